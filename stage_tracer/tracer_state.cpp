#include <spdlog/spdlog.h>

#include <algorithm>

#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "stage_tracer/tracer_stage.hpp"

/// The state of the march in files.
namespace cupola {

void TracerStage::resume(const std::filesystem::path& checkpoint) {
  const HdfReader file(checkpoint);
  require_mesh(file, read_header(file, "checkpoint"), mesh_.hash);
  wall_before_ = std::max(wall_before_, file.doubles("March/wall_seconds", 1)[0]);
  clock_.restore(nlohmann::json::parse(file.text("March/wall_seconds_by_part")).get<std::map<std::string, double>>());
  read_state(file);
  // A retry may ask for shorter steps than the checkpoint's: what remains is filled anew.
  constexpr double round_off = 1e-9;
  if (campaign_.tracer.time_step && steps_.length > *campaign_.tracer.time_step * (1 + round_off)) {
    const TimeSteps rest = fill_with_steps(campaign_.tracer.longest() - now_, *campaign_.tracer.time_step);
    steps_ = {step_ + rest.count, rest.length};
    trial_.reset();  // it was of other steps
  }
  if (foam_.rank() == 0) {
    cut_history(folder_, step_);
    spdlog::info("going on from step {} of {}", step_, steps_.count);
  }
}

void TracerStage::read_state(const HdfReader& file) {
  const std::vector<std::int64_t> steps = file.integers("March/step", 3);
  step_ = static_cast<long>(steps[0]);
  next_trial_ = static_cast<long>(steps[2]);
  const std::vector<double> times = file.doubles("March/times", 3);
  now_ = times[0];
  steps_ = {static_cast<long>(steps[1]), times[1]};
  early_difference_ = times[2];
  step_error_ = StepError::from_row(file.doubles("March/step_error", 5));
  trial_.reset();
  if (const std::vector<double> row = file.doubles("March/trial"); !row.empty()) trial_ = StepTrial::from_row(row);
  cells_at_floor_ = file.integers("March/cells_at_floor", 1)[0];
  held_back_ = foam_.rank() == 0 ? file.integers("March/held_back", 1)[0] : 0;
  ledger_ = Ledger::from_row(file.doubles("March/ledger"));
  averages_.restore(file.doubles("March/averages"));
  steady_.restore(file.doubles("March/steady"));
  if (windows_) windows_->restore(file.doubles("March/windows"));
  tracers_ = from_rows(file.doubles("March/tracers"), campaign_.heat.has_value(), foam_.rank(), foam_.ranks());
  if (insertion_) insertion_->restore({file.doubles("Insertion/owed"), file.integers("Insertion/entered")});
  if (gas_) gas_->restore(file);
}

void TracerStage::write_state(HdfWriter& file, const std::vector<double>& all_tracer_rows) const {
  file.write("March/step", std::vector<std::int64_t>{step_, steps_.count, next_trial_});
  file.write("March/times", std::vector<double>{now_, steps_.length, early_difference_});
  file.write("March/step_error", step_error_.row());
  file.write("March/trial", trial_ ? trial_->row() : std::vector<double>{});
  file.write("March/cells_at_floor", std::vector<std::int64_t>{cells_at_floor_});
  file.write("March/held_back", std::vector<std::int64_t>{held_back_});
  file.write("March/ledger", ledger_.row());
  file.write("March/averages", averages_.row());
  file.write("March/steady", steady_.row());
  if (windows_) file.write("March/windows", windows_->row());
  file.write("March/tracers", all_tracer_rows, tracer_columns);
  if (insertion_) {
    file.write("Insertion/owed", insertion_->state().owed);
    file.write("Insertion/entered", insertion_->state().entered);
  }
  if (gas_) gas_->save(file);
}

void TracerStage::write_checkpoint() {
  const auto running = clock_.measure("output");
  const std::vector<double> rows = gather_to_first(to_rows(tracers_));
  std::vector<double> held = {static_cast<double>(held_back_)};
  sum_(held);
  held_back_ = foam_.rank() == 0 ? static_cast<std::int64_t>(held[0]) : 0;
  if (foam_.rank() != 0) return;
  checkpoints_.write(step_, [&](const std::filesystem::path& path) {
    HdfWriter file(path);
    write_header(file, {"checkpoint", task_.campaign_hash, mesh_.hash});
    file.write("March/wall_seconds", std::vector<double>{wall_seconds()});
    file.write_text("March/wall_seconds_by_part", nlohmann::json(clock_.seconds()).dump());
    write_state(file, rows);
    file.commit();
  });
}

}  // namespace cupola
