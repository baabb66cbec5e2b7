#include <gmock/gmock.h>

#include <charconv>
#include <sstream>

#include "export/report/report.h"
#include "support/shapes.h"

namespace fusee::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::vector<std::vector<std::string>> cells(const std::string& table) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    auto& row = rows.emplace_back(1);
    for (const char c : line) {
      if (c == ',') {
        row.emplace_back();
      } else {
        row.back() += c;
      }
    }
  }
  return rows;
}

Product round_product() {
  Product product;
  product.joint.mechanism = testing::plain_mechanism();
  product.joint.mechanism.load.tip_force = 10;
  product.synthesis = testing::pulley_of(testing::circle(20), testing::circle(15), 8);
  const transmission::Transmission transmission(product.joint.mechanism);
  product.synthesis.stroke = {transmission.at_theta(radians(-20)), transmission.at_theta(0),
                              transmission.at_theta(radians(20))};
  for (const transmission::TransmissionPoint& point : product.synthesis.stroke) {
    product.as_built.points.push_back({point.alpha, point.theta, point.theta + radians(0.01), 0.002});
  }
  return product;
}

TEST(ProfileCsv, HoldsBothPitchCurves) {
  Product product = round_product();
  product.pulley.layout.z_p1 = 2.5;
  product.pulley.layout.z_p2 = 7.25;
  const auto rows = cells(profile_csv(product));
  ASSERT_EQ(rows.size(), 1U + 2 * 8);
  EXPECT_THAT(rows[0], ElementsAre("pulley", "angle_deg", "x_mm", "y_mm", "radius_of_curvature_mm", "active",
                                   "normal_deg", "turn_deg", "z_mm"));
  EXPECT_THAT(rows[3], ElementsAre("P1", "90.000000", "0.000000", "20.000000", "20.000000", "1", "90.000000",
                                   "90.000000", "2.500000"));
  EXPECT_THAT(rows[1], ElementsAre("P1", "0.000000", "20.000000", "0.000000", "20.000000", "0", "0.000000", "0.000000",
                                   "2.500000"));
  EXPECT_THAT(rows[9], ElementsAre("P2", "0.000000", "15.000000", "0.000000", "15.000000", "1", "0.000000", "0.000000",
                                   "7.250000"));
}

TEST(PitchCurveCsv, HoldsOneClosedCurveInSpace) {
  Product product = round_product();
  product.pulley.layout.z_p2 = 7.25;
  const auto rows = cells(pitch_curve_csv(product, transmission::Side::right));
  ASSERT_EQ(rows.size(), 1U + 8 + 1);
  EXPECT_THAT(rows[0], ElementsAre("x_mm", "y_mm", "z_mm"));
  EXPECT_THAT(rows[1], ElementsAre("15.000000", "0.000000", "7.250000"));
  EXPECT_THAT(rows[3], ElementsAre("0.000000", "15.000000", "7.250000"));
  EXPECT_EQ(rows.back(), rows[1]);
}

TEST(TransmissionCsv, StartsWithAgreedColumns) {
  EXPECT_THAT(transmission_csv(round_product()), StartsWith("alpha_deg,theta_deg,r1_mm,r2_mm,"));
}

TEST(TransmissionCsv, RowsMatchComputation) {
  const Product product = round_product();
  const auto rows = cells(transmission_csv(product));
  ASSERT_EQ(rows.size(), 4U);
  for (std::size_t i = 0; i < 3; ++i) {
    const transmission::TransmissionPoint& point = product.synthesis.stroke[i];
    const std::vector<std::string>& row = rows[i + 1];
    ASSERT_EQ(row.size(), rows[0].size());
    const auto value = [&](const std::string& column) {
      const auto at = std::find(rows[0].begin(), rows[0].end(), column) - rows[0].begin();
      return std::stod(row.at(static_cast<std::size_t>(at)));
    };
    EXPECT_NEAR(value("alpha_deg"), degrees(point.alpha), 1e-6);
    EXPECT_NEAR(value("r1_mm"), 20.0, 1e-6);
    EXPECT_NEAR(value("r2_mm"), point.t2.p, 1e-6);
    // Virtual work: r2/r1 = m2/m1. T2 · m2 is the torque of the tip force.
    EXPECT_NEAR(value("r2_mm") / value("r1_mm"), value("m2_mm") / value("m1_mm"), 1e-6);
    EXPECT_NEAR(value("T2_N") * value("m2_mm"), 10.0 * 100.0, 1e-3);
    EXPECT_NEAR(value("theta_as_built_deg") - value("theta_deg"), 0.01, 2e-6);
    EXPECT_NEAR(value("slack_mm"), 0.002, 1e-9);
  }
}

TEST(TransmissionCsv, InterpolatesRewoundPointsOnly) {
  Product product = round_product();
  auto& points = product.as_built.points;
  points.erase(points.begin() + 1);
  points[0].excess = 0.0;
  points[1].excess = 0.3;
  product.synthesis.stroke[0].alpha -= 1.0;
  const double t = (0.0 - points[0].alpha) / (points[1].alpha - points[0].alpha);
  const auto rows = cells(transmission_csv(product));
  EXPECT_EQ(rows[1].back(), "");
  EXPECT_NEAR(std::stod(rows[2].back()), 0.3 * t, 1e-6);
}

TEST(TransmissionCsv, HasNumbersOnly) {
  Product product = round_product();
  product.synthesis.stroke[1].t2.m = 0;  // a dead centre: the tension has no bound
  const std::string table = transmission_csv(product);
  EXPECT_THAT(table, Not(HasSubstr("inf")));
  EXPECT_THAT(table, Not(HasSubstr("nan")));
  EXPECT_THAT(table, HasSubstr(",,"));
}

}  // namespace
}  // namespace fusee::formats
