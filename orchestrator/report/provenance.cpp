#include "orchestrator/report/provenance.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <set>
#include <string>
#include <vector>

#include "orchestrator/stage_sequence.hpp"
#include "orchestrator/stage_state.hpp"
#include "schemas/files.hpp"

namespace cupola {

using nlohmann::json;

namespace {

std::string relative_to(const std::filesystem::path& file, const std::filesystem::path& run) {
  return file.lexically_normal().lexically_relative(run).generic_string();
}

std::string text_of(const YAML::Node& node, const char* key) {
  return node[key] && node[key].IsScalar() ? node[key].Scalar() : "";
}

/// What `task.yaml` says about where a stage's numbers come from.
json task_entry(const StageReport& stage, const std::filesystem::path& run) {
  const std::filesystem::path file = stage.state.folder / "task.yaml";
  json entry = {{"random_seed", nullptr}, {"program_version", nullptr}, {"inputs", json::object()}};
  if (!std::filesystem::exists(file)) {
    return entry;
  }
  const YAML::Node task = YAML::Load(read_text(file));
  entry["random_seed"] = text_of(task, "random_seed");
  entry["program_version"] = text_of(task, "program_version");
  for (const auto& input : task["inputs"]) {
    entry["inputs"][input.first.as<std::string>()] = {
        {"file", relative_to(stage.state.folder / text_of(input.second, "file"), run)},
        {"hash", text_of(input.second, "hash")}};
  }
  return entry;
}

/// Files of a finished stage with their sizes and hashes, as its manifest has them.
json files_of(const StageReport& stage, const std::filesystem::path& run) {
  json files = json::object();
  if (!stage.readable) {
    return files;
  }
  const json listed = read_json(stage.state.folder / "manifest.json").value("files", json::object());
  for (const auto& [name, file] : listed.items()) {
    files[relative_to(stage.state.folder / name, run)] = file;
  }
  return files;
}

json stage_provenance(const StageReport& stage, const std::filesystem::path& run) {
  json entry = {{"stage", shown_name(stage.kind)},
                {"episode", stage.episode},
                {"attempt", stage.state.attempt},
                {"ranks", stage.summary.value("ranks", json())}};
  try {
    entry.update(task_entry(stage, run));
    entry["files"] = files_of(stage, run);
  } catch (const std::exception& problem) {
    entry["problem"] = problem.what();  // a damaged file must not keep the report from being made
  }
  return entry;
}

std::string media_type(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending == ".hdf" || ending == ".h5") return "application/x-hdf5";
  if (ending == ".json") return "application/json";
  if (ending == ".jsonl") return "application/jsonl";
  if (ending == ".yaml") return "application/yaml";
  if (ending == ".html") return "text/html";
  if (ending == ".xdmf") return "application/xml";
  if (ending == ".stl") return "model/stl";
  return "text/plain";
}

/// Names of the views for ParaView and of what they need, sorted.
std::set<std::string> views_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  std::error_code ignored;
  for (const auto& file : std::filesystem::directory_iterator(folder, ignored))
    if (file.is_regular_file() && file.path().extension() != ".part") names.insert(file.path().filename().string());
  return names;
}

json reference(const std::string& id) { return {{"@id", id}}; }

/// Ranks of the stages as they were prepared, one entry for each change: `ranks` and the stage from which on.
struct RanksFrom {
  int ranks = 0;
  std::string stage;
};
std::vector<RanksFrom> ranks_used(const RunRecord& run) {
  std::vector<RanksFrom> used;
  for (const json& record : run.journal) {
    const int ranks = record.value("ranks", 0);
    if (record.value("event", "") != "stage-prepared" || (!used.empty() && used.back().ranks == ranks)) continue;
    used.push_back({ranks, stage_title(stage_kind(record.value("stage", "")), record.value("episode", 0))});
  }
  return used;
}

/// The command that computes the same again: with the limits it was given beside the campaign's own.
std::string command_of(const RunRecord& run, const std::vector<RanksFrom>& used) {
  std::string command = "cupola run campaign.yaml --run-dir NEW_FOLDER";
  int at_most = run.campaign.converged.at_most;
  for (const json& record : run.journal)
    if (record.value("event", "") == "orchestrator-started") at_most = record.value("at_most", at_most);
  if (at_most != run.campaign.converged.at_most) command += fmt::format(" --at-most {}", at_most);
  const int of_campaign = run.campaign.launch.ranks;
  const int ranks = used.empty() ? ranks_in_force(run.journal, of_campaign) : used.front().ranks;
  if (ranks != of_campaign && !run.campaign.launch.slurm) command += fmt::format(" --ranks {}", ranks);
  return command;
}

/// What one command does not do again; empty where the ranks stayed as they were.
std::string changes_of_ranks(const std::vector<RanksFrom>& used) {
  if (used.size() < 2) return "";
  std::string text = fmt::format("{} at first", used.front().ranks);
  for (std::size_t i = 1; i < used.size(); ++i)
    text += fmt::format(", {} from the {} on", used[i].ranks, used[i].stage);
  return text + ": the same to the last digit only with `cupola resume --ranks` at the same places";
}

/// What the owner of the data has put into the crate: licence and authors of the whole, and who these are.
struct OwnersWords {
  json of_root = json::object();
  json entities = json::array();
};

OwnersWords owners_words_in(const std::filesystem::path& crate) {
  try {
    const json before = std::filesystem::exists(crate) ? read_json(crate) : json::object();
    const json graph = before.value("@graph", json::array());
    OwnersWords words;
    for (const json& entity : graph) {
      if (entity.value("@id", "") == "./")
        for (const char* key : {"license", "author", "publisher", "funder"})
          if (entity.contains(key)) words.of_root[key] = entity[key];
      const json type = entity.value("@type", json());
      if (type == "Person" || type == "Organization") words.entities.push_back(entity);
    }
    return words;
  } catch (const std::exception&) {
    return {};  // a damaged one is made anew
  }
}

}  // namespace

json provenance(const RunRecord& run, const std::vector<StageReport>& stages) {
  const std::vector<RanksFrom> used = ranks_used(run);
  json result = {{"command", command_of(run, used)},
                 {"ranks_changed", changes_of_ranks(used)},
                 {"campaign_hash", run.campaign_hash},
                 {"resolved_hash", run.information.value("resolved_hash", "")},
                 {"hosts", json::array()},
                 {"starts", json::array()},
                 {"stages", json::array()},
                 {"advice", json::array()}};
  std::set<std::string> hosts{run.information.value("host", "")};
  for (const json& record : run.journal) {
    const std::string event = record.value("event", "");
    if (record.contains("host")) {
      hosts.insert(record.value("host", ""));
    }
    if (event == "orchestrator-started") {
      result["starts"].push_back({{"host", record.value("host", "")},
                                  {"time", record.value("time", "")},
                                  {"program_version", record.value("program_version", "")}});
    }
    if (event == "advice-taken") {
      result["advice"].push_back(record.value("changes", json::object()));
    }
  }
  hosts.erase("");
  result["hosts"] = hosts;
  for (const StageReport& stage : stages) {
    result["stages"].push_back(stage_provenance(stage, run.folder));
  }
  return result;
}

json ro_crate(const RunRecord& run, const json& report) {
  json parts = json::array();
  json results = json::array();
  json files = json::array();
  const auto add = [&](const std::string& file, const std::string& name, const json& size, const json& hash) {
    json entry = {{"@id", file}, {"@type", "File"}, {"name", name}, {"encodingFormat", media_type(file)}};
    if (!size.is_null()) {
      entry["contentSize"] = std::to_string(size.get<std::uint64_t>());
    }
    if (!hash.is_null()) {
      entry["identifier"] = hash;
    }
    files.push_back(entry);
    parts.push_back(reference(file));
  };
  add("campaign.yaml", "The campaign, frozen", nullptr, run.campaign_hash);
  add("resolved.yaml", "The campaign with every default", nullptr, run.information.value("resolved_hash", ""));
  const auto add_as_it_is = [&](const std::string& file, const std::string& name) {
    const std::filesystem::path path = run.folder / file;
    if (std::filesystem::exists(path)) add(file, name, std::filesystem::file_size(path), hash_file(path));
  };
  add_as_it_is("run.json", "Versions, host and start");
  add_as_it_is("journal.jsonl", "What was done, when");
  add_as_it_is("report/index.html", "Report for people");
  add_as_it_is("report/report.json", "Every number of the report");
  for (const std::string& view : views_in(run.folder / "fields"))
    add_as_it_is("fields/" + view, "For ParaView: " + view);
  for (const json& stage : report.at("provenance").at("stages")) {
    const json listed = stage.value("files", json::object());
    for (const auto& [file, about] : listed.items()) {
      add(file,
          fmt::format("{} stage of episode {}: {}", stage.value("stage", ""), stage.value("episode", 0),
                      std::filesystem::path(file).filename().string()),
          about.value("size", json()), about.value("hash", json()));
      results.push_back(reference(file));
    }
  }
  const std::string version = report.at("versions").value("cupola", "");
  const std::string software = "#cupola-" + version;
  json action = {{"@id", "#campaign"},
                 {"@type", "CreateAction"},
                 {"name", "The campaign " + run.campaign.name},
                 {"description", report.at("state")},
                 {"startTime", report.at("started")},
                 {"instrument", reference(software)},
                 {"object", json::array({reference("campaign.yaml")})},
                 {"result", results}};
  if (!run.journal.empty()) {
    action["endTime"] = run.journal.back().value("time", "");
  }
  json graph = {{{"@id", "ro-crate-metadata.json"},
                 {"@type", "CreativeWork"},
                 {"conformsTo", reference("https://w3id.org/ro/crate/1.1")},
                 {"about", reference("./")}},
                {{"@id", "./"},
                 {"@type", "Dataset"},
                 {"name", run.campaign.name},
                 {"description", fmt::format("Campaign {} of a moving bed, computed by Cupola {}: {}.",
                                             run.campaign.name, version, report.at("state").get<std::string>())},
                 {"datePublished", report.at("file_written")},
                 {"mentions", json::array({reference("#campaign")})},
                 {"hasPart", parts}},
                {{"@id", software},
                 {"@type", "SoftwareApplication"},
                 {"name", "Cupola"},
                 {"version", version},
                 {"softwareRequirements", json::array()}},
                action};
  const OwnersWords owner = owners_words_in(run.folder / "ro-crate-metadata.json");
  graph[1].update(owner.of_root);
  graph.insert(graph.end(), owner.entities.begin(), owner.entities.end());
  for (const auto& [name, library] : report.at("versions").items()) {
    if (name != "cupola") {
      graph[2]["softwareRequirements"].push_back(name + " " + library.get<std::string>());
    }
  }
  graph.insert(graph.end(), files.begin(), files.end());
  return {{"@context", "https://w3id.org/ro/crate/1.1/context"}, {"@graph", graph}};
}

}  // namespace cupola
