#pragma once
#include <vector>

#include "physics/gas/transient_flow.hpp"
#include "physics/turbulence/turbulence.hpp"
#include "stage_dem/dem_gas.hpp"

namespace cupola {

/// `dem.gas: transient`: the gas moves with the bed and gives and takes momentum at each of its steps.  On a parcel
///   F_i = sum_c V_ic (D_c/alpha_c - grad p_c),
/// V_ic its material volume in cell c, alpha_c the solids fraction there, D_c the drag by volume of cell, the very term
/// of the gas's equation: what the parcels get of drag the gas loses, to round-off (`momentum_residual`).  The force is
/// constant over a step of the gas, which is at most a tenth of the shortest time in which drag stops a parcel.
class TransientCoupling final : public DemGas {
 public:
  TransientCoupling(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, std::vector<double> gas_temperature,
                    MPI_Comm communicator);

  /// A step of the gas.  Where parcels came or went since the last one, the gas fills their place or gives it up
  /// without being drawn in or pressed out.
  void update(const SolidsOnMesh& solids, const std::vector<Parcel>& owned, double seconds,
              bool in_any_case = false) override;
  [[nodiscard]] std::vector<ParcelForce> forces(const SolidsOnMesh& solids, const std::vector<Parcel>& owned) override;
  [[nodiscard]] double longest_step() const override;

  /// |drag on the parcels + what the gas got from the solids by its own balance| over the sum of |drag|, largest so
  /// far.
  [[nodiscard]] double momentum_residual() const override { return momentum_residual_; }
  [[nodiscard]] const std::vector<double>& pressure() const override { return flow_.pressure(); }
  [[nodiscard]] std::vector<double> velocity() const override;
  /// Steps, cells at the void floor, largest mass residual, inlets; the turbulence, where there is one.
  [[nodiscard]] nlohmann::json summary() const override;

  void save(HdfWriter& file) const override;
  void load(const HdfReader& file) override;

  [[nodiscard]] const TransientFlow& flow() const { return flow_; }
  [[nodiscard]] const Turbulence* turbulence() const { return turbulence_.get(); }

 private:
  const BedMesh& mesh_;
  const Campaign& campaign_;
  MPI_Comm communicator_;
  TransientFlow flow_;
  std::unique_ptr<Turbulence> turbulence_;  ///< null: laminar
  std::vector<double> temperature_;         ///< K, all cells
  double solids_volume_ = -1;               ///< m3 in the mesh at the last step; negative: none yet
  double last_step_ = 0;                    ///< s
  double stopping_time_ = 0;                ///< s, least over the cells: mass over drag coefficient; 0: none known
  std::int64_t steps_ = 0;
  std::int64_t cells_at_floor_ = 0;
  double mass_residual_ = 0;
  double momentum_residual_ = 0;
};

}  // namespace cupola
