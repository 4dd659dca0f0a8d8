#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cupola {

/// Reading and writing HDF5 with the serial library.  Names are paths inside the file (`Packing/position`); groups on the way are
/// made.  A matrix is row-major with `columns` columns.
class HdfWriter {
 public:
  /// Opens a temporary file beside `file`; `commit` puts it in place (synced, then renamed).  Without commit nothing is left.
  explicit HdfWriter(std::filesystem::path file);
  ~HdfWriter();
  HdfWriter(const HdfWriter&) = delete;
  HdfWriter& operator=(const HdfWriter&) = delete;

  void write(const std::string& name, const std::vector<double>& values, std::size_t columns = 1);
  void write(const std::string& name, const std::vector<std::int64_t>& values, std::size_t columns = 1);
  void write(const std::string& name, const std::vector<std::uint8_t>& values);
  void write_text(const std::string& name, const std::string& value);        ///< a scalar UTF-8 string dataset
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, std::int64_t value);
  void attribute(const std::string& object, const std::string& name, const std::vector<std::int64_t>& value);
  void attribute(const std::string& object, const std::string& name, const std::string& value);  ///< fixed-length ASCII
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

  [[nodiscard]] bool has(const std::string& name) const;
  /// Names directly under a group, sorted.
  [[nodiscard]] std::vector<std::string> names(const std::string& group) const;
  /// @throws Failure wrong_input naming file and dataset: missing, of another type, or (expected_rows >= 0) of another length
  [[nodiscard]] std::vector<double> doubles(const std::string& name, std::int64_t expected_rows = -1) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& name, std::int64_t expected_rows = -1) const;
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
