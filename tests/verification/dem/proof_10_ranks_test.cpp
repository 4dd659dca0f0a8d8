// One and two ranks give the same averaged fields within their standard errors, and so does a run that was stopped and
// restored half-way: the program cupola-dem on the tiny slot.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include "schemas/campaign_reader.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "schemas/task.hpp"
#include "schemas/version.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {
namespace {

/// Prepares and runs the stage; where asked, stops it once in its window and lets it go on.
FieldFile run(const std::filesystem::path& folder, int ranks, bool stopped_half_way) {
  Task task;
  task.kind = TaskKind::dem;
  task.campaign = load_campaign(CUPOLA_TINY);
  task.campaign.launch.ranks = ranks;
  task.campaign.dem.relaxation = 1;
  task.campaign.dem.window = 3;
  task.campaign.dem.at_most = 4;
  task.campaign.charging.stock_line = 1.6;
  task.campaign_hash = hash_text("tiny");
  task.program_version = program_version;
  task.random_seed = 11;
  std::filesystem::create_directories(folder);
  write_task(folder, task);
  EXPECT_EQ(wait_for(start({CUPOLA_DEM, "prepare", folder.string()})), 0);
  const std::vector<std::string> command{CUPOLA_MPIEXEC, "--oversubscribe",     "--bind-to", "none",
                                         "-n",           std::to_string(ranks), CUPOLA_DEM,  folder.string()};
  if (stopped_half_way) {
    const pid_t child = start(command);
    int status = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
      const auto progress = read_progress(folder);
      if (progress && progress->phase == "averaging") {
        kill(child, SIGUSR1);
        waitpid(child, &status, 0);
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  EXPECT_EQ(wait_for(start(command)), 0) << read_text(folder / "stage.log");
  return FieldFile(folder / "result.hdf", "dem-result");
}

/// Differences of two fields over the standard error of the difference, in cells that hold solids in both.
std::vector<double> deviations(const FieldFile& one, const FieldFile& other) {
  const auto fraction = one.cell_data("solids_fraction");
  const auto fraction_there = other.cell_data("solids_fraction");
  const auto velocity = one.cell_data("solids_velocity", 3), error = one.cell_data("solids_velocity_error", 3);
  const auto velocity_there = other.cell_data("solids_velocity", 3);
  const auto error_there = other.cell_data("solids_velocity_error", 3);
  std::vector<double> result;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const double variance = error[i] * error[i] + error_there[i] * error_there[i];
    if (fraction[i / 3] > 0.3 && fraction_there[i / 3] > 0.3 && variance > 0)
      result.push_back((velocity[i] - velocity_there[i]) / std::sqrt(variance));
  }
  return result;
}

TEST(RanksAndRestarts, GiveTheSameFieldsWithinTheirStandardErrors) {
  const TemporaryFolder temporary;
  const FieldFile one = run(temporary.path() / "one", 1, false);
  const FieldFile two = run(temporary.path() / "two", 2, false);
  const FieldFile restored = run(temporary.path() / "restored", 1, true);
  const auto between_ranks = deviations(one, two);
  ASSERT_GT(between_ranks.size(), 300U);
  double squares = 0, within_two = 0;
  for (const double deviation : between_ranks) {
    squares += deviation * deviation / static_cast<double>(between_ranks.size());
    within_two += std::abs(deviation) < 2 ? 1.0 / static_cast<double>(between_ranks.size()) : 0;
  }
  std::printf("rms deviation %.2f standard errors, %.0f %% within two, %zu values\n", std::sqrt(squares),
              100 * within_two, between_ranks.size());
  // Two runs of a chaotic bed are independent: their differences scatter by one standard error, a little more where it
  // comes from ten batches; a field that depends on the ranks would differ by many.
  EXPECT_LT(std::sqrt(squares), 2);
  EXPECT_GT(within_two, 0.8);
  // On the same number of ranks a restored run is the same to the last bit.
  for (const char* name : {"solids_velocity", "solids_velocity_error"})
    EXPECT_EQ(one.cell_data(name, 3), restored.cell_data(name, 3)) << name;
}

}  // namespace
}  // namespace cupola
