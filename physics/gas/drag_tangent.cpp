#include "physics/gas/drag_tangent.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "physics/closures/drag.hpp"
#include "physics/closures/gas_properties.hpp"
#include "physics/closures/sutherland.hpp"
#include "physics/equations/cell_failure.hpp"

namespace cupola {
namespace {

constexpr double least_relative_resistance = 1e-4;

}  // namespace

void DragTangents::update(const BedState& bed, const std::vector<double>& gas_temperature,
                          const std::vector<double>& speed, double usual_speed) {
  const double specific_gas_constant = molar_gas_constant / gas_.molar_mass;
  tangents_.resize(mesh_.cells());
  double sum = 0, volume = 0;
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell) {
    const double void_fraction = bed.void_fraction[cell];
    if (!(void_fraction > 0) || void_fraction > 1 + 1e-12) {
      throw cell_failure(mesh_, fmt::format("a cell without gas: void fraction {}", void_fraction), cell);
    }
    if (!(gas_temperature[cell] > 0)) {
      throw cell_failure(mesh_, fmt::format("gas temperature is {} K", gas_temperature[cell]), cell);
    }
    Tangent& tangent = tangents_[cell];
    tangent = {0, 0, speed[cell]};
    if (void_fraction > 1 - empty_solids_fraction) continue;
    // The laws depend on density x speed only, so a density of 1 turns the speed into the mass flux.
    const double viscosity = gas_viscosity(gas_, gas_temperature[cell]);
    const auto law = [&](double flux) {
      return specific_gas_constant * gas_temperature[cell] *
             drag_resistance(law_, void_fraction, bed.grain_diameter[cell], viscosity, 1, flux, bed.drag_factor[cell]);
    };
    const double step = 1e-3 * std::max(speed[cell], 1e-3 * usual_speed);
    tangent.value = law(speed[cell]);
    tangent.slope = std::max(0.0, (law(speed[cell] + step) - tangent.value) / step);
    sum += tangent.value * mesh_.cell_volume[cell];
    volume += mesh_.cell_volume[cell];
  }
  if (volume == 0) {
    throw Failure(ExitCode::diverged, "no solids left in any cell: the gas has nothing to flow through");
  }
  least_ = least_relative_resistance * sum / volume;
}

DragTangents::Value DragTangents::at(std::int64_t cell, double speed, double normal_flux) const {
  const Tangent& tangent = tangents_[cell];
  // A tangent far from where it touches must not lead below zero.
  const double value = std::max({tangent.value + tangent.slope * (speed - tangent.speed), 0.1 * tangent.value, least_});
  return {value, speed > 0 ? tangent.slope * normal_flux * normal_flux / speed : 0};
}

}  // namespace cupola
