#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "physics/gas/bed_gas.hpp"
#include "schemas/campaign.hpp"
#include "schemas/hdf.hpp"

namespace cupola {

/// The steady gas of the tracer stage, by the campaign's gas model: the flow is solved again only where the bed has
/// changed by more than the accuracy asks for, the energy (where there is heat) in every step.  Both start warm; every
/// solve made or skipped is counted.
class GasModel {
 public:
  GasModel(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign);

  /// First flow, on a guessed gas temperature (K, all cells).
  void begin(const BedState& bed, std::vector<double> first_guess);

  /// Solves the flow to a tight tolerance, whatever has changed.
  void solve_flow_tightly(const BedState& bed);

  /// Some warm iterations of the flow at a given temperature (K, all cells), whatever has changed.
  void improve_flow(const BedState& bed, std::vector<double> temperature, double tolerance, int most_iterations) {
    temperature_ = std::move(temperature);
    solve_flow(bed, tolerance, most_iterations);
  }

  /// Solves the flow again where ||R - R_last||/||R_last|| exceeds the threshold, R = T r(|G|) being the resistance of
  /// each cell to the mass flux; nothing otherwise.  With `tracer.resolve: every-step` always, and tightly.
  void follow(const BedState& bed);

  /// Steady gas energy with what the solids exchange in this step.
  void solve_energy(const BedState& bed, const SolidsExchange& solids);

  [[nodiscard]] const std::vector<double>& temperature() const { return temperature_; }
  [[nodiscard]] const BedFlow& flow() const { return *flow_; }
  [[nodiscard]] const GasEnergy::Ledger& energy_ledger() const { return energy_->ledger(); }
  [[nodiscard]] long flow_solves() const { return flow_solves_; }
  [[nodiscard]] long flow_skips() const { return flow_skips_; }
  [[nodiscard]] long energy_solves() const { return energy_solves_; }

  /// All that a later solution starts from and a result needs.
  struct State {
    BedFlow::WarmStart start;
    std::vector<double> face_pressure, inertia_over_drag, temperature, last_resistance;
    long flow_solves, flow_skips, energy_solves;
  };
  [[nodiscard]] State state() const;
  void restore(State state);

  /// The same for a checkpoint, under `Gas/`.
  void save(HdfWriter& file) const;
  void restore(const HdfReader& file);

 private:
  [[nodiscard]] std::vector<double> resistance(const BedState& bed) const;
  void solve_flow(const BedState& bed, double tolerance, int most_iterations);

  const Campaign& campaign_;
  std::unique_ptr<BedFlow> flow_;
  std::unique_ptr<GasEnergy> energy_;    ///< only where there is heat
  std::vector<double> temperature_;      ///< K, all cells
  std::vector<double> last_resistance_;  ///< at the last flow solution
  double threshold_;
  long flow_solves_ = 0;
  long flow_skips_ = 0;
  long energy_solves_ = 0;
};

}  // namespace cupola
