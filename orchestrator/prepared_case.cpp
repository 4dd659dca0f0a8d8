#include "orchestrator/prepared_case.hpp"

#include <algorithm>

#include "schemas/files.hpp"

namespace cupola {

std::string case_fingerprint(const std::filesystem::path& foam_folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(foam_folder))
    if (entry.is_regular_file() && !entry.path().filename().string().starts_with("log."))
      files.push_back(entry.path().lexically_relative(foam_folder));
  std::sort(files.begin(), files.end());
  std::string all;
  for (const auto& file : files) all += file.string() + "\n" + hash_file(foam_folder / file) + "\n";
  return hash_text(all);
}

CaseCondition case_condition(const std::vector<nlohmann::json>& journal, int episode, TaskKind kind, int attempt,
                             const std::filesystem::path& task_folder, int ranks) {
  const nlohmann::json* prepared = last_record(journal, "stage-prepared", episode, kind, attempt);
  if (prepared == nullptr || prepared->value("ranks", 0) != ranks) return CaseCondition::missing;
  if (!std::filesystem::is_directory(task_folder / "foam")) return CaseCondition::missing;
  return case_fingerprint(task_folder / "foam") == prepared->value("case_hash", "") ? CaseCondition::ready
                                                                                    : CaseCondition::damaged;
}

}  // namespace cupola
