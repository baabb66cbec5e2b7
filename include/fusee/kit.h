/// \file
/// The test rig: the parts around a pulley that make a joint for the bench.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"
#include "fusee/profile.h"
#include "fusee/solid.h"

namespace fusee {
struct BearingType;  // mechanism/catalogue.h
struct BoardType;    // mechanism/catalogue.h
struct MotorType;    // mechanism/catalogue.h
}  // namespace fusee

namespace fusee::kit {

// ---- Bodies ---------------------------------------------------------------------------------------------------------
// Bodies of a test rig's parts: stacks of slabs with convex outlines and holes. mm.

/// A disc of the plane.
struct Disc {
  Vec2 centre{0, 0};
  double radius = 0;
};

/// The convex hull of discs: one disc gives a circle, two a slot, four a rectangle with round corners.
struct DiscHull {
  std::vector<Disc> discs;
  int corners = 64;  ///< number of corners of its outline
};
/// A circle.
DiscHull disc(const Vec2& centre, double radius);
/// A slot between two centres, with round ends of the radius `radius`.
DiscHull slot(const Vec2& from, const Vec2& to, double radius);
/// A rectangle whose corners have the radius `radius`.
DiscHull box(const Vec2& low, const Vec2& high, double radius = 0.3);
/// Counter-clockwise outline of the hull, enlarged by `grow` all round. Corner i has the same normal for every `grow`.
Polygon outline_of(const DiscHull& hull, double grow = 0);

/// One contour of a slab, vertical if both growths are equal.
struct SlabLoop {
  DiscHull hull;
  bool hole = false;
  double grow_low = 0;
  double grow_high = 0;
};
/// The loops of a slab must not touch. An identical loop in the slab above continues it; no other may touch it.
struct Slab {
  double low = 0;
  double high = 0;
  std::vector<SlabLoop> loops;
};
/// Slabs from bottom to top without gaps, in print orientation from z = 0.
struct SlabBody {
  std::vector<Slab> slabs;
};

/// Compensation for the effects of printing.
struct PrintTrim {
  double scale = 1;          ///< of all coordinates
  double hole = 0;           ///< added to the diameter of holes
  double elephant_foot = 0;  ///< chamfer at the bed
  double foot_slope = 1;     ///< height of that chamfer over its width
};
/// The body as it is printed: holes are widened so that a polygon's sides touch the nominal circle.
SlabBody trimmed(const SlabBody& body, const PrintTrim& trim);
/// The mesh with coordinates rounded to float.
solid::TriangleMesh mesh_of(const SlabBody& body, double scale = 1);
/// Exact volume of that mesh before rounding. mm³
double volume_of(const SlabBody& body, double scale = 1);

// ---- Kit ------------------------------------------------------------------------------------------------------------
// The test rig: the parts around a pulley that make a joint for the bench, as plain values.
//
// The rig's frame is the mechanism's, with z up from the top of the base plate. From below: motor | base plate |
// tendon 1 at `z_tendon1`, tendon 2 at `z_tendon2`, between collars on the pins | scale plate, over pins and pulley |
// link, on two ball bearings, its post hanging down at C to both tendons | magnet | board | bracket. Of all that moves
// with the link, only the post can meet a pin or the pulley; `conditions` check it. mm, rad

/// A screw's thread, with its holes, head and nut.
struct Thread {
  std::string_view name;
  double diameter = 0;
  double clearance = 0;  ///< diameter of its clearance hole
  double tapping = 0;    ///< diameter of its tapping hole
  double head_radius = 0;
  double nut = 0;  ///< across flats
  double nut_height = 0;
};

/// Diameter of the thinnest rod on sale that is at least this thick: metric, or sixteenths of an inch in an inch file.
/// Beyond the thickest one, `at_least`. mm
double stock_rod(double at_least, LengthUnit units);

/// A guide pin: a bare rod, or a screw in a sleeve.
struct KitPin {
  transmission::Side side = transmission::Side::left;
  Vec2 place{0, 0};
  const Thread* screw = nullptr;  ///< null: the rod itself is the pin
  double radius = 0;              ///< radius on which the tendon runs
  double collar = 0;              ///< outer radius of the collars below and above it
  double gap_low = 0;             ///< heights between which the tendon runs
  double gap_high = 0;
  double top = 0;  ///< highest point of pin, head and collars
};

/// Heights and radii of the rig, resolved.
struct KitSizes {
  const fusee::BearingType* bearing = nullptr;
  const fusee::BoardType* board = nullptr;
  const fusee::MotorType* motor = nullptr;  ///< its mount; null: the catalogue has none with this shaft or horn
  std::string motor_name;                   ///< that the file gives by its model, shaft or horn; "" for none
  /// Threads of the joint's axle, of the rods on the feet, of the screws in the post and the tensioner, and of the cap.
  const Thread *axle = nullptr, *foot = nullptr, *small = nullptr, *cap_screw = nullptr;
  double base = 0;        ///< thickness of the base plate
  double pulley_low = 0;  ///< height of the pulley's lower face
  double pulley_high = 0;
  double pulley_radius = 0;  ///< radius of the circle about its axis that contains its flanges
  double z_tendon1 = 0, z_tendon2 = 0;
  double tendon_gap = 0;                     ///< between collars
  double axle_tube = 0;                      ///< outer radius
  double scale_low = 0, scale_plate = 0;     ///< the scale plate's lower face and thickness
  double pointer = 0;                        ///< radius of the link's pointer
  double graduation = 0;                     ///< spacing of the scale's lines, rad
  double link_low = 0, ledge = 0, link = 0;  ///< the link's lower face, its ledge below the bearings, its thickness
  double hub = 0;                            ///< radius of its hub
  double cap = 0, cap_height = 0, web = 0,
         recess = 0;                              ///< magnet cap: radius, height, web, radius of the room for the nut
  double cap_screws = 0;                          ///< radius of their circle
  double post = 0, waist = 0, bore = 0;           ///< radii of the post at C: outside, where tendon 2 is tied, inside
  double post_low = 0;                            ///< its lower end, at tendon 1
  double flange = 0;                              ///< thickness of the post's flange on top of the link
  double post_screws = 0;                         ///< distance from C across the link, on both sides
  double slide = 0, slide_width = 0, travel = 0;  ///< tensioner: length and width of the slide, how far it moves
  double link_end = 0;                            ///< y of the link's end at home
  double bracket_low = 0, bracket = 0;            ///< the bracket's lower face and thickness
  double leg = 0;                                 ///< height of the legs
  Vec2 motor_front{0, 1};                         ///< direction of the motor's front
};

/// Position of a part: first turned over about y if its print orientation requires it, then turned about z, then
/// shifted.
struct KitPlace {
  Vec2 shift{0, 0};
  double z = 0;
  bool turned_over = false;
  bool on_link = false;  ///< it turns with the link; given for home
};

/// Names that parts of a rig may have; no rig has all of them.
inline constexpr std::array<std::string_view, 23> k_kit_part_names{
    "base_plate",   "base_template", "link",         "link_template", "bracket",      "scale_plate",
    "leg",          "foot_spacer",   "foot_tube",    "post",          "magnet_cap",   "tensioner_slide",
    "axle_spacer",  "board_spacer",  "bearing_ring", "pin_b_collar",  "pin_b_spacer", "pin_b_sleeve",
    "pin_d_collar", "pin_d_spacer",  "pin_d_sleeve", "drum",          "fit_coupon"};

/// A printed or cut part of the rig.
struct KitPart {
  std::string name;              ///< of k_kit_part_names; base of its file names
  std::string words;             ///< description
  SlabBody body;                 ///< in print orientation, nominal size
  std::vector<KitPlace> places;  ///< one for each piece; none for a part outside the rig (the coupon)
  int count = 1;
  bool plate = false;  ///< may also be cut from sheets, because its slabs are vertical
};

/// A part to buy.
struct KitItem {
  int count = 1;
  std::string what;
  std::string use;
};

/// Additional lengths of a tendon in the rig, beyond the knots of the pulley.
struct KitTendon {
  transmission::Side side = transmission::Side::left;
  double beyond = 0;    ///< length from C to the fastening, mm
  double at_joint = 0;  ///< length wound up by the fastening itself, mm
};

/// Heights of tendons on a multi-turn pulley over the whole range, above the pulley's lower face, mm.
struct TendonHeights {
  struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    /// Extends the span to a height.
    void include(double height);
  };
  std::array<double, 2> ends{};  ///< of each tendon at the joint; with collars also where it reaches its guide
  std::array<Span, 2> guides;    ///< of each tendon on its guide
  Span drum;                     ///< of both on the joint's drum; `ends` without a drum
};

/// Outcome: all conditions hold, or not.
enum class KitStatus { made, impossible };

/// Result of plan_kit(): the rig as plain values, or the conditions that fail.
struct KitPlan {
  KitStatus status = KitStatus::impossible;
  KitSizes sizes;
  std::array<KitPin, 2> pins;
  std::vector<Vec2> feet;  ///< two: for scale plate and bracket
  std::array<Vec2, 4> legs;
  std::vector<profile::Condition> conditions;  ///< all distances over the whole range: `value` is at least `limit`
  std::vector<KitPart> parts;                  ///< in the order of assembly, the coupon last; empty if impossible
  std::vector<KitItem> items;
  std::array<KitTendon, 2> tendons;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;
  /// True for a joint with a drum, separate attachments, idlers or sheaths, or a multi-turn pulley. The kit then
  /// consists of plates to drill instead of a rig, and `sizes`, `feet` and `legs` are empty.
  bool drilled = false;
  std::optional<TendonHeights> heights;  ///< for several turns

  bool made() const { return status == KitStatus::made; }
};

/// The thinnest pin radius of a kit, mm: rods below 1 mm diameter are not sold.
inline constexpr double k_least_pin = 0.5;
/// Thickness of a drilling template, mm.
inline constexpr double k_template_plate = 4;

/// Requires a feasible one-turn pulley.
KitPlan plan_kit(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                 const solid::BodyLayout& layout);
/// The kit for a multi-turn pulley.
KitPlan plan_kit_of_turns(const Mechanism& mechanism, const solid::BodyLayout& layout, const TendonHeights& heights);

/// The link's outline at a joint angle, in the rig's frame.
Polygon link_outline(const KitPlan& plan, const Mechanism& mechanism, double theta);
/// The scale plate's outline.
Polygon scale_outline(const KitPlan& plan, const Mechanism& mechanism);

/// One reading of the coupon.
struct CouponReading {
  std::string what;  ///< the feature on the coupon
  std::string read;  ///< what to read
  std::string key;   ///< the key of the file that the reading sets, and how
};
/// The readings of coupon_body().
std::vector<CouponReading> coupon_readings(const Mechanism& mechanism);
/// A flat piece with holes, slots and pegs in graded sizes.
SlabBody coupon_body(const Mechanism& mechanism);

/// The mesh of a part as it is printed.
solid::TriangleMesh printed_mesh(const KitPart& part, const Mechanism& mechanism, const solid::BodyLayout& layout);
/// Volume of printed_mesh() before rounding. mm³
double printed_volume(const KitPart& part, const Mechanism& mechanism, const solid::BodyLayout& layout);
/// The nominal mesh of a part in place at a joint angle.
solid::TriangleMesh placed_mesh(const KitPart& part, const KitPlace& place, double theta);

}  // namespace fusee::kit
