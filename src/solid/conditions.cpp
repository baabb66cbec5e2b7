#include "solid/conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "mechanism/catalogue.h"
#include "solid/bore.h"
#include "solid/condition_list.h"
#include "solid/hub.h"
#include "solid/plane_distance.h"
#include "solid/size.h"

namespace fusee::solid {
namespace {

// Clearance between a flange and a pin: print tolerance and run-out of the pulley. mm
constexpr double k_pin_gap = 0.5;

// Least thickness of a flange below a channel: two layers of 0.2 mm. mm
constexpr double k_least_channel_floor = 0.4;

// Least web between the holes of a horn: half a line of a 0.4 mm nozzle. With less, the holes merge. mm
constexpr double k_least_web = 0.2;

class Conditions {
 public:
  Conditions(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const BodyLayout& layout,
             const FlangeRims& rims)
      : mechanism_(mechanism),
        body_(mechanism.body),
        synthesis_(synthesis),
        layout_(layout),
        rims_(rims),
        d_(mechanism.tendon.diameter) {}

  std::vector<profile::Condition> all(const std::vector<AnchorRoom>& rooms) {
    add_rims();
    add_room();
    if (auto tall = too_tall(layout_)) list_.add(std::move(*tall));
    add_groove();
    add_bore_wall(synthesis_.p1);
    add_bore_wall(synthesis_.p2);
    if (auto flat = flat_off_shaft(body_, layout_.bore.shaft)) list_.add(std::move(*flat));
    add_horn();
    for (profile::Condition& condition : hub_conditions(mechanism_, layout_, inradius(rims_.upper)))
      list_.add(std::move(condition));
    for (const AnchorRoom& room : rooms) add_anchor(room);
    add_channel();
    if (mechanism_.sheath.is_there()) {
      // The pulley is at the motor, and only the sheath exits are near it.
      add_sheath_exit(transmission::Side::left);
      add_sheath_exit(transmission::Side::right);
      return list_.release();
    }
    add_pin("pin_clear_B", "B", {-mechanism_.guides.EB, mechanism_.pulley.EF}, "guides.EB_mm");
    add_pin("pin_clear_D", "D", {mechanism_.guides.ED, mechanism_.pulley.EF - mechanism_.guides.D_below_B},
            "guides.ED_mm");
    add_drum();
    return list_.release();
  }

 private:
  // A plan with valid rims needs no condition for them.
  void add_rims() {
    if (rims_.outside) return;
    list_.add("flange_rims", 0, 0, false,
              "the outlines are sampled too coarsely for a flange that projects over the edges of both grooves. Reduce "
              "--tolerance-mm");
  }

  void add_room() {
    if (!(body_.room > 0)) return;
    double reach = layout_.hub_radius;
    for (const Polygon* rim : {&rims_.lower, &rims_.middle, &rims_.upper})
      reach = std::max(reach, rim->empty() ? 0.0 : circumradius(*rim));
    list_.add(room_condition(mechanism_, 2.0 * reach));
  }

  void add_groove() {
    list_.add_least(
        "groove_depth", layout_.groove_depth, d_,
        fmt::format("the groove is {} mm deep (body.groove_depth_mm), less than the tendon's diameter of {} mm",
                    rounded(layout_.groove_depth), rounded(d_)));
  }

  Polygon floor_of(const profile::Outline& outline) const { return profile::parallel(outline, -0.5 * d_); }

  // The thinnest wall between a floor and the bore with its screw holes.
  Wall wall_to(const Polygon& floor, const BoreLayout& bore) const {
    Wall least = wall_between(floor, bore.outline);
    for (const Polygon& hole : bore.screw_holes) {
      const Wall other = wall_between(floor, hole);
      if (other.thickness < least.thickness) least = other;
    }
    return least;
  }

  // Checks the wall for the larger of two bores: the part's, which is compensated for shrinking holes, and the shaft's,
  // which is drawn in profile.dxf.
  void add_bore_wall(const profile::Outline& outline) {
    const Polygon floor = floor_of(outline);
    const Wall in_part = wall_to(floor, layout_.bore),
               in_drawing = wall_to(floor, bore_of_shaft(mechanism_, layout_.bore));
    const Wall& wall = in_part.thickness <= in_drawing.thickness ? in_part : in_drawing;
    list_.add_least(
        fmt::format("bore_wall_{}", transmission::pulley_name(outline.side)), wall.thickness, layout_.min_wall,
        fmt::format("the bore leaves {} to {}'s floor at {:.0f}°; at least {} mm is required (body.min_wall_mm)",
                    wall_words(wall.thickness), transmission::pulley_name(outline.side), degrees(wall.angle),
                    rounded(layout_.min_wall, 3)));
  }

  std::string horn_name() const { return body_.horn == k_own_horn ? "of [horn]" : body_.horn; }

  void add_horn() {
    if (body_.bore != Bore::horn) return;
    const bool apart = layout_.parts == Parts::two;
    const double depth = layout_.bore.horn_recess > 0 ? layout_.bore.horn_recess + layout_.bore.horn_ceiling : 0.0;
    const double height = apart ? layout_.z_mate : layout_.z_hub;
    list_.add_most(
        "horn_recess", depth, height - layout_.min_wall,
        fmt::format(
            "horn {}: {} requires a recess {} mm deep including its ceiling, {} only {} mm high", horn_name(),
            layout_.bore.spline_teeth > 0 ? "the shaft (horn.spline_length_mm)" : "the boss (horn.boss_height_mm)",
            rounded(depth, 3), apart ? "P1 (print.parts) is" : "the pulley is", rounded(height, 3)));
    const Web web = thinnest_web();
    list_.add_least(
        "horn_holes", web.thickness, k_least_web,
        fmt::format(
            "horn {}: {} remains between {} (with material.hole_compensation_mm); at least {} mm is required. Try {}",
            horn_name(), wall_words(web.thickness), web.between, k_least_web, web.change));
  }

  /// The web between two holes of a horn, and the change that would widen it.
  struct Web {
    double thickness = std::numeric_limits<double>::infinity();
    const char* between = "its holes";
    const char* change = "";
  };

  // Each hole counts as the circle around it.
  Web thinnest_web() const {
    struct Circle {
      Vec2 centre;
      double radius;
    };
    const auto around = [](const Polygon& hole) {
      Circle circle{Vec2::Zero(), 0};
      for (const Vec2& point : hole) circle.centre += point / static_cast<double>(hole.size());
      for (const Vec2& point : hole) circle.radius = std::max(circle.radius, (point - circle.centre).norm());
      return circle;
    };
    const BoreLayout& bore = layout_.bore;
    const bool sunk = bore.horn_recess > 0;
    Web least;
    const auto consider = [&least](const Web& web) {
      if (web.thickness < least.thickness) least = web;
    };
    if (sunk) {
      consider({distance_to_edges(bore.outline, Vec2::Zero()) - around(bore.screw_holes[0]).radius,
                "the recess and the centre hole", "a smaller horn.centre_hole_mm, which leaves a shoulder"});
    }
    std::vector<Circle> bolts;
    for (std::size_t k = sunk ? 1 : 0; k < bore.screw_holes.size(); ++k) bolts.push_back(around(bore.screw_holes[k]));
    for (std::size_t a = 0; a < bolts.size(); ++a) {
      consider({bolts[a].centre.norm() - bolts[a].radius - bore.radius,
                sunk ? "the screws and the boss" : "the screws and the centre hole",
                sunk ? "a larger horn.bolt_circle_mm, or a smaller horn.bolt_hole_mm or horn.boss_diameter_mm"
                     : "a larger horn.bolt_circle_mm, or a smaller horn.bolt_hole_mm or horn.centre_hole_mm"});
      for (std::size_t b = a + 1; b < bolts.size(); ++b) {
        consider({(bolts[a].centre - bolts[b].centre).norm() - bolts[a].radius - bolts[b].radius, "two screws",
                  "a larger horn.bolt_circle_mm, fewer in horn.bolt_count, or a smaller horn.bolt_hole_mm"});
      }
    }
    return least;
  }

  void add_anchor(const AnchorRoom& room) {
    const std::string past = body_.wrap > 0
                                 ? fmt::format(", {} deg or more past the end of the active arc (body.wrap_deg)",
                                               rounded(degrees(body_.wrap)))
                                 : "";
    list_.add_least(fmt::format("anchor_{}", transmission::pulley_name(room.side)), 2.0 * room.room, 2.0 * room.least,
                    fmt::format("{}'s tie-off has space for a knot pocket of {} mm; at least {} mm is required "
                                "(body.knot_pocket_mm) behind walls of {} mm (body.min_wall_mm){}",
                                transmission::pulley_name(room.side), rounded(2.0 * room.room, 3),
                                rounded(2.0 * room.least, 3), rounded(layout_.min_wall, 3), past));
  }

  void add_channel() {
    const double width = layout_.channel_width;
    list_.add_least(
        "channel_width", width, d_,
        fmt::format("the tie-off channels are {} mm wide (body.anchor_hole_mm), too narrow for a tendon of {} mm",
                    rounded(width), rounded(d_)));
    // Checked on the side of the bed only: on the side of the ceiling the flange is made as thick as required.
    const bool apart = layout_.parts == Parts::two;
    const double thickness = (apart ? std::min(layout_.z_mate - layout_.z_p1, layout_.z_p2 - layout_.z_mate)
                                    : std::min(layout_.z_p1, layout_.z_p2 - layout_.z_middle)) -
                             0.5 * width;
    list_.add_least("channel_floor", thickness, k_least_channel_floor,
                    thickness > 0
                        ? fmt::format("the tie-off channels, {} mm wide (body.anchor_hole_mm), leave {} mm of a flange",
                                      rounded(width), rounded(thickness, 3))
                        : fmt::format("the tie-off channels, {} mm wide (body.anchor_hole_mm), cut through a flange",
                                      rounded(width)));
  }

  /// Reach of the flanges within the angle that a disc subtends at the axis.
  double reach_within(const Vec2& centre, double radius) const {
    const double half_angle = elementary::asin(std::min(1.0, radius / centre.norm()));
    double reach = 0;
    // Nine directions across the disc.
    for (int i = -4; i <= 4; ++i) reach = std::max(reach, reach_towards(turned(centre, half_angle * i / 4.0)));
    return reach;
  }

  // Reach of the flanges under a pin over the stroke. The pulley turns clockwise by α under the pin, so in the pulley's
  // frame the pin moves counter-clockwise.
  double reach_towards(const Vec2& pin) const {
    if (synthesis_.stroke.empty()) return 0;
    const double home = elementary::atan2(pin.y(), pin.x());
    const double first = home + synthesis_.stroke.front().alpha,
                 span = synthesis_.stroke.back().alpha - synthesis_.stroke.front().alpha;
    double reach = 0;
    for (const Polygon* rim : {&rims_.lower, &rims_.middle, &rims_.upper}) {
      for (const Vec2& point : *rim) {
        double past_first = std::fmod(elementary::atan2(point.y(), point.x()) - first, k_two_pi);
        if (past_first < 0) past_first += k_two_pi;
        if (past_first <= span) reach = std::max(reach, point.norm());
      }
    }
    return reach;
  }

  void add_pin(const char* condition_name, const char* pin_name, const Vec2& pin, const char* key) {
    const double clear = pin.norm() - mechanism_.guides.radius - reach_towards(pin);
    list_.add_least(condition_name, clear, k_pin_gap,
                    fmt::format("pin {} ({}, pulley.EF_mm) {} mm {} the flanges; at least {} mm clearance is required",
                                pin_name, key, (clear > 0 ? "comes within " : "stands ") + rounded(std::abs(clear), 3),
                                clear > 0 ? "of" : "inside", k_pin_gap));
  }

  /// The file gives the sheath's exit as a point. The clearance allows for the tendon only, not for the part that holds
  /// the sheath.
  void add_sheath_exit(transmission::Side side) {
    const Sheath& sheath = mechanism_.sheath;
    const Vec2 exit(transmission::mirror_sign(side) * sheath.exit_across, sheath.exit_above);
    const double clear = exit.norm() - 0.5 * d_ - reach_towards(exit);
    const char* number = side == transmission::Side::left ? "1" : "2";
    list_.add_least(
        fmt::format("mouth_clear_{}", number), clear, k_pin_gap,
        fmt::format("the exit of sheath {} (sheath.exit_across_mm, sheath.exit_above_mm) {} mm {} the flanges, "
                    "at least {} mm clearance is required",
                    number, (clear > 0 ? "comes within " : "stands ") + rounded(std::abs(clear), 3),
                    clear > 0 ? "of" : "inside", k_pin_gap));
  }

  /// The drum stands over the pulley as a pin does.
  void add_drum() {
    if (!(mechanism_.joint.drum_radius > 0)) return;
    const Vec2 drum(0, mechanism_.guides.OE + mechanism_.pulley.EF);
    const double clear = drum.norm() - mechanism_.joint.drum_radius - reach_within(drum, mechanism_.joint.drum_radius);
    list_.add_least(
        "drum_clear", clear, k_pin_gap,
        fmt::format("the drum (joint.drum_radius_mm, guides.OE_mm, pulley.EF_mm) {} mm {} the flanges; at least {} mm "
                    "clearance is required",
                    (clear > 0 ? "comes within " : "stands ") + rounded(std::abs(clear), 3),
                    clear > 0 ? "of" : "inside", k_pin_gap));
  }
  const Mechanism& mechanism_;
  const Body& body_;
  const profile::SynthesisResult& synthesis_;
  const BodyLayout& layout_;
  const FlangeRims& rims_;
  double d_;  ///< diameter of the tendon
  ConditionList list_;
};

}  // namespace

profile::Condition room_condition(const Mechanism& mechanism, double diameter) {
  constexpr double k_resolution = 1e-3;  // mm, of numbers that are printed
  const double room = mechanism.body.room;
  profile::Condition condition;
  condition.name = "room";
  condition.ok = diameter <= room + k_resolution;
  condition.value = diameter;
  condition.limit = room;
  condition.unit = "mm";
  condition.message = fmt::format("the part is {} mm wide, and its room (body.room_diameter_mm) is {} mm",
                                  rounded(diameter, 5), rounded(room));
  return condition;
}

// A convex outline is closest to a hole inside it at one of the hole's corners.
Wall wall_between(const Polygon& floor, const Polygon& hole) {
  Wall wall{std::numeric_limits<double>::infinity(), 0};
  for (const Vec2& corner : hole) {
    const double depth = depth_inside(floor, corner);
    if (depth < wall.thickness) wall = {depth, elementary::atan2(corner.y(), corner.x())};
  }
  return wall;
}

std::vector<profile::Condition> conditions_of(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                                              const BodyLayout& layout, const FlangeRims& rims,
                                              const std::vector<AnchorRoom>& rooms) {
  return Conditions(mechanism, synthesis, layout, rims).all(rooms);
}

}  // namespace fusee::solid
