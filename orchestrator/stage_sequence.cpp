#include "orchestrator/stage_sequence.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace cupola {
namespace {

constexpr std::array<std::pair<TaskKind, const char*>, 4> names{{{TaskKind::dem, "dem"},
                                                                 {TaskKind::tracer, "tracer"},
                                                                 {TaskKind::predict, "predict"},
                                                                 {TaskKind::correct, "correct"}}};

}  // namespace

std::string stage_name(TaskKind kind) {
  for (const auto& [known, name] : names)
    if (known == kind) return name;
  throw std::logic_error("a kind of task without a name");
}

TaskKind stage_kind(const std::string& wanted) {
  for (const auto& [kind, name] : names)
    if (wanted == name) return kind;
  throw std::out_of_range("no stage is called " + wanted);
}

std::string stage_title(TaskKind kind, int episode) {
  if (kind == TaskKind::predict && episode == before_all_episodes) return "first prediction";
  switch (kind) {
    case TaskKind::predict:
      return fmt::format("prediction of episode {}", episode);
    case TaskKind::correct:
      return fmt::format("correction of episode {}", episode);
    default:
      return fmt::format("{} stage of episode {}", stage_name(kind), episode);
  }
}

bool can_be_left_out(TaskKind kind) { return kind == TaskKind::predict || kind == TaskKind::correct; }

const std::vector<TaskKind>& stages_of_episode(Strategy strategy) {
  static const std::vector<TaskKind> marching = {TaskKind::dem, TaskKind::tracer};
  return strategy == Strategy::march ? marching : all_stages_of_episode();
}

const std::vector<TaskKind>& all_stages_of_episode() {
  static const std::vector<TaskKind> all = {TaskKind::dem, TaskKind::predict, TaskKind::tracer, TaskKind::correct};
  return all;
}

}  // namespace cupola
