#include "export/step/compact_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <unordered_map>
#include <utility>
#include <vector>

namespace fusee::formats {
namespace {

/// Entities without an identity, which can be merged if they are equal. The pieces of a divided edge share one curve,
/// and those of a face one surface.
constexpr std::array<std::string_view, 21> k_values{"",  // an entity of several types, which begins with a bracket
                                                    "CARTESIAN_POINT",
                                                    "DIRECTION",
                                                    "VECTOR",
                                                    "AXIS2_PLACEMENT_3D",
                                                    "LINE",
                                                    "CIRCLE",
                                                    "ELLIPSE",
                                                    "B_SPLINE_CURVE_WITH_KNOTS",
                                                    "PLANE",
                                                    "CYLINDRICAL_SURFACE",
                                                    "CONICAL_SURFACE",
                                                    "TOROIDAL_SURFACE",
                                                    "B_SPLINE_SURFACE_WITH_KNOTS",
                                                    "COLOUR_RGB",
                                                    "FILL_AREA_STYLE_COLOUR",
                                                    "FILL_AREA_STYLE",
                                                    "SURFACE_STYLE_FILL_AREA",
                                                    "SURFACE_SIDE_STYLE",
                                                    "SURFACE_STYLE_USAGE",
                                                    "PRESENTATION_STYLE_ASSIGNMENT"};

/// Statements end with a semicolon outside texts, which are in quotes ('' is a quote).
std::vector<std::string> statements_of(std::string_view text) {
  std::vector<std::string> statements(1);
  bool in_text = false;
  for (const char c : text) {
    if (c == '\'') in_text = !in_text;
    // Line breaks within a long text are not part of it.
    if (in_text ? c == '\n' || c == '\r' : std::isspace(static_cast<unsigned char>(c)) != 0) continue;
    if (!in_text && c == ';') {
      statements.emplace_back();
    } else {
      statements.back() += c;
    }
  }
  statements.pop_back();
  return statements;
}

/// Ten digits, which resolve 5e-8 mm on a part of half a metre.
std::string short_number(std::string_view number) {
  char text[32];
  const double value = std::strtod(std::string(number).c_str(), nullptr);
  std::snprintf(text, sizeof text, "%.10G", value == 0 ? 0.0 : value);
  std::string shorter = text;
  // A real always contains a point.
  if (shorter.find('.') == std::string::npos) shorter.insert(std::min(shorter.find('E'), shorter.size()), ".");
  return shorter.size() < number.size() ? shorter : std::string(number);
}

/// Shortens reals, which are distinguished from integers by their points.
std::string with_short_numbers(std::string_view statement) {
  std::string text;
  bool in_text = false;
  for (std::size_t i = 0; i < statement.size();) {
    if (statement[i] == '\'') in_text = !in_text;
    const bool begins = !in_text && i > 0 && (statement[i - 1] == '(' || statement[i - 1] == ',') &&
                        (std::isdigit(static_cast<unsigned char>(statement[i])) || statement[i] == '-');
    const std::size_t end =
        begins ? std::min(statement.find_first_not_of("0123456789.E+-", i), statement.size()) : i + 1;
    const std::string_view token = statement.substr(i, end - i);
    text += begins && token.find('.') != std::string_view::npos ? short_number(token) : std::string(token);
    i = end;
  }
  return text;
}

/// The statement with each reference #n replaced by #renamed(n).
template <typename Rename>
std::string with_references(std::string_view statement, const Rename& renamed) {
  std::string text;
  bool in_text = false;
  for (std::size_t i = 0; i < statement.size(); ++i) {
    if (statement[i] == '\'') in_text = !in_text;
    text += statement[i];
    if (in_text || statement[i] != '#') continue;
    std::size_t number = 0;
    while (i + 1 < statement.size() && std::isdigit(static_cast<unsigned char>(statement[i + 1])))
      number = 10 * number + static_cast<std::size_t>(statement[++i] - '0');
    text += std::to_string(renamed(number));
  }
  return text;
}

struct Instance {
  std::size_t number = 0;
  std::string definition;  ///< TYPE(…)
};

bool is_value(const Instance& instance) {
  const std::string_view type = std::string_view(instance.definition).substr(0, instance.definition.find('('));
  return std::find(k_values.begin(), k_values.end(), type) != k_values.end();
}

/// Keeps the first of equal values, and lets all references point to it. Repeats until all values differ, because two
/// vectors become equal when their directions are merged.
void merge_values(std::vector<Instance>& instances) {
  while (true) {
    std::unordered_map<std::string_view, std::size_t> first;
    std::unordered_map<std::size_t, std::size_t> replaced_by;
    std::vector<Instance> kept;
    kept.reserve(instances.size());
    for (const Instance& instance : instances) {
      if (is_value(instance)) {
        const auto [found, is_new] = first.try_emplace(instance.definition, instance.number);
        if (!is_new) {
          replaced_by[instance.number] = found->second;
          continue;
        }
      }
      kept.push_back({instance.number, {}});
    }
    if (replaced_by.empty()) return;
    const auto renamed = [&replaced_by](std::size_t number) {
      const auto found = replaced_by.find(number);
      return found == replaced_by.end() ? number : found->second;
    };
    std::size_t k = 0;
    for (const Instance& instance : instances) {
      if (k < kept.size() && kept[k].number == instance.number)
        kept[k++].definition = with_references(instance.definition, renamed);
    }
    instances = std::move(kept);
  }
}

}  // namespace

std::string compact_step(std::string_view text) {
  std::string result;
  std::vector<Instance> instances;
  std::vector<std::string> after;
  for (std::string& statement : statements_of(text)) {
    if (statement.front() == '#') {
      const std::size_t equals = statement.find('=');
      instances.push_back({std::stoul(statement.substr(1, equals - 1)),
                           with_short_numbers(std::string_view(statement).substr(equals + 1))});
    } else if (instances.empty()) {
      result += statement + ";\n";
    } else {
      after.push_back(std::move(statement));
    }
  }
  merge_values(instances);
  std::unordered_map<std::size_t, std::size_t> new_number;
  for (const Instance& instance : instances) new_number.emplace(instance.number, new_number.size() + 1);
  for (const Instance& instance : instances) {
    result +=
        "#" + std::to_string(new_number.at(instance.number)) + "=" +
        with_references(instance.definition, [&new_number](std::size_t number) { return new_number.at(number); }) +
        ";\n";
  }
  for (const std::string& statement : after) result += statement + ";\n";
  return result;
}

}  // namespace fusee::formats
