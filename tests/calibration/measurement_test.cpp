#include "fusee/calibration/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "fusee/base/text.h"
#include "fusee/transmission/transmission.h"
#include "support/mechanisms.h"

namespace fusee {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// α of a triangle wave between ±`size` deg, `per_stroke` rows a stroke.
std::vector<double> triangle(double size, int per_stroke, int strokes) {
  std::vector<double> alphas;
  for (int i = 0; i <= per_stroke * strokes; ++i) {
    const int stroke = i / per_stroke, step = i % per_stroke;
    const double way = -size + 2 * size * step / per_stroke;
    alphas.push_back(stroke % 2 == 0 ? way : -way);
  }
  return alphas;
}

std::string csv(const std::vector<double>& alphas, const std::function<double(double)>& theta) {
  std::string text = "time_s,alpha_deg,theta_deg\n";
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    text += shortest(0.1 * static_cast<double>(i)) + "," + shortest(alphas[i]) + "," + shortest(theta(alphas[i])) + "\n";
  }
  return text;
}

double quarter(double alpha) { return 0.25 * alpha; }

struct Parsed {
  Measurement measurement;
  fusee::Run run;
};

Parsed parsed(const std::string& text, const MeasurementOptions& options = {}) {
  Parsed result;
  result.run = parse_run(text, "run.csv", options, result.measurement);
  return result;
}

std::string error_of(const std::string& text, const MeasurementOptions& options = {}) {
  try {
    parsed(text, options);
  } catch (const InputError& error) {
    std::string all;
    for (const Diagnostic& diagnostic : error.diagnostics()) all += to_text(diagnostic) + "\n";
    return all;
  }
  return "none";
}

std::string notes_of(const Measurement& measurement) {
  std::string all;
  for (const std::string& note : measurement.notes) all += note + "\n";
  return all;
}

std::string reasons_of(const Measurement& measurement) {
  std::string all;
  for (const std::string& reason : measurement.not_testable) all += reason + "\n";
  return all;
}

/// A scratch file that goes with the test.
class Scratch {
 public:
  explicit Scratch(const std::string& text) : path_(std::filesystem::temp_directory_path() / ("fusee-measurement-" + std::to_string(::getpid()) + ".csv")) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~Scratch() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(Measurement, ReadsWhatABenchLogs) {
  const Parsed p = parsed(csv(triangle(40, 50, 4), quarter));
  EXPECT_THAT(p.measurement.not_testable, IsEmpty());
  EXPECT_THAT(p.measurement.notes, IsEmpty());
  ASSERT_THAT(p.run.samples, SizeIs(201));
  EXPECT_DOUBLE_EQ(p.run.samples[0].alpha, radians(-40.0));
  EXPECT_DOUBLE_EQ(p.run.samples[0].theta, radians(-10.0));
  EXPECT_TRUE(p.run.has_time);
  EXPECT_FALSE(p.run.has_load);
  EXPECT_NEAR(degrees(p.run.speed), 16.0, 1e-9);
}

TEST(Measurement, FindsStrokesAtTheReversals) {
  const Parsed p = parsed(csv(triangle(40, 50, 4), quarter));
  ASSERT_THAT(p.run.strokes, SizeIs(4));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(p.run.strokes[i].direction, i % 2 == 0 ? 1 : -1);
    EXPECT_EQ(p.run.strokes[i].cycle, static_cast<int>(i / 2));
    EXPECT_FALSE(p.run.strokes[i].partial);
    EXPECT_NEAR(static_cast<double>(p.run.strokes[i].last), 50.0 * static_cast<double>(i + 1), 1.0);
  }
}

TEST(Measurement, NoiseAndQuantumMakeNoStrokes) {
  std::vector<double> alphas = triangle(40, 400, 4);
  for (std::size_t i = 0; i < alphas.size(); ++i) alphas[i] = 0.25 * std::round(4 * (alphas[i] + 0.2 * std::sin(12.9898 * static_cast<double>(i))));
  EXPECT_THAT(parsed(csv(alphas, quarter)).run.strokes, SizeIs(4));
  EXPECT_NEAR(degrees(parsed(csv(alphas, quarter)).measurement.alpha_quantum), 0.25, 1e-9);
}

TEST(Measurement, AFirstStrokeFromTheMiddleIsPartial) {
  std::vector<double> alphas = triangle(40, 50, 4);
  alphas.erase(alphas.begin(), alphas.begin() + 25);
  const Parsed p = parsed(csv(alphas, quarter));
  ASSERT_THAT(p.run.strokes, SizeIs(4));
  EXPECT_TRUE(p.run.strokes[0].partial);
  EXPECT_FALSE(p.run.strokes[1].partial);
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("does not begin at a reversal"));
}

TEST(Measurement, TakesCommentsByteOrderMarksAndAnyLineEnd) {
  std::string text = csv(triangle(40, 50, 4), quarter);
  std::string windows = "\xEF\xBB\xBF# a log\r\n";
  for (const char c : text) windows += c == '\n' ? std::string("  # said\r\n") : std::string(1, c);
  const Parsed plain = parsed(text), strange = parsed(windows);
  ASSERT_EQ(plain.run.samples.size(), strange.run.samples.size());
  for (std::size_t i = 0; i < plain.run.samples.size(); ++i) EXPECT_EQ(plain.run.samples[i].theta, strange.run.samples[i].theta);
}

TEST(Measurement, ColumnsCanBeGivenARole) {
  const std::string text = "alpha_deg,theta_deg,tau_out_Nm\n1,2,3\n";
  const Parsed p = parsed(text, {{{"load", "tau_out_Nm"}}});
  EXPECT_TRUE(p.run.has_load);
  EXPECT_EQ(p.run.samples.at(0).load, 3);
  EXPECT_EQ(p.measurement.load_unit, "Nm");
  EXPECT_THAT(error_of(text, {{{"load", "tau_oat_Nm"}}}), HasSubstr("the nearest is \"tau_out_Nm\""));
  EXPECT_THAT(error_of(text, {{{"loud", "tau_out_Nm"}}}), HasSubstr("did you mean load?"));
}

TEST(Measurement, AMissingColumnIsNamedWithTheNearest) {
  EXPECT_THAT(error_of("alpha_deg,thta_deg\n1,2\n"), HasSubstr("run.csv:1:1: error: there is no column theta_deg"));
  EXPECT_THAT(error_of("alpha_deg,thta_deg\n1,2\n"), HasSubstr("the nearest is \"thta_deg\""));
  EXPECT_THAT(error_of(""), HasSubstr("holds no header"));
  EXPECT_THAT(error_of("alpha_deg,theta_deg,alpha_deg\n1,2,3\n"), HasSubstr("two columns are called \"alpha_deg\""));
}

TEST(Measurement, TextInANumberIsSaidWithItsLine) {
  const std::string errors = error_of("alpha_deg,theta_deg\n1,2\n# ok\n1,two\n3,4\nx,5\n");
  EXPECT_THAT(errors, HasSubstr("run.csv:4:3: error: theta_deg: \"two\" is not a number"));
  EXPECT_THAT(errors, HasSubstr("run.csv:6:1: error: alpha_deg: \"x\" is not a number"));
  EXPECT_THAT(error_of("alpha_deg,theta_deg\n1\n1,2\n"), HasSubstr("run.csv:2:1: error: the row has 1 values, the header 2"));
  EXPECT_THAT(error_of(std::string("alpha_deg,theta_deg\n\0\n", 22)), HasSubstr("binary"));
}

TEST(Measurement, RowsWithoutAnAngleAreLeftOutAndCounted) {
  std::string text = csv(triangle(40, 50, 4), quarter);
  text.replace(text.find("\n0,") + 1, 2, "0.0,nan,inf\n0,");
  const Parsed p = parsed(text);
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("1 row without alpha or theta, the first in line 2"));
  EXPECT_THAT(p.run.samples, SizeIs(201));
}

TEST(Measurement, WrapAroundIsTakenBack) {
  const auto wrapped = [](double alpha) { return std::remainder(alpha, 360.0); };
  std::vector<double> alphas = triangle(300, 100, 4);
  std::string text = "alpha_deg,theta_deg\n";
  for (const double alpha : alphas) text += shortest(wrapped(alpha)) + "," + shortest(quarter(alpha)) + "\n";
  const Parsed p = parsed(text);
  // The first value decides on which turn the log begins.
  const double shift = degrees(p.run.samples[0].alpha) - alphas[0];
  for (std::size_t i = 0; i < alphas.size(); ++i) EXPECT_NEAR(degrees(p.run.samples[i].alpha), alphas[i] + shift, 1e-9);
  EXPECT_NEAR(std::remainder(shift, 360.0), 0, 1e-9);
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("unwrapped"));
}

TEST(Measurement, TimeIsPutInOrder) {
  std::string text = csv(triangle(40, 50, 4), quarter);
  const std::size_t a = text.find("\n3,") + 1, b = text.find('\n', a) + 1, c = text.find('\n', b) + 1;
  text = text.substr(0, a) + text.substr(b, c - b) + text.substr(a, b - a) + text.substr(a, b - a) + text.substr(c);
  const Parsed p = parsed(text);
  ASSERT_THAT(p.run.samples, SizeIs(201));
  for (std::size_t i = 1; i < 201; ++i) EXPECT_GT(p.run.samples[i].time, p.run.samples[i - 1].time);
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("rows were put in order"));
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("taken together"));
}

TEST(Measurement, OutliersAreDroppedAndMotionIsNot) {
  std::string text = csv(triangle(40, 50, 4), quarter);
  const std::size_t at = text.find("\n7,");
  const std::size_t end = text.find('\n', at + 1);
  text.replace(at, end - at, "\n7,16,77");
  const Parsed p = parsed(text);
  EXPECT_THAT(p.run.samples, SizeIs(200));
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("dropped as outliers"));
  // A step that stays is no outlier.
  const Parsed step = parsed(csv(triangle(40, 50, 4), [](double alpha) { return 0.25 * alpha + (alpha > 3 ? 2 : 0); }));
  EXPECT_THAT(step.run.samples, SizeIs(201));
}

TEST(Measurement, WhatCannotBeTestedIsSaid) {
  EXPECT_THAT(reasons_of(parsed("alpha_deg,theta_deg\n1,2\n").measurement), HasSubstr("1 row that can be used"));
  EXPECT_THAT(reasons_of(parsed(csv(std::vector<double>(50, 1.0), quarter)).measurement), HasSubstr("alpha does not change"));
  EXPECT_THAT(reasons_of(parsed(csv(triangle(40, 50, 4), [](double) { return 3.0; })).measurement), HasSubstr("sensor is dead"));
  const auto frozen = [](double alpha) { return 0.25 * std::min(alpha, -20.0); };
  EXPECT_THAT(reasons_of(parsed(csv(triangle(40, 50, 4), frozen)).measurement), HasSubstr("stands still"));
  const Scratch one_way(csv(triangle(40, 50, 1), quarter));
  EXPECT_THAT(reasons_of(read_measurement({one_way.path()})), HasSubstr("alpha only grows"));
  EXPECT_THROW(read_measurement({"no/such/file.csv"}), InputError);
}

TEST(Measurement, AFileAndItsTextAreTheSame) {
  const std::string text = csv(triangle(40, 5000, 4), quarter);
  const Scratch file(text);
  const Measurement measurement = read_measurement({file.path()});
  ASSERT_THAT(measurement.runs, SizeIs(1));
  const fusee::Run run = parsed(text).run;
  ASSERT_EQ(measurement.runs[0].samples.size(), run.samples.size());
  for (std::size_t i = 0; i < run.samples.size(); ++i) ASSERT_EQ(measurement.runs[0].samples[i].theta, run.samples[i].theta);
}

TEST(Measurement, ALogTooLongToKeepIsThinned) {
  std::string text = "alpha_deg,theta_deg\n";
  constexpr int rows = 1'200'000;
  for (int i = 0; i < rows; ++i) {
    const int step = i % 200'000;
    const int alpha = step < 100'000 ? step : 200'000 - step;
    text += std::to_string(alpha) + "e-3," + std::to_string(alpha) + "e-4\n";
  }
  const Parsed p = parsed(text);
  EXPECT_LT(p.run.samples.size(), std::size_t{1} << 20);
  EXPECT_GT(p.run.samples.size(), 500'000u);
  EXPECT_THAT(p.run.strokes, SizeIs(12));
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("of 1200000 rows one in 2 is used"));
}

// ---- against what was declared --------------------------------------------------------------------------------------

Measurement of_joint(double alpha_factor, double theta_factor, bool exchanged = false) {
  const Transmission law(testing::forearm());
  Measurement measurement;
  const double most = degrees(law.alpha_max());
  std::string text = exchanged ? "theta_deg,alpha_deg\n" : "alpha_deg,theta_deg\n";
  for (const double alpha : triangle(0.95 * most, 60, 4)) {
    text += shortest(alpha_factor * alpha) + "," + shortest(theta_factor * degrees(law.theta(radians(alpha)))) + "\n";
  }
  measurement.runs.push_back(parse_run(text, "run.csv", {}, measurement));
  compare_with_declared(testing::forearm(), measurement);
  return measurement;
}

TEST(MeasurementAgainstDeclared, ExchangedTurnedAndInRadiansAreSaid) {
  EXPECT_EQ(reasons_of(of_joint(1, 1)), "");
  EXPECT_EQ(reasons_of(of_joint(1, 1.2)), "");
  EXPECT_THAT(reasons_of(of_joint(1, -1)), HasSubstr("opposite sign"));
  EXPECT_THAT(reasons_of(of_joint(1, 1, true)), HasSubstr("exchanged"));
  EXPECT_THAT(reasons_of(of_joint(radians(1.0), radians(1.0))), HasSubstr("both angles look like radians"));
  EXPECT_THAT(reasons_of(of_joint(radians(1.0), 1)), HasSubstr("alpha looks like radians"));
  EXPECT_THAT(reasons_of(of_joint(1, radians(1.0))), HasSubstr("theta looks like radians"));
  EXPECT_THAT(reasons_of(of_joint(1, 7)), HasSubstr("not the declared joint"));
}

}  // namespace
}  // namespace fusee
