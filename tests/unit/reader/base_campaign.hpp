#pragma once
#include <stdexcept>
#include <string>

namespace cupola::test {

/// A sound campaign with every kind of section, to be spoilt by the tests.
inline const std::string base_campaign = R"(campaign: base
scene:
  geometry: {slot: {depth: 0.6 m, profile: [[0, 1.5], [1, 1.5], [6, 1.2]]}}
  mesh: {cell: 0.2 m}
  gas:
    species: blast
    inlets:
      - {name: left, side: left, z: 0.5 m, size: [0.2 m, 0.2 m], mass_flow: 1.4 kg/s, total_temperature: 2600 K}
species:
  coke: {diameter: 44 mm, coarse_graining: 4, density: 800, heat_capacity: 850, conductivity: 1.7}
  ore:
    {diameter: 15 mm, density: 3 t/m3, heat_capacity: 600, conductivity: 80, softening: {from: 1475 K, melted: 1675 K}}
contacts:
  pairs:
    coke-coke: {restitution: 0.5, friction: 0.9, rolling: 0.5}
    ore-ore: {restitution: 0.5, friction: 0.8, rolling: 0.4}
    ore-coke: {restitution: 0.2, friction: 0.8, rolling: 0.02}
    coke-wall: {restitution: 0.5, friction: 0.5, rolling: 0.02}
    ore-wall: {restitution: 0.2, friction: 0.2, rolling: 0.02}
heat: {}
charging: {stock_line: 5.5 m, layers: [{coke: 200 kg}, {ore: 600 kg}]}
raceways:
  - {box: {x: [1, 1.5], y: [-0.3, 0.3], z: [0.3, 0.7]}, dem_removal_rate: 50 kg/s}
descent_rate: 2 mm/s
dem: {stop: {at_most: 20 s}}
converged: {for: 2 episodes, at_most: 8 episodes}
)";

/// The base campaign with one piece of text replaced by another.
inline std::string spoilt(const std::string& old_text, const std::string& new_text) {
  auto text = base_campaign;
  const auto at = text.find(old_text);
  if (at == std::string::npos) throw std::logic_error("not in the base campaign: " + old_text);
  return text.replace(at, old_text.size(), new_text);
}

}  // namespace cupola::test
