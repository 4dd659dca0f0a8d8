#include "orchestrator/run_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "orchestrator/built_with.hpp"
#include "orchestrator/campaign_difference.hpp"
#include "orchestrator/child_process.hpp"
#include "orchestrator/stage_sequence.hpp"
#include "schemas/campaign_reader.hpp"
#include "schemas/resolved_campaign.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* campaign_name = "campaign.yaml";
constexpr const char* resolved_name = "resolved.yaml";
constexpr const char* information_name = "run.json";
constexpr const char* journal_name = "journal.jsonl";

bool is_run(const fs::path& folder) { return fs::exists(folder / information_name); }

/// Whether a folder holds nothing, or nothing but what a run that was killed while it was made leaves behind.
bool can_become_run(const fs::path& folder) {
  if (!fs::exists(folder)) return true;
  if (!fs::is_directory(folder)) return false;
  const std::set<std::string> own = {campaign_name, resolved_name, "lock"};
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::string name = entry.path().filename().string();
    if (name.ends_with(".part")) name.resize(name.size() - 5);
    if (!own.contains(name) && name != information_name && !name.starts_with("lock.")) return false;
  }
  return true;
}

Failure not_a_run(const fs::path& folder) {
  return Failure(ExitCode::wrong_input,
                 fmt::format("{}: not a run folder ({} is missing). Begin one with `cupola run CAMPAIGN --run-dir {}`.",
                             folder.string(), information_name, folder.string()))
      .at("folder", folder.string());
}

/// The frozen file's text, if it is as it was frozen.
std::string frozen_text(const fs::path& folder, const std::string& name, const std::string& hash) {
  std::string text = read_text(folder / name);
  if (hash_text(text) != hash)
    throw Failure(ExitCode::wrong_input,
                  fmt::format("{}: changed after the run began. A run keeps the campaign it began with: put the file "
                              "back, or begin a new run folder with the changed campaign.",
                              (folder / name).string()))
        .at("file", (folder / name).string());
  return text;
}

json read_information(const fs::path& folder) {
  json information = read_sealed_json(folder / information_name);
  for (const char* key : {"campaign_hash", "resolved_hash"})
    if (!information.contains(key) || !information[key].is_string())
      throw Failure(ExitCode::wrong_input, fmt::format("{}: {} is missing", (folder / information_name).string(), key));
  return information;
}

/// The frozen campaign; its defaults are those of the program that began the run.
Campaign frozen_campaign(const fs::path& folder, const json& information) {
  frozen_text(folder, campaign_name, information["campaign_hash"]);
  const std::string resolved = frozen_text(folder, resolved_name, information["resolved_hash"]);
  ReadCampaign read = read_campaign_text(resolved, (folder / resolved_name).string());
  if (!read.ok()) throw Failure(ExitCode::wrong_input, to_text(read.errors));
  return read.campaign;
}

/// Whether the journal is there where it must be, and belongs to this campaign.
void check_beginning(const fs::path& folder, const std::vector<json>& journal, const std::string& campaign_hash) {
  // The journal begins before the first stage does.
  if (journal.empty() && fs::exists(folder / "episodes"))
    throw Failure(
        ExitCode::input_output,
        fmt::format("{}: missing or empty, although stages have been run. Put the journal back from a copy, or "
                    "begin a new run folder.",
                    (folder / journal_name).string()))
        .at("file", (folder / journal_name).string());
  if (!journal.empty() && journal.front().value("campaign_hash", "") != campaign_hash)
    throw Failure(ExitCode::wrong_input,
                  fmt::format("{}: the journal of another campaign", (folder / journal_name).string()));
}

void freeze(const fs::path& folder, const std::string& text, const Campaign& campaign, const json& versions) {
  const std::string resolved = resolved_yaml(campaign);
  write_text_atomically(folder / campaign_name, text);
  write_text_atomically(folder / resolved_name, resolved);
  // Last: its presence says that the folder is whole.
  write_sealed_json(folder / information_name, {{"schema", 1},
                                                {"campaign", campaign.name},
                                                {"campaign_hash", hash_text(text)},
                                                {"resolved_hash", hash_text(resolved)},
                                                {"versions", versions},
                                                {"host", host_name()},
                                                {"started", utc_now()}});
}

void require_same(const fs::path& folder, const fs::path& campaign_file, const Campaign& campaign) {
  const json information = read_information(folder);
  const std::string there = frozen_text(folder, resolved_name, information["resolved_hash"]);
  const std::string here = resolved_yaml(campaign);
  if (there == here) return;
  throw Failure(ExitCode::wrong_input,
                fmt::format("{}: the run of another campaign than {}:\n  {}\nNothing was changed. Choose another "
                            "--run-dir, or go on with the campaign it began with by `cupola resume {}`.",
                            folder.string(), campaign_file.string(), fmt::join(changed_keys(there, here), "\n  "),
                            folder.string()))
      .at("folder", folder.string());
}

void make_folders(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: cannot be made: {}. Choose another --run-dir.", folder.string(), error.message()));
}

}  // namespace

fs::path stage_folder(const fs::path& run, int episode, TaskKind kind) {
  if (episode == before_all_episodes) return run / "prediction";
  return run / "episodes" / fmt::format("{:03d}", episode) / stage_name(kind);
}

fs::path task_folder(const fs::path& run, int episode, TaskKind kind, int attempt) {
  // The prediction that a run begins with may have been made before there was a campaign to run.
  if (episode == before_all_episodes)
    return attempt > 1 ? run / fmt::format("prediction-attempt-{}", attempt) : stage_folder(run, episode, kind);
  return stage_folder(run, episode, kind) / fmt::format("attempt-{}", attempt);
}

RunRecord read_run(const fs::path& folder) {
  if (!is_run(folder)) throw not_a_run(folder);
  RunRecord record;
  record.folder = fs::canonical(folder);
  record.information = read_information(folder);
  record.campaign = frozen_campaign(folder, record.information);
  record.campaign_hash = record.information["campaign_hash"].get<std::string>();
  if (fs::exists(folder / journal_name)) record.journal = read_journal(folder / journal_name);
  check_beginning(folder, record.journal, record.campaign_hash);
  return record;
}

RunFolder::RunFolder(const fs::path& folder) : path_(fs::canonical(folder)), lock_(path_) {}

void RunFolder::load() {
  information_ = read_information(path_);
  campaign_ = frozen_campaign(path_, information_);
  campaign_hash_ = information_["campaign_hash"].get<std::string>();
  if (!fs::exists(path_ / journal_name)) check_beginning(path_, {}, campaign_hash_);  // else it is made here
  journal_ = std::make_unique<Journal>(path_ / journal_name);
  check_beginning(path_, journal_->records(), campaign_hash_);
  if (journal_->records().empty())
    journal_->append("campaign-started", {{"campaign", campaign_.name}, {"campaign_hash", campaign_hash_}});
}

std::unique_ptr<RunFolder> RunFolder::for_campaign(const fs::path& campaign_file, const fs::path& folder,
                                                   const json& versions) {
  const std::string text = read_text(campaign_file);
  const ReadCampaign read = read_campaign_text(text, campaign_file.string());
  if (!read.ok()) throw Failure(ExitCode::wrong_input, to_text(read.errors));
  if (!is_run(folder) && !can_become_run(folder))
    throw Failure(ExitCode::wrong_input,
                  fmt::format("{}: holds something that is not a run. Nothing was changed. Choose another --run-dir.",
                              folder.string()))
        .at("folder", folder.string());
  make_folders(folder);
  std::unique_ptr<RunFolder> run(new RunFolder(folder));
  if (is_run(folder))
    require_same(folder, campaign_file, read.campaign);
  else
    freeze(folder, text, read.campaign, versions);
  run->load();
  return run;
}

std::unique_ptr<RunFolder> RunFolder::open(const fs::path& folder) {
  if (!is_run(folder)) throw not_a_run(folder);
  std::unique_ptr<RunFolder> run(new RunFolder(folder));
  run->load();
  return run;
}

}  // namespace cupola
