#include "mechanism/law_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.h"
#include "mechanism/field_text.h"

namespace fusee {
namespace {

constexpr double k_home_error_deg = 0.01;  ///< largest |θ| at α = 0
constexpr std::size_t k_min_rows = 4;      ///< rows that the interpolation of θ(0) uses
constexpr std::size_t k_max_problems = 20;
constexpr double k_largest_theta_deg = 360;

/// A number with a decimal point, or with a decimal comma where commas do not separate.
bool parse_number(std::string_view written, double& value, bool decimal_comma) {
  std::string text(written);
  if (decimal_comma && std::count(text.begin(), text.end(), ',') == 1 && text.find('.') == std::string::npos)
    std::replace(text.begin(), text.end(), ',', '.');
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

/// Names of the two columns of a table, the hint of its errors, and its maximum number of rows.
struct PairColumns {
  const char* first;
  const char* second;
  const char* hint;
  std::size_t most_rows;
};

constexpr PairColumns k_law_columns = {
    "alpha_deg", "theta_deg", "first a line alpha_deg,theta_deg, then one pair of angles per line, both increasing",
    /// Bounds time and memory, far above any real table.
    100000};
constexpr PairColumns k_torque_columns = {
    "theta_deg", "motor_torque_Nmm",
    "first a line theta_deg,motor_torque_Nmm, then an angle and its wanted torque per line, the angles increasing",
    /// The law is integrated over all rows, anew for each changed joint.
    2000};

/// One row in the file's units, with its line.
struct PairRow {
  int line = 0;
  double first = 0;
  double second = 0;
};

/// Parser for a table of two columns. Comma, semicolon or tab separates: the header decides.
class PairTableReader {
 public:
  PairTableReader(const PairColumns& columns, const std::string& file, std::vector<Diagnostic>& problems)
      : columns_(columns), file_(file), problems_(problems) {}

  /// `check` receives this reader, the previous row (null for the first) and the row. It returns false to drop the row.
  template <typename Check>
  void read(std::string_view csv, Check check) {
    if (csv.substr(0, 3) == "\xEF\xBB\xBF") csv.remove_prefix(3);
    for (int line = 1; !csv.empty() && problems_.size() < k_max_problems; ++line) {
      const std::size_t end = std::min(csv.find('\n'), csv.size());
      std::string_view text = csv.substr(0, end);
      csv.remove_prefix(std::min(end + 1, csv.size()));
      text = trimmed(text.substr(0, text.find('#')));
      if (!text.empty()) read_line(line, text, check);
    }
    if (!problems_.empty()) return;
    if (!header_read_) {
      fail(0, "the table is empty", columns_.hint);
    } else if (rows_.size() < k_min_rows) {
      fail(
          0,
          "the table has " + std::to_string(rows_.size()) + " rows; a law needs at least " + std::to_string(k_min_rows),
          columns_.hint);
    }
  }

  const std::vector<PairRow>& rows() const { return rows_; }
  bool is_valid() const { return problems_.empty(); }

  void fail(int line, std::string message, std::string hint) {
    problems_.push_back({Severity::error, {file_, line, line > 0 ? 1 : 0}, std::move(message), std::move(hint)});
  }

  void check_increasing(const char* column, double before, double value, int line, const char* hint) {
    if (value > before) return;
    fail(line,
         std::string(column) + " does not increase: " + shortest(value) + " deg after " + shortest(before) + " deg",
         hint);
  }

  /// Checks that θ, selected by `theta`, covers the joint's range.
  void check_cover(const Joint& joint, double PairRow::*theta) {
    // Half a millionth of a degree: the rounding of a table with six decimals.
    constexpr double k_rounding_deg = 5e-7;
    const double least = degrees(joint.theta_min), most = degrees(joint.theta_max);
    const PairRow &first = rows_.front(), &last = rows_.back();
    if (first.*theta > least + k_rounding_deg) {
      fail(first.line,
           "theta begins at " + rounded(first.*theta) + " deg, above joint.range_deg's " + rounded(least) + " deg",
           "add rows below, or raise the range's lower end");
    }
    if (last.*theta < most - k_rounding_deg) {
      fail(last.line,
           "theta ends at " + rounded(last.*theta) + " deg, below joint.range_deg's " + rounded(most) + " deg",
           "add rows above, or lower the range's upper end");
    }
  }

 private:
  template <typename Check>
  void read_line(int line, std::string_view text, Check check) {
    if (!header_read_) {
      const std::size_t separator = text.find_first_of(",;\t");
      if (separator != std::string_view::npos) separator_ = text[separator];
    }
    const std::size_t at = text.find(separator_);
    const std::string_view first = trimmed(text.substr(0, at));
    const std::string_view second = at == std::string_view::npos ? std::string_view() : trimmed(text.substr(at + 1));
    if (!header_read_) {
      header_read_ = true;
      if (first == columns_.first && second == columns_.second) return;
      return fail(line, "the columns are " + in_quotes(text) + ", not " + columns_.first + "," + columns_.second,
                  columns_.hint);
    }
    PairRow row{line, 0, 0};
    const bool decimal_comma = separator_ != ',';
    if (!parse_number(first, row.first, decimal_comma) || !parse_number(second, row.second, decimal_comma)) {
      return fail(line, in_quotes(text) + " is not two finite numbers", columns_.hint);
    }
    if (rows_.size() == columns_.most_rows) {
      return fail(line, "the table has more than " + std::to_string(columns_.most_rows) + " rows", "leave rows out");
    }
    if (check(*this, rows_.empty() ? nullptr : &rows_.back(), row)) rows_.push_back(row);
  }

  const PairColumns& columns_;
  const std::string& file_;
  std::vector<Diagnostic>& problems_;
  std::vector<PairRow> rows_;
  bool header_read_ = false;
  char separator_ = ',';
};

/// Checks a row of θ(α). Returns false to drop the row; problems that keep the row are reported as well.
bool check_law_row(PairTableReader& reader, const PairRow* before, const PairRow& row) {
  constexpr double k_largest_alpha_deg = 3600;
  if (std::abs(row.first) > k_largest_alpha_deg || std::abs(row.second) > k_largest_theta_deg) {
    reader.fail(row.line,
                "an angle is too large: alpha " + rounded(row.first) + " deg, theta " + rounded(row.second) + " deg",
                "angles are in degrees; alpha within +-3600, theta within +-360");
    return false;
  }
  constexpr const char* hint = "theta must grow with alpha, row by row";
  if (before != nullptr) {
    reader.check_increasing("alpha_deg", before->first, row.first, row.line, hint);
    reader.check_increasing("theta_deg", before->second, row.second, row.line, hint);
  }
  return true;
}

/// Checks a row of the wanted torque. Returns false to drop the row.
bool check_torque_row(PairTableReader& reader, const PairRow* before, const PairRow& row) {
  constexpr double k_largest_torque = 1e7;  // N·mm
  if (std::abs(row.first) > k_largest_theta_deg || std::abs(row.second) > k_largest_torque) {
    reader.fail(row.line,
                "a number is too large: theta " + rounded(row.first) + " deg, torque " + rounded(row.second) + " Nmm",
                "theta is in degrees, within +-360; the torque in N mm, within +-10000000");
    return false;
  }
  if (before != nullptr)
    reader.check_increasing("theta_deg", before->first, row.first, row.line, "one row per angle, from low to high");
  return true;
}

/// θ(0) by cubic interpolation (Lagrange) of the four rows around the gap below row `i`.
double theta_at_zero(const std::vector<PairRow>& rows, std::size_t i) {
  const std::size_t first = std::min(i < 2 ? 0 : i - 2, rows.size() - 4);
  double theta = 0;
  for (std::size_t j = first; j < first + 4; ++j) {
    double weight = 1;
    for (std::size_t k = first; k < first + 4; ++k) {
      if (k != j) weight *= rows[k].first / (rows[k].first - rows[j].first);
    }
    theta += weight * rows[j].second;
  }
  return theta;
}

void check_home(PairTableReader& reader) {
  const std::vector<PairRow>& rows = reader.rows();
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i - 1].first > 0 || rows[i].first < 0) continue;
    const double theta = theta_at_zero(rows, i);
    if (std::abs(theta) <= k_home_error_deg) return;
    return reader.fail(rows[i].line,
                       "the law does not pass through home: theta is " + rounded(theta) + " deg at alpha = 0",
                       "shift the angles so that alpha = 0 gives theta = 0");
  }
  reader.fail(rows.front().line, "alpha = 0 (home) is not within the table", "add rows on both sides of alpha = 0");
}

}  // namespace

std::vector<LawRow> parse_law_table(std::string_view csv, const std::string& file, const Joint& joint,
                                    std::vector<Diagnostic>& problems) {
  std::vector<Diagnostic> found;
  PairTableReader reader(k_law_columns, file, found);
  reader.read(csv, check_law_row);
  if (reader.is_valid()) {
    reader.check_cover(joint, &PairRow::second);
    check_home(reader);
  }
  problems.insert(problems.end(), found.begin(), found.end());
  std::vector<LawRow> rows;
  rows.reserve(reader.rows().size());
  for (const PairRow& row : reader.rows()) rows.push_back({radians(row.first), radians(row.second)});
  return rows;
}

std::vector<TorqueRow> parse_torque_table(std::string_view csv, const std::string& file, const Joint& joint,
                                          std::vector<Diagnostic>& problems) {
  std::vector<Diagnostic> found;
  PairTableReader reader(k_torque_columns, file, found);
  reader.read(csv, check_torque_row);
  if (reader.is_valid()) reader.check_cover(joint, &PairRow::first);
  problems.insert(problems.end(), found.begin(), found.end());
  std::vector<TorqueRow> rows;
  rows.reserve(reader.rows().size());
  for (const PairRow& row : reader.rows()) rows.push_back({radians(row.first), row.second});
  return rows;
}

}  // namespace fusee
