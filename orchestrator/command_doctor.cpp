#include <fmt/format.h>
#include <unistd.h>

#include <functional>
#include <string>

#include "orchestrator/child_process.hpp"
#include "orchestrator/commands.hpp"
#include "orchestrator/embedded_files.hpp"
#include "orchestrator/result_check.hpp"
#include "orchestrator/signal_watch.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "orchestrator/stage_task.hpp"
#include "schemas/campaign_reader.hpp"
#include "schemas/files.hpp"
#include "schemas/version.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

/// A folder for the trial, removed in the end.
class TrialFolder {
 public:
  TrialFolder() : path_(fs::temp_directory_path() / fmt::format("cupola-doctor-{}", ::getpid())) {
    fs::create_directories(path_);
  }
  ~TrialFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;
  TrialFolder(TrialFolder&&) = delete;
  TrialFolder& operator=(TrialFolder&&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Runs a command to its end. @return its output; @throws Failure where its status is not 0
std::string output_of(Command command, SignalWatch& signals, const fs::path& log) {
  fs::remove(log);
  command.log = log;
  command.ends_with_us = true;
  ChildProcess process(command, signals.former_mask());
  process.release();
  while (!process.poll()) {
    signals.wait(std::chrono::milliseconds(200));
    if (signals.stop_requests() > 0) throw Failure(ExitCode::stopped, "stopped on request");
  }
  std::string output = fs::exists(log) ? read_text(log) : "";
  if (*process.poll() != 0)
    throw Failure(ExitCode::input_output, fmt::format("status {}: {}", *process.poll(), output));
  return output;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// The smallest DEM stage, prepared and run on two ranks.
std::string trial_run(const fs::path& folder, SignalWatch& signals) {
  ReadCampaign read = read_campaign_text(smoke_campaign(), "smoke_campaign.yaml");
  if (!read.ok()) throw Failure(ExitCode::wrong_input, to_text(read.errors));
  const StageLauncher launcher(StageLauncher::own_folder());
  const fs::path task = folder / "task";
  const std::string campaign_hash = hash_text(smoke_campaign());
  ensure_task(task, stage_task(TaskKind::dem, 1, read.campaign, campaign_hash, {}, task));
  output_of(launcher.prepare(TaskKind::dem, task), signals, folder / "prepare.log");
  output_of(launcher.run(TaskKind::dem, task, read.campaign.launch), signals, folder / "run.log");
  check_result(task, TaskKind::dem, read.campaign, campaign_hash);
  const auto progress = read_progress(task);
  return fmt::format("{} steps on {} ranks, result checked", progress ? progress->step : 0, read.campaign.launch.ranks);
}

}  // namespace

ExitCode doctor() {
  SignalWatch signals;
  const TrialFolder trial;
  const fs::path programs = StageLauncher::own_folder();
  bool well = true;
  const auto check = [&](const std::string& name, const std::function<std::string()>& look, const std::string& cure) {
    try {
      fmt::print("ok      {}: {}\n", name, look());
    } catch (const Failure& failure) {
      if (failure.code() == ExitCode::stopped) throw;
      well = false;
      fmt::print("missing {}: {}\n        {}\n", name, failure.what(), cure);
    }
    std::fflush(stdout);
  };
  const auto answer = [&](const std::vector<std::string>& words) {
    Command command;
    command.words = words;
    return first_line(output_of(command, signals, trial.path() / "answer.log"));
  };
  fmt::print("cupola {}\n", program_version);
  for (const char* stage : {"cupola-dem", "cupola-tracer"})
    check(
        stage,
        [&] {
          return answer({(programs / stage).string(), "--version"});
        },
        "Build it; it belongs beside cupola. If a library is named above, install it (packages.txt).");
  check(
      "mpirun",
      [&] {
        return answer({"mpirun", "--version"});
      },
      "Install openmpi-bin.");
  for (const char* tool : {"blockMesh", "checkMesh", "decomposePar"})
    check(
        tool,
        [&] {
          return answer({"sh", "-c", std::string("command -v ") + tool});
        },
        "Install openfoam.");
  check(
      "two-rank run", [&] { return trial_run(trial.path(), signals); },
      "Look at what the programs said above; try `mpirun -n 2 hostname`.");
  return well ? ExitCode::done : ExitCode::input_output;
}

}  // namespace cupola
