#include "tests/verification/dem/proof_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "stage_dem/pouring.hpp"

namespace cupola::test {

Campaign one_species(double diameter, double density) {
  Campaign campaign = box_campaign();
  Species& species = campaign.species[0];
  species.diameter = diameter;
  species.coarse_graining = 1;
  species.density = density;
  campaign.species.resize(1);
  campaign.contacts.rolling_model = Contacts::Rolling::none;
  campaign.contacts.pairs = {{"coke-coke", {0.5, 0.3, 0}}, {"coke-wall", {0.5, 0.3, 0}}};
  return campaign;
}

Parcel new_parcel(const Campaign& campaign, std::int64_t id, int species, const Vector3& position,
                  const Vector3& velocity) {
  Parcel parcel = cupola::new_parcel(campaign, id, species, position);
  parcel.velocity = velocity;
  return parcel;
}

void advance_until(Engine& engine, long steps, const std::function<bool(const std::vector<Parcel>&)>& condition) {
  for (int turn = 0; turn < 20000; ++turn) {
    engine.advance(steps);
    if (condition(everyone(engine))) return;
  }
  FAIL() << "what was waited for never happened";
}

std::vector<Parcel> poured(const Campaign& campaign, double height, std::size_t at_most) {
  Pouring pouring(campaign, {});
  RandomNumbers random(11, RandomNumbers::Use::building, 0);
  const double radius = largest_diameter(campaign) / 2;
  std::int64_t id = 1;
  const auto kinds = static_cast<std::int64_t>(campaign.species.size());
  while (pouring.placed().size() < at_most &&
         pouring.place(
             campaign.bottom() + radius, height, id, [&](double) { return static_cast<int>(id % kinds); }, random, 300))
    ++id;
  return pouring.placed();
}

double packing_fraction(const Campaign& campaign, const std::vector<Parcel>& parcels, const Vector3& lower,
                        const Vector3& upper) {
  const double spacing = parcels.front().radius / 8;
  const double depth = period(campaign);
  std::int64_t points = 0;
  std::int64_t inside = 0;
  for (double x = lower[0] + spacing / 2; x < upper[0]; x += spacing)
    for (double z = lower[2] + spacing / 2; z < upper[2]; z += spacing) {
      std::vector<const Parcel*> near;
      for (const auto& parcel : parcels)
        if (std::hypot(parcel.position[0] - x, parcel.position[2] - z) < parcel.radius) near.push_back(&parcel);
      for (double y = lower[1] + spacing / 2; y < upper[1]; y += spacing) {
        ++points;
        for (const auto* parcel : near) {
          double dy = parcel->position[1] - y;
          if (depth > 0) dy -= depth * std::round(dy / depth);
          if (std::hypot(parcel->position[0] - x, dy, parcel->position[2] - z) < parcel->radius) {
            ++inside;
            break;
          }
        }
      }
    }
  return static_cast<double>(inside) / static_cast<double>(points);
}

}  // namespace cupola::test
