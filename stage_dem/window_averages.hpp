#pragma once
#include <string>
#include <vector>

#include "schemas/hdf.hpp"

namespace cupola {

/// One sample of the moving bed: arrays over all cells.
struct BedSample {
  std::vector<double> fraction;          ///< material volume fraction
  std::vector<double> contact_fraction;  ///< contact volume fraction
  std::vector<double> flux;              ///< material volume fraction x velocity, m/s, cells x 3
};

/// Averages of the bed over a window, with standard errors from the scatter of batch means.
///
/// Samples are gathered into batches of at least `batch_seconds`; the fields are means over all samples (the velocity
/// is the mean flux over the mean fraction), the standard error of a mean is sqrt(sum (b - mean)^2/(n (n - 1))) over
/// the n batches b, widened by sqrt(w (n - 1)/(n - w)), w = (1 + r)/(1 - r), with r the correlation of successive
/// batches, pooled over all cells and corrected for the window's own mean (0 where it is negative, at most 0.8): the
/// bed's velocity is correlated over about 0.2 s, its density over 0.75 s.
class WindowAverages {
 public:
  WindowAverages(std::size_t cells, double batch_seconds);

  void add(const BedSample& sample, double seconds);

  [[nodiscard]] double seconds() const { return seconds_; }
  [[nodiscard]] std::int64_t batches() const { return batches_; }

  /// Means and their standard errors; errors are NaN, and the growth zero, with fewer than two batches.
  struct Fields {
    std::vector<double> fraction, fraction_error, contact_fraction;
    std::vector<double> fraction_growth;           ///< 1/s: slope of the straight line through the batch means
    std::vector<double> velocity, velocity_error;  ///< m/s, cells x 3; velocity zero in empty cells
  };
  [[nodiscard]] Fields fields() const;

  /// rms of the velocity's standard error over rms of the velocity, weighted with the mean fraction, over the cells
  /// given; NaN with fewer than two batches.
  [[nodiscard]] double relative_error(const std::vector<bool>& cells) const;

  /// Under `Averages/` or a group below it, `group` ending with a slash.
  void save(HdfWriter& file, const std::string& group = "") const;
  void load(const HdfReader& file, const std::string& group = "");

 private:
  void close_batch();
  [[nodiscard]] double widening(double successive, double squares) const;

  static constexpr std::size_t columns = 4;  ///< fraction and the three velocities
  std::size_t cells_;
  double batch_seconds_;
  double seconds_ = 0;
  double running_seconds_ = 0;
  std::int64_t batches_ = 0;
  std::vector<double> running_;  ///< integral over the running batch: fraction, flux (x 3), contact fraction; cells x 5
  std::vector<double> total_;    ///< integral over all closed batches, the same
  std::vector<double> sum_;      ///< over batches, of batch means: fraction, velocity; cells x 4
  std::vector<double> sum_of_squares_;   ///< of the same
  std::vector<double> sum_of_products_;  ///< of a batch and the one before
  std::vector<double> last_;             ///< batch before
  std::vector<double> first_;            ///< first batch
  std::vector<double> moment_;           ///< sum over batches of number (from 0) x mean fraction; cells
  double closed_seconds_ = 0;            ///< of all closed batches
};

}  // namespace cupola
