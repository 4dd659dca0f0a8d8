#pragma once
#include <cmath>
#include <stdexcept>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/campaign_reader.hpp"

namespace cupola::testing {

/// Adds a second kind of grain, `fine`: as the first but for its size and conductivity, in its contacts too.
inline void add_fine_grains(Campaign& campaign, double diameter, double conductivity) {
  Species fine = campaign.species[0];
  fine.name = "fine";
  fine.diameter = diameter;
  fine.conductivity = conductivity;
  campaign.species.push_back(fine);
  for (const char* other : {"fine-fine", "fine-wall", "pebble-fine"})
    campaign.contacts.pairs[other] = campaign.contacts.pairs.at("pebble-pebble");
}

/// A column of pebbles at rest, blown from below: a bed 0.2 m wide, 0.2 m deep and 1 m high, without heat loss and with
/// hardly any conduction in the pebbles.  Tests change what they are about.
inline Campaign column_campaign(int rows) {
  const ReadCampaign read = read_campaign_text(R"yaml(
campaign: column
scene:
  geometry: {box: {width: 0.2 m, depth: 0.2 m, height: 1 m}}
  mesh: {cell: 0.1 m, cells: {half_width: 1, depth: 1, heights: [)yaml" +
                                                   std::to_string(rows) + R"yaml(]}}
  gas:
    species: air
    inlets: [{name: blast, side: bottom, mass_flow: 0.04 kg/s, total_temperature: 1300 K}]
species:
  pebble: {diameter: 5 mm, density: 2000 kg/m3, heat_capacity: 800 J/kg/K, conductivity: 1e-9 W/m/K}
contacts:
  pairs:
    pebble-pebble: {restitution: 0.5, friction: 0.5, rolling: 0.1}
    pebble-wall: {restitution: 0.5, friction: 0.3, rolling: 0.02}
heat: {nusselt_factor: 1}
charging: {stock_line: 1 m, temperature: 300 K, layers: [{pebble: 10 kg}]}
descent_rate: 0
dem: {stop: {at_most: 5 s}}
tracer: {duration: 100 s, time_step: 1 s, tracers_per_cell: 1}
)yaml",
                                               "column.yaml");
  if (!read.ok()) throw std::runtime_error(to_text(read.errors));
  return read.campaign;
}

/// Mass flux of the column's blast, kg/m2/s.
inline double blast_flux(const Campaign& campaign) {
  return campaign.scene.gas->inlets[0].mass_flow /
         (2 * campaign.half_width(campaign.bottom()) * campaign.scene.geometry.depth);
}

/// Heat exchange of the first species a volume of bed with the solids fraction given, W/m3/K: h a with a = 6 (1 - e)/d
/// and h after Ranz and Marshall, written out here so that the stage's own closure is held against it.
inline double volumetric_exchange(const Campaign& campaign, double mass_flux, double solids_fraction) {
  const Gas& gas = *campaign.scene.gas;
  const double diameter = campaign.species[0].diameter;
  const double reynolds = mass_flux * diameter / gas.viscosity;
  const double nusselt = 2 + 0.6 * std::sqrt(reynolds) * std::cbrt(gas.prandtl);
  const double conductivity = gas.viscosity * gas.heat_capacity / gas.prandtl;
  return campaign.heat->nusselt_factor * nusselt * conductivity / diameter * 6 * solids_fraction / diameter;
}

/// Means over the rows of a field of the column, from the bottom up (weighted with nothing: a row's cells are equal).
inline std::vector<double> row_means(const BedMesh& mesh, const std::vector<double>& field, double height,
                                     std::size_t rows) {
  std::vector<double> sum(rows, 0.0), count(rows, 0.0);
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    const auto row = static_cast<std::size_t>(mesh.cell_centre[c][2] / height * static_cast<double>(rows));
    sum[row] += field[c];
    count[row] += 1;
  }
  for (std::size_t k = 0; k < rows; ++k) sum[k] /= count[k];
  return sum;
}

}  // namespace cupola::testing
