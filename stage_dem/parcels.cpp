#include "stage_dem/parcels.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace cupola {
namespace {

constexpr double sphere = 4.0 / 3 * std::numbers::pi;

}  // namespace

std::vector<Parcel> gather_parcels(const Engine& engine, MPI_Comm communicator) {
  static_assert(std::is_trivially_copyable_v<Parcel>);
  const auto mine = engine.owned();
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  MPI_Datatype type = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(sizeof(Parcel), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  const int number = static_cast<int>(mine.size());
  std::vector<int> numbers(static_cast<std::size_t>(ranks));
  std::vector<int> first(numbers.size(), 0);
  MPI_Allgather(&number, 1, MPI_INT, numbers.data(), 1, MPI_INT, communicator);
  for (std::size_t rank = 1; rank < first.size(); ++rank) first[rank] = first[rank - 1] + numbers[rank - 1];
  std::vector<Parcel> all(static_cast<std::size_t>(first.back() + numbers.back()));
  MPI_Allgatherv(mine.data(), number, type, all.data(), numbers.data(), first.data(), type, communicator);
  MPI_Type_free(&type);
  std::sort(all.begin(), all.end(), [](const Parcel& a, const Parcel& b) { return a.id < b.id; });
  return all;
}

Parcel new_parcel(const Campaign& campaign, std::int64_t id, int species, const Vector3& position) {
  const Species& kind = campaign.species[static_cast<std::size_t>(species)];
  Parcel parcel;
  parcel.id = id;
  parcel.species = species;
  parcel.position = position;
  parcel.radius = kind.parcel_diameter() / 2;
  parcel.mass = parcel_mass(kind);
  return parcel;
}

double parcel_mass(const Species& species) {
  return species.density * sphere * std::pow(species.parcel_diameter() / 2, 3);
}

double largest_diameter(const Campaign& campaign) {
  double largest = 0;
  for (const auto& species : campaign.species) largest = std::max(largest, species.parcel_diameter());
  return largest;
}

double period(const Campaign& campaign) {
  return campaign.scene.geometry.sides == Geometry::Sides::periodic ? campaign.scene.geometry.depth : 0;
}

double contact_volume(const Parcel& parcel) { return sphere * std::pow(parcel.radius, 3); }

double material_volume(const Campaign& campaign, const Parcel& parcel) {
  return parcel.mass / campaign.species[static_cast<std::size_t>(parcel.species)].density;
}

}  // namespace cupola
