#include "mechanism/law_table.h"

#include <gmock/gmock.h>

namespace fusee {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const Joint k_joint{100, radians(-30), radians(30)};

/// "line message | hint" of all errors.
std::string errors_of(const std::string& csv) {
  std::vector<Diagnostic> problems;
  parse_law_table(csv, "law.csv", k_joint, problems);
  std::string text;
  for (const Diagnostic& problem : problems)
    text += std::to_string(problem.place.line) + " " + problem.message + " | " + problem.hint + "\n";
  return text;
}

TEST(LawTable, ReadsSpreadsheetFormats) {
  std::vector<Diagnostic> problems;
  const std::string csv =
      "\xEF\xBB\xBF# a law\r\nalpha_deg, theta_deg\r\n\r\n-90, -30\r\n-45,\t-15 # low\r\n0,0\r\n45,15\r\n90,30";
  const std::vector<LawRow> rows = parse_law_table(csv, "law.csv", k_joint, problems);
  EXPECT_THAT(problems, IsEmpty());
  ASSERT_THAT(rows, SizeIs(5));
  EXPECT_EQ(rows[0].alpha, radians(-90));
  EXPECT_EQ(rows[1].theta, radians(-15));
}

TEST(LawTable, ReadsDecimalCommas) {
  std::vector<Diagnostic> problems;
  const std::string header = "alpha_deg;theta_deg\n";
  const std::vector<LawRow> rows =
      parse_law_table(header + "-90,5;-30\n-45;-15,25\n0;0,0\n45.5;15\n90;30\n", "law.csv", k_joint, problems);
  EXPECT_THAT(problems, IsEmpty());
  ASSERT_THAT(rows, SizeIs(5));
  EXPECT_EQ(rows[0].alpha, radians(-90.5));
  EXPECT_EQ(rows[1].theta, radians(-15.25));
  EXPECT_EQ(rows[3].alpha, radians(45.5));
  EXPECT_THAT(errors_of(header + "-1.000,5;-30\n"), HasSubstr("2 \"-1.000,5;-30\" is not two finite numbers"));
  EXPECT_THAT(errors_of(header + "-90;-30;1\n"), HasSubstr("2 \"-90;-30;1\" is not two finite numbers"));

  parse_law_table("alpha_deg\ttheta_deg\n-90,5\t-30\n-45\t-15\n0\t0\n90\t30\n", "law.csv", k_joint, problems);
  EXPECT_THAT(problems, IsEmpty());
}

TEST(LawTable, ReportsLineOfEachError) {
  EXPECT_THAT(errors_of(""), HasSubstr("0 the table is empty"));
  EXPECT_THAT(errors_of("theta_deg,alpha_deg\n1,2\n"), HasSubstr("1 the columns are \"theta_deg,alpha_deg\""));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90,-30\n0,0\n90,30\n"),
              HasSubstr("0 the table has 3 rows; a law needs at least 4"));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90,-30\n0,zero\n45,15\n90,30\n"),
              HasSubstr("3 \"0,zero\" is not two finite numbers"));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90,-30\n0,nan\n45,15\n90,30\n"),
              HasSubstr("3 \"0,nan\" is not two finite numbers"));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90\n"), HasSubstr("2 \"-90\" is not two finite numbers"));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90,-30,5\n"), HasSubstr("2 \"-90,-30,5\" is not two"));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90,-30\n-95,-20\n0,0\n90,30\n"),
              HasSubstr("3 alpha_deg does not increase: -95 deg after -90 deg"));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90,-30\n-45,-30\n0,0\n90,30\n"),
              HasSubstr("3 theta_deg does not increase: -30 deg after -30 deg"));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90,-29\n-45,-15\n0,0\n90,30\n"),
              HasSubstr("2 theta begins at -29 deg, above joint.range_deg's -30 deg"));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90,-30\n-45,-15\n0,0\n90,29\n"),
              HasSubstr("5 theta ends at 29 deg, below joint.range_deg's 30 deg"));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n1e9,0\n"), HasSubstr("2 an angle is too large"));
}

TEST(LawTable, RequiresHome) {
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90,-30\n-45,-15\n0,0.02\n45,15\n90,30\n"),
              HasSubstr("the law does not pass through home: theta is 0.02 deg"));
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n-90,-30\n-45,-15\n0,0.009\n45,15\n90,30\n"), IsEmpty());
  EXPECT_THAT(errors_of("alpha_deg,theta_deg\n10,-30\n20,-15\n30,0\n45,15\n90,30\n"),
              HasSubstr("alpha = 0 (home) is not within the table"));
}

TEST(LawTable, InterpolatesHomeBetweenRows) {
  // θ = α/3 + α³/10⁵ is a cubic: the interpolation between rows around home is exact.
  std::string csv = "alpha_deg,theta_deg\n";
  for (const double alpha : {-90.0, -50.0, -10.0, 30.0, 60.0, 90.0}) {
    csv += std::to_string(alpha) + "," + std::to_string(alpha / 3 + alpha * alpha * alpha / 1e5) + "\n";
  }
  EXPECT_THAT(errors_of(csv), IsEmpty());
}

std::string torque_errors_of(const std::string& csv) {
  std::vector<Diagnostic> problems;
  parse_torque_table(csv, "torque.csv", k_joint, problems);
  std::string text;
  for (const Diagnostic& problem : problems)
    text += std::to_string(problem.place.line) + " " + problem.message + " | " + problem.hint + "\n";
  return text;
}

TEST(TorqueTable, ReadsAnglesAndTorques) {
  std::vector<Diagnostic> problems;
  const std::vector<TorqueRow> rows = parse_torque_table(
      "theta_deg, motor_torque_Nmm\r\n-30,900 # low\n-10,950\n0,-5\n30,1e3", "torque.csv", k_joint, problems);
  EXPECT_THAT(problems, IsEmpty());
  ASSERT_THAT(rows, SizeIs(4));
  EXPECT_EQ(rows[0].theta, radians(-30));
  EXPECT_EQ(rows[2].torque, -5);
  EXPECT_EQ(rows[3].torque, 1000);
}

TEST(TorqueTable, ReportsLineOfEachError) {
  const std::string header = "theta_deg,motor_torque_Nmm\n";
  EXPECT_THAT(torque_errors_of(""), HasSubstr("0 the table is empty"));
  EXPECT_THAT(torque_errors_of("theta_deg,torque_Nmm\n1,2\n"),
              HasSubstr("1 the columns are \"theta_deg,torque_Nmm\", not theta_deg,motor_torque_Nmm"));
  EXPECT_THAT(torque_errors_of(header + "-30,1\n0,2\n30,3\n"), HasSubstr("0 the table has 3 rows"));
  EXPECT_THAT(torque_errors_of(header + "-30,1\n0,inf\n10,1\n30,3\n"), HasSubstr("3 \"0,inf\" is not two finite"));
  EXPECT_THAT(torque_errors_of(header + "-30,1\n0,2\n0,2\n30,3\n"),
              HasSubstr("4 theta_deg does not increase: 0 deg after 0 deg"));
  EXPECT_THAT(torque_errors_of(header + "-29,1\n0,2\n10,2\n30,3\n"), HasSubstr("2 theta begins at -29 deg"));
  EXPECT_THAT(torque_errors_of(header + "-30,1\n0,2\n10,2\n29,3\n"), HasSubstr("5 theta ends at 29 deg"));
  EXPECT_THAT(torque_errors_of(header + "-30,1e8\n"), HasSubstr("2 a number is too large"));
  std::string many = header;
  for (int i = 0; i <= 2000; ++i) many += std::to_string(-30 + 0.03 * i) + ",1\n";
  EXPECT_THAT(torque_errors_of(many), HasSubstr("2002 the table has more than 2000 rows"));
}

TEST(LawTable, LimitsErrors) {
  std::string csv = "alpha_deg,theta_deg\n";
  for (int i = 0; i < 1000; ++i) csv += "x,y\n";
  std::vector<Diagnostic> problems;
  parse_law_table(csv, "law.csv", k_joint, problems);
  EXPECT_THAT(problems, SizeIs(20));
}

}  // namespace
}  // namespace fusee
