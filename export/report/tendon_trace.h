/// \file
/// Positions of the mechanism's points at one place of the stroke, and the path of a tendon over them. Frame of the
/// mechanism file (docs/reference/mechanism-file.md), mm.
#pragma once

#include <optional>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/outline.h"

namespace fusee {

/// G.
Vec2 pulley_axis(const Mechanism& mechanism);
/// B or D.
Vec2 pin_centre(const Mechanism& mechanism, Side side);
/// Where its sheath ends, beside the pulley; what a tendon comes to its pulley from. There must be a sheath.
Vec2 sheath_mouth(const Mechanism& mechanism, Side side);
/// A sheath as it is drawn: from the pin's outer side, straight down, to its mouth. Nobody knows its way, and its
/// length is the file's.
std::vector<Vec2> sheath_curve(const Mechanism& mechanism, Side side);
/// Where a tendon ends: C, or its own attachment.
Vec2 attachment(const Mechanism& mechanism, Side side, double theta);

/// One tendon at one place of the stroke, in the frame of the mechanism: C → pin → pulley → along the groove to
/// `wound_to`.
///
/// Found on the sampled outline by geometry alone (tangents to circles and polygons), not from the transmission's
/// formulas.
struct TendonTrace {
  Vec2 attachment;               ///< C, or the tendon's own
  Vec2 onto_pin;                 ///< tangent point of the upper span
  Vec2 off_pin;                  ///< tangent point of the lower span, or where it goes into its sheath
  Vec2 take_off;                 ///< where it leaves the pulley
  std::vector<Vec2> free_path;   ///< attachment … take_off, with the arcs over drum and pin, through its sheath
  std::vector<Vec2> wound_path;  ///< take_off … the anchor's end of the active arc
  double free_length = 0;        ///< exact on the pin's arc, with the sheath's own length, mm
  double wound_length = 0;       ///< along the polygon, mm
};

/// Nothing when there is no such path: C or the pulley within the pin's circle, fewer than three points in the outline.
std::optional<TendonTrace> trace_tendon(const Mechanism& mechanism, const Outline& outline, double alpha, double theta);

}  // namespace fusee
