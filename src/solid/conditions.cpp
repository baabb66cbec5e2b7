#include "solid/conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fusee/base/text.h"
#include "solid/bore.h"
#include "solid/hub.h"
#include "solid/plane_distance.h"
#include "solid/set_screw.h"

namespace fusee {
namespace {

// Between a flange and a pin that must not touch: print tolerance and a pulley that runs out a little.
constexpr double k_pin_gap = 0.5;

// A number taken from a message must do, though it was rounded to be written.
constexpr double k_grain = 1e-9;

// Numbers to advise: rounded to what people write, on the side that works.
double rounded_down(double value) { return 0.1 * std::floor(value / 0.1 + 1e-9); }
double rounded_up(double value) { return 0.1 * std::ceil(value / 0.1 - 1e-9); }

const char* name_of(Side side) { return side == Side::left ? "P1" : "P2"; }

class Conditions {
 public:
  Conditions(const Mechanism& mechanism, const SynthesisResult& synthesis, const BodyLayout& layout,
             const FlangeRims& rims)
      : mechanism_(mechanism),
        body_(mechanism.body),
        synthesis_(synthesis),
        layout_(layout),
        rims_(rims),
        d_(mechanism.tendon.diameter) {}

  std::vector<Condition> all(const std::vector<AnchorRoom>& rooms) {
    add_groove();
    add_bore_wall(synthesis_.p1);
    add_bore_wall(synthesis_.p2);
    add_horn();
    add_hub();
    add_set_screw();
    for (const AnchorRoom& room : rooms) add_anchor(room);
    add_channel();
    add_pin("pin_clear_B", "B", {-mechanism_.guides.EB, mechanism_.pulley.EF}, "guides.EB_mm");
    add_pin("pin_clear_D", "D", {mechanism_.guides.ED, mechanism_.pulley.EF}, "guides.ED_mm");
    return std::move(result_);
  }

 private:
  // What stands after the fact, the numbers to change, is said only where it is needed.
  void add(std::string name, double value, double limit, bool ok, std::string fact, const std::string& advice) {
    if (!ok && !advice.empty()) fact += ": " + advice;
    Condition condition;
    condition.name = std::move(name);
    condition.ok = ok;
    condition.value = value;
    condition.limit = limit;
    condition.unit = "mm";
    condition.message = std::move(fact);
    result_.push_back(std::move(condition));
  }
  void add_least(std::string name, double value, double least, std::string fact, const std::string& advice) {
    add(std::move(name), value, least, value >= least - k_grain, std::move(fact), advice);
  }
  void add_most(std::string name, double value, double most, std::string fact, const std::string& advice) {
    add(std::move(name), value, most, value <= most + k_grain, std::move(fact), advice);
  }

  void add_groove() {
    add_least("groove_depth", layout_.groove_depth, d_,
              fmt::format("the groove is {} mm deep for a tendon of {} mm", rounded(layout_.groove_depth), rounded(d_)),
              fmt::format("make body.groove_depth_mm ≥ {}, or 0 (automatic)", rounded(d_)));
    const double foot = layout_.elephant_foot, flange = layout_.flange_thickness;
    add_least("flange_thickness", flange, foot + 0.2,
              fmt::format("the lower flange is {} mm thick, the chamfer at the bed takes {} mm of it", rounded(flange),
                          rounded(foot)),
              fmt::format("make body.flange_thickness_mm ≥ {}, or material.elephant_foot_mm ≤ {}", rounded(foot + 0.2),
                          rounded(std::max(0.0, flange - 0.2))));
    const double deepest = layout_.groove_depth - 0.1;
    add_most("elephant_foot", foot, deepest, fmt::format("the chamfer at the bed is {} mm wide", rounded(foot)),
             fmt::format("make material.elephant_foot_mm ≤ {}, or the groove deeper", rounded(deepest)));
  }

  Polygon floor(const Outline& outline) const { return parallel(outline, -0.5 * d_); }

  Wall wall_to(const Polygon& floor_polygon, const BoreLayout& bore) const {
    Wall least = wall_between(floor_polygon, bore.outline);
    for (const Polygon& hole : bore.screw_holes) {
      const Wall other = wall_between(floor_polygon, hole);
      if (other.thickness < least.thickness) least = other;
    }
    return least;
  }

  // The wall grows as the bore shrinks, facet by facet: found by halving.
  double largest_bore(const Polygon& floor_polygon) const {
    double low = 0, high = body_.bore_diameter;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      const BoreLayout bore = bore_layout(body_, middle, mechanism_.material.hole_compensation);
      (wall_to(floor_polygon, bore).thickness >= body_.min_wall ? low : high) = middle;
    }
    return rounded_down(low);
  }

  void add_bore_wall(const Outline& outline) {
    const Polygon floor_polygon = floor(outline);
    const Wall wall = wall_to(floor_polygon, layout_.bore);
    add_least(fmt::format("bore_wall_{}", name_of(outline.side)), wall.thickness, body_.min_wall,
              fmt::format("the bore leaves a wall of {} mm to {}'s floor at {:.0f}°", rounded(wall.thickness, 3),
                          name_of(outline.side), degrees(wall.angle)),
              fmt::format("{}", fmt::join(bore_advice(floor_polygon, wall), ", or ")));
  }

  std::vector<std::string> bore_advice(const Polygon& floor_polygon, const Wall& wall) const {
    std::vector<std::string> advice;
    if (body_.bore != Bore::horn && body_.bore_diameter > 0) {
      if (const double bore = largest_bore(floor_polygon); bore > 0)
        advice.push_back(fmt::format("make body.bore_diameter_mm ≤ {:.1f}", bore));
    }
    const double thinner = 0.01 * std::floor(100.0 * wall.thickness);
    if (thinner >= 0.1) advice.push_back(fmt::format("body.min_wall_mm ≤ {:.2f}", thinner));
    if (mechanism_.pulley.law == Law::compensate && mechanism_.pulley.r1 > 0) {
      // Outlines grow about in proportion to r1.
      const double reach = inradius(floor_polygon) + 0.5 * d_;
      const double needed = mechanism_.pulley.r1 * (reach + body_.min_wall - wall.thickness) / reach;
      advice.push_back(fmt::format("pulley.r1_mm ≥ {:.1f}", rounded_up(needed)));
    }
    return advice;
  }

  void add_horn() {
    if (body_.bore != Bore::horn) return;
    const double deepest = layout_.z_hub - body_.min_wall;
    add_most("horn_recess", layout_.bore.horn_recess, deepest,
             fmt::format("the recess of horn {} is {} mm deep, the pulley {} mm high", body_.horn,
                         rounded(layout_.bore.horn_recess), rounded(layout_.z_hub)),
             "make body.flange_thickness_mm or body.groove_depth_mm larger");
    const double gap = horn_gap();
    add_least("horn_holes", gap, 0.2,
              fmt::format("the holes of horn {} leave {} mm between them", body_.horn, rounded(gap, 3)),
              "make material.hole_compensation_mm smaller, or take another body.horn");
  }

  // The thinnest web between a horn's holes, as circles.
  double horn_gap() const {
    struct Circle {
      Vec2 centre;
      double radius;
    };
    const auto circle = [](const Polygon& hole) {
      Vec2 centre = Vec2::Zero();
      for (const Vec2& point : hole) centre += point / static_cast<double>(hole.size());
      return Circle{centre, (hole.front() - centre).norm()};
    };
    std::vector<Circle> circles{circle(layout_.bore.outline)};
    const std::size_t first = layout_.bore.horn_recess > 0 ? 1 : 0;
    for (std::size_t k = first; k < layout_.bore.screw_holes.size(); ++k)
      circles.push_back(circle(layout_.bore.screw_holes[k]));
    double gap = std::numeric_limits<double>::infinity();
    if (first == 1) gap = circles[0].radius - circle(layout_.bore.screw_holes[0]).radius;
    for (std::size_t a = 0; a < circles.size(); ++a) {
      for (std::size_t b = a + 1; b < circles.size(); ++b) {
        gap = std::min(gap, (circles[a].centre - circles[b].centre).norm() - circles[a].radius - circles[b].radius);
      }
    }
    return gap;
  }

  void add_hub() {
    if (layout_.hub_radius <= 0) return;
    const double diameter = 2.0 * layout_.hub_radius, wall = layout_.hub_radius - layout_.bore.radius;
    add_least("hub_wall", wall, body_.min_wall,
              fmt::format("a hub of {} mm leaves a wall of {} mm about the bore", rounded(diameter), rounded(wall, 3)),
              fmt::format("make body.hub_diameter_mm ≥ {:.1f}, or 0 (automatic)",
                          rounded_up(2.0 * (layout_.bore.radius + body_.min_wall))));
    const double limit = 2.0 * (inradius(rims_.upper) - k_hub_margin);
    add_most("hub_on_flange", diameter, limit,
             fmt::format("the upper flange has room for a hub of {} mm, this one has {} mm", rounded(limit),
                         rounded(diameter)),
             fmt::format("make body.hub_diameter_mm ≤ {:.1f}, or 0 (automatic)", rounded_down(limit)));
  }

  // Only a set screw that was asked for by name can be impossible.
  void add_set_screw() {
    if (body_.set_screw == "auto" || body_.set_screw == "none" || body_.bore == Bore::horn) return;
    const double diameter = 2.0 * layout_.hub_radius, needed = 2.0 * hub_radius_for_named_screw();
    if (!layout_.set_screw.present) {
      add("set_screw_wall", diameter, needed, false,
          fmt::format("there is no place for set screw {}, which needs a hub of {:.1f} mm and a side of it without a "
                      "knot pocket",
                      body_.set_screw, rounded_up(needed)),
          "make body.set_screw \"auto\" or a smaller one, body.hub_height_mm ≥ 8, or pulley.r1_mm larger");
      return;
    }
    add_least("set_screw_wall", diameter, needed,
              fmt::format("set screw {} needs a hub of {:.1f} mm, this one has {} mm", body_.set_screw,
                          rounded_up(needed), rounded(diameter)),
              fmt::format("make body.hub_diameter_mm ≥ {:.1f}, or 0 (automatic), or body.nut_trap false",
                          rounded_up(needed)));
    const double spare = height_to_spare(layout_.set_screw, layout_, body_.min_wall);
    add_least(
        "set_screw_height", spare, 0.0,
        fmt::format("a hub {} mm high has {} mm of height to spare about set screw {}", rounded(body_.hub_height),
                    rounded(spare, 3), body_.set_screw),
        fmt::format("make body.hub_height_mm ≥ {:.1f}", rounded_up(body_.hub_height - 2.0 * std::min(0.0, spare))));
  }

  double hub_radius_for_named_screw() const {
    const Screw* screw = find_screw(body_.set_screw);
    if (screw == nullptr) return 0;
    return hub_radius_for(
        set_screw_layout(*screw, body_.nut_trap, mechanism_.material.hole_compensation, body_.min_wall, layout_),
        layout_.bore.radius, body_.min_wall);
  }

  void add_anchor(const AnchorRoom& room) {
    std::vector<std::string> advice;
    if (room.bore_that_fits > 0)
      advice.push_back(fmt::format("make body.bore_diameter_mm ≤ {:.1f}", room.bore_that_fits));
    if (room.min_wall_that_fits > 0)
      advice.push_back(fmt::format("make body.min_wall_mm ≤ {:.2f}", room.min_wall_that_fits));
    if (body_.knot_pocket > 0 && room.room > 0) {
      advice.push_back(
          fmt::format("make body.knot_pocket_mm ≤ {:.1f}, or 0 (automatic)", rounded_down(2.0 * room.room)));
    }
    if (advice.empty())
      advice.emplace_back("make the pulley larger (pulley.r1_mm) or the tendon thinner (tendon.diameter_mm)");
    add_least(fmt::format("anchor_{}", name_of(room.side)), 2.0 * room.room, 2.0 * room.least,
              fmt::format("{}'s tie-off has room for a knot pocket of {} mm, at least {} mm are needed",
                          name_of(room.side), rounded(2.0 * room.room, 3), rounded(2.0 * room.least, 3)),
              fmt::format("{}", fmt::join(advice, ", or ")));
  }

  void add_channel() {
    const double width = layout_.channel_width;
    add_least("channel_width", width, d_,
              fmt::format("the tie-off channels are {} mm wide for a tendon of {} mm", rounded(width), rounded(d_)),
              fmt::format("make body.anchor_hole_mm ≥ {}, or 0 (automatic)", rounded(d_ + 0.2)));
    constexpr double least = 0.4;
    const double below = layout_.z_p1 - 0.5 * width;
    add_least(
        "channel_floor", below, least,
        fmt::format("the tie-off channels leave {} mm of the lower flange", rounded(below, 3)),
        fmt::format("make body.anchor_hole_mm ≤ {:.1f}, or 0 (automatic)", rounded_down(2.0 * (layout_.z_p1 - least))));
  }

  // The pulley turns clockwise by α under the pin: in its own frame the pin goes round counter-clockwise.
  double reach_towards(const Vec2& pin) const {
    if (synthesis_.stroke.empty()) return 0;
    const double home = std::atan2(pin.y(), pin.x());
    const double first = home + synthesis_.stroke.front().alpha,
                 span = synthesis_.stroke.back().alpha - synthesis_.stroke.front().alpha;
    double reach = 0;
    for (const Polygon* rim : {&rims_.lower, &rims_.middle, &rims_.upper}) {
      for (const Vec2& point : *rim) {
        double turned = std::fmod(std::atan2(point.y(), point.x()) - first, k_two_pi);
        if (turned < 0) turned += k_two_pi;
        if (turned <= span) reach = std::max(reach, point.norm());
      }
    }
    return reach;
  }

  void add_pin(const char* condition_name, const char* pin_name, const Vec2& pin, const char* key) {
    const double clear = pin.norm() - mechanism_.guides.radius - reach_towards(pin);
    const double needed = pin.norm() + k_pin_gap - clear;
    const auto leg = [needed](double other) { return std::sqrt(std::max(0.0, needed * needed - other * other)); };
    add_least(condition_name, clear, k_pin_gap,
              fmt::format("pin {} comes within {} mm of the flanges", pin_name, rounded(clear, 3)),
              fmt::format("make pulley.EF_mm ≥ {:.1f}, or {} ≥ {:.1f}, or body.groove_depth_mm ≤ {:.1f}",
                          rounded_up(leg(pin.x())), key, rounded_up(leg(pin.y())),
                          rounded_down(layout_.groove_depth - (k_pin_gap - clear))));
  }

  const Mechanism& mechanism_;
  const Body& body_;
  const SynthesisResult& synthesis_;
  const BodyLayout& layout_;
  const FlangeRims& rims_;
  double d_;
  std::vector<Condition> result_;
};

}  // namespace

// A hole inside a convex outline comes nearest to it with one of its own corners.
Wall wall_between(const Polygon& floor, const Polygon& hole) {
  Wall wall{std::numeric_limits<double>::infinity(), 0};
  for (const Vec2& corner : hole) {
    const double depth = depth_inside(floor, corner);
    if (depth < wall.thickness) wall = {depth, std::atan2(corner.y(), corner.x())};
  }
  return wall;
}

std::vector<Condition> conditions_of(const Mechanism& mechanism, const SynthesisResult& synthesis,
                                     const BodyLayout& layout, const FlangeRims& rims,
                                     const std::vector<AnchorRoom>& rooms) {
  return Conditions(mechanism, synthesis, layout, rims).all(rooms);
}

}  // namespace fusee
