#include "orchestrator/run_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "orchestrator/prepared_case.hpp"
#include "orchestrator/run_folder.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "schemas/checkpoint_seal.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Looker {
 public:
  explicit Looker(fs::path run) : run_(std::move(run)) {}

  RunCheck look() {
    look_at_campaign();
    look_at_journal();
    look_at_stage(before_all_episodes, TaskKind::predict);
    bool any = true;
    for (int episode = 1; any; ++episode) {
      any = false;
      for (const TaskKind kind : all_stages_of_episode()) any = look_at_stage(episode, kind) || any;
    }
    look_for_missing();
    look_at_report();
    return std::move(check_);
  }

 private:
  /// Runs a look; what it throws is a problem. @return whether all was well
  template <class Look>
  bool attempt_to(Look look) {
    try {
      look();
      return true;
    } catch (const std::exception& problem) {
      check_.problems.emplace_back(problem.what());
      return false;
    }
  }

  void look_at_campaign() {
    json information;
    if (!attempt_to([&] { information = read_sealed_json(run_ / "run.json"); })) return;
    ++check_.files;
    for (const auto& [name, key] : {std::pair{"campaign.yaml", "campaign_hash"}, {"resolved.yaml", "resolved_hash"}})
      attempt_to([&, name = name, key = key] {
        ++check_.files;
        if (hash_file(run_ / name) != information.value(key, ""))
          check_.problems.push_back(
              fmt::format("{}: changed after the run began; put the file back from a copy", (run_ / name).string()));
      });
    campaign_hash_ = information.value("campaign_hash", "");
  }

  void look_at_journal() {
    const fs::path file = run_ / "journal.jsonl";
    if (fs::exists(file)) {
      ++check_.files;
      if (!attempt_to([&] { journal_ = read_journal(file); })) return;
    }
    if (journal_.empty()) {
      if (fs::exists(run_ / "episodes"))
        check_.problems.push_back(file.string() + ": missing or empty, although stages have been run");
      return;
    }
    if (!campaign_hash_.empty() && journal_.front().value("campaign_hash", "") != campaign_hash_)
      check_.problems.push_back(file.string() + ": the journal of another campaign");
    if (const std::string text = read_text(file); !text.empty() && text.back() != '\n')
      check_.remarks.push_back(file.string() + ": its last line was cut short; the next start drops it");
  }

  /// @return whether there is any attempt
  bool look_at_stage(int episode, TaskKind kind) {
    int attempt = 1;
    for (; fs::is_directory(task_folder(run_, episode, kind, attempt)); ++attempt)
      look_at_attempt(episode, kind, attempt);
    return attempt > 1;
  }

  void look_at_attempt(int episode, TaskKind kind, int attempt) {
    const fs::path folder = task_folder(run_, episode, kind, attempt);
    const std::string name = stage_title(kind, episode);
    const json* preparing = last_record(journal_, "stage-preparing", episode, kind, attempt);
    const json* finished = last_record(journal_, "stage-finished", episode, kind, attempt);
    if (has_manifest(folder)) {
      look_at_result(folder, name, finished);
      return;
    }
    if (finished != nullptr)
      check_.problems.push_back(fmt::format("{}: the manifest of the {} is missing", folder.string(), name));
    if (preparing != nullptr && preparing->contains("task_hash")) {
      attempt_to([&] {
        ++check_.files;
        if (hash_file(folder / "task.yaml") != (*preparing)["task_hash"])
          check_.problems.push_back(
              fmt::format("{}: not the task that the journal knows", (folder / "task.yaml").string()));
      });
    }
    attempt_to([&] { read_failure(folder); });
    look_at_checkpoints(folder);
    look_at_case(episode, kind, attempt, folder);
  }

  void look_at_result(const fs::path& folder, const std::string& name, const json* finished) {
    const std::size_t before = check_.problems.size();
    for (const std::string& problem : manifest_problems(folder)) check_.problems.push_back(problem);
    attempt_to([&] {
      check_.files += 1 + read_json(folder / "manifest.json").value("files", json::object()).size();
      if (finished != nullptr && finished->value("manifest_hash", "") != hash_file(folder / "manifest.json"))
        check_.problems.push_back(
            fmt::format("{}: not the manifest that the journal knows: the result of the {} was "
                        "changed or swapped",
                        (folder / "manifest.json").string(), name));
    });
    if (check_.problems.size() == before) check_.whole.push_back(name);
  }

  void look_at_checkpoints(const fs::path& folder) {
    attempt_to([&] {
      const auto checkpoints = find_checkpoints(folder);
      for (const CheckpointSeal& checkpoint : checkpoints) {
        ++check_.files;
        if (!checkpoint.step)
          check_.remarks.push_back(checkpoint.file.string() +
                                   ": torn or damaged; the stage goes on from the other one, or from its beginning");
      }
    });
  }

  void look_at_case(int episode, TaskKind kind, int attempt, const fs::path& folder) {
    const json* prepared = last_record(journal_, "stage-prepared", episode, kind, attempt);
    if (prepared == nullptr || !fs::is_directory(folder / "foam")) return;
    attempt_to([&] {
      ++check_.files;
      if (case_condition(journal_, episode, kind, attempt, folder, prepared->value("ranks", 0)) ==
          CaseCondition::damaged)
        check_.remarks.push_back((folder / "foam").string() +
                                 ": damaged or changed after it was prepared; it is prepared again");
    });
  }

  /// Stages that the journal knows as finished and that are not there at all.
  void look_for_missing() {
    for (const json& record : journal_) {
      if (record.value("event", "") != "stage-finished") continue;
      const fs::path folder = task_folder(run_, record.value("episode", 0), stage_kind(record.value("stage", "")),
                                          record.value("attempt", 0));
      if (!fs::is_directory(folder))
        check_.problems.push_back(folder.string() + ": missing, although the journal knows it finished");
    }
  }

  /// The numbers of the report; what else is derived is made from them and from the results, and carries no hash.
  void look_at_report() {
    const fs::path file = run_ / "report" / "report.json";
    if (!fs::exists(file)) return;
    ++check_.files;
    try {
      read_sealed_json(file);
    } catch (const std::exception&) {
      check_.problems.push_back(
          fmt::format("{}: damaged, or changed after it was written; `cupola report {}` makes it anew", file.string(),
                      run_.string()));
    }
  }

  fs::path run_;
  RunCheck check_;
  std::vector<json> journal_;
  std::string campaign_hash_;
};

}  // namespace

RunCheck check_run(const fs::path& run) {
  if (!fs::exists(run / "run.json"))
    throw Failure(ExitCode::wrong_input, fmt::format("{}: not a run folder (run.json is missing).", run.string()));
  return Looker(run).look();
}

std::string still_whole(const fs::path& run, const std::string& sentence) {
  return fmt::format("{}{} {}", sentence, sentence.ends_with('.') ? "" : ".", still_whole(run));
}

std::string still_whole(const fs::path& run) {
  try {
    const RunCheck check = check_run(run);
    if (check.whole.empty()) return "No result is finished yet.";
    return fmt::format("Whole and usable as they are: {}.", fmt::join(check.whole, ", "));
  } catch (const std::exception&) {
    return "Nothing of it can be read.";
  }
}

}  // namespace cupola
