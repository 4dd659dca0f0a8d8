#pragma once
#include <Random123/philox.h>

#include <cstdint>

namespace cupola {

/// Uniform numbers in [0, 1) from the counter-based generator Philox 4x32-10 (Salmon et al. 2011): the n-th number
/// depends on seed, stream and n alone, so it is the same on any number of ranks and after a restart, with nothing to
/// save.
class RandomNumbers {
 public:
  /// What the numbers are for, so that no two uses share a sequence.
  enum class Use : std::uint32_t { building, charging, raceway };

  RandomNumbers(std::uint64_t seed, Use use, std::uint64_t stream)
      : key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)}},
        counter_{{0, static_cast<std::uint32_t>(use), static_cast<std::uint32_t>(stream),
                  static_cast<std::uint32_t>(stream >> 32U)}} {}

  double next() {
    if (used_ == 2) {
      block_ = r123::Philox4x32()(counter_, key_);
      ++counter_[0];
      used_ = 0;
    }
    const std::uint64_t bits = (static_cast<std::uint64_t>(block_[2 * used_]) << 32U) | block_[2 * used_ + 1];
    ++used_;
    return static_cast<double>(bits >> 11U) * 0x1.0p-53;
  }

 private:
  r123::Philox4x32::key_type key_;
  r123::Philox4x32::ctr_type counter_;
  r123::Philox4x32::ctr_type block_{};
  std::size_t used_ = 2;
};

}  // namespace cupola
