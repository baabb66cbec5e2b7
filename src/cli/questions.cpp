#include "cli/questions.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>

#include "base/text.h"
#include "cli/arguments.h"
#include "fusee/mechanism_file.h"
#include "fusee/solid.h"
#include "mechanism/catalogue.h"
#include "mechanism/field_text.h"

namespace fusee::cli {
namespace {

constexpr int k_most_tries = 5;

constexpr std::string_view k_joint_picture = R"(
            C             C: where both tendons hold the link, R above O
           /|\
      1   / | R\   2      O: the joint's axis
         /  O   \
        /        \
       B    E     D       B, D: guide pins, below O
        \        /
         \  .-. /
          \( F )          F: the motor's shaft, with the pulley
            '-'
)";
constexpr std::string_view k_range_picture = R"(
      - \   | 0  / +
         \  |   /         theta, to the right positive; 0 is home
          \ |  /
            O
)";
constexpr std::string_view k_tendon_picture = R"(
      __    __
     |  \__/  |           the tendon lies in grooves as deep as twice its
     |   ()   |           diameter; 8 diameters are a usual least bend
)";
constexpr std::string_view k_load_picture = R"(
            C --->        the force that the joint has to hold at C, across
            |             the link; at a longer lever it is less
            O
)";

/// Removes blanks at both ends.
std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> words;
  while (true) {
    const std::size_t first = text.find_first_not_of(" \t,;[]");
    if (first == std::string_view::npos) return words;
    text.remove_prefix(first);
    words.emplace_back(text.substr(0, text.find_first_of(" \t,;[]")));
    text.remove_prefix(words.back().size());
  }
}

std::optional<double> number_in(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

struct Question {
  std::string_view picture;
  std::string words;
  std::string proposed;
  /// Stores an answer, or returns what is wrong with it.
  std::function<std::string(std::string_view)> take;
};

void put(Console& console, const Question& question, int number) {
  std::string answer;
  for (int tries = 0; tries < k_most_tries; ++tries) {
    const std::string picture = tries == 0 ? std::string(question.picture) + "\n" : "";
    const auto line = console.ask(fmt::format("{}{}/6  {} [{}]: ", picture, number, question.words, question.proposed));
    answer = trimmed(line.value_or(""));
    const std::string wrong = question.take(answer.empty() ? question.proposed : answer);
    if (wrong.empty()) return;
    console.say({Severity::error, {}, wrong, {}});
  }
  throw InputError(Diagnostic{
      Severity::error, {}, fmt::format("question {} was not answered in {} tries", number, k_most_tries), {}});
}

/// Accepts `count` numbers within the bounds of `key`.
std::function<std::string(std::string_view)> numbers(const char* key, int count,
                                                     std::function<void(const std::vector<double>&)> set) {
  return [field = find_field(key), count, set = std::move(set)](std::string_view answer) -> std::string {
    std::vector<double> values;
    for (const std::string& word : words_in(answer)) {
      const auto value = number_in(word);
      if (!value) return fmt::format("'{}' is not a number", word);
      if (*value < field->least || *value > field->most)
        return fmt::format("{} {} is not within {} to {}", rounded(*value), field->unit, rounded(field->least),
                           rounded(field->most));
      values.push_back(*value);
    }
    if (static_cast<int>(values.size()) != count)
      return count == 1 ? "give one number" : "give two numbers, the lower one first";
    if (count == 2 && !(values[0] < values[1])) return "the lower end comes first, and must be below the upper end";
    if (count == 2 && (values[0] > 0 || values[1] < 0)) return "home, at 0, must lie within the range";
    set(values);
    return {};
  };
}

/// Values of the answers. A shaft has a catalogue name, or a diameter if it is another.
struct Answers {
  std::string name = "my joint";
  double R = 60, low = -30, high = 30, d = 1, force = 10;
  std::string shaft;
  double bore = 0;
};

std::string take_shaft(Answers& answers, std::string_view answer) {
  if (find_shaft(answer) != nullptr) {
    answers.shaft = answer;
    return {};
  }
  const auto diameter = number_in(answer);
  const Field& field = *find_field("body.bore_diameter_mm");
  if (!diameter || !(*diameter > 0) || *diameter > field.most)
    return fmt::format("'{}' is neither a name in the list nor a diameter in mm", answer);
  answers.shaft.clear();
  answers.bore = *diameter;
  return {};
}

std::string list_of_shafts() {
  std::string list;
  for (const ShaftType& shaft : shafts()) list += fmt::format("\n      {:<17} {}", shaft.name, shaft.description);
  return list + "\n";
}

Answers asked(Console& console) {
  Answers answers;
  const auto first = [](double& number) {
    return [&number](const std::vector<double>& values) { number = values[0]; };
  };
  put(console,
      {"", "What is the joint called?", answers.name,
       [&](std::string_view answer) -> std::string {
         if (cleaned_line(answer) != answer) return "a name is text of one line, without control characters";
         answers.name = answer;
         return {};
       }},
      1);
  put(console, {k_joint_picture, "R: how far is C from O, mm?", "60", numbers("joint.length_mm", 1, first(answers.R))},
      2);
  put(console,
      {k_range_picture, "The lowest and the highest angle, deg?", "-30 30",
       numbers("joint.range_deg", 2,
               [&answers](const std::vector<double>& values) {
                 answers.low = values[0];
                 answers.high = values[1];
               })},
      3);
  put(console,
      {k_tendon_picture, "How thick is the tendon, mm?", "1", numbers("tendon.diameter_mm", 1, first(answers.d))}, 4);
  put(console, {k_load_picture, "Which force at C, N?", "10", numbers("load.tip_force_N", 1, first(answers.force))}, 5);
  const std::string listed = list_of_shafts();
  put(console,
      {listed, "The motor's shaft: one of these names, or the diameter of a round shaft, mm?", "5",
       [&answers](std::string_view answer) { return take_shaft(answers, answer); }},
      6);
  return answers;
}

/// The paper's optimum scaled by R, with a pulley that turns less than once. The tendon is of the catalogue if it has
/// that diameter.
DeclaredMechanism mechanism_of(const Answers& answers) {
  const double R = answers.R, span = answers.high - answers.low;
  // α is about θ times the tendon's arm, some 0.6 R, over r1; 280° leave room for the knots.
  const double r1 = std::max(0.18 * R, 0.6 * R * span / 280.0);
  std::string text = fmt::format("schema = 1\nname = {}\n[joint]\nlength_mm = {}\nrange_deg = [{}, {}]\n",
                                 toml_string(answers.name), shortest(R), shortest(answers.low), shortest(answers.high));
  text += fmt::format("[guides]\nEB_mm = {0}\nED_mm = {0}\nOE_mm = {1}\nradius_mm = {2}\n", rounded(0.5 * R, 3),
                      rounded(-0.4 * R, 3), rounded(std::clamp(0.03 * R, 1.0, 5.0), 2));
  text += fmt::format("[pulley]\nEF_mm = {}\nr1_mm = {}\nlaw = \"compensate\"\n", rounded(1.2 * R, 3), rounded(r1, 3));
  text += fmt::format("[tendon]\ndiameter_mm = {}\n", shortest(answers.d));
  for (const TendonType& known : tendon_types()) {
    if (known.diameter != answers.d) continue;
    text += fmt::format("modulus_MPa = {}\nbend_ratio = {}\n", shortest(known.modulus), shortest(known.bend_ratio));
    break;
  }
  text += fmt::format("[load]\ntip_force_N = {}\n[body]\n", shortest(answers.force));
  text += answers.shaft.empty() ? fmt::format("bore_diameter_mm = {}\n", shortest(answers.bore))
                                : fmt::format("shaft = \"{}\"\n", answers.shaft);
  return parse_mechanism(text, "your answers");
}

/// The value as text; rounded, because angles are converted to radians and back.
std::string value_text(const Field& field, const DeclaredMechanism& mechanism) {
  constexpr int k_digits = 12;
  if (field.kind == FieldKind::number) return rounded(field.get(mechanism, 0), k_digits);
  if (field.kind == FieldKind::range)
    return fmt::format("[{}, {}]", rounded(field.get(mechanism, 0), k_digits),
                       rounded(field.get(mechanism, 1), k_digits));
  const std::string words = field.get_text(mechanism);
  return field.kind == FieldKind::boolean ? words : toml_string(words);
}

constexpr std::string_view k_keys =
    "name joint.length_mm joint.range_deg guides.EB_mm guides.ED_mm guides.OE_mm guides.radius_mm pulley.EF_mm "
    "pulley.r1_mm "
    "pulley.law tendon.diameter_mm tendon.modulus_MPa tendon.bend_ratio load.tip_force_N";

/// The keys of answers, of their consequences and of changes, in the order of a file; all others have their defaults.
std::string file_of(const DeclaredMechanism& mechanism, const std::vector<std::string>& changed) {
  std::vector<std::string> keys = split(k_keys, ' ');
  keys.emplace_back(mechanism.body.shaft.empty() || mechanism.body.shaft == "none" ? "body.bore_diameter_mm"
                                                                                   : "body.shaft");
  keys.insert(keys.end(), changed.begin(), changed.end());
  std::string text =
      "# Made by 'fusee new --ask'. All other keys have their defaults: 'fusee explain' lists them.\nschema = 1\n";
  std::string_view table;
  for (const Field& field : fields()) {
    if (std::find(keys.begin(), keys.end(), field.name()) == keys.end()) continue;
    if (field.table != table) text += fmt::format("\n[{}]\n", table = field.table);
    text += wrapped(field.meaning, field.symbol.empty() ? "# " : fmt::format("# {}: ", field.symbol), "# ");
    text += fmt::format("{} = {}\n", field.key, value_text(field, mechanism));
  }
  return text;
}

bool was_asked(const profile::Change& change) {
  return change.key.starts_with("joint.") || change.key == "tendon.diameter_mm" ||
         change.key == "body.bore_diameter_mm";
}

void turn(DeclaredMechanism& mechanism, const profile::Change& change) {
  DeclaredMechanism changed = mechanism;
  const Field& field = *find_field(change.key);
  if (change.to_word.empty())
    field.set(changed, 0, change.to);
  else
    field.set_text(changed, change.to_word);
  mechanism = changed;
}

}  // namespace

AskedMechanism ask_for_mechanism(Console& console) {
  AskedMechanism asked_for{mechanism_of(asked(console)), {}, {}, {}, {}};
  std::vector<std::string> changed_keys;
  // Numbers without a question may be changed freely.
  constexpr int k_most_changes = 4;
  for (int changes = 0;; ++changes) {
    asked_for.obstacles = solid::obstacles(asked_for.mechanism);
    if (asked_for.obstacles.empty()) break;
    asked_for.advice = solid::body_advice(asked_for.mechanism).alone;
    const auto ours = std::find_if_not(asked_for.advice.begin(), asked_for.advice.end(), was_asked);
    if (ours == asked_for.advice.end() || changes == k_most_changes) break;
    turn(asked_for.mechanism, *ours);
    asked_for.changed.push_back(ours->text);
    changed_keys.push_back(ours->key);
    asked_for.advice.clear();
  }
  asked_for.text = file_of(asked_for.mechanism, changed_keys);
  return asked_for;
}

}  // namespace fusee::cli
