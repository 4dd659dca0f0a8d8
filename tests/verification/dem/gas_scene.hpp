#pragma once
#include <filesystem>

#include "physics/closures/gas_properties.hpp"
#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/foam_case.hpp"
#include "schemas/campaign.hpp"

namespace cupola::test {

inline constexpr double gas_temperature = 293;  // K

/// Puts a gas into a box, blown from below over its whole bottom.
/// @param mass_flow kg/s  @param density kg/m3, at the outlet  @param viscosity Pa s
inline void blow_through(Campaign& campaign, double mass_flow, double density, double viscosity) {
  Gas gas;
  gas.species = "air";
  gas.molar_mass = 0.029;
  gas.heat_capacity = 1005;
  gas.viscosity = viscosity;
  gas.prandtl = 0.7;
  gas.outlet_pressure = density * molar_gas_constant * gas_temperature / gas.molar_mass;
  Inlet blast;
  blast.name = "blast";
  blast.side = Inlet::Side::bottom;
  blast.mass_flow = mass_flow;
  blast.total_temperature = gas_temperature;
  gas.inlets = {blast};
  campaign.scene.gas = gas;
}

/// OpenFOAM and the mesh of a campaign on all ranks, in the running test's folder.
class GasScene {
 public:
  explicit GasScene(const Campaign& campaign);

 private:
  std::filesystem::path folder_;
  char name_[7] = "cupola";
  char* words_[2] = {name_, nullptr};
  int argc_ = 1;
  char** argv_ = words_;

 public:
  FoamCase foam;
  BedMesh mesh;
};

}  // namespace cupola::test
