// One motion, written as loggers, spreadsheets and motor tools write it: different clocks, units and text. All must
// read as the same numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/text.h"
#include "fusee/measurement.h"
#include "measurement/cells.h"
#include "measurement/units.h"
#include "support/mechanisms.h"

namespace fusee::measurement {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr int k_rows = 401;

/// A joint of ratio 2 that swings five times, with 20 ms from row to row.
double time_of(int row) { return 0.02 * row; }
double alpha_of(int row) { return 60 * std::sin(k_two_pi * 5 * row / (k_rows - 1)) + 0.003; }
double theta_of(int row) { return 0.5 * alpha_of(row) + 0.001; }

using Value = std::function<std::string(int)>;
std::string number(double value) { return fixed(value, 6); }
std::string whole(double value) { return fixed(std::round(value), 0); }
Value seconds() {
  return [](int row) { return fixed(time_of(row), 3); };
}
Value alpha() {
  return [](int row) { return number(alpha_of(row)); };
}
Value theta() {
  return [](int row) { return number(theta_of(row)); };
}

/// A table of these values, rows `first` to `end`.
std::string table(const std::string& header, const std::vector<Value>& columns, char separator = ',', int first = 0,
                  int end = k_rows) {
  std::string text = header + "\n";
  for (int row = first; row < end; ++row) {
    for (std::size_t i = 0; i < columns.size(); ++i) text += (i > 0 ? std::string(1, separator) : "") + columns[i](row);
    text += "\n";
  }
  return text;
}

std::string plain() { return table("time_s,alpha_deg,theta_deg", {seconds(), alpha(), theta()}); }

struct ReadRun {
  Measurement measurement;
  Run run;
  std::string notes;
};

ReadRun read(const std::string& text, const MeasurementOptions& options = {}) {
  ReadRun result;
  result.run = parse_run(text, "run.csv", options, result.measurement);
  for (const std::string& note : result.measurement.notes) result.notes += note + "\n";
  return result;
}

std::string error_of(const std::string& text, const MeasurementOptions& options = {}) {
  try {
    read(text, options);
  } catch (const InputError& error) {
    std::string all;
    for (const Diagnostic& diagnostic : error.diagnostics()) all += to_text(diagnostic) + "\n";
    return all;
  }
  return "none";
}

/// Checks every row in order, from row `first` on; angles to `within` deg.
void expect_motion(const Run& run, double within = 1e-5, int first = 0) {
  ASSERT_EQ(run.samples.size(), static_cast<std::size_t>(k_rows - first));
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    const int row = static_cast<int>(i) + first;
    ASSERT_NEAR(degrees(run.samples[i].alpha), alpha_of(row), within) << row;
    ASSERT_NEAR(degrees(run.samples[i].theta), theta_of(row), within) << row;
    if (run.has_time) {
      ASSERT_NEAR(run.samples[i].time - run.samples[0].time, time_of(row) - time_of(first), 1e-6) << row;
    }
  }
}

MeasurementOptions with_columns(const std::map<std::string, std::string>& columns) {
  MeasurementOptions options;
  options.columns = columns;
  return options;
}

MeasurementOptions in_units(const std::map<std::string, std::string>& units) {
  MeasurementOptions options;
  options.units = units;
  return options;
}

std::size_t breaks_of(const Run& run) {
  std::size_t breaks = 0;
  for (const Sample& sample : run.samples) breaks += sample.after_break;
  return breaks;
}

// ---- clocks ---------------------------------------------------------------------------------------------------------

TEST(LoggedClock, ContinuesOverflowedCounter) {
  struct Counter {
    const char* name;
    double tick, size, start;  // s, counts, counts
  };
  for (const Counter& counter :
       {Counter{"time_us", 1e-6, 4294967296.0, 4294967296.0 - 3e6},
        Counter{"time_ms", 1e-3, 4294967296.0, 4294967296.0 - 4000}, Counter{"time_ms", 1e-3, 65536.0, 65536.0 - 4000},
        Counter{"time_us", 1e-6, 2147483648.0, 2147483648.0 - 3e6},
        Counter{"time_ms", 1e-3, 2147483648.0, 2147483648.0 - 4000}}) {
    const Value time = [&](int row) {
      return whole(std::fmod(counter.start + std::round(time_of(row) / counter.tick), counter.size));
    };
    const ReadRun found = read(table(std::string(counter.name) + ",alpha_deg,theta_deg", {time, alpha(), theta()}));
    expect_motion(found.run);
    EXPECT_EQ(breaks_of(found.run), 0u);
    EXPECT_THAT(found.notes, HasSubstr("the clock's counter ran over 1 time"));
  }
}

TEST(LoggedClock, ContinuesManyOverflows) {
  const Value time = [](int row) { return whole(std::fmod(std::round(1e6 * time_of(row)), 65536.0)); };
  const ReadRun found = read(table("time_us,alpha_deg,theta_deg", {time, alpha(), theta()}));
  expect_motion(found.run);
  EXPECT_EQ(breaks_of(found.run), 0u);
  EXPECT_THAT(found.notes, HasSubstr("the clock's counter ran over 122 times"));  // 8 s in periods of 65.536 ms
}

TEST(LoggedClock, MovesLateRowBackAfterOverflow) {
  constexpr double size = 4294967296.0, start = size - 3e6;  // overflows at row 150
  const auto reordered = [](const Value& value) {
    return [value](int row) { return value(row == 200 ? 201 : row == 201 ? 200 : row); };
  };
  const Value time = [](int row) { return whole(std::fmod(start + std::round(1e6 * time_of(row)), size)); };
  const ReadRun found =
      read(table("time_us,alpha_deg,theta_deg", {reordered(time), reordered(alpha()), reordered(theta())}));
  expect_motion(found.run);
  EXPECT_EQ(breaks_of(found.run), 0u);
  EXPECT_THAT(found.notes, HasSubstr("the clock's counter ran over 1 time"));
  EXPECT_THAT(found.notes, HasSubstr("1 row delivered late"));
}

TEST(LoggedClock, RestartBeginsNewMotion) {
  // Back to 0, to the middle of the log, and by less than a row.
  for (const double start : {0.0, 5.5, 8.975}) {
    const Value time = [&](int row) { return fixed(row < 200 ? 5 + time_of(row) : start + time_of(row - 200), 4); };
    const ReadRun found = read(table("time_s,alpha_deg,theta_deg", {time, alpha(), theta()}));
    ASSERT_THAT(found.run.samples, SizeIs(k_rows)) << start;
    expect_motion(found.run);
    EXPECT_EQ(breaks_of(found.run), 1u);
    EXPECT_TRUE(found.run.samples[200].after_break);
    EXPECT_THAT(found.notes, HasSubstr("the clock goes back 1 time, first from 8.98 to "));
  }
}

TEST(LoggedClock, SetBackKeepsRowOrder) {
  const Value time = [](int row) { return fixed(row < 200 ? time_of(row) : time_of(row) - 0.05, 3); };
  const ReadRun found = read(table("time_s,alpha_deg,theta_deg", {time, alpha(), theta()}));
  ASSERT_THAT(found.run.samples, SizeIs(k_rows));
  for (int row = 0; row < k_rows; ++row)
    EXPECT_NEAR(degrees(found.run.samples[static_cast<std::size_t>(row)].alpha), alpha_of(row), 1e-5);
  EXPECT_TRUE(found.run.samples[200].after_break);
}

TEST(LoggedClock, DropsUnusableClock) {
  const Value time = [](int row) { return fixed(std::fmod(7.31 * row, 50.0), 3); };
  const ReadRun found = read(table("time_s,alpha_deg,theta_deg", {time, alpha(), theta()}));
  EXPECT_FALSE(found.run.has_time);
  expect_motion(found.run);
  EXPECT_THAT(found.notes, HasSubstr("time is not used"));
}

TEST(LoggedClock, RestartMakesNextStrokePartial) {
  // The logger restarts in the middle of a stroke.
  const Value time = [](int row) { return fixed(row < 210 ? time_of(row) : time_of(row - 210), 3); };
  const ReadRun found = read(table("time_s,alpha_deg,theta_deg", {time, alpha(), theta()}));
  std::size_t partial = 0;
  for (const Stroke& stroke : found.run.strokes) {
    if (stroke.partial && stroke.first == 210) ++partial;
    EXPECT_FALSE(stroke.first < 210 && stroke.last >= 210);
  }
  EXPECT_EQ(partial, 1u);
}

TEST(LoggedTime, TakesUnitFromName) {
  const auto in = [](double unit) { return Value([unit](int row) { return fixed(time_of(row) / unit, 3); }); };
  for (const auto& [name, unit] : std::vector<std::pair<std::string, double>>{{"time_s", 1},
                                                                              {"Time [s]", 1},
                                                                              {"time", 1},
                                                                              {"Time[ms]", 1e-3},
                                                                              {"time_ms", 1e-3},
                                                                              {"time (us)", 1e-6},
                                                                              {"time [\xC2\xB5s]", 1e-6},
                                                                              {"timeMs", 1e-3},
                                                                              {"time_ns", 1e-9},
                                                                              {"%time", 1e-9},
                                                                              {"time_min", 60}}) {
    // Three decimals of a minute are too coarse.
    const Value value = unit == 60 ? Value([](int row) { return fixed(time_of(row) / 60, 9); }) : in(unit);
    const ReadRun found = read(table(name + ",alpha_deg,theta_deg", {value, alpha(), theta()}));
    ASSERT_TRUE(found.run.has_time) << name;
    expect_motion(found.run);
  }
  for (const auto& [name, unit] : std::vector<std::pair<std::string, double>>{
           {"millis", 1e-3}, {"Zeit in s", 1}, {"t [us]", 1e-6}, {"clock_ns", 1e-9}})
    expect_motion(
        read(table(name + ",alpha_deg,theta_deg", {in(unit), alpha(), theta()}), with_columns({{"time", name}})).run);
}

TEST(LoggedTime, InfersUnitOrRefuses) {
  const Value millis = [](int row) { return whole(1000 * time_of(row)); };
  const std::string text = table("time,alpha_deg,theta_deg", {millis, alpha(), theta()});
  EXPECT_THAT(error_of(text), HasSubstr("the unit of \"time\" is unknown: as s, the rows are 20 s apart"));
  EXPECT_THAT(error_of(text), HasSubstr("--unit time=ms"));
  expect_motion(read(text, in_units({{"time", "ms"}})).run);
  // 2025-03-01T10:00:00Z in ms since 1970.
  const Value epoch = [](int row) { return whole(1740823200000.0 + 1000 * time_of(row)); };
  const ReadRun found = read(table("time,alpha_deg,theta_deg", {epoch, alpha(), theta()}));
  expect_motion(found.run);
  EXPECT_THAT(found.notes, HasSubstr("time in ms since 1970"));
}

TEST(LoggedTime, ReportsImplausibleSteps) {
  const Value millis = [](int row) { return whole(1000 * time_of(row)); };
  const std::string text = table("time_s,alpha_deg,theta_deg", {millis, alpha(), theta()});
  EXPECT_THAT(read(text).notes, HasSubstr("the rows are 20 s apart: if the times are in ms"));
  EXPECT_THAT(read(plain()).notes, ::testing::Not(HasSubstr("s apart")));
}

TEST(LoggedTime, ReadsTimeStamps) {
  const auto stamp = [](const std::string& before, double start, char mark, const std::string& after) {
    return Value([=](int row) {
      const double time = start + time_of(row);
      const double minutes = std::floor(time / 60), rest = time - 60 * minutes;
      std::string text = fixed(rest, 3);
      text = (rest < 9.9995 ? "0" : "") + text;
      text[text.find('.')] = mark;
      const std::string minute = fixed(minutes, 0);
      return before + (minute.size() < 2 ? "0" : "") + minute + ":" + text + after;
    });
  };
  for (const Value& value : {stamp("2025-03-01T10:", 55, '.', "Z"), stamp("2025-03-01 10:", 0, '.', ""),
                             stamp("2024-02-29T23:", 3590, '.', "+01:00"), stamp("2025/12/31 10:", 3, '.', " -0500")}) {
    const std::string text = table("timestamp,alpha_deg,theta_deg", {value, alpha(), theta()});
    if (text.find(":60:") != std::string::npos) continue;
    expect_motion(read(text).run);
  }
  // A time of day over midnight.
  const Value of_day = [](int row) {
    const double time = 86396 + time_of(row);
    return time < 86400 ? "23:59:" + fixed(time - 86340, 3) : "00:00:0" + fixed(time - 86400, 3);
  };
  expect_motion(read(table("time,alpha_deg,theta_deg", {of_day, alpha(), theta()})).run);
  // A clock of 12 hours without its half of the day.
  const Value of_half_day = [](int row) {
    const double time = 3596 + time_of(row);
    return time < 3600 ? "12:59:" + fixed(time - 3540, 3) : "1:00:0" + fixed(time - 3600, 3);
  };
  const ReadRun half = read(table("time,alpha_deg,theta_deg", {of_half_day, alpha(), theta()}));
  expect_motion(half.run);
  EXPECT_EQ(breaks_of(half.run), 0u);
  // Excel's export of times with milliseconds.
  const Value of_hour = [](int row) {
    const double time = 3596 + time_of(row);
    return time < 3600 ? "59:" + fixed(time - 3540, 3) : "00:0" + fixed(time - 3600, 3);
  };
  expect_motion(read(table("time,alpha_deg,theta_deg", {of_hour, alpha(), theta()})).run);
  EXPECT_DOUBLE_EQ(*read_time_stamp("1970-01-02T00:00:01Z"), 86401);
  EXPECT_DOUBLE_EQ(*read_time_stamp("2025-03-01T10:00:00+02:00"), 1740816000);
  EXPECT_DOUBLE_EQ(*read_time_stamp("20250301T100000+0200"), 1740816000);  // the basic form of ISO 8601
  EXPECT_DOUBLE_EQ(*read_time_stamp("20240131T101500.125"), 1706696100.125);
  EXPECT_FALSE(read_time_stamp("20240131"));
  EXPECT_FALSE(read_time_stamp("20241331T101500"));
  EXPECT_FALSE(read_time_stamp("101500.125"));
  for (const char* const text : {"2025-03-01", "10", "2025-13-01T10:00:00", "10:61", "10:00:00x", "", "60:00.5",
                                 "32.01.2025 10:00", "01.13.2025 10:00", "13/13/2025 10:00", "1 dog 10:00"})
    EXPECT_FALSE(read_time_stamp(text)) << text;
}

TEST(LoggedTime, ReadsTimeStampsOfSpreadsheets) {
  const double morning = *read_time_stamp("2025-03-12T10:00:00.25");
  for (const char* const text : {"12.03.2025 10:00:00,250", "12.3.25 10:00:00.25", "12-Mar-2025 10:00:00.250",
                                 "12-M\xC3\xA4r-2025 10:00:00.250", "2025-03-12 10:00:00.25 am"})
    EXPECT_DOUBLE_EQ(*read_time_stamp(text), morning) << text;
  // The order of day and month is unknown: only the time of day counts.
  for (const char* const text : {"03/12/2025 10:00:00.25", "3/12/2025, 10:00:00.25 AM", "12/03/2025 10:00:00,25",
                                 "3-12-2025 10:00:00.25", "10:00:00.25 a.m.",
                                 "10:00:00.25\xE2\x80\xAF"
                                 "AM"})
    EXPECT_DOUBLE_EQ(*read_time_stamp(text), 36000.25) << text;
  EXPECT_DOUBLE_EQ(*read_time_stamp("12:00:01 AM"), 1);
  EXPECT_DOUBLE_EQ(*read_time_stamp("12:00:01 PM"), 43201);
  EXPECT_DOUBLE_EQ(*read_time_stamp("3/12/2025 1:02:03 PM"), 46923);
  EXPECT_DOUBLE_EQ(*read_time_stamp("1 days 00:00:01.500000"), 86401.5);
  EXPECT_DOUBLE_EQ(*read_time_stamp("0 days 00:00:00"), 0);
  EXPECT_DOUBLE_EQ(*read_time_stamp("59:50.5"), 3590.5);
}

// Serial numbers of Excel and MATLAB count days: 45717.4 is the morning of 2025-03-01 in Excel.
TEST(LoggedTime, RefusesDaysTakenForSeconds) {
  const Value days = [](int row) { return fixed(45717.4 + time_of(row) / 86400, 11); };
  const std::string text = table("time,alpha_deg,theta_deg", {days, alpha(), theta()});
  EXPECT_THAT(error_of(text), HasSubstr("the unit of \"time\" is unknown: as s, the rows are 2.3"));
  EXPECT_THAT(error_of(text), HasSubstr("--unit time=d"));
  EXPECT_TRUE(read(text, in_units({{"time", "d"}})).run.has_time);
}

TEST(LoggedTime, ReportsUnknownUnitOfName) {
  const ReadRun found = read(table("time_jiffies,alpha_deg,theta_deg", {seconds(), alpha(), theta()}));
  EXPECT_FALSE(found.run.has_time);
  EXPECT_THAT(found.notes, HasSubstr("column \"time_jiffies\" is not used: \"jiffies\" is no unit of time"));
}

// ---- angles ---------------------------------------------------------------------------------------------------------

Value scaled(const std::function<double(int)>& angle, double per_degree, int decimals) {
  return [=](int row) { return fixed(angle(row) * per_degree, decimals); };
}

TEST(LoggedAngles, TakeUnitFromName) {
  struct AngleNames {
    const char *alpha, *theta;
    double per_degree;
  };
  for (const AngleNames& written :
       {AngleNames{"alpha [rad]", "theta [rad]", radians(1.0)}, AngleNames{"alpha_rad", "theta_rad", radians(1.0)},
        AngleNames{"Alpha (deg)", "Theta (deg)", 1}, AngleNames{"alpha [\xC2\xB0]", "theta in \xC2\xB0", 1},
        AngleNames{"alpha_mdeg", "theta_mdeg", 1000}, AngleNames{"alpha_turns", "theta [rev]", 1.0 / 360},
        AngleNames{"alphaMrad", "theta mrad", 1000 * radians(1.0)}, AngleNames{"alpha_arcmin", "theta [arcsec]", 0},
        AngleNames{"alpha_gon", "theta_gon", 1 / 0.9}, AngleNames{"alpha [gradi]", "theta [grados]", 1}}) {
    const std::string header = std::string("time_s,") + written.alpha + "," + written.theta;
    const double of_alpha = written.per_degree > 0 ? written.per_degree : 60;  // arc minutes
    const double of_theta = written.per_degree > 0 ? written.per_degree : 3600;
    expect_motion(read(table(header, {seconds(), scaled(alpha_of, of_alpha, 9), scaled(theta_of, of_theta, 9)})).run);
  }
  expect_motion(
      read(table("time_s,motor,joint", {seconds(), scaled(alpha_of, radians(1.0), 9), scaled(theta_of, 1000, 3)}),
           [] {
             MeasurementOptions options = with_columns({{"alpha", "motor"}, {"theta", "joint"}});
             options.units = {{"alpha", "rad"}, {"theta", "mdeg"}};
             return options;
           }())
          .run);
  EXPECT_THAT(error_of("alpha [furlong],theta_deg\n1,2\n"), HasSubstr("the unit of \"alpha [furlong]\" is unknown"));
}

Value counts(const std::function<double(int)>& angle, double per_turn, double zero, double size = 0) {
  return [=](int row) {
    const double value = std::round(angle(row) / 360 * per_turn) + zero;
    return fixed(size > 0 ? value - size * std::floor(value / size) : value, 0);
  };
}

TEST(LoggedAngles, ReadCounts) {
  MeasurementOptions options;
  options.ticks_per_turn = {{"alpha", 4096}, {"theta", -16384}};
  options.zero_ticks = {{"alpha", 100}, {"theta", 2048}};
  // Single turns that wrap, and counters of 16 and 32 bits that run over.
  for (const double size : {4096.0, 65536.0, 4294967296.0}) {
    const std::string text = table(
        "time_s,alpha,theta", {seconds(), counts(alpha_of, 4096, 100, size), counts(theta_of, -16384, 2048, 4 * size)});
    const ReadRun found = read(text, options);
    ASSERT_THAT(found.run.samples, SizeIs(k_rows));
    const double turns = k_two_pi * std::round((found.run.samples[0].alpha - radians(alpha_of(0))) / k_two_pi);
    for (int row = 0; row < k_rows; ++row) {
      const Sample& sample = found.run.samples[static_cast<std::size_t>(row)];
      ASSERT_NEAR(degrees(sample.alpha - turns), alpha_of(row), 0.05) << row;
      ASSERT_NEAR(degrees(sample.theta), theta_of(row), 0.02) << row;
    }
    EXPECT_THAT(found.notes, HasSubstr("alpha in counts of 4096 a turn, 100 at home"));
    EXPECT_THAT(found.notes, HasSubstr("theta in counts of 16384 a turn, falling, 2048 at home"));
  }
}

TEST(LoggedAngles, StartAtReadingOfHome) {
  MeasurementOptions options;
  options.home_readings = {{"alpha", 0.25}, {"theta", 153.2}};
  const auto plus = [](double (*angle)(int), double factor, double zero) {
    return [=](int row) { return fixed(angle(row) * factor + zero, 6); };
  };
  const ReadRun found = read(
      table("time_s,alpha_turns,theta_deg", {seconds(), plus(alpha_of, 1.0 / 360, 0.25), plus(theta_of, 1, 153.2)}),
      options);
  ASSERT_THAT(found.run.samples, SizeIs(k_rows));
  for (int row = 0; row < k_rows; ++row) {
    const Sample& sample = found.run.samples[static_cast<std::size_t>(row)];
    ASSERT_NEAR(degrees(sample.alpha), alpha_of(row), 4e-4) << row;
    ASSERT_NEAR(degrees(sample.theta), theta_of(row), 1e-6) << row;
  }
  EXPECT_THAT(found.notes, HasSubstr("theta: the sensor reads 153.2 deg at home"));
  MeasurementOptions both = options;
  both.zero_ticks = {{"theta", 100}};
  EXPECT_THAT(error_of("alpha_deg,theta_deg\n1,2\n", both), HasSubstr("two readings of theta at home"));
}

/// 3.3 V over 270°, half of it at home.
TEST(LoggedAngles, ReadVoltsOfTurn) {
  const auto volts = [](int row) { return fixed(1.65 + theta_of(row) / 270 * 3.3, 6); };
  for (const char* const name : {"pot_V", "joint [V]", "theta (volts)"}) {
    const std::string text = table(std::string("t,motor_deg,") + name, {seconds(), alpha(), volts});
    MeasurementOptions options = with_columns({{"theta", name}});
    EXPECT_THAT(error_of(text, options), HasSubstr("is a voltage, and theta an angle"));
    options.ticks_per_turn = {{"theta", 4.4}};
    options.home_readings = {{"theta", 1.65}};
    const ReadRun found = read(text, options);
    EXPECT_TRUE(found.run.has_time);
    for (int row = 0; row < k_rows; ++row)
      ASSERT_NEAR(degrees(found.run.samples[static_cast<std::size_t>(row)].theta), theta_of(row), 1e-3) << row;
  }
}

TEST(LoggedAngles, ReportUnitOfWholeNumbers) {
  const MeasurementOptions roles = with_columns({{"alpha", "motor"}, {"theta", "joint"}});
  const auto logged = [](double per_turn, double zero, double size = 0) {
    return table("time_s,motor,joint",
                 {seconds(), counts(alpha_of, per_turn, zero, size), counts(theta_of, per_turn, zero, size)});
  };
  const ReadRun found = read(logged(4096, 2048), roles);
  EXPECT_NEAR(degrees(found.run.samples[100].alpha - found.run.samples[0].alpha), alpha_of(100) - alpha_of(0), 0.1);
  EXPECT_THAT(found.notes, HasSubstr("taken as counts of 4096 a turn (--ticks-per-turn alpha=N overrides this)"));
  MeasurementOptions home = roles;
  home.zero_ticks = {{"alpha", 2048}, {"theta", 2048}};
  const ReadRun from_home = read(logged(4096, 2048), home);
  EXPECT_NEAR(degrees(from_home.run.samples[100].alpha), alpha_of(100), 0.05);
  EXPECT_NEAR(degrees(from_home.run.samples[100].theta), theta_of(100), 0.05);
  EXPECT_THAT(from_home.notes, HasSubstr("taken as counts of 4096 a turn, 2048 at home (--ticks-per-turn"));
  const std::string fractions = table("time_s,motor,joint", {seconds(), alpha(), theta()});
  EXPECT_THAT(error_of(fractions, home), HasSubstr("which are no counts of an encoder"));
  const ReadRun wrapped = read(logged(2000, 100, 2000), roles);
  EXPECT_THAT(wrapped.notes, HasSubstr("taken as counts of 2000 a turn"));
  EXPECT_THAT(error_of(logged(20000, 0), roles), HasSubstr("which look like counts of an encoder"));
  EXPECT_THAT(error_of(logged(20000, 0), roles), HasSubstr("--ticks-per-turn alpha=4096"));
  const ReadRun degrees_read = read(logged(360, 0), roles);
  EXPECT_THAT(degrees_read.notes, HasSubstr("alpha taken as deg, as the name \"motor\" states no unit"));
  const ReadRun with_unit = read(
      table("time_s,alpha_deg,theta_deg", {seconds(), counts(alpha_of, 4096, 2048), counts(theta_of, 4096, 2048)}));
  EXPECT_THAT(with_unit.notes, HasSubstr("read as degrees; if they are counts, --ticks-per-turn alpha=4096"));
}

TEST(LoggedAngles, InferUnitFromDeclaredRange) {
  const DeclaredMechanism joint = testing::forearm();
  const MeasurementOptions expected = expecting(joint, with_columns({{"alpha", "motor"}, {"theta", "joint"}}));
  ASSERT_GT(expected.alpha_span, 1);
  for (const auto& [unit, factor] : std::vector<std::pair<std::string, double>>{{"deg", 1}, {"rad", radians(1.0)}}) {
    const double size = 0.4 * degrees(expected.alpha_span) / 60, of_theta = 0.4 * degrees(expected.theta_span) / 30;
    const ReadRun found = read(table("time_s,motor,joint", {seconds(), scaled(alpha_of, size * factor, 9),
                                                            scaled(theta_of, of_theta * factor, 9)}),
                               expected);
    EXPECT_NEAR(degrees(found.run.samples[20].alpha), size * alpha_of(20), 1e-5) << unit;
    EXPECT_THAT(found.notes, HasSubstr("theta taken as " + unit));
  }
  // ROS positions, over several turns of a motor.
  const ReadRun ros = read(
      table("time_s,motor_position,joint_position", {seconds(), scaled(alpha_of, 0.2, 9), scaled(theta_of, 0.2, 9)}),
      with_columns({{"alpha", "motor_position"}, {"theta", "joint_position"}}));
  EXPECT_NEAR(ros.run.samples[20].alpha, 0.2 * alpha_of(20), 1e-6);
  EXPECT_THAT(ros.notes, HasSubstr("alpha taken as rad"));
  // A joint does not turn ten times.
  const ReadRun servos = read(table("time_s,position,joint_position", {seconds(), alpha(), theta()}),
                              with_columns({{"alpha", "position"}, {"theta", "joint_position"}}));
  expect_motion(servos.run);
  EXPECT_THAT(servos.notes, HasSubstr("alpha taken as deg"));
}

// ---- loads ----------------------------------------------------------------------------------------------------------

TEST(LoggedLoads, ConvertUnits) {
  struct LoadName {
    const char* name;
    double load;  // of 1 in its unit
    const char* in;
  };
  for (const LoadName& written :
       {LoadName{"load_N", 1, "N"}, LoadName{"load_kg", 9.80665, "N"}, LoadName{"load [g]", 9.80665e-3, "N"},
        LoadName{"load [lbf]", 4.4482216152605, "N"}, LoadName{"load_lb", 4.4482216152605, "N"},
        LoadName{"load (kN)", 1000, "N"}, LoadName{"load_oz", 0.27801385095378125, "N"}, LoadName{"load_Nm", 1, "Nm"},
        LoadName{"load_Nmm", 1, "Nmm"}, LoadName{"load [N\xC2\xB7m]", 1, "Nm"}, LoadName{"load [N*mm]", 1, "Nmm"},
        LoadName{"load_Ncm", 10, "Nmm"}, LoadName{"load_mNm", 1, "Nmm"}, LoadName{"load [kgf*cm]", 98.0665, "Nmm"},
        LoadName{"load_kg_cm", 98.0665, "Nmm"}, LoadName{"load [oz-in]", 7.061551814226043, "Nmm"},
        LoadName{"load (lb in)", 112.9848290276167, "Nmm"}, LoadName{"load [ft.lbf]", 1355.8179483314, "Nmm"}}) {
    for (const MeasurementOptions& options : {MeasurementOptions{}, with_columns({{"load", written.name}})}) {
      const ReadRun found = read(table(std::string("time_s,alpha_deg,theta_deg,") + written.name,
                                       {seconds(), alpha(), theta(), [](int) { return "2"; }}),
                                 options);
      ASSERT_TRUE(found.run.has_load) << written.name;
      EXPECT_NEAR(found.run.samples[7].load, 2 * written.load, 1e-9 * written.load) << written.name;
      EXPECT_EQ(found.measurement.load_unit, written.in) << written.name;
    }
  }
}

TEST(LoggedLoads, RequireOneUnit) {
  const auto logged = [](const std::string& name) {
    return table("alpha_deg,theta_deg," + name, {alpha(), theta(), [](int) { return "2"; }});
  };
  Measurement measurement;
  EXPECT_EQ(parse_run(logged("load_Nmm"), "a.csv", {}, measurement).samples[3].load, 2);
  const fusee::measurement::Run second = parse_run(logged("load_Nm"), "b.csv", {}, measurement);
  EXPECT_EQ(second.samples[3].load, 2000);
  EXPECT_NEAR(second.mean_load, 2000, 1e-9);
  EXPECT_EQ(measurement.load_unit, "Nmm");
  EXPECT_THROW(parse_run(logged("load_kg"), "c.csv", {}, measurement), InputError);
}

TEST(LoggedLoads, RejectUnknownUnit) {
  const auto logged = [](const std::string& name) {
    return table("alpha_deg,theta_deg," + name, {alpha(), theta(), [](int) { return "2"; }});
  };
  EXPECT_THAT(error_of(logged("load [stone]")), HasSubstr("the unit of \"load [stone]\" is unknown: \"stone\""));
  EXPECT_THAT(error_of(logged("load_stone"), with_columns({{"load", "load_stone"}})), HasSubstr("units: N, mN, cN"));
  EXPECT_THAT(error_of(logged("pull"), in_units({{"load", "stone"}})), HasSubstr("there is no unit \"stone\" of load"));
  EXPECT_THAT(read(logged("load_cell")).notes, HasSubstr("column \"load_cell\" is not used"));
  EXPECT_THAT(read(logged("pull_N")).notes,
              HasSubstr("column \"pull_N\" is not used: if it is the load, add --column load=pull_N"));
  EXPECT_EQ(read(logged("pull_N"), with_columns({{"load", "pull_N"}})).notes, read(logged("load_N")).notes);
  EXPECT_EQ(read(logged("tension1_N")).notes, read(logged("load_N")).notes);
  const ReadRun bare = read(logged("pull"), with_columns({{"load", "pull"}}));
  EXPECT_THAT(bare.notes, HasSubstr("load: taken as N, as the name \"pull\" states no unit"));
  EXPECT_THAT(error_of("alpha_deg,theta_deg,tension1_Nm\n1,2,3\n", with_columns({{"tension1", "tension1_Nm"}})),
              HasSubstr("is a torque"));
}

TEST(LoggedLoads, RejectGramsTakenAsNewtons) {
  const auto logged = [](const std::string& name, const std::string& load) {
    return table("alpha_deg,theta_deg," + name, {alpha(), theta(), [load](int) { return load; }});
  };
  MeasurementOptions finger = with_columns({{"load", "Last"}});
  finger.tip_force = finger.load_scale = 10;
  const std::string message = error_of(logged("Last", "200"), finger);
  EXPECT_THAT(message, HasSubstr("the unit of \"Last\" is unknown: it reaches 200: as N, 20 times the declared load of "
                                 "10 N"));
  EXPECT_THAT(message, HasSubstr("state the unit: --unit load=g (200 g is 1.96 N), or --unit load=N"));
  EXPECT_THAT(error_of(logged("Last", "0.5"), finger), HasSubstr("--unit load=kg (0.5 kg is 4.9 N)"));
  EXPECT_EQ(error_of(logged("Last", "12"), finger), "none");
  finger.units = {{"load", "N"}};
  EXPECT_EQ(read(logged("Last", "200"), finger).run.samples[3].load, 200);
  finger.units = {{"load", "g"}};
  EXPECT_NEAR(read(logged("Last", "200"), finger).run.samples[3].load, 1.96133, 1e-9);
  // A stated unit is trusted, with a note.
  MeasurementOptions stated;
  stated.tip_force = stated.load_scale = 10;
  const ReadRun far = read(logged("load_N", "200"), stated);
  EXPECT_EQ(far.run.samples[3].load, 200);
  EXPECT_THAT(far.notes, HasSubstr("load: \"load_N\" reaches 200 N, 20 times the declared load of 10 N"));
}

TEST(LoggedLoads, ReportUnusedColumnsAndAssumedLoad) {
  const auto logged = [](const std::string& name) {
    return table("alpha_deg,theta_deg," + name, {alpha(), theta(), [](int) { return "2"; }});
  };
  MeasurementOptions finger;
  finger.tip_force = finger.load_scale = 10;
  for (const std::string name : {"Last", "Kraft", "force", "carga"})
    EXPECT_THAT(read(logged(name), finger).notes,
                HasSubstr("column \"" + name +
                          "\" is not used, and the load of the file, 10 N, is assumed: if it is the load, add "
                          "--column load=" +
                          name + " --unit load=N, or its unit"));
  for (const std::string name : {"Last (N)", "Belastung_N", "carga [N]"}) {
    const ReadRun found = read(logged(name), finger);
    EXPECT_EQ(found.run.samples[3].load, 2) << name;
    EXPECT_THAT(found.notes, HasSubstr("load: taken from the column \"" + name + "\", by its name"));
  }
  EXPECT_THAT(read(logged("battery")).measurement.sources,
              ElementsAre("run.csv: columns that are not used: \"battery\""));
  EXPECT_THAT(read(logged("load_N")).measurement.sources, ElementsAre());
}

// ---- text -----------------------------------------------------------------------------------------------------------

TEST(LoggedText, ReadsQuotesOfRfc4180) {
  const std::string remark = "\"he said \"\"stop\"\",\nand it; stopped\"";
  const ReadRun found = read(table("time_s,\"Motor, deg\",\"Joint, deg\",remark",
                                   {seconds(), alpha(), theta(), [&](int row) { return row == 7 ? remark : "\"\""; }}),
                             with_columns({{"alpha", "Motor, deg"}, {"theta", "Joint, deg"}}));
  expect_motion(found.run);
  EXPECT_EQ(found.notes, read(plain()).notes);
  // A quotation mark within a cell opens no quoted text.
  expect_motion(read(table("time_s,alpha_deg,theta_deg,5\" arm",
                           {seconds(), alpha(), theta(), [](int) { return std::string("7\" long"); }}))
                    .run);
  EXPECT_THAT(error_of("alpha_deg,theta_deg,note\n1,2,\"x\n3,4,y\n"),
              HasSubstr("run.csv:2:1: error: the quotation mark that opens a cell here is never closed"));
  // Lines are counted through a quoted cell.
  EXPECT_THAT(error_of("alpha_deg,theta_deg,note\n1,2,\"x\n\ny\"\n3,z,y\n"), HasSubstr("run.csv:5:3: error"));
}

TEST(LoggedText, ReadsCommentsAtLineBeginning) {
  expect_motion(read(table("# of a bench\nsample #,time_s,alpha_deg,theta_deg,remark",
                           {[](int row) { return std::to_string(row); }, seconds(), alpha(), theta(),
                            [](int row) { return "#" + std::to_string(row); }}))
                    .run);
}

TEST(LoggedText, SkipsPreamble) {
  const std::string body = plain();
  for (const char* const above : {"Logger,v2.1\nDate,2025-03-01\n\n", "Record Length,2500\n1,2\n3,4\n",
                                  "A \"new\" bench; by, me\n", "sep=,\n", "\"sep=,\"\r\n"}) {
    const ReadRun found = read(above + body);
    expect_motion(found.run);
    if (std::string(above).find("sep") == std::string::npos) {
      EXPECT_THAT(found.notes, HasSubstr("the header is line ")) << above;
    }
  }
  const std::string wizard =
      "DYNAMIXEL Graph,3,,,\nItemCount,3,,,\n-1,5,XX,Present Position,#ffff00\n" +
      table("Time[ms],Realtime Tick,Present Position,Goal Position,",
            {[](int row) { return whole(1000 * time_of(row)); }, [](int) { return "1"; }, counts(theta_of, 4096, 2048),
             counts(alpha_of, 4096, 2048), [](int) { return ""; }});
  const ReadRun found = read(wizard, with_columns({{"alpha", "Goal Position"}, {"theta", "Present Position"}}));
  ASSERT_THAT(found.run.samples, SizeIs(k_rows));
  EXPECT_NEAR(degrees(found.run.samples[20].alpha) - 180, alpha_of(20), 0.05);
  EXPECT_THAT(found.notes, HasSubstr("the header is line 4"));
  // Without known names, the likeliest header is the one reported.
  EXPECT_THAT(error_of("Logger,v2\nOperator,me\ntime_s,left,right\n0,1,2\n1,2,3\n"),
              HasSubstr("run.csv:3:1: error: there is no column alpha_deg"));
}

TEST(ColumnNames, ChooseAnglesByWords) {
  for (const auto& [names, alpha_name, theta_name] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"time_s,motor_deg,joint_deg", "motor_deg", "joint_deg"},
           {"time_s,Motor,Gelenk", "Motor", "Gelenk"},
           {"Zeit,Motor,Gelenk", "Motor", "Gelenk"},
           {"temps,moteur,articulation", "moteur", "articulation"},
           {"tempo,motore,giunto", "motore", "giunto"},
           {"tijd,motorhoek,gewrichtshoek", "motorhoek", "gewrichtshoek"},
           {"tiempo,motor,articulaci\xC3\xB3n", "motor", "articulaci\xC3\xB3n"},
           {"time_s,servo,pot", "servo", "pot"},
           {"time_s,servo_cmd,joint", "servo_cmd", "joint"},
           {"time_s,servoAngle,A0", "servoAngle", "A0"},
           {"time_s,encoder,elbow", "encoder", "elbow"},
           {"time_s,motor_pos,joint_pos", "motor_pos", "joint_pos"},
           {"time_s,alpha_deg,pot", "alpha_deg", "pot"}}) {
    const ReadRun found = read(table(names, {seconds(), alpha(), theta()}));
    expect_motion(found.run);
    if (alpha_name != "alpha_deg") {
      EXPECT_THAT(found.notes, HasSubstr("alpha: taken from the column \"" + alpha_name + "\"")) << names;
    }
    EXPECT_THAT(found.notes, HasSubstr("theta: taken from the column \"" + theta_name + "\"")) << names;
  }
  // Columns of other quantities and commands beside a sensor.
  const auto zero = [](int) { return "0"; };
  const ReadRun found = read("Rig 3\n" + table("time_s;setpoint;motor_deg;motor_current;motor_rpm;joint_deg;joint_Nm",
                                               {seconds(), zero, alpha(), zero, zero, theta(), zero}, ';'));
  expect_motion(found.run);
  EXPECT_THAT(found.notes, HasSubstr("the header is line 2"));
  // Under the stamps of a serial monitor.
  std::string stamped = "10:00:00.000 -> servo,pot\n";
  for (int row = 0; row < k_rows; ++row)
    stamped += "10:00:" + fixed(10 + time_of(row), 3) + " -> " + alpha()(row) + "," + theta()(row) + "\n";
  EXPECT_TRUE(read(stamped).run.has_time);
  expect_motion(read(stamped).run);
}

TEST(ColumnNames, ReadGreekLettersAndClocks) {
  const ReadRun greek = read(table("t [s],\u03B1 [\u00B0],\u03B8 [\u00B0]", {seconds(), alpha(), theta()}));
  expect_motion(greek.run);
  EXPECT_TRUE(greek.run.has_time);
  const auto scaled_time = [](double size) { return [size](int row) { return whole(size * time_of(row)); }; };
  for (const auto& [clock, size] : std::vector<std::pair<std::string, double>>{
           {"millis", 1e3}, {"millis()", 1e3}, {"micros", 1e6}, {"ms", 1e3}, {"t_us", 1e6}}) {
    const ReadRun read_clock = read(table(clock + ",motor_deg,joint_deg", {scaled_time(size), alpha(), theta()}));
    expect_motion(read_clock.run);
    EXPECT_TRUE(read_clock.run.has_time) << clock;
    EXPECT_NEAR(read_clock.run.samples[100].time - read_clock.run.samples[0].time, 2.0, 1e-9) << clock;
  }
  const auto stamp = [](int row) { return "01.11.2026 10:00:" + fixed(10 + time_of(row), 3); };
  EXPECT_TRUE(read(table("Zeitstempel,alpha_deg,theta_deg", {stamp, alpha(), theta()})).run.has_time);
}

TEST(ColumnNames, ChooseAnglesAboveDecimalCommas) {
  const auto with_comma = [](const Value& value) {
    return [value](int row) {
      std::string text = value(row);
      std::replace(text.begin(), text.end(), '.', ',');
      return text;
    };
  };
  expect_motion(
      read(table("Zeit;Motor;Gelenk", {with_comma(seconds()), with_comma(alpha()), with_comma(theta())}, ';')).run);
}

TEST(ColumnNames, OfferTheAngleThatIsKnown) {
  EXPECT_THAT(error_of(table("time_s,Motor,xyz", {seconds(), alpha(), theta()})),
              HasSubstr("select them with --column alpha=Motor --column theta=NAME"));
}

TEST(ColumnNames, GiveTheOptionThatReadsAmbiguousAngles) {
  for (const auto& [names, options] : std::vector<std::pair<std::string, std::map<std::string, std::string>>>{
           {"time_s,encoder,pot", {{"alpha", "encoder"}, {"theta", "pot"}}},
           {"time_s,A0,A1", {{"alpha", "A0"}, {"theta", "A1"}}},
           {"time_s,motor 1,joint", {{"alpha", "motor 1"}, {"theta", "joint"}}},
           {"time_s,setpoint,joint", {{"alpha", "setpoint"}, {"theta", "joint"}}},
           {"time_s,Goal angle,Present angle", {{"alpha", "Goal angle"}, {"theta", "Present angle"}}}}) {
    const bool two_motors = names == "time_s,motor 1,joint";
    const std::string text = two_motors ? table(names + ",motor 2", {seconds(), alpha(), theta(), alpha()})
                                        : table(names, {seconds(), alpha(), theta()});
    const std::string error = error_of(text);
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 2) << error;  // one message, one hint
    std::string words;
    for (const auto& [role, name] : options)
      words += " --column " + role + "=" + (name.find(' ') == std::string::npos ? name : '"' + name + '"');
    EXPECT_THAT(error, HasSubstr("add" + words + " if "));
    expect_motion(read(text, with_columns(options)).run);
  }
  EXPECT_THAT(error_of(table("time_s,left,right", {seconds(), alpha(), theta()})),
              HasSubstr("there is no column alpha_deg and no theta_deg"));
}

TEST(LoggedText, ReadsRowNames) {
  // write.csv() of R.
  std::string text = R"("","time_s","alpha_deg","theta_deg")";
  for (int row = 0; row < k_rows; ++row)
    text += "\n\"" + std::to_string(row + 1) + "\"," + seconds()(row) + "," + alpha()(row) + "," + theta()(row);
  expect_motion(read(text + "\n").run);
  // write.table() of R names one column less.
  std::replace(text.begin(), text.end(), ',', ' ');
  EXPECT_THAT(error_of("\"time_s\"" + text.substr(text.find(" \"alpha")) + "\n"),
              HasSubstr("name every column, also one of row numbers"));
}

TEST(LoggedText, ReplacesHeaderOfProse) {
  const ReadRun found = read("alpha and theta of a bench\n" + plain());
  expect_motion(found.run);
  EXPECT_THAT(found.notes, HasSubstr("the header is line 2"));
  // A comment of MATLAB keeps the time.
  EXPECT_TRUE(read("% " + plain()).run.has_time);
  EXPECT_EQ(read("% " + plain()).notes, read(plain()).notes);
}

// Copied from the serial monitor of Arduino's IDE or PlatformIO.
TEST(LoggedTime, ReadsStampsOfSerialMonitors) {
  for (const char* const arrow : {" -> ", " > "}) {
    const std::string header = "10:00:00.000" + std::string(arrow) + "alpha_deg,theta_deg\n";
    std::string text = "09:59:59.500" + std::string(arrow) + "Ready.\n" + header;
    for (int row = 0; row < k_rows; ++row) {
      if (row == 200) text += header;
      text += "10:00:0" + fixed(time_of(row), 3) + arrow + alpha()(row) + "," + theta()(row) + "\n";
    }
    const ReadRun found = read(text);
    ASSERT_TRUE(found.run.has_time);
    expect_motion(found.run);
    EXPECT_EQ(breaks_of(found.run), 1u);
  }
}

TEST(LoggedText, TakesUnitsBelowHeader) {
  const std::vector<Value> columns = {[](int row) { return whole(1000 * time_of(row)); },
                                      [](int row) { return fixed(radians(alpha_of(row)), 9); },
                                      [](int row) { return fixed(radians(theta_of(row)), 9); }};
  for (const char* const units : {"ms,rad,rad", "[ms],[rad],[rad]", "(milliseconds),(Radian),(Radian)"}) {
    const ReadRun found = read(table(std::string("time,alpha,theta\n") + units, columns));
    expect_motion(found.run);
    EXPECT_THAT(found.notes, HasSubstr("line 2 has the units of the columns")) << units;
  }
  const std::string load = "time_s,alpha_deg,theta_deg,load\ns,deg,deg,kg\n0,1,2,3\n";
  EXPECT_NEAR(read(load).run.samples.at(0).load, 3 * 9.80665, 1e-12);
  EXPECT_THAT(read(load).notes, ::testing::Not(HasSubstr("taken as N")));
  EXPECT_THAT(error_of(table("time,alpha_deg,theta\nms,rad,rad", columns)),
              HasSubstr("run.csv:2:4: error: alpha_deg is in deg by its name, but in rad by the line below it"));
  // Again after a restart.
  const std::string head = "time,alpha,theta\nms,rad,rad";
  const ReadRun again = read(table(head, columns, ',', 0, 200) + table(head, columns, ',', 200));
  expect_motion(again.run);
  EXPECT_EQ(breaks_of(again.run), 1u);
}

TEST(LoggedText, ReadsRaggedSeparators) {
  const std::vector<Value> columns = {seconds(), alpha(), theta()};
  const std::vector<Value> padded = {seconds(), alpha(), theta(), [](int) { return ",,"; }};
  expect_motion(read(table("time_s,alpha_deg,theta_deg", padded)).run);
  expect_motion(read(table("time_s,alpha_deg,theta_deg,,,", columns)).run);
  EXPECT_THAT(
      error_of(table("time_s;alpha_deg;theta_deg", columns, '\t')),
      HasSubstr("the row has 1 values, the header 3, and so in 399 rows below"));  // the last one may be truncated
  EXPECT_THAT(error_of(table("time_s;alpha_deg;theta_deg", columns, '\t')),
              HasSubstr("separate the values by the same mark as the names"));
}

TEST(LoggedText, OmitsPaddingAtEnd) {
  for (const std::string& padding : {std::string(3, '\0'), std::string(200'000, '\0'), std::string("\x1A")}) {
    const ReadRun found = read(plain() + padding);
    expect_motion(found.run);
    EXPECT_THAT(found.notes, HasSubstr("zero bytes at the end (line 403): the log was not closed, they are omitted"));
  }
  EXPECT_THAT(error_of(plain() + std::string(5, '\0') + "\n8.1,2,1\n"),
              HasSubstr("run.csv:403:1: error: contains binary bytes"));
  // Only the padding of the last line is the log's end, also if that line has text of its own.
  EXPECT_THAT(error_of(plain() + std::string(5, '\0') + "\n8.1,2,1" + std::string(5, '\0')),
              HasSubstr("run.csv:403:1: error: contains binary bytes"));
}

TEST(LoggedText, ReadsTypesetNumbers) {
  const auto marked = [](const Value& value, const std::string& mark) {
    return Value([=](int row) {
      std::string text = value(row);
      const std::size_t point = text.find('.');
      const std::size_t end = point == std::string::npos ? text.size() : point;
      if (end > 3 && text[end - 4] != '-') text.insert(end - 3, mark);
      return text;
    });
  };
  const Value millis = [](int row) { return whole(1000 * time_of(row)); };
  for (const char* const mark : {" ", "\xC2\xA0", "\xE2\x80\xAF", "'", "\xE2\x80\x99"})
    expect_motion(read(table("time_ms;alpha_deg;theta_deg", {marked(millis, mark), alpha(), theta()}, ';')).run);
  for (const char* const minus : {"\xE2\x88\x92", "\xE2\x80\x93", "\x96"}) {
    std::string text = plain();
    for (std::size_t at = text.find('-'); at != std::string::npos; at = text.find('-')) text.replace(at, 1, minus);
    expect_motion(read(text).run);
  }
  EXPECT_THAT(error_of("alpha_deg;theta_deg\n1 2;3\n"), HasSubstr("\"1 2\" is not a number"));
}

TEST(LoggedText, ReadsBarsAndBlanksOfSpreadsheets) {
  expect_motion(read(table("time_s|alpha_deg|theta_deg", {seconds(), alpha(), theta()}, '|')).run);
  const auto blank_after = [](int row) { return number(alpha_of(row)) + "\u00A0"; };
  const auto blank_before = [](int row) { return "\u00A0" + number(theta_of(row)); };
  expect_motion(read(table("time_s;alpha_deg;theta_deg", {seconds(), blank_after, blank_before}, ';')).run);
}

TEST(LoggedText, NamesFormatThatIsNoTable) {
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"{\"alpha_deg\": 1.5, \"theta_deg\": 0.7}\n{\"alpha_deg\": 2.5, \"theta_deg\": 1.2}\n",
            "is JSON and no table"},
           {"[{\"alpha_deg\": 1.5, \"theta_deg\": 0.7}]\n", "is JSON and no table"},
           {"<table><tr><th>alpha_deg</th></tr></table>\n", "is XML or HTML and no table"},
           {">alpha:1.5\n>theta:0.7\n", "each value follows its name, as in \"alpha:1.5\""},
           {"t=0.1 alpha=1.5 theta=0.7\n", "each value follows its name, as in \"t=0.1\""},
           {"alpha_deg:1.5,theta_deg:0.7\n", "each value follows its name, as in \"alpha_deg:1.5\""}}) {
    const std::string error = error_of(text);
    EXPECT_THAT(error, HasSubstr(words));
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 2) << error;  // one message with its hint
  }
}

TEST(LoggedText, ReadsMissingValues) {
  for (const char* const word :
       {"#N/A", "#NV", "1.#QNAN", "-1.#IND00", "--", "?", "<NA>", "NaT", "#DIV/0!", "...", "-nan(ind)"}) {
    const std::string text = std::string("load_N,time_s,alpha_deg,theta_deg\n") + word + ",0,1,2\n" + word + ",1,2,3\n";
    EXPECT_THAT(read(text).run.samples, SizeIs(2)) << word;
  }
  EXPECT_THAT(read("alpha_deg,theta_deg\n#1,2\n3,4\n").run.samples, SizeIs(1)) << "a comment";
}

TEST(LoggedText, AcceptsRepeatedHeader) {
  const std::vector<Value> columns = {seconds(), alpha(), theta()};
  const std::string header = "time_s,alpha_deg,theta_deg";
  const std::string second_half = table("", columns, ',', 200).substr(1);
  const ReadRun found = read(table(header, columns, ',', 0, 200) + header + "\n" + second_half);
  expect_motion(found.run);
  EXPECT_TRUE(found.run.samples[200].after_break);
  EXPECT_EQ(breaks_of(found.run), 1u);
  EXPECT_THAT(found.notes, HasSubstr("the header is repeated 1 time, first in line 202: a new motion begins there"));
  // A row truncated by the restart, followed by the logger's start-up text.
  const ReadRun booted = read(table(header, columns, ',', 0, 200) +
                              "3.98,1\nets Jun  8 2016\nrst:0x1 (POWERON),boot:0x13\n" + header + "\n" + second_half);
  expect_motion(booted.run);
  EXPECT_THAT(booted.notes, HasSubstr("and 3 rows before it were not data"));
  // The header of a second file with a byte order mark, of another version, or behind a cut row.
  for (const char* const before : {"\xEF\xBB\xBF", "3.98,12.", "3.98,12.5,3."})
    expect_motion(read(table(header, columns, ',', 0, 200) + before + header + "\n" + second_half).run);
  expect_motion(read(table(header, columns, ',', 0, 200) + "Time_s, Alpha_deg, Theta_deg\n" + second_half).run);
  EXPECT_THAT(error_of(table(header, columns, ',', 0, 200) + "theta_deg,alpha_deg,time_s\n" + second_half),
              HasSubstr("run.csv:202:1: error: this line names the columns again, but not as the first header"));
}

std::string utf16(const std::string& text, bool is_big_endian) {
  std::string bytes = is_big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) bytes += is_big_endian ? std::string(1, '\0') + c : c + std::string(1, '\0');
  return bytes;
}

TEST(LoggedText, ReadsEveryEncoding) {
  expect_motion(read(utf16(plain(), /*is_big_endian=*/false)).run);
  expect_motion(read(utf16(plain(), /*is_big_endian=*/true)).run);
  const std::vector<Value> columns = {seconds(), alpha(), theta()};
  const std::string latin = table("Zeit in s;Winkel oben in \xB0;Winkel unten in \xB0", columns, ';');
  const std::string hint = error_of(latin);
  EXPECT_THAT(hint, HasSubstr("\"Winkel oben in \xC2\xB0\""));
  for (const char* const degree : {"\xC2\xB0", "\xB0"}) {
    const MeasurementOptions options = with_columns({{"time", "Zeit in s"},
                                                     {"alpha", std::string("Winkel oben in ") + degree},
                                                     {"theta", std::string("Winkel unten in ") + degree}});
    const ReadRun found = read(latin, options);
    expect_motion(found.run);
    EXPECT_EQ(found.notes, read(plain()).notes);
  }
  std::string returns = plain();
  for (char& c : returns) c = c == '\n' ? '\r' : c;
  expect_motion(read(returns).run);
}

TEST(LoggedText, RequiresOneDecimalMark) {
  const auto comma = [](const Value& value) {
    return Value([value](int row) {
      std::string text = value(row);
      for (char& c : text) c = c == '.' ? ',' : c;
      return text;
    });
  };
  const auto quoted = [](const Value& value) { return Value([value](int row) { return "\"" + value(row) + "\""; }); };
  const std::vector<Value> commas = {comma(seconds()), comma(alpha()), comma(theta())};
  expect_motion(read(table("time_s;alpha_deg;theta_deg", commas, ';')).run);
  expect_motion(read(table("time_s\talpha_deg\ttheta_deg", commas, '\t')).run);
  expect_motion(
      read(table("time_s,alpha_deg,theta_deg", {quoted(commas[0]), quoted(commas[1]), quoted(commas[2])})).run);
  // Grouped thousands: "1,020" ms.
  const Value grouped = [](int row) {
    const int ms = 20 * row;
    if (ms < 1000) return "\"" + std::to_string(ms) + "\"";
    return "\"" + std::to_string(ms / 1000) + "," + std::to_string(1000 + ms % 1000).substr(1) + "\"";
  };
  expect_motion(read(table("time_ms,alpha_deg,theta_deg", {grouped, alpha(), theta()})).run);
  EXPECT_THAT(error_of("alpha_deg;theta_deg\n1,5;2,5\n2.5;3,5\n"), HasSubstr("\"2.5\" is not a number"));
  EXPECT_THAT(error_of("alpha_deg;theta_deg\n1.5;2.5\n2,5;3.5\n"), HasSubstr("\"2,5\" is not a number"));
}

TEST(ColumnNames, StateTheirUnits) {
  const auto unit = [](const char* name, Quantity quantity) {
    const ColumnName parsed = parse_column_name(name, quantity);
    return parsed.base + "|" + (parsed.unit ? std::string(parsed.unit->name) : parsed.unknown_unit);
  };
  EXPECT_EQ(unit("tau_out_Nm", Quantity::load), "tau_out|Nm");
  EXPECT_EQ(unit("Load [kg]", Quantity::load), "load|kg");
  EXPECT_EQ(unit("tau_kgf_cm", Quantity::load), "tau|kgcm");
  EXPECT_EQ(unit("load_cell", Quantity::load), "load|cell");
  EXPECT_EQ(unit("tipForceN", Quantity::load), "tipforce|N");
  EXPECT_EQ(unit("/joint_states/motor/position", Quantity::angle), "/joint_states/motor/position|");
  EXPECT_EQ(unit("motor_counts", Quantity::angle), "motor|counts");
  EXPECT_EQ(unit("", Quantity::angle), "|");
}

}  // namespace
}  // namespace fusee::measurement
