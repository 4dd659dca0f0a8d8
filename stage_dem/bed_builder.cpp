#include "stage_dem/bed_builder.hpp"

#include <algorithm>

#include "physics/plan/charge.hpp"
#include "physics/plan/mesh_counts.hpp"
#include "stage_dem/bed_surface.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/pouring.hpp"
#include "stage_dem/softening.hpp"

namespace cupola {
namespace {

/// Pause between portions, s: the fall of most of a portion.
constexpr double pause = 0.3;

double layer_volume(const Campaign& campaign, const Layer& layer) {
  double volume = 0;
  for (const auto& [name, mass] : layer) volume += mass / campaign.species[campaign.species_index(name)].density;
  return volume;
}

double stock_area(const Campaign& campaign) {
  return 2 * campaign.half_width(campaign.charging.stock_line) * campaign.scene.geometry.depth;
}

}  // namespace

BedBuilder::BedBuilder(const Campaign& campaign) : campaign_(campaign) {}

void BedBuilder::begin_layer(double surface) {
  const auto& layers = campaign_.charging.layers;
  layer_ = next_layer_;
  next_layer_ = (next_layer_ + 1) % static_cast<std::int64_t>(layers.size());
  base_ = surface;
  const double full =
      layer_volume(campaign_, layers[static_cast<std::size_t>(layer_)]) / (expected_packing * stock_area(campaign_));
  thickness_ = std::min(full, campaign_.charging.stock_line - base_);
  volume_left_ = expected_packing * slot_volume(campaign_, base_, base_ + thickness_);
}

int BedBuilder::species_at(double x, double share, const OreTemperature& temperature) const {
  const Layer& layer = campaign_.charging.layers[static_cast<std::size_t>(layer_)];
  double rest = share * layer_volume(campaign_, layer);
  std::size_t chosen = 0;
  for (const auto& [name, mass] : layer) {
    chosen = campaign_.species_index(name);
    rest -= mass / campaign_.species[chosen].density;
    if (rest < 0) break;
  }
  const Species& species = campaign_.species[chosen];
  if (!species.softening) return static_cast<int>(chosen);
  // The lower edge of the layer decides, so that hardly any ore melts at once.
  const double z = base_;
  if (z > species.none_below && temperature.at({x, 0, z}, -1) < species.softening->melted)
    return static_cast<int>(chosen);
  const auto solid =
      std::find_if(campaign_.species.begin(), campaign_.species.end(), [](const Species& s) { return !s.softening; });
  return solid == campaign_.species.end() ? static_cast<int>(chosen)
                                          : static_cast<int>(solid - campaign_.species.begin());
}

std::vector<Parcel> BedBuilder::pour(const std::vector<Parcel>& parcels, const OreTemperature& temperature, double time,
                                     std::uint64_t seed, std::int64_t& next_id) {
  if (done_ || time < not_before_) return {};
  const double surface = bed_surface(campaign_, parcels);
  if (volume_left_ <= 0) {
    double smallest = campaign_.species.front().parcel_diameter();
    for (const auto& species : campaign_.species) smallest = std::min(smallest, species.parcel_diameter());
    if (surface > campaign_.charging.stock_line - smallest / 2) {
      done_ = true;
      return {};
    }
    begin_layer(surface);
  }
  Pouring pouring(campaign_, parcels);
  const double from = highest_top(campaign_, parcels);
  const double room = campaign_.hopper_top() - from;
  const double to =
      from +
      std::min(room, 0.2 + volume_left_ / (Pouring::loose_fraction * slot_volume(campaign_, base_, base_ + 0.1) / 0.1));
  RandomNumbers random(seed, RandomNumbers::Use::building, static_cast<std::uint64_t>(next_id));
  while (volume_left_ > 0) {
    const double share = random.next();
    const auto choose = [&](double x) { return species_at(x, share, temperature); };
    if (!pouring.place(from, to, next_id, choose, random, 100)) break;
    ++next_id;
    volume_left_ -= contact_volume(pouring.placed().back());
  }
  not_before_ = time + pause;
  return pouring.placed();
}

nlohmann::json BedBuilder::save() const {
  return {{"next_layer", next_layer_},   {"layer", layer_},           {"base", base_}, {"thickness", thickness_},
          {"volume_left", volume_left_}, {"not_before", not_before_}, {"done", done_}};
}

void BedBuilder::load(const nlohmann::json& state) {
  state.at("next_layer").get_to(next_layer_);
  state.at("layer").get_to(layer_);
  state.at("base").get_to(base_);
  state.at("thickness").get_to(thickness_);
  state.at("volume_left").get_to(volume_left_);
  state.at("not_before").get_to(not_before_);
  state.at("done").get_to(done_);
}

}  // namespace cupola
