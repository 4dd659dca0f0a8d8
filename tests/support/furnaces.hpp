#pragma once
#include "schemas/campaign.hpp"

/// Small campaigns that tests of several parts build their scenes from.
namespace cupola::furnaces {

inline Inlet tuyere(const std::string& name, Inlet::Side side, double z) {
  Inlet inlet;
  inlet.name = name;
  inlet.side = side;
  inlet.z = z;
  inlet.size = {0.25, 0.25};
  inlet.mass_flow = 1.4;
  inlet.total_temperature = 2600;
  return inlet;
}

inline Species grains(const std::string& name, double diameter, double coarse_graining, double density) {
  Species species;
  species.name = name;
  species.diameter = diameter;
  species.coarse_graining = coarse_graining;
  species.density = density;
  return species;
}

/// A shaft slot 8 m high with a bosh, two tuyeres and periodic sides; the stock line lies inside the mesh.
inline Campaign shaft() {
  Campaign campaign;
  campaign.name = "shaft";
  campaign.scene.geometry.depth = 0.6;
  campaign.scene.geometry.profile = {{-0.5, 1.5}, {0.2, 1.5}, {1.0, 1.85}, {6.5, 1.2}, {7.6, 1.2}};
  campaign.scene.mesh.cell = 0.2;
  Gas gas;
  gas.species = "air";
  gas.molar_mass = 0.029;
  gas.heat_capacity = 1040;
  gas.viscosity = 2e-5;
  gas.prandtl = 0.8;
  gas.inlets = {tuyere("tuyere-left", Inlet::Side::left, 0.06), tuyere("tuyere-right", Inlet::Side::right, 0.06)};
  campaign.scene.gas = gas;
  campaign.species = {grains("coke", 0.044, 4, 800), grains("ore", 0.015, 10, 3000)};
  campaign.charging.stock_line = 6.1;
  campaign.charging.hopper_height = 1.0;
  return campaign;
}

/// The paper's furnace with the cell counts of the published mesh: 107,008 cells.
inline Campaign paper() {
  Campaign campaign = shaft();
  campaign.name = "paper";
  campaign.scene.geometry.depth = 1.2;
  campaign.scene.geometry.profile = {{-2, 6.0}, {0.75, 6.0}, {3.9, 7.4}, {6.4, 7.4}, {24, 4.7}, {26, 4.7}};
  campaign.scene.mesh.cells = MeshCells{32, 11, {25, 15, 12, 90, 10}};
  campaign.charging.stock_line = 26.1;
  campaign.charging.hopper_height = 2.5;
  return campaign;
}

/// A box with walls all round, blown from below over its whole bottom.
inline Campaign box() {
  Campaign campaign = shaft();
  campaign.name = "box";
  campaign.scene.geometry.kind = Geometry::Kind::box;
  campaign.scene.geometry.sides = Geometry::Sides::walls;
  campaign.scene.geometry.depth = 0.4;
  campaign.scene.geometry.profile = {{0, 0.3}, {1.5, 0.3}};
  campaign.scene.mesh.cell = 0.1;
  Inlet blast;
  blast.name = "blast";
  blast.side = Inlet::Side::bottom;
  blast.mass_flow = 0.1;
  campaign.scene.gas->inlets = {blast};
  campaign.charging.stock_line = 1.6;
  return campaign;
}

}  // namespace cupola::furnaces
