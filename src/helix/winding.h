/// \file
/// Internal: the transmission of both tendons over several turns, with constant tendon lengths in space.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "fusee/helix.h"
#include "helix/pitch_spiral.h"

namespace fusee::helix {

/// The helix of one side.
struct HelixGeometry {
  double slope = 0;          ///< tan λ of the groove
  double below = 0;          ///< height of the take-off at home above the tendon's end on the joint, mm
  double circumference = 0;  ///< length of the shortest turn in plan, mm
  double needed_lead = 0;    ///< least lead over the shortest turn that leaves room for the tightest pair of turns, mm
  double tightest_at = 0;    ///< ψ of the earlier turn of that pair, in the image
};

/// Both wound tendons: the transmission with their sloping paths, and their helices.
struct Windings {
  std::unique_ptr<const transmission::Transmission> transmission;
  std::shared_ptr<const transmission::SlopedPaths> paths;  ///< null if the planar curves cannot be made
  std::array<HelixGeometry, 2> geometry;
  double closure = 0;  ///< by how much the tendons' lengths vary over the range, mm
};

/// +1 (P2) if the take-off rises as the wound length σ of the image grows, −1 (P1) if it falls. On both pulleys, later
/// turns of the spiral are higher.
inline double helix_sign(transmission::Side side) { return transmission::mirror_sign(side); }
/// Rise Δ of the sloping part of a tendon's free path, at the planar wound length σ. mm
inline double rise(const HelixGeometry& geometry, transmission::Side side, double sigma) {
  return geometry.below + helix_sign(side) * geometry.slope * sigma;
}
/// The axial geometry of a tendon at the planar wound length σ. HelixPoint::z is left out.
HelixPoint helix_point(const HelixGeometry& geometry, transmission::Side side, const FreePath& path, double sigma);

/// Finds the law and both helices with which the tendons' lengths in space are constant. Requires that the law's planar
/// curves exist.
Windings wind(const Mechanism& mechanism, const MinLead& least_lead, HelixAccuracy accuracy);

}  // namespace fusee::helix
