#include "case/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace breccia::case_::units_test {
namespace {

using testing::HasSubstr;

struct Good {
  const char* text;
  const char* unit;
  double si;
};

void PrintTo(const Good& good, std::ostream* out) { *out << good.text; }

class GoodQuantity : public testing::TestWithParam<Good> {};

// Powers of ten act on the digits, so the values are the doubles one would write in SI, bit for bit.
TEST_P(GoodQuantity, IsConvertedExactly) {
  EXPECT_EQ(to_si(GetParam().text, GetParam().unit), GetParam().si) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    Units, GoodQuantity,
    testing::Values(Good{"26.6 GPa", "Pa", 26.6e9}, Good{"26.6GPa", "Pa", 26.6e9}, Good{"3 m/s", "m/s", 3},
                    Good{"10 us", "s", 1e-5}, Good{"10 \u00b5s", "s", 1e-5}, Good{"9.81 m/s^2", "m/s2", 9.81},
                    Good{"-9.81 m/s2", "m/s2", -9.81}, Good{"+1 m", "m", 1}, Good{"1e-3 mm", "m", 1e-6},
                    Good{"1E+3 mm", "m", 1}, Good{".5 m", "m", 0.5}, Good{"5. m", "m", 5},
                    Good{"20 GPa/s", "Pa/s", 20e9}, Good{"1.8 TPa", "Pa", 1.8e12}, Good{"2340 kg/m3", "kg/m3", 2340},
                    Good{"2.34 g/cm3", "kg/m3", 2340}, Good{"2.34 t/m^3", "kg/m3", 2340}, Good{"30 N/m", "J/m2", 30},
                    Good{"30 J/m2", "J/m2", 30}, Good{"0.03 N/mm", "J/m2", 30}, Good{"7 J m^-2", "J/m2", 7},
                    Good{"7 J/(m*m)", "J/m2", 7}, Good{"7 J/m/m", "J/m2", 7}, Good{"7 kg m2/(s2 m2)", "J/m2", 7},
                    Good{"2 Pa s", "Pa s", 2}, Good{"2 Pa*s", "Pa s", 2}, Good{"2 Pa.s", "Pa s", 2},
                    Good{"2 mPa s", "Pa s", 0.002}, Good{"10 kHz", "1/s", 1e4}, Good{"10 1/s", "1/s", 10},
                    Good{"10 /s", "1/s", 10}, Good{"10/s", "1/s", 10}, Good{"5 %", "1", 0.05}, Good{"0.3", "1", 0.3},
                    Good{"0", "Pa", 0}, Good{"2 min", "s", 120}, Good{"3 h", "s", 10800}, Good{"1 bar", "Pa", 1e5},
                    Good{"1 N/mm2", "Pa", 1e6}, Good{"  4   m  ", "m", 4}, Good{"4\u00a0MPa", "Pa", 4e6},
                    Good{"9.81 m/s\u00b2", "m/s2", 9.81}, Good{"2.4 g/cm\u00b3", "kg/m3", 2400},
                    Good{"2\u202fPa\u2009s", "Pa s", 2}, Good{"180 deg", "rad", std::numbers::pi},
                    Good{"2 rad/s", "rad/s", 2}, Good{"1 dm3", "m3", 1e-3}, Good{"1 l", "m3", 1e-3},
                    Good{"3 mrad", "rad", 0.003}));

struct Bad {
  const char* text;
  const char* unit;
  const char* what;
  const char* allowed;
};

void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.text; }

class BadQuantity : public testing::TestWithParam<Bad> {};

TEST_P(BadQuantity, SaysWhatIsWrongAndWhatIsAllowed) {
  try {
    const double si = to_si(GetParam().text, GetParam().unit);
    FAIL() << GetParam().text << " was read as " << si;
  } catch (const UnitError& e) {
    EXPECT_THAT(e.what(), HasSubstr(GetParam().what));
    EXPECT_THAT(e.allowed, HasSubstr(GetParam().allowed));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Units, BadQuantity,
    testing::Values(
        Bad{"3 m", "kg/m3", "is of dimension length, not density", "kg/m3, g/cm3"},
        Bad{"3 Pa", "m/s", "is of dimension pressure, not velocity", "mm/s"},
        Bad{"3\u00b2 m", "m", "unknown unit", "units m g s"}, Bad{"3", "Pa", "the unit is missing", "MPa, GPa"},
        Bad{"3 %", "Pa", "has no dimension", "MPa"}, Bad{"3 m2 kg", "Pa", "dimension m2 kg, not pressure", "GPa"},
        Bad{"3 Hz", "rad/s", "is of dimension frequency, not angular velocity", "deg/s"},
        Bad{"3 parsec", "m", "unknown unit \"parsec\"", "units m g s"},
        Bad{"3 mpa", "Pa", "did you mean \"MPa\" or \"mPa\"?", "prefix"},
        Bad{"3 Gpa", "Pa", "did you mean \"GPa\"?", "prefix"}, Bad{"3 kmin", "s", "unknown unit \"kmin\"", "units"},
        Bad{"GPa", "Pa", "does not begin with a number", "26.6 GPa"}, Bad{"", "Pa", "does not begin", "number"},
        Bad{"nan Pa", "Pa", "does not begin with a number", "number"},
        Bad{"inf Pa", "Pa", "does not begin with a number", "number"},
        Bad{"1e999 Pa", "Pa", "outside the range", "magnitudes"}, Bad{"1e-320 Pa", "Pa", "outside the range", "1e-307"},
        Bad{"1e-305 mPa", "Pa", "outside the range", "1e-307"},
        Bad{"1e99999999999 Pa", "Pa", "does not begin", "number"}, Bad{"3 m/", "m", "cannot read the unit", "kg/m3"},
        Bad{"3 m^", "m", "cannot read the unit at \"\"", "exponents"},
        Bad{"3 m^-", "m", "cannot read the unit at \"-\"", "exponents"},
        Bad{"3 m^99", "m", "cannot read the unit", "exponents"},
        Bad{"3 m^-2147483648", "m", "cannot read the unit", "exponents"}, Bad{"3 (m", "m", "cannot read", "kg/m3"},
        Bad{"3 m)", "m", "cannot read", "kg/m3"}, Bad{"3 m,5", "m", "cannot read the unit at \",5\"", "kg/m3"},
        Bad{"3 mm9 mm9 mm9 mm9 mm9 mm9 mm9 mm9 mm9 mm9 mm9 mm9 mm9 mm9 mm9", "m", "cannot read", "exponents"},
        Bad{"3 ((((((((((m))))))))))", "m", "cannot read", "kg/m3"},
        Bad{"3 (((((((((mm9)9)9)9)9)9)9)9)9)9", "m", "cannot read", "exponents"}));

TEST(Units, DegreesBecomeRadians) { EXPECT_DOUBLE_EQ(to_si("30 deg", "rad"), std::numbers::pi / 6); }

TEST(Units, KilometresAnHourAreDividedNotMultiplied) {
  // 3.6 has no exact double, so one rounding is allowed.
  EXPECT_DOUBLE_EQ(to_si("36 km/h", "m/s"), 10.0);
}

TEST(Units, ADimensionWithoutANameIsSpelledOut) { EXPECT_EQ(name_of(dimension_of("m2 kg/rad")), "m2 kg rad-1"); }

TEST(Units, AUnitCarriesItsDimension) {
  EXPECT_EQ(dimension_of("Pa s"), (Dimension{{-1, 1, -1, 0}}));
  EXPECT_EQ(dimension_of("1"), Dimension{});
  EXPECT_TRUE(parse_quantity("3 m/m").has_unit);
  EXPECT_FALSE(parse_quantity("3").has_unit);
}

}  // namespace
}  // namespace breccia::case_::units_test
