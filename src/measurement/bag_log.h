/// \file
/// Internal: converts messages of a ROS 2 bag, from any kind of file, to rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/measurement.h"
#include "measurement/columns.h"
#include "measurement/ros_messages.h"
#include "measurement/row_reader.h"
#include "measurement/tracks.h"

namespace fusee::measurement {

/// Bytes. Larger messages are images and the like.
constexpr std::size_t k_largest_message = std::size_t{1} << 20;

/// Takes messages in the order of the file and keeps the numbers that may be motor, joint or a column of the options.
/// A number has the name that PlotJuggler gives it: the topic and the part of the message. Memory is bounded: of long
/// logs every second value is kept, then every fourth, and so on.
class BagLog {
 public:
  static constexpr std::size_t k_not_used = static_cast<std::size_t>(-1);

  BagLog(std::string name, const MeasurementOptions& options) : name_(std::move(name)), options_(options) {}

  /// Index for add_message(); k_not_used for topics without numbers. Files of one bag share their topics.
  std::size_t add_topic(std::string_view name, std::string_view type, std::string_view encoding);
  /// `log_time`: time of arrival at the recorder, ns. Malformed messages are counted.
  void add_message(std::size_t topic, std::int64_t log_time, std::string_view message);
  /// A fault of the file that leaves other parts readable.
  void add_note(std::string note) { notes_.push_back(std::move(note)); }
  std::size_t messages() const { return messages_; }

  /// Chooses columns and clock, and joins the numbers. Throws InputError if the roles of the topics are not obvious, or
  /// if nothing can be read.
  LoggedRows finish(std::size_t most_samples);

 private:
  struct Topic {
    std::string name, type_name, encoding;
    const MessageType* type = nullptr;  ///< nullptr: its messages have no numbers for a role
    std::size_t malformed = 0;          ///< messages
  };
  struct Point {
    std::int64_t stamp = 0;     ///< of the message's header, ns; 0 without one
    std::int64_t log_time = 0;  ///< of the recorder, ns
    double value = 0;
    std::size_t order = 0;  ///< number of the message in the log
  };
  struct Series {
    std::vector<Point> points;
    std::size_t count = 0;   ///< values since the last thinning
    std::size_t stride = 1;  ///< every `stride`-th value is kept
    bool is_wanted = false;
  };
  enum class Clock { header, recorder };
  /// A column of the log and its numbers.
  struct ChosenColumn {
    Column column;
    const std::vector<Point>* points;
  };

  void add_value(const std::string& name, const Point& point);
  bool is_wanted(const std::string& name) const;
  void thin_out();
  [[noreturn]] void refuse(const std::string& message, const std::string& hint) const;
  [[noreturn]] void refuse_without_numbers() const;
  std::vector<ChosenColumn> choose_columns(LoggedRows& rows) const;
  Clock choose_clock(const std::vector<ChosenColumn>& chosen, std::string& reason) const;
  void add_source(const std::vector<ChosenColumn>& chosen, Clock clock, const std::string& reason,
                  LoggedRows& rows) const;

  std::string name_;
  MeasurementOptions options_;
  std::vector<Topic> topics_;
  std::map<std::string, std::size_t, std::less<>> topic_by_name_;
  std::map<std::string, Series> series_;
  std::size_t messages_ = 0;
  std::size_t kept_points_ = 0;  ///< of all series
  std::vector<std::string> notes_;
};

}  // namespace fusee::measurement
