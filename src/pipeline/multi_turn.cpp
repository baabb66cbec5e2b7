#include "pipeline/multi_turn.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "analysis/plausibility.h"
#include "base/text.h"
#include "fusee/helical_solid.h"
#include "fusee/helix.h"
#include "fusee/joint.h"
#include "fusee/mechanism_file.h"
#include "fusee/pipeline.h"
#include "fusee/solid.h"
#include "pipeline/design.h"
#include "solid/conditions.h"
#include "solid/groove.h"
#include "solid/print.h"

namespace fusee::pipeline {
namespace {

helix::HelixGroove groove_of(const Mechanism& mechanism) {
  const helical_solid::HelicalSection section = helical_solid::helical_section(mechanism);
  const double d = mechanism.tendon.diameter;
  // The later of two turns lies below. If its radius is larger by `step`, the upper turn is smaller: the growth of the
  // upper turn is −step.
  return {
      section.depth,
      std::min(solid::room_at_groove_edge(section.walls.below, d), solid::room_at_groove_edge(section.walls.above, d)),
      [section](double step) { return helical_solid::least_lead(section, -step); }};
}

/// Notes on properties of multi-turn pulleys that the body's tables do not contain.
std::vector<std::string> notes_of(const Mechanism& mechanism, const formats::HelixProduct& helix) {
  const helical_solid::TendonsLaid ends = helix.laid(mechanism.guides.collar);
  const std::string where = mechanism.guides.collar ? "the guides' collars hold the tendons at the heights "
                                                    : "the tendons end on the joint at the heights ";
  const double share_at_knot = elementary::exp(-mechanism.pulley.mu * k_two_pi * mechanism.body.spare_turns);
  std::vector<std::string> notes = {
      where + rounded(ends.z1, 4) + " mm (tendon 1) and " + rounded(ends.z2, 4) +
          " mm (tendon 2) above the pulley's lower face, where the fleet angle is smallest",
      "helical grooves: " + rounded(helix.synthesis.sides[0].turns, 3) + " turns (P1) and " +
          rounded(helix.synthesis.sides[1].turns, 3) + " turns (P2) over the range, and " +
          rounded(mechanism.body.spare_turns) + " spare at each end, after which " + rounded(100.0 * share_at_knot, 2) +
          " % of a tension reaches the knot; leads of " + rounded(helix.synthesis.sides[0].lead, 3) + " and " +
          rounded(helix.synthesis.sides[1].lead, 3) + " mm",
      "there is no plates.dxf: plates cannot have helical grooves"};
  for (const helix::HelixSide& side : helix.synthesis.sides) {
    if (side.fleet <= helix::k_noted_fleet || side.fleet > helix::k_warned_fleet) continue;
    notes.push_back("a fleet angle of " + rounded(degrees(side.fleet), 3) +
                    "° exceeds the 1.5° limit of smooth drums and is within the 2° limit of grooved drums");
  }
  return notes;
}

/// Failed checks of the body as conditions: a body whose tie-offs do not fit or need support is infeasible.
std::vector<profile::Condition> faults_of(const Mechanism& mechanism, const helical_solid::HelicalPulley& pulley,
                                          const solid::TriangleMesh& mesh) {
  std::vector<Check> checks =
      helical_solid::check_helical_pulley(mesh, pulley, helical_solid::helical_section(mechanism));
  if (!mechanism.print.supports) {
    solid::PrintLimits limits;
    limits.overhang = mechanism.print.overhang;
    for (Check& check : solid::check_print(mesh, limits)) checks.push_back(std::move(check));
  }
  std::vector<profile::Condition> faults;
  if (mechanism.body.room > 0) {
    const double diameter = solid::diameter_about_axis(mesh) / pulley.layout.scale;
    if (const profile::Condition room = solid::room_condition(mechanism, diameter); !room.ok) faults.push_back(room);
  }
  for (const Check& check : checks) {
    if (check.ok) continue;
    profile::Condition fault;
    fault.name = "body_" + check.name;
    fault.ok = false;
    fault.value = check.value;
    fault.limit = check.limit;
    fault.unit = check.unit;
    fault.message = "the multi-turn body fails a check: " + check.name + " is " + rounded(check.value, 4) +
                    ", the limit is " + rounded(check.limit, 4) + (check.where.empty() ? "" : " (" + check.where + ")");
    faults.push_back(std::move(fault));
  }
  return faults;
}

/// A coarse synthesis, sufficient for slopes and warnings.
helix::HelixSynthesis brief_synthesis(const Mechanism& mechanism) {
  constexpr double k_brief_chord_error_mm = 0.05;
  profile::SynthesisOptions options;
  options.chord_error_mm = k_brief_chord_error_mm;
  options.stroke_steps = 72;
  return helix::synthesise_helix(mechanism, groove_of(mechanism), options);
}

bool is_multi_turn(const DeclaredMechanism& mechanism) {
  if (mechanism.transmission || profile::kept_to_one_turn(mechanism)) return false;
  profile::SynthesisOptions options;
  options.advice = false;
  return profile::needs_multi_turn(profile::synthesise(mechanism, options));
}

/// Note on the effect of the slope φ of tendon paths, since forces are computed for level tendons. A tension T turns
/// the joint with T cos φ. A path of planar length L is L/cos φ long, and grows by cos φ dL at constant rise. Its
/// compliance is that of a planar tendon with EA cos³φ.
std::string words_on_slopes(const Mechanism& mechanism) {
  constexpr double k_noted_theta = radians(0.001);
  const helix::HelixSynthesis helix = brief_synthesis(mechanism);
  const std::string start = "the tendons are wound several times: angles and forces are computed for level tendons";
  if (helix.sides[0].stroke.empty()) return start;
  double steepest = 0;          // slope, rad
  double theta_difference = 0;  // rad
  const transmission::Transmission level(mechanism);
  for (std::size_t i = 0; i < helix.stroke.size(); ++i) {
    for (const helix::HelixSide& side : helix.sides) steepest = std::max(steepest, std::abs(side.stroke[i].slope));
    theta_difference = std::max(theta_difference, std::abs(level.theta(helix.stroke[i].alpha) - helix.stroke[i].theta));
  }
  const auto percent_more = [steepest](int power) {
    return rounded(100.0 * (elementary::pow(elementary::cos(steepest), -power) - 1.0), 2);
  };
  std::string words = start + ". Their paths slope by up to " + rounded(degrees(steepest), 3) +
                      "°, which increases tensions by up to " + percent_more(1) + " % and their stretch by up to " +
                      percent_more(3) + " %";
  if (theta_difference > k_noted_theta)
    words += "; the effect of guides.collar on theta, up to " + rounded(degrees(theta_difference), 2) + "°, is omitted";
  return words;
}

void draw_for_making(helix::Spiral& spiral, const OutlineError& outline) {
  for (helix::SpiralRow& row : spiral.rows) {
    const profile::OutlinePoint drawn =
        joint::drawn_for_making({row.turn, Vec2(row.x, row.y), unit(row.turn), row.rho}, outline);
    row.x = drawn.position.x();
    row.y = drawn.position.y();
    row.rho = drawn.curvature_radius;
  }
}

helical_solid::FloorLine as_made(helical_solid::FloorLine drawn, const OutlineError& outline) {
  Polygon plan;
  for (const Vec3& point : drawn) plan.push_back(point.head<2>());
  // Half-planes meet each side of the floor's polygon several times. With this number of points on either side, a
  // normal averages several sides.
  constexpr std::size_t k_points_beside = 14;
  plan = joint::line_as_made(std::move(plan), outline, k_points_beside);
  for (std::size_t i = 0; i < drawn.size(); ++i) drawn[i].head<2>() = plan[i];
  return drawn;
}

/// Copies the results of the helical synthesis that both kinds of pulley have.
void adopt_synthesis(formats::Product& product, const formats::HelixProduct& helix) {
  profile::SynthesisResult& synthesis = product.synthesis;
  synthesis = {};
  synthesis.status = helix.synthesis.status;
  synthesis.stroke = helix.synthesis.stroke;
  synthesis.conditions = helix.synthesis.conditions;
  synthesis.warnings = helix.synthesis.warnings;
}

}  // namespace

std::optional<Diagnostic> note_on_turns(const MechanismFile& file) {
  if (!is_multi_turn(file.mechanism)) return std::nullopt;
  return Diagnostic{Severity::note, file.place_of("pulley.winding"), words_on_slopes(file.mechanism), {}};
}

std::vector<Diagnostic> warnings_of_turns(const MechanismFile& file) {
  std::vector<Diagnostic> warnings;
  if (!is_multi_turn(file.mechanism)) return warnings;
  for (const std::string& words : brief_synthesis(file.mechanism).warnings)
    warnings.push_back({Severity::warning, file.place_of("pulley.winding"), words, {}});
  return warnings;
}

std::vector<Diagnostic> unused_turn_keys(const MechanismFile& file) {
  std::vector<Diagnostic> warnings;
  for (const char* key : {"guides.collar", "body.lead_mm", "body.spare_turns"}) {
    if (!find_field(key)->is_set(file.mechanism)) continue;
    warnings.push_back({Severity::warning,
                        file.place_of(key),
                        std::string(key) + " is not used: it applies to multi-turn pulleys, and these have one turn",
                        {}});
  }
  return warnings;
}

MechanismFile with_plausibility_warnings_and_turns(MechanismFile file) {
  const auto turns = note_on_turns(file);
  file = analysis::with_plausibility_warnings(std::move(file));
  if (turns) file.warnings.push_back(*turns);
  return file;
}

bool design_multi_turn(formats::Product& product, double chord_error_mm, const RunContext& context,
                       solid::TieOffSearch search) {
  const Mechanism& mechanism = product.joint.mechanism;
  context.begin_step("winding both tendons several times");
  formats::HelixProduct& helix = product.helix.emplace();
  profile::SynthesisOptions options;
  options.chord_error_mm = chord_error_mm;
  options.drawn_out = -product.joint.outline.offset;
  helix.synthesis = helix::synthesise_helix(mechanism, groove_of(mechanism), options);
  adopt_synthesis(product, helix);
  if (!helix.synthesis.made()) return false;
  for (helix::HelixSide& side : helix.synthesis.sides) draw_for_making(side.spiral, product.joint.outline);
  context.begin_step("building the body");
  helix.pulley = helical_solid::make_helical_pulley(mechanism, helix.synthesis.sides[0].spiral,
                                                    helix.synthesis.sides[1].spiral, chord_error_mm, search);
  solid::Pulley& pulley = product.pulley;
  pulley = {};
  pulley.status = helix.pulley.made ? solid::PulleyStatus::made : solid::PulleyStatus::impossible;
  pulley.layout = helix.pulley.layout;
  pulley.mesh = std::move(helix.pulley.mesh);
  pulley.conditions = helix.pulley.conditions;
  if (pulley.made()) {
    for (profile::Condition& fault : faults_of(mechanism, helix.pulley, pulley.mesh)) {
      pulley.conditions.push_back(std::move(fault));
      pulley.status = solid::PulleyStatus::impossible;
    }
  }
  pulley.expected_volume = helix.pulley.expected_volume;
  pulley.expected_euler = helix.pulley.expected_euler;
  pulley.mesh_checks = helix.pulley.mesh_checks;
  for (std::string& note : notes_of(mechanism, helix)) pulley.layout.notes.push_back(std::move(note));
  return pulley.made();
}

namespace {

/// Designs a multi-turn pulley within the limit of excess length. A string on a polygon inscribed in its curve is too
/// short, in proportion to the chord error and the angle of winding. If the excess length over the range exceeds its
/// limit, the curves are drawn again, as finely as the limit requires (campaign of seed 620001, design 316: 10.5 rad,
/// 0.11 mm of excess length).
bool design_turns_within(formats::Product& product, double chord_error_mm, const AsBuiltLimits& limits,
                         const RunContext& context, solid::TieOffSearch search) {
  if (!design_multi_turn(product, chord_error_mm, context, search)) return false;
  double furthest = 0;  // rad
  for (const transmission::TransmissionPoint& point : product.synthesis.stroke)
    furthest = std::max(furthest, std::abs(point.alpha));
  if (furthest * chord_error_mm <= limits.excess) return true;
  const profile::RewindResult wound = rewind_multi_turn(product, product.pulley.mesh).result;
  if (all_ok(as_built_checks(product.joint.mechanism, wound, limits))) return true;
  return design_multi_turn(product, 0.5 * limits.excess / furthest, context, search);
}

}  // namespace

bool design_any(formats::Product& product, double chord_error_mm, const AsBuiltLimits& limits,
                const RunContext& context, solid::TieOffSearch search) {
  if (design(product, chord_error_mm, context, search)) return true;
  if (!profile::needs_multi_turn(product.synthesis)) return false;
  const auto kept = profile::kept_to_one_turn(product.file.mechanism);
  if (!kept) return design_turns_within(product, chord_error_mm, limits, context, search);
  for (profile::Condition& condition : product.synthesis.conditions) {
    if (!condition.ok) condition.message += " (" + *kept + ")";
  }
  return false;
}

helical_solid::HelicalRewind rewind_multi_turn(const formats::Product& product, const solid::TriangleMesh& mesh) {
  return rewind_multi_turn(product, helical_solid::helical_floors(mesh, product.pulley.layout.scale));
}

helical_solid::HelicalRewind rewind_multi_turn(const formats::Product& product,
                                               const std::vector<helical_solid::FloorLine>& floors) {
  if (floors.size() != 2)
    throw InputError("", "it has " + std::to_string(floors.size()) + " helical grooves instead of 2");
  const joint::IdentifiedJoint& joint = product.joint;
  return helical_solid::rewind_floors(as_made(floors[0], joint.outline), as_made(floors[1], joint.outline),
                                      joint::with_inset(joint), product.synthesis.stroke,
                                      product.helix->laid(joint.mechanism.guides.collar));
}

std::vector<Check> check_multi_turn(const formats::Product& product, const solid::TriangleMesh& mesh) {
  return helical_solid::check_helical_pulley(mesh, product.helix->pulley,
                                             helical_solid::helical_section(product.joint.mechanism));
}

namespace {

/// Keys of the body that advice may change; optional ones only if the file has them.
std::vector<std::string> keys_of_body(const DeclaredMechanism& mechanism) {
  std::vector<std::string> keys{"body.lead_mm", "body.spare_turns", "body.groove_depth_mm", "body.groove_angle_deg"};
  for (const char* key : {"body.bore_diameter_mm", "body.bore_flat_mm", "body.knot_pocket_mm", "body.anchor_hole_mm",
                          "body.min_wall_mm", "body.hub_diameter_mm"}) {
    if (solid::is_written(mechanism, key)) keys.emplace_back(key);
  }
  return keys;
}

constexpr double k_helix_trial_chord_error_mm = 0.05;

helix::HelixSynthesis trial_curves(const Mechanism& mechanism, double chord_error_mm) {
  profile::SynthesisOptions options;
  options.chord_error_mm = chord_error_mm;
  options.stroke_steps = 36;
  return helix::synthesise_helix(mechanism, groove_of(mechanism), options, helix::HelixAccuracy::coarse);
}

/// Obstacles of the curves first, then of the body.
std::vector<profile::Condition> obstacles_of(const Mechanism& mechanism, const helix::HelixSynthesis& curves,
                                             double chord_error_mm) {
  if (!curves.made()) return profile::failed_of(curves.conditions);
  return helical_solid::helical_obstacles(mechanism, curves.sides[0].spiral, curves.sides[1].spiral, chord_error_mm);
}

/// The first bend of a tendon that is tighter than tendon.bend_ratio allows.
std::optional<std::string> tight_bend(const Mechanism& mechanism, const helix::HelixSynthesis& curves) {
  const double least = 0.5 * mechanism.tendon.bend_ratio * mechanism.tendon.diameter;
  for (const helix::HelixSide& side : curves.sides) {
    const helix::Spiral& spiral = side.spiral;
    for (std::size_t i = spiral.first_used; i <= spiral.last_used; ++i) {
      if (spiral.rows[i].rho >= least) continue;
      return "the tendon is bent to a radius of " + rounded(spiral.rows[i].rho, 3) + " mm, and requires " +
             rounded(least, 3) + " mm or more (tendon.bend_ratio)";
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> obstacle_to_multi_turn(const Mechanism& mechanism) {
  const helix::HelixSynthesis curves = trial_curves(mechanism, k_helix_trial_chord_error_mm);
  const std::vector<profile::Condition> obstacles = obstacles_of(mechanism, curves, k_helix_trial_chord_error_mm);
  if (!obstacles.empty()) return obstacles.front().message;
  return tight_bend(mechanism, curves);
}

namespace {

// Limit of spiral rows for the full builds of advice: a build of 2400 rows takes half a second (campaign of seed
// 990202, design 237). Two builds, which run in parallel, are always allowed.
constexpr double k_rows_for_advice = 9000;

/// Approximate number of rows of the spirals at the final chord error e, which allows turns of √(8e/ρ) between rows.
double rows_as_made(const helix::HelixSynthesis& curves, double chord_error_mm) {
  double rows = 0;
  for (const helix::HelixSide& side : curves.sides) {
    const std::vector<helix::SpiralRow>& coarse = side.spiral.rows;
    for (std::size_t i = 1; i < coarse.size(); ++i)
      rows += (coarse[i].turn - coarse[i - 1].turn) * std::sqrt(coarse[i].rho / (8.0 * chord_error_mm));
  }
  return rows;
}

/// Quick checks and full builds of small variants of a file.
class MultiTurnCheck {
 public:
  MultiTurnCheck(const DeclaredMechanism& declared, const MultiTurnTrial& trial) : declared_(declared), trial_(trial) {}

  std::vector<profile::Condition> obstacles(const Mechanism& changed) {
    trial_.context.throw_if_stopped();
    DeclaredMechanism declared = declared_;
    static_cast<Mechanism&>(declared) = changed;
    const Mechanism joint = joint::identified_joint(declared, joint::LawSearch::brief).mechanism;
    const helix::HelixSynthesis curves = trial_curves(joint, k_helix_trial_chord_error_mm);
    std::vector<profile::Condition> obstacles = obstacles_of(joint, curves, k_helix_trial_chord_error_mm);
    if (obstacles.empty()) record_size(rows_as_made(curves, trial_.chord_error_mm));
    return obstacles;
  }
  bool make(const Mechanism& changed) {
    ++begun_;
    return trial_.made(changed);
  }
  /// Number of full builds for which the largest feasible variant leaves time.
  int builds_left() const { return std::max(2, static_cast<int>(k_rows_for_advice / most_rows_)) - begun_; }

 private:
  /// Raises most_rows_ to `rows`; called by several threads.
  void record_size(double rows) {
    double known = most_rows_;
    while (rows > known && !most_rows_.compare_exchange_weak(known, rows)) {
    }
  }

  const DeclaredMechanism& declared_;
  const MultiTurnTrial& trial_;
  std::atomic<double> most_rows_ = 1;  ///< of the feasible variants so far
  std::atomic<int> begun_ = 0;         ///< full builds
};

}  // namespace

profile::Advice multi_turn_advice(const formats::Product& product, const MultiTurnTrial& trial) {
  MultiTurnCheck check(product.file.mechanism, trial);
  const profile::FeasibilityOracle judge{
      .obstacles = [&check](const Mechanism& changed) { return check.obstacles(changed); },
      .made = [&check](const Mechanism& changed) { return check.make(changed); },
      .is_expensive = true,
      .builds_left = [&check] { return check.builds_left(); }};
  DeclaredMechanism in_one_part = product.file.mechanism;
  const Field& parts = *find_field("print.parts");
  if (const std::string declared_parts = parts.get_text(in_one_part); declared_parts == "two") {
    parts.set_text(in_one_part, "one");
    if (judge.obstacles(in_one_part).empty() && judge.made(in_one_part)) {
      profile::Advice advice;
      advice.alone.push_back({"print.parts", 0, 0, {}, "print.parts = \"one\"", declared_parts, "one"});
      return advice;
    }
  }
  return profile::find_advice(product.file.mechanism, judge, keys_of_body(product.file.mechanism));
}

kit::TendonHeights tendon_heights(const formats::Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const double rho = mechanism.guide_pitch_radius();
  const helical_solid::TendonsLaid laid = product.helix->laid(mechanism.guides.collar);
  kit::TendonHeights heights;
  heights.ends = {laid.z1, laid.z2};
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    const double end = heights.ends.at(i);
    heights.drum.include(end);
    kit::TendonHeights::Span& guide = heights.guides.at(i);
    if (laid.collar) {
      guide.include(end);
      continue;
    }
    const transmission::Side side = i == 0 ? transmission::Side::left : transmission::Side::right;
    const transmission::PinPlace place = transmission::pin_place(mechanism, side, rho);
    const helical_solid::SpiralPlace& spiral = i == 0 ? product.helix->pulley.p1 : product.helix->pulley.p2;
    const std::vector<helix::HelixPoint>& stroke = product.helix->synthesis.sides.at(i).stroke;
    for (std::size_t k = 0; k < stroke.size(); ++k) {
      const transmission::TransmissionPoint& at = product.synthesis.stroke.at(k);
      const transmission::TendonPoint& tendon = i == 0 ? at.t1 : at.t2;
      // Rise of the tendon per planar length.
      const double rise = spiral.direction * elementary::tan(stroke[k].slope);
      guide.include(end + rise * tendon.free_upper);
      guide.include(end + rise * (tendon.free_upper + rho * tendon.wrap));
      heights.drum.include(end +
                           rise * place.drum *
                               transmission::upper_span(place, transmission::mirror_sign(side) * at.theta).on_drum);
    }
  }
  return heights;
}

}  // namespace fusee::pipeline
