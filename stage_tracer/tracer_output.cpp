#include <mpi.h>

#include <algorithm>
#include <cmath>

#include "schemas/files.hpp"
#include "stage_tracer/gas_comparison.hpp"
#include "stage_tracer/tracer_stage.hpp"

/// What the march tells while it runs and when it is done.

namespace cupola {
namespace {

constexpr long most_history_lines = 200;
constexpr double usual_checkpoint_interval = 60;  // s of wall time
constexpr double seconds_between_progress = 1;

/// Largest over mean of a figure of each rank.
double imbalance(double mine, const SumOverRanks& sum) {
  std::vector<double> total = {mine, 1.0};
  sum(total);
  double largest = mine;
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return total[0] > 0 ? largest * total[1] / total[0] : 1;
}

}  // namespace

void TracerStage::write_output(bool checkpoint_now, bool last) {
  const double wall = wall_seconds();
  // Rank 0's clock decides for all.
  int due = wall - last_checkpoint_ > checkpoint_interval(usual_checkpoint_interval) ? 1 : 0;
  MPI_Bcast(&due, 1, MPI_INT, 0, MPI_COMM_WORLD);
  const long interval =
      std::max(1L, steps_.count / most_history_lines + (steps_.count % most_history_lines != 0 ? 1 : 0));
  // Before the checkpoint of the same step, which counts on this line.
  if (step_ % interval == 0 || last) {
    const auto running = clock_.measure("output");
    const nlohmann::json line = history_line();  // every rank does its share of it
    if (foam_.rank() == 0) append_history(folder_, line);
  }
  if (due != 0 || checkpoint_now) {
    write_checkpoint();
    last_checkpoint_ = wall_seconds();
  }
  const auto running = clock_.measure("output");
  if (foam_.rank() != 0) return;
  const bool first = last_progress_ == 0;
  if (wall - last_progress_ < seconds_between_progress && !first && !last && !checkpoint_now) return;
  Progress progress;
  progress.step = step_;
  progress.process_seconds = now_;
  progress.process_seconds_total = campaign_.tracer.longest();
  progress.wall_seconds = wall;
  progress.rate = (progress.process_seconds - last_progress_time_) / std::max(wall - last_progress_, 1e-6);
  progress.phase = "marching";
  progress.monitored["tracers"] = static_cast<double>(all_tracers_);
  if (campaign_.heat) progress.monitored["mean_solid_temperature"] = mean_temperature(contents_, campaign_);
  write_progress(folder_, progress);
  last_progress_ = wall;
  last_progress_time_ = progress.process_seconds;
}

nlohmann::json TracerStage::history_line() const {
  nlohmann::json line = {{"step", step_}, {"time", now_}, {"tracers", all_tracers_}, {"wall_seconds", wall_seconds()}};
  if (!campaign_.heat) return line;
  // `contents_` are means over the step.
  const CellContents contents = sum_tracers(tracers_, campaign_.species.size(), mesh_.cells(), true, sum_);
  if (step_error_.seconds > 0) line["time_step_error"] = step_error_.after(now_, steps_.length);
  line["mean_solid_temperature"] = mean_temperature(contents, campaign_);
  if (gas_) {
    line["top_gas_temperature"] = gas_->energy_ledger().top_gas_temperature;
    line["gas_energy_residual"] = gas_->energy_ledger().residual;
  }
  if (can_melt(campaign_)) {
    const CellContents around = spread(contents, kernel_);
    const double height =
        find_melting_zone(mesh_, campaign_, field_, around.volume, around.temperature).melted.height_mean;
    line["cohesive_zone_height"] = std::isfinite(height) ? nlohmann::json(height) : nlohmann::json(nullptr);
  }
  return line;
}

MarchOutcome TracerStage::outcome() {
  MarchOutcome result{mesh_, field_, averages_, ledger_};
  result.gas = gas_.get();
  result.tracer_rows = gather_to_first(to_rows(tracers_));
  for (std::size_t r = 0; r < result.tracer_rows.size(); r += tracer_columns) {
    const auto row = result.tracer_rows.begin() + static_cast<std::ptrdiff_t>(r);
    result.tracer_position.push_back(paths_.position({static_cast<std::int64_t>(row[2]), {row[3], row[4], row[5]}}));
  }
  result.tracers = all_tracers_;
  result.ranks = foam_.ranks();
  result.steps = step_;
  result.time_step = steps_.length;
  result.process_seconds = now_;
  if (campaign_.heat) result.step_error = step_error_.after(now_, steps_.length);
  result.until_steady = campaign_.tracer.stop == TracerSettings::Stop::steady;
  result.remaining = steady_.remaining();
  result.windows = steady_.windows();
  if (windows_) result.measured = &*windows_;
  if (campaign_.tracer.displacement != TracerSettings::Displacement::none) {
    std::vector<double> held = {static_cast<double>(held_back_)};
    sum_(held);
    result.held_back = static_cast<std::int64_t>(held[0]);
  }
  result.wall_seconds = wall_seconds();
  result.wall_seconds_by_part = clock_.seconds();
  result.motion_imbalance = imbalance(clock_.seconds().at("motion"), sum_);
  result.cells_at_floor = cells_at_floor_;
  result.largest_biot = heat_.largest_biot();
  if (gas_ && campaign_.tracer.compare_gas_models)
    result.gas_comparison = compare_gas_models(foam_, mesh_, campaign_, bed_, gas_->temperature());
  return result;
}

double TracerStage::wall_seconds() const {
  return wall_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

}  // namespace cupola
