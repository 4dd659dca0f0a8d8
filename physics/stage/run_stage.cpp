#include "physics/stage/run_stage.hpp"

#include <mpi.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <thread>

#include "schemas/files.hpp"

namespace cupola {
namespace {

struct Place {
  int rank = 0;
  int ranks = 1;
};

Place place_among_ranks() {
  int running = 0;
  int over = 0;
  MPI_Initialized(&running);
  MPI_Finalized(&over);
  Place place;
  if (running != 0 && over == 0) {
    MPI_Comm_rank(MPI_COMM_WORLD, &place.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &place.ranks);
  }
  return place;
}

int report(const std::filesystem::path& task_folder, const Failure& failure) {
  const Place place = place_among_ranks();
  // Most failures are found by all ranks at once: rank 0 speaks for them, and ends the others before they speak too.
  if (place.rank != 0) std::this_thread::sleep_for(std::chrono::milliseconds(500));
  spdlog::error("{}", failure.what());
  for (const auto& [what, value] : failure.where()) spdlog::error("  at {} {}", what, value);
  for (const auto& [key, value] : failure.advice()) spdlog::error("  advice: {}: {}", key, value);
  if (failure.code() != ExitCode::held && std::filesystem::is_directory(task_folder)) {
    try {
      write_failure(task_folder, failure);
    } catch (const std::exception& problem) {
      spdlog::error("failure.json could not be written: {}", problem.what());
    }
  }
  const int code = static_cast<int>(failure.code());
  if (place.ranks > 1) MPI_Abort(MPI_COMM_WORLD, code);
  return code;
}

}  // namespace

int run_stage(const std::filesystem::path& task_folder, const std::function<ExitCode()>& stage) {
  try {
    return static_cast<int>(stage());
  } catch (const Failure& failure) {
    return report(task_folder, failure);
  } catch (const std::filesystem::filesystem_error& problem) {
    return report(task_folder, Failure(ExitCode::input_output, problem.what()).at("file", problem.path1().string()));
  } catch (const std::exception& problem) {
    return report(task_folder,
                  Failure(ExitCode::diverged, std::string("the stage ended unexpectedly: ") + problem.what()));
  }
}

}  // namespace cupola
