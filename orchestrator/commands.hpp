#pragma once
#include <filesystem>
#include <optional>

#include "orchestrator/march.hpp"
#include "schemas/failure.hpp"

/// The commands of `cupola`, one function each.  All throw Failure.
namespace cupola {

/// `cupola validate CAMPAIGN`: all errors of a campaign file.
ExitCode validate(const std::filesystem::path& campaign_file, bool as_json);

/// `cupola explain CAMPAIGN`: what will be computed and why, sizes, heat balance, expected cost.
ExitCode explain(const std::filesystem::path& campaign_file, bool as_json);

/// `cupola run CAMPAIGN`: begins a run folder, or goes on with it.
/// @param folder none: `runs/<campaign>` in the present folder
ExitCode run(const std::filesystem::path& campaign_file, const std::optional<std::filesystem::path>& folder,
             const MarchOptions& options);

/// `cupola resume RUN`
ExitCode resume(const std::filesystem::path& folder, const MarchOptions& options);

/// `cupola status RUN`
ExitCode status(const std::filesystem::path& folder, bool as_json);

/// `cupola verify RUN`: compares every byte that carries a hash. @return done, or input_output where one differs
ExitCode verify(const std::filesystem::path& folder, bool as_json);

/// `cupola report RUN`: makes the report anew, at whatever point the run stands.
ExitCode report(const std::filesystem::path& folder);

/// `cupola init DIR`: writes a commented campaign to begin with.
ExitCode init(const std::filesystem::path& folder);

/// `cupola doctor`: is everything there that a run needs, and do two ranks really work together?
ExitCode doctor();

}  // namespace cupola
