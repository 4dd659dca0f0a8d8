#include "stage_tracer/network.hpp"

#include <algorithm>
#include <cmath>

#include "schemas/failure.hpp"

namespace cupola {
std::vector<double> network_inflow(const std::vector<Link>& links, const std::vector<double>& x) {
  std::vector<double> inflow(x.size(), 0.0);
  for (const Link& link : links) {
    const double flow = link.conductance * (x[link.second] - x[link.first]);
    inflow[link.first] += flow;
    inflow[link.second] -= flow;
  }
  return inflow;
}

int solve_network(const std::vector<Link>& links, const std::vector<double>& diagonal,
                  const std::vector<double>& source, std::vector<double>& x, double tolerance, int most_iterations) {
  const std::size_t nodes = x.size();
  std::vector<double> inverse = diagonal;
  for (const Link& link : links) {
    inverse[link.first] += link.conductance;
    inverse[link.second] += link.conductance;
  }
  for (double& value : inverse) value = value > 0 ? 1 / value : 0;
  std::vector<double> applied(nodes);
  const auto apply = [&](const std::vector<double>& v) {
    for (std::size_t i = 0; i < nodes; ++i) applied[i] = diagonal[i] * v[i];
    for (const Link& link : links) {
      const double flow = link.conductance * (v[link.second] - v[link.first]);
      applied[link.first] -= flow;
      applied[link.second] += flow;
    }
  };
  apply(x);
  std::vector<double> residual(nodes), direction(nodes);
  double rz = 0;
  double largest = 0;  // of the corrections that the diagonal alone would make
  for (std::size_t i = 0; i < nodes; ++i) {
    residual[i] = inverse[i] > 0 ? source[i] - applied[i] : 0;
    direction[i] = residual[i] * inverse[i];
    rz += residual[i] * direction[i];
    largest = std::max(largest, std::abs(direction[i]));
  }
  for (int iteration = 0; iteration <= most_iterations; ++iteration) {
    if (largest <= tolerance) return iteration;
    apply(direction);
    double curvature = 0;
    for (std::size_t i = 0; i < nodes; ++i) curvature += direction[i] * applied[i];
    const double length = rz / curvature;
    double next = 0;
    largest = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
      x[i] += length * direction[i];
      residual[i] -= length * applied[i];
      const double z = residual[i] * inverse[i];
      next += residual[i] * z;
      largest = std::max(largest, std::abs(z));
    }
    const double ratio = next / rz;
    for (std::size_t i = 0; i < nodes; ++i) direction[i] = residual[i] * inverse[i] + ratio * direction[i];
    rz = next;
  }
  throw Failure(ExitCode::diverged, "conduction in the solids did not converge; shorten tracer.time_step");
}

}  // namespace cupola
