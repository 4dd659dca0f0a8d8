#include "orchestrator/stage_versions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>

#include "orchestrator/built_with.hpp"
#include "orchestrator/launch/program_output.hpp"
#include "orchestrator/run_check.hpp"
#include "schemas/version.hpp"

namespace cupola {
namespace {

using nlohmann::json;

/// A stage that only prints is long done by then.
constexpr std::chrono::seconds patience{60};

json in_force(const json& information, const std::vector<json>& journal) {
  json versions = information.value("versions", json::object());
  for (const json& record : journal)
    if (record.value("event", "") == "versions-accepted") versions = record.value("versions", versions);
  return versions;
}

}  // namespace

json present_versions(const StageLauncher& launcher) {
  json versions = program_versions();
  for (const TaskKind kind : {TaskKind::dem, TaskKind::tracer}) {
    const ProgramOutput said = output_of({launcher.program(kind).string(), "--versions"}, patience);
    fmt::print(stderr, "{}", said.error);
    const json of_stage = json::parse(said.output, nullptr, false);
    if (said.status != 0 || !of_stage.is_object())
      throw Failure(ExitCode::input_output, fmt::format("{} does not say its versions: it cannot be started. See what "
                                                        "`cupola doctor` says.",
                                                        launcher.program(kind).string()));
    if (of_stage.value("cupola", "") != program_version)
      throw Failure(ExitCode::input_output,
                    fmt::format("{} is of version {}, cupola of {}: programs of one version belong together. Build or "
                                "install all three again.",
                                launcher.program(kind).string(), of_stage.value("cupola", "?"), program_version));
    for (const auto& [name, version] : of_stage.items()) versions[name] = version;
  }
  return versions;
}

void settle_versions(RunFolder& run, const json& present, bool accept) {
  const json before = in_force(run.information(), run.journal().records());
  std::vector<std::string> differences;
  for (const auto& [name, version] : before.items())
    if (present.value(name, "") != version)
      differences.push_back(
          fmt::format("{} {} (here {})", name, version.get<std::string>(), present.value(name, "none")));
  if (differences.empty() && before.size() == present.size()) return;
  if (!differences.empty() && !accept)
    throw Failure(
        ExitCode::wrong_input,
        fmt::format("{}: goes by {}. What comes next would not be what the former versions give. {} Go on with "
                    "`cupola resume {} --accept-versions` (finished stages are kept, a stage under way goes on "
                    "from its checkpoint), use the former versions, or begin a new run folder.",
                    run.path().string(), fmt::join(differences, ", "), still_whole(run.path()), run.path().string()));
  run.journal().append("versions-accepted", {{"versions", present}});
}

}  // namespace cupola
