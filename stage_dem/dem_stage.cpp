#include "stage_dem/dem_stage.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "physics/projection/bed_state.hpp"
#include "schemas/files.hpp"
#include "stage_dem/bed_sample.hpp"
#include "stage_dem/bed_surface.hpp"
#include "stage_dem/bed_watch.hpp"
#include "stage_dem/coupled_block.hpp"
#include "stage_dem/dem_files.hpp"
#include "stage_dem/dem_limits.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/part_timer.hpp"
#include "stage_dem/process_time.hpp"
#include "stage_dem/softening.hpp"
#include "stage_dem/stationarity.hpp"

namespace cupola {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

/// Building needs no more than stability: creep and overlap do not matter to a bed that is still falling.
constexpr double building_fraction = 0.2;
/// The bed is at rest below this mean speed, m/s; settling takes between these times, s.
constexpr double rest_speed = 0.01;
constexpr double least_settling = 0.4;
constexpr double most_settling = 1.5;
/// Steps between two growths of a radius.
constexpr long regrowth_steps = 10;
/// Length of a batch of the window's statistics, s: ten batches a window, but none shorter than the bed remembers its
/// velocity, unless that leaves fewer than four.
double batch_seconds(double window) { return std::max(window / 10, std::min(0.25, window / 4)); }

}  // namespace

DemStage::DemStage(const Task& task, const std::filesystem::path& folder, FoamCase& foam, const BedMesh& mesh,
                   MPI_Comm communicator)
    : task_(task),
      campaign_(task.campaign),
      folder_(folder),
      mesh_(mesh),
      bed_(bed_cells(mesh, campaign_)),
      communicator_(communicator),
      rank_(foam.rank()),
      ranks_(foam.ranks()),
      started_(process_start()),
      last_progress_(started_ - std::chrono::hours(1)),
      last_checkpoint_(started_),
      step_(dem_time_step(task.campaign)),
      temperature_(task, folder, mesh),
      solids_(mesh, task.campaign, communicator),
      builder_(task.campaign),
      charging_(task.campaign),
      raceways_(task.campaign),
      books_(task.campaign),
      books_at_window_(task.campaign),
      averages_(mesh.cells(), batch_seconds(task.campaign.dem.window)),
      species_averages_(task.campaign.species.size() > 1 ? task.campaign.species.size() : 0, averages_) {
  gas_ = make_dem_gas(foam, mesh, campaign_, temperature_.gas(), communicator);
}

ExitCode DemStage::run() {
  begin();
  report_progress(true);
  while (state_.phase != DemPhase::done) {
    begin_block();
    advance_block();
    finish_block();
    next_phase();
    report_progress(false);
    if (StopRequest::agreed(communicator_)) {
      DemFiles(*this).write_checkpoint();
      spdlog::info("stopped on request at {:.2f} s of process time; run again to go on", state_.time);
      return ExitCode::stopped;
    }
    DemFiles(*this).write_checkpoint_when_due();
  }
  begin_block();  // the last packing on the mesh, its sample and the gas through it
  if (gas_) gas_->update(solids_, engine_->owned(), 0, true);
  report_progress(true);
  DemFiles(*this).write_result();
  return ExitCode::done;
}

void DemStage::begin() {
  DemFiles files(*this);
  if (files.resume()) {
    parcels_ = gather_parcels(*engine_, communicator_);
    spdlog::info("going on from the checkpoint at step {}", engine_->step());
  } else if (task_.inputs.contains("packing")) {
    files.load_packing();
    parcels_ = gather_parcels(*engine_, communicator_);
    regrowing_ = true;
    enter(DemPhase::regrowing);
  } else {
    files.make_engine({});
    enter(DemPhase::building);
  }
  state_.wall_parts["start-up"] += seconds_since(started_);
}

void DemStage::enter(DemPhase phase) {
  state_.phase = phase;
  state_.phase_time = 0;
  state_.descent.clear();
  if (phase == DemPhase::averaging) books_at_window_ = books_;
  spdlog::info("{} at {:.2f} s of process time, {} parcels", phase_name(phase), state_.time, parcels_.size());
}

void DemStage::begin_block() {
  if (state_.phase == DemPhase::building) return;
  const auto owned = engine_->owned();
  hold_dead_man(owned);
  {
    const PartTimer timer(state_.wall_parts, "projection");
    solids_.divide(owned);
    // A block's motion is sampled where it ended: when the next one begins.
    const bool in_window = state_.phase == DemPhase::averaging && state_.phase_time > 0;
    if (in_window || state_.phase == DemPhase::done) sample();
  }
  if (!gas_ || couples_within_blocks() || state_.phase == DemPhase::done) return;
  {
    const PartTimer timer(state_.wall_parts, "gas");
    gas_->update(solids_, owned, state_.last_block);
  }
  const PartTimer timer(state_.wall_parts, "projection");
  engine_->set_forces(gas_->forces(solids_, owned));
}

void DemStage::hold_dead_man(const std::vector<Parcel>& owned) {
  if (!campaign_.dead_man || state_.phase == DemPhase::settling) return;
  std::vector<bool> held(owned.size());
  for (std::size_t i = 0; i < owned.size(); ++i)
    held[i] = campaign_.dead_man->contains(owned[i].position) &&
              !campaign_.species[static_cast<std::size_t>(owned[i].species)].softening;
  engine_->hold(held);
}

void DemStage::advance_block() {
  const PartTimer timer(state_.wall_parts, "liggghts");
  const double block = campaign_.dem.block;
  double step = step_.step;
  long steps = step_.steps_per_block;
  if (state_.phase == DemPhase::building) {
    steps = static_cast<long>(std::ceil(block / (std::max(building_fraction, step_.fraction()) * step_.reference)));
    step = block / static_cast<double>(steps);
  } else if (state_.phase == DemPhase::regrowing) {
    steps = regrowth_steps;
  }
  engine_->set_time_step(step);
  if (engine_->count() > 0) {
    if (couples_within_blocks() && state_.phase != DemPhase::building) {
      const double gas_seconds = advance_with_gas(*engine_, solids_, *gas_, step, steps);
      state_.wall_parts["gas"] += gas_seconds;
      state_.wall_parts["liggghts"] -= gas_seconds;
    } else {
      engine_->advance(steps);
    }
  }
  state_.last_block = step * static_cast<double>(steps);
  state_.time += state_.last_block;
  state_.phase_time += state_.last_block;
}

void DemStage::finish_block() {
  const PartTimer timer(state_.wall_parts, "between_blocks");
  if (state_.phase != DemPhase::building) shrink_or_regrow();
  parcels_ = gather_parcels(*engine_, communicator_);
  watch();
  if (state_.phase != DemPhase::building) remove_parcels();
  charge();
  engine_->exchange();
}

void DemStage::next_phase() {
  switch (state_.phase) {
    case DemPhase::building:
      if (builder_.done()) enter(DemPhase::settling);
      break;
    case DemPhase::settling:
      if (state_.phase_time > least_settling - same_time &&
          (state_.mean_speed < rest_speed || state_.phase_time > most_settling - same_time)) {
        check_creep(campaign_, state_.creep_speed, engine_->step());
        enter(DemPhase::relaxing);
      }
      break;
    case DemPhase::regrowing:
      if (!regrowing_) enter(DemPhase::relaxing);
      break;
    case DemPhase::relaxing:
      if (relaxed()) {
        state_.relaxed_after = state_.phase_time;
        enter(DemPhase::averaging);
      }
      break;
    case DemPhase::averaging:
      if (window_complete()) enter(DemPhase::done);
      break;
    case DemPhase::done:
      break;
  }
}

bool DemStage::relaxed() const {
  const DemSettings& dem = campaign_.dem;
  if (state_.phase_time < dem.relaxation - same_time) return false;
  if (dem.stop == DemSettings::Stop::duration || state_.phase_time > dem.at_most - dem.window - same_time) return true;
  return std::abs(drift(state_.descent)) < stationary_up_to;
}

bool DemStage::window_complete() const {
  const DemSettings& dem = campaign_.dem;
  // The last block's sample is taken when the next one begins.
  if (state_.phase_time < dem.window - same_time) return false;
  if (dem.stop == DemSettings::Stop::duration) return true;
  if (state_.relaxed_after + state_.phase_time > dem.at_most - same_time) return true;
  if (std::abs(drift(state_.descent)) > stationary_up_to) return false;
  return averages_.relative_error(bed_) < dem.standard_error;
}

void DemStage::sample() {
  const auto samples =
      sample_bed(campaign_, mesh_, solids_, engine_->owned(), charging_.state().falling, state_.last_block);
  averages_.add(sum_of(samples), state_.last_block);
  for (std::size_t s = 0; s < species_averages_.size(); ++s) species_averages_[s].add(samples[s], state_.last_block);
}

double DemStage::temperature_at(const Parcel& parcel) const {
  return temperature_.at(parcel.position, solids_.locator().find(parcel.position));
}

void DemStage::shrink_or_regrow() {
  const auto owned = engine_->owned();
  std::vector<double> radii(owned.size());
  int growing = 0;
  for (std::size_t i = 0; i < owned.size(); ++i) {
    radii[i] = owned[i].radius;
    if (!campaign_.species[static_cast<std::size_t>(owned[i].species)].softening) continue;
    const double temperature = temperature_at(owned[i]);
    radii[i] = state_.phase == DemPhase::regrowing ? regrow(campaign_, owned[i], temperature)
                                                   : soften(campaign_, owned[i], temperature);
    if (radii[i] > owned[i].radius) growing = 1;
  }
  engine_->resize(radii);
  MPI_Allreduce(MPI_IN_PLACE, &growing, 1, MPI_INT, MPI_MAX, communicator_);
  regrowing_ = growing != 0;
}

void DemStage::remove_parcels() {
  std::vector<std::int64_t> gone;
  std::vector<Parcel> staying;
  for (const auto& parcel : parcels_) {
    const Species& species = campaign_.species[static_cast<std::size_t>(parcel.species)];
    if (species.softening && melted(campaign_, parcel, temperature_at(parcel))) {
      books_.take_out_melted(parcel);
      gone.push_back(parcel.id);
    } else if (species.softening && parcel.position[2] < species.none_below) {
      books_.take_out_unmelted(parcel);
      gone.push_back(parcel.id);
    } else {
      staying.push_back(parcel);
    }
  }
  if (moving()) {
    const auto drawn = raceways_.remove(staying, state_.last_block, task_.random_seed, engine_->step(), books_);
    gone.insert(gone.end(), drawn.begin(), drawn.end());
    std::erase_if(
        staying, [&](const Parcel& parcel) { return std::find(drawn.begin(), drawn.end(), parcel.id) != drawn.end(); });
  }
  if (gone.empty()) return;
  engine_->remove(gone);
  parcels_ = std::move(staying);
  if (parcels_.empty())
    throw Failure(ExitCode::diverged, "no parcel is left in the bed: the raceways take more than is charged")
        .at("step", std::to_string(engine_->step()))
        .advise("raceways", "a smaller dem_removal_rate");
}

void DemStage::charge() {
  std::vector<Parcel> added;
  state_.stock_height = bed_surface(campaign_, parcels_);
  if (state_.phase == DemPhase::building) {
    added = builder_.pour(parcels_, temperature_, state_.time, task_.random_seed, state_.next_id);
    charging_.state().next_layer = builder_.next_layer();
    books_.put_in(added, false);
  } else {
    charging_.see_landed(parcels_);
    if (moving()) added = charging_.pour(parcels_, state_.stock_height, state_.time, task_.random_seed, state_.next_id);
    books_.put_in(added, true);
  }
  if (added.empty()) return;
  engine_->add(added);
  parcels_.insert(parcels_.end(), added.begin(), added.end());
}

void DemStage::watch() {
  if (state_.phase == DemPhase::building || state_.last_block <= 0) return;
  const BedMotion motion = bed_motion(parcels_, charging_.state().falling, state_.last_block);
  state_.mean_speed = motion.speed;
  state_.descent.push_back(motion.downwards);
  state_.fast_parcels += motion.fast;
  if (state_.phase == DemPhase::settling) state_.creep_speed = motion.downwards;
  const double overlap = largest_overlap(campaign_, parcels_, communicator_);
  const double wall_overlap = largest_wall_overlap(campaign_, parcels_);
  state_.largest_overlap = std::max(state_.largest_overlap, overlap);
  state_.largest_wall_overlap = std::max(state_.largest_wall_overlap, wall_overlap);
  if (state_.phase != DemPhase::regrowing) check_overlaps(campaign_, overlap, wall_overlap, engine_->step());
  if (rank_ != 0 || state_.phase == DemPhase::regrowing) return;
  nlohmann::json by_species;
  for (const auto& species : campaign_.species) by_species[species.name] = 0;
  for (const auto& parcel : parcels_) {
    auto& number = by_species[campaign_.species[static_cast<std::size_t>(parcel.species)].name];
    number = number.get<std::int64_t>() + 1;
  }
  nlohmann::json line = {{"step", engine_->step()},
                         {"time", state_.time},
                         {"wall_seconds", wall_seconds()},
                         {"phase", phase_name(state_.phase)},
                         {"parcels", parcels_.size()},
                         {"parcels_by_species", by_species},
                         {"stock_height", state_.stock_height},
                         {"mean_speed", state_.mean_speed},
                         {"largest_overlap", overlap}};
  if (state_.phase == DemPhase::averaging) {
    line["window_seconds"] = averages_.seconds();
    if (const double error = averages_.relative_error(bed_); std::isfinite(error)) line["velocity_error"] = error;
  }
  append_history(folder_, line);
}

double DemStage::wall_seconds() const { return state_.wall_before + seconds_since(started_); }

void DemStage::report_progress(bool now) {
  if (rank_ != 0 || (!now && seconds_since(last_progress_) < 1)) return;
  const double wall = wall_seconds();
  Progress progress;
  progress.step = engine_->step();
  progress.process_seconds = state_.time;
  const double ahead = campaign_.dem.relaxation + campaign_.dem.window;
  switch (state_.phase) {
    case DemPhase::relaxing:
      progress.process_seconds_total = state_.time - state_.phase_time + ahead;
      break;
    case DemPhase::averaging:
      progress.process_seconds_total = state_.time - state_.phase_time + campaign_.dem.window;
      break;
    case DemPhase::done:
      progress.process_seconds_total = state_.time;
      break;
    default:
      progress.process_seconds_total = state_.time + ahead;
  }
  progress.process_seconds_total = std::max(progress.process_seconds_total, state_.time);
  progress.wall_seconds = wall;
  progress.rate = wall > progress_wall_ ? (state_.time - progress_time_) / (wall - progress_wall_) : 0;
  progress.phase = phase_name(state_.phase);
  progress.monitored = {{"parcels", static_cast<double>(parcels_.size())},
                        {"stock_height", state_.stock_height},
                        {"mean_speed", state_.mean_speed}};
  write_progress(folder_, progress);
  last_progress_ = Clock::now();
  progress_time_ = state_.time;
  progress_wall_ = wall;
}

}  // namespace cupola
