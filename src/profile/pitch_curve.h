/// \file
/// One side's closed pitch curve as a function of the direction of its normal.
#pragma once

#include <memory>
#include <vector>

#include "profile/closing_arc.h"
#include "profile/take_off.h"

namespace fusee {

/// A groove floor that bends more sharply is an edge, not a seat. mm
inline constexpr double k_least_floor_radius = 0.05;

/// Convex, closed, in the right-hand image of its side.
class PitchCurve {
 public:
  virtual ~PitchCurve() = default;
  /// At any ψ.
  virtual CurvePoint at(double psi) const = 0;
  /// at(psi).radius, which may be had for less.
  virtual double radius(double psi) const { return at(psi).radius; }
  /// Normals at the ends of the active arc; end > begin, less than a turn apart.
  virtual double active_begin() const = 0;
  virtual double active_end() const = 0;
  /// Directions at which the curve runs straight: samples stand on both sides of each.
  virtual std::vector<double> straight_directions() const { return {}; }
};

/// method = "exact": the envelope of the tendon's lines, closed by an arc. Refers to what it is given: keep it alive.
class EnvelopeCurve : public PitchCurve {
 public:
  /// `samples`: take-offs by increasing joint angle of the image, over the whole range, ψ increasing. `straight`: ψ of
  /// the active arc's straight pieces.
  EnvelopeCurve(const TakeOffs& take_offs, const std::vector<TakeOff>& samples, const ClosingArc& closing,
                std::vector<double> straight);

  CurvePoint at(double psi) const override;
  double radius(double psi) const override;
  double active_begin() const override { return samples_.front().curve.psi; }
  double active_end() const override { return samples_.back().curve.psi; }
  std::vector<double> straight_directions() const override { return straight_; }

 private:
  double turned(double psi) const;
  bool is_active(double turned) const;
  CurvePoint active_at(double psi) const;

  const TakeOffs& take_offs_;
  const std::vector<TakeOff>& samples_;
  const ClosingArc& closing_;
  std::vector<double> straight_;
};

/// `psi` turned by full turns into [start, start + 2π).
double turned_into(double start, double psi);

}  // namespace fusee
