#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "orchestrator/study/study_tasks.hpp"

namespace cupola {

/// The tasks of a study in the order in which they can run as arrays of jobs: each array needs only those before it.
/// What has finished or failed already is left out.
std::vector<std::vector<std::size_t>> array_layers(const std::vector<StudyTask>& tasks);

/// `0-3,7`: the members of an array, at most `at_once` of them at a time (`%`; 0: no limit).
std::string array_list(const std::vector<std::size_t>& members, int at_once);

/// Queues what is left of a study in Slurm: one array of jobs for each layer, a member for each task, and a last job
/// that gathers the results.  A layer begins when the one before it has ended, in whatever way.
/// @param study_file, @param folder absolute
/// @return numbers of the jobs
/// @throws Failure wrong_input: the scene has no `launch.slurm`, or Slurm refuses; input_output: Slurm does not answer
std::vector<std::string> submit_study(const Study& study, const StudyWork& work, const std::filesystem::path& folder);

}  // namespace cupola
