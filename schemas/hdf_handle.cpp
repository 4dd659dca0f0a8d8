#include "schemas/hdf_handle.hpp"

#include <string_view>

namespace cupola::hdf {

namespace {

/// A file that could not be flushed crashes the library when it tidies up at the program's end; all files are closed
/// by then.  It must be told before its first use.
[[maybe_unused]] const herr_t no_tidying_at_the_end = H5dont_atexit();

}  // namespace

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    close();
    id_ = other.id_;
    closer_ = other.closer_;
    other.id_ = H5I_INVALID_HID;
  }
  return *this;
}

bool Handle::close() {
  const bool good = id_ < 0 || closer_(id_) >= 0;
  id_ = H5I_INVALID_HID;
  return good;
}

Handle file_access() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.get(), false, true);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  return access;
}

std::string last_error() {
  std::string message;
  const auto visit = [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
    if (error->desc != nullptr && *error->desc != '\0') {
      *static_cast<std::string*>(text) = error->desc;
    }
    return 0;
  };
  // From the outermost call inwards, so that the last one visited is the cause.
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, visit, &message);
  H5Eclear2(H5E_DEFAULT);
  // Where the system refused, its own words are inside, after the time and the numbers of descriptors.
  static constexpr std::string_view system_words = "error message = '";
  if (const auto begin = message.find(system_words); begin != std::string::npos) {
    const auto first = begin + system_words.size();
    return message.substr(first, message.find('\'', first) - first);
  }
  return message.empty() ? "no reason given by HDF5" : message;
}

std::optional<bool> exists(hid_t file, const std::string& name) {
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    const std::string part = name.substr(0, end);
    const htri_t there = part == "/" ? 1 : H5Lexists(file, part.c_str(), H5P_DEFAULT);
    if (there < 0) return std::nullopt;
    if (there == 0) return false;
    if (end == std::string::npos) return true;
    // Nothing is below a dataset; HDF5 would call that an error too.
    const Handle object(H5Oopen(file, part.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object) return std::nullopt;
    if (H5Iget_type(object.get()) != H5I_GROUP) return false;
  }
}

}  // namespace cupola::hdf
