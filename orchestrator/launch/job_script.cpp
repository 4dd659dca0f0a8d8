#include "orchestrator/launch/job_script.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <string_view>

namespace cupola {
namespace {

std::string line_of(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + quoted(word);
  return line;
}

std::string beginning(const SlurmLaunch& slurm, const std::string& what) {
  std::string text = fmt::format("#!/bin/bash\n# Written by cupola: {}.\nset -e\n", what);
  for (const std::string& line : slurm.setup) text += line + "\n";
  // Programs of Open MPI refuse to run as root unless told so; in a container root is all there is.
  if (::geteuid() == 0) text += "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1\n";
  return text;
}

}  // namespace

std::string quoted(const std::string& word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char letter : word) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

std::string stage_script(const SlurmLaunch& slurm, const std::vector<std::string>& prepare,
                         const std::vector<std::string>& run) {
  return beginning(slurm, "prepares a stage and becomes it") +
         fmt::format("trap 'exit 75' USR1 TERM\n{}\ntrap - USR1 TERM\nexec {}\n", line_of(prepare), line_of(run));
}

std::string link_script(const SlurmLaunch& slurm, const std::vector<std::string>& cupola) {
  return beginning(slurm, "one stage of a campaign that runs as a chain of jobs") +
         fmt::format("exec {}\n", line_of(cupola));
}

std::vector<std::string> ranks_in_job(SlurmLaunch::Starter starter, int ranks,
                                      const std::vector<std::string>& program) {
  std::vector<std::string> words;
  if (starter == SlurmLaunch::Starter::srun)
    words = {"srun", fmt::format("--ntasks={}", ranks)};
  else
    words = {"mpirun", "-n", std::to_string(ranks), "--bind-to", "none"};
  words.insert(words.end(), program.begin(), program.end());
  return words;
}

}  // namespace cupola
