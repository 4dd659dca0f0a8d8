#pragma once
#include <mpi.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "physics/mesh/foam_case.hpp"
#include "schemas/hdf.hpp"
#include "stage_dem/solids_on_mesh.hpp"

namespace cupola {

/// The gas of the DEM stage: `dem.gas` says which.  Collective; arrays are over all cells, the same on every rank.
class DemGas {
 public:
  DemGas() = default;
  DemGas(const DemGas&) = delete;
  DemGas& operator=(const DemGas&) = delete;
  virtual ~DemGas() = default;

  /// Follows the bed: the parcels last divided, an engine's `owned`.
  /// @param seconds since the last call  @param in_any_case solve even where nothing has changed
  virtual void update(const SolidsOnMesh& solids, const std::vector<Parcel>& owned, double seconds,
                      bool in_any_case = false) = 0;
  /// Forces on those parcels, in their order.
  [[nodiscard]] virtual std::vector<ParcelForce> forces(const SolidsOnMesh& solids,
                                                        const std::vector<Parcel>& owned) = 0;
  /// Longest time until the next `update`, s; infinity where one a block is enough.
  [[nodiscard]] virtual double longest_step() const = 0;

  /// What is given to the parcels less what the gas loses, over the size of both, largest so far.
  [[nodiscard]] virtual double momentum_residual() const = 0;
  [[nodiscard]] virtual const std::vector<double>& pressure() const = 0;  ///< Pa
  /// Interstitial velocity, cells x 3, m/s.
  [[nodiscard]] virtual std::vector<double> velocity() const = 0;
  /// Numbers for the report.
  [[nodiscard]] virtual nlohmann::json summary() const = 0;

  virtual void save(HdfWriter& file) const = 0;
  virtual void load(const HdfReader& file) = 0;
};

/// The one that the campaign asks for; null for none. @param temperature of the gas, K, all cells
std::unique_ptr<DemGas> make_dem_gas(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign,
                                     const std::vector<double>& temperature, MPI_Comm communicator);

}  // namespace cupola
