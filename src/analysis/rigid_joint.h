/// \file
/// A joint with pulleys that were made for another mechanism, and with inextensible tendons: joint angle, excess
/// length, and the derivatives of both.
#pragma once

#include <string_view>
#include <vector>

#include "fusee/joint.h"

namespace fusee::analysis {

/// The joint at one pulley angle.
struct RigidPoint {
  double theta = 0;   ///< tendon 1 taut, rad
  double excess = 0;  ///< excess length of tendon 2 at that θ, mm; negative: it would have to stretch
};

/// The joint with tendons that are as long as their paths at home.
class RigidJoint {
 public:
  RigidJoint(const joint::MadePulleys& made, const Mechanism& mounted);

  RigidPoint at(double alpha) const;
  const std::array<transmission::PinPlace, 2>& pins() const { return pins_; }
  std::array<joint::LowerPath, 2> lower(double alpha) const { return made_.paths(pins_, alpha); }

 private:
  /// Length of a tendon between a fixed point of its pin's rim and a fixed point of the pulley, up to a constant. mm
  double length_below_pin(std::size_t side, const joint::LowerPath& path) const {
    return path.reach - pins_[side].rho * pins_[side].off_pin(path.normal) + path.wound;
  }

  joint::MadePulleys made_;
  std::array<transmission::PinPlace, 2> pins_;
  std::array<double, 2> home_;  ///< path length at home, up to a constant
};

/// A joint that deviates from the one its pulleys were made for.
struct Alteration {
  Mechanism mounted;
  double offset = 0;  ///< offset of both pitch curves, mm
};

/// A length of the joint that may deviate from its declaration, while the pulleys do not change.
struct Dimension {
  std::string_view key;  ///< key of the field table, or "print_offset"
  void (*alter)(Alteration& joint, double change);
  /// d (path length of tendon `side`)/d change, at fixed θ and α. `theta` and `alpha` of the image.
  double (*lengthens)(const transmission::PinPlace& pin, const joint::LowerPath& lower, transmission::Side side,
                      double theta, double alpha);
};

/// The dimensions of this joint, in a fixed order.
std::vector<Dimension> dimensions(const Mechanism& mechanism);

/// The pulleys `made` for `mechanism` in a joint with one dimension changed (mm).
RigidJoint altered(const joint::MadePulleys& made, const Mechanism& mechanism, const Dimension& dimension,
                   double change);
/// The pulleys `made` for `mechanism` in a joint with each of dimensions() changed.
RigidJoint altered(const joint::MadePulleys& made, const Mechanism& mechanism, const std::vector<double>& changes);

/// d/d change of the result of at(), in closed form.
RigidPoint derivative(const RigidJoint& joint, const Dimension& dimension, double alpha);

}  // namespace fusee::analysis
