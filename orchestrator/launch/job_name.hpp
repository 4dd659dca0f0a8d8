#pragma once
#include <string>

#include "orchestrator/run_folder.hpp"

namespace cupola {

/// A job's name, `cupola-<ten letters of its own>-<what>`: one can see in the queue what it is, and no other job has
/// it.
std::string job_name(const RunFolder& run, const std::string& what);

}  // namespace cupola
