#pragma once
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include "schemas/files.hpp"
#include "schemas/task.hpp"

namespace cupola {

/// Where a campaign is: what stands before a stage's own progress.
struct StagePlace {
  int episode = 1;
  int at_most = 1;
  TaskKind kind = TaskKind::dem;
  int attempt = 1;
};

/// `episode 2 of at most 8 · tracer · marching · 1.21 h of 5 h · 3400 s/s · ends in 4 min · mean solids 812 K`
std::string progress_line(const StagePlace& place, const std::optional<Progress>& progress);

/// Shows a run to who looks at it: on a terminal one line that is written over, else a plain line every ten seconds.
class ProgressView {
 public:
  explicit ProgressView(std::FILE* out = stdout);
  ~ProgressView();
  ProgressView(const ProgressView&) = delete;
  ProgressView& operator=(const ProgressView&) = delete;
  ProgressView(ProgressView&&) = delete;
  ProgressView& operator=(ProgressView&&) = delete;

  /// The present state; shown at once, later, or not at all.
  void show(const std::string& line);
  /// Something that stays.
  void say(const std::string& line);

 private:
  void clear();

  std::FILE* out_;
  bool terminal_;
  bool line_open_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace cupola
