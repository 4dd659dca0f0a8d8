#include <fcntl.h>

#include <sstream>

#include "schemas/file_descriptor.hpp"
#include "schemas/files.hpp"

namespace cupola {

namespace {

constexpr const char* history_name = "history.jsonl";

std::string to_line(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace

void append_history(const std::filesystem::path& folder, const nlohmann::json& line) {
  FileDescriptor(folder / history_name, O_WRONLY | O_CREAT | O_APPEND).write(to_line(line));
}

void sync_history(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder / history_name)) FileDescriptor(folder / history_name, O_RDONLY).sync();
}

std::vector<nlohmann::json> read_history(const std::filesystem::path& folder) {
  std::vector<nlohmann::json> lines;
  if (!std::filesystem::exists(folder / history_name)) {
    return lines;
  }
  std::istringstream text(read_text(folder / history_name));
  for (std::string line; std::getline(text, line);) {
    nlohmann::json value = nlohmann::json::parse(line, nullptr, false);
    if (value.is_object()) {
      lines.push_back(std::move(value));
    }
  }
  return lines;
}

void cut_history(const std::filesystem::path& folder, long last_step) {
  if (!std::filesystem::exists(folder / history_name)) {
    return;
  }
  std::string kept;
  for (const nlohmann::json& line : read_history(folder)) {
    if (const auto step = line.find("step");
        step != line.end() && step->is_number() && step->get<double>() <= double(last_step)) {
      kept += to_line(line);
    }
  }
  write_text_atomically(folder / history_name, kept);
}

}  // namespace cupola
