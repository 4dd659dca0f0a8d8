#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "stage_tracer/removal.hpp"

namespace cupola {

/// Mass and energy of an episode, from its beginning: what came in, what went out, what is stored (enthalpies from 293
/// K).
struct Ledger {
  Tally tally;            ///< of all ranks
  double blast = 0;       ///< J, by the gas
  double top_gas = 0;     ///< J
  double walls = 0;       ///< J
  double to_solids = 0;   ///< J, what the gas gave to the solids by its own account
  double mass_begin = 0;  ///< kg in the bed at the beginning
  double mass_now = 0;
  double energy_begin = 0;  ///< J in the bed at the beginning, after the hand-over
  double energy_now = 0;
  double handover = 0;  ///< J that re-seeding and the steady temperature of stagnant cells changed

  /// (in - out - stored)/in of the mass (in: charge, or what was there where nothing was charged).
  [[nodiscard]] double mass_residual() const;
  /// |in - out - stored|/blast enthalpy (over the largest term where there is no blast).
  [[nodiscard]] double energy_residual() const;
  /// As docs/contracts.md has it. @param heat whether there is an energy balance
  [[nodiscard]] nlohmann::json to_json(bool heat) const;

  [[nodiscard]] std::vector<double> row() const;
  static Ledger from_row(const std::vector<double>& row);
};

}  // namespace cupola
