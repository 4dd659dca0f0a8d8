#include "orchestrator/quantity_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace cupola {
namespace {

struct Label {
  const char* words;
  const char* format;
};

const std::map<std::string, Label>& labels() {
  static const std::map<std::string, Label> all = {
      {"mean_solid_temperature", {"mean solids", "{:.0f} K"}},
      {"cohesive_zone_height", {"zone", "{:.2f} m"}},
      {"top_gas_temperature", {"top gas", "{:.0f} K"}},
      {"parcels", {"parcels", "{:.0f}"}},
      {"tracers", {"tracers", "{:.0f}"}},
      {"stock_height", {"stock", "{:.2f} m"}},
      {"largest_overlap", {"overlap", "{:.3f}"}},
      {"mean_speed", {"speed", "{:.2g} m/s"}},
  };
  return all;
}

}  // namespace

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  constexpr double minute = 60, hour = 3600, day = 86400;
  if (seconds < 10) return fmt::format("{:.2g} s", seconds);
  if (seconds < 2 * minute) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2 * hour) return fmt::format("{:.3g} min", seconds / minute);
  if (seconds < 2 * day) return fmt::format("{:.3g} h", seconds / hour);
  return fmt::format("{:.3g} d", seconds / day);
}

std::string counted(long long number, const std::string& what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

std::string monitored_text(const std::string& name, double value) {
  const auto label = labels().find(name);
  if (label == labels().end()) return fmt::format("{} {:.4g}", name, value);
  return fmt::format("{} {}", label->second.words, fmt::format(fmt::runtime(label->second.format), value));
}

}  // namespace cupola
