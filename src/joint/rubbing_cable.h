/// \file
/// The cable of a joint declared by a ratio: a stiffening compliance, and friction along the cable.
#pragma once

#include <array>

#include "fusee/mechanism.h"

namespace fusee::joint {

/// Model of the cable, with its history.
///
/// Under the load q with friction f the joint is at driven − d(q ± f), where d is the cable's deflection. Contacts in
/// series, each with an equal share of the friction, slip one after another from the moving end, with thresholds evenly
/// spread from 0 to 2 f. Each is a play operator whose bounds move with motor and load; the joint angle is their mean
/// (Prandtl-Ishlinskii model with uniform density).
class RubbingCable {
 public:
  /// Starts at rest without load, with the motor's end of the cable at `driven`. rad
  RubbingCable(const RatioJointError& joint, double driven);

  /// Joint angle after the motor's end moves to `driven` under `load`. rad, and the log's unit of load
  double to(double driven, double load);

 private:
  static constexpr std::size_t k_contacts = 8;

  /// Rotation of the joint by the cable's deflection under `pull`. rad
  double deflection(double pull) const { return joint_.compliance * pull + joint_.waves.gained(pull); }

  RatioJointError joint_;
  std::array<double, k_contacts> angles_{};  ///< joint angle of each contact, as if it had the whole cable
};

}  // namespace fusee::joint
