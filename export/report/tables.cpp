#include "export/report/tables.h"

#include <algorithm>
#include <cmath>

#include "export/report/svg.h"
#include "fusee/base/units.h"

namespace fusee {
namespace {

struct PlainName {
  std::string_view name;
  std::string_view words;
};

constexpr PlainName k_plain_names[] = {
    {"finite", "All coordinates are finite numbers"},
};

std::string cell(std::string_view classes, const std::string& html) {
  return (classes.empty() ? std::string("<td>") : "<td class=\"" + std::string(classes) + "\">") + html + "</td>";
}

/// What was asked of the value. A Check does not say; its value, its limit and its outcome together do.
std::string_view relation(const Check& check) {
  if (check.value == check.limit || !std::isfinite(check.value)) return "";
  if (!check.ok && check.unit == "1") return "";
  return (check.value < check.limit) == check.ok ? "≤ " : "≥ ";
}

std::string name_cell(std::string_view name, const std::string& remark) {
  std::string html = safe_text(plain_name(name));
  if (!remark.empty()) html += " <span class=\"where\">" + safe_text(remark) + "</span>";
  return cell("", html);
}

std::string row_start(bool ok) { return ok ? "<tr><td class=\"state\">✓</td>" : "<tr class=\"failed\"><td class=\"state\">✕</td>"; }

}  // namespace

std::string plain_name(std::string_view name) {
  for (const PlainName& known : k_plain_names) {
    if (known.name == name) return std::string(known.words);
  }
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

std::string shown_unit(std::string_view unit) {
  if (unit == "deg") return "°";
  if (unit == "1") return "";
  return std::string(unit);
}

std::string with_unit(double value, std::string_view unit, int digits) {
  const std::string shown = shown_unit(unit);
  return readable_rounded(value, digits) + (shown.empty() || shown == "°" ? "" : "\u00a0") + shown;
}

std::string checks_table(const std::vector<Check>& checks) {
  std::string html = "<div class=\"scroll\"><table><thead><tr><th></th><th>Check</th><th class=\"number\">Value</th>"
                     "<th class=\"number\">Limit</th></tr></thead><tbody>";
  // What failed comes first: nobody should have to look for it.
  std::vector<Check> sorted = checks;
  std::stable_partition(sorted.begin(), sorted.end(), [](const Check& check) { return !check.ok; });
  for (const Check& check : sorted) {
    html += row_start(check.ok) + name_cell(check.name, check.where) + cell("number", safe_text(with_unit(check.value, check.unit))) +
            cell("number", std::string(relation(check)) + safe_text(with_unit(check.limit, check.unit))) + "</tr>";
  }
  return html + "</tbody></table></div>";
}

std::string conditions_table(const std::vector<Condition>& conditions) {
  std::string html = "<div class=\"scroll\"><table><thead><tr><th></th><th>Condition</th><th class=\"number\">Tightest at α</th>"
                     "<th class=\"number\">Value</th><th class=\"number\">Limit</th><th class=\"number\">Margin</th></tr></thead><tbody>";
  for (const Condition& condition : conditions) {
    const double margin = condition.ok ? std::abs(condition.value - condition.limit) : -std::abs(condition.value - condition.limit);
    html += row_start(condition.ok) + name_cell(condition.name, condition.ok ? "" : condition.message) +
            cell("number", readable(degrees(condition.alpha), 1) + "°") +
            cell("number", safe_text(with_unit(condition.value, condition.unit, 4))) +
            cell("number", safe_text(with_unit(condition.limit, condition.unit, 4))) +
            cell("number", safe_text(with_unit(margin, condition.unit))) + "</tr>";
  }
  return html + "</tbody></table></div>";
}

}  // namespace fusee
