#pragma once
#include <string>

namespace cupola {

/// A duration as a person says it: `42 s`, `7.5 min`, `1.25 h`, `2.1 d`; `?` where it is not finite.
std::string duration_text(double seconds);

/// `1 episode`, `2 episodes`.
std::string counted(long long number, const std::string& what);

/// A monitored quantity with its name and unit: `mean solids 812 K`, `zone 2.43 m`.
/// @param name as in `progress.json`, SI
std::string monitored_text(const std::string& name, double value);

}  // namespace cupola
