#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "orchestrator/commands.hpp"
#include "orchestrator/run_check.hpp"

namespace cupola {

ExitCode verify(const std::filesystem::path& folder, bool as_json) {
  const RunCheck check = check_run(folder);
  if (as_json) {
    const nlohmann::json answer = {{"folder", folder.string()},
                                   {"files", check.files},
                                   {"whole", check.whole},
                                   {"problems", check.problems},
                                   {"remarks", check.remarks}};
    fmt::print("{}\n", answer.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    for (const std::string& stage : check.whole) fmt::print("whole    {}\n", stage);
    for (const std::string& remark : check.remarks) fmt::print("note     {}\n", remark);
    for (const std::string& problem : check.problems) fmt::print("DAMAGED  {}\n", problem);
    fmt::print("{} files compared with their hashes, {} damaged, changed or missing\n", check.files,
               check.problems.size());
  }
  return check.problems.empty() ? ExitCode::done : ExitCode::input_output;
}

}  // namespace cupola
