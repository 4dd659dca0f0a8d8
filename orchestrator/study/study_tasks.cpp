#include "orchestrator/study/study_tasks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "orchestrator/result_check.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "orchestrator/stage_task.hpp"
#include "orchestrator/study/finished_stage.hpp"
#include "schemas/failure.hpp"
#include "schemas/files.hpp"
#include "schemas/resolved_campaign.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t digits_of_name = 12;

/// Gathers tasks, each once.
class Planner {
 public:
  Planner(const Study& study, fs::path folder) : study_(study), folder_(std::move(folder)) {}

  void add_run(std::size_t setting, int seed) {
    const Campaign campaign = with_seed(study_.settings[setting].campaign, seed);
    StudyRun run{setting, seed, {}, {}};
    if (study_.stage == StudyStage::campaign) {
      run.own = {whole_campaign(campaign)};
    } else if (study_.stage == StudyStage::tracer) {
      // The DEM stage of the scene itself: it does not see what is varied.
      run.shared = bed(study_.scene);
      run.own = {tracer(campaign, run.shared.back())};
    } else {
      std::map<std::string, std::size_t> inputs;
      int episode = 1;
      if (study_.begins_with_packing) {
        run.shared = {dem(with_seed(study_.scene, seed), 1, {})};
        inputs["packing"] = run.shared.back();
        episode = 2;
      }
      run.own = {dem(campaign, episode, inputs)};
      if (study_.stage == StudyStage::episode) run.own.push_back(tracer(campaign, run.own.back()));
    }
    work_.runs.push_back(std::move(run));
  }

  StudyWork take() { return std::move(work_); }

 private:
  static Campaign with_seed(Campaign campaign, int seed) {
    campaign.random_seed += static_cast<std::uint64_t>(seed);
    return campaign;
  }

  std::vector<std::size_t> bed(const Campaign& campaign) {
    const std::size_t first = dem(campaign, 1, {});
    if (!study_.begins_with_packing) return {first};
    return {first, dem(campaign, 2, {{"packing", first}})};
  }

  std::size_t dem(const Campaign& campaign, int episode, const std::map<std::string, std::size_t>& inputs) {
    StudyTask task;
    task.kind = TaskKind::dem;
    task.episode = episode;
    task.inputs = inputs;
    task.campaign = campaign;
    return add(std::move(task),
               fmt::format("dem {} {} {}", episode, campaign.launch.ranks, seen_by_dem_stage(campaign)));
  }

  std::size_t tracer(const Campaign& campaign, std::size_t granular) {
    StudyTask task;
    task.kind = TaskKind::tracer;
    task.episode = work_.tasks[granular].episode;
    task.inputs = {{"granular", granular}};
    task.campaign = campaign;
    return add(std::move(task), "tracer " + seen(campaign));
  }

  std::size_t whole_campaign(const Campaign& campaign) {
    StudyTask task;
    task.is_run = true;
    task.campaign = campaign;
    return add(std::move(task), "campaign " + seen(campaign));
  }

  /// Stands for the campaign file, which the tasks of a study do not have: tasks on one mesh must have the same one,
  /// since the mesh carries it.
  static std::string hash_of_mesh(const Campaign& campaign) {
    const auto all = resolved_json(campaign);
    return hash_text(all["scene"]["geometry"].dump() + all["scene"]["mesh"].dump());
  }

  /// All of a campaign but its name.
  static std::string seen(const Campaign& campaign) {
    auto all = resolved_json(campaign);
    all.erase("campaign");
    return all.dump();
  }

  std::size_t add(StudyTask task, std::string identity) {
    for (const auto& [name, input] : task.inputs) identity += fmt::format(" {}={}", name, work_.tasks[input].name());
    const std::string digits = hash_text(identity).substr(5, digits_of_name);
    task.campaign_text = resolved_yaml(task.campaign);
    task.campaign_hash = hash_of_mesh(task.campaign);
    task.folder = folder_ / "stages" / fmt::format("{}-{}", task.is_run ? "campaign" : stage_name(task.kind), digits);
    const auto there = std::find_if(work_.tasks.begin(), work_.tasks.end(),
                                    [&](const StudyTask& one) { return one.folder == task.folder; });
    if (there != work_.tasks.end()) return static_cast<std::size_t>(there - work_.tasks.begin());
    work_.tasks.push_back(std::move(task));
    return work_.tasks.size() - 1;
  }

  const Study& study_;
  fs::path folder_;
  StudyWork work_;
};

std::string said_by(const fs::path& folder) {
  const auto failure = read_failure(folder);
  return failure ? failure->value("sentence", "") : "";
}

void look_after_run(StudyTask& task) {
  const fs::path outcome = task.folder / "outcome.json";
  if (!fs::exists(outcome)) return;
  const nlohmann::json ended = read_json(outcome);
  task.sentence = ended.value("sentence", "");
  task.state = ended.value("finished", false) ? StudyTask::State::finished : StudyTask::State::failed;
}

}  // namespace

StudyWork study_work(const Study& study, const fs::path& folder) {
  Planner planner(study, folder);
  // References first: without them nothing can be compared.
  std::vector<std::size_t> order;
  for (const bool wanted : {true, false})
    for (std::size_t i = 0; i < study.settings.size(); ++i) {
      const bool is_reference = std::any_of(study.settings.begin(), study.settings.end(),
                                            [&](const StudySetting& one) { return one.reference == i; });
      if (is_reference == wanted) order.push_back(i);
    }
  for (const std::size_t setting : order)
    for (int seed = 0; seed < study.seeds; ++seed) planner.add_run(setting, seed);
  StudyWork work = planner.take();
  std::stable_sort(work.runs.begin(), work.runs.end(),
                   [](const StudyRun& one, const StudyRun& other) { return one.setting < other.setting; });
  return work;
}

namespace {

/// A sentence with the paths of the study's own files as seen from its folder: it may be moved.
std::string from_study_folder(std::string sentence, const StudyTask& task) {
  const std::string root = task.folder.parent_path().parent_path().string() + "/";
  for (std::size_t at = sentence.find(root); at != std::string::npos; at = sentence.find(root, at))
    sentence.erase(at, root.size());
  return sentence;
}

}  // namespace

void look_after(StudyTask& task) {
  task.state = StudyTask::State::waiting;
  task.sentence.clear();
  if (task.is_run) return look_after_run(task);
  if (has_manifest(task.folder)) {
    try {
      check_result(task.folder, task.kind, task.campaign, task.campaign_hash);
      task.state = StudyTask::State::finished;
    } catch (const Failure& failure) {
      task.state = StudyTask::State::failed;
      task.sentence = from_study_folder(failure.what(), task);
    }
  } else if (const std::string sentence = said_by(task.folder); !sentence.empty()) {
    task.state = StudyTask::State::failed;
    task.sentence = from_study_folder(sentence, task);
  }
}

bool is_ready(StudyTask& task, const std::vector<StudyTask>& tasks) {
  if (task.state != StudyTask::State::waiting) return false;
  for (const auto& [name, index] : task.inputs) {
    const StudyTask& before = tasks[index];
    if (before.state == StudyTask::State::failed) {
      task.state = StudyTask::State::failed;
      task.sentence = fmt::format("the {} stage it rests on failed: {}", stage_name(before.kind), before.sentence);
      return false;
    }
    if (before.state != StudyTask::State::finished) return false;
  }
  return true;
}

void make_folder(const StudyTask& task, const std::vector<StudyTask>& tasks) {
  if (task.is_run) {
    fs::create_directories(task.folder);
    write_text_atomically(task.folder / "campaign.yaml", task.campaign_text);
    return;
  }
  std::map<std::string, fs::path> inputs;
  for (const auto& [name, index] : task.inputs) inputs[name] = tasks[index].folder / "result.hdf";
  ensure_task(task.folder, stage_task(task.kind, task.episode, task.campaign, task.campaign_hash, inputs, task.folder));
}

}  // namespace cupola
