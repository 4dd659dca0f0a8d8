#include "stage_tracer/predictor/correction.hpp"

#include <algorithm>

#include "schemas/field_file.hpp"

namespace cupola {

MarchBias read_march_bias(const std::filesystem::path& result, const BedMesh& mesh, const Campaign& campaign) {
  const FieldFile file(result, "tracer-result", mesh.hash);
  const auto limited = [&](const std::string& name) {
    std::vector<double> values = file.cell_data(name);
    for (double& value : values) value = std::clamp(value, -largest_carried_bias, largest_carried_bias);
    return values;
  };
  MarchBias bias;
  for (const Species& species : campaign.species) bias.species.push_back(limited(march_bias_name + species.name));
  return bias;
}

BySpecies corrected(const Campaign& campaign, const CellContents& predicted, const MarchBias& bias) {
  BySpecies result = predicted.temperature;
  for (std::size_t s = 0; s < result.size(); ++s) {
    const auto& softening = campaign.species[s].softening;
    for (std::size_t c = 0; c < result[s].size(); ++c) {
      if (!(predicted.volume[s][c] > 0)) continue;
      result[s][c] = std::max(result[s][c] + bias.species[s][c], campaign.charging.temperature);
      if (softening) result[s][c] = std::min(result[s][c], softening->melted);
    }
  }
  return result;
}

}  // namespace cupola
