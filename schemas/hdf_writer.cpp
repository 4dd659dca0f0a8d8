#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "schemas/files.hpp"
#include "schemas/hdf.hpp"
#include "schemas/hdf_handle.hpp"

namespace cupola {

namespace {

/// How to create an object without time stamps, so that the same content has the same hash whenever it is written.
hdf::Handle timeless(hid_t kind) {
  hdf::Handle creation(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  return creation;
}

std::string parent_of(const std::string& name) {
  const auto slash = name.find_last_of('/');
  return slash == std::string::npos ? "" : name.substr(0, slash);
}

}  // namespace

struct HdfWriter::State {
  std::filesystem::path final_file;
  std::filesystem::path temporary_file;
  hdf::Handle handle;

  [[noreturn]] void fail(const std::string& what) const {
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: cannot write {}: {}", final_file.string(), what, hdf::last_error()))
        .at("file", final_file.string());
  }

  [[nodiscard]] hid_t file() const {
    if (!handle) {
      throw Failure(ExitCode::input_output,
                    fmt::format("{}: written to after it was put in place", final_file.string()));
    }
    return handle.get();
  }

  /// Makes a group and those on the way to it, where they are not there yet.
  void make_group(const std::string& name) const {
    if (name.empty() || name == "/") return;
    const auto there = hdf::exists(file(), name);
    if (!there) fail("group '" + name + "'");
    if (*there) return;
    make_group(parent_of(name));
    const auto creation = timeless(H5P_GROUP_CREATE);
    hdf::Handle group(H5Gcreate2(file(), name.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), H5Gclose);
    if (!group || !group.close()) fail("group '" + name + "'");
  }

  /// One dataset of raw memory of a given type, groups on the way made.
  void dataset(const std::string& name, hid_t type, const hdf::Handle& space, const void* values) const {
    make_group(parent_of(name));
    const auto creation = timeless(H5P_DATASET_CREATE);
    hdf::Handle set(H5Dcreate2(file(), name.c_str(), type, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                    H5Dclose);
    // Small datasets are written when they are closed: a failure shows there and never again.
    if (!set || H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0 || !set.close()) {
      fail("dataset '" + name + "'");
    }
  }

  template <class Value>
  void matrix(const std::string& name, hid_t type, const std::vector<Value>& values, std::size_t columns) const {
    if (columns == 0 || values.size() % columns != 0) {
      throw Failure(ExitCode::input_output, fmt::format("{}: dataset '{}': {} values do not fill rows of {}",
                                                        final_file.string(), name, values.size(), columns));
    }
    const std::array<hsize_t, 2> extent{values.size() / columns, columns};
    dataset(name, type, hdf::Handle(H5Screate_simple(columns == 1 ? 1 : 2, extent.data(), nullptr), H5Sclose),
            values.data());
  }

  void attribute(const std::string& object, const std::string& name, hid_t type, const hdf::Handle& space,
                 const void* value) const {
    make_group(object);
    hdf::Handle written(H5Acreate_by_name(file(), object.c_str(), name.c_str(), type, space.get(), H5P_DEFAULT,
                                          H5P_DEFAULT, H5P_DEFAULT),
                        H5Aclose);
    if (!written || H5Awrite(written.get(), type, value) < 0 || !written.close()) {
      fail(fmt::format("attribute '{}' of '{}'", name, object));
    }
  }
};

namespace {

hdf::Handle scalar() { return {H5Screate(H5S_SCALAR), H5Sclose}; }

/// A fixed-length string type; HDF5 has none of length 0, so that an empty text is one null character.
hdf::Handle string_type(std::size_t length, H5T_cset_t characters) {
  hdf::Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(length, 1));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), characters);
  return type;
}

}  // namespace

HdfWriter::HdfWriter(std::filesystem::path file) : state_(std::make_unique<State>()) {
  state_->final_file = std::move(file);
  state_->temporary_file = temporary_beside(state_->final_file);
  const auto creation = timeless(H5P_FILE_CREATE);
  const hdf::Handle access = hdf::file_access();  // closing it would clear what HDF5 says
  state_->handle =
      hdf::Handle(H5Fcreate(state_->temporary_file.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  if (!state_->handle) {
    state_->fail("the file");
  }
}

HdfWriter::~HdfWriter() {
  if (state_->handle) {
    state_->handle.close();
    std::error_code ignored;
    std::filesystem::remove(state_->temporary_file, ignored);
  }
}

void HdfWriter::write(const std::string& name, const std::vector<double>& values, std::size_t columns) {
  state_->matrix(name, H5T_NATIVE_DOUBLE, values, columns);
}

void HdfWriter::write(const std::string& name, const std::vector<std::int64_t>& values, std::size_t columns) {
  state_->matrix(name, H5T_NATIVE_INT64, values, columns);
}

void HdfWriter::write(const std::string& name, const std::vector<std::uint8_t>& values) {
  state_->matrix(name, H5T_NATIVE_UINT8, values, 1);
}

void HdfWriter::write_text(const std::string& name, const std::string& value) {
  state_->dataset(name, string_type(value.size(), H5T_CSET_UTF8).get(), scalar(), value.c_str());
}

void HdfWriter::attribute(const std::string& object, const std::string& name, double value) {
  state_->attribute(object, name, H5T_NATIVE_DOUBLE, scalar(), &value);
}

void HdfWriter::attribute(const std::string& object, const std::string& name, std::int64_t value) {
  state_->attribute(object, name, H5T_NATIVE_INT64, scalar(), &value);
}

void HdfWriter::attribute(const std::string& object, const std::string& name, const std::vector<std::int64_t>& value) {
  const hsize_t extent = value.size();
  state_->attribute(object, name, H5T_NATIVE_INT64, {H5Screate_simple(1, &extent, nullptr), H5Sclose}, value.data());
}

void HdfWriter::attribute(const std::string& object, const std::string& name, const std::string& value) {
  state_->attribute(object, name, string_type(value.size(), H5T_CSET_ASCII).get(), scalar(), value.c_str());
}

void HdfWriter::commit() {
  if (H5Fflush(state_->file(), H5F_SCOPE_GLOBAL) < 0) {
    state_->fail("the file to disk");
  }
  if (!state_->handle.close()) {
    state_->fail("the file to disk");
  }
  publish(state_->temporary_file, state_->final_file);
}

}  // namespace cupola
