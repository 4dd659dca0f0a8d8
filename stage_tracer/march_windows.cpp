#include "stage_tracer/march_windows.hpp"

namespace cupola {
namespace {

constexpr const char* seconds_of = "Windows/seconds";
constexpr const char* volume_of = "Windows/volume";
constexpr const char* temperature_of = "Windows/temperature";

BySpecies unfolded(const std::vector<double>& values, std::size_t window, std::size_t species, std::size_t cells) {
  BySpecies result;
  for (std::size_t s = 0; s < species; ++s) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>((window * species + s) * cells);
    result.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(cells));
  }
  return result;
}

}  // namespace

void MarchWindows::add(const Averages& averages) { rows_.push_back(averages.row()); }

std::vector<double> MarchWindows::row() const {
  std::vector<double> result = {static_cast<double>(rows_.size())};
  for (const auto& row : rows_) result.insert(result.end(), row.begin(), row.end());
  return result;
}

void MarchWindows::restore(const std::vector<double>& row) {
  rows_.clear();
  const auto windows = static_cast<std::size_t>(row.at(0));
  if (windows == 0) return;
  const auto length = static_cast<std::ptrdiff_t>((row.size() - 1) / windows);
  for (auto begin = row.begin() + 1; begin != row.end(); begin += length) rows_.emplace_back(begin, begin + length);
}

void MarchWindows::write(HdfWriter& file) const {
  std::vector<double> seconds, volume, temperature;
  for (const auto& row : rows_) {
    Averages averages(species_, cells_, true);
    averages.restore(row);
    seconds.push_back(averages.seconds());
    for (const auto& of_species : averages.volume()) volume.insert(volume.end(), of_species.begin(), of_species.end());
    for (const auto& of_species : averages.temperature())
      temperature.insert(temperature.end(), of_species.begin(), of_species.end());
  }
  file.write(seconds_of, seconds);
  file.write(volume_of, volume, species_ * cells_);
  file.write(temperature_of, temperature, species_ * cells_);
}

std::vector<MarchWindows::Window> MarchWindows::read(const HdfReader& file, std::size_t species, std::size_t cells) {
  const std::vector<double> seconds = file.doubles(seconds_of);
  const auto rows = static_cast<std::int64_t>(seconds.size());
  const auto columns = static_cast<std::int64_t>(species * cells);
  const std::vector<double> volume = file.doubles(volume_of, rows, columns);
  const std::vector<double> temperature = file.doubles(temperature_of, rows, columns);
  std::vector<Window> windows;
  for (std::size_t w = 0; w < seconds.size(); ++w)
    windows.push_back({seconds[w], {unfolded(volume, w, species, cells), unfolded(temperature, w, species, cells)}});
  return windows;
}

}  // namespace cupola
