#include <mpi.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "stage_tracer/tracer_stage.hpp"

/// What the steps cost in accuracy, and when the march is there.
namespace cupola {
namespace {

constexpr int windows_in_a_row = 2;  // that must agree before a march is ended
constexpr const char* trial_file = "trial.hdf";

}  // namespace

void TracerStage::save_trial() const {
  const std::vector<double> rows = gather_to_first(to_rows(tracers_));
  if (foam_.rank() == 0) {
    HdfWriter file(folder_ / trial_file);
    write_state(file, rows);
    file.commit();
  }
  MPI_Barrier(MPI_COMM_WORLD);
}

double TracerStage::compare_steps() {
  const auto running = clock_.measure("error estimate");
  const auto parts = clock_.seconds();
  const Tally tally = local_tally_;
  const std::int64_t held_back = held_back_;
  const auto undo = [&] {
    read_state(HdfReader(folder_ / trial_file));
    local_tally_ = tally;
    held_back_ = held_back;
  };
  save_trial();
  advance(2 * steps_.length);
  const TracerTemperatures one_step(tracers_);
  undo();
  advance(steps_.length);
  ++step_;
  advance(steps_.length);
  const double difference = temperature_difference(one_step, tracers_, campaign_, sum_);
  const double memory = std::min(heat_.relaxation_time(contents_, steps_.length), campaign_.tracer.longest());
  undo();
  error_memory_ = memory;
  clock_.restore(parts);
  MPI_Barrier(MPI_COMM_WORLD);
  if (foam_.rank() == 0) std::filesystem::remove(folder_ / trial_file);
  return difference;
}

void TracerStage::estimate_error() {
  if (step_ + 2 > steps_.count) return;
  const double duration = campaign_.tracer.longest();
  step_error_ = {compare_steps(), steps_.length};
  const double error = step_error_.after(duration, error_memory_);
  if (foam_.rank() == 0) {
    spdlog::info("after {} steps, of {:.4g} s: one step of twice the length differs by {:.2g}, estimated error {:.2g}",
                 step_, steps_.length, step_error_.pair, error);
  }
}

void TracerStage::end_window() {
  // Windows end where the march ends.
  const auto windows_left = [&](double time) {
    return std::ceil((campaign_.tracer.longest() - time) / window() - 1e-6);
  };
  const bool last = step_ >= steps_.count;
  if (!last && windows_left(now_ - steps_.length) == windows_left(now_)) return;
  const auto running = clock_.measure("averages");
  windows_->add(averages_);
  if (!last) averages_.clear();
}

bool TracerStage::is_steady() {
  if (campaign_.tracer.stop != TracerSettings::Stop::steady) return false;
  // Windows end where the longest march would end.
  const auto windows_left = [&](double time) {
    return std::floor((campaign_.tracer.longest() - time) / window() + 1e-9);
  };
  if (windows_left(now_ - steps_.length) == windows_left(now_) || step_ == steps_.count) return false;
  if (averages_.seconds() < 0.9 * window()) {  // the first window is cut short
    averages_.clear();
    return false;
  }
  const auto running = clock_.measure("averages");
  auto [capacity, temperature] = averages_.solids(campaign_);
  for (std::size_t c = 0; c < capacity.size(); ++c) {
    if (field_.stagnant[c]) capacity[c] = 0;
  }
  steady_.add(capacity, temperature);
  if (steady_.below(campaign_.tracer.remaining_change) >= windows_in_a_row) return true;
  averages_.clear();
  return false;
}

}  // namespace cupola
