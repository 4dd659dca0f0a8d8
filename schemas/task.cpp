#include "schemas/task.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "schemas/campaign_from_document.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "schemas/resolved_campaign.hpp"
#include "schemas/version.hpp"
#include "schemas/yaml_text.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

/// In the order of TaskKind.
constexpr std::array<const char*, 4> kind_names = {"dem", "tracer", "predict", "correct"};
constexpr const char* task_file = "task.yaml";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& sentence) {
  throw Failure(ExitCode::wrong_input, file.string() + ": " + sentence).at("file", file.string());
}

/// Reads the members of a task; every complaint names file and key.
class Members {
 public:
  Members(const Json& json, std::filesystem::path file, std::string where)
      : json_(json), file_(std::move(file)), where_(std::move(where)) {
    if (!json_.is_object()) refuse(file_, fmt::format("`{}` must be a section of keys", where_));
  }

  [[nodiscard]] const Json& at(const std::string& key) const {
    if (!json_.contains(key)) refuse(file_, fmt::format("the key `{}` is missing", path_of(where_, key)));
    return json_.at(key);
  }
  [[nodiscard]] std::string text(const std::string& key) const {
    if (!at(key).is_string()) refuse(file_, fmt::format("`{}` must be a text", path_of(where_, key)));
    return at(key).get<std::string>();
  }
  [[nodiscard]] std::uint64_t count(const std::string& key) const {
    const auto& value = at(key);
    if (!value.is_number_integer() || (!value.is_number_unsigned() && value.get<std::int64_t>() < 0)) {
      refuse(file_, fmt::format("`{}` must be a whole number", path_of(where_, key)));
    }
    return value.get<std::uint64_t>();
  }

 private:
  const Json& json_;
  std::filesystem::path file_;
  std::string where_;
};

TaskInput read_input(const std::filesystem::path& folder, const Members& members, const std::string& name) {
  TaskInput input{members.text("file"), members.text("hash")};
  const auto file = folder / input.file;
  if (!std::filesystem::exists(file)) {
    refuse(folder / task_file, fmt::format("the input `{}` is not there: {}", name, file.string()));
  }
  if (const auto hash = hash_file(file); hash != input.hash) {
    refuse(folder / task_file,
           fmt::format("the input `{}` has another content than this task was made for: {} has hash {}, expected {}",
                       name, file.string(), hash, input.hash));
  }
  return input;
}

}  // namespace

std::string task_text(const Task& task) {
  Json inputs = Json::object();
  for (const auto& [name, input] : task.inputs) inputs[name] = {{"file", input.file.string()}, {"hash", input.hash}};
  const Json json{{"schema", file_schema_version},
                  {"kind", kind_names.at(static_cast<std::size_t>(task.kind))},
                  {"episode", task.episode},
                  {"campaign_hash", task.campaign_hash},
                  {"program_version", task.program_version},
                  {"random_seed", task.random_seed},
                  {"inputs", inputs},
                  {"campaign", resolved_json(task.campaign)}};
  return yaml_text(json);
}

void write_task(const std::filesystem::path& folder, const Task& task) {
  write_text_atomically(folder / task_file, task_text(task));
}

Task read_task(const std::filesystem::path& folder) {
  const auto file = folder / task_file;
  if (!std::filesystem::exists(file)) {
    throw Failure(ExitCode::wrong_input, fmt::format("{}: not a task folder ({} is missing); `cupola run` makes them",
                                                     folder.string(), task_file))
        .at("file", file.string());
  }
  auto document = parse_yaml(read_text(file), file.string());
  if (!document.errors.empty())
    throw Failure(ExitCode::wrong_input, to_text(document.errors) +
                                             "cupola wrote this file whole: it was changed or "
                                             "damaged. Move its task folder away and resume.")
        .at("file", file.string());
  const Members members(document.root, file, "");
  if (const auto schema = members.count("schema"); schema != file_schema_version) {
    refuse(file, fmt::format("it is written in file schema {}, this program reads {}: use the program that wrote it",
                             schema, file_schema_version));
  }
  Task task;
  const auto kind = members.text("kind");
  const auto known = std::find(kind_names.begin(), kind_names.end(), kind);
  if (known == kind_names.end())
    refuse(file, fmt::format("`kind` must be dem, tracer, predict or correct, but is `{}`", kind));
  task.kind = static_cast<TaskKind>(known - kind_names.begin());
  task.episode = static_cast<int>(members.count("episode"));
  task.campaign_hash = members.text("campaign_hash");
  task.program_version = members.text("program_version");
  task.random_seed = members.count("random_seed");
  for (const auto& [name, input] : members.at("inputs").items()) {
    task.inputs[name] = read_input(folder, Members(input, file, path_of("inputs", name)), name);
  }
  static_cast<void>(members.at("campaign"));
  auto campaign = read_campaign_document(document.below("campaign"));
  if (!campaign.ok()) throw Failure(ExitCode::wrong_input, to_text(campaign.errors)).at("file", file.string());
  task.campaign = std::move(campaign.campaign);
  return task;
}

}  // namespace cupola
