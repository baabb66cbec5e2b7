#include "export/report/drawing.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "export/report/tendon_trace.h"
#include "fusee/base.h"
#include "mechanism/lengths.h"

namespace fusee::formats {
namespace {

// Placing on paper ----------------------------------------------------------------------------------------------------

/// Maps the mechanism (mm, y up) to the figure (px, y down).
struct View {
  Vec2 low{1e9, 1e9};
  Vec2 high{-1e9, -1e9};
  double scale = 1;
  Vec2 origin{0, 0};

  void include(const Vec2& point, double margin = 0) {
    if (!point.allFinite()) return;
    low = low.cwiseMin(point - Vec2(margin, margin));
    high = high.cwiseMax(point + Vec2(margin, margin));
  }
  /// Fits the included points into a width and a height at (left, top).
  void fit(double left, double top, double width, double height) {
    const Vec2 size = (high - low).cwiseMax(Vec2(1e-6, 1e-6));
    scale = std::min(width / size.x(), height / size.y());
    const Vec2 middle = 0.5 * (low + high);
    origin = {left + 0.5 * width - scale * middle.x(), top + 0.5 * height + scale * middle.y()};
  }
  Vec2 operator()(const Vec2& point) const { return {origin.x() + scale * point.x(), origin.y() - scale * point.y()}; }
  std::vector<Vec2> operator()(std::vector<Vec2> points) const {
    for (Vec2& point : points) point = (*this)(point);
    return points;
  }
};

std::vector<Vec2> closed_copy(std::vector<Vec2> points) {
  if (!points.empty()) points.push_back(points.front());
  return points;
}

constexpr double k_drawing_tolerance = 0.15;  // px

std::string curve(std::string_view classes, const View& view, const std::vector<Vec2>& points, bool closed = false) {
  return svg_path(classes, thinned(view(points), k_drawing_tolerance), closed);
}

std::string ink(transmission::Side side) { return side == transmission::Side::left ? "p1" : "p2"; }

/// A round length for a scale bar of about `px` pixels.
double scale_bar_length(double scale, double px) {
  const double rough = px / scale;
  const double decade = elementary::pow(10.0, std::floor(elementary::log10(rough)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * decade <= rough) return factor * decade;
  }
  return decade;
}

/// A bar of a round length in the file's unit.
std::string scale_bar(const View& view, const Vec2& left_end, LengthUnit units) {
  const double unit = to_mm(1, units);
  const double length = scale_bar_length(view.scale * unit, 80);
  const Vec2 right_end = left_end + Vec2(length * view.scale * unit, 0);
  const Vec2 tick(0, 4);
  return svg_line("dimension", left_end, right_end) + svg_line("dimension", left_end - tick, left_end + tick) +
         svg_line("dimension", right_end - tick, right_end + tick) +
         svg_words("soft middle", 0.5 * (left_end + right_end) - Vec2(0, 6),
                   rounded(length) + " " + std::string(unit_word(units)));
}

// Mechanism -----------------------------------------------------------------------------------------------------------

constexpr double k_panel_width = 290;
constexpr double k_panel_height = 345;
constexpr double k_detail_height = 230;
constexpr double k_moving_width = 520;
constexpr double k_moving_height = 560;

double pulley_reach(const profile::SynthesisResult& synthesis) {
  return std::max(circumradius(profile::parallel(synthesis.p1, 0)), circumradius(profile::parallel(synthesis.p2, 0)));
}

/// A box in px.
struct PaperBox {
  double left, top, width, height;
};

View fitted(View view, const PaperBox& box) {
  view.fit(box.left, box.top, box.width, box.height);
  return view;
}

/// A view that contains the joint at each of these angles.
View mechanism_view(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                    const std::vector<double>& thetas, const PaperBox& box) {
  View view;
  view.include({0, 0}, 0.06 * mechanism.joint.R);
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    view.include(pin_centre(mechanism, side), mechanism.guide_pitch_radius() + 0.5 * mechanism.tendon.diameter);
  }
  if (mechanism.sheath.is_there()) {
    for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
      for (const Vec2& point : sheath_curve(mechanism, side)) view.include(point, mechanism.tendon.diameter);
    }
  }
  view.include(pulley_axis(mechanism), pulley_reach(synthesis));
  if (mechanism.joint.drum_radius > 0) view.include({0, 0}, mechanism.drum_pitch_radius());
  for (const double theta : thetas) {
    for (const transmission::Side side : {transmission::Side::left, transmission::Side::right})
      view.include(attachment(mechanism, side, theta));
  }
  return fitted(view, box);
}

/// The pulley alone, enlarged.
View pulley_view(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const PaperBox& box) {
  View view;
  view.include(pulley_axis(mechanism), pulley_reach(synthesis));
  return fitted(view, box);
}

/// A group that turns with the pulley: the outlines at home.
std::string pulley_group(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const View& view,
                         double alpha) {
  const Vec2 axis = pulley_axis(mechanism);
  const Vec2 centre = view(axis);
  std::string svg = "<g class=\"pulley\" transform=\"rotate(" + svg_number(degrees(alpha)) + " " +
                    svg_number(centre.x()) + " " + svg_number(centre.y()) + ")\">";
  for (const profile::Outline* outline : {&synthesis.p1, &synthesis.p2}) {
    std::vector<Vec2> points = closed_copy(profile::parallel(*outline, 0));
    for (Vec2& point : points) point += axis;
    svg += curve("thin " + ink(outline->side), view, points);
  }
  // The home mark, which points to +y at α = 0.
  svg += svg_line("axis-line", centre, centre - Vec2(0, pulley_reach(synthesis) * view.scale + 7));
  return svg + svg_circle("metal", centre, 3) + "</g>";
}

std::string tendon_name(transmission::Side side) { return side == transmission::Side::left ? "tendon1" : "tendon2"; }

std::string tendon_group(const TendonTrace& trace, const View& view, const Mechanism& mechanism,
                         transmission::Side side) {
  const double width = std::max(2.0, mechanism.tendon.diameter * view.scale);
  // Tendon 2 is dashed, so that tendon 1 is visible below it.
  const std::string dashes = side == transmission::Side::right
                                 ? ";stroke-dasharray:" + svg_number(3 * width) + " " + svg_number(1.6 * width)
                                 : "";
  std::string svg =
      "<g class=\"tendon " + tendon_name(side) + "\" style=\"stroke-width:" + svg_number(width) + dashes + "\">";
  svg += curve(ink(side), view, trace.free_path) + curve(ink(side), view, trace.wound_path);
  return svg + "</g>" + svg_circle("take-off off-" + tendon_name(side), view(trace.take_off), 3);
}

std::string joint_group(const Mechanism& mechanism, const View& view, double theta) {
  const Vec2 joint = view({0, 0});
  const Vec2 end = view(attachment(mechanism, transmission::Side::left, theta));
  if (!mechanism.joint.is_plain()) {
    const Vec2 other = view(attachment(mechanism, transmission::Side::right, theta));
    std::string svg;
    if (mechanism.joint.drum_radius > 0)
      svg = svg_circle("metal drum", joint, mechanism.joint.drum_radius * view.scale);
    return svg + "<g class=\"joint-link\">" + svg_path("link", {end, joint, other}) + "</g>" +
           svg_circle("metal", joint, 5) + svg_circle("take-off at-c", end, 3.5) +
           svg_circle("take-off at-c2", other, 3.5);
  }
  return "<g class=\"joint-link\">" + svg_line("link", joint, end) + "</g>" + svg_circle("metal", joint, 5) +
         svg_circle("take-off at-c", end, 3.5);
}

std::string pins(const Mechanism& mechanism, const View& view) {
  std::string svg;
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    svg += svg_circle("metal", view(pin_centre(mechanism, side)), std::max(1.5, mechanism.guides.radius * view.scale));
    if (mechanism.guides.kind == GuideKind::idler)
      svg += svg_circle("metal", view(pin_centre(mechanism, side)), mechanism.guides.bearing_radius * view.scale);
  }
  return svg;
}

/// A wide, pale line below everything else, with a ring at each exit.
std::string sheaths(const Mechanism& mechanism, const View& view) {
  if (!mechanism.sheath.is_there()) return "";
  const double width = std::max(13.0, 4.0 * mechanism.tendon.diameter * view.scale);
  std::string svg =
      "<g class=\"sheath\" style=\"fill:none;stroke:currentColor;stroke-opacity:.22;stroke-width:" + svg_number(width) +
      "\">";
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right})
    svg += "<path d=\"" + path_data(thinned(view(sheath_curve(mechanism, side)), k_drawing_tolerance), false) + "\"/>";
  svg += "</g>";
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right})
    svg += svg_circle("metal", view(sheath_exit(mechanism, side)), 0.4 * width);
  return svg;
}

std::string point_names(const Mechanism& mechanism, const View& view, double theta) {
  const double gap = mechanism.guide_pitch_radius() * view.scale + 12;
  const Vec2 name_offset = 15 * Vec2(elementary::sin(theta), -elementary::cos(theta)) + Vec2(0, 4);
  const Vec2 c = view(attachment(mechanism, transmission::Side::left, theta)),
             other = view(attachment(mechanism, transmission::Side::right, theta));
  const bool plain = mechanism.joint.is_plain(), apart = !plain && (other - c).norm() > 1;
  return svg_words("halo middle name-c", c + name_offset,
                   plain   ? "C"
                   : apart ? "A1"
                           : "A1, A2") +
         (apart ? svg_words("halo middle name-c2", other + name_offset, "A2") : "") +
         svg_words("halo", view({0, 0}) + Vec2(9, 5), "O") +
         svg_words("halo middle", view(pin_centre(mechanism, transmission::Side::left)) + Vec2(gap, 5), "B") +
         svg_words("halo middle", view(pin_centre(mechanism, transmission::Side::right)) + Vec2(-gap, 5), "D") +
         svg_words("halo", view(pulley_axis(mechanism)) + Vec2(7, 15), "G");
}

std::string scene(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const View& view,
                  const Pose& pose) {
  std::string svg = sheaths(mechanism, view) + joint_group(mechanism, view, pose.theta) +
                    pulley_group(mechanism, synthesis, view, pose.alpha) + pins(mechanism, view);
  for (const profile::Outline* outline : {&synthesis.p1, &synthesis.p2}) {
    if (const auto trace = trace_tendon(mechanism, *outline, pose.alpha, pose.theta)) {
      svg += tendon_group(*trace, view, mechanism, outline->side);
    }
  }
  return svg + point_names(mechanism, view, pose.theta);
}

Figure mechanism_figure(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const View& whole,
                        const View& detail, const Pose& pose) {
  const std::string angles =
      "θ = " + readable(degrees(pose.theta), 1) + "°, α = " + readable(degrees(pose.alpha), 1) + "°";
  Figure figure{k_panel_width, k_panel_height + k_detail_height, "The mechanism at " + angles, {}, {}};
  figure.body = svg_words("heading", {4, 18}, angles) + scene(mechanism, synthesis, whole, pose) +
                scale_bar(whole, {6, k_panel_height - 8}, mechanism.units);
  // A nested svg clips the detail.
  figure.body += "<svg x=\"1\" y=\"" + svg_number(k_panel_height) + "\" width=\"" + svg_number(k_panel_width - 2) +
                 "\" height=\"" + svg_number(k_detail_height - 1) + "\">" + scene(mechanism, synthesis, detail, pose) +
                 scale_bar(detail, {10, k_detail_height - 14}, mechanism.units) + "</svg>";
  const Vec2 low(1, k_panel_height), high(k_panel_width - 1, k_panel_height + k_detail_height - 1);
  figure.body += svg_path("frame", {low, {high.x(), low.y()}, high, {low.x(), high.y()}}, true);
  return figure;
}

// The joint to be moved -----------------------------------------------------------------------------------------------

/// The point nearest to α = 0. `stroke` must not be empty.
const transmission::TransmissionPoint& home_of(const std::vector<transmission::TransmissionPoint>& stroke) {
  return *std::min_element(stroke.begin(), stroke.end(),
                           [](const auto& a, const auto& b) { return std::abs(a.alpha) < std::abs(b.alpha); });
}

Figure moving_figure(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const View& view,
                     const Pose& pose, const std::string& title) {
  Figure figure{k_moving_width, k_moving_height, title, {}, {}};
  const Vec2 origin = view({0, 0});
  figure.body = "<g class=\"scene\" data-view=\"" + shortest(view.scale) + " " + shortest(origin.x()) + " " +
                shortest(origin.y()) + "\">" + scene(mechanism, synthesis, view, pose) + "</g>" +
                scale_bar(view, {6, k_moving_height - 8}, mechanism.units);
  return figure;
}

// Dimensions of the joint ---------------------------------------------------------------------------------------------

constexpr double k_sketch_width = 380;
constexpr double k_sketch_height = 460;

/// A horizontal dimension between two abscissae (mm), drawn at the height `y` (px). A short one has its name outside.
std::string horizontal_dimension(const View& view, double from, double to, double y, const std::string& name) {
  const double left = view({std::min(from, to), 0}).x(), right = view({std::max(from, to), 0}).x();
  const Vec2 tick(0, 4);
  std::string svg = svg_line("dimension", {left, y}, {right, y});
  for (const double x : {left, right}) svg += svg_line("dimension", Vec2(x, y) - tick, Vec2(x, y) + tick);
  if (right - left > words_width(name, 13) + 8)
    return svg + svg_words("small halo middle", {0.5 * (left + right), y + 4}, name);
  return svg +
         (from < to ? svg_words("small", {right + 6, y + 4}, name) : svg_words("small end", {left - 6, y + 4}, name));
}

/// A vertical dimension between two heights (mm), drawn at `x` (px), with its name beside it.
std::string vertical_dimension(const View& view, double from, double to, double x, const std::string& name) {
  const double top = view({0, std::max(from, to)}).y(), bottom = view({0, std::min(from, to)}).y();
  const Vec2 tick(4, 0);
  std::string svg = svg_line("dimension", {x, top}, {x, bottom});
  for (const double y : {top, bottom}) svg += svg_line("dimension", Vec2(x, y) - tick, Vec2(x, y) + tick);
  const bool is_left = x < view({0, 0}).x();
  return svg +
         svg_words(is_left ? "small halo end" : "small halo", {x + (is_left ? -7 : 7), 0.5 * (top + bottom) + 4}, name);
}

/// A radius from a centre to the lower left, with its name on it, because tendons may pass outside.
std::string named_radius(const View& view, const Vec2& centre, double radius, const std::string& name) {
  const Vec2 from = view(centre), to = view(centre + radius * unit(radians(215.0)));
  return svg_line("dimension", from, to) + svg_words("small halo middle", 0.5 * (from + to) + Vec2(0, 4), name);
}

// Profile -------------------------------------------------------------------------------------------------------------

constexpr double k_profile_width = 480;
constexpr double k_profile_height = 532;

/// A dimension along a radius: a line from the axis to the point (mm), and its length beside the point.
std::string radius_dimension(const View& view, const Vec2& point) {
  const Vec2 tip = view(point);
  const Vec2 outward = (tip - view({0, 0})).normalized();
  const std::string anchor = outward.x() < -0.3 ? " end" : outward.x() > 0.3 ? "" : " middle";
  return svg_line("dimension", view({0, 0}), tip) +
         svg_words("small halo" + anchor, tip + 26 * outward + Vec2(0, 4), readable(point.norm(), 3));
}

/// Horizontal overall size below the drawing.
std::string width_dimension(const View& view, double low, double high, double bottom_px, const std::string& words) {
  const Vec2 left(view({low, 0}).x(), bottom_px);
  const Vec2 right(view({high, 0}).x(), bottom_px);
  const Vec2 tick(0, 5);
  return svg_line("dimension", left, right) + svg_line("dimension", left - tick, left + tick) +
         svg_line("dimension", right - tick, right + tick) +
         svg_words("small middle", 0.5 * (left + right) + Vec2(0, 17), words);
}

std::vector<Vec2> arc_points(const profile::Outline& outline, std::size_t first, std::size_t last) {
  std::vector<Vec2> points;
  const std::size_t n = outline.points.size();
  for (std::size_t i = first;; i = (i + 1) % n) {
    points.push_back(outline.points[i].position);
    if (i == last) return points;
  }
}

std::string anchors(const View& view, const solid::Pulley& pulley, transmission::Side side) {
  std::string svg;
  for (const solid::Anchor& anchor : pulley.anchors) {
    if (anchor.side != side) continue;
    svg += curve("hole", view, anchor.channel, true) +
           svg_circle("hole", view(anchor.pocket), solid::pocket_radius(anchor, pulley.layout) * view.scale);
    if (anchor.tail) {
      svg += curve("hole", view, anchor.tail->outline(), true);
      if (anchor.tail->pilot_diameter > 0)
        svg += svg_circle("hole", view(anchor.tail->to), 0.5 * anchor.tail->pilot_diameter * view.scale);
    }
    // a: anchor under load; s: spare anchor. The page explains both letters.
    svg += svg_words("soft halo middle", view(anchor.pocket) + Vec2(0, 4), anchor.wound_end ? "a" : "s");
  }
  return svg;
}

std::string bore(const View& view, const solid::BodyLayout& layout) {
  std::string svg = curve("hole", view, layout.bore.outline, true);
  for (const Polygon& hole : layout.bore.screw_holes) svg += curve("hole", view, hole, true);
  return svg;
}

/// Below the drawing, because anchors may be anywhere around the bore.
std::string bore_words(const solid::BoreLayout& bore) {
  if (bore.outline.empty()) return "";
  const double inscribed_radius = distance_to_edges(bore.outline, Vec2::Zero());
  if (bore.circle) return "bore ⌀ " + readable_rounded(2 * inscribed_radius) + " inside the polygon";
  if (bore.kind == Bore::d)
    return "bore ⌀ " + readable_rounded(2 * bore.radius) + ", " + readable_rounded(bore.radius + inscribed_radius) +
           " from the flat";
  return "bore ⌀ " + readable_rounded(2 * inscribed_radius) + " clear";
}

std::string axes(const View& view, double reach) {
  return svg_line("axis-line", view({-1.06 * reach, 0}), view({1.06 * reach, 0})) +
         svg_line("axis-line", view({0, -1.06 * reach}), view({0, 1.12 * reach})) +
         svg_words("soft halo middle", view({0, 1.12 * reach}) - Vec2(0, 6), "home");
}

/// The angle in [0, 2π).
double wrapped(double angle) { return angle - k_two_pi * std::floor(angle / k_two_pi); }

double active_turn(const profile::Outline& outline) {
  return wrapped(outline.points[outline.active_last].psi - outline.points[outline.active_first].psi);
}

struct LegendEntry {
  std::string classes;
  std::string words;
};

std::string legend(const std::vector<LegendEntry>& entries) {
  // Two entries a line leave space for the larger font of a narrow column.
  std::string svg;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double x = i % 2 == 0 ? 4 : 0.5 * k_profile_width, y = 44 + (i < 2 ? 0 : 24);
    svg +=
        svg_line(entries[i].classes, {x, y - 4}, {x + 24, y - 4}) + svg_words("small", {x + 30, y}, entries[i].words);
  }
  return svg;
}

std::string profile_legend(const profile::Outline& outline) {
  const std::string colour = ink(outline.side);
  return legend({{"curve " + colour + " whole", "active arc (pitch)"},
                 {"closing " + colour, "closing arc"},
                 {"floor main", "groove floor"},
                 {"flange", "groove edge"}});
}

// The polar drawing for comparison ------------------------------------------------------------------------------------

/// A point of the active arc in polar coordinates about the axis, or the difference of two curves there.
struct PolarPoint {
  double alpha = 0;  ///< of the stroke, rad
  double angle = 0;  ///< direction from the axis, rad
  double r = 0;      ///< radius, or difference of radii, mm
};

/// r against α, as the paper draws it.
std::vector<PolarPoint> polar_drawing(const std::vector<transmission::TransmissionPoint>& stroke,
                                      transmission::Side side) {
  const auto tendon = [side](const transmission::TransmissionPoint& point) -> const transmission::TendonPoint& {
    return side == transmission::Side::left ? point.t1 : point.t2;
  };
  const double home_normal = tendon(home_of(stroke)).lower_normal;
  std::vector<PolarPoint> points;
  for (const transmission::TransmissionPoint& point : stroke)
    points.push_back({point.alpha, home_normal + point.alpha, tendon(point).p});
  return points;
}

bool is_round(const std::vector<PolarPoint>& drawing) {
  const auto [least, most] = std::minmax_element(drawing.begin(), drawing.end(),
                                                 [](const PolarPoint& a, const PolarPoint& b) { return a.r < b.r; });
  return most->r - least->r < 1e-9 * most->r;
}

/// Radius of the active arc in the direction of `angle`; NaN on the closing arc.
double radius_towards(const profile::Outline& outline, double angle) {
  const Vec2 direction = unit(angle);
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const Vec2& from = outline.points[i].position;
    const Vec2& to = outline.points[(i + 1) % outline.points.size()].position;
    if (cross(direction, from) > 0 || cross(direction, to) <= 0 || direction.dot(from + to) <= 0) continue;
    if (!outline.is_active(i) || !outline.is_active((i + 1) % outline.points.size())) break;
    return cross(from, to - from) / cross(direction, to - from);
  }
  return std::nan("");
}

/// A magnification 1, 2, 5, 10 … that makes `difference` visible beside a radius of `r`.
double magnification(double difference, double r) {
  constexpr double k_visible_share = 0.22;  // largest drawn difference per radius
  const double largest_factor = k_visible_share * r / difference;
  double factor = elementary::pow(10.0, std::floor(elementary::log10(largest_factor)));
  for (const double step : {5.0, 2.0}) {
    if (step * factor <= largest_factor) return std::max(1.0, step * factor);
  }
  return std::max(1.0, factor);
}

}  // namespace

std::vector<Figure> mechanism_figures(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                                      const std::vector<Pose>& poses) {
  std::vector<double> thetas;
  for (const Pose& pose : poses) thetas.push_back(pose.theta);
  const View whole = mechanism_view(mechanism, synthesis, thetas, {30, 40, k_panel_width - 60, k_panel_height - 82});
  const View detail = pulley_view(mechanism, synthesis, {24, 24, k_panel_width - 48, k_detail_height - 48});
  std::vector<Figure> figures;
  for (const Pose& pose : poses) figures.push_back(mechanism_figure(mechanism, synthesis, whole, detail, pose));
  return figures;
}

std::vector<Figure> moving_figures(const Mechanism& mechanism, const profile::SynthesisResult& synthesis) {
  const transmission::TransmissionPoint& home = home_of(synthesis.stroke);
  const Pose pose{home.alpha, home.theta};
  std::vector<double> thetas;
  for (const transmission::TransmissionPoint& point : synthesis.stroke) thetas.push_back(point.theta);
  const View whole = mechanism_view(mechanism, synthesis, thetas, {40, 40, k_moving_width - 80, k_moving_height - 90});
  const View near = pulley_view(mechanism, synthesis, {60, 60, k_moving_width - 120, k_moving_height - 130});
  return {moving_figure(mechanism, synthesis, whole, pose, "The joint with both tendons, to scale"),
          moving_figure(mechanism, synthesis, near, pose, "The pulley with both tendons, larger")};
}

std::optional<Figure> dimension_figure(const Mechanism& mechanism, const profile::SynthesisResult& synthesis) {
  if (synthesis.p1.points.empty() || synthesis.p2.points.empty() || synthesis.stroke.empty()) return std::nullopt;
  const transmission::TransmissionPoint& home = home_of(synthesis.stroke);
  const Vec2 axis = pulley_axis(mechanism);
  const double end_height = mechanism.joint.is_plain() ? mechanism.joint.R : 0;  // of C; 0: R is not drawn
  const Guides& guides = mechanism.guides;
  constexpr double k_below = 52, k_right = 92;
  Figure figure{k_sketch_width, k_sketch_height, "Dimensions of the joint at home, to scale", {}, {}};
  const View view = mechanism_view(mechanism, synthesis, {home.theta},
                                   {30, 24, k_sketch_width - 30 - k_right, k_sketch_height - 32 - k_below});
  figure.body = scene(mechanism, synthesis, view, {home.alpha, home.theta});
  const double pin_height = -guides.OE, low = k_sketch_height - 30;
  const double first = view(view.high).x() + 14, second = first + 36;
  const auto extension_line = [](const Vec2& from, const Vec2& to) { return svg_line("grid", from, to); };
  figure.body += extension_line(view({0, 0}), {first, view({0, 0}).y()}) +
                 extension_line(view({0, pin_height}), {second, view({0, pin_height}).y()}) +
                 extension_line(view(axis), {second, view(axis).y()}) +
                 extension_line(view({0, pin_height}), {view({0, 0}).x(), low}) +
                 extension_line(view({-guides.EB, pin_height}), {view({-guides.EB, 0}).x(), low}) +
                 extension_line(view({guides.ED, pin_height}), {view({guides.ED, 0}).x(), low});
  const double left = view(view.low).x() - 12;
  if (end_height > 0)
    figure.body += extension_line({left, view({0, 0}).y()}, view({0, 0})) +
                   extension_line({left, view({0, end_height}).y()}, view({0, end_height}));
  figure.body +=
      horizontal_dimension(view, 0, -guides.EB, low, "EB") + horizontal_dimension(view, 0, guides.ED, low, "ED");
  if (guides.OE != 0) figure.body += vertical_dimension(view, 0, pin_height, first, "OE");
  figure.body += vertical_dimension(view, pin_height, axis.y(), second, "EF");
  if (end_height > 0) figure.body += vertical_dimension(view, 0, end_height, left, "R");
  if (mechanism.joint.drum_radius > 0) figure.body += named_radius(view, {0, 0}, mechanism.joint.drum_radius, "drum");
  if (mechanism.pulley.law == Law::compensate) figure.body += named_radius(view, axis, mechanism.pulley.r1, "r1");
  return figure;
}

Figure profile_figure(const Mechanism& mechanism, const profile::Outline& outline, const solid::Pulley& pulley) {
  const std::string name(transmission::pulley_name(outline.side));
  Figure figure{k_profile_width, k_profile_height, "Profile of " + name, {}, {}};
  if (outline.points.size() < 3) return figure;
  const double radius = 0.5 * mechanism.tendon.diameter;
  const Polygon floor = profile::parallel(outline, -radius);
  const Polygon groove_edge = profile::parallel(outline, pulley.layout.groove_depth - radius);
  View view;
  for (const Vec2& point : groove_edge) view.include(point);
  const double low = view.low.x(), high = view.high.x();
  const double reach = std::max(view.high.cwiseAbs().maxCoeff(), view.low.cwiseAbs().maxCoeff());
  view.include({0, 1.12 * reach});
  view.fit(34, 90, k_profile_width - 68, k_profile_height - 160);
  figure.body = svg_words("heading", {4, 18}, name + ", seen from +z at home") + profile_legend(outline);
  figure.body += curve("flange", view, groove_edge, true) + curve("floor main", view, floor, true);
  figure.body += anchors(view, pulley, outline.side) + bore(view, pulley.layout) + axes(view, reach);
  figure.body +=
      curve("closing " + ink(outline.side), view, arc_points(outline, outline.active_last, outline.active_first));
  figure.body +=
      curve("curve whole " + ink(outline.side), view, arc_points(outline, outline.active_first, outline.active_last));
  figure.body += radius_dimension(view, outline.points[outline.active_first].position) +
                 radius_dimension(view, outline.points[outline.active_last].position);
  const std::string words =
      "overall " + readable(high - low, 2) + " mm, active arc " + readable(degrees(active_turn(outline)), 1) + "°";
  figure.body +=
      width_dimension(view, low, high, k_profile_height - 42, words) +
      svg_words("small middle", {0.5 * k_profile_width, k_profile_height - 7}, bore_words(pulley.layout.bore));
  return figure;
}

std::optional<Figure> polar_figure(const profile::SynthesisResult& synthesis, transmission::Side side) {
  const profile::Outline& outline = side == transmission::Side::left ? synthesis.p1 : synthesis.p2;
  if (outline.points.size() < 3 || synthesis.stroke.size() < 2) return std::nullopt;
  const std::vector<PolarPoint> drawing = polar_drawing(synthesis.stroke, side);
  if (is_round(drawing)) return std::nullopt;
  std::vector<Vec2> drawn;
  std::vector<PolarPoint> differences;  // of the drawing from the profile
  PolarPoint largest;
  for (const PolarPoint& point : drawing) {
    drawn.push_back(point.r * unit(point.angle));
    const double difference = point.r - radius_towards(outline, point.angle);
    if (!std::isfinite(difference)) continue;
    differences.push_back({point.alpha, point.angle, difference});
    if (std::abs(difference) > std::abs(largest.r)) largest = differences.back();
  }
  if (largest.r == 0) return std::nullopt;
  const double factor = magnification(std::abs(largest.r), drawing.front().r);
  std::vector<Vec2> magnified;
  for (const PolarPoint& point : differences)
    magnified.push_back((radius_towards(outline, point.angle) + factor * point.r) * unit(point.angle));

  const std::string name(transmission::pulley_name(side));
  Figure figure{k_profile_width, k_profile_height, "The polar drawing of " + name + " beside its profile", {}, {}};
  View view;
  for (const std::vector<Vec2>* points : {&drawn, &magnified}) {
    for (const Vec2& point : *points) view.include(point);
  }
  for (const profile::OutlinePoint& point : outline.points) view.include(point.position);
  view.fit(34, 90, k_profile_width - 68, k_profile_height - 142);
  figure.body = svg_words("heading", {4, 18}, name + " against r(α) in polar coordinates") +
                legend({{"curve whole " + ink(side), "profile"},
                        {"curve main", "polar drawing"},
                        {"third", "difference × " + readable_rounded(factor)}});
  figure.body += svg_circle("metal", view({0, 0}), 3);
  figure.body += curve("closing " + ink(side), view, arc_points(outline, outline.active_last, outline.active_first));
  figure.body +=
      curve("curve whole " + ink(side), view, arc_points(outline, outline.active_first, outline.active_last));
  figure.body += curve("thin main", view, drawn) + curve("third", view, magnified);
  figure.body += svg_words("small middle", {0.5 * k_profile_width, k_profile_height - 12},
                           readable(largest.r, 3) + " mm apart at α = " + readable(degrees(largest.alpha), 1) + "°");
  return figure;
}

}  // namespace fusee::formats
