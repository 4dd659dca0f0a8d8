#include <gtest/gtest.h>

#include <limits>

#include "orchestrator/report/json_numbers.hpp"

namespace cupola {
namespace {

TEST(JsonNumbers, AreRoundedAndNeverNaN) {
  EXPECT_EQ(rounded(1675.123456).dump(), "1675.12");
  EXPECT_EQ(rounded(std::numeric_limits<double>::quiet_NaN()).dump(), "null");
  EXPECT_EQ(rounded(std::vector<double>{1.0 / 3, 2e-9}, 3).dump(), "[0.333,2e-09]");
}

TEST(JsonNumbers, AreFoundOnlyWhereThereAreSome) {
  const nlohmann::json value = {{"a", {{"b", 2}, {"c", "text"}, {"d", nullptr}}}};
  EXPECT_EQ(number_at(value, "/a/b"), 2);
  for (const char* pointer : {"/a/c", "/a/d", "/a/e", "/x/y", "/a"}) {
    EXPECT_FALSE(number_at(value, pointer)) << pointer;
  }
  EXPECT_FALSE(number_at(nullptr, "/a"));
  EXPECT_TRUE(number_or_null(value, "/a/c").is_null());
}

}  // namespace
}  // namespace cupola
