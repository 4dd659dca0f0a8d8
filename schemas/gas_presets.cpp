#include "schemas/gas_presets.hpp"

namespace cupola {
namespace {

using Coefficients = std::array<double, 7>;

constexpr Coefficients nitrogen_low{3.53100528,      -1.23660987e-4, -5.02999437e-7, 2.43530612e-9,
                                    -1.40881235e-12, -1.04697628e3,  2.96747468};
constexpr Coefficients nitrogen_high{2.95257626,      1.39690057e-3, -4.92631691e-7, 7.86010367e-11,
                                     -4.60755321e-15, -9.23948645e2, 5.87189252};
constexpr Coefficients oxygen_low{3.78245636,     -2.99673415e-3, 9.84730200e-6, -9.68129508e-9,
                                  3.24372836e-12, -1.06394356e3,  3.65767573};
constexpr Coefficients oxygen_high{3.66096083,      6.56365523e-4, -1.41149485e-7, 2.05797658e-11,
                                   -1.29913248e-15, -1.21597725e3, 3.41536184};
constexpr Coefficients argon{2.5, 0, 0, 0, 0, -7.45375e2, 4.37967491};

/// The polynomials are those of a mole, so they mix by volume.
Coefficients air(const Coefficients& nitrogen, const Coefficients& oxygen) {
  Coefficients mixture{};
  for (std::size_t i = 0; i < mixture.size(); ++i)
    mixture[i] = 0.7808 * nitrogen[i] + 0.2095 * oxygen[i] + 0.0097 * argon[i];
  return mixture;
}

}  // namespace

const std::vector<GasPreset>& gas_presets() {
  constexpr double gas_constant = 8.31446261815324;  // J/mol/K
  const Sutherland of_nitrogen{1.663e-5, 273, 107};
  const JanafPolynomials nitrogen{200, 1000, 6000, nitrogen_low, nitrogen_high};
  static const std::vector<GasPreset> presets{
      {"air",
       0.02897,
       1007,
       1.846e-5,
       0.707,
       {1.716e-5, 273, 111},
       {200, 1000, 6000, air(nitrogen_low, oxygen_low), air(nitrogen_high, oxygen_high)}},
      {"nitrogen", 0.02801, 1041, 1.782e-5, 0.716, of_nitrogen, nitrogen},
      {"blast", 0.028, 745 + gas_constant / 0.028, 2e-5, 0.8, of_nitrogen, nitrogen},
  };
  return presets;
}

}  // namespace cupola
