#include "paper/reproduction.h"

#include <gmock/gmock.h>

#include "export/report/paper.h"
#include "fusee/optimize.h"
#include "paper/windows.h"

namespace fusee::paper {
namespace {

using ::testing::HasSubstr;

TEST(Windows, BordersAreAccurate) {
  const auto windows = windows_where([](double x) { return x > 0.131 && x < 0.2537; }, 0.0, 1.0, 40);
  ASSERT_EQ(windows.size(), 1u);
  EXPECT_NEAR(windows[0].low, 0.131, 1e-5);
  EXPECT_NEAR(windows[0].high, 0.2537, 1e-5);
  EXPECT_FALSE(windows[0].open_low || windows[0].open_high);
}

TEST(Windows, SupportSeveralAndOpenWindows) {
  const auto windows = windows_where([](double x) { return x < 0.2 || x > 0.7; }, 0.0, 1.0, 10);
  ASSERT_EQ(windows.size(), 2u);
  EXPECT_TRUE(windows[0].open_low);
  EXPECT_TRUE(windows[1].open_high);
  EXPECT_EQ(windows_text({"mu", "", 0, 1, windows}), "up to 0.2 and from 0.7");
  EXPECT_EQ(windows_text({"r1", "mm", 2, 42, {}}), "none from 2 to 42 mm");
}

TEST(Windows, ClaimSaysThatNoValueMakesItHold) {
  Claim claim;
  claim.windows = {{"mu", "", 0.01, 0.51, {}}, {"EF", "mm", 20, 220, {{74.8, 220, false, true}}}};
  EXPECT_EQ(formats::claim_windows_text(claim), "no mu from 0.01 to 0.51 makes it hold; EF from 74.8 mm");
}

class Paper : public ::testing::Test {
 protected:
  static const Reproduction& all() {
    static const Reproduction reproduction = reproduce_paper();
    return reproduction;
  }
  static const Claim& claim(const std::string& name) {
    for (const Claim& one : all().claims) {
      if (one.name == name) return one;
    }
    throw std::runtime_error("no claim " + name);
  }
};

TEST_F(Paper, Table4IsTheCertifiedOptimum) {
  EXPECT_NEAR(all().optimum, 2.3673442954, 1e-9);
  EXPECT_LE(all().relative_gap, 1e-6);
  for (const OptimumRow& row : all().table_4) EXPECT_NEAR(row.computed, row.paper, 1e-6) << row.symbol;
}

TEST_F(Paper, VerdictsFollowEquations) {
  EXPECT_EQ(claim("optimum_of_table_4").verdict, Verdict::holds_only_if);
  EXPECT_EQ(claim("all_three_at_their_bounds").verdict, Verdict::holds_only_if);
  EXPECT_EQ(claim("largest_tension_at_negative_limit").verdict, Verdict::holds_only_if);
  EXPECT_EQ(claim("largest_elongation_at_negative_limit").verdict, Verdict::holds);
  EXPECT_EQ(claim("largest_error_at_negative_limit").verdict, Verdict::holds);
  EXPECT_EQ(claim("the_pulley_linearizes").verdict, Verdict::does_not_hold);
  EXPECT_EQ(claim("profile_by_drawing_r2_against_alpha").verdict, Verdict::does_not_hold);
  EXPECT_THAT(claim("the_pulley_linearizes").equations_give, HasSubstr("±0.52°"));
}

/// The border of the window is correct: inside, the optimum is Table 4; outside, it is another design.
TEST_F(Paper, WindowOfMuIsCorrect) {
  const ParameterWindows& mu = claim("optimum_of_table_4").windows.front();
  ASSERT_EQ(mu.windows.size(), 1u);
  const Window window = mu.windows.front();
  for (const auto& [value, inside] : {std::pair{window.low - 0.002, false},
                                      {window.low + 0.002, true},
                                      {window.high - 0.002, true},
                                      {window.high + 0.002, false}}) {
    PaperAssumptions assumptions;
    assumptions.mu = value;
    const optimize::CertifiedResult best = optimize::certified_optimum(
        optimize::make_problem(paper_problem_file(assumptions)), optimize::Objective::max_tension);
    const bool table_4 =
        std::abs(best.best[0] - 100) < 1e-3 && std::abs(best.best[1] - 50) < 1e-3 && std::abs(best.best[2] + 40) < 1e-3;
    EXPECT_EQ(table_4, inside) << value;
  }
}

TEST_F(Paper, FiguresAreCompleteAndFinite) {
  std::vector<int> numbers;
  for (const PaperFigure& figure : all().figures) {
    numbers.push_back(figure.number);
    ASSERT_FALSE(figure.curves.empty());
    for (const Curve& curve : figure.curves) {
      EXPECT_GT(curve.points.size(), 50u);
      for (const Vec2& point : curve.points) EXPECT_TRUE(point.allFinite());
    }
  }
  EXPECT_EQ(numbers, (std::vector<int>{4, 5, 7, 8, 9, 10, 11, 13}));
}

TEST_F(Paper, OnlyLinearLawIsStraight) {
  ASSERT_EQ(all().laws.size(), 2u);
  EXPECT_GT(all().laws[0].nonlinearity, 0.5);
  EXPECT_LT(all().laws[1].nonlinearity, 1e-9);
  EXPECT_DOUBLE_EQ(all().laws[0].r1_least, all().laws[0].r1_most);
  EXPECT_LT(all().laws[1].r1_least, all().laws[1].r1_most);
}

}  // namespace
}  // namespace fusee::paper
