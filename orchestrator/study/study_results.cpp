#include "orchestrator/study/study_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "orchestrator/child_process.hpp"
#include "orchestrator/journal.hpp"
#include "orchestrator/report/json_numbers.hpp"
#include "orchestrator/report/report_page.hpp"
#include "orchestrator/study/finished_stage.hpp"
#include "orchestrator/study/pareto.hpp"
#include "orchestrator/study/study_fields.hpp"
#include "physics/plan/plan.hpp"
#include "schemas/failure.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "schemas/version.hpp"

namespace cupola {
namespace {

using nlohmann::json;
using State = StudyTask::State;
namespace fs = std::filesystem;

constexpr double seconds_an_hour = 3600;

std::string state_text(State state) {
  switch (state) {
    case State::waiting:
      return "waiting";
    case State::running:
      return "running";
    case State::finished:
      return "finished";
    case State::failed:
      return "failed";
    case State::stopped:
      return "stopped";
  }
  return "";
}

/// Mean and its standard error; the latter null with one value.
json statistics(const std::vector<double>& values) {
  if (values.empty()) return {{"mean", nullptr}, {"standard_error", nullptr}, {"runs", 0}};
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.) / n;
  double squares = 0;
  for (const double value : values) squares += std::pow(value - mean, 2);
  return {{"mean", mean},
          {"standard_error", values.size() > 1 ? json(std::sqrt(squares / (n - 1) / n)) : json()},
          {"runs", values.size()}};
}

json or_null(const std::optional<double>& value) { return value ? json(*value) : json(); }

/// The numbers that a task's result says about itself.
struct Cost {
  double wall = 0, core = 0;
};

Cost cost_of(const StudyTask& task) {
  if (task.is_run) {
    const json report = read_json(task.folder / "run" / "report" / "report.json");
    const double wall = report.value("wall_seconds", 0.);
    return {wall, wall * task.campaign.launch.ranks};
  }
  const FieldFile file(task.folder / "result.hdf", "");
  const double wall = file.summary().value("wall_seconds", 0.);
  return {wall, wall * task.campaign.launch.ranks};
}

/// What explains a setting's cost and error, taken over from the stage's summary.
json notes_of(const StudyTask& task) {
  json notes = json::object();
  if (task.is_run) return notes;
  const json summary = FieldFile(task.folder / "result.hdf", "").summary();
  for (const char* key : {"time_step", "steps", "flow_solves", "tracers", "parcels", "cells", "largest_overlap",
                          "window_seconds", "process_seconds", "rayleigh_fraction"})
    if (summary.contains(key)) notes[key] = summary[key];
  if (const auto error = number_at(summary, "/accuracy/time_step_error")) notes["time_step_error"] = *error;
  return notes;
}

class Results {
 public:
  Results(const Study& study, const StudyWork& work) : study_(study), work_(work) {}

  json gather() {
    read_fields();
    json settings = json::array();
    for (std::size_t i = 0; i < study_.settings.size(); ++i) settings.push_back(setting_entry(i));
    json metrics = json::array();
    for (const StudyMetric metric : study_.metrics) metrics.push_back(metric_entry(metric, settings));
    json axes = json::array();
    for (const StudyAxis& axis : study_.axes) axes.push_back({{"keys", axis.keys}, {"values", axis.in_si}});
    return {{"schema", 1},
            {"kind", "study"},
            {"study", study_.name},
            {"about", study_.about},
            {"size", study_.size == StudySize::reduced ? "reduced" : "full"},
            {"scene", study_.scene.name},
            {"stage", study_stage_words.at(static_cast<std::size_t>(study_.stage))},
            {"begin", study_.begins_with_packing ? "packing" : "empty"},
            {"seeds", study_.seeds},
            {"jobs", study_.jobs},
            {"host", host_name()},
            {"program_version", program_version},
            {"file_written", utc_now()},
            {"study_text", read_text(study_.file)},
            {"scene_text", read_text(study_.scene_file)},
            {"reference", study_.reference.sentence},
            {"axes", axes},
            {"metrics", metrics},
            {"settings", settings},
            {"shared", shared_entry()}};
  }

 private:
  void read_fields() {
    fields_.resize(work_.runs.size());
    for (std::size_t i = 0; i < work_.runs.size(); ++i) {
      const StudyTask& last = work_.tasks[work_.runs[i].last()];
      if (last.state != State::finished) continue;
      if (!last.is_run) {
        fields_[i] = read_study_fields(last.folder, last.kind, last.campaign);
      } else if (const auto folder = last_finished_stage(last.folder / "run", TaskKind::tracer)) {
        fields_[i] = read_study_fields(*folder, TaskKind::tracer, last.campaign);
      }
    }
    for (const auto& [metric, file] : study_.reference.data)
      data_.emplace(metric, read_data_table(file, data_columns(metric)));
    if (study_.reference.kind != StudyReference::Kind::run) return;
    const TaskKind kind = study_.stage == StudyStage::dem ? TaskKind::dem : TaskKind::tracer;
    other_run_ = read_study_fields(last_finished_stage(study_.reference.run, kind).value(), kind, study_.scene);
  }

  [[nodiscard]] const std::optional<StudyFields>& fields_of(std::size_t setting, int seed) const {
    return fields_[setting * static_cast<std::size_t>(study_.seeds) + static_cast<std::size_t>(seed)];
  }

  [[nodiscard]] std::optional<double> error_of(StudyMetric metric, std::size_t setting, int seed) const {
    const auto& fields = fields_of(setting, seed);
    if (!fields) return std::nullopt;
    switch (study_.reference.kind) {
      case StudyReference::Kind::setting: {
        const std::size_t wanted = study_.settings[setting].reference.value();
        const auto& reference = fields_of(wanted, seed);
        return wanted == setting || !reference ? std::nullopt : metric_error(metric, *fields, *reference);
      }
      case StudyReference::Kind::run:
        return metric_error(metric, *fields, *other_run_);
      case StudyReference::Kind::data:
        return metric_error(metric, *fields, data_.at(metric));
      case StudyReference::Kind::analytic:
        return analytic_error(metric, *fields, study_.settings[setting].campaign);
    }
    return std::nullopt;
  }

  static std::optional<double> analytic_error(StudyMetric metric, const StudyFields& fields, const Campaign& campaign) {
    const Plan plan = make_plan(campaign);
    if (metric == StudyMetric::pressure_drop)
      return plan.pressure ? metric_error(metric, fields, plan.pressure->drop) : std::nullopt;
    if (!plan.heat) return std::nullopt;
    if (metric == StudyMetric::top_gas_temperature) return metric_error(metric, fields, plan.heat->top_gas_temperature);
    for (const auto& height : plan.heat->melting_height)
      if (height) return metric_error(metric, fields, *height);
    return std::nullopt;
  }

  json run_entry(std::size_t setting, int seed) {
    const StudyRun& run = work_.runs[setting * static_cast<std::size_t>(study_.seeds) + static_cast<std::size_t>(seed)];
    json entry = {
        {"seed", seed},          {"state", "finished"},      {"sentence", ""},           {"wall_seconds", nullptr},
        {"core_hours", nullptr}, {"errors", json::object()}, {"figures", json::object()}};
    Cost cost;
    for (const std::size_t index : run.own) {
      const StudyTask& task = work_.tasks[index];
      if (task.state == State::finished) {
        const Cost one = cost_of(task);
        cost.wall += one.wall;
        cost.core += one.core;
        continue;
      }
      entry["state"] = state_text(task.state);
      entry["sentence"] = task.sentence;
      return entry;
    }
    entry["wall_seconds"] = cost.wall;
    entry["core_hours"] = cost.core / seconds_an_hour;
    entry["sentence"] = work_.tasks[run.last()].sentence;
    entry["notes"] = notes_of(work_.tasks[run.last()]);
    entry["result"] = work_.tasks[run.last()].name();
    for (const StudyMetric metric : study_.metrics) {
      entry["errors"][metric_name(metric)] = or_null(error_of(metric, setting, seed));
      const auto& fields = fields_of(setting, seed);
      entry["figures"][metric_name(metric)] = fields ? or_null(metric_figure(metric, *fields)) : json();
    }
    return entry;
  }

  json setting_entry(std::size_t index) {
    const StudySetting& setting = study_.settings[index];
    json runs = json::array();
    std::vector<double> walls, cores;
    std::map<std::string, std::vector<double>> errors, figures;
    for (int seed = 0; seed < study_.seeds; ++seed) {
      const json run = run_entry(index, seed);
      if (run["wall_seconds"].is_number()) {
        walls.push_back(run["wall_seconds"].get<double>());
        cores.push_back(run["core_hours"].get<double>());
      }
      for (const StudyMetric metric : study_.metrics) {
        const std::string name = metric_name(metric);
        if (run["errors"].contains(name) && run["errors"][name].is_number())
          errors[name].push_back(run["errors"][name].get<double>());
        if (run["figures"].contains(name) && run["figures"][name].is_number())
          figures[name].push_back(run["figures"][name].get<double>());
      }
      runs.push_back(run);
    }
    json entry = {{"index", index},
                  {"label", setting.label()},
                  {"values", setting.values},
                  {"si", setting.in_si},
                  {"reference", setting.reference ? json(*setting.reference) : json()},
                  {"is_reference", setting.reference == index},
                  {"wall_seconds", statistics(walls)},
                  {"core_hours", statistics(cores)},
                  {"errors", json::object()},
                  {"figures", json::object()},
                  {"runs", runs}};
    for (const StudyMetric metric : study_.metrics) {
      entry["errors"][metric_name(metric)] = statistics(errors[metric_name(metric)]);
      entry["figures"][metric_name(metric)] = statistics(figures[metric_name(metric)]);
    }
    return entry;
  }

  /// How far the reference's own seeds lie from one another: below it no error can be told from chance.
  [[nodiscard]] std::optional<double> noise_of(StudyMetric metric) const {
    double sum = 0;
    int pairs = 0;
    for (std::size_t i = 0; i < study_.settings.size(); ++i) {
      if (study_.settings[i].reference != i) continue;
      for (int a = 0; a < study_.seeds; ++a)
        for (int b = a + 1; b < study_.seeds; ++b) {
          const auto &one = fields_of(i, a), &other = fields_of(i, b);
          const auto error = one && other ? metric_error(metric, *one, *other) : std::nullopt;
          if (!error) continue;
          sum += *error;
          ++pairs;
        }
    }
    return pairs > 0 ? std::optional(sum / pairs) : std::nullopt;
  }

  [[nodiscard]] json metric_entry(StudyMetric metric, const json& settings) const {
    const std::string name = metric_name(metric);
    std::vector<CostAndError> points;
    std::vector<std::size_t> whose;
    for (const json& setting : settings) {
      const json &error = setting["errors"][name]["mean"], &wall = setting["wall_seconds"]["mean"];
      if (!error.is_number() || !wall.is_number()) continue;
      points.push_back({wall.get<double>(), error.get<double>()});
      whose.push_back(setting["index"].get<std::size_t>());
    }
    const std::vector<std::size_t> front = pareto_front(points);
    const auto knee = knee_of(points, front);
    json on_front = json::array();
    for (const std::size_t i : front) on_front.push_back(whose[i]);
    return {{"name", name},
            {"unit", metric_unit(metric)},
            {"norm", metric_norm(metric)},
            {"front", on_front},
            {"knee", knee ? json(whose[*knee]) : json()},
            {"noise", or_null(noise_of(metric))}};
  }

  /// What all settings share, and what it took.
  [[nodiscard]] json shared_entry() const {
    std::vector<std::size_t> shared;
    for (const StudyRun& run : work_.runs)
      for (const std::size_t index : run.shared)
        if (std::find(shared.begin(), shared.end(), index) == shared.end()) shared.push_back(index);
    json entries = json::array();
    for (const std::size_t index : shared) {
      const StudyTask& task = work_.tasks[index];
      const bool finished = task.state == State::finished;
      entries.push_back({{"result", task.name()},
                         {"state", state_text(task.state)},
                         {"sentence", task.sentence},
                         {"wall_seconds", finished ? json(cost_of(task).wall) : json()}});
    }
    return entries;
  }

  const Study& study_;
  const StudyWork& work_;
  std::vector<std::optional<StudyFields>> fields_;  ///< by run
  std::optional<StudyFields> other_run_;
  std::map<StudyMetric, DataTable> data_;
};

}  // namespace

json study_results(const Study& study, const StudyWork& work) { return Results(study, work).gather(); }

void write_study_report(const fs::path& folder, const json& results) {
  write_json_atomically(folder / "study.json", results);
  write_text_atomically(folder / "index.html", report_page(results));
}

}  // namespace cupola
