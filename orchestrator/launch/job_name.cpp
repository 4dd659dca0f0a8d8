#include "orchestrator/launch/job_name.hpp"

#include <fmt/format.h>

namespace cupola {

std::string job_name(const RunFolder& run, const std::string& what) {
  // The journal grows with every job.
  const std::string unique = hash_text(run.path().string() + std::to_string(run.journal().records().size()));
  return fmt::format("cupola-{}-{}", unique.substr(unique.find(':') + 1, 10), what);
}

}  // namespace cupola
