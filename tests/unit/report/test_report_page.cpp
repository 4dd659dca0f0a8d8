#include <gtest/gtest.h>

#include <string>

#include "orchestrator/report/report_page.hpp"

namespace cupola {
namespace {

/// The data as a browser would find it in the page.
nlohmann::json data_in(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"report-data\">";
  const std::size_t from = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(ReportPage, CarriesTheDataWhateverItHolds) {
  const nlohmann::json report = {{"campaign", "</script><script>alert(1)</script><!-- µ \" \\ /*DATA*/"},
                                 {"episodes", {1.5, nullptr}}};
  EXPECT_EQ(data_in(report_page(report)), report);
}

TEST(ReportPage, NeedsNothingFromElsewhere) {
  const std::string page = report_page(nlohmann::json::object());
  EXPECT_EQ(page.rfind("<!doctype html>", 0), 0U);
  EXPECT_NE(page.find("Content-Security-Policy\" content=\"default-src 'none'"), std::string::npos);
  for (const char* reference : {"<script src", "<link rel=\"stylesheet\"", "@import", "<img "}) {
    EXPECT_EQ(page.find(reference), std::string::npos) << reference;
  }
  EXPECT_GT(page.size(), 200000U) << "the charting library is in it";
}

}  // namespace
}  // namespace cupola
