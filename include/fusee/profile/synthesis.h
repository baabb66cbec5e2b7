/// \file
/// Synthesis of both pitch curves from a mechanism, or the failed conditions and advice.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fusee/profile/advice.h"
#include "fusee/profile/outline.h"
#include "fusee/transmission/transmission.h"

namespace fusee {

struct SynthesisOptions {
  /// Largest sagitta between the polygon and the curve, on the pitch curve and on every parallel curve up to the
  /// flange. mm
  double tolerance = 0.01;
  /// Outward offset that will be added to the curves before they are made (draw_for_making). The tolerance holds there
  /// too. mm
  double drawn_out = 0;
  /// Search for single changes that make an infeasible mechanism feasible.
  bool advice = true;
  /// Number of steps of the stroke table.
  int stroke_steps = 180;
};

/// A feasibility condition: its result, and its tightest place along the stroke.
struct Condition {
  std::string name;  ///< "convex_floor", "tendon_on_pin_D", "one_turn" …
  bool ok = true;
  double alpha = 0;  ///< tightest place, rad
  double value = 0;  ///< value at the tightest place
  double limit = 0;  ///< bound that value must stay above (below)
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

enum class SynthesisStatus { made, infeasible };

struct SynthesisResult {
  SynthesisStatus status = SynthesisStatus::infeasible;
  Outline p1;
  Outline p2;
  std::vector<TransmissionPoint> stroke;  ///< evenly spaced in α over the range, home included
  std::vector<Condition> conditions;      ///< all of them, passed ones included
  std::vector<Change> advice;             ///< empty when made, or when no change of one number suffices
  /// Issues that do not prevent making: tight bends, slack of method = "paper" …
  std::vector<std::string> warnings;

  bool made() const { return status == SynthesisStatus::made; }
  /// The point of the stroke where α is nearest to 0; null without a stroke.
  const TransmissionPoint* home() const;
  /// Summary in one paragraph: the result, or the failure and the advice.
  std::string brief() const;
};

SynthesisResult synthesise(const Mechanism& mechanism, const SynthesisOptions& options = {});

/// True when the only failed conditions are those of one turn.
bool need_several_turns(const SynthesisResult& synthesis);
/// Reason why a pulley is limited to one turn; null when it may have several.
std::optional<std::string> kept_to_one_turn(const Mechanism& mechanism);

}  // namespace fusee
