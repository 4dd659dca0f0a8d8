#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

/// POSIX files, for the sources of schemas/files.hpp only.
namespace cupola {

/// An open file that closes itself.
class FileDescriptor {
 public:
  /// open(2) with close-on-exec; new files get mode 0644. @throws Failure input_output
  FileDescriptor(const std::filesystem::path& file, int flags);
  ~FileDescriptor();
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  FileDescriptor(FileDescriptor&&) = delete;
  FileDescriptor& operator=(FileDescriptor&&) = delete;

  [[nodiscard]] int get() const { return descriptor_; }
  /// Hands the open file over to the caller.
  [[nodiscard]] int release();
  /// Writes all of it. @throws Failure input_output
  void write(const std::string& text) const;
  /// Up to `count` bytes into `buffer`; fewer only at the end of the file. @throws Failure input_output
  [[nodiscard]] std::size_t read(char* buffer, std::size_t count) const;
  /// fsync(2); file systems that cannot sync a folder are forgiven. @throws Failure input_output
  void sync() const;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Failure input_output with the reason of the last system call (errno): `FILE: cannot DO: reason`.
[[noreturn]] void throw_system_failure(const std::filesystem::path& file, const std::string& what);

}  // namespace cupola
