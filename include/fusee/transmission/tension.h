/// \file
/// The paper's chain of forces at one place of the stroke: T2 [6], φ [8], T_b [7], Δ [9], Δθ [10],[11].
///
/// One tendon carries the load, the other is slack; no pretension. equilibrium.h is the full model behind it.
#pragma once

#include "fusee/transmission/transmission.h"

namespace fusee {

struct PaperForces {
  double gamma1 = 0;      ///< angle at C between OC and tendon 1, rad
  double gamma2 = 0;      ///< the same of tendon 2, rad
  double T1 = 0;          ///< above pin B, where the load pulls towards +θ, N
  double T2 = 0;          ///< above pin D: F_c / sin γ2 [6], N
  double phi = 0;         ///< turning over pin D [8], rad
  double Tb = 0;          ///< below the pin of the tendon that carries: T e^{μφ} [7], N
  double elongation = 0;  ///< of the tendon that carries: Δ = T L/(A E) of both spans [9], mm
  double theta_error =
      0;  ///< by how much Δ lets the load turn the joint [10],[11], rad; negative where the load pulls towards +θ
  double motor_torque = 0;  ///< about G, towards +α: T_b r2, N·mm
  double stiffness = 0;     ///< torque per angle that [9]-[11] mean: EA m²/L, of the tendon that carries, N·mm/rad
};

/// The load is what [load] turns the joint with (load_torque): the tip force alone as in the paper, or what acts like
/// one.
PaperForces paper_forces(const Mechanism& mechanism, const TransmissionPoint& point);

}  // namespace fusee
