#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/child_process.hpp"
#include "schemas/task.hpp"

namespace cupola {

/// How a stage of an episode stands, as its folder and the journal say: nothing else is kept anywhere.
struct StageState {
  enum class Condition {
    absent,       ///< no attempt yet
    interrupted,  ///< begun and not ended: goes on in the same folder, from its checkpoint where it has one
    running,      ///< somebody works in the task folder: started by an orchestrator that has died
    failed,       ///< the numbers went bad (70): the attempt stays as it is
    finished,     ///< its manifest is there
  };
  Condition condition = Condition::absent;
  int attempt = 1;                                ///< the latest one
  std::filesystem::path folder;                   ///< of that attempt
  std::optional<nlohmann::json> failure;          ///< `failure.json` of a failed one
  std::optional<ProcessIdentity> process;         ///< of a running one, where the journal knows it
  std::optional<nlohmann::json> finished_record;  ///< the journal's line about its end, where there is one
};

/// @param run the run folder, @param journal its records
StageState stage_state(const std::filesystem::path& run, const std::vector<nlohmann::json>& journal, int episode,
                       TaskKind kind);

/// Whether a journal line is about this attempt of this stage.
bool is_about(const nlohmann::json& record, int episode, TaskKind kind, int attempt);

/// The last record of an event about an attempt, since it was last begun anew; null where there is none.
const nlohmann::json* last_record(const std::vector<nlohmann::json>& journal, const std::string& event, int episode,
                                  TaskKind kind, int attempt);

/// How many stages have come to their end.
int stages_finished(const std::vector<nlohmann::json>& journal);

/// Ranks of the stages that start now: those of the last `ranks-changed`, else the campaign's.
int ranks_in_force(const std::vector<nlohmann::json>& journal, int of_campaign);

/// Wall time of a stage over all its attempts, s, as their progress says it.
double wall_seconds_of_stage(const std::filesystem::path& run, int episode, TaskKind kind);

/// Changes of campaign keys that retries took over from failed attempts, oldest first, with their values.
std::vector<std::pair<std::string, std::string>> advice_taken(const std::vector<nlohmann::json>& journal);

}  // namespace cupola
