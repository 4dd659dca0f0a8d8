#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "physics/mesh/foam_dictionaries.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

using BlockFace = std::array<std::size_t, 4>;  ///< vertices, seen from outside against the clock

/// Vertices in the planes x = -half width, 0, half width of every level and section.
class Blocks {
 public:
  Blocks(const Campaign& campaign, const MeshCounts& counts) : campaign_(campaign), counts_(counts) {
    collect_patches();
  }

  [[nodiscard]] std::string text() const {
    return foam_file_head("blockMeshDict") + "scale 1;\n\n" + vertices() + blocks() + "edges ( );\n\n" + patches() +
           "mergePatchPairs ( );\n";
  }

 private:
  [[nodiscard]] std::size_t levels() const { return counts_.levels.size(); }
  [[nodiscard]] std::size_t sections() const { return counts_.sections.size(); }
  [[nodiscard]] std::size_t vertex(std::size_t plane, std::size_t section, std::size_t level) const {
    return (level * sections() + section) * 3 + plane;
  }

  [[nodiscard]] std::string vertices() const {
    std::string text = "vertices\n(\n";
    for (const double z : counts_.levels) {
      const double half_width = campaign_.half_width(z);
      for (const double y : counts_.sections) {
        for (const double x : {-half_width, 0.0, half_width}) text += fmt::format("    ({} {} {})\n", x, y, z);
      }
    }
    return text + ");\n\n";
  }

  [[nodiscard]] std::string blocks() const {
    std::string text = "blocks\n(\n";
    for (std::size_t k = 0; k + 1 < levels(); ++k) {
      for (std::size_t j = 0; j + 1 < sections(); ++j) {
        for (std::size_t i = 0; i < 2; ++i) {
          text += fmt::format("    hex ({} {} {} {} {} {} {} {}) ({} {} {}) simpleGrading (1 1 1)\n", vertex(i, j, k),
                              vertex(i + 1, j, k), vertex(i + 1, j + 1, k), vertex(i, j + 1, k), vertex(i, j, k + 1),
                              vertex(i + 1, j, k + 1), vertex(i + 1, j + 1, k + 1), vertex(i, j + 1, k + 1),
                              counts_.columns, counts_.slices[j], counts_.rows[k]);
        }
      }
    }
    return text + ");\n\n";
  }

  void collect_patches() {
    const std::string bottom = bottom_patch();
    for (std::size_t j = 0; j + 1 < sections(); ++j) {
      for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t top = levels() - 1;
        add(bottom, {vertex(i, j, 0), vertex(i, j + 1, 0), vertex(i + 1, j + 1, 0), vertex(i + 1, j, 0)});
        add("outlet", {vertex(i, j, top), vertex(i + 1, j, top), vertex(i + 1, j + 1, top), vertex(i, j + 1, top)});
      }
    }
    const std::size_t back = sections() - 1;
    for (std::size_t k = 0; k + 1 < levels(); ++k) {
      for (std::size_t j = 0; j + 1 < sections(); ++j) {
        add(side_patch(Inlet::Side::left, j, k),
            {vertex(0, j, k), vertex(0, j, k + 1), vertex(0, j + 1, k + 1), vertex(0, j + 1, k)});
        add(side_patch(Inlet::Side::right, j, k),
            {vertex(2, j, k), vertex(2, j + 1, k), vertex(2, j + 1, k + 1), vertex(2, j, k + 1)});
      }
      for (std::size_t i = 0; i < 2; ++i) {
        add("front", {vertex(i, 0, k), vertex(i + 1, 0, k), vertex(i + 1, 0, k + 1), vertex(i, 0, k + 1)});
        add("back", {vertex(i, back, k), vertex(i, back, k + 1), vertex(i + 1, back, k + 1), vertex(i + 1, back, k)});
      }
    }
  }

  void add(const std::string& patch, const BlockFace& face) { faces_[patch].push_back(face); }

  [[nodiscard]] std::string bottom_patch() const {
    if (campaign_.scene.gas) {
      for (const Inlet& inlet : campaign_.scene.gas->inlets) {
        if (inlet.side == Inlet::Side::bottom) return inlet.name;
      }
    }
    return "bottom";
  }

  /// The inlet that opens this block face of a side wall, or the wall.
  [[nodiscard]] std::string side_patch(Inlet::Side side, std::size_t section, std::size_t level) const {
    const double y = (counts_.sections[section] + counts_.sections[section + 1]) / 2;
    const double z = (counts_.levels[level] + counts_.levels[level + 1]) / 2;
    if (campaign_.scene.gas) {
      for (const Inlet& inlet : campaign_.scene.gas->inlets) {
        if (inlet.side == side && std::abs(y) < inlet.size[0] / 2 && std::abs(z - inlet.z) < inlet.size[1] / 2) {
          return inlet.name;
        }
      }
    }
    return "wall";
  }

  [[nodiscard]] std::string type_of(const std::string& patch) const {
    const bool periodic = campaign_.scene.geometry.sides == Geometry::Sides::periodic;
    if (periodic && patch == "front") return "type cyclic; neighbourPatch back;";
    if (periodic && patch == "back") return "type cyclic; neighbourPatch front;";
    const bool solid = patch == "wall" || patch == "bottom" || patch == "front" || patch == "back";
    return solid ? "type wall;" : "type patch;";
  }

  [[nodiscard]] std::string patches() const {
    std::string text = "boundary\n(\n";
    for (const auto& [name, faces] : faces_) {
      text += fmt::format("    {}\n    {{\n        {}\n        faces\n        (\n", name, type_of(name));
      for (const auto& face : faces) {
        text += fmt::format("            ({} {} {} {})\n", face[0], face[1], face[2], face[3]);
      }
      text += "        );\n    }\n";
    }
    return text + ");\n\n";
  }

  const Campaign& campaign_;
  const MeshCounts& counts_;
  std::map<std::string, std::vector<BlockFace>> faces_;
};

}  // namespace

std::string block_mesh_dictionary(const Campaign& campaign, const MeshCounts& counts) {
  return Blocks(campaign, counts).text();
}

}  // namespace cupola
