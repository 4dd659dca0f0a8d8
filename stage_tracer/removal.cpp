#include "stage_tracer/removal.hpp"

namespace cupola {

std::vector<double> Tally::row() const {
  std::vector<double> result;
  for (const auto* part : {&mass, &enthalpy, &tracers}) result.insert(result.end(), part->begin(), part->end());
  result.insert(result.end(), {charged_mass, charged_enthalpy, charged_tracers});
  return result;
}

Tally Tally::from_row(const std::vector<double>& row) {
  Tally tally;
  for (std::size_t c = 0; c < causes; ++c) {
    tally.mass[c] = row.at(c);
    tally.enthalpy[c] = row.at(causes + c);
    tally.tracers[c] = row.at(2 * causes + c);
  }
  tally.charged_mass = row.at(3 * causes);
  tally.charged_enthalpy = row.at(3 * causes + 1);
  tally.charged_tracers = row.at(3 * causes + 2);
  return tally;
}

Tally& Tally::operator+=(const Tally& other) {
  std::vector<double> sum = row();
  const std::vector<double> more = other.row();
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
  return *this = from_row(sum);
}

}  // namespace cupola
