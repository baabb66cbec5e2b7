#include "measurement/row_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "fusee/base/files.h"
#include "fusee/base/text.h"
#include "fusee/base/units.h"

namespace fusee {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t k_longest_line = std::size_t{1} << 16;
constexpr std::size_t k_most_columns = 1000;
constexpr std::size_t k_most_problems = 20;
constexpr double k_largest_deg = 1e7;
/// Times and loads beyond this are a logger's garbage; their squares are still numbers.
constexpr double k_largest_value = 1e15;

// ---- words ----------------------------------------------------------------------------------------------------------

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view unquoted(std::string_view text) {
  text = trimmed(text);
  return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

/// Bytes of a file as a message may show them.
std::string shown(std::string_view text) {
  std::string words;
  for (const char c : text.substr(0, 40)) {
    const auto byte = static_cast<unsigned char>(c);
    words += byte < 0x20 || byte >= 0x7f ? '?' : c;
  }
  return "\"" + words + (text.size() > 40 ? "…\"" : "\"");
}

std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return small;
}

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// `separator` ' ': any number of blanks.
std::vector<std::string_view> cells(std::string_view line, char separator) {
  std::vector<std::string_view> parts;
  const std::string_view separators = separator == ' ' ? std::string_view(" \t") : std::string_view(&separator, 1);
  while (parts.size() <= k_most_columns) {
    const std::size_t end = line.find_first_of(separators);
    parts.push_back(unquoted(line.substr(0, end)));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
    if (separator == ' ') line.remove_prefix(std::min(line.find_first_not_of(separators), line.size()));
  }
  return parts;
}

char separator_of(std::string_view header) {
  for (const char separator : {',', ';', '\t', ' '}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

enum class Cell { number, missing, text };

/// "", "nan" and "inf" are what loggers write when there was nothing to write.
Cell read_cell(std::string_view text, double& value) {
  value = k_nan;
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  if (text.empty()) return Cell::missing;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = end == text.data() + text.size();
  if (!whole || (error != std::errc() && error != std::errc::result_out_of_range)) {
    value = k_nan;
    const std::string_view known[] = {"na", "n/a", "null", "none", "-"};
    return std::find(std::begin(known), std::end(known), lower(text)) != std::end(known) ? Cell::missing : Cell::text;
  }
  if (error != std::errc() || !std::isfinite(value)) value = k_nan;
  return std::isnan(value) ? Cell::missing : Cell::number;
}

/// "-12,5": a number where the comma is the point.
bool has_decimal_comma(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || text.find(',', comma + 1) != std::string_view::npos) return false;
  std::string point(text);
  point[comma] = '.';
  double value = 0;
  return read_cell(point, value) == Cell::number;
}

double* member(Mounting& mounting, const std::string& role) {
  if (role == k_motor_sensor_turned) return &mounting.motor_sensor_turned;
  if (role == k_joint_sensor_turned) return &mounting.joint_sensor_turned;
  return nullptr;
}

double* member(Sample& sample, const std::string& role) {
  if (role == "time") return &sample.time;
  if (role == "alpha") return &sample.alpha;
  if (role == "theta") return &sample.theta;
  if (role == "load") return &sample.load;
  if (role == "temperature") return &sample.temperature;
  if (role == "tension1") return &sample.tension1;
  if (role == "tension2") return &sample.tension2;
  return nullptr;  // cycle: found from α itself
}

bool is_mounting(const std::string& role) { return role == k_motor_sensor_turned || role == k_joint_sensor_turned; }
bool is_angle(const std::string& role) { return role == "alpha" || role == "theta" || is_mounting(role); }

/// The unit stands in the column's name: degrees and seconds unless it says otherwise.
double factor_of(const std::string& role, const std::string& column) {
  if (is_angle(role)) return ends_with(column, "_rad") ? 1.0 : radians(1.0);
  if (role == "time") return ends_with(column, "_ms") ? 1e-3 : ends_with(column, "_us") ? 1e-6 : 1.0;
  return 1.0;
}

// ---- rows -----------------------------------------------------------------------------------------------------------

class RowReader {
 public:
  RowReader(const std::string& name, const MeasurementOptions& options, std::size_t most_samples)
      : name_(name), options_(options), most_samples_(most_samples) {}

  void line(std::string_view text) {
    ++line_;
    if (line_ == 1 && text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    line_text_ = text;
    refuse_binary(text);
    const std::size_t mark = text.find('#');
    if (columns_.empty() && mark != std::string_view::npos) comment_ = trimmed(text.substr(mark + 1));
    const std::string_view content = text.substr(0, mark);
    if (trimmed(content).empty()) return;
    if (columns_.empty()) return header(trimmed(content));
    row(separator_ == '\t' ? content : trimmed(content));
  }

  LoggedRows finish() {
    if (columns_.empty()) {
      fail(0, "holds no header", "the first line names the columns: alpha_deg,theta_deg and, if logged, time_s,load_N");
    }
    // A log that was cut off ends in the middle of a row.
    if (!cut_off_.message.empty() && problems_.empty()) {
      found_.notes.push_back("the last row (line " + std::to_string(cut_off_.place.line) + ") is cut off: left out");
    }
    if (!problems_.empty()) throw InputError(problems_);
    return std::move(found_);
  }

  [[noreturn]] void refuse_long_line() const {
    const Diagnostic problem{
        Severity::error, place(line_ + 1, 1),
        "a line of more than " + std::to_string(k_longest_line) + " bytes: this is no table of measured data",
        "one row a line, ended by LF, CR LF or CR"};
    throw InputError(problem);
  }

 private:
  struct Column {
    std::size_t index = 0;
    std::string role;
    std::string name;
    double factor = 1;
  };

  Place place(long long line, int column) const {
    return {name_, static_cast<int>(std::min<long long>(line, std::numeric_limits<int>::max())), line > 0 ? column : 0};
  }

  /// 1 for the whole line.
  int column_of(std::string_view cell) const { return static_cast<int>(cell.data() - line_text_.data()) + 1; }

  void fail(int column, std::string message, std::string hint) {
    problems_.push_back({Severity::error, place(columns_.empty() && column == 0 ? 0 : line_, column),
                         std::move(message), std::move(hint)});
    if (problems_.size() < k_most_problems) return;
    problems_.push_back({Severity::note, place(line_, 1), "reading stopped here: there may be more", ""});
    throw InputError(problems_);
  }

  void refuse_binary(std::string_view text) const {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\f'; };
    const auto found = std::find_if(text.begin(), text.end(), is_control);
    if (found == text.end()) return;
    const std::string_view start = text.substr(0, 2);
    std::string hint = "measured data are a CSV text";
    if (line_ == 1 && (start == "\xFF\xFE" || start == "\xFE\xFF")) hint = "it looks like UTF-16: save it as UTF-8";
    if (line_ == 1 && start == "\x1F\x8B") hint = "it looks compressed: unpack it with gunzip";
    if (line_ == 1 && start == "PK") hint = "it looks like a spreadsheet or a zip: export a CSV text";
    const Diagnostic problem{Severity::error, place(line_, static_cast<int>(found - text.begin()) + 1),
                             "holds binary bytes", hint};
    throw InputError(problem);
  }

  void header(std::string_view text) {
    separator_ = separator_of(text);
    std::vector<std::string> names;
    for (const std::string_view cell : cells(text, separator_)) names.emplace_back(cell);
    if (names.size() > k_most_columns) {
      fail(1, "the header names more than " + std::to_string(k_most_columns) + " columns", "measured data need a few");
      throw InputError(problems_);
    }
    count_ = names.size();
    refuse_numbers_as_header(names);
    for (const auto& [role, usual] : column_roles()) {
      const auto given = options_.columns.find(role);
      const std::string wanted = given != options_.columns.end() ? given->second : usual;
      const auto found = std::find(names.begin(), names.end(), wanted);
      if (found != names.end()) {
        columns_.push_back({static_cast<std::size_t>(found - names.begin()), role, wanted, factor_of(role, wanted)});
        if (std::find(found + 1, names.end(), wanted) != names.end()) {
          fail(1, "two columns are called " + shown(wanted), "each column needs a name of its own");
        }
      } else if (is_needed(role) || given != options_.columns.end()) {
        missing(role, wanted, names);
      }
    }
    if (!problems_.empty()) throw InputError(problems_);
    refuse_shared_columns();
    found_.has_time = has("time");
    found_.has_load = has("load");
    found_.has_temperature = has("temperature");
    for (const Column& column : columns_) {
      if (column.role == "load") found_.load_column = column.name;
    }
  }

  bool is_needed(const std::string& role) const { return role == "alpha" || (role == "theta" && options_.needs_theta); }

  bool has(const std::string& role) const {
    return std::any_of(columns_.begin(), columns_.end(), [&](const Column& column) { return column.role == role; });
  }

  void refuse_numbers_as_header(const std::vector<std::string>& names) {
    double value = 0;
    for (const std::string& name : names) {
      if (read_cell(name, value) != Cell::number) return;
    }
    const bool in_comment = comment_.find("alpha") != std::string::npos;
    fail(1, "the first line holds numbers: there is no header",
         in_comment ? "line " + std::to_string(line_) + " follows a comment that may be it: take the # away"
                    : "the first line names the columns: alpha_deg,theta_deg and, if logged, time_s,load_N");
    throw InputError(problems_);
  }

  /// One column is not two things.
  void refuse_shared_columns() {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (columns_[i].index != columns_[j].index) continue;
        fail(1,
             "column " + shown(columns_[i].name) + " is taken as " + columns_[j].role + " and as " + columns_[i].role,
             "give each role a column of its own with --column " + columns_[i].role + "=NAME");
      }
    }
    if (!problems_.empty()) throw InputError(problems_);
  }

  void missing(const std::string& role, const std::string& wanted, const std::vector<std::string>& names) {
    std::string nearest;
    for (const std::string& name : names) {
      if (lower(name) == lower(wanted)) nearest = name;
    }
    if (nearest.empty()) nearest = nearest_word(wanted, names);
    for (const std::string& name : names) {
      if (nearest.empty() && lower(name).find(role) != std::string::npos) nearest = name;
    }
    std::string list;
    for (const std::string& name : names) {
      if (list.size() < 300) list += (list.empty() ? "" : ", ") + shown(name);
    }
    const std::string unit = is_angle(role) ? " (in degrees, or its name ends in _rad)" : "";
    const std::string word = shown(nearest);
    const bool plain = word.size() == nearest.size() + 2 && nearest.find(' ') == std::string::npos;
    fail(1, "there is no column " + wanted,
         nearest.empty()
             ? "the columns are " + list + "; --column " + role + "=NAME says which one it is" + unit
             : "the nearest is " + word + ": --column " + role + "=" + (plain ? nearest : word) + " takes it" + unit);
  }

  void row(std::string_view text) {
    if (!cut_off_.message.empty()) {
      problems_.push_back(cut_off_);
      cut_off_ = {};
      if (problems_.size() >= k_most_problems) throw InputError(problems_);
    }
    ++found_.rows;
    std::vector<std::string_view> values = cells(text, separator_);
    if (values.size() == count_ + 1 && values.back().empty())
      values.pop_back();  // some loggers end each row with a separator
    if (values.size() != count_) return wrong_count(values.size());
    Sample sample{k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan};
    for (const Column& column : columns_) {
      double value = k_nan;
      if (read_cell(values[column.index], value) == Cell::text) return not_a_number(column, values);
      if (is_angle(column.role) && std::abs(value) * column.factor > radians(k_largest_deg)) {
        return fail(column_of(values[column.index]), column.name + " = " + shortest(value) + " is no angle",
                    "angles are in degrees; leave the cell empty where nothing was logged");
      }
      if (std::abs(value) > k_largest_value) {
        return fail(column_of(values[column.index]),
                    column.name + " = " + shortest(value) + " is beyond anything measured",
                    "leave the cell empty where nothing was logged");
      }
      if (double* to = member(sample, column.role)) *to = value * column.factor;
      if (double* to = member(found_.mounting, column.role); to != nullptr && !std::isnan(value)) {
        if (mounted_.insert(column.role).second) {
          *to = value * column.factor;
        } else if (*to != value * column.factor) {
          return fail(column_of(values[column.index]), column.name + " changes within the run",
                      "one file for each way in which the encoders were mounted");
        }
      }
    }
    keep(sample);
  }

  void wrong_count(std::size_t count) {
    const std::string message =
        "the row has " + std::to_string(count) + " values, the header " + std::to_string(count_);
    if (count > count_ && separator_ == ',' && found_.rows == 1) {
      fail(1, message, "if commas are the decimal points, separate the values with ; and write points: 1.5;2.5");
      throw InputError(problems_);
    }
    Diagnostic problem{Severity::error, place(line_, 1), message, "remove the row, or complete it"};
    if (count < count_) {
      cut_off_ = problem;  // no fault if it is the last one
    } else {
      fail(1, problem.message, problem.hint);
    }
  }

  void not_a_number(const Column& column, const std::vector<std::string_view>& values) {
    const std::string_view cell = values[column.index];
    const std::string message = column.name + ": " + shown(cell) + " is not a number";
    if (has_decimal_comma(cell)) {
      fail(column_of(cell), message + ": it has a decimal comma", "write decimal points in the whole file: 1.5");
      throw InputError(problems_);
    }
    double value = 0;
    const bool all_text = std::all_of(values.begin(), values.end(),
                                      [&](std::string_view v) { return read_cell(v, value) != Cell::number; });
    if (all_text && found_.rows == 1) {
      return fail(column_of(cell), message, "a second line of the header? Begin it with #");
    }
    fail(column_of(cell), message,
         "numbers with a decimal point, one a cell; leave the cell empty where nothing was logged");
  }

  void keep(const Sample& sample) {
    if (std::isnan(sample.alpha) || (options_.needs_theta && std::isnan(sample.theta))) {
      found_.without_theta += !std::isnan(sample.alpha);
      if (found_.without_angle++ == 0) found_.first_without_angle = line_;
      return;
    }
    if (counter_++ % found_.stride != 0) return;
    std::vector<Sample>& samples = found_.samples;
    samples.push_back(sample);
    if (samples.size() < most_samples_) return;
    for (std::size_t i = 0; 2 * i < samples.size(); ++i) samples[i] = samples[2 * i];
    samples.resize((samples.size() + 1) / 2);
    found_.stride *= 2;
    counter_ = 0;
  }

  const std::string& name_;
  const MeasurementOptions& options_;
  std::size_t most_samples_;
  LoggedRows found_;
  std::vector<Column> columns_;
  std::set<std::string> mounted_;  ///< roles of the mounting that have their value
  std::vector<Diagnostic> problems_;
  Diagnostic cut_off_;
  std::string_view line_text_;
  std::string comment_;
  char separator_ = ',';
  std::size_t count_ = 0, counter_ = 0;
  long long line_ = 0;
};

/// Cuts blocks of bytes into lines that end with LF, CR LF or CR.
class Lines {
 public:
  explicit Lines(RowReader& reader) : reader_(reader) {}

  void add(std::string_view bytes) {
    while (!bytes.empty()) {
      if (after_return_ && bytes.front() == '\n') bytes.remove_prefix(1);
      after_return_ = false;
      const std::size_t end = bytes.find_first_of("\r\n");
      rest_.append(bytes.substr(0, end));
      if (rest_.size() > k_longest_line) reader_.refuse_long_line();
      if (end == std::string_view::npos) return;
      after_return_ = bytes[end] == '\r';
      reader_.line(rest_);
      rest_.clear();
      bytes.remove_prefix(end + 1);
    }
  }

  LoggedRows finish() {
    if (!rest_.empty()) reader_.line(rest_);
    return reader_.finish();
  }

 private:
  RowReader& reader_;
  std::string rest_;
  bool after_return_ = false;
};

}  // namespace

std::string rows_text(std::size_t count) { return std::to_string(count) + (count == 1 ? " row" : " rows"); }

void check_roles(const MeasurementOptions& options) {
  std::vector<std::string> roles;
  std::string list;
  for (const auto& [role, column] : column_roles()) {
    roles.push_back(role);
    list += (list.empty() ? "" : ", ") + role;
  }
  for (const auto& [role, column] : options.columns) {
    if (std::find(roles.begin(), roles.end(), role) != roles.end()) continue;
    const std::string nearest = nearest_word(role, roles);
    throw InputError("", "there is no role " + shown(role) + " for a column",
                     nearest.empty() ? "roles: " + list : "did you mean " + nearest + "?");
  }
}

LoggedRows read_rows(std::string_view text, const std::string& name, const MeasurementOptions& options,
                     std::size_t most_samples) {
  RowReader reader(name, options, most_samples);
  Lines lines(reader);
  lines.add(text);
  return lines.finish();
}

LoggedRows read_rows(const std::filesystem::path& path, const std::string& name, const MeasurementOptions& options,
                     std::size_t most_samples) {
  RowReader reader(name, options, most_samples);
  Lines lines(reader);
  constexpr std::size_t k_any_size = std::numeric_limits<std::size_t>::max();
  read_blocks({path, k_any_size, /*pipes=*/true}, [&lines](std::string_view block) { lines.add(block); });
  return lines.finish();
}

}  // namespace fusee
