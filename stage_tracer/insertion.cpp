#include "stage_tracer/insertion.hpp"

#include <algorithm>

#include "stage_tracer/random.hpp"

namespace cupola {

Insertion::Insertion(const BedMesh& mesh, std::vector<StockFace> faces, const ChargePlan& charge,
                     std::vector<double> tracer_volume, std::uint64_t seed, std::int64_t first_id)
    : faces_(std::move(faces)),
      charge_(charge),
      tracer_volume_(std::move(tracer_volume)),
      seed_(seed),
      first_id_(first_id) {
  const std::size_t species = tracer_volume_.size();
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto& sides = mesh.cell_faces[faces_[f].cell];
    side_.push_back(static_cast<std::size_t>(std::find(sides.begin(), sides.end(), faces_[f].face) - sides.begin()));
    // A random part of a tracer owed at the start keeps the faces from charging in step.
    for (std::size_t s = 0; s < species; ++s) {
      const auto uniform = random_uniform(seed_, RandomUse::entry_phase, f * species + s);
      state_.owed.push_back(uniform[0] * tracer_volume_[s]);
      state_.entered.push_back(0);
    }
  }
}

std::vector<Entry> Insertion::advance(double from, double to) {
  std::vector<std::vector<ChargePlan::Piece>> pieces;
  for (std::size_t zone = 0; zone < charge_.zones(); ++zone) pieces.push_back(charge_.pieces(from, to, zone));
  const std::vector<std::size_t>& zones = charge_.zone_of_place();
  const std::size_t species = tracer_volume_.size();
  std::vector<Entry> entries;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for (const ChargePlan::Piece& piece : pieces[zones.empty() || pieces.size() == 1 ? 0 : zones[f]]) {
      for (std::size_t s = 0; s < species; ++s) {
        const double rate = faces_[f].volume_rate * (*piece.share)[s];
        if (rate <= 0) continue;
        double& owed = state_.owed[f * species + s];
        double time = piece.from;
        while (owed + rate * (piece.to - time) >= tracer_volume_[s]) {
          time += (tracer_volume_[s] - owed) / rate;
          owed = 0;
          entries.push_back(enter(f, s, std::min(time, piece.to)));
        }
        owed += rate * std::max(0.0, piece.to - time);
      }
    }
  }
  return entries;
}

Entry Insertion::enter(std::size_t face, std::size_t species, double time) {
  const std::size_t place = face * tracer_volume_.size() + species;
  const std::size_t side = side_[face];
  Entry entry;
  entry.id = first_id_ + static_cast<std::int64_t>(place) +
             state_.entered[place]++ * static_cast<std::int64_t>(state_.entered.size());
  entry.species = static_cast<std::uint8_t>(species);
  entry.time = time;
  entry.volume = tracer_volume_[species];
  entry.point.cell = faces_[face].cell;
  const auto uniform = random_uniform(seed_, RandomUse::entry_position, static_cast<std::uint64_t>(entry.id));
  entry.point.reference = {uniform[0], uniform[1], uniform[2]};
  entry.point.reference[side / 2] = side % 2 == 0 ? 0.0 : 1.0;
  return entry;
}

}  // namespace cupola
