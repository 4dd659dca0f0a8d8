#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "orchestrator/child_process.hpp"
#include "orchestrator/signal_watch.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "schemas/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using cupola::ChildProcess;
using cupola::Command;
using cupola::ProcessIdentity;
using cupola::SignalWatch;
using cupola::TemporaryFolder;
using namespace std::chrono_literals;

Command shell(const std::string& script, const std::filesystem::path& log) {
  Command command;
  command.words = {"sh", "-c", script};
  command.log = log;
  return command;
}

int end_of(ChildProcess& process, SignalWatch& signals) {
  const auto begin = std::chrono::steady_clock::now();
  while (!process.poll()) {
    signals.wait(100ms);
    if (std::chrono::steady_clock::now() - begin > 20s) throw std::runtime_error("the process does not end");
  }
  return *process.poll();
}

TEST(ChildProcess, HandsItsStatusOnAndWritesItsLog) {
  const TemporaryFolder folder;
  SignalWatch signals;
  Command command = shell("echo \"$COLOUR\"; echo worse >&2; exit 75", folder.path() / "log");
  command.environment["COLOUR"] = std::string("blue");
  ChildProcess process(command, signals.former_mask());
  process.release();
  EXPECT_EQ(end_of(process, signals), 75);
  EXPECT_EQ(cupola::read_text(folder.path() / "log"), "blue\nworse\n");
}

TEST(ChildProcess, DoesNothingBeforeItIsReleased) {
  const TemporaryFolder folder;
  SignalWatch signals;
  {
    ChildProcess process(shell("touch " + (folder.path() / "done").string(), folder.path() / "log"),
                         signals.former_mask());
    std::this_thread::sleep_for(100ms);
    EXPECT_FALSE(process.poll());
  }
  ::wait(nullptr);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "done"));
}

TEST(ChildProcess, ThatCannotBeStartedSaysSo) {
  const TemporaryFolder folder;
  SignalWatch signals;
  Command command;
  command.words = {(folder.path() / "no-such-program").string()};
  command.log = folder.path() / "log";
  ChildProcess process(command, signals.former_mask());
  process.release();
  EXPECT_EQ(end_of(process, signals), 127);
  EXPECT_NE(cupola::read_text(folder.path() / "log").find("cannot be started"), std::string::npos);
}

TEST(ChildProcess, HasASessionOfItsOwnAndHearsSignals) {
  const TemporaryFolder folder;
  SignalWatch signals;
  ChildProcess process(
      shell("trap 'exit 75' USR1; : > " + (folder.path() / "ready").string() + "; while :; do sleep 0.05; done",
            folder.path() / "log"),
      signals.former_mask());
  process.release();
  while (!std::filesystem::exists(folder.path() / "ready")) signals.wait(20ms);
  EXPECT_EQ(::getsid(process.pid()), process.pid());
  process.signal(SIGUSR1);
  EXPECT_EQ(end_of(process, signals), 75);
}

TEST(ChildProcess, EndedByASignalHasTheShellsStatus) {
  const TemporaryFolder folder;
  SignalWatch signals;
  ChildProcess process(shell("kill -9 $$", folder.path() / "log"), signals.former_mask());
  process.release();
  EXPECT_EQ(end_of(process, signals), 128 + SIGKILL);
}

TEST(ProcessIdentity, TellsAProcessFromItsSuccessor) {
  ProcessIdentity self = ProcessIdentity::of(::getpid());
  EXPECT_TRUE(self.alive());
  self.started += 1;
  EXPECT_FALSE(self.alive()) << "same number, another process";
  self = ProcessIdentity::of(::getpid());
  self.host = "elsewhere";
  EXPECT_FALSE(self.alive());
  EXPECT_FALSE(ProcessIdentity::of(0x3fffffff).alive());
}

TEST(SignalWatch, CountsRequestsToStop) {
  SignalWatch signals;
  EXPECT_EQ(signals.stop_requests(), 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::kill(::getpid(), signal);
  EXPECT_EQ(signals.stop_requests(), 3);
  ::kill(::getpid(), SIGINT);
  EXPECT_EQ(signals.stop_requests(), 4);
}

TEST(SignalWatch, WakesWhenAChildEnds) {
  const TemporaryFolder folder;
  SignalWatch signals;
  ChildProcess process(shell("exit 0", folder.path() / "log"), signals.former_mask());
  process.release();
  const auto begin = std::chrono::steady_clock::now();
  while (!process.poll()) signals.wait(20s);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
}

TEST(Mpirun, AsksForMorePlacesOnlyWhereItMust) {
  const auto words = [](int ranks) {
    std::string text;
    for (const std::string& word : cupola::mpirun(ranks, {"program", "task"}).words) text += word + " ";
    return text;
  };
  EXPECT_EQ(words(1), "mpirun -n 1 --bind-to none program task ");
  EXPECT_EQ(words(100000), "mpirun -n 100000 --bind-to none --oversubscribe program task ");
  EXPECT_EQ(cupola::mpirun(1, {}).environment.contains("OMPI_ALLOW_RUN_AS_ROOT"), ::geteuid() == 0);
}

}  // namespace
