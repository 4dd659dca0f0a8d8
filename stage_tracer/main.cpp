#include <foamVersion.H>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "physics/mesh/foam_case.hpp"
#include "physics/mesh/prepare.hpp"
#include "physics/stage/program_versions.hpp"
#include "physics/stage/run_stage.hpp"
#include "physics/stage/stage_log.hpp"
#include "physics/stage/stop_request.hpp"
#include "schemas/files.hpp"
#include "schemas/task.hpp"
#include "schemas/version.hpp"
#include "stage_tracer/predictor/predictor.hpp"
#include "stage_tracer/tracer_stage.hpp"

namespace {

using cupola::ExitCode;

cupola::Task read_tracer_task(const std::filesystem::path& folder) {
  cupola::Task task = cupola::read_task(folder);
  if (task.kind == cupola::TaskKind::dem) {
    throw cupola::Failure(ExitCode::wrong_input,
                          (folder / "task.yaml").string() + ": `kind` is dem: start cupola-dem on this folder");
  }
  return task;
}

int prepare(const std::filesystem::path& folder, std::optional<int> ranks) {
  return cupola::run_stage(folder, [&] {
    cupola::Task task = read_tracer_task(folder);
    task.campaign.launch.ranks = ranks.value_or(task.campaign.launch.ranks);
    cupola::prepare(folder, task);
    return ExitCode::done;
  });
}

int march(const std::filesystem::path& folder, int& argc, char**& argv) {
  return cupola::run_stage(folder, [&] {
    const cupola::Task task = read_tracer_task(folder);
    const cupola::StopRequest stop;
    cupola::FoamCase foam(folder / "foam", argc, argv);
    return static_cast<ExitCode>(cupola::run_stage(folder, [&] {
      std::optional<cupola::FolderLock> lock;
      if (foam.rank() == 0) lock.emplace(folder);
      cupola::open_stage_log(folder, foam.rank());
      if (task.kind == cupola::TaskKind::predict) return cupola::predict(foam, folder, task);
      if (task.kind == cupola::TaskKind::correct) return cupola::correct(foam, folder, task);
      return cupola::TracerStage(foam, folder, task).run();
    }));
  });
}

}  // namespace

/// cupola-tracer TASK: marches a tracer task; cupola-tracer prepare TASK: makes its mesh and OpenFOAM case.
int main(int argc, char** argv) {
  CLI::App app{"Tracer stage of Cupola: heat and motion of the bed over hours of process time"};
  std::filesystem::path folder;
  app.set_version_flag("--version", std::string("cupola-tracer ") + cupola::program_version);
  app.add_flag_callback(
      "--versions",
      [] {
        std::cout << cupola::versions_text(
                         {{"OpenFOAM", std::to_string(Foam::foamVersion::api) + "." + Foam::foamVersion::patch}})
                  << "\n";
        throw CLI::Success();
      },
      "Print the versions of the program and its libraries as JSON");
  CLI::App* preparing = app.add_subcommand("prepare", "make mesh and OpenFOAM case of a task folder");
  preparing->add_option("TASK", folder, "task folder")->required();
  std::optional<int> ranks;
  preparing->add_option("--ranks", ranks, "for another number of ranks than the task's")->check(CLI::PositiveNumber);
  app.add_option("TASK", folder, "task folder");
  CLI11_PARSE(app, argc, argv);
  if (preparing->parsed()) return prepare(folder, ranks);
  if (folder.empty()) return app.exit(CLI::CallForHelp());
  return march(folder, argc, argv);
}
