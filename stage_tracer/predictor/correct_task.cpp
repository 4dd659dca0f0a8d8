#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "stage_tracer/predictor/correction.hpp"
#include "stage_tracer/predictor/measured_march.hpp"
#include "stage_tracer/predictor/predictor.hpp"
#include "stage_tracer/previous_temperature.hpp"

namespace cupola {
namespace {

/// Tendencies are small differences of noisy means: they are smoothed over some parcels before they are believed.
constexpr int tendency_smoothing = 4;
constexpr int bias_smoothing = 2;
/// Of the solids of a cell that a species must be for its bias to count there.
constexpr double least_share = 0.02;

std::filesystem::path input_file(const std::filesystem::path& folder, const Task& task, const std::string& name) {
  const auto input = task.inputs.find(name);
  if (input == task.inputs.end())
    throw Failure(ExitCode::wrong_input,
                  "task.yaml: inputs." + name + " is missing; a correction needs granular, prediction and march");
  return folder / input->second.file;
}

/// Where a bias of each species can be measured: the volume that both know, m3.
BySpecies common_volume(const CellContents& a, const CellContents& b) {
  BySpecies volume = a.volume;
  for (std::size_t c = 0; c < volume.front().size(); ++c) {
    double all = 0;
    for (std::size_t s = 0; s < volume.size(); ++s) all += std::min(a.volume[s][c], b.volume[s][c]);
    for (std::size_t s = 0; s < volume.size(); ++s) {
      const double both = std::min(a.volume[s][c], b.volume[s][c]);
      volume[s][c] = both > least_share * all ? both : 0;
    }
  }
  return volume;
}

BySpecies difference(const BySpecies& volume, const BySpecies& a, const BySpecies& b) {
  BySpecies result = a;
  for (std::size_t s = 0; s < a.size(); ++s) {
    for (std::size_t c = 0; c < a[s].size(); ++c) result[s][c] = volume[s][c] > 0 ? a[s][c] - b[s][c] : 0;
  }
  return result;
}

/// One steady solution and what is needed of it.
struct Solution {
  Predictor::Outcome outcome;
  CellContents contents;  ///< spread
};

Solution solve(Predictor& predictor, const BedTemperatures& guess, const std::vector<double>& share,
               const BySpecies* tendency, PartClock& clock) {
  Predictor::Settings settings;
  settings.share = &share;
  settings.tendency = tendency;
  Solution solution{predictor.solve(guess, settings, clock), {}};
  solution.contents = spread(predictor.contents(), predictor.kernel());
  return solution;
}

}  // namespace

ExitCode correct(FoamCase& foam, const std::filesystem::path& folder, const Task& task) {
  const auto started = std::chrono::steady_clock::now();
  PartClock clock;
  const Campaign& campaign = task.campaign;
  const BedMesh mesh = BedMesh::read(folder / "foam" / "mesh.hdf");
  const DemResult dem = read_dem_result(input_file(folder, task, "granular"), mesh, campaign);
  const PreviousTemperature previous = read_previous_temperature(folder, task, mesh);
  const FieldFile prediction(input_file(folder, task, "prediction"), "tracer-result", mesh.hash);
  const FieldFile march(input_file(folder, task, "march"), "tracer-result", mesh.hash);
  const std::vector<double> share = prediction.cell_data(predicted_share_name);

  Predictor predictor(foam, mesh, campaign, &dem, previous.ore);
  const CellSpreading& kernel = predictor.kernel();
  const std::vector<MarchWindows::Window> windows =
      MarchWindows::read(march.hdf(), campaign.species.size(), mesh.cells());
  const MeasuredMarch measured = measure_march(windows, kernel, tendency_smoothing);

  // The steady solution that changes as the march did, and the one that does not: their difference is how far the march
  // still had to go, and the march's distance from the first is what the solution leaves out.
  const BedTemperatures guess{prediction.cell_data("gas_temperature"), previous.by_species};
  const Solution changing = solve(predictor, guess, share, &measured.tendency, clock);
  const bool sound = changing.outcome.converged;
  const Solution steady = solve(predictor, sound ? predictor.temperatures() : guess, share, nullptr, clock);
  const Solution& compared = sound ? changing : steady;
  if (foam.rank() != 0) return ExitCode::done;
  if (!sound)
    spdlog::warn(
        "the steady solution with the march's tendency did not converge: what the march had still to go is "
        "left out of the correction");

  MarchBias bias;
  const BySpecies common = common_volume(measured.mean, compared.contents);
  bias.species = smoothed(common, difference(common, measured.mean.temperature, compared.contents.temperature), kernel,
                          bias_smoothing);

  CellContents contents = steady.contents;
  contents.temperature = corrected(campaign, contents, bias);
  Averages averages(campaign.species.size(), mesh.cells(), true);
  averages.add(contents, campaign, 1.0);

  const std::vector<bool>& rest = predictor.field().stagnant;
  const auto norm = [&](const BySpecies& a, const BySpecies& b) {
    return temperature_norm(campaign, common, rest, a, b);
  };
  const TemperatureNorm apart = norm(measured.mean.temperature, previous.by_species);
  const TemperatureNorm to_go = norm(steady.contents.temperature, compared.contents.temperature);
  const TemperatureNorm left_out = norm(measured.mean.temperature, compared.contents.temperature);
  /// rms of a field of differences over the level.
  const auto size = [&](const BySpecies& field) {
    BySpecies away = measured.mean.temperature;
    for (std::size_t s = 0; s < away.size(); ++s)
      std::transform(away[s].begin(), away[s].end(), field[s].begin(), away[s].begin(), std::minus<>());
    return norm(measured.mean.temperature, away).relative();
  };
  const double noise = size(measured.error);
  constexpr double hour = 3600;
  const double tendency = hour * size(measured.tendency);

  const Ledger ledger = predictor.ledger();
  MarchOutcome result = predictor.march_outcome(averages, ledger, started, clock);
  // The zone stays where the march has it: below the last ore its temperature is a continuation, of which differences
  // mean nothing.
  if (can_melt(campaign))
    result.ore_temperature =
        find_melting_zone(mesh, campaign, predictor.field(), measured.mean.volume, measured.mean.temperature)
            .ore_temperature;
  result.more_cell_data[predicted_share_name] = share;
  for (std::size_t s = 0; s < campaign.species.size(); ++s)
    result.more_cell_data[march_bias_name + campaign.species[s].name] = bias.species[s];
  result.correction = {{"extrapolated", sound},
                       {"converged", steady.outcome.converged},
                       {"windows", measured.windows},
                       {"measured_seconds", measured.seconds},
                       {"level", apart.level},
                       {"from_prediction", apart.relative()},
                       {"from_prediction_mean", apart.mean},
                       {"tendency", tendency},
                       {"to_go", to_go.relative()},
                       {"bias", left_out.relative()},
                       {"bias_mean", left_out.mean},
                       {"noise", noise}};
  write_result(folder, task, result);
  write_manifest(folder);
  spdlog::info(
      "done: tracers left alone for {:.4g} s went {:.2g} % from the prediction, had {:.2g} % to go, and are "
      "{:.2g} % from the steady solution; noise {:.2g} %",
      measured.seconds, 100 * apart.relative(), 100 * to_go.relative(), 100 * left_out.relative(), 100 * noise);
  return ExitCode::done;
}

}  // namespace cupola
