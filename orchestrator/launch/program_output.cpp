#include "orchestrator/launch/program_output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "schemas/failure.hpp"

namespace cupola {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int not_there = 127;  // as the shell says it
constexpr int killed = 128 + SIGKILL;

/// A pipe whose ends are closed again, whatever happens.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw Failure(ExitCode::input_output, fmt::format("no pipe: {}", std::strerror(errno)));
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  Pipe(Pipe&&) = delete;
  Pipe& operator=(Pipe&&) = delete;

  [[nodiscard]] int reading() const { return ends_[0]; }
  [[nodiscard]] int writing() const { return ends_[1]; }
  void close_end(std::size_t end) {
    if (ends_[end] >= 0) ::close(ends_[end]);
    ends_[end] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// What the new process begins with: nothing to read, the pipes to write to, no signal held back, a group of its own.
class SpawnSettings {
 public:
  SpawnSettings(const Pipe& output, const Pipe& error) {
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, output.writing(), 1);
    posix_spawn_file_actions_adddup2(&files, error.writing(), 2);
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  SpawnSettings(SpawnSettings&&) = delete;
  SpawnSettings& operator=(SpawnSettings&&) = delete;

  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};
};

/// Takes what is there. @return false at the end of the pipe
bool take(int descriptor, std::string& text) {
  std::array<char, 4096> buffer{};
  const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
  if (count < 0) return errno == EINTR;
  text.append(buffer.data(), static_cast<std::size_t>(count));
  return count > 0;
}

/// Reads both pipes to their ends. @return false where that took too long
bool listen(Pipe& output, Pipe& error, ProgramOutput& result, Clock::time_point until) {
  bool output_open = true, error_open = true;
  while (output_open || error_open) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
    if (left.count() <= 0) return false;
    std::array<pollfd, 2> pipes{
        {{output_open ? output.reading() : -1, POLLIN, 0}, {error_open ? error.reading() : -1, POLLIN, 0}}};
    if (::poll(pipes.data(), pipes.size(), static_cast<int>(left.count())) <= 0) continue;
    if (pipes[0].revents != 0) output_open = take(output.reading(), result.output);
    if (pipes[1].revents != 0) error_open = take(error.reading(), result.error);
  }
  return true;
}

}  // namespace

ProgramOutput output_of(const std::vector<std::string>& words, std::chrono::seconds patience) {
  ProgramOutput result;
  Pipe output, error;
  std::vector<std::string> texts = words;
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  pid_t pid = 0;
  const SpawnSettings settings(output, error);
  const int problem =
      ::posix_spawnp(&pid, pointers[0], &settings.files, &settings.attributes, pointers.data(), environ);
  if (problem == ENOENT || problem == EACCES)
    return {not_there, "", fmt::format("{}: {}", words.front(), std::strerror(problem))};
  if (problem != 0)
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: no process for it: {}", words.front(), std::strerror(problem)));
  output.close_end(1);
  error.close_end(1);
  if (!listen(output, error, result, Clock::now() + patience)) {
    ::kill(pid, SIGKILL);
    result.error += fmt::format("{} did not answer within {} s", words.front(), patience.count());
  }
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    // Only a signal kept us from waiting.
  }
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : WIFSIGNALED(status) ? 128 + WTERMSIG(status) : killed;
  return result;
}

}  // namespace cupola
