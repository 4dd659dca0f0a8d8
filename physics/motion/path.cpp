#include "physics/motion/path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/motion/exponentials.hpp"
#include "physics/motion/hexahedron.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Stays of no time in a row after which a path is running round an edge.
constexpr int most_idle_crossings = 16;

/// Abscissae and weights of the eight-point Gauss-Legendre rule on [0,1], lower half.
constexpr std::array<std::array<double, 2>, 4> gauss_points{{{0.019855071751231884, 0.050614268145188130},
                                                             {0.10166676129318663, 0.11119051722668724},
                                                             {0.23723379504183550, 0.15685332293894364},
                                                             {0.40828267875217510, 0.18134189168918100}}};

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

/// Reference coordinate after a pseudo-time, from the rate there and the change of the rate along the axis.
double moved(double coordinate, double rate, double change, double pseudo) {
  return coordinate + rate * pseudo * expm1_over(change * pseudo);
}

/// Whether |J| is linear in zeta and constant in xi and eta.
bool has_linear_volume(const Hexahedron& shape) {
  const double lower = shape.determinant({0, 0, 0});
  const double upper = shape.determinant({0, 0, 1});
  for (const double xi : {0.0, 0.5, 1.0}) {
    for (const double eta : {0.0, 0.5, 1.0}) {
      for (const double zeta : {0.0, 0.5, 1.0}) {
        const double linear = lower + zeta * (upper - lower);
        if (std::abs(shape.determinant({xi, eta, zeta}) - linear) > 1e-12 * std::abs(lower + upper)) return false;
      }
    }
  }
  return true;
}

/// The neighbour's opposite face must be this one, with the other two axes running alike.
void check_axes(const BedMesh& mesh, std::int64_t cell, std::size_t side, std::int64_t neighbour, std::int64_t face) {
  const std::int64_t partner = mesh.face_partner[index(face)];
  const std::int64_t seen = mesh.cell_faces[index(neighbour)][side ^ 1U];
  if (seen != (partner >= 0 ? partner : face)) {
    throw Failure(
        ExitCode::wrong_input,
        fmt::format("the reference axes of cells {} and {} do not agree; prepare the task again", cell, neighbour))
        .at("cell", std::to_string(cell));
  }
}

}  // namespace

struct PathField::Exit {
  Vector3 rate{};                         ///< d reference/d tau at the point
  Vector3 straight{never, never, never};  ///< pseudo-time to the face ahead at the present rate; never: not reached
  Vector3 least{never, never, never};     ///< no more than the pseudo-time to the face ahead
  std::size_t first = 0;                  ///< axis of the smallest of them
  double pseudo = never;                  ///< pseudo-time to the nearest exit
  std::size_t axis = 0;
  bool upper = false;  ///< through the face at 1
};

PathField::PathField(const BedMesh& mesh, const std::vector<double>& face_flux, const std::vector<double>& storage)
    : mesh_(mesh), cells_(mesh.cells()) {
  if (face_flux.size() != mesh.faces() || storage.size() != mesh.cells()) {
    throw Failure(ExitCode::wrong_input,
                  fmt::format("{} fluxes and {} storage values on a mesh of {} faces and {} cells", face_flux.size(),
                              storage.size(), mesh.faces(), mesh.cells()));
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    Cell& cell = cells_[c];
    const auto number = static_cast<std::int64_t>(c);
    if (!(storage[c] > 0) || !std::isfinite(storage[c])) {
      throw Failure(ExitCode::wrong_input, fmt::format("storage {} in cell {} must be positive", storage[c], c))
          .at("cell", std::to_string(c));
    }
    for (std::size_t side = 0; side < 6; ++side) {
      const std::int64_t face = mesh.cell_faces[c][side];
      const std::int64_t neighbour = mesh.across(number, face);
      if (neighbour >= 0) check_axes(mesh, number, side, neighbour, face);
      cell.neighbour[side] = static_cast<std::int32_t>(neighbour);
      // Both cells at a periodic pair read the flux of one of its faces, so that they agree to the last digit.
      const std::int64_t partner = mesh.face_partner[index(face)];
      const bool read_partner = partner >= 0 && partner < face;
      const double outward = read_partner                             ? -face_flux[index(partner)]
                             : mesh.face_owner[index(face)] == number ? face_flux[index(face)]
                                                                      : -face_flux[index(face)];
      const std::size_t axis = side / 2;
      if (side % 2 == 0) {
        cell.flux[axis] = -outward;
      } else {
        cell.change[axis] = outward - cell.flux[axis];
      }
    }
    const Hexahedron shape(mesh, c);
    cell.storage = storage[c];
    cell.linear_volume = has_linear_volume(shape);
    cell.storage_volume = storage[c] * shape.determinant({0, 0, 0});
    cell.storage_volume_change = storage[c] * shape.determinant({0, 0, 1}) - cell.storage_volume;
  }
}

Vector3 PathField::position(const Point& point) const {
  return Hexahedron(mesh_, index(point.cell)).position(point.reference);
}

PathField::Point PathField::locate_in(std::int64_t cell, const Vector3& position) const {
  Vector3 inside = position;
  if (mesh_.periodic_depth > 0) {
    inside[1] -=
        mesh_.periodic_depth * std::round((position[1] - mesh_.cell_centre[index(cell)][1]) / mesh_.periodic_depth);
  }
  return {cell, Hexahedron(mesh_, index(cell)).reference(inside)};
}

Vector3 PathField::velocity(const Point& point) const {
  const Cell& cell = cells_[index(point.cell)];
  const Hexahedron shape(mesh_, index(point.cell));
  const auto jacobian = shape.jacobian(point.reference);
  const double divisor = cell.storage * shape.determinant(point.reference);
  Vector3 velocity{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      velocity[i] += jacobian[i][axis] * (cell.flux[axis] + cell.change[axis] * point.reference[axis]) / divisor;
    }
  }
  return velocity;
}

double PathField::crossing_time(std::int64_t number) const {
  const Cell& cell = cells_[index(number)];
  double through = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    through += std::abs(cell.flux[axis]) + std::abs(cell.flux[axis] + cell.change[axis]);
  }
  return through > 0 ? cell.storage * mesh_.cell_volume[index(number)] / (through / 2) : never;
}

PathField::Exit PathField::look_ahead(const Cell& cell, const Vector3& reference) {
  Exit exit;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double change = cell.change[axis];
    const double rate = cell.flux[axis] + change * reference[axis];
    exit.rate[axis] = rate;
    // A face whose flux does not lead out is never reached: the path slows down in front of it.
    const bool leads_out = rate > 0 ? cell.flux[axis] + change > 0 : rate < 0 && cell.flux[axis] < 0;
    if (!leads_out) continue;
    const double straight = ((rate > 0 ? 1.0 : 0.0) - reference[axis]) / rate;
    exit.straight[axis] = straight;
    // log(1 + z)/z >= 2/(2 + z): most axes are ruled out without a logarithm.
    exit.least[axis] = 2 * straight / (2 + change * straight);
    if (exit.least[axis] < exit.least[exit.first]) exit.first = axis;
  }
  return exit;
}

void PathField::find_exit(const Cell& cell, Exit& exit) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t axis = (exit.first + k) % 3;
    if (!(exit.least[axis] < exit.pseudo)) continue;
    const double pseudo = exit.straight[axis] * log1p_over(cell.change[axis] * exit.straight[axis]);
    if (pseudo < exit.pseudo) {
      exit.pseudo = pseudo;
      exit.axis = axis;
      exit.upper = exit.rate[axis] > 0;
    }
  }
}

double PathField::elapsed(std::size_t number, const Vector3& reference, const Vector3& rate, double pseudo) const {
  const Cell& cell = cells_[number];
  if (cell.linear_volume) {
    const double zeta_integral =
        pseudo * (reference[2] + rate[2] * pseudo * expm1_less_linear_over_square(cell.change[2] * pseudo));
    return cell.storage_volume * pseudo + cell.storage_volume_change * zeta_integral;
  }
  const Hexahedron shape(mesh_, number);
  double sum = 0;
  for (const auto& [abscissa, weight] : gauss_points) {
    for (const double share : {abscissa, 1 - abscissa}) {
      Vector3 on_path{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        on_path[axis] = moved(reference[axis], rate[axis], cell.change[axis], share * pseudo);
      }
      sum += weight * shape.determinant(on_path);
    }
  }
  return cell.storage * sum * pseudo;
}

double PathField::pseudo_time(std::size_t number, const Vector3& reference, const Exit& exit, double seconds) const {
  // The elapsed time rises with the pseudo-time at the rate storage |J| > 0: Newton's method with the bracket kept.
  const Cell& cell = cells_[number];
  constexpr int most_iterations = 60;
  const double here = cell.storage_volume + cell.storage_volume_change * reference[2];
  double pseudo = seconds / here;
  if (cell.linear_volume && cell.storage_volume_change == 0) return std::min(pseudo, exit.pseudo);
  double least = 0;
  double most = exit.pseudo;
  // To second order, where that is a small correction.
  const double correction = 0.5 * cell.storage_volume_change * exit.rate[2] * pseudo / here;
  if (std::abs(correction) < 0.1) pseudo *= 1 - correction;
  pseudo = std::min(most, pseudo);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    double error = 0;
    double volume = 0;
    if (cell.linear_volume) {
      const double z = cell.change[2] * pseudo;
      const double curve = expm1_less_linear_over_square(z);
      const double path = exit.rate[2] * pseudo;
      error = pseudo * (cell.storage_volume + cell.storage_volume_change * (reference[2] + path * curve)) - seconds;
      volume = here + cell.storage_volume_change * path * (1 + z * curve);
    } else {
      error = elapsed(number, reference, exit.rate, pseudo) - seconds;
      Vector3 there{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        there[axis] = moved(reference[axis], exit.rate[axis], cell.change[axis], pseudo);
      }
      volume = cell.storage * Hexahedron(mesh_, number).determinant(there);
    }
    (error > 0 ? most : least) = pseudo;
    double next = pseudo - error / volume;
    if (!(next >= least && next <= most)) next = std::isfinite(most) ? (least + most) / 2 : 2 * pseudo;
    // Newton's step squares the error: one smaller than this leaves nothing but round-off.
    const bool settled = std::abs(next - pseudo) <= 1e-9 * next;
    pseudo = next;
    if (settled) break;
  }
  return pseudo;
}

template <typename Visit>
PathField::End PathField::follow(Point& point, double seconds, const Visit& visit) const {
  // Sets the rates of the exit; whether the path cannot reach a face within a pseudo-time.
  const auto stays_inside = [](const Cell& cell, const Vector3& reference, double pseudo, Exit& exit) {
    bool inside = pseudo > 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double change = cell.change[axis];
      const double rate = cell.flux[axis] + change * reference[axis];
      exit.rate[axis] = rate;
      // The rate on the way to the face ahead is between that here and that at the face.
      const double upwards = std::max(rate, cell.flux[axis] + change) * pseudo;
      const double downwards = -std::min(rate, cell.flux[axis]) * pseudo;
      inside = inside && (rate > 0 ? upwards < 1 - reference[axis] : downwards < reference[axis]);
    }
    exit.pseudo = pseudo;
    return inside;
  };
  double left = seconds;
  int idle_crossings = 0;
  while (left > 0) {
    const std::size_t number = index(point.cell);
    const Cell& cell = cells_[number];
    Exit exit;
    // No more pseudo-time than this is left.
    const double most =
        cell.linear_volume ? left / (cell.storage_volume + std::min(0.0, cell.storage_volume_change)) : 0;
    // Most stays end inside the cell, which shows at once.
    const bool inside = stays_inside(cell, point.reference, most, exit);
    if (!inside) exit = look_ahead(cell, point.reference);
    const bool stands = exit.rate[0] == 0 && exit.rate[1] == 0 && exit.rate[2] == 0;
    if (stands || idle_crossings > most_idle_crossings) {
      fallbacks_ += stands ? 0 : 1;
      visit(point.cell, left);
      return End::stagnant;
    }
    double to_exit = never;
    // Many more show without a logarithm.
    if (!inside && !(cell.linear_volume && exit.least[exit.first] > most)) {
      find_exit(cell, exit);
      if (exit.pseudo < never) to_exit = elapsed(number, point.reference, exit.rate, exit.pseudo);
    }
    const bool leaves = to_exit <= left;
    const double pseudo = leaves ? exit.pseudo : pseudo_time(number, point.reference, exit, left);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point.reference[axis] =
          std::clamp(moved(point.reference[axis], exit.rate[axis], cell.change[axis], pseudo), 0.0, 1.0);
    }
    const double stay = leaves ? to_exit : left;
    if (stay > 0) visit(point.cell, stay);
    if (!leaves) return End::time_up;
    left -= to_exit;
    idle_crossings = to_exit > 0 ? 0 : idle_crossings + 1;
    const std::int32_t next = cell.neighbour[2 * exit.axis + (exit.upper ? 1 : 0)];
    point.reference[exit.axis] = exit.upper ? 1 : 0;
    if (next < 0) return End::left_through_outflow;
    point.cell = next;
    point.reference[exit.axis] = exit.upper ? 0 : 1;
  }
  return End::time_up;
}

PathField::End PathField::advance(Point& point, double seconds, void (*residence)(void*, std::int64_t, double),
                                  void* context) const {
  if (residence == nullptr) return follow(point, seconds, [](std::int64_t, double) {});
  return follow(point, seconds, [&](std::int64_t cell, double stay) { residence(context, cell, stay); });
}

PathField::End PathField::advance(Point& point, double seconds, std::vector<Stay>& stays) const {
  return follow(point, seconds, [&](std::int64_t cell, double stay) {
    stays.push_back({static_cast<std::int32_t>(cell), stay});
  });
}

double PathField::lowest(std::int64_t cell) const {
  double lowest = never;
  for (const std::int64_t corner : mesh_.cell_points[index(cell)]) {
    lowest = std::min(lowest, mesh_.points[index(corner)][2]);
  }
  return lowest;
}

}  // namespace cupola
