/// \file
/// Internal: positions of the mechanism's points at one pose of the stroke, and the path of a tendon over them. Frame
/// of the mechanism file (docs/reference/mechanism-file.md), mm.
#pragma once

#include <optional>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"
#include "fusee/profile.h"

namespace fusee::formats {

/// The axis G.
Vec2 pulley_axis(const Mechanism& mechanism);
/// The pin B or D.
Vec2 pin_centre(const Mechanism& mechanism, transmission::Side side);
/// Exit of a tendon's sheath beside the pulley. Requires a sheath.
Vec2 sheath_exit(const Mechanism& mechanism, transmission::Side side);
/// The curve of a sheath in drawings: from the pin's outer side, straight down, to its exit. Its true course is
/// unknown, and its length in the file is another.
std::vector<Vec2> sheath_curve(const Mechanism& mechanism, transmission::Side side);
/// The end of a tendon: C, or its own attachment.
Vec2 attachment(const Mechanism& mechanism, transmission::Side side, double theta);

/// One tendon at one place of the stroke, in the frame of the mechanism: C → pin → pulley → along the groove to
/// the anchor's end of the active arc.
///
/// Computed on the sampled outline by geometry alone (tangents to circles and polygons), independently of the
/// transmission's formulas.
struct TendonTrace {
  Vec2 attachment;               ///< C, or the tendon's own attachment
  Vec2 onto_pin;                 ///< tangent point of the upper span
  Vec2 off_pin;                  ///< tangent point of the lower span, or the entrance of the sheath
  Vec2 take_off;                 ///< take-off from the pulley
  std::vector<Vec2> free_path;   ///< attachment … take_off, with the arcs over drum and pin, through its sheath
  std::vector<Vec2> wound_path;  ///< take_off … the anchor's end of the active arc
  double free_length = 0;        ///< exact on the pin's arc, with the sheath's own length, mm
  double wound_length = 0;       ///< along the polygon, mm
};

/// Empty if there is no such path: C or the pulley within the pin's circle, or fewer than three points in the outline.
std::optional<TendonTrace> trace_tendon(const Mechanism& mechanism, const profile::Outline& outline, double alpha,
                                        double theta);

}  // namespace fusee::formats
