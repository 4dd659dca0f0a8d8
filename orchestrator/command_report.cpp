#include <fmt/format.h>

#include "orchestrator/commands.hpp"
#include "orchestrator/report/report.hpp"

namespace cupola {

ExitCode report(const std::filesystem::path& folder) {
  make_report(folder);
  fmt::print("{}\n", (std::filesystem::absolute(folder) / "report" / "index.html").lexically_normal().string());
  return ExitCode::done;
}

}  // namespace cupola
