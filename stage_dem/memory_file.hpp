#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace cupola {

/// A file that lies in memory and has a name as long as the object lives, for a library that reads and writes its state
/// by name.  LIGGGHTS does not look whether a write has worked: on a disk, a full one would leave it torn unnoticed.
class MemoryFile {
 public:
  /// @throws Failure input_output
  explicit MemoryFile(const std::vector<std::uint8_t>& content = {});
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  MemoryFile(MemoryFile&&) = delete;
  MemoryFile& operator=(MemoryFile&&) = delete;

  /// Good for this process only.
  [[nodiscard]] std::string name() const;
  /// What stands in it now. @throws Failure input_output
  [[nodiscard]] std::vector<std::uint8_t> bytes() const;

 private:
  int descriptor_;
};

}  // namespace cupola
