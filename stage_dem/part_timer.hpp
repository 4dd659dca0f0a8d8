#pragma once
#include <chrono>
#include <map>
#include <string>

namespace cupola {

/// Adds the wall time of its life to a part's account.
class PartTimer {
 public:
  PartTimer(std::map<std::string, double>& parts, std::string part)
      : parts_(parts), part_(std::move(part)), begun_(std::chrono::steady_clock::now()) {}
  ~PartTimer() { parts_[part_] += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count(); }
  PartTimer(const PartTimer&) = delete;
  PartTimer& operator=(const PartTimer&) = delete;

 private:
  std::map<std::string, double>& parts_;
  std::string part_;
  std::chrono::steady_clock::time_point begun_;
};

}  // namespace cupola
