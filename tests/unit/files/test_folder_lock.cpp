#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

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

}  // namespace
}  // namespace cupola
