#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "schemas/failure.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola::test {

/// Bytes as they stand on the disk, without the functions under test.
inline std::string raw_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_raw(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// The Failure that `action` ends with; fails the test (by throwing) where it ends well.
template <class Action>
Failure failure_of(Action action) {
  try {
    action();
  } catch (const Failure& failure) {
    return failure;
  }
  throw std::runtime_error("expected a Failure, none came");
}

}  // namespace cupola::test
