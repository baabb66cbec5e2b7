#include "mechanism/optimize_table.h"

#include <algorithm>

#include "base/text.h"
#include "fusee/mechanism_file.h"
#include "mechanism/field_text.h"
#include "mechanism/linear_relation.h"

namespace fusee {
namespace {

constexpr std::size_t k_max_variables = 8;
constexpr std::size_t k_max_objectives = 3;

class OptimizeTableCheck {
 public:
  OptimizeTableCheck(const Optimization& table, const std::function<bool(const std::string&)>& is_good,
                     const std::function<Place(const std::string&, std::size_t)>& item_place,
                     std::vector<Diagnostic>& errors)
      : table_(table), is_good_(is_good), item_place_(item_place), errors_(errors) {}

  void run() {
    if (is_good_("objective")) check_objectives();
    if (is_good_("variables")) check_variables();
    if (is_good_("tied")) check_ties();
    if (is_good_("constraints")) check_constraints();
  }

 private:
  void fail(const Place& place, std::string message, std::string hint) {
    errors_.push_back({Severity::error, place, std::move(message), std::move(hint)});
  }

  void check_objectives() {
    if (table_.objectives.size() > k_max_objectives) {
      fail(item_place_("objective", k_max_objectives), "optimize.objective names more than three",
           "a front has two or three objectives");
    }
  }

  void check_variables() {
    const auto& variables = table_.variables;
    if (variables.size() > k_max_variables)
      fail(item_place_("variables", k_max_variables), "optimize.variables names more than eight keys",
           "leave some out");
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const Place place = item_place_("variables", i);
      if (!find_number_key(variables[i])) {
        const std::string nearest = nearest_word(variables[i], number_key_names());
        fail(place, in_quotes(variables[i]) + (find_field(variables[i]) ? " holds no single number" : " is not a key"),
             nearest.empty() ? "fusee explain lists the keys" : "did you mean " + nearest + "?");
      } else if (std::find(variables.begin(), variables.begin() + static_cast<std::ptrdiff_t>(i), variables[i]) !=
                 variables.begin() + static_cast<std::ptrdiff_t>(i)) {
        fail(place, variables[i] + " occurs twice among the variables", "leave one out");
      }
    }
    if (is_good_("lower") && is_good_("upper")) check_bounds();
  }

  void check_bounds() {
    const std::size_t count = table_.variables.size();
    for (const auto& [key, values] : {std::pair{"lower", &table_.lower}, std::pair{"upper", &table_.upper}}) {
      if (values->size() == count) continue;
      fail(item_place_(key, count),
           "optimize." + std::string(key) + " has " + std::to_string(values->size()) +
               (values->size() == 1 ? " number for " : " numbers for ") + std::to_string(count) +
               (count == 1 ? " variable" : " variables"),
           "one number for each variable, in their order");
    }
    if (table_.lower.size() != count || table_.upper.size() != count) return;
    for (std::size_t i = 0; i < count; ++i) check_bounds_of(i);
  }

  void check_bounds_of(std::size_t i) {
    const auto key = find_number_key(table_.variables[i]);
    if (!key) return;
    const Field& field = *key->field;
    const double lower = table_.lower[i], upper = table_.upper[i];
    for (const auto& [name, value] : {std::pair{"lower", lower}, std::pair{"upper", upper}}) {
      if (value >= field.least && value <= field.most) continue;
      fail(item_place_(name, i),
           "optimize." + std::string(name) + " of " + table_.variables[i] + " = " + with_unit(value, field.unit) +
               " is out of range",
           "allowed: " + shortest(field.least) + " to " + with_unit(field.most, field.unit));
    }
    if (lower > upper) {
      fail(item_place_("lower", i),
           "the bounds of " + table_.variables[i] + " are crossed: lower " + with_unit(lower, field.unit) +
               " is above upper " + with_unit(upper, field.unit),
           "exchange them");
    }
  }

  /// The parsed relation; nullopt after its fault was reported at its column.
  std::optional<LinearRelation> relation(const std::string& key, std::size_t item, const std::string& text) {
    ParsedRelation parsed = parse_relation(text);
    if (!parsed.fault) return std::move(parsed.relation);
    Place place = item_place_(key, item);
    // The opening quote precedes the text. Escapes in the text shift the reported column.
    if (place.line > 0) place.column += 1 + static_cast<int>(parsed.fault->at);
    fail(place,
         "optimize." + key + ": " + in_quotes(text) + ": " + parsed.fault->message + " (character " +
             std::to_string(parsed.fault->at + 1) + ")",
         parsed.fault->hint);
    return std::nullopt;
  }

  void check_ties() {
    std::vector<std::string> earlier;
    for (std::size_t i = 0; i < table_.tied.size(); ++i) {
      const auto tie = relation("tied", i, table_.tied[i]);
      if (!tie) continue;
      const Place place = item_place_("tied", i);
      const auto& left = tie->left;
      if (tie->relation != Relation::equal || left.terms.size() != 1 || left.terms.front().factor != 1 ||
          left.constant != 0) {
        fail(place, "optimize.tied: " + in_quotes(table_.tied[i]) + " does not define a key",
             "write key = sum of other keys");
        continue;
      }
      const std::string& key = left.terms.front().key;
      const auto uses = [&key](const std::vector<LinearTerm>& terms) {
        return std::any_of(terms.begin(), terms.end(), [&key](const LinearTerm& term) { return term.key == key; });
      };
      if (uses(tie->right.terms)) fail(place, key + " is tied to itself", "the right side names other keys");
      if (std::find(table_.variables.begin(), table_.variables.end(), key) != table_.variables.end()) {
        fail(place, key + " is tied, and a variable as well", "leave it out of the variables");
      }
      if (std::find(earlier.begin(), earlier.end(), key) != earlier.end())
        fail(place, key + " is tied twice, or used before it is tied", "one tie per key, in the order of use");
      earlier.push_back(key);
      for (const LinearTerm& term : tie->right.terms) earlier.push_back(term.key);
    }
  }

  void check_constraints() {
    for (std::size_t i = 0; i < table_.constraints.size(); ++i) relation("constraints", i, table_.constraints[i]);
  }

  const Optimization& table_;
  const std::function<bool(const std::string&)>& is_good_;
  const std::function<Place(const std::string&, std::size_t)>& item_place_;
  std::vector<Diagnostic>& errors_;
};

}  // namespace

void check_optimize_table(const Optimization& table, const std::function<bool(const std::string& key)>& is_good,
                          const std::function<Place(const std::string& key, std::size_t item)>& item_place,
                          std::vector<Diagnostic>& errors) {
  OptimizeTableCheck(table, is_good, item_place, errors).run();
}

}  // namespace fusee
