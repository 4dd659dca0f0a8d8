#include "tests/support/tracer_program.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "schemas/files.hpp"
#include "tests/support/settled_bed.hpp"

namespace cupola::testing {
namespace {

constexpr double speed_up = 100;  // of the generated DEM result

int status_of(int raw) { return WIFEXITED(raw) ? WEXITSTATUS(raw) : 128; }

}  // namespace

TracerProgram::TracerProgram(const Campaign& campaign, int ranks) : ranks_(ranks) {
  task_.campaign = campaign;
  prepare();
  write_settled_bed(path() / "granular.hdf", mesh_, task_, speed_up);
  task_.inputs["granular"] = {"granular.hdf", hash_file(path() / "granular.hdf")};
  write_task(path(), task_);
}

TracerProgram::TracerProgram(const Campaign& campaign, const MakeBed& make_bed, int ranks) : ranks_(ranks) {
  task_.campaign = campaign;
  prepare();
  set_bed(make_bed(mesh_, campaign));
}

void TracerProgram::prepare() {
  task_.kind = TaskKind::tracer;
  task_.campaign.launch.ranks = ranks_;
  task_.campaign_hash = hash_text(task_.campaign.name);
  task_.program_version = "test";
  write_task(path(), task_);
  const std::string command = std::string(CUPOLA_TRACER) + " prepare " + path().string() + " > /dev/null";
  if (status_of(std::system(command.c_str())) != 0) throw std::runtime_error("prepare failed: " + failure());
  mesh_ = BedMesh::read(path() / "foam" / "mesh.hdf");
}

void TracerProgram::set_bed(const StatedBed& bed) {
  write_stated_bed(path() / "granular.hdf", mesh_, task_, bed);
  task_.inputs["granular"] = {"granular.hdf", hash_file(path() / "granular.hdf")};
  write_task(path(), task_);
}

pid_t TracerProgram::start() const {
  const pid_t child = fork();
  if (child != 0) return child;
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);  // as `cupola run` starts it
  const std::string count = std::to_string(ranks_);
  const std::string folder = path().string();
  if (ranks_ == 1) {
    execl(CUPOLA_TRACER, CUPOLA_TRACER, folder.c_str(), nullptr);
  } else {
    execlp(CUPOLA_MPIEXEC, CUPOLA_MPIEXEC, "--oversubscribe", "--bind-to", "none", "-n", count.c_str(), CUPOLA_TRACER,
           folder.c_str(), nullptr);
  }
  _exit(127);
}

int TracerProgram::wait(pid_t child) {
  int raw = 0;
  waitpid(child, &raw, 0);
  return status_of(raw);
}

void TracerProgram::drop_march() {
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(path())) {
    const std::string name = entry.path().filename();
    if (name != "foam" && name != "granular.hdf" && name != "before.hdf" && name != "task.yaml") {
      old.push_back(entry.path());
    }
  }
  for (const auto& file : old) std::filesystem::remove_all(file);
}

void TracerProgram::march_anew(const Campaign& campaign) {
  drop_march();
  task_.campaign = campaign;
  task_.campaign.launch.ranks = ranks_;
  write_task(path(), task_);
}

void TracerProgram::march_anew(const Campaign& campaign, const StatedBed& bed) {
  march_anew(campaign);
  set_bed(bed);
}

void TracerProgram::begin_from(const std::filesystem::path& file) {
  const std::filesystem::path copy = path() / "before.hdf";
  std::filesystem::copy_file(file, copy, std::filesystem::copy_options::overwrite_existing);
  task_.inputs["solids_temperature"] = {"before.hdf", hash_file(copy)};
  write_task(path(), task_);
}

void TracerProgram::take_granular(const std::filesystem::path& file) {
  const std::filesystem::path copy = path() / "granular.hdf";
  std::filesystem::copy_file(file, copy, std::filesystem::copy_options::overwrite_existing);
  task_.inputs["granular"] = {"granular.hdf", hash_file(copy)};
  write_task(path(), task_);
}

void TracerProgram::change_ranks(int ranks) {
  ranks_ = ranks;
  prepare();
}

FinalTracers TracerProgram::tracers() const {
  const FieldFile file = result();
  const auto id = file.hdf().integers("Tracers/id");
  const auto species = file.hdf().integers("Tracers/species");
  const auto position = file.hdf().doubles("Tracers/position");
  const auto volume = file.hdf().doubles("Tracers/volume");
  const bool heat = file.hdf().has("Tracers/temperature");
  const auto temperature = heat ? file.hdf().doubles("Tracers/temperature") : std::vector<double>{};
  std::vector<std::size_t> order(id.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
  FinalTracers sorted;
  for (const std::size_t i : order) {
    sorted.id.push_back(id[i]);
    sorted.species.push_back(species[i]);
    sorted.position.push_back({position[3 * i], position[3 * i + 1], position[3 * i + 2]});
    sorted.volume.push_back(volume[i]);
    if (heat) sorted.temperature.push_back(temperature[i]);
  }
  return sorted;
}

std::string TracerProgram::failure() const {
  const auto found = read_failure(path());
  return found ? found->dump() : "";
}

}  // namespace cupola::testing
