#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "physics/equations/face_geometry.hpp"
#include "physics/projection/bed_state.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// Tangents of the drag law in every cell, in terms of psi = p^2/2:  -grad psi = (value + slope (|G| - speed)) G.
class DragTangents {
 public:
  DragTangents(const BedMesh& mesh, const Gas& gas, DragLaw law) : mesh_(mesh), gas_(gas), law_(law) {}

  /// Tangents at the mass fluxes `speed` (kg/m2/s) of the cells.  Cells without solids get the least resistance: 1e-4
  /// of the mean of the others, so that the equations stay well conditioned.
  /// @throws Failure diverged: a cell without gas, a temperature that is not positive, no solids in any cell
  void update(const BedState& bed, const std::vector<double>& gas_temperature, const std::vector<double>& speed,
              double usual_speed);

  struct Value {
    double value = 0;     ///< 1/s
    double increase = 0;  ///< derivative by ln(normal flux), 1/s
  };
  /// At the cell's own mass flux.
  [[nodiscard]] double at_cell(std::int64_t cell) const { return std::max(tangents_[cell].value, least_); }
  /// Where |G| is `speed`, of which `normal_flux` is normal to a face.
  [[nodiscard]] Value at(std::int64_t cell, double speed, double normal_flux) const;

 private:
  struct Tangent {
    double value = 0;  ///< 1/s
    double slope = 0;  ///< m2/kg
    double speed = 0;  ///< kg/m2/s
  };
  const BedMesh& mesh_;
  const Gas& gas_;
  DragLaw law_;
  std::vector<Tangent> tangents_;
  double least_ = 0;
};

/// A cell with less solids than this counts as empty.
inline constexpr double empty_solids_fraction = 1e-6;

}  // namespace cupola
