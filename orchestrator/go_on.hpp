#pragma once
#include <filesystem>
#include <memory>
#include <optional>

#include "orchestrator/march.hpp"

namespace cupola {

/// The run folder of a campaign file that has been looked over: made, or opened where it is there.
/// @param folder none: `runs/<campaign>` in the present folder
/// @throws Failure wrong_input: also where the plan refuses the campaign
std::unique_ptr<RunFolder> open_for(const std::filesystem::path& campaign_file,
                                    const std::optional<std::filesystem::path>& folder);

/// Works on a run folder until the campaign ends or has to stop, and keeps its report up to date.
/// @return, @throws as `march`
ExitCode go_on(RunFolder& folder, const MarchOptions& options, SignalWatch& signals);

}  // namespace cupola
