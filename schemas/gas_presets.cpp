#include "schemas/gas_presets.hpp"

namespace cupola {

const std::vector<GasPreset>& gas_presets() {
  constexpr double gas_constant = 8.31446261815324;  // J/mol/K
  static const std::vector<GasPreset> presets{
      {"air", 0.02897, 1007, 1.846e-5, 0.707},
      {"nitrogen", 0.02801, 1041, 1.782e-5, 0.716},
      {"blast", 0.028, 745 + gas_constant / 0.028, 2e-5, 0.8},
  };
  return presets;
}

}  // namespace cupola
