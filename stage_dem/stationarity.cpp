#include "stage_dem/stationarity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cupola {
namespace {

struct Mean {
  double value = 0;
  double variance = 0;  ///< of the mean
};

Mean mean_of_batches(const double* samples, std::size_t batch) {
  Mean mean;
  double squares = 0;
  for (std::size_t b = 0; b < batches_a_half; ++b) {
    double sum = 0;
    for (std::size_t i = b * batch; i < (b + 1) * batch; ++i) sum += samples[i] / static_cast<double>(batch);
    mean.value += sum / batches_a_half;
    squares += sum * sum;
  }
  mean.variance = std::max(0.0, squares / batches_a_half - mean.value * mean.value) / (batches_a_half - 1);
  return mean;
}

}  // namespace

double drift(const std::vector<double>& series) {
  if (series.size() < least_samples) return std::numeric_limits<double>::infinity();
  const std::size_t batch = series.size() / least_samples;
  // The oldest samples that fill no batch are left out.
  const double* second = series.data() + series.size() - batches_a_half * batch;
  const Mean late = mean_of_batches(second, batch);
  const Mean early = mean_of_batches(second - batches_a_half * batch, batch);
  const double difference = late.value - early.value;
  if (difference == 0) return 0;
  return difference / std::sqrt(late.variance + early.variance);
}

}  // namespace cupola
