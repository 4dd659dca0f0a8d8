#include "physics/plan/scene_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "physics/closures/drag.hpp"
#include "physics/plan/charge.hpp"
#include "physics/plan/expected_parcels.hpp"
#include "physics/plan/inlet_flows.hpp"

namespace cupola {
namespace {

/// Largest Reynolds number of the law's source, with the superficial flux (docs/models.md); none where it is no limit.
double most_reynolds(DragLaw law) {
  switch (law) {
    case DragLaw::koch_hill:
      return 200;
    case DragLaw::beetstra:
      return 1000;
    case DragLaw::ergun:
    case DragLaw::gidaspow:
      return 1e4;
    default:
      return 0;
  }
}

void judge_drag(const Campaign& campaign, const Charge& charge, std::vector<std::string>& warnings) {
  double mass_flow = 0, largest = 0;
  for (const Inlet& inlet : campaign.scene.gas->inlets) mass_flow += inlet.mass_flow;
  for (const Species& species : campaign.species) largest = std::max(largest, species.diameter);
  const double reynolds = mass_flow / charge.area * largest / campaign.scene.gas->viscosity;
  const double most = most_reynolds(campaign.drag);
  if (most > 0 && reynolds > 2 * most) {
    const bool early = campaign.drag == DragLaw::beetstra || campaign.drag == DragLaw::koch_hill;
    warnings.push_back(fmt::format(
        "The drag law {} holds up to Reynolds numbers of about {:.0f}, the bed has {:.0f} "
        "at the stock line: the pressure drop will {} (docs/models.md has the ranges)",
        drag_law_name(campaign.drag), most, reynolds, early ? "come out too small" : "be an extrapolation"));
  }
  if (campaign.drag == DragLaw::emms && largest > 5e-4)
    warnings.push_back(fmt::format(
        "The drag law emms is fitted to grains of some 40 um in a riser; these are of {:.3g} mm", 1e3 * largest));
  if (campaign.drag == DragLaw::wen_yu && !campaign.raceways.empty())
    warnings.emplace_back("The drag law wen-yu is for dispersed grains; in a packed bed ergun or gidaspow hold");
}

void judge_species(const Campaign& campaign, const Charge& charge, std::vector<std::string>& warnings) {
  const auto parcels = expected_parcels(campaign, charge.volume_share, charge.packing);
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    const std::string& name = campaign.species[i].name;
    const bool charged =
        std::any_of(campaign.charging.layers.begin(), campaign.charging.layers.end(), [&](const Layer& layer) {
          const auto found = layer.find(name);
          return found != layer.end() && found->second > 0;
        });
    if (!charged) {
      warnings.push_back(
          fmt::format("No layer of charging.layers holds {}: there will be none in the bed. Charge it, or leave "
                      "species.{} out",
                      name, name));
    } else if (parcels[i] < 1) {
      warnings.push_back(
          fmt::format("The bed will hold less than one parcel of {} ({:.2g}): charge more of it, or lower "
                      "species.{}.coarse_graining",
                      name, parcels[i], name));
    }
  }
}

}  // namespace

std::vector<std::string> scene_warnings(const Campaign& campaign) {
  std::vector<std::string> warnings;
  const Charge charge = charge_of(campaign);
  if (campaign.scene.gas)
    if (const auto flowing = with_mass_flows(campaign, charge)) judge_drag(*flowing, charge, warnings);
  judge_species(campaign, charge, warnings);
  return warnings;
}

}  // namespace cupola
