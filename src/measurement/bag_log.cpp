#include "measurement/bag_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "measurement/csv_text.h"
#include "measurement/log_text.h"
#include "measurement/ros_names.h"
#include "measurement/unpacking.h"

namespace fusee::measurement {
namespace {

constexpr std::size_t k_most_topics = 10000;
constexpr std::size_t k_longest_topic = 1000;  // bytes
/// 256 MiB, at 32 bytes a point.
constexpr std::size_t k_most_points = std::size_t{1} << 23;
/// ns. Larger times are clamped to it, so that differences of two times stay within 64 bits.
constexpr std::int64_t k_latest_time = 4'000'000'000'000'000'000;
/// Larger values are garbage. As k_largest_value of row_reader.cpp.
constexpr double k_largest_number = 1e15;

const char* const k_header_clock = "header_stamp";
const char* const k_recorder_clock = "log_time";

/// Span of times in ns.
struct TimeSpan {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  std::int64_t last = std::numeric_limits<std::int64_t>::min();

  void take(std::int64_t time) {
    first = std::min(first, time);
    last = std::max(last, time);
  }
};

/// Times of one number by both clocks.
struct ClockSpans {
  TimeSpan stamps, log_times;
};

/// ns; negative if the spans are apart.
double overlap(const TimeSpan& one, const TimeSpan& other) {
  return static_cast<double>(std::min(one.last, other.last)) - static_cast<double>(std::max(one.first, other.first));
}

}  // namespace

std::size_t BagLog::add_topic(std::string_view name, std::string_view type, std::string_view encoding) {
  const auto known = topic_by_name_.find(name);
  std::size_t index = topics_.size();
  if (known != topic_by_name_.end()) {
    index = known->second;
  } else {
    if (index >= k_most_topics || name.empty() || name.size() > k_longest_topic || type.size() > k_longest_topic)
      return k_not_used;
    Topic topic{to_utf8(name), std::string(type), std::string(encoding.substr(0, k_longest_topic))};
    if (encoding == "cdr") topic.type = find_message_type(type);
    if (topic.name.front() != '/') topic.name.insert(0, "/");
    topics_.push_back(std::move(topic));
    topic_by_name_.emplace(name, index);
  }
  return topics_[index].type == nullptr ? k_not_used : index;
}

void BagLog::add_message(std::size_t index, std::int64_t log_time, std::string_view message) {
  Topic& topic = topics_[index];
  UnpackedBytes unpacked;  // of a bag that is compressed message by message
  if (is_zstd(message)) {
    unpacked = unpack(Packing::zstd, message, k_largest_message);
    message = unpacked.bytes;
  }
  Point point{.log_time = std::clamp(log_time, -k_latest_time, k_latest_time), .order = messages_++};
  std::vector<std::pair<std::string, double>> values;
  const auto stamp = decode_message(*topic.type, message, [&](std::string_view part, double value) {
    if (part.size() <= k_longest_topic) values.emplace_back(topic.name + "/" + to_utf8(part), value);
  });
  if (!stamp) {
    ++topic.malformed;
    return;
  }
  point.stamp = std::clamp(*stamp, -k_latest_time, k_latest_time);
  for (const auto& [name, value] : values) {
    point.value = value;
    add_value(name, point);
  }
}

void BagLog::add_value(const std::string& name, const Point& point) {
  auto found = series_.find(name);
  if (found == series_.end()) {
    constexpr std::size_t k_numbers_of_joint = 3;  // position, velocity and effort
    if (series_.size() >= k_numbers_of_joint * k_most_columns)
      refuse("has more than " + std::to_string(k_most_columns) + " joints", "record only the motor and the joint");
    found = series_.emplace(name, Series{}).first;
    found->second.is_wanted = is_wanted(name);
  }
  Series& series = found->second;
  if (!series.is_wanted || !(std::abs(point.value) <= k_largest_number)) return;
  if (series.count++ % series.stride != 0) return;
  series.points.push_back(point);
  if (++kept_points_ >= k_most_points) thin_out();
}

/// Angles of joints and single numbers may be motor and joint; other numbers only if an option names them.
bool BagLog::is_wanted(const std::string& name) const {
  return name.ends_with("/position") || name.ends_with("/data") ||
         std::any_of(options_.columns.begin(), options_.columns.end(),
                     [&](const auto& column) { return selects(lower(to_utf8(column.second)), lower(name)); });
}

void BagLog::thin_out() {
  kept_points_ = 0;
  for (auto& [name, series] : series_) {
    std::vector<Point>& points = series.points;
    for (std::size_t i = 0; 2 * i < points.size(); ++i) points[i] = points[2 * i];
    points.resize((points.size() + 1) / 2);
    series.stride *= 2;
    series.count = 0;
    kept_points_ += points.size();
  }
}

void BagLog::refuse(const std::string& message, const std::string& hint) const {
  throw InputError(name_, message, hint);
}

void BagLog::refuse_without_numbers() const {
  constexpr std::size_t k_longest_list = 400;
  const char* const k_advice = "record sensor_msgs/msg/JointState of motor and joint";
  std::string list;
  for (const Topic& topic : topics_) {
    if (list.size() > k_longest_list) {
      list += ", …";
      break;
    }
    list += (list.empty() ? "" : ", ") + shown(topic.name) + " (" + cleaned_line(topic.type_name) +
            (topic.encoding == "cdr" ? "" : ", encoded as " + shown(topic.encoding) + ", not cdr") +
            (topic.malformed > 0     ? ", malformed"
             : topic.type != nullptr ? ", no messages"
                                     : "") +
            ")";
  }
  if (list.empty()) refuse("has no topics", k_advice);
  std::string damage;
  for (const std::string& note : notes_) damage += "; " + note;
  refuse("no topic has angles" + damage, "its topics: " + list + "; " + k_advice);
}

LoggedRows BagLog::finish(std::size_t most_samples) {
  if (series_.empty()) refuse_without_numbers();
  LoggedRows rows;
  std::vector<ChosenColumn> chosen = choose_columns(rows);
  std::string reason;
  const Clock clock = choose_clock(chosen, reason);
  std::vector<Track> tracks;
  for (ChosenColumn& each : chosen) {
    Column& column = each.column;
    Track& track = tracks.emplace_back();
    track.role = column.role;
    track.half_turn = half_turn(column);
    for (const Point& point : *each.points) {
      track.add({clock == Clock::header ? point.stamp : point.log_time, point.value, point.order});
      column.take_value(point.value);
    }
  }
  RowKeeper keeper(most_samples);
  JoinedRows joined = join(tracks, options_.needs_theta, keeper);
  if (keeper.samples.empty() && joined.rows > 0)
    refuse("alpha and theta are never logged at the same time", "record both topics in one bag, from one clock");
  rows.notes.insert(rows.notes.end(), notes_.begin(), notes_.end());
  for (const Topic& topic : topics_) {
    if (topic.malformed > 0)
      rows.notes.push_back(std::to_string(topic.malformed) + " messages of " + shown(topic.name) +
                           " are malformed: omitted");
  }
  rows.notes.insert(rows.notes.end(), joined.notes.begin(), joined.notes.end());
  add_source(chosen, clock, reason, rows);
  rows.rows = joined.rows;
  rows.samples = std::move(keeper.samples);
  rows.stride = keeper.stride;
  std::vector<Column> columns;
  for (ChosenColumn& each : chosen) columns.push_back(std::move(each.column));
  settle_rows(columns, options_, name_, rows);
  rows.has_time = true;
  return rows;
}

/// The columns of the options, and motor and joint where they are obvious.
std::vector<BagLog::ChosenColumn> BagLog::choose_columns(LoggedRows& rows) const {
  std::vector<std::string> names;
  for (const auto& [name, series] : series_) names.push_back(name);
  MeasurementOptions options = options_;
  options.columns.erase("time");
  Header header = find_columns(names, options);
  std::vector<Diagnostic> problems = header.problems;
  for (Diagnostic& problem : problems) problem.place.file = name_;
  const auto add_problem = [&](const std::string& message, const std::string& hint) {
    problems.push_back(InputError(name_, message, hint).diagnostics().front());
  };
  std::vector<ChosenColumn> chosen;
  for (Column& column : header.columns) {
    const std::string& role = column.role;
    const Series& series = series_.at(column.name);
    if (member_of(role) == nullptr)
      add_problem("a bag has no column of the role " + role, "give it in a CSV file");
    else if (series.points.empty())
      add_problem(shown(column.name) + " has no numbers", "choose another for " + role);
    else
      chosen.push_back({std::move(column), &series.points});
  }
  if (!problems.empty()) throw InputError(problems);
  rows.notes = std::move(header.notes);
  return chosen;
}

/// The stamps of the headers are nearer to the measurement than the time of arrival at the recorder. They are used if
/// all topics have them and those of motor and joint come from one clock. Otherwise `reason` says why they are not.
BagLog::Clock BagLog::choose_clock(const std::vector<ChosenColumn>& chosen, std::string& reason) const {
  const auto given = options_.columns.find("time");
  const std::string wanted = given == options_.columns.end() ? "" : given->second;
  if (!wanted.empty() && wanted != k_header_clock && wanted != k_recorder_clock)
    refuse("there is no time " + shown(wanted) + " in a bag",
           std::string("--column time=") + k_header_clock + " or time=" + k_recorder_clock);
  if (wanted == k_recorder_clock) return Clock::recorder;
  std::vector<ClockSpans> angles;
  for (const ChosenColumn& each : chosen) {
    ClockSpans spans;
    bool is_stamped = true;
    for (const Point& point : *each.points) {
      spans.stamps.take(point.stamp);
      spans.log_times.take(point.log_time);
      is_stamped = is_stamped && point.stamp != 0;
    }
    const bool is_constant = spans.stamps.first == spans.stamps.last && spans.log_times.first != spans.log_times.last;
    if (!is_stamped || is_constant) reason = shown(each.column.name) + " has no stamps";
    if (each.column.quantity == Quantity::angle) angles.push_back(spans);
  }
  // Stamps of one clock overlap for about as long as the times of arrival do.
  if (reason.empty() && angles.size() == 2 &&
      overlap(angles[0].stamps, angles[1].stamps) < 0.5 * overlap(angles[0].log_times, angles[1].log_times))
    reason = "the stamps of motor and joint come from two clocks";
  if (wanted == k_header_clock && !reason.empty())
    refuse("the stamps of the headers cannot be the time: " + reason, std::string("--column time=") + k_recorder_clock);
  return reason.empty() ? Clock::header : Clock::recorder;
}

/// Reports the topics and the clock of the rows.
void BagLog::add_source(const std::vector<ChosenColumn>& chosen, Clock clock, const std::string& reason,
                        LoggedRows& rows) const {
  std::string source;
  for (const ChosenColumn& each : chosen) {
    const bool is_position = each.column.quantity == Quantity::angle && each.column.name.ends_with("/position");
    source += (source.empty() ? "" : ", ") + each.column.role + " is " + cleaned_line(each.column.name) +
              (is_position && each.column.unit != nullptr ? " in " + std::string(each.column.unit->name) : "");
  }
  source += clock == Clock::header ? "; time is that of the message headers" : "; time is that of the recorder";
  if (!reason.empty()) source += ", as " + reason;
  rows.sources.push_back(source);
}

}  // namespace fusee::measurement
