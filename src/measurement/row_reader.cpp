#include "measurement/row_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

#include "base/text.h"
#include "fusee/base.h"
#include "measurement/cells.h"
#include "measurement/columns.h"
#include "measurement/csv_text.h"
#include "measurement/log_text.h"
#include "measurement/ros_names.h"
#include "measurement/row_keeper.h"
#include "measurement/tracks.h"

namespace fusee::measurement {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
/// Problems that are listed before reading stops.
constexpr std::size_t k_most_problems = 20;
/// Faults after which reading stops, also if they are all of one kind.
constexpr std::size_t k_most_faults = 1000;
/// Lines above the header, such as settings of a logger or an oscilloscope.
constexpr std::size_t k_longest_preamble = 1000;
/// Larger values are garbage. Squares of values within the limits are finite. Times in ns since 1970 are within the
/// limit of times.
constexpr double k_largest_value = 1e15, k_largest_time = 1e19;

const char* const k_usual_header =
    "the first line names the columns: alpha_deg,theta_deg and, if logged, time_s,load_N";

/// The mounting angle for a role; nullptr for other roles.
double* mounting_of(joint::Mounting& mounting, const std::string& role) {
  if (role == k_motor_sensor_turned) return &mounting.motor_sensor_turned;
  if (role == k_joint_sensor_turned) return &mounting.joint_sensor_turned;
  return nullptr;
}

/// True if each cell is a number or a time stamp. A single comma in a cell counts as a decimal mark.
bool all_numbers(const std::vector<std::string>& cells) {
  double value = 0;
  return std::all_of(cells.begin(), cells.end(), [&](std::string cell) {
    if (std::count(cell.begin(), cell.end(), ',') == 1) cell[cell.find(',')] = '.';
    return read_number(cell, value) == CellContent::number || read_time_stamp(cell);
  });
}

/// Separator of a spreadsheet's "sep=;" line; 0 for another line.
char stated_separator(std::string_view line) {
  if (line.size() >= 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
  return line.size() == 5 && lower(line.substr(0, 4)) == "sep=" ? line[4] : '\0';
}

constexpr char k_separators[] = {',', ';', '\t', ' '};

/// Cells of a header line, with doubled quotation marks made single and without line ends.
std::vector<std::string> names_in(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  split_cells(line, separator, cells);
  std::vector<std::string> names;
  for (const std::string_view cell : cells) {
    std::string& name = names.emplace_back(cell);
    for (std::size_t at = name.find("\"\""); at != std::string::npos; at = name.find("\"\"", at + 1)) name.erase(at, 1);
    std::replace(name.begin(), name.end(), '\n', ' ');
  }
  return names;
}

/// A quoted name may have a line end where its column's name has a blank.
bool is_same_name(std::string_view cell, std::string_view name) {
  const auto is_same = [](char a, char b) { return (a == '\n' ? " " : lower({&a, 1})) == lower({&b, 1}); };
  return std::equal(cell.begin(), cell.end(), name.begin(), name.end(), is_same);
}

/// "[deg]" and "(deg)" become "deg".
std::string_view without_brackets(std::string_view cell) {
  const bool in_brackets = cell.size() > 2 && std::string_view("[({<").find(cell.front()) != std::string_view::npos &&
                           std::string_view("])}>").find(cell.back()) != std::string_view::npos;
  return in_brackets ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

/// Bytes that do not belong to the text: zero bytes of a log that was not closed, and the end mark of DOS.
constexpr std::string_view k_padding{"\0\x1A", 2};

/// The likely separator of a line; a comma if it has none. A semicolon or tab comes first, since commas may be decimal
/// marks beside it.
char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ',', '|', ' '}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

}  // namespace

/// A possible header line, for the message if there is no header.
struct HeaderLine {
  std::string text;
  std::vector<std::string> names;
  long long line = 0;
};

// ---- rows -----------------------------------------------------------------------------------------------------------

class RowReader {
 public:
  RowReader(const std::string& name, const MeasurementOptions& options, std::size_t most_samples)
      : name_(name), options_(options), keeper_(most_samples) {}

  void take(const Record& record) {
    line_ = record.line;
    std::string_view text = record.text;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // of a file appended to another one
    line_text_ = text;
    if (record.open_quote && text.find('\n') != std::string_view::npos) refuse_long(record.line, true);
    text = without_padding(text);
    refuse_binary(text);
    std::string_view content = trimmed(text);
    if (content.empty()) return;
    if (padded_lines_ > 0) refuse_padding();
    if (content.front() == '#' && !is_row_without_first_value(content)) {
      if (columns_.empty()) comment_ = content.substr(1);
      return;
    }
    const std::string_view unstamped = without_stamp(content);
    if (columns_.empty()) {
      find_header(unstamped);
      if (std::exchange(is_header_above_, false)) take(record);  // as the first row below the header
      return;
    }
    take_row(separator_ == '\t' && !is_stamped_ ? text : unstamped);  // a tab at either end borders an empty cell
  }

  LoggedRows finish() {
    if (columns_.empty()) refuse_without_header();
    if (padded_lines_ > 0) {
      logged_.notes.push_back("zero bytes at the end (line " + std::to_string(first_padded_line_) +
                              "): the log was not closed, they are omitted");
    }
    // A truncated log ends in the middle of a row.
    if (!short_row_.message.empty() && problems_.empty()) {
      logged_.notes.push_back("the last row (line " + std::to_string(short_row_.place.line) +
                              ") is truncated: omitted");
    }
    if (!problems_.empty()) refuse();
    if (repeated_headers_ > 0) {
      logged_.notes.push_back(
          "the header is repeated " + times(repeated_headers_) + ", first in line " + std::to_string(first_repeat_) +
          ": a new motion begins there" +
          (dropped_rows_ > 0 ? ", and " + rows_text(dropped_rows_) + " before it were not data" : ""));
    }
    if (!tracks_.empty()) join_tracks();
    logged_.samples = std::move(keeper_.samples);
    logged_.stride = keeper_.stride;
    settle_rows(columns_, options_, name_, logged_);
    return std::move(logged_);
  }

  [[noreturn]] void refuse_long(long long line, bool open_quote) const {
    const std::string most = std::to_string(k_longest_record);
    const Diagnostic problem =
        open_quote ? Diagnostic{Severity::error, place(line, 1),
                                "the quotation mark that opens a cell here is never closed", "close or remove it"}
                   : Diagnostic{Severity::error, place(line, 1),
                                "a line of more than " + most + " bytes: this is not a table of measured data",
                                "write one row per line, ended by LF, CR LF or CR"};
    throw InputError(problem);
  }

 private:
  static std::string times(std::size_t count) { return std::to_string(count) + (count == 1 ? " time" : " times"); }

  Place place(long long line, int column) const {
    return {name_, static_cast<int>(std::min<long long>(line, std::numeric_limits<int>::max())), line > 0 ? column : 0};
  }

  /// Column number of a cell; 1 for the whole line.
  int column_of(std::string_view cell) const { return static_cast<int>(cell.data() - line_text_.data()) + 1; }

  /// One fault, or the first of its kind.
  struct Fault {
    Diagnostic problem;
    std::string kind;        ///< "number alpha"; "" if it is reported for itself
    std::size_t others = 0;  ///< faults of its kind in later rows
  };

  /// Faults of one kind in several rows are reported once.
  void fail(int column, std::string message, std::string hint, const std::string& kind = "") {
    fail({Severity::error, place(line_, column), std::move(message), std::move(hint)}, kind);
  }

  void fail(Diagnostic problem, const std::string& kind) {
    ++faults_;
    const auto known = std::find_if(problems_.begin(), problems_.end(),
                                    [&](const Fault& fault) { return !kind.empty() && fault.kind == kind; });
    if (known != problems_.end()) {
      ++known->others;
    } else {
      problems_.push_back({std::move(problem), kind});
    }
    if (problems_.size() < k_most_problems && faults_ < k_most_faults) return;
    problems_.push_back(
        {{Severity::note, place(line_, 1), "reading stopped here: there may be more", ""}, std::string()});
    refuse();
  }

  [[noreturn]] void refuse() const {
    std::vector<Diagnostic> diagnostics;
    for (const Fault& fault : problems_) {
      Diagnostic& diagnostic = diagnostics.emplace_back(fault.problem);
      if (fault.others > 0) diagnostic.message += ", and so in " + rows_text(fault.others) + " below";
    }
    throw InputError(diagnostics);
  }

  // ---- bytes that are no text

  /// The text without padding at its end, which is noted.
  std::string_view without_padding(std::string_view text) {
    const std::size_t end = text.find_last_not_of(k_padding) + 1;  // 0 if there is nothing else
    if (end == text.size()) return text;
    if (padded_lines_++ == 0) first_padded_line_ = line_;
    return text.substr(0, end);
  }

  /// Refuses padding that text follows: it is not at the end of the log.
  void refuse_padding() {
    if (line_ == first_padded_line_) return;  // this line's own padding, which may end the log
    line_ = first_padded_line_;
    refuse_binary(k_padding);
  }

  /// The line without the time of day that the serial monitors of Arduino's IDE and PlatformIO can write before it, as
  /// in "10:00:00.020 -> 1.5,2.5". If the header line has such a time before it, too, the time becomes the last cell of
  /// the row; else it is dropped.
  std::string_view without_stamp(std::string_view content) {
    if (columns_.empty()) is_stamped_ = false;
    for (const std::string_view arrow : {std::string_view(" -> "), std::string_view(" > ")}) {
      constexpr std::size_t k_longest_stamp = 20;
      const std::size_t end = content.substr(0, k_longest_stamp).find(arrow);
      if (end == std::string_view::npos || !read_time_stamp(content.substr(0, end))) continue;
      const std::string_view rest = trimmed(content.substr(end + arrow.size()));
      if (columns_.empty()) is_stamped_ = true;
      if (columns_.empty() || !is_stamped_) return rest;
      stamped_row_ = std::string(rest) + separator_ + std::string(content.substr(0, end));
      line_text_ = stamped_row_;
      return stamped_row_;
    }
    return content;
  }

  /// True for a row with "#N/A" in the first column: it is no comment.
  bool is_row_without_first_value(std::string_view content) {
    if (columns_.empty()) return false;
    split_cells(content, separator_, values_);
    double value = 0;
    return values_.size() > 1 && values_.size() == column_count_ &&
           read_number(values_.front(), value) == CellContent::missing;
  }

  void refuse_binary(std::string_view text) const {
    const auto is_control = [](char c) {
      return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\f' && c != '\n';
    };
    const auto found = std::find_if(text.begin(), text.end(), is_control);
    if (found == text.end()) return;
    const std::string_view start = text.substr(0, 2);
    std::string hint = "give measured data as CSV text";
    if (line_ == 1 && text.size() > 1 && (text[0] == '\0' || text[1] == '\0'))
      hint = "it looks like UTF-16 without its byte order mark: save it as UTF-8";
    if (line_ == 1 && text.substr(0, 1) == "\x1F") hint = "it looks compressed: unpack it with gunzip";
    if (line_ > 1 && *found == '\0') hint = "remove the zero bytes: the log was damaged there";
    if (line_ == 1 && start == "PK") hint = "it looks like a spreadsheet or a zip: export a CSV text";
    const Diagnostic problem{Severity::error, place(line_, static_cast<int>(found - text.begin()) + 1),
                             "contains binary bytes", hint};
    throw InputError(problem);
  }

  // ---- header

  /// The header is the first line that names the angles; lines above it are a preamble.
  void find_header(std::string_view text) {
    if (const char stated = stated_separator(text)) {
      stated_separator_ = stated;
      return;
    }
    header_text_ = text;
    if (text.starts_with("% ")) text = trimmed(text.substr(1));  // a comment of MATLAB
    for (const char separator : {',', ';', '\t', '|', ' ', stated_separator_}) {
      if (separator == 0 || (stated_separator_ != 0 && separator != stated_separator_)) continue;
      std::vector<std::string> names = names_in(text, separator);
      if (names.size() > k_most_columns) refuse_many_columns(text);
      while (names.size() > 1 && names.back().empty()) names.pop_back();  // after trailing separators
      if (is_stamped_) names.emplace_back("time");
      Header header = find_columns(names, options_);
      if (!header.has_angles) continue;
      separator_ = separator;
      return take_header(names, std::move(header));
    }
    remember_likely_header(text);
  }

  /// Throws for a text that is no table, by its first line.
  void refuse_other_format(std::string_view line) const {
    const auto refuse_as = [&](const std::string& message, const std::string& hint) {
      const Diagnostic problem{Severity::error, place(line_, 1), message, hint};
      throw InputError(problem);
    };
    const std::string export_hint = "write a CSV text: the names of the columns, then a line of values for each time";
    if (line.starts_with("{") || line.starts_with("[{") || line.starts_with("[["))
      refuse_as("is JSON and no table", export_hint);
    if (line.starts_with("<") && line.find('>') != std::string_view::npos)
      refuse_as("is XML or HTML and no table", export_hint);
    const std::string label = label_of(line);
    if (!label.empty())
      refuse_as("each value follows its name, as in " + shown(label),
                "write the names once, in the first line, such as alpha_deg,theta_deg, and the values alone below");
  }

  /// "alpha:17.7" if a line begins with a name and its value; else empty.
  static std::string label_of(std::string_view line) {
    if (line.starts_with(">")) line.remove_prefix(1);
    const std::string_view cell = line.substr(0, line.find_first_of(", ;\t|"));
    const std::size_t mark = cell.find_first_of(":=");
    if (mark == std::string_view::npos || mark == 0 || mark + 1 == cell.size()) return {};
    double value = 0;
    const bool is_name = std::isalpha(static_cast<unsigned char>(cell.front())) != 0;
    return is_name && read_number(cell.substr(mark + 1), value) == CellContent::number ? std::string(cell)
                                                                                       : std::string();
  }

  [[noreturn]] void refuse_many_columns(std::string_view text) const {
    refuse_other_format(text);
    const Diagnostic problem{Severity::error, place(line_, 1),
                             "the header names more than " + std::to_string(k_most_columns) + " columns",
                             "measured data need only a few"};
    throw InputError(problem);
  }

  void take_header(const std::vector<std::string>& names, Header header) {
    for (Diagnostic& problem : header.problems) fail(1, std::move(problem.message), std::move(problem.hint));
    if (!problems_.empty()) refuse();
    columns_ = std::move(header.columns);
    logged_.notes = std::move(header.notes);
    logged_.sources.clear();
    if (!header.unused.empty()) logged_.sources.push_back("columns that are not used: " + quoted_list(header.unused));
    column_count_ = names.size();
    begin_tracks();
    if (preamble_lines_ > 0)
      logged_.notes.push_back("the header is line " + std::to_string(line_) + ": the lines above are omitted");
  }

  /// Remembers the likeliest header of a file without known names: the first line above a row of as many numbers, else
  /// the first line. Takes it as the header if words in its names choose the angles.
  void remember_likely_header(std::string_view text) {
    HeaderLine here{std::string(text), names_in(text, stated_separator_ ? stated_separator_ : separator_of(text)),
                    line_};
    const bool is_row_below_names =
        all_numbers(here.names) && !all_numbers(line_above_.names) && line_above_.names.size() == here.names.size();
    if (preamble_lines_ == 0) {
      likely_header_ = here;
    } else if (!is_likely_above_numbers_ && is_row_below_names) {
      likely_header_ = line_above_;
      is_likely_above_numbers_ = true;
      if (take_likely_header()) return;
    }
    line_above_ = std::move(here);
    if (++preamble_lines_ > k_longest_preamble) refuse_without_header();
  }

  /// Takes the line above a row of numbers if words in its names choose the angles.
  bool take_likely_header() {
    std::vector<std::string> names = likely_header_.names;
    if (is_stamped_) names.emplace_back("time");
    Header header = find_columns(names, options_, true);
    if (!header.has_angles) return false;
    separator_ = stated_separator_ != 0 ? stated_separator_ : separator_of(likely_header_.text);
    header_text_ = likely_header_.text;
    --preamble_lines_;  // the header itself does not count
    const long long row_line = std::exchange(line_, likely_header_.line);
    take_header(names, std::move(header));
    line_ = row_line;
    is_header_above_ = true;
    return true;
  }

  [[noreturn]] void refuse_without_header() {
    if (preamble_lines_ == 0) {
      const Diagnostic problem{Severity::error, place(0, 0), "has no header", k_usual_header};
      throw InputError(problem);
    }
    line_ = likely_header_.line;
    refuse_other_format(likely_header_.text);
    if (all_numbers(likely_header_.names)) {
      const bool in_comment = comment_.find("alpha") != std::string::npos;
      fail(1, "the first line has numbers: there is no header",
           in_comment ? "line " + std::to_string(line_) + " follows a comment that may be the header: remove its #"
                      : k_usual_header);
    } else {
      for (Diagnostic& problem : find_columns(likely_header_.names, options_).problems)
        fail(1, std::move(problem.message), std::move(problem.hint));
    }
    refuse();
  }

  const Column* column_of_role(const std::string& role) const {
    const auto found =
        std::find_if(columns_.begin(), columns_.end(), [&](const Column& column) { return column.role == role; });
    return found == columns_.end() ? nullptr : &*found;
  }

  /// True if the row repeats the header.
  bool is_header(const std::vector<std::string_view>& values) const {
    return std::all_of(columns_.begin(), columns_.end(), [&](const Column& column) {
      return (is_stamped_ && column.index + 1 == column_count_) || is_same_name(values[column.index], column.name);
    });
  }

  /// True if a line names the angles, with any separator.
  bool names_columns(std::string_view text) const {
    return std::any_of(std::begin(k_separators), std::end(k_separators),
                       [&](char separator) { return find_columns(names_in(text, separator), options_).has_angles; });
  }

  // ---- units below the header

  /// True if the row has units for the columns, and nothing else.
  bool is_units_row() const {
    bool has_unit = false;
    for (const Column& column : columns_) {
      const std::string_view cell = without_brackets(values_[column.index]);
      if (column.quantity == Quantity::none || cell.empty() || cell == "-") continue;
      if (find_unit(column.quantity, cell) == nullptr) return false;
      has_unit = true;
    }
    return has_unit;
  }

  void take_units_row() {
    for (Column& column : columns_) {
      const Unit* const unit = find_unit(column.quantity, without_brackets(values_[column.index]));
      if (unit == nullptr || column.is_given) continue;
      const Unit* const stated = parse_column_name(column.name, column.quantity).unit;
      if (stated != nullptr && stated != unit) {
        fail(column_of(values_[column.index]),
             column.name + " is in " + std::string(stated->name) + " by its name, but in " + std::string(unit->name) +
                 " by the line below it",
             "select one with --unit " + column.role + "=" + std::string(unit->name) + " or --unit " + column.role +
                 "=" + std::string(stated->name));
        continue;
      }
      column.unit = unit;
      std::erase_if(logged_.notes,
                    [&](const std::string& note) { return note.starts_with(column.role + ": taken as "); });
    }
    if (!problems_.empty()) refuse();
    logged_.notes.push_back("line " + std::to_string(line_) + " has the units of the columns");
  }

  /// A repeated header: the logger restarted, and its output since the last row is not data.
  void begin_again() {
    if (repeated_headers_++ == 0) first_repeat_ = line_;
    // A row has at most one fault.
    dropped_rows_ += faults_ - faults_at_last_row_ + (short_row_.message.empty() ? 0 : 1);
    problems_ = problems_at_last_row_;
    faults_ = faults_at_last_row_;
    short_row_ = {};
    may_have_units_ = true;
    keeper_.begin_again();
  }

  // ---- numbers with times of their own

  /// A table of PlotJuggler has a row for each time at which any number was logged, with empty cells for the others.
  /// The numbers are joined as those of a bag.
  void begin_tracks() {
    const Column* const time = column_of_role("time");
    const bool is_ros = std::any_of(columns_.begin(), columns_.end(), [](const Column& column) {
      return column.quantity == Quantity::angle && is_ros_name(column.name);
    });
    if (!is_ros || time == nullptr || time->unit == nullptr) return;
    for (const Column& column : columns_) {
      if (column.role == "time" || member_of(column.role) == nullptr) continue;
      Track& track = tracks_.emplace_back();
      track.role = column.role;
      track.half_turn = half_turn(column);
    }
  }

  void add_to_tracks(const Sample& sample) {
    const double time = sample.time * column_of_role("time")->unit->factor;  // s
    constexpr double k_last_second = 4e9, k_since_1970 = 9e8;                // s; the years 2096 and 1998
    if (!(std::abs(time) < k_last_second)) return;
    // In s since 1970, a double resolves microseconds; else nanoseconds.
    const std::int64_t tick = time > k_since_1970 ? 1000 : 1;  // ns
    const std::int64_t rounded_time = std::llround(time * 1e9 / static_cast<double>(tick)) * tick;
    for (Track& track : tracks_) {
      const double value = sample.*member_of(track.role);
      if (!std::isnan(value)) track.add({rounded_time, value, logged_.rows});
    }
  }

  void join_tracks() {
    const JoinedRows joined = join(tracks_, options_.needs_theta, keeper_);
    logged_.notes.insert(logged_.notes.end(), joined.notes.begin(), joined.notes.end());
    logged_.rows = joined.rows;
    // The joined rows have their time in s.
    for (Column& column : columns_) {
      if (column.role == "time")
        column = {.index = column.index,
                  .role = "time",
                  .name = column.name,
                  .quantity = Quantity::time,
                  .unit = usual_unit(Quantity::time)};
    }
  }

  // ---- rows

  void take_row(std::string_view text) {
    split_cells(text, separator_, values_);
    while (values_.size() > column_count_ && values_.back().empty())
      values_.pop_back();  // some loggers and spreadsheets end each row with separators
    if (values_.size() == column_count_ && is_header(values_)) return begin_again();
    if (text.size() > header_text_.size() && text.ends_with(header_text_)) {
      ++dropped_rows_;  // the restart came in the middle of a row
      return begin_again();
    }
    if (std::exchange(may_have_units_, false) && values_.size() == column_count_ && is_units_row()) {
      if (logged_.rows == 0) take_units_row();
      return;
    }
    if (logged_.rows == 0 && repeated_headers_ == 0 && names_columns(text)) return replace_header(text);
    if (!short_row_.message.empty()) fail(std::exchange(short_row_, {}), "count");
    ++logged_.rows;
    if (values_.size() != column_count_) return report_wrong_count(values_.size());
    numbers_.settle_mark(values_);
    Sample sample{k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, false};
    for (Column& column : columns_) {
      if (!take_cell(column, values_[column.index], sample)) return;
    }
    keep(sample);
  }

  /// The line taken for the header was prose that names the angles.
  void replace_header(std::string_view text) {
    columns_.clear();
    tracks_.clear();
    logged_.notes.clear();
    ++preamble_lines_;
    find_header(text);
  }

  /// False if the cell is not a value of that column; reports the fault.
  bool take_cell(Column& column, std::string_view cell, Sample& sample) {
    double value = k_nan;
    if (!read_value(column, cell, value)) {
      report_text(column, cell);
      return false;
    }
    if (std::isnan(value)) return true;
    if (!is_possible(column, cell, value)) return false;
    column.take_value(value);
    if (double Sample::*const to = member_of(column.role)) sample.*to = value;
    double* const mounting = mounting_of(logged_.mounting, column.role);
    return mounting == nullptr || take_mounting(column, cell, value * column.unit->factor, *mounting);
  }

  bool read_value(Column& column, std::string_view cell, double& value) {
    const CellContent content = numbers_.read(cell, value);
    if (column.quantity != Quantity::time) return content != CellContent::text;
    // Either all times are numbers, or all are time stamps.
    const bool had_numbers = !column.is_date && column.most >= column.least;
    if (content != CellContent::text) return content == CellContent::missing || !column.is_date;
    const std::optional<double> stamp = had_numbers ? std::nullopt : read_time_stamp(cell);
    if (!stamp) return false;
    column.is_date = true;
    value = *stamp;
    return true;
  }

  bool is_possible(const Column& column, std::string_view cell, double value) {
    const bool is_angle = column.quantity == Quantity::angle && column.unit != nullptr;
    if (is_angle && std::abs(value) * column.unit->factor > radians(k_largest_deg)) {
      fail(column_of(cell), column.name + " = " + shortest(value) + " is not an angle",
           "leave the cell empty where nothing was logged", "angle " + column.role);
      return false;
    }
    if (std::abs(value) > (column.quantity == Quantity::time ? k_largest_time : k_largest_value)) {
      fail(column_of(cell), column.name + " = " + shortest(value) + " is too large for a measured value",
           "leave the cell empty where nothing was logged", "large " + column.role);
      return false;
    }
    return true;
  }

  bool take_mounting(const Column& column, std::string_view cell, double angle, double& mounting) {
    const bool is_first_value = mounted_.insert(column.role).second;
    if (is_first_value) {
      mounting = angle;
    } else if (mounting != angle) {
      fail(column_of(cell), column.name + " changes within the run", "use one file for each mounting of the encoders",
           "mounting " + column.role);
      return false;
    }
    return true;
  }

  void report_wrong_count(std::size_t count) {
    const std::string message =
        "the row has " + std::to_string(count) + " values, the header " + std::to_string(column_count_);
    if (count > column_count_ && separator_ == ',' && logged_.rows == 1) {
      fail(1, message,
           "if commas are the decimal marks, separate the values with ; as in 1,5;2,5; otherwise name every column");
      refuse();
    }
    if (names_columns(line_text_)) refuse_other_header();
    const std::string hint = count == 1              ? "separate the values by the same mark as the names"
                             : count > column_count_ ? "name every column, also one of row numbers, or remove the value"
                                                     : "remove or complete the row";
    Diagnostic problem{Severity::error, place(line_, 1), message, hint};
    if (count < column_count_) {
      short_row_ = problem;
    } else {
      fail(std::move(problem), "count");
    }
  }

  /// The logger restarted with other columns.
  [[noreturn]] void refuse_other_header() {
    fail(1, "this line names the columns again, but not as the first header",
         "split the file here and give both files");
    refuse();
  }

  void report_text(const Column& column, std::string_view cell) {
    const std::string message = column.name + ": " + shown(cell) + " is not a number";
    double value = 0;
    const bool all_text = std::all_of(values_.begin(), values_.end(),
                                      [&](std::string_view v) { return read_number(v, value) != CellContent::number; });
    if (all_text && logged_.rows == 1) {
      return fail(column_of(cell), message, "is this a second header line? Begin it with #");
    }
    if (all_text && names_columns(line_text_)) refuse_other_header();
    fail(column_of(cell), message,
         column.quantity == Quantity::time
             ? "write numbers, or time stamps as 2025-03-01T10:00:00.020 in all rows"
             : "write one number per cell, with one decimal mark in the whole file; leave "
               "the cell empty where nothing was logged",
         "number " + column.role);
  }

  void keep(const Sample& sample) {
    if (faults_ != faults_at_last_row_) problems_at_last_row_ = problems_;
    faults_at_last_row_ = faults_;
    if (!tracks_.empty()) return add_to_tracks(sample);
    if (std::isnan(sample.alpha) || (options_.needs_theta && std::isnan(sample.theta))) {
      logged_.without_theta += !std::isnan(sample.alpha);
      if (logged_.without_angle++ == 0) logged_.first_without_angle = line_;
      return;
    }
    keeper_.add(sample);
  }

  const std::string& name_;
  const MeasurementOptions& options_;
  RowKeeper keeper_;
  std::vector<Track> tracks_;  ///< empty: each row is complete
  LoggedRows logged_;
  std::vector<Column> columns_;           ///< empty until the header is found
  std::vector<std::string_view> values_;  ///< cells of the current row
  NumberReader numbers_;
  std::set<std::string> mounted_;  ///< mounting roles that already have their value
  std::vector<Fault> problems_, problems_at_last_row_;
  Diagnostic short_row_;        ///< the last row has too few values; no fault if the log ends there
  std::string_view line_text_;  ///< the current record, for column numbers in messages
  std::string comment_;         ///< the last comment above the header
  std::string header_text_;
  std::string stamped_row_;  ///< the current row with its stamp as the last cell
  HeaderLine likely_header_, line_above_;
  char separator_ = ',';
  char stated_separator_ = 0;             ///< of a "sep=;" line; 0 without one
  bool is_likely_above_numbers_ = false;  ///< the likely header stands above a row of as many numbers
  bool is_header_above_ = false;          ///< the header was found only with the row below it
  bool is_stamped_ = false;               ///< a serial monitor put the time of day before the header
  bool may_have_units_ = true;            ///< the next row may state the units
  std::size_t preamble_lines_ = 0, repeated_headers_ = 0, dropped_rows_ = 0, padded_lines_ = 0;
  std::size_t faults_ = 0, faults_at_last_row_ = 0;
  std::size_t column_count_ = 0;
  long long line_ = 0;          ///< of the current record
  long long first_repeat_ = 0;  ///< line of the first repeated header
  long long first_padded_line_ = 0;
};

std::string rows_text(std::size_t count) { return std::to_string(count) + (count == 1 ? " row" : " rows"); }

std::string unit_for(const std::string& role, const std::string& spelling) {
  const Unit* unit = find_unit(quantity_of(role), spelling);
  return unit == nullptr ? "" : std::string(unit->name);
}

std::string units_for(const std::string& role) { return unit_names(quantity_of(role)); }

void check_roles(const MeasurementOptions& options) {
  std::vector<std::string> roles;
  std::string list;
  for (const auto& [role, column] : column_roles()) {
    roles.push_back(role);
    list += (list.empty() ? "" : ", ") + role;
  }
  const auto check = [&](const std::string& role) {
    if (std::find(roles.begin(), roles.end(), role) != roles.end()) return;
    const std::string nearest = nearest_word(role, roles);
    throw InputError("", "there is no role " + shown(role) + " for a column",
                     nearest.empty() ? "roles: " + list : "did you mean " + nearest + "?");
  };
  for (const auto& [role, column] : options.columns) check(role);
  for (const auto& [role, unit] : options.units) {
    check(role);
    if (unit_for(role, unit).empty())
      throw InputError("", "there is no unit " + shown(unit) + " of " + role, "units: " + units_for(role));
  }
  for (const auto& [role, ticks] : options.ticks_per_turn) {
    if (member_of(role) == nullptr || quantity_of(role) != Quantity::angle || !(std::abs(ticks) >= 2))
      throw InputError("", "give counts a turn for alpha or theta, 2 or more (negative if they fall)");
  }
  for (const auto& [role, ticks] : options.zero_ticks) {
    if (member_of(role) == nullptr || quantity_of(role) != Quantity::angle || !std::isfinite(ticks))
      throw InputError("", "give counts at home for alpha or theta");
  }
  for (const auto& [role, reading] : options.home_readings) {
    if (member_of(role) == nullptr || quantity_of(role) != Quantity::angle || !std::isfinite(reading))
      throw InputError("", "give readings at home for alpha or theta");
    if (options.zero_ticks.count(role) > 0)
      throw InputError("", "two readings of " + role + " at home: leave out the counts or the other");
  }
}

struct CsvReader::Parts {
  Parts(const std::string& name, const MeasurementOptions& options, std::size_t most_samples)
      : rows(name, options, most_samples),
        records([this](const Record& record) { rows.take(record); },
                [this](long long line, bool open_quote) { rows.refuse_long(line, open_quote); }) {}

  RowReader rows;
  RecordSplitter records;
};

CsvReader::CsvReader(const std::string& name, const MeasurementOptions& options, std::size_t most_samples)
    : parts_(std::make_unique<Parts>(name, options, most_samples)) {}
CsvReader::~CsvReader() = default;

void CsvReader::add(std::string_view block) { parts_->records.add(block); }

LoggedRows CsvReader::finish() {
  parts_->records.finish();
  return parts_->rows.finish();
}

void settle_rows(std::vector<Column>& columns, const MeasurementOptions& options, const std::string& name,
                 LoggedRows& rows) {
  const auto has = [&](const std::string& role) {
    return std::any_of(columns.begin(), columns.end(), [&](const Column& column) { return column.role == role; });
  };
  rows.has_time = has("time");
  rows.has_load = has("load");
  rows.has_temperature = has("temperature");
  const std::string units = settle_units(columns, rows.samples, options, name);
  if (!units.empty()) rows.notes.push_back(units);
  for (const Column& column : columns) {
    if (column.role == "load") rows.load_unit = column.unit->base;
  }
}

}  // namespace fusee::measurement
