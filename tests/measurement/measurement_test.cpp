#include "fusee/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "base/text.h"
#include "fusee/transmission.h"
#include "support/mechanisms.h"

namespace fusee::measurement {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// α of a triangle wave between ±`size` deg, `per_stroke` rows per stroke.
std::vector<double> triangle(double size, int per_stroke, int strokes) {
  std::vector<double> alphas;
  for (int i = 0; i <= per_stroke * strokes; ++i) {
    const int stroke = i / per_stroke, step = i % per_stroke;
    const double rising = -size + 2 * size * step / per_stroke;
    alphas.push_back(stroke % 2 == 0 ? rising : -rising);
  }
  return alphas;
}

std::string csv(const std::vector<double>& alphas, const std::function<double(double)>& theta) {
  std::string text = "time_s,alpha_deg,theta_deg\n";
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    text +=
        shortest(0.1 * static_cast<double>(i)) + "," + shortest(alphas[i]) + "," + shortest(theta(alphas[i])) + "\n";
  }
  return text;
}

double quarter(double alpha) { return 0.25 * alpha; }

struct ParsedRun {
  Measurement measurement;
  fusee::measurement::Run run;
};

ParsedRun parsed(const std::string& text, const MeasurementOptions& options = {}) {
  ParsedRun result;
  result.run = parse_run(text, "run.csv", options, result.measurement);
  return result;
}

MeasurementOptions column_options(const std::map<std::string, std::string>& columns) {
  MeasurementOptions options;
  options.columns = columns;
  return options;
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

/// A scratch file, deleted with the test.
class Scratch {
 public:
  explicit Scratch(const std::string& text, const std::string& name = "run")
      : path_(std::filesystem::temp_directory_path() /
              ("fusee-measurement-" + name + "-" + std::to_string(::getpid()) + ".csv")) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~Scratch() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(Measurement, ReadsBenchLog) {
  const ParsedRun p = parsed(csv(triangle(40, 50, 4), quarter));
  EXPECT_THAT(p.measurement.not_testable, IsEmpty());
  EXPECT_THAT(p.measurement.notes, IsEmpty());
  ASSERT_THAT(p.run.samples, SizeIs(201));
  EXPECT_DOUBLE_EQ(p.run.samples[0].alpha, radians(-40.0));
  EXPECT_DOUBLE_EQ(p.run.samples[0].theta, radians(-10.0));
  EXPECT_TRUE(p.run.has_time);
  EXPECT_FALSE(p.run.has_load);
  EXPECT_NEAR(degrees(p.run.speed), 16.0, 1e-9);  // 80° in 50 rows of 0.1 s
}

TEST(Measurement, CutsStrokesAtReversals) {
  const ParsedRun p = parsed(csv(triangle(40, 50, 4), quarter));
  ASSERT_THAT(p.run.strokes, SizeIs(4));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(p.run.strokes[i].direction, i % 2 == 0 ? 1 : -1);
    EXPECT_EQ(p.run.strokes[i].cycle, static_cast<int>(i / 2));
    EXPECT_FALSE(p.run.strokes[i].partial);
    EXPECT_NEAR(static_cast<double>(p.run.strokes[i].last), 50.0 * static_cast<double>(i + 1), 1.0);
  }
}

TEST(Measurement, NoiseMakesNoStrokes) {
  std::vector<double> alphas = triangle(40, 400, 4);
  for (std::size_t i = 0; i < alphas.size(); ++i)
    alphas[i] = 0.25 * std::round(4 * (alphas[i] + 0.2 * std::sin(12.9898 * static_cast<double>(i))));
  EXPECT_THAT(parsed(csv(alphas, quarter)).run.strokes, SizeIs(4));
  EXPECT_NEAR(degrees(parsed(csv(alphas, quarter)).measurement.alpha_quantum), 0.25, 1e-9);
}

TEST(Measurement, FirstStrokeFromMiddleIsPartial) {
  std::vector<double> alphas = triangle(40, 50, 4);
  alphas.erase(alphas.begin(), alphas.begin() + 25);
  const ParsedRun p = parsed(csv(alphas, quarter));
  ASSERT_THAT(p.run.strokes, SizeIs(4));
  EXPECT_TRUE(p.run.strokes[0].partial);
  EXPECT_FALSE(p.run.strokes[1].partial);
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("does not begin at a reversal"));
}

TEST(Measurement, AcceptsCommentsByteOrderMarkAndLineEnds) {
  std::string text = csv(triangle(40, 50, 4), quarter);
  std::string windows = "\xEF\xBB\xBF# a log\r\n";
  for (const char c : text) windows += c == '\n' ? std::string("\r\n  # said\r\n") : std::string(1, c);
  const ParsedRun plain = parsed(text), strange = parsed(windows);
  ASSERT_EQ(plain.run.samples.size(), strange.run.samples.size());
  for (std::size_t i = 0; i < plain.run.samples.size(); ++i)
    EXPECT_EQ(plain.run.samples[i].theta, strange.run.samples[i].theta);
}

std::string replaced(std::string text, const std::string& old_text, const std::string& new_text) {
  for (std::size_t at = text.find(old_text); at != std::string::npos; at = text.find(old_text, at + new_text.size()))
    text.replace(at, old_text.size(), new_text);
  return text;
}

TEST(Measurement, ReadsEverySeparator) {
  const std::string text = csv(triangle(40, 50, 4), quarter);
  const ParsedRun plain = parsed(text);
  const std::string padded = replaced(replaced(text, ",", " , "), "\n", "\t\n");
  const std::string quoted =
      "\"" + replaced(replaced(text.substr(0, text.size() - 1), ",", "\",\""), "\n", "\"\n\"") + "\"";
  for (const std::string& other :
       {replaced(text, ",", ";"), replaced(text, ",", "\t"), replaced(text, ",", "  "), replaced(text, "\n", "\r"),
        replaced(text, "\n", "\r\n"), replaced(text, "\n", ",\n"), text.substr(0, text.size() - 1), padded, quoted}) {
    // If rows end in a comma, the header has none.
    const ParsedRun p = parsed(replaced(other, "theta_deg,\n", "theta_deg\n"));
    ASSERT_EQ(p.run.samples.size(), plain.run.samples.size()) << other.substr(0, 80);
    for (std::size_t i = 0; i < p.run.samples.size(); ++i)
      EXPECT_EQ(p.run.samples[i].theta, plain.run.samples[i].theta);
    EXPECT_THAT(p.measurement.notes, IsEmpty());
  }
}

TEST(Measurement, TakesUnitFromColumnName) {
  const std::string text = "clock_ms,motor_rad,joint_rad\n500,0.5,0.1\n";
  const ParsedRun p =
      parsed(text, column_options({{"time", "clock_ms"}, {"alpha", "motor_rad"}, {"theta", "joint_rad"}}));
  EXPECT_DOUBLE_EQ(p.run.samples.at(0).time, 0.5);
  EXPECT_DOUBLE_EQ(p.run.samples.at(0).alpha, 0.5);
  EXPECT_DOUBLE_EQ(p.run.samples.at(0).theta, 0.1);
}

TEST(Measurement, RejectsColumnWithTwoRoles) {
  EXPECT_THAT(error_of("alpha_deg,theta_deg\n1,2\n", column_options({{"load", "theta_deg"}})),
              HasSubstr("\"theta_deg\" is taken as theta and as load"));
}

TEST(Measurement, ReportsDecimalCommasOnce) {
  EXPECT_THAT(error_of("alpha_deg,theta_deg\n1,5,2,5\n2,5,3,5\n"), HasSubstr("if commas are the decimal marks"));
}

TEST(Measurement, RejectsTextWithoutTable) {
  EXPECT_THAT(error_of(std::string("a\0l\0", 4)), HasSubstr("save it as UTF-8"));
  EXPECT_THAT(error_of("\x1F\x8B\x08\x01"), HasSubstr("unpack it with gunzip"));
  EXPECT_THAT(error_of("PK\x03\x04"), HasSubstr("export a CSV text"));
  EXPECT_THAT(error_of("alpha_deg,theta_deg\n" + std::string(70'000, '1')),
              HasSubstr("run.csv:2:1: error: a line of more than 65536 bytes"));
  EXPECT_THAT(error_of("1,2\n3,4\n"), HasSubstr("there is no header"));
  EXPECT_THAT(error_of("# alpha_deg,theta_deg\n1,2\n3,4\n"), HasSubstr("remove its #"));
  EXPECT_THAT(error_of("alpha_deg,theta_deg\nfloat,float\n1,2\n"),
              HasSubstr("is this a second header line? Begin it with #"));
  EXPECT_THAT(error_of("ALPHADEG,theta_deg\n1,2\n"), HasSubstr("the nearest is \"ALPHADEG\""));
  EXPECT_THAT(error_of("alpha_deg,theta_deg\n1e300,2\n"),
              HasSubstr("run.csv:2:1: error: alpha_deg = 1e+300 is not an angle"));
}

TEST(Measurement, StopsAfterManyErrors) {
  std::string text = "alpha_deg,theta_deg\n";
  for (int i = 0; i < 1000; ++i) text += "1,x\n";
  const std::string errors = error_of(text);
  EXPECT_EQ(std::count(errors.begin(), errors.end(), 'x'), 1);
  EXPECT_THAT(errors, HasSubstr("\"x\" is not a number, and so in 999 rows below"));
  EXPECT_THAT(errors, HasSubstr("there may be more"));
}

TEST(Measurement, ReportsFaultOfManyRowsOnce) {
  std::string text = "alpha_deg,theta_deg,load_N\n";
  for (int i = 0; i < 50; ++i) text += "1,2 deg,3 N\n";
  const std::string errors = error_of(text + "1,2\n1,2,3,4\n1,2,3\n");
  EXPECT_THAT(errors, HasSubstr("run.csv:2:3: error: theta_deg: \"2 deg\" is not a number, and so in 49 rows below"));
  EXPECT_THAT(errors, HasSubstr("run.csv:52:1: error: the row has 2 values, the header 3, and so in 1 row below"));
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 4);  // a hint below each
}

TEST(Measurement, OmitsTruncatedLastRow) {
  const ParsedRun p = parsed(csv(triangle(40, 50, 4), quarter) + "20.1,-39");
  EXPECT_THAT(p.run.samples, SizeIs(201));
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("the last row (line 203) is truncated"));
}

TEST(Measurement, AssignsRolesToColumns) {
  const std::string text = "alpha_deg,theta_deg,tau_out_Nm\n1,2,3\n";
  const ParsedRun p = parsed(text, column_options({{"load", "tau_out_Nm"}}));
  EXPECT_TRUE(p.run.has_load);
  EXPECT_EQ(p.run.samples.at(0).load, 3);
  EXPECT_EQ(p.measurement.load_unit, "Nm");
  EXPECT_THAT(error_of(text, column_options({{"load", "tau_oat_Nm"}})), HasSubstr("the nearest is \"tau_out_Nm\""));
  EXPECT_THAT(error_of(text, column_options({{"loud", "tau_out_Nm"}})), HasSubstr("did you mean load?"));
}

TEST(Measurement, SuggestsNearestColumn) {
  EXPECT_THAT(error_of("alpha_deg,thta_deg\n1,2\n"), HasSubstr("run.csv:1:1: error: there is no column theta_deg"));
  EXPECT_THAT(error_of("alpha_deg,thta_deg\n1,2\n"), HasSubstr("the nearest is \"thta_deg\""));
  EXPECT_THAT(error_of(""), HasSubstr("has no header"));
  EXPECT_THAT(error_of("alpha_deg,theta_deg,alpha_deg\n1,2,3\n"), HasSubstr("two columns are called \"alpha_deg\""));
}

TEST(Measurement, ReportsLineOfInvalidNumber) {
  const std::string errors = error_of("alpha_deg,theta_deg\n1,2\n# ok\n1,two\n3,4\nx,5\n");
  EXPECT_THAT(errors, HasSubstr("run.csv:4:3: error: theta_deg: \"two\" is not a number"));
  EXPECT_THAT(errors, HasSubstr("run.csv:6:1: error: alpha_deg: \"x\" is not a number"));
  EXPECT_THAT(error_of("alpha_deg,theta_deg\n1\n1,2\n"),
              HasSubstr("run.csv:2:1: error: the row has 1 values, the header 2"));
  EXPECT_THAT(error_of(std::string("alpha_deg,theta_deg\n1,\0002\n", 25)), HasSubstr("binary"));
}

TEST(Measurement, CountsRowsWithoutAngle) {
  std::string text = csv(triangle(40, 50, 4), quarter);
  text.replace(text.find("\n0,") + 1, 2, "0.0,nan,inf\n0,");
  const ParsedRun p = parsed(text);
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("1 row without alpha or theta, the first in line 2"));
  EXPECT_THAT(p.run.samples, SizeIs(201));
}

TEST(Measurement, UnwrapsEncoder) {
  const auto wrapped = [](double alpha) { return std::remainder(alpha, 360.0); };
  std::vector<double> alphas = triangle(300, 100, 4);
  std::string text = "alpha_deg,theta_deg\n";
  for (const double alpha : alphas) text += shortest(wrapped(alpha)) + "," + shortest(quarter(alpha)) + "\n";
  const ParsedRun p = parsed(text);
  // The first value determines the turn on which the log begins.
  const double shift = degrees(p.run.samples[0].alpha) - alphas[0];
  for (std::size_t i = 0; i < alphas.size(); ++i) EXPECT_NEAR(degrees(p.run.samples[i].alpha), alphas[i] + shift, 1e-9);
  EXPECT_NEAR(std::remainder(shift, 360.0), 0, 1e-9);
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("unwrapped"));
}

TEST(Measurement, MovesLateRowBack) {
  std::string text = csv(triangle(40, 50, 4), quarter);
  // The row at 3 s comes after the next row, and comes twice.
  const std::size_t a = text.find("\n3,") + 1, b = text.find('\n', a) + 1, c = text.find('\n', b) + 1;
  const std::string late = text.substr(a, b - a), next = text.substr(b, c - b);
  text = text.substr(0, a) + next + late + late + text.substr(c);
  const ParsedRun p = parsed(text);
  ASSERT_THAT(p.run.samples, SizeIs(201));
  for (std::size_t i = 1; i < 201; ++i) EXPECT_GT(p.run.samples[i].time, p.run.samples[i - 1].time);
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("delivered late"));
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("averaged"));
}

// ---- time -----------------------------------------------------------------------------------------------------------

/// Rows of a triangle wave, with times from `time`.
std::string timed(const std::function<std::string(int)>& time) {
  std::string text = "time_s,alpha_deg,theta_deg\n";
  const std::vector<double> alphas = triangle(40, 50, 4);
  for (std::size_t i = 0; i < alphas.size(); ++i)
    text += time(static_cast<int>(i)) + "," + shortest(alphas[i]) + "," + shortest(quarter(alphas[i])) + "\n";
  return text;
}

TEST(Measurement, InterpolatesFewMissingTimes) {
  const ParsedRun few = parsed(timed([](int i) { return i == 7 || i == 8 ? "" : shortest(0.1 * i); }));
  EXPECT_NEAR(few.run.samples[7].time, 0.7, 1e-12);
  EXPECT_NEAR(few.run.samples[8].time, 0.8, 1e-12);
  EXPECT_THAT(notes_of(few.measurement), HasSubstr("2 rows without a time"));
  const ParsedRun many = parsed(timed([](int i) { return i % 2 == 0 ? "nan" : shortest(0.1 * i); }));
  EXPECT_FALSE(many.run.has_time);
  EXPECT_THAT(many.run.samples, SizeIs(201));
  EXPECT_THAT(notes_of(many.measurement), HasSubstr("time is not used"));
}

TEST(Measurement, SpreadsCoarseClock) {
  const ParsedRun p = parsed(timed([](int i) { return std::to_string(i / 10); }));
  ASSERT_THAT(p.run.samples, SizeIs(201));
  for (std::size_t i = 0; i < 200; ++i) EXPECT_NEAR(p.run.samples[i].time, 0.1 * static_cast<double>(i), 1e-12);
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("coarser than the log"));
}

TEST(Measurement, DropsConstantClock) {
  const ParsedRun p = parsed(timed([](int) { return "1.0"; }));
  EXPECT_FALSE(p.run.has_time);
  EXPECT_THAT(p.run.samples, SizeIs(201));
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("the clock stands still"));
}

TEST(Measurement, ContinuesRestartedClock) {
  const ParsedRun p = parsed(timed([](int i) { return shortest(0.1 * (i % 100)); }));
  ASSERT_THAT(p.run.samples, SizeIs(201));
  for (std::size_t i = 0; i < 201; ++i) EXPECT_NEAR(p.run.samples[i].time, 0.1 * static_cast<double>(i), 1e-9);
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("the clock goes back 2 times, first from 9.9 to 0 s"));
}

TEST(Measurement, KeepsOrderOfSwappedHalves) {
  const std::string text = timed([](int i) { return shortest(0.1 * i); });
  // The row at 13 s is row 130 of 201: the second part has 71 rows.
  const std::size_t body = text.find('\n') + 1, middle = text.find("\n13,") + 1;
  const ParsedRun p = parsed(text.substr(0, body) + text.substr(middle) + text.substr(body, middle - body));
  ASSERT_THAT(p.run.samples, SizeIs(201));
  for (std::size_t i = 0; i < 201; ++i) {
    EXPECT_NEAR(degrees(p.run.samples[i].alpha), triangle(40, 50, 4)[(i + 130) % 201], 1e-9);
    EXPECT_EQ(p.run.samples[i].after_break, i == 71);
    EXPECT_NEAR(p.run.samples[i].time, 13 + 0.1 * static_cast<double>(i), 1e-9);
  }
}

// ---- strokes --------------------------------------------------------------------------------------------------------

std::vector<double> sine(double size, int rows, double cycles) {
  std::vector<double> alphas;
  for (int i = 0; i <= rows; ++i) alphas.push_back(size * std::sin(k_two_pi * cycles * i / rows));
  return alphas;
}

/// Adds small jitter, as a sensor's noise: the phase 12.9898 i² of the sine scatters like a random one.
std::vector<double> jittered(std::vector<double> values, double size) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += size * std::sin(12.9898 * static_cast<double>(i * i));
  return values;
}

/// Inserts a dwell of `rows` rows at every `every`-th value.
std::vector<double> dwelling(const std::vector<double>& values, std::size_t every, int rows) {
  std::vector<double> found;
  for (std::size_t i = 0; i < values.size(); ++i)
    found.insert(found.end(), i % every == 0 ? static_cast<std::size_t>(rows) : 1, values[i]);
  return found;
}

std::string directions_of(const fusee::measurement::Run& run) {
  std::string signs;
  for (const Stroke& stroke : run.strokes)
    signs += std::string(stroke.partial ? "(" : "") + (stroke.direction > 0 ? "+" : "-") + (stroke.partial ? ")" : "");
  return signs;
}

TEST(Strokes, SineBeginsWithPartialStroke) {
  for (const double noise : {0.0, 0.05, 0.5}) {
    const ParsedRun p = parsed(csv(jittered(sine(40, 2000, 3), noise), quarter));
    EXPECT_EQ(directions_of(p.run), "(+)-+-+-+") << noise;
    // A quarter sine is partial; cycles count from the first complete stroke.
    for (std::size_t i = 1; i < p.run.strokes.size(); ++i)
      EXPECT_EQ(p.run.strokes[i].cycle, static_cast<int>((i - 1) / 2));
  }
}

TEST(Strokes, FewRowsBeginAtReversal) {
  EXPECT_EQ(directions_of(parsed(csv(triangle(40, 8, 6), quarter)).run), "+-+-+-");
}

/// Strokes of a joint with a play of 4° of α, which is `behind` α when the log begins.
std::string directions_behind_play(double behind) {
  return directions_of(parsed(csv(triangle(40, 50, 6), [&](double alpha) {
                         behind = std::clamp(behind, alpha - 2.0, alpha + 2.0);
                         return 0.25 * behind;
                       })).run);
}

TEST(Strokes, BeginningUnlikeItsRepeatsIsPartial) {
  EXPECT_EQ(directions_behind_play(-38.0), "+-+-+-");  // as after every reversal
  EXPECT_EQ(directions_behind_play(-42.0), "(+)-+-+-");
}

TEST(Strokes, DwellsDoNotCutStrokes) {
  const std::vector<double> alphas = triangle(40, 50, 6);
  for (const std::size_t every :
       {std::size_t{50}, std::size_t{25}, std::size_t{10}}) {  // at the reversals, in the middle, staircases
    for (const double noise : {0.0, 0.02}) {
      // θ has noise of 1e-4°, a function of α that scatters like random numbers.
      const ParsedRun p = parsed(csv(jittered(dwelling(alphas, every, 40), noise),
                                     [](double alpha) { return 0.25 * alpha + 1e-4 * std::sin(1e5 * alpha); }));
      EXPECT_EQ(directions_of(p.run), "+-+-+-") << every << " " << noise;
    }
  }
}

TEST(Strokes, DitherMakesNoStroke) {
  std::vector<double> alphas = triangle(40, 200, 4);
  for (std::size_t i = 0; i < alphas.size(); ++i) alphas[i] += 0.3 * std::sin(1.7 * static_cast<double>(i));
  EXPECT_EQ(directions_of(parsed(csv(alphas, quarter)).run), "+-+-");
}

TEST(Strokes, TinyMotionMakesStrokes) {
  EXPECT_EQ(directions_of(parsed(csv(triangle(0.1, 50, 4), quarter)).run), "+-+-");
}

TEST(Strokes, JitterMakesNoStroke) {
  const ParsedRun p = parsed(csv(jittered(std::vector<double>(300, 3.0), 0.01), quarter));
  EXPECT_EQ(directions_of(p.run), "");
  EXPECT_THAT(reasons_of(p.measurement), HasSubstr("alpha only jitters (by 0.02 deg)"));
}

TEST(Strokes, FindsManyCycles) {
  const ParsedRun p = parsed(csv(jittered(triangle(40, 20, 400), 0.02), quarter));
  ASSERT_THAT(p.run.strokes, SizeIs(400));
  EXPECT_EQ(p.run.strokes.back().cycle, 199);
}

// Without the rows from 7 s to 14 s, α steps from 9.6° on its way down to 24° on its way up.
TEST(Strokes, GapCutsStroke) {
  std::string text = csv(triangle(40, 50, 6), quarter);
  text.erase(text.find("\n7,") + 1, text.find("\n14,") - text.find("\n7,"));
  for (const char* const name : {"time_s", "frame"}) {
    const ParsedRun p = parsed(replaced(text, "time_s", name));
    EXPECT_EQ(directions_of(p.run), "+-(+)-+-") << name;
    EXPECT_THAT(notes_of(p.measurement), HasSubstr("over which alpha moves 14.4 deg"));
  }
}

TEST(Strokes, LoadStepsDoNotCutStrokes) {
  const std::vector<double> alphas = triangle(40, 50, 8);
  std::string text = "alpha_deg,theta_deg,load_N\n";
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    const double load = 5.0 * static_cast<double>(i / 100);
    text += shortest(alphas[i]) + "," + shortest(quarter(alphas[i]) - 0.1 * load) + "," + shortest(load) + "\n";
  }
  const ParsedRun p = parsed(text);
  EXPECT_EQ(directions_of(p.run), "+-+-+-+-");
  EXPECT_THAT(p.measurement.not_testable, IsEmpty());
  EXPECT_THAT(p.measurement.notes, IsEmpty());
}

// ---- unusable runs --------------------------------------------------------------------------------------------------

TEST(Measurement, DropsOutliersAndKeepsMotion) {
  std::string text = csv(triangle(40, 50, 4), quarter);
  const std::size_t at = text.find("\n7,");
  const std::size_t end = text.find('\n', at + 1);
  text.replace(at, end - at, "\n7,16,77");
  const ParsedRun p = parsed(text);
  EXPECT_THAT(p.run.samples, SizeIs(200));
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("dropped as outliers"));
  // A lasting step is not an outlier.
  const ParsedRun step =
      parsed(csv(triangle(40, 50, 4), [](double alpha) { return 0.25 * alpha + (alpha > 3 ? 2 : 0); }));
  EXPECT_THAT(step.run.samples, SizeIs(201));
}

TEST(Measurement, ReportsUntestableRuns) {
  EXPECT_THAT(reasons_of(parsed("alpha_deg,theta_deg\n1,2\n").measurement), HasSubstr("1 row can be used"));
  EXPECT_THAT(reasons_of(parsed(csv(std::vector<double>(50, 1.0), quarter)).measurement),
              HasSubstr("alpha does not change"));
  EXPECT_THAT(reasons_of(parsed(csv(triangle(40, 50, 4), [](double) { return 3.0; })).measurement),
              HasSubstr("sensor is dead"));
  const auto frozen = [](double alpha) { return 0.25 * std::min(alpha, -20.0); };
  EXPECT_THAT(reasons_of(parsed(csv(triangle(40, 50, 4), frozen)).measurement), HasSubstr("theta is constant"));
  const Scratch one_way(csv(triangle(40, 50, 1), quarter));
  EXPECT_THAT(reasons_of(read_measurement({one_way.path()})), HasSubstr("alpha only grows"));
  EXPECT_THROW(read_measurement({"no/such/file.csv"}), InputError);
}

TEST(Measurement, FindsSmallOutliersInLargeMotion) {
  const std::vector<double> alphas = triangle(40, 50, 4);
  std::string text = "alpha_deg,theta_deg\n";
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    const double noise = 0.02 * std::sin(12.9898 * static_cast<double>(i * i));
    text += shortest(alphas[i]) + "," +
            shortest(10 * std::sin(radians(alphas[i])) + noise + (i % 90 == 17 ? 0.8 : 0.0)) + "\n";
  }
  const ParsedRun p = parsed(text);
  EXPECT_THAT(p.run.samples, SizeIs(198));  // of 201, without rows 17, 107 and 197
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("3 rows with theta more than"));
}

TEST(Measurement, KeepsManyOutliers) {
  std::vector<double> alphas = triangle(40, 50, 4);
  std::string text = "alpha_deg,theta_deg\n";
  for (std::size_t i = 0; i < alphas.size(); ++i)
    text += shortest(alphas[i]) + "," + shortest(quarter(alphas[i]) + (i % 30 == 7 ? 60 : 0)) + "\n";
  const ParsedRun p = parsed(text);
  EXPECT_THAT(p.run.samples, SizeIs(201));
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("too many to be outliers, kept"));
}

TEST(Measurement, PlayIsNotFrozenSensor) {
  // Play of 8 deg: θ is constant for a tenth of the sweep after each reversal, exactly so without noise.
  double pulley = -40;
  std::string text = "alpha_deg,theta_deg\n";
  for (const double alpha : triangle(40, 100, 6)) {
    pulley = std::clamp(pulley, alpha - 4, alpha + 4);
    text += shortest(alpha) + "," + shortest(0.25 * pulley) + "\n";
  }
  EXPECT_EQ(reasons_of(parsed(text).measurement), "");
  // Strokes that reverse within the play, next to large ones.
  pulley = -40;
  text = "alpha_deg,theta_deg\n";
  std::vector<double> alphas = triangle(40, 100, 4);
  for (const double alpha : triangle(5, 100, 4)) alphas.push_back(alpha - 35);
  for (const double alpha : alphas) {
    pulley = std::clamp(pulley, alpha - 6, alpha + 6);
    text += shortest(alpha) + "," + shortest(0.25 * pulley) + "\n";
  }
  EXPECT_EQ(reasons_of(parsed(text).measurement), "");
  // A sensor with steps of 2°: θ is constant over 8° of α.
  const auto coarse = [](double alpha) { return 2.0 * std::round(0.125 * alpha); };
  EXPECT_EQ(reasons_of(parsed(csv(triangle(40, 100, 4), coarse)).measurement), "");
}

TEST(Measurement, ReportsFrozenSensors) {
  // α rises by 1.6° a row: from 30.4° at 4.4 s to 40° the saturated θ is constant.
  const auto saturated = [](double alpha) { return 0.25 * std::clamp(alpha, -30.0, 30.0); };
  EXPECT_THAT(reasons_of(parsed(csv(triangle(40, 50, 4), saturated)).measurement),
              HasSubstr("theta is constant at 7.5 deg while alpha moves over 9.6 deg (at 4.4 s)"));
  std::string text = "alpha_deg,theta_deg,load_N\n", loaded = text;
  const std::vector<double> alphas = triangle(40, 50, 4);
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    const bool still = i > 60 && i < 90;
    const std::string rows = shortest(still ? alphas[60] : alphas[i]) + "," + shortest(quarter(alphas[i])) + ",";
    text += rows + "0\n";
    loaded += rows + (i > 75 ? "5\n" : "0\n");
  }
  EXPECT_THAT(reasons_of(parsed(text).measurement), HasSubstr("alpha is constant while theta moves over"));
  EXPECT_EQ(reasons_of(parsed(loaded).measurement), "");  // a step of the load moves the joint
}

TEST(Measurement, RejectsRepeatedRun) {
  const Scratch one(csv(triangle(40, 50, 4), quarter), "one"), copy(csv(triangle(40, 50, 4), quarter), "copy");
  try {
    read_measurement({one.path(), copy.path()});
    ADD_FAILURE() << "a copy was taken";
  } catch (const InputError& error) {
    EXPECT_THAT(to_text(error.diagnostics().at(0)), HasSubstr("has the same rows as"));
  }
}

TEST(Measurement, ReportsErrorsOfAllFiles) {
  const Scratch one("alpha_deg,theta_deg\n1,x\n", "one"), other("alpha_deg\n1\n", "other");
  try {
    read_measurement({one.path(), "no/such/file.csv", other.path(), std::filesystem::temp_directory_path()});
    ADD_FAILURE() << "nothing was wrong";
  } catch (const InputError& error) {
    EXPECT_THAT(error.diagnostics(), SizeIs(4));
  }
}

TEST(Measurement, ThinsManyLongFiles) {
  std::string text = "alpha_deg,theta_deg\n";
  constexpr int rows_a_stroke = 100'000;
  for (int i = 0; i < 6 * rows_a_stroke; ++i) {
    const int step = i % rows_a_stroke;
    const bool rises = i / rows_a_stroke % 2 == 0;
    text += std::to_string(rises ? step : rows_a_stroke - step) + "e-3," + std::to_string(i % 7) + "\n";
  }
  const Scratch one(text, "one"), other(replaced(text, ",6\n", ",5\n"), "other");
  const Measurement measurement = read_measurement({one.path(), other.path()});
  std::size_t kept = 0;
  for (const fusee::measurement::Run& run : measurement.runs) kept += run.samples.size();
  EXPECT_LE(kept, std::size_t{1} << 20);
  EXPECT_GT(kept, std::size_t{1} << 19);
  EXPECT_THAT(notes_of(measurement),
              HasSubstr("of 600000 rows one in 2 is used: at most 1048576 rows are kept, divided "
                        "equally among the files"));
}

TEST(Measurement, FileAndTextAgree) {
  const std::string text = csv(triangle(40, 5000, 4), quarter);
  const Scratch file(text);
  const Measurement measurement = read_measurement({file.path()});
  ASSERT_THAT(measurement.runs, SizeIs(1));
  const fusee::measurement::Run run = parsed(text).run;
  ASSERT_EQ(measurement.runs[0].samples.size(), run.samples.size());
  for (std::size_t i = 0; i < run.samples.size(); ++i)
    ASSERT_EQ(measurement.runs[0].samples[i].theta, run.samples[i].theta);
}

TEST(Measurement, ThinsLongLog) {
  std::string text = "alpha_deg,theta_deg\n";
  constexpr int rows = 1'200'000;
  for (int i = 0; i < rows; ++i) {
    const int step = i % 200'000;
    const int alpha = step < 100'000 ? step : 200'000 - step;
    text += std::to_string(alpha) + "e-3," + std::to_string(alpha) + "e-4\n";
  }
  const ParsedRun p = parsed(text);
  EXPECT_LT(p.run.samples.size(), std::size_t{1} << 20);
  EXPECT_GT(p.run.samples.size(), 500'000u);
  EXPECT_THAT(p.run.strokes, SizeIs(12));  // of 100000 rows each
  EXPECT_THAT(notes_of(p.measurement), HasSubstr("of 1200000 rows one in 2 is used"));
}

// ---- comparison with the file ---------------------------------------------------------------------------------------

/// A run of the forearm whose logged angles are multiplied by these factors; with `exchanged` under each other's name.
Measurement of_joint(double alpha_factor, double theta_factor, bool exchanged = false) {
  const transmission::Transmission law(testing::forearm());
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

TEST(MeasurementAgainstDeclared, NotesLoadAssumedWithoutColumn) {
  const auto notes_with = [](double tip_force, double torque, bool has_load) {
    DeclaredMechanism joint = testing::forearm();
    joint.load = {};
    joint.load.tip_force = tip_force;
    joint.load.torque = torque;
    Measurement measurement = of_joint(1, 1);
    measurement.notes.clear();
    measurement.runs.front().has_load = has_load;
    compare_with_declared(joint, measurement);
    return notes_of(measurement);
  };
  EXPECT_THAT(notes_with(6, 0, false),
              HasSubstr("run.csv: no load column, so the load of the file is assumed, load.tip_force_N = 6: if nothing "
                        "hung on the joint, give --set load.tip_force_N=0; otherwise log the load as load_N"));
  EXPECT_THAT(notes_with(6, 20, false), HasSubstr("--set load.tip_force_N=0 --set load.torque_Nmm=0"));
  EXPECT_THAT(notes_with(6, 0, true), Not(HasSubstr("no load column")));
  EXPECT_THAT(notes_with(0, 0, false), Not(HasSubstr("no load column")));
}

TEST(MeasurementAgainstDeclared, ReportsSwappedSignedOrRadianColumns) {
  EXPECT_EQ(reasons_of(of_joint(1, 1)), "");
  EXPECT_EQ(reasons_of(of_joint(1, 1.2)), "");
  EXPECT_THAT(reasons_of(of_joint(1, -1)), HasSubstr("opposite sign"));
  EXPECT_THAT(reasons_of(of_joint(1, 1, /*exchanged=*/true)), HasSubstr("exchanged"));
  EXPECT_THAT(reasons_of(of_joint(radians(1.0), radians(1.0))), HasSubstr("both angles look like radians"));
  EXPECT_THAT(reasons_of(of_joint(radians(1.0), 1)), HasSubstr("alpha looks like radians"));
  EXPECT_THAT(reasons_of(of_joint(1, radians(1.0))), HasSubstr("theta looks like radians"));
  EXPECT_THAT(reasons_of(of_joint(1, 7)), HasSubstr("not the declared joint"));
}

TEST(MeasurementAgainstDeclared, RemovesWholeTurns) {
  // An encoder from 0 to 360 deg reads a turn too much below home.
  const transmission::Transmission law(testing::forearm());
  const double most = degrees(law.alpha_max());
  const auto wrapped = [](double value) { return value < 0 ? value + 360 : value; };
  std::string text = "alpha_deg,theta_deg\n";
  const std::vector<double> alphas = triangle(0.95 * most, 60, 4);
  for (const double alpha : alphas)
    text += shortest(wrapped(alpha)) + "," + shortest(wrapped(degrees(law.theta(radians(alpha))))) + "\n";
  Measurement measurement;
  measurement.runs.push_back(parse_run(text, "run.csv", {}, measurement));
  compare_with_declared(testing::forearm(), measurement);
  EXPECT_EQ(reasons_of(measurement), "");
  EXPECT_THAT(
      notes_of(measurement),
      HasSubstr(
          "the log begins whole turns away from the declared angles: added -360 deg to alpha and -360 deg to theta"));
  for (std::size_t i = 0; i < alphas.size(); ++i) {
    EXPECT_NEAR(degrees(measurement.runs[0].samples[i].alpha), alphas[i], 1e-9);
    EXPECT_NEAR(measurement.runs[0].samples[i].theta, law.theta(radians(alphas[i])), 1e-9);
  }
}

// The second run reads a turn less: −290° is 70° − 360°.
TEST(MeasurementAgainstDeclared, RatioRunsStartOnSameTurn) {
  Mechanism ratio;
  ratio.transmission = RatioTransmission{4.0};
  Measurement measurement;
  const std::string text = csv(triangle(40, 50, 4), [](double alpha) { return 70 + quarter(alpha); });
  measurement.runs.push_back(parse_run(text, "a.csv", {}, measurement));
  measurement.runs.push_back(parse_run(csv(triangle(40, 60, 4), [](double alpha) { return -290 + quarter(alpha); }),
                                       "b.csv", {}, measurement));
  compare_with_declared(ratio, measurement);
  EXPECT_EQ(reasons_of(measurement), "");
  EXPECT_NEAR(degrees(measurement.runs[0].samples[0].theta), 60, 1e-9);
  EXPECT_NEAR(degrees(measurement.runs[1].samples[0].theta), 60, 1e-9);
}

TEST(MeasurementAgainstDeclared, ReportsUnsetZero) {
  const transmission::Transmission law(testing::forearm());
  const double most = degrees(law.alpha_max());
  const auto reasons_with_offset = [&](double offset) {
    Measurement measurement;
    measurement.runs.push_back(parse_run(
        csv(triangle(0.9 * most, 60, 4), [&](double alpha) { return offset + degrees(law.theta(radians(alpha))); }),
        "run.csv", {}, measurement));
    compare_with_declared(testing::forearm(), measurement);
    return reasons_of(measurement);
  };
  EXPECT_EQ(reasons_with_offset(10), "");  // within the range of zero_offset
  EXPECT_THAT(reasons_with_offset(100), HasSubstr("theta is 100 deg away from the declared angle"));
}

TEST(MeasurementAgainstDeclared, MotionWithinNoiseNeedsLargerRange) {
  Measurement measurement;
  std::string text = "alpha_deg,theta_deg\n";
  const std::vector<double> alphas = triangle(0.05, 50, 4);
  for (std::size_t i = 0; i < alphas.size(); ++i)
    text += shortest(alphas[i]) + "," + shortest(0.1 * std::sin(12.9898 * static_cast<double>(i * i))) + "\n";
  measurement.runs.push_back(parse_run(text, "run.csv", {}, measurement));
  compare_with_declared(testing::forearm(), measurement);
  EXPECT_THAT(reasons_of(measurement), HasSubstr("use a larger range"));
}

// ---- input of simulations -------------------------------------------------------------------------------------------

std::filesystem::path written(const std::string& text) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("fusee-driving-" + std::to_string(::getpid()) + ".csv");
  std::ofstream(path) << text;
  return path;
}

TEST(Driving, NeedsNoTheta) {
  const DeclaredMechanism joint = testing::forearm();
  for (const char* text : {"time_s,alpha_deg,load_N\n0,1,5\n1,2,\n2,3,6\n",
                           "time_s,alpha_deg,load_N,theta_deg\n0,1,5,\n1,2,,\n2,3,6,\n"}) {
    const Measurement log = read_driving(written(text), joint);
    ASSERT_THAT(log.runs, SizeIs(1));
    ASSERT_THAT(log.runs[0].samples, SizeIs(3));
    EXPECT_DOUBLE_EQ(log.runs[0].samples[1].alpha, radians(2.0));
    EXPECT_EQ(log.runs[0].samples[1].load, 5) << "the load before";
    EXPECT_TRUE(std::isnan(log.runs[0].samples[1].theta));
    EXPECT_THAT(log.notes, SizeIs(1));  // that of the missing load
  }
}

// θ decides whether a jump of α by a turn is a motion, also where only every second row has a θ.
TEST(Driving, UnwrapsAlphaWithThetaInSomeRows) {
  const auto alpha_at_end = [](int jump, double theta_after) {
    std::string text = "alpha_deg,theta_deg\n";
    for (int row = 0; row < 40; ++row) {
      text += shortest(row < jump ? row : row + 360) + ",";
      if (row % 2 == 0) text += shortest(row < jump ? 0.1 * row : 0.1 * row + theta_after);
      text += "\n";
    }
    const Measurement log = read_driving(written(text), testing::forearm());
    return degrees(log.runs[0].samples.back().alpha);
  };
  for (const int jump : {19, 20}) {
    EXPECT_NEAR(alpha_at_end(jump, 90), 399, 1e-9) << "θ moves by 90°";
    EXPECT_NEAR(alpha_at_end(jump, 0), 39, 1e-9) << "θ stays: the encoder wraps";
  }
}

TEST(Driving, ConvertsTorqueToTipForce) {
  const DeclaredMechanism joint = testing::forearm();
  MeasurementOptions options;
  options.columns["load"] = "tau_Nm";
  const Measurement log = read_driving(written("alpha_deg,tau_Nm\n0,1\n1,1\n"), joint, options);
  EXPECT_DOUBLE_EQ(log.runs[0].samples[0].load, 1000.0 / joint.joint.R);
}

TEST(Driving, RequiresAlpha) {
  EXPECT_THROW(read_driving(written("alpha_deg\n\n"), testing::forearm()), InputError);
  EXPECT_THROW(read_driving(written("alpha_deg\nnan\n"), testing::forearm()), InputError);
}

TEST(UnfilledRuns, AreReported) {
  const ParsedRun run = parsed("time_s,alpha_deg,load_N,theta_deg\n0,1,5,\n1,2,5,\n2,3,5,\n");
  ASSERT_THAT(run.measurement.not_testable, SizeIs(1));
  EXPECT_THAT(run.measurement.not_testable[0], HasSubstr("no measured rows: theta is empty in all 3 rows"));
}

TEST(Mounting, IsConstantInRun) {
  const std::string head = "alpha_deg,theta_deg,joint_sensor_turned_deg\n";
  EXPECT_DOUBLE_EQ(parsed(head + "0,0,90\n1,0,\n2,0,90\n").run.mounting.joint_sensor_turned, radians(90.0));
  EXPECT_THAT(error_of(head + "0,0,90\n1,0,0\n"), HasSubstr("changes within the run"));
  EXPECT_EQ(parsed("alpha_deg,theta_deg\n0,0\n1,0\n").run.mounting, fusee::joint::Mounting{});
}

}  // namespace
}  // namespace fusee::measurement
