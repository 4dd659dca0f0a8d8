#include "bench/tracer_task.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/campaign_reader.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "schemas/version.hpp"
#include "tests/support/settled_bed.hpp"

namespace cupola::bench {
namespace {

constexpr double speed_up = 100;  // of the generated field over the descent rate

void refine(MeshSettings& mesh, double factor) {
  const auto scaled = [&](int count) { return std::max(1, static_cast<int>(std::lround(count * factor))); };
  mesh.cell /= factor;
  if (!mesh.cells) return;
  mesh.cells->half_width = scaled(mesh.cells->half_width);
  mesh.cells->depth = scaled(mesh.cells->depth);
  for (int& count : mesh.cells->heights) count = scaled(count);
}

Campaign campaign_of(const TracerBench& bench) {
  Campaign campaign = load_campaign(bench.campaign);
  refine(campaign.scene.mesh, bench.cell_factor);
  campaign.launch.ranks = bench.ranks;
  TracerSettings& tracer = campaign.tracer;
  tracer.duration = bench.seconds;
  tracer.stop = TracerSettings::Stop::duration;
  tracer.tracers_per_cell = bench.tracers_per_cell;
  if (bench.reference) {
    tracer.time_step = reference_step;
    tracer.resolve = TracerSettings::Resolve::every_step;
  }
  if (bench.time_step > 0) tracer.time_step = bench.time_step;
  return campaign;
}

}  // namespace

void make_tracer_task(const std::filesystem::path& folder, const TracerBench& bench,
                      const std::filesystem::path& tracer) {
  if (std::filesystem::exists(folder / "granular.hdf")) return;
  std::filesystem::create_directories(folder);
  Task task;
  task.kind = TaskKind::tracer;
  task.campaign = campaign_of(bench);
  task.campaign_hash = hash_text(task.campaign.name);
  task.program_version = program_version;
  write_task(folder, task);
  const std::string command =
      fmt::format("{} prepare {} > {}", tracer.string(), folder.string(), (folder / "prepare.log").string());
  if (std::system(command.c_str()) != 0) {
    throw Failure(ExitCode::wrong_input,
                  fmt::format("`{}` failed; see {}", command, (folder / "prepare.log").string()));
  }
  const auto unfinished = folder / "granular.hdf.new";
  testing::write_settled_bed(unfinished, BedMesh::read(folder / "foam" / "mesh.hdf"), task, speed_up);
  task.inputs["granular"] = {"granular.hdf", hash_file(unfinished)};
  std::filesystem::rename(unfinished, folder / "granular.hdf");
  write_task(folder, task);
}

}  // namespace cupola::bench
