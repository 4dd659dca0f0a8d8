#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "schemas/campaign.hpp"

namespace cupola {

/// A word as the shell reads it back, whatever letters are in it.
std::string quoted(const std::string& word);

/// The script of a job that prepares a stage's task and becomes the stage: the signal before the time limit then
/// reaches it without a shell in between.  A request to stop that comes during the preparation ends the job with 75.
std::string stage_script(const SlurmLaunch& slurm, const std::vector<std::string>& prepare,
                         const std::vector<std::string>& run);

/// The script of a link of a chain: a job that becomes cupola itself.
std::string link_script(const SlurmLaunch& slurm, const std::vector<std::string>& cupola);

/// The ranks of a stage inside a job: `mpirun` or `srun`, which take nodes and places from Slurm.
std::vector<std::string> ranks_in_job(SlurmLaunch::Starter starter, int ranks, const std::vector<std::string>& program);

}  // namespace cupola
