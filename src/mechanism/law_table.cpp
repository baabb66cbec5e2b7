#include "mechanism/law_table.h"

#include <charconv>
#include <cmath>

#include "fusee/base/text.h"
#include "mechanism/field_text.h"

namespace fusee {
namespace {

constexpr double k_home_error_deg = 0.01;
constexpr std::size_t k_fewest_rows = 4;
/// More than anyone writes; keeps time and memory bounded.
constexpr std::size_t k_most_rows = 100000;
constexpr std::size_t k_most_problems = 20;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

bool parse_number(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

/// One row in degrees, with its line.
struct CsvRow {
  int line = 0;
  double alpha = 0;
  double theta = 0;
};

class LawTableReader {
 public:
  LawTableReader(const std::string& file, std::vector<Diagnostic>& problems) : file_(file), problems_(problems) {}

  void read(std::string_view csv) {
    if (csv.substr(0, 3) == "\xEF\xBB\xBF") csv.remove_prefix(3);
    for (int line = 1; !csv.empty() && problems_.size() < k_most_problems; ++line) {
      const std::size_t end = std::min(csv.find('\n'), csv.size());
      std::string_view text = csv.substr(0, end);
      csv.remove_prefix(std::min(end + 1, csv.size()));
      text = trimmed(text.substr(0, text.find('#')));
      if (!text.empty()) read_line(line, text);
    }
  }

  void check(const Joint& joint) {
    if (!problems_.empty()) return;
    if (!header_read_) return fail(0, "the table is empty", k_format_hint);
    if (rows_.size() < k_fewest_rows) {
      return fail(0,
                  "the table has " + std::to_string(rows_.size()) + " rows; a law needs at least " +
                      std::to_string(k_fewest_rows),
                  k_format_hint);
    }
    check_cover(joint);
    check_home();
  }

  std::vector<LawRow> rows() const {
    std::vector<LawRow> rows;
    rows.reserve(rows_.size());
    for (const CsvRow& row : rows_) rows.push_back({radians(row.alpha), radians(row.theta)});
    return rows;
  }

 private:
  static constexpr const char* k_format_hint =
      "first a line alpha_deg,theta_deg, then one pair of angles a line, both increasing";

  void fail(int line, std::string message, std::string hint) {
    problems_.push_back({Severity::error, {file_, line, line > 0 ? 1 : 0}, std::move(message), std::move(hint)});
  }

  void read_line(int line, std::string_view text) {
    const std::size_t comma = text.find(',');
    const std::string_view first = trimmed(text.substr(0, comma));
    const std::string_view second =
        comma == std::string_view::npos ? std::string_view() : trimmed(text.substr(comma + 1));
    if (!header_read_) {
      header_read_ = true;
      if (first == "alpha_deg" && second == "theta_deg") return;
      return fail(line, "the columns are " + in_quotes(text) + ", not alpha_deg,theta_deg", k_format_hint);
    }
    CsvRow row{line, 0, 0};
    if (!parse_number(first, row.alpha) || !parse_number(second, row.theta)) {
      return fail(line, in_quotes(text) + " is not two finite numbers", k_format_hint);
    }
    add(row);
  }

  void add(const CsvRow& row) {
    constexpr double k_largest_deg = 3600;
    if (std::abs(row.alpha) > k_largest_deg || std::abs(row.theta) > 360) {
      return fail(row.line,
                  "an angle is too large: alpha " + rounded(row.alpha) + " deg, theta " + rounded(row.theta) + " deg",
                  "angles are in degrees; alpha within +-3600, theta within +-360");
    }
    if (rows_.size() == k_most_rows)
      return fail(row.line, "the table has more than " + std::to_string(k_most_rows) + " rows", "leave rows out");
    if (!rows_.empty()) check_increasing("alpha_deg", rows_.back().alpha, row.alpha, row.line);
    if (!rows_.empty()) check_increasing("theta_deg", rows_.back().theta, row.theta, row.line);
    rows_.push_back(row);
  }

  void check_increasing(const char* column, double before, double here, int line) {
    if (here > before) return;
    fail(line,
         std::string(column) + " does not increase: " + shortest(here) + " deg after " + shortest(before) + " deg",
         "theta must grow with alpha, row by row");
  }

  void check_cover(const Joint& joint) {
    // Half a millionth of a degree: what a table printed with six decimals may lack.
    constexpr double k_rounding_deg = 5e-7;
    const double least = degrees(joint.theta_min), most = degrees(joint.theta_max);
    if (rows_.front().theta > least + k_rounding_deg) {
      fail(rows_.front().line,
           "theta begins at " + rounded(rows_.front().theta) + " deg, above joint.range_deg's " + rounded(least) +
               " deg",
           "add rows below, or raise the range's lower end");
    }
    if (rows_.back().theta < most - k_rounding_deg) {
      fail(rows_.back().line,
           "theta ends at " + rounded(rows_.back().theta) + " deg, below joint.range_deg's " + rounded(most) + " deg",
           "add rows above, or lower the range's upper end");
    }
  }

  void check_home() {
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      if (rows_[i - 1].alpha > 0 || rows_[i].alpha < 0) continue;
      const double theta = theta_at_zero(i);
      if (std::abs(theta) <= k_home_error_deg) return;
      return fail(rows_[i].line, "the law does not pass through home: theta is " + rounded(theta) + " deg at alpha = 0",
                  "shift the angles so that alpha = 0 gives theta = 0");
    }
    fail(rows_.front().line, "alpha = 0 (home) is not within the table", "add rows on both sides of alpha = 0");
  }

  /// θ(0) by the cubic through the four rows around the gap below row `i` (Lagrange).
  double theta_at_zero(std::size_t i) const {
    const std::size_t first = std::min(i < 2 ? 0 : i - 2, rows_.size() - 4);
    double theta = 0;
    for (std::size_t j = first; j < first + 4; ++j) {
      double weight = 1;
      for (std::size_t k = first; k < first + 4; ++k) {
        if (k != j) weight *= rows_[k].alpha / (rows_[k].alpha - rows_[j].alpha);
      }
      theta += weight * rows_[j].theta;
    }
    return theta;
  }

  const std::string& file_;
  std::vector<Diagnostic>& problems_;
  std::vector<CsvRow> rows_;
  bool header_read_ = false;
};

}  // namespace

std::vector<LawRow> parse_law_table(std::string_view csv, const std::string& file, const Joint& joint,
                                    std::vector<Diagnostic>& problems) {
  std::vector<Diagnostic> found;
  LawTableReader reader(file, found);
  reader.read(csv);
  reader.check(joint);
  problems.insert(problems.end(), found.begin(), found.end());
  return reader.rows();
}

}  // namespace fusee
