/// \file
/// Mechanism → both pitch curves, or the reasons why there are none and the nearest numbers with which there would be.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fusee/profile/advice.h"
#include "fusee/profile/outline.h"
#include "fusee/transmission/transmission.h"

namespace fusee {

struct SynthesisOptions {
  /// Largest sagitta between the polygon and the curve, on the pitch curve and on every curve parallel to it up to the
  /// flange. mm
  double tolerance = 0.01;
  /// By how much the curves will be drawn further out before they are made (draw_for_making): the tolerance holds there
  /// too. mm
  double drawn_out = 0;
  /// Search for changes of single numbers that would make an infeasible mechanism feasible.
  bool advice = true;
  /// Number of steps of the stroke table.
  int stroke_steps = 180;
};

/// A condition of feasibility that was looked at, whether it holds, and where it is tightest.
struct Condition {
  std::string name;  ///< "convex_floor", "tendon_on_pin_D", "one_turn" …
  bool ok = true;
  double alpha = 0;  ///< where it is tightest, rad
  double value = 0;  ///< there
  double limit = 0;  ///< value must stay above (below) this
  std::string unit;
  std::string message;  ///< for a person: what happens, where, by how much
};

/// Those that do not hold.
std::vector<Condition> failed_of(const std::vector<Condition>& conditions);

/// It asks that a pulley turns no further than once.
bool is_of_one_turn(const Condition& condition);

/// Why synthesise() would not make it, the condition that is cheapest to see; null when it would. Draws nothing: for
/// searches that ask of thousands.
std::optional<Condition> obstacle_to(const Mechanism& mechanism);
/// The same, but for conditions of one turn: null where those alone do not hold.
std::optional<Condition> obstacle_but_one_turn(const Mechanism& mechanism);

enum class SynthesisStatus { made, infeasible };

struct SynthesisResult {
  SynthesisStatus status = SynthesisStatus::infeasible;
  Outline p1;
  Outline p2;
  std::vector<TransmissionPoint> stroke;  ///< evenly spaced in α over the range, home included
  std::vector<Condition> conditions;      ///< all of them, those that hold too
  std::vector<Change> advice;             ///< empty when made, or when no change of one number helps
  std::vector<std::string> warnings;      ///< made all the same: tight bends, slack of method = "paper" …

  bool made() const { return status == SynthesisStatus::made; }
  /// The place of the stroke where α is nearest to 0; null without a stroke.
  const TransmissionPoint* home() const;
  /// One paragraph: what was made, or why not and what to change.
  std::string brief() const;
};

SynthesisResult synthesise(const Mechanism& mechanism, const SynthesisOptions& options = {});

/// The one thing that keeps these curves from being made is that they are longer than a turn.
bool need_several_turns(const SynthesisResult& synthesis);
/// Why a pulley is not wound several times; null where it is when one turn does not suffice.
std::optional<std::string> kept_to_one_turn(const Mechanism& mechanism);

}  // namespace fusee
