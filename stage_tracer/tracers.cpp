#include "stage_tracer/tracers.hpp"

#include <algorithm>
#include <cmath>

#include "stage_tracer/random.hpp"

namespace cupola {

void Tracers::remove(const std::vector<std::uint8_t>& drop) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (drop[i] != 0) continue;
    if (kept != i) {
      id[kept] = id[i];
      species[kept] = species[i];
      point[kept] = point[i];
      volume[kept] = volume[i];
      life[kept] = life[i];
      if (!temperature.empty()) temperature[kept] = temperature[i];
    }
    ++kept;
  }
  id.resize(kept);
  species.resize(kept);
  point.resize(kept);
  volume.resize(kept);
  life.resize(kept);
  if (!temperature.empty()) temperature.resize(kept);
}

void Tracers::sort_by_cell(std::size_t cells) {
  std::vector<std::size_t> place(cells + 1, 0);
  for (const PathField::Point& where : point) ++place[static_cast<std::size_t>(where.cell) + 1];
  for (std::size_t c = 0; c < cells; ++c) place[c + 1] += place[c];
  std::vector<std::size_t> target(size());
  for (std::size_t i = 0; i < size(); ++i) target[i] = place[static_cast<std::size_t>(point[i].cell)]++;
  const auto reorder = [&](auto& values) {
    auto sorted = values;
    for (std::size_t i = 0; i < values.size(); ++i) sorted[target[i]] = values[i];
    values = std::move(sorted);
  };
  reorder(id);
  reorder(species);
  reorder(point);
  reorder(volume);
  reorder(life);
  reorder(temperature);
}

std::vector<double> to_rows(const Tracers& tracers) {
  std::vector<double> rows;
  rows.reserve(tracers.size() * tracer_columns);
  for (std::size_t i = 0; i < tracers.size(); ++i) {
    const PathField::Point& point = tracers.point[i];
    rows.insert(rows.end(),
                {static_cast<double>(tracers.id[i]), static_cast<double>(tracers.species[i]),
                 static_cast<double>(point.cell), point.reference[0], point.reference[1], point.reference[2],
                 tracers.volume[i], tracers.life[i], tracers.temperature.empty() ? 0 : tracers.temperature[i]});
  }
  return rows;
}

Tracers from_rows(const std::vector<double>& rows, bool heat, int rank, int ranks) {
  Tracers tracers;
  for (std::size_t r = 0; r < rows.size(); r += tracer_columns) {
    const auto id = static_cast<std::int64_t>(rows[r]);
    if (rank_of(id, ranks) != rank) continue;
    const PathField::Point point{static_cast<std::int64_t>(rows[r + 2]), {rows[r + 3], rows[r + 4], rows[r + 5]}};
    tracers.add(id, static_cast<std::uint8_t>(rows[r + 1]), point, rows[r + 6], rows[r + 7]);
    if (heat) tracers.temperature.push_back(rows[r + 8]);
  }
  return tracers;
}

double draw_life(std::uint64_t seed, std::int64_t id) {
  return -std::log(random_uniform(seed, RandomUse::life, static_cast<std::uint64_t>(id))[0]);
}

}  // namespace cupola
