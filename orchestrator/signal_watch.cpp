#include "orchestrator/signal_watch.hpp"

namespace cupola {

SignalWatch::SignalWatch() {
  sigemptyset(&watched_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGCHLD}) sigaddset(&watched_, signal);
  sigprocmask(SIG_BLOCK, &watched_, &former_);
  // A terminal that has gone must not end the run: writing to it fails instead.
  std::signal(SIGPIPE, SIG_IGN);
}

SignalWatch::~SignalWatch() {
  while (take(std::chrono::milliseconds(0))) {
    // Nothing that came while we watched must be delivered the hard way now.
  }
  sigprocmask(SIG_SETMASK, &former_, nullptr);
  std::signal(SIGPIPE, SIG_DFL);
}

bool SignalWatch::take(std::chrono::milliseconds at_most) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(at_most);
  const timespec timeout{seconds.count(), std::chrono::nanoseconds(at_most - seconds).count()};
  const int signal = sigtimedwait(&watched_, nullptr, &timeout);
  if (signal > 0 && signal != SIGCHLD) ++stop_requests_;
  if (signal == SIGUSR1) time_is_up_ = true;
  return signal > 0;
}

void SignalWatch::wait(std::chrono::milliseconds at_most) { take(at_most); }

int SignalWatch::stop_requests() {
  while (take(std::chrono::milliseconds(0))) {
    // A child's change taken here is found by whoever asks the child.
  }
  return stop_requests_;
}

bool SignalWatch::time_is_up() { return stop_requests() > 0 && time_is_up_; }

}  // namespace cupola
