/// \file
/// The rest of a test model: what stands round a pulley so that its joint can be held in the hand, as plain values.
///
/// The kit's frame is the mechanism's, z up from the top of the base plate. From below: motor | base plate | tendon 1
/// at `z_tendon1`, tendon 2 at `z_tendon2`, between collars on the pins | scale plate, over pins and pulley | link, on
/// two ball bearings, its post hanging down at C to both tendons | magnet | board | bracket. So nothing that moves with
/// the link meets a pin or the pulley, but the post, which stays within the plane's room (`conditions`). mm, rad
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fusee/kit/body.h"
#include "fusee/mechanism/catalogue.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/synthesis.h"
#include "fusee/solid/layout.h"

namespace fusee {

/// A screw's thread and what goes with it.
struct Thread {
  std::string_view name;
  double diameter = 0;
  double clearance = 0;  ///< diameter of the hole that it passes
  double tapping = 0;    ///< of the hole that it cuts its thread into
  double head_radius = 0;
  double nut = 0;  ///< across flats
  double nut_height = 0;
};

/// A guide pin: a bare rod, or a screw in a sleeve.
struct KitPin {
  Side side = Side::left;
  Vec2 place{0, 0};
  const Thread* screw = nullptr;  ///< null: the rod itself is the pin
  double radius = 0;              ///< on which the tendon runs
  double collar = 0;              ///< outer radius of the collars below and above it
  double gap_low = 0;             ///< heights between which the tendon runs
  double gap_high = 0;
  double top = 0;  ///< of all that stands there
};

/// Part of the kit's heights and radii, resolved.
struct KitSizes {
  const BearingType* bearing = nullptr;
  const BoardType* board = nullptr;
  const MotorType* motor = nullptr;  ///< null: none of the catalogue's has such a shaft or horn
  const Thread *axle = nullptr, *foot = nullptr, *small = nullptr;
  double base = 0;        ///< thickness of the base plate
  double pulley_low = 0;  ///< height of the pulley's lower face
  double pulley_high = 0;
  double pulley_radius = 0;  ///< of the circle about its axis that its flanges keep within
  double z_tendon1 = 0, z_tendon2 = 0;
  double tendon_gap = 0;                   ///< between collars
  double axle_tube = 0;                    ///< outer radius
  double scale_low = 0, scale_plate = 0;   ///< the scale plate's lower face and thickness
  double pointer = 0;                      ///< radius of the link's pointer
  double graduation = 0;                   ///< of the scale, rad
  double link_low = 0, lip = 0, link = 0;  ///< the link's lower face, its lip below the bearings, its thickness
  double hub = 0;                          ///< radius of its hub
  double cap = 0, cap_height = 0, web = 0,
         recess = 0;                              ///< magnet cap: radius, height, web, radius of the room for the nut
  double cap_screws = 0;                          ///< radius on which they stand
  double post = 0, waist = 0, bore = 0;           ///< radii of the post at C: outside, where tendon 2 is tied, inside
  double post_low = 0;                            ///< its mouth, at tendon 1
  double flange = 0;                              ///< thickness of the post's flange on top of the link
  double post_screws = 0;                         ///< ± from C, across the link
  double slide = 0, slide_width = 0, travel = 0;  ///< tensioner: length and width of the slide, how far it moves
  double link_end = 0;                            ///< y of the link's end at home
  double bracket_low = 0, bracket = 0;
  double leg = 0;          ///< height of the legs
  Vec2 motor_front{0, 1};  ///< direction of the motor's front
};

/// Where a part stands: turned over about y first where it lies so on the printer, then turned about z, then shifted.
struct KitPlace {
  Vec2 shift{0, 0};
  double z = 0;
  bool turned_over = false;
  bool on_link = false;  ///< it turns with the link: at home
};

struct KitPart {
  std::string name;              ///< "base_plate": of its files
  std::string words;             ///< what it is
  SlabBody body;                 ///< as it lies on the printer, the size that is wanted
  std::vector<KitPlace> places;  ///< one a piece; none: it is no part of the model (the coupon)
  int count = 1;
  bool plate = false;  ///< may be cut from sheets as well: its slabs are upright
};

/// A thing to buy.
struct KitItem {
  int count = 1;
  std::string what;
  std::string use;
};

/// A tendon of the kit: beyond the knots that a pulley's tendon has.
struct KitTendon {
  Side side = Side::left;
  double beyond = 0;    ///< from C to its end at the joint, along the tendon
  double at_joint = 0;  ///< what its fastening there takes, mm
};

/// Of tendons that climb on a pulley of several turns: over the whole range, above the pulley's lower face, mm.
struct TendonHeights {
  struct Span {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void see(double height);
  };
  std::array<double, 2> ends{};  ///< of each at the joint; with collars also where it comes onto its guide
  std::array<Span, 2> guides;    ///< of each on its guide
  Span drum;                     ///< of both on the joint's drum; `ends` where there is none
};

enum class KitStatus { made, impossible };

struct KitPlan {
  KitStatus status = KitStatus::impossible;
  KitSizes sizes;
  std::array<KitPin, 2> pins;
  std::vector<Vec2> feet;  ///< two: of scale plate and bracket
  std::array<Vec2, 4> legs;
  std::vector<Condition> conditions;  ///< distances over the whole range, all: `value` is at least `limit`
  std::vector<KitPart> parts;         ///< in the order of assembly, the coupon last; none where impossible
  std::vector<KitItem> items;
  std::array<KitTendon, 2> tendons;
  std::vector<std::string> notes;
  /// Of a joint with a drum, ends of its own, idlers or sheaths, or a pulley of several turns: plates to drill by, no
  /// model that stands by itself; `sizes`, `feet` and `legs` are then empty.
  bool drilled = false;
  std::optional<TendonHeights> heights;  ///< of several turns

  bool made() const { return status == KitStatus::made; }
};

/// The radius of the thinnest pin that a kit has, mm: no rod is sold as one below 1 mm.
inline constexpr double k_least_pin = 0.5;

/// Of a joint whose pulley can be made, of one turn.
KitPlan plan_kit(const Mechanism& mechanism, const SynthesisResult& synthesis, const BodyLayout& layout);
/// Of several turns.
KitPlan plan_kit_of_turns(const Mechanism& mechanism, const BodyLayout& layout, const TendonHeights& heights);

/// Where the link's outline is at a joint angle, in the kit's frame.
Polygon link_outline(const KitPlan& plan, const Mechanism& mechanism, double theta);
/// The scale plate's outline.
Polygon scale_outline(const KitPlan& plan, const Mechanism& mechanism);

/// What the coupon is read for.
struct CouponReading {
  std::string what;  ///< on the coupon
  std::string read;  ///< what to look for
  std::string key;   ///< which key of the file takes it, and how
};
std::vector<CouponReading> coupon_readings(const Mechanism& mechanism);
/// A flat piece with holes, slots and pegs in steps.
SlabBody coupon_body(const Mechanism& mechanism);

/// A part's mesh as it is printed.
TriangleMesh printed_mesh(const KitPart& part, const Mechanism& mechanism, const BodyLayout& layout);
double printed_volume(const KitPart& part, const Mechanism& mechanism, const BodyLayout& layout);
/// Meshes as they stand at a joint angle: of the size that is wanted.
TriangleMesh standing(const KitPart& part, const KitPlace& place, double theta);

}  // namespace fusee
