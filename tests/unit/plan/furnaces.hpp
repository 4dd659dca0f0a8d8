#pragma once
#include <utility>

#include "physics/plan/charge.hpp"
#include "schemas/campaign.hpp"

namespace cupola::test {

/// The paper's furnace (two of its inserted layers make a round of the recipe), with 8.6 kg/s a tuyere through 0.25 m x
/// 0.25 m unless told otherwise.
inline Campaign paper_furnace(double blast = 8.6, double opening = 0.25) {
  Campaign campaign;
  campaign.name = "paper";
  campaign.scene.geometry = {Geometry::Kind::slot,
                             1.2,
                             Geometry::Sides::periodic,
                             {{-2, 6}, {0.75, 6}, {3.9, 7.4}, {6.4, 7.4}, {24, 4.7}, {26, 4.7}}};
  campaign.scene.mesh.cell = 0.2;
  Gas gas;
  gas.species = "blast";
  gas.molar_mass = 0.028;
  gas.heat_capacity = 745 + 8.31446261815324 / 0.028;
  gas.viscosity = 2e-5;
  gas.prandtl = 0.8;
  for (const auto& [name, side] : {std::pair{"tuyere-left", Inlet::Side::left}, {"tuyere-right", Inlet::Side::right}}) {
    Inlet inlet;
    inlet.name = name;
    inlet.side = side;
    inlet.z = 0.06;
    inlet.size = {opening, opening};
    inlet.mass_flow = blast;
    inlet.total_temperature = 2620;
    gas.inlets.push_back(inlet);
  }
  campaign.scene.gas = gas;
  campaign.scene.heat_loss = WallHeatLoss{20, 293};
  campaign.species = {{"coke", 0.044, 4, 800, 850, 1.7, std::nullopt, 0},
                      {"ore", 0.015, 10, 3000, 600, 80, Softening{1475, 1675}, 3}};
  campaign.drag = DragLaw::beetstra;
  campaign.heat = Heat{0.1};
  campaign.initial.cohesive_zone = InvertedV{8, 0.5, 2700, 300};
  campaign.charging.stock_line = 26.1;
  // 0.62 m of coke and 0.825 m of ore over 9.4 m x 1.2 m at a packing of 0.56.
  campaign.charging.layers = {{{"coke", 0.62 * 11.28 * 0.56 * 800}}, {{"ore", 0.825 * 11.28 * 0.56 * 3000}}};
  campaign.charging.hopper_height = 2.5;
  for (const double side : {-1.0, 1.0}) {
    Raceway raceway;
    raceway.box = {Vector3{side < 0 ? -6.0 : 4.5, -0.5, -0.5}, Vector3{side < 0 ? -4.5 : 6.0, 0.5, 0.5}};
    raceway.void_fraction = 0.9;
    raceway.dem_removal_rate = 500;
    campaign.raceways.push_back(raceway);
  }
  campaign.descent_rate = 2e-3;
  campaign.dem.time_step = 2.5e-5;
  return campaign;
}

}  // namespace cupola::test
