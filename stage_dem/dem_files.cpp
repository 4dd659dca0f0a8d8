#include "stage_dem/dem_files.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "physics/mesh/wall_check.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "stage_dem/liggghts_engine.hpp"
#include "stage_dem/packing_check.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/part_timer.hpp"

namespace cupola {
namespace {

constexpr double usual_checkpoint_interval = 300;  // s of wall time

}  // namespace

void DemFiles::make_engine(std::vector<std::uint8_t> snapshot) {
  EngineSetUp set_up;
  set_up.wall_file = (stage_.folder_ / "foam" / "wall.stl").string();
  check_walls(stage_.campaign_, read_stl(set_up.wall_file), set_up.wall_file);
  set_up.folder = stage_.folder_.string();
  set_up.time_step = stage_.step_.step;
  set_up.from = std::move(snapshot);
  stage_.engine_ = make_liggghts_engine(stage_.campaign_, set_up, stage_.communicator_);
}

bool DemFiles::resume() {
  const auto found = CheckpointFiles(stage_.folder_).latest();
  // Work that was lost with its process was paid for as well.
  const auto before = read_progress(stage_.folder_);
  if (before) stage_.state_.wall_before = before->wall_seconds;
  if (!found) {
    if (stage_.rank_ == 0) cut_history(stage_.folder_, -1);
    return false;
  }
  const HdfReader file(found->file);
  const FileHeader header = read_header(file, "checkpoint");
  require_mesh(file, header, stage_.mesh_.hash);
  make_engine(stage_.rank_ == 0 ? file.bytes("Engine/snapshot") : std::vector<std::uint8_t>{});
  const auto state = nlohmann::json::parse(file.text("State"));
  state.at("stage").get_to(stage_.state_);
  if (before) stage_.state_.wall_before = std::max(stage_.state_.wall_before, before->wall_seconds);
  state.at("regrowing").get_to(stage_.regrowing_);
  stage_.builder_.load(state.at("builder"));
  stage_.charging_.load(state.at("charging"));
  stage_.raceways_.load(state.at("raceways"));
  stage_.books_.load(state.at("books"));
  stage_.books_at_window_.load(state.at("books_at_window"));
  stage_.averages_.load(file);
  for (std::size_t s = 0; s < stage_.species_averages_.size(); ++s)
    stage_.species_averages_[s].load(file, stage_.campaign_.species[s].name + "/");
  if (stage_.gas_) stage_.gas_->load(file);
  if (stage_.rank_ == 0) cut_history(stage_.folder_, found->step);
  return true;
}

void DemFiles::load_packing() {
  const auto& input = stage_.task_.inputs.at("packing");
  const FieldFile before(stage_.folder_ / input.file, "dem-result", stage_.mesh_.hash);
  const HdfReader& file = before.hdf();
  const auto id = file.integers("Packing/id");
  const auto rows = static_cast<std::int64_t>(id.size());
  const auto species = file.integers("Packing/species", rows);
  const auto released = file.integers("Packing/released", rows);
  const auto radius = file.doubles("Packing/radius", rows);
  const auto mass = file.doubles("Packing/mass", rows);
  const auto position = file.doubles("Packing/position", rows);
  const auto velocity = file.doubles("Packing/velocity", rows);
  const auto angular_velocity = file.doubles("Packing/angular_velocity", rows);
  std::vector<Parcel> parcels(id.size());
  ChargingState& charging = stage_.charging_.state();
  for (std::size_t i = 0; i < id.size(); ++i) {
    Parcel& parcel = parcels[i];
    parcel.id = id[i];
    parcel.species = static_cast<int>(species[i]);
    parcel.radius = radius[i];
    parcel.mass = mass[i];
    for (std::size_t k = 0; k < 3; ++k) {
      parcel.position[k] = position[3 * i + k];
      parcel.velocity[k] = velocity[3 * i + k];
      parcel.angular_velocity[k] = angular_velocity[3 * i + k];
    }
    if (released[i] == 0) charging.falling.insert(id[i]);
    stage_.state_.next_id = std::max(stage_.state_.next_id, id[i] + 1);
  }
  if (parcels.empty())
    throw Failure(ExitCode::wrong_input, "the packing handed over holds no parcel").at("file", input.file.string());
  check_packing(stage_.campaign_, parcels, input.file.string());
  const auto next_layer = file.integers("Charging/next_layer", 1);
  charging.next_layer = next_layer[0];
  const auto owed = file.doubles("Charging/owed", static_cast<std::int64_t>(charging.owed.size()));
  const auto carried = file.doubles("Charging/carried", static_cast<std::int64_t>(charging.carried.size()));
  for (std::size_t s = 0; s < charging.owed.size(); ++s) {
    const double one = parcel_mass(stage_.campaign_.species[s]);
    charging.owed[s] = std::llround(owed[s] / one);
    charging.carried[s] = carried[s] * one;
  }
  make_engine({});
  stage_.engine_->add(parcels);
  stage_.books_.put_in(parcels, false);
  spdlog::info("packing of {} parcels from {}", parcels.size(), input.file.string());
}

void DemFiles::write_checkpoint() {
  const PartTimer timer(stage_.state_.wall_parts, "checkpoints");
  const auto snapshot = stage_.engine_->snapshot();
  stage_.last_checkpoint_ = std::chrono::steady_clock::now();
  if (stage_.rank_ != 0) return;
  DemState state = stage_.state_;
  state.wall_before = stage_.wall_seconds();
  const nlohmann::json text{{"stage", state},
                            {"regrowing", stage_.regrowing_},
                            {"builder", stage_.builder_.save()},
                            {"charging", stage_.charging_.save()},
                            {"raceways", stage_.raceways_.save()},
                            {"books", stage_.books_.save()},
                            {"books_at_window", stage_.books_at_window_.save()}};
  CheckpointFiles(stage_.folder_).write(stage_.engine_->step(), [&](const std::filesystem::path& path) {
    HdfWriter file(path);
    write_header(file, {"checkpoint", stage_.task_.campaign_hash, stage_.mesh_.hash});
    file.write("Engine/snapshot", snapshot);
    file.write_text("State", text.dump());
    stage_.averages_.save(file);
    for (std::size_t s = 0; s < stage_.species_averages_.size(); ++s)
      stage_.species_averages_[s].save(file, stage_.campaign_.species[s].name + "/");
    if (stage_.gas_) stage_.gas_->save(file);
    file.commit();
  });
}

void DemFiles::write_checkpoint_when_due() {
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - stage_.last_checkpoint_;
  int due = since.count() > checkpoint_interval(usual_checkpoint_interval) ? 1 : 0;
  MPI_Bcast(&due, 1, MPI_INT, 0, stage_.communicator_);
  if (due != 0) write_checkpoint();
}

}  // namespace cupola
