#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "schemas/campaign_reader.hpp"
#include "schemas/files.hpp"
#include "schemas/resolved_campaign.hpp"

namespace cupola {
namespace {

/// Spoils a text in one of the ways a hand or a broken disk would.
void mutate(std::string& text, std::mt19937& random) {
  static const std::vector<std::string> pieces{
      ":",    "-",     "{",      "}",    "[",     "]",     "\n",     "\t",
      "&a ",  "*a",    "!!int ", "~",    "null",  "1e999", ".nan",   "-1",
      "0",    "5 m",   "\"",     "'",    "#",     "|\n",   ">",      "%",
      "? ",   "---\n", "...",    "\xff", "\xc3(", " kg",   "1e-320", "999999999999999999999",
      "<<: ", "@",     "`"};
  if (text.empty()) return;
  const auto at = [&](std::size_t size) { return std::uniform_int_distribution<std::size_t>(0, size - 1)(random); };
  const auto place = at(text.size());
  switch (at(5)) {
    case 0:
      text.erase(place, 1 + at(20));
      break;
    case 1:
      text.insert(place, pieces[at(pieces.size())]);
      break;
    case 2:
      text[place] = static_cast<char>(at(256));
      break;
    case 3:
      text.insert(place, text.substr(at(text.size()), 1 + at(60)));
      break;
    default:
      text.resize(place);
      break;
  }
}

/// Whatever stands in a file: the reader ends, names a place inside the file, and what it accepts it can write and read
/// again.
TEST(CampaignRobustness, SurvivesSpoiltFiles) {
  std::vector<std::string> texts;
  for (const auto* name : {"tiny", "slot_quick", "slot_paper"}) {
    texts.push_back(read_text(std::filesystem::path(CUPOLA_SOURCE) / "cases" / name / "campaign.yaml"));
  }
  std::mt19937 random(20240229);
  int accepted = 0;
  for (int round = 0; round < 3000; ++round) {
    auto text = texts[static_cast<std::size_t>(round) % texts.size()];
    for (auto left = 1 + random() % 4; left > 0; --left) mutate(text, random);
    const auto result = read_campaign_text(text, "file");
    for (const auto& error : result.errors) {
      ASSERT_GE(error.line, 1) << text;
      ASSERT_GE(error.column, 1) << text;
      ASSERT_FALSE(error.message.empty()) << text;
      ASSERT_EQ(error.message.find("breaks the schema"), std::string::npos) << to_text(result.errors) << text;
    }
    if (!result.ok()) continue;
    ++accepted;
    const auto again = read_campaign_text(resolved_yaml(result.campaign), "resolved");
    ASSERT_TRUE(again.ok()) << to_text(again.errors) << text;
    ASSERT_EQ(resolved_yaml(again.campaign), resolved_yaml(result.campaign)) << text;
  }
  EXPECT_GT(accepted, 50);  // not every change is a mistake: comments, digits
}

}  // namespace
}  // namespace cupola
