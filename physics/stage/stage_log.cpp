#include "physics/stage/stage_log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "schemas/failure.hpp"

namespace cupola {

void open_stage_log(const std::filesystem::path& task_folder, int rank) {
  auto console = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  console->set_level(rank == 0 ? spdlog::level::warn : spdlog::level::err);
  std::vector<spdlog::sink_ptr> sinks{console};
  if (rank == 0) {
    try {
      sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_mt>((task_folder / "stage.log").string()));
    } catch (const spdlog::spdlog_ex& problem) {
      throw Failure(ExitCode::input_output, std::string("the stage's log cannot be opened: ") + problem.what())
          .at("file", (task_folder / "stage.log").string());
    }
  }
  auto logger = std::make_shared<spdlog::logger>("stage", sinks.begin(), sinks.end());
  logger->set_pattern("%Y-%m-%d %H:%M:%S %l: %v");
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

}  // namespace cupola
