#pragma once
#include <mpi.h>

namespace cupola {

/// Catches SIGUSR1, SIGTERM and SIGINT for its life and remembers that a stop was asked for.  At most one object at a
/// time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
  StopRequest(StopRequest&&) = delete;
  StopRequest& operator=(StopRequest&&) = delete;

  /// Whether a signal has reached this process.
  [[nodiscard]] static bool asked_here();

  /// Whether a signal has reached any rank.  Collective: every rank gets the same answer.
  [[nodiscard]] static bool agreed(MPI_Comm communicator);
};

}  // namespace cupola
