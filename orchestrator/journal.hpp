#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cupola {

/// `journal.jsonl` of a run folder: what is about to be done, then what came of it, one JSON object a line, only ever
/// appended to and synced to the disk before `append` returns.
///
/// Lines are chained: each carries the hash over the line before it and its own content (keys `number`, `time`,
/// `event`, `hash` beside those of the event), so that a changed, missing or swapped line is found the next time the
/// journal is read. A last line that was cut short by a crash was never finished and is dropped.
class Journal {
 public:
  /// Opens for appending, makes the file where there is none, and cuts a torn last line off.
  /// @throws Failure wrong_input naming the first line that does not fit the chain, input_output
  explicit Journal(std::filesystem::path file);

  /// Appends one line. @param content an object; @throws Failure input_output
  void append(const std::string& event, const nlohmann::json& content);

  /// All records, oldest first.
  [[nodiscard]] const std::vector<nlohmann::json>& records() const { return records_; }

 private:
  std::filesystem::path file_;
  std::vector<nlohmann::json> records_;
};

/// Reads a journal that another process may be writing: nothing is changed, an unfinished last line is left out.
/// @throws Failure wrong_input naming the first line that does not fit the chain, input_output
std::vector<nlohmann::json> read_journal(const std::filesystem::path& file);

/// The present moment as `2026-11-22T02:04:19.123Z`.
std::string utc_now();

/// The moment of `utc_now`'s text in seconds since 1970. @throws Failure wrong_input
double seconds_since_epoch(const std::string& utc);

}  // namespace cupola
