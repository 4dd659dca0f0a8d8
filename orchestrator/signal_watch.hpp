#pragma once
#include <chrono>
#include <csignal>

namespace cupola {

/// Takes over the signals that ask the orchestrator to stop (SIGINT, SIGTERM, SIGHUP; SIGUSR1 from a cluster
/// before its time limit) and the one that a child has
/// changed (SIGCHLD): they interrupt nothing and are read where it is safe.  Started programs get the former mask back.
/// Make one object, before anything is started.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;
  SignalWatch(SignalWatch&&) = delete;
  SignalWatch& operator=(SignalWatch&&) = delete;

  /// Sleeps until a child changes, a stop is asked for, or the time is over.
  void wait(std::chrono::milliseconds at_most);

  /// How often a stop has been asked for so far.
  [[nodiscard]] int stop_requests();

  /// Whether the cluster has asked for the stop because the time is up (SIGUSR1).
  [[nodiscard]] bool time_is_up();

  /// The signal mask to give to started programs.
  [[nodiscard]] const sigset_t& former_mask() const { return former_; }

 private:
  bool take(std::chrono::milliseconds at_most);

  sigset_t watched_{};
  sigset_t former_{};
  int stop_requests_ = 0;
  bool time_is_up_ = false;
};

}  // namespace cupola
