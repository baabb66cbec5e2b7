/// \file
/// The cable of a joint declared by a ratio: a compliance that stiffens, and friction along the cable's way.
#pragma once

#include <array>

#include "fusee/mechanism/imperfections.h"

namespace fusee {

/// Carries the cable's history from row to row.
///
/// Under the load q, held back by the friction f, the joint stands at driven − d(q ± f), where d is the cable's
/// deflection. Contacts in series, each of an equal share of the friction, slip one after another from the end that
/// moves: their thresholds are spread evenly from 0 to 2 f. Each is a play operator whose bounds move with motor and
/// load; the joint stands at their mean (Prandtl-Ishlinskii, even density).
class RubbingCable {
 public:
  /// At rest without load, the motor's side of the cable at `driven`. rad
  RubbingCable(const RatioJointError& joint, double driven);

  /// Angle of the joint once the motor's side stands at `driven` and `load` acts. rad, and the log's unit of load
  double to(double driven, double load);

 private:
  static constexpr std::size_t k_contacts = 8;

  /// By how much the cable turns the joint back under `pull`. rad
  double deflection(double pull) const { return joint_.compliance * pull + joint_.waves.gained(pull); }

  RatioJointError joint_;
  std::array<double, k_contacts> angles_{};  ///< of the joint, if each contact had all of the cable
};

}  // namespace fusee
