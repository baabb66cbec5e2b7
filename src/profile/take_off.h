/// \file
/// method = "exact": the point where a tendon leaves its pulley, for each point of the stroke.
///
/// Up to the sampled outline, this module works in the right-hand image of the tendon, in the pulley's frame. P1 is the
/// mirror image (x → −x, α → −α, θ → −θ) of the curve computed for it.
#pragma once

#include "fusee/transmission.h"

namespace fusee::profile {

/// A point of a convex curve by its normal: X = h n + h' t, radius of curvature h + h''. rad, mm.
struct CurvePoint {
  double psi = 0;     ///< direction of the outward normal
  double h = 0;       ///< support: distance of the tangent from the axis
  double dh = 0;      ///< dh/dψ
  double radius = 0;  ///< radius of curvature

  Vec2 position() const { return h * unit(psi) + dh * turned_left(unit(psi)); }
};

/// The take-off point at one point of the stroke.
struct TakeOff {
  transmission::TransmissionPoint stroke;  ///< of the mechanism itself, not of its image
  CurvePoint curve;                        ///< in the image
  double dpsi = 0;                         ///< dψ/dα of the image; must be positive
};

/// The take-off points of one side as a function of the joint angle of its image. Keeps a reference to the
/// transmission.
class TakeOffs {
 public:
  TakeOffs(const transmission::Transmission& transmission, transmission::Side side);

  TakeOff at(double image_theta) const;
  const transmission::TendonPoint& tendon(const TakeOff& take_off) const {
    return side_ == transmission::Side::left ? take_off.stroke.t1 : take_off.stroke.t2;
  }
  transmission::Side side() const { return side_; }
  const transmission::Transmission& transmission() const { return *transmission_; }
  const transmission::PinPlace& place() const { return transmission_->place(side_); }

 private:
  const transmission::Transmission* transmission_;
  transmission::Side side_;
};

}  // namespace fusee::profile
