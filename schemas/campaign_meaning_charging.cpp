#include <algorithm>

#include "schemas/campaign_meaning.hpp"
#include "schemas/nearest.hpp"

namespace cupola::meaning {
namespace {

/// MODEL of the charge: what is charged at once must find room between the stock line and the hopper's top.
void check_batch(Context& context, const std::string& path, double volume) {
  const auto& campaign = context.campaign;
  const auto& geometry = campaign.scene.geometry;
  const double throat = 2 * campaign.half_width(campaign.top()) * geometry.depth;
  if (volume > throat * (campaign.top() - campaign.bottom())) {
    context.add(path,
                "the layer would be {:.4g} m thick in the throat, more than the furnace is high: check its masses",
                volume / throat);
    return;
  }
  const double stock_line = std::max(campaign.charging.stock_line, campaign.bottom());
  double room =
      2 * campaign.half_width(campaign.top()) * (campaign.hopper_top() - std::max(stock_line, campaign.top()));
  for (std::size_t i = 1; i < geometry.profile.size(); ++i) {
    const double low = std::max(geometry.profile[i - 1][0], stock_line);
    const double high = geometry.profile[i][0];
    if (low < high) room += (campaign.half_width(low) + campaign.half_width(high)) * (high - low);
  }
  room *= geometry.depth;
  if (volume > room * (1 + rounding)) {
    context.add(
        path,
        "the layer takes {:.4g} m3, but there are only {:.4g} m3 between the stock line and the top of the charging "
        "hopper: charge less at once, lower the stock line or raise charging.hopper_height",
        volume, room);
  }
}

/// A ring lies inside the throat.
void check_ring(Context& context, const std::string& path, std::size_t layer) {
  const auto ring = context.campaign.charging.ring_of(layer);
  if (!ring) return;
  const double half_width = context.campaign.half_width(context.campaign.charging.stock_line);
  if (!((*ring)[0] < (*ring)[1])) {
    context.add(path, "expected [from, to] with from < to");
  } else if ((*ring)[0] >= half_width || (*ring)[1] > half_width + rounding) {
    context.add(path, "the ring from {} to {} m reaches outside the furnace, whose half width is {:.4g} m there",
                (*ring)[0], (*ring)[1], half_width);
  }
}

}  // namespace

void check_charging(Context& context) {
  const auto& campaign = context.campaign;
  const auto& charging = campaign.charging;
  if (context.shaped &&
      (charging.stock_line <= campaign.bottom() || charging.stock_line > campaign.hopper_top() + rounding)) {
    context.add("charging.stock_line",
                "{} m is not between the bottom, {} m, and the top of the charging hopper, {:.4g} m",
                charging.stock_line, campaign.bottom(), campaign.hopper_top());
    return;
  }
  for (std::size_t i = 0; i < charging.layers.size(); ++i) {
    const auto path = path_of("charging.layers", i);
    double volume = 0;
    for (const auto& [name, mass] : charging.layers[i]) {
      if (context.known(name)) {
        volume += mass / campaign.species[campaign.species_index(name)].density / bulk_packing;
      } else if (context.named && !context.names.empty()) {
        context.add_at_key(path_of(path, name), "there is no species `{}`{}", name, suggestion(name, context.names));
      }
    }
    if (charging.layers[i].empty()) context.add(path, "expected a mass of some species, like {{coke: 270 kg}}");
    if (context.shaped) check_batch(context, path, volume);
    if (context.shaped) check_ring(context, path_of(path, "ring"), i);
  }
}

}  // namespace cupola::meaning
