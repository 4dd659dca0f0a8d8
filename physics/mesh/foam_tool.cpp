#include "physics/mesh/foam_tool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "schemas/files.hpp"
#include "schemas/plain_path.hpp"

namespace cupola {
namespace {

/// File actions of posix_spawn: standard output and error to a file, no input.
class OutputTo {
 public:
  explicit OutputTo(const std::string& file) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    // OpenFOAM looks at the name of the folder it is started in, and ends where there is a blank in it.  (Nor has it
    // the variable PWD for the same reason: see ToolEnvironment.)
    posix_spawn_file_actions_addchdir_np(&actions_, "/");
  }
  ~OutputTo() { posix_spawn_file_actions_destroy(&actions_); }
  OutputTo(const OutputTo&) = delete;
  OutputTo& operator=(const OutputTo&) = delete;
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// The environment for the tools: without what mpirun tells its ranks, which a serial program must not take for its
/// own.
class ToolEnvironment {
 public:
  ToolEnvironment() {
    bool has_project_folder = false;
    for (char** entry = environ; *entry != nullptr; ++entry) {
      const std::string variable(*entry);
      if (variable.starts_with("OMPI_COMM_WORLD") || variable.starts_with("PMIX_") ||
          variable.starts_with("FOAM_CASE") || variable.starts_with("PWD=")) {
        continue;
      }
      has_project_folder = has_project_folder || variable.starts_with("WM_PROJECT_DIR=");
      variables_.push_back(variable);
    }
    if (!has_project_folder) variables_.emplace_back("WM_PROJECT_DIR=/usr/share/openfoam");
    for (std::string& variable : variables_) pointers_.push_back(variable.data());
    pointers_.push_back(nullptr);
  }
  [[nodiscard]] char* const* get() const { return pointers_.data(); }

 private:
  std::vector<std::string> variables_;
  std::vector<char*> pointers_;
};

std::string last_lines(const std::string& text, std::size_t lines) {
  std::size_t begin = text.size();
  for (std::size_t found = 0; begin > 0; --begin) {
    if (text[begin - 1] == '\n' && ++found > lines) break;
  }
  return text.substr(begin);
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

std::string run_foam_tool(const std::string& program, const std::vector<std::string>& options,
                          const std::filesystem::path& case_folder) {
  const std::filesystem::path folder = std::filesystem::absolute(case_folder);
  const std::filesystem::path log = folder / ("log." + program);
  const PlainPath plain(folder);
  std::vector<std::string> words{program, "-case", plain.path().string()};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  const OutputTo output(log.string());
  const ToolEnvironment environment;
  pid_t child = 0;
  const int problem = posix_spawnp(&child, program.c_str(), output.get(), nullptr, arguments.data(), environment.get());
  if (problem != 0) {
    throw Failure(ExitCode::input_output, fmt::format("{} cannot be started: {}; is the package openfoam installed?",
                                                      program, std::strerror(problem)));
  }
  const int status = wait_for(child);
  std::string printed = read_text(log);
  if (status != 0) {
    throw Failure(ExitCode::input_output, fmt::format("{} ended with status {}; {} says at its end:\n{}", program,
                                                      status, log.string(), last_lines(printed, 20)))
        .at("file", log.string());
  }
  return printed;
}

}  // namespace cupola
