#include "stage_tracer/predictor/predictor.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/closures/enthalpy_zero.hpp"
#include "schemas/failure.hpp"
#include "stage_tracer/bed_composition.hpp"
#include "stage_tracer/ore_temperature.hpp"
#include "stage_tracer/predictor/lagged_state.hpp"

namespace cupola {
namespace {

/// On streamlines that will move again, the temperatures need not be much better than the last move.
constexpr double inner_over_outer = 0.2;
constexpr double least_inner = 0.1;  // K
constexpr int most_evaluations = 10;
constexpr double flow_tolerance = 1e-4;
/// Of a cell of which lines fill less than this share they know less and less what flows there.
constexpr double least_known = 0.1;
/// Lines that pass from one cell to another let temperatures jump, however little they move.  Changes below this share
/// of rms(T - 293 K) that have not fallen by a quarter over so many iterations are such jumps.
constexpr double largest_jump = 0.01;
constexpr std::size_t looked_at = 3;
constexpr double slow_decrease = 0.75;
/// Share of the bed that lines should reach: a dead man is less than the rest.
constexpr double least_reached = 0.75;

/// rms over the bed of what changed, K: the gas weighted with the cells' volumes, species with their shares of the
/// solids.
double change_of(const BedMesh& mesh, const std::vector<bool>& bed, const CellContents& contents,
                 const BedTemperatures& now, const BedTemperatures& before) {
  double sum = 0;
  double weight = 0;
  const auto add = [&](double volume, double difference) {
    sum += volume * difference * difference;
    weight += volume;
  };
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    if (!bed[c]) continue;
    add(mesh.cell_volume[c], now.gas[c] - before.gas[c]);
    double solids = 0;
    for (const auto& volume : contents.volume) solids += volume[c];
    for (std::size_t s = 0; s < now.solids.size() && solids > 0; ++s) {
      if (!(before.solids[s][c] > 0)) continue;  // was not there
      add(mesh.cell_volume[c] * contents.volume[s][c] / solids, now.solids[s][c] - before.solids[s][c]);
    }
  }
  return weight > 0 ? std::sqrt(sum / weight) : 0;
}

/// rms(T - 293 K) of the gas, K.
double level_of(const BedTemperatures& temperatures) {
  double sum = 0;
  for (const double gas : temperatures.gas) sum += (gas - enthalpy_zero) * (gas - enthalpy_zero);
  return std::sqrt(sum / static_cast<double>(temperatures.gas.size()));
}

/// Whether what still changes is no more than lines that jump between cells.
bool only_lines_jump(const std::vector<Predictor::Iteration>& done, double level) {
  if (done.size() < 2 * looked_at) return false;
  const auto least = [&](std::size_t from, std::size_t to) {
    double result = HUGE_VAL;
    for (std::size_t i = done.size() - from; i < done.size() - to; ++i) result = std::min(result, done[i].change);
    return result;
  };
  return done.back().change < largest_jump * level &&
         least(looked_at, 0) > slow_decrease * least(2 * looked_at, looked_at);
}

}  // namespace

Predictor::Predictor(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, const DemResult* dem,
                     const std::vector<double>& dem_temperature)
    : foam_(foam),
      mesh_(mesh),
      campaign_(campaign),
      granular_(foam, mesh, campaign, dem, dem_temperature),
      kernel_(mesh, field().bed, kernel_diameter(campaign, field().charge)),
      conduction_(mesh, campaign, field().bed, field().charge.layer_thickness, field().charge.volume_share),
      heat_(mesh, campaign, kernel_, conduction_, sum_over_world()),
      gas_(foam, mesh, campaign),
      empty_share_(share_of_persistent(campaign, field().charge)) {}

void Predictor::compose(const CellContents& contents) {
  bed_volume_ = bed_composition(mesh_, campaign_, field(), spread(contents, kernel_), empty_share_);
  bed_ = bed_state(mesh_, campaign_, bed_volume_);
}

CellContents Predictor::guessed_contents(const std::vector<double>& ore_temperature) const {
  CellContents contents{BySpecies(campaign_.species.size(), std::vector<double>(mesh_.cells(), 0.0)),
                        temperatures_.solids};
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    if (!field().bed[c]) continue;
    for (std::size_t s = 0; s < campaign_.species.size(); ++s) {
      const Species& species = campaign_.species[s];
      const bool gone = species.softening && (ore_temperature[c] >= species.softening->melted ||
                                              mesh_.cell_centre[c][2] < species.none_below);
      if (!gone)
        contents.volume[s][c] = field().charge.volume_share[s] * field().solids_fraction[c] * mesh_.cell_volume[c];
    }
  }
  return contents;
}

MeltingZone Predictor::melting_zone() const {
  if (!can_melt(campaign_)) return {std::vector<double>(mesh_.cells(), campaign_.charging.temperature), {}, {}, {}};
  const CellContents around = spread(solids_.contents, kernel_);
  return find_melting_zone(mesh_, campaign_, field(), around.volume, around.temperature);
}

void Predictor::draw_lines(const std::vector<double>& share, const Settings& settings,
                           std::optional<Streamlines>& lines, PartClock& clock) {
  {
    const auto running = clock.measure("granular flux");
    granular_.follow(share);
    share_ = share;
  }
  const auto running = clock.measure("streamlines");
  std::vector<double> persistent_flux;
  for (const StockFace& face : field().stock_faces)
    persistent_flux.push_back(face.volume_rate * granular_.charged_share());
  lines.emplace(mesh_, field().face_flux, field().stock_faces, persistent_flux, granular_.sink(), settings.lines_across,
                foam_.rank(), foam_.ranks());
}

Predictor::Outcome Predictor::solve(BedTemperatures temperatures, const Settings& settings, PartClock& clock) {
  temperatures_ = std::move(temperatures);
  // Where melting is guessed, the species that melts is taken at its guessed temperature.
  std::vector<double> ore = temperatures_.gas;
  for (std::size_t s = 0; s < campaign_.species.size(); ++s) {
    if (campaign_.species[s].softening) ore = temperatures_.solids[s];
  }
  LaggedState state{temperatures_.gas, guessed_contents(ore),
                    settings.share != nullptr ? *settings.share : granular_.share(ore)};
  const auto [coldest, hottest] = temperature_range(campaign_);
  LaggedIteration lagged(mesh_, field().bed, coldest, hottest, granular_.charged_share());
  MeltingZone zone;
  Outcome outcome;
  std::optional<Streamlines> lines;
  double tolerance = 20;
  bool held = false;
  for (int iteration = 0; iteration < settings.most_iterations; ++iteration) {
    const bool stay = held || settings.share != nullptr;
    if (!stay || !lines) draw_lines(state.share, settings, lines, clock);
    {
      const auto running = clock.measure("flow");
      compose(state.contents);
      if (iteration == 0) {
        gas_.begin(bed_, state.gas);
      } else {
        gas_.improve_flow(bed_, state.gas, flow_tolerance, 1);
      }
    }
    Iteration record;
    record.lines_moved = !stay;
    {
      const auto running = clock.measure("temperatures");
      const SteadyHeat::Result result =
          heat_.solve({field(), granular_.packing(), granular_.sink(), *lines, bed_volume_, bed_, settings.tendency},
                      gas_, state.contents, temperatures_, tolerance, most_evaluations);
      solids_ = result.solids;
      record.evaluations = result.evaluations;
      record.linear_iterations = result.linear_iterations;
      record.correction = result.correction;
    }
    check_raceways();
    zone = melting_zone();
    record.change =
        change_of(mesh_, field().bed, solids_.contents, temperatures_, {state.gas, state.contents.temperature});
    record.zone_height = can_melt(campaign_) ? zone.melted.height_mean : std::numeric_limits<double>::quiet_NaN();
    outcome.iterations.push_back(record);
    if (foam_.rank() == 0) {
      spdlog::info(
          "iteration {}: change {:.3g} K, {} evaluations with {} linear iterations (last correction {:.2g} K), zone at "
          "{:.3f} m{}",
          iteration + 1, record.change, record.evaluations, record.linear_iterations, record.correction,
          record.zone_height, stay ? ", lines held" : "");
    }
    const double level = level_of(temperatures_);
    const double wanted = held ? std::max(settings.tolerance, settings.held_tolerance * level) : settings.tolerance;
    if (std::max(record.change, record.correction) < wanted) {
      outcome.converged = true;
      break;
    }
    tolerance = std::clamp(inner_over_outer * record.change, least_inner, 20.0);
    lagged.advance(state, {temperatures_.gas, solids_.contents, stay ? state.share : implied_share(zone)});
    if (!stay && only_lines_jump(outcome.iterations, level)) {
      held = true;
      outcome.line_noise = record.change;
      lagged.begin_anew();
    }
  }
  granular_.mark_stagnant();
  look_for_warnings(zone, outcome);
  return outcome;
}

std::vector<double> Predictor::implied_share(const MeltingZone& zone) const {
  std::vector<double> share = granular_.share(can_melt(campaign_) ? zone.ore_temperature : std::vector<double>{});
  for (std::size_t c = 0; c < share.size(); ++c) {
    if (!field().bed[c]) continue;
    const double known = std::min(1.0, solids_.passed[c] / (least_known * mesh_.cell_volume[c]));
    share[c] += known * (solids_.share[c] - share[c]);
  }
  return share;
}

void Predictor::check_raceways() const {
  // What a raceway should remove must reach it on the streamlines.
  for (std::size_t r = 0; r < campaign_.raceways.size(); ++r) {
    double wanted = 0;
    double removed = 0;
    for (const std::int64_t cell : raceway_cells(mesh_, campaign_.raceways[r])) {
      wanted += granular_.sink()[cell] * mesh_.cell_volume[cell];
      removed += solids_.removed[cell];
    }
    if (removed < 0.5 * wanted) {
      throw Failure(
          ExitCode::diverged,
          fmt::format("raceways[{}] should remove {:.3g} m3/s, but only {:.3g} m3/s reach it on paths from the "
                      "stock plane; enlarge its box or refine scene.mesh.cell",
                      r, wanted, removed))
          .at("key", fmt::format("raceways[{}].box", r));
    }
  }
}

void Predictor::look_for_warnings(const MeltingZone& zone, Outcome& outcome) const {
  double volume = 0;
  double reached = 0;
  double unreached = 0;
  double unreached_height = 0;
  for (std::size_t c = 0; c < mesh_.cells(); ++c) {
    if (!field().bed[c]) continue;
    volume += mesh_.cell_volume[c];
    double inflow = 0;
    for (const auto& of_species : solids_.inflow) {
      for (std::size_t side = 0; side < 7; ++side) inflow += of_species[7 * c + side];
    }
    if (inflow > 0) {
      reached += mesh_.cell_volume[c];
    } else {
      unreached += mesh_.cell_volume[c];
      unreached_height += mesh_.cell_volume[c] * mesh_.cell_centre[c][2];
    }
  }
  outcome.reached = volume > 0 ? reached / volume : 0;
  if (outcome.reached < least_reached) {
    outcome.warnings.push_back(fmt::format(
        "No path leads from the stock plane to {:.0f} % of the bed ({:.2g} m3, at {:.2g} m on average): it is taken as "
        "coke at rest. Where it should move, enlarge the raceways' boxes, refine scene.mesh.cell, or lengthen "
        "dem.window; where there is none, let the mesh begin higher.",
        100 * (1 - outcome.reached), unreached, unreached_height / unreached));
  }
  if (!outcome.converged) {
    outcome.warnings.push_back(fmt::format(
        "The prediction did not converge: the temperatures still changed by {:.3g} K in the last of {} iterations. "
        "March instead, or change blast or burden.",
        outcome.iterations.back().change, outcome.iterations.size()));
  }
  if (!can_melt(campaign_)) return;
  const double stock = std::min(campaign_.charging.stock_line, campaign_.top());
  const double unmelted = solids_.rates.of(solids_.rates.mass, Cause::unmelted);
  const double melted = solids_.rates.of(solids_.rates.mass, Cause::melted);
  if (zone.softened.height_max > stock - 2 * campaign_.scene.mesh.cell) {
    outcome.warnings.push_back(
        fmt::format("The cohesive zone reaches the stock line: softening begins {:.2g} m below it. Blow less or cooler "
                    "gas, or charge more burden.",
                    stock - zone.softened.height_max));
  }
  if (unmelted > 0.05 * (unmelted + melted)) {
    outcome.warnings.push_back(
        fmt::format("{:.0f} % of the melting species does not melt before `none_below`: more or hotter blast, or less "
                    "burden, is needed.",
                    100 * unmelted / (unmelted + melted)));
  }
}

MarchOutcome Predictor::march_outcome(const Averages& averages, const Ledger& ledger,
                                      std::chrono::steady_clock::time_point started, const PartClock& clock) const {
  MarchOutcome result{mesh_, field(), averages, ledger};
  result.gas = &gas_;
  result.ranks = foam_.ranks();
  result.cells_at_floor = bed_.cells_at_floor;
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  result.wall_seconds_by_part = clock.seconds();
  return result;
}

Ledger Predictor::ledger() const {
  Ledger ledger;
  ledger.tally = solids_.rates;
  const GasEnergy::Ledger& gas = gas_.energy_ledger();
  ledger.blast = gas.blast;
  ledger.top_gas = gas.top_gas;
  ledger.walls = gas.walls;
  ledger.to_solids = gas.to_solids;
  for (std::size_t s = 0; s < campaign_.species.size(); ++s) {
    for (std::size_t c = 0; c < mesh_.cells(); ++c) {
      const double volume = solids_.contents.volume[s][c];
      if (!(volume > 0)) continue;
      ledger.mass_now += volume * campaign_.species[s].density;
      ledger.energy_now += enthalpy(campaign_.species[s], volume, solids_.contents.temperature[s][c]);
    }
  }
  ledger.mass_begin = ledger.mass_now;
  ledger.energy_begin = ledger.energy_now;
  return ledger;
}

}  // namespace cupola
