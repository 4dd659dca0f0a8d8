#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cupola {

/// Writing HDF5 with the serial library.  Names are paths inside the file (`Packing/position`); groups on the way are
/// made.  A matrix is row-major; with `columns` = 1 the dataset has one dimension, else two.  Whatever HDF5 refuses is
/// a Failure (input_output) that names file and dataset.
class HdfWriter {
 public:
  /// Opens a temporary file beside `file`; `commit` puts it in place (synced, then renamed).  Without commit nothing is
  /// left.
  explicit HdfWriter(std::filesystem::path file);
  ~HdfWriter();
  HdfWriter(const HdfWriter&) = delete;
  HdfWriter& operator=(const HdfWriter&) = delete;
  HdfWriter(HdfWriter&&) = delete;
  HdfWriter& operator=(HdfWriter&&) = delete;

  /// @throws Failure also where the number of values is no multiple of `columns`
  void write(const std::string& name, const std::vector<double>& values, std::size_t columns = 1);
  void write(const std::string& name, const std::vector<std::int64_t>& values, std::size_t columns = 1);
  void write(const std::string& name, const std::vector<std::uint8_t>& values);
  void write_text(const std::string& name,
                  const std::string& value);  ///< a scalar UTF-8 string dataset of fixed length
  /// Attributes of the object `object` (a group is made where there is none); "/" is the root.
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, std::int64_t value);
  void attribute(const std::string& object, const std::string& name, const std::vector<std::int64_t>& value);
  void attribute(const std::string& object, const std::string& name, const std::string& value);  ///< fixed-length ASCII
  void attribute(const std::string& object, const std::string& name, const char* value) {
    attribute(object, name, std::string(value));
  }
  /// Closes, syncs and renames.  Nothing can be written after it.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

class HdfReader {
 public:
  /// @throws Failure input_output: not there, truncated or not an HDF5 file
  explicit HdfReader(std::filesystem::path file);
  ~HdfReader();
  HdfReader(const HdfReader&) = delete;
  HdfReader& operator=(const HdfReader&) = delete;
  HdfReader(HdfReader&&) = delete;
  HdfReader& operator=(HdfReader&&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const;
  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] bool has_attribute(const std::string& object, const std::string& name) const;
  /// Names directly under a group, sorted; empty where there is no such group.
  [[nodiscard]] std::vector<std::string> names(const std::string& group) const;
  /// Rows and columns of a dataset (one column where it has one dimension). @throws Failure wrong_input where there is
  /// none
  [[nodiscard]] std::pair<std::size_t, std::size_t> shape(const std::string& name) const;
  /// @throws Failure wrong_input naming file and dataset: missing, of another type, or (where not negative) of another
  /// number of rows or columns; input_output where the stored bytes are missing
  [[nodiscard]] std::vector<double> doubles(const std::string& name, std::int64_t expected_rows = -1,
                                            std::int64_t expected_columns = -1) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& name, std::int64_t expected_rows = -1,
                                                   std::int64_t expected_columns = -1) const;
  [[nodiscard]] std::vector<std::uint8_t> bytes(const std::string& name) const;
  [[nodiscard]] std::string text(const std::string& name) const;
  [[nodiscard]] double number_attribute(const std::string& object, const std::string& name) const;
  [[nodiscard]] std::int64_t integer_attribute(const std::string& object, const std::string& name) const;
  [[nodiscard]] std::string text_attribute(const std::string& object, const std::string& name) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace cupola
