/// \file
/// The paper's chain of forces at one point of the stroke: T2 [6], φ [8], T_b [7], Δ [9], Δθ [10],[11].
///
/// One tendon carries the load and the other is slack, without pretension. equilibrium.h has the full model.
#pragma once

#include "fusee/transmission/transmission.h"

namespace fusee {

struct PaperForces {
  double gamma1 = 0;      ///< angle at C between OC and tendon 1, rad
  double gamma2 = 0;      ///< angle at C between OC and tendon 2, rad
  double T1 = 0;          ///< tension above pin B, where the load pulls towards +θ, N
  double T2 = 0;          ///< tension above pin D: F_c / sin γ2 [6], N
  double phi = 0;         ///< wrap on pin D [8], rad
  double Tb = 0;          ///< tension of the loaded tendon below its pin: T e^{μφ} [7], N
  double elongation = 0;  ///< elongation of the loaded tendon: Δ = T L/(A E) of both spans [9], mm
  /// Joint rotation under load due to Δ [10],[11], rad; negative where the load pulls towards +θ.
  double theta_error = 0;
  double motor_torque = 0;  ///< torque about G, towards +α: T_b r2, N·mm
  double stiffness = 0;     ///< torsional stiffness implied by [9]-[11]: EA m²/L of the loaded tendon, N·mm/rad
};

/// The load is load_torque(): the tip force as in the paper, or any equivalent torque.
PaperForces paper_forces(const Mechanism& mechanism, const TransmissionPoint& point);

}  // namespace fusee
