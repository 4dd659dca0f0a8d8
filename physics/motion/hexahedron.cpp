#include "physics/motion/hexahedron.hpp"

#include <algorithm>
#include <cmath>

namespace cupola {
namespace {

double determinant_of(const std::array<Vector3, 3>& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Solves m x = b by Cramer's rule.
Vector3 solve(const std::array<Vector3, 3>& m, const Vector3& b) {
  const double determinant = determinant_of(m);
  Vector3 x{};
  for (std::size_t column = 0; column < 3; ++column) {
    std::array<Vector3, 3> replaced = m;
    for (std::size_t row = 0; row < 3; ++row) replaced[row][column] = b[row];
    x[column] = determinant_of(replaced) / determinant;
  }
  return x;
}

}  // namespace

Hexahedron::Hexahedron(const BedMesh& mesh, std::size_t cell) {
  const auto corner = [&](std::size_t k, std::size_t i) {
    return mesh.points[static_cast<std::size_t>(mesh.cell_points[cell][k])][i];
  };
  for (std::size_t i = 0; i < 3; ++i) {
    // Corners by (xi, eta, zeta): 0 = 000, 1 = 100, 2 = 110, 3 = 010, 4 = 001, 5 = 101, 6 = 111, 7 = 011.
    const double x000 = corner(0, i);
    const double x100 = corner(1, i);
    const double x110 = corner(2, i);
    const double x010 = corner(3, i);
    const double x001 = corner(4, i);
    const double x101 = corner(5, i);
    const double x111 = corner(6, i);
    const double x011 = corner(7, i);
    coefficient_[0][i] = x000;
    coefficient_[1][i] = x100 - x000;
    coefficient_[2][i] = x010 - x000;
    coefficient_[3][i] = x001 - x000;
    coefficient_[4][i] = (x110 - x010) - (x100 - x000);
    coefficient_[5][i] = (x011 - x001) - (x010 - x000);
    coefficient_[6][i] = (x101 - x001) - (x100 - x000);
    coefficient_[7][i] = ((x111 - x011) - (x101 - x001)) - ((x110 - x010) - (x100 - x000));
  }
}

Vector3 Hexahedron::position(const Vector3& r) const {
  Vector3 x{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto c = [&](std::size_t k) { return coefficient_[k][i]; };
    x[i] = c(0) + r[0] * (c(1) + r[1] * (c(4) + r[2] * c(7)) + r[2] * c(6)) + r[1] * (c(2) + r[2] * c(5)) + r[2] * c(3);
  }
  return x;
}

std::array<Vector3, 3> Hexahedron::jacobian(const Vector3& r) const {
  std::array<Vector3, 3> m{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto c = [&](std::size_t k) { return coefficient_[k][i]; };
    m[i][0] = c(1) + r[1] * c(4) + r[2] * c(6) + r[1] * r[2] * c(7);
    m[i][1] = c(2) + r[0] * c(4) + r[2] * c(5) + r[0] * r[2] * c(7);
    m[i][2] = c(3) + r[1] * c(5) + r[0] * c(6) + r[0] * r[1] * c(7);
  }
  return m;
}

double Hexahedron::determinant(const Vector3& reference) const { return determinant_of(jacobian(reference)); }

Vector3 Hexahedron::reference(const Vector3& wanted) const {
  constexpr int most_iterations = 30;
  Vector3 r{0.5, 0.5, 0.5};
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Vector3 x = position(r);
    const Vector3 step = solve(jacobian(r), {wanted[0] - x[0], wanted[1] - x[1], wanted[2] - x[2]});
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      // The map is folded far outside the cell: stay near it.
      r[i] = std::clamp(r[i] + step[i], -0.5, 1.5);
      largest = std::max(largest, std::abs(step[i]));
    }
    if (largest < 1e-15) break;
  }
  for (double& coordinate : r) coordinate = std::clamp(coordinate, 0.0, 1.0);
  return r;
}

}  // namespace cupola
