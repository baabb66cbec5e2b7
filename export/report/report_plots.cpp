#include "export/report/report_plots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "export/report/tables.h"
#include "fusee/base.h"
#include "fusee/transmission.h"
#include "transmission/load.h"

namespace fusee::formats {
namespace {

const PlotAxis k_alpha_axis{"pulley angle α", "°", {}, {}, 1e-6};

template <typename Value>
std::vector<Vec2> over_alpha(const profile::SynthesisResult& synthesis, Value value) {
  std::vector<Vec2> points;
  for (const transmission::TransmissionPoint& point : synthesis.stroke)
    points.emplace_back(degrees(point.alpha), value(point));
  return points;
}

Plot radius_plot(const Product& product) {
  Plot plot{"Pitch radii", k_alpha_axis, {"moment arm about G", "mm", {}, {}, 0.1}, {}, {}, {}};
  plot.series = {{"r1", Ink::p1, over_alpha(product.synthesis, [](const auto& p) { return p.t1.p; })},
                 {"r2", Ink::p2, over_alpha(product.synthesis, [](const auto& p) { return p.t2.p; })}};
  return plot;
}

std::string line_words(const BestLine& line) {
  return "best line θ = " + readable(line.offset, 2) + "° + " + readable_rounded(line.slope, 4) + " α";
}

Plot theta_plot(const std::vector<Vec2>& theta, const BestLine& line) {
  Plot plot{"Joint angle", k_alpha_axis, {"joint angle θ", "°", {}, {}, 0.1}, {}, {}, {}};
  plot.series = {{"θ(α)", Ink::main, theta}};
  if (theta.empty()) return plot;
  const auto on_line = [&](const Vec2& point) { return Vec2(point.x(), line.offset + line.slope * point.x()); };
  plot.series.push_back({line_words(line), Ink::third, {on_line(theta.front()), on_line(theta.back())}, true});
  return plot;
}

Plot deviation_plot(const std::vector<Vec2>& theta, const BestLine& line) {
  constexpr double k_rounding_deg = 1e-9;
  Plot plot{"Deviation from the best line: " +
                (line.deviation > k_rounding_deg ? "±" + readable_rounded(line.deviation, 3) + "°" : "none"),
            k_alpha_axis,
            {"θ less the line", "°", {}, {}, 0.01},
            {},
            {},
            {}};
  PlotSeries series{"θ − line", Ink::main, {}};
  for (const Vec2& point : theta)
    series.points.emplace_back(point.x(), point.y() - line.offset - line.slope * point.x());
  plot.series = {series};
  return plot;
}

/// Curvature over the unrolled direction of the normal, for the working arc.
PlotSeries curvature_of_turns(const helix::HelixSide& helix, transmission::Side side) {
  PlotSeries series{
      std::string(transmission::pulley_name(side)), side == transmission::Side::left ? Ink::p1 : Ink::p2, {}};
  for (std::size_t i = helix.spiral.first_used; i <= helix.spiral.last_used; ++i)
    series.points.emplace_back(degrees(helix.spiral.rows[i].turn), helix.spiral.rows[i].rho);
  return series;
}

/// Points of one arc (active or closing), with a gap for the other one.
PlotSeries curvature_series(const profile::Outline& outline, bool active) {
  const bool left = outline.side == transmission::Side::left;
  PlotSeries series{std::string(transmission::pulley_name(outline.side)) + (active ? " active" : ""),
                    left ? Ink::p1 : Ink::p2,
                    {},
                    !active};
  if (!active) series.name.clear();
  for (std::size_t i = 0; i < outline.points.size(); ++i) {
    const profile::OutlinePoint& point = outline.points[i];
    series.points.emplace_back(degrees(point.psi), outline.is_active(i) == active ? point.curvature_radius : k_gap);
  }
  return series;
}

/// Upper end of the axis. The closing arc, and a bridged hollow of the polar drawing, may be nearly straight, so the
/// axis shows the radii of most of the active arc.
std::optional<double> highest_shown(std::vector<double> radii) {
  if (radii.empty()) return std::nullopt;
  std::sort(radii.begin(), radii.end());
  const double ninth_decile = radii[radii.size() * 9 / 10];
  return std::min(1.6 * radii.back(), 3 * ninth_decile);
}

Plot curvature_plot(const Product& product) {
  Plot plot{"Radius of curvature of the pitch curves (thin: closing arc)",
            {"direction of the normal ψ", "°", {}, {}, 1e-6},
            {"radius of curvature", "mm", 0.0, {}, 0.1},
            {},
            {},
            {}};
  std::vector<double> active_radii;
  if (product.helix) {
    plot.title = "Radius of curvature of the pitch curves";
    plot.series = {curvature_of_turns(product.helix->synthesis.sides[0], transmission::Side::left),
                   curvature_of_turns(product.helix->synthesis.sides[1], transmission::Side::right)};
    for (const PlotSeries& series : plot.series) {
      for (const Vec2& point : series.points) active_radii.push_back(point.y());
    }
  }
  for (const bool active : {false, true}) {
    if (product.helix) break;
    for (const profile::Outline* outline : {&product.synthesis.p1, &product.synthesis.p2}) {
      plot.series.push_back(curvature_series(*outline, active));
      if (!active) continue;
      for (const Vec2& point : plot.series.back().points) {
        if (std::isfinite(point.y())) active_radii.push_back(point.y());
      }
    }
  }
  plot.y.high = highest_shown(active_radii);
  const Tendon& tendon = product.joint.mechanism.tendon;
  if (tendon.bend_ratio > 0)
    plot.limits = {{0.5 * tendon.diameter * (tendon.bend_ratio + 1), "smallest advised bend radius"}};
  return plot;
}

std::vector<PlotLimit> both_limits(const Check* check) {
  if (!check) return {};
  return {{check->limit, "limit"}, {-check->limit, "limit"}};
}

/// A curve over α of the wound tendons' result, between its limits, with its worst point labelled.
Plot as_built_plot(const Product& product, const std::string& title, const PlotAxis& y, const Check* check,
                   const std::function<double(const profile::RewindPoint&)>& value) {
  Plot plot{title, k_alpha_axis, y, {{title, Ink::main, {}}}, both_limits(check), {}};
  Vec2 worst(0, 0);
  for (const profile::RewindPoint& point : product.as_built.points) {
    const Vec2 place(degrees(point.alpha), value(point));
    plot.series[0].points.push_back(place);
    if (std::abs(place.y()) > std::abs(worst.y())) worst = place;
  }
  if (worst.y() != 0) plot.marks = {{worst, with_unit(worst.y(), y.unit), Ink::main}};
  return plot;
}

}  // namespace

const Check* find_check(const Product& product, std::string_view name) {
  const auto found = std::find_if(product.checks.begin(), product.checks.end(),
                                  [&](const Check& check) { return check.name == name; });
  return found == product.checks.end() ? nullptr : &*found;
}

std::vector<Plot> transmission_plots(const Product& product) {
  const std::vector<Vec2> theta = over_alpha(product.synthesis, [](const auto& p) { return degrees(p.theta); });
  const BestLine line = best_line(theta);
  return {radius_plot(product), theta_plot(theta, line), deviation_plot(theta, line), curvature_plot(product)};
}

std::vector<Plot> as_built_plots(const Product& product) {
  if (product.as_built.points.empty()) return {};
  return {as_built_plot(product, "Error of the joint angle", {"θ as built less θ declared", "°", {}, {}, 1e-4},
                        find_check(product, "theta_error"),
                        [](const auto& p) { return degrees(p.theta - p.theta_declared); }),
          as_built_plot(product, "Excess length of tendon 2", {"excess (+), stretch (−)", "mm", {}, {}, 1e-4},
                        find_check(product, "excess_length"), [](const auto& p) { return p.excess; })};
}

namespace {

const PlotAxis k_theta_axis{"joint angle θ", "°", {}, {}, 1e-6};

std::vector<Vec2> target_torque(const Mechanism& mechanism) {
  std::vector<Vec2> points;
  for (const TorqueRow& row : mechanism.pulley.torque_rows) points.emplace_back(degrees(row.theta), row.torque);
  if (points.empty()) {
    for (const double theta : {mechanism.joint.theta_min, mechanism.joint.theta_max})
      points.emplace_back(degrees(theta), mechanism.pulley.motor_torque);
  }
  return points;
}

/// The torque that balances the load on the pulley as wound: load · dθ/dα, by differences of the wound angles over
/// k_half_width on both sides. Over less, the corners of facets, some 0.001° high, would dominate.
std::vector<Vec2> torque_as_wound(const Product& product) {
  const std::vector<profile::RewindPoint>& wound = product.as_built.points;
  constexpr double k_half_width = radians(4);
  std::vector<Vec2> points;
  for (std::size_t i = 0, first = 0, last = 0; i < wound.size(); ++i) {
    while (last < wound.size() && wound[last].alpha < wound[i].alpha + k_half_width) ++last;
    while (wound[first].alpha < wound[i].alpha - k_half_width) ++first;
    if (last == wound.size()) break;
    if (wound[i].alpha - wound.front().alpha < k_half_width) continue;
    const double slope = (wound[last].theta - wound[first].theta) / (wound[last].alpha - wound[first].alpha);
    const double theta = 0.5 * (wound[last].theta + wound[first].theta);
    points.emplace_back(degrees(theta), transmission::law_load_torque(product.joint.mechanism, theta).value * slope);
  }
  return points;
}

std::vector<Vec2> torque_with_friction(const Product& product, bool rising) {
  std::vector<Vec2> points;
  for (const analysis::StrokePoint& both : product.holding.loaded) {
    const joint::EquilibriumPoint& point = rising ? both.rising : both.falling;
    const bool held = point.status == joint::EquilibriumStatus::held;
    points.emplace_back(degrees(point.theta), held ? point.motor_torque : k_gap);
  }
  return points;
}

Plot motor_plot(const Product& product) {
  Plot plot{"Motor torque that holds the load", k_theta_axis, {"torque towards +α", "N·mm", {}, {}, 1}, {}, {}, {}};
  plot.series = {{"wanted", Ink::third, target_torque(product.joint.mechanism)},
                 {"no friction", Ink::main, torque_as_wound(product)}};
  if (!product.holding.loaded.empty()) {
    plot.series.push_back({"α growing", Ink::p1, torque_with_friction(product, true), true});
    plot.series.push_back({"α falling", Ink::p2, torque_with_friction(product, false), true});
  }
  return plot;
}

Plot load_plot(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const auto over_theta = [&](auto value) {
    std::vector<Vec2> points;
    for (const transmission::TransmissionPoint& point : product.synthesis.stroke)
      points.emplace_back(degrees(point.theta), value(point.theta));
    return points;
  };
  const auto spring = [&](double theta) { return mechanism.spring.torque(theta); };
  const auto all = [&](double theta) { return transmission::law_load_torque(mechanism, theta).value; };
  Plot plot{"Load at the joint", k_theta_axis, {"torque against +θ", "N·mm", {}, {}, 1}, {}, {}, {}};
  const bool sprung = mechanism.spring != Spring{};
  plot.series = {{sprung ? "weight, force and spring" : "weight and force", Ink::main, over_theta(all)}};
  if (!sprung) return plot;
  plot.series.push_back({"spring", Ink::p2, over_theta(spring), true});
  plot.series.push_back(
      {"weight and force", Ink::p1, over_theta([&](double theta) { return all(theta) - spring(theta); }), true});
  return plot;
}

}  // namespace

std::vector<Plot> torque_plots(const Product& product) {
  if (product.joint.mechanism.pulley.law != Law::torque || product.synthesis.stroke.empty()) return {};
  return {motor_plot(product), load_plot(product)};
}

std::vector<Plot> force_plots(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  if (mechanism.load.tip_force == 0) return {};
  const auto force = [&](auto value) {
    return over_alpha(product.synthesis,
                      [&](const auto& p) { return value(transmission::paper_forces(mechanism, p)); });
  };
  const std::string lower_name = mechanism.sheath.is_there()                 ? "Tb, behind the sheath"
                                 : mechanism.guides.kind == GuideKind::idler ? "Tb, below the idler"
                                                                             : "Tb, below the pin";
  Plot tension{"Tension of tendon 2 under the tip force", k_alpha_axis, {"tension", "N", 0.0, {}, 0.1}, {}, {}, {}};
  tension.series = {
      {mechanism.guides.kind == GuideKind::idler ? "T2, above the idler" : "T2, above the pin", Ink::p2,
       force([](const transmission::PaperForces& f) { return f.T2; })},
      {lower_name + " (with friction)", Ink::main, force([](const transmission::PaperForces& f) { return f.Tb; })}};
  Plot stretch{"Joint angle lost by stretch", k_alpha_axis, {"Δθ", "°", {}, {}, 1e-3}, {}, {}, {}};
  stretch.series = {{"Δθ", Ink::p2, force([](const transmission::PaperForces& f) { return degrees(f.theta_error); })}};
  return {tension, stretch};
}

}  // namespace fusee::formats
