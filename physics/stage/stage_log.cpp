#include "physics/stage/stage_log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>

#include "schemas/failure.hpp"

namespace cupola {

void open_stage_log(const std::filesystem::path& task_folder, int rank) {
  // The orchestrator sends standard error to stage.log as well: what rank 0 says must not stand there twice.
  const bool error_goes_to_log = std::getenv(stderr_goes_to_log) != nullptr;
  std::vector<spdlog::sink_ptr> sinks;
  if (rank != 0 || !error_goes_to_log) {
    sinks.push_back(std::make_shared<spdlog::sinks::stderr_sink_mt>());
    sinks.back()->set_level(rank == 0 ? spdlog::level::warn : spdlog::level::err);
  }
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
