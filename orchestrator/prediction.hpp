#pragma once
#include <filesystem>
#include <optional>

#include "orchestrator/run_folder.hpp"
#include "orchestrator/signal_watch.hpp"
#include "orchestrator/stage_launcher.hpp"

namespace cupola {

/// `RUN/prediction`: the task folder of a run's prediction, which belongs to no episode.
std::filesystem::path prediction_folder(const std::filesystem::path& run);

/// Whether a run holds a prediction that has ended.
bool has_prediction(const std::filesystem::path& run);

/// Result of a prediction that a march can begin with: one that has converged.
std::optional<std::filesystem::path> usable_prediction(const std::filesystem::path& run);

/// Makes the prediction of a run where it is not there yet; one that was interrupted begins again.
/// @return false where a stop was asked for
/// @throws Failure wrong_input where the run has begun without it, else as the predictor said
bool finish_prediction(RunFolder& run, const StageLauncher& launcher, SignalWatch& signals);

}  // namespace cupola
