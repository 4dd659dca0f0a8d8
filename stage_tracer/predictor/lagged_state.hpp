#pragma once
#include <optional>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "stage_tracer/predictor/anderson.hpp"
#include "stage_tracer/predictor/steady_heat.hpp"

namespace cupola {

/// What the predictor holds while it looks for temperatures: all that flux, streamlines, composition and gas flow are
/// made from.  The prediction is its fixed point.
struct LaggedState {
  std::vector<double> gas;    ///< K, all cells: for the resistances and the exchange
  CellContents contents;      ///< for the composition
  std::vector<double> share;  ///< f, all cells: for the granular flux
};

/// Carries the lagged state towards its fixed point.  Near a balance of heat-capacity flows a little gas more in one
/// column moves its zone by metres, and a hotter column lets less gas through: turns that take over all that came out
/// swing.  Anderson's acceleration, on shortened steps, finds out how much to take of each.
class LaggedIteration {
 public:
  /// Keeps references. @param lowest, highest K that any temperature can have  @param least_share of f
  LaggedIteration(const BedMesh& mesh, const std::vector<bool>& bed, double lowest, double highest, double least_share)
      : mesh_(mesh), bed_(bed), lowest_(lowest), highest_(highest), least_share_(least_share) {}

  /// @param state what was held; becomes what is to be held next  @param result what came out of it
  void advance(LaggedState& state, const LaggedState& result);
  /// Forgets what was learnt: the equations have changed.
  void begin_anew() { acceleration_.reset(); }

 private:
  [[nodiscard]] std::vector<double> flat(const LaggedState& state) const;

  const BedMesh& mesh_;
  const std::vector<bool>& bed_;
  double lowest_, highest_, least_share_;
  std::optional<Anderson> acceleration_;
};

}  // namespace cupola
