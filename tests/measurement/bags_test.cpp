// Recordings of ROS 2: MCAP, SQLite files and folders of ros2 bag, and PlotJuggler's tables. The files in
// tests/fuzz/corpus/bags are of independent writers: @mcap/core with lz4js and wasm-zstd, and Python's sqlite3.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "fusee/base.h"
#include "fuzz/measurement_laws.h"
#include "measurement/log_file.h"
#include "measurement/row_keeper.h"
#include "measurement/row_reader.h"
#include "measurement/tracks.h"
#include "measurement/unpacking.h"

namespace fusee::measurement {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::filesystem::path k_corpus = std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/fuzz/corpus/bags";

// ---- a writer by the specifications of CDR and MCAP -----------------------------------------------------------------

template <typename Number>
void put(std::string& bytes, Number value) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &value, sizeof(Number));
  bytes.append(raw, sizeof(Number));
}

/// A message in little-endian CDR: each number is aligned to its size.
class Cdr {
 public:
  template <typename Number>
  Cdr& add(Number value) {
    body_.resize((body_.size() + sizeof(Number) - 1) / sizeof(Number) * sizeof(Number));
    put(body_, value);
    return *this;
  }
  Cdr& text(const std::string& text) {
    add(static_cast<std::uint32_t>(text.size() + 1));
    body_ += text;
    body_ += '\0';
    return *this;
  }
  Cdr& header(std::int64_t stamp) {
    return add(static_cast<std::int32_t>(stamp / 1'000'000'000))
        .add(static_cast<std::uint32_t>(stamp % 1'000'000'000))
        .text("base");
  }
  Cdr& doubles(const std::vector<double>& values) {
    add(static_cast<std::uint32_t>(values.size()));
    for (const double value : values) add(value);
    return *this;
  }
  std::string message() const { return std::string("\0\1\0\0", 4) + body_; }  // 1: little-endian

 private:
  std::string body_;
};

std::string joint_state(std::int64_t stamp, const std::vector<std::string>& names, const std::vector<double>& positions,
                        const std::vector<double>& efforts = {}) {
  Cdr cdr;
  cdr.header(stamp).add(static_cast<std::uint32_t>(names.size()));
  for (const std::string& name : names) cdr.text(name);
  return cdr.doubles(positions).doubles({}).doubles(efforts).message();
}

std::string number_message(double value) { return Cdr().add(value).message(); }

/// MCAP without chunks. Records: 1 header, 2 footer, 3 schema, 4 channel, 5 message.
class Mcap {
 public:
  Mcap() {
    std::string header;
    text(header, "ros2");
    text(header, "test");
    record(1, header);
  }
  int topic(const std::string& name, const std::string& type = "sensor_msgs/msg/JointState",
            const std::string& encoding = "cdr") {
    std::string schema, channel;
    const auto id = static_cast<std::uint16_t>(++topics_);
    put(schema, id);
    for (const std::string& field : {type, std::string("ros2msg"), std::string()}) text(schema, field);
    record(3, schema);
    put(channel, id);
    put(channel, id);
    text(channel, name);
    text(channel, encoding);
    put(channel, std::uint32_t{0});
    record(4, channel);
    return id;
  }
  void add(int topic, std::int64_t log_time, const std::string& data) {
    std::string message;
    put(message, static_cast<std::uint16_t>(topic));
    put(message, std::uint32_t{0});
    put(message, static_cast<std::uint64_t>(log_time));
    put(message, static_cast<std::uint64_t>(log_time));
    record(5, message + data);
  }
  void record(char opcode, const std::string& body) {
    bytes_ += opcode;
    put(bytes_, static_cast<std::uint64_t>(body.size()));
    bytes_ += body;
  }
  std::string unfinished() const { return bytes_; }
  std::string finished() const {
    Mcap copy = *this;
    copy.record(2, std::string(20, '\0'));
    return copy.bytes_ + std::string(k_mcap_magic);
  }

 private:
  static void text(std::string& bytes, const std::string& words) {
    put(bytes, static_cast<std::uint32_t>(words.size()));
    bytes += words;
  }

  std::string bytes_ = std::string(k_mcap_magic);
  int topics_ = 0;
};

// ---- reading --------------------------------------------------------------------------------------------------------

LoggedRows rows_of(const std::string& bytes, const MeasurementOptions& options = {}) {
  return read_rows(std::string_view(bytes), "run.mcap", options);
}

MeasurementOptions with_columns(const std::map<std::string, std::string>& columns) {
  MeasurementOptions options;
  options.columns = columns;
  return options;
}

std::string error_in(const std::string& bytes, const MeasurementOptions& options = {}) {
  try {
    rows_of(bytes, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string corpus_file(const std::string& name) { return read_file(k_corpus / name, 1 << 20); }

constexpr std::int64_t k_ms = 1'000'000, k_start = 1'750'000'000'000'000'000;

/// Rows of the corpus: 64 in 1.28 s.
double corpus_alpha(int i) { return 0.5 * std::sin(2 * k_pi * i / 32); }
double corpus_theta(int i) { return corpus_alpha(i) / 4 + 0.001 * std::cos(i); }

void expect_corpus_rows(const LoggedRows& rows, std::size_t count, const std::string& name) {
  ASSERT_EQ(rows.samples.size(), count) << name;
  for (std::size_t i = 0; i < count; ++i) {
    const int n = static_cast<int>(i);
    EXPECT_EQ(rows.samples[i].time, n * 20 / 1000.0) << name << " row " << i;
    EXPECT_NEAR(rows.samples[i].alpha, corpus_alpha(n), 1e-15) << name << " row " << i;
    EXPECT_NEAR(rows.samples[i].theta, corpus_theta(n), 1e-15) << name << " row " << i;
  }
}

TEST(Bags, HaveSameRowsFromEveryWriter) {
  for (const char* const name : {"good_two_topics.mcap", "good_zstd.mcap", "good_lz4.mcap", "good_one_topic.mcap",
                                 "good_no_summary.mcap", "good_two_topics.db3"})
    expect_corpus_rows(rows_of(corpus_file(name)), 64, name);
  expect_corpus_rows(rows_of(corpus_file("good_packed_messages.db3")), 16, "packed messages");
}

// Results depend on samples, strokes, notes and reasons alone. If these agree, the results have the same bytes.
TEST(Bags, GiveSameMeasurementAsTable) {
  const std::filesystem::path data = std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/data/bags";
  Measurement plain;
  const measurement::Run expected = parse_run(read_file(data / "plain.csv", 1 << 20), "run", {}, plain);
  for (const std::filesystem::path& path :
       {k_corpus / "good_two_topics.mcap", k_corpus / "good_zstd.mcap", k_corpus / "good_lz4.mcap",
        k_corpus / "good_one_topic.mcap", k_corpus / "good_two_topics.db3", data / "plotjuggler.csv"}) {
    Measurement other;
    const measurement::Run run = parse_run(read_file(path, 1 << 20), "run", {}, other);
    EXPECT_EQ(other.notes, plain.notes) << path;
    EXPECT_EQ(other.not_testable, plain.not_testable) << path;
    ASSERT_EQ(run.samples.size(), expected.samples.size()) << path;
    for (std::size_t i = 0; i < run.samples.size(); ++i) {
      EXPECT_EQ(run.samples[i].time, expected.samples[i].time) << path << " row " << i;
      EXPECT_EQ(run.samples[i].alpha, expected.samples[i].alpha) << path << " row " << i;
      EXPECT_EQ(run.samples[i].theta, expected.samples[i].theta) << path << " row " << i;
    }
    EXPECT_EQ(run.strokes.size(), expected.strokes.size()) << path;
  }
}

TEST(Bags, ReportTopicsUnitsAndClock) {
  const LoggedRows rows = rows_of(corpus_file("good_zstd.mcap"));
  EXPECT_THAT(rows.sources,
              ElementsAre("alpha is /motor/joint_states/hinge/position in rad, theta is "
                          "/joint/joint_states/hinge/position in rad; time is that of the message headers"));
  EXPECT_THAT(rows.notes, ElementsAre("alpha in rad; theta in rad"));
}

TEST(Bags, AreReadInAnyBlocks) {
  const std::string bytes = corpus_file("good_lz4.mcap");
  const std::string name = "run.mcap";
  for (const std::size_t step : {1, 7, 1000}) {
    LogFile file(name, {}, k_most_samples);
    for (std::size_t at = 0; at < bytes.size(); at += step) file.add(std::string_view(bytes).substr(at, step));
    file.end([] { return std::string(); });
    EXPECT_EQ(file.finish().samples.size(), 64u) << step;
  }
}

// A recording that is cut off gives the whole messages before its end, with a note.
TEST(Bags, CutOffGiveTheirWholeMessages) {
  for (const char* const name :
       {"good_two_topics.mcap", "good_one_topic.mcap", "good_zstd.mcap", "good_two_topics.db3"}) {
    const std::string bytes = corpus_file(name);
    std::size_t before = 0;
    for (std::size_t size = 0; size < bytes.size(); size += 97) {
      LoggedRows rows;
      try {
        rows = rows_of(bytes.substr(0, size));
      } catch (const InputError& error) {
        EXPECT_EQ(before, 0u) << name << " " << size << " " << error.what();
        continue;
      }
      EXPECT_GE(rows.samples.size(), before) << name << " " << size;
      expect_corpus_rows(rows, rows.samples.size(), name);
      if (rows.samples.size() < 64) {
        EXPECT_THAT(rows.notes, Contains(HasSubstr("the recording is unfinished"))) << size;
      }
      before = rows.samples.size();
    }
    EXPECT_GE(before, 60u) << name;
  }
}

TEST(Bags, WithDamagedChunkOmitIt) {
  std::string bytes = corpus_file("good_two_topics.mcap");
  const std::size_t at = bytes.find("hinge", bytes.size() / 3);
  bytes[at] = 'b';
  const LoggedRows rows = rows_of(bytes);
  // The damaged chunk has some of the 64 rows, and the others have about half of them or more.
  EXPECT_LT(rows.samples.size(), 62u);
  EXPECT_GT(rows.samples.size(), 30u);
  EXPECT_THAT(rows.notes, Contains("1 chunks of the recording are damaged: omitted"));
}

TEST(Bags, SurviveChangedBytes) {
  for (const char* const name : {"good_lz4.mcap", "good_packed_messages.db3"}) {
    const std::string bytes = corpus_file(name);
    for (std::size_t at = 0; at < bytes.size(); at += 19) {
      std::string changed = bytes;
      changed[at] = static_cast<char>(changed[at] ^ 0x5B);
      try {
        EXPECT_EQ(fusee::testing::broken_law(changed), "") << name << " byte " << at;
      } catch (const InputError& error) {
        EXPECT_FALSE(error.diagnostics().empty());
      }
    }
  }
}

TEST(Bags, CorpusIsReadOrRefused) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(k_corpus)) {
    const std::string name = entry.path().filename().string();
    ++files;
    try {
      EXPECT_EQ(fusee::testing::broken_law(read_file(entry.path(), 1 << 20)), "") << name;
      EXPECT_EQ(name.find("bad_"), std::string::npos) << name;
    } catch (const InputError& error) {
      EXPECT_NE(name.find("bad_"), std::string::npos) << name << " " << error.what();
    }
  }
  EXPECT_GE(files, 7);
}

// ---- joining --------------------------------------------------------------------------------------------------------

/// Linear signals of two angles that are logged at different times: interpolation must reproduce them. Steps in ms.
Mcap two_rates(std::int64_t theta_step, std::int64_t theta_shift) {
  Mcap mcap;
  const int motor = mcap.topic("/motor/state"), joint = mcap.topic("/joint/state");
  for (std::int64_t t = 0; t < 2000; ++t) {
    const std::int64_t time = k_start + t * k_ms;
    if (t % 10 == 0) mcap.add(motor, time, joint_state(time, {"a"}, {0.001 * static_cast<double>(t)}));
    if (t % theta_step == theta_shift)
      mcap.add(joint, time, joint_state(time, {"b"}, {0.5 - 0.0002 * static_cast<double>(t)}));
  }
  return mcap;
}

TEST(Joining, InterpolatesSlowerAngleOntoFaster) {
  for (const std::int64_t step : {4, 25, 100}) {
    const LoggedRows rows = rows_of(two_rates(step, 3).finished());
    // Rows of the faster angle within the times of the other. θ every 4 ms: 500 less the 3 after the last α at 1990 ms.
    // α every 10 ms: from 10 ms to the last θ at 1978 ms or 1903 ms.
    const std::size_t expected = step == 4 ? 497 : step == 25 ? 197 : 190;
    EXPECT_EQ(rows.samples.size(), expected) << step;
    for (const Sample& sample : rows.samples) {
      // Both angles are linear in time, so θ is linear in α.
      EXPECT_NEAR(sample.theta, 0.5 - 0.2 * sample.alpha, 1e-12) << step;
    }
    EXPECT_THAT(rows.notes, Contains(HasSubstr("interpolated in time"))) << step;
    EXPECT_THAT(rows.notes, Contains(HasSubstr("omitted: the other angle is not logged there"))) << step;
  }
}

TEST(Joining, DoesNotBridgeGaps) {
  Mcap mcap;
  const int motor = mcap.topic("/motor"), joint = mcap.topic("/joint");
  for (std::int64_t t = 0; t < 1000; t += 10) {
    const std::int64_t time = k_start + t * k_ms;
    mcap.add(motor, time, joint_state(time, {"m"}, {0.001 * static_cast<double>(t)}));
    const bool lost = t > 300 && t < 500;
    if (!lost) mcap.add(joint, time + 5 * k_ms, joint_state(time + 5 * k_ms, {"j"}, {0.001 * static_cast<double>(t)}));
  }
  const LoggedRows rows = rows_of(mcap.finished());
  for (const Sample& sample : rows.samples) EXPECT_FALSE(sample.time > 0.306 && sample.time < 0.5) << sample.time;
  // Without θ are the first row, and 20 rows from 310 ms to 500 ms.
  EXPECT_EQ(rows.samples.size(), 100u - 1 - 20);
}

TEST(Joining, DoesNotMixLogsOfARestartedClock) {
  Mcap mcap;
  const int motor = mcap.topic("/motor"), joint = mcap.topic("/joint");
  for (const double level : {0.0, 1.0}) {
    for (std::int64_t t = 0; t < 500; t += 10) {
      mcap.add(motor, k_start + t * k_ms,
               joint_state((1000 + t) * k_ms, {"m"}, {level + 0.001 * static_cast<double>(t)}));
      mcap.add(joint, k_start + t * k_ms,
               joint_state((1003 + t) * k_ms, {"j"}, {level + 0.001 * static_cast<double>(t)}));
    }
  }
  const LoggedRows rows = rows_of(mcap.finished());
  EXPECT_EQ(rows.samples.size(), 98u);  // 50 of each log, less the first one, which is before θ
  for (const Sample& sample : rows.samples) EXPECT_NEAR(sample.theta, sample.alpha - 0.003, 1e-12);
  Measurement measurement;
  const measurement::Run run = parse_run(mcap.finished(), "run", {}, measurement);
  EXPECT_EQ(
      std::count_if(run.samples.begin(), run.samples.end(), [](const Sample& sample) { return sample.after_break; }),
      1);
}

// θ jumps from π to −π. A row between these values takes the nearer one, because their mean would be near 0.
TEST(Joining, HoldsAngleAcrossAWholeTurn) {
  Track alpha, theta;
  alpha.role = "alpha";
  theta.role = "theta";
  alpha.half_turn = theta.half_turn = k_pi;
  for (int i = 0; i < 100; ++i) {
    alpha.points.push_back({i * 10 * k_ms, 0.01 * i, static_cast<std::size_t>(2 * i)});
    theta.points.push_back(
        {i * 10 * k_ms + 4 * k_ms, std::remainder(3.0 + 0.01 * i, k_two_pi), static_cast<std::size_t>(2 * i + 1)});
  }
  RowKeeper keeper(1000);
  join({alpha, theta}, true, keeper);
  for (const Sample& sample : keeper.samples) EXPECT_GT(std::abs(sample.theta), 2.0) << sample.time;
}

// At its limit, the keeper drops every second row: of 100 rows it keeps every 16th, for an even and for an odd limit.
TEST(RowKeeper, KeepsRowsAtEqualDistances) {
  for (const std::size_t most : {8u, 9u}) {
    RowKeeper keeper(most);
    for (int row = 0; row < 100; ++row) {
      Sample sample;
      sample.time = row;
      keeper.add(sample);
    }
    EXPECT_EQ(keeper.stride, 16u);
    for (std::size_t i = 0; i < keeper.samples.size(); ++i)
      EXPECT_EQ(keeper.samples[i].time, static_cast<double>(keeper.stride * i)) << most;
    EXPECT_EQ(keeper.samples.size(), 100 / keeper.stride + 1);
  }
}

TEST(RowKeeper, KeepsRestartBeforeOmittedRow) {
  RowKeeper keeper(4);
  for (int row = 0; row < 5; ++row) {
    if (row == 3) keeper.begin_again();
    Sample sample;
    sample.time = row;
    keeper.add(sample);
  }
  ASSERT_EQ(keeper.samples.size(), 3u);  // rows 0, 2 and 4
  EXPECT_FALSE(keeper.samples[1].after_break);
  EXPECT_TRUE(keeper.samples[2].after_break);
}

TEST(Track, KeepsPointsAtEqualDistances) {
  Track track;
  for (std::int64_t i = 0; i < std::int64_t{9} << 20; ++i) track.add({i, 0, 0});
  EXPECT_EQ(track.stride, 4u);  // at most 4 · 2^20 points are kept
  bool is_evenly_spaced = true;
  for (std::size_t i = 0; i < track.points.size(); ++i)
    is_evenly_spaced &= track.points[i].time == static_cast<std::int64_t>(4 * i);
  EXPECT_TRUE(is_evenly_spaced);
}

TEST(Joining, HoldsLoadsThatAreSetByHand) {
  Mcap mcap;
  const int state = mcap.topic("/joint_states"), load = mcap.topic("/load", "std_msgs/msg/Float64");
  for (std::int64_t t = 0; t < 9000; t += 100) {
    if (t % 3000 == 0) mcap.add(load, t * k_ms, number_message(static_cast<double>(t) / 300));
    mcap.add(state, t * k_ms, joint_state(0, {"motor", "joint"}, {0.001 * static_cast<double>(t), 0.0}));
  }
  const LoggedRows rows = rows_of(mcap.finished(), with_columns({{"load", "/load/data"}}));
  ASSERT_EQ(rows.samples.size(), 90u);
  for (const Sample& sample : rows.samples) EXPECT_EQ(sample.load, 10 * std::floor(sample.time / 3));
}

// ---- clocks and columns ---------------------------------------------------------------------------------------------

/// A message every 20 ms, recorded up to 2 ms late. `stamp`: of the first message, ns; 0: no message has a stamp.
Mcap one_topic(std::int64_t stamp, const std::vector<std::string>& names = {"motor", "joint"}) {
  Mcap mcap;
  const int topic = mcap.topic("/joint_states");
  for (std::int64_t t = 0; t < 20; ++t) {
    std::vector<double> positions, efforts;
    for (std::size_t i = 0; i < names.size(); ++i) {
      positions.push_back(0.1 * static_cast<double>(t) / static_cast<double>(i + 1));
      efforts.push_back(static_cast<double>(i));
    }
    const std::int64_t jitter = t % 3 * k_ms;
    mcap.add(topic, t * 20 * k_ms + jitter,
             joint_state(stamp == 0 ? 0 : stamp + t * 20 * k_ms, names, positions, efforts));
  }
  return mcap;
}

TEST(BagClock, IsTheHeadersIfTheyHaveStamps) {
  EXPECT_EQ(rows_of(one_topic(7000 * k_ms).finished()).samples[1].time, 7.02);
  const LoggedRows without = rows_of(one_topic(0).finished());
  EXPECT_EQ(without.samples[1].time, 0.021);
  EXPECT_THAT(without.sources, Contains(HasSubstr("time is that of the recorder, as")));
  EXPECT_EQ(rows_of(one_topic(7000 * k_ms).finished(), with_columns({{"time", "log_time"}})).samples[1].time, 0.021);
  EXPECT_THAT(error_in(one_topic(0).finished(), with_columns({{"time", "header_stamp"}})), HasSubstr("has no stamps"));
  EXPECT_THAT(error_in(one_topic(0).finished(), with_columns({{"time", "stamp"}})),
              HasSubstr("there is no time \"stamp\""));
}

TEST(BagClock, IsTheRecordersForStampsOfTwoClocks) {
  Mcap mcap;
  const int motor = mcap.topic("/motor"), joint = mcap.topic("/joint");
  for (std::int64_t t = 0; t < 1000; t += 10) {
    mcap.add(motor, k_start + t * k_ms, joint_state(k_start + t * k_ms, {"m"}, {0.001 * static_cast<double>(t)}));
    mcap.add(joint, k_start + t * k_ms, joint_state((77 + t) * k_ms, {"j"}, {0.002 * static_cast<double>(t)}));
  }
  const LoggedRows rows = rows_of(mcap.finished());
  EXPECT_EQ(rows.samples.size(), 100u);
  EXPECT_THAT(rows.sources, Contains(HasSubstr("two clocks")));
}

TEST(BagColumns, AreChosenWhereTheNamesAreObvious) {
  for (const std::vector<std::string>& names : {std::vector<std::string>{"motor", "joint"},
                                                {"actuator_1", "elbow"},
                                                {"elbowMotor", "elbowJoint"},
                                                {"joint_motor", "joint"}}) {
    const LoggedRows rows = rows_of(one_topic(1, names).finished());
    EXPECT_EQ(rows.samples[10].alpha, 1.0) << names[0];
    EXPECT_EQ(rows.samples[10].theta, 0.5) << names[0];
  }
  const LoggedRows theta_first = rows_of(one_topic(1, {"finger_link", "finger_x"}).finished());
  EXPECT_EQ(theta_first.samples[10].theta, 1.0);
}

// A number that is named weight is not taken as the joint's angle, and one that is named joint_deg is.
TEST(BagColumns, NeedBothWordsForTwoKinds) {
  for (const char* const name : {"/weight", "/joint_deg"}) {
    Mcap mcap;
    const int motor = mcap.topic("/motor"), other = mcap.topic(name, "std_msgs/msg/Float32");
    for (std::int64_t t = 0; t < 10; ++t) {
      mcap.add(motor, t * k_ms, joint_state(0, {"m"}, {0.1 * static_cast<double>(t)}));
      mcap.add(other, t * k_ms, Cdr().add(static_cast<float>(t)).message());
    }
    const std::string error = error_in(mcap.finished());
    if (name == std::string("/weight")) {
      EXPECT_THAT(error, HasSubstr("not obvious which joint is theta"));
    } else {
      EXPECT_EQ(error, "");
    }
  }
}

TEST(BagColumns, AreListedIfNotObvious) {
  const std::string bytes = one_topic(1, {"a", "b", "c"}).finished();
  EXPECT_THAT(error_in(bytes),
              HasSubstr("/joint_states/a/position, /joint_states/b/position, /joint_states/c/position"));
  EXPECT_THAT(error_in(bytes), HasSubstr("--column alpha=NAME"));
  for (const std::map<std::string, std::string>& columns :
       {std::map<std::string, std::string>{{"alpha", "/joint_states/c/position"}, {"theta", "/joint_states/b"}},
        {{"alpha", "c"}, {"theta", "b/position"}}}) {
    const LoggedRows rows = rows_of(bytes, with_columns(columns));
    EXPECT_NEAR(rows.samples[9].alpha, 0.3, 1e-12);
    EXPECT_NEAR(rows.samples[9].theta, 0.45, 1e-12);
  }
  EXPECT_THAT(error_in(bytes, with_columns({{"alpha", "joint_states"}})), HasSubstr("no topic or joint"));
}

TEST(BagColumns, HaveTheUnitsOfRos) {
  const LoggedRows rows = rows_of(one_topic(1).finished(), with_columns({{"load", "/joint_states/joint/effort"}}));
  EXPECT_EQ(rows.load_unit, "Nm");
  EXPECT_EQ(rows.samples[3].load, 1.0);
  MeasurementOptions degrees;
  degrees.units = {{"alpha", "deg"}};
  EXPECT_NEAR(rows_of(one_topic(1).finished(), degrees).samples[10].alpha, radians(1.0), 1e-15);
}

TEST(BagColumns, MayBeNumbersAndWrenches) {
  Mcap mcap;
  const int motor = mcap.topic("/motor_deg", "std_msgs/msg/Float64"),
            joint = mcap.topic("/joint_deg", "std_msgs/Float64"),
            force = mcap.topic("/ft", "geometry_msgs/msg/WrenchStamped");
  for (std::int64_t t = 0; t < 50; ++t) {
    mcap.add(motor, t * 10 * k_ms, number_message(static_cast<double>(t)));
    mcap.add(joint, t * 10 * k_ms, number_message(static_cast<double>(t) / 2));
    Cdr wrench;
    wrench.header(t * 10 * k_ms);
    for (const double value : {0.0, 12.5, 0.0, 0.0, 0.0, 0.0}) wrench.add(value);
    mcap.add(force, t * 10 * k_ms, wrench.message());
  }
  const LoggedRows rows = rows_of(mcap.finished(), with_columns({{"load", "/ft/wrench/force/y"}}));
  ASSERT_EQ(rows.samples.size(), 50u);
  EXPECT_NEAR(rows.samples[20].alpha, radians(20), 1e-12);
  EXPECT_NEAR(rows.samples[20].theta, radians(10), 1e-12);
  EXPECT_EQ(rows.samples[20].load, 12.5);
  EXPECT_EQ(rows.load_unit, "N");
}

TEST(Bags, WithoutAnglesNameTheirTopics) {
  Mcap mcap;
  mcap.add(mcap.topic("/camera", "sensor_msgs/msg/Image"), 0, "x");
  mcap.topic("/joint_states", "sensor_msgs/msg/JointState", "ros1");
  EXPECT_THAT(error_in(mcap.finished()), HasSubstr("\"/camera\" (sensor_msgs/msg/Image), \"/joint_states\" "
                                                   "(sensor_msgs/msg/JointState, encoded as \"ros1\", not cdr)"));
  EXPECT_THAT(error_in(Mcap().finished()), HasSubstr("has no topics"));
  EXPECT_THAT(error_in("#ROSBAG V2.0\n and so on"), HasSubstr("ROS 1"));
  EXPECT_THAT(error_in(std::string("SQLite format 3\0", 16) + "no more"), HasSubstr("first page"));
}

TEST(Bags, OmitMalformedMessages) {
  Mcap mcap = one_topic(1);
  mcap.add(1, 0, std::string("\x00\x01\x00", 3));
  mcap.add(1, 0, joint_state(1, {"motor", "joint"}, {1, 2}).substr(0, 60));
  const LoggedRows rows = rows_of(mcap.finished());
  EXPECT_EQ(rows.samples.size(), 20u);
  EXPECT_THAT(rows.notes, Contains("2 messages of \"/joint_states\" are malformed: omitted"));
}

// ---- PlotJuggler ----------------------------------------------------------------------------------------------------

TEST(PlotJuggler, TableHasTheRowsOfItsBag) {
  const LoggedRows table =
      rows_of(read_file(std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/data/bags/plotjuggler.csv", 1 << 20));
  expect_corpus_rows(table, 64, "table");
  EXPECT_THAT(table.notes, ElementsAre("alpha in rad; theta in rad"));
}

// Numbers with other times have empty cells, as in a bag of two topics.
TEST(PlotJuggler, EmptyCellsAreJoinedAsInBag) {
  Mcap mcap;
  const int motor = mcap.topic("/motor"), joint = mcap.topic("/joint");
  std::string table = "__time,/joint/j/position,/motor/m/position\n";
  for (std::int64_t t = 0; t < 1000; t += 5) {
    const std::int64_t time = k_start + t * k_ms;
    const double angle = 0.125 * static_cast<double>(t % 90);
    // Microseconds with leading zeros: seven digits without the first.
    const std::string seconds =
        std::to_string(time / 1'000'000'000) + "." + std::to_string(1'000'000 + time / 1000 % 1'000'000).substr(1);
    if (t % 20 == 5) {
      mcap.add(motor, time, joint_state(time, {"m"}, {angle}));
      table += seconds + ",," + std::to_string(angle) + "\n";
    } else if (t % 50 == 10) {
      mcap.add(joint, time, joint_state(time, {"j"}, {angle}));
      table += seconds + "," + std::to_string(angle) + ",\n";
    }
  }
  const LoggedRows of_table = rows_of(table), of_bag = rows_of(mcap.finished());
  ASSERT_EQ(of_table.samples.size(), of_bag.samples.size());
  EXPECT_GT(of_bag.samples.size(), 40u);
  for (std::size_t i = 0; i < of_bag.samples.size(); ++i) {
    EXPECT_EQ(of_table.samples[i].time, of_bag.samples[i].time);
    EXPECT_EQ(of_table.samples[i].alpha, of_bag.samples[i].alpha);
    EXPECT_EQ(of_table.samples[i].theta, of_bag.samples[i].theta);
  }
  EXPECT_EQ(of_table.notes, of_bag.notes);
}

// ---- limits ---------------------------------------------------------------------------------------------------------

/// A zstd frame (RFC 8878) of blocks that each repeat one byte 128·1024 times.
std::string repeated_zeros(int blocks) {
  std::string frame("\x28\xB5\x2F\xFD\x00\x58", 6);  // a window of 2 MB
  for (int i = 0; i < blocks; ++i) {
    // Block header: size, type (1: one repeated byte), and whether it is the last block.
    const std::uint32_t head = (std::uint32_t{128 * 1024} << 3U) | 2U | (i + 1 == blocks ? 1U : 0U);
    for (int byte = 0; byte < 3; ++byte) frame += static_cast<char>(head >> (8 * byte));
    frame += '\0';
  }
  return frame;
}

TEST(Unpacking, StopsAtItsLimit) {
  const std::string packed = repeated_zeros(100);
  const UnpackedBytes all = unpack(Packing::zstd, packed, std::size_t{1} << 30);
  EXPECT_TRUE(all.whole);
  EXPECT_EQ(all.bytes.size(), std::size_t{100} * 128 * 1024);
  const UnpackedBytes some = unpack(Packing::zstd, packed, 1'000'000);
  EXPECT_FALSE(some.whole);
  EXPECT_EQ(some.bytes.size(), 1'000'000u);
  UnpackingLimit limit;
  const std::size_t most = limit.raise_for(packed.size());
  EXPECT_LT(most, std::size_t{65} << 20);
  limit.use(most);
  EXPECT_EQ(limit.raise_for(1), 1000u);  // bytes for each packed one
}

TEST(Unpacking, ReportsDamagedAndCutOffFrames) {
  const std::string packed = repeated_zeros(3);
  EXPECT_FALSE(unpack(Packing::zstd, packed.substr(0, packed.size() - 1), 1 << 20).whole);
  EXPECT_FALSE(unpack(Packing::zstd, "\x28\xB5\x2F\xFDxxxx", 1 << 20).whole);
  EXPECT_FALSE(unpack(Packing::lz4, "xxxxxxxxxxxx", 1 << 20).whole);
  EXPECT_FALSE(unpack(Packing::lz4, "", 1 << 20).whole);
}

}  // namespace
}  // namespace fusee::measurement
