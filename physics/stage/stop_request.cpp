#include "physics/stage/stop_request.hpp"

#include <array>
#include <csignal>

namespace cupola {
namespace {

volatile std::sig_atomic_t stop_asked = 0;
constexpr std::array<int, 3> signals{SIGUSR1, SIGTERM, SIGINT};

void remember(int /*signal*/) { stop_asked = 1; }

void set_handlers(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  // System calls go on where they were: HDF5 and MPI do not expect to be interrupted.
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : signals) sigaction(signal, &action, nullptr);
}

}  // namespace

StopRequest::StopRequest() {
  stop_asked = 0;
  set_handlers(remember);
}

StopRequest::~StopRequest() { set_handlers(SIG_DFL); }

bool StopRequest::asked_here() { return stop_asked != 0; }

bool StopRequest::agreed(MPI_Comm communicator) {
  int asked = asked_here() ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &asked, 1, MPI_INT, MPI_MAX, communicator);
  return asked != 0;
}

}  // namespace cupola
