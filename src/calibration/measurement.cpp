#include "fusee/calibration/measurement.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

#include "calibration/strokes.h"
#include "fusee/base/text.h"

// From bytes to runs in three steps:
//   1. Rows: the file is read line by line in bounded memory; a run too long to keep is thinned as it comes.
//   2. Repair: order in time, wrap-around, outliers; each said in a note.
//   3. Strokes, and whether anything can be concluded from them at all.

namespace fusee {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
/// Samples kept of one run: beyond that every second one goes, again and again.
constexpr std::size_t k_most_samples = std::size_t{1} << 20;
constexpr std::size_t k_longest_line = std::size_t{1} << 16;
constexpr std::size_t k_most_columns = 1000;
constexpr std::size_t k_most_problems = 20;
constexpr std::size_t k_fewest_samples = 20;
constexpr double k_largest_deg = 1e7;

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return text;
}

/// Bytes of a file as a message may show them.
std::string shown(std::string_view text) {
  std::string words;
  for (const char c : text.substr(0, 40)) words += static_cast<unsigned char>(c) < 0x20 || c == 0x7f || (c & 0x80) ? '?' : c;
  return "\"" + words + (text.size() > 40 ? "…\"" : "\"");
}

std::vector<std::string_view> cells(std::string_view line, char separator) {
  std::vector<std::string_view> parts;
  while (parts.size() < k_most_columns) {
    const std::size_t end = line.find(separator);
    parts.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  return parts;
}

char separator_of(std::string_view header) {
  for (const char separator : {',', ';', '\t'}) {
    if (header.find(separator) != std::string_view::npos) return separator;
  }
  return ',';
}

enum class Cell { number, missing, text };

/// "", "nan" and "inf" are what loggers write when there was nothing to write.
Cell read_cell(std::string_view text, double& value) {
  value = k_nan;
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  if (text.empty()) return Cell::missing;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || (error != std::errc() && error != std::errc::result_out_of_range)) {
    value = k_nan;
    const std::string_view known[] = {"NaN", "NAN", "nan", "NA", "null", "None"};
    return std::find(std::begin(known), std::end(known), text) != std::end(known) ? Cell::missing : Cell::text;
  }
  if (error != std::errc() || !std::isfinite(value)) value = k_nan;
  return std::isnan(value) ? Cell::missing : Cell::number;
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

// ---- 1. rows --------------------------------------------------------------------------------------------------------

class RowReader {
 public:
  RowReader(const std::string& name, const MeasurementOptions& options) : name_(name), options_(options) {}

  void line(std::string_view text) {
    ++line_;
    if (line_ == 1 && text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    if (text.find('\0') != std::string_view::npos) throw InputError(name_, "is a binary file (line " + std::to_string(line_) + ")", "measured data are a CSV text");
    text = trimmed(text.substr(0, text.find('#')));
    if (text.empty()) return;
    if (columns_.empty()) return header(text);
    row(text);
  }

  void finish() {
    if (columns_.empty()) fail(0, "holds no header", "the first line names the columns: alpha_deg,theta_deg and, if logged, time_s,load_N");
    if (!problems_.empty()) throw InputError(problems_);
  }

  std::vector<Sample> samples;
  bool has(const std::string& role) const { return present_.count(role) > 0; }
  std::string column_of(const std::string& role) const {
    const auto found = options_.columns.find(role);
    if (found != options_.columns.end()) return found->second;
    for (const auto& [known, column] : column_roles()) {
      if (known == role) return column;
    }
    return {};
  }
  std::size_t stride() const { return stride_; }
  std::size_t without_number() const { return without_number_; }
  int first_without_number() const { return first_without_number_; }
  std::size_t rows() const { return rows_; }

 private:
  struct Column {
    std::size_t index = 0;
    std::string role;
  };

  void fail(int at, std::string message, std::string hint) {
    problems_.push_back({Severity::error, {name_, at, at > 0 ? 1 : 0}, std::move(message), std::move(hint)});
    if (problems_.size() >= k_most_problems) throw InputError(problems_);
  }

  void header(std::string_view text) {
    separator_ = separator_of(text);
    std::vector<std::string> names;
    for (const std::string_view cell : cells(text, separator_)) names.emplace_back(cell);
    count_ = names.size();
    for (const auto& [role, usual] : column_roles()) {
      const std::string wanted = column_of(role);
      const auto found = std::find(names.begin(), names.end(), wanted);
      if (found != names.end()) {
        columns_.push_back({static_cast<std::size_t>(found - names.begin()), role});
        present_.insert(role);
        if (std::find(found + 1, names.end(), wanted) != names.end()) fail(line_, "two columns are called " + wanted, "each column needs a name of its own");
      } else if (role == "alpha" || role == "theta" || options_.columns.count(role) > 0) {
        missing(role, wanted, names);
      }
    }
    if (!problems_.empty()) throw InputError(problems_);
  }

  void missing(const std::string& role, const std::string& wanted, const std::vector<std::string>& names) {
    std::string nearest = nearest_word(wanted, names);
    for (const std::string& name : names) {
      if (nearest.empty() && name.find(role) != std::string::npos) nearest = name;
    }
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + shown(name).substr(0, 44);
    const std::string hint = nearest.empty() ? "the columns are " + list.substr(0, 400) + "; --column " + role + "=NAME says which one it is"
                                             : "the nearest is " + shown(nearest) + ": --column " + role + "=" + nearest + " takes it (angles in degrees)";
    fail(line_, "there is no column " + wanted, hint);
  }

  void row(std::string_view text) {
    ++rows_;
    const std::vector<std::string_view> values = cells(text, separator_);
    if (values.size() != count_) {
      // A log that was cut off ends in the middle of a row.
      return fail(line_, "the row has " + std::to_string(values.size()) + " values, the header " + std::to_string(count_), "remove the row, or complete it");
    }
    Sample sample{k_nan, k_nan, k_nan, k_nan, k_nan, k_nan, k_nan};
    for (const Column& column : columns_) {
      double value = k_nan;
      if (read_cell(values[column.index], value) == Cell::text) {
        return fail(line_, column_of(column.role) + ": " + shown(values[column.index]) + " is not a number", "numbers with a decimal point, one a cell; leave the cell empty where nothing was logged");
      }
      const bool is_angle = column.role == "alpha" || column.role == "theta";
      if (is_angle && std::abs(value) > k_largest_deg) return fail(line_, column_of(column.role) + " = " + shortest(value) + " deg is no angle", "angles are in degrees");
      if (double* place = member(sample, column.role)) *place = is_angle ? radians(value) : value;
    }
    keep(sample);
  }

  void keep(const Sample& sample) {
    if (std::isnan(sample.alpha) || std::isnan(sample.theta)) {
      if (without_number_++ == 0) first_without_number_ = line_;
      return;
    }
    if (counter_++ % stride_ != 0) return;
    samples.push_back(sample);
    if (samples.size() < k_most_samples) return;
    for (std::size_t i = 0; 2 * i < samples.size(); ++i) samples[i] = samples[2 * i];
    samples.resize((samples.size() + 1) / 2);
    stride_ *= 2;
    counter_ = 0;
  }

  const std::string& name_;
  const MeasurementOptions& options_;
  std::vector<Column> columns_;
  std::set<std::string> present_;
  std::vector<Diagnostic> problems_;
  char separator_ = ',';
  std::size_t count_ = 0, rows_ = 0, stride_ = 1, counter_ = 0, without_number_ = 0;
  int line_ = 0, first_without_number_ = 0;
};

void read_text(std::string_view text, RowReader& reader) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    reader.line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  reader.finish();
}

/// In blocks: a log may be larger than the memory.
void read_stream(const std::filesystem::path& path, const std::string& name, RowReader& reader) {
  std::error_code problem;
  const auto kind = std::filesystem::status(path, problem).type();
  if (kind == std::filesystem::file_type::not_found) throw InputError(name, "there is no such file");
  if (kind != std::filesystem::file_type::regular) throw InputError(name, "is not a regular file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(name, "cannot be read");
  std::vector<char> block(std::size_t{1} << 20);
  std::string rest;
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    std::string_view bytes(block.data(), static_cast<std::size_t>(stream.gcount()));
    while (!bytes.empty()) {
      const std::size_t end = bytes.find('\n');
      rest.append(bytes.substr(0, end));
      if (rest.size() > k_longest_line) throw InputError(name, "has a line of more than " + std::to_string(k_longest_line) + " bytes: this is no table of measured data");
      if (end == std::string_view::npos) break;
      reader.line(rest);
      rest.clear();
      bytes.remove_prefix(end + 1);
    }
  }
  if (stream.bad()) throw InputError(name, "cannot be read to its end");
  if (!rest.empty()) reader.line(rest);
  reader.finish();
}

// ---- 2. repair ------------------------------------------------------------------------------------------------------

using Say = std::function<void(const std::string&)>;

std::string rows_text(std::size_t count) { return std::to_string(count) + (count == 1 ? " row" : " rows"); }

/// A clock that starts again goes on where it stopped; single rows out of order are put in order; rows of the same time become
/// one, their mean. Afterwards time grows from row to row.
void order_time(Run& run, const Say& say) {
  std::vector<Sample>& samples = run.samples;
  const auto lost = static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), [](const Sample& s) { return std::isnan(s.time); }));
  if (lost > 0) {
    say(rows_text(lost) + " without a time: time is not used");
    run.has_time = false;
    for (Sample& sample : samples) sample.time = k_nan;
    return;
  }
  std::size_t back = 0, restarts = 0;
  double shift = 0, last = samples.front().time;
  const double first = last;
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) steps.push_back(std::abs(samples[i].time - samples[i - 1].time));
  const double usual = median_of(steps);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double here = samples[i].time;
    if (here < last) {
      const bool restart = here - first < 2 * usual && last - here > 100 * usual;
      if (restart) shift += last - here + usual;
      ++(restart ? restarts : back);
    }
    last = here;
    samples[i].time = here + shift;
  }
  if (restarts > 0) say("the clock starts again " + std::to_string(restarts) + " times: taken as one motion");
  if (back > 0) {
    std::stable_sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.time < b.time; });
    say("time goes back " + std::to_string(back) + " times: rows were put in order");
  }
  std::vector<Sample> merged;
  std::size_t same = 0;
  for (std::size_t i = 0; i < samples.size();) {
    std::size_t end = i + 1;
    while (end < samples.size() && samples[end].time == samples[i].time) ++end;
    Sample mean = samples[i];
    for (double Sample::* value : {&Sample::alpha, &Sample::theta, &Sample::load, &Sample::temperature, &Sample::tension1, &Sample::tension2}) {
      double sum = 0;
      for (std::size_t j = i; j < end; ++j) sum += samples[j].*value;
      mean.*value = sum / static_cast<double>(end - i);
    }
    same += end - i - 1;
    merged.push_back(mean);
    i = end;
  }
  if (same > 0) say(rows_text(same) + " with the time of the row before: taken together, their mean");
  samples = std::move(merged);
}

/// An encoder that jumps by about a turn was wrapped around.
void unwrap(std::vector<Sample>& samples, double Sample::* angle, const std::string& name, const Say& say) {
  double shift = 0;
  std::size_t wraps = 0;
  double before = samples.front().*angle;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double here = samples[i].*angle;
    const double jump = here - before;
    before = here;
    if (std::abs(std::abs(jump) - k_two_pi) < radians(80.0)) {
      shift -= jump > 0 ? k_two_pi : -k_two_pi;
      ++wraps;
    }
    samples[i].*angle = here + shift;
  }
  if (wraps > 0) say(name + " jumps by a turn " + std::to_string(wraps) + " times: unwrapped");
}

double middle_of_five(const std::vector<Sample>& samples, double Sample::* angle, std::size_t i) {
  const std::size_t first = std::min(i < 2 ? 0 : i - 2, samples.size() - 5);
  std::array<double, 5> near{};
  for (std::size_t j = 0; j < 5; ++j) near[j] = samples[first + j].*angle;
  std::sort(near.begin(), near.end());
  return near[2];
}

/// Single rows far off the middle of their neighbours: dropped outs and spikes of a sensor, not motion.
void drop_outliers(Run& run, double Sample::* angle, const std::string& name, const Say& say) {
  std::vector<Sample>& samples = run.samples;
  if (samples.size() < k_fewest_samples) return;
  std::vector<double> off(samples.size(), 0);
  for (std::size_t i = 2; i + 2 < samples.size(); ++i) off[i] = std::abs(samples[i].*angle - middle_of_five(samples, angle, i));
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i) steps.push_back(std::abs(samples[i].*angle - samples[i - 1].*angle));
  std::vector<double> sorted_steps = steps;
  std::nth_element(sorted_steps.begin(), sorted_steps.begin() + static_cast<std::ptrdiff_t>(sorted_steps.size() * 9 / 10), sorted_steps.end());
  const double limit = 12 * median_of(off) + 4 * sorted_steps[sorted_steps.size() * 9 / 10] + radians(0.02);
  const auto wild = static_cast<std::size_t>(std::count_if(off.begin(), off.end(), [limit](double value) { return value > limit; }));
  if (wild == 0 || wild > samples.size() / 50 + 1) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (off[i] <= limit) samples[kept++] = samples[i];
  }
  samples.resize(kept);
  say(rows_text(wild) + " with " + name + " more than " + rounded(degrees(limit), 2) + " deg off their neighbours: dropped as outliers");
}

/// The step of a sensor that only knows multiples of it; 0 when the values are finer than can be told.
double quantum_of(const std::vector<Sample>& samples, double Sample::* angle) {
  std::vector<double> values;
  for (std::size_t i = 0; i < samples.size() && values.size() < 20000; ++i) values.push_back(samples[i].*angle);
  std::sort(values.begin(), values.end());
  constexpr double same = radians(1e-7);
  double least = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = values[i] - values[i - 1];
    if (step > same && (least == 0 || step < least)) least = step;
  }
  return least;
}

// ---- 3. what can be concluded ---------------------------------------------------------------------------------------

double span_of(const std::vector<Sample>& samples, double Sample::* angle) {
  double least = samples.front().*angle, most = least;
  for (const Sample& sample : samples) {
    least = std::min(least, sample.*angle);
    most = std::max(most, sample.*angle);
  }
  return most - least;
}

void describe(Run& run) {
  if (run.has_time) {
    std::vector<double> speeds;
    for (std::size_t i = 1; i < run.samples.size(); ++i) {
      const double step = run.samples[i].time - run.samples[i - 1].time;
      if (step > 0) speeds.push_back(std::abs(run.samples[i].alpha - run.samples[i - 1].alpha) / step);
    }
    run.speed = median_of(std::move(speeds));
  }
  if (!run.has_load) return;
  double sum = 0;
  std::size_t count = 0;
  for (const Sample& sample : run.samples) {
    if (std::isnan(sample.load)) continue;
    sum += sample.load;
    ++count;
  }
  if (count > 0) run.mean_load = sum / static_cast<double>(count);
}

/// A load that was not logged for a moment is the last one that was.
void fill_load(Run& run, const Say& say) {
  std::size_t lost = 0;
  double last = k_nan;
  for (const Sample& sample : run.samples) {
    if (std::isnan(last)) last = sample.load;
  }
  if (std::isnan(last)) {
    run.has_load = false;
    return;
  }
  for (Sample& sample : run.samples) {
    if (std::isnan(sample.load)) {
      sample.load = last;
      ++lost;
    }
    last = sample.load;
  }
  if (lost > 0) say(rows_text(lost) + " without a load: the load before was taken");
}

void look_at_run(Run& run, Measurement& into, const Say& say) {
  const auto refuse = [&](const std::string& reason) { into.not_testable.push_back(run.name + ": " + reason); };
  if (run.samples.size() < k_fewest_samples) {
    return refuse(rows_text(run.samples.size()) + " that can be used; at least " + std::to_string(k_fewest_samples) + " are needed");
  }
  const double alpha_span = span_of(run.samples, &Sample::alpha), theta_span = span_of(run.samples, &Sample::theta);
  if (alpha_span < radians(1e-6)) return refuse("alpha does not change: the motor did not move, or its sensor is dead");
  if (theta_span < radians(1e-6)) return refuse("theta does not change while alpha moves over " + rounded(degrees(alpha_span)) + " deg: the joint's sensor is dead, or the joint is stuck");
  if (run.strokes.empty()) return refuse("alpha only jitters: no motion in it");
  const bool up = std::any_of(run.strokes.begin(), run.strokes.end(), [](const Stroke& s) { return s.direction > 0; });
  const bool down = std::any_of(run.strokes.begin(), run.strokes.end(), [](const Stroke& s) { return s.direction < 0; });
  if (!up || !down) say("alpha moves in one direction only");
  if (run.strokes.front().partial) {
    say("the first stroke (" + rows_text(run.strokes.front().last - run.strokes.front().first + 1) + ") does not begin at a reversal: its play is not known, it is left out");
  }
}

/// Rows with the sensor at one value while α goes on: θ frozen for a part of the run.
void look_for_freezes(const Run& run, Measurement& into) {
  const double theta_span = span_of(run.samples, &Sample::theta), alpha_span = span_of(run.samples, &Sample::alpha);
  std::size_t first = 0;
  double longest = 0;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    if (run.samples[i].theta != run.samples[first].theta) first = i;
    double way = 0;
    if (i - first > 10) way = std::abs(run.samples[i].alpha - run.samples[first].alpha);
    longest = std::max(longest, way);
  }
  if (theta_span > 0 && longest > 0.4 * alpha_span) {
    into.not_testable.push_back(run.name + ": theta stands still while alpha moves over " + rounded(degrees(longest), 3) + " deg: a frozen sensor or a saturated one");
  }
}

Run make_run(const std::string& name, RowReader& reader, Measurement& into) {
  const Say say = [&](const std::string& words) { into.notes.push_back(name + ": " + words); };
  Run run;
  run.name = name;
  run.samples = std::move(reader.samples);
  run.has_time = reader.has("time");
  run.has_load = reader.has("load");
  run.has_temperature = reader.has("temperature");
  if (reader.stride() > 1) say("too long to keep whole: every " + std::to_string(reader.stride()) + "th row is used");
  if (reader.without_number() > 0) {
    say(rows_text(reader.without_number()) + " without alpha or theta, the first in line " + std::to_string(reader.first_without_number()) + ": left out");
    if (2 * reader.without_number() > reader.rows()) into.not_testable.push_back(name + ": more than half of the rows hold no angle");
  }
  if (!run.samples.empty()) {
    if (run.has_time) order_time(run, say);
    unwrap(run.samples, &Sample::alpha, "alpha", say);
    unwrap(run.samples, &Sample::theta, "theta", say);
    drop_outliers(run, &Sample::alpha, "alpha", say);
    drop_outliers(run, &Sample::theta, "theta", say);
    if (run.has_load) fill_load(run, say);
    into.alpha_quantum = std::max(into.alpha_quantum, quantum_of(run.samples, &Sample::alpha));
    into.theta_quantum = std::max(into.theta_quantum, quantum_of(run.samples, &Sample::theta));
    run.strokes = split_strokes(run.samples, quantum_of(run.samples, &Sample::alpha), run.has_time);
    describe(run);
    look_for_freezes(run, into);
  }
  look_at_run(run, into, say);
  if (run.has_load) {
    const std::string column = reader.column_of("load");
    const std::size_t mark = column.rfind('_');
    into.load_unit = mark == std::string::npos ? "" : column.substr(mark + 1);
  }
  return run;
}

void check_roles(const MeasurementOptions& options) {
  std::vector<std::string> roles;
  for (const auto& [role, column] : column_roles()) roles.push_back(role);
  for (const auto& [role, column] : options.columns) {
    if (std::find(roles.begin(), roles.end(), role) != roles.end()) continue;
    const std::string nearest = nearest_word(role, roles);
    throw InputError("", "there is no role " + shown(role) + " for a column", nearest.empty() ? "roles: alpha, theta, time, load, temperature, tension1, tension2, cycle" : "did you mean " + nearest + "?");
  }
}

/// Refused where all runs together move one way.
void look_at_directions(Measurement& measurement) {
  if (!measurement.not_testable.empty()) return;
  int up = 0, down = 0;
  for (const Run& run : measurement.runs) {
    for (const Stroke& stroke : run.strokes) ++(stroke.direction > 0 ? up : down);
  }
  if (up > 0 && down > 0) return;
  measurement.not_testable.push_back(std::string("alpha only ") + (up > 0 ? "grows" : "falls") + ": without the way back backlash, friction and delay cannot be told from a wrong shape; log both directions");
}

/// Files of one name in two folders are told apart by their paths.
std::vector<std::string> run_names(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const auto& file : files) {
    const std::string name = file.filename().string();
    const auto same = std::count_if(files.begin(), files.end(), [&](const auto& other) { return other.filename() == file.filename(); });
    names.push_back(same > 1 ? file.string() : name);
  }
  return names;
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& column_roles() {
  static const std::vector<std::pair<std::string, std::string>> roles = {
      {"alpha", "alpha_deg"},         {"theta", "theta_deg"},         {"time", "time_s"},             {"load", "load_N"},
      {"temperature", "temperature_C"}, {"tension1", "tension1_N"}, {"tension2", "tension2_N"}, {"cycle", "cycle"}};
  return roles;
}

Run parse_run(std::string_view text, const std::string& name, const MeasurementOptions& options, Measurement& into) {
  check_roles(options);
  RowReader reader(name, options);
  read_text(text, reader);
  return make_run(name, reader, into);
}

Measurement read_measurement(const std::vector<std::filesystem::path>& files, const MeasurementOptions& options) {
  check_roles(options);
  Measurement measurement;
  std::vector<Diagnostic> problems;
  const std::vector<std::string> names = run_names(files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string path = files[i].string();
    RowReader reader(path, options);
    try {
      read_stream(files[i], path, reader);
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.diagnostics().begin(), error.diagnostics().end());
      continue;
    }
    measurement.runs.push_back(make_run(names[i], reader, measurement));
  }
  if (!problems.empty()) throw InputError(problems);
  if (measurement.runs.empty()) measurement.not_testable.push_back("no run was given");
  look_at_directions(measurement);
  return measurement;
}

}  // namespace fusee
