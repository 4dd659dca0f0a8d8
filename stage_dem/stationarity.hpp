#pragma once
#include <vector>

namespace cupola {

/// Drift of an evenly sampled series, in standard errors: the mean of its second half less that of its first, over the
/// standard error of that difference (Geweke 1992, with halves).  Each half is cut into batches, whose scatter gives
/// its standard error, so that what successive samples have in common is counted as long as batches are longer than
/// the memory of the series.  Infinite with fewer than `least_samples`; 0 for a constant series.
double drift(const std::vector<double>& series);

inline constexpr std::size_t batches_a_half = 5;
inline constexpr std::size_t least_samples = 2 * batches_a_half;
/// Up to so many standard errors a series counts as stationary: one in twenty stationary ones exceeds it.
inline constexpr double stationary_up_to = 2;

}  // namespace cupola
