#include <gmock/gmock.h>

#include "orchestrator/report/answers.hpp"

namespace cupola {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json report_of(const std::string& state) {
  const json episode = {
      {"index", 3},
      {"dem", {{"process_seconds", 4.}, {"wall_seconds", 40.}, {"ranks", 2}, {"packing_fraction", 0.561}}},
      {"tracer", {{"process_seconds", 7200.}, {"wall_seconds", 20.}}},
      {"mean_solid_temperature", 1000.},
      {"cohesive_zone", {{"height_mean", 2.9}, {"height_min", 2.4}, {"height_max", 3.5}, {"columns_without", 2}}},
      {"change", {{"temperature", 0.4}, {"cohesive_zone", 0.2}, {"granular_velocity", 0.7}}},
      {"figures", {{"temperature", 0.004}, {"cohesive_zone", 0.2}, {"granular_velocity", 1.4}}}};
  return {{"state", state},
          {"description", "DEM stage of episode 3: parcel 7 left"},
          {"has_heat", true},
          {"wall_seconds", 492.},
          {"criteria",
           {{"temperature", 0.01}, {"cohesive_zone", 1.}, {"granular_velocity", 2.}, {"for", 2}, {"at_most", 8}}},
          {"furnace", {{"melting_temperature", 1675.}}},
          {"ledger", {{"mass_residual", 1e-14}, {"energy_residual", 1e-3}}},
          {"episodes", {episode, episode, episode}}};
}

const std::string converged = "converged", bed = "state_of_the_bed", certainty = "certainty", cost = "wall_time";

std::string answer(const json& report, const std::string& which) { return answers(report).at(which).at("answer"); }

TEST(Answers, OfAConvergedRun) {
  const json report = report_of("converged");
  EXPECT_EQ(answer(report, converged), "Yes, after 3 episodes");
  EXPECT_EQ(answer(report, bed), "2.90 m on average, 2.40 to 3.50 m");
  EXPECT_EQ(answer(report, certainty), "Remaining changes at most 70 % of what is allowed");
  EXPECT_EQ(answer(report, cost), "8 min 12 s on 2 ranks");
  EXPECT_THAT(answers(report)[bed].at("detail"), HasSubstr("2 columns hold no zone"));
  EXPECT_THAT(answers(report)[certainty].at("detail"),
              HasSubstr("Mass closes to round-off of the charge, heat to 0.1 % of the blast's"));
  EXPECT_THAT(answers(report)[cost].at("detail"), HasSubstr("6 h of process time in 1 min."));
}

TEST(Answers, OfARunThatHasNotConverged) {
  json report = report_of("not converged at its limit");
  report["episodes"][2]["change"]["temperature"] = 3.1;
  EXPECT_EQ(answer(report, converged), "No, not within 3 episodes");
  EXPECT_EQ(answers(report)[converged].at("detail"), "Not met: temperature. It can be resumed with a higher limit.");
  EXPECT_EQ(answer(report, certainty), "Remaining changes up to 3.1 times what is allowed");
  EXPECT_EQ(answer(report_of("steady, ore not melted"), converged), "Steady, but ore leaves unmelted");
  EXPECT_THAT(answers(report_of("failed"))[converged].at("detail"), HasSubstr("parcel 7 left"));
}

TEST(Answers, OfOneEpisodeSaysThatNothingCouldBeJudged) {
  json report = report_of("not converged at its limit");
  json first = report["episodes"][0];
  first["change"] = {{"temperature", nullptr}, {"cohesive_zone", nullptr}, {"granular_velocity", nullptr}};
  report["episodes"] = json::array({first});
  EXPECT_EQ(answer(report, converged), "No, not within 1 episode");
  EXPECT_THAT(answers(report)[converged].at("detail"), HasSubstr("Nothing could be judged yet"));
}

TEST(Answers, SayWhetherAChangeWasExtrapolated) {
  json report = report_of("running");
  EXPECT_THAT(answers(report)[certainty].at("detail"), HasSubstr("Temperature changed in the last episode by 0.4 %"));
  report["episodes"][2]["lambda"] = {{"temperature", 0.5}};
  EXPECT_THAT(answers(report)[certainty].at("detail"), HasSubstr("Temperature still to change by 0.4 %"));
}

TEST(Answers, OfARunThatHasJustBegun) {
  json report = report_of("running");
  report["episodes"] = json::array();
  report["ledger"] = {{"mass_residual", nullptr}, {"energy_residual", nullptr}};
  report["wall_seconds"] = 0.;
  EXPECT_EQ(answer(report, converged), "Not yet");
  EXPECT_EQ(answer(report, bed), "Not known yet");
  EXPECT_EQ(answer(report, certainty), "Nothing to judge yet");
  EXPECT_EQ(answer(report, cost), "0 s");
}

TEST(Answers, OfAColdSceneSpeakOfTheBed) {
  json report = report_of("converged");
  report["has_heat"] = false;
  EXPECT_EQ(answer(report, bed), "Packed to 56.1 % by volume");
}

TEST(Duration, InWords) {
  EXPECT_EQ(duration_in_words(0.25), "0.25 s");
  EXPECT_EQ(duration_in_words(59.4), "59.4 s");
  EXPECT_EQ(duration_in_words(492), "8 min 12 s");
  EXPECT_EQ(duration_in_words(3600 * 18.333), "18 h 20 min");
  EXPECT_EQ(duration_in_words(86400 * 8.2), "8.2 days");
}

}  // namespace
}  // namespace cupola
