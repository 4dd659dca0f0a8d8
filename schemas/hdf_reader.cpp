#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "schemas/failure.hpp"
#include "schemas/file_descriptor.hpp"
#include "schemas/hdf.hpp"
#include "schemas/hdf_handle.hpp"

namespace cupola {

struct HdfReader::State {
  std::filesystem::path path;
  hdf::Handle file;

  [[nodiscard]] Failure failure(ExitCode code, const std::string& what) const {
    return Failure(code, path.string() + ": " + what).at("file", path.string());
  }

  [[nodiscard]] Failure wrong(const std::string& name, const std::string& what) const {
    return failure(ExitCode::wrong_input, fmt::format("dataset '{}' {}", name, what)).at("dataset", name);
  }

  /// What HDF5 could not do: a failed read must never look like something that is not there.
  [[nodiscard]] Failure unreadable(const std::string& what) const {
    return failure(ExitCode::input_output, fmt::format("{} cannot be read: {}", what, hdf::last_error()));
  }

  [[nodiscard]] bool has(const std::string& name) const {
    const auto there = hdf::exists(file.get(), name);
    if (!there) throw unreadable("'" + name + "'");
    return *there;
  }

  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const {
    if (object != "/" && !has(object)) return false;
    const htri_t there = H5Aexists_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT);
    if (there < 0) throw unreadable(fmt::format("attribute '{}' of '{}'", name, object));
    return there > 0;
  }

  [[nodiscard]] hdf::Handle open(const std::string& name) const {
    if (!has(name)) {
      throw wrong(name, "is missing: the file was written by another kind of task or by an older program");
    }
    hdf::Handle set(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set) {
      throw unreadable("dataset '" + name + "'");
    }
    return set;
  }

  [[nodiscard]] std::pair<std::size_t, std::size_t> shape(const std::string& name, const hdf::Handle& set) const {
    const hdf::Handle space(H5Dget_space(set.get()), H5Sclose);
    const int dimensions = H5Sget_simple_extent_ndims(space.get());
    if (dimensions < 0 || dimensions > 2) {
      throw wrong(name, "is neither a column nor a table");
    }
    std::array<hsize_t, 2> extent{1, 1};
    H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
    if (extent[1] == 0) {
      throw wrong(name, "is a table without columns");
    }
    return {extent[0], extent[1]};
  }

  template <class Value>
  [[nodiscard]] std::vector<Value> read(const std::string& name, H5T_class_t wanted, const char* wanted_name,
                                        hid_t memory, std::int64_t rows, std::int64_t columns) const {
    const hdf::Handle set = open(name);
    const hdf::Handle type(H5Dget_type(set.get()), H5Tclose);
    if (H5Tget_class(type.get()) != wanted || H5Tget_size(type.get()) > sizeof(Value)) {
      throw wrong(name, fmt::format("does not hold {}", wanted_name));
    }
    const auto [stored_rows, stored_columns] = shape(name, set);
    if (rows >= 0 && stored_rows != static_cast<std::size_t>(rows)) {
      throw wrong(name, fmt::format("has {} rows where {} are expected: it belongs to another mesh or packing",
                                    stored_rows, rows));
    }
    if (columns >= 0 && stored_columns != static_cast<std::size_t>(columns)) {
      throw wrong(name, fmt::format("has {} columns where {} are expected", stored_columns, columns));
    }
    // A damaged header may announce any size: believe it only as far as there are bytes.
    const std::size_t width = H5Tget_size(type.get());
    const std::size_t stored = H5Dget_storage_size(set.get()) / std::max<std::size_t>(width, 1);
    if (stored_columns != 0 && stored_rows > stored / stored_columns) {
      throw failure(ExitCode::input_output,
                    fmt::format("dataset '{}' announces {} x {} values and holds {}: the file is damaged", name,
                                stored_rows, stored_columns, stored));
    }
    std::vector<Value> values(stored_rows * stored_columns);
    if (H5Dread(set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
      throw unreadable("dataset '" + name + "'");
    }
    return values;
  }

  [[nodiscard]] hdf::Handle open_attribute(const std::string& object, const std::string& name,
                                           H5T_class_t wanted) const {
    if (!has_attribute(object, name)) {
      throw failure(ExitCode::wrong_input, fmt::format("attribute '{}' of '{}' is missing", name, object));
    }
    hdf::Handle attribute(H5Aopen_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose);
    if (!attribute) throw unreadable(fmt::format("attribute '{}' of '{}'", name, object));
    const hdf::Handle type(H5Aget_type(attribute.get()), H5Tclose);
    const hdf::Handle space(H5Aget_space(attribute.get()), H5Sclose);
    if (H5Tget_class(type.get()) != wanted || H5Sget_simple_extent_npoints(space.get()) != 1) {
      throw failure(ExitCode::wrong_input,
                    fmt::format("attribute '{}' of '{}' has another type than expected", name, object));
    }
    return attribute;
  }

  template <class Value>
  [[nodiscard]] Value attribute(const std::string& object, const std::string& name, H5T_class_t wanted,
                                hid_t memory) const {
    const hdf::Handle attribute = open_attribute(object, name, wanted);
    Value value{};
    if (H5Aread(attribute.get(), memory, &value) < 0) {
      throw unreadable(fmt::format("attribute '{}' of '{}'", name, object));
    }
    return value;
  }

  /// Reads a fixed-length string by means of `reader(memory type, buffer)` and takes the padding off.
  template <class Reader>
  [[nodiscard]] std::string fixed_text(const hdf::Handle& type, const std::string& what, Reader reader) const {
    if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) > 0) {
      throw failure(ExitCode::wrong_input, what + " is not a text of fixed length");
    }
    std::error_code unknown;
    const std::uintmax_t file_size = std::filesystem::file_size(path, unknown);
    const std::size_t length = H5Tget_size(type.get());
    if (unknown || length > file_size) {
      throw failure(ExitCode::input_output, what + " is longer than the file: the file is damaged");
    }
    std::string value(length, '\0');
    if (reader(type.get(), value.data()) < 0) {
      throw unreadable(what);
    }
    value.resize(value.find_last_not_of('\0') + 1);
    return value;
  }
};

HdfReader::HdfReader(std::filesystem::path file) : state_(std::make_unique<State>()) {
  state_->path = std::move(file);
  std::error_code problem;
  const auto kind = std::filesystem::status(state_->path, problem).type();
  if (kind == std::filesystem::file_type::none) {
    throw state_->failure(ExitCode::input_output, "cannot be looked at: " + problem.message());
  }
  if (kind != std::filesystem::file_type::regular) {
    throw state_->failure(ExitCode::input_output, "there is no such file");
  }
  // HDF5 looks for its signature further on where it is not at the beginning; ours is there.
  std::array<char, 9> head{};
  static_cast<void>(FileDescriptor(state_->path, O_RDONLY).read(head.data(), head.size()));
  if (std::memcmp(head.data(), "\x89HDF\r\n\x1a\n", 8) != 0) {
    throw state_->failure(ExitCode::input_output, "not a whole HDF5 file (no signature at its beginning)");
  }
  if (static_cast<unsigned char>(head[8]) < hdf::least_superblock) {
    throw state_->failure(ExitCode::input_output,
                          "not a whole HDF5 file (of a version without checksums, which cupola does not write)");
  }
  const hdf::Handle access = hdf::file_access();  // closing it would clear what HDF5 says
  state_->file = {H5Fopen(state_->path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
  if (!state_->file) {
    throw state_->failure(ExitCode::input_output, "not a whole HDF5 file (" + hdf::last_error() + ")");
  }
}

HdfReader::~HdfReader() = default;

const std::filesystem::path& HdfReader::file() const { return state_->path; }

bool HdfReader::has(const std::string& name) const { return state_->has(name); }

bool HdfReader::has_attribute(const std::string& object, const std::string& name) const {
  return state_->has_attribute(object, name);
}

std::vector<std::string> HdfReader::names(const std::string& group) const {
  std::vector<std::string> found;
  if (group != "/" && !has(group)) {
    return found;
  }
  const hdf::Handle opened(H5Gopen2(state_->file.get(), group.c_str(), H5P_DEFAULT), H5Gclose);
  const auto visit = [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (!opened || H5Literate(opened.get(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, visit, &found) < 0) {
    throw state_->unreadable("group '" + group + "'");
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::pair<std::size_t, std::size_t> HdfReader::shape(const std::string& name) const {
  return state_->shape(name, state_->open(name));
}

std::vector<double> HdfReader::doubles(const std::string& name, std::int64_t rows, std::int64_t columns) const {
  return state_->read<double>(name, H5T_FLOAT, "floating-point numbers", H5T_NATIVE_DOUBLE, rows, columns);
}

std::vector<std::int64_t> HdfReader::integers(const std::string& name, std::int64_t rows, std::int64_t columns) const {
  return state_->read<std::int64_t>(name, H5T_INTEGER, "whole numbers", H5T_NATIVE_INT64, rows, columns);
}

std::vector<std::uint8_t> HdfReader::bytes(const std::string& name) const {
  return state_->read<std::uint8_t>(name, H5T_INTEGER, "bytes", H5T_NATIVE_UINT8, -1, 1);
}

std::string HdfReader::text(const std::string& name) const {
  const hdf::Handle set = state_->open(name);
  const hdf::Handle type(H5Dget_type(set.get()), H5Tclose);
  const hdf::Handle space(H5Dget_space(set.get()), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.get()) != 1) {
    throw state_->wrong(name, "does not hold one text");
  }
  return state_->fixed_text(type, "dataset '" + name + "'", [&](hid_t memory, void* buffer) {
    return H5Dread(set.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
  });
}

double HdfReader::number_attribute(const std::string& object, const std::string& name) const {
  return state_->attribute<double>(object, name, H5T_FLOAT, H5T_NATIVE_DOUBLE);
}

std::int64_t HdfReader::integer_attribute(const std::string& object, const std::string& name) const {
  return state_->attribute<std::int64_t>(object, name, H5T_INTEGER, H5T_NATIVE_INT64);
}

std::string HdfReader::text_attribute(const std::string& object, const std::string& name) const {
  const hdf::Handle attribute = state_->open_attribute(object, name, H5T_STRING);
  const hdf::Handle type(H5Aget_type(attribute.get()), H5Tclose);
  return state_->fixed_text(type, fmt::format("attribute '{}' of '{}'", name, object),
                            [&](hid_t memory, void* buffer) { return H5Aread(attribute.get(), memory, buffer); });
}

}  // namespace cupola
