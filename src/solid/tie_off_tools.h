/// \file
/// Internal: volumes that tie-offs remove from the body. mm, not yet scaled.
#pragma once

#include "fusee/solid.h"
#include "solid/channel_entries.h"
#include "solid/plan.h"

namespace fusee::solid {

/// Channel and knot pocket, with the pocket open to the nearest face, or the slot to the face. Each `variant` has
/// different facets.
TriangleMesh tie_off_tool(const BodyPlan& plan, const PlannedAnchor& anchor, int variant);
/// Plan view of the slot to the face.
Polygon hole_outline(const FaceHole& hole, int variant);

/// The tail's slot, open to the face. To be subtracted from a body that has its tie-off.
TriangleMesh tail_slot_tool(const BodyLayout& layout, transmission::Side side, const TailSlot& slot);
/// The pilot hole of the clamp screw, open to the face. It is wider than the slot, which ends at its centre.
TriangleMesh clamp_pilot_tool(const BodyLayout& layout, transmission::Side side, const TailSlot& slot);

/// True if the pockets of this side open at the face on the bed, where nothing supports overhangs.
bool is_pocket_face_on_bed(const BodyLayout& layout, transmission::Side side);

/// Distance from the groove's plane to a channel's floor.
double channel_half_height(const BodyLayout& layout, int variant);

/// Shifts a path slightly, so that no edge coincides with one of another variant.
AnchorPath varied(AnchorPath path, int variant);

/// The plan view of a channel as it is cut.
ChannelEdges channel_edges(const BodyPlan& plan, transmission::Side side, const AnchorPath& path);

}  // namespace fusee::solid
