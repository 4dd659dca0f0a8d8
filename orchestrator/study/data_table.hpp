#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace cupola {

/// Published data: a CSV file whose first line names the columns; `#` begins a comment line.
struct DataTable {
  std::map<std::string, std::vector<double>> columns;
  [[nodiscard]] std::size_t rows() const { return columns.begin()->second.size(); }
};

/// @param wanted names of the columns that must be there
/// @throws Failure input_output: no such file; wrong_input naming line and column: no number, a column is missing, no
/// rows
DataTable read_data_table(const std::filesystem::path& file, const std::vector<std::string>& wanted);

}  // namespace cupola
