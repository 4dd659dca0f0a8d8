#include "stage_dem/mass_books.hpp"

#include "stage_dem/parcels.hpp"

namespace cupola {
namespace {

MassBooks::Counts operator-(MassBooks::Counts a, const MassBooks::Counts& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

}  // namespace

MassBooks::MassBooks(const Campaign& campaign) {
  const std::size_t species = campaign.species.size();
  for (const auto& kind : campaign.species) parcel_mass_.push_back(parcel_mass(kind));
  initial_ = charged_ = melted_ = unmelted_ = Counts(species, 0);
  raceway_.assign(campaign.raceways.size(), Counts(species, 0));
}

void MassBooks::put_in(const std::vector<Parcel>& parcels, bool charged) {
  for (const auto& parcel : parcels) ++count(charged ? charged_ : initial_, parcel);
}

double MassBooks::mass(const Counts& counts) const {
  double sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) sum += static_cast<double>(counts[i]) * parcel_mass_[i];
  return sum;
}

double MassBooks::residual(const std::vector<Parcel>& present) const {
  double stored = 0;
  for (const auto& parcel : present) stored += parcel.mass;
  double out = mass(melted_) + mass(unmelted_);
  for (const auto& raceway : raceway_) out += mass(raceway);
  const double in = mass(initial_) + mass(charged_);
  return in > 0 ? (in - out - stored) / in : 0;
}

nlohmann::json MassBooks::ledger(const std::vector<Parcel>& present) const {
  double stored = 0;
  for (const auto& parcel : present) stored += parcel.mass;
  double through_raceways = 0;
  for (const auto& raceway : raceway_) through_raceways += mass(raceway);
  return {{"mass_initial", mass(initial_)},
          {"mass_in", mass(charged_)},
          {"mass_out", {{"raceway", through_raceways}, {"melted", mass(melted_)}, {"unmelted", mass(unmelted_)}}},
          {"mass_stored", stored},
          {"residual", residual(present)}};
}

nlohmann::json MassBooks::save() const {
  return {{"initial", initial_},
          {"charged", charged_},
          {"melted", melted_},
          {"unmelted", unmelted_},
          {"raceway", raceway_}};
}

void MassBooks::load(const nlohmann::json& state) {
  state.at("initial").get_to(initial_);
  state.at("charged").get_to(charged_);
  state.at("melted").get_to(melted_);
  state.at("unmelted").get_to(unmelted_);
  state.at("raceway").get_to(raceway_);
}

MassBooks MassBooks::since(const MassBooks& earlier) const {
  MassBooks difference = *this;
  difference.initial_ = initial_ - earlier.initial_;
  difference.charged_ = charged_ - earlier.charged_;
  difference.melted_ = melted_ - earlier.melted_;
  difference.unmelted_ = unmelted_ - earlier.unmelted_;
  for (std::size_t i = 0; i < raceway_.size(); ++i) difference.raceway_[i] = raceway_[i] - earlier.raceway_[i];
  return difference;
}

}  // namespace cupola
