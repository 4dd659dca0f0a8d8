#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <ctime>
#include <mutex>
#include <thread>

#include "schemas/file_descriptor.hpp"
#include "schemas/files.hpp"

namespace cupola {

namespace {

using std::chrono::seconds;

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : "unknown host";
}

/// What a lock file says about its holder.
struct Note {
  std::string host;  ///< empty where nobody has put itself down
  std::string text;
};

Note read_note(const std::filesystem::path& file) {
  const std::string written = read_text(file);
  if (written.empty()) return {};
  const nlohmann::json content = nlohmann::json::parse(written, nullptr, false);
  // The holder may just be writing it.
  if (!content.is_object()) return {host_name(), "another process"};
  const std::string host = content.value("host", "unknown host");
  return {host, fmt::format("process {} on {} since {}", content.value("pid", 0), host,
                            content.value("since", "unknown time"))};
}

std::string holder_text(const std::filesystem::path& file) {
  const Note note = read_note(file);
  return note.text.empty() ? "another process" : note.text;
}

/// Takes the kernel's lock without waiting. @return false where another process holds it
bool take(int descriptor, const std::filesystem::path& file) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
  if (errno == EWOULDBLOCK) return false;
  throw_system_failure(file, "lock (the file system must know locks)");
}

/// Takes the lock; whoever only looks whether it is held (`holder`) has it for a moment, which is waited for.
bool take_patiently(int descriptor, const std::filesystem::path& file) {
  constexpr int looks = 10;
  for (int look = 0; look < looks; ++look) {
    if (take(descriptor, file)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

struct stat state_of(const std::filesystem::path& file) {
  struct stat state {};
  if (::stat(file.c_str(), &state) != 0) throw_system_failure(file, "look at");
  return state;
}

/// What time it is for the file system the folder lies on.
std::time_t file_system_time(const std::filesystem::path& lock) {
  const std::filesystem::path probe = lock.string() + fmt::format(".{}.part", ::getpid());
  FileDescriptor(probe, O_WRONLY | O_CREAT | O_TRUNC).write("\n");
  const std::time_t now = state_of(probe).st_mtime;
  std::error_code ignored;
  std::filesystem::remove(probe, ignored);
  return now;
}

/// For how long the holder has given no sign of life. A time of change that lies ahead says that it lives.
seconds silence(const std::filesystem::path& lock, std::time_t now) {
  return seconds(std::max<std::time_t>(now - state_of(lock).st_mtime, 0));
}

Failure held_by(const std::filesystem::path& folder, const std::string& who, const std::string& more = "") {
  return Failure(ExitCode::held,
                 fmt::format("{}: held by {}{}; wait for it, or stop it first", folder.string(), who, more))
      .at("folder", folder.string());
}

/// A lock of the kernel's that has outlived the host that took it (the file server has not noticed): gives way to a new
/// file.  Only one process at a time does this.
void replace_abandoned(const std::filesystem::path& lock, ino_t abandoned) {
  const std::filesystem::path guard = lock.string() + ".replacing.part";
  const FileDescriptor opened(guard, O_RDWR | O_CREAT);
  if (!take_patiently(opened.get(), guard) || state_of(lock).st_ino != abandoned) return;
  std::filesystem::remove(lock);
}

}  // namespace

struct FolderLock::Held {
  explicit Held(FileDescriptor& opened) : descriptor(opened.release()) {
    // Signals are for the program's own threads.
    sigset_t all;
    sigset_t former;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &former);
    sign_of_life = std::jthread([lock = descriptor](const std::stop_token& over) {
      std::mutex alone;
      std::condition_variable_any wake;
      std::unique_lock guard(alone);
      while (!wake.wait_for(guard, over, sign_of_life_every, [&] { return over.stop_requested(); }))
        ::futimens(lock, nullptr);
    });
    pthread_sigmask(SIG_SETMASK, &former, nullptr);
  }
  ~Held() {
    sign_of_life.request_stop();
    sign_of_life.join();
    [[maybe_unused]] const int ignored = ::ftruncate(descriptor, 0);
    ::close(descriptor);
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  Held(Held&&) = delete;
  Held& operator=(Held&&) = delete;

  int descriptor;
  std::jthread sign_of_life;
};

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "lock";
  constexpr int tries = 5;  // a lock may be replaced while we look at it
  for (int attempt = 0; attempt < tries && !held_; ++attempt) {
    FileDescriptor opened(file, O_RDWR | O_CREAT);
    const bool taken = take_patiently(opened.get(), file);
    struct stat own {};
    if (::fstat(opened.get(), &own) != 0 || !std::filesystem::exists(file) || state_of(file).st_ino != own.st_ino)
      continue;
    const Note note = read_note(file);
    const bool elsewhere = !note.host.empty() && note.host != host_name();
    if (!taken && !elsewhere) throw held_by(folder, holder_text(file));
    if (elsewhere) {
      const seconds silent = silence(file, file_system_time(file));
      if (silent < dead_after_silence)
        throw held_by(folder, note.text,
                      fmt::format(" (last sign of life {} s ago; after {} s of silence it counts as dead)",
                                  silent.count(), dead_after_silence.count()));
      if (!taken) {
        replace_abandoned(file, own.st_ino);
        continue;
      }
    }
    if (::ftruncate(opened.get(), 0) != 0) throw_system_failure(file, "write");
    const nlohmann::json content = {{"host", host_name()},
                                    {"pid", ::getpid()},
                                    {"since", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
    opened.write(content.dump() + "\n");
    held_ = std::make_unique<Held>(opened);
  }
  if (!held_) throw held_by(folder, holder_text(file));
}

FolderLock::~FolderLock() = default;

std::optional<std::string> FolderLock::holder(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "lock";
  if (!std::filesystem::exists(file)) return std::nullopt;
  const FileDescriptor opened(file, O_RDONLY);  // also where we may only read
  const bool held_here = !take(opened.get(), file);
  const Note note = read_note(file);
  const bool elsewhere = !note.host.empty() && note.host != host_name();
  if (elsewhere)
    return silence(file, std::time(nullptr)) < dead_after_silence ? std::optional(note.text) : std::nullopt;
  return held_here ? std::optional(holder_text(file)) : std::nullopt;
}

}  // namespace cupola
