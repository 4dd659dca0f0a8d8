#pragma once

namespace cupola {

/// Times of the DEM stage are sums of whole blocks: less than this apart they are the same, s.
inline constexpr double same_time = 1e-9;

}  // namespace cupola
