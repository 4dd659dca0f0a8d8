#include <fmt/format.h>

#include "orchestrator/commands.hpp"
#include "orchestrator/embedded_files.hpp"
#include "schemas/files.hpp"

namespace cupola {

ExitCode init(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "campaign.yaml";
  if (std::filesystem::exists(file))
    throw Failure(ExitCode::wrong_input,
                  fmt::format("{}: is there already; nothing was changed. Choose another folder.", file.string()));
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: cannot be made: {}. Choose another folder.", folder.string(), error.message()));
  write_text_atomically(file, starter_campaign());
  fmt::print(
      "{0}: a small furnace slot to begin with; change it to yours.\n"
      "  cupola validate {0}\n  cupola explain {0}\n  cupola run {0} --run-dir {1}\n",
      file.string(), (folder / "run").string());
  return ExitCode::done;
}

}  // namespace cupola
