#include "orchestrator/study/data_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "schemas/failure.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char letter : line) {
    if (letter == ',')
      cells.emplace_back();
    else if (letter != ' ' && letter != '\t' && letter != '\r' && letter != '"')
      cells.back() += letter;
  }
  return cells;
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& sentence) {
  throw Failure(ExitCode::wrong_input, file.string() + sentence).at("file", file.string());
}

}  // namespace

DataTable read_data_table(const std::filesystem::path& file, const std::vector<std::string>& wanted) {
  if (!std::filesystem::is_regular_file(file))
    throw Failure(ExitCode::input_output, fmt::format("{}: there is no such file", file.string()))
        .at("file", file.string());
  std::istringstream text(read_text(file));
  std::vector<std::string> names;
  DataTable table;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.empty() || line == "\r" || line.front() == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    if (cells.size() != names.size())
      refuse(file, fmt::format(":{}: {} values, but {} columns", number, cells.size(), names.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double value = 0;
      const auto [end, error] = std::from_chars(cells[i].data(), cells[i].data() + cells[i].size(), value);
      if (error != std::errc() || end != cells[i].data() + cells[i].size() || !std::isfinite(value))
        refuse(file, fmt::format(":{}: column {}: `{}` is no number", number, names[i], cells[i]));
      table.columns[names[i]].push_back(value);
    }
  }
  for (const std::string& name : wanted)
    if (!table.columns.contains(name))
      refuse(file,
             fmt::format(": no column `{}` with numbers: expected the columns {} (SI units), found {}", name,
                         fmt::join(wanted, ", "), names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  return table;
}

}  // namespace cupola
