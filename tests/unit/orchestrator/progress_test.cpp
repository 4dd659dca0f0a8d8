#include <gtest/gtest.h>

#include <limits>

#include "orchestrator/progress_view.hpp"
#include "orchestrator/quantity_text.hpp"
#include "schemas/files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using cupola::duration_text;
using cupola::progress_line;

TEST(Duration, IsSaidAsAPersonSaysIt) {
  EXPECT_EQ(duration_text(0.25), "0.25 s");
  EXPECT_EQ(duration_text(42), "42 s");
  EXPECT_EQ(duration_text(450), "7.5 min");
  EXPECT_EQ(duration_text(18000), "5 h");
  EXPECT_EQ(duration_text(2.5 * 86400), "2.5 d");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "?");
}

TEST(ProgressLine, SaysWhereTheCampaignIs) {
  cupola::Progress progress;
  progress.phase = "marching";
  progress.process_seconds = 9000;
  progress.process_seconds_total = 18000;
  progress.rate = 300;
  progress.monitored = {{"mean_solid_temperature", 812.4}};
  EXPECT_EQ(progress_line({2, 8, cupola::TaskKind::tracer, 1}, progress),
            "episode 2 of at most 8 · tracer · marching · 2.5 h of 5 h · 300 s/s · ends in 30 s · mean solids 812 K");
  EXPECT_EQ(progress_line({1, 8, cupola::TaskKind::dem, 2}, std::nullopt),
            "episode 1 of at most 8 · dem (attempt 2) · starting");
}

TEST(ProgressView, WritesPlainLinesWhereThereIsNoTerminal) {
  const cupola::TemporaryFolder folder;
  std::FILE* out = std::fopen((folder.path() / "out").c_str(), "w");
  {
    cupola::ProgressView view(out);
    view.show("one");
    view.show("two");  // too soon
    view.say("three");
  }
  std::fclose(out);
  EXPECT_EQ(cupola::read_text(folder.path() / "out"), "one\nthree\n");
}

}  // namespace
