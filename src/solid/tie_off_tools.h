/// \file
/// What is cut out of the body for a tie-off. mm, not yet scaled.
#pragma once

#include "fusee/solid/mesh.h"
#include "solid/mouths.h"
#include "solid/plan.h"

namespace fusee {

/// Channel and knot pocket, the pocket open to the nearest face, or the slot to the face. Another `variant` has other
/// facets.
TriangleMesh tie_off_tool(const BodyPlan& plan, const PlannedAnchor& anchor, int variant);
Polygon hole_outline(const FaceHole& hole, int variant);

/// Open to the face, out of a body that has its tie-off …
TriangleMesh tail_slot_tool(const BodyLayout& layout, Side side, const TailSlot& slot);
/// … and open to the face too: it is wider than the slot, which ends at its middle.
TriangleMesh clamp_pilot_tool(const BodyLayout& layout, Side side, const TailSlot& slot);

/// Does the face that this pulley's pockets open on lie on the printer's bed, with nothing to support what hangs over
/// it?
bool on_bed(const BodyLayout& layout, Side side);

/// From the groove's plane to a channel's floor.
double channel_half_height(const BodyLayout& layout, int variant);

/// Moved a little, so that no edge of another variant lies where one of this did.
AnchorPath varied(AnchorPath path, int variant);

/// A channel as it is cut, seen along the axis.
ChannelEdges channel_edges(const BodyPlan& plan, Side side, const AnchorPath& path);

}  // namespace fusee
