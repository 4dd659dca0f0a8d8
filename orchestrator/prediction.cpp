#include "orchestrator/prediction.hpp"

#include <fmt/format.h>

#include <chrono>

#include "orchestrator/stage_task.hpp"
#include "schemas/failure.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using namespace std::chrono_literals;

/// @return false where a stop was asked for
bool run_to_end(const Command& command, const std::filesystem::path& task, SignalWatch& signals) {
  ChildProcess process(command, signals.former_mask());
  process.release();
  bool asked = false;
  std::optional<int> status;
  while (!(status = process.poll())) {
    signals.wait(200ms);
    if (!asked && signals.stop_requests() > 0) {
      asked = true;
      process.signal(SIGTERM);
    }
  }
  if (asked) return false;
  if (*status == static_cast<int>(ExitCode::done)) return true;
  const auto failure = read_failure(task);
  const int code = failure ? failure->value("code", 0) : 0;
  throw Failure(code == static_cast<int>(ExitCode::wrong_input) || code == static_cast<int>(ExitCode::input_output)
                    ? static_cast<ExitCode>(code)
                    : ExitCode::diverged,
                failure ? fmt::format("prediction: {}", failure->value("sentence", ""))
                        : fmt::format("prediction: ended without saying why (status {}); see {}", *status,
                                      (task / "stage.log").string()));
}

}  // namespace

std::filesystem::path prediction_folder(const std::filesystem::path& run) { return run / "prediction"; }

bool has_prediction(const std::filesystem::path& run) {
  return std::filesystem::exists(prediction_folder(run) / "manifest.json");
}

std::optional<std::filesystem::path> usable_prediction(const std::filesystem::path& run) {
  if (!has_prediction(run)) return std::nullopt;
  const std::filesystem::path file = prediction_folder(run) / "result.hdf";
  const nlohmann::json summary = FieldFile(file, "tracer-result").summary();
  if (!summary.value(nlohmann::json::json_pointer("/prediction/converged"), false)) return std::nullopt;
  return file;
}

bool finish_prediction(RunFolder& run, const StageLauncher& launcher, SignalWatch& signals) {
  if (has_prediction(run.path())) return true;
  if (std::filesystem::exists(run.path() / "episodes")) {
    throw Failure(ExitCode::wrong_input,
                  fmt::format("{}: the campaign has begun there without a prediction; predict in another folder "
                              "(--run-dir)",
                              run.path().string()));
  }
  const std::filesystem::path task = prediction_folder(run.path());
  ensure_task(task, stage_task(TaskKind::predict, 0, run.campaign(), run.campaign_hash(), {}, task));
  std::filesystem::remove(task / "failure.json");
  return run_to_end(launcher.prepare(TaskKind::predict, task), task, signals) &&
         run_to_end(launcher.run(TaskKind::predict, task, run.campaign().launch), task, signals);
}

}  // namespace cupola
