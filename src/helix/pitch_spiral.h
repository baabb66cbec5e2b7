/// \file
/// Internal: one side's pitch curve over all its turns, in the right-hand image of its tendon, in the pulley's frame.
#pragma once

#include <array>
#include <vector>

#include "fusee/helix/spiral.h"
#include "profile/take_off.h"

namespace fusee {

/// A place of the curve, and how much of the tendon lies between it and where the tendon leaves at home.
struct SpiralPoint {
  CurvePoint curve;
  double sigma = 0;  ///< in plan, growing with ψ, mm
};

/// What of a tendon is not wound, in plan.
struct FreePath {
  double whole = 0;    ///< from its end on the joint to the pulley, mm
  double sloping = 0;  ///< of that, what rises: all of it, or with collars what lies below the guide
};

/// Beyond the working arc either end runs on for the spare turns, and becomes a circle about the axis on the way: its
/// normal's distance is p + p' sin u w(u), w falling from 1 to 0. Refers to its take-offs: keep them alive.
class PitchSpiral {
 public:
  /// `lengthening`: q of the side, null for a planar tendon.
  PitchSpiral(const Mechanism& mechanism, const TakeOffs& take_offs, const ChebyshevSeries* lengthening);

  double working_begin() const { return samples_.front().curve.psi; }
  double working_end() const { return samples_.back().curve.psi; }
  double begin() const { return working_begin() - spare_; }
  double end() const { return working_end() + spare_; }
  const std::vector<TakeOff>& samples() const { return samples_; }
  SpiralPoint at_home() const { return {home_.curve, 0.0}; }

  /// Of the working arc and of the spare turns.
  SpiralPoint at(double psi) const;
  /// Of a take-off.
  double sigma(const TakeOff& take_off) const;
  FreePath free_path(const TakeOff& take_off) const;

 private:
  SpiralPoint beyond(double turned, const SpiralPoint& from, double direction) const;
  double lengthened(double alpha) const { return lengthening_ != nullptr ? lengthening_->at(alpha).d0 : 0.0; }

  const TakeOffs& take_offs_;
  const ChebyshevSeries* lengthening_;
  bool collar_;
  double spare_;
  std::vector<TakeOff> samples_;
  TakeOff home_;
};

}  // namespace fusee
