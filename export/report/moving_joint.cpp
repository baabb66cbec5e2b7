#include "export/report/moving_joint.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "export/report/calibration_words.h"
#include "export/report/drawing.h"
#include "export/report/report_parts.h"
#include "export/report/tendon_trace.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

// Data for the page's computations ------------------------------------------------------------------------------------

/// JSON has no NaN.
std::string json_number(double value, int decimals) {
  return std::isfinite(value) ? trimmed_fixed(value, decimals) : "null";
}

std::string json_point(const Vec2& point) {
  constexpr int k_decimals = 4;
  return "[" + json_number(point.x(), k_decimals) + "," + json_number(point.y(), k_decimals) + "]";
}

/// "name":[…], one number for each item.
template <typename Items, typename Number>
std::string json_numbers(const std::string& name, const Items& items, int decimals, Number number) {
  std::string text = "\"" + name + "\":[";
  for (std::size_t i = 0; i < items.size(); ++i) text += (i ? "," : "") + json_number(number(items[i]), decimals);
  return text + "]";
}

template <typename Items, typename Text>
std::string comma_separated(const Items& items, Text text_of) {
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "" : ",") + text_of(item);
  return text;
}

std::string json_outline(const profile::Outline& outline) {
  std::string text = "{\"sign\":" + json_number(transmission::mirror_sign(outline.side), 0) +
                     ",\"end\":" + std::to_string(outline.anchor_end()) + ",\"points\":[";
  for (std::size_t i = 0; i < outline.points.size(); ++i)
    text += (i ? "," : "") + json_point(outline.points[i].position);
  return text + "]}";
}

bool has_equilibrium(const joint::EquilibriumPoint& point) {
  return point.status != joint::EquilibriumStatus::no_equilibrium;
}

/// The joint under its load, in one direction of the stroke.
std::string json_direction(const std::vector<analysis::StrokePoint>& loaded,
                           joint::EquilibriumPoint analysis::StrokePoint::*direction) {
  const auto numbers = [&](const std::string& key, int decimals, auto value) {
    return json_numbers(key, loaded, decimals, [&](const analysis::StrokePoint& point) {
      return has_equilibrium(point.*direction) ? value(point.*direction) : std::nan("");
    });
  };
  const auto tension = [&](const std::string& key, joint::TendonState joint::EquilibriumPoint::*tendon,
                           double joint::TendonState::*part) {
    return numbers(key, 3, [=](const joint::EquilibriumPoint& point) { return point.*tendon.*part; });
  };
  return "{" + tension("upper1", &joint::EquilibriumPoint::t1, &joint::TendonState::upper) + "," +
         tension("lower1", &joint::EquilibriumPoint::t1, &joint::TendonState::lower) + "," +
         tension("upper2", &joint::EquilibriumPoint::t2, &joint::TendonState::upper) + "," +
         tension("lower2", &joint::EquilibriumPoint::t2, &joint::TendonState::lower) + "," +
         numbers("torque", 2, [](const joint::EquilibriumPoint& point) { return point.motor_torque; }) + "," +
         numbers("theta", 5, [](const joint::EquilibriumPoint& point) { return degrees(point.theta); }) + "}";
}

/// One entry for each load.
std::string json_strokes(const std::vector<correction::LoadedStroke>& strokes) {
  std::string text =
      json_numbers("loads", strokes, 4, [](const correction::LoadedStroke& stroke) { return stroke.load; });
  for (const bool rising : {true, false}) {
    text += rising ? ",\"rising\":[" : ",\"falling\":[";
    for (std::size_t i = 0; i < strokes.size(); ++i)
      text += (i ? "," : "") + json_direction(strokes[i].points, rising ? &analysis::StrokePoint::rising
                                                                        : &analysis::StrokePoint::falling);
    text += "]";
  }
  return text;
}

std::string json_angles(const std::string& name, const std::vector<std::vector<double>>& by_load) {
  std::string text = "\"" + name + "\":[";
  for (std::size_t i = 0; i < by_load.size(); ++i) {
    text += i ? ",[" : "[";
    for (std::size_t k = 0; k < by_load[i].size(); ++k) text += (k ? "," : "") + json_number(degrees(by_load[i][k]), 4);
    text += "]";
  }
  return text + "]";
}

/// One entry for each share, a multiple of the effect's identified size.
std::string json_effect(const correction::RehearsedEffect& effect) {
  std::string text = "{\"shares\":[";
  for (std::size_t i = 0; i < effect.shares.size(); ++i) {
    const correction::RehearsedShare& share = effect.shares[i];
    text += std::string(i ? "," : "") + "{\"share\":" + json_number(correction::k_rehearsed_shares[i], 2) + "," +
            json_numbers("numbers", share.parameters, 5,
                         [](const calibration::FittedParameter& number) { return number.value; }) +
            "," + json_angles("rising", share.rising) + "," + json_angles("falling", share.falling) + "}";
  }
  return text + "]}";
}

/// The end of a tendon. `lies`: joint angle (rad) up to which the tendon lies on the drum, in the mirror image that has it
/// on the right; −1000: never. `normal`: direction (rad) of the normal of the line from drum to pin in the drawing, which
/// is constant up to that angle.
std::string json_end(const Mechanism& mechanism, transmission::Side side) {
  const transmission::PinPlace place = transmission::pin_place(mechanism, side, mechanism.guide_pitch_radius());
  double lies = -1e3, normal = 0;
  if (const auto leaves = transmission::lift_off(place)) {
    lies = *leaves;
    const double on_drum = transmission::upper_span(place, *leaves - 1.0).normal;  // 1 rad below: on the drum
    normal = side == transmission::Side::right ? on_drum : k_pi - on_drum;
  }
  return "{\"at\":" + json_point(attachment(mechanism, side, 0.0)) + ",\"lies\":" + json_number(lies, 6) +
         ",\"normal\":" + json_number(normal, 6) + "}";
}

std::string json_ends(const Mechanism& mechanism) {
  if (mechanism.joint.is_plain()) return "";
  return "\"drum\":" + json_number(mechanism.drum_pitch_radius(), 6) + ",\"ends\":[" +
         json_end(mechanism, transmission::Side::left) + "," + json_end(mechanism, transmission::Side::right) + "],";
}

/// The points at which the sheaths end beside the pulley.
std::string json_sheaths(const Mechanism& mechanism) {
  if (!mechanism.sheath.is_there()) return "";
  const auto points_of = [&mechanism](transmission::Side side) {
    return comma_separated(sheath_curve(mechanism, side), json_point);
  };
  return "\"exits\":[" + json_point(sheath_exit(mechanism, transmission::Side::left)) + "," +
         json_point(sheath_exit(mechanism, transmission::Side::right)) + "],\"sheaths\":[[" +
         points_of(transmission::Side::left) + "],[" + points_of(transmission::Side::right) + "]],";
}

std::string motion_json(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                        const std::vector<correction::LoadedStroke>& strokes,
                        const std::vector<correction::RehearsedEffect>& effects) {
  const std::vector<transmission::TransmissionPoint>& stroke = synthesis.stroke;
  const auto numbers = [&](const std::string& key, int decimals, auto value) {
    return json_numbers(key, stroke, decimals, value) + ",";
  };
  return "{\"R\":" + json_number(mechanism.joint.R, 6) + ",\"rho\":" + json_number(mechanism.guide_pitch_radius(), 6) +
         "," + json_ends(mechanism) + json_sheaths(mechanism) + "\"axis\":" + json_point(pulley_axis(mechanism)) +
         ",\"pins\":[" + json_point(pin_centre(mechanism, transmission::Side::left)) + "," +
         json_point(pin_centre(mechanism, transmission::Side::right)) + "],\"outlines\":[" +
         json_outline(synthesis.p1) + "," + json_outline(synthesis.p2) + "]," +
         numbers("alpha", 6, [](const transmission::TransmissionPoint& point) { return degrees(point.alpha); }) +
         numbers("theta", 6, [](const transmission::TransmissionPoint& point) { return degrees(point.theta); }) +
         numbers("slope", 6, [](const transmission::TransmissionPoint& point) { return point.g; }) +
         numbers("r1", 4, [](const transmission::TransmissionPoint& point) { return point.t1.p; }) +
         numbers("r2", 4, [](const transmission::TransmissionPoint& point) { return point.t2.p; }) +
         json_strokes(strokes) + ",\"effects\":[" + comma_separated(effects, json_effect) + "]}";
}

// Visible elements ----------------------------------------------------------------------------------------------------

/// `name`: key by which moving_joint.js finds the number.
std::string number_row(const std::string& words, const std::string& name) {
  return "<div><dt>" + words + "</dt><dd data-show=\"" + name + "\">–</dd></div>";
}

/// `name`: id of the slider, and key of the output beside it.
std::string slider(const std::string& words, const std::string& name, double low, double high, double value) {
  return "<label for=\"" + name + "\">" + words + "</label><input id=\"" + name + "\" type=\"range\" min=\"" +
         trimmed_fixed(low, 3) + "\" max=\"" + trimmed_fixed(high, 3) + "\" step=\"any\" value=\"" +
         trimmed_fixed(value, 3) + "\"/><output for=\"" + name + "\" data-show=\"" + name + "\">–</output>";
}

std::string controls(const std::string& inside) {
  return "<div class=\"controls\" hidden=\"hidden\">" + inside + "</div>";
}

std::string alpha_controls(const profile::SynthesisResult& synthesis) {
  return controls("<button type=\"button\" class=\"play\" aria-pressed=\"false\">Play</button>" +
                  slider("Pulley angle α", "alpha", degrees(synthesis.stroke.front().alpha),
                         degrees(synthesis.stroke.back().alpha), 0));
}

std::string load_controls(const std::vector<correction::LoadedStroke>& strokes) {
  if (strokes.size() < 2) return "";
  return controls(slider("Load at the tip", "load", strokes.front().load, strokes.back().load, 0));
}

/// A slider for the size of an effect, where 1 is the identified size.
std::string effect_controls(const correction::RehearsedEffect& effect, std::size_t number) {
  std::string units, names;
  for (const calibration::FittedParameter& parameter : effect.shares.front().parameters) {
    const auto [words, unit] = name_and_unit(parameter.name, "");
    names += (names.empty() ? "" : "|") + words;
    units += (units.empty() ? "" : "|") + unit;
  }
  return "<div class=\"controls effect-share\" hidden=\"hidden\" data-names=\"" + safe_text(names) +
         "\" data-units=\"" + safe_text(units) + "\">" +
         slider(safe_text(open_words(effect.name)), "effect" + std::to_string(number),
                correction::k_rehearsed_shares.front(), correction::k_rehearsed_shares.back(), 1) +
         "</div>";
}

std::string numbers_list(bool has_effects, const Joint& joint) {
  return "<dl class=\"numbers\" hidden=\"hidden\">" + number_row("Joint angle θ, declared", "theta") +
         number_row(has_effects ? "θ as the sensor shows it" : "θ under the load", "loaded") +
         number_row("dθ/dα", "slope") + number_row("r1, r2", "radii") +
         number_row(joint.attachment1 ? "Tendon 1, at A1 / at P1" : "Tendon 1, at C / at P1", "tendon1") +
         number_row(joint.attachment2 ? "Tendon 2, at A2 / at P2" : "Tendon 2, at C / at P2", "tendon2") +
         number_row("Motor torque", "torque") + number_row("Turning", "way") +
         (has_effects ? number_row("Deviation from the target motion", "off") : "") + "</dl>";
}

std::string moving_html(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                        const std::vector<correction::LoadedStroke>& strokes,
                        const std::vector<correction::RehearsedEffect>& effects) {
  std::string html = "<div class=\"moving\">" + alpha_controls(synthesis) + load_controls(strokes);
  for (std::size_t i = 0; i < effects.size(); ++i) html += effect_controls(effects[i], i);
  html += "<div class=\"scenes\">";
  for (const Figure& figure : moving_figures(mechanism, synthesis)) html += "<div>" + inline_svg(figure) + "</div>";
  return html + "</div>" + numbers_list(!effects.empty(), mechanism.joint) +
         "<script type=\"application/json\" id=\"motion\">" + motion_json(mechanism, synthesis, strokes, effects) +
         "</script></div>";
}

}  // namespace

std::string moving_joint(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                         const std::vector<analysis::StrokePoint>& loaded) {
  if (synthesis.stroke.empty() || loaded.size() != synthesis.stroke.size() || synthesis.p1.points.size() < 3) return "";
  return moving_html(mechanism, synthesis, {{mechanism.load.tip_force, loaded}}, {});
}

namespace {

/// True if all words of `required` ("drum+sheath") apply to the joint.
bool is_for(std::string_view required, const std::vector<std::string_view>& words) {
  const std::size_t plus = required.find('+');
  if (plus != std::string_view::npos)
    return is_for(required.substr(0, plus), words) && is_for(required.substr(plus + 1), words);
  return std::find(words.begin(), words.end(), required) != words.end();
}

/// The script for a joint with these words. A line that ends in `//=` and words is kept only if all of them are given.
std::string lines_for(const std::vector<std::string_view>& words) {
  std::string script;
  std::string_view rest = embedded::moving_joint_js;
  while (!rest.empty()) {
    const std::size_t size = std::min(rest.find('\n'), rest.size() - 1) + 1;  // with the line break
    const std::string_view line = rest.substr(0, size);
    rest.remove_prefix(size);
    constexpr std::string_view k_mark = " //=";
    const std::size_t mark = line.rfind(k_mark);
    if (mark == std::string_view::npos) {
      script += line;
      continue;
    }
    const std::size_t begin = mark + k_mark.size();
    const std::string_view required = line.substr(begin, line.size() - 1 - begin);  // without the line break
    if (is_for(required, words)) script += std::string(line.substr(0, mark)) + "\n";
  }
  return script;
}

}  // namespace

std::string_view joint_script(const Mechanism& mechanism) {
  static const std::string plain = lines_for({"plain", "pin"}), drum = lines_for({"drum", "pin"}),
                           plain_sheathed = lines_for({"plain", "sheath"}),
                           drum_sheathed = lines_for({"drum", "sheath"});
  if (mechanism.sheath.is_there()) return mechanism.joint.is_plain() ? plain_sheathed : drum_sheathed;
  return mechanism.joint.is_plain() ? plain : drum;
}

std::string moving_joint(const correction::Rehearsal& rehearsal) {
  if (rehearsal.effects.empty()) return "";
  return moving_html(rehearsal.mechanism, rehearsal.synthesis, rehearsal.strokes, rehearsal.effects);
}

}  // namespace fusee::formats
