// What a joint of the wider class, or of tendons that climb, is drilled by: plates with every axis where the file has
// it, and its drum.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "fusee/base/text.h"
#include "fusee/kit/kit.h"
#include "fusee/transmission/tendon_path.h"
#include "kit/hardware.h"
#include "kit/parts.h"

namespace fusee {
namespace {

constexpr double k_between_holes = 1.2;  // three lines of a 0.4 mm nozzle
constexpr double k_plate = 4;
constexpr double k_round_hole = 5;  // of a plate, beside its holes

struct NamedHole {
  std::string name;
  Vec2 place{0, 0};
  double radius = 0;
};

/// Both tendons may end in one hole.
void add_hole(std::vector<NamedHole>& holes, const NamedHole& hole) {
  const auto same = [&hole](const NamedHole& other) { return (other.place - hole.place).norm() < 1e-6; };
  if (std::none_of(holes.begin(), holes.end(), same)) holes.push_back(hole);
}

void look_between(KitPlan& plan, const std::vector<NamedHole>& holes) {
  for (std::size_t i = 0; i < holes.size(); ++i) {
    for (std::size_t k = i + 1; k < holes.size(); ++k) {
      Condition apart;
      apart.name = holes[i].name + "_beside_" + holes[k].name;
      apart.value = (holes[i].place - holes[k].place).norm() - holes[i].radius - holes[k].radius;
      apart.limit = k_between_holes;
      apart.unit = "mm";
      apart.ok = apart.value >= apart.limit;
      if (!apart.ok)
        apart.message = "between the holes of " + holes[i].name + " and " + holes[k].name + " " +
                        rounded(apart.value, 3) + " mm are left, " + rounded(apart.limit, 3) + " mm are needed";
      plan.conditions.push_back(apart);
    }
  }
}

/// A plate round its holes, and round `more`.
SlabBody plate_of(const std::vector<NamedHole>& holes, std::vector<Disc> more) {
  Slab plate{0, k_plate, {}};
  for (const NamedHole& hole : holes) {
    more.push_back({hole.place, hole.radius + k_round_hole});
    plate.loops.push_back({disc(hole.place, hole.radius), true, 0, 0});
  }
  plate.loops.insert(plate.loops.begin(), {DiscHull{std::move(more), 144}, false, 0, 0});
  return {{plate}};
}

class TemplateMaker {
 public:
  TemplateMaker(const Mechanism& mechanism, const BodyLayout& layout, const std::optional<TendonHeights>& heights)
      : mechanism_(mechanism), layout_(layout), axle_(thread_within(0.5 * smallest_lever())) {
    plan_.heights = heights;
  }

  KitPlan made() {
    plan_.drilled = true;
    Condition pin;
    pin.name = "pin_radius";
    pin.value = mechanism_.guides.radius;
    pin.limit = k_least_pin;
    pin.unit = "mm";
    pin.ok = pin.value >= pin.limit;
    if (!pin.ok) pin.message = "a pin so thin cannot be made: guides.radius_mm " + rounded(k_least_pin) + " or more";
    plan_.conditions.push_back(pin);
    base();
    link();
    plan_.status = failed_of(plan_.conditions).empty() ? KitStatus::made : KitStatus::impossible;
    if (!plan_.made()) {
      plan_.parts.clear();
      plan_.items.clear();
      return plan_;
    }
    plan_.parts.push_back({"fit_coupon", "the fit coupon: print it first", coupon_body(mechanism_), {}, 1, false});
    plan_.tendons[1].side = Side::right;
    plan_.notes.push_back(std::string(plan_.heights ? "of a pulley wound several times"
                                                    : "of a joint with a drum, ends of its own, idlers or sheaths") +
                          " the kit has plates to drill by, true to size" +
                          (plan_.heights && mechanism_.joint.drum_radius <= 0 ? "" : ", and the drum") +
                          ": no bearings, motor's holes, scale or encoder mount");
    return plan_;
  }

 private:
  bool idlers() const { return mechanism_.guides.kind == GuideKind::idler; }

  double smallest_lever() const {
    const Joint& joint = mechanism_.joint;
    double least = joint.drum_radius > 0 ? joint.drum_radius : joint.R;
    for (const auto& end : {joint.attachment1, joint.attachment2})
      if (end) least = std::min(least, std::hypot(end->across, end->along));
    return least;
  }

  void base() {
    std::vector<NamedHole> holes{{"axle", {0, 0}, 0.5 * axle_.clearance}};
    const double pin_hole =
        idlers() ? 0.5 * thread_within(mechanism_.guides.bearing_radius).clearance : mechanism_.guides.radius;
    for (const Side side : {Side::left, Side::right}) {
      const PinPlace place = pin_place(mechanism_, side, 0);
      const double sign = mirror_sign(side);
      KitPin& pin = plan_.pins[side == Side::left ? 0 : 1];
      pin.side = side;
      pin.place = {sign * place.pin().x(), place.pin().y()};
      pin.radius = pin.collar = mechanism_.guides.radius;
      holes.push_back({side == Side::left ? "pin_B" : "pin_D", pin.place, pin_hole});
      if (!place.mouth) continue;
      const Vec2 mouth = place.pulley_axis() + Vec2(sign * place.mouth->across, place.mouth->above);
      holes.push_back({side == Side::left ? "mouth_1" : "mouth_2", mouth, ferrule()});
    }
    const double shaft = mechanism_.body.bore == Bore::horn ? 0.5 * horn_of(mechanism_).bolt_circle + 5
                                                            : 0.5 * shaft_of(mechanism_, layout_) + 0.5;
    holes.push_back({"pulley_axis", pin_place(mechanism_, Side::left, 0).pulley_axis(), shaft});
    look_between(plan_, holes);
    plan_.parts.push_back({"base_template",
                           "base: axis, guides and pulley, where the file has them",
                           plate_of(holes, {}),
                           {{{0, 0}, -k_plate, false, false}},
                           1,
                           true});
    plan_.items.push_back({1, "axle of the joint, " + std::string(axle_.name), "through base, drum and link"});
    buy_guides();
  }

  double ferrule() const { return std::max(1.5, mechanism_.tendon.diameter); }

  /// Of a guide whose tendon climbs, or stands between collars.
  std::string climb_words() const {
    if (!plan_.heights) return "";
    const auto of = [this](std::size_t i, const std::string& name) {
      const TendonHeights::Span& on = plan_.heights->guides.at(i);
      return name + (mechanism_.guides.collar ? " between collars at " + rounded(on.low, 4)
                                              : " smooth from " + rounded(std::floor(on.low - margin()), 4) + " to " +
                                                    rounded(std::ceil(on.high + margin()), 4));
    };
    return "; " + of(0, "B") + " mm, " + of(1, "D") + " mm above the pulley's lower face";
  }
  /// Above and below a tendon's centre line.
  double margin() const { return mechanism_.tendon.diameter + 1; }

  void buy_guides() {
    const Guides& guides = mechanism_.guides;
    if (idlers())
      plan_.items.push_back(
          {2,
           std::string(plan_.heights && !guides.collar ? "roller" : "idler") + " on a ball bearing, ⌀ " +
               rounded(2 * guides.radius, 4) + (plan_.heights && !guides.collar ? "" : " at its groove's floor"),
           "B and D, on " + std::string(thread_within(guides.bearing_radius).name) + " bolts" + climb_words()});
    else
      plan_.items.push_back(
          {2, "steel rod ⌀ " + rounded(2 * guides.radius, 4), "pins B and D, pressed into the base" + climb_words()});
    if (mechanism_.sheath.is_there())
      plan_.items.push_back({2, "Bowden sheath, " + rounded(mechanism_.sheath.length, 4) + " mm, with ferrules",
                             "from pin to mouth; the pulley's part of the base may be cut off and stand elsewhere"});
  }

  void link() {
    const Joint& joint = mechanism_.joint;
    std::vector<NamedHole> holes{{"axle", {0, 0}, 0.5 * axle_.clearance}};
    const double tie = std::max(0.5, 0.75 * mechanism_.tendon.diameter);
    const auto end = [&](const std::optional<Attachment>& own) {
      return own ? Vec2(own->across, own->along) : Vec2(0, joint.R);
    };
    add_hole(holes, {"end_1", end(joint.attachment1), tie});
    add_hole(holes, {"end_2", end(joint.attachment2), tie});
    add_hole(holes, {"C", {0, joint.R}, 1.6});
    look_between(plan_, holes);
    const double drum = joint.drum_radius;
    plan_.parts.push_back({"link_template",
                           "link: axis, the tendons' ends, and C for the load",
                           plate_of(holes, {{{0, 0}, std::max(drum, axle_.head_radius + 2)}}),
                           {{{0, 0}, 0, false, true}},
                           1,
                           true});
    if (!(drum > 0)) return;
    look_between(plan_, {{"drum", {2 * drum, 0}, drum}, {"axle", {0, 0}, 0.5 * axle_.clearance}});
    const double high =
        (plan_.heights ? plan_.heights->drum.high - plan_.heights->drum.low : layout_.z_p2 - layout_.z_p1) +
        2 * margin();
    plan_.parts.push_back(
        {"drum",
         "drum of the joint, as wide as both tendons: fixed to the link",
         {{{0, high, {{disc({0, 0}, drum), false, 0, 0}, {disc({0, 0}, 0.5 * axle_.clearance), true, 0, 0}}}}},
         {{{0, 0}, -high, false, true}},
         1,
         false});
  }

  const Mechanism& mechanism_;
  const BodyLayout& layout_;
  const Thread& axle_;
  KitPlan plan_;
};

}  // namespace

KitPlan plan_template(const Mechanism& mechanism, const BodyLayout& layout,
                      const std::optional<TendonHeights>& heights) {
  return TemplateMaker(mechanism, layout, heights).made();
}

}  // namespace fusee
