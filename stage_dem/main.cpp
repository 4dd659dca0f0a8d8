#include <foamVersion.H>
#include <liggghts/version.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "physics/mesh/prepare.hpp"
#include "physics/stage/program_versions.hpp"
#include "physics/stage/run_stage.hpp"
#include "physics/stage/stage_log.hpp"
#include "schemas/files.hpp"
#include "schemas/version.hpp"
#include "stage_dem/dem_stage.hpp"

namespace {

using namespace cupola;

Task read_dem_task(const std::filesystem::path& folder) {
  Task task = read_task(folder);
  if (task.kind != TaskKind::dem)
    throw Failure(ExitCode::wrong_input,
                  (folder / "task.yaml").string() + ": `kind` is tracer: start cupola-tracer on this folder")
        .at("key", "kind")
        .at("file", (folder / "task.yaml").string());
  return task;
}

ExitCode prepare_task(const std::filesystem::path& folder, std::optional<int> ranks) {
  Task task = read_dem_task(folder);
  task.campaign.launch.ranks = ranks.value_or(task.campaign.launch.ranks);
  prepare(folder, task);
  return ExitCode::done;
}

ExitCode run_task(const std::filesystem::path& folder, int argc, char** argv) {
  const Task task = read_dem_task(folder);
  if (has_manifest(folder)) return ExitCode::done;  // finished by an earlier start
  FoamCase foam(folder / "foam", argc, argv);
  const auto stage = [&] {
    std::optional<FolderLock> lock;
    if (foam.rank() == 0) lock.emplace(folder);
    // The log is another's while the folder is.
    MPI_Barrier(MPI_COMM_WORLD);
    open_stage_log(folder, foam.rank());
    spdlog::info("cupola-dem {}, {} ranks, task of campaign {}, episode {}", program_version, foam.ranks(),
                 task.campaign.name, task.episode);
    const BedMesh mesh = BedMesh::read(folder / "foam" / "mesh.hdf");
    return DemStage(task, folder, foam, mesh, MPI_COMM_WORLD).run();
  };
  return static_cast<ExitCode>(run_stage(folder, stage));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "cupola-dem: seconds of coarse-grained CFD-DEM of a moving bed, to its averaged granular field "
      "(docs/contracts.md)");
  app.set_version_flag("--version", std::string("cupola-dem ") + program_version);
  const std::map<std::string, std::string> libraries{
      {"OpenFOAM", std::to_string(Foam::foamVersion::api) + "." + Foam::foamVersion::patch},
      {"LIGGGHTS", LAMMPS_VERSION}};
  app.add_flag_callback(
      "--versions",
      [&] {
        std::cout << versions_text(libraries) << "\n";
        throw CLI::Success();
      },
      "Print the versions of the program and its libraries as JSON");
  std::filesystem::path folder;
  app.add_option("TASK", folder, "task folder");
  auto* prepare_command = app.add_subcommand("prepare", "write the task's OpenFOAM case and walls (one process)");
  std::filesystem::path folder_to_prepare;
  prepare_command->add_option("TASK", folder_to_prepare, "task folder")->required();
  std::optional<int> ranks;
  prepare_command->add_option("--ranks", ranks, "for another number of ranks than the task's")
      ->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  if (*prepare_command) return run_stage(folder_to_prepare, [&] { return prepare_task(folder_to_prepare, ranks); });
  if (folder.empty()) {
    std::cerr << app.help();
    return static_cast<int>(ExitCode::wrong_input);
  }
  return run_stage(folder, [&] { return run_task(folder, argc, argv); });
}
