/// \file
/// One side's closed pitch curve as a function of its normal direction.
#pragma once

#include <memory>
#include <vector>

#include "profile/closing_arc.h"
#include "profile/take_off.h"

namespace fusee::profile {

/// A groove floor with a smaller radius is an edge, not a seat. mm
inline constexpr double k_least_floor_radius = 0.05;

/// Convex, closed, in the right-hand image of its side.
class PitchCurve {
 public:
  virtual ~PitchCurve() = default;
  /// Point with normal direction ψ, any angle.
  virtual CurvePoint at(double psi) const = 0;
  /// The radius of at(psi), possibly at lower cost.
  virtual double radius(double psi) const { return at(psi).radius; }
  /// Normal directions at the ends of the active arc; end > begin, less than a turn apart.
  virtual double active_begin() const = 0;
  virtual double active_end() const = 0;
  /// Directions at which the curve is straight; samples are placed on both sides of each.
  virtual std::vector<double> straight_directions() const { return {}; }
};

/// method = "exact": the envelope of the tendon's lines and a closing arc. Keeps references to its arguments.
class EnvelopeCurve : public PitchCurve {
 public:
  /// `samples`: take-offs over the whole range, with increasing joint angle of the image and increasing ψ. `straight`:
  /// ψ of the active arc's straight parts.
  EnvelopeCurve(const TakeOffs& take_offs, const std::vector<TakeOff>& samples, const ClosingArc& closing,
                std::vector<double> straight);

  CurvePoint at(double psi) const override;
  double radius(double psi) const override;
  double active_begin() const override { return samples_.front().curve.psi; }
  double active_end() const override { return samples_.back().curve.psi; }
  std::vector<double> straight_directions() const override { return straight_; }

 private:
  /// `psi` shifted by full turns to the active arc, or the closing arc that follows it.
  double turned(double psi) const;
  bool is_active(double turned) const;
  CurvePoint active_at(double psi) const;

  const TakeOffs& take_offs_;
  const std::vector<TakeOff>& samples_;
  const ClosingArc& closing_;
  std::vector<double> straight_;
};

/// `psi` shifted by full turns into [start, start + 2π).
double turned_into(double start, double psi);

}  // namespace fusee::profile
