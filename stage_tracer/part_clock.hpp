#pragma once
#include <chrono>
#include <map>
#include <string>
#include <utility>

namespace cupola {

/// Wall time by part of the stage.
class PartClock {
 public:
  /// Counts the time from its making to its end for a part.
  class Running {
   public:
    Running(PartClock& clock, std::string part)
        : clock_(clock), part_(std::move(part)), begin_(std::chrono::steady_clock::now()) {}
    ~Running() {
      clock_.seconds_[part_] += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    Running(Running&&) = delete;
    Running& operator=(Running&&) = delete;

   private:
    PartClock& clock_;
    std::string part_;
    std::chrono::steady_clock::time_point begin_;
  };

  [[nodiscard]] Running measure(const std::string& part) { return {*this, part}; }
  [[nodiscard]] const std::map<std::string, double>& seconds() const { return seconds_; }
  /// Counts what was measured in another way.
  void add(const std::string& part, double seconds) { seconds_[part] += seconds; }
  /// Goes on from what an earlier start of the task has spent.
  void restore(std::map<std::string, double> seconds) { seconds_ = std::move(seconds); }

 private:
  std::map<std::string, double> seconds_;
};

}  // namespace cupola
