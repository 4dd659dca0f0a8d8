#pragma once
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cupola {

/// Which process this is, also after its number has been given to another one.
struct ProcessIdentity {
  std::string host;
  int pid = 0;
  std::uint64_t started = 0;  ///< clock ticks since the machine was started

  [[nodiscard]] static ProcessIdentity of(int pid);
  /// Whether it still runs; a process of another host does not as far as we can see.
  [[nodiscard]] bool alive() const;
};

/// The name of this machine.
std::string host_name();

/// What to start.
struct Command {
  std::vector<std::string> words;                  ///< the program and its arguments
  std::map<std::string, std::string> environment;  ///< added to our own
  std::filesystem::path log;                       ///< standard output and error are appended here
  bool ends_with_us = false;                       ///< killed by the kernel when we die
};

/// A started program in a process session of its own, so that a Ctrl-C at the terminal does not reach it.
class ChildProcess {
 public:
  /// Makes the process but holds the program back until `release`: what is about to run can be written down first, and
  /// if we die before, nothing is started.
  /// @param mask signal mask for the program
  /// @throws Failure input_output
  ChildProcess(const Command& command, const sigset_t& mask);
  /// Does not end a program that still runs.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ChildProcess(ChildProcess&&) = delete;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Lets the program begin.
  void release();
  /// Its exit status once it has ended (128 + the signal's number where a signal ended it); none while it runs.
  [[nodiscard]] std::optional<int> poll();
  void signal(int number) const;
  /// Kills it and all that it has started in its process session.
  void kill_all() const;
  [[nodiscard]] int pid() const { return pid_; }

 private:
  int pid_ = 0;
  int gate_ = -1;  ///< the writing end of the pipe that holds the program back
  std::optional<int> status_;
};

}  // namespace cupola
