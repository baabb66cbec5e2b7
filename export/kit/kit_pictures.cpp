#include "export/kit/kit_pictures.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "export/report/tendon_trace.h"
#include "fusee/base.h"
#include "mechanism/catalogue.h"

namespace fusee::formats {
namespace {

constexpr double k_picture_width = 520, k_picture_height = 420, k_picture_margin = 10;  // of the SVG, in its units

/// A convex slab with holes at its place in the rig; its walls may be inclined.
struct DrawnSlab {
  Polygon below, above;
  double low = 0, high = 0;
  std::vector<Polygon> holes;  ///< in the upper face
  std::string css_class;       ///< without "-side" or "-top": "kit", "kit-new", "kit-bought"
};

/// A line in space.
struct DrawnLine {
  std::vector<Vec3> points;
  std::string classes;  ///< CSS classes
};

/// Parallel projection, seen from the front right and from above. In the picture y points down, as in SVG.
class Projection {
 public:
  Vec2 operator()(const Vec2& p, double z) const {
    const double azimuth = radians(-24), elevation = radians(38);
    const Vec2 q(p.x() * elementary::cos(azimuth) - p.y() * elementary::sin(azimuth),
                 p.x() * elementary::sin(azimuth) + p.y() * elementary::cos(azimuth));
    return {q.x(), -(q.y() * elementary::sin(elevation) + z * elementary::cos(elevation))};
  }
  Polygon operator()(const Polygon& polygon, double z) const {
    Polygon points;
    for (const Vec2& p : polygon) points.push_back((*this)(p, z));
    return points;
  }
};

/// Maps projected points to the picture: all included points fill it.
class Paper {
 public:
  void include(const Vec2& p) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
  Vec2 operator()(const Vec2& p) const {
    const Vec2 size = high_ - low_;
    const double scale = std::min((k_picture_width - 2 * k_picture_margin) / size.x(),
                                  (k_picture_height - 2 * k_picture_margin) / size.y());
    return Vec2(0.5 * k_picture_width, 0.5 * k_picture_height) + scale * (p - 0.5 * (low_ + high_));
  }
  std::vector<Vec2> operator()(const std::vector<Vec2>& points) const {
    std::vector<Vec2> result;
    for (const Vec2& p : points) result.push_back((*this)(p));
    constexpr double k_tolerance = 0.15;  // in units of the SVG
    return thinned(result, k_tolerance);
  }

 private:
  Vec2 low_{1e9, 1e9}, high_{-1e9, -1e9};
};

/// The letters of the mechanism at their places: axis O, pins B and D, the pulley's axis G, and C on the link.
std::string axis_letters(const Mechanism& mechanism, const Paper& paper) {
  std::string svg;
  const auto letter = [&](const char* name, const Vec2& place) {
    svg += svg_words("halo", paper(Vec2(place.x(), -place.y())) + Vec2(7, -6), name);
  };
  letter("O", {0, 0});
  letter("B", {-mechanism.guides.EB, -mechanism.guides.OE});
  letter("D", {mechanism.guides.ED, -mechanism.guides.OE});
  letter("G", pulley_axis(mechanism));
  letter("C", {0, mechanism.joint.R});
  return svg;
}

/// An outline of a part at one of its places. A part is turned over about the y axis.
Polygon placed_outline(Polygon outline, const kit::KitPlace& place) {
  for (Vec2& p : outline) p = Vec2(place.turned_over ? -p.x() : p.x(), p.y()) + place.shift;
  return outline;
}

void add_part(std::vector<DrawnSlab>& drawn, const kit::KitPart& part, const std::string& css_class) {
  for (const kit::KitPlace& place : part.places) {
    for (const kit::Slab& slab : part.body.slabs) {
      std::vector<Polygon> holes;
      for (const kit::SlabLoop& loop : slab.loops) {
        if (loop.hole)
          holes.push_back(
              placed_outline(kit::outline_of(loop.hull, place.turned_over ? loop.grow_low : loop.grow_high), place));
      }
      bool is_first_rim = true;  // the holes are drawn in one rim only
      for (const kit::SlabLoop& loop : slab.loops) {
        if (loop.hole) continue;
        DrawnSlab drawn_slab;
        drawn_slab.below = placed_outline(kit::outline_of(loop.hull, loop.grow_low), place);
        drawn_slab.above = placed_outline(kit::outline_of(loop.hull, loop.grow_high), place);
        drawn_slab.low = place.z + (place.turned_over ? -slab.high : slab.low);
        drawn_slab.high = place.z + (place.turned_over ? -slab.low : slab.high);
        if (place.turned_over) std::swap(drawn_slab.below, drawn_slab.above);
        if (is_first_rim) drawn_slab.holes = holes;
        is_first_rim = false;
        drawn_slab.css_class = css_class;
        drawn.push_back(std::move(drawn_slab));
      }
    }
  }
}

/// Adds an upright prism without holes.
void add_upright(std::vector<DrawnSlab>& drawn, const kit::DiscHull& hull, double low, double high,
                 const std::string& css_class) {
  const Polygon outline = kit::outline_of(hull);
  drawn.push_back({outline, outline, low, high, {}, css_class});
}

void add_motor(std::vector<DrawnSlab>& drawn, const KitProduct& product, const std::string& css_class) {
  const kit::KitSizes& sizes = product.plan.sizes;
  if (!sizes.motor) return;
  const MotorType& motor = *sizes.motor;
  const Vec2 axis = pulley_axis(product.pulley.joint.mechanism), front = sizes.motor_front;
  const Vec2 front_end = axis + motor.front * front, back_end = axis - motor.back * front;
  const Vec2 side(motor.side, 0);
  add_upright(drawn, kit::box(front_end.cwiseMin(back_end) - side, front_end.cwiseMax(back_end) + side, 1),
              -sizes.base - motor.depth, -sizes.base, css_class);
  constexpr double k_horn_radius = 3;  // mm, of a motor without shaft
  const double radius = motor.shaft > 0 ? 0.5 * motor.shaft : k_horn_radius;
  add_upright(drawn, kit::disc(axis, radius), -sizes.base,
              motor.shaft > 0 ? motor.shaft_length - sizes.base : sizes.pulley_low, css_class);
}

void add_rods(std::vector<DrawnSlab>& drawn, const kit::KitPlan& plan, const std::string& css_class) {
  const kit::KitSizes& sizes = plan.sizes;
  // Nuts and ends of the rods, mm beyond the parts.
  constexpr double k_foot_below = 3, k_foot_above = 4, k_axle_below = 2, k_axle_above = 2;
  for (const kit::KitPin& pin : plan.pins)
    add_upright(drawn, kit::disc(pin.place, pin.screw ? 0.5 * pin.screw->diameter : pin.radius), -sizes.base, pin.top,
                css_class);
  for (const Vec2& foot : plan.feet)
    add_upright(drawn, kit::disc(foot, 0.5 * sizes.foot->diameter), -sizes.base - k_foot_below,
                sizes.bracket_low + sizes.bracket + k_foot_above, css_class);
  add_upright(drawn, kit::disc({0, 0}, 0.5 * sizes.axle->diameter), -sizes.base - k_axle_below,
              sizes.link_low + sizes.link + k_axle_above, css_class);
}

void add_pulley(std::vector<DrawnSlab>& drawn, const KitProduct& product, const std::string& css_class) {
  const Product& pulley = product.pulley;
  const solid::BodyLayout& layout = pulley.pulley.layout;
  const double tendon_diameter = pulley.joint.mechanism.tendon.diameter, low = product.plan.sizes.pulley_low;
  const Vec2 axis = pulley_axis(pulley.joint.mechanism);
  const auto add = [&](const profile::Outline& outline, double offset, double from, double to) {
    Polygon shape = profile::parallel(outline, offset);
    for (Vec2& p : shape) p += axis;
    drawn.push_back({shape, shape, low + from, low + to, {}, css_class});
  };
  const double groove_floor = -0.5 * tendon_diameter, groove_edge = layout.groove_depth - 0.5 * tendon_diameter;
  const double half_groove = 0.6 * tendon_diameter;  // of the drawn groove, which is a little wider than the tendon
  add(pulley.synthesis.p1, groove_edge, 0, layout.z_p1 - half_groove);
  add(pulley.synthesis.p1, groove_floor, layout.z_p1 - half_groove, layout.z_p1 + half_groove);
  add(pulley.synthesis.p2, groove_edge, layout.z_p1 + half_groove, layout.z_p2 - half_groove);
  add(pulley.synthesis.p2, groove_floor, layout.z_p2 - half_groove, layout.z_p2 + half_groove);
  add(pulley.synthesis.p2, groove_edge, layout.z_p2 + half_groove, layout.z_top);
  if (layout.hub_radius > 0)
    add_upright(drawn, kit::disc(axis, layout.hub_radius), low + layout.z_top, low + layout.z_hub, css_class);
}

std::vector<DrawnLine> tendon_lines(const KitProduct& product) {
  std::vector<DrawnLine> lines;
  const Mechanism& mechanism = product.pulley.joint.mechanism;
  const kit::KitSizes& sizes = product.plan.sizes;
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const bool left = side == transmission::Side::left;
    const auto trace = trace_tendon(mechanism, left ? product.pulley.synthesis.p1 : product.pulley.synthesis.p2, 0, 0);
    if (!trace) continue;
    DrawnLine line{{}, left ? "kit-tendon p1" : "kit-tendon p2 whole"};
    const double z = left ? sizes.z_tendon1 : sizes.z_tendon2;
    for (const Vec2& p : trace->free_path) line.points.emplace_back(p.x(), p.y(), z);
    lines.push_back(std::move(line));
  }
  return lines;
}

void draw_slab(std::string& body, const DrawnSlab& slab, const Projection& project, const Paper& paper) {
  Polygon both = project(slab.below, slab.low);
  const Polygon above = project(slab.above, slab.high);
  both.insert(both.end(), above.begin(), above.end());
  body += svg_path(slab.css_class + "-side", paper(convex_hull(both)), true);
  std::string data = path_data(paper(above), true);
  for (const Polygon& hole : slab.holes) data += path_data(paper(project(hole, slab.high)), true);
  body += "<path class=\"" + slab.css_class + "-top\" fill-rule=\"evenodd\" d=\"" + data + "\"/>";
}

}  // namespace

Figure kit_picture(const KitProduct& product, const std::vector<KitStep>& steps, std::size_t last) {
  std::vector<DrawnSlab> drawn;
  std::vector<DrawnLine> lines;
  for (std::size_t i = 0; i <= last; ++i) {
    const KitStep& step = steps[i];
    const std::string css_class = i == last ? "kit-new" : "kit", bought = i == last ? "kit-bought" : "kit";
    for (const kit::KitPart& part : product.plan.parts) {
      if (std::find(step.parts.begin(), step.parts.end(), part.name) != step.parts.end())
        add_part(drawn, part, css_class);
    }
    if (step.motor) add_motor(drawn, product, bought);
    if (step.rods) add_rods(drawn, product.plan, bought);
    if (step.pulley) add_pulley(drawn, product, css_class);
    if (step.tendons) lines = tendon_lines(product);
  }
  // Higher slabs are drawn over lower ones, and at equal height the nearer ones over the further ones.
  const auto nearness = [](const DrawnSlab& slab) {
    double y = 1e9;
    for (const Vec2& p : slab.below) y = std::min(y, p.y());
    return -y;
  };
  std::stable_sort(drawn.begin(), drawn.end(), [&](const DrawnSlab& a, const DrawnSlab& b) {
    if (std::abs(a.low - b.low) > 1e-6) return a.low < b.low;
    return nearness(a) < nearness(b);
  });
  const Projection project;
  Paper paper;
  for (const DrawnSlab& slab : drawn) {
    for (const Vec2& p : project(slab.below, slab.low)) paper.include(p);
    for (const Vec2& p : project(slab.above, slab.high)) paper.include(p);
  }
  Figure figure{k_picture_width, k_picture_height, steps[last].title, {}, {}};
  std::size_t drawn_lines = 0;
  for (const DrawnSlab& slab : drawn) {
    // A tendon is drawn before the first slab that lies above it.
    for (; drawn_lines < lines.size() && lines[drawn_lines].points.front().z() < slab.low; ++drawn_lines) {
      std::vector<Vec2> points;
      for (const Vec3& p : lines[drawn_lines].points) points.push_back(project(Vec2(p.x(), p.y()), p.z()));
      figure.body += svg_path(lines[drawn_lines].classes, paper(points));
    }
    draw_slab(figure.body, slab, project, paper);
  }
  return figure;
}

Figure kit_plan_view(const KitProduct& product) {
  const Mechanism& mechanism = product.pulley.joint.mechanism;
  const kit::KitPlan& plan = product.plan;
  Paper paper;
  const double from = mechanism.joint.theta_min, to = mechanism.joint.theta_max;
  std::vector<Polygon> links;
  for (const double theta : {from, 0.0, to}) links.push_back(kit::link_outline(plan, mechanism, theta));
  const auto shown = [](const Polygon& points) {  // y points down in SVG
    std::vector<Vec2> result;
    for (const Vec2& p : points) result.emplace_back(p.x(), -p.y());
    return result;
  };
  const Polygon scale = kit::scale_outline(plan, mechanism);
  const Polygon base = kit::outline_of(plan.parts.front().body.slabs.front().loops.front().hull);
  const Polygon pulley = kit::outline_of(kit::disc(pulley_axis(mechanism), plan.sizes.pulley_radius));
  for (const Polygon& outline : {links[0], links[1], links[2], scale, base, pulley}) {
    for (const Vec2& p : shown(outline)) paper.include(p);
  }
  Figure figure{
      k_picture_width, k_picture_height, "From above: the link at home and at both ends of its range", {}, {}};
  figure.body = svg_path("kit-side", paper(shown(base)), true) + svg_path("kit-top", paper(shown(scale)), true);
  const auto circle = [&](const std::string& classes, const Vec2& place, double radius) {
    figure.body += svg_path(classes, paper(shown(kit::outline_of(kit::disc(place, radius)))), true);
  };
  figure.body += svg_path("kit-bought-top", paper(shown(pulley)), true);
  for (const kit::KitPin& pin : plan.pins) {
    circle("kit-new-top", pin.place, pin.collar);
    circle("kit-bought-top", pin.place, pin.radius);
  }
  constexpr double k_drawn_wall = 1.2;  // mm, of the tube around a foot's rod
  for (const Vec2& foot : plan.feet) circle("kit-new-top", foot, 0.5 * plan.sizes.foot->clearance + k_drawn_wall);
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const auto trace = trace_tendon(
        mechanism, side == transmission::Side::left ? product.pulley.synthesis.p1 : product.pulley.synthesis.p2, 0, 0);
    if (trace)
      figure.body += svg_path(side == transmission::Side::left ? "kit-tendon p1" : "kit-tendon p2 whole",
                              paper(shown(trace->free_path)));
  }
  for (const Polygon& link : links) figure.body += svg_path("main", paper(shown(link)), true);
  figure.body += axis_letters(mechanism, paper);
  return figure;
}

namespace {

/// The pitch curve of a side. For a multi-turn pulley: half a turn before and after the take-off at home.
profile::Outline home_outline(const Product& product, transmission::Side side) {
  if (!product.helix) return side == transmission::Side::left ? product.synthesis.p1 : product.synthesis.p2;
  const helix::HelixSide& helix = product.helix->synthesis.sides.at(side == transmission::Side::left ? 0 : 1);
  const auto home = std::min_element(
      helix.stroke.begin(), helix.stroke.end(),
      [](const helix::HelixPoint& a, const helix::HelixPoint& b) { return std::abs(a.wound) < std::abs(b.wound); });
  const double turn = helix.spiral.row_at(home->z).turn;
  profile::Outline outline;
  outline.side = side;
  for (const helix::SpiralRow& row : helix.spiral.rows) {
    if (std::abs(row.turn - turn) < k_pi)
      outline.points.push_back({row.turn, Vec2(row.x, row.y), unit(row.turn), row.rho});
  }
  outline.active_last = outline.points.size() - 1;
  return outline;
}

/// The whole pitch curve of a side, in the mechanism's frame.
std::vector<Vec2> pitch_curve(const Product& product, transmission::Side side) {
  const Vec2 axis = pulley_axis(product.joint.mechanism);
  std::vector<Vec2> points;
  if (product.helix) {
    for (const helix::SpiralRow& row :
         product.helix->synthesis.sides.at(side == transmission::Side::left ? 0 : 1).spiral.rows)
      points.emplace_back(axis + Vec2(row.x, row.y));
  } else {
    for (const profile::OutlinePoint& point :
         (side == transmission::Side::left ? product.synthesis.p1 : product.synthesis.p2).points)
      points.emplace_back(axis + point.position);
  }
  return points;
}

}  // namespace

Figure kit_template_view(const KitProduct& product) {
  const Product& pulley = product.pulley;
  const Mechanism& mechanism = pulley.joint.mechanism;
  Paper paper;
  const auto shown = [](const std::vector<Vec2>& points) {  // y points down in SVG
    std::vector<Vec2> result;
    for (const Vec2& p : points) result.emplace_back(p.x(), -p.y());
    return result;
  };
  std::vector<std::pair<std::string, Polygon>> drawn;
  for (const char* name : {"base_template", "drum", "link_template"}) {
    for (const kit::KitPart& part : product.plan.parts) {
      if (part.name != name) continue;
      const bool is_link = part.places.front().on_link, is_drum = part.name == "drum";
      const auto classes_of = [&](bool is_hole) {
        if (is_drum && !is_hole) return "kit-new-top";
        return is_hole || is_link ? "main" : "kit-top";
      };
      for (const kit::SlabLoop& loop : part.body.slabs.front().loops)
        drawn.emplace_back(classes_of(loop.hole), kit::outline_of(loop.hull));
    }
  }
  for (const auto& [classes, outline] : drawn) {
    for (const Vec2& p : shown(outline)) paper.include(p);
  }
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    for (const Vec2& p : shown(pitch_curve(pulley, side))) paper.include(p);
  }
  Figure figure{k_picture_width, k_picture_height, "From above, at home: base, drum and link with their holes", {}, {}};
  for (const auto& [classes, outline] : drawn) figure.body += svg_path(classes, paper(shown(outline)), true);
  const auto circle = [&](const std::string& classes, const Vec2& place, double radius) {
    figure.body += svg_path(classes, paper(shown(kit::outline_of(kit::disc(place, radius)))), true);
  };
  for (const kit::KitPin& pin : product.plan.pins) {
    circle("kit-bought-top", pin.place, pin.radius);
    if (mechanism.guides.kind == GuideKind::idler) circle("kit-bought-top", pin.place, mechanism.guides.bearing_radius);
  }
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    const profile::Outline outline = home_outline(pulley, side);
    figure.body += svg_path("main", paper(shown(pitch_curve(pulley, side))), !pulley.helix);
    if (mechanism.sheath.is_there())
      figure.body += "<g class=\"kit-sheath\" style=\"fill:none;stroke:#c9b48a;stroke-width:7\"><path d=\"" +
                     path_data(paper(shown(sheath_curve(mechanism, side))), false) + "\"/></g>";
    if (const auto trace = trace_tendon(mechanism, outline, 0, 0))
      figure.body += svg_path(side == transmission::Side::left ? "kit-tendon p1" : "kit-tendon p2 whole",
                              paper(shown(trace->free_path)));
  }
  figure.body += axis_letters(mechanism, paper);
  return figure;
}

}  // namespace fusee::formats
