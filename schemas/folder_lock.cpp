#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <thread>

#include "schemas/file_descriptor.hpp"
#include "schemas/files.hpp"

namespace cupola {

namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? std::string(name.data()) : "unknown host";
}

/// What the lock file says about its holder; the holder may just be writing it.
std::string describe_holder(const std::filesystem::path& file) {
  const nlohmann::json content = nlohmann::json::parse(read_text(file), nullptr, false);
  if (!content.is_object()) {
    return "another process";
  }
  return fmt::format("process {} on {} since {}", content.value("pid", 0), content.value("host", "unknown host"),
                     content.value("since", "unknown time"));
}

/// Takes the lock without waiting. @return false where another process holds it
bool take(int descriptor, const std::filesystem::path& file) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
    return true;
  }
  if (errno == EWOULDBLOCK) {
    return false;
  }
  throw_system_failure(file, "lock");
}

/// Takes the lock; whoever only looks whether it is held (`holder`) has it for a moment, which is waited for.
bool take_patiently(int descriptor, const std::filesystem::path& file) {
  constexpr int looks = 10;
  for (int look = 0; look < looks; ++look) {
    if (take(descriptor, file)) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "lock";
  FileDescriptor opened(file, O_RDWR | O_CREAT);
  if (!take_patiently(opened.get(), file)) {
    throw Failure(ExitCode::held,
                  fmt::format("{}: held by {}; wait for it, or stop it first", folder.string(), describe_holder(file)))
        .at("folder", folder.string());
  }
  if (::ftruncate(opened.get(), 0) != 0) {
    throw_system_failure(file, "write");
  }
  const nlohmann::json content = {{"host", host_name()},
                                  {"pid", ::getpid()},
                                  {"since", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
  opened.write(content.dump() + "\n");
  descriptor_ = opened.release();
}

FolderLock::~FolderLock() { ::close(descriptor_); }

std::optional<std::string> FolderLock::holder(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "lock";
  if (!std::filesystem::exists(file)) {
    return std::nullopt;
  }
  const FileDescriptor opened(file, O_RDONLY);  // also where we may only read
  return take(opened.get(), file) ? std::nullopt : std::optional(describe_holder(file));
}

}  // namespace cupola
