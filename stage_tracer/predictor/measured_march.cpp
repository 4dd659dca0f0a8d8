#include "stage_tracer/predictor/measured_march.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/closures/enthalpy_zero.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

constexpr std::size_t least_windows = 4;

/// Volume-weighted mean of some windows.
CellContents mean_of(const std::vector<MarchWindows::Window>& windows, std::size_t first, std::size_t end) {
  CellContents mean = windows[first].mean;
  for (std::size_t s = 0; s < mean.volume.size(); ++s) {
    for (std::size_t c = 0; c < mean.volume[s].size(); ++c) {
      double seconds = 0;
      double volume = 0;
      double heat = 0;
      for (std::size_t w = first; w < end; ++w) {
        const double here = windows[w].seconds * windows[w].mean.volume[s][c];
        seconds += windows[w].seconds;
        volume += here;
        heat += here * windows[w].mean.temperature[s][c];
      }
      mean.volume[s][c] = seconds > 0 ? volume / seconds : 0;
      mean.temperature[s][c] = volume > 0 ? heat / volume : 0;
    }
  }
  return mean;
}

double seconds_of(const std::vector<MarchWindows::Window>& windows, std::size_t first, std::size_t end) {
  double sum = 0;
  for (std::size_t w = first; w < end; ++w) sum += windows[w].seconds;
  return sum;
}

}  // namespace

MeasuredMarch measure_march(const std::vector<MarchWindows::Window>& windows, const CellSpreading& kernel,
                            int smoothing) {
  if (windows.size() < least_windows)
    throw Failure(ExitCode::wrong_input,
                  fmt::format("a march of {} layer passages says too little to correct a prediction by; {} are needed",
                              windows.size(), least_windows))
        .at("key", "predict_and_verify.windows");
  const std::size_t end = windows.size();
  MeasuredMarch measured;
  measured.windows = end - 1;
  measured.seconds = seconds_of(windows, 1, end);
  measured.mean = mean_of(windows, 1, end);
  const std::size_t half = measured.windows / 2;
  const CellContents early = mean_of(windows, 1, 1 + half);
  const CellContents late = mean_of(windows, end - half, end);
  const double between =
      measured.seconds - 0.5 * (seconds_of(windows, 1, 1 + half) + seconds_of(windows, end - half, end));
  measured.tendency = measured.error = BySpecies(early.volume.size(), std::vector<double>(early.volume[0].size(), 0.0));
  BySpecies known = measured.mean.volume;
  for (std::size_t s = 0; s < known.size(); ++s) {
    for (std::size_t c = 0; c < known[s].size(); ++c) {
      bool always = true;
      double squares = 0;
      for (std::size_t w = 1; w < end; ++w) always = always && windows[w].mean.volume[s][c] > 0;
      if (!always) {
        known[s][c] = 0;
        continue;
      }
      measured.tendency[s][c] = (late.temperature[s][c] - early.temperature[s][c]) / between;
      for (std::size_t w = 2; w + 1 < end; ++w) {
        const double second = windows[w + 1].mean.temperature[s][c] - 2 * windows[w].mean.temperature[s][c] +
                              windows[w - 1].mean.temperature[s][c];
        squares += second * second / 6;
      }
      measured.error[s][c] = std::sqrt(squares / static_cast<double>(end - 3) / static_cast<double>(measured.windows));
    }
  }
  measured.tendency = smoothed(known, std::move(measured.tendency), kernel, smoothing);
  return measured;
}

TemperatureNorm temperature_norm(const Campaign& campaign, const BySpecies& volume, const std::vector<bool>& left_out,
                                 const BySpecies& a, const BySpecies& b) {
  double weight = 0, squares = 0, sum = 0, level = 0;
  for (std::size_t s = 0; s < volume.size(); ++s) {
    const Species& species = campaign.species[s];
    for (std::size_t c = 0; c < volume[s].size(); ++c) {
      if (!(volume[s][c] > 0) || left_out[c]) continue;
      const double capacity = volume[s][c] * species.density * species.heat_capacity.at(a[s][c]);
      const double difference = a[s][c] - b[s][c];
      weight += capacity;
      squares += capacity * difference * difference;
      sum += capacity * difference;
      level += capacity * (a[s][c] - enthalpy_zero) * (a[s][c] - enthalpy_zero);
    }
  }
  if (!(weight > 0)) return {};
  return {std::sqrt(squares / weight), sum / weight, std::sqrt(level / weight)};
}

BySpecies smoothed(const BySpecies& volume, BySpecies values, const CellSpreading& kernel, int passes) {
  CellContents contents{volume, std::move(values)};
  for (int pass = 0; pass < passes; ++pass) contents = spread(contents, kernel);
  return contents.temperature;
}

}  // namespace cupola
