#include <limits>

#include "schemas/files.hpp"

namespace cupola {

namespace {

/// JSON has no NaN: it is written as null, which must come back as NaN.
double number(const nlohmann::json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

}  // namespace

void write_progress(const std::filesystem::path& folder, const Progress& progress) {
  write_json_atomically(folder / "progress.json", {{"step", progress.step},
                                                   {"process_seconds", progress.process_seconds},
                                                   {"process_seconds_total", progress.process_seconds_total},
                                                   {"wall_seconds", progress.wall_seconds},
                                                   {"rate", progress.rate},
                                                   {"phase", progress.phase},
                                                   {"monitored", progress.monitored}});
}

std::optional<Progress> read_progress(const std::filesystem::path& folder) {
  try {
    const nlohmann::json file = read_json(folder / "progress.json");
    Progress progress;
    progress.step = file.at("step").get<long>();
    progress.process_seconds = number(file.at("process_seconds"));
    progress.process_seconds_total = number(file.at("process_seconds_total"));
    progress.wall_seconds = number(file.at("wall_seconds"));
    progress.rate = number(file.at("rate"));
    progress.phase = file.at("phase").get<std::string>();
    for (const auto& [name, value] : file.at("monitored").items()) {
      progress.monitored[name] = number(value);
    }
    return progress;
  } catch (const Failure&) {
    return std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

void write_failure(const std::filesystem::path& folder, const Failure& failure) {
  write_sealed_json(folder / "failure.json", {{"code", static_cast<int>(failure.code())},
                                              {"sentence", failure.what()},
                                              {"where", failure.where()},
                                              {"advice", failure.advice()}});
}

std::optional<nlohmann::json> read_failure(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "failure.json";
  if (!std::filesystem::exists(file)) {
    return std::nullopt;
  }
  nlohmann::json failure = read_json(file);
  return failure.contains("hash") ? read_sealed_json(file) : failure;
}

}  // namespace cupola
