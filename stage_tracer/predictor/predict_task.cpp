#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>

#include "schemas/files.hpp"
#include "stage_tracer/predictor/correction.hpp"
#include "stage_tracer/predictor/first_guess.hpp"
#include "stage_tracer/predictor/predictor.hpp"
#include "stage_tracer/previous_temperature.hpp"

namespace cupola {
namespace {

/// rms of the temperatures' error over rms(T - 293 K), the largest that was measured against marches
/// (docs/predictor.md).
constexpr double error_without_dem = 0.10;
constexpr double error_with_dem = 0.065;

nlohmann::json as_json(const Predictor::Outcome& outcome, bool with_dem) {
  nlohmann::json iterations = nlohmann::json::array();
  for (const Predictor::Iteration& one : outcome.iterations) {
    iterations.push_back(
        {{"change", one.change},
         {"correction", one.correction},
         {"evaluations", one.evaluations},
         {"linear_iterations", one.linear_iterations},
         {"lines_moved", one.lines_moved},
         {"zone_height", std::isfinite(one.zone_height) ? nlohmann::json(one.zone_height) : nlohmann::json(nullptr)}});
  }
  return {{"converged", outcome.converged},
          {"with_dem", with_dem},
          {"expected_error", with_dem ? error_with_dem : error_without_dem},
          {"reached", outcome.reached},
          {"line_noise", outcome.line_noise},
          {"warnings", outcome.warnings},
          {"zone_iterations", iterations}};
}

}  // namespace

ExitCode predict(FoamCase& foam, const std::filesystem::path& folder, const Task& task) {
  const auto started = std::chrono::steady_clock::now();
  PartClock clock;
  const Campaign& campaign = task.campaign;
  if (!campaign.heat || !campaign.scene.gas) {
    throw Failure(ExitCode::wrong_input, "a prediction needs heat and gas; this campaign lacks one of them");
  }
  const BedMesh mesh = BedMesh::read(folder / "foam" / "mesh.hdf");
  const PreviousTemperature previous = read_previous_temperature(folder, task, mesh);
  std::optional<DemResult> dem;
  if (const auto input = task.inputs.find("granular"); input != task.inputs.end())
    dem = read_dem_result(folder / input->second.file, mesh, campaign);
  Predictor predictor(foam, mesh, campaign, dem ? &*dem : nullptr, previous.ore);
  BedTemperatures guess;
  if (!previous.by_species.empty()) {
    // The gas begins where its hottest partner is: it is solved for at once.
    guess = {previous.by_species.front(), previous.by_species};
  } else {
    guess = guess_from_plan(mesh, campaign, predictor.field().charge);
  }
  const Predictor::Outcome outcome = predictor.solve(std::move(guess), {}, clock);
  for (const std::string& warning : outcome.warnings) {
    if (foam.rank() == 0) spdlog::warn("{}", warning);
  }
  if (foam.rank() != 0) return ExitCode::done;

  Averages averages(campaign.species.size(), mesh.cells(), true);
  CellContents contents = spread(predictor.contents(), predictor.kernel());
  if (const auto input = task.inputs.find("correction"); input != task.inputs.end()) {
    const MarchBias bias = read_march_bias(folder / input->second.file, mesh, campaign);
    contents.temperature = corrected(campaign, contents, bias);
  }
  averages.add(contents, campaign, 1.0);
  const Ledger ledger = predictor.ledger();
  MarchOutcome result = predictor.march_outcome(averages, ledger, started, clock);
  for (const auto& [part, seconds] : result.wall_seconds_by_part) spdlog::info("{}: {:.3g} s", part, seconds);
  result.prediction = as_json(outcome, dem.has_value());
  result.more_cell_data[predicted_share_name] = predictor.share();
  write_result(folder, task, result);
  write_manifest(folder);
  spdlog::info("done: {} after {} iterations, {:.3g} s; energy residual {:.2g}, streamlines reach {:.1f} % of the bed",
               outcome.converged ? "converged" : "not converged", outcome.iterations.size(), result.wall_seconds,
               ledger.energy_residual(), 100 * outcome.reached);
  return ExitCode::done;
}

}  // namespace cupola
