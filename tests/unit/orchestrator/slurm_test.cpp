#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "orchestrator/launch/job_script.hpp"
#include "orchestrator/launch/program_output.hpp"
#include "orchestrator/launch/slurm_queue.hpp"

namespace cupola {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Phase = JobState::Phase;

Launch launch_of(const SlurmLaunch& slurm) {
  Launch launch;
  launch.ranks = 64;
  launch.slurm = slurm;
  return launch;
}

SlurmLaunch one_day() {
  SlurmLaunch slurm;
  slurm.time = 86400;
  slurm.checkpoint_before = 600;
  return slurm;
}

TEST(SlurmSubmission, SaysEverythingSbatchNeeds) {
  SlurmLaunch slurm = one_day();
  slurm.partition = "batch";
  slurm.account = "furnace";
  slurm.nodes = 2;
  slurm.options = {"--mem=16G"};
  const auto words = sbatch_words(launch_of(slurm), {"name", "/run/job.sh", "/run", "/run/100%/stage.log", "17"});
  EXPECT_THAT(words, testing::ElementsAre("sbatch", "--parsable", "--job-name=name", "--ntasks=64", "--time=1440:00",
                                          "--signal=B:USR1@600", "--requeue", "--open-mode=append",
                                          "--output=/run/100%%/stage.log", "--chdir=/run", "--partition=batch",
                                          "--account=furnace", "--nodes=2", "--dependency=afterok:17",
                                          "--kill-on-invalid-dep=yes", "--mem=16G", "/run/job.sh"));
}

TEST(SlurmSubmission, RoundsTimesUpSoThatNoneIsLost) {
  SlurmLaunch slurm = one_day();
  slurm.time = 90.5;
  slurm.checkpoint_before = 12.1;
  const auto words = sbatch_words(launch_of(slurm), {"name", "/job.sh", "/", "/log", ""});
  EXPECT_THAT(words, Contains("--time=1:31"));
  EXPECT_THAT(words, Contains("--signal=B:USR1@13"));
}

TEST(JobScript, BecomesTheStage) {
  SlurmLaunch slurm = one_day();
  slurm.setup = {"module load openmpi"};
  const auto script = stage_script(slurm, {"/opt/cupola-dem", "prepare", "/my run"},
                                   ranks_in_job(SlurmLaunch::Starter::mpirun, 4, {"/opt/cupola-dem", "/my run"}));
  EXPECT_THAT(script, testing::StartsWith("#!/bin/bash\n"));
  EXPECT_LT(script.find("set -e\n"), script.find("module load openmpi\n"));
  EXPECT_LT(script.find("module load openmpi\n"), script.find("/opt/cupola-dem prepare '/my run'\n"));
  EXPECT_THAT(script, testing::EndsWith("\nexec mpirun -n 4 --bind-to none /opt/cupola-dem '/my run'\n"));
  EXPECT_THAT(ranks_in_job(SlurmLaunch::Starter::srun, 4, {"program"}),
              testing::ElementsAre("srun", "--ntasks=4", "program"));
}

TEST(JobScript, QuotesWhateverTheShellWouldRead) {
  for (const std::string word :
       {"plain", "two words", "it's", "$(date)", "über/straße", "", "a\"b", "new\nline", "*"}) {
    const auto said = output_of({"bash", "-c", "printf %s " + quoted(word)}, std::chrono::seconds(60));
    EXPECT_EQ(said.output, word);
  }
}

TEST(JobState, IsReadFromSqueueAndScontrol) {
  const auto waiting = job_state_from("PENDING|Resources\n", "JobId=1 JobState=PENDING Restarts=2 ExitCode=0:0");
  EXPECT_EQ(waiting.phase, Phase::waiting);
  EXPECT_EQ(waiting.reason, "Resources");
  EXPECT_EQ(waiting.restarts, 2);
  EXPECT_FALSE(waiting.status);
  EXPECT_EQ(job_state_from("RUNNING|None\n", "").phase, Phase::running);
  EXPECT_EQ(job_state_from("COMPLETING|None\n", "").phase, Phase::running);
  const auto stopped = job_state_from("FAILED|NonZeroExitCode\n", "JobId=1 Restarts=0 ExitCode=75:0 RunTime=00:01");
  EXPECT_EQ(stopped.phase, Phase::ended);
  EXPECT_EQ(stopped.status, 75);
  EXPECT_EQ(job_state_from("TIMEOUT|TimeLimit", "ExitCode=0:15").status, 128 + 15);
  EXPECT_FALSE(job_state_from("TIMEOUT|TimeLimit", "").status);
}

TEST(JobState, IsReadFromAccounting) {
  EXPECT_EQ(job_state_from_accounting("COMPLETED|0:0\n").status, 0);
  const auto cancelled = job_state_from_accounting("CANCELLED by 1000|0:15\n");
  EXPECT_EQ(cancelled.word, "CANCELLED");
  EXPECT_EQ(cancelled.phase, Phase::ended);
  EXPECT_EQ(job_state_from_accounting("RUNNING|0:0\n").phase, Phase::running);
}

TEST(ProgramOutput, TakesBothStreamsAndTheStatus) {
  const auto said = output_of({"bash", "-c", "echo out; echo wrong >&2; exit 3"}, std::chrono::seconds(60));
  EXPECT_EQ(said.output, "out\n");
  EXPECT_EQ(said.error, "wrong\n");
  EXPECT_EQ(said.status, 3);
  EXPECT_EQ(output_of({"cupola-no-such-program"}, std::chrono::seconds(60)).status, 127);
}

TEST(ProgramOutput, HoldsMoreThanAPipeDoes) {
  const auto said = output_of({"bash", "-c", "head -c 1000000 /dev/zero | tr '\\0' x"}, std::chrono::seconds(60));
  EXPECT_EQ(said.output.size(), 1000000U);
}

TEST(ProgramOutput, DoesNotWaitForEver) {
  const auto said = output_of({"sleep", "100"}, std::chrono::seconds(1));
  EXPECT_EQ(said.status, 128 + SIGKILL);
  EXPECT_THAT(said.error, HasSubstr("sleep did not answer within 1 s"));
}

}  // namespace
}  // namespace cupola
