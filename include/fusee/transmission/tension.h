/// \file
/// The paper's chain of forces at one place of the stroke: T2 [6], φ [8], T_b [7], Δ [9], Δθ [10],[11].
#pragma once

#include "fusee/transmission/transmission.h"

namespace fusee {

struct PaperForces {
  double gamma2 = 0;       ///< angle between OC and tendon 2, rad
  double T2 = 0;           ///< above the pin: F_c / sin γ2 [6], N
  double phi = 0;          ///< turning over pin D [8], rad
  double Tb = 0;           ///< below the pin: T2 e^{μφ} [7], N
  double elongation = 0;   ///< Δ = T L/(A E) of both spans [9], mm
  double theta_error = 0;  ///< Δθ that Δ makes at the joint [10],[11], rad
};

PaperForces paper_forces(const Mechanism& mechanism, const TransmissionPoint& point);

}  // namespace fusee
