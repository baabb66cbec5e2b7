/// \file
/// Two pitch curves → one compound body, as a mesh.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/solid/layout.h"
#include "fusee/solid/mesh.h"

namespace fusee {

/// The seat of a knot that is pulled against the outer face of its pulley.
struct FaceSeat {
  double radius = 0;         ///< radius of the countersink at the face, mm
  double depth = 0;          ///< depth over which it narrows to the slot
  double z = 0;              ///< height of the face
  Vec2 hole = Vec2::Zero();  ///< centre of the slot's round end, at the floor
  double length = 0;         ///< length from there outwards to the rim
};

/// A straight slot in the face, from the knot's pocket outwards, in which the tail lies flush. A clamp screw's head may
/// hold it at its end. mm
struct TailSlot {
  Vec2 from;
  Vec2 to;
  double width = 0;
  double depth = 0;           ///< depth of its walls
  double ceiling = 0;         ///< height of the peaked ceiling above them if the face is on the bed; 0: flat
  double pilot_diameter = 0;  ///< diameter of the hole for the screw's thread, at `to`; 0: no screw
  double pilot_depth = 0;     ///< depth below the face
  double head_diameter = 0;

  Polygon outline() const;
  double head_or_width() const { return head_diameter > width ? head_diameter : width; }
};

/// The path of a channel: an arc of the centre line about `centre`, then a straight to the pocket.
struct ChannelBend {
  Vec2 centre;
  double radius = 0;
  Vec2 heading;            ///< direction of the straight, to the pocket
  double straight = 0;     ///< length of the straight
  double half_height = 0;  ///< on both sides of the groove's plane
};

/// One tie-off. The tendon leaves the groove floor tangentially through a channel that turns inward to a knot pocket,
/// or through a slot of the outer flange to its face.
struct Anchor {
  Side side = Side::left;
  bool wound_end = true;  ///< the end that carries load; false: the spare one at the other end of the arc
  Vec2 exit;              ///< where the channel's centre line leaves the floor, mm
  Polygon channel;        ///< outline of the channel in the groove's plane, or of the slot in the flange, ccw
  Polygon entry;          ///< the channel as it is cut, widened at its entry so that it prints without support
  Vec2 pocket;            ///< centre of the knot pocket, or of the countersink
  std::optional<ChannelBend> bend = {};  ///< for a channel
  std::optional<FaceSeat> seat = {};     ///< for a tie-off through the face
  std::optional<TailSlot> tail = {};
};

/// A letter or a sign on a face.
struct Mark {
  std::vector<Polygon> loops;  ///< loops[0] without the others
  bool on_top = true;          ///< else on the face on the bed
};

/// Radius of the knot pocket, or of the countersink, mm.
double pocket_radius(const Anchor& anchor, const BodyLayout& layout);

/// P1 or P2 where they are printed separately, in print orientation: the mating face at z = 0, the axis at the origin.
struct PrintedPart {
  Side side = Side::left;
  TriangleMesh mesh;           ///< coordinates are floats already
  double expected_volume = 0;  ///< mm³
  int expected_euler = 0;
  std::vector<Check> mesh_checks = {};  ///< check_mesh() of `mesh`
};

enum class PulleyStatus { made, impossible };

struct Pulley {
  PulleyStatus status = PulleyStatus::impossible;
  BodyLayout layout;
  TriangleMesh mesh;               ///< the whole pulley; coordinates are floats already
  std::vector<PrintedPart> parts;  ///< P1 and P2 of a pulley in two parts; empty: the whole is printed in one
  std::vector<Anchor> anchors;
  std::vector<Mark> marks;            ///< engraved, or raised
  std::vector<Condition> conditions;  ///< walls, bore, pockets …, including those that hold
  double expected_volume = 0;         ///< exact volume of the discretised part, by areas of sections, mm³
  int expected_euler = 0;             ///< V − E + F
  std::vector<Check> mesh_checks;     ///< check_mesh() of `mesh`

  bool made() const { return status == PulleyStatus::made; }
  std::string brief() const;
};

/// The parts to print: the whole, or P1 and P2 side by side.
TriangleMesh plate_of(const Pulley& pulley);

/// Effort of the search for printable tie-offs. A thorough search finds everything that a brief one finds.
enum class TieOffSearch { thorough, brief };

Pulley make_pulley(const Mechanism& mechanism, const SynthesisResult& synthesis,
                   TieOffSearch search = TieOffSearch::thorough);

/// The conditions of a body on these curves that fail. Makes no mesh.
std::vector<Condition> body_obstacles(const Mechanism& mechanism, const SynthesisResult& synthesis);
/// The conditions of curves and body that fail.
std::vector<Condition> obstacles(const Mechanism& mechanism);
/// True for a number of the body that the file sets and that is used. Changing an automatic number is no advice, and 0
/// means "automatic", not a small number.
bool is_written(const Mechanism& mechanism, std::string_view key);
/// Changes that would make a rejected mechanism possible: numbers of the joint or the body, another screw size, or a
/// written value left automatic. `judge` tries each. Printing in `refused` parts is excluded, because it was tried
/// already.
Advice body_advice(const Mechanism& mechanism, const FeasibilityOracle& judge = {obstacles},
                   Parts refused = Parts::automatic);

/// Checks of a mesh of this pulley (usually one read back from a file): check_mesh, then Euler number, volume,
/// deviation from the analytic surface within `tolerance`, thinnest wall, groove depth and width.
std::vector<Check> check_pulley(const TriangleMesh& mesh, const Mechanism& mechanism, const SynthesisResult& synthesis,
                                const Pulley& pulley, double tolerance);
/// Checks of one part of two: check_mesh, Euler number and volume.
std::vector<Check> check_printed_part(const TriangleMesh& mesh, const PrintedPart& part);

}  // namespace fusee
