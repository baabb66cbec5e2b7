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

/// One place of the stroke to draw.
struct Pose {
  double alpha = 0;
  double theta = 0;
};

/// The mechanism at several poses, one figure each, all at one scale. What moves stands in groups of its own (class
/// "joint-link", "pulley", "tendon"), so that a page can move it.
std::vector<Figure> mechanism_figures(const Mechanism& mechanism, const SynthesisResult& synthesis,
                                      const std::vector<Pose>& poses);

/// The joint at home, large, and its pulley beside it: two figures that moving_joint.js moves. Each has a group
/// "scene" whose data-view is the scale in px/mm and where the frame's origin lies; tendons are groups of their own
/// ("tendon1", "tendon2").
std::vector<Figure> moving_figures(const Mechanism& mechanism, const SynthesisResult& synthesis);

/// One pulley of the pair seen along its axis at home: pitch curve (active and closing arc), floor, lip, bore, anchors,
/// dimensions.
Figure profile_figure(const Mechanism& mechanism, const Outline& outline, const Pulley& pulley);

/// The polar drawing of one pulley, r against α from the direction of the tendon's normal at home, over its exact
/// profile, and what lies between both magnified. The figure of method = "exact"; null for a round pulley, where both
/// are one.
std::optional<Figure> polar_figure(const SynthesisResult& synthesis, Side side);

}  // namespace fusee
