#include "stage_tracer/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cupola {
namespace {

double sum(const std::array<double, causes>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

double Ledger::mass_residual() const {
  const double difference = tally.charged_mass - sum(tally.mass) - (mass_now - mass_begin);
  const double scale = std::max({tally.charged_mass, sum(tally.mass), mass_begin});
  return scale > 0 ? std::abs(difference) / scale : 0;
}

double Ledger::energy_residual() const {
  const double difference =
      blast + tally.charged_enthalpy - top_gas - walls - sum(tally.enthalpy) - (energy_now - energy_begin);
  const double scale = blast > 0 ? blast : std::max({std::abs(energy_begin), std::abs(energy_now), 1.0});
  return std::abs(difference) / scale;
}

nlohmann::json Ledger::to_json(bool heat) const {
  const auto mass = [&](Cause cause) { return tally.of(tally.mass, cause); };
  const auto energy = [&](Cause cause) { return tally.of(tally.enthalpy, cause); };
  nlohmann::json result;
  result["mass"] = {{"in", tally.charged_mass},
                    {"out",
                     {{"raceway", mass(Cause::raceway)},
                      {"melted", mass(Cause::melted)},
                      {"unmelted", mass(Cause::unmelted)},
                      {"lost", mass(Cause::lost)}}},
                    {"stored", mass_now - mass_begin},
                    {"residual", mass_residual()}};
  if (heat) {
    result["energy"] = {{"blast", blast},
                        {"charge", tally.charged_enthalpy},
                        {"top_gas", top_gas},
                        {"melt", energy(Cause::melted)},
                        {"removed_coke", energy(Cause::raceway)},
                        {"unmelted", energy(Cause::unmelted)},
                        {"lost", energy(Cause::lost)},
                        {"walls", walls},
                        {"stored", energy_now - energy_begin},
                        {"handover", handover},
                        {"to_solids", to_solids},
                        {"residual", energy_residual()}};
  }
  return result;
}

std::vector<double> Ledger::row() const {
  std::vector<double> result = tally.row();
  result.insert(result.end(),
                {blast, top_gas, walls, to_solids, mass_begin, mass_now, energy_begin, energy_now, handover});
  return result;
}

Ledger Ledger::from_row(const std::vector<double>& row) {
  Ledger ledger;
  ledger.tally = Tally::from_row(row);
  std::size_t next = Tally::columns;
  for (double* value : {&ledger.blast, &ledger.top_gas, &ledger.walls, &ledger.to_solids, &ledger.mass_begin,
                        &ledger.mass_now, &ledger.energy_begin, &ledger.energy_now, &ledger.handover}) {
    *value = row.at(next++);
  }
  return ledger;
}

}  // namespace cupola
