#include <fmt/format.h>
#include <httplib.h>

#include <chrono>
#include <mutex>
#include <thread>

#include "orchestrator/commands.hpp"
#include "orchestrator/report/report.hpp"
#include "orchestrator/report/report_page.hpp"
#include "orchestrator/run_status.hpp"
#include "orchestrator/signal_watch.hpp"

namespace cupola {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

bool is_loopback(const std::string& host) { return host == "127.0.0.1" || host == "localhost" || host == "::1"; }

/// Report and status of a run for those who ask; made anew at most every few seconds, by one thread at a time (HDF5's
/// serial library takes no more).
class LiveRun {
 public:
  explicit LiveRun(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::string page() { return report_page(report()); }
  std::string numbers() { return report().dump(1); }
  std::string status() {
    const std::lock_guard<std::mutex> guard(mutex_);
    if (status_.is_null() || Clock::now() - status_time_ > 2s) {
      status_ = run_status(read_run(folder_));
      status_["text"] = status_text(status_);
      status_time_ = Clock::now();
    }
    return status_.dump();
  }

 private:
  json report() {
    const std::lock_guard<std::mutex> guard(mutex_);
    if (report_.is_null() || Clock::now() - report_time_ > 5s) {
      report_ = gather_report(folder_);
      report_time_ = Clock::now();
    }
    return report_;
  }

  std::filesystem::path folder_;
  std::mutex mutex_;
  json report_, status_;
  Clock::time_point report_time_, status_time_;
};

void answer(httplib::Response& response, const std::function<std::string()>& make, const char* type) {
  try {
    response.set_content(make(), type);
  } catch (const std::exception& problem) {
    response.status = 503;
    response.set_content(std::string(problem.what()) + "\n", "text/plain; charset=utf-8");
  }
}

/// On loopback, pages of other sites must not read the run through a name of theirs that leads here.
bool is_asked_as_loopback(const httplib::Request& request) {
  const std::string host = request.get_header_value("Host");
  const std::size_t port = host.rfind(':');
  const std::string name = host.substr(0, port);
  return is_loopback(name) || name == "[::1]";
}

}  // namespace

ExitCode serve(const std::filesystem::path& folder, const std::string& host, int port) {
  SignalWatch signals;
  read_run(folder);  // says at once what is wrong with the folder
  LiveRun live(folder);
  httplib::Server server;
  // Without SO_REUSEPORT, which the library sets: a second server on the port is to fail, not to share its visitors.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_default_headers({{"Cache-Control", "no-store"}, {"X-Content-Type-Options", "nosniff"}});
  if (is_loopback(host)) {
    server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
      if (is_asked_as_loopback(request)) return httplib::Server::HandlerResponse::Unhandled;
      response.status = 403;
      return httplib::Server::HandlerResponse::Handled;
    });
  }
  server.Get("/", [&](const httplib::Request&, httplib::Response& response) {
    answer(
        response, [&] { return live.page(); }, "text/html; charset=utf-8");
  });
  server.Get("/report.json", [&](const httplib::Request&, httplib::Response& response) {
    answer(
        response, [&] { return live.numbers(); }, "application/json");
  });
  server.Get("/status.json", [&](const httplib::Request&, httplib::Response& response) {
    answer(
        response, [&] { return live.status(); }, "application/json");
  });
  const int bound = port == 0 ? server.bind_to_any_port(host) : (server.bind_to_port(host, port) ? port : -1);
  if (bound < 0)
    throw Failure(
        ExitCode::input_output,
        fmt::format("{}:{}: cannot be listened at: another program listens there, perhaps another `cupola serve`, or "
                    "the address is not of this machine. Choose another --port (0: any free one) or --host.",
                    host, port));
  fmt::print("http://{}:{}/ shows {}; Ctrl-C ends this, not the campaign\n", host, bound, folder.string());
  std::fflush(stdout);
  std::thread listening([&] { server.listen_after_bind(); });
  while (signals.stop_requests() == 0) signals.wait(1s);
  server.stop();
  listening.join();
  return ExitCode::done;
}

}  // namespace cupola
