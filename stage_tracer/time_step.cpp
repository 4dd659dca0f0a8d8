#include "stage_tracer/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cupola {
namespace {

constexpr double first_part = 0.2;
constexpr double longest_part = 0.5;
constexpr double shortest_part = 0.1;
constexpr double part_of_duration = 0.01;  // first step of a bed at rest
constexpr double faster_volume = 0.1;

/// Crossing time that `faster_volume` of the moving bed falls below, s.
double crossing_time(const BedMesh& mesh, const GranularField& field, const PathField& paths) {
  std::vector<double> residence(mesh.cells());
  std::vector<std::size_t> moving;
  double volume = 0;
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    if (!field.bed[c] || field.stagnant[c]) continue;
    residence[c] = paths.crossing_time(static_cast<std::int64_t>(c));
    moving.push_back(c);
    volume += mesh.cell_volume[c];
  }
  std::sort(moving.begin(), moving.end(), [&](std::size_t a, std::size_t b) { return residence[a] < residence[b]; });
  double passed = 0;
  for (const std::size_t c : moving) {
    passed += mesh.cell_volume[c];
    if (passed >= faster_volume * volume) return residence[c];
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

TimeSteps fill_with_steps(double duration, double longest) {
  TimeSteps steps;
  steps.count = std::max(1L, static_cast<long>(std::ceil(duration / longest - 1e-9)));
  steps.length = duration / static_cast<double>(steps.count);
  return steps;
}

StepLimits step_limits(const BedMesh& mesh, const Campaign& campaign, const GranularField& field,
                       const PathField& paths, const ChargePlan* charge) {
  const double passage = charge != nullptr
                             ? std::min(crossing_time(mesh, field, paths), charge->thinnest_layer_seconds())
                             : campaign.tracer.longest() * part_of_duration / first_part;
  return {first_part * passage, shortest_part * passage, longest_part * passage};
}

}  // namespace cupola
