#pragma once
#include <filesystem>

namespace cupola {

/// A name of a folder for libraries that stumble over blanks, quotes and the like in a path (OpenFOAM drops them,
/// LIGGGHTS splits its commands at them): the name itself where it is plain, else /proc/self/fd/N, which holds in this
/// process and in those it starts for as long as this object lives.
class PlainPath {
 public:
  /// @throws Failure input_output where the folder cannot be opened
  explicit PlainPath(const std::filesystem::path& folder);
  ~PlainPath();
  PlainPath(const PlainPath&) = delete;
  PlainPath& operator=(const PlainPath&) = delete;
  PlainPath(PlainPath&&) = delete;
  PlainPath& operator=(PlainPath&&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

}  // namespace cupola
