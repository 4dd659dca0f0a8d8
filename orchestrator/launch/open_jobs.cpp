#include "orchestrator/launch/open_jobs.hpp"

namespace cupola {

OpenJobs open_jobs(const std::vector<nlohmann::json>& journal) {
  OpenJobs open;
  for (const nlohmann::json& record : journal) {
    const std::string event = record.value("event", "");
    if (event == "job-submitted") open.job = record.value("job", "");
    if (event == "job-ended") open.job.clear();
    if (event == "chain-submitting") open.chain = record.value("name", "");
    if (event == "chain-ended") open.chain.clear();
  }
  return open;
}

}  // namespace cupola
