#pragma once
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "schemas/failure.hpp"

/// The small files of a task folder and how files are written: to a temporary name, synced, then renamed.  All of these
/// throw Failure input_output where the file system refuses, naming the file and its reason.
namespace cupola {

/// Content hash of a file or text: "xxh3:" and 32 hexadecimal digits (XXH3, 128 bit).
std::string hash_file(const std::filesystem::path& file);
std::string hash_text(const std::string& text);

std::string read_text(const std::filesystem::path& file);
void write_text_atomically(const std::filesystem::path& file, const std::string& text);
nlohmann::json read_json(const std::filesystem::path& file);
void write_json_atomically(const std::filesystem::path& file, const nlohmann::json& value);
/// A JSON object that carries the hash of its own content under `hash`.  Every byte counts: read_sealed_json takes only
/// the text that write_sealed_json writes. @throws Failure input_output naming the file where anything was changed
void write_sealed_json(const std::filesystem::path& file, nlohmann::json object);
nlohmann::json read_sealed_json(const std::filesystem::path& file);
/// Where a file is written before it is published: `<file>.part` in the same folder.  What a killed program leaves
/// there is overwritten by the next one and counts for nothing.
std::filesystem::path temporary_beside(const std::filesystem::path& file);
/// Renames an already written temporary file to its place, syncing file and folder.
void publish(const std::filesystem::path& temporary, const std::filesystem::path& file);

/// `progress.json`
struct Progress {
  long step = 0;
  double process_seconds = 0;               ///< since the task's begin
  double process_seconds_total = 0;         ///< the task's expected end
  double wall_seconds = 0;                  ///< spent in this task over all its starts
  double rate = 0;                          ///< process seconds per wall second, recent
  std::string phase;                        ///< `settling`, `relaxing`, `averaging`, `marching`, …
  std::map<std::string, double> monitored;  ///< SI, e.g. `mean_solid_temperature`, `parcels`
};
void write_progress(const std::filesystem::path& folder, const Progress& progress);
/// Absent or unreadable: none (the writer may not have begun).
std::optional<Progress> read_progress(const std::filesystem::path& folder);

/// `history.jsonl`: one JSON object a line; each has "step".
void append_history(const std::filesystem::path& folder, const nlohmann::json& line);
/// Makes the lines so far outlast a power cut; before a checkpoint or a manifest that counts on them.
void sync_history(const std::filesystem::path& folder);
/// Drops lines whose "step" is greater than `last_step` (a resume from that step's checkpoint) and lines torn by a
/// kill.  To be called before a resumed stage appends; -1 drops all.
void cut_history(const std::filesystem::path& folder, long last_step);
/// Whole lines, in order; torn ones are left out.  Empty where there is no history yet.
std::vector<nlohmann::json> read_history(const std::filesystem::path& folder);

/// `failure.json`: `code`, `sentence`, `where{}`, `advice{}`, sealed; one without a seal (written by hand) is taken as
/// it is. @throws Failure input_output where it is damaged
void write_failure(const std::filesystem::path& folder, const Failure& failure);
std::optional<nlohmann::json> read_failure(const std::filesystem::path& folder);

/// `manifest.json`, written last and sealed: size and hash of every file of the folder, except what goes on changing or
/// is of no use afterwards: `lock`, `progress.json`, `checkpoint-*`, `*.log`, `log.*`, `*.part`.  Of `foam/` only
/// `mesh.hdf` and `wall.stl` are in it: the rest (OpenFOAM's case, decomposed) follows from `task.yaml` and is large.
void write_manifest(const std::filesystem::path& folder);
bool has_manifest(const std::filesystem::path& folder);
/// Checks the manifest's own seal, sizes and hashes. @throws Failure input_output naming the first file that differs
void verify_manifest(const std::filesystem::path& folder);
/// The same for all files: a sentence for each that differs, none where all is well.
std::vector<std::string> manifest_problems(const std::filesystem::path& folder);

/// How often the holder of a folder touches its lock, and after which silence one on another host counts as dead.
inline constexpr std::chrono::seconds sign_of_life_every{5};
inline constexpr std::chrono::seconds dead_after_silence{60};

/// An exclusive lock on a folder (`lock` in it: host, pid, since; empty when given back), held for the object's life.
///
/// On one host the kernel keeps it (flock): it ends with the process, in whatever way that ends, and programs it starts
/// do not inherit it.  Between hosts that share a file system the kernel's lock may not be seen, or may outlive the
/// host that took it; there the holder's sign of life counts, the file's time of change, which a thread of its own
/// renews. Both times compared are those of the file system, so that clocks of hosts do not matter.
class FolderLock {
 public:
  /// @throws Failure held (says who, and for how long it has been silent), input_output
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock(FolderLock&&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;

  /// Who holds the folder now (`process 123 on host since …`); none where nobody does.  Changes nothing.
  static std::optional<std::string> holder(const std::filesystem::path& folder);

 private:
  struct Held;
  std::unique_ptr<Held> held_;
};

}  // namespace cupola
