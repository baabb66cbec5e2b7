#include <charconv>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/model.h"

namespace fusee::model {
namespace {

constexpr std::size_t k_most_rows = 100000;
constexpr std::size_t k_most_problems = 20;
/// Larger values are not angles.
constexpr double k_largest_deg = 1e6;
constexpr const char* k_hint = "expected is a file of 'fusee calibrate': theta_deg,alpha_up_deg,alpha_down_deg";

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(without_blanks(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

class CompensationReader {
 public:
  explicit CompensationReader(const std::string& file) : file_(file) {}

  std::vector<TwoWayRow> read(std::string_view text) {
    for (int line = 1; !text.empty() && problems_.size() < k_most_problems; ++line) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view content = without_blanks(text.substr(0, std::min(text.find('#'), end)));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (content.empty()) continue;
      if (is_header_read_)
        read_row(line, cells_of(content));
      else
        read_header(line, cells_of(content));
      if (!is_header_read_ && !problems_.empty()) break;
    }
    if (problems_.empty() && rows_.size() < 2) fail(0, "it has fewer than two rows");
    if (!problems_.empty()) throw InputError(problems_);
    return rows_;
  }

 private:
  /// Adds a problem. `line`: 0 for the whole file.
  void fail(int line, std::string message) {
    problems_.push_back({Severity::error, {file_, line, line > 0 ? 1 : 0}, std::move(message), k_hint});
  }

  void read_header(int line, const std::vector<std::string_view>& cells) {
    constexpr std::string_view names[] = {"theta_deg", "alpha_up_deg", "alpha_down_deg"};
    for (std::size_t i = 0; i < 3; ++i) {
      if (i >= cells.size() || cells[i] != names[i])
        return fail(line, "column " + std::to_string(i + 1) + " must be " + std::string(names[i]));
    }
    is_header_read_ = true;
  }

  void read_row(int line, const std::vector<std::string_view>& cells) {
    double values[3] = {};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string_view cell = i < cells.size() ? cells[i] : std::string_view();
      const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), values[i]);
      const bool is_number = error == std::errc() && end == cell.data() + cell.size() && !std::isnan(values[i]);
      if (!is_number || std::abs(values[i]) > k_largest_deg)
        return fail(line, "'" + std::string(cell.substr(0, 40)) + "' is not an angle in degrees");
    }
    const TwoWayRow row{radians(values[0]), radians(values[1]), radians(values[2])};
    if (!rows_.empty()) {
      const TwoWayRow& last = rows_.back();
      if (!(row.theta > last.theta && row.up > last.up && row.down > last.down))
        return fail(line, "all three angles must increase from row to row");
    }
    if (rows_.size() == k_most_rows) return fail(line, "more than " + std::to_string(k_most_rows) + " rows");
    rows_.push_back(row);
  }

  const std::string& file_;
  bool is_header_read_ = false;
  std::vector<TwoWayRow> rows_;
  std::vector<Diagnostic> problems_;
};

}  // namespace

std::vector<TwoWayRow> read_compensation(const std::string& text, const std::string& name) {
  return CompensationReader(name).read(text);
}

}  // namespace fusee::model
