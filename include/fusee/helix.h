/// \file
/// Multi-turn pulleys: both pitch curves as spirals.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "fusee/profile.h"
#include "fusee/transmission.h"

namespace fusee::helix {

// ---- Spirals --------------------------------------------------------------------------------------------------------
// The pitch curve of a helical groove: the tendon's centre line over several turns.

/// One row of the pitch curve of a helical groove.
struct SpiralRow {
  double x = 0, y = 0;  ///< mm, on the pitch curve (tendon's centre line in plan), pulley frame at home
  double turn = 0;      ///< rad, angle of the outward normal, unrolled over all turns, monotone
  double rho = 0;       ///< mm, radius of curvature in plan, > 0
  double s = 0;         ///< mm, planar arc length from the first row
  double z = 0;         ///< mm, height of the tendon's centre line: linear in s
};

/// The outward normal at a row is (cos turn, sin turn). From one turn to the next, z grows by at least the groove's
/// width, a rib and the step between both radii.
struct Spiral {
  std::vector<SpiralRow> rows;                ///< in growing `turn`, spare turns at both ends included
  double slope = 0;                           ///< tan λ = dz/ds
  std::size_t first_used = 0, last_used = 0;  ///< rows of the working arc, without the spare turns

  /// The row nearest to a height.
  const SpiralRow& row_at(double z) const {
    return *std::min_element(rows.begin(), rows.end(), [z](const SpiralRow& a, const SpiralRow& b) {
      return std::abs(a.z - z) < std::abs(b.z - z);
    });
  }
};

// ---- Synthesis ------------------------------------------------------------------------------------------------------
// Mechanism → both multi-turn pitch curves, each a spiral whose height is linear in its length, or the
// conditions that fail.

/// The axial geometry of one tendon at one place of the stroke.
struct HelixPoint {
  double z = 0;      ///< height of the take-off, in the spiral's frame, mm
  double slope = 0;  ///< slope of the free path's sloping part, rising from the joint's side to the pulley, rad
  double fleet = 0;  ///< fleet angle: between the free path and the groove at the take-off, rad
  double wound = 0;  ///< length wound along the groove since home, positive when more is wound, mm
  double free = 0;   ///< length of the free part, from its end on the joint, mm
};

/// One pulley's spiral, with its sizes and fleet angles.
struct HelixSide {
  Spiral spiral;
  /// Height of the tendon's end on the joint (with collars: of its guide), in the spiral's frame. It minimises the
  /// largest fleet angle over the range. mm
  double attachment_z = 0;
  double turns = 0;                ///< turns of the working arc
  double circumference = 0;        ///< circumference of the shortest turn, mm
  double lead = 0;                 ///< lead of the groove over the shortest turn, mm
  double fleet = 0;                ///< largest |fleet angle|, rad
  double fleet_at = 0;             ///< α of that largest fleet angle, rad
  std::vector<HelixPoint> stroke;  ///< one point for each of HelixSynthesis::stroke
};

/// Result of synthesise_helix(): both spirals, or the failed conditions.
struct HelixSynthesis {
  profile::SynthesisStatus status = profile::SynthesisStatus::infeasible;
  std::array<HelixSide, 2> sides;                       ///< P1, P2
  std::vector<transmission::TransmissionPoint> stroke;  ///< evenly spaced in α over the range, home included
  std::vector<profile::Condition> conditions;
  std::vector<std::string> warnings;
  /// Variation over the range of the tendons' lengths in space, by the formulas that the curves are drawn from. mm
  double closure = 0;

  bool made() const { return status == profile::SynthesisStatus::made; }
};

/// The least axial distance of two neighbouring turns when the later one's radius is larger by `step` (of either sign).
/// mm
using MinLead = std::function<double(double step)>;

/// The cross-section of a mechanism's helical grooves, which the module `helical_solid` defines.
struct HelixGroove {
  double groove_edge = 0;  ///< height of the groove edge over the floor, mm
  /// Sideways play of a tendon at the height of the groove edge, up to the nearer wall, mm.
  double room_at_groove_edge = 0;
  MinLead least_lead;
};

/// The largest number of turns, spare turns excluded.
constexpr double k_most_turns = 12;
/// Fleet angle above which a note is given. rad
constexpr double k_noted_fleet = radians(1.5);
/// Fleet angle above which a warning is given. rad
constexpr double k_warned_fleet = radians(2.0);

/// The accuracy of the curves: as they will be built, or coarse and some ten times faster. The conditions of coarse
/// curves agree with those of fine ones to a thousandth, and convergence of the lengths is not required.
enum class HelixAccuracy { fine, coarse };

/// Computes no advice.
HelixSynthesis synthesise_helix(const Mechanism& mechanism, const HelixGroove& groove,
                                const profile::SynthesisOptions& options = {},
                                HelixAccuracy accuracy = HelixAccuracy::fine);

}  // namespace fusee::helix
