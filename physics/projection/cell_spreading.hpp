#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"

namespace cupola {

/// A kernel of one parcel diameter as a linear operator W between cells (MODEL 10).  What a tracer in cell j carries is
/// spread over cells c with the weights W_cj; what it feels of the cells is gathered with the same weights.
///
/// W is a number of equal explicit diffusion passes through the faces (periodic partners included), sum S_c -> S_c +
/// tau sum_f (A/d)_f (S_n/V_n - S_c/V_c), with total 2 tau = D^2/20, the variance along each axis of a uniform sphere
/// of diameter D. Hence: columns sum to 1 (conservative), no weight is negative (tau limited per pass), W_cj V_j = W_jc
/// V_c.  On meshes with cells much larger than D it tends to the identity.
class CellSpreading {
 public:
  /// @param confined_to cells that take part (the bed); elsewhere W is the identity. Empty: all cells.
  /// @param diameter of the sphere whose variance the kernel has, m
  CellSpreading(const BedMesh& mesh, const std::vector<bool>& confined_to, double diameter);

  /// W applied to extensive sums (volume, heat capacity, conductance a cell), in place; the total is unchanged.
  void apply(std::vector<double>& sums) const;
  /// The transpose applied to intensive cell values: result_j = sum_c W_cj value_c, in place.
  void gather(std::vector<double>& values) const;
  /// Weighted mean as a tracer in each cell sees it: sum_c W_cj w_c v_c / sum_c W_cj w_c; v_j where no weight reaches
  /// it.
  [[nodiscard]] std::vector<double> gather(const std::vector<double>& values, const std::vector<double>& weights) const;

  [[nodiscard]] int passes() const { return passes_; }

 private:
  struct Exchange {
    std::int64_t first, second;  ///< cells
    double conductance;          ///< tau A/d of one pass, m3
  };
  std::vector<Exchange> exchanges_;
  std::vector<double> inverse_volume_;
  int passes_ = 0;
  mutable std::vector<double> work_;
};

}  // namespace cupola
