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
#include "stage_tracer/predictor/predicted_field.hpp"
#include "stage_tracer/seeding.hpp"

namespace cupola {
namespace {

std::filesystem::path granular_result(const std::filesystem::path& folder, const Task& task) {
  const auto input = task.inputs.find("granular");
  if (input == task.inputs.end()) {
    throw Failure(ExitCode::wrong_input,
                  "task.yaml: inputs.granular is missing; a tracer task needs the DEM result of its episode");
  }
  return folder / input->second.file;
}

/// The field of the DEM result; where the march begins with a prediction, the one that was predicted on.
GranularField granular_field(FoamCase& foam, const BedMesh& mesh, const std::filesystem::path& folder, const Task& task,
                             const DemResult& dem, const std::vector<double>& dem_temperature) {
  const auto prediction = task.inputs.find("prediction");
  if (prediction == task.inputs.end()) return make_granular_field(foam, mesh, task.campaign, dem, dem_temperature);
  PredictedField predicted(foam, mesh, task.campaign, &dem, dem_temperature);
  predicted.follow(
      FieldFile(folder / prediction->second.file, "tracer-result", mesh.hash).cell_data(predicted_share_name));
  predicted.mark_stagnant();
  return predicted.field();
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

std::unique_ptr<const ChargePlan> make_charge(const Campaign& campaign, const BedMesh& mesh, const GranularField& field,
                                              const DemResult& dem) {
  double rate = 0;
  for (const double of_species : field.charge.volume_rate) rate += of_species;
  if (!(rate > 0)) return nullptr;
  std::vector<ChargePlan::Place> places;
  for (const StockFace& face : field.stock_faces) {
    places.push_back({std::abs(mesh.face_centre[static_cast<std::size_t>(face.face)][0]), face.volume_rate});
  }
  return std::make_unique<const ChargePlan>(campaign, rate, charged_position(campaign, dem), places);
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
      field_(granular_field(foam, mesh_, folder_, task, dem_, previous_.ore)),
      paths_(mesh_, field_.face_flux, field_.storage),
      split_(tracers_per_parcel(campaign_, locator_, field_.bed, dem_.packing)),
      charge_(make_charge(campaign_, mesh_, field_, dem_)),
      limits_(step_limits(mesh_, campaign_, field_, paths_, charge_.get())),
      kernel_(mesh_, field_.bed, kernel_diameter(campaign_, field_.charge), share_cells(mesh_.cells())),
      conduction_(mesh_, campaign_, field_.bed, field_.charge.layer_thickness, field_.charge.volume_share),
      motion_(campaign_, field_, paths_),
      sum_(sum_over_world()),
      empty_share_(share_of_persistent(campaign_, field_.charge)),
      displaced_(displaced_cells(mesh_, campaign_, field_.bed, previous_.ore)),
      steps_(fill_with_steps(campaign_.tracer.longest(), campaign_.tracer.time_step.value_or(limits_.first))),
      averages_(campaign_.species.size(), mesh_.cells(), campaign_.heat.has_value()),
      heat_(campaign_, kernel_, conduction_, sum_, clock_) {
  if (campaign_.scene.gas && campaign_.tracer.gas != TracerSettings::GasModel::none) {
    gas_ = std::make_unique<GasModel>(foam_, mesh_, campaign_);
  }
  if (task.inputs.contains("prediction")) windows_.emplace(campaign_.species.size(), mesh_.cells());
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
  // Work that was lost with its process was paid for as well.
  if (const auto before = read_progress(folder_)) wall_before_ = before->wall_seconds;
  const auto found = checkpoints_.latest();
  if (found) {
    resume(found->file);
  } else {
    clock_.add("start-up", wall_seconds());
    begin();
  }
  last_checkpoint_ = wall_seconds();
  bool done = step_ >= steps_.count;
  while (!done) {
    begin_trial();
    step();
    if (windows_) end_window();
    done = step_ >= steps_.count || is_steady();
    // After the windows, which count with the length of the step just made.
    judge_trial();
    const bool stop = StopRequest::agreed(MPI_COMM_WORLD) && !done;
    write_output(stop, done);
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

void TracerStage::begin() {
  if (foam_.rank() == 0) cut_history(folder_, -1);
  tracers_ = seed_tracers(campaign_, locator_, paths_, field_.bed, dem_.packing, split_, task_.random_seed,
                          foam_.rank(), foam_.ranks());
  if (campaign_.heat) set_temperatures(tracers_, previous_, campaign_, paths_);
  compose(Stays(tracers_, 1));
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
  constexpr double settling_tolerance = 1e-3;  // of the flow, while the temperatures still change
  constexpr int settling_iterations = 5;
  for (int turn = 0; turn < most_turns; ++turn) {
    const std::vector<double> before = gas_->temperature();
    gas_->solve_energy(bed_, heat_.solids_at_rest(contents_, bed_, *gas_));
    if (settle) {
      heat_.settle_stagnant(tracers_, contents_, bed_volume_, field_.stagnant, bed_, *gas_);
      compose(Stays(tracers_, 1));
    }
    if (campaign_.tracer.resolve == TracerSettings::Resolve::every_step) {
      // The gas temperature keeps what a loose solution leaves to chance, and the bed remembers it for minutes.
      gas_->solve_flow_tightly(bed_);
    } else {
      gas_->improve_flow(bed_, gas_->temperature(), settling_tolerance, settling_iterations);
    }
    double change = 0;
    for (std::size_t c = 0; c < before.size(); ++c)
      change = std::max(change, std::abs(gas_->temperature()[c] - before[c]));
    if (change < 1) break;
  }
  gas_->solve_flow_tightly(bed_);
}

}  // namespace cupola
