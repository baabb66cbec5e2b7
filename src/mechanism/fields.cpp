#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "mechanism/catalogue.h"
#include "mechanism/effect.h"

namespace fusee {
namespace {

// ---- accessors of members -------------------------------------------------------------------------------------------

double identity(double value) { return value; }
double in_percent(double fraction) { return 100.0 * fraction; }
double from_percent(double percent) { return percent / 100.0; }

using Conversion = double (*)(double);

template <auto Part, auto Member, Conversion to_file, Conversion from_file>
struct NumberAccess {
  static double get(const DeclaredMechanism& mechanism, int) { return to_file(mechanism.*Part.*Member); }
  static void set(DeclaredMechanism& mechanism, int, double value) { mechanism.*Part.*Member = from_file(value); }
};

constexpr std::array<std::string_view, 4> names(Law) { return {"compensate", "linear", "table", "torque"}; }
constexpr std::array<std::string_view, 2> names(GuideKind) { return {"pin", "idler"}; }
constexpr std::array<std::string_view, 2> names(Method) { return {"exact", "paper"}; }
constexpr std::array<std::string_view, 2> names(WindingChoice) { return {"auto", "one_turn"}; }
constexpr std::array<std::string_view, 3> names(Groove) { return {"u", "v", "flat"}; }
constexpr std::array<std::string_view, 2> names(Flange) { return {"follow", "round"}; }
constexpr std::array<std::string_view, 6> names(Bore) { return {"round", "d", "hex", "square", "keyway", "horn"}; }
constexpr std::array<std::string_view, 3> names(Parts) { return {"auto", "one", "two"}; }
constexpr std::array<std::string_view, 3> names(Marks) { return {"engraved", "raised", "none"}; }
constexpr std::array<std::string_view, 2> names(Tail) { return {"slot", "none"}; }

template <auto Part, auto Member>
struct ChoiceAccess {
  using Enum = std::remove_cvref_t<decltype(std::declval<DeclaredMechanism>().*Part.*Member)>;
  static constexpr auto k_names = names(Enum{});

  static std::string get(const DeclaredMechanism& mechanism) {
    return std::string(k_names.at(static_cast<std::size_t>(mechanism.*Part.*Member)));
  }
  static void set(DeclaredMechanism& mechanism, std::string_view value) {
    const auto found = std::find(k_names.begin(), k_names.end(), value);
    demand(found != k_names.end(), "choice " + std::string(value));
    mechanism.*Part.*Member = static_cast<Enum>(found - k_names.begin());
  }
};

template <auto Part, auto Member>
struct TextAccess {
  static std::string get(const DeclaredMechanism& mechanism) { return mechanism.*Part.*Member; }
  static void set(DeclaredMechanism& mechanism, std::string_view value) { mechanism.*Part.*Member = value; }
};

template <auto Part, auto Member>
struct BooleanAccess {
  static std::string get(const DeclaredMechanism& mechanism) { return mechanism.*Part.*Member ? "true" : "false"; }
  static void set(DeclaredMechanism& mechanism, std::string_view value) { mechanism.*Part.*Member = value == "true"; }
};

template <auto Part, auto Member>
auto& member_of(DeclaredMechanism& mechanism) {
  return mechanism.*Part.*Member;
}

// ---- builders of rows -----------------------------------------------------------------------------------------------

/// Common properties of all kinds of rows.
struct Row {
  std::string_view name;  ///< "joint.length_mm"
  std::string_view symbol;
  std::string_view fallback;  ///< "": no default; the key is then mandatory, unless `only_when` is set
  std::string_view meaning;
  std::string_view only_when = {};
};

Field base_field(const Row& row, FieldKind kind) {
  Field field;
  const std::size_t dot = row.name.find('.');
  field.table = dot == std::string_view::npos ? std::string_view() : row.name.substr(0, dot);
  field.key = dot == std::string_view::npos ? row.name : row.name.substr(dot + 1);
  field.symbol = row.symbol;
  field.kind = kind;
  field.required = row.fallback.empty() && row.only_when.empty();
  field.only_when = row.only_when;
  field.fallback = row.fallback;
  field.meaning = row.meaning;
  return field;
}

template <auto Part, auto Member, Conversion to_file = identity, Conversion from_file = identity>
Field number(const Row& row, std::string_view unit, double least, double most) {
  Field field = base_field(row, FieldKind::number);
  field.unit = unit;
  field.least = least;
  field.most = most;
  field.get = &NumberAccess<Part, Member, to_file, from_file>::get;
  field.set = &NumberAccess<Part, Member, to_file, from_file>::set;
  return field;
}

template <auto Part, auto Member>
Field whole_number(const Row& row, int least, int most) {
  Field field = base_field(row, FieldKind::number);
  field.whole = true;
  field.least = least;
  field.most = most;
  field.get = [](const DeclaredMechanism& mechanism, int) { return static_cast<double>(mechanism.*Part.*Member); };
  field.set = [](DeclaredMechanism& mechanism, int, double value) {
    mechanism.*Part.*Member = static_cast<int>(std::lround(value));
  };
  return field;
}

template <auto Part, auto Member>
Field choice(const Row& row) {
  using Access = ChoiceAccess<Part, Member>;
  Field field = base_field(row, FieldKind::choice);
  field.choices.assign(Access::k_names.begin(), Access::k_names.end());
  field.get_text = &Access::get;
  field.set_text = &Access::set;
  return field;
}

template <auto Part, auto Member>
Field text(const Row& row, std::vector<std::string_view> choices = {}) {
  Field field = base_field(row, choices.empty() ? FieldKind::text : FieldKind::choice);
  field.choices = std::move(choices);
  field.get_text = &TextAccess<Part, Member>::get;
  field.set_text = &TextAccess<Part, Member>::set;
  return field;
}

template <auto Part, auto Member>
Field boolean(const Row& row) {
  Field field = base_field(row, FieldKind::boolean);
  field.get_text = &BooleanAccess<Part, Member>::get;
  field.set_text = &BooleanAccess<Part, Member>::set;
  return field;
}

/// `least`, `most`: bounds of each number of the list.
template <auto Part, auto Member>
Field numbers(const Row& row, double least, double most) {
  Field field = base_field(row, FieldKind::numbers);
  field.least = least;
  field.most = most;
  field.numbers = &member_of<Part, Member>;
  return field;
}

template <auto Part, auto Member>
Field texts(const Row& row, std::vector<std::string_view> choices = {}) {
  Field field = base_field(row, FieldKind::texts);
  field.choices = std::move(choices);
  field.texts = &member_of<Part, Member>;
  return field;
}

std::vector<std::string_view> motor_names() {
  std::vector<std::string_view> names{"none"};
  for (const MotorModel& model : motor_models()) names.push_back(model.name);
  return names;
}

std::vector<std::string_view> shaft_names() {
  std::vector<std::string_view> names{"none"};
  for (const ShaftType& type : shafts()) names.push_back(type.name);
  return names;
}

// ---- rows without a member of their own -----------------------------------------------------------------------------

Field schema_field() {
  Field field = base_field({"schema", "", "", "version of this file format"}, FieldKind::number);
  field.least = field.most = 1;
  field.get = [](const DeclaredMechanism&, int) { return 1.0; };
  field.set = [](DeclaredMechanism&, int, double) {};
  return field;
}

Field name_field() {
  Field field =
      base_field({"name", "", "\"joint\"", "name of the joint; appears in the output files"}, FieldKind::text);
  field.get_text = [](const DeclaredMechanism& mechanism) { return mechanism.name; };
  field.set_text = [](DeclaredMechanism& mechanism, std::string_view value) { mechanism.name = value; };
  return field;
}

constexpr std::array<std::string_view, 2> k_unit_names = {"mm", "inch"};  // in the order of LengthUnit

Field units_field() {
  Field field =
      base_field({"units", "", "\"mm\"",
                  "unit of the numbers under keys that end in _mm; a text such as \"3 1/2 in\" has its own unit"},
                 FieldKind::choice);
  field.choices.assign(k_unit_names.begin(), k_unit_names.end());
  field.get_text = [](const DeclaredMechanism& mechanism) {
    return std::string(k_unit_names.at(static_cast<std::size_t>(mechanism.units)));
  };
  field.set_text = [](DeclaredMechanism& mechanism, std::string_view value) {
    mechanism.units = value == "inch" ? LengthUnit::inch : LengthUnit::mm;
  };
  field.is_set = [](const DeclaredMechanism& mechanism) { return mechanism.units != LengthUnit::mm; };
  return field;
}

Field range_field() {
  Field field = base_field(
      {"joint.range_deg", "theta", "", "the joint's lowest and highest angle; home (0) lies within"}, FieldKind::range);
  field.unit = "deg";
  field.least = -180;
  field.most = 180;
  field.get = [](const DeclaredMechanism& m, int end) {
    return degrees_as_read(end == 0 ? m.joint.theta_min : m.joint.theta_max);
  };
  field.set = [](DeclaredMechanism& m, int end, double value) {
    (end == 0 ? m.joint.theta_min : m.joint.theta_max) = radians(value);
  };
  return field;
}

template <std::optional<Attachment> Joint::*attachment>
Field attachment_field(std::string_view name, std::string_view meaning) {
  Field field = base_field({name, "", "", meaning}, FieldKind::point);
  field.required = false;
  field.otherwise = "[0, length_mm], which is C";
  field.unit = "mm";
  field.least = -10000;
  field.most = 10000;
  field.is_set = [](const DeclaredMechanism& m) { return (m.joint.*attachment).has_value(); };
  field.get = [](const DeclaredMechanism& m, int end) {
    const Attachment at = (m.joint.*attachment).value_or(Attachment{0, m.joint.R});
    return end == 0 ? at.across : at.along;
  };
  field.set = [](DeclaredMechanism& m, int end, double value) {
    if (!(m.joint.*attachment)) m.joint.*attachment = Attachment{0, m.joint.R};
    (end == 0 ? (m.joint.*attachment)->across : (m.joint.*attachment)->along) = value;
  };
  return field;
}

Field transmission_kind_field() {
  Field field =
      base_field({"transmission.kind", "", "", "a joint declared by a ratio, for calibrate only"}, FieldKind::choice);
  field.choices = {"ratio"};
  field.get_text = [](const DeclaredMechanism& m) { return std::string(m.transmission ? "ratio" : ""); };
  field.set_text = [](DeclaredMechanism& m, std::string_view) {
    if (!m.transmission) m.transmission.emplace();
  };
  return field;
}

Field transmission_ratio_field() {
  Field field =
      base_field({"transmission.ratio", "", "", "theta = offset + alpha/ratio; either sign, not 0"}, FieldKind::number);
  field.least = -10000;
  field.most = 10000;
  field.get = [](const DeclaredMechanism& m, int) { return m.transmission ? m.transmission->ratio : 0.0; };
  field.set = [](DeclaredMechanism& m, int, double value) {
    if (!m.transmission) m.transmission.emplace();
    m.transmission->ratio = value;
  };
  return field;
}

// ---- the table ------------------------------------------------------------------------------------------------------
// Bounds are generous: they exclude values that cannot be made or computed, and catch wrong units and decimal points.
// Synthesis decides if a pulley exists.

void add_load(std::vector<Field>& table) {
  constexpr auto load = &Mechanism::load;
  table.push_back(number<load, &Load::tip_force>(
      {"load.tip_force_N", "F_c", "0", "force across OC at C, positive against +theta"}, "N", -100000, 100000));
  table.push_back(number<load, &Load::torque>(
      {"load.torque_Nmm", "", "0", "torque on the joint, positive against +theta"}, "Nmm", -10000000, 10000000));
  table.push_back(
      number<load, &Load::mass_kg>({"load.mass_kg", "", "0", "mass of the link and what it carries"}, "kg", 0, 10000));
  table.push_back(number<load, &Load::lever>(
      {"load.lever_mm", "", "0", "from the joint axis along OC to the centre of mass"}, "mm", -10000, 10000));
  table.push_back(number<load, &Load::tilt, degrees_as_read, radians>(
      {"load.tilt_deg", "", "0",
       "the joint angle at which OC points straight up; 0: upright at home; 90: horizontal at home, so that the weight "
       "loads tendon 2; 180: hanging down at home"},
      "deg", -360, 360));
}

void add_sheath(std::vector<Field>& table) {
  constexpr auto sheath = &Mechanism::sheath;
  const auto add = [&table](Field field, std::string_view otherwise) {
    field.required = false;
    field.needed_in_table = !otherwise.empty();
    field.otherwise = otherwise;
    field.is_set = [](const DeclaredMechanism& m) { return m.sheath.is_there(); };
    table.push_back(std::move(field));
  };
  constexpr std::string_view if_omitted = "no sheath; required with any key of [sheath]";
  add(number<sheath, &Sheath::length>({"sheath.length_mm", "", "",
                                       "length of each tendon's Bowden sheath from its pin to the motor; the sheath "
                                       "points straight down at the pin"},
                                      "mm", 1, 100000),
      if_omitted);
  add(number<sheath, &Sheath::bend, degrees_as_read, radians>(
          {"sheath.bend_deg", "", "", "total bend of a sheath, ends included: 180 for a half turn of any radius"},
          "deg", 0, 3600),
      if_omitted);
  add(number<sheath, &Sheath::mu>(
          {"sheath.friction", "", "0.08",
           "capstan coefficient between tendon and sheath: it reduces a tension by a factor e^(friction bend)"},
          "", 0, 1),
      {});
  add(number<sheath, &Sheath::stiffness>(
          {"sheath.stiffness_N_per_mm", "", "0", "axial stiffness of a sheath in compression; 0: rigid"}, "N/mm", 0,
          1000000),
      {});
  add(number<sheath, &Sheath::exit_across>(
          {"sheath.exit_across_mm", "", "",
           "distance of the sheath exits at the motor to the left and right of the pulley's axis"},
          "mm", 0.1, 10000),
      if_omitted);
  add(number<sheath, &Sheath::exit_above>(
          {"sheath.exit_above_mm", "", "", "height of the sheath exits at the motor above the pulley's axis"}, "mm", 1,
          10000),
      if_omitted);
}

void add_spring(std::vector<Field>& table) {
  constexpr auto spring = &Mechanism::spring;
  constexpr auto has_spring = [](const DeclaredMechanism& m) { return m.spring != Spring{}; };
  table.push_back(number<spring, &Spring::stiffness>(
      {"spring.stiffness_Nmm_per_rad", "", "0",
       "stiffness of a spring about the joint's axis, between base and link; 0: constant torque preload_Nmm"},
      "Nmm_per_rad", 0, 10000000));
  table.back().is_set = has_spring;
  table.push_back(number<spring, &Spring::preload>(
      {"spring.preload_Nmm", "", "0", "torque of the spring at free_deg, positive against +theta"}, "Nmm", -10000000,
      10000000));
  table.back().is_set = has_spring;
  table.push_back(number<spring, &Spring::free, degrees_as_read, radians>(
      {"spring.free_deg", "", "0",
       "the joint angle at which the spring's torque is preload_Nmm; without preload: its rest angle"},
      "deg", -360, 360));
  table.back().is_set = has_spring;
}

constexpr double k_deg_per_s = 6.0;  ///< degrees per second of one revolution per minute

double from_rpm(double rpm) { return radians(k_deg_per_s * rpm); }
/// The number of revolutions per minute that from_rpm() converts to exactly `speed` (rad/s); the nearest one if there
/// is none.
double in_rpm(double speed) {
  const double rpm = degrees_as_read(speed) / k_deg_per_s;
  for (const double near : {rpm, std::nextafter(rpm, 0.0), std::nextafter(rpm, HUGE_VAL)}) {
    if (from_rpm(near) == speed) return near;
  }
  return rpm;
}

void add_motor(std::vector<Field>& table) {
  constexpr auto motor = &Mechanism::motor;
  table.push_back(text<motor, &Motor::model>(
      {"motor.model", "", "\"none\"",
       "the motor of the catalogue that turns the pulley; numbers written beside it replace its own"},
      motor_names()));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.motor.model != "none"; };
  const auto add = [&table](Field field, std::string_view otherwise, bool (*is_set)(const DeclaredMechanism&)) {
    field.required = false;
    field.otherwise = otherwise;
    field.is_set = is_set;
    table.push_back(std::move(field));
  };
  constexpr std::string_view of_model = "that of motor.model; without one, no limit";
  add(number<motor, &Motor::travel, degrees_as_read, radians>(
          {"motor.travel_deg", "", "", "angle that the motor turns from one end of its range to the other"}, "deg", 1,
          1000000),
      of_model, [](const DeclaredMechanism& m) { return m.motor.travel > 0; });
  add(number<motor, &Motor::stall_torque>({"motor.stall_torque_Nmm", "", "", "torque at which the motor stalls"}, "Nmm",
                                          0.001, 100000000),
      of_model, [](const DeclaredMechanism& m) { return m.motor.stall_torque > 0; });
  add(number<motor, &Motor::speed, degrees_as_read, radians>(
          {"motor.speed_deg_per_s", "", "", "speed of the motor without load"}, "deg/s", 0.001, 1000000),
      of_model, [](const DeclaredMechanism& m) { return m.motor.speed > 0; });
  // An alternative unit of the speed, which is written in deg/s.
  add(number<motor, &Motor::speed, in_rpm, from_rpm>(
          {"motor.speed_rpm", "", "", "speed of the motor without load, in place of speed_deg_per_s"}, "rpm", 0.001,
          100000),
      "motor.speed_deg_per_s", [](const DeclaredMechanism&) { return false; });
  table.push_back(number<motor, &Motor::gear_ratio>(
      {"motor.gear_ratio", "", "1",
       "turns of the motor per turn of the pulley, by a gearbox between them: the motor's torque is multiplied by it, "
       "its speed and travel are divided"},
      "", 0.001, 100000));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.motor.gear_ratio != 1; };
  table.push_back(number<motor, &Motor::gear_efficiency>(
      {"motor.gear_efficiency", "", "0.9", "share of the torque that the gearbox passes on"}, "", 0.01, 1));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.motor.gear_efficiency != Motor{}.gear_efficiency; };
  add(number<motor, &Motor::joint_speed, degrees_as_read, radians>(
          {"motor.joint_speed_deg_per_s", "", "", "speed that the joint must reach at every angle under [load]"},
          "deg/s", 0.001, 1000000),
      "no speed is required", [](const DeclaredMechanism& m) { return m.motor.joint_speed > 0; });
  table.push_back(boolean<motor, &Motor::enforce>(
      {"motor.enforce", "", "false",
       "true: a joint that requires more travel, torque or speed than the motor has is refused; false: a warning"}));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.motor.enforce; };
}

void add_mechanism(std::vector<Field>& table) {
  constexpr auto joint = &Mechanism::joint;
  constexpr auto guides = &Mechanism::guides;
  constexpr auto pulley = &Mechanism::pulley;
  constexpr auto tendon = &Mechanism::tendon;
  table.push_back(number<joint, &Joint::R>(
      {"joint.length_mm", "R", "", "from the joint axis O to the tendons' attachment C"}, "mm", 1, 10000));
  table.push_back(range_field());
  table.push_back(
      number<joint, &Joint::drum_radius>({"joint.drum_radius_mm", "", "0",
                                          "radius of a drum about O, fixed to the link, on which tendons wrap with "
                                          "their centre line half a thickness further out; 0: none"},
                                         "mm", 0, 5000));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.joint.drum_radius > 0; };
  table.push_back(number<joint, &Joint::drum_mu>(
      {"joint.drum_friction", "", "0",
       "capstan coefficient between tendon and drum; it limits how far a tendon slides on the drum; 0: slides freely"},
      "", 0, 1));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.joint.drum_mu > 0; };
  table.push_back(
      attachment_field<&Joint::attachment1>("joint.attachment1_mm",
                                            "end of tendon 1 in the link at home: [to the right, along OC]; between "
                                            "the drum and its pitch circle an end is moved onto that circle"));
  table.push_back(attachment_field<&Joint::attachment2>(
      "joint.attachment2_mm",
      "end of tendon 2 in the link at home: [to the right, along OC]; over the drum's top it may be left of O"));
  table.push_back(number<guides, &Guides::EB>(
      {"guides.EB_mm", "EB", "", "distance of guide pin B to the left of the line through the axes"}, "mm", 0.1,
      10000));
  table.push_back(number<guides, &Guides::ED>(
      {"guides.ED_mm", "ED", "", "distance of guide pin D to the right of the line through the axes"}, "mm", 0.1,
      10000));
  table.push_back(number<guides, &Guides::OE>(
      {"guides.OE_mm", "OE", "",
       "from the joint axis to the line of the pins; positive: the pins are below the joint, away from C"},
      "mm", -10000, 10000));
  table.push_back(number<guides, &Guides::radius>(
      {"guides.radius_mm", "", "2", "radius of the guide pins themselves; 0: a point"}, "mm", 0, 500));
  table.push_back(number<guides, &Guides::mu>(
      {"guides.friction", "mu", "0.12", "capstan coefficient of friction at the pins"}, "", 0, 2));
  constexpr auto has_idlers = [](const DeclaredMechanism& m) { return m.guides.kind == GuideKind::idler; };
  table.push_back(choice<guides, &Guides::kind>(
      {"guides.kind", "", "\"pin\"",
       "pin: the tendon slides over it (guides.friction); idler: it turns on a bearing, with far less friction"}));
  table.back().is_set = has_idlers;
  table.push_back(number<guides, &Guides::bearing_radius>(
      {"guides.bearing_radius_mm", "", "1.5",
       "friction radius of an idler's bearing: the shaft radius of a plain bearing, the pitch radius of a ball bearing",
       "guides.kind=idler"},
      "mm", 0, 500));
  table.back().is_set = has_idlers;
  table.push_back(number<guides, &Guides::bearing_friction>(
      {"guides.bearing_friction", "", "0.005",
       "friction coefficient of an idler's bearing: 0.0015 to 0.005 for balls, 0.1 to 0.2 for plastic on steel",
       "guides.kind=idler"},
      "", 0, 1));
  table.back().is_set = has_idlers;
  table.push_back(boolean<guides, &Guides::collar>({"guides.collar", "", "false",
                                                    "true: a collar holds a multi-turn tendon at its guide's height, "
                                                    "and only its lower span slopes; false: the whole tendon slopes"}));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.guides.collar; };
  add_sheath(table);
  table.push_back(number<pulley, &PulleyDrive::EF>(
      {"pulley.EF_mm", "EF", "",
       "from the line of the pins down to the pulley's axis; with a sheath it only sets where the pulley is drawn"},
      "mm", 1, 10000));
  table.push_back(number<pulley, &PulleyDrive::r1>(
      {"pulley.r1_mm", "r1", "", "radius of the round pulley P1, to the tendon's centre line", "pulley.law=compensate"},
      "mm", 0.1, 10000));
  table.push_back(choice<pulley, &PulleyDrive::law>(
      {"pulley.law", "", "\"compensate\"",
       "compensate: P1 round, P2 keeps both tendons taut; linear: theta = alpha/ratio; table: theta(alpha) from a CSV; "
       "torque: the motor holds [load] and [spring] with the wanted torque"}));
  table.push_back(number<pulley, &PulleyDrive::ratio>({"pulley.ratio", "", "", "alpha per theta", "pulley.law=linear"},
                                                      "", 0.01, 1000));
  table.push_back(text<pulley, &PulleyDrive::table>(
      {"pulley.table", "", "", "CSV file with columns alpha_deg, theta_deg; its path is relative to this file",
       "pulley.law=table"}));
  table.push_back(
      number<pulley, &PulleyDrive::motor_torque>({"pulley.motor_torque_Nmm", "", "0",
                                                  "the motor torque, towards +alpha, that holds [load] and [spring] at "
                                                  "every angle, without friction; 0: given by pulley.torque_table",
                                                  "pulley.law=torque"},
                                                 "Nmm", -10000000, 10000000));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.pulley.motor_torque != 0; };
  table.push_back(
      text<pulley, &PulleyDrive::torque_table>({"pulley.torque_table", "", "\"\"",
                                                "CSV file with columns theta_deg, motor_torque_Nmm, in place of "
                                                "motor_torque_Nmm; its path is relative to this file",
                                                "pulley.law=torque"}));
  table.back().is_set = [](const DeclaredMechanism& m) { return !m.pulley.torque_table.empty(); };
  table.push_back(choice<pulley, &PulleyDrive::method>({"pulley.method", "", "\"exact\"",
                                                        "exact: the envelope of the tendon lines over the real pins; "
                                                        "paper: point pins, r2 drawn in polar coordinates"}));
  table.push_back(number<pulley, &PulleyDrive::mu>(
      {"pulley.friction", "mu", "0.2",
       "effective friction coefficient between tendon and groove; it limits how far the wound tendon slides, up to a "
       "knot 5 mm of arc beyond the range; in a V groove of full angle b: the material's coefficient over sin(b/2)"},
      "", 0, 2));
  table.push_back(choice<pulley, &PulleyDrive::winding>(
      {"pulley.winding", "", "\"auto\"",
       "auto: multi-turn helical grooves where one turn does not suffice; one_turn: such a pulley is rejected"}));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.pulley.winding != WindingChoice::automatic; };
  table.push_back(
      number<tendon, &Tendon::diameter>({"tendon.diameter_mm", "d", "", "thickness of the tendon"}, "mm", 0.01, 50));
  table.push_back(number<tendon, &Tendon::modulus>(
      {"tendon.modulus_MPa", "E", "40000", "Young's modulus over the full section of the diameter"}, "MPa", 1,
      1000000));
  table.push_back(number<tendon, &Tendon::pretension>(
      {"tendon.pretension_N", "", "5", "pretension of tendon 1 at home"}, "N", 0, 100000));
  table.push_back(number<tendon, &Tendon::bend_ratio>(
      {"tendon.bend_ratio", "D/d", "8", "minimum bend diameter per tendon diameter before a warning"}, "", 1, 1000));
  table.push_back(number<tendon, &Tendon::strength>(
      {"tendon.strength_N", "", "0",
       "breaking tension of the tendon without a knot, as its maker states it; 0: that of the catalogue's tendon of "
       "this diameter and modulus, if there is one"},
      "N", 0, 1000000));
  table.push_back(number<tendon, &Tendon::knot_efficiency>(
      {"tendon.knot_efficiency", "", "0.5",
       "fraction of its strength that a tendon keeps at a knot; 0.5 is usual for braided HMPE"},
      "", 0.05, 1));
  add_load(table);
  add_spring(table);
  add_motor(table);
}

void add_body(std::vector<Field>& table) {
  constexpr auto body = &Mechanism::body;
  table.push_back(choice<body, &Body::groove>(
      {"body.groove", "", "\"u\"",
       "section of the grooves: u has a round seat, v sloping walls only, flat a flat floor"}));
  table.push_back(number<body, &Body::groove_angle, degrees_as_read, radians>(
      {"body.groove_angle_deg", "", "50", "full angle between the walls of a groove"}, "deg", 0, 120));
  table.push_back(number<body, &Body::groove_depth>(
      {"body.groove_depth_mm", "", "0",
       "from a groove's floor to its edge; 0: twice the tendon's diameter, at least 0.8 mm"},
      "mm", 0, 50));
  table.push_back(number<body, &Body::seat_ratio>(
      {"body.seat_ratio", "", "0.55", "seat radius of a u groove per tendon diameter"}, "", 0.5, 2));
  table.push_back(choice<body, &Body::flange>(
      {"body.flange", "", "\"follow\"", "follow: flanges are parallel to the groove's outline; round: circles"}));
  table.push_back(number<body, &Body::flange_thickness>(
      {"body.flange_thickness_mm", "", "1.2", "thickness of the flanges at the groove's edge"}, "mm", 0.2, 50));
  table.push_back(number<body, &Body::hub_diameter>(
      {"body.hub_diameter_mm", "", "0",
       "diameter of the hub; 0: the largest that leaves space for the other features of its face"},
      "mm", 0, 1000));
  table.push_back(number<body, &Body::hub_height>(
      {"body.hub_height_mm", "", "8",
       "height of the hub above the top flange; 0: no hub; omitted, with a note, where it does not fit"},
      "mm", 0, 500));
  table.push_back(
      choice<body, &Body::bore>({"body.bore", "", "\"round\"", "shape of the bore; horn: a servo horn is screwed on"}));
  table.push_back(number<body, &Body::bore_diameter>(
      {"body.bore_diameter_mm", "", "0",
       "diameter of the shaft, across flats for hex and square; 0: 5 mm, less where space is short; a round bore is "
       "printed as a polygon around this circle, because printers cut inside of curves"},
      "mm", 0, 500));
  table.push_back(number<body, &Body::bore_flat>(
      {"body.bore_flat_mm", "", "0", "from the flat of a D shaft to its far side; 0: 0.9 times the diameter",
       "body.bore=d"},
      "mm", 0, 500));
  table.push_back(text<body, &Body::horn>({"body.horn", "", "\"own\"",
                                           "the servo horn that is screwed on; own: the one that [horn] describes",
                                           "body.bore=horn"}));
  table.push_back(text<body, &Body::shaft>(
      {"body.shaft", "", "\"none\"",
       "the motor shaft that the bore is for, in place of bore, bore_diameter_mm and bore_flat_mm"},
      shaft_names()));
  table.push_back(text<body, &Body::set_screw>(
      {"body.set_screw", "", "\"auto\"",
       "screw through the hub onto the shaft; auto: M3 to M2 as the hub has space, no wider than the shaft"},
      {"auto", "none", "M2", "M2.5", "M3", "M4", "M5", "M6", "#2-56", "#4-40", "#6-32", "#8-32", "#10-24", "1/4-20"}));
  table.push_back(boolean<body, &Body::nut_trap>(
      {"body.nut_trap", "", "true",
       "the set screw goes through a nut that is slid into the hub; false: its thread is cut into the hub"}));
  table.push_back(number<body, &Body::anchor_hole>(
      {"body.anchor_hole_mm", "", "0",
       "width of the channel to a tendon's knot; 0: tendon diameter + 0.3 mm, at least 0.6 mm"},
      "mm", 0, 50));
  table.push_back(number<body, &Body::knot_pocket>(
      {"body.knot_pocket_mm", "", "0",
       "diameter of the pocket for a tendon's knot; 0: 3.5 tendon diameters, less where space is short"},
      "mm", 0, 100));
  table.push_back(number<body, &Body::wrap, degrees_as_read, radians>(
      {"body.wrap_deg", "", "0",
       "minimum wrap of a tendon between its active arc and its tie-off, which relieves the knot; 0: as much as fits"},
      "deg", 0, 330));
  table.push_back(choice<body, &Body::tail>(
      {"body.tail", "", "\"slot\"",
       "place of a tendon's end beyond its knot; slot: in a straight slot of the face, if it fits"}));
  table.push_back(text<body, &Body::clamp_screw>(
      {"body.clamp_screw", "", "\"none\"", "screw whose head clamps the tail at the end of its slot"},
      {"none", "M2", "M2.5", "M3", "#2-56", "#4-40"}));
  table.push_back(choice<body, &Body::marks>(
      {"body.marks", "", "\"engraved\"", "home mark, clocking mark and labels on the faces"}));
  table.push_back(number<body, &Body::mark_depth>({"body.mark_depth_mm", "", "0.4", "depth or height of the marks"},
                                                  "mm", 0.05, 5));
  table.push_back(number<body, &Body::min_wall>(
      {"body.min_wall_mm", "", "0", "minimum wall thickness of the part; 0: 1.2 mm, thinner on small pulleys"}, "mm", 0,
      50));
  table.push_back(
      number<body, &Body::room>({"body.room_diameter_mm", "", "0",
                                 "the part must fit into a circle of this diameter about its axis; 0: no limit"},
                                "mm", 0, 10000));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.body.room != 0; };
  table.push_back(number<body, &Body::lead>(
      {"body.lead_mm", "", "0",
       "helical grooves: minimum height from one turn to the next; 0: as groove and rib require"},
      "mm", 0, 50));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.body.lead != 0; };
  table.push_back(number<body, &Body::spare_turns>(
      {"body.spare_turns", "", "1",
       "helical grooves: turns before and after those that the range winds; they relieve the knot"},
      "", 0.25, 5));
  table.back().is_set = [](const DeclaredMechanism& m) { return m.body.spare_turns != 1; };
}

void add_horn(std::vector<Field>& table) {
  constexpr auto horn = &Mechanism::horn;
  constexpr std::string_view k_when = "body.horn=own";
  table.push_back(number<horn, &Horn::bolt_circle>(
      {"horn.bolt_circle_mm", "", "0", "diameter of the circle through the centres of the screws", k_when}, "mm", 0,
      500));
  table.push_back(whole_number<horn, &Horn::bolt_count>(
      {"horn.bolt_count", "", "0", "number of screws, evenly spaced on the bolt circle", k_when}, 0, 24));
  table.push_back(number<horn, &Horn::bolt_hole>(
      {"horn.bolt_hole_mm", "", "0", "diameter of the screws' clearance holes; material.hole_compensation_mm is added",
       k_when},
      "mm", 0, 50));
  table.push_back(number<horn, &Horn::first_bolt, degrees_as_read, radians>(
      {"horn.first_bolt_deg", "", "0", "direction of the first screw at home, from +x towards +y", k_when}, "deg", -360,
      360));
  table.push_back(number<horn, &Horn::centre_hole>(
      {"horn.centre_hole_mm", "", "0",
       "diameter of the hole for the central screw: wide enough for its head and the driver, if it holds the horn",
       k_when},
      "mm", 0, 500));
  table.push_back(number<horn, &Horn::boss_diameter>(
      {"horn.boss_diameter_mm", "", "0", "diameter of the boss on the horn's face, which sinks into the pulley",
       k_when},
      "mm", 0, 500));
  table.push_back(number<horn, &Horn::boss_height>(
      {"horn.boss_height_mm", "", "0", "height of the boss above the face; 0: the horn is flat", k_when}, "mm", 0,
      100));
  table.push_back(whole_number<horn, &Horn::spline_teeth>(
      {"horn.spline_teeth", "", "0",
       "teeth of the servo's output shaft, for a pulley that is pushed onto the shaft instead of a horn", k_when},
      0, 120));
  table.push_back(number<horn, &Horn::spline_diameter>(
      {"horn.spline_diameter_mm", "", "0", "diameter of the servo's shaft over its teeth", k_when}, "mm", 0, 100));
  table.push_back(number<horn, &Horn::spline_depth>(
      {"horn.spline_depth_mm", "", "0", "depth of the teeth of the servo's shaft", k_when}, "mm", 0, 20));
  table.push_back(number<horn, &Horn::spline_length>({"horn.spline_length_mm", "", "0",
                                                      "length of the servo's shaft in the pulley, followed by a "
                                                      "shoulder and horn.centre_hole_mm; 0: the teeth go through",
                                                      k_when},
                                                     "mm", 0, 100));
}

void add_making(std::vector<Field>& table) {
  constexpr auto material = &Mechanism::material;
  constexpr auto cut = &Mechanism::cut;
  table.push_back(
      text<material, &Material::name>({"material.name", "", "\"PLA\"", "material of the part; appears in the report"}));
  table.push_back(number<material, &Material::shrinkage, in_percent, from_percent>(
      {"material.shrinkage_percent", "", "0", "shrinkage of a print; the mesh is enlarged by it"}, "%", -5, 10));
  table.push_back(number<material, &Material::hole_compensation>(
      {"material.hole_compensation_mm", "", "0.2",
       "added to the diameter of holes and the bore, which print too small; for a round bore, printed as a polygon, to "
       "its inscribed circle"},
      "mm", -1, 2));
  table.push_back(number<material, &Material::elephant_foot>(
      {"material.elephant_foot_mm", "", "0.4",
       "chamfer at the edge on the printer's bed, smaller at a thin groove edge; 0: none"},
      "mm", 0, 3));
  constexpr auto print = &Mechanism::print;
  table.push_back(choice<print, &Print::parts>(
      {"print.parts", "", "\"auto\"",
       "one: P1 and P2 in one part, with an overhang support cone under the middle flange where it extends beyond P1; "
       "two: printed separately and pinned together; auto: one, unless that cone would be high"}));
  table.push_back(number<print, &Print::overhang, degrees_as_read, radians>(
      {"print.overhang_deg", "", "45",
       "flattest printable slope of a downward face above the horizontal; 90: vertical"},
      "deg", 20, 75));
  table.push_back(boolean<print, &Print::supports>(
      {"print.supports", "", "false", "true: the printer adds supports, and the part is not shaped to avoid them"}));
  table.push_back(number<print, &Print::nozzle>(
      {"print.nozzle_mm", "", "0.4",
       "diameter of the printer's nozzle, the width of one line: a warning names flanges and walls that are thinner"},
      "mm", 0.05, 5));
  table.push_back(number<cut, &Cut::kerf>({"cut.kerf_mm", "", "0.2", "width of the cut"}, "mm", 0, 10));
  table.push_back(
      number<cut, &Cut::plate>({"cut.plate_mm", "", "3", "thickness of the stacked plates"}, "mm", 0.1, 100));
  table.push_back(number<cut, &Cut::sheet_width>(
      {"cut.sheet_width_mm", "", "300", "width of the sheet that plates are cut from"}, "mm", 10, 10000));
  table.push_back(number<cut, &Cut::sheet_height>(
      {"cut.sheet_height_mm", "", "200", "height of the sheet that plates are cut from"}, "mm", 10, 10000));
  table.push_back(number<cut, &Cut::dowel>(
      {"cut.dowel_mm", "", "3", "diameter of the dowels that align the plates; 0: none"}, "mm", 0, 50));
  table.push_back(transmission_kind_field());
  table.push_back(transmission_ratio_field());
}

void add_optimize(std::vector<Field>& table) {
  constexpr auto optimize = &DeclaredMechanism::optimize;
  table.push_back(texts<optimize, &Optimization::objectives>(
      {"optimize.objective", "", "[\"max_tension\"]",
       "quantities to minimize (min_bend: to maximize); two or three for a front"},
      {"max_tension", "max_error", "footprint", "motor_torque", "min_bend"}));
  table.push_back(
      texts<optimize, &Optimization::variables>({"optimize.variables", "", "[]", "keys of this file to optimize"}));
  table.push_back(numbers<optimize, &Optimization::lower>(
      {"optimize.lower", "", "[]", "lower bound of each variable, in its own unit"}, -1e6, 1e6));
  table.push_back(numbers<optimize, &Optimization::upper>(
      {"optimize.upper", "", "[]", "upper bound of each variable, in its own unit"}, -1e6, 1e6));
  table.push_back(texts<optimize, &Optimization::tied>(
      {"optimize.tied", "", "[]", "keys that depend on others: \"guides.EB_mm = guides.ED_mm\""}));
  table.push_back(texts<optimize, &Optimization::constraints>(
      {"optimize.constraints", "", "[]", "linear conditions on keys: \"guides.EB_mm <= 0.5 * joint.length_mm\""}));
  table.push_back(boolean<optimize, &Optimization::feasible>(
      {"optimize.feasible", "", "false", "only designs for which a pulley can be made"}));
}

/// The row of a parameter that an effect's file declares.
Field identified(const EffectParameter& parameter) {
  const IdentifiedKey& key = parameter.key;
  Field field;
  field.table = "identified";
  field.key = key.name;
  field.fallback = key.fallback;
  field.meaning = key.meaning;
  field.unit = key.unit;
  field.least = key.least;
  field.most = key.most;
  field.get = [parameter](const DeclaredMechanism& mechanism, int) {
    return parameter.key.to_file(value_of(mechanism.identified, parameter));
  };
  field.set = [parameter](DeclaredMechanism& mechanism, int, double value) {
    set_value(mechanism.identified, parameter, parameter.key.from_file(value));
  };
  return field;
}

/// The one row without an effect: the load during the measurement.
Field mean_load() {
  EffectParameter load;
  load.number = [](Imperfections& joint) -> double& { return joint.joint.mean_load; };
  load.key = key::plain("mean_load_N", "N", -1e+06, 1e+06,
                        "tip force beyond load.tip_force_N at which the joint must follow its target motion");
  return identified(load);
}

/// An effect's parameters in the order of their keys: first those that are added to a declared number.
std::vector<EffectParameter> in_file_order(const Effect& effect) {
  std::vector<EffectParameter> parameters = effect.parameters;
  std::stable_partition(parameters.begin(), parameters.end(),
                        [](const EffectParameter& p) { return p.merge_rule != MergeRule::replace; });
  return parameters;
}

/// Effects in the order of their keys: first immediate ones, then those that depend on time or temperature.
std::vector<Effect> in_file_order(std::span<const Effect> all) {
  std::vector<Effect> ordered(all.begin(), all.end());
  std::stable_partition(ordered.begin(), ordered.end(),
                        [](const Effect& effect) { return !effect.needs.time && !effect.needs.temperature; });
  return ordered;
}

/// Rows for the effects of all kinds of joints, so that a file may change its kind and keep its values. Order: along
/// the chain, with those of ratio joints before the joint's sensor.
void add_identified(std::vector<Field>& table) {
  std::vector<Field> rows, of_joint_sensor;
  const auto add = [&](const Effect& effect) {
    for (const EffectParameter& parameter : in_file_order(effect)) {
      const auto same = [&](const Field& field) { return field.key == parameter.key.name; };
      if (std::any_of(rows.begin(), rows.end(), same) ||
          std::any_of(of_joint_sensor.begin(), of_joint_sensor.end(), same))
        continue;
      (effect.place == ChainPlace::joint_sensor ? of_joint_sensor : rows).push_back(identified(parameter));
    }
  };
  for (const Effect& effect : effects(JointKind::tendons)) add(effect);
  rows.push_back(mean_load());
  for (const Effect& effect : in_file_order(effects(JointKind::ratio))) add(effect);
  table.insert(table.end(), rows.begin(), rows.end());
  table.insert(table.end(), of_joint_sensor.begin(), of_joint_sensor.end());
}

void add_prior(std::vector<Field>& table) {
  const auto reading = [&table]<auto Member>(std::string_view name, std::string_view meaning) {
    table.push_back(numbers<&DeclaredMechanism::prior, Member>({name, "", "[]", meaning}, -1e6, 1e6));
  };
  reading.operator()<&Prior::EB>("prior.EB_mm", "guides.EB_mm measured by hand: [value, standard uncertainty]");
  reading.operator()<&Prior::ED>("prior.ED_mm", "guides.ED_mm measured by hand");
  reading.operator()<&Prior::OE>("prior.OE_mm", "guides.OE_mm measured by hand");
  reading.operator()<&Prior::OE1>("prior.OE1_mm", "guides.OE_mm measured by hand, of the left pin only");
  reading.operator()<&Prior::OE2>("prior.OE2_mm", "guides.OE_mm measured by hand, of the right pin only");
  reading.operator()<&Prior::EF>("prior.EF_mm", "pulley.EF_mm measured by hand");
  reading.operator()<&Prior::guide_radius>("prior.guide_radius_mm", "guides.radius_mm measured by hand");
  reading.operator()<&Prior::length>("prior.length_mm", "joint.length_mm measured by hand");
  reading.operator()<&Prior::radius_offset>(
      "prior.radius_offset_mm", "pitch radius of the made pulley minus that of the drawn one, measured by hand");
  reading.operator()<&Prior::pulley_scale>("prior.pulley_scale",
                                           "size of the made pulley / size of the drawn one, measured by hand");
  reading.operator()<&Prior::modulus>("prior.modulus_MPa", "tendon.modulus_MPa measured by hand");
  reading.operator()<&Prior::drum_radius>("prior.drum_radius_mm", "joint.drum_radius_mm measured by hand");
  reading.operator()<&Prior::attachment1_across>("prior.attachment1_across_mm",
                                                 "first number of joint.attachment1_mm, measured by hand");
  reading.operator()<&Prior::attachment1_along>("prior.attachment1_along_mm",
                                                "second number of joint.attachment1_mm, measured by hand");
  reading.operator()<&Prior::attachment2_across>("prior.attachment2_across_mm",
                                                 "first number of joint.attachment2_mm, measured by hand");
  reading.operator()<&Prior::attachment2_along>("prior.attachment2_along_mm",
                                                "second number of joint.attachment2_mm, measured by hand");
  reading.operator()<&Prior::motor_offset_deg>(
      "prior.motor_offset_deg", "angle of the shaft minus the reading of the motor sensor, measured by hand");
  reading.operator()<&Prior::backlash_deg>("prior.backlash_deg",
                                           "play between motor and pulley, of alpha, measured by hand");
  reading.operator()<&Prior::runout_x>("prior.runout_x_mm",
                                       "eccentricity of the pulley at home, to the right, measured by hand");
  reading.operator()<&Prior::runout_y>("prior.runout_y_mm",
                                       "eccentricity of the pulley at home, upwards, measured by hand");
  reading.operator()<&Prior::guide_compliance>(
      "prior.guide_give_mm_per_N", "displacement of a pin per newton of the tendon's force on it, measured by hand");
  reading.operator()<&Prior::zero_deg>("prior.zero_deg", "reading of the joint sensor at theta = 0, measured by hand");
  reading.operator()<&Prior::gain_percent>(
      "prior.gain_percent", "excess of the joint sensor's reading over the whole range, measured by hand");
}

std::vector<Field> make_table() {
  std::vector<Field> table;
  table.push_back(schema_field());
  table.push_back(units_field());
  table.push_back(name_field());
  add_mechanism(table);
  add_body(table);
  add_horn(table);
  add_making(table);
  add_optimize(table);
  add_identified(table);
  add_prior(table);
  return table;
}

/// Sets a field to its default.
void set_fallback(const Field& field, DeclaredMechanism& mechanism) {
  std::string_view text = field.fallback;
  if (field.kind == FieldKind::number) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    demand(error == std::errc() && end == text.data() + text.size(), "default of " + field.name());
    field.set(mechanism, 0, value);
    return;
  }
  if (field.kind == FieldKind::numbers || field.kind == FieldKind::texts) {
    // A default list is empty or holds one text: [] or ["text"].
    if (text.size() > 2) field.texts(mechanism) = {std::string(text.substr(2, text.size() - 4))};
    return;
  }
  if (text.size() >= 2 && text.front() == '"') text = text.substr(1, text.size() - 2);
  field.set_text(mechanism, text);
}

}  // namespace

std::string Field::name() const {
  return table.empty() ? std::string(key) : std::string(table) + "." + std::string(key);
}

std::span<const Field> fields() {
  static const std::vector<Field> table = make_table();
  return table;
}

const FormerKey* find_former_key(std::string_view name) {
  // Earlier files had one key for both pins. Their identified.guide_down_mm moved the pins and the pulley's axis
  // together; it has no successor.
  static constexpr FormerKey k_former = {"identified.guide_outward_mm",
                                         {"identified.guide1_outward_mm", "identified.guide2_outward_mm"}};
  return name == k_former.name ? &k_former : nullptr;
}

const Field* find_field(std::string_view name) {
  for (const Field& field : fields()) {
    if (field.name() == name) return &field;
  }
  return nullptr;
}

double number_of(const Mechanism& mechanism, const Field& field, int end) {
  return field.get(DeclaredMechanism{mechanism}, end);
}

void set_number(Mechanism& mechanism, const Field& field, int end, double value) {
  DeclaredMechanism declared{mechanism};
  field.set(declared, end, value);
  mechanism = declared;
}

std::optional<NumberKey> find_number_key(std::string_view name) {
  int end = 0;
  const bool first = name.ends_with("[0]"), second = name.ends_with("[1]");
  if (first || second) {
    end = second ? 1 : 0;
    name.remove_suffix(3);
  }
  const Field* field = find_field(name);
  if (field == nullptr || field->table.empty()) return std::nullopt;
  const bool is_pair = field->kind == FieldKind::range || field->kind == FieldKind::point;
  if ((first || second) ? !is_pair : field->kind != FieldKind::number) return std::nullopt;
  return NumberKey{field, end};
}

std::vector<std::string> number_key_names() {
  std::vector<std::string> names;
  for (const Field& field : fields()) {
    if (field.kind == FieldKind::number && !field.table.empty()) names.push_back(field.name());
    if (field.kind == FieldKind::range || field.kind == FieldKind::point)
      names.insert(names.end(), {field.name() + "[0]", field.name() + "[1]"});
  }
  return names;
}

std::vector<std::string> field_tables() {
  std::vector<std::string> tables;
  for (const Field& field : fields()) {
    if (tables.empty() || tables.back() != field.table) tables.emplace_back(field.table);
  }
  return tables;
}

std::string_view table_meaning(std::string_view table) {
  if (table == "joint") return "the joint and its range";
  if (table == "guides") return "the two pins that the tendons run over";
  if (table == "sheath") return "optional Bowden sheaths between the pins and the motor";
  if (table == "pulley") return "place and function of the pulley";
  if (table == "tendon") return "both tendons";
  if (table == "load") return "the load on the joint";
  if (table == "spring") return "a spring about the joint's axis";
  if (table == "motor") return "the motor, with which travel, torque and speed are compared";
  if (table == "body") return "the body of the pulley";
  if (table == "horn") return "a servo's horn of your own, or its toothed shaft (body.bore = \"horn\")";
  if (table == "material") return "the material of the part";
  if (table == "print") return "print settings";
  if (table == "cut") return "settings for cutting the part as a stack of plates";
  if (table == "optimize") return "variables and objectives of fusee optimize";
  if (table == "identified") return "deviations from the declared joint that fusee calibrate identified";
  if (table == "prior") return "manual measurements of the joint, each as [value, standard uncertainty]";
  if (table == "transmission")
    return "a joint of another kind, in place of joint, guides and pulley, for calibrate only";
  return "the file";
}

bool is_used(const Field& field, const DeclaredMechanism& mechanism) {
  if (field.only_when.empty()) return true;
  const std::size_t equals = field.only_when.find('=');
  const Field* other = find_field(field.only_when.substr(0, equals));
  demand(other != nullptr, "only_when of " + field.name());
  return is_used(*other, mechanism) && other->get_text(mechanism) == field.only_when.substr(equals + 1);
}

DeclaredMechanism default_mechanism() {
  DeclaredMechanism mechanism;
  for (const Field& field : fields()) {
    if (!field.fallback.empty()) set_fallback(field, mechanism);
  }
  return mechanism;
}

}  // namespace fusee
