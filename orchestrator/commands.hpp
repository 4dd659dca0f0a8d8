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

/// `cupola predict CAMPAIGN`: the steady state without any stage, with a report (docs/predictor.md).
/// @param folder as of `run`; the campaign can be run there afterwards
ExitCode predict(const std::filesystem::path& campaign_file, const std::optional<std::filesystem::path>& folder);

/// `cupola resume RUN`
ExitCode resume(const std::filesystem::path& folder, const MarchOptions& options);

/// `cupola run CAMPAIGN --submit`: queues the whole campaign as a chain of jobs in Slurm.
ExitCode submit(const std::filesystem::path& campaign_file, const std::optional<std::filesystem::path>& folder,
                const MarchOptions& options);
/// `cupola resume RUN --submit`: the same for what is left of a run.
ExitCode submit_again(const std::filesystem::path& folder, const MarchOptions& options);
/// A link of such a chain: one stage.
ExitCode chain_link(const std::filesystem::path& folder, MarchOptions options);

/// `cupola status RUN`
/// @param again_and_again `--watch`: until the campaign has ended or a signal comes
ExitCode status(const std::filesystem::path& folder, bool as_json, bool again_and_again);

/// `cupola serve RUN`: the report in a browser while the campaign runs; until a signal comes.
/// @param host address to listen at @param port 0: any free one
ExitCode serve(const std::filesystem::path& folder, const std::string& host, int port);

/// `cupola verify RUN`: compares every byte that carries a hash. @return done, or input_output where one differs
ExitCode verify(const std::filesystem::path& folder, bool as_json);

/// `cupola report RUN`: makes the report anew, at whatever point the run stands.
ExitCode report(const std::filesystem::path& folder);

/// What may be asked of `cupola study`.
struct StudyOptions {
  std::optional<std::filesystem::path> folder;  ///< none: `studies/<study>` in the present folder
  std::optional<int> jobs;                      ///< instead of the file's
  std::optional<std::size_t> task;              ///< only this one: what a member of an array of jobs does
  bool reduced = false;                         ///< with the file's section `reduced`
  bool only_check = false;                      ///< says what would be run
  bool only_gather = false;                     ///< runs nothing, makes the results anew
  bool retry_failed = false;                    ///< what failed is tried again
  bool submit = false;                          ///< as arrays of jobs in Slurm
};

/// `cupola study STUDY`: one scene at many settings, error against run time (docs/studies.md).
/// @return done: all ended, and something could be compared; diverged: nothing could; stopped: goes on next time
ExitCode study(const std::filesystem::path& study_file, const StudyOptions& options);

/// `cupola init DIR`: writes a commented campaign to begin with.
ExitCode init(const std::filesystem::path& folder);

/// `cupola doctor`: is everything there that a run needs, and do two ranks really work together?
ExitCode doctor();

}  // namespace cupola
