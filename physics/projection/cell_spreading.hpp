#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/projection/cells_of_rank.hpp"

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
  /// @param share the ranks' shares of the work; by default this rank does all of it
  CellSpreading(const BedMesh& mesh, const std::vector<bool>& confined_to, double diameter, CellsOfRank share = {});

  /// W applied to extensive sums (volume, heat capacity, conductance a cell), in place; the total is unchanged.
  void apply(std::vector<double>& sums) const { apply({&sums}); }
  /// The same for several arrays together, which costs less than one after the other.
  void apply(const std::vector<std::vector<double>*>& sums) const;
  /// The transpose applied to intensive cell values: result_j = sum_c W_cj value_c, in place.
  void gather(std::vector<double>& values) const { gather({&values}); }
  void gather(const std::vector<std::vector<double>*>& values) const;
  /// Weighted mean as a tracer in each cell sees it: sum_c W_cj w_c v_c / sum_c W_cj w_c; v_j where no weight reaches
  /// it.
  [[nodiscard]] std::vector<double> gather(const std::vector<double>& values, const std::vector<double>& weights) const;

  [[nodiscard]] int passes() const { return passes_; }
  [[nodiscard]] const CellsOfRank& share() const { return share_; }

 private:
  /// What a cell exchanges with its neighbours in one pass; unused places name the cell itself, with 0.
  struct Neighbours {
    std::array<std::int32_t, 6> cell{};
    std::array<double, 6> conductance{};  ///< tau A/d of one pass, m3
    double kept = 1;                      ///< part of the cell's own value that stays
  };
  template <bool spreads>
  void pass(const std::vector<std::vector<double>*>& arrays) const;

  std::vector<Neighbours> neighbours_;
  std::vector<double> inverse_volume_;
  int passes_ = 0;
  CellsOfRank share_;
  mutable std::vector<double> work_;  ///< cells x arrays
};

}  // namespace cupola
