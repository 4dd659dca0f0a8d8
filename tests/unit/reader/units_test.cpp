#include "schemas/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cupola {
namespace {

TEST(Units, ConvertToSi) {
  EXPECT_DOUBLE_EQ(to_si("5 h", "s"), 18000);
  EXPECT_DOUBLE_EQ(to_si("20 min", "s"), 1200);
  EXPECT_DOUBLE_EQ(to_si("2 mm/s", "m/s"), 0.002);
  EXPECT_DOUBLE_EQ(to_si("1200 degC", "K"), 1473.15);
  EXPECT_DOUBLE_EQ(to_si("1200 °C", "K"), 1473.15);
  EXPECT_DOUBLE_EQ(to_si("1 bar", "Pa"), 1e5);
  EXPECT_DOUBLE_EQ(to_si("50 MPa", "Pa"), 5e7);
  EXPECT_DOUBLE_EQ(to_si("1.5 t/m3", "kg/m3"), 1500);
  EXPECT_DOUBLE_EQ(to_si("36 t/h", "kg/s"), 10);
  EXPECT_DOUBLE_EQ(to_si("0.85 kJ/kg/K", "J/kg/K"), 850);
  EXPECT_DOUBLE_EQ(to_si("20 W/m2/K", "W/m2/K"), 20);
  EXPECT_DOUBLE_EQ(to_si("20 W m-2 K-1", "W/m2/K"), 20);
  EXPECT_DOUBLE_EQ(to_si("28 g/mol", "kg/mol"), 0.028);
  EXPECT_DOUBLE_EQ(to_si("0.02 mPa s", "Pa s"), 2e-5);
  EXPECT_DOUBLE_EQ(to_si("1 %", "1"), 0.01);
  EXPECT_DOUBLE_EQ(to_si("5 cm2/s", "m2/s"), 5e-4);
}

TEST(Units, TakeNumbersWithoutAUnitAsSi) {
  EXPECT_EQ(to_si("0.5", "m"), 0.5);
  EXPECT_EQ(to_si(" +5e-4 ", "m2/s"), 5e-4);
  EXPECT_EQ(to_si("44mm", "m"), to_si("44 mm", "m"));
}

TEST(Units, CountCriteria) {
  EXPECT_EQ(to_si("1 cell", "cell"), 1);
  EXPECT_EQ(to_si("2.5 cells", "cell"), 2.5);
  EXPECT_EQ(to_si("2 sigma", "sigma"), 2);
  EXPECT_EQ(to_si("8 episodes", "episode"), 8);
  EXPECT_THROW(to_si("2 cells", "episode"), UnitError);
  EXPECT_THROW(to_si("2 cells", "m"), UnitError);
  EXPECT_THROW(to_si("2 m", "cell"), UnitError);
}

TEST(Units, NameBothDimensions) {
  try {
    to_si("5 m", "s");
    FAIL() << "a length passed for a time";
  } catch (const UnitError& error) {
    EXPECT_STREQ(error.what(), "expected a time (like 5 s), but `5 m` is a length");
  }
}

TEST(Units, RefuseWhatIsNoFiniteQuantity) {
  for (const auto* text : {"", " ", "m", "nan", "inf", "-inf s", "1e999", "1e308 Gs", "5 5 s s", "0x10 s", "1,5 s",
                           "5 s since 2000-01-01", "5 Hz", "5 lg(re 1 s)", "5 @", "--5 s", "5 s)"}) {
    EXPECT_THROW(to_si(text, "s"), UnitError) << text;
  }
}

}  // namespace
}  // namespace cupola
