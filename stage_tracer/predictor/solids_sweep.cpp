#include "stage_tracer/predictor/solids_sweep.hpp"

#include <algorithm>
#include <cmath>
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
      : species_(species), cells_(cells), values((9 * species + 3) * cells + Tally::columns, 0.0) {}

  double& volume(std::size_t s, std::size_t c) { return values[s * cells_ + c]; }
  double& heat(std::size_t s, std::size_t c) { return values[(species_ + s) * cells_ + c]; }
  double& inflow(std::size_t s, std::size_t c, std::size_t side) {
    return values[(2 * species_ + 7 * s) * cells_ + 7 * c + side];
  }
  double& removed(std::size_t c) { return values[9 * species_ * cells_ + c]; }
  double& passed(std::size_t c) { return values[(9 * species_ + 1) * cells_ + c]; }
  double& share(std::size_t c) { return values[(9 * species_ + 2) * cells_ + c]; }
  double* tally() { return &values[(9 * species_ + 3) * cells_]; }

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

/// One line on its way down.
class SolidsSweep::Walk {
 public:
  Walk(const SolidsSweep& sweep, const SolidsSurroundings& surroundings, Sums& sums, Tally& tally)
      : sweep_(sweep),
        species_(sweep.campaign_.species),
        around_(surroundings),
        sums_(sums),
        tally_(tally),
        flux_(species_.size()),
        temperature_(species_.size()),
        melts_(species_.size()) {}

  /// @param persistent m3/s
  void enter(double persistent) {
    const double charged_at = sweep_.campaign_.charging.temperature;
    for (std::size_t s = 0; s < species_.size(); ++s) {
      flux_[s] = persistent * sweep_.share_over_persistent_[s];
      temperature_[s] = charged_at;
      tally_.enter(flux_[s] * species_[s].density, heat(s, flux_[s]));
    }
  }

  [[nodiscard]] bool empty() const {
    return std::all_of(flux_.begin(), flux_.end(), [](double flux) { return flux <= 0; });
  }

  /// Enters a cell through a side (`no_cell`: is still in the same).
  void pass_into(std::size_t cell, std::size_t side) {
    for (std::size_t s = 0; s < species_.size(); ++s) {
      if (!(flux_[s] > 0)) continue;
      if (species_[s].softening && sweep_.mesh_.cell_centre[cell][2] < species_[s].none_below) {
        leave(s, Cause::unmelted);
      } else if (side != no_cell) {
        sums_.inflow(s, cell, side) += flux_[s] * sweep_.capacity_[s];
      }
    }
  }

  /// Stays in a cell for so long at a storage of 1; each melting that falls into the stay ends a part of it.
  void stay(std::size_t cell, double time_left, double packing, double sink) {
    while (time_left > 0 && !empty()) {
      const double share = persistent_share();
      const double storage = share * packing;
      const double removal = sink / storage;
      double time = time_left * storage;
      for (std::size_t s = 0; s < species_.size(); ++s) {
        melts_[s] = HUGE_VAL;
        if (flux_[s] > 0 && species_[s].softening)
          melts_[s] = course(s, cell, removal).time_of(species_[s].softening->melted);
      }
      const double first = *std::min_element(melts_.begin(), melts_.end());
      const bool melting = first <= time;
      if (melting) time = first;
      const double part = melting ? time / storage : time_left;
      double persistent = 0;
      for (std::size_t s = 0; s < species_.size(); ++s) {
        if (sweep_.persistent_[s]) persistent += flux_[s];
      }
      const double volume = persistent * StayOfSolids::survived(sink, part);
      sums_.passed(cell) += volume;
      sums_.share(cell) += volume * share;
      for (std::size_t s = 0; s < species_.size(); ++s) {
        if (!(flux_[s] > 0)) continue;
        exchange(s, cell, time, removal);
        if (melting && melts_[s] <= first) leave(s, Cause::melted);
      }
      time_left -= part;
    }
  }

  void end() {
    for (std::size_t s = 0; s < species_.size(); ++s) leave(s, Cause::lost);
  }

 private:
  [[nodiscard]] double heat(std::size_t s, double volume) const {
    return sweep_.capacity_[s] * volume * (temperature_[s] - enthalpy_zero);
  }
  [[nodiscard]] StayOfSolids course(std::size_t s, std::size_t cell, double removal) const {
    return {temperature_[s], around_.rate[s][cell], around_.felt[s][cell], around_.source[s][cell], removal};
  }
  void leave(std::size_t s, Cause cause) {
    if (flux_[s] > 0) tally_.leave(cause, flux_[s] * species_[s].density, heat(s, flux_[s]));
    flux_[s] = 0;
  }

  /// Of the solids flux that is left of the line; all species are used up at the same rate.
  [[nodiscard]] double persistent_share() const {
    double all = 0;
    double persistent = 0;
    for (std::size_t s = 0; s < species_.size(); ++s) {
      if (flux_[s] > 0) all += sweep_.share_over_persistent_[s];
      if (sweep_.persistent_[s]) persistent += sweep_.share_over_persistent_[s];
    }
    return persistent / all;
  }

  void exchange(std::size_t s, std::size_t cell, double time, double removal) {
    const StayOfSolids part = course(s, cell, removal);
    const double volume = flux_[s] * part.volume_time(time);
    const double excess = flux_[s] * part.excess_time(time);
    sums_.volume(s, cell) += volume;
    sums_.heat(s, cell) += volume * temperature_[s] + excess;
    const double used_up = std::min(flux_[s], removal * volume);
    if (used_up > 0) {
      tally_.leave(Cause::raceway, used_up * species_[s].density,
                   heat(s, used_up) + removal * excess * sweep_.capacity_[s]);
      if (sweep_.persistent_[s]) sums_.removed(cell) += used_up;
    }
    const double entered = flux_[s];
    flux_[s] -= used_up;
    temperature_[s] = part.temperature(time);
    if (flux_[s] <= least_survival * entered) leave(s, Cause::raceway);
  }

  const SolidsSweep& sweep_;
  const std::vector<Species>& species_;
  const SolidsSurroundings& around_;
  Sums& sums_;
  Tally& tally_;
  std::vector<double> flux_;         ///< m3/s of each species; 0: no longer there
  std::vector<double> temperature_;  ///< K
  std::vector<double> melts_;        ///< s until each melts in this part of the stay
};

SolidsOnLines SolidsSweep::operator()(const Streamlines& lines, const std::vector<double>& packing,
                                      const std::vector<double>& sink, const SolidsSurroundings& surroundings,
                                      const SumOverRanks& sum) const {
  const std::size_t cells = mesh_.cells();
  const std::size_t species = campaign_.species.size();
  Sums sums(species, cells);
  Tally tally;
  Walk walk(*this, surroundings, sums, tally);
  for (const Streamlines::Line& line : lines.lines()) {
    walk.enter(line.flux);
    std::size_t before = no_cell;
    for (std::size_t i = line.first; i < line.end && !walk.empty(); ++i) {
      const Streamlines::Stay& stay = lines.stays()[i];
      const auto c = static_cast<std::size_t>(stay.cell);
      walk.pass_into(c, before == c ? no_cell : before == no_cell ? from_outside : side_between(mesh_, c, before));
      before = c;
      // A line that ends at rest without being used up cannot fill more than its cell.
      const double time = sink[c] > 0 ? stay.time : std::min(stay.time, mesh_.cell_volume[c] / line.flux);
      walk.stay(c, time, packing[c], sink[c]);
    }
    walk.end();
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
  for (std::size_t c = 0; c < cells; ++c) {
    result.removed.push_back(sums.removed(c));
    result.passed.push_back(sums.passed(c));
    result.share.push_back(sums.passed(c) > 0 ? sums.share(c) / sums.passed(c) : 0);
  }
  result.rates = Tally::from_row({sums.tally(), sums.tally() + Tally::columns});
  return result;
}

}  // namespace cupola
