#include "cli/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/text.h"
#include "fusee/mechanism_file.h"
#include "measurement/units.h"
#include "mechanism/catalogue.h"
#include "mechanism/field_text.h"

namespace fusee::cli {
namespace {

// Text ----------------------------------------------------------------------------------------------------------------

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; }

/// Lower case, with ASCII in place of typographic signs, diameter signs and brackets removed.
std::string simplified(std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 24> signs{
      {{"−", "-"},    {"–", "-"},    {"—", "-"},    {"±", "+-"}, {"°", " deg "},  {"″", "\""},
       {"”", "\""},   {"“", "\""},   {"′", "'"},    {"’", "'"},  {"…", ".."},     {"⌀", " "},
       {"Ø", " "},    {"ø", " "},    {"∅", " "},    {"·", " "},  {"\u00a0", " "}, {"\u202f", " "},
       {"½", " 1/2"}, {"¼", " 1/4"}, {"¾", " 3/4"}, {"[", " "},  {"]", " "},      {"\t", " "}}};
  std::string simple;
  while (!text.empty()) {
    const auto sign =
        std::find_if(signs.begin(), signs.end(), [text](const auto& known) { return text.starts_with(known.first); });
    if (sign != signs.end()) {
      simple += sign->second;
      text.remove_prefix(sign->first.size());
    } else {
      simple += static_cast<char>(std::tolower(static_cast<unsigned char>(text.front())));
      text.remove_prefix(1);
    }
  }
  return simple;
}

void skip_blanks(std::string_view& text) { text.remove_prefix(std::min(text.find_first_not_of(' '), text.size())); }

bool skip(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

/// The letters and marks of a unit at the front, "" for none.
std::string take_word(std::string_view& text) {
  skip_blanks(text);
  std::string word;
  while (!text.empty() && (is_letter(text.front()) || text.front() == '"' || text.front() == '\'')) {
    word += text.front();
    text.remove_prefix(1);
  }
  return word;
}

// Numbers -------------------------------------------------------------------------------------------------------------

/// Digits with a decimal point, or with a decimal comma where `may_have_comma`.
std::optional<double> take_decimal(std::string_view& text, bool may_have_comma) {
  std::string digits;
  std::size_t end = 0;
  const auto take_digits = [&] {
    while (end < text.size() && is_digit(text[end])) digits += text[end++];
  };
  take_digits();
  const bool point = end < text.size() && (text[end] == '.' || (may_have_comma && text[end] == ','));
  if (point && end + 1 < text.size() && is_digit(text[end + 1])) {
    digits += '.';
    ++end;
    take_digits();
  } else if (point && text[end] == '.' && !text.substr(end).starts_with("..") && !digits.empty()) {
    ++end;  // "45."
  }
  double value = 0;
  const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || error != std::errc() || last != digits.data() + digits.size()) return std::nullopt;
  text.remove_prefix(end);
  return value;
}

/// A decimal number, a fraction or both: "1.8", "3/4", "1 3/4".
std::optional<double> take_number(std::string_view& text) {
  skip_blanks(text);
  std::string_view rest = text;
  std::optional<double> value = take_decimal(rest, true);
  if (!value) return std::nullopt;
  const auto take_denominator = [](std::string_view& from) -> std::optional<double> {
    if (from.size() < 2 || from.front() != '/' || !is_digit(from[1])) return std::nullopt;
    from.remove_prefix(1);
    return take_decimal(from, false);
  };
  if (const auto denominator = take_denominator(rest); denominator && *denominator > 0) {
    value = *value / *denominator;
  } else {
    // A fraction after a whole number: "1 3/4", "1-3/4".
    std::string_view after = rest;
    if (skip(after, " ") || skip(after, "-")) {
      const std::optional<double> numerator = take_decimal(after, false);
      const std::optional<double> divisor = numerator ? take_denominator(after) : std::nullopt;
      if (divisor && *divisor > 0) {
        value = *value + *numerator / *divisor;
        rest = after;
      }
    }
  }
  text = rest;
  return value;
}

/// Takes a signed number. Blanks may separate the sign from the digits.
std::optional<double> take_signed(std::string_view& text, bool may_have_comma = true) {
  skip_blanks(text);
  std::string_view rest = text;
  const bool minus = skip(rest, "-");
  if (!minus) skip(rest, "+");
  skip_blanks(rest);
  const auto value = take_decimal(rest, may_have_comma);
  if (!value) return std::nullopt;
  text = rest;
  return minus ? -*value : *value;
}

Refusal not_understood(std::string_view typed, std::string_view expected, std::string_view examples) {
  return {fmt::format("{} is not {}: type it as {}", in_quotes(typed), expected, examples)};
}

// Lengths -------------------------------------------------------------------------------------------------------------

constexpr std::string_view k_lengths = "45, 45 mm, 4.5 cm, 1.8 in or 1 3/4\"";

constexpr double k_inch = 25.4, k_foot = 304.8;  // mm

/// mm per unit; empty for an unknown one.
std::optional<double> unit_of_length(std::string_view word) {
  static constexpr std::array<std::pair<std::string_view, double>, 25> units{{{"", 1},
                                                                              {"mm", 1},
                                                                              {"millimetre", 1},
                                                                              {"millimetres", 1},
                                                                              {"millimeter", 1},
                                                                              {"millimeters", 1},
                                                                              {"cm", 10},
                                                                              {"centimetre", 10},
                                                                              {"centimetres", 10},
                                                                              {"centimeter", 10},
                                                                              {"centimeters", 10},
                                                                              {"m", 1000},
                                                                              {"metre", 1000},
                                                                              {"metres", 1000},
                                                                              {"meter", 1000},
                                                                              {"meters", 1000},
                                                                              {"in", k_inch},
                                                                              {"inch", k_inch},
                                                                              {"inches", k_inch},
                                                                              {"\"", k_inch},
                                                                              {"''", k_inch},
                                                                              {"ft", k_foot},
                                                                              {"foot", k_foot},
                                                                              {"feet", k_foot},
                                                                              {"'", k_foot}}};
  for (const auto& [name, size] : units)
    if (name == word) return size;
  return std::nullopt;
}

/// One or several numbers with units, such as "2 ft 3 in". A plain number is in `plain`.
std::optional<double> take_length(std::string_view& text, LengthUnit plain = LengthUnit::mm) {
  std::optional<double> sum;
  while (true) {
    std::string_view rest = text;
    const auto number = take_number(rest);
    if (!number) return sum;
    const std::string word = take_word(rest);
    const auto unit = word.empty() && plain == LengthUnit::inch ? k_inch : unit_of_length(word);
    if (!unit) return sum;
    skip(rest, ".");
    sum = sum.value_or(0) + *number * *unit;
    text = rest;
    if (*unit != k_foot) return sum;
  }
}

/// A length, mm, in whole nanometres. Removes the rounding error of a conversion: 1 3/4 in is 44.45 mm.
double to_nanometres(double length) {
  const double whole = std::round(1e6 * length) / 1e6;
  return whole > 0 ? whole : length;  // a positive length stays positive
}

// Words of the catalogue ----------------------------------------------------------------------------------------------

/// Words between blanks, commas and slashes.
std::vector<std::string> split_words(std::string_view text) {
  std::vector<std::string> words;
  while (true) {
    const std::size_t first = text.find_first_not_of(" ,;/()");
    if (first == std::string_view::npos) return words;
    text.remove_prefix(first);
    words.emplace_back(text.substr(0, text.find_first_of(" ,;/()")));
    text.remove_prefix(words.back().size());
  }
}

/// Words by which an entry is also found, in addition to its name and description.
std::string search_words(const ShaftType& type) { return fmt::format("motor shaft {} mm", rounded(type.diameter)); }
std::string search_words(const HornType& type) { return type.horn.spline_teeth > 0 ? "spline" : "servo horn"; }
std::string search_words(const TendonType&) { return ""; }

/// The entries whose name or description has all words; the entry of that name alone if there is one.
template <class Type>
std::vector<const Type*> matching(const std::vector<Type>& types, const std::vector<std::string>& words) {
  std::vector<const Type*> found;
  for (const Type& type : types) {
    const std::string text = simplified(fmt::format("{} {} {}", type.name, type.description, search_words(type)));
    std::string joined = text;  // finds "nema17" in "NEMA 17"
    std::erase_if(joined, [](char c) { return c == ' ' || c == '-'; });
    if (words.size() == 1 && words.front() == simplified(type.name)) return {&type};
    const auto has = [&](std::string word) {
      if (text.find(word) != std::string::npos) return true;
      std::erase(word, '-');
      return !word.empty() && joined.find(word) != std::string::npos;
    };
    if (!words.empty() && std::all_of(words.begin(), words.end(), has)) found.push_back(&type);
  }
  return found;
}

template <class Type>
void add_names(std::string& list, const std::vector<const Type*>& types) {
  for (const Type* type : types) list += (list.empty() ? "" : ", ") + type->name;
}

/// True for shafts that differ in form only, such as D and round: the first in the catalogue is the usual one.
bool is_one_family(const std::vector<const ShaftType*>& types) {
  return !types.empty() && std::all_of(types.begin(), types.end(), [&types](const ShaftType* type) {
    return type->diameter == types.front()->diameter;
  });
}

/// "nema17-d5; also in the list: nema17-round5"; empty for one shaft.
std::string choice_words(const std::vector<const ShaftType*>& types) {
  if (types.size() < 2) return {};
  std::string others;
  add_names(others, std::vector(types.begin() + 1, types.end()));
  return fmt::format("{}; also in the list: {}", types.front()->name, others);
}

/// The rotation of a motor in the catalogue that has this horn, rad; 0: unlimited.
double travel_with(std::string_view horn) {
  constexpr double k_servo_travel = radians(180.0);
  for (const MotorType& motor : motor_types()) {
    if (motor.name != "standard servo") continue;
    if (std::find(motor.fits.begin(), motor.fits.end(), horn) != motor.fits.end()) return k_servo_travel;
  }
  return 0;
}

}  // namespace

Answer<double> read_length(std::string_view typed, LengthUnit plain) {
  const std::string simple = simplified(typed);
  std::string_view text = simple;
  skip_blanks(text);
  for (const std::string_view word : {"diameter", "dia.", "dia", "about", "ca.", "~", "="})
    if (skip(text, word)) skip_blanks(text);
  const auto length = take_length(text, plain);
  skip_blanks(text);
  if (!length || !text.empty()) return not_understood(typed, "a length", k_lengths);
  if (!(*length > 0)) return Refusal{"the length must be greater than 0"};
  return to_nanometres(*length);
}

bool is_in_inches(std::string_view typed) {
  const std::string simple = simplified(typed);
  std::string_view text = simple;
  while (!text.empty()) {
    const auto unit = unit_of_length(take_word(text));
    if (unit == k_inch || unit == k_foot) return true;
    text.remove_prefix(text.empty() ? 0 : 1);
  }
  return false;
}

Answer<AngleRange> read_range(std::string_view typed) {
  constexpr std::string_view k_examples = "-30 30, -30..30, 0 to 80 or ±30";
  std::string simple = simplified(typed);
  double unit = 1;
  // Units and words that only surround the numbers.
  for (const std::string_view word : {"degrees", "degree", "deg", "radians", "rad", "from", "between"}) {
    for (std::size_t at = 0; (at = simple.find(word)) != std::string::npos;) {
      if (word.starts_with("rad")) unit = degrees(1.0);
      simple.replace(at, word.size(), " ");
    }
  }
  std::string_view text = simple;
  skip_blanks(text);
  AngleRange range;
  bool symmetric = false;
  for (const std::string_view sign : {"+-", "+/-", "-/+", "-+", "+ -"})
    if (!symmetric) symmetric = skip(text, sign);
  if (symmetric) {
    const auto end = take_signed(text);
    skip_blanks(text);
    if (!end || !text.empty()) return not_understood(typed, "a range", k_examples);
    range = {-*end * unit, *end * unit};
  } else {
    // A comma is decimal only where something else separates the ends.
    const auto first_digit = std::find_if(simple.begin(), simple.end(), is_digit);
    const std::string_view from_first_digit(
        std::string_view(simple).substr(static_cast<std::size_t>(first_digit - simple.begin())));
    const std::string_view ends = from_first_digit.substr(0, from_first_digit.find_last_of("0123456789") + 1);
    const bool comma_is_decimal = ends.find_first_of(" ;") != std::string_view::npos ||
                                  ends.find("..") != std::string_view::npos ||
                                  ends.find("to") != std::string_view::npos;
    const auto low = take_signed(text, comma_is_decimal);
    if (!low) return not_understood(typed, "a range", k_examples);
    const bool has_blank = text.starts_with(' ');
    skip_blanks(text);
    // "0-80" and "0 - 80" have a dash, "0 -80" a sign.
    const bool is_sign = has_blank && text.size() > 1 && text.front() == '-' && text[1] != ' ';
    bool separated = has_blank;
    for (const std::string_view sign : {"...", "..", "to", "and", "until", "till", "bis", ",", ";", ":", "/"})
      if (skip(text, sign)) separated = true;
    if (!is_sign && text.starts_with('-') && !separated)
      separated = skip(text, "-");
    else if (!is_sign && text.starts_with("- "))
      skip(text, "-");
    const auto high = take_signed(text, comma_is_decimal);
    skip_blanks(text);
    if (!high && text.empty()) return Refusal{"give both ends of the range, such as 0 80 or ±30"};
    if (!high || !separated || !text.empty()) return not_understood(typed, "a range", k_examples);
    range = {*low * unit, *high * unit};
  }
  const Field& field = *find_field("joint.range_deg");
  if (!(range.low < range.high))
    return Refusal{fmt::format("the lower end comes first: {} {}?", rounded(range.high), rounded(range.low))};
  if (range.low > 0 || range.high < 0)
    return Refusal{"home, at 0, must lie within the range: measure the angles from a home inside it"};
  if (range.low < field.least || range.high > field.most)
    return Refusal{fmt::format("a joint turns within {} to {} deg", rounded(field.least), rounded(field.most))};
  return range;
}

Answer<TypedLoad> read_load(std::string_view typed) {
  constexpr std::string_view k_examples = "10 N, 0.5 kg, 500 g, 2 lbf, or 0.8 Nm for a torque about the joint";
  const std::string simple = simplified(typed);
  std::string_view text = simple;
  const auto number = take_signed(text);
  if (!number) return not_understood(typed, "a load", k_examples);
  skip_blanks(text);
  const measurement::Unit* unit = find_unit(measurement::Quantity::load, text.empty() ? "N" : text);
  if (unit == nullptr)
    return Refusal{fmt::format("{} is not a unit of force or torque: type it as {}", in_quotes(text), k_examples)};
  const double size = *number * unit->factor;
  TypedLoad load;
  if (unit->base == "N") load.force = size;
  if (unit->base == "Nmm") load.torque = size;
  if (unit->base == "Nm") load.torque = 1000 * size;
  for (const auto& [key, value] : {std::pair{"load.tip_force_N", load.force}, {"load.torque_Nmm", load.torque}}) {
    const Field& field = *find_field(key);
    if (value < field.least || value > field.most)
      return Refusal{fmt::format("{} {} is not within {} to {}", rounded(value), field.unit, rounded(field.least),
                                 rounded(field.most))};
  }
  return load;
}

namespace {

/// Removes an angle such as "180 deg" from a motor's name and returns it, rad; 0 for none.
double extract_travel(std::string& simple) {
  for (std::size_t at = 0; at < simple.size(); ++at) {
    if (!is_digit(simple[at]) || (at > 0 && std::string_view(" ,(").find(simple[at - 1]) == std::string_view::npos))
      continue;
    std::string_view rest = std::string_view(simple).substr(at);
    const std::size_t before = rest.size();
    const auto angle = take_decimal(rest, false);
    skip_blanks(rest);
    for (const std::string_view word : {"degrees", "degree", "deg"}) {
      if (!angle || !skip(rest, word)) continue;
      simple.replace(at, before - rest.size(), " ");
      return radians(*angle);
    }
  }
  return 0;
}

/// Models of the catalogue whose name and description have all words, and the name at least one; the model of that name
/// alone if there is one.
std::vector<const MotorModel*> matching_models(const std::vector<std::string>& words) {
  std::vector<const MotorModel*> found;
  for (const MotorModel& model : motor_models()) {
    const std::string name = simplified(model.name), text = name + " " + simplified(model.description);
    if (words.size() == 1 && words.front() == name) return {&model};
    const auto is_in_name = [&name](const std::string& word) { return name.find(word) != std::string::npos; };
    const auto is_in_text = [&text](const std::string& word) { return text.find(word) != std::string::npos; };
    if (std::any_of(words.begin(), words.end(), is_in_name) && std::all_of(words.begin(), words.end(), is_in_text))
      found.push_back(&model);
  }
  return found;
}

/// A model without its horn or shaft.
TypedMotor bare_motor_of(const MotorModel& model) {
  TypedMotor motor;
  motor.model = model.name;
  motor.travel = model.travel;
  return motor;
}

/// How to answer with a model of which the catalogue knows neither horn nor shaft.
Refusal no_fitting(const MotorModel& model) {
  return {
      fmt::format("the catalogue has neither horn nor shaft of {0}: type its shaft behind it, such as {0}, 5 mm D, "
                  "or a horn of the list, such as {0}, disc-25T-M3",
                  model.name)};
}

/// A model with its first horn or shaft.
Answer<TypedMotor> motor_of(const MotorModel& model) {
  if (model.fits.empty()) return no_fitting(model);
  TypedMotor motor = bare_motor_of(model);
  const std::string& name = model.fits.front();
  const ShaftType* shaft = find_shaft(name);
  (shaft != nullptr ? motor.shaft : motor.horn) = name;
  motor.words = fmt::format("{}, {} ({})", model.name,
                            shaft != nullptr ? shaft->description : find_horn(name)->description, name);
  return motor;
}

/// The model among the words of an answer whose shaft or horn has this name; "" for none.
std::string named_model(const std::vector<std::string>& words, const std::string& fitting) {
  for (const MotorModel& model : motor_models()) {
    const bool is_named = std::find(words.begin(), words.end(), simplified(model.name)) != words.end();
    if (is_named && std::find(model.fits.begin(), model.fits.end(), fitting) != model.fits.end()) return model.name;
  }
  return {};
}

/// A shaft by its diameter: "5 mm", "1/4 in D". Empty for any other text.
std::optional<Answer<TypedMotor>> read_shaft(std::string_view text, LengthUnit plain) {
  const auto diameter = take_length(text, plain);
  if (!diameter) return std::nullopt;
  const auto is_flat = [](const std::string& word) { return word == "d" || word == "d-shaft" || word == "flat"; };
  const std::vector<std::string> words = split_words(text);
  for (const std::string& word : words) {
    if (!is_flat(word) && word != "shaft" && word != "round") return std::nullopt;
  }
  const double most = find_field("body.bore_diameter_mm")->most;
  if (!(*diameter > 0) || *diameter > most)
    return Refusal{fmt::format("a shaft of {} mm is not within 0 to {} mm", rounded(*diameter), rounded(most))};
  TypedMotor motor;
  motor.bore = to_nanometres(*diameter);
  motor.flat = std::any_of(words.begin(), words.end(), is_flat);
  motor.words = fmt::format("a {} shaft of {} mm", motor.flat ? "D" : "round", rounded(*diameter));
  return motor;
}

/// The words of an answer that may be part of a name.
std::vector<std::string> words_of_name(std::string_view text) {
  constexpr std::array<std::string_view, 10> k_fillers{"hobby", "small", "standard", "a",     "with",
                                                       "for",   "and",   "that",     "turns", "encoder"};
  std::vector<std::string> words = split_words(text);
  std::erase_if(words, [&](const std::string& word) {
    return std::find(k_fillers.begin(), k_fillers.end(), word) != k_fillers.end();
  });
  return words;
}

/// A model of the catalogue and a shaft or horn of the list: "STS3032, disc-25T-M3". Empty for any other words.
std::optional<TypedMotor> read_model_with_entry(const std::vector<std::string>& words) {
  for (const MotorModel& model : motor_models()) {
    std::vector<std::string> others = words;
    if (std::erase(others, simplified(model.name)) == 0 || others.empty()) continue;
    const std::vector<const ShaftType*> of_shafts = matching(shafts(), others);
    const std::vector<const HornType*> of_horns = matching(horns(), others);
    TypedMotor motor = bare_motor_of(model);
    std::string description;
    if (is_one_family(of_shafts) && of_horns.empty()) {
      motor.shaft = of_shafts.front()->name;
      motor.choice = choice_words(of_shafts);
      description = of_shafts.front()->description;
    } else if (of_horns.size() == 1 && of_shafts.empty()) {
      motor.horn = of_horns.front()->name;
      description = of_horns.front()->description;
    } else {
      continue;
    }
    motor.words = fmt::format("{}, {} ({})", model.name, description, motor.shaft + motor.horn);
    return motor;
  }
  return std::nullopt;
}

/// An entry of the catalogue by words of its name. `typed`: the whole answer, for the refusal.
Answer<TypedMotor> read_entry(const std::vector<std::string>& words, std::string_view typed) {
  const std::vector<const ShaftType*> of_shafts = matching(shafts(), words);
  const std::vector<const HornType*> of_horns = matching(horns(), words);
  TypedMotor motor;
  if (is_one_family(of_shafts) && (of_horns.empty() || words == std::vector{simplified(of_shafts.front()->name)})) {
    motor.shaft = of_shafts.front()->name;
    motor.model = named_model(words, motor.shaft);
    motor.words = of_shafts.front()->description;
    motor.choice = choice_words(of_shafts);
    return motor;
  }
  if (of_horns.size() == 1 && of_shafts.empty()) {
    motor.horn = of_horns.front()->name;
    motor.model = named_model(words, motor.horn);
    motor.travel = travel_with(motor.horn);
    motor.words = of_horns.front()->description;
    return motor;
  }
  if (const auto with_entry = read_model_with_entry(words)) return *with_entry;
  std::string names;
  if (of_shafts.empty() && of_horns.empty()) {
    const std::vector<const MotorModel*> models = matching_models(words);
    if (models.size() == 1) return motor_of(*models.front());
    add_names(names, models);
  }
  add_names(names, of_shafts);
  add_names(names, of_horns);
  if (!names.empty()) return Refusal{fmt::format("{} fits several entries: {}. Which one?", in_quotes(typed), names)};
  return Refusal{fmt::format("{} is neither a name in the list nor the diameter of a shaft, such as 5 mm or 5 mm D",
                             in_quotes(typed))};
}

}  // namespace

namespace {

/// The larger of a ratio and its inverse.
double ratio_above_one(double one, double other) { return std::max(one / other, other / one); }

/// Removes the first length from an answer and returns it. A number that is part of a name ("7x7", "100 lb") is none.
std::optional<double> extract_diameter(std::string& answer, LengthUnit plain) {
  for (std::size_t at = 0; at < answer.size(); ++at) {
    const bool begins = is_digit(answer[at]) && (at == 0 || answer[at - 1] == ' ');
    if (!begins) continue;
    std::string_view rest = std::string_view(answer).substr(at);
    const std::size_t before = rest.size();
    const auto length = take_length(rest, plain);
    const std::size_t taken = before - rest.size();
    const bool ends = rest.empty() || rest.front() == ' ' || rest.front() == ',';
    if (!length || !ends) {
      at = std::min(answer.find(' ', at), answer.size() - 1);
      continue;
    }
    std::string_view next = rest;
    const std::string word = take_word(next);
    if (word == "lb" || word == "lbs" || word == "strands" || word == "strand") continue;
    answer.replace(at, taken, " ");
    return to_nanometres(*length);
  }
  return std::nullopt;
}

/// Removes "5:1" and the words of a gearbox from a motor's name and returns the ratio; 1 for none.
double extract_gear_ratio(std::string& simple) {
  for (std::size_t at = 0; at < simple.size(); ++at) {
    if (!is_digit(simple[at]) || (at > 0 && simple[at - 1] != ' ' && simple[at - 1] != ',')) continue;
    std::string_view rest = std::string_view(simple).substr(at);
    const std::size_t before = rest.size();
    const auto ratio = take_decimal(rest, false);
    skip_blanks(rest);
    if (!ratio || !skip(rest, ":")) continue;
    skip_blanks(rest);
    if (!skip(rest, "1") || (!rest.empty() && is_digit(rest.front()))) continue;
    simple.replace(at, before - rest.size(), " ");
    return *ratio;
  }
  return 1;
}

/// A motor's answer without its shaft.
struct ModelAnswer {
  std::vector<const MotorModel*> models;
  std::optional<double> bore;  ///< the typed diameter of the shaft, mm
  bool flat = false;
};

/// Separates the words of a shaft, and of a gearbox, from those of the model.
ModelAnswer split_model(std::string simple, LengthUnit plain) {
  ModelAnswer answer;
  answer.bore = extract_diameter(simple, plain);
  std::vector<std::string> words = words_of_name(simple);
  std::erase_if(words, [&answer](const std::string& word) {
    const bool is_flat = word == "d" || word == "d-shaft" || word == "flat";
    answer.flat = answer.flat || is_flat;
    return is_flat || word == "shaft" || word == "round" || word.starts_with("gear") || word == "planetary";
  });
  answer.models = matching_models(words);
  return answer;
}

/// A model of the catalogue together with its shaft: "NEMA17-40mm, 5 mm D". Empty for any other text.
std::optional<TypedMotor> read_model_with_shaft(const std::string& simple, LengthUnit plain) {
  const ModelAnswer answer = split_model(simple, plain);
  if (!answer.bore || answer.models.size() != 1) return std::nullopt;
  const MotorModel& model = *answer.models.front();
  TypedMotor motor = bare_motor_of(model);
  for (const std::string& name : model.fits) {
    const ShaftType* shaft = find_shaft(name);
    if (shaft == nullptr || std::abs(shaft->diameter - *answer.bore) > 0.005) continue;
    if ((shaft->bore == Bore::d) != answer.flat) continue;
    motor.shaft = name;
    motor.words = fmt::format("{}, {} ({})", model.name, shaft->description, name);
    return motor;
  }
  motor.bore = *answer.bore;
  motor.flat = answer.flat;
  motor.words = fmt::format("{}, a {} shaft of {} mm", model.name, answer.flat ? "D" : "round", rounded(*answer.bore));
  return motor;
}

/// The model behind a gearbox. Its shaft is that of the gearbox if one was typed.
Answer<TypedMotor> read_geared(const std::string& simple, double ratio, std::string_view typed, LengthUnit plain) {
  const Field& field = *find_field("motor.gear_ratio");
  if (ratio < field.least || ratio > field.most)
    return Refusal{fmt::format("a gear ratio of {}:1 is not within {} to {}", rounded(ratio), rounded(field.least),
                               rounded(field.most))};
  const auto [models, bore, flat] = split_model(simple, plain);
  // "N20 298:1": the ratio is part of the model's name.
  const std::string ratio_in_name = "-" + rounded(ratio) + "-";
  for (const MotorModel* model : models)
    if (!bore && models.size() > 1 && model->name.find(ratio_in_name) != std::string::npos) return motor_of(*model);
  if (models.size() != 1) {
    std::string names;
    add_names(names, models);
    return Refusal{fmt::format("a gear ratio belongs to a motor of known torque: {}",
                               names.empty() ? in_quotes(typed) + " names none, type such as NEMA17-48mm 5:1"
                                             : in_quotes(typed) + " fits several: " + names + ". Which one?")};
  }
  const MotorModel& model = *models.front();
  TypedMotor motor = bare_motor_of(model);
  if (!bore) {
    Answer<TypedMotor> own = motor_of(model);
    if (std::holds_alternative<Refusal>(own)) return own;
    motor = std::get<TypedMotor>(std::move(own));
  }
  motor.gear_ratio = ratio;
  motor.travel /= ratio;
  const std::string gear = fmt::format("{} with a gearbox {}:1", model.name, rounded(ratio));
  motor.words = gear + ", with the motor's own shaft: type the gearbox's shaft behind it if it differs, such as 8 mm D";
  if (!bore) return motor;
  motor.bore = *bore;
  motor.flat = flat;
  motor.words = fmt::format("{}, a {} shaft of {} mm", gear, flat ? "D" : "round", rounded(*bore));
  return motor;
}

}  // namespace

Answer<TypedMotor> read_motor(std::string_view typed, LengthUnit plain) {
  std::string simple = simplified(typed);
  const double travel = extract_travel(simple);
  const double gear_ratio = extract_gear_ratio(simple);
  const auto shaft = read_shaft(simple, plain);
  const auto with_shaft = read_model_with_shaft(simple, plain);
  Answer<TypedMotor> answer = gear_ratio != 1 ? read_geared(simple, gear_ratio, typed, plain)
                              : shaft         ? *shaft
                              : with_shaft    ? *with_shaft
                                              : read_entry(words_of_name(simple), typed);
  if (TypedMotor* const motor = std::get_if<TypedMotor>(&answer); motor != nullptr && travel > 0) {
    motor->typed_travel = travel;
    motor->travel = travel / motor->gear_ratio;
  }
  return answer;
}

Answer<TypedTendon> read_tendon(std::string_view typed, LengthUnit plain) {
  std::string simple = simplified(typed);
  std::vector<const TendonType*> types;
  std::optional<double> diameter;
  for (const TendonType& type : tendon_types())
    if (split_words(simple) == std::vector{simplified(type.name)}) types = {&type};
  std::vector<std::string> words;
  if (types.empty()) {
    diameter = extract_diameter(simple, plain);
    words = split_words(simple);
    std::erase_if(words, [](const std::string& word) {
      return word == "line" || word == "rope" || word == "cord" || word == "cable" || word == "string" ||
             word == "thread" || word == "of" || word == "a" || word == "mm";
    });
    types = matching(tendon_types(), words);
  }
  if (simple.starts_with('-')) return Refusal{"a diameter must be greater than 0"};
  if (types.empty() && !words.empty()) {
    std::string names;
    for (const TendonType& type : tendon_types()) names += (names.empty() ? "" : ", ") + type.name;
    return Refusal{
        fmt::format("{} is not a tendon of the catalogue ({}): give its diameter alone, or a material such as "
                    "Dyneema, steel, Vectran, Kevlar or nylon",
                    in_quotes(typed), names)};
  }
  if (!diameter && types.size() != 1) {
    std::string names;
    add_names(names, types);
    return Refusal{types.empty() ? fmt::format("{} is not a tendon: type it as 0.6 mm, Dyneema 0.6 or steel 1.2 mm",
                                               in_quotes(typed))
                                 : fmt::format("give its diameter too, such as {} {}: the catalogue has {}", typed,
                                               rounded(types.front()->diameter), names)};
  }
  const double d = diameter.value_or(types.empty() ? 0 : types.front()->diameter);
  const Field& field = *find_field("tendon.diameter_mm");
  if (!(d >= field.least) || d > field.most)
    return Refusal{fmt::format("a tendon of {} mm is not within {} to {} mm", rounded(d), rounded(field.least),
                               rounded(field.most))};
  if (types.empty()) types = matching(tendon_types(), {"hmpe"});  // a diameter alone: the most usual material
  const TendonType& nearest = **std::min_element(types.begin(), types.end(), [d](const auto* one, const auto* other) {
    return ratio_above_one(one->diameter, d) < ratio_above_one(other->diameter, d);
  });
  const bool is_entry = std::abs(nearest.diameter - d) < 0.005;  // mm
  const double strength = is_entry ? 0 : std::round(strength_by_section(nearest, d));
  return TypedTendon{
      d, nearest.modulus, nearest.bend_ratio, strength,
      fmt::format("{} mm, {}{}: {}{}", rounded(d), is_entry ? "" : "of the kind of ", nearest.name, nearest.description,
                  is_entry ? "" : fmt::format("; strength by its section, about {} N", rounded(strength)))};
}

}  // namespace fusee::cli
