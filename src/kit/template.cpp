// Kits for joints outside the paper's layout and for helical tendons: plates to drill with every axis at its place, and
// the drum.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "fusee/kit.h"
#include "fusee/transmission.h"
#include "kit/hardware.h"
#include "kit/motor_mount.h"
#include "kit/parts.h"

namespace fusee::kit {
namespace {

// All in mm.
constexpr double k_between_holes = 1.2;  // least wall: three lines of a 0.4 mm nozzle
constexpr double k_plate = k_template_plate;
constexpr double k_ledge = 1.2;      // ledge below the bearings and around a spacer
constexpr double k_clearance = 0.5;  // of moving parts
constexpr double k_around_hole = 5;  // width of a plate around its holes
constexpr double k_hole_at_C = 1.6;  // radius

struct NamedHole {
  std::string name;
  Vec2 place{0, 0};
  double radius = 0;
};

/// Adds a hole unless its place already has one: both tendons may end in one hole.
void add_hole(std::vector<NamedHole>& holes, const NamedHole& hole) {
  const auto same = [&hole](const NamedHole& other) { return (other.place - hole.place).norm() < 1e-6; };
  if (std::none_of(holes.begin(), holes.end(), same)) holes.push_back(hole);
}

/// Adds a condition for the wall between each two holes.
void check_distances(KitPlan& plan, const std::vector<NamedHole>& holes) {
  for (std::size_t i = 0; i < holes.size(); ++i) {
    for (std::size_t k = i + 1; k < holes.size(); ++k) {
      profile::Condition apart;
      apart.name = holes[i].name + "_beside_" + holes[k].name;
      apart.value = (holes[i].place - holes[k].place).norm() - holes[i].radius - holes[k].radius;
      apart.limit = k_between_holes;
      apart.unit = "mm";
      apart.ok = apart.value >= apart.limit;
      if (!apart.ok)
        apart.message = "the holes of " + holes[i].name + " and " + holes[k].name + " are " + rounded(apart.value, 3) +
                        " mm apart; at least " + rounded(apart.limit, 3) + " mm is required";
      plan.conditions.push_back(apart);
    }
  }
}

/// A plate around its holes and around the discs of `more`.
SlabBody plate_of(const std::vector<NamedHole>& holes, std::vector<Disc> more) {
  Slab plate{0, k_plate, {}};
  for (const NamedHole& hole : holes) {
    more.push_back({hole.place, hole.radius + k_around_hole});
    plate.loops.push_back({disc(hole.place, hole.radius), true, 0, 0});
  }
  plate.loops.insert(plate.loops.begin(), {DiscHull{std::move(more), 144}, false, 0, 0});
  return {{plate}};
}

class TemplateMaker {
 public:
  TemplateMaker(const Mechanism& mechanism, const solid::BodyLayout& layout,
                const std::optional<TendonHeights>& heights)
      : mechanism_(mechanism),
        layout_(layout),
        bearing_(largest_bearing()),
        axle_(bearing_ ? thread_within(bearing_->bore) : thread_within(0.5 * smallest_lever(), mechanism.units)) {
    plan_.heights = heights;
  }

  KitPlan make() {
    plan_.drilled = true;
    profile::Condition pin;
    pin.name = "pin_radius";
    pin.value = mechanism_.guides.radius;
    pin.limit = k_least_pin;
    pin.unit = "mm";
    pin.ok = pin.value >= pin.limit;
    if (!pin.ok) pin.message = "a pin this thin is not sold: guides.radius_mm " + rounded(k_least_pin) + " or more";
    plan_.conditions.push_back(pin);
    add_base();
    add_link();
    plan_.status = profile::failed_of(plan_.conditions).empty() ? KitStatus::made : KitStatus::impossible;
    if (!plan_.made()) {
      plan_.parts.clear();
      plan_.items.clear();
      return plan_;
    }
    plan_.parts.push_back({"fit_coupon", "the fit coupon: print it first", coupon_body(mechanism_), {}, 1, false});
    plan_.tendons[1].side = transmission::Side::right;
    plan_.notes.push_back(
        std::string(plan_.heights ? "for a multi-turn pulley"
                                  : "for a joint with a drum, separate attachments, idlers or sheaths") +
        " the kit has full-size drilling templates with bearing seats and the motor's holes" +
        (plan_.heights && !has_drum() ? "" : ", and the drum") + "; it has no scale, tensioner or encoder mount");
    return plan_;
  }

 private:
  /// Radius of the hole in which a tendon is tied.
  static double tie_radius(const Mechanism& mechanism) { return std::max(0.5, 0.75 * mechanism.tendon.diameter); }
  /// Position of a tendon's end on the link: its own attachment, or C.
  Vec2 end_of(const std::optional<Attachment>& attachment) const {
    return attachment ? Vec2(attachment->across, attachment->along) : Vec2(0, mechanism_.joint.R);
  }

  /// The largest bearing that fits; null if none does. Two of them lie in the link, beside the tendons' ends. The ring
  /// on which they stand passes through the drum.
  const fusee::BearingType* largest_bearing() const {
    const Joint& joint = mechanism_.joint;
    double room = joint.R - k_hole_at_C;
    for (const auto& end : {joint.attachment1, joint.attachment2})
      room = std::min(room, end_of(end).norm() - tie_radius(mechanism_));
    for (const fusee::BearingType& bearing : bearing_types()) {
      const bool fits_in_drum = joint.drum_radius == 0 || ring_hole(bearing) + k_ledge <= joint.drum_radius;
      if (0.5 * bearing.outer + k_between_holes <= room && fits_in_drum) return &bearing;
    }
    return nullptr;
  }
  /// Radius of the opening for the ring of these bearings, which does not rotate.
  static double ring_hole(const fusee::BearingType& bearing) { return 0.5 * bearing.spacer + k_clearance; }
  double hole_in_drum() const { return bearing_ ? ring_hole(*bearing_) : 0.5 * axle_.clearance; }

  bool has_idlers() const { return mechanism_.guides.kind == GuideKind::idler; }

  /// Least distance from the joint's axis to an end of a tendon or to the drum's surface.
  double smallest_lever() const {
    const Joint& joint = mechanism_.joint;
    double least = joint.drum_radius > 0 ? joint.drum_radius : joint.R;
    for (const auto& end : {joint.attachment1, joint.attachment2})
      if (end) least = std::min(least, elementary::hypot(end->across, end->along));
    return least;
  }

  void add_base() {
    std::vector<NamedHole> holes{{"axle", {0, 0}, 0.5 * axle_.clearance}};
    const double pin_hole =
        has_idlers() ? 0.5 * thread_within(mechanism_.guides.bearing_radius).clearance : mechanism_.guides.radius;
    for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
      const transmission::PinPlace place = transmission::pin_place(mechanism_, side, 0);
      const double sign = transmission::mirror_sign(side);
      KitPin& pin = plan_.pins[side == transmission::Side::left ? 0 : 1];
      pin.side = side;
      pin.place = {sign * place.pin().x(), place.pin().y()};
      pin.radius = pin.collar = mechanism_.guides.radius;
      holes.push_back({side == transmission::Side::left ? "pin_B" : "pin_D", pin.place, pin_hole});
      if (!place.sheath_exit) continue;
      const Vec2 exit = place.pulley_axis() + Vec2(sign * place.sheath_exit->across, place.sheath_exit->above);
      holes.push_back({side == transmission::Side::left ? "mouth_1" : "mouth_2", exit, ferrule_radius()});
    }
    const Vec2 pulley = transmission::pin_place(mechanism_, transmission::Side::left, 0).pulley_axis();
    const fusee::MotorType* motor = motor_that_fits(holes, pulley);
    std::vector<Disc> above_motor;  // corners of the part of the plate that carries the motor
    if (motor) above_motor = motor_corners(*motor, pulley, motor_front(pulley));
    for (Disc& corner : above_motor) corner.radius = 1;
    // Radius of the hole for the pulley's axis.
    const double axis_hole = mechanism_.body.bore == Bore::horn ? 0.5 * horn_of(mechanism_).bolt_circle + 5
                                                                : 0.5 * shaft_of(mechanism_, layout_) + 0.5;
    if (!motor) holes.push_back({"pulley_axis", pulley, axis_hole});
    check_distances(plan_, holes);
    SlabBody plate = plate_of(holes, above_motor);
    if (motor) {
      for (SlabLoop& loop : motor_holes(*motor, pulley, motor_front(pulley)))
        plate.slabs.front().loops.push_back(std::move(loop));
      buy_motor(plan_, motor_name(mechanism_, motor), *motor, k_plate);
    }
    plan_.parts.push_back({"base_template",
                           "base: axis, guides and pulley at the file's positions",
                           std::move(plate),
                           {{{0, 0}, -k_plate, false, false}},
                           1,
                           true});
    buy_axle();
    buy_guides();
  }

  /// Null if the catalogue has no suitable motor or if it would collide with another axis. The plate then has only a
  /// hole for the pulley's axis.
  const fusee::MotorType* motor_that_fits(const std::vector<NamedHole>& holes, const Vec2& pulley) {
    const fusee::MotorType* motor = motor_for(mechanism_, layout_);
    if (!motor) {
      plan_.notes.push_back("no motor of the catalogue has this shaft or horn: the base has only a hole for its axis");
      return nullptr;
    }
    for (const NamedHole& hole : holes) {
      const double distance = distance_to_motor(*motor, hole.place - pulley, motor_front(pulley));
      if (distance - hole.radius >= k_between_holes) continue;
      plan_.notes.push_back("the motor (" + mount_words(motor_name(mechanism_, motor), *motor) +
                            ") would overlap the hole of " + hole.name +
                            ": the base has only a hole for its axis. Increase pulley.EF_mm or choose a smaller motor "
                            "(body.shaft, body.horn)");
      return nullptr;
    }
    return motor;
  }

  /// The drum carries both tendons, with a margin above and below.
  double drum_height() const {
    const auto& heights = plan_.heights;
    return (heights ? heights->drum.high - heights->drum.low : layout_.z_p2 - layout_.z_p1) + 2 * margin();
  }
  bool has_drum() const { return mechanism_.joint.drum_radius > 0; }

  void buy_axle() {
    if (!bearing_) {
      plan_.items.push_back({1, "axle of the joint, " + std::string(axle_.name), "through base, drum and link"});
      plan_.notes.push_back(
          "no ball bearing of the catalogue fits beside the tendons' ends: the link turns on the axle");
      return;
    }
    const double ring = (has_drum() ? drum_height() : 0.0) + k_clearance + k_ledge;
    plan_.parts.push_back(
        {"bearing_ring",
         has_drum() ? "ring under the inner ring of the lower bearing, through the drum"
                    : "ring under the inner ring of the lower bearing",
         {{{0,
            ring,
            {{disc({0, 0}, 0.5 * bearing_->spacer), false, 0, 0}, {disc({0, 0}, 0.5 * axle_.clearance), true, 0, 0}}}}},
         {{{0, 0}, 0, false, false}},
         1,
         false});
    plan_.items.push_back(
        {2, "ball bearing " + bearing_->name + " (" + bearing_->description + ")", "joint, in the link"});
    const double stack = k_plate + ring + 2 * bearing_->width + axle_.nut_height + 1;
    plan_.items.push_back({1, screw_words(axle_, stack) + " with nut", "the joint's axle, from below"});
  }

  double ferrule_radius() const { return std::max(1.5, mechanism_.tendon.diameter); }

  /// Text for guides whose tendons are helical or run between collars.
  std::string height_words() const {
    if (!plan_.heights) return "";
    const auto words_of = [this](std::size_t i, const std::string& name) {
      const TendonHeights::Span& span = plan_.heights->guides.at(i);
      return name + (mechanism_.guides.collar ? " between collars at " + rounded(span.low, 4)
                                              : " smooth from " + rounded(std::floor(span.low - margin()), 4) + " to " +
                                                    rounded(std::ceil(span.high + margin()), 4));
    };
    return "; " + words_of(0, "B") + " mm, " + words_of(1, "D") + " mm above the pulley's lower face";
  }
  /// Clearance above and below a tendon's centre line.
  double margin() const { return mechanism_.tendon.diameter + 1; }

  void buy_guides() {
    const Guides& guides = mechanism_.guides;
    if (has_idlers())
      plan_.items.push_back(
          {2,
           std::string(plan_.heights && !guides.collar ? "roller" : "idler") + " on a ball bearing, ⌀ " +
               rounded(2 * guides.radius, 4) + (plan_.heights && !guides.collar ? " mm" : " mm at its groove's floor"),
           "B and D, on " + std::string(thread_within(guides.bearing_radius).name) + " bolts" + height_words()});
    else
      plan_.items.push_back({2, "steel rod ⌀ " + rounded(2 * guides.radius, 4) + " mm",
                             "pins B and D, pressed into the base" + height_words()});
    if (mechanism_.sheath.is_there())
      plan_.items.push_back(
          {2, "Bowden sheath, " + rounded(mechanism_.sheath.length, 4) + " mm, with ferrules",
           "from pin to sheath exit; the pulley's part of the base may be cut off and mounted elsewhere"});
  }

  void add_link() {
    const Joint& joint = mechanism_.joint;
    std::vector<NamedHole> holes{{"axle", {0, 0}, bearing_ ? 0.5 * bearing_->outer : 0.5 * axle_.clearance}};
    add_hole(holes, {"end_1", end_of(joint.attachment1), tie_radius(mechanism_)});
    add_hole(holes, {"end_2", end_of(joint.attachment2), tie_radius(mechanism_)});
    add_hole(holes, {"C", {0, joint.R}, k_hole_at_C});
    check_distances(plan_, holes);
    const double drum = joint.drum_radius, ring = bearing_ ? k_clearance : 0.0;
    const double on_axle = bearing_ ? holes.front().radius + k_ledge : axle_.head_radius + 2;
    SlabBody plate = plate_of(holes, {{{0, 0}, std::max(drum, on_axle)}});
    if (bearing_) seat_bearings(plate);
    plan_.parts.push_back({"link_template",
                           "link: axis, the tendons' ends, and C for the load",
                           std::move(plate),
                           {{{0, 0}, has_drum() ? drum_height() + ring : ring, false, true}},
                           1,
                           true});
    if (!has_drum()) return;
    // The wall around the hole in the drum, as the distance between two circles: with a second circle of the drum's
    // radius at twice that radius, the distance is the drum's radius minus the hole's.
    check_distances(plan_, {{"drum", {2 * drum, 0}, drum}, {"axle", {0, 0}, hole_in_drum()}});
    plan_.parts.push_back(
        {"drum",
         "drum of the joint, as wide as both tendons: fixed to the link",
         {{{0, drum_height(), {{disc({0, 0}, drum), false, 0, 0}, {disc({0, 0}, hole_in_drum()), true, 0, 0}}}}},
         {{{0, 0}, ring, false, true}},
         1,
         false});
  }

  /// Makes the plate as high as both bearings, with a ledge that leaves their inner rings free.
  void seat_bearings(SlabBody& plate) const {
    Slab& seat = plate.slabs.front();
    Slab ledge = seat;
    for (SlabLoop& loop : ledge.loops) {
      if (loop.hole && loop.hull.discs.front().centre == Vec2(0, 0))
        loop.hull = disc({0, 0}, 0.5 * bearing_->outer - 0.25 * (bearing_->outer - bearing_->spacer));
    }
    ledge.high = k_ledge;
    seat.low = k_ledge;
    seat.high = k_ledge + 2 * bearing_->width;
    plate.slabs.insert(plate.slabs.begin(), std::move(ledge));
  }

  const Mechanism& mechanism_;
  const solid::BodyLayout& layout_;
  const fusee::BearingType* bearing_;  ///< null: the link turns directly on the axle
  const Thread& axle_;
  KitPlan plan_;
};

}  // namespace

KitPlan plan_template(const Mechanism& mechanism, const solid::BodyLayout& layout,
                      const std::optional<TendonHeights>& heights) {
  return TemplateMaker(mechanism, layout, heights).make();
}

}  // namespace fusee::kit
