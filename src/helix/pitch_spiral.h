/// \file
/// Internal: one side's pitch curve over all its turns, in the pulley's frame. The left side is mirrored to a
/// right-hand one, the "image".
#pragma once

#include <array>
#include <vector>

#include "fusee/helix.h"
#include "profile/take_off.h"

namespace fusee::helix {

/// A point of the curve, and the length of the curve between it and the take-off at home.
struct SpiralPoint {
  profile::CurvePoint curve;
  double sigma = 0;  ///< σ: that length in plan, growing with ψ, 0 at home, mm
};

/// Planar lengths of the free part of a tendon.
struct FreePath {
  double whole = 0;    ///< from its end on the joint to the pulley, mm
  double sloping = 0;  ///< the part that rises: all of it, or with collars the part below the guide, mm
};

/// The pitch curve of one side. Beyond the working arc, either end continues for the spare turns and approaches a
/// circle about the axis. At the angle u beyond an end with the support h and its slope h', the support is
/// h + h' sin u w(u), with w falling from 1 to 0. Keeps a reference to the take-offs.
class PitchSpiral {
 public:
  /// `lengthening`: q(α) of the side (transmission::SlopedPaths), null for a planar tendon.
  PitchSpiral(const Mechanism& mechanism, const profile::TakeOffs& take_offs,
              const transmission::ChebyshevSeries* lengthening);

  double working_begin() const { return samples_.front().curve.psi; }
  double working_end() const { return samples_.back().curve.psi; }
  double begin() const { return working_begin() - spare_; }
  double end() const { return working_end() + spare_; }
  const std::vector<profile::TakeOff>& samples() const { return samples_; }
  SpiralPoint at_home() const { return {home_.curve, 0.0}; }

  /// `psi` within the working arc or the spare turns.
  SpiralPoint at(double psi) const;
  /// Wound length at a take-off, relative to home. mm
  double sigma(const profile::TakeOff& take_off) const;
  FreePath free_path(const profile::TakeOff& take_off) const;

 private:
  /// Point of the spare turns at the angle `turned` beyond an end `from` of the working arc. `direction`: +1 with
  /// growing ψ, −1 against it.
  SpiralPoint beyond(double turned, const SpiralPoint& from, double direction) const;
  /// q at the pulley angle α. mm
  double lengthened(double alpha) const { return lengthening_ != nullptr ? lengthening_->at(alpha).d0 : 0.0; }

  const profile::TakeOffs& take_offs_;
  const transmission::ChebyshevSeries* lengthening_;
  bool collar_;   ///< the guides have collars: only the part below the guide slopes
  double spare_;  ///< angle of the spare turns at either end, rad
  std::vector<profile::TakeOff> samples_;
  profile::TakeOff home_;
};

}  // namespace fusee::helix
