#include "cli/questions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "base/text.h"
#include "cli/answers.h"
#include "cli/arguments.h"
#include "cli/interrupt.h"
#include "cli/joint_picture.h"
#include "fusee/solid.h"
#include "mechanism/catalogue.h"
#include "mechanism/field_text.h"
#include "mechanism/lengths.h"

namespace fusee::cli {
namespace {

// Number of tries for one question: the command also ends for an endless input without a usable answer.
constexpr int k_most_tries = 50;

constexpr std::string_view k_joint_picture = R"(
            C             C: the point of the link at which the load acts,
            |             straight above O when the joint is at home
            |
            O             O: the joint's axis

            G             G: the axis of the motor and its pulley, below O
)";
constexpr std::string_view k_range_picture = R"(
      - \   | 0  / +
         \  |   /         the joint's angle: positive to the right,
          \ |  /          0 where C is straight above O
            O
)";
constexpr std::string_view k_room_picture = R"(
          .---.
         /     \          the pulley turns about G and must not reach
        |   G   |         beyond this circle
         \     /
          '---'
)";
constexpr std::string_view k_load_picture = R"(
            C --->        the largest force across the link at C, or the
            |             torque about O, that the joint has to hold
            O
)";

/// The answers so far.
struct Answers {
  std::string name;
  double length = 0;  ///< of the link, mm
  AngleRange range;
  double room = 0;  ///< largest diameter of the pulley, mm
  TypedLoad load;
  TypedMotor motor;
  TypedTendon tendon;
  LengthUnit units = LengthUnit::mm;  ///< of the file
  LengthUnit plain = LengthUnit::mm;  ///< of lengths without a unit
  bool may_be_inches = true;          ///< a length that is typed in inches makes a file in inches
};

struct Question {
  std::string_view subject;
  std::string picture;  ///< or a list, above the question
  std::string words;    ///< the question itself
  std::function<std::string(const Answers&)> proposal;
  /// Stores an answer and explains how it was understood, or returns a refusal.
  std::function<Answer<std::string>(Answers&, std::string_view)> take;
};

/// A length within the bounds of a key.
Answer<double> length_for(std::string_view key, std::string_view text, const Answers& answers) {
  Answer<double> answer = read_length(text, answers.plain);
  const Field& field = *find_field(key);
  const double* length = std::get_if<double>(&answer);
  if (length != nullptr && (*length < field.least || *length > field.most))
    return Refusal{
        fmt::format("{} mm is not within {} to {} mm", rounded(*length), rounded(field.least), rounded(field.most))};
  return answer;
}

std::string load_words(const TypedLoad& load) {
  return load.torque != 0 ? fmt::format("{} Nmm about O", rounded(load.torque))
                          : fmt::format("{} N at C", rounded(load.force));
}

std::string list_of_motors() {
  std::string list = "\n";
  const auto add = [&list](std::string_view name, std::string_view description) {
    list += fmt::format("      {:<17} {}\n", name, description);
  };
  for (const ShaftType& shaft : shafts()) add(shaft.name, shaft.description);
  for (const HornType& horn : horns()) add(horn.name, horn.description);
  return list;
}

std::string list_of_tendons() {
  std::string list = "\n";
  for (const TendonType& tendon : tendon_types())
    list += fmt::format("      {:<17} {}\n", tendon.name, tendon.description);
  return list;
}

/// Stores an answer in `target` and returns words(target), or returns the refusal.
template <class Value>
Answer<std::string> stored(Answer<Value> read, Value& target, const std::function<std::string(const Value&)>& words) {
  if (Refusal* refusal = std::get_if<Refusal>(&read)) return std::move(*refusal);
  target = std::get<Value>(std::move(read));
  return words(target);
}

/// The motor for a person. A typed diameter is in the file's unit, an entry of the catalogue is not converted.
std::string motor_words(const Answers& answers) {
  return answers.motor.bore > 0 ? lengths_in(answers.units, answers.motor.words) : answers.motor.words;
}

const std::vector<Question>& questions() {
  static const auto fixed_proposal = [](std::string text) {
    return [text = std::move(text)](const Answers&) { return text; };
  };
  static const auto length_words = [](const Answers& answers) -> std::function<std::string(const double&)> {
    return [units = answers.units](const double& length) {
      return fmt::format("{} {}", rounded(from_mm(length, units)), unit_word(units));
    };
  };
  static const std::vector<Question> all{
      {"name", "", "What is the joint called?", fixed_proposal("my joint"),
       [](Answers& answers, std::string_view text) -> Answer<std::string> {
         constexpr std::size_t k_longest = 200;
         if (cleaned_line(text) != text) return Refusal{"a name is text of one line, without control characters"};
         if (text.size() > k_longest) return Refusal{"a name has at most 200 bytes"};
         return stored<std::string>(std::string(text), answers.name, [](const std::string& name) { return name; });
       }},
      {"length", std::string(k_joint_picture), "How far is C from O (45 mm, 1.8 in)?", fixed_proposal("60 mm"),
       [](Answers& answers, std::string_view text) {
         if (answers.may_be_inches) answers.units = is_in_inches(text) ? LengthUnit::inch : LengthUnit::mm;
         return stored(length_for("joint.length_mm", text, answers), answers.length, length_words(answers));
       }},
      {"range", std::string(k_range_picture), "From which to which angle does it turn (0 80, -30..30, ±30)?",
       fixed_proposal("-30 30"),
       [](Answers& answers, std::string_view text) {
         return stored<AngleRange>(read_range(text), answers.range, [](const AngleRange& range) {
           return fmt::format("{} to {} deg", rounded(range.low), rounded(range.high));
         });
       }},
      {"room", std::string(k_room_picture), "How wide may the pulley be (⌀30 mm)?",
       [](const Answers& answers) { return rounded(std::round(std::clamp(0.7 * answers.length, 30.0, 80.0))) + " mm"; },
       [](Answers& answers, std::string_view text) {
         // The bounds of pulley.EF_mm, 1 to 10000 mm: those of body.room_diameter_mm include 0, which is no limit.
         return stored(length_for("pulley.EF_mm", text, answers), answers.room, length_words(answers));
       }},
      {"load", std::string(k_load_picture), "Which load (10 N, 0.5 kg, 2 lbf, 0.8 Nm)?", fixed_proposal("10 N"),
       [](Answers& answers, std::string_view text) {
         return stored<TypedLoad>(read_load(text), answers.load, load_words);
       }},
      {"motor", list_of_motors(),
       "The motor: a name of this list, a model (XL430-W250, NEMA17-48mm 5:1), or its shaft (5 mm, 5 mm D)?",
       fixed_proposal("5 mm"),
       [](Answers& answers, std::string_view text) {
         return stored<TypedMotor>(read_motor(text, answers.plain), answers.motor, [&answers](const TypedMotor& motor) {
           return motor_words(answers) + (motor.choice.empty() ? "" : " (" + motor.choice + ")") +
                  (motor.travel > 0 ? fmt::format("; turns {}{} deg", motor.gear_ratio != 1 ? "the pulley " : "",
                                                  rounded(degrees(motor.travel)))
                                    : "");
         });
       }},
      {"tendon", list_of_tendons(), "The tendon: diameter, material or both (0.6 mm, Dyneema 0.6, steel 1.2)?",
       fixed_proposal("1 mm"), [](Answers& answers, std::string_view text) {
         return stored<TypedTendon>(
             read_tendon(text, answers.plain), answers.tendon,
             [&answers](const TypedTendon& tendon) { return lengths_in(answers.units, tendon.words); });
       }}};
  return all;
}

/// "length: 45 mm, range: 0 to 80 deg".
std::string answered_words(const std::vector<std::string>& understood) {
  std::string words;
  for (std::size_t i = 0; i < understood.size(); ++i)
    words += fmt::format("{}{}: {}", words.empty() ? "" : ", ", questions()[i].subject, understood[i]);
  return words;
}

/// Asks one question until its answer can be used; nullopt at the end of the input.
std::optional<std::string> ask_until_usable(Console& console, std::size_t number, Answers& answers,
                                            const std::string& proposal) {
  const Question& question = questions().at(number);
  std::string picture = question.picture + (question.picture.empty() ? "" : "\n");
  for (int tries = 0; tries < k_most_tries; ++tries) {
    const auto line = console.ask(
        fmt::format("{}{}/{}  {} [{}]: ", picture, number + 1, questions().size(), question.words, proposal));
    if (is_interrupted()) throw Stopped();
    if (!line) return std::nullopt;
    picture.clear();
    const std::string_view answer = trimmed(*line);
    const Answer<std::string> taken = question.take(answers, answer.empty() ? proposal : answer);
    if (const std::string* understood = std::get_if<std::string>(&taken)) {
      if (*understood != answer) console.write("      → " + *understood + "\n");
      return *understood;
    }
    console.report({Severity::error, {}, std::get<Refusal>(taken).reason, {}});
  }
  throw InputError(Diagnostic{Severity::error,
                              {},
                              fmt::format("question {} ({}) has no usable answer in {} tries: no file was written",
                                          number + 1, question.subject, k_most_tries),
                              {}});
}

// The file ------------------------------------------------------------------------------------------------------------

DeclaredMechanism joint_of(const Answers& answers) {
  DeclaredMechanism mechanism = default_mechanism();
  mechanism.units = answers.units;
  mechanism.name = answers.name;
  mechanism.joint.R = answers.length;
  mechanism.joint.theta_min = radians(answers.range.low);
  mechanism.joint.theta_max = radians(answers.range.high);
  mechanism.load.tip_force = answers.load.force;
  mechanism.load.torque = answers.load.torque;
  mechanism.tendon.diameter = answers.tendon.diameter;
  mechanism.tendon.modulus = answers.tendon.modulus;
  mechanism.tendon.bend_ratio = answers.tendon.bend_ratio;
  mechanism.tendon.strength = answers.tendon.strength;
  Body& body = mechanism.body;
  if (!answers.motor.shaft.empty()) {
    body.shaft = answers.motor.shaft;
  } else if (!answers.motor.horn.empty()) {
    body.bore = Bore::horn;
    body.horn = answers.motor.horn;
  } else {
    body.bore = answers.motor.flat ? Bore::d : Bore::round;
    body.bore_diameter = answers.motor.bore;
  }
  if (!answers.motor.model.empty()) mechanism.motor.model = answers.motor.model;
  mechanism.motor.travel = answers.motor.typed_travel;
  mechanism.motor.gear_ratio = answers.motor.gear_ratio;
  return mechanism;
}

/// A length of the layout has four digits in inches. One that was typed is exact.
std::string length_text(const Field& field, double length, LengthUnit units) {
  const bool is_typed = field.table == "tendon" || field.table == "body" || field.key == "length_mm";
  if (units == LengthUnit::mm || is_typed) return length_value_text(length, units);
  return rounded(from_mm(length, units), 4);
}

std::string value_text(const Field& field, const DeclaredMechanism& mechanism) {
  const auto number = [&](int end) {
    return is_length(field.key) ? length_text(field, field.get(mechanism, end), mechanism.units)
                                : number_text(field, mechanism, end);
  };
  if (field.kind == FieldKind::number) return number(0);
  if (field.kind == FieldKind::range || field.kind == FieldKind::point)
    return fmt::format("[{}, {}]", number(0), number(1));
  const std::string words = field.get_text(mechanism);
  return field.kind == FieldKind::boolean ? words : toml_string(words);
}

/// The keys of answers and layout, which the file states; all others have their defaults.
std::vector<std::string> keys_to_write(const DeclaredMechanism& mechanism) {
  std::string keys = mechanism.units == LengthUnit::inch ? "units " : "";
  keys +=
      "name joint.length_mm joint.range_deg guides.EB_mm guides.ED_mm guides.OE_mm guides.radius_mm pulley.EF_mm "
      "pulley.r1_mm pulley.law tendon.diameter_mm tendon.modulus_MPa tendon.bend_ratio ";
  if (mechanism.tendon.strength > 0) keys += "tendon.strength_N ";
  if (mechanism.joint.drum_radius > 0) keys += "joint.drum_radius_mm joint.attachment1_mm joint.attachment2_mm ";
  if (mechanism.guides.kind == GuideKind::idler)
    keys += "guides.kind guides.bearing_radius_mm guides.bearing_friction ";
  keys += mechanism.load.torque != 0 ? "load.torque_Nmm " : "load.tip_force_N ";
  if (find_shaft(mechanism.body.shaft) != nullptr)
    keys += "body.shaft";
  else
    keys += mechanism.body.bore == Bore::horn ? "body.bore body.horn" : "body.bore body.bore_diameter_mm";
  if (mechanism.body.set_screw != default_mechanism().body.set_screw) keys += " body.set_screw body.nut_trap";
  if (mechanism.body.hub_height != default_mechanism().body.hub_height) keys += " body.hub_height_mm";
  if (mechanism.motor.model != Motor{}.model) keys += " motor.model";
  if (mechanism.motor.travel > 0) keys += " motor.travel_deg";
  if (mechanism.motor.gear_ratio != 1) keys += " motor.gear_ratio";
  if (mechanism.tendon.pretension != default_mechanism().tendon.pretension) keys += " tendon.pretension_N";
  if (mechanism.body.room > 0) keys += " body.room_diameter_mm";
  return split(keys, ' ');
}

/// The mechanism file. `about`: a comment at its beginning; `more`: further keys to write; `pretension`: the reason for
/// the pretension.
std::string file_of(const DeclaredMechanism& mechanism, const std::string& about,
                    const std::vector<std::string>& more = {}, const std::string& pretension = {}) {
  std::vector<std::string> keys = keys_to_write(mechanism);
  keys.insert(keys.end(), more.begin(), more.end());
  std::string text = "# Made by 'fusee new --ask'. All other keys have their defaults: 'fusee explain' lists them.\n" +
                     (about.empty() ? "" : wrapped(about, "# ", "# ")) + "schema = 1\n";
  std::string_view table;
  for (const Field& field : fields()) {
    if (std::find(keys.begin(), keys.end(), field.name()) == keys.end()) continue;
    if (field.table != table) {
      table = field.table;
      text += fmt::format("\n[{}]\n", table);
    }
    text += wrapped(field.meaning, field.symbol.empty() ? "# " : fmt::format("# {}: ", field.symbol), "# ");
    if (field.name() == "tendon.pretension_N" && !pretension.empty()) text += wrapped(pretension, "# ", "# ");
    text += fmt::format("{} = {}\n", field.key, value_text(field, mechanism));
  }
  return text;
}

// The layout ----------------------------------------------------------------------------------------------------------

/// Finds layouts for answers.
class Layouts {
 public:
  Layouts(const std::vector<Setting>& settings, const RunContext& context) : settings_(settings), context_(context) {}

  /// `any`: the first layout that builds suffices.
  pipeline::LayoutSearch search(const Answers& answers, const RunContext& context, bool any = false) const {
    const auto file = [this](const DeclaredMechanism& mechanism) {
      MechanismFile read;
      read.path = "your answers";
      read.mechanism = parse_mechanism(file_of(mechanism, ""), read.path, ".", settings_, &read.warnings, &read.places,
                                       *context_.files);
      return read;
    };
    pipeline::LayoutRequirements requirements{joint_of(answers), answers.room, answers.motor.travel, any};
    requirements.joint.motor = motor_of(requirements.joint);
    if (const double travel = motor_limits(requirements.joint.motor).travel; travel > 0) requirements.travel = travel;
    return pipeline::choose_layout(requirements, file, context);
  }

  /// Changes of single answers with which a layout exists.
  std::vector<OtherAnswer> others(const Answers& answers) const {
    std::vector<OtherAnswer> found;
    const auto add = [&](int question, std::string to, std::string from) {
      found.push_back({question, std::string(questions()[static_cast<std::size_t>(question - 1)].subject),
                       std::move(to), std::move(from)});
    };
    constexpr int k_motor_question = 6, k_tendon_question = 7;  // numbers in questions()
    if (auto room = other_room(answers)) found.push_back(std::move(*room));
    // Thinner tendons, the thickest first, in numbers of two digits.
    for (const double share : {0.75, 0.5, 0.3, 0.15}) {
      Answers other = answers;
      other.tendon.diameter = number_of(rounded(share * answers.tendon.diameter, 2));
      if (!exists(other)) continue;
      add(k_tendon_question, rounded(other.tendon.diameter) + " mm", rounded(answers.tendon.diameter) + " mm");
      break;
    }
    // Plain shafts thinner than the answered one, or any if a motor was named. The thickest comes first.
    for (const char* motor : {"5 mm", "3 mm", "2 mm", "1 mm"}) {
      Answers other = answers;
      other.motor = std::get<TypedMotor>(read_motor(motor));
      if (other.motor.bore >= answers.motor.bore && answers.motor.bore > 0) continue;
      if (!exists(other)) continue;
      add(k_motor_question, motor, answers.motor.words);
      break;
    }
    return found;
  }

  /// A larger room with which a layout exists: for a pulley and a drum. `found`: set to it, mm.
  std::optional<OtherAnswer> other_room(const Answers& answers, double* found = nullptr) const {
    constexpr int k_room_question = 4;  // number in questions()
    const auto room = nearest(answers, &Answers::room, {1.1, 1.25, 1.5, 2, 3, 5, 8});
    if (!room) return std::nullopt;
    if (found != nullptr) *found = *room;
    return OtherAnswer{k_room_question, std::string(questions()[k_room_question - 1].subject), rounded(*room) + " mm",
                       rounded(answers.room) + " mm"};
  }

 private:
  /// The motor of the answers with settings, as a file with both has it. Its travel is that of the motor, before a
  /// gearbox.
  Motor motor_of(const DeclaredMechanism& joint) const {
    std::vector<Setting> of_motor;
    std::copy_if(settings_.begin(), settings_.end(), std::back_inserter(of_motor),
                 [](const Setting& setting) { return setting.key.starts_with("motor."); });
    if (of_motor.empty()) return joint.motor;
    DeclaredMechanism complete = joint;  // with any layout, as the reader requires one
    for (double* length :
         {&complete.guides.EB, &complete.guides.ED, &complete.guides.OE, &complete.pulley.EF, &complete.pulley.r1})
      *length = 10;
    const std::string text = file_of(complete, "");
    return parse_mechanism(text, "your answers", ".", of_motor, nullptr, nullptr, *context_.files).motor;
  }

  /// False also if a setting does not suit the answers, such as motor.enforce for another motor.
  bool exists(const Answers& answers) const {
    try {
      return search(answers, context_.without_progress(), /*any=*/true).chosen.has_value();
    } catch (const InputError&) {
      return false;
    }
  }

  /// Tries `factors` times the present value of `number` until a layout exists, then bisects towards the last value
  /// without one. In whole mm, or tenths below 10 mm.
  std::optional<double> nearest(const Answers& answers, double Answers::*number,
                                const std::vector<double>& factors) const {
    const auto rounded_up = [](double value) {
      const double step = value < 10 ? 0.1 : 1.0;
      return number_of(rounded(std::ceil(value / step - 1e-9) * step));
    };
    const auto has_layout = [&](double value) {
      Answers other = answers;
      other.*number = value;
      return exists(other);
    };
    double infeasible = answers.*number;
    for (const double factor : factors) {
      double feasible = rounded_up(factor * answers.*number);
      if (!has_layout(feasible)) {
        infeasible = feasible;
        continue;
      }
      for (int halvings = 0; halvings < 3; ++halvings) {
        const double middle = rounded_up(0.5 * (infeasible + feasible));
        if (!(middle < feasible)) break;
        (has_layout(middle) ? feasible : infeasible) = middle;
      }
      return feasible;
    }
    return std::nullopt;
  }

  const std::vector<Setting>& settings_;
  const RunContext& context_;
};

/// "A drum on the joint, tendons over pins. The pulley is 26 mm wide (room 30 mm) and turns 140 deg …".
std::string about(const pipeline::ChosenLayout& layout, const Answers& answers) {
  std::string words = layout.words;
  words.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(words.front())));
  const std::string pulley = fmt::format(
      "{}. The pulley is {} mm wide (room {} mm) and turns {} deg over the range; the load pulls a tendon with {} N.",
      words, rounded(layout.diameter, 3), rounded(answers.room), rounded(degrees(layout.travel), 3),
      rounded(layout.tension, 3));
  // The reason for a pretension that is written stands beside it.
  const analysis::UnderLoad& load = layout.built.product.under_load;
  const bool is_slack = !layout.pretension_words.empty() && !(load.slack1.empty() && load.slack2.empty());
  std::string shortcoming = is_slack ? " A tendon is slack under the load: " + layout.pretension_words + "." : "";
  if (!layout.price_words.empty()) shortcoming += " Note: " + layout.price_words + ".";
  return fmt::format("{} Motor: {}. Tendon: {}.{}", lengths_in(answers.units, pulley), motor_words(answers),
                     lengths_in(answers.units, answers.tendon.words), shortcoming);
}

/// "a drum of 42.3 mm radius (now 36.7 mm) and a pulley 34 mm wide and 58.7 mm high (now 35.7 mm and 23 mm)".
std::string words_beside(const pipeline::ChosenLayout& other, const pipeline::ChosenLayout& now) {
  const auto height = [](const pipeline::ChosenLayout& layout) {
    return rounded(solid::outer_size(layout.built.product.pulley).height, 3);
  };
  const double drum = other.file.mechanism.joint.drum_radius, drum_now = now.file.mechanism.joint.drum_radius;
  std::string words;
  if (drum > 0)
    words = fmt::format("a drum of {} mm radius ({}) and ", rounded(drum),
                        drum_now > 0 ? "now " + rounded(drum_now) + " mm" : "now a lever");
  words += fmt::format("a pulley {} mm wide and {} mm high (now {} mm and {} mm)", rounded(other.diameter, 3),
                       height(other), rounded(now.diameter, 3), height(now));
  if (other.built.product.helix && !now.built.product.helix) words += ", of several turns";
  if (!other.is_held && now.is_held) words += ", which nothing holds on its shaft";
  return words;
}

bool sets_units(const Setting& setting) { return setting.key == "units"; }

/// The file of a layout: the keys of answers, layout and settings. A setting of a list needs every key.
std::string text_of(const pipeline::ChosenLayout& layout, const Answers& answers,
                    const std::vector<Setting>& settings) {
  std::vector<std::string> keys;
  for (const Setting& setting : settings) {
    if (sets_units(setting)) continue;
    const Field* field = find_field(setting.key);
    if (field == nullptr || field->kind == FieldKind::numbers || field->kind == FieldKind::texts)
      return write_mechanism(layout.file.mechanism);
    keys.push_back(setting.key);
  }
  return file_of(layout.file.mechanism, about(layout, answers), keys, layout.pretension_words);
}

/// The unit of lengths that --set units=inch selects.
LengthUnit units_of(const std::vector<Setting>& settings) {
  const auto found = std::find_if(settings.rbegin(), settings.rend(), sets_units);
  if (found == settings.rend()) return LengthUnit::mm;
  std::string unit = found->value;
  std::erase(unit, '"');
  return unit == "inch" ? LengthUnit::inch : LengthUnit::mm;
}

}  // namespace

AskedMechanism ask_for_mechanism(Console& console, const std::vector<Setting>& settings, const RunContext& context) {
  Answers answers;
  answers.units = answers.plain = units_of(settings);
  answers.may_be_inches = settings.empty();  // numbers of --set are in the file's unit
  std::vector<std::string> understood;
  for (std::size_t i = 0; i < questions().size(); ++i) {
    const auto answer = ask_until_usable(console, i, answers, questions()[i].proposal(answers));
    if (!answer) {
      throw InputError(Diagnostic{Severity::error,
                                  {},
                                  fmt::format("the input ended at question {} of {} ({}): no file was written", i + 1,
                                              questions().size(), questions()[i].subject),
                                  understood.empty() ? "type an answer, or Enter for the proposal"
                                                     : "answered: " + answered_words(understood)});
    }
    understood.push_back(*answer);
  }
  const Layouts layouts(settings, context);
  while (true) {
    AskedMechanism asked;
    asked.search = layouts.search(answers, context);
    asked.units = answers.units;
    if (asked.search.chosen) {
      const pipeline::ChosenLayout& layout = *asked.search.chosen;
      asked.text = text_of(layout, answers, settings);
      if (layout.stalls) {
        // With the limit of the motor, a layout that the motor cannot hold is none.
        std::vector<Setting> with_limit = settings;
        with_limit.push_back({"motor.enforce", "true"});
        double room = 0;
        asked.room = Layouts(with_limit, context).other_room(answers, &room);
        if (asked.room) {
          Answers wider = answers;
          wider.room = room;
          const pipeline::LayoutSearch search = layouts.search(wider, context.without_progress());
          if (search.chosen && !search.chosen->stalls)
            asked.room_words = words_beside(*search.chosen, layout);
          else
            asked.room.reset();
        }
      }
      console.write("\n" + lengths_in(answers.units, joint_picture(layout.built.product)) + "\n");
      return asked;
    }
    asked.others = layouts.others(answers);
    if (asked.others.empty()) return asked;
    console.report(
        {Severity::error, {}, "no layout fits these answers: " + lengths_in(answers.units, asked.search.obstacle), {}});
    const OtherAnswer& other = asked.others.front();
    const auto number = static_cast<std::size_t>(other.question - 1);
    if (!ask_until_usable(console, number, answers, other.answer)) return asked;
  }
}

}  // namespace fusee::cli
