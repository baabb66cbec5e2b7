#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/kit.h"
#include "fusee/transmission.h"
#include "kit/hardware.h"
#include "kit/motor_mount.h"
#include "kit/parts.h"
#include "mechanism/catalogue.h"

namespace fusee::kit {
namespace {

constexpr double k_infinite = std::numeric_limits<double>::infinity();
constexpr double k_clear = 0.5;  // clearance of moving parts, mm: a desktop printer is accurate to 0.2 mm
constexpr int k_places = 49;     // number of joint positions at which distances are checked

/// True for commercial rod diameters of either unit, mm.
bool is_stock_rod(double diameter) {
  constexpr double k_thickest = 12.72, k_tolerance = 0.025;  // mm; the thickest rod is half an inch, 12.7 mm
  if (diameter > k_thickest) return false;
  for (const LengthUnit units : {LengthUnit::mm, LengthUnit::inch}) {
    if (std::abs(stock_rod(diameter - k_tolerance, units) - diameter) < k_tolerance + 1e-9) return true;
  }
  return false;
}

/// Distance of a point outside a convex polygon, negative inside. Beyond a corner it is a lower bound.
double distance_outside(const Polygon& convex, const Vec2& point) {
  double most = -k_infinite;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vec2 &a = convex[i], edge = convex[(i + 1) % convex.size()] - a;
    most = std::max(most, cross(point - a, edge) / edge.norm());
  }
  return most;
}

double distance_to_path(const std::vector<Vec2>& path, const Vec2& point) {
  double least = k_infinite;
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    least = std::min(least, distance_to_segment(point, path[i], path[i + 1]));
  return least;
}

/// Centre line of a tendon from C to its take-off on the pulley.
std::vector<Vec2> tendon_path(const Mechanism& mechanism, const transmission::TransmissionPoint& at,
                              transmission::Side side) {
  const double rho = mechanism.guide_pitch_radius(), sign = transmission::mirror_sign(side);
  const transmission::PinPlace place = transmission::pin_place(mechanism, side, rho);
  const transmission::TendonPoint& tendon = side == transmission::Side::left ? at.t1 : at.t2;
  const Vec2 pin(sign * place.pin().x(), place.pin().y());
  return {mechanism.joint.R * Vec2(elementary::sin(at.theta), elementary::cos(at.theta)),
          pin + rho * unit(tendon.upper_normal), pin + rho * unit(tendon.lower_normal),
          place.pulley_axis() + tendon.p * unit(tendon.lower_normal)};
}

/// Positions and tendon paths of the mechanism, computed once.
struct Scene {
  const Mechanism& mechanism;
  Vec2 pulley;               ///< the pulley's axis
  std::array<Vec2, 2> pins;  ///< B and D
  std::vector<transmission::TransmissionPoint> stroke;
  std::array<std::vector<std::vector<Vec2>>, 2> paths;  ///< of tendons 1 and 2, at each place of the stroke
  double longest = 0;                                   ///< free length of a tendon, mm

  explicit Scene(const Mechanism& rig_mechanism) : mechanism(rig_mechanism) {
    const transmission::Transmission transmission(mechanism);
    const transmission::PinPlace place = transmission::pin_place(mechanism, transmission::Side::left, 0);
    pulley = place.pulley_axis();
    for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
      const transmission::PinPlace own = transmission::pin_place(mechanism, side, 0);
      pins[side == transmission::Side::left ? 0 : 1] = {transmission::mirror_sign(side) * own.pin().x(), own.pin().y()};
    }
    for (int i = 0; i < k_places; ++i) {
      const double share = static_cast<double>(i) / (k_places - 1);
      stroke.push_back(transmission.at_alpha(transmission.alpha_min() +
                                             share * (transmission.alpha_max() - transmission.alpha_min())));
      for (const transmission::Side side : {transmission::Side::left, transmission::Side::right})
        paths[side == transmission::Side::left ? 0 : 1].push_back(tendon_path(mechanism, stroke.back(), side));
      longest = std::max({longest, stroke.back().t1.length, stroke.back().t2.length});
    }
  }
};

/// The minimum of a value over the stroke, and the α at which it occurs.
struct Minimum {
  double value = k_infinite;
  double alpha = 0;
  void consider(double other_value, double other_alpha) {
    if (other_value < value) *this = {other_value, other_alpha};
  }
};

// ---- sizes ----------------------------------------------------------------------------------------------------------

/// Sets the sizes that follow from the bearing. The axle's thread is metric, as the bearing's bore is.
void size_axle(KitSizes& sizes, const fusee::BearingType& bearing, LengthUnit units) {
  sizes.bearing = &bearing;
  sizes.axle = &thread_within(bearing.bore);
  sizes.foot = &thread_within(bearing.bore >= 5 ? 4.2 : bearing.bore, units);
  sizes.small = &thread_within(bearing.bore >= 5 ? 3 : 2, units);
  sizes.cap_screw = &threads_of(units).front();
  sizes.base = bearing.bore >= 5 ? 6 : 4;
  sizes.axle_tube = std::max(0.5 * sizes.axle->clearance + k_wall, 0.5 * bearing.spacer);
}

/// Sets the sizes that follow from pulley and motor.
void size_pulley(KitSizes& sizes, const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                 const solid::BodyLayout& layout) {
  const double groove_edge = layout.groove_depth - 0.5 * mechanism.tendon.diameter;
  for (const profile::Outline* outline : {&synthesis.p1, &synthesis.p2})
    sizes.pulley_radius = std::max(sizes.pulley_radius, circumradius(profile::parallel(*outline, groove_edge)));
  sizes.pulley_radius = std::max(sizes.pulley_radius, layout.hub_radius);
  sizes.motor = motor_for(mechanism, layout);
  sizes.motor_name = motor_name(mechanism, sizes.motor);
  const double heads = sizes.motor ? sizes.motor->head + 0.5 : 0.0;
  sizes.pulley_low = std::max(1.5, heads);
  if (sizes.motor && sizes.motor->face > 0) sizes.pulley_low = std::max(sizes.motor->face - sizes.base, heads);
  sizes.pulley_high = sizes.pulley_low + layout.z_hub;
  sizes.z_tendon1 = sizes.pulley_low + layout.z_p1;
  sizes.z_tendon2 = sizes.pulley_low + layout.z_p2;
  sizes.tendon_gap = mechanism.tendon.diameter + 1.0;
}

KitPin pin_of(const KitSizes& sizes, const Scene& scene, transmission::Side side) {
  const Guides& guides = scene.mechanism.guides;
  KitPin pin;
  pin.side = side;
  pin.place = scene.pins[side == transmission::Side::left ? 0 : 1];
  pin.radius = guides.radius;
  const double height = side == transmission::Side::left ? sizes.z_tendon1 : sizes.z_tendon2;
  pin.gap_low = height - 0.5 * sizes.tendon_gap;
  pin.gap_high = height + 0.5 * sizes.tendon_gap;
  constexpr double k_thinnest_screw = 2.8;  // mm: M3 or #4
  for (const Thread& thread : threads_of(scene.mechanism.units)) {
    if (thread.diameter >= k_thinnest_screw && thread.clearance + 2 * k_wall <= 2 * guides.radius) pin.screw = &thread;
  }
  const double inner = pin.screw ? 0.5 * pin.screw->clearance : guides.radius + 0.1;
  pin.collar = std::max(guides.radius + std::max(scene.mechanism.tendon.diameter, 0.8), inner + k_wall);
  pin.top = pin.gap_high + k_collar_height + (pin.screw ? pin.screw->nut_height + 1 : 0);
  return pin;
}

/// Sets all sizes above the pins, and the legs'. `pins_top`: highest point of both pins.
void size_link(KitSizes& sizes, const Scene& scene, double pins_top) {
  const Mechanism& mechanism = scene.mechanism;
  const double R = mechanism.joint.R, d = mechanism.tendon.diameter;
  const fusee::BearingType& bearing = *sizes.bearing;
  const Thread &small = *sizes.small, &cap_screw = *sizes.cap_screw;
  sizes.scale_low = std::max(pins_top, sizes.pulley_high) + k_layer_gap;
  sizes.scale_plate = 3;
  sizes.ledge = k_wall;
  sizes.link_low = sizes.scale_low + sizes.scale_plate + k_layer_gap;
  sizes.link = sizes.ledge + 2 * bearing.width;
  sizes.recess = std::max(nut_corner_radius(*sizes.axle), 0.5 * sizes.board->magnet) + 0.6;
  sizes.cap_screws = std::max(0.5 * bearing.outer, sizes.recess) + 0.5 * cap_screw.clearance + 0.9;
  sizes.cap = sizes.recess + k_wall;
  sizes.hub = 0.5 * bearing.outer + 2.2;
  sizes.web = sizes.board->magnet_height;
  sizes.cap_height = sizes.web + sizes.axle->nut_height + 2.0;
  sizes.bore = std::max(0.5 * d + 0.25, 0.6);
  sizes.waist = std::max(sizes.bore + 1.0, 0.5 * bearing.bore);
  sizes.post = sizes.waist + 0.8;
  sizes.post_low = sizes.z_tendon1 + 0.5 * d;
  sizes.flange = 3;
  sizes.post_screws = sizes.post + 0.5 * small.tapping + 1.6;
  sizes.slide_width = 2 * nut_corner_radius(small) + 4;
  sizes.slide = slide_lengths(small).whole();
  sizes.travel = std::clamp(0.03 * scene.longest, 5.0, 15.0);
  sizes.link_end = R + sizes.post + k_post_to_slide + sizes.slide + sizes.travel + 5;
  sizes.pointer = std::clamp(0.45 * R, 16.0, 45.0);
  for (const double step : {1.0, 2.0, 5.0, 10.0}) {
    sizes.graduation = radians(step);
    if (sizes.graduation * sizes.pointer >= 1.4) break;
  }
  const double magnet = sizes.link_low + sizes.link + sizes.cap_height;
  const fusee::BoardType& board = *sizes.board;
  sizes.bracket_low = magnet + board.gap + board.chip + board.thickness + k_board_spacer;
  sizes.bracket = 4;
  sizes.leg = (sizes.motor ? sizes.motor->depth : 20) + 5;
  sizes.motor_front = motor_front(scene.pulley);
}

// ---- distances ------------------------------------------------------------------------------------------------------

class Conditions {
 public:
  explicit Conditions(KitPlan& plan) : plan_(plan) {}
  /// Adds the condition that a distance is at least `limit`. Its message gives the `fault` and suggests the `change`,
  /// in which "{}" is replaced by the missing distance.
  void at_least(const std::string& name, const Minimum& found, double limit, const std::string& fault,
                const std::string& change) {
    profile::Condition condition;
    condition.name = name;
    condition.value = found.value;
    condition.limit = limit;
    condition.alpha = found.alpha;
    condition.unit = "mm";
    condition.ok = found.value >= limit;
    if (!condition.ok) {
      std::string hint = change;
      if (const auto place = hint.find("{}"); place != std::string::npos)
        hint.replace(place, 2, trimmed_fixed(std::ceil(10 * (limit - found.value)) / 10, 1) + " mm");
      condition.message = fault + ": " + rounded(found.value, 3) + " mm, and at least " + rounded(limit, 3) +
                          " mm is required (α = " + rounded(degrees(found.alpha), 3) + "°)";
      if (!hint.empty()) condition.message += "; try " + hint;
    }
    plan_.conditions.push_back(condition);
  }

 private:
  KitPlan& plan_;
};

/// Clearance of a tendon from a circle. `tendon`: 0 for tendon 1, 1 for tendon 2.
Minimum tendon_past(const Scene& scene, int tendon, const Vec2& place, double radius) {
  Minimum least;
  for (std::size_t i = 0; i < scene.stroke.size(); ++i)
    least.consider(distance_to_path(scene.paths[tendon][i], place) - radius - 0.5 * scene.mechanism.tendon.diameter,
                   scene.stroke[i].alpha);
  return least;
}

/// Clearance of the post at C from a circle.
Minimum post_past(const Scene& scene, const KitSizes& sizes, const Vec2& place, double radius) {
  Minimum least;
  for (const transmission::TransmissionPoint& at : scene.stroke)
    least.consider(
        (scene.mechanism.joint.R * Vec2(elementary::sin(at.theta), elementary::cos(at.theta)) - place).norm() -
            sizes.post - radius,
        at.alpha);
  return least;
}

void check_axle(Conditions& checks, const Scene& scene, const KitPlan& plan) {
  const KitSizes& sizes = plan.sizes;
  const Vec2 axis(0, 0);
  const auto fixed = [](double value) { return Minimum{value, 0}; };
  checks.at_least("axle_beside_pulley", fixed(scene.pulley.norm() - sizes.pulley_radius - sizes.axle_tube), k_clear,
                  "the joint's axle is too close to the pulley",
                  "pulley.EF_mm " + std::string(scene.pulley.y() < 0 ? "larger" : "smaller") +
                      " by {}, or a smaller pulley (pulley.r1_mm, body.groove_depth_mm)");
  for (const int tendon : {0, 1}) {
    checks.at_least("axle_beside_tendon_" + std::to_string(tendon + 1),
                    tendon_past(scene, tendon, axis, sizes.axle_tube), k_clear,
                    "tendon " + std::to_string(tendon + 1) + " is too close to the joint's axle",
                    std::string(tendon == 0 ? "guides.EB_mm" : "guides.ED_mm") +
                        " larger by {}, or a smaller range (joint.range_deg)");
    checks.at_least(std::string("axle_beside_pin_") + (tendon == 0 ? "B" : "D"),
                    fixed(scene.pins[tendon].norm() - sizes.axle_tube - plan.pins[tendon].collar), k_clear,
                    std::string("pin ") + (tendon == 0 ? "B" : "D") + " is too close to the joint's axle",
                    std::string(tendon == 0 ? "guides.EB_mm" : "guides.ED_mm") + " larger by {}");
  }
  if (sizes.motor) {
    const double distance = distance_to_motor(*sizes.motor, axis - scene.pulley, sizes.motor_front);
    checks.at_least(
        "axle_beside_motor", fixed(distance - sizes.axle->head_radius), k_clear,
        "the screw of the joint's axle is too close to the motor (" + mount_words(sizes.motor_name, *sizes.motor) + ")",
        "pulley.EF_mm " + std::string(scene.pulley.y() < 0 ? "larger" : "smaller") +
            " by {}, or a smaller motor (body.shaft, body.horn)");
  }
}

void check_pins(Conditions& checks, const Scene& scene, const KitPlan& plan) {
  const KitSizes& sizes = plan.sizes;
  for (const int pin : {0, 1}) {
    const KitPin& own = plan.pins[pin];
    const std::string name(1, pin == 0 ? 'B' : 'D'), key = pin == 0 ? "guides.EB_mm" : "guides.ED_mm";
    checks.at_least("pin_" + name + "_beside_pulley",
                    {(own.place - scene.pulley).norm() - own.collar - sizes.pulley_radius, 0}, k_clear,
                    "pin " + name + " is too close to the pulley", "pulley.EF_mm larger by {}, or " + key + " larger");
    checks.at_least("pin_" + name + "_beside_post", post_past(scene, sizes, own.place, own.collar), k_clear,
                    "the post at C is too close to pin " + name,
                    key + " larger by {}, or a smaller range (joint.range_deg)");
    checks.at_least("pin_" + name + "_beside_tendon_" + (pin == 0 ? "2" : "1"),
                    tendon_past(scene, 1 - pin, own.place, own.collar), k_clear,
                    std::string("tendon ") + (pin == 0 ? "2" : "1") + " is too close to pin " + name,
                    key + " larger by {}");
    checks.at_least("pin_" + name + "_low_collar", {own.gap_low, 0}, 0.6,
                    "there is no space for a collar below the tendon on pin " + name,
                    "body.flange_thickness_mm larger by {}");
    if (sizes.motor) {
      const double radius = own.screw ? own.screw->head_radius : own.radius + k_wall;
      checks.at_least(
          "pin_" + name + "_beside_motor",
          {distance_to_motor(*sizes.motor, own.place - scene.pulley, sizes.motor_front) - radius, 0}, k_clear,
          "pin " + name + " is too close to the motor (" + mount_words(sizes.motor_name, *sizes.motor) + ")",
          "pulley.EF_mm larger by {}");
    }
  }
  checks.at_least("pins_apart", {(scene.pins[0] - scene.pins[1]).norm() - plan.pins[0].collar - plan.pins[1].collar, 0},
                  k_clear, "the pins are too close to each other", "guides.EB_mm and guides.ED_mm larger by {}");
}

void check_link(Conditions& checks, const Scene& scene, const KitPlan& plan) {
  const KitSizes& sizes = plan.sizes;
  const double R = scene.mechanism.joint.R;
  checks.at_least("post_beside_pulley", post_past(scene, sizes, scene.pulley, sizes.pulley_radius), k_clear,
                  "the post at C is too close to the pulley", "pulley.EF_mm or joint.length_mm larger by {}");
  checks.at_least("post_beside_axle", {R - sizes.post - sizes.axle_tube, 0}, k_clear,
                  "the post at C is too close to the axle", "joint.length_mm larger by {}");
  checks.at_least("post_beside_magnet", {R - (sizes.post + 1) - sizes.cap, 0}, k_clear,
                  "the post at C is too close to the magnet's cap", "joint.length_mm larger by {}");
  checks.at_least("post_beside_bearing", {R - sizes.post - 0.5 * sizes.bearing->outer, 0}, k_wall,
                  "the hole for the post at C is too close to the bearing", "joint.length_mm larger by {}");
  const double waist_low =
      sizes.z_tendon2 - 0.5 * sizes.tendon_gap - post_steepness(scene.mechanism) * (sizes.post - sizes.waist) - 0.4;
  checks.at_least("tendons_apart_on_post", {waist_low - sizes.post_low, 0}, k_clear,
                  "both tendons are too close to each other to be tied to one post",
                  "body.flange_thickness_mm larger by {}");
  const Polygon scale = scale_outline(plan, scene.mechanism);
  Minimum post;
  for (const transmission::TransmissionPoint& at : scene.stroke)
    post.consider(distance_outside(scale, R * Vec2(elementary::sin(at.theta), elementary::cos(at.theta))) - sizes.post,
                  at.alpha);
  checks.at_least("post_beside_scale", post, k_clear, "the post at C is too close to the scale",
                  "joint.length_mm larger by {}, or a smaller range (joint.range_deg)");
  const double magnet = sizes.link_low + sizes.link + sizes.cap_height;
  checks.at_least("tensioner_below_board",
                  {magnet + sizes.board->gap - sizes.link_low - sizes.link - tensioner_height(*sizes.small), 0},
                  k_clear, "the tensioner is too close to the board", "another board (profiles/catalogue/boards.toml)");
  checks.at_least("scale_over_pins", {sizes.scale_low - std::max(plan.pins[0].top, plan.pins[1].top), 0}, k_clear,
                  "a pin is too close to the scale", "");
  checks.at_least("scale_over_pulley", {sizes.scale_low - sizes.pulley_high, 0}, k_clear,
                  "the pulley is too close to the scale", "");
  checks.at_least("link_over_scale", {sizes.link_low - sizes.scale_low - sizes.scale_plate, 0}, k_clear,
                  "the link is too close to the scale", "");
  checks.at_least(
      "tendon_1_over_base",
      {sizes.z_tendon1 - 0.5 * scene.mechanism.tendon.diameter - (sizes.motor ? sizes.motor->head : 0.0), 0}, k_clear,
      "tendon 1 is too close to the motor's screws", "body.flange_thickness_mm larger by {}");
}

// ---- feet -----------------------------------------------------------------------------------------------------------

double foot_radius(const KitSizes& sizes) { return 0.5 * sizes.foot->clearance + k_wall; }

/// Tests places for a foot: it must clear all other parts over the whole stroke.
class FootPlaces {
 public:
  FootPlaces(const Scene& scene, const KitPlan& plan) : scene_(scene), plan_(plan) {
    for (const transmission::TransmissionPoint& at : scene.stroke)
      links_.push_back(link_outline(plan, scene.mechanism, at.theta));
  }

  bool is_free(const Vec2& place) const {
    const KitSizes& sizes = plan_.sizes;
    // Radius around the place that must be free.
    const double own = foot_radius(sizes) + k_clear + 0.3;
    if (on_scale(place, own)) return false;
    // The board's corners lie on a circle about the joint's axis.
    if (place.norm() < 0.5 * sizes.board->size.norm() + own + 1) return false;
    if ((place - scene_.pulley).norm() < sizes.pulley_radius + own) return false;
    for (const KitPin& pin : plan_.pins) {
      if ((place - pin.place).norm() < pin.collar + 1 + own) return false;
    }
    if (sizes.motor &&
        distance_to_motor(*sizes.motor, place - scene_.pulley, sizes.motor_front) < nut_corner_radius(*sizes.foot) + 1)
      return false;
    for (const auto& paths : scene_.paths) {
      for (const auto& path : paths) {
        if (distance_to_path(path, place) < own + 0.5 * scene_.mechanism.tendon.diameter + 0.5) return false;
      }
    }
    return std::all_of(links_.begin(), links_.end(),
                       [&](const Polygon& link) { return distance_outside(link, place) > own; });
  }

 private:
  /// True behind the axis, where the scale's lines are.
  bool on_scale(const Vec2& place, double own) const {
    const double theta = elementary::atan2(-place.x(), -place.y()), more = radians(15);
    return place.norm() < plan_.sizes.pointer + k_scale_reach + own &&
           theta > scene_.mechanism.joint.theta_min - more && theta < scene_.mechanism.joint.theta_max + more;
  }

  const Scene& scene_;
  const KitPlan& plan_;
  std::vector<Polygon> links_;
};

/// The free place nearest to the joint's axis, at most `reach` away, on the right (`side` = +1) or on the left (−1).
std::optional<Vec2> foot_on(const FootPlaces& places, double side, double reach) {
  for (double radius = 8; radius < reach; radius += 1) {
    for (int step = 0; step < 21; ++step) {
      // Begins straight to the side, then alternates below, in steps of 5°, and above, in steps of 2°.
      const double angle = radians(step % 2 ? -5.0 * ((step + 1) / 2) : 2.0 * (step / 2));
      const Vec2 place = radius * Vec2(side * elementary::cos(angle), elementary::sin(angle));
      if (places.is_free(place)) return place;
    }
  }
  return std::nullopt;
}

// ---- base -----------------------------------------------------------------------------------------------------------

/// All features on or under the base plate, with their radii.
std::vector<Disc> base_features(const Scene& scene, const KitPlan& plan) {
  const KitSizes& sizes = plan.sizes;
  constexpr double k_around_shaft = 8;  // of the plate, mm
  std::vector<Disc> all{{{0, 0}, sizes.axle_tube}, {scene.pulley, k_around_shaft}};
  for (const KitPin& pin : plan.pins) all.push_back({pin.place, pin.collar});
  for (const Vec2& foot : plan.feet) all.push_back({foot, nut_corner_radius(*sizes.foot) + 1});
  if (sizes.motor) {
    for (const Disc& corner : motor_corners(*sizes.motor, scene.pulley, sizes.motor_front)) all.push_back(corner);
  }
  return all;
}

/// Puts the legs at the corners of a rectangle around all features of the base.
void place_legs(const Scene& scene, KitPlan& plan) {
  Vec2 low(k_infinite, k_infinite), high = -low;
  for (const Disc& feature : base_features(scene, plan)) {
    low = low.cwiseMin(feature.centre - Vec2(feature.radius, feature.radius));
    high = high.cwiseMax(feature.centre + Vec2(feature.radius, feature.radius));
  }
  const double out = k_leg_radius + 1;
  low -= Vec2(out, out);
  high += Vec2(out, out);
  plan.legs = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

/// The plan of a rig with this bearing: sizes, places and conditions, but no parts yet.
KitPlan plan_with_bearing(const Scene& scene, const profile::SynthesisResult& synthesis,
                          const solid::BodyLayout& layout, const fusee::BearingType& bearing) {
  KitPlan plan;
  KitSizes& sizes = plan.sizes;
  sizes.board = &board_types().front();
  size_axle(sizes, bearing, scene.mechanism.units);
  size_pulley(sizes, scene.mechanism, synthesis, layout);
  plan.pins = {pin_of(sizes, scene, transmission::Side::left), pin_of(sizes, scene, transmission::Side::right)};
  size_link(sizes, scene, std::max(plan.pins[0].top, plan.pins[1].top));
  Conditions checks(plan);
  checks.at_least("pin_radius", {scene.mechanism.guides.radius, 0}, k_least_pin, "a pin this thin is not sold",
                  "guides.radius_mm " + rounded(k_least_pin) + " or more");
  check_axle(checks, scene, plan);
  check_pins(checks, scene, plan);
  const FootPlaces places(scene, plan);
  const double reach = 60 + 2.5 * std::max(scene.mechanism.joint.R, scene.pulley.norm() + sizes.pulley_radius);
  for (const double side : {-1.0, 1.0}) {
    if (const auto place = foot_on(places, side, reach)) plan.feet.push_back(*place);
  }
  checks.at_least("feet", {static_cast<double>(plan.feet.size()), 0}, 2, "", "");
  profile::Condition& feet = plan.conditions.back();
  feet.unit = "1";
  if (!feet.ok) {
    feet.message =
        "there is no place for the feet of scale and bracket beside link, tendons and pulley; "
        "try a smaller range (joint.range_deg) or a larger pulley.EF_mm";
  }
  check_link(checks, scene, plan);
  place_legs(scene, plan);
  plan.status = profile::failed_of(plan.conditions).empty() ? KitStatus::made : KitStatus::impossible;
  return plan;
}

void add_notes(KitPlan& plan, const Mechanism& mechanism, const solid::BodyLayout& layout) {
  const KitSizes& sizes = plan.sizes;
  if (!sizes.motor) {
    plan.notes.push_back(
        "no motor of the catalogue has this " + std::string(mechanism.body.bore == Bore::horn ? "horn" : "shaft") +
        ": the base plate has only a hole for it. Mount yours so that the pulley's lower face is " +
        rounded(sizes.pulley_low, 3) + " mm above the plate, or add it to profiles/catalogue/motors.toml");
  } else if (sizes.motor->shaft > 0) {
    const double needed = sizes.base + sizes.pulley_low + 0.5 * layout.z_hub;
    if (!layout.set_screw.present && needed > sizes.motor->shaft_length)
      plan.notes.push_back("the motor's shaft must reach " + rounded(std::ceil(needed), 3) + " mm above its face, " +
                           rounded(sizes.motor->shaft_length, 3) + " mm is usual: buy one with a long shaft");
  }
  constexpr double k_usual_bed = 220;  // mm
  // The legs' positions are corners of a rectangle, the first and the third opposite.
  const Vec2 base = plan.legs[2] - plan.legs[0] + Vec2(2 * k_leg_radius + 2, 2 * k_leg_radius + 2);
  if (base.maxCoeff() > k_usual_bed)
    plan.notes.push_back("the base plate is " + rounded(std::ceil(base.x()), 4) + " × " +
                         rounded(std::ceil(base.y()), 4) +
                         " mm, larger than the bed of most printers: cut it (kit.dxf)");
  for (const KitPin& pin : plan.pins) {
    if (!pin.screw && !is_stock_rod(2 * pin.radius))
      plan.notes.push_back("rods of " + rounded(2 * pin.radius, 4) +
                           " mm are not sold: use the shank of a drill for pin " +
                           (pin.side == transmission::Side::left ? "B" : "D"));
  }
}

}  // namespace

double shaft_of(const Mechanism& mechanism, const solid::BodyLayout& layout) {
  if (mechanism.body.bore_diameter > 0) return mechanism.body.bore_diameter;
  const double bore = layout.bore.circle ? layout.bore.circle->diameter : 2 * layout.bore.radius;
  return bore - mechanism.material.hole_compensation;
}

KitPlan plan_kit(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                 const solid::BodyLayout& layout) {
  if (!mechanism.is_papers()) return plan_template(mechanism, layout, std::nullopt);
  const Scene scene(mechanism);
  const std::vector<fusee::BearingType>& all = bearing_types();
  KitPlan plan;
  for (const fusee::BearingType& bearing : all) {
    // The catalogue begins with the largest bearing. Bearings wider than a third of R are avoided, except the smallest.
    if (bearing.outer > mechanism.joint.R / 3 && &bearing != &all.back()) continue;
    plan = plan_with_bearing(scene, synthesis, layout, bearing);
    if (plan.made()) break;
  }
  if (!plan.made()) return plan;
  add_notes(plan, mechanism, layout);
  make_parts(plan, mechanism, layout);
  return plan;
}

KitPlan plan_kit_of_turns(const Mechanism& mechanism, const solid::BodyLayout& layout, const TendonHeights& heights) {
  return plan_template(mechanism, layout, heights);
}

void TendonHeights::Span::include(double height) {
  low = std::min(low, height);
  high = std::max(high, height);
}

}  // namespace fusee::kit
