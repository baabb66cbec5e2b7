#include "profile/take_off.h"

namespace fusee::profile {

TakeOffs::TakeOffs(const transmission::Transmission& transmission, transmission::Side side)
    : transmission_(&transmission), side_(side) {}

// The pitch curve is the envelope of the tendon's lines. A line lies at the moment arm p from the pulley's axis. It
// touches the guide, which has the radius ρ and lies at the distance c from that axis in direction φ. In the frame of
// the turning pulley the line's normal is ψ(α) = φ − acos((p − ρ)/c) + α. With the reach to the pin,
// w = sqrt(c² − (p − ρ)²):
//   ψ' = 1 + p'/w      w' = −(p − ρ) p'/w      ψ'' = p''/w − p'w'/w²
//   dh/dψ = p'/ψ'      d²h/dψ² = (p'' − dh/dψ ψ'')/ψ'²
TakeOff TakeOffs::at(double image_theta) const {
  const double sign = transmission::mirror_sign(side_);
  TakeOff take_off;
  take_off.stroke = transmission_->at_theta(sign * image_theta);
  const transmission::TendonPoint& at = tendon(take_off);
  const double normal = side_ == transmission::Side::right ? at.lower_normal : k_pi - at.lower_normal;
  const double dp = sign * at.dp;
  const double w = at.lower_reach;
  const double dw = -(at.p - place().lower().rho) * dp / w;
  const double d2psi = at.d2p / w - dp * dw / (w * w);
  take_off.dpsi = 1.0 + dp / w;
  CurvePoint& curve = take_off.curve;
  curve.psi = normal + sign * take_off.stroke.alpha;
  curve.h = at.p;
  curve.dh = dp / take_off.dpsi;
  curve.radius = at.p + (at.d2p - curve.dh * d2psi) / (take_off.dpsi * take_off.dpsi);
  return take_off;
}

}  // namespace fusee::profile
