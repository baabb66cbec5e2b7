/// report.html: all information about a pulley before printing, on one self-contained page.
#include "export/report/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>

#include "base/text.h"
#include "base/thread_pool.h"
#include "export/report/calibration_words.h"
#include "export/report/derived.h"
#include "export/report/drawing.h"
#include "export/report/helix_report.h"
#include "export/report/home_words.h"
#include "export/report/html.h"
#include "export/report/input_json.h"
#include "export/report/mesh_code.h"
#include "export/report/moving_helix.h"
#include "export/report/moving_joint.h"
#include "export/report/report_parts.h"
#include "export/report/report_plots.h"
#include "export/report/tables.h"
#include "export/report/tendon_lengths.h"
#include "export/report/under_load.h"
#include "export/tool.h"
#include "mechanism/catalogue.h"
#include "mechanism/lengths.h"
#include "transmission/load.h"

namespace fusee::formats {
namespace {

std::string all_in_divs(const std::vector<Plot>& plots) {
  std::string html;
  for (const Plot& plot : plots) html += in_div(plot_figure(plot));
  return html;
}

// Verdict -------------------------------------------------------------------------------------------------------------

std::string limit_words(const Check* check) {
  return check ? " (limit " + with_unit(check->limit, check->unit) + ")" : "";
}

std::string as_built_words(const Product& product) {
  if (product.as_built.points.empty()) return "No tendon was wound on this part.";
  const profile::RewindResult& built = product.as_built;
  return "With tendons wound on the mesh itself, the joint follows the declared θ(α) within " +
         with_unit(degrees(built.max_theta_error), "deg") + limit_words(find_check(product, "theta_error")) +
         ", worst at α = " + readable(degrees(built.max_theta_error_at), 1) +
         "°, and the tendons’ excess length stays within " + with_unit(built.max_excess, "mm") +
         limit_words(find_check(product, "excess_length")) +
         ", worst at α = " + readable(degrees(built.max_excess_at), 1) + "°.";
}

std::string verdict_words(const Product& product) {
  std::vector<std::string> failed;
  for (const Check& check : product.checks) {
    if (!check.ok) {
      failed.push_back(plain_name(check.name) + " (" + with_unit(check.value, check.unit) + ", limit " +
                       with_unit(check.limit, check.unit) + ")");
    }
  }
  const std::string count = std::to_string(product.checks.size());
  if (product.checks.empty()) return "Nothing was checked on this part.";
  if (failed.empty()) {
    const bool is_paper_method = product.joint.mechanism.pulley.method == Method::paper;
    return std::string(is_paper_method ? "Made by the paper’s drawing: " : "Checked: ") +
           "the pulley as built follows θ(α) within " + with_unit(degrees(product.as_built.max_theta_error), "deg") +
           limit_words(find_check(product, "theta_error")) + " and the tendons’ excess length stays within " +
           with_unit(product.as_built.max_excess, "mm") + limit_words(find_check(product, "excess_length")) +
           (is_paper_method ? " (reported, not judged)" : "") + ". All " + count + " checks hold." +
           under_load_sentences(product.under_load, product.joint.mechanism);
  }
  return "Do not build it unchanged: " + std::to_string(failed.size()) + " of " + count + " checks failed. " +
         joined(failed, "; ") + ".";
}

struct PageVerdict {
  std::string style;  ///< class in page.css
  std::string sign;
  std::string words;
};

PageVerdict verdict_of(const Product& product) {
  const std::string words = verdict_words(product);
  if (product.checks.empty() || !all_ok(product.checks)) return {"bad", "✕", words};
  const analysis::UnderLoad& load = product.under_load;
  const bool is_taut = load.slack1.empty() && load.slack2.empty();
  const bool suffices = !load.lost_at && is_taut && (!load.motor || (load.motor->ok() && load.motor->misfit.empty()));
  if (product.joint.mechanism.pulley.method == Method::paper || !suffices) return {"noted", "!", words};
  return {"good", "✓", words};
}

std::string warnings(const Product& product) {
  std::vector<std::string> all = product.synthesis.warnings;
  all.insert(all.end(), product.holding.warnings.begin(), product.holding.warnings.end());
  for (const Diagnostic& diagnostic : product.file.warnings) {
    all.push_back(diagnostic.message + (diagnostic.hint.empty() ? "" : ": " + diagnostic.hint));
  }
  if (all.empty()) return "";
  for (std::string& one : all) one = lengths_in(product.file.mechanism.units, one);
  return "<section class=\"warnings\">" + html_list(all) + "</section>";
}

// Key numbers ---------------------------------------------------------------------------------------------------------

/// Range of a quantity over the stroke. NaN is the initial value, which fmin and fmax ignore.
struct StrokeRange {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = low;
};

template <typename Value>
StrokeRange stroke_range(const profile::SynthesisResult& synthesis, Value value) {
  StrokeRange range;
  for (const transmission::TransmissionPoint& point : synthesis.stroke) {
    range.low = std::fmin(range.low, value(point));
    range.high = std::fmax(range.high, value(point));
  }
  return range;
}

std::string range_words(const StrokeRange& range, int decimals, const std::string& unit) {
  const std::string gap = unit == "°" ? "" : "\u00a0";
  return readable(range.low, decimals) + "\u2009…\u2009" + readable(range.high, decimals) + gap + unit;
}

std::string_view law_words(Law law) {
  switch (law) {
    case Law::compensate:
      return "P1 round, P2 follows";
    case Law::linear:
      return "θ = α / ratio";
    case Law::table:
      return "θ(α) from a table";
    case Law::torque:
      return "target torque of the motor";
  }
  return "";
}

void add_law(KeyNumbers& numbers, const Product& product) {
  const PulleyDrive& drive = product.joint.mechanism.pulley;
  numbers.add("Law", std::string(law_words(drive.law)),
              drive.method == Method::paper ? "the paper’s polar drawing" : "");
  if (drive.law == Law::linear) numbers.add("Ratio α / θ", readable_rounded(drive.ratio));
  if (drive.law == Law::torque) {
    const StrokeRange torque = stroke_range(product.synthesis, [&](const auto& p) {
      return transmission::law_load_torque(product.joint.mechanism, p.theta).value * p.g;
    });
    numbers.add("Motor torque",
                drive.torque_rows.empty() ? with_unit(drive.motor_torque, "N·mm") : range_words(torque, 1, "N·mm"),
                "holds [load] and [spring], without friction");
  }
  if (drive.law == Law::compensate) {
    numbers.add("r1", with_unit(drive.r1, "mm", 5), "pitch");
  } else {
    numbers.add("r1", range_words(stroke_range(product.synthesis, [](const auto& p) { return p.t1.p; }), 3, "mm"));
  }
  numbers.add("r2", range_words(stroke_range(product.synthesis, [](const auto& p) { return p.t2.p; }), 3, "mm"));
  numbers.add("Pulley angle α",
              range_words({degrees(stroke_range(product.synthesis, [](const auto& p) { return p.alpha; }).low),
                           degrees(stroke_range(product.synthesis, [](const auto& p) { return p.alpha; }).high)},
                          2, "°"));
}

void add_part(KeyNumbers& numbers, const solid::Pulley& pulley) {
  constexpr double k_pla_density = 1.24;  // g/cm³
  if (pulley.mesh.triangles.empty()) return;
  const solid::Bounds box = solid::bounds(pulley.mesh);
  const Vec3 size = box.high - box.low;
  numbers.add("Size of the part",
              readable(size.x(), 1) + " × " + readable(size.y(), 1) + " × " + readable(size.z(), 1) + " mm");
  const double volume = solid::enclosed_volume(pulley.mesh) / 1000;
  numbers.add("Volume", readable_rounded(volume, 3) + " cm³",
              readable_rounded(volume * k_pla_density, 2) + " g if solid PLA");
}

std::string key_numbers(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const Guides& guides = mechanism.guides;
  KeyNumbers numbers;
  numbers.add("R = OC", with_unit(mechanism.joint.R, "mm", 6));
  if (const Joint& joint = mechanism.joint; joint.drum_radius > 0)
    numbers.add("Drum radius", with_unit(joint.drum_radius, "mm", 6),
                joint.drum_mu > 0 ? "μ " + readable_rounded(joint.drum_mu, 3) : "");
  const auto add_end = [&numbers](const char* name, const std::optional<Attachment>& end) {
    if (end)
      numbers.add(name, readable_rounded(end->across, 6) + ", " + readable_rounded(end->along, 6) + " mm",
                  "across, along OC");
  };
  add_end("Tendon 1 ends at", mechanism.joint.attachment1);
  add_end("Tendon 2 ends at", mechanism.joint.attachment2);
  numbers.add("Joint angle θ",
              range_words({degrees(mechanism.joint.theta_min), degrees(mechanism.joint.theta_max)}, 1, "°"));
  numbers.add("EB, ED", readable_rounded(guides.EB, 6) + ", " + readable_rounded(guides.ED, 6) + " mm");
  numbers.add("OE", with_unit(guides.OE, "mm", 6),
              guides.OE < 0   ? "pins above the joint"
              : guides.OE > 0 ? "pins below the joint"
                              : "");
  const Sheath& sheath = mechanism.sheath;
  numbers.add("EF", with_unit(mechanism.pulley.EF, "mm", 6), sheath.is_there() ? "where it is drawn" : "");
  if (sheath.is_there()) {
    numbers.add("Sheaths", with_unit(sheath.length, "mm", 6),
                "bends " + readable_rounded(degrees(sheath.bend), 4) + "°, μ " + readable_rounded(sheath.mu, 3) + ", " +
                    (sheath.stiffness > 0 ? with_unit(sheath.stiffness, "N/mm") : "rigid") + "; drawn shorter");
    numbers.add("Sheath exits", "± " + with_unit(sheath.exit_across, "mm", 6),
                with_unit(sheath.exit_above, "mm", 6) + " above G");
  }
  if (guides.kind == GuideKind::idler) {
    numbers.add(
        "Idler radius", with_unit(guides.radius, "mm"),
        "bearing " + with_unit(guides.bearing_radius, "mm") + ", μ " + readable_rounded(guides.bearing_friction, 3));
  } else {
    numbers.add("Pin radius", with_unit(guides.radius, "mm"), "μ " + readable_rounded(guides.mu, 3));
  }
  add_law(numbers, product);
  numbers.add("Tendon", "⌀ " + with_unit(mechanism.tendon.diameter, "mm"),
              readable_rounded(mechanism.tendon.modulus / 1000, 3) + " GPa");
  numbers.add("Pretension", with_unit(mechanism.tendon.pretension, "N"), "tendon 1 at home");
  if (mechanism.load.tip_force != 0)
    numbers.add("Tip force", with_unit(mechanism.load.tip_force, "N"), "across OC, against +θ");
  const Spring& spring = mechanism.spring;
  if (spring != Spring{}) {
    numbers.add(
        "Spring on the joint", readable_rounded(spring.stiffness, 4) + "\u00a0N·mm/rad",
        readable_rounded(spring.preload, 4) + "\u00a0N·mm at θ = " + readable_rounded(degrees(spring.free), 4) + "°");
  }
  add_motor(numbers, product.under_load);
  add_part(numbers, product.pulley);
  const std::string table = numbers.html(product.file.mechanism.units);
  const std::optional<Figure> sketch = dimension_figure(mechanism, product.synthesis);
  return sketch ? "<div class=\"with-sketch\">" + table + in_div(*sketch) + "</div>" : table;
}

// The part in 3-D -----------------------------------------------------------------------------------------------------

std::string vector_words(const Vec3& v) { return shortest(v.x()) + " " + shortest(v.y()) + " " + shortest(v.z()); }

/// Middle and half height of a groove along the axis. A helical groove extends from its first turn to its last one,
/// including the ribs between them.
struct GrooveBand {
  double middle = 0, half = 0;
};

GrooveBand groove_band(const Product& product, transmission::Side which) {
  const bool left = which == transmission::Side::left;
  const solid::BodyLayout& layout = product.pulley.layout;
  const solid::GrooveWalls& walls = left ? layout.p1 : layout.p2;
  // Slightly narrower than the groove, so that the flanges stay untinted.
  const double half = 0.98 * std::min(walls.below_width(), walls.above_width());
  if (!product.helix) return {left ? layout.z_p1 : layout.z_p2, half};
  const helical_solid::SpiralPlace& place = left ? product.helix->pulley.p1 : product.helix->pulley.p2;
  const std::vector<helix::SpiralRow>& rows = product.helix->synthesis.sides.at(left ? 0 : 1).spiral.rows;
  const double first = place.height(rows.front().z), last = place.height(rows.back().z);
  return {0.5 * (first + last), 0.5 * std::abs(last - first) + half};
}

/// The tinted region of a groove for viewer.js: height of its middle, half height, least radius (mm). The bore, within
/// that radius, stays untinted.
std::string tint_words(const Product& product, transmission::Side which) {
  const solid::BodyLayout& layout = product.pulley.layout;
  const GrooveBand band = groove_band(product, which);
  return vector_words(layout.scale * Vec3(band.middle, band.half, 1.1 * layout.bore.radius));
}

std::string part_view(const Product& product) {
  const auto code = encode_mesh(product.pulley.mesh);
  if (!code) return "<p>There is no mesh to show.</p>";
  std::string html =
      "<div class=\"stage\"><canvas tabindex=\"0\" aria-label=\"The pulley in three dimensions\" data-low=\"" +
      vector_words(code->low) + "\" data-step=\"" + shortest(code->step) + "\" data-triangles=\"" +
      std::to_string(code->triangles) + "\" data-groove1=\"" + tint_words(product, transmission::Side::left) +
      "\" data-groove2=\"" + tint_words(product, transmission::Side::right) + "\"></canvas>";
  html +=
      "<div class=\"buttons\" hidden=\"hidden\"><button data-view=\"isometric\">Isometric</button><button "
      "data-view=\"top\">Top</button>"
      "<button data-view=\"side\">Side</button><button data-view=\"below\">Below</button>"
      "<button data-view=\"half\" aria-pressed=\"false\">Cut open</button></div>"
      "<p class=\"missing\">A still picture: WebGL 2 is off or missing here.</p></div>";
  html +=
      "<p class=\"hint\"><span class=\"how\">Drag to turn, shift-drag to move, pinch or wheel (after a click) to "
      "zoom; arrow keys, + and −. </span>" +
      std::to_string(code->triangles) + " triangles. P1 is the lower groove, P2 the upper one.</p>";
  return html + "<script type=\"text/plain\" id=\"mesh\">" + code->base64 + "</script>";
}

// Mechanism -----------------------------------------------------------------------------------------------------------

Pose pose_near(const profile::SynthesisResult& synthesis, double theta) {
  const auto nearest = std::min_element(
      synthesis.stroke.begin(), synthesis.stroke.end(),
      [&](const auto& a, const auto& b) { return std::abs(a.theta - theta) < std::abs(b.theta - theta); });
  return {nearest->alpha, nearest->theta};
}

/// Both ends, home and one more between; evenly spaced if home is an end or outside the range.
std::vector<Pose> poses(const Product& product) {
  const profile::SynthesisResult& synthesis = product.synthesis;
  if (synthesis.stroke.empty()) return {};
  const double low = product.joint.mechanism.joint.theta_min;
  const double high = product.joint.mechanism.joint.theta_max;
  std::array<double, 4> thetas{low, 0, 0.5 * high, high};
  if (low >= 0 || high <= 0) thetas = {low, low + (high - low) / 3, high - (high - low) / 3, high};
  std::vector<Pose> result;
  for (const double theta : thetas) result.push_back(pose_near(synthesis, theta));
  return result;
}

/// Text for the path of both tendons from their ends to the pulley.
std::string tendon_path_words(const Mechanism& mechanism) {
  if (mechanism.is_papers()) return "from C over the pin to the pulley";
  std::string words = mechanism.joint.is_plain() ? "from C" : "from their ends on the link";
  if (mechanism.joint.drum_radius > 0) words += ", on its drum as far as they touch it,";
  words += mechanism.guides.kind == GuideKind::idler ? " over the idlers" : " over the pins";
  return words +
         (mechanism.sheath.is_there() ? ", through their sheaths (drawn shorter) to the pulley" : " to the pulley");
}

std::string mechanism_words(const Mechanism& mechanism) {
  return "<p class=\"lead\">To scale. Both tendons run on their true path at the centre line: " +
         tendon_path_words(mechanism) +
         ", and along the groove to their anchor.\nThe pulleys are shown by their pitch curves; the dash-dotted ray "
         "points to home.</p>\n<p class=\"key\"><span class=\"swatch p1\">tendon 1, pulley P1</span><span "
         "class=\"swatch p2\">tendon 2, pulley P2</span><span class=\"swatch dot\">take-off point</span></p>\n";
}

/// "C → pin B → P1".
std::string path_words(const Mechanism& mechanism, transmission::Side side) {
  const bool left = side == transmission::Side::left;
  const bool has_attachment = (left ? mechanism.joint.attachment1 : mechanism.joint.attachment2).has_value();
  std::string words = !has_attachment ? "C" : left ? "A1" : "A2";
  if (mechanism.joint.drum_radius > 0) words += " → drum";
  words += mechanism.guides.kind == GuideKind::idler ? " → idler " : " → pin ";
  words += left ? "B" : "D";
  if (mechanism.sheath.is_there()) words += " → sheath";
  return words + (left ? " → P1, lower groove" : " → P2, upper groove");
}

constexpr std::string_view k_profile_words =
    "<p class=\"lead\">Radii are measured to the tendon’s centre line, before the scale for shrinkage. a: anchor under "
    "load; s: spare anchor.</p>\n";

std::string mechanism_panels(const Product& product) {
  if (product.helix) return all_in_divs(helix_plots(product));
  std::string html;
  for (const Figure& figure : mechanism_figures(product.joint.mechanism, product.synthesis, poses(product)))
    html += in_div(figure);
  return html;
}

std::string moving_section(const Product& product) {
  if (product.helix)
    return "<section id=\"moving\"><h2>The tendons in motion</h2>" + std::string(k_moving_helix_words) +
           moving_helix(product) + "</section>";
  const std::string joint = moving_joint(product.joint.mechanism, product.synthesis, product.holding.loaded);
  if (joint.empty()) return "";
  return "<section id=\"moving\"><h2>The joint moves</h2>" + std::string(k_moving_words) + joint + "</section>";
}

std::string torques_section(const Product& product) {
  const std::vector<Plot> plots = torque_plots(product);
  if (plots.empty()) return "";
  return "<section id=\"torques\"><h2>Torques</h2><p class=\"lead\">The target torque of the motor, and the torque "
         "that it requires: without friction, from the angles of the pulley as wound; and with stretch and "
         "friction, for α "
         "increasing and decreasing.</p><div class=\"plots\">" +
         all_in_divs(plots) + "</div></section>";
}

/// The result beside the paper's model, which has no tendon 1.
std::string_view taut_words(const analysis::UnderLoad& load) {
  if (load.rows.empty() || load.lost_at) return "";
  return load.slack1.empty() && load.slack2.empty()
             ? "With the pretension, both tendons of this joint stay taut over the whole range."
             : "With the pretension, a tendon of this joint goes slack: see the top of this page.";
}

std::string forces_section(const Product& product) {
  const std::string torques = torques_section(product);
  const std::vector<Plot> plots = force_plots(product);
  if (plots.empty()) return torques;
  return torques + "<section id=\"forces\"><h2>Forces</h2><p class=\"lead\">" +
         safe_text(with_unit(product.joint.mechanism.load.tip_force, "N")) +
         " at the tip, across OC, by the paper’s model (equations 6 to 11), which leaves out the pretension and "
         "tendon 1: the tension of tendon 2, and the joint angle that its stretch costs. " +
         std::string(taut_words(product.under_load)) + "</p><div class=\"plots\">" + all_in_divs(plots) +
         "</div></section>";
}

// Making --------------------------------------------------------------------------------------------------------------

std::string tendon_row(const TendonLength& tendon, const Mechanism& mechanism) {
  const bool left = tendon.side == transmission::Side::left;
  return "<tr><td>" + std::string(left ? "Tendon 1" : "Tendon 2") + "</td><td>" + path_words(mechanism, tendon.side) +
         "</td><td class=\"number\">" + readable(tendon.between_knots, 1) + " mm</td><td class=\"number\">" +
         readable(tendon.cut, 0) + " mm</td><td class=\"number\">" + readable(degrees(tendon.spare_lap), 0) +
         "°</td></tr>";
}

/// Cut lengths for the test rig, where they differ.
std::string rig_words(const Product& product) {
  if (!product.rig) return "";
  std::string words;
  for (const KitCut& cut : rig_cuts(product, *product.rig))
    words += (words.empty() ? "tendon " : ", tendon ") + std::string(cut.side == transmission::Side::left ? "1" : "2") +
             " at " + readable(cut.cut, 0) + " mm (" + readable(cut.longer, 0) + " mm more)";
  return words.empty() ? ""
                       : " For the test rig of <code>fusee kit</code> cut " + words +
                             ": they run on to its tensioner and round its post.";
}

std::string tendon_table(const Product& product) {
  std::string rows;
  for (const TendonLength& tendon : tendon_lengths(product)) rows += tendon_row(tendon, product.joint.mechanism);
  if (rows.empty()) return "";
  return "<h3>Tendons</h3><div class=\"scroll\"><table><thead><tr><th></th><th>Path</th><th class=\"number\">Knot to "
         "knot</th>"
         "<th class=\"number\">Cut at</th><th class=\"number\">Left on the pulley at full "
         "pay-out</th></tr></thead><tbody>" +
         rows + "</tbody></table></div><p class=\"hint\">From " +
         std::string(product.joint.mechanism.joint.is_plain() ? "C" : "its end") +
         " to the knot’s pocket, taut, with the joint and the pulley at "
         "home. The cut length adds both knots and a tail of 50 mm at each end to pull them tight with, rounded up to "
         "5 mm." +
         rig_words(product) + "</p>";
}

std::string knot_row(const solid::KnotHold& knot, const solid::Holding& holding) {
  const std::optional<double> share = holding.share(knot);
  const bool left = knot.side == transmission::Side::left;
  const auto cell = [](const std::string& words) { return "<td class=\"number\">" + words + "</td>"; };
  return "<tr><td>" + std::string(left ? "Tendon 1, on P1" : "Tendon 2, on P2") + "</td>" +
         cell(readable(degrees(knot.alpha), 1) + "°") + cell(with_unit(knot.tension, "N", 3)) +
         cell(readable(degrees(knot.wrap_left), 0) + "°") + cell(with_unit(knot.at_knot, "N", 3)) +
         cell(share ? readable(100 * *share, 1) + " %" : "not known") + "</tr>";
}

std::string strength_words(const Product& product) {
  const std::optional<analysis::Strength>& strength = product.holding.strength;
  if (!strength) return "The tendon’s strength is not known: set tendon.strength_N.";
  const bool declared = strength->source == "tendon.strength_N";
  return "It bears " + with_unit(strength->tension, "N") + " without a knot (" +
         (declared ? "" : "an estimate: the catalogue’s ") + safe_text(strength->source) + ") and " +
         with_unit(strength->at_knot, "N") + " at one (tendon.knot_efficiency " +
         readable_rounded(product.joint.mechanism.tendon.knot_efficiency) + "); half of that is safe.";
}

std::string knot_table(const Product& product) {
  std::string rows;
  for (const solid::KnotHold& knot : product.holding.knots) rows += knot_row(knot, product.holding);
  if (rows.empty()) return "";
  return "<h3>Knots on the pulley</h3><div class=\"scroll\"><table><thead><tr><th></th><th class=\"number\">Largest at "
         "α</th><th class=\"number\">Tendon carries</th><th class=\"number\">Wrap</th><th "
         "class=\"number\">Knot carries</th><th class=\"number\">Of its strength</th></tr></thead><tbody>" +
         rows +
         "</tbody></table></div><p class=\"hint\">The wrap φ between take-off and tie-off leaves T·e<sup>−μφ</sup> to "
         "the knot, μ = " +
         readable_rounded(product.joint.mechanism.pulley.mu) +
         " (pulley.friction): the most over the stroke, in both directions, with the load and without. " +
         strength_words(product) + "</p>";
}

/// Instructions for mounting the pulley on its shaft or horn.
std::string mounting(const Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const std::string home = " with P1 below and " + home_words(product) + ": the direction from O to C at home.";
  if (mechanism.body.bore != Bore::horn) return "Put the pulley on its shaft" + home;
  const Horn& horn = horn_of(mechanism);
  if (horn.spline_teeth > 0) {
    return "Turn the servo to where its home shall be. Push the pulley onto its toothed shaft" + home +
           " It fits every " + readable(360.0 / horn.spline_teeth, 1) +
           "°: correct the remainder with the controller’s zero. The screw comes from above.";
  }
  return "Put the horn on the servo at its home, the first screw " + readable(degrees(horn.first_bolt), 1) +
         "° from +x towards +y, and its own screw in the middle. Screw the pulley onto it (" +
         std::to_string(horn.bolt_count) + " holes on " + readable_rounded(horn.bolt_circle) + " mm)" + home;
}

/// Explains why a round bore has corners; "" if it has none.
std::string polyhole_words(const solid::BoreLayout& bore) {
  if (!bore.circle) return "";
  return " The bore is a polygon of " + std::to_string(bore.outline.size()) +
         " sides on purpose: printed corners cut inside a curve, so a circle would come out too small. Its "
         "sides touch the circle of " +
         with_unit(bore.circle->diameter, "mm") + ": try the shaft in it.";
}

/// Instructions for routing a tendon from its pulley to its end.
std::string routing_words(const Mechanism& mechanism) {
  const std::string pin = mechanism.guides.kind == GuideKind::idler ? "idler " : "pin ";
  const std::string over = mechanism.sheath.is_there() ? "through its sheath, over the " : "up over the ";
  std::string to = " to C";
  if (!mechanism.joint.is_plain())
    to = mechanism.joint.drum_radius > 0 ? " and the drum to its end on the link" : " to its end on the link";
  return over + "outer side of " + pin + "B" + to + "; tendon 2 likewise from P2 over " + pin + "D.";
}

std::vector<std::string> steps(const Product& product) {
  const solid::BodyLayout& layout = product.pulley.layout;
  std::vector<std::string> items{
      "Print it on its lower flange, in the orientation of the files: the groove walls require no support. Use enough "
      "walls that grooves and anchors are solid."};
  if (layout.scale != 1) {
    items.push_back("The files are already " + readable((layout.scale - 1) * 100, 2) +
                    " % larger, for the shrinkage of " + product.joint.mechanism.material.name +
                    ": do not scale again.");
  }
  items.push_back("Measure the bore and the groove with a caliper before going on." + polyhole_words(layout.bore));
  items.push_back(mounting(product));
  if (product.helix) {
    items.push_back(std::string(k_winding_words));
    items.push_back(helix_heights(product));
  } else
    items.push_back(
        "Hold the joint at home. Knot tendon 1 into P1’s anchor, lay it into the lower groove and lead it " +
        routing_words(product.joint.mechanism));
  items.push_back("Tighten both until tendon 1 carries " + with_unit(product.joint.mechanism.tendon.pretension, "N") +
                  " at home, then turn the pulley over the whole stroke: neither may go slack.");
  return items;
}

/// A table of the design values that differ from the declared ones, for an identified joint.
std::string derived_table(const Product& product) {
  const DerivedNumbers derived = derived_numbers(product.file.mechanism, product.joint);
  std::string rows;
  for (const Field* field : derived.fields) {
    rows += "<tr><td>" + safe_text(field->name()) + "</td><td class=\"number\">" +
            safe_text(field_words(*field, product.file.mechanism)) + "</td><td class=\"number\">" +
            safe_text(field_words(*field, derived.made)) + "</td></tr>";
  }
  if (rows.empty()) return "";
  return "<h3>Declared and built</h3><div class=\"scroll\"><table><thead><tr><th>Key</th><th "
         "class=\"number\">Declared</th><th class=\"number\">Built</th></tr></thead><tbody>" +
         rows +
         "</tbody></table></div><p class=\"hint\">These numbers include the file’s [identified] table: with them the "
         "identified joint follows the target motion.</p>";
}

/// Links to files beside the page. `names`: separated by ", ".
std::string file_links(std::string_view names) {
  std::string html;
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(", "), names.size());
    const std::string name(names.substr(0, end));
    html += (html.empty() ? "<a href=\"" : ", <a href=\"") + name + "\"><code>" + name + "</code></a>";
    names.remove_prefix(std::min(end + 2, names.size()));
  }
  return html;
}

std::string files_table(const Product& product) {
  struct File {
    std::string_view name;
    std::string_view words;
  };
  constexpr File k_files[] = {
      {"pulley.stl, pulley.3mf, pulley.obj, pulley.drc", "the part, to print or to look at"},
      {"pulley.scad", "the part as an OpenSCAD program, to change"},
      {"profile.dxf", "pitch curves, groove floors and bore"},
      {"plates.dxf", "the part as plates to cut"},
      {"profile.csv, transmission.csv", "the curves and the stroke as tables"},
      {"profile_p1.csv, profile_p2.csv", "points of each pitch curve, for a spline in CAD"},
      {"mechanism.toml", "the mechanism file of this part; <code>fusee new --from pulley.3mf</code> writes it, too"},
      {"manifest.json", "the checks and the files’ hashes, for programs"}};
  std::string html = "<h3>Other files</h3><div class=\"scroll\"><table><tbody>";
  const bool has_step = std::any_of(product.checks.begin(), product.checks.end(),
                                    [](const Check& check) { return check.name.rfind("step_", 0) == 0; });
  if (has_step) html += "<tr><td>" + file_links("pulley.step") + "</td><td>the part for CAD</td></tr>";
  for (const File& file : k_files) {
    // A multi-turn pulley has no plates.
    if (product.helix && file.name == "plates.dxf") continue;
    html += "<tr><td>" + file_links(file.name) + "</td><td>" + std::string(file.words) + "</td></tr>";
  }
  return html + "</tbody></table></div>";
}

std::string making(const Product& product) {
  std::string html =
      html_list(steps(product), "ol") + tendon_table(product) + knot_table(product) + derived_table(product);
  if (!product.pulley.layout.notes.empty())
    html += "<h3>Sizes chosen automatically</h3>" + html_list(product.pulley.layout.notes);
  return html + files_table(product);
}

std::string source_words(const MechanismFile& file) {
  const std::string source = source_html(file);
  std::string words = source.empty() ? "" : "from " + source;
  if (!file.sha256.empty()) words += " (SHA-256 " + safe_text(file.sha256.substr(0, 12)) + "…)";
  return words;
}

std::string conditions(const Product& product) {
  std::string html = "<h3>Over the stroke</h3>" + conditions_table(product.synthesis.conditions, true);
  if (!product.pulley.conditions.empty()) html += "<h3>Body</h3>" + conditions_table(product.pulley.conditions, false);
  return html;
}

std::string profiles(const Product& product) {
  std::string html;
  if (product.helix) {
    for (const transmission::Side side : {transmission::Side::left, transmission::Side::right})
      html += in_div(spiral_figure(product, side));
    return html;
  }
  for (const profile::Outline* outline : {&product.synthesis.p1, &product.synthesis.p2}) {
    html += in_div(profile_figure(product.joint.mechanism, *outline, product.pulley));
  }
  for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
    if (const auto figure = polar_figure(product.synthesis, side)) html += in_div(*figure);
  }
  return html;
}

}  // namespace

std::string report_html(const Product& product) {
  auto part = run_async([&product] { return part_view(product); });
  auto mechanism = run_async([&product] { return mechanism_panels(product); });
  const PageVerdict verdict = verdict_of(product);
  const LengthUnit units = product.file.mechanism.units;
  const std::string name = product.joint.mechanism.name.empty() ? "unnamed" : safe_text(product.joint.mechanism.name);
  return filled_page(
      embedded::page_html,
      {
          {"tool", std::string(k_tool)},
          {"name", name},
          {"figure_css", std::string(embedded::figure_css)},
          {"page_css", std::string(embedded::page_css)},
          {"readout_js", std::string(embedded::readout_js)},
          {"viewer_js", std::string(embedded::viewer_js)},
          {"moving_joint_js",
           std::string(product.helix ? embedded::moving_helix_js : joint_script(product.joint.mechanism))},
          {"source", source_words(product.file)},
          {"verdict_class", verdict.style},
          {"verdict_sign", verdict.sign},
          {"verdict", safe_text(lengths_in(units, verdict.words))},
          {"warnings", warnings(product)},
          {"key_numbers", key_numbers(product)},
          {"part", part.get()},
          {"moving", moving_section(product)},
          {"mechanism_words", product.helix ? std::string(k_helix_words) : mechanism_words(product.joint.mechanism)},
          {"mechanism_class", product.helix ? "plots" : "panels"},
          {"mechanism", mechanism.get()},
          {"transmission_plots", all_in_divs(transmission_plots(product))},
          {"as_built_words", safe_text(lengths_in(units, as_built_words(product)))},
          {"as_built_plots", all_in_divs(as_built_plots(product))},
          {"forces", forces_section(product)},
          {"profile_words", std::string(product.helix ? k_spiral_words : k_profile_words)},
          {"profiles", lengths_in(units, profiles(product))},
          {"checks", checks_tables(product.checks)},
          {"conditions", lengths_in(units, conditions(product))},
          {"making", lengths_in(units, making(product))},
          {"footer", "Made by " + std::string(k_tool) + ". Lengths " +
                         (units == LengthUnit::mm ? "" : "without a unit ") + "in mm, angles in degrees, forces in N."},
      });
}

}  // namespace fusee::formats
