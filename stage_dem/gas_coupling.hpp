#pragma once
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "physics/gas/bed_gas.hpp"
#include "physics/projection/bed_state.hpp"
#include "stage_dem/dem_gas.hpp"

namespace cupola {

/// The quasi-steady gas of the DEM stage (MODEL 14): the Darcy-Forchheimer flow through the bed as it stands, solved
/// again when the bed has changed, and its force on the parcels,
///     F_i = -sum_c (V_ic/alpha_c) grad p_c - K_i v_i,
/// V_ic the parcel's material volume in cell c, alpha_c the solids fraction there.  The first part over all parcels is
/// minus the integral of grad p over the cells with solids, to round-off (`momentum_residual`).  The second makes the
/// force implicit in the parcel's velocity: K_i = sum_c (V_ic/alpha_c) |grad p_c|/|u_c| with the interstitial gas
/// velocity u, so that a parcel carried along with the gas feels no force; LIGGGHTS evaluates it at every step.  A
/// parcel that moves against the gas, or falls through gas at rest, is damped more: K_i is at least (V_i/alpha) e r(e
/// |v_i - u|) in the cell of its centre, r the drag law's resistance and e the void fraction, which gives the grain's
/// terminal velocity.  Between the two (a fall against a flow of about the same speed) the drag comes out too small, by
/// half at most.  With `dem.gas: frozen` the flow is solved once and kept; the forces follow the parcels in it.
class GasCoupling final : public DemGas {
 public:
  GasCoupling(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, std::vector<double> gas_temperature,
              MPI_Comm communicator);

  /// Solves the flow again where 0.25 s have gone by since the last solution, in which a bed drawn down fast sinks by a
  /// fraction of a parcel, or where the void fraction has changed by more than 0.15, rms over cells with solids.  The
  /// criterion sees the state alone, so that a resumed run decides the same.
  void update(const SolidsOnMesh& solids, const std::vector<Parcel>& owned, double seconds,
              bool in_any_case = false) override;
  [[nodiscard]] std::vector<ParcelForce> forces(const SolidsOnMesh& solids, const std::vector<Parcel>& owned) override;
  [[nodiscard]] double longest_step() const override { return std::numeric_limits<double>::infinity(); }

  /// |sum of forces + integral of grad p over cells with solids| over the sum of |V grad p|, largest of all blocks.
  [[nodiscard]] double momentum_residual() const override { return momentum_residual_; }
  [[nodiscard]] const std::vector<double>& pressure() const override { return pressure_; }
  [[nodiscard]] std::vector<double> velocity() const override;
  /// Flow solves, cells at the void floor, inlets, inertia left out.
  [[nodiscard]] nlohmann::json summary() const override;

  void save(HdfWriter& file) const override;
  void load(const HdfReader& file) override;

 private:
  const BedMesh& mesh_;
  const Campaign& campaign_;
  /// kg/s from the drag law at the parcel's own slip against the gas of the cell.
  [[nodiscard]] double slip_damping(const Parcel& parcel, std::size_t cell, double solids_volume) const;
  [[nodiscard]] double density(std::size_t cell) const;  ///< kg/m3, of the gas

  MPI_Comm communicator_;
  DarcyForchheimer flow_;
  BedState bed_;                     ///< of the last `update`
  std::vector<double> temperature_;  ///< K, all cells
  std::vector<double> void_solved_;  ///< void fraction the last solution saw; empty: none yet
  std::vector<double> pressure_;     ///< Pa
  std::vector<double> gradient_;     ///< Pa/m, cells x 3
  std::vector<double> speed_;        ///< m/s, |interstitial velocity|
  std::vector<double> mass_flux_;    ///< kg/m2/s, cells x 3
  double seconds_since_ = 0;         ///< s of process time since the last solution
  std::int64_t solves_ = 0;
  std::int64_t cells_at_floor_ = 0;
  double momentum_residual_ = 0;
};

}  // namespace cupola
