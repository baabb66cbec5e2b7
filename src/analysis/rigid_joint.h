/// \file
/// Pulleys made for one mechanism in another, with tendons that do not stretch: the joint angle, the slack, and the
/// derivatives of both.
#pragma once

#include <string_view>
#include <vector>

#include "fusee/joint/joint_model.h"

namespace fusee {

struct RigidPoint {
  double theta = 0;  ///< tendon 1 taut, rad
  double slack = 0;  ///< of tendon 2 there, mm; negative: it would have to stretch
};

/// Tendons as long as they are at home.
class RigidJoint {
 public:
  RigidJoint(const MadePulleys& made, const Mechanism& mounted);

  RigidPoint at(double alpha) const;
  const std::array<PinPlace, 2>& pins() const { return pins_; }
  std::array<LowerPath, 2> lower(double alpha) const { return made_.paths(pins_, alpha); }

 private:
  double below(std::size_t side, const LowerPath& path) const {
    return path.reach - pins_[side].rho * pins_[side].off_pin(path.normal) + path.wound;
  }

  MadePulleys made_;
  std::array<PinPlace, 2> pins_;
  std::array<double, 2> home_;  ///< length of path, but for a constant
};

/// A joint that came out otherwise than its pulleys were made for.
struct Alteration {
  Mechanism mounted;
  double offset = 0;  ///< of both pitch curves, mm
};

/// A length of the joint that may come out otherwise than declared, while the pulleys stay as they were made.
struct Dimension {
  std::string_view key;  ///< of the field table, or "print_offset"
  void (*alter)(Alteration& joint, double change);
  /// d (length of tendon `side`'s path)/d change, at fixed θ and α. `theta` and `alpha` of the image.
  double (*lengthens)(const PinPlace& pin, const LowerPath& lower, Side side, double theta, double alpha);
};

/// Those that this joint has.
std::vector<Dimension> dimensions(const Mechanism& mechanism);

/// `made`, as declared for `mechanism`, in what comes of one change (mm) to it …
RigidJoint altered(const MadePulleys& made, const Mechanism& mechanism, const Dimension& dimension, double change);
/// … and of a change to each of dimensions().
RigidJoint altered(const MadePulleys& made, const Mechanism& mechanism, const std::vector<double>& changes);

/// d/d change of what at() gives, in closed form.
RigidPoint derivative(const RigidJoint& joint, const Dimension& dimension, double alpha);

}  // namespace fusee
