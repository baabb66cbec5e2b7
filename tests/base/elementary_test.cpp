// Elementary functions, compared with the C library's in 64-bit precision, in all rounding modes.
#include <gmock/gmock.h>

#include <array>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>

#include "fusee/base_elementary.h"

namespace fusee {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

struct Function {
  const char* name;
  double (*value)(double);
  long double (*reference)(long double);
  double least, most;
};

const std::array<Function, 14> k_functions{{
    {"sin", elementary::sin, sinl, -8, 8},
    {"sin far away", elementary::sin, sinl, -1e6, 1e6},
    {"cos", elementary::cos, cosl, -8, 8},
    {"tan", elementary::tan, tanl, -8, 8},
    {"asin", elementary::asin, asinl, -1, 1},
    {"acos", elementary::acos, acosl, -1, 1},
    {"atan", elementary::atan, atanl, -20, 20},
    {"exp", elementary::exp, expl, -40, 40},
    {"log", elementary::log, logl, 0, 100},
    {"log near 1", elementary::log, logl, 0.9, 1.1},
    {"log1p", elementary::log1p, log1pl, -0.9, 5},
    {"log10", elementary::log10, log10l, 0, 1e6},
    {"power", [](double x) { return elementary::pow(x, 0.7); }, [](long double x) { return powl(x, 0.7); }, 0, 50},
    {"atan2", [](double x) { return elementary::atan2(x, -1.5); }, [](long double x) { return atan2l(x, -1.5L); }, -4,
     4},
}};

/// Distance in units in the last place of `value`.
double units_apart(double value, long double exact) {
  const double unit = std::nextafter(std::abs(value), k_infinity) - std::abs(value);
  return static_cast<double>(std::abs(value - exact) / unit);
}

/// Pseudo-random numbers of [0, 1): those of Weyl's sequence.
double fraction(int i) { return std::fmod(0.5 + 0.6180339887498949 * i, 1.0); }

double worst_error(const Function& function, int mode) {
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = function.least + (function.most - function.least) * fraction(i);
    const long double exact = function.reference(x);
    std::fesetround(mode);
    const double value = function.value(x);
    std::fesetround(FE_TONEAREST);
    worst = std::max(worst, units_apart(value, exact));
  }
  return worst;
}

TEST(Elementary, ErrorIsBelowFiveQuartersOfUnit) {
  for (const Function& function : k_functions) EXPECT_LT(worst_error(function, FE_TONEAREST), 1.25) << function.name;
}

// transmission/interval.h relies on this bound.
TEST(Elementary, ErrorIsBelowTwoUnitsInDirectedRounding) {
  for (const Function& function : k_functions) {
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
      EXPECT_LT(worst_error(function, mode), 2.0) << function.name;
  }
}

TEST(Elementary, HypotenuseIsExactWithinOneUnit) {
  for (int i = 0; i < 20000; ++i) {
    const double x = 50 * fraction(i), y = 20 * fraction(7 * i + 3) - 10;
    EXPECT_LT(units_apart(elementary::hypot(x, y), hypotl(x, y)), 1.0);
  }
  EXPECT_EQ(elementary::hypot(std::ldexp(3, 600), std::ldexp(4, 600)), std::ldexp(5, 600));
  EXPECT_EQ(elementary::hypot(k_infinity, std::nan("")), k_infinity);
}

TEST(Elementary, PowersOfTenAreExact) {
  double power = 1;
  for (int n = 0; n <= 22; ++n, power *= 10) {
    EXPECT_EQ(elementary::pow(10.0, n), power);
    EXPECT_EQ(elementary::log10(power), n);
  }
}

TEST(Elementary, SpecialValuesAreThoseOfTheStandard) {
  EXPECT_EQ(elementary::sin(-0.0), 0.0);
  EXPECT_TRUE(std::signbit(elementary::sin(-0.0)));
  EXPECT_EQ(elementary::atan2(0.0, -1.0), std::acos(-1.0));
  EXPECT_EQ(elementary::atan2(-0.0, -1.0), -std::acos(-1.0));
  EXPECT_EQ(elementary::exp(-k_infinity), 0.0);
  EXPECT_EQ(elementary::exp(1000), k_infinity);
  EXPECT_EQ(elementary::log(0), -k_infinity);
  EXPECT_EQ(elementary::pow(-8, 2), 64.0);
  for (const double none : {elementary::sin(k_infinity), elementary::asin(1.5), elementary::acos(-1.5),
                            elementary::log(-1), elementary::log1p(-2), elementary::pow(-1, 0.5)})
    EXPECT_TRUE(std::isnan(none));
}

/// FNV-1a hash of the bits of 20000 values.
std::uint64_t hash(const Function& function) {
  std::uint64_t sum = 14695981039346656037u;
  for (int i = 0; i < 20000; ++i) {
    const double x = function.least + (function.most - function.least) * fraction(i);
    sum = (sum ^ std::bit_cast<std::uint64_t>(function.value(x))) * 1099511628211u;
  }
  return sum;
}

TEST(Elementary, BitsAreThoseOfEveryMachine) {
  // Recorded once. Every compiler and machine must give these bits.
  constexpr std::array<std::uint64_t, k_functions.size()> k_hashes{
      0x9127086a98c9991cu, 0xb55667e3032a159fu, 0x1f30623cfaeae055u, 0xcc01bfeecc13d30fu, 0xca952184cc261cf0u,
      0x1faf0a122c192ceau, 0x6e7f0344a1f689ebu, 0xbdd1ec8c960a48du,  0x343da766776b670cu, 0x78f7d09325c48ab9u,
      0x2bbc22f56b7cf797u, 0x68fe06be63248229u, 0x99e006a5281218c0u, 0x2a2d1b085e4a017au};
  for (std::size_t i = 0; i < k_functions.size(); ++i)
    EXPECT_EQ(hash(k_functions[i]), k_hashes[i]) << k_functions[i].name;
}

}  // namespace
}  // namespace fusee
