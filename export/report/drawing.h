/// \file
/// Drawings to scale: the mechanism with both tendons on their true path, and the pulleys' profiles with dimensions. mm
/// → px.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "export/report/svg.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/synthesis.h"
#include "fusee/solid/pulley.h"

namespace fusee {

/// One tendon at one place of the stroke, in the frame of the mechanism: C → pin → pulley → along the groove to
/// `wound_to`.
///
/// Found on the sampled outline by geometry alone (tangents to circles and polygons), not from the transmission's
/// formulas.
struct TendonTrace {
  Vec2 attachment;               ///< C
  Vec2 onto_pin;                 ///< tangent point of the upper span
  Vec2 off_pin;                  ///< tangent point of the lower span
  Vec2 take_off;                 ///< where it leaves the pulley
  std::vector<Vec2> free_path;   ///< C … take_off, with the arc over the pin
  std::vector<Vec2> wound_path;  ///< take_off … the anchor's end of the active arc
  double free_length = 0;        ///< exact on the pin's arc, mm
  double wound_length = 0;       ///< along the polygon, mm
};

/// Nothing when there is no such path: C or the pulley within the pin's circle, fewer than three points in the outline.
std::optional<TendonTrace> trace_tendon(const Mechanism& mechanism, const Outline& outline, double alpha, double theta);

/// One place of the stroke to draw.
struct Pose {
  double alpha = 0;
  double theta = 0;
};

/// The mechanism at several poses, one figure each, all at one scale. What moves stands in groups of its own (class
/// "joint-link", "pulley", "tendon"), so that a page can move it.
std::vector<Figure> mechanism_figures(const Mechanism& mechanism, const SynthesisResult& synthesis,
                                      const std::vector<Pose>& poses);

/// One pulley of the pair seen along its axis at home: pitch curve (active and closing arc), floor, lip, bore, anchors,
/// dimensions.
Figure profile_figure(const Mechanism& mechanism, const Outline& outline, const Pulley& pulley);

}  // namespace fusee
