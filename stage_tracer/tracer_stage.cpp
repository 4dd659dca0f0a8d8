#include "stage_tracer/tracer_stage.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/stage/stop_request.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "stage_tracer/displacement.hpp"
#include "stage_tracer/gas_comparison.hpp"
#include "stage_tracer/seeding.hpp"

namespace cupola {
namespace {

constexpr long most_history_lines = 400;
constexpr double seconds_between_checkpoints = 60;
constexpr double seconds_between_progress = 1;

std::filesystem::path granular_result(const std::filesystem::path& folder, const Task& task) {
  const auto input = task.inputs.find("granular");
  if (input == task.inputs.end()) {
    throw Failure(ExitCode::wrong_input,
                  "task.yaml: inputs.granular is missing; a tracer task needs the DEM result of its episode");
  }
  return folder / input->second.file;
}

/// Volume of the recipe that has passed the stock plane when the stage begins: what the DEM stage has charged, less
/// what of it still lies above the plane.
double charged_position(const Campaign& campaign, const DemResult& dem) {
  double position = 0;
  for (std::size_t layer = 0; layer < dem.next_layer; ++layer) {
    for (const auto& [name, mass] : campaign.charging.layers[layer])
      position += mass / campaign.species[campaign.species_index(name)].density;
  }
  for (std::size_t s = 0; s < dem.owed.size(); ++s) position -= dem.owed[s] / campaign.species[s].density;
  for (std::size_t p = 0; p < dem.packing.id.size(); ++p) {
    if (dem.packing.position[p][2] >= campaign.charging.stock_line) {
      position -= dem.packing.mass[p] / campaign.species[dem.packing.species[p]].density;
    }
  }
  return position;
}

std::unique_ptr<const ChargePlan> make_charge(const Campaign& campaign, const GranularField& field,
                                              const DemResult& dem) {
  double rate = 0;
  for (const double of_species : field.charge.volume_rate) rate += of_species;
  if (!(rate > 0)) return nullptr;
  return std::make_unique<const ChargePlan>(campaign, rate, charged_position(campaign, dem));
}

/// Diameter of the parcels that a tracer's volume is spread over: mean by the recipe's volume, or of all species.
double kernel_diameter(const Campaign& campaign, const Charge& charge) {
  double diameter = 0;
  double share = 0;
  for (std::size_t s = 0; s < campaign.species.size(); ++s) {
    diameter += charge.volume_share[s] * campaign.species[s].parcel_diameter();
    share += charge.volume_share[s];
  }
  return share > 0 ? diameter / share : campaign.species.front().parcel_diameter();
}

}  // namespace

TracerStage::TracerStage(FoamCase& foam, std::filesystem::path folder, const Task& task)
    : foam_(foam),
      folder_(std::move(folder)),
      task_(task),
      campaign_(task.campaign),
      checkpoints_(folder_),
      mesh_(BedMesh::read(folder_ / "foam" / "mesh.hdf")),
      locator_(mesh_),
      dem_(read_dem_result(granular_result(folder_, task), mesh_, campaign_)),
      previous_(read_previous_temperature(folder_, task, mesh_)),
      field_(make_granular_field(foam, mesh_, campaign_, dem_, previous_.ore)),
      paths_(mesh_, field_.face_flux, field_.storage),
      split_(tracers_per_parcel(campaign_, locator_, field_.bed, dem_.packing)),
      charge_(make_charge(campaign_, field_, dem_)),
      steps_(choose_time_steps(mesh_, campaign_, field_, paths_, charge_.get())),
      kernel_(mesh_, field_.bed, kernel_diameter(campaign_, field_.charge)),
      conduction_(mesh_, campaign_, field_.bed, field_.charge.layer_thickness, field_.charge.volume_share),
      motion_(campaign_, field_, paths_),
      sum_(sum_over_world()),
      empty_share_(share_of_persistent(campaign_, field_.charge)),
      averages_(campaign_.species.size(), mesh_.cells(), campaign_.heat.has_value()),
      heat_(campaign_, kernel_, conduction_) {
  if (campaign_.scene.gas && campaign_.tracer.gas != TracerSettings::GasModel::none) {
    gas_ = std::make_unique<GasModel>(foam_, mesh_, campaign_);
  }
  if (charge_) {
    std::vector<double> tracer_volume;
    for (const Species& species : campaign_.species) {
      tracer_volume.push_back(std::numbers::pi / 6 * std::pow(species.parcel_diameter(), 3) / split_);
    }
    const std::int64_t first_id = (dem_.packing.id.back() + 1) * tracer_ids_per_parcel;
    insertion_ = std::make_unique<Insertion>(mesh_, field_.stock_faces, *charge_, std::move(tracer_volume),
                                             task_.random_seed, first_id);
  }
}

ExitCode TracerStage::run() {
  const auto found = checkpoints_.latest();
  if (found) {
    resume(found->file);
  } else {
    begin();
  }
  while (step_ < steps_.count) {
    step();
    const bool stop = StopRequest::agreed(MPI_COMM_WORLD) && step_ < steps_.count;
    write_output(stop);
    if (stop) return ExitCode::stopped;
  }
  const MarchOutcome result = outcome();
  if (foam_.rank() == 0) {
    write_result(folder_, task_, result);
    write_manifest(folder_);
    spdlog::info(
        "done: {:.6g} s of process time in {:.3g} s of wall time, {} tracers; mass residual {:.2g}, energy residual "
        "{:.2g}",
        result.process_seconds, result.wall_seconds, result.tracers, ledger_.mass_residual(),
        ledger_.energy_residual());
  }
  return ExitCode::done;
}

void TracerStage::step() {
  const double begin = time(static_cast<double>(step_));
  const double middle = time(static_cast<double>(step_) + 0.5);
  const double end = time(static_cast<double>(step_ + 1));
  move(begin, middle);
  compose();
  if (campaign_.tracer.displacement == TracerSettings::Displacement::random) {
    std::vector<double> packed(mesh_.cells(), 0.0);
    for (const auto& volume : contents_.volume) {
      for (std::size_t c = 0; c < packed.size(); ++c) packed[c] += volume[c];
    }
    displace(tracers_, campaign_.tracer, locator_, paths_, field_.bed,
             volume_excess(mesh_, field_.bed, packed, field_.solids_fraction), steps_.length, task_.random_seed, step_);
    compose();
  }
  if (gas_) {
    const auto running = clock_.measure("flow");
    gas_->follow(bed_);
  }
  if (campaign_.heat) exchange_heat();
  average();
  if (campaign_.heat) remove_molten(tracers_, campaign_, local_tally_);
  move(middle, end);
  ++step_;
  close_balances();
}

void TracerStage::move(double from, double to) {
  const auto running = clock_.measure("motion");
  std::vector<Entry> entries = insertion_ ? insertion_->advance(from, to) : std::vector<Entry>{};
  std::erase_if(entries, [&](const Entry& entry) { return entry.id % foam_.ranks() != foam_.rank(); });
  motion_.advance(tracers_, from, to, entries, task_.random_seed, local_tally_);
}

void TracerStage::compose() {
  const auto running = clock_.measure("composition");
  contents_ = sum_tracers(tracers_, campaign_.species.size(), mesh_.cells(), campaign_.heat.has_value(), sum_);
  bed_volume_ = bed_composition(mesh_, campaign_, field_, spread(contents_, kernel_), empty_share_);
  bed_ = bed_state(mesh_, campaign_, bed_volume_);
  cells_at_floor_ = std::max(cells_at_floor_, bed_.cells_at_floor);
}

void TracerStage::exchange_heat() {
  const auto running = clock_.measure("heat");
  ledger_.walls += heat_.advance(tracers_, contents_, bed_volume_, bed_, gas_.get(), steps_.length);
  if (!gas_) return;
  const GasEnergy::Ledger& gas = gas_->energy_ledger();
  ledger_.blast += gas.blast * steps_.length;
  ledger_.top_gas += gas.top_gas * steps_.length;
  ledger_.walls += gas.walls * steps_.length;
  ledger_.to_solids += gas.to_solids * steps_.length;
}

void TracerStage::average() {
  const double window = charge_ ? charge_->cycle_seconds() : 0.1 * campaign_.tracer.duration;
  const double middle = time(static_cast<double>(step_) + 0.5);
  if (middle < campaign_.tracer.duration - window && step_ + 1 < steps_.count) return;
  const auto running = clock_.measure("averages");
  averages_.add(spread(contents_, kernel_), campaign_, steps_.length);
}

void TracerStage::close_balances() {
  std::vector<double> row = local_tally_.row();
  double mass = 0;
  double energy = 0;
  for (std::size_t i = 0; i < tracers_.size(); ++i) {
    const Species& species = campaign_.species[tracers_.species[i]];
    mass += tracers_.volume[i] * species.density;
    if (campaign_.heat) energy += enthalpy(species, tracers_.volume[i], tracers_.temperature[i]);
  }
  row.insert(row.end(), {mass, energy, static_cast<double>(tracers_.size())});
  sum_(row);
  all_tracers_ = static_cast<std::size_t>(row.back());
  ledger_.mass_now = row[Tally::columns];
  ledger_.energy_now = row[Tally::columns + 1];
  ledger_.tally += Tally::from_row(row);
  local_tally_ = Tally{};
  if (all_tracers_ == 0) {
    throw Failure(ExitCode::diverged, "no tracer is left in the bed; check raceways and melting against the charge")
        .at("step", std::to_string(step_));
  }
}

void TracerStage::begin() {
  if (foam_.rank() == 0) cut_history(folder_, -1);
  tracers_ = seed_tracers(campaign_, locator_, paths_, field_.bed, dem_.packing, split_, task_.random_seed,
                          foam_.rank(), foam_.ranks());
  if (campaign_.heat) set_temperatures(tracers_, previous_, campaign_, paths_);
  compose();
  if (gas_) begin_gas();
  close_balances();
  ledger_.mass_begin = ledger_.mass_now;
  ledger_.energy_begin = ledger_.energy_now;
  if (previous_.energy) ledger_.handover = ledger_.energy_begin - *previous_.energy;
  if (foam_.rank() == 0) {
    spdlog::info("{} tracers ({} a parcel) in {} cells of the bed; {} steps of {:.4g} s; field scaled by {:.4g}",
                 all_tracers_, split_, std::count(field_.bed.begin(), field_.bed.end(), true), steps_.count,
                 steps_.length, field_.scale);
  }
}

void TracerStage::begin_gas() {
  const auto running = clock_.measure("first gas solution");
  std::vector<double> guess(mesh_.cells(), campaign_.charging.temperature);
  if (!campaign_.heat) {
    guess.assign(mesh_.cells(), campaign_.scene.gas->inlets.front().total_temperature);
    gas_->begin(bed_, std::move(guess));
    return;
  }
  const CellContents around = spread(contents_, kernel_);
  for (std::size_t c = 0; c < guess.size(); ++c) {
    double volume = 0;
    double sum = 0;
    for (std::size_t s = 0; s < around.volume.size(); ++s) {
      volume += around.volume[s][c];
      sum += around.volume[s][c] * around.temperature[s][c];
    }
    if (volume > 0) guess[c] = sum / volume;
  }
  gas_->begin(bed_, std::move(guess));
  // Flow, gas energy and the stagnant solids in turns, until they agree within a kelvin.
  const bool settle = charge_ && std::count(field_.stagnant.begin(), field_.stagnant.end(), true) > 0;
  constexpr int most_turns = 20;
  for (int turn = 0; turn < most_turns; ++turn) {
    const std::vector<double> before = gas_->temperature();
    gas_->solve_energy(bed_, heat_.solids_at_rest(contents_, bed_, *gas_));
    if (settle) {
      heat_.settle_stagnant(tracers_, contents_, bed_volume_, field_.stagnant, bed_, *gas_);
      compose();
    }
    gas_->solve_flow_tightly(bed_);
    double change = 0;
    for (std::size_t c = 0; c < before.size(); ++c)
      change = std::max(change, std::abs(gas_->temperature()[c] - before[c]));
    if (change < 1) break;
  }
}

void TracerStage::resume(const std::filesystem::path& checkpoint) {
  const HdfReader file(checkpoint);
  require_mesh(file, read_header(file, "checkpoint"), mesh_.hash);
  step_ = static_cast<long>(file.integers("March/step", 1)[0]);
  wall_before_ = file.doubles("March/wall_seconds", 1)[0];
  clock_.restore(nlohmann::json::parse(file.text("March/wall_seconds_by_part")).get<std::map<std::string, double>>());
  cells_at_floor_ = file.integers("March/cells_at_floor", 1)[0];
  ledger_ = Ledger::from_row(file.doubles("March/ledger"));
  averages_.restore(file.doubles("March/averages"));
  tracers_ = from_rows(file.doubles("March/tracers"), campaign_.heat.has_value(), foam_.rank(), foam_.ranks());
  if (insertion_) insertion_->restore(file.doubles("Insertion/owed"), file.integers("Insertion/next_id", 1)[0]);
  if (gas_) gas_->restore(file);
  if (foam_.rank() == 0) {
    cut_history(folder_, step_);
    spdlog::info("going on from step {} of {}", step_, steps_.count);
  }
}

void TracerStage::write_checkpoint() {
  const auto running = clock_.measure("output");
  const std::vector<double> rows = gather_to_first(to_rows(tracers_));
  if (foam_.rank() != 0) return;
  checkpoints_.write(step_, [&](const std::filesystem::path& path) {
    HdfWriter file(path);
    write_header(file, {"checkpoint", task_.campaign_hash, mesh_.hash});
    file.write("March/step", std::vector<std::int64_t>{step_});
    file.write("March/wall_seconds", std::vector<double>{wall_seconds()});
    file.write_text("March/wall_seconds_by_part", nlohmann::json(clock_.seconds()).dump());
    file.write("March/cells_at_floor", std::vector<std::int64_t>{cells_at_floor_});
    file.write("March/ledger", ledger_.row());
    file.write("March/averages", averages_.row());
    file.write("March/tracers", rows, tracer_columns);
    if (insertion_) {
      file.write("Insertion/owed", insertion_->owed());
      file.write("Insertion/next_id", std::vector<std::int64_t>{insertion_->next_id()});
    }
    if (gas_) gas_->save(file);
    file.commit();
  });
}

void TracerStage::write_output(bool checkpoint_now) {
  const double wall = wall_seconds();
  // Rank 0's clock decides for all.
  int due = wall - last_checkpoint_ > seconds_between_checkpoints ? 1 : 0;
  MPI_Bcast(&due, 1, MPI_INT, 0, MPI_COMM_WORLD);
  if (due != 0 || checkpoint_now) {
    write_checkpoint();
    last_checkpoint_ = wall_seconds();
  }
  if (foam_.rank() != 0) return;
  const auto running = clock_.measure("output");
  const bool last = step_ == steps_.count;
  const long interval =
      std::max(1L, steps_.count / most_history_lines + (steps_.count % most_history_lines != 0 ? 1 : 0));
  if (step_ % interval == 0 || last) append_history(folder_, history_line());
  const bool first = last_progress_ == 0;
  if (wall - last_progress_ < seconds_between_progress && !first && !last && !checkpoint_now) return;
  Progress progress;
  progress.step = step_;
  progress.process_seconds = time(static_cast<double>(step_));
  progress.process_seconds_total = campaign_.tracer.duration;
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
  nlohmann::json line = {{"step", step_}, {"time", time(static_cast<double>(step_))}, {"tracers", all_tracers_}};
  if (!campaign_.heat) return line;
  line["mean_solid_temperature"] = mean_temperature(contents_, campaign_);
  if (gas_) line["top_gas_temperature"] = gas_->energy_ledger().top_gas_temperature;
  if (can_melt(campaign_)) {
    const CellContents around = spread(contents_, kernel_);
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
  result.steps = steps_.count;
  result.time_step = steps_.length;
  result.process_seconds = campaign_.tracer.duration;
  result.wall_seconds = wall_seconds();
  result.wall_seconds_by_part = clock_.seconds();
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
