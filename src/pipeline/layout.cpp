#include "pipeline/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <iterator>
#include <limits>

#include "base/text.h"
#include "fusee/analysis.h"
#include "fusee/kit.h"
#include "fusee/profile.h"
#include "fusee/solid.h"
#include "fusee/transmission.h"
#include "mechanism/catalogue.h"
#include "pipeline/design.h"
#include "pipeline/multi_turn.h"
#include "pipeline/shaft_reach.h"
#include "solid/plan.h"
#include "transmission/load.h"

namespace fusee::pipeline {
namespace {

// Beyond this joint angle a lever point between two pins meets a dead centre or a pin for nearly all proportions.
constexpr double k_lever_reach = radians(40.0);
// Rotation that leaves room for both knots on a pulley of one turn.
constexpr double k_one_turn = radians(280.0);
// Least radius of a pulley's groove floor, mm.
constexpr double k_least_floor = 1.0;
// Arc of a tendon that stays on the drum at the end of the range.
constexpr double k_least_wrap = radians(8.0);
// A guide thicker than a rod of 12 mm, or with a tension that wears a sliding tendon, is an idler on ball bearings.
// They are of type 623: 10 mm outside diameter, balls on a pitch radius of 3.3 mm. On links that are shorter than
// k_least_length_with_idlers, wear alone requires no idler.
constexpr double k_thickest_pin = 6.0;               // radius, mm
constexpr double k_tension_on_pin = 100.0;           // N
constexpr double k_least_idler = 8.0;                // radius, mm
constexpr double k_least_length_with_idlers = 60.0;  // of the link, mm
// Largest pitch radius of a drum that is chosen for the strength of the knots, over the link length. If the load
// requires a larger drum, the build warns that the tendon breaks.
constexpr double k_widest_drum = 0.5;
// Limit for a drum that is wider only because features of the pulley require space.
constexpr double k_widest_drum_for_features = 0.45;
// Links up to this length get a lever, mm: the proportions of a longer one exceed the bounds of the keys.
constexpr double k_longest_lever = 5000.0;
// Motor torque with friction in pulley, guides and joint over that without.
constexpr double k_friction = 1.15;
constexpr double k_much_friction = 1.4;  // over pins, with the pretension that keeps both tendons taut
// Torque of a motor without its advised margin, with a pretension that keeps both tendons taut over that without.
constexpr double k_most_for_pretension = 1.25;
// Least safety factor of tendons with the pretension that keeps both taut.
constexpr double k_least_safety = 2.0;
// Full builds of candidates for one search.
constexpr int k_max_layout_builds = 8;
// Full builds if the first layout that builds suffices.
constexpr int k_max_trial_builds = 3;

/// The value as it is written to the file, with three digits.
double in_three_digits(double value) { return number_of(rounded(value, 3)); }

/// The largest torque of the declared load about the joint, N·mm.
double torque_of(const Mechanism& mechanism) {
  const Load& load = mechanism.load;
  return std::abs(load.tip_force) * mechanism.joint.R + std::abs(load.torque) + transmission::weight_moment(load);
}

/// Sets a drum, its guides and both tendon ends so that the tendons stay on the drum over the whole range. `rho`: pitch
/// radius of the drum; `reach`: largest pitch radius of the pulley, both mm.
void put_drum(Mechanism& mechanism, double rho, double reach) {
  const double d = mechanism.tendon.diameter, guide = mechanism.guide_pitch_radius();
  Joint& joint = mechanism.joint;
  joint.drum_radius = in_three_digits(rho - 0.5 * d);
  rho = mechanism.drum_pitch_radius();
  Guides& guides = mechanism.guides;
  guides.OE = in_three_digits(rho + guide + 2.0 * std::max(mechanism.guides.radius, d));
  // Outside both the drum and the pulley, so that each tendon bends round its guide.
  guides.EB = guides.ED = in_three_digits(std::max(std::max(rho, reach) - guide + 0.18 * guides.OE, 0.5 * guide));
  const double flange = reach - 0.5 * d + mechanism.groove_depth();
  const double clearance = std::max(3.0, 0.4 * flange);  // between guides and flange, mm
  mechanism.pulley.EF = in_three_digits(guides.radius + flange + clearance);
  const Vec2 pin(guides.ED, -guides.OE);
  // Angle at which tendon 2 leaves the drum at home: the common tangent of drum and guide.
  const double normal = elementary::atan2(pin.y(), pin.x()) + elementary::acos((rho - guide) / pin.norm());
  // Ends between the drum's surface and its pitch circle are moved onto the pitch circle when the file is read.
  const double end_radius = rho - 0.25 * d;
  const auto end_at = [end_radius](double angle) {
    return Attachment{number_of(fixed(end_radius * elementary::cos(angle), 3)),
                      number_of(fixed(end_radius * elementary::sin(angle), 3))};
  };
  joint.attachment1 = end_at(k_pi - normal - k_least_wrap + joint.theta_min);
  joint.attachment2 = end_at(normal + k_least_wrap + joint.theta_max);
}

/// True if a pitch radius leaves a drum below a tendon of this diameter, in mm.
bool is_drum(double rho, double tendon) { return rho > 0.6 * tendon; }

/// Largest pitch radius of a drum that, with its tendon, is no wider than a room, in mm. Its drum radius has three
/// digits, as in the file.
double widest_drum(double room, double tendon) {
  const double radius = 0.5 * room - tendon;
  if (!(radius > 0)) return 0;
  const double step = elementary::pow(10.0, std::floor(elementary::log10(radius)) - 2);
  return in_three_digits(std::floor(radius / step + 1e-9) * step) + 0.5 * tendon;
}

/// Sets guides and pulley to the proportions of the paper's optimum at this link length. `r1`: mm.
void put_lever(Mechanism& mechanism, double r1) {
  const double R = mechanism.joint.R;
  mechanism.guides.EB = mechanism.guides.ED = in_three_digits(0.5 * R);
  mechanism.guides.OE = in_three_digits(-0.4 * R);
  mechanism.pulley.EF = in_three_digits(1.2 * R);
  mechanism.pulley.r1 = in_three_digits(r1);
}

struct Candidate {
  DeclaredMechanism mechanism;
  std::string words;
  bool is_spare = false;  ///< used only if no other candidate builds: the motor needs more torque than the joint
  double torque = 0;      ///< estimate of the motor's, N·mm
};

/// The file's motor, or the strongest in the catalogue that fits. Its torque is 0 if neither is known.
MotorModel motor_for(const Mechanism& mechanism) {
  MotorModel motor = motor_limits(mechanism.motor);
  if (motor.stall_torque == 0)
    if (const MotorModel* strongest = strongest_motor_that_fits(mechanism.body)) motor = *strongest;
  return motor;
}

/// The torque that the motor should be asked for, N·mm: its own over the advised margin. 0: unknown.
double usable_torque(const Mechanism& mechanism) {
  const MotorModel motor = motor_for(mechanism);
  return motor.stall_torque / motor.advised_margin();
}

/// The candidates for one set of requirements, in order of preference.
class Candidates {
 public:
  explicit Candidates(const LayoutRequirements& requirements)
      : requirements_(requirements), joint_(requirements.joint) {
    const double d = joint_.tendon.diameter;
    span_ = joint_.joint.theta_max - joint_.joint.theta_min;
    bend_ = 0.5 * joint_.tendon.bend_ratio * d;
    largest_ = 0.5 * requirements_.room - joint_.groove_depth() + 0.5 * d;
    turn_ = requirements_.travel > 0 ? std::min(k_one_turn, 0.95 * requirements_.travel) : k_one_turn;
    const auto strength = analysis::likely_strength(joint_.tendon);
    // Twice the load, since knots and friction are known to a factor only.
    strong_ = strength ? std::min(2.0 * torque_of(joint_) / strength->at_knot, k_widest_drum * joint_.joint.R) : 0;
    widest_ = widest_drum(requirements_.room, d);
    usable_ = usable_torque(joint_);
    joint_.pulley.law = Law::compensate;
    joint_.joint.drum_radius = 0;
    joint_.joint.attachment1 = joint_.joint.attachment2 = std::nullopt;
  }

  std::vector<Candidate> all() {
    if (!(largest_ > 0)) return {};
    if (!is_drum(widest_, joint_.tendon.diameter)) {
      add_lever();
      return std::move(all_);
    }
    // Pitch radii of a drum, mm: the least, the usual one, and the largest with which one turn of the pulley suffices.
    const double least = std::max({bend_, strong_, 1.5 + joint_.tendon.diameter});
    const double usual = std::min(std::max(0.15 * joint_.joint.R, least), widest_);
    const double fitting = std::min(largest_ * turn_ / span_, widest_);
    add_lever();
    if (usual <= fitting) add_drum(usual);
    if (fitting >= least) add_drum(std::min(usual, fitting));
    add_wider_drums(std::min(usual, fitting));
    if (requirements_.travel == 0) add_turns(usual);
    // Last, a drum beyond a limit of bends or strength: its build has warnings.
    add_drum(std::min(fitting, usual));
    prefer_motor(usual);
    return std::move(all_);
  }

 private:
  void add_lever() {
    const Joint& joint = joint_.joint;
    if (-joint.theta_min > k_lever_reach || joint.theta_max > k_lever_reach || joint.R > k_longest_lever) return;
    // α is about θ times the tendon's arm, some 0.6 R, over r1.
    const double r1 = std::max({0.18 * joint.R, 0.6 * joint.R * span_ / turn_, bend_});
    for (const double larger : {1.0, 1.25, 1.5}) {
      if (larger * r1 > largest_) return;
      Candidate candidate = with_guides(0.6 * joint.R, "a lever");
      put_lever(candidate.mechanism, larger * r1);
      candidate.torque = k_friction * torque_of(joint_) * larger * r1 / (0.6 * joint.R);
      all_.push_back(std::move(candidate));
    }
  }

  /// Drums of one pitch radius with pulleys of one turn, the smallest pulley first.
  void add_drum(double rho) {
    double r1 = std::max({rho * span_ / turn_, bend_, 0.5 * joint_.tendon.diameter + k_least_floor});
    for (; r1 < largest_; r1 *= 1.3) add_drum_with(rho, r1, "a drum on the joint");
    add_drum_with(rho, largest_, "a drum on the joint");
  }

  /// A drum and a pulley that both grow, for features that have no space on a smaller pulley. The pulley is no wider
  /// than the drum: the motor needs no more torque than the joint.
  void add_wider_drums(double rho) {
    const double widest = std::min({k_widest_drum_for_features * joint_.joint.R, largest_, widest_});
    for (double wider = rho; wider < widest;) {
      wider = std::min(1.35 * wider, widest);
      for (const double share : {0.8, 1.0}) add_drum_with(wider, share * wider, "a drum on the joint");
    }
  }

  /// A small pulley that turns more than once.
  void add_turns(double rho) {
    for (const double share : {0.6, 0.75, 0.9, 1.0}) {
      if (share * largest_ < bend_) continue;
      add_drum_with(rho, share * largest_, "a drum on the joint, several turns of the pulley");
    }
  }

  /// If a candidate requires too much of the motor, adds wider drums and smaller pulleys that do not, with several turns
  /// if one is not enough, and the smallest pulleys of one turn. Candidates within the motor's torque come first, then
  /// those that require least.
  void prefer_motor(double rho) {
    const auto is_within = [this](const Candidate& candidate) { return candidate.torque <= usable_; };
    if (usable_ == 0 || std::all_of(all_.begin(), all_.end(), is_within)) return;
    constexpr double k_three_digits = 1.01;  // the radius is rounded
    const double widest = std::min(k_widest_drum_for_features * joint_.joint.R, widest_);
    for (double wider = std::min(rho, widest); wider > 0; wider = std::min(1.35 * wider, widest)) {
      for (const double friction : {k_friction, k_much_friction}) {
        const double reduction = k_three_digits * friction * torque_of(joint_) / usable_;
        const double r1 = std::min(std::floor(1e3 * wider / reduction) / 1e3, largest_);
        const double turn = span_ * wider / r1;
        if (!(requirements_.travel > 0 && turn > 0.95 * requirements_.travel)) add_small_pulley(wider, r1);
      }
      if (wider == widest) break;
    }
    // Between a pulley of one turn and one that the motor turns with its margin.
    for (const double share : {1.0, 0.85, 0.7, 0.55}) {
      const double r1 = std::ceil(1e3 * share * span_ * widest / turn_) / 1e3;
      if (share == 1.0 || requirements_.travel == 0) add_small_pulley(widest, r1);
    }
    const auto others = std::stable_partition(all_.begin(), all_.end(), is_within);
    std::stable_sort(others, all_.end(),
                     [](const Candidate& one, const Candidate& other) { return one.torque < other.torque; });
  }

  void add_small_pulley(double rho, double r1) {
    if (r1 < std::max(bend_, 0.5 * joint_.tendon.diameter + k_least_floor) || r1 > largest_) return;
    const bool is_one_turn = span_ * rho / r1 <= k_one_turn;
    add_drum_with(rho, r1, is_one_turn ? "a drum on the joint" : "a drum on the joint, several turns of the pulley");
  }

  void add_drum_with(double rho, double r1, const char* words) {
    if (!is_drum(rho, joint_.tendon.diameter)) return;
    Candidate candidate = with_guides(rho, words);
    candidate.mechanism.pulley.r1 = std::min(in_three_digits(r1), std::floor(1e3 * largest_) / 1e3);
    candidate.torque = k_friction * torque_of(joint_) * candidate.mechanism.pulley.r1 / rho;
    put_drum(candidate.mechanism, rho, candidate.mechanism.pulley.r1);
    candidate.is_spare = candidate.mechanism.pulley.r1 > rho;
    const auto is_same = [&candidate](const Candidate& other) {
      return other.words == candidate.words && other.mechanism.pulley.r1 == candidate.mechanism.pulley.r1 &&
             other.mechanism.joint.drum_radius == candidate.mechanism.joint.drum_radius;
    };
    if (std::none_of(all_.begin(), all_.end(), is_same)) all_.push_back(std::move(candidate));
  }

  /// Pins, or idlers where a pin would be too thick or would wear the tendon.
  Candidate with_guides(double arm, const std::string& layout) const {
    Candidate candidate{joint_, layout};
    Guides& guides = candidate.mechanism.guides;
    const double thick = bend_ - 0.5 * joint_.tendon.diameter;
    guides.radius = std::max(thick, std::clamp(0.03 * joint_.joint.R, 1.0, 5.0));
    const bool wears = torque_of(joint_) / arm > k_tension_on_pin && joint_.joint.R >= k_least_length_with_idlers;
    guides.kind = guides.radius > k_thickest_pin || wears ? GuideKind::idler : GuideKind::pin;
    if (guides.kind == GuideKind::idler) {
      guides.radius = std::max(guides.radius, k_least_idler);
      guides.bearing_radius = 3.3;  // of type 623, mm
      guides.bearing_friction = 0.003;
    }
    guides.radius = in_three_digits(guides.radius);
    if (guides.kind == GuideKind::pin) guides.radius = 0.5 * kit::stock_rod(2.0 * guides.radius, joint_.units);
    candidate.words += guides.kind == GuideKind::idler ? ", tendons over idlers" : ", tendons over pins";
    return candidate;
  }

  const LayoutRequirements& requirements_;
  DeclaredMechanism joint_;  ///< without a layout
  double span_ = 0;          ///< range of θ, rad
  double bend_ = 0;          ///< least pitch radius around which the tendon may be bent, mm
  double largest_ = 0;       ///< largest pitch radius of a pulley within the room, mm
  double widest_ = 0;        ///< largest pitch radius of a drum that is no wider than the room, mm
  double turn_ = 0;          ///< largest rotation of a pulley of one turn, rad
  double usable_ = 0;        ///< torque of the motor, N·mm; 0: unknown
  double strong_ = 0;        ///< least moment arm at which the knots hold twice the load, mm
  std::vector<Candidate> all_;
};

/// The reason why a pulley is infeasible, by a quick check without a mesh; empty if none was found.
std::optional<std::string> quick_obstacle(const DeclaredMechanism& declared) {
  const Curves curves = curves_of(declared);
  const Mechanism& mechanism = curves.joint.mechanism;
  if (!curves.obstacles.empty()) {
    const bool several_turns_may_help =
        std::all_of(curves.obstacles.begin(), curves.obstacles.end(), profile::is_of_one_turn);
    if (!several_turns_may_help || profile::kept_to_one_turn(mechanism)) return curves.obstacles.front().message;
    return obstacle_to_multi_turn(mechanism);
  }
  const std::vector<profile::Condition> of_body = solid::body_obstacles(mechanism, curves.synthesis);
  return of_body.empty() ? std::nullopt : std::optional(of_body.front().message);
}

/// A copy with the radius of P1 rounded down to 0.01 mm.
DeclaredMechanism with_rounded_radius(DeclaredMechanism mechanism) {
  mechanism.pulley.r1 = std::floor(100.0 * mechanism.pulley.r1) / 100.0;
  return mechanism;
}

/// Sum of weighted shortcomings: the set screw holds the pulley, the channels hold the tendons, the home mark aligns
/// it.
std::size_t shortcomings(const solid::BodyLayout& layout) {
  std::size_t weight = layout.notes.size();
  for (const solid::Omission& omission : layout.omissions) {
    if (omission.feature == "set_screw") weight += 4;
    if (omission.feature == "home_mark" || omission.feature.starts_with("channel_")) weight += 2;
  }
  return weight;
}

/// True if nothing holds the pulley on its shaft although the file does not renounce a set screw.
bool is_loose(const Mechanism& mechanism, const solid::BodyLayout& layout) {
  const Body& body = mechanism.body;
  return body.bore != Bore::horn && body.set_screw != "none" && body.hub_height > 0 && !layout.set_screw.present;
}

/// True if the motor's shaft does not reach the set screw.
bool is_beyond_shaft(const Mechanism& mechanism, const solid::BodyLayout& layout) {
  const std::optional<ShaftReach> reach = shaft_reach(mechanism, layout);
  return reach && !reach->suffices();
}

/// 0: a set screw or a horn holds the pulley, or the file wants none. 1: the shaft is too short for the set screw; another
/// motor or a coupling helps. 2: nothing holds it.
std::size_t looseness(const Mechanism& mechanism, const solid::BodyLayout& layout) {
  if (is_loose(mechanism, layout)) return 2;
  return is_beyond_shaft(mechanism, layout) ? 1 : 0;
}

/// Fewer are better, in this order.
struct Rank {
  std::size_t stalls = 0;        ///< 1: the motor cannot hold the load
  std::size_t warnings = 0;      ///< of the build, without those on the motor and its shaft
  std::size_t loose = 0;         ///< looseness()
  std::size_t weakness = 0;      ///< missing share of the motor's advised margin, in quarters
  std::size_t shortcomings = 0;  ///< of a pulley of one turn; several turns always have the same notes

  auto operator<=>(const Rank&) const = default;
  bool is_without_fault() const { return *this <= Rank{0, 0, 0, 0, shortcomings}; }
};

/// The motor's stall torque over `torque` (N·mm), which it has to hold; 0: unknown.
double motor_margin(const Mechanism& mechanism, double torque) {
  return torque > 0 ? motor_for(mechanism).stall_torque / torque : 0;
}

void rank_motor(Rank& rank, const Mechanism& mechanism, double torque) {
  const double margin = motor_margin(mechanism, torque);
  if (margin == 0) return;
  rank.stalls = margin < 1 ? 1 : 0;
  const double missing = motor_for(mechanism).advised_margin() / margin - 1;
  rank.weakness = static_cast<std::size_t>(std::ceil(std::clamp(missing, 0.0, 1e3) / 0.25));
}

/// Rank of a plan without a mesh, with an estimate of the motor's torque in N·mm. A pulley of several turns has no such
/// plan: it is assumed to have no shortcoming.
Rank planned_rank(const DeclaredMechanism& declared, double torque) {
  Rank rank;
  rank_motor(rank, declared, torque);
  const Curves curves = curves_of(declared);
  if (!curves.obstacles.empty()) return rank;
  const solid::BodyPlan plan = solid::plan_body(curves.joint.mechanism, curves.synthesis);
  if (!plan.is_possible()) return rank;
  rank.loose = looseness(declared, plan.layout);
  rank.shortcomings = shortcomings(plan.layout);
  return rank;
}

Rank rank_of(const formats::Product& product) {
  Rank rank;
  rank_motor(rank, product.joint.mechanism, product.under_load.largest_torque.value);
  const std::vector<Diagnostic> of_motor = product.under_load.motor
                                               ? analysis::motor_warnings(*product.under_load.motor, product.file)
                                               : std::vector<Diagnostic>{};
  rank.warnings = product.file.warnings.size() + product.synthesis.warnings.size() + product.holding.warnings.size();
  const bool misses_shaft = is_beyond_shaft(product.joint.mechanism, product.pulley.layout);
  rank.warnings -= std::min(rank.warnings, of_motor.size() + (misses_shaft ? 1 : 0));
  rank.loose = looseness(product.file.mechanism, product.pulley.layout);
  rank.shortcomings = product.helix ? 0 : shortcomings(product.pulley.layout);
  return rank;
}

/// Declares the smallest set screw, in a thread of the hub. The hub that a declared screw requires has precedence over
/// marks and slots. Empty if the file names a set screw or must not have one, or if that hub does not fit.
std::optional<DeclaredMechanism> with_small_screw(const DeclaredMechanism& declared) {
  if (declared.body.set_screw != "auto" || declared.body.hub_diameter > 0) return std::nullopt;
  DeclaredMechanism changed = declared;
  changed.body.set_screw = declared.units == LengthUnit::inch ? "#2-56" : "M2";
  changed.body.nut_trap = false;
  return quick_obstacle(changed) ? std::nullopt : std::optional(changed);
}

/// A variant that holds the pulley better on its shaft, with a lower hub, the smallest set screw, or both. Empty if the
/// plan is held already, or if there is none.
std::optional<DeclaredMechanism> held_variant(const DeclaredMechanism& declared, const Rank& planned) {
  if (planned.loose == 0) return std::nullopt;
  if (auto lower = with_lower_hub(declared)) return lower;
  const std::optional<DeclaredMechanism> small = with_small_screw(declared);
  if (!small) return std::nullopt;
  const std::size_t loose = planned_rank(*small, 0).loose;
  if (loose == 0) return small;
  if (auto lower = with_lower_hub(*small)) return lower;
  return loose < planned.loose ? small : std::nullopt;
}

/// The tendons' moment arm at home, mm.
double arm_of(const ChosenLayout& layout) {
  const Mechanism& mechanism = layout.file.mechanism;
  return mechanism.joint.drum_radius > 0 ? mechanism.drum_pitch_radius() : layout.built.product.synthesis.home()->t1.m;
}

/// Why a layout does not meet the requirements.
struct Obstacle {
  std::string message;
  double torque = 0;  ///< if the motor's torque is the reason: the required one, N·mm
};

/// The first failed condition or check of a build.
Obstacle first_reason(const BuildResult& built) {
  const formats::Product& product = built.product;
  const auto& conditions = product.synthesis.made() ? product.pulley.conditions : product.synthesis.conditions;
  for (const profile::Condition& condition : conditions)
    if (!condition.ok) return {condition.message, condition.name == "motor_torque" ? condition.value : 0};
  for (const Check& check : product.checks)
    if (!check.ok) return {"the check " + check.name + " of the part fails"};
  return {"no pulley can be made"};
}

/// The obstacle to report: the last one, or the least torque that a motor would need.
class Obstacles {
 public:
  void add(Obstacle obstacle) {
    if (obstacle.torque > 0) ++by_torque_;
    if (last_.torque > 0 && !(obstacle.torque > 0 && obstacle.torque < last_.torque)) return;
    last_ = std::move(obstacle);
  }
  std::string message() const {
    if (last_.torque == 0 || by_torque_ < 2) return last_.message;
    return last_.message + fmt::format(", the least of the {} layouts that were built", by_torque_);
  }

 private:
  Obstacle last_;
  int by_torque_ = 0;
};

/// Fills `layout` by a dry build of its file. Returns the reason why it does not meet the requirements; empty if it
/// does.
std::optional<Obstacle> build_layout(const LayoutRequirements& needs, ChosenLayout& layout, const RunContext& context) {
  BuildOptions options;
  options.dry_run = options.force = true;
  options.advice = false;
  options.folder = temporary_folder() / "fusee-layout";
  layout.built = build(layout.file, options, context.without_progress());
  if (layout.built.status != BuildStatus::done) return first_reason(layout.built);
  const formats::Product& product = layout.built.product;
  if (const std::optional<double>& lost_at = product.under_load.lost_at)
    return Obstacle{
        fmt::format("the load pulls the joint past its dead centre at alpha = {} deg: there is no equilibrium",
                    fixed(degrees(*lost_at), 1))};
  layout.diameter = solid::diameter_about_axis(product.pulley.mesh);
  layout.travel = product.synthesis.stroke.back().alpha - product.synthesis.stroke.front().alpha;
  if (layout.diameter > needs.room + 1e-6)
    return Obstacle{fmt::format("the pulley is {} mm wide", rounded(layout.diameter, 3))};
  if (needs.travel > 0 && layout.travel > needs.travel + 1e-9)
    return Obstacle{fmt::format("the pulley would turn {}°, the motor turns {}°", rounded(degrees(layout.travel), 3),
                                rounded(degrees(needs.travel), 3))};
  return std::nullopt;
}

/// Rounded up to two digits.
double rounded_up(double value) {
  const double step = elementary::pow(10.0, std::floor(elementary::log10(value)) - 1);
  return number_of(rounded(std::ceil(value / step - 1e-9) * step, 2));
}

/// Gives a layout with a slack tendon the least pretension that keeps both taut, or explains why not.
void keep_taut(ChosenLayout& chosen, const LayoutRequirements& needs, const CandidateFile& file_of,
               const RunContext& context) {
  const std::optional<double> least = chosen.built.product.under_load.taut_pretension;
  if (!least) return;
  DeclaredMechanism mechanism = chosen.file.mechanism;
  mechanism.tendon.pretension = rounded_up(*least);
  ChosenLayout taut = chosen;
  taut.file = file_of(mechanism);
  if (taut.file.mechanism.tendon.pretension != mechanism.tendon.pretension) return;  // a setting overrides it
  const std::optional<Obstacle> obstacle = build_layout(needs, taut, context);
  const analysis::UnderLoad& load = taut.built.product.under_load;
  const std::string words = rounded(*least, 3) + " N or more keeps both tendons taut under the load";
  std::string against;
  const double torque = load.largest_torque.value, torque_before = chosen.built.product.under_load.largest_torque.value;
  Rank rank = rank_of(taut.built.product), rank_before = rank_of(chosen.built.product);
  const bool is_too_much =
      rank.weakness > 0 && (rank.stalls > rank_before.stalls || torque > k_most_for_pretension * torque_before);
  rank.weakness = rank_before.weakness = 0;  // is_too_much limits the motor's torque
  if (obstacle)
    against = obstacle->message;
  else if (load.safety_factor().value_or(k_least_safety) < k_least_safety)
    against = "the tendons' safety factor would be " + rounded(*load.safety_factor(), 3);
  else if (is_too_much)
    against = "the motor would have to hold " + rounded(torque, 3) + " Nmm";
  else if (rank > rank_before)
    against = taut.built.product.file.warnings.size() > chosen.built.product.file.warnings.size()
                  ? taut.built.product.file.warnings.back().message
                  : "the pulley would lack more features";
  if (!against.empty()) {
    chosen.pretension_words = "a pretension of " + words + ", but " + against;
    return;
  }
  chosen = std::move(taut);
  chosen.pretension_words = words;
}

/// Writes the room as a key of the file, so that later changes keep it.
void keep_room(ChosenLayout& chosen, const LayoutRequirements& needs, const CandidateFile& file_of) {
  DeclaredMechanism mechanism = chosen.file.mechanism;
  if (mechanism.body.room > 0) return;  // a setting already gives it
  mechanism.body.room = needs.room;
  MechanismFile file = file_of(mechanism);
  if (!quick_obstacle(file.mechanism)) chosen.file = std::move(file);
}

}  // namespace

namespace {

/// One search for a layout.
class LayoutChoice {
 public:
  LayoutChoice(const LayoutRequirements& requirements, const CandidateFile& file_of, const RunContext& context)
      : requirements_(requirements), file_of_(file_of), context_(context) {}

  LayoutSearch search() {
    LayoutSearch search;
    for (const Candidate& candidate : Candidates(requirements_).all()) {
      if (chosen_ && (requirements_.any || candidate.is_spare)) continue;
      // Without a fault, only a larger pulley of the same layout can be better: it may have more features.
      if (chosen_ && best_.is_without_fault() && (best_.shortcomings == 0 || candidate.words != chosen_->words)) break;
      if (!add(candidate)) break;
    }
    if (chosen_ && !requirements_.any) {
      add_price();
      context_.begin_step("keeping both tendons taut");
      keep_taut(*chosen_, requirements_, file_of_, context_);
      keep_room(*chosen_, requirements_, file_of_);
    }
    search.chosen = std::move(chosen_);
    search.obstacle = obstacles_.message();
    if (search.obstacle.empty()) search.obstacle = "the room is smaller than the tendon's groove";
    return search;
  }

 private:
  /// Builds a candidate if it may be better than the best one so far. False if no further build is allowed.
  bool add(const Candidate& candidate) {
    context_.begin_step("trying " + candidate.words);
    const MechanismFile file = file_of_(candidate.mechanism);
    if (std::optional<std::string> obstacle = quick_obstacle(file.mechanism)) {
      if (builds_ == 0) obstacles_.add({std::move(*obstacle)});  // the last one remains: it has the most space
      return true;
    }
    if (requirements_.any) return try_build(candidate.mechanism, candidate, /*is_last=*/true);
    const Rank planned = planned_rank(file.mechanism, candidate.torque);
    if (const auto held = held_variant(file.mechanism, planned)) {
      Candidate screwed = candidate;
      screwed.mechanism.body.set_screw = held->body.set_screw;
      screwed.mechanism.body.nut_trap = held->body.nut_trap;
      screwed.mechanism.body.hub_height = held->body.hub_height;
      if (may_be_better(screwed, planned_rank(file_of_(screwed.mechanism).mechanism, candidate.torque))) {
        if (!try_build(screwed.mechanism, screwed, /*is_last=*/false)) return false;
        if (chosen_ && best_.loose == 0) return true;
      }
    }
    return !may_be_better(candidate, planned) || try_build(candidate.mechanism, candidate, /*is_last=*/true);
  }

  bool may_be_better(const Candidate& candidate, Rank planned) const {
    if (!chosen_ || best_.warnings > 0) return true;
    // Several turns are not planned. A pulley that is no larger than a loose one is at least as loose.
    for (std::size_t loose = 1; loose < largest_loose_.size(); ++loose)
      if (candidate.mechanism.pulley.r1 <= largest_loose_[loose]) planned.loose = loose;
    return planned < best_;
  }

  /// Builds a candidate. `is_last`: no other variant of it follows, so that its obstacle is reported. False if no
  /// further build is allowed.
  bool try_build(DeclaredMechanism mechanism, const Candidate& candidate, bool is_last) {
    if (builds_++ == (requirements_.any ? k_max_trial_builds : k_max_layout_builds)) return false;
    ChosenLayout layout;
    layout.file = file_of_(mechanism);
    layout.words = candidate.words;
    std::optional<Obstacle> obstacle = build_layout(requirements_, layout, context_);
    // Excess radius, with a reserve for rounding. A pulley that is larger by far is not worth a second build.
    const double excess = 0.5 * (layout.diameter - requirements_.room) + 0.02;
    if (obstacle && layout.diameter > requirements_.room && excess < 0.3 * mechanism.pulley.r1) {
      // The flange also covers the tie-offs. Only the build has determined by how much it exceeds the groove.
      mechanism.pulley.r1 -= excess;
      layout.file = file_of_(with_rounded_radius(mechanism));
      if (!quick_obstacle(layout.file.mechanism)) obstacle = build_layout(requirements_, layout, context_);
    }
    if (obstacle) {
      if (is_last) obstacles_.add(std::move(*obstacle));
      return true;
    }
    const formats::Product& product = layout.built.product;
    const Rank rank = rank_of(product);
    if (product.helix)
      largest_loose_[rank.loose] = std::max(largest_loose_[rank.loose], layout.file.mechanism.pulley.r1);
    const double torque = product.under_load.largest_torque.value;
    const bool has_no_screw = is_loose(product.file.mechanism, product.pulley.layout);
    if (has_no_screw && torque > 0) least_loose_torque_ = std::min(least_loose_torque_, torque);
    if (chosen_ && !(rank < best_)) return true;
    best_ = rank;
    layout.stalls = rank.stalls > 0;
    layout.tension = torque_of(layout.file.mechanism) / arm_of(layout);
    // A pulley that was meant to turn more than once may do with one turn.
    constexpr std::string_view k_turns = ", several turns of the pulley";
    const std::size_t at = layout.words.find(k_turns);
    if (!product.helix && at != std::string::npos) layout.words.erase(at, k_turns.size());
    chosen_ = std::move(layout);
    return true;
  }

  /// States what a pulley that is held on its shaft costs, or that none was found.
  void add_price() {
    const double share = least_loose_torque_ / chosen_->built.product.under_load.largest_torque.value;
    // A screw that the shaft does not reach is a warning of the build.
    chosen_->is_held = best_.loose < 2;
    if (!chosen_->is_held) {
      chosen_->price_words =
          "nothing holds the pulley on its shaft, as there is no space for a hub with a set screw: glue it, or take a "
          "thinner shaft or a servo with a horn";
    } else if (best_.weakness > 0 && share < 0.95) {
      chosen_->price_words =
          fmt::format("the set screw costs torque: a smaller pulley without one would require {} % less of the motor",
                      rounded(100.0 * (1.0 - share), 2));
    }
  }

  const LayoutRequirements& requirements_;
  const CandidateFile& file_of_;
  const RunContext& context_;
  std::optional<ChosenLayout> chosen_;
  Rank best_;            ///< of the choice
  Obstacles obstacles_;  ///< of candidates that fail
  int builds_ = 0;
  /// r1 of the largest pulley of several turns by its looseness(), mm.
  std::array<double, 3> largest_loose_{};
  /// Least torque of the motor with a pulley that nothing holds on its shaft, N·mm.
  double least_loose_torque_ = std::numeric_limits<double>::infinity();
};

}  // namespace

LayoutSearch choose_layout(const LayoutRequirements& requirements, const CandidateFile& file_of,
                           const RunContext& context) {
  return LayoutChoice(requirements, file_of, context).search();
}

namespace {

/// True for a lever whose tendon loses its moment arm or its pin within the range, but not within a tenth of the range.
bool is_range_the_obstacle(const Mechanism& mechanism) {
  if (mechanism.transmission || !mechanism.joint.is_plain() || mechanism.sheath.is_there()) return false;
  const std::optional<profile::Condition> obstacle = profile::obstacle_but_one_turn(mechanism);
  if (!obstacle || !(obstacle->name == "moment_arms" || obstacle->name.starts_with("tendon_on_pin"))) return false;
  Mechanism narrow = mechanism;
  narrow.joint.theta_min *= 0.1;
  narrow.joint.theta_max *= 0.1;
  return !profile::obstacle_but_one_turn(narrow);
}

/// Keys of the layout whose values differ, with the new values.
std::vector<std::pair<std::string, std::string>> settings_of(const DeclaredMechanism& changed,
                                                             const DeclaredMechanism& before) {
  std::vector<std::pair<std::string, std::string>> settings;
  for (const char* key : {"joint.drum_radius_mm", "joint.attachment1_mm", "joint.attachment2_mm", "guides.EB_mm",
                          "guides.ED_mm", "guides.OE_mm", "pulley.EF_mm", "pulley.r1_mm"}) {
    const Field& field = *find_field(key);
    if (!is_used(field, changed)) continue;
    const auto text = [&field](const DeclaredMechanism& mechanism) -> std::string {
      if (field.is_set != nullptr && !field.is_set(mechanism)) return {};
      return field.kind == FieldKind::point
                 ? "[" + number_text(field, mechanism, 0) + ", " + number_text(field, mechanism, 1) + "]"
                 : number_text(field, mechanism, 0);
    };
    if (text(changed) != text(before)) settings.emplace_back(key, text(changed));
  }
  return settings;
}

/// Mean dα/dθ of a law that prescribes α; 0 if it has none.
double mean_ratio(const Mechanism& mechanism) {
  if (mechanism.pulley.law == Law::linear) return std::abs(mechanism.pulley.ratio);
  const std::vector<LawRow>& rows = mechanism.pulley.rows;
  if (rows.empty() || !(rows.back().theta > rows.front().theta)) return 0;
  return (rows.back().alpha - rows.front().alpha) / (rows.back().theta - rows.front().theta);
}

/// A drum for a file, with the largest error of the joint angle under the declared load.
struct Drum {
  DeclaredMechanism mechanism;
  bool stalls = false;  ///< the motor of the file cannot hold the load
  double error = 0;     ///< rad
};

/// A drum with this pitch radius (mm) and a pulley that reaches this far; empty if it is infeasible.
std::optional<Drum> drum_of(DeclaredMechanism declared, double rho, double reach) {
  if (declared.body.room > 0) rho = std::min(rho, widest_drum(declared.body.room, declared.tendon.diameter));
  if (!is_drum(rho, declared.tendon.diameter)) return std::nullopt;
  put_drum(declared, rho, reach);
  if (quick_obstacle(declared)) return std::nullopt;
  const Mechanism joint = joint::identified_joint(declared, joint::LawSearch::brief).mechanism;
  const analysis::UnderLoad load = analysis::under_load(joint);
  if (load.lost_at) return std::nullopt;
  Drum drum{std::move(declared), false, load.theta_error.value};
  drum.stalls = load.motor && !load.motor->ok();
  return drum;
}

/// Pitch radii of drums over the link length: the usual one and wider ones, which are stiffer.
constexpr std::array k_drum_shares{0.15, 0.2, 0.27, 0.36};

/// Drums for the pulley of the file, then for larger and smaller ones. For one pulley the drum with the least error under
/// the load comes first, among those with which the motor holds the load.
std::vector<Drum> drums_for(const DeclaredMechanism& declared, const RunContext& context) {
  const double span = declared.joint.theta_max - declared.joint.theta_min;
  const bool has_r1 = declared.pulley.law == Law::compensate;
  const double ratio = has_r1 ? 0 : mean_ratio(declared);
  std::vector<Drum> all;
  if (!has_r1 && !(ratio > 0)) return all;
  const double bend = 0.5 * declared.tendon.bend_ratio * declared.tendon.diameter;
  const std::vector<double> factors = has_r1 ? std::vector{1.0, 1.4, 2.0, 0.7} : std::vector{1.0};
  for (const double factor : factors) {
    std::vector<Drum> of_pulley;
    for (const double share : k_drum_shares) {
      context.throw_if_stopped();
      DeclaredMechanism changed = declared;
      double rho = std::max(share * declared.joint.R, bend), reach = rho / ratio;
      if (has_r1) {
        if (factor != 1.0) changed.pulley.r1 = in_three_digits(factor * declared.pulley.r1);
        reach = changed.pulley.r1;
        rho = std::min(rho, reach * k_one_turn / span);
      }
      if (auto drum = drum_of(std::move(changed), rho, reach)) of_pulley.push_back(std::move(*drum));
    }
    std::stable_sort(of_pulley.begin(), of_pulley.end(), [](const Drum& one, const Drum& other) {
      return one.stalls != other.stalls ? other.stalls : one.error < other.error;
    });
    std::move(of_pulley.begin(), of_pulley.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace

std::optional<profile::LayoutAdvice> drum_advice(const MechanismFile& file, const BuildOptions& options,
                                                 const RunContext& context) {
  if (!is_range_the_obstacle(joint::identified_joint(file.mechanism).mechanism)) return std::nullopt;
  BuildOptions dry = options;
  dry.dry_run = dry.force = true;
  dry.advice = dry.step = false;
  dry.folder = temporary_folder() / "fusee-layout";
  for (const Drum& drum : drums_for(file.mechanism, context)) {
    context.throw_if_stopped();
    MechanismFile with_drum = file;
    with_drum.mechanism = drum.mechanism;
    if (build(with_drum, dry, context.without_progress()).status != BuildStatus::done) continue;
    return profile::LayoutAdvice{"put a drum on the joint, on which both tendons stay over the whole range",
                                 "finger_mcp", settings_of(drum.mechanism, file.mechanism)};
  }
  return std::nullopt;
}

}  // namespace fusee::pipeline
