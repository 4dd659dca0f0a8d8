#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cupola {

/// What a run has left to Slurm, as far as its journal has not seen it end; empty where there is nothing.
struct OpenJobs {
  std::string job;    ///< number of the present stage's job
  std::string chain;  ///< name of the jobs of a chain

  [[nodiscard]] bool any() const { return !job.empty() || !chain.empty(); }
};

OpenJobs open_jobs(const std::vector<nlohmann::json>& journal);

}  // namespace cupola
