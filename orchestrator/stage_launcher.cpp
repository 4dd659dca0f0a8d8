#include "orchestrator/stage_launcher.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "orchestrator/launch/job_script.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

constexpr const char* log_name = "stage.log";

/// Cores that mpirun counts as places for ranks: hardware threads of one core count once.
int physical_cores() {
  std::set<std::string> cores;
  for (int thread = 0;; ++thread) {
    std::ifstream siblings(fmt::format("/sys/devices/system/cpu/cpu{}/topology/thread_siblings_list", thread));
    std::string list;
    if (!std::getline(siblings, list)) break;
    cores.insert(list);
  }
  return static_cast<int>(cores.size());
}

}  // namespace

StageLauncher::StageLauncher(std::filesystem::path programs) : programs_(std::move(programs)) {
  for (const TaskKind kind : {TaskKind::dem, TaskKind::tracer})
    if (::access(program(kind).c_str(), X_OK) != 0)
      throw Failure(ExitCode::input_output,
                    fmt::format("{}: not there or not executable. It belongs beside cupola; build it, or see what "
                                "`cupola doctor` says.",
                                program(kind).string()));
}

std::filesystem::path StageLauncher::own_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

std::filesystem::path StageLauncher::program(TaskKind kind) const {
  return programs_ / (kind == TaskKind::dem ? "cupola-dem" : "cupola-tracer");
}

Command StageLauncher::prepare(TaskKind kind, const std::filesystem::path& task_folder) const {
  Command command;
  command.words = {program(kind).string(), "prepare", task_folder.string()};
  command.log = task_folder / log_name;
  command.ends_with_us = true;
  return command;
}

Command StageLauncher::run(TaskKind kind, const std::filesystem::path& task_folder, const Launch& launch) const {
  Command command = mpirun(launch.ranks, {program(kind).string(), task_folder.string()});
  if (launch.slurm && in_allocation_for(launch.ranks)) command.words = words_in_job(kind, task_folder, launch);
  command.log = task_folder / log_name;
  return command;
}

std::vector<std::string> StageLauncher::words_in_job(TaskKind kind, const std::filesystem::path& task_folder,
                                                     const Launch& launch) const {
  return ranks_in_job(launch.slurm.value().starter, launch.ranks, {program(kind).string(), task_folder.string()});
}

bool in_allocation_for(int ranks) {
  const char* job = std::getenv("SLURM_JOB_ID");
  const char* places = std::getenv("SLURM_NTASKS");
  if (job == nullptr) return false;
  return (places != nullptr ? std::atoi(places) : 1) >= ranks;
}

Command mpirun(int ranks, const std::vector<std::string>& program_and_arguments) {
  Command command;
  command.words = {"mpirun", "-n", std::to_string(ranks), "--bind-to", "none"};
  if (ranks > physical_cores() && std::getenv("SLURM_JOB_ID") == nullptr) command.words.emplace_back("--oversubscribe");
  command.words.insert(command.words.end(), program_and_arguments.begin(), program_and_arguments.end());
  // A rank that waits lets others work: where the cores are shared, waiting in a loop would take most of them.
  command.environment.emplace("OMPI_MCA_mpi_yield_when_idle", "1");
  if (::geteuid() == 0) {
    command.environment.emplace("OMPI_ALLOW_RUN_AS_ROOT", "1");
    command.environment.emplace("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  }
  return command;
}

}  // namespace cupola
