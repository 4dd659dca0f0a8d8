#include "stage_tracer/network.hpp"

#include <algorithm>
#include <cmath>

#include "schemas/failure.hpp"

namespace cupola {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

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
  std::vector<double> full = diagonal;
  for (const Link& link : links) {
    full[link.first] += link.conductance;
    full[link.second] += link.conductance;
  }
  const auto apply = [&](const std::vector<double>& v) {
    std::vector<double> result = network_inflow(links, v);
    for (std::size_t i = 0; i < v.size(); ++i) result[i] = diagonal[i] * v[i] - result[i];
    return result;
  };
  const auto precondition = [&](const std::vector<double>& r) {
    std::vector<double> z(r.size(), 0.0);
    for (std::size_t i = 0; i < r.size(); ++i) z[i] = full[i] > 0 ? r[i] / full[i] : 0;
    return z;
  };
  std::vector<double> residual = apply(x);
  for (std::size_t i = 0; i < x.size(); ++i) residual[i] = full[i] > 0 ? source[i] - residual[i] : 0;
  std::vector<double> z = precondition(residual);
  std::vector<double> direction = z;
  double rz = dot(residual, z);
  for (int iteration = 0; iteration <= most_iterations; ++iteration) {
    const double largest = z.empty() ? 0 : std::abs(*std::max_element(z.begin(), z.end(), [](double a, double b) {
      return std::abs(a) < std::abs(b);
    }));
    if (largest <= tolerance) return iteration;
    const std::vector<double> applied = apply(direction);
    const double length = rz / dot(direction, applied);
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += length * direction[i];
      residual[i] -= length * applied[i];
    }
    z = precondition(residual);
    const double next = dot(residual, z);
    for (std::size_t i = 0; i < x.size(); ++i) direction[i] = z[i] + next / rz * direction[i];
    rz = next;
  }
  throw Failure(ExitCode::diverged, "conduction in the solids did not converge; shorten tracer.time_step");
}

}  // namespace cupola
