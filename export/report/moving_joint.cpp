#include "export/report/moving_joint.h"

#include <algorithm>
#include <cmath>

#include "export/report/drawing.h"
#include "export/report/tendon_trace.h"
#include "fusee/base/text.h"
#include "fusee/base/units.h"

namespace fusee {
namespace {

// What the page computes with --------------------------------------------------------------------------------------

/// JSON knows no NaN.
std::string json_number(double value, int decimals) {
  return std::isfinite(value) ? trimmed_fixed(value, decimals) : "null";
}

std::string json_point(const Vec2& point) {
  constexpr int k_decimals = 4;
  return "[" + json_number(point.x(), k_decimals) + "," + json_number(point.y(), k_decimals) + "]";
}

/// "name":[…], a number an item.
template <typename Items, typename Number>
std::string json_numbers(const std::string& name, const Items& items, int decimals, Number number) {
  std::string text = "\"" + name + "\":[";
  for (std::size_t i = 0; i < items.size(); ++i) text += (i ? "," : "") + json_number(number(items[i]), decimals);
  return text + "]";
}

std::string json_outline(const Outline& outline) {
  std::string text = "{\"sign\":" + json_number(mirror_sign(outline.side), 0) +
                     ",\"end\":" + std::to_string(outline.anchor_end()) + ",\"points\":[";
  for (std::size_t i = 0; i < outline.points.size(); ++i)
    text += (i ? "," : "") + json_point(outline.points[i].position);
  return text + "]}";
}

bool is_held(const EquilibriumPoint& point) { return point.status != EquilibriumStatus::no_equilibrium; }

/// The joint under its load, on one of the ways through the stroke.
std::string json_way(const std::string& name, const std::vector<StrokePoint>& loaded,
                     EquilibriumPoint StrokePoint::*way) {
  const auto numbers = [&](const std::string& key, int decimals, auto value) {
    return json_numbers(key, loaded, decimals, [&](const StrokePoint& point) {
      return is_held(point.*way) ? value(point.*way) : std::nan("");
    });
  };
  const auto tension = [&](const std::string& key, TendonState EquilibriumPoint::*tendon, double TendonState::*part) {
    return numbers(key, 3, [=](const EquilibriumPoint& point) { return point.*tendon.*part; });
  };
  return "\"" + name + "\":{" + tension("upper1", &EquilibriumPoint::t1, &TendonState::upper) + "," +
         tension("lower1", &EquilibriumPoint::t1, &TendonState::lower) + "," +
         tension("upper2", &EquilibriumPoint::t2, &TendonState::upper) + "," +
         tension("lower2", &EquilibriumPoint::t2, &TendonState::lower) + "," +
         numbers("torque", 2, [](const EquilibriumPoint& point) { return point.motor_torque; }) + "," +
         numbers("theta", 5, [](const EquilibriumPoint& point) { return degrees(point.theta); }) + "}";
}

std::string motion_json(const Mechanism& mechanism, const SynthesisResult& synthesis,
                        const std::vector<StrokePoint>& loaded) {
  const std::vector<TransmissionPoint>& stroke = synthesis.stroke;
  const auto numbers = [&](const std::string& key, int decimals, auto value) {
    return json_numbers(key, stroke, decimals, value) + ",";
  };
  return "{\"R\":" + json_number(mechanism.joint.R, 6) + ",\"rho\":" + json_number(mechanism.guide_pitch_radius(), 6) +
         ",\"axis\":" + json_point(pulley_axis(mechanism)) + ",\"pins\":[" +
         json_point(pin_centre(mechanism, Side::left)) + "," + json_point(pin_centre(mechanism, Side::right)) +
         "],\"outlines\":[" + json_outline(synthesis.p1) + "," + json_outline(synthesis.p2) + "]," +
         numbers("alpha", 6, [](const TransmissionPoint& point) { return degrees(point.alpha); }) +
         numbers("theta", 6, [](const TransmissionPoint& point) { return degrees(point.theta); }) +
         numbers("slope", 6, [](const TransmissionPoint& point) { return point.g; }) +
         numbers("r1", 4, [](const TransmissionPoint& point) { return point.t1.p; }) +
         numbers("r2", 4, [](const TransmissionPoint& point) { return point.t2.p; }) +
         json_way("rising", loaded, &StrokePoint::rising) + "," + json_way("falling", loaded, &StrokePoint::falling) +
         "}";
}

// What a person sees -----------------------------------------------------------------------------------------------

/// `name` is where moving_joint.js puts the number.
std::string number_row(const std::string& words, const std::string& name) {
  return "<div><dt>" + words + "</dt><dd data-show=\"" + name + "\">–</dd></div>";
}

std::string slider(const SynthesisResult& synthesis) {
  const double low = degrees(synthesis.stroke.front().alpha), high = degrees(synthesis.stroke.back().alpha);
  return "<div class=\"controls\" hidden=\"hidden\"><button type=\"button\" class=\"play\" "
         "aria-pressed=\"false\">Play</button>"
         "<label for=\"alpha\">Pulley angle α</label><input id=\"alpha\" type=\"range\" min=\"" +
         fixed(low, 3) + "\" max=\"" + fixed(high, 3) +
         "\" step=\"any\" value=\"0\"/><output for=\"alpha\" data-show=\"alpha\">0.0°</output></div>";
}

std::string numbers_list() {
  return "<dl class=\"numbers\" hidden=\"hidden\">" + number_row("Joint angle θ", "theta") +
         number_row("θ under the load", "loaded") + number_row("dθ/dα", "slope") + number_row("r1, r2", "radii") +
         number_row("Tendon 1, at C / at P1", "tendon1") + number_row("Tendon 2, at C / at P2", "tendon2") +
         number_row("Motor torque", "torque") + number_row("Turning", "way") + "</dl>";
}

}  // namespace

std::string moving_joint(const Mechanism& mechanism, const SynthesisResult& synthesis,
                         const std::vector<StrokePoint>& loaded) {
  if (synthesis.stroke.empty() || loaded.size() != synthesis.stroke.size() || synthesis.p1.points.size() < 3) return "";
  const auto home =
      std::min_element(synthesis.stroke.begin(), synthesis.stroke.end(),
                       [](const auto& a, const auto& b) { return std::abs(a.alpha) < std::abs(b.alpha); });
  std::string html = "<div class=\"moving\">" + slider(synthesis) + "<div class=\"scenes\">";
  for (const Figure& figure : moving_figures(mechanism, synthesis, {home->alpha, home->theta}))
    html += "<div>" + inline_svg(figure) + "</div>";
  return html + "</div>" + numbers_list() + "<script type=\"application/json\" id=\"motion\">" +
         motion_json(mechanism, synthesis, loaded) + "</script></div>";
}

}  // namespace fusee
