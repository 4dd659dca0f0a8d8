#pragma once
#include <mpi.h>

#include <functional>
#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cupola {

/// Owns one LIGGGHTS on a duplicate of the communicator.  While an exception flies through several ranks nothing is
/// closed: closing is collective, the other ranks do not come, and the process is about to be aborted.
class LiggghtsInstance {
 public:
  LiggghtsInstance(MPI_Comm communicator, const std::string& log_file);
  ~LiggghtsInstance();
  LiggghtsInstance(const LiggghtsInstance&) = delete;
  LiggghtsInstance& operator=(const LiggghtsInstance&) = delete;

  /// @throws Failure diverged with LIGGGHTS' sentence and the command
  void command(const std::string& line);

  /// Calls into LIGGGHTS; its refusals name `line` as the command.
  /// @throws Failure diverged as `command`
  static void guarded(const std::string& line, const std::function<void()>& work);

  [[nodiscard]] LAMMPS_NS::LAMMPS& operator*() const { return *instance_; }
  [[nodiscard]] LAMMPS_NS::LAMMPS* operator->() const { return instance_; }
  [[nodiscard]] MPI_Comm communicator() const { return communicator_; }
  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int ranks() const { return ranks_; }

 private:
  MPI_Comm communicator_ = MPI_COMM_NULL;
  int rank_ = 0;
  int ranks_ = 1;
  LAMMPS_NS::LAMMPS* instance_ = nullptr;
};

}  // namespace cupola
