#include "orchestrator/stage_versions.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "orchestrator/built_with.hpp"
#include "orchestrator/run_check.hpp"
#include "schemas/version.hpp"

namespace cupola {
namespace {

using nlohmann::json;

/// What a program prints. Empty where it cannot be started or ends badly.
std::string output_of(const std::filesystem::path& program, const char* option) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return {};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  std::string name = program.string();
  std::string word = option;
  std::array<char*, 3> words{name.data(), word.data(), nullptr};
  pid_t child = 0;
  const int problem = ::posix_spawn(&child, name.c_str(), &actions, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t count = 0;
       problem == 0 && ((count = ::read(pipe[0], buffer.data(), buffer.size())) > 0 || errno == EINTR);)
    if (count > 0)
      text.append(buffer.data(), static_cast<std::size_t>(count));
    else if (count == 0)
      break;
  ::close(pipe[0]);
  int status = 0;
  while (problem == 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return problem == 0 && status == 0 ? text : std::string();
}

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
    const std::string said = output_of(launcher.program(kind), "--versions");
    const json of_stage = json::parse(said, nullptr, false);
    if (!of_stage.is_object())
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
