#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "raw_files.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

using test::failure_of;
using testing::HasSubstr;

TEST(FolderLock, IsHeldForTheObjectsLife) {
  const TemporaryFolder folder;
  EXPECT_FALSE(FolderLock::holder(folder.path()));
  {
    const FolderLock lock(folder.path());
    const Failure failure = failure_of([&] { FolderLock(folder.path()); });
    EXPECT_EQ(failure.code(), ExitCode::held);
    EXPECT_THAT(failure.what(), HasSubstr("process " + std::to_string(::getpid())));
    EXPECT_THAT(FolderLock::holder(folder.path()).value(), HasSubstr("since 2"));
  }
  EXPECT_FALSE(FolderLock::holder(folder.path()));
  EXPECT_NO_THROW(FolderLock(folder.path()));
}

TEST(FolderLock, OfAnotherProcessIsSeenAndEndsWithItHoweverItEnds) {
  const TemporaryFolder folder;
  std::array<int, 2> ready{};
  ASSERT_EQ(::pipe(ready.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    const char byte = 1;
    (void)!::write(ready[1], &byte, 1);
    ::pause();
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_THAT(failure_of([&] { FolderLock(folder.path()); }).what(), HasSubstr("process " + std::to_string(child)));
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  EXPECT_NO_THROW(FolderLock(folder.path()));
  ::close(ready[0]);
  ::close(ready[1]);
}

/// A stage that outlives the orchestrator that started it must not keep the run folder locked.
TEST(FolderLock, IsNotInheritedByProgramsItStarts) {
  const TemporaryFolder folder;
  pid_t child = -1;
  {
    const FolderLock lock(folder.path());
    child = ::fork();
    if (child == 0) {
      ::execl("/bin/sleep", "sleep", "30", nullptr);
      ::_exit(127);
    }
    // Until exec has closed it the child shares the lock.
    while (!std::filesystem::read_symlink("/proc/" + std::to_string(child) + "/exe").string().ends_with("sleep")) {
      ::usleep(1000);
    }
  }
  EXPECT_NO_THROW(FolderLock(folder.path()));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

/// What another host of a shared file system leaves in the folder, its last sign of life so long ago.
void held_elsewhere(const std::filesystem::path& folder, std::chrono::seconds ago) {
  test::write_raw(folder / "lock", R"({"host":"node-17","pid":4711,"since":"2026-11-22T01:02:03Z"})");
  std::filesystem::last_write_time(folder / "lock", std::filesystem::file_time_type::clock::now() - ago);
}

TEST(FolderLock, OfAnotherHostCountsWhileItGivesSignsOfLife) {
  const TemporaryFolder folder;
  held_elsewhere(folder.path(), sign_of_life_every);
  const Failure failure = failure_of([&] { FolderLock(folder.path()); });
  EXPECT_EQ(failure.code(), ExitCode::held);
  EXPECT_THAT(failure.what(), HasSubstr("process 4711 on node-17 since 2026-11-22T01:02:03Z"));
  EXPECT_THAT(FolderLock::holder(folder.path()).value(), HasSubstr("node-17"));
  // A clock that was put back: the sign of life lies ahead.
  held_elsewhere(folder.path(), -std::chrono::hours(2));
  EXPECT_EQ(failure_of([&] { FolderLock(folder.path()); }).code(), ExitCode::held);
}

TEST(FolderLock, OfAHostThatCrashedIsTaken) {
  const TemporaryFolder folder;
  held_elsewhere(folder.path(), dead_after_silence + std::chrono::seconds(2));
  EXPECT_FALSE(FolderLock::holder(folder.path()));
  const FolderLock lock(folder.path());
  EXPECT_THAT(FolderLock::holder(folder.path()).value(), HasSubstr("process " + std::to_string(::getpid())));
}

/// A file server that still keeps the kernel's lock of a host that crashed.
TEST(FolderLock, OfAHostThatCrashedIsTakenAlsoWhereTheServerKeepsIt) {
  const TemporaryFolder folder;
  held_elsewhere(folder.path(), dead_after_silence + std::chrono::seconds(2));
  const int server = ::open((folder.path() / "lock").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_EQ(::flock(server, LOCK_EX), 0);
  {
    const FolderLock lock(folder.path());
    EXPECT_EQ(failure_of([&] { FolderLock(folder.path()); }).code(), ExitCode::held);
  }
  ::close(server);
}

TEST(FolderLock, GivenBackSaysNothingOfItsHolder) {
  const TemporaryFolder folder;
  { const FolderLock lock(folder.path()); }
  EXPECT_EQ(test::raw_bytes(folder.path() / "lock"), "");
}

TEST(FolderLock, GivesSignsOfLife) {
  const TemporaryFolder folder;
  const FolderLock lock(folder.path());
  held_elsewhere(folder.path(), std::chrono::hours(1));
  const auto before = std::filesystem::last_write_time(folder.path() / "lock");
  std::this_thread::sleep_for(sign_of_life_every + std::chrono::seconds(1));
  EXPECT_GT(std::filesystem::last_write_time(folder.path() / "lock"), before);
}

}  // namespace
}  // namespace cupola
