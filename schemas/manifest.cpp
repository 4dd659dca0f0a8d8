#include <fmt/format.h>

#include <functional>
#include <map>

#include "schemas/files.hpp"

namespace cupola {

namespace {

constexpr const char* manifest_name = "manifest.json";

/// Does the manifest answer for this file (path relative to the task folder)?
bool is_listed(const std::filesystem::path& file) {
  if (*file.begin() == "foam") {
    return file == "foam/mesh.hdf" || file == "foam/wall.stl";
  }
  const std::string name = file.filename().string();
  const std::string extension = file.extension().string();
  return name != manifest_name && name != "lock" && name != "progress.json" && extension != ".log" &&
         extension != ".part" && name.rfind("checkpoint-", 0) != 0 && name.rfind("log.", 0) != 0;
}

Failure differs(const std::filesystem::path& file, const std::string& how) {
  return Failure(ExitCode::input_output,
                 fmt::format("{}: {} than {} says: the file is damaged or was changed after the stage "
                             "ended; remove its task folder and run again",
                             file.string(), how, manifest_name))
      .at("file", file.string());
}

}  // namespace

void write_manifest(const std::filesystem::path& folder) {
  sync_history(folder);
  // Ordered, so that equal folders have equal manifests.
  std::map<std::string, nlohmann::json> files;
  for (auto entry = std::filesystem::recursive_directory_iterator(folder); entry != std::filesystem::end(entry);
       ++entry) {
    const std::filesystem::path relative = entry->path().lexically_relative(folder);
    if (entry->is_directory() && entry.depth() > 0 && *relative.begin() == "foam") {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file() && is_listed(relative)) {
      files[relative.string()] = {{"size", entry->file_size()}, {"hash", hash_file(entry->path())}};
    }
  }
  write_sealed_json(folder / manifest_name, {{"schema", 1}, {"files", files}});
}

bool has_manifest(const std::filesystem::path& folder) {
  return std::filesystem::is_regular_file(folder / manifest_name);
}

namespace {

/// Hands over what is wrong with the files, in the order of the manifest.
void check_manifest(const std::filesystem::path& folder, const std::function<void(const Failure&)>& take) {
  const nlohmann::json manifest = read_sealed_json(folder / manifest_name);
  try {
    for (const auto& [name, expected] : manifest.at("files").items()) {
      const std::filesystem::path file = folder / name;
      if (!std::filesystem::is_regular_file(file)) {
        take(Failure(ExitCode::input_output,
                     fmt::format("{}: missing, although {} lists it; remove its task folder and run again",
                                 file.string(), manifest_name))
                 .at("file", file.string()));
      } else if (std::filesystem::file_size(file) != expected.at("size").get<std::uintmax_t>()) {
        take(differs(file, "another size"));
      } else if (hash_file(file) != expected.at("hash").get<std::string>()) {
        take(differs(file, "other content"));
      }
    }
  } catch (const nlohmann::json::exception& error) {
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: not a manifest: {}", (folder / manifest_name).string(), error.what()));
  }
}

}  // namespace

void verify_manifest(const std::filesystem::path& folder) {
  check_manifest(folder, [](const Failure& failure) { throw failure; });
}

std::vector<std::string> manifest_problems(const std::filesystem::path& folder) {
  std::vector<std::string> problems;
  try {
    check_manifest(folder, [&](const Failure& failure) { problems.emplace_back(failure.what()); });
  } catch (const Failure& failure) {
    problems.emplace_back(failure.what());
  }
  return problems;
}

}  // namespace cupola
