#include "orchestrator/progress_view.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

#include "orchestrator/quantity_text.hpp"
#include "orchestrator/stage_launcher.hpp"

namespace cupola {
namespace {

constexpr std::chrono::seconds between_plain_lines(10);
constexpr std::size_t width_unknown = 80;

/// The line cut to the terminal's width; letters beyond ASCII take more bytes than places.
std::string fitted(const std::string& line, std::size_t places) {
  std::size_t used = 0, end = 0;
  while (end < line.size() && used + 1 < places) {
    ++end;
    while (end < line.size() && (static_cast<unsigned char>(line[end]) & 0xC0U) == 0x80U) ++end;
    ++used;
  }
  return line.substr(0, end);
}

std::size_t terminal_width(std::FILE* out) {
  winsize size{};
  return ::ioctl(::fileno(out), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : width_unknown;
}

}  // namespace

std::string progress_line(const StagePlace& place, const std::optional<Progress>& progress) {
  std::string line = fmt::format("episode {} of at most {} · {}", place.episode, place.at_most, stage_name(place.kind));
  if (place.attempt > 1) line += fmt::format(" (attempt {})", place.attempt);
  if (!progress) return line + " · starting";
  if (!progress->phase.empty()) line += " · " + progress->phase;
  line += fmt::format(" · {} of {}", duration_text(progress->process_seconds),
                      duration_text(progress->process_seconds_total));
  if (progress->rate > 0) {
    const double left = progress->process_seconds_total - progress->process_seconds;
    line +=
        fmt::format(" · {:.3g} s/s · ends in {}", progress->rate, duration_text(std::max(left, 0.) / progress->rate));
  }
  for (const auto& [name, value] : progress->monitored) line += " · " + monitored_text(name, value);
  return line;
}

ProgressView::ProgressView(std::FILE* out)
    : out_(out),
      terminal_(::isatty(::fileno(out)) == 1),
      last_(std::chrono::steady_clock::now() - between_plain_lines) {}

ProgressView::~ProgressView() { clear(); }

// fputs and not fmt::print: a terminal that has gone is no reason to end a run.
void ProgressView::show(const std::string& line) {
  if (terminal_) {
    clear();
    std::fputs(fitted(line, terminal_width(out_)).c_str(), out_);
    line_open_ = true;
  } else {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < between_plain_lines) return;
    last_ = now;
    std::fputs((line + "\n").c_str(), out_);
  }
  std::fflush(out_);
}

void ProgressView::say(const std::string& line) {
  clear();
  std::fputs((line + "\n").c_str(), out_);
  std::fflush(out_);
}

void ProgressView::clear() {
  if (!line_open_) return;
  std::fputs("\r\033[K", out_);
  line_open_ = false;
}

}  // namespace cupola
