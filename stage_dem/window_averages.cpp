#include "stage_dem/window_averages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "stage_dem/process_time.hpp"

namespace cupola {
namespace {

constexpr std::size_t integrals = 5;

}  // namespace

WindowAverages::WindowAverages(std::size_t cells, double batch_seconds)
    : cells_(cells),
      batch_seconds_(batch_seconds),
      running_(cells * integrals),
      total_(cells * integrals),
      sum_(cells * columns),
      sum_of_squares_(cells * columns),
      sum_of_products_(cells * columns),
      last_(cells * columns),
      first_(cells * columns),
      moment_(cells) {}

void WindowAverages::add(const BedSample& sample, double seconds) {
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    double* integral = &running_[cell * integrals];
    integral[0] += seconds * sample.fraction[cell];
    for (std::size_t k = 0; k < 3; ++k) integral[1 + k] += seconds * sample.flux[3 * cell + k];
    integral[4] += seconds * sample.contact_fraction[cell];
  }
  running_seconds_ += seconds;
  seconds_ += seconds;
  if (running_seconds_ > batch_seconds_ - same_time) close_batch();
}

void WindowAverages::close_batch() {
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    const double* integral = &running_[cell * integrals];
    std::array<double, columns> mean{integral[0] / running_seconds_, 0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) mean[1 + k] = integral[0] > 0 ? integral[1 + k] / integral[0] : 0;
    moment_[cell] += static_cast<double>(batches_) * mean[0];
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t i = cell * columns + k;
      sum_[i] += mean[k];
      sum_of_squares_[i] += mean[k] * mean[k];
      if (batches_ > 0) sum_of_products_[i] += mean[k] * last_[i];
      if (batches_ == 0) first_[i] = mean[k];
      last_[i] = mean[k];
    }
  }
  for (std::size_t i = 0; i < running_.size(); ++i) total_[i] += running_[i];
  std::fill(running_.begin(), running_.end(), 0.0);
  closed_seconds_ += running_seconds_;
  running_seconds_ = 0;
  ++batches_;
}

double WindowAverages::widening(double successive, double squares) const {
  if (squares <= 0 || batches_ < 3) return 1;
  const double n = static_cast<double>(batches_);
  const double seen = successive / (n - 1) / (squares / n);
  // Deviations from the window's own mean hide its error, w/n of the variance: what is seen of the correlation r is
  // (r - w/n)/(1 - w/n), and of the variance 1 - w/n.
  double correlation = 0;
  double w = 1;
  for (int turn = 0; turn < 20; ++turn) {
    correlation = std::clamp(seen * (1 - w / n) + w / n, 0.0, 0.8);
    w = std::min((1 + correlation) / (1 - correlation), n / 2);
  }
  return std::sqrt(w * (n - 1) / (n - w));
}

WindowAverages::Fields WindowAverages::fields() const {
  const double none = std::numeric_limits<double>::quiet_NaN();
  Fields fields;
  fields.fraction.resize(cells_);
  fields.contact_fraction.resize(cells_);
  fields.fraction_error.assign(cells_, none);
  fields.fraction_growth.assign(cells_, 0.0);
  fields.velocity.assign(3 * cells_, 0.0);
  fields.velocity_error.assign(3 * cells_, none);
  const double n = static_cast<double>(batches_);
  std::vector<double> variance(cells_ * columns);
  // Pooled over cells: sums of squared deviations and of products of successive ones, for fraction and velocity apart.
  std::array<double, 2> squares{}, successive{};
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    const double* closed = &total_[cell * integrals];
    const double* open = &running_[cell * integrals];
    const double fraction = closed[0] + open[0];
    if (seconds_ > 0) {
      fields.fraction[cell] = fraction / seconds_;
      fields.contact_fraction[cell] = (closed[4] + open[4]) / seconds_;
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (fraction > 0) fields.velocity[3 * cell + k] = (closed[1 + k] + open[1 + k]) / fraction;
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t i = cell * columns + k;
      const double mean = n > 0 ? sum_[i] / n : 0;
      variance[i] = std::max(0.0, sum_of_squares_[i] - n * mean * mean);
      squares[k == 0 ? 0 : 1] += variance[i];
      // sum over successive pairs of (b_j - mean)(b_(j-1) - mean)
      successive[k == 0 ? 0 : 1] +=
          sum_of_products_[i] - mean * (2 * sum_[i] - first_[i] - last_[i]) + (n - 1) * mean * mean;
    }
  }
  if (batches_ < 2) return fields;
  const std::array<double, 2> wide{widening(successive[0], squares[0]), widening(successive[1], squares[1])};
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    const double slope = 12 * (moment_[cell] - 0.5 * (n - 1) * sum_[cell * columns]) / (n * (n * n - 1));  // a batch
    fields.fraction_growth[cell] = slope * n / closed_seconds_;
    fields.fraction_error[cell] = wide[0] * std::sqrt(variance[cell * columns] / (n * (n - 1)));
    for (std::size_t k = 0; k < 3; ++k)
      fields.velocity_error[3 * cell + k] = wide[1] * std::sqrt(variance[cell * columns + 1 + k] / (n * (n - 1)));
  }
  return fields;
}

double WindowAverages::relative_error(const std::vector<bool>& cells) const {
  if (batches_ < 2) return std::numeric_limits<double>::quiet_NaN();
  const Fields found = fields();
  double error = 0;
  double square = 0;
  for (std::size_t cell = 0; cell < cells_; ++cell) {
    if (!cells[cell]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      error += found.fraction[cell] * std::pow(found.velocity_error[3 * cell + k], 2);
      square += found.fraction[cell] * std::pow(found.velocity[3 * cell + k], 2);
    }
  }
  return square > 0 ? std::sqrt(error / square) : std::numeric_limits<double>::quiet_NaN();
}

void WindowAverages::save(HdfWriter& file, const std::string& group) const {
  const std::string at = "Averages/" + group;
  file.write(at + "running", running_);
  file.write(at + "total", total_);
  file.write(at + "sum", sum_);
  file.write(at + "sum_of_squares", sum_of_squares_);
  file.write(at + "sum_of_products", sum_of_products_);
  file.write(at + "last", last_);
  file.write(at + "first", first_);
  file.write(at + "moment", moment_);
  file.write(at + "seconds", std::vector<double>{seconds_, running_seconds_, closed_seconds_});
  file.write(at + "batches", std::vector<std::int64_t>{batches_});
}

void WindowAverages::load(const HdfReader& file, const std::string& group) {
  const std::string at = "Averages/" + group;
  running_ = file.doubles(at + "running", static_cast<std::int64_t>(running_.size()));
  total_ = file.doubles(at + "total", static_cast<std::int64_t>(total_.size()));
  const auto rows = static_cast<std::int64_t>(sum_.size());
  sum_ = file.doubles(at + "sum", rows);
  sum_of_squares_ = file.doubles(at + "sum_of_squares", rows);
  sum_of_products_ = file.doubles(at + "sum_of_products", rows);
  last_ = file.doubles(at + "last", rows);
  first_ = file.doubles(at + "first", rows);
  moment_ = file.doubles(at + "moment", static_cast<std::int64_t>(moment_.size()));
  const auto seconds = file.doubles(at + "seconds", 3);
  seconds_ = seconds[0];
  running_seconds_ = seconds[1];
  closed_seconds_ = seconds[2];
  batches_ = file.integers(at + "batches", 1)[0];
}

}  // namespace cupola
