#pragma once
#include <hdf5.h>

#include <filesystem>
#include <optional>
#include <string>

/// What HdfWriter and HdfReader share; not for others, who need no HDF5 header.
namespace cupola::hdf {

/// An HDF5 identifier that closes itself.
class Handle {
 public:
  using Closer = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Closer closer) : id_(id), closer_(closer) {}
  Handle(Handle&& other) noexcept : id_(other.id_), closer_(other.closer_) { other.id_ = H5I_INVALID_HID; }
  Handle& operator=(Handle&& other) noexcept;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close(); }

  [[nodiscard]] hid_t get() const { return id_; }
  [[nodiscard]] explicit operator bool() const { return id_ >= 0; }
  /// Closes now. @return false where HDF5 reports an error (data that could not be flushed)
  bool close();

 private:
  hid_t id_ = H5I_INVALID_HID;
  Closer closer_ = nullptr;
};

/// File access without HDF5's own file locks (folders are locked by FolderLock, and a report reads while a stage
/// writes), in the format of HDF5 1.8, whose every structure but the values carries a checksum, and with its error
/// printing off, since errors leave as Failure.
Handle file_access();

/// Least version of the superblock, byte 8 of a file, from which on HDF5's structures have checksums.  The library
/// believes what older files say about themselves, and a damaged one can crash it.
constexpr unsigned char least_superblock = 2;

/// The deepest message on HDF5's error stack, for the end of a sentence; clears the stack.
std::string last_error();

/// Is there an object of this name?  Unlike H5Lexists, does not fail where a group on the way is missing.  None where
/// the file could not be read: `last_error` says why.
std::optional<bool> exists(hid_t file, const std::string& name);

}  // namespace cupola::hdf
