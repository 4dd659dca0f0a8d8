#include "physics/mesh/wall_triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "schemas/files.hpp"

namespace cupola {
namespace {

/// Longest leg of the quadrilaterals that are cut along their shorter diagonal: the cut is then shorter than 0.5 m.
constexpr double longest_leg = 0.35;

int pieces(double length) { return std::max(1, static_cast<int>(std::ceil(length / longest_leg - 1e-9))); }

double distance(const Vector3& a, const Vector3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

/// A level of the wall: height and half width.
struct Ring {
  double z = 0;
  double half_width = 0;
};

std::vector<Ring> rings(const Campaign& campaign) {
  std::vector<Ring> corners;
  for (const auto& corner : campaign.scene.geometry.profile) corners.push_back({corner[0], corner[1]});
  if (campaign.hopper_top() > campaign.top()) corners.push_back({campaign.hopper_top(), corners.back().half_width});
  std::vector<Ring> all{corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Ring& from = corners[i - 1];
    const Ring& to = corners[i];
    const int count = pieces(std::hypot(to.z - from.z, to.half_width - from.half_width));
    for (int k = 1; k < count; ++k) {
      const double share = static_cast<double>(k) / count;
      all.push_back({from.z + share * (to.z - from.z), from.half_width + share * (to.half_width - from.half_width)});
    }
    all.push_back(to);
  }
  return all;
}

class Surface {
 public:
  explicit Surface(const Campaign& campaign) : rings_(rings(campaign)), depth_(campaign.scene.geometry.depth) {
    const auto widest = std::max_element(rings_.begin(), rings_.end(),
                                         [](const Ring& a, const Ring& b) { return a.half_width < b.half_width; });
    across_ = 2 * pieces(widest->half_width);
    along_ = pieces(depth_);
    add_sides();
    add_bottom();
    if (campaign.scene.geometry.sides == Geometry::Sides::walls) add_front_and_back();
  }

  std::vector<Triangle> triangles;

 private:
  [[nodiscard]] double y(int slice) const { return depth_ * (static_cast<double>(slice) / along_ - 0.5); }
  [[nodiscard]] double x(int column, const Ring& ring) const {
    return ring.half_width * (2.0 * column / across_ - 1.0);
  }

  void add(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    if (distance(a, c) <= distance(b, d)) {
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    } else {
      triangles.push_back({a, b, d});
      triangles.push_back({b, c, d});
    }
  }

  void add_sides() {
    for (std::size_t k = 0; k + 1 < rings_.size(); ++k) {
      const Ring& low = rings_[k];
      const Ring& high = rings_[k + 1];
      for (int j = 0; j < along_; ++j) {
        const double front = y(j);
        const double back = y(j + 1);
        add({-low.half_width, front, low.z}, {-high.half_width, front, high.z}, {-high.half_width, back, high.z},
            {-low.half_width, back, low.z});
        add({low.half_width, front, low.z}, {low.half_width, back, low.z}, {high.half_width, back, high.z},
            {high.half_width, front, high.z});
      }
    }
  }

  void add_bottom() {
    const Ring& low = rings_.front();
    for (int i = 0; i < across_; ++i) {
      for (int j = 0; j < along_; ++j) {
        add({x(i, low), y(j), low.z}, {x(i, low), y(j + 1), low.z}, {x(i + 1, low), y(j + 1), low.z},
            {x(i + 1, low), y(j), low.z});
      }
    }
  }

  void add_front_and_back() {
    for (std::size_t k = 0; k + 1 < rings_.size(); ++k) {
      const Ring& low = rings_[k];
      const Ring& high = rings_[k + 1];
      for (int i = 0; i < across_; ++i) {
        for (const int side : {0, along_}) {
          const Vector3 a{x(i, low), y(side), low.z};
          const Vector3 b{x(i + 1, low), y(side), low.z};
          const Vector3 c{x(i + 1, high), y(side), high.z};
          const Vector3 d{x(i, high), y(side), high.z};
          side == 0 ? add(a, b, c, d) : add(a, d, c, b);
        }
      }
    }
  }

  std::vector<Ring> rings_;
  double depth_;
  int across_ = 2;  ///< pieces from wall to wall, the same on every ring
  int along_ = 1;   ///< pieces along the depth
};

Vector3 unit_normal(const Triangle& t) {
  const auto edge = [&](std::size_t i) { return Vector3{t[i][0] - t[0][0], t[i][1] - t[0][1], t[i][2] - t[0][2]}; };
  const Vector3 u = edge(1);
  const Vector3 v = edge(2);
  const Vector3 n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  const double length = std::hypot(n[0], n[1], n[2]);
  return {n[0] / length, n[1] / length, n[2] / length};
}

}  // namespace

std::vector<Triangle> wall_triangles(const Campaign& campaign) { return Surface(campaign).triangles; }

void write_stl(const std::filesystem::path& file, const std::vector<Triangle>& triangles) {
  std::string text = "solid wall\n";
  for (const Triangle& triangle : triangles) {
    const Vector3 normal = unit_normal(triangle);
    fmt::format_to(std::back_inserter(text), "facet normal {} {} {}\n outer loop\n", normal[0], normal[1], normal[2]);
    for (const Vector3& corner : triangle) {
      fmt::format_to(std::back_inserter(text), "  vertex {} {} {}\n", corner[0], corner[1], corner[2]);
    }
    text += " endloop\nendfacet\n";
  }
  write_text_atomically(file, text + "endsolid wall\n");
}

}  // namespace cupola
