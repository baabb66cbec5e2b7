/// \file
/// From a mechanism to the closed pitch curves of both pulleys, and back by winding strings on them.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"
#include "fusee/transmission.h"

namespace fusee::profile {

// ---- Pitch curves ---------------------------------------------------------------------------------------------------
// A sampled, closed, convex pitch curve: the tendon's centre line on the pulley, in the pulley's frame at home with
// the axis at the origin.

/// One point of a pitch curve.
struct OutlinePoint {
  double psi = 0;               ///< direction of the outward normal, rad, increasing along the curve
  Vec2 position;                ///< mm
  Vec2 normal;                  ///< unit(psi)
  double curvature_radius = 0;  ///< radius of curvature of the pitch curve, mm
};

/// Counter-clockwise, strictly convex, with the axis inside. P1 and P2 of a pulley are sampled at the *same* psi
/// values: points with equal index have equal normals, also on parallel curves.
///
/// Tendons leave the active arc within the range. It runs counter-clockwise from points[active_first] to
/// points[active_last], possibly past the end of the vector. Both are exact ends, except that ends of P1 and P2 less
/// than 0.1° apart share a point. The remaining closing arc carries no tendon in range, except the short lap at the
/// wound end that leads to the anchor.
struct Outline {
  transmission::Side side = transmission::Side::left;
  std::vector<OutlinePoint> points;
  std::size_t active_first = 0;
  std::size_t active_last = 0;

  /// The end of the active arc where the tendon stays wound over the whole stroke and continues to its anchor:
  /// active_last for P1 (left), active_first for P2 (right).
  std::size_t anchor_end() const { return side == transmission::Side::left ? active_last : active_first; }
  /// True for points of the active arc, ends included.
  bool is_active(std::size_t i) const;
};

/// The parallel curve at `distance` (outward positive): point i moves along its normal. The groove floor is parallel(o,
/// −d/2).
Polygon parallel(const Outline& outline, double distance);

/// Bound on the distance of a convex curve from the chord of two of its points, mm. It is that of an arc (chord · turn
/// / 8), but at most the height of the intersection of both end tangents, which is small when the whole turn is at one
/// end, as beside a bridge over a hollow. `from` and `to` are points on the curve with normals `psi_from` and `psi_to`,
/// rad.
double sagitta(const Vec2& from, double psi_from, const Vec2& to, double psi_to);

// ---- Advice ---------------------------------------------------------------------------------------------------------
// Search for the smallest change of a number that makes an infeasible mechanism feasible.

struct Condition;

/// The nearest value of one key, a number or a word, with which every condition holds.
struct Change {
  std::string key;  ///< "pulley.r1_mm"
  double from = 0;  ///< in the file's unit
  double to = 0;
  std::string unit;
  std::string text;            ///< "r1 ≤ 18.9 mm"
  std::string from_word = {};  ///< for a key that is not a number: "M3"
  std::string to_word = {};
  std::optional<double> until = {};  ///< the last value that suffices, if a value not far beyond `to` no longer does
  std::string cost = {};             ///< ", which omits the hub"; "" if it is unknown or nothing
};

/// Feasibility test of changed mechanisms during the search for advice.
struct FeasibilityOracle {
  /// Fast test: returns the failed conditions; none if the mechanism is feasible as far as this test can decide. Called
  /// hundreds of times, and by two threads at once if `made` is set.
  std::function<std::vector<Condition>(const Mechanism&)> obstacles;
  /// Full build of a change before it is reported, with the very numbers that the user will read. Empty: the fast test
  /// suffices.
  std::function<bool(const Mechanism&)> made = {};
  /// The fast test is slow: numbers that do not help are tested less often the further they are changed.
  bool is_expensive = false;
  /// Number of full builds that the evaluations so far still justify; fewer than usual for large parts. Empty: the
  /// usual number.
  std::function<int()> builds_left = {};
  /// Keys whose numbers are searched first, over their whole range: those that the user has just typed.
  std::vector<std::string> first = {};
};

/// Another layout for the joint: the keys to set, as they stand in a file.
struct LayoutAdvice {
  std::string text;           ///< "put a drum on the joint, which reaches any angle of the range"
  std::string template_name;  ///< a template with this layout
  std::vector<std::pair<std::string, std::string>> settings;  ///< "joint.drum_radius_mm", "12.5"
};

/// Changes that make a mechanism feasible: single changes, nearest first, or two combined changes.
struct Advice {
  std::vector<Change> alone;
  std::vector<Change> together;
  std::optional<LayoutAdvice> layout = {};
  /// True if every single number was tried over its whole allowed range, and none suffices.
  bool is_exhausted = true;

  bool empty() const { return alone.empty() && together.empty() && !layout; }
};

/// Searches each number of joint, guides, pulley and tendon that the law uses, and `more_keys` (numbers for which 0
/// means "automatic", so that they are never reduced to 0). All numbers move outwards together in growing steps, up to
/// five times their magnitude, until a few are feasible. If none is, they are searched in smaller steps up to the
/// bounds of the field table. Bisection then finds the border, rounded to three digits on the safe side. If no single
/// number suffices, the most helpful ones are changed in pairs. `more_keys` are easier to change and move three times
/// as far. `known`: number of changes that are known already and need not be found.
Advice find_advice(const Mechanism& mechanism, const FeasibilityOracle& oracle,
                   const std::vector<std::string>& more_keys = {}, std::size_t known = 0);

/// The single changes of find_advice() for a yes/no feasibility test.
std::vector<Change> nearest_changes(const Mechanism& mechanism, const std::function<bool(const Mechanism&)>& possible,
                                    const std::vector<std::string>& more_keys = {});

/// "pulley.r1_mm = 18.9 or less (now 20)".
std::string setting_words(const Change& change);
/// "make r1 ≤ 18.9 mm, or EF ≥ 95 mm, or the range ±28°"; "" for none.
std::string advice_sentence(const std::vector<Change>& changes);

// ---- Synthesis ------------------------------------------------------------------------------------------------------
// Synthesis of both pitch curves from a mechanism, or the failed conditions and advice.

/// Accuracy and scope of synthesise().
struct SynthesisOptions {
  /// Largest sagitta between the polygon and the curve, on the pitch curve and on every parallel curve up to the
  /// flange. mm
  double chord_error_mm = 0.01;
  /// Outward offset that will be added to the curves before they are made (draw_for_making). The chord error holds
  /// there, too. mm
  double drawn_out = 0;
  /// Search for single changes that make an infeasible mechanism feasible.
  bool advice = true;
  /// Number of steps of the stroke table.
  int stroke_steps = 180;
};

/// A feasibility condition: its result, and its tightest place along the stroke.
struct Condition {
  std::string name;  ///< "convex_floor_P2", "tendon_on_pin_D", "one_turn_P1" …
  bool ok = true;
  double alpha = 0;  ///< tightest place, rad
  double value = 0;  ///< value at the tightest place
  double limit = 0;  ///< lower or upper bound of `value`
  std::string unit;
  std::string message;  ///< for a person: what fails, where, by how much
};

/// The conditions that fail.
std::vector<Condition> failed_of(const std::vector<Condition>& conditions);

/// True for a condition that limits a pulley to one turn.
bool is_of_one_turn(const Condition& condition);

/// The first failed condition of synthesise(), tested in order of cost; null when there is none. Draws no curves, for
/// searches over thousands of mechanisms.
std::optional<Condition> obstacle_to(const Mechanism& mechanism);
/// As obstacle_to(), but ignores the conditions of one turn.
std::optional<Condition> obstacle_but_one_turn(const Mechanism& mechanism);

/// Outcome of synthesise().
enum class SynthesisStatus { made, infeasible };

/// Result of synthesise(): both curves, or the failed conditions and advice.
struct SynthesisResult {
  SynthesisStatus status = SynthesisStatus::infeasible;
  Outline p1;
  Outline p2;
  std::vector<transmission::TransmissionPoint> stroke;  ///< evenly spaced in α over the range, home included
  std::vector<Condition> conditions;                    ///< all of them, passed ones included
  std::vector<Change> advice;                           ///< empty when made, or when no change of one number suffices
  /// Issues that do not prevent making: tight bends, excess length of method = "paper" …
  std::vector<std::string> warnings;

  bool made() const { return status == SynthesisStatus::made; }
  /// The point of the stroke where α is nearest to 0; null without a stroke.
  const transmission::TransmissionPoint* home() const;
  /// Summary in one paragraph: the result, or the failure and the advice.
  std::string brief() const;
};

/// Draws both pitch curves. An infeasible mechanism is a value. Requires a joint with tendons.
SynthesisResult synthesise(const Mechanism& mechanism, const SynthesisOptions& options = {});

/// True when the only failed conditions are those of one turn.
bool needs_multi_turn(const SynthesisResult& synthesis);
/// Reason why a pulley is limited to one turn; null when it may have several.
std::optional<std::string> kept_to_one_turn(const Mechanism& mechanism);

// ---- Rewinding ------------------------------------------------------------------------------------------------------
// Independent verification: winds two inextensible strings on a pair of groove floors and finds the resulting joint
// angle. Polygon geometry only (arc lengths, tangents to discs, root finding); no equation is shared with the
// synthesis.

/// Joint angle of wound strings at one pulley angle.
struct RewindPoint {
  double alpha = 0;           ///< rad
  double theta_declared = 0;  ///< by the target motion, rad
  double theta = 0;           ///< with tendon 1 taut (or with the only string), rad
  double excess = 0;          ///< excess length of tendon 2 at that θ: > 0 hangs loose, < 0 would have to stretch, mm
};

/// Result of rewind(), with its largest deviations.
struct RewindResult {
  std::vector<RewindPoint> points;
  double max_theta_error = 0;     ///< max |theta − theta_declared|, rad
  double max_theta_error_at = 0;  ///< α, rad
  double max_excess = 0;          ///< max |excess|, mm
  double max_excess_at = 0;       ///< α, rad
};

/// `floor1`, `floor2`: the groove floors in the pulley's frame at home, axis at the origin, mm. The string bridges
/// hollows. Throws InputError when a floor does not surround the axis or contains a pin.
RewindResult rewind(const Mechanism& mechanism, const Polygon& floor1, const Polygon& floor2, int steps = 180);
/// Winds only the string of `side`, which then determines the joint angle; the excess length is reported as 0.
RewindResult rewind_one(const Mechanism& mechanism, transmission::Side side, const Polygon& floor, int steps = 180);

}  // namespace fusee::profile
