#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "orchestrator/report/stage_report.hpp"

namespace cupola {

/// A source of error that more computing makes smaller.
struct ErrorSource {
  enum class Law {
    statistics,   ///< falls with the square root of the time spent
    first_order,  ///< falls with the time spent: half the step costs twice as much
    contraction,  ///< falls by `factor` with every `wall` seconds: the alternation
  };
  std::string name;  ///< for people
  std::string cure;  ///< what to change, for people
  double error = 0;  ///< relative
  double wall = 0;   ///< s that this error cost so far; of contraction: of one episode
  Law law = Law::statistics;
  double factor = 1;  ///< of contraction
  double floor = 0;   ///< other errors hide what is smaller: it gets no better than this (or than `error`)
  /// The error after so many seconds more.
  [[nodiscard]] double after(double seconds) const;
};

/// `report.accuracy`: how each error fell with the wall time spent on it, and where the next hour would help most.
/// @param report with `episodes`
nlohmann::json accuracy_and_cost(const std::vector<StageReport>& stages, const nlohmann::json& report);

/// The sentence; empty without sources.
std::string where_the_next_hour_helps(const std::vector<ErrorSource>& sources);

}  // namespace cupola
