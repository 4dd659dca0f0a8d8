#pragma once
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "orchestrator/child_process.hpp"
#include "orchestrator/signal_watch.hpp"
#include "orchestrator/stage_launcher.hpp"
#include "orchestrator/study/study_tasks.hpp"

namespace cupola {

/// Works through the tasks of a study on this machine, `jobs` at a time.  A task that fails is noted down and the
/// others go on.  What it starts ends with it; a stage that was killed goes on from its checkpoint the next time.
class StudyRunner {
 public:
  /// All but `jobs` are kept by reference. @param after_task called after each task that has ended
  StudyRunner(std::vector<StudyTask>& tasks, const StageLauncher& launcher, SignalWatch& signals, int jobs,
              std::function<void(const StudyTask&)> after_task);

  /// Until all have ended, or a stop was asked for and what ran has written its checkpoint.
  /// @return whether nothing is left to do
  bool go();

 private:
  struct Running {
    std::size_t task;
    bool preparing;
    std::unique_ptr<ChildProcess> process;
    int asked = 0;  ///< requests to stop that were passed on
  };

  void start_what_is_ready();
  void begin(std::size_t task);
  void start(std::size_t task, bool preparing);
  /// @return whether it has ended
  bool look_at(Running& running);
  void judge(StudyTask& task, int status);

  std::vector<StudyTask>& tasks_;
  const StageLauncher& launcher_;
  SignalWatch& signals_;
  std::size_t jobs_;
  std::function<void(const StudyTask&)> after_task_;
  std::list<Running> running_;
};

}  // namespace cupola
