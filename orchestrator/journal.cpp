#include "orchestrator/journal.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>

#include "schemas/failure.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using nlohmann::json;

/// The records of a journal's text, and how much of the text they take (a torn last line is beyond it).
struct Parsed {
  std::vector<json> records;
  std::size_t whole_bytes = 0;
};

std::string chain_hash(const std::string& previous, const json& record_without_hash) {
  return hash_text(previous + record_without_hash.dump());
}

[[noreturn]] void refuse(const std::filesystem::path& file, std::size_t line, const std::string& why) {
  throw Failure(
      ExitCode::wrong_input,
      fmt::format(
          "{}:{}: {}. The journal was changed or damaged after it was written, so what this run has done is not known. "
          "Put the journal back from a copy, or begin a new run folder.",
          file.string(), line, why))
      .at("file", file.string())
      .at("line", std::to_string(line));
}

json checked_record(const std::filesystem::path& file, std::size_t line, const std::string& text,
                    const std::string& previous) {
  json record = json::parse(text, nullptr, false);
  if (!record.is_object() || !record.contains("hash") || !record["hash"].is_string())
    refuse(file, line, "this line is not a record");
  if (record.dump() != text) refuse(file, line, "this line was written by something else");
  json content = record;
  content.erase("hash");
  if (record["hash"] != chain_hash(previous, content)) refuse(file, line, "this line does not fit the one before it");
  if (record.value("number", 0L) != static_cast<long>(line)) refuse(file, line, "this line has the wrong number");
  return record;
}

Parsed parse(const std::filesystem::path& file, const std::string& text) {
  Parsed parsed;
  std::string previous;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = text.find('\n', begin);
    const std::size_t line = parsed.records.size() + 1;
    if (end == std::string::npos) {
      // A crash leaves the beginning of a line. A whole record followed by something else was no crash.
      const std::string tail = text.substr(begin);
      if (tail.size() > 1 && json::accept(tail.substr(0, tail.size() - 1)))
        refuse(file, line, "this line does not end as a line does");
      break;
    }
    json record = checked_record(file, line, text.substr(begin, end - begin), previous);
    previous = record["hash"].get<std::string>();
    parsed.records.push_back(std::move(record));
    begin = end + 1;
    parsed.whole_bytes = begin;
  }
  return parsed;
}

/// A file open for appending that is closed again, whatever happens.
class AppendingFile {
 public:
  explicit AppendingFile(const std::filesystem::path& file)
      : file_(file), descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0) fail("cannot be opened for appending");
  }
  ~AppendingFile() { ::close(descriptor_); }
  AppendingFile(const AppendingFile&) = delete;
  AppendingFile& operator=(const AppendingFile&) = delete;
  AppendingFile(AppendingFile&&) = delete;
  AppendingFile& operator=(AppendingFile&&) = delete;

  /// Writes and syncs; where that fails nothing of the text stays behind.
  void append(const std::string& text) {
    const off_t before = ::lseek(descriptor_, 0, SEEK_END);
    std::size_t written = 0;
    while (written < text.size()) {
      const ssize_t count = ::write(descriptor_, text.data() + written, text.size() - written);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) undo(before);
      written += static_cast<std::size_t>(count);
    }
    if (::fsync(descriptor_) != 0) undo(before);
  }

  void cut(std::size_t size) {
    if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0 || ::fsync(descriptor_) != 0)
      fail("cannot be cut back to its last whole line");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: {}: {}. Check the disk's space and the permissions of the run folder.",
                              file_.string(), what, std::strerror(errno)))
        .at("file", file_.string());
  }

  [[noreturn]] void undo(off_t size) {
    const int error = errno;
    [[maybe_unused]] const int ignored = ::ftruncate(descriptor_, size);
    errno = error;
    fail("cannot be written");
  }

  std::filesystem::path file_;
  int descriptor_;
};

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

Journal::Journal(std::filesystem::path file) : file_(std::move(file)) {
  const bool there = std::filesystem::exists(file_);
  AppendingFile appending(file_);
  if (!there) {
    sync_folder(file_.parent_path());
    return;
  }
  const std::string text = read_text(file_);
  Parsed parsed = parse(file_, text);
  if (parsed.whole_bytes < text.size()) appending.cut(parsed.whole_bytes);
  records_ = std::move(parsed.records);
}

void Journal::append(const std::string& event, const json& content) {
  json record = content.is_null() ? json::object() : content;
  record["number"] = records_.size() + 1;
  record["time"] = utc_now();
  record["event"] = event;
  const std::string previous = records_.empty() ? std::string() : records_.back()["hash"].get<std::string>();
  record["hash"] = chain_hash(previous, record);
  AppendingFile(file_).append(record.dump() + "\n");
  records_.push_back(std::move(record));
}

std::vector<json> read_journal(const std::filesystem::path& file) { return parse(file, read_text(file)).records; }

std::string utc_now() {
  using namespace std::chrono;
  const auto now = system_clock::now();
  const auto milliseconds = duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() % 1000;
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03d}Z", fmt::gmtime(system_clock::to_time_t(now)), milliseconds);
}

double seconds_since_epoch(const std::string& utc) {
  std::tm broken{};
  const char* rest = ::strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%S", &broken);
  if (rest == nullptr) throw Failure(ExitCode::wrong_input, fmt::format("\"{}\" is not a time in UTC.", utc));
  const double fraction = *rest == '.' ? std::strtod(rest, nullptr) : 0.;
  return static_cast<double>(::timegm(&broken)) + fraction;
}

}  // namespace cupola
