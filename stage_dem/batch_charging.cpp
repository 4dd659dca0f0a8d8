#include "stage_dem/batch_charging.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "physics/plan/mesh_counts.hpp"
#include "schemas/failure.hpp"
#include "stage_dem/bed_surface.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/pouring.hpp"

namespace cupola {
namespace {

constexpr double loose_packing = 0.55;

void check_batches_fit(const Campaign& campaign) {
  const double stock = campaign.charging.stock_line;
  double room = 0;
  if (stock < campaign.top()) room += slot_volume(campaign, stock, campaign.top());
  const double foot = std::max(stock, campaign.top());
  room += 2 * campaign.half_width(campaign.top()) * campaign.scene.geometry.depth * (campaign.hopper_top() - foot);
  for (std::size_t i = 0; i < campaign.charging.layers.size(); ++i) {
    double volume = 0;
    for (const auto& [name, mass] : campaign.charging.layers[i])
      volume += mass / campaign.species[campaign.species_index(name)].density / loose_packing;
    if (volume > room)
      throw Failure(
          ExitCode::wrong_input,
          fmt::format("charging.layers[{}] takes {:.3g} m3 but only {:.3g} m3 are free above the stock line: charge "
                      "smaller layers or raise charging.hopper_height",
                      i, volume, room))
          .at("key", fmt::format("charging.layers[{}]", i));
  }
}

}  // namespace

BatchCharging::BatchCharging(const Campaign& campaign) : campaign_(campaign) {
  check_batches_fit(campaign);
  state_.owed.assign(campaign.species.size(), 0);
  state_.carried.assign(campaign.species.size(), 0.0);
}

void BatchCharging::begin_batch() {
  const auto& layers = campaign_.charging.layers;
  const Layer& layer = layers[static_cast<std::size_t>(state_.next_layer)];
  for (const auto& [name, mass] : layer) {
    const std::size_t species = campaign_.species_index(name);
    const double one = parcel_mass(campaign_.species[species]);
    const double available = mass + state_.carried[species];
    const double whole = std::floor(available / one);
    state_.owed[species] += static_cast<std::int64_t>(whole);
    state_.carried[species] = available - whole * one;
  }
  state_.next_layer = (state_.next_layer + 1) % static_cast<std::int64_t>(layers.size());
}

std::array<double, 2> BatchCharging::running_ring() const {
  const auto layers = static_cast<std::int64_t>(campaign_.charging.layers.size());
  const auto running = static_cast<std::size_t>((state_.next_layer + layers - 1) % layers);
  if (const auto ring = campaign_.charging.ring_of(running)) return *ring;
  return {0, std::max(campaign_.half_width(campaign_.top()), campaign_.half_width(campaign_.charging.stock_line))};
}

std::vector<Parcel> BatchCharging::pour(const std::vector<Parcel>& parcels, double surface, double time,
                                        std::uint64_t seed, std::int64_t& next_id) {
  const auto still_owed = [&] { return std::accumulate(state_.owed.begin(), state_.owed.end(), std::int64_t{0}); };
  if (campaign_.charging.layers.empty()) return {};
  if (still_owed() == 0) {
    if (surface >= campaign_.charging.stock_line || time < state_.not_before) return {};
    begin_batch();
  }
  Pouring pouring(campaign_, parcels);
  // Between the bed's surface and the hopper's top; where parcels are, the test for overlap keeps others out.
  const double from = std::max(surface, campaign_.charging.stock_line - 1);
  double volume = 0;
  for (std::size_t species = 0; species < state_.owed.size(); ++species)
    volume += static_cast<double>(state_.owed[species]) * parcel_mass(campaign_.species[species]) /
              campaign_.species[species].density;
  // No higher than the batch needs: a short fall disturbs the bed least.
  const auto [inner, outer] = running_ring();
  const double width = std::min(outer, campaign_.half_width(campaign_.charging.stock_line)) - inner;
  const double area = 2 * width * campaign_.scene.geometry.depth;
  const double to = std::min(campaign_.hopper_top(), from + 0.2 + volume / (Pouring::loose_fraction * area));
  RandomNumbers random(seed, RandomNumbers::Use::charging, static_cast<std::uint64_t>(next_id));
  while (still_owed() > 0) {
    // A mixed batch is poured mixed: the species with the largest number still to come first.
    const auto species = std::max_element(state_.owed.begin(), state_.owed.end()) - state_.owed.begin();
    const auto choose = [&, inner = inner, outer = outer](double x) {
      return std::abs(x) < inner || std::abs(x) > outer ? -1 : static_cast<int>(species);
    };
    const double radius = campaign_.species[static_cast<std::size_t>(species)].parcel_diameter() / 2;
    if (!pouring.place(from + radius, to - radius, next_id, choose, random, 200)) break;
    state_.falling.insert(next_id++);
    --state_.owed[static_cast<std::size_t>(species)];
  }
  // Free fall through the whole hopper, and a little to come to rest.
  const double height = campaign_.hopper_top() - campaign_.charging.stock_line;
  state_.not_before = time + std::sqrt(2 * height / 9.81) + 0.1;
  return pouring.placed();
}

void BatchCharging::see_landed(const std::vector<Parcel>& parcels) {
  if (state_.falling.empty()) return;
  std::set<std::int64_t> still;
  for (const auto& parcel : parcels) {
    const auto& v = parcel.velocity;
    const bool moving = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] > 0.25;
    if (moving && state_.falling.contains(parcel.id)) still.insert(parcel.id);
  }
  state_.falling = std::move(still);
}

nlohmann::json BatchCharging::save() const {
  return {{"next_layer", state_.next_layer},
          {"owed", state_.owed},
          {"carried", state_.carried},
          {"not_before", state_.not_before},
          {"falling", state_.falling}};
}

void BatchCharging::load(const nlohmann::json& state) {
  state.at("next_layer").get_to(state_.next_layer);
  state.at("owed").get_to(state_.owed);
  state.at("carried").get_to(state_.carried);
  state.at("not_before").get_to(state_.not_before);
  state.at("falling").get_to(state_.falling);
}

}  // namespace cupola
