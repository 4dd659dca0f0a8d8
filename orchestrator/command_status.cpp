#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "orchestrator/commands.hpp"
#include "orchestrator/journal.hpp"
#include "orchestrator/run_status.hpp"
#include "orchestrator/signal_watch.hpp"

namespace cupola {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

std::string shown(const nlohmann::json& status, bool as_json, int indent) {
  return as_json ? status.dump(indent) : status_text(status);
}

/// Whether there is nothing more to see.
bool is_over(const nlohmann::json& status) {
  const std::string state = status["state"];
  return state != "running" && state != "queued" && state != "stopped" && state != "failed";
}

/// Shows the state again and again until the campaign has ended or somebody has seen enough.
ExitCode watch(const std::filesystem::path& folder, bool as_json) {
  SignalWatch signals;
  const bool terminal = ::isatty(STDOUT_FILENO) == 1;
  std::string last;
  for (;;) {
    const Clock::time_point begin = Clock::now();
    nlohmann::json status;
    try {
      status = run_status(read_run(folder));
    } catch (const Failure& failure) {
      // A network disk may be away for a moment; whoever watches wants to see it come back.
      if (last.empty() || failure.code() != ExitCode::input_output) throw;
      fmt::print("{}\n", failure.what());
      signals.wait(10s);
      if (signals.stop_requests() > 0) return ExitCode::done;
      continue;
    }
    const std::string text = shown(status, as_json, -1);
    if (terminal && !as_json)
      fmt::print("\033[H\033[J{}\n\n{}, Ctrl-C leaves; the campaign goes on\n", text, utc_now());
    else if (text != last)
      fmt::print("{}\n", text);
    std::fflush(stdout);
    last = text;
    if (is_over(status)) return ExitCode::done;
    // Reading takes long on a slow disk: it must not be kept busy by who only looks.
    const auto pause = std::max<Clock::duration>(2s, 10 * (Clock::now() - begin));
    signals.wait(std::chrono::duration_cast<std::chrono::milliseconds>(pause));
    if (signals.stop_requests() > 0) return ExitCode::done;
  }
}

}  // namespace

ExitCode status(const std::filesystem::path& folder, bool as_json, bool again_and_again) {
  if (again_and_again) return watch(folder, as_json);
  fmt::print("{}\n", shown(run_status(read_run(folder)), as_json, 2));
  return ExitCode::done;
}

}  // namespace cupola
