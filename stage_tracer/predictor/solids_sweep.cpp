#include "stage_tracer/predictor/solids_sweep.hpp"

#include <algorithm>
#include <limits>

#include "physics/closures/solid_enthalpy.hpp"
#include "stage_tracer/predictor/stay.hpp"

namespace cupola {
namespace {

/// Less than this share of what entered counts as used up.
constexpr double least_survival = 1e-12;
/// Place of what enters from above the stock plane, after the six sides.
constexpr std::size_t from_outside = 6;
constexpr std::size_t no_cell = std::numeric_limits<std::size_t>::max();

/// All sums of a sweep as one flat array, so that the ranks exchange one message.
class Sums {
 public:
  Sums(std::size_t species, std::size_t cells)
      : species_(species), cells_(cells), values((9 * species + 1) * cells + Tally::columns, 0.0) {}

  double& volume(std::size_t s, std::size_t c) { return values[s * cells_ + c]; }
  double& heat(std::size_t s, std::size_t c) { return values[(species_ + s) * cells_ + c]; }
  double& inflow(std::size_t s, std::size_t c, std::size_t side) {
    return values[(2 * species_ + 7 * s) * cells_ + 7 * c + side];
  }
  double& removed(std::size_t c) { return values[9 * species_ * cells_ + c]; }
  double* tally() { return &values[(9 * species_ + 1) * cells_]; }

 private:
  std::size_t species_;
  std::size_t cells_;

 public:
  std::vector<double> values;
};

std::size_t side_between(const BedMesh& mesh, std::size_t cell, std::size_t from) {
  for (std::size_t side = 0; side < 6; ++side) {
    if (mesh.across(static_cast<std::int64_t>(cell), mesh.cell_faces[cell][side]) == static_cast<std::int64_t>(from))
      return side;
  }
  return no_cell;
}

}  // namespace

SolidsSweep::SolidsSweep(const BedMesh& mesh, const Campaign& campaign, std::vector<double> share)
    : mesh_(mesh), campaign_(campaign), share_over_persistent_(std::move(share)) {
  double persistent = 0;
  for (std::size_t s = 0; s < share_over_persistent_.size(); ++s) {
    persistent_.push_back(!campaign.species[s].softening.has_value());
    if (persistent_[s]) persistent += share_over_persistent_[s];
  }
  for (double& value : share_over_persistent_) value /= persistent;
  double hottest = 0;
  for (const Inlet& inlet : campaign.scene.gas->inlets) hottest = std::max(hottest, inlet.total_temperature);
  for (const Species& species : campaign.species) {
    const double from = campaign.charging.temperature;
    const double to = species.softening ? species.softening->melted : hottest;
    capacity_.push_back(species.density * (solid_enthalpy(species, to) - solid_enthalpy(species, from)) / (to - from));
  }
}

SolidsOnLines SolidsSweep::operator()(const Streamlines& lines, const std::vector<double>& storage,
                                      const std::vector<double>& removal_rate, const SolidsSurroundings& surroundings,
                                      const SumOverRanks& sum) const {
  const std::size_t cells = mesh_.cells();
  const std::size_t species = campaign_.species.size();
  Sums sums(species, cells);
  Tally tally;
  const double charged_at = campaign_.charging.temperature;
  std::vector<double> temperature(species);
  std::vector<bool> present(species);
  for (const Streamlines::Line& line : lines.lines()) {
    std::vector<double> flux(species);
    for (std::size_t s = 0; s < species; ++s) {
      flux[s] = line.flux * share_over_persistent_[s];
      present[s] = flux[s] > 0;
      temperature[s] = charged_at;
      tally.enter(flux[s] * campaign_.species[s].density, capacity_[s] * flux[s] * (charged_at - enthalpy_zero));
    }
    std::size_t before = no_cell;
    for (std::size_t i = line.first; i < line.end; ++i) {
      const Streamlines::Stay& stay = lines.stays()[i];
      const auto c = static_cast<std::size_t>(stay.cell);
      const double removal = removal_rate[c];
      double time = stay.time * storage[c];
      // A line that ends at rest without being used up cannot fill more than its cell.
      if (!(removal > 0)) time = std::min(time, storage[c] * mesh_.cell_volume[c] / line.flux);
      const std::size_t side = before == c         ? no_cell
                               : before == no_cell ? from_outside
                                                   : side_between(mesh_, c, before);
      before = c;
      bool any = false;
      for (std::size_t s = 0; s < species; ++s) {
        if (!present[s]) continue;
        const Species& of = campaign_.species[s];
        const double capacity = capacity_[s];
        const auto heat = [&](double volume) { return capacity * volume * (temperature[s] - enthalpy_zero); };
        if (of.softening && mesh_.cell_centre[c][2] < of.none_below) {
          tally.leave(Cause::unmelted, flux[s] * of.density, heat(flux[s]));
          present[s] = false;
          continue;
        }
        if (side != no_cell) sums.inflow(s, c, side) += flux[s] * capacity;
        const StayOfSolids course(temperature[s], surroundings.rate[s][c], surroundings.felt[s][c],
                                  surroundings.source[s][c], removal);
        const double melts = of.softening ? course.time_of(of.softening->melted) : HUGE_VAL;
        const bool melted = melts <= time;
        const double lasts = melted ? melts : time;
        const double volume = flux[s] * course.volume_time(lasts);
        const double excess = flux[s] * course.excess_time(lasts);
        sums.volume(s, c) += volume;
        sums.heat(s, c) += volume * temperature[s] + excess;
        const double used_up = std::min(flux[s], removal * volume);
        if (used_up > 0) {
          tally.leave(Cause::raceway, used_up * of.density, heat(used_up) + removal * excess * capacity);
          if (persistent_[s]) sums.removed(c) += used_up;
        }
        const double entered = flux[s];
        flux[s] -= used_up;
        temperature[s] = course.temperature(lasts);
        if (melted) tally.leave(Cause::melted, flux[s] * of.density, heat(flux[s]));
        if (flux[s] <= least_survival * entered && !melted) {
          if (flux[s] > 0) tally.leave(Cause::raceway, flux[s] * of.density, heat(flux[s]));
          flux[s] = 0;
        }
        present[s] = !melted && flux[s] > 0;
        any = any || present[s];
      }
      if (!any) break;
    }
    for (std::size_t s = 0; s < species; ++s) {
      if (present[s])
        tally.leave(Cause::lost, flux[s] * campaign_.species[s].density,
                    capacity_[s] * flux[s] * (temperature[s] - enthalpy_zero));
    }
  }
  const std::vector<double> row = tally.row();
  std::copy(row.begin(), row.end(), sums.tally());
  sum(sums.values);

  SolidsOnLines result;
  const BySpecies zero(species, std::vector<double>(cells, 0.0));
  result.contents = {zero, zero};
  result.inflow.assign(species, std::vector<double>(7 * cells));
  for (std::size_t s = 0; s < species; ++s) {
    for (std::size_t c = 0; c < cells; ++c) {
      const double volume = sums.volume(s, c);
      result.contents.volume[s][c] = volume;
      if (volume > 0) result.contents.temperature[s][c] = sums.heat(s, c) / volume;
      for (std::size_t side = 0; side < 7; ++side) result.inflow[s][7 * c + side] = sums.inflow(s, c, side);
    }
  }
  for (std::size_t c = 0; c < cells; ++c) result.removed.push_back(sums.removed(c));
  result.rates = Tally::from_row({sums.tally(), sums.tally() + Tally::columns});
  return result;
}

}  // namespace cupola
