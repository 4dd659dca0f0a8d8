// Cost and error of the tracer stage at full size.
//   bench_tracer [--json FILE]                 default settings on one and two ranks, against the reference
//   bench_tracer reference [--step S] [--out FILE]   makes the reference; goes on where it was interrupted
//   bench_tracer prepare FOLDER …              one task, to be run by hand
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <numeric>

#include "bench/reduced_field.hpp"
#include "bench/tracer_task.hpp"
#include "schemas/campaign_reader.hpp"
#include "schemas/failure.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"

namespace cupola::bench {
namespace {

using Json = nlohmann::json;

const std::filesystem::path source = CUPOLA_SOURCE_DIR;
const std::filesystem::path reference_file = source / "bench" / "reference" / "slot_paper.json";

/// Runs a task that has been made, on from where it was stopped; returns its summary.
Json march(const std::filesystem::path& folder, int ranks) {
  if (!std::filesystem::exists(folder / "result.hdf")) {
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    const std::string command = fmt::format("{} --oversubscribe --bind-to none -n {} {} {} > {} 2>&1", CUPOLA_MPIEXEC,
                                            ranks, CUPOLA_TRACER, folder.string(), (folder / "run.log").string());
    if (std::system(command.c_str()) != 0) throw Failure(ExitCode::wrong_input, fmt::format("`{}` failed", command));
  }
  return FieldFile(folder / "result.hdf", "tracer-result").summary();
}

/// Rows of the table, as tools/run_benchmarks.sh collects them.
class Rows {
 public:
  Rows(std::string setting, const Json& summary) : setting_(std::move(setting)), summary_(summary) {}

  void add(const std::string& metric, double value, const std::string& unit) {
    list_.push_back({{"bench", "tracer"},
                     {"setting", setting_},
                     {"metric", metric},
                     {"value", value},
                     {"unit", unit},
                     {"ranks", summary_["ranks"]},
                     {"cells", summary_["cells"]},
                     {"parcels", summary_["tracers"]}});
    fmt::print("{:<10} {} rank(s) {:<44} {:>12.5g} {}\n", setting_, summary_["ranks"].get<int>(), metric, value, unit);
  }
  [[nodiscard]] const std::vector<Json>& list() const { return list_; }

 private:
  std::string setting_;
  const Json& summary_;
  std::vector<Json> list_;
};

/// Seconds spent in steps, without what is done once a stage.
double marching_seconds(const Json& summary) {
  double sum = 0;
  for (const auto& [part, seconds] : summary["wall_seconds_by_part"].items()) {
    if (part != "start-up" && part != "first gas solution") sum += seconds.get<double>();
  }
  return sum;
}

std::vector<Json> rows_of(const std::string& setting, const Json& summary, const std::filesystem::path& result,
                          const Campaign& campaign) {
  Rows rows(setting, summary);
  const double steps = summary["steps"];
  const double tracers = summary["tracers"];
  const double ranks = summary["ranks"];
  const double marching = marching_seconds(summary);
  rows.add("process_seconds_per_wall_second", summary["process_seconds"].get<double>() / marching, "1");
  rows.add("seconds_to_start", summary["wall_seconds"].get<double>() - marching, "s");
  rows.add("time_step", summary["time_step"], "s");
  const Json& parts = summary["wall_seconds_by_part"];
  double of_tracers = 0;
  for (const char* part : {"motion", "exchange"}) of_tracers += parts.value(part, 0.0);
  rows.add("ns_per_tracer_step", 1e9 * of_tracers * ranks / steps / tracers, "ns");
  for (const auto& [part, seconds] : parts.items())
    rows.add("milliseconds_a_step: " + part, 1e3 * seconds.get<double>() / steps, "ms");
  if (summary.contains("imbalance")) rows.add("imbalance", summary["imbalance"]["motion"], "1");
  if (summary.contains("accuracy")) rows.add("estimated_step_error", summary["accuracy"]["time_step_error"], "1");
  if (std::filesystem::exists(reference_file)) {
    const Json kept = Json::parse(read_text(reference_file));
    const ReducedField reference = ReducedField::of_json(kept["field"]);
    const ReducedField field = ReducedField::of_result(result, campaign);
    if (kept["process_seconds"] == summary["process_seconds"] && kept["cells"] == summary["cells"]) {
      rows.add("temperature_error", temperature_error(field, reference), "1");
      rows.add("cohesive_zone_error", zone_error(field, reference), "m");
      rows.add("change_over_the_run", change_from_guess(reference, campaign), "1");
    }
  }
  return rows.list();
}

void run_default(const TracerBench& wanted, const std::filesystem::path& work, const std::filesystem::path& json) {
  std::vector<Json> all;
  std::vector<double> marching;
  for (const int ranks : {1, 2}) {
    TracerBench bench = wanted;
    bench.ranks = ranks;
    const auto folder = work / fmt::format("ranks_{}", ranks);
    std::filesystem::remove_all(folder);
    make_tracer_task(folder, bench, CUPOLA_TRACER);
    const Json summary = march(folder, ranks);
    const Campaign campaign = read_task(folder).campaign;
    auto rows = rows_of("default", summary, folder / "result.hdf", campaign);
    marching.push_back(marching_seconds(summary));
    if (ranks == 2) {
      Rows more("default", summary);
      more.add("speed_up_over_one_rank", marching[0] / marching[1], "1");
      rows.push_back(more.list().front());
    }
    all.insert(all.end(), rows.begin(), rows.end());
    std::filesystem::remove_all(folder);
  }
  if (!json.empty()) write_json_atomically(json, all);
}

/// The reference, and rows on what it costs.
void make_reference(TracerBench bench, const std::filesystem::path& work, const std::filesystem::path& out) {
  bench.reference = true;
  const auto folder = work / fmt::format("reference_{:g}", bench.time_step > 0 ? bench.time_step : reference_step);
  make_tracer_task(folder, bench, CUPOLA_TRACER);
  const Json summary = march(folder, bench.ranks);
  const Campaign campaign = read_task(folder).campaign;
  const ReducedField field = ReducedField::of_result(folder / "result.hdf", campaign);
  const Json kept = {
      {"command", fmt::format("bench_tracer reference --step {:g} --ranks {} --seconds {:g} --tracers {:g}",
                              summary["time_step"].get<double>(), bench.ranks, bench.seconds, bench.tracers_per_cell)},
      {"process_seconds", summary["process_seconds"]},
      {"time_step", summary["time_step"]},
      {"cells", summary["cells"]},
      {"tracers", summary["tracers"]},
      {"wall_seconds", summary["wall_seconds"]},
      {"field", field.to_json()}};
  std::filesystem::create_directories(out.parent_path());
  write_json_atomically(out, kept);
  rows_of("reference", summary, folder / "result.hdf", campaign);
}

}  // namespace
}  // namespace cupola::bench

int main(int argc, char** argv) {
  using namespace cupola;
  using namespace cupola::bench;
  CLI::App app{"Cost and error of the tracer stage"};
  TracerBench bench;
  bench.campaign = source / "cases" / "slot_paper" / "campaign.yaml";
  std::filesystem::path folder;
  std::filesystem::path json;
  std::filesystem::path work = std::filesystem::temp_directory_path() / "cupola_bench_tracer";
  std::filesystem::path out = reference_file;
  const auto settings = [&](CLI::App& of) {
    of.add_option("--campaign", bench.campaign, "campaign file");
    of.add_option("--seconds", bench.seconds, "process time");
    of.add_option("--step", bench.time_step, "time step, s");
    of.add_option("--cells", bench.cell_factor, "cells along an edge over the campaign's");
    of.add_option("--tracers", bench.tracers_per_cell, "tracers a cell");
    of.add_option("--work", work, "folder for the tasks");
  };
  settings(app);
  app.add_option("--json", json, "rows of the table");
  CLI::App* making = app.add_subcommand("reference", "make the reference");
  settings(*making);
  making->add_option("--ranks", bench.ranks, "MPI ranks");
  making->add_option("--out", out, "file of the reduced field");
  CLI::App* preparing = app.add_subcommand("prepare", "make one task, to be run by hand");
  settings(*preparing);
  preparing->add_option("FOLDER", folder, "task folder")->required();
  preparing->add_option("--ranks", bench.ranks, "MPI ranks");
  preparing->add_flag("--reference", bench.reference, "reference settings");
  CLI11_PARSE(app, argc, argv);
  try {
    if (preparing->parsed()) {
      make_tracer_task(folder, bench, CUPOLA_TRACER);
    } else if (making->parsed()) {
      make_reference(bench, work, out);
    } else {
      run_default(bench, work, json);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 70;
  }
  return 0;
}
