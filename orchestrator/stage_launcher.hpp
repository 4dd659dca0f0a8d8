#pragma once
#include <filesystem>
#include <string>

#include "orchestrator/child_process.hpp"
#include "orchestrator/stage_sequence.hpp"
#include "schemas/task.hpp"

namespace cupola {

/// How stages are started on this machine: `cupola-dem` and `cupola-tracer` from the folder of our own program, with
/// mpirun.
class StageLauncher {
 public:
  /// @param programs folder of the stages' programs. @throws Failure input_output where one is missing
  explicit StageLauncher(std::filesystem::path programs);

  /// The folder this program itself lies in.
  static std::filesystem::path own_folder();

  /// One process that writes the task's OpenFOAM case; dies with us.
  [[nodiscard]] Command prepare(TaskKind kind, const std::filesystem::path& task_folder) const;
  /// The stage itself; goes on when we die.  Inside an allocation of Slurm it gets its places there.
  [[nodiscard]] Command run(TaskKind kind, const std::filesystem::path& task_folder, const Launch& launch) const;
  /// The stage itself as the last line of a job's script.
  [[nodiscard]] std::vector<std::string> words_in_job(TaskKind kind, const std::filesystem::path& task_folder,
                                                      const Launch& launch) const;
  /// Where the programs are.
  [[nodiscard]] const std::filesystem::path& folder() const { return programs_; }

  /// The stage's program.
  [[nodiscard]] std::filesystem::path program(TaskKind kind) const;

 private:
  std::filesystem::path programs_;
};

/// Whether this process runs inside an allocation of Slurm with room for so many ranks: stages are then started in it.
bool in_allocation_for(int ranks);

/// `mpirun` with what a run on this machine needs: no binding (two runs would share the first cores), more ranks than
/// cores only where they are asked for, permission to run as root only where we do.
Command mpirun(int ranks, const std::vector<std::string>& program_and_arguments);

}  // namespace cupola
