#include "base/golden_section.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fusee {
namespace {

TEST(GoldenSection, FindsMinimum) {
  for (const double least : {-0.9, 0.0, 0.31, 1.9}) {
    const auto kinked = [least](double x) { return std::abs(x - least); };
    const Bracket narrowed = golden_section({-1.0, 2.0}, 40, kinked);
    EXPECT_NEAR(narrowed.middle(), least, 1e-7);
    EXPECT_NEAR(narrowed.high - narrowed.low, 3.0 * std::pow(0.61803398874989485, 40), 1e-12);
  }
}

TEST(GoldenSection, FindsMinimumAtEnd) {
  EXPECT_NEAR(golden_section({0.0, 1.0}, 40, [](double x) { return -x; }).middle(), 1.0, 1e-7);
  EXPECT_NEAR(golden_section({0.0, 1.0}, 40, [](double x) { return x; }).middle(), 0.0, 1e-7);
}

TEST(GoldenSection, EvaluatesOncePerStep) {
  int evaluations = 0;
  golden_section({0.0, 1.0}, 20, [&evaluations](double x) {
    ++evaluations;
    return x * x;
  });
  EXPECT_EQ(evaluations, 2 + 20);  // the search begins with two points
}

}  // namespace
}  // namespace fusee
