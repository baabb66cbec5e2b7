/// \file
/// The pulley as one checked solid: sizes, mesh, anchors and placement.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/analysis.h"
#include "fusee/base.h"
#include "fusee/mechanism.h"
#include "fusee/profile.h"
#include "fusee/transmission.h"

namespace fusee::solid {

// ---- Meshes ---------------------------------------------------------------------------------------------------------
// A triangle mesh as plain values, and measurements of it. mm.

/// Indexed triangles, counter-clockwise seen from outside. A mesh read from a file may have any defect.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Volume by the divergence theorem, mm³; positive when the faces look outward. Indices must be in range.
double enclosed_volume(const TriangleMesh& mesh);
/// Corners of a box parallel to the axes.
struct Bounds {
  Vec3 low, high;
};
/// The smallest box that contains all vertices.
Bounds bounds(const TriangleMesh& mesh);
/// One index for each distinct position (exact equality), with triangles renumbered. Topology checks require a welded
/// mesh.
TriangleMesh weld(const TriangleMesh& mesh);
/// Welds the mesh and removes facets with two equal corners, which rounding of very short edges produces.
TriangleMesh without_collapsed_facets(const TriangleMesh& mesh);
/// Rounds every coordinate to the nearest float, as every mesh format stores it.
TriangleMesh rounded_to_float(TriangleMesh mesh);

/// Checks that a mesh is a solid: finite, indices in range, closed, 2-manifold (edges and vertices), outward, no
/// degenerate or duplicate face, no self-intersection. One Check each, with `where` naming the first faulty facet and
/// its place. Checks that an earlier fault makes impossible are reported as failed, with the reason in `where`.
std::vector<Check> check_mesh(const TriangleMesh& mesh);

/// Closed section at height z as loops: outer ones counter-clockwise, holes clockwise. Empty when the plane misses the
/// mesh.
std::vector<Polygon> section(const TriangleMesh& mesh, double z);
/// The groove floor in a section: its loop of largest area. Throws InputError when there is none.
Polygon outer_loop(const std::vector<Polygon>& loops);

// ---- Layout ---------------------------------------------------------------------------------------------------------
// The body's sizes with every "automatic" resolved. Solid, OpenSCAD, plates and report all read them here.
//
// Bottom to top along z: flange 1 | groove P1 | middle flange | groove P2 | flange 2 | hub. z = 0 is the outer face of
// flange 1. mm, rad. These are the finished part's sizes. The mesh's coordinates are `scale` times them.
//
// In one piece the part is printed on flange 1. In two pieces the middle flange is parted at `z_mate`, and each piece
// is printed on that face: P1 turned over, P2 with its hub up.

/// A point of a groove's cross-section: outward offset from the floor, axial distance from the groove's plane.
struct GroovePoint {
  double offset = 0;
  double dz = 0;
};

/// The nominal circle of a hole that is printed as a polygon (polyhole).
struct RoundHole {
  Vec2 centre = Vec2::Zero();
  double diameter = 0;
};

/// The circle that the sides of a polyhole touch.
RoundHole circle_within(const Polygon& facets);

/// Both halves of a groove's cross-section, from its floor to the groove edge: first {0, 0}, last {depth, half the
/// width}. The half that is above during printing is a ceiling.
struct GrooveWalls {
  std::vector<GroovePoint> below;  ///< towards flange 1
  std::vector<GroovePoint> above;

  double below_width() const { return below.back().dz; }
  double above_width() const { return above.back().dz; }
};

/// Pins that locate P1 and P2 on each other: holes through P1 and into P2. Without pins the bore alone locates them.
struct DowelLayout {
  std::vector<Vec2> places;
  double hole_diameter = 0;  ///< compensated
  double pin_diameter = 0;
  double z_end = 0;    ///< end of the holes' straight walls, in P2
  double ceiling = 0;  ///< height of the cone in which they end; 0: flat
};

/// The bore, with hole compensation.
struct BoreLayout {
  Bore kind = Bore::round;
  double shaft = 0;                 ///< diameter of the shaft, without hole compensation; unused for a horn
  Polygon outline;                  ///< counter-clockwise about the axis, hole compensation included
  std::optional<RoundHole> circle;  ///< circle that the outline's sides touch from outside; set for round bores
  std::size_t arc_points = 0;  ///< number of the outline's first points that lie on one arc about the axis (D, keyway)
  double radius = 0;           ///< radius of the largest circle about the axis that the bore reaches
  std::vector<Polygon> screw_holes;  ///< through holes of a servo horn; with a recess the first is the centre screw's
  double horn_recess = 0;            ///< depth of the horn's pocket from the bottom face; 0: through
  double horn_ceiling = 0;           ///< height of the cone above it, which closes it without a flat ceiling
  int spline_teeth = 0;              ///< teeth of a servo's shaft in the outline; 0: none
};

/// The set screw and its nut, in the hub.
struct SetScrewLayout {
  bool present = false;
  std::string thread;        ///< "M3"
  double hole_diameter = 0;  ///< clearance or tapping diameter, compensated
  double z = 0;              ///< height of its axis, in the hub
  double angle = 0;          ///< direction of its axis about z, rad
  bool nut_trap = false;
  double nut_width = 0;  ///< across flats, compensated
  double nut_thickness = 0;
  double ceiling_slope = 0;  ///< angle of the hole's ceiling above the horizontal, rad
  double nut_distance = 0;   ///< distance from the axis to the middle of the nut
};

/// An automatic feature of the body that is omitted or reduced for lack of space.
struct Omission {
  std::string feature;   ///< "set_screw", "tail_slot_P2", "home_mark" …
  std::size_t note = 0;  ///< index of its text in BodyLayout::notes
};

/// All sizes of the body, as described above.
struct BodyLayout {
  Parts parts = Parts::one;  ///< number of printed parts; never automatic
  double ceiling_slope = 0;  ///< angle of downward faces above the horizontal, rad; 0: they may be flat
  double entry_lean = 0;     ///< angle between the walls of a channel entry and the normal of the groove edge, rad
  double tendon_diameter = 0;
  GrooveWalls p1, p2;
  double groove_depth = 0;
  double flange_thickness = 0;
  double lower_cone = 0;   ///< height of the cone between a groove edge and flange 1, where the flange projects over it
  double middle_cone = 0;  ///< height of the cone under the middle flange
  double upper_cone = 0;   ///< height of the cone under flange 2
  double z_p1 = 0;         ///< plane of groove P1
  double z_middle = 0;     ///< bottom of the middle flange's rim
  double z_mate = 0;       ///< in two parts: boundary of P1 and P2, within the middle flange
  double z_p2 = 0;
  double z_top = 0;       ///< top of flange 2
  double z_hub = 0;       ///< top of the hub (= z_top without one)
  double hub_radius = 0;  ///< 0: no hub
  BoreLayout bore;
  SetScrewLayout set_screw;
  double channel_width = 0;              ///< width of the tie-off channels
  double channel_fillet = 0;             ///< radius at which a channel leaves the floor's tangent, to its centre line
  double pocket_radius = 0;              ///< radius of the knot pockets
  double channel_ceiling = 0;            ///< rise of the channels' ceilings towards their outer walls; 0: flat
  double pocket_ceiling = 0;             ///< rise of the ceilings of P1's pockets where they open on the bed
  double min_wall = 0;                   ///< thickness of the thinnest wall allowed
  double elephant_foot = 0;              ///< width of the chamfer at the bed
  DowelLayout dowels;                    ///< of a part in two pieces
  double mark_depth = 0;                 ///< depth of engraved marks; raised marks have the height that the file gives
  double scale = 1;                      ///< all x, y, z of the mesh are times this: 1/(1 − shrinkage)
  std::vector<std::string> notes;        ///< reductions and omissions of "automatic" features, with reasons
  std::vector<Omission> omissions = {};  ///< those of `notes` about features that another number could bring back

  /// Records an omission with its note.
  void omit(std::string feature, std::string note);
  /// True if the feature was omitted or reduced.
  bool lacks(std::string_view feature) const;
};

/// Height of a chamfer or ceiling of this width that prints without support, mm.
double rise_of(const BodyLayout& layout, double width);
/// Slope of two ceilings that meet in a ridge over a slit, rad.
double ridge_slope(const BodyLayout& layout);

/// Resolves all sizes. Explicit numbers are kept (make_pulley reports impossible ones) and automatic ones are made to
/// fit.
BodyLayout resolve_layout(const Mechanism& mechanism, const profile::SynthesisResult& synthesis);

// ---- Pulley ---------------------------------------------------------------------------------------------------------
// Two pitch curves → one compound body, as a mesh.

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

  /// Closed outline in the plane of the face.
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
  transmission::Side side = transmission::Side::left;
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
  std::vector<Polygon> loops;  ///< loops[0] is the outline, the others are its holes
  bool on_top = true;          ///< else on the face on the bed
  bool shows_home = false;     ///< the home mark (top) or the clocking mark (below), in the home direction
};

/// Radius of the knot pocket, or of the countersink, mm.
double pocket_radius(const Anchor& anchor, const BodyLayout& layout);

/// P1 or P2 where they are printed separately, in print orientation: the mating face at z = 0, the axis at the origin.
struct PrintedPart {
  transmission::Side side = transmission::Side::left;
  TriangleMesh mesh;           ///< coordinates are floats already
  double expected_volume = 0;  ///< mm³
  int expected_euler = 0;
  std::vector<Check> mesh_checks = {};  ///< check_mesh() of `mesh`
};

/// Outcome: all conditions hold, or not.
enum class PulleyStatus { made, impossible };

/// Result of make_pulley(): the solid, or the conditions that fail.
struct Pulley {
  PulleyStatus status = PulleyStatus::impossible;
  BodyLayout layout;
  TriangleMesh mesh;               ///< the whole pulley; coordinates are floats already
  std::vector<PrintedPart> parts;  ///< P1 and P2 of a pulley in two parts; empty: the whole is printed in one
  std::vector<Anchor> anchors;
  std::vector<Mark> marks;                     ///< engraved, or raised
  std::vector<profile::Condition> conditions;  ///< walls, bore, pockets …, including those that hold
  double expected_volume = 0;                  ///< exact volume of the discretised part, by areas of sections, mm³
  int expected_euler = 0;                      ///< V − E + F
  std::vector<Check> mesh_checks;              ///< check_mesh() of `mesh`

  bool made() const { return status == PulleyStatus::made; }
  bool has_home_mark() const;  ///< on the top face
  /// Summary: the result, or the failed conditions.
  std::string brief() const;
};

/// Size of the finished pulley: the smallest cylinder about its axis that contains it, mm.
struct OuterSize {
  double diameter = 0;
  double height = 0;
};
OuterSize outer_size(const Pulley& pulley);
/// Diameter of a mesh about the z axis, mm; 0 without vertices.
double diameter_about_axis(const TriangleMesh& mesh);

/// The parts to print: the whole, or P1 and P2 side by side.
TriangleMesh plate_of(const Pulley& pulley);

/// Effort of the search for printable tie-offs. A thorough search finds everything that a brief one finds.
enum class TieOffSearch { thorough, brief };

/// Makes the solid on both outlines of `synthesis`, which must be made. What does not fit is a failed condition.
Pulley make_pulley(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                   TieOffSearch search = TieOffSearch::thorough);

/// The conditions of a body on these curves that fail. Makes no mesh.
std::vector<profile::Condition> body_obstacles(const Mechanism& mechanism, const profile::SynthesisResult& synthesis);
/// The conditions of curves and body that fail.
std::vector<profile::Condition> obstacles(const Mechanism& mechanism);
/// True for a number of the body that the file sets and that is used. Changing an automatic number is no advice, and 0
/// means "automatic", not a small number.
bool is_written(const Mechanism& mechanism, std::string_view key);
/// Changes that would make a rejected mechanism possible: numbers of the joint or the body, another screw size, or a
/// written value left automatic. `judge` tries each. Printing in `refused` parts is excluded, because it was tried
/// already.
profile::Advice body_advice(const Mechanism& mechanism, const profile::FeasibilityOracle& judge = {obstacles},
                            Parts refused = Parts::automatic);

/// Checks of a mesh of this pulley (usually one read back from a file): check_mesh, then Euler number, volume,
/// deviation from the analytic surface within `chord_error_mm`, thinnest wall, groove depth and width.
std::vector<Check> check_pulley(const TriangleMesh& mesh, const Mechanism& mechanism,
                                const profile::SynthesisResult& synthesis, const Pulley& pulley, double chord_error_mm);
/// Checks of one part of two: check_mesh, Euler number and volume.
std::vector<Check> check_printed_part(const TriangleMesh& mesh, const PrintedPart& part);

// ---- Hold of the tendons --------------------------------------------------------------------------------------------
// How the tendons are held on the pulley: the tension that the wrap leaves at each knot, compared with the knot's
// strength. N, rad.

/// Largest safe fraction of a knot's strength. Above it, varying loads wear the knot out. Rope makers require a factor
/// of 2 or more on static loads alone.
inline constexpr double k_safe_knot_share = 0.5;

/// The knot of one tendon on its pulley at its largest load: over the stroke, in both directions of motion, with and
/// without the declared load.
struct KnotHold {
  transmission::Side side = transmission::Side::left;
  double alpha = 0;
  double wrap_left = 0;  ///< wrap between take-off and tie-off at `alpha`
  double tension = 0;    ///< tension of the tendon between pulley and pin at `alpha`
  double at_knot = 0;    ///< tension · e^(−μ · wrap_left), the capstan equation with pulley.friction
};

/// Load of all knots.
struct Holding {
  std::vector<KnotHold> knots;                 ///< one for each tied tendon
  std::optional<analysis::Strength> strength;  ///< strength of the tendon, if known
  std::vector<std::string> warnings;
  std::vector<analysis::StrokePoint> loaded;  ///< the declared load's cycle at each place of the synthesis' stroke

  /// Tension at the knot as a fraction of its strength; empty if the strength is unknown.
  std::optional<double> share(const KnotHold& knot) const;
};

/// Requires a pulley that was made. Each warning lists changes with which all knots bear at most half of their
/// strength. Each listed change was tried.
Holding tendon_holding(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const Pulley& pulley);

// ---- Placement of a moved part --------------------------------------------------------------------------------------
// Finds the position of a pulley in a mesh that was moved: grooves, axis, turn and side, from the mesh alone.

/// The largest loop of the section at height z, counter-clockwise for either face orientation. Empty when the plane
/// misses the part.
std::optional<Polygon> outline_at(const TriangleMesh& mesh, double z);

/// A groove found by find_grooves().
struct GrooveInMesh {
  double z = 0;   ///< middle of its floor
  Polygon floor;  ///< in the coordinates of the mesh
};
/// The grooves that run round the z axis, from below: heights at which the part is thinner than above and below by at
/// least `least_depth` times its radius. `step`: sampling distance, less than half a groove's width.
std::vector<GrooveInMesh> find_grooves(const TriangleMesh& mesh, double least_depth, double step);

/// The groove floors of a pulley about its axis at home, mm. An empty floor is not searched for.
struct GrooveFloors {
  Polygon p1;
  Polygon p2;
};
/// Distance between two outlines in their present positions, mm: rms of the distances between parallel tangents,
/// without the worst quarter (channels cut outlines).
double outline_deviation(const GrooveFloors& found, const GrooveFloors& expected);

/// A groove, and the pulley that it was recognised as.
struct PlacedGroove {
  transmission::Side side = transmission::Side::left;
  double z = 0;   ///< in the mesh
  Polygon floor;  ///< returned to the axis, at home
};

/// A transformation: optionally turned over about the x axis, then turned, then moved.
struct Placement {
  std::vector<PlacedGroove> grooves;  ///< P1 and P2, or the only groove
  Vec2 axis = Vec2::Zero();           ///< position in the mesh; the bore's, if there is one
  double turn = 0;                    ///< about the axis, counter-clockwise from +z, rad
  bool tells_turn = true;             ///< false for round outlines, with `turn` 0
  bool turned_over = false;
  double deviation = 0;      ///< of the floors, as outline_deviation() defines it
  double bore_off_axis = 0;  ///< distance of the bore from the axis of the floors, mm; 0: none, or no bore
};

/// found: recognised; unknown: another part; mirrored, scaled: the part, but not as drawn.
enum class PlacementStatus { found, unknown, mirrored, scaled };

/// Result of find_placement().
struct PlacementResult {
  PlacementStatus status = PlacementStatus::unknown;
  Placement placement;  ///< for a mirrored part: of its mirror image
  double scale = 1;     ///< size of the part relative to the expected one
};

/// The connected components of a mesh, in the order of their first facets.
std::vector<TriangleMesh> bodies_of(const TriangleMesh& mesh);

/// Searches for the pulley with these floors, or for one of the two when the mesh has one groove. The deviation must be
/// below 2 % of the radius, for a mirrored or scaled part below 0.1 %. If two placements fit equally well, the one not
/// turned over is chosen. A single groove looks the same mirrored and turned over, so it is never reported as mirrored.
PlacementResult find_placement(const TriangleMesh& mesh, const GrooveFloors& expected, double tendon_diameter);

}  // namespace fusee::solid
