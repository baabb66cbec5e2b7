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

/// Where a knot lies that is drawn against the outer face of its pulley.
struct FaceSeat {
  double radius = 0;         ///< of the countersink at the face, mm
  double depth = 0;          ///< over which it narrows to the slot
  double z = 0;              ///< of the face
  Vec2 hole = Vec2::Zero();  ///< middle of the slot's round end, at the floor
  double length = 0;         ///< from there outwards to where the slot has left the flange
};

/// A straight slot in the face, from the knot's pocket outwards: the tail lies flush in it, under a screw's head at its
/// end where one is asked for. mm
struct TailSlot {
  Vec2 from;
  Vec2 to;
  double width = 0;
  double depth = 0;           ///< of its walls
  double roof = 0;            ///< height of the gable over them where the face lies on the printer; 0: flat
  double pilot_diameter = 0;  ///< of the hole that the screw's thread is cut into, at `to`; 0: no screw
  double pilot_depth = 0;     ///< below the face
  double head_diameter = 0;

  Polygon outline() const;
  double head_or_width() const { return head_diameter > width ? head_diameter : width; }
};

/// How a channel runs: an arc about `centre`, whose radius its centre line has, and then straight to its pocket.
struct ChannelBend {
  Vec2 centre;
  double radius = 0;
  Vec2 heading;            ///< along the straight, to the pocket
  double straight = 0;     ///< how long that is
  double half_height = 0;  ///< to both sides of the groove's plane
};

/// One tie-off: the tendon leaves the groove floor tangentially through a channel that turns inward to a knot pocket,
/// or through a slot of the outer flange to its face.
struct Anchor {
  Side side = Side::left;
  bool wound_end = true;  ///< the end that carries load; false: the spare one at the other end of the arc
  Vec2 exit;              ///< where the channel's centre line leaves the floor, mm
  Polygon channel;        ///< outline of the channel in the groove's plane, or of the slot in the flange, ccw
  Polygon mouth;          ///< the channel as it is cut, opened towards the groove, for a print without supports
  Vec2 pocket;            ///< centre of the knot pocket, or of the countersink
  std::optional<ChannelBend> bend = {};  ///< of a channel
  std::optional<FaceSeat> seat = {};     ///< of a tie-off through the face
  std::optional<TailSlot> tail = {};
};

/// A letter or a sign on a face.
struct Mark {
  std::vector<Polygon> loops;  ///< loops[0] without the others
  bool on_top = true;          ///< else on the face on the bed
};

/// Of the knot pocket, or of the countersink, mm.
double pocket_radius(const Anchor& anchor, const BodyLayout& layout);

/// P1 or P2 where they are printed apart: as it lies on the printer, the face that meets the other at z = 0, the axis
/// at the origin.
struct PrintedPart {
  Side side = Side::left;
  TriangleMesh mesh;           ///< coordinates are floats already
  double expected_volume = 0;  ///< mm³
  int expected_euler = 0;
  std::vector<Check> mesh_checks = {};  ///< check_mesh() of it
};

enum class PulleyStatus { made, impossible };

struct Pulley {
  PulleyStatus status = PulleyStatus::impossible;
  BodyLayout layout;
  TriangleMesh mesh;               ///< the whole; coordinates are floats already
  std::vector<PrintedPart> parts;  ///< P1 and P2 of a pulley in two parts; empty: the whole is printed as it stands
  std::vector<Anchor> anchors;
  std::vector<Mark> marks;            ///< engraved, or raised
  std::vector<Condition> conditions;  ///< walls, bore, pockets: all, those that hold too
  double expected_volume = 0;         ///< exact volume of the discretised part, by areas of sections, mm³
  int expected_euler = 0;             ///< V − E + F
  std::vector<Check> mesh_checks;     ///< check_mesh() of `mesh`

  bool made() const { return status == PulleyStatus::made; }
  std::string brief() const;
};

/// What goes to the printer: the whole as it stands, or P1 and P2 side by side.
TriangleMesh plate_of(const Pulley& pulley);

/// How long tie-offs are sought that print. What a brief search finds a thorough one finds too.
enum class TieOffSearch { thorough, brief };

Pulley make_pulley(const Mechanism& mechanism, const SynthesisResult& synthesis,
                   TieOffSearch search = TieOffSearch::thorough);

/// The conditions of a body on these curves that do not hold. Makes no mesh.
std::vector<Condition> body_obstacles(const Mechanism& mechanism, const SynthesisResult& synthesis);
/// The same of curves and body.
std::vector<Condition> obstacles(const Mechanism& mechanism);
/// A number of the body that was written and is used: a change of what is automatic would be no advice, and 0 is not a
/// small number but "automatic".
bool is_written(const Mechanism& mechanism, std::string_view key);
/// What would make a refused mechanism possible: numbers of the joint or written for the body, screws of another size,
/// what is written left to the program. Each was tried, as `judge` says; but for printing it in `refused` parts, which
/// did not do.
Advice body_advice(const Mechanism& mechanism, const FeasibilityOracle& judge = {obstacles},
                   Parts refused = Parts::automatic);

/// What a mesh of this pulley must be, measured on `mesh` (usually one read back from a file): check_mesh, then Euler
/// number, volume, deviation from the analytic surface within `tolerance`, smallest wall, groove depth and width.
std::vector<Check> check_pulley(const TriangleMesh& mesh, const Mechanism& mechanism, const SynthesisResult& synthesis,
                                const Pulley& pulley, double tolerance);
/// The same of one part of two: check_mesh, Euler number and volume.
std::vector<Check> check_printed_part(const TriangleMesh& mesh, const PrintedPart& part);

}  // namespace fusee
