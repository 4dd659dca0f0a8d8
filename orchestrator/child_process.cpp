#include "orchestrator/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "schemas/failure.hpp"

namespace cupola {
namespace {

constexpr int cannot_be_started = 127;  // as the shell says it

struct ProcessLine {
  std::uint64_t started = 0;  ///< clock ticks since the machine was; 0 where there is no such process or it has ended
  int session = 0;
};

ProcessLine process_line(int pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string text;
  if (!std::getline(file, text)) return {};
  // The second field, the name in brackets, may hold blanks; state is field 3, the session 6, the start is field 22.
  const std::size_t bracket = text.rfind(')');
  if (bracket == std::string::npos) return {};
  std::istringstream fields(text.substr(bracket + 1));
  std::string field;
  fields >> field;
  if (field == "Z" || field == "X") return {};
  ProcessLine line;
  for (int i = 4; i <= 22; ++i) {
    fields >> field;
    if (i == 6) line.session = std::atoi(field.c_str());
  }
  line.started = std::strtoull(field.c_str(), nullptr, 10);
  return line;
}

std::uint64_t start_of(int pid) { return process_line(pid).started; }

/// What the new process does: only calls that are safe between fork and exec.
[[noreturn]] void become(const std::vector<char*>& words, const std::vector<char*>& environment, int log, int gate,
                         const sigset_t& mask, bool ends_with_us, pid_t parent) {
  ::setsid();
  if (ends_with_us) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(cannot_be_started);
  }
  char go = 0;
  ssize_t count = 0;
  do {
    count = ::read(gate, &go, 1);
  } while (count < 0 && errno == EINTR);
  if (count != 1) ::_exit(cannot_be_started);
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing < 0 || ::dup2(nothing, 0) < 0 || ::dup2(log, 1) < 0 || ::dup2(log, 2) < 0) ::_exit(cannot_be_started);
  ::signal(SIGPIPE, SIG_DFL);
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  ::execvpe(words.front(), words.data(), environment.data());
  ::dprintf(2, "%s cannot be started: %s\n", words.front(), std::strerror(errno));
  ::_exit(cannot_be_started);
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_with(const std::map<std::string, std::string>& added) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!added.contains(text.substr(0, text.find('=')))) result.push_back(text);
  }
  for (const auto& [name, value] : added) result.push_back(name + "=" + value);
  return result;
}

}  // namespace

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : "unknown host";
}

ProcessIdentity ProcessIdentity::of(int pid) { return {host_name(), pid, start_of(pid)}; }

bool ProcessIdentity::alive() const {
  return pid > 0 && started > 0 && host == host_name() && start_of(pid) == started;
}

ChildProcess::ChildProcess(const Command& command, const sigset_t& mask) {
  std::vector<std::string> words = command.words;
  std::vector<std::string> environment = environment_with(command.environment);
  const std::vector<char*> word_pointers = pointers(words);
  const std::vector<char*> environment_pointers = pointers(environment);
  const auto fail = [&](const std::string& what) {
    return Failure(ExitCode::input_output, fmt::format("{}: {}: {}", words.front(), what, std::strerror(errno)));
  };
  const int log = ::open(command.log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (log < 0) throw fail("its log " + command.log.string() + " cannot be opened");
  std::array<int, 2> gate{};
  if (::pipe2(gate.data(), O_CLOEXEC) != 0) {
    ::close(log);
    throw fail("no pipe for it");
  }
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) {
    ::close(gate[1]);  // else the pipe would never end when the parent dies
    become(word_pointers, environment_pointers, log, gate[0], mask, command.ends_with_us, parent);
  }
  const int error = errno;
  ::close(log);
  ::close(gate[0]);
  gate_ = gate[1];
  if (pid_ < 0) {
    ::close(gate_);
    errno = error;
    throw fail("no process for it");
  }
}

ChildProcess::~ChildProcess() {
  if (gate_ >= 0) ::close(gate_);
}

void ChildProcess::release() {
  const char go = 1;
  if (::write(gate_, &go, 1) != 1)
    throw Failure(ExitCode::input_output, fmt::format("process {} cannot be started: {}", pid_, std::strerror(errno)));
  ::close(gate_);
  gate_ = -1;
}

std::optional<int> ChildProcess::poll() {
  if (status_) return status_;
  int status = 0;
  const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
  if (ended == pid_) status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return status_;
}

void ChildProcess::signal(int number) const {
  if (!status_) ::kill(pid_, number);
}

void ChildProcess::kill_all() const {
  if (status_) return;
  // The ranks have process groups of their own, but the session is ours: nothing can leave it by accident.
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
    const int pid = std::atoi(entry.path().filename().c_str());
    if (pid > 0 && process_line(pid).session == pid_) ::kill(pid, SIGKILL);
  }
  ::kill(pid_, SIGKILL);
}

}  // namespace cupola
