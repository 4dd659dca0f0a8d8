#include <fmt/format.h>

#include "orchestrator/commands.hpp"
#include "orchestrator/run_status.hpp"

namespace cupola {

ExitCode status(const std::filesystem::path& folder, bool as_json) {
  const nlohmann::json present = run_status(read_run(folder));
  fmt::print("{}\n", as_json ? present.dump(2) : status_text(present));
  return ExitCode::done;
}

}  // namespace cupola
