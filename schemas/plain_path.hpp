#pragma once
#include <filesystem>

namespace cupola {

/// A name of a folder that holds only letters, digits and `._-+/` of ASCII: OpenFOAM and LIGGGHTS end at a blank in a
/// path.  The folder's own absolute path where that is plain, else a symbolic link in the system's folder for temporary
/// files, named by the hash of that path, so that all ranks have the same; whoever made it removes it.
class PlainPath {
 public:
  /// @param folder need not exist. @throws Failure input_output where no link can be made
  explicit PlainPath(const std::filesystem::path& folder);
  ~PlainPath();
  PlainPath(const PlainPath&) = delete;
  PlainPath& operator=(const PlainPath&) = delete;
  PlainPath(PlainPath&&) = delete;
  PlainPath& operator=(PlainPath&&) = delete;

  [[nodiscard]] const std::filesystem::path& get() const { return path_; }

 private:
  std::filesystem::path path_;
  bool is_own_link_ = false;
};

}  // namespace cupola
