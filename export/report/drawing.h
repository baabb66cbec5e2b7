/// \file
/// Internal: drawings to scale: the mechanism with both tendons on their true path, and the pulleys' profiles with
/// dimensions. Input is in mm, figures are in px.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "export/report/svg.h"
#include "fusee/mechanism.h"
#include "fusee/profile.h"
#include "fusee/solid.h"

namespace fusee::formats {

/// A position of the mechanism.
struct Pose {
  double alpha = 0;  ///< rad
  double theta = 0;  ///< rad
};

/// The mechanism at several poses, one figure each, all at one scale. Moving parts are groups (class "joint-link",
/// "pulley", "tendon"), so that a page can move them.
std::vector<Figure> mechanism_figures(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                                      const std::vector<Pose>& poses);

/// The joint at home, and its pulley enlarged: two figures that moving_joint.js moves. Each has a group "scene" whose
/// data-view gives the scale in px/mm and the position of the frame's origin. The tendons are the groups "tendon1" and
/// "tendon2".
std::vector<Figure> moving_figures(const Mechanism& mechanism, const profile::SynthesisResult& synthesis);

/// The joint at home with a dimension line for each key of its geometry (R, EB, ED, OE, EF, r1, drum), named like the
/// key numbers beside it. Empty for helical pulleys, which have no outline.
std::optional<Figure> dimension_figure(const Mechanism& mechanism, const profile::SynthesisResult& synthesis);

/// One pulley of the pair seen along its axis at home: pitch curve (active and closing arc), floor, groove edge, bore,
/// anchors, dimensions.
Figure profile_figure(const Mechanism& mechanism, const profile::Outline& outline, const solid::Pulley& pulley);

/// The paper's drawing of one pulley over its exact profile, with the difference magnified. The paper draws r(α) in polar
/// coordinates; α counts from the direction of the tendon's normal at home. Empty for a round pulley, where both are
/// equal.
std::optional<Figure> polar_figure(const profile::SynthesisResult& synthesis, transmission::Side side);

}  // namespace fusee::formats
