#pragma once
#include <stdexcept>
#include <string>

namespace cupola {

/// A quantity that cannot be understood: the sentence names what was expected and what stands there.
class UnitError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Value in `si_unit` (udunits spelling, "1" for a plain number) of a text such as `5 h`, `2 mm/s`, `1200 degC`, `1 %`
/// or `0.3`; a number without a unit is SI.  `cell`, `sigma` and `episode` are criteria of a campaign, counted, not
/// converted.
/// @throws UnitError not a number, unknown unit, wrong dimension (names both), not finite
double to_si(const std::string& text, const std::string& si_unit);

/// What a unit measures, with an example: `time (like 5 s)`.
std::string describe_unit(const std::string& si_unit);

}  // namespace cupola
