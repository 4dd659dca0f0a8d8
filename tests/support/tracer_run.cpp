#include "tests/support/tracer_run.hpp"

#include <sys/wait.h>

#include <chrono>
#include <cstdlib>

#include "tests/support/settled_bed.hpp"

namespace cupola::testing {
namespace {

int run(const std::string& command) {
  const int raw = std::system((command + " > /dev/null 2>&1").c_str());
  return WIFEXITED(raw) ? WEXITSTATUS(raw) : 128;
}

}  // namespace

TracerRun::TracerRun(const std::string& program, const Campaign& campaign) {
  Task task;
  task.kind = TaskKind::tracer;
  task.campaign = campaign;
  task.campaign.launch.ranks = 1;
  task.campaign_hash = hash_text(campaign.name);
  task.program_version = "test";
  write_task(folder_.path(), task);
  const auto begin = std::chrono::steady_clock::now();
  status_ = run(program + " prepare " + folder_.path().string());
  if (status_ == 0) {
    write_settled_bed(folder_.path() / "granular.hdf", BedMesh::read(folder_.path() / "foam" / "mesh.hdf"), task, 100);
    task.inputs["granular"] = {"granular.hdf", hash_file(folder_.path() / "granular.hdf")};
    write_task(folder_.path(), task);
    status_ = run(program + " " + folder_.path().string());
  }
  wall_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::string TracerRun::sentence() const {
  const auto failure = read_failure(folder_.path());
  return failure ? failure->value("sentence", std::string()) : std::string();
}

}  // namespace cupola::testing
