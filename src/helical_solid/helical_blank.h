/// \file
/// Internal: the body before cuts, as one structured grid closed by flat faces, bore and hub.
#pragma once

#include "fusee/base.h"
#include "fusee/solid.h"
#include "fusee/transmission.h"
#include "helical_solid/winding.h"

namespace fusee::helical_solid {

/// Heights of the rings that bound the grooves, mm. The lowest ring, at height 0, is chamfered.
struct RingHeights {
  double lower = 0;    ///< lower ring of the middle flange
  double upper = 0;    ///< its upper ring; a cone joins both where P2 projects over P1
  double top = 0;      ///< ring of the upper face
  double hub_top = 0;  ///< top of the hub; equal to `top` without a hub
};

/// Outline of the lower face (P1) or the upper face (P2).
Polygon rim_of(const Fan& fan, transmission::Side side, double groove_edge);

/// Largest projection of the middle flange's upper ring over its lower one, mm. The cone between them supports it.
double middle_step(const Fan& fan, double groove_edge);

/// The closed mesh of the body before cuts, in mm of the finished part, not scaled and not rounded to float.
solid::TriangleMesh helical_blank(const Fan& fan, const HelicalSection& section, const solid::BodyLayout& layout,
                                  const RingHeights& heights);

}  // namespace fusee::helical_solid
