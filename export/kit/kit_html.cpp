// kit.html: the assembly page of the test rig.

#include <algorithm>
#include <filesystem>

#include "base/text.h"
#include "export/kit/kit_pictures.h"
#include "export/kit/kit_style.h"
#include "export/report/home_words.h"
#include "export/report/html.h"
#include "export/report/input_json.h"
#include "export/report/report_parts.h"
#include "export/report/tables.h"
#include "export/report/tendon_lengths.h"
#include "fusee/base.h"
#include "fusee/export.h"
#include "mechanism/catalogue.h"
#include "mechanism/lengths.h"

namespace fusee::formats {
namespace {

std::string mm(double value, int decimals = 1) { return readable(value, decimals) + "\u00a0mm"; }

const kit::KitPart* part_named(const kit::KitPlan& plan, const std::string& name) {
  const auto found =
      std::find_if(plan.parts.begin(), plan.parts.end(), [&](const kit::KitPart& part) { return part.name == name; });
  return found == plan.parts.end() ? nullptr : &*found;
}

/// The side of the pulley where a tendon leaves it, and its winding direction.
std::string winding_words(transmission::Side side) {
  return side == transmission::Side::left
             ? "P1, the lower groove. Seen from above it leaves the pulley on its left, and is wound "
               "counter-clockwise from "
               "there round the lower side"
             : "P2, the upper groove. Seen from above it leaves the pulley on its right, and is wound "
               "clockwise from there "
               "round the lower side";
}

std::vector<KitStep> steps_of(const KitProduct& product) {
  const kit::KitPlan& plan = product.plan;
  const kit::KitSizes& sizes = plan.sizes;
  std::vector<KitStep> steps;
  KitStep base;
  base.title = "Base, legs and motor";
  base.parts = {"base_plate", "leg"};
  base.motor = true;
  base.words = {"Screw a leg under each corner of the base plate, from above."};
  if (sizes.motor) {
    base.words.push_back(
        "Screw the motor" + (sizes.motor_name.empty() ? "" : " (" + sizes.motor_name + ")") +
        " under the plate, low heads above" +
        (sizes.motor->shaft > 0 ? "." : ", its horn up; turn its horn so that 0 of the motor is home."));
    if (sizes.motor_name != sizes.motor->name)
      base.words.push_back("The plate's holes for it are an assumption, those of " + sizes.motor->name +
                           ": body.shaft or body.horn in the mechanism file changes them.");
  } else
    base.words.push_back("Hold your motor under the plate, its axis in the large hole.");
  steps.push_back(base);

  KitStep pins;
  pins.title = "Axle, pins and feet";
  pins.parts = {"axle_spacer", "foot_spacer"};
  pins.rods = true;
  for (const kit::KitPin& pin : plan.pins) {
    const std::string letter = pin.side == transmission::Side::left ? "b" : "d",
                      name = pin.side == transmission::Side::left ? "B" : "D";
    for (const char* piece : {"spacer", "sleeve", "collar"}) {
      if (part_named(plan, "pin_" + letter + "_" + piece)) pins.parts.push_back("pin_" + letter + "_" + piece);
    }
    pins.words.push_back(
        "Pin " + name + (pin.side == transmission::Side::left ? " (left): " : " (right): ") +
        (pin.screw
             ? "the " + std::string(pin.screw->name) + " screw from below, then spacer, sleeve and collar, and the nut."
             : "press the rod in from above, flush below; glue the spacer to the plate, and the collar " +
                   readable(sizes.tendon_gap, 1) + " mm above it."));
  }
  pins.words.push_back("The axle's screw (" + std::string(sizes.axle->name) +
                       ") from below, its spacer over it; both threaded rods (" + std::string(sizes.foot->name) +
                       ") with a nut below, their spacers over them.");
  steps.push_back(pins);

  KitStep pulley;
  pulley.title = "Pulley";
  pulley.pulley = true;
  pulley.words = {
      "Tie both tendons to the pulley first (see Tendons), then put it on the motor, P1 down, its lower face " +
          mm(sizes.pulley_low) + " above the plate.",
      "Turn it to its home with the motor at 0: " + home_words(product.pulley) + ", the side of the joint's axis."};
  steps.push_back(pulley);

  KitStep scale;
  scale.title = "Scale";
  scale.parts = {"scale_plate", "bearing_ring"};
  scale.words = {"Over axle and feet, numbers up; it holds the axle.", "The ring under the bearing over the axle."};
  steps.push_back(scale);

  KitStep link;
  link.title = "Link";
  link.parts = {"link", "post", "magnet_cap"};
  link.words = {"Press both bearings (" + sizes.bearing->name + ") into the link from above, against its ledge.",
                "Push the post through the hole at C from above and screw its flange down.",
                "Link onto the axle, nut on top: it holds the inner rings, and the link turns freely.",
                "Press the magnet into the cap, flush with its outer face, and screw the cap over the nut."};
  steps.push_back(link);

  KitStep tendons;
  tendons.title = "Tendons and tensioner";
  tendons.parts = {"tensioner_slide"};
  tendons.tendons = true;
  tendons.words = {
      "Tendon 2 over pin D, between its collars, to the post: a bowline round its waist, free to turn.",
      "Tendon 1 over pin B to the post's lower end, up through it, along the link, one turn and a half round the "
      "slide's screw and under its washer.",
      "The tensioner's screw through the wall at the link's end into the nut in the slide: turn it until, at home, "
      "tendon 1 carries " +
          readable_rounded(product.pulley.joint.mechanism.tendon.pretension, 3) + " N."};
  steps.push_back(tendons);

  KitStep sensor;
  sensor.title = "Encoder";
  sensor.parts = {"foot_tube", "bracket", "board_spacer"};
  sensor.words = {"Board (" + sizes.board->name + ") under the bracket on its spacers, chip down.",
                  "Bracket onto the feet, nuts on top: " + mm(sizes.board->gap) + " remain between magnet and chip.",
                  "At home the link's pointer stands at 0 of the scale: set both zeros there."};
  steps.push_back(sensor);
  return steps;
}

std::string pictures(const KitProduct& product) {
  const std::vector<KitStep> steps = steps_of(product);
  std::string html;
  for (std::size_t i = 0; i < steps.size(); ++i)
    html += "<div><h3>" + std::to_string(i + 1) + ". " + safe_text(steps[i].title) + "</h3>" +
            inline_svg(kit_picture(product, steps, i)) + html_list(steps[i].words, "ol") + "</div>";
  return html_section("assembly", "Step by step",
                      "<p class=\"lead\">Drawn from the parts themselves. Added parts are coloured: blue ones are "
                      "printed, tan ones are bought.</p><div class=\"pictures\">" +
                          html + "</div>");
}

/// "tendon 1 is 120 mm shorter, tendon 2 …" of the joint without rig.
std::string shorter_without_rig_words(const KitProduct& product) {
  std::string words;
  for (const KitCut& cut : kit_cuts(product))
    words += (words.empty() ? "tendon " : ", tendon ") + std::string(cut.side == transmission::Side::left ? "1" : "2") +
             " is " + mm(cut.longer, 0) + " shorter";
  return words;
}

std::string tendon_section(const KitProduct& product) {
  std::string rows;
  for (const KitCut& cut : kit_cuts(product)) {
    const bool left = cut.side == transmission::Side::left;
    const auto lengths = tendon_lengths(product.pulley);
    const auto own_length =
        std::find_if(lengths.begin(), lengths.end(), [&](const TendonLength& one) { return one.side == cut.side; });
    rows += "<tr>" + html_cell(left ? "Tendon 1" : "Tendon 2") +
            html_cell(left ? "P1 → pin B → the post’s lower end → slide" : "P2 → pin D → round the post") +
            html_number_cell(mm(cut.between_knots)) + html_number_cell(mm(cut.cut, 0)) +
            html_number_cell(readable(degrees(own_length->spare_lap), 0) + "°") + html_cell(winding_words(cut.side)) +
            "</tr>";
  }
  return html_section(
      "tendons", "Tendons",
      html_table(
          {"", "path", "# taut, at home", "# cut at", "# left on the pulley at full pay-out", "direction of winding"},
          rows) +
          "<p class=\"hint\">Taut: from the knot on the pulley to C, and for tendon 1 on through the "
          "post to the slide’s screw. "
          "The cut length adds the turns round screw or post, both knots and a tail of 50 mm at each "
          "end, rounded up to 5 mm. It is " +
          shorter_without_rig_words(product) + ", the length without rig that <code>fusee build</code> prints.</p>" +
          html_list({"On the pulley: a figure-eight knot in each tendon’s end, pulled into its pocket; "
                     "the other spare hole of each groove "
                     "stays empty.",
                     "On the post: a bowline, which does not draw shut, so that the loop turns on the "
                     "post and pulls through C.",
                     "On the slide: one turn and a half round the screw, clamped by its washer; cut "
                     "the tail only after the first load."}));
}

std::string parts_section(const KitProduct& product) {
  std::string rows;
  for (const kit::KitPart& part : product.plan.parts) {
    const solid::Bounds box = solid::bounds(kit::mesh_of(part.body));
    const Vec3 size = box.high - box.low;
    rows += "<tr>" + html_number_cell(std::to_string(part.count)) + html_cell(part.words) +
            html_number_cell(readable(size.x(), 1) + " × " + readable(size.y(), 1) + " × " + readable(size.z(), 1) +
                             " mm") +
            html_cell(kit_file_name(part, "stl") + (part.plate ? ", kit.dxf" : "")) + "</tr>";
  }
  return html_section("parts", "To print, or to cut",
                      "<p class=\"lead\">In the orientation of the files, without supports; each as .3mf too. The "
                      "pulley itself is built by "
                      "<code>fusee build</code>.</p>" +
                          html_table({"#", "part", "# size", "file"}, rows));
}

std::string items_section(const KitProduct& product) {
  std::string rows;
  for (const kit::KitItem& item : product.plan.items)
    rows +=
        "<tr>" + html_number_cell(std::to_string(item.count)) + html_cell(item.what) + html_cell(item.use) + "</tr>";
  const Mechanism& mechanism = product.pulley.joint.mechanism;
  rows += "<tr>" + html_number_cell("2") + html_cell("tendon ⌀ " + rounded(mechanism.tendon.diameter) + " mm") +
          html_cell("see Tendons") + "</tr>";
  return html_section("buy", "To buy", html_table({"#", "what", "what for"}, rows));
}

std::string coupon_section(const Mechanism& mechanism) {
  std::string rows;
  for (const kit::CouponReading& reading : kit::coupon_readings(mechanism))
    rows += "<tr>" + html_cell(reading.what) + html_cell(reading.read) + html_cell(reading.key) + "</tr>";
  return html_section("coupon", "First: the fit coupon",
                      "<p class=\"lead\">Print fit_coupon.stl on its own. Its columns are numbered 0 to 4; write what "
                      "it shows into the "
                      "mechanism file, then run <code>fusee kit</code> and <code>fusee build</code> again.</p>" +
                          html_table({"look at", "read", "write"}, rows));
}

std::string fit_section(const KitProduct& product) {
  std::string rows;
  for (const profile::Condition& condition : product.plan.conditions) {
    const bool is_count = condition.unit != "mm";
    rows += "<tr>" + html_cell(plain_name(condition.name)) +
            html_number_cell(is_count ? readable(condition.value, 0) : mm(condition.value, 2)) +
            html_number_cell(is_count ? readable(condition.limit, 0) : mm(condition.limit, 2)) +
            html_number_cell(readable(degrees(condition.alpha), 1) + "°") + "</tr>";
  }
  return html_section(
      "fit", "Clearances",
      "<p class=\"lead\">The smallest value over the whole range, and its place.</p><div class=\"pictures\"><div>" +
          inline_svg(kit_plan_view(product)) + "</div><div>" +
          html_table({"", "# distance", "# at least", "# α"}, rows) + "</div></div>");
}

std::string key_section(const KitProduct& product) {
  const kit::KitSizes& sizes = product.plan.sizes;
  const Mechanism& mechanism = product.pulley.joint.mechanism;
  KeyNumbers numbers;
  numbers.add("Link R = OC", mm(mechanism.joint.R));
  numbers.add("Range", readable(degrees(mechanism.joint.theta_min), 1) + "° … " +
                           readable(degrees(mechanism.joint.theta_max), 1) + "°");
  numbers.add("Scale", readable(degrees(sizes.graduation), 0) + "°", "from line to line");
  numbers.add("Tendons above the base", mm(sizes.z_tendon1) + ", " + mm(sizes.z_tendon2));
  numbers.add("Motor", sizes.motor_name.empty() ? "your own" : sizes.motor_name,
              sizes.motor && sizes.motor_name != sizes.motor->name ? "mount assumed: " + sizes.motor->name : "");
  numbers.add("Bearings", "2 × " + sizes.bearing->name);
  numbers.add("Encoder", sizes.board->name);
  return html_section("numbers", "In short", numbers.html(mechanism.units));
}

// ---- plates to drill ------------------------------------------------------------------------------------------------

std::vector<std::string> template_words(const KitProduct& product) {
  const Mechanism& mechanism = product.pulley.joint.mechanism;
  const bool idlers = mechanism.guides.kind == GuideKind::idler;
  const bool is_helical = product.plan.heights.has_value();
  std::string guide_words = "Rods into B and D, upright: the tendons run on their outer sides.";
  if (idlers && is_helical && !mechanism.guides.collar)
    guide_words = "Smooth rollers onto bolts at B and D, over the whole height range of the tendons there.";
  else if (idlers)
    guide_words = "Idlers onto bolts at B and D, their grooves at the heights of both tendons.";
  std::vector<std::string> words{
      "Use the plates of base and link as drilling templates, or cut them (kit.dxf): every hole is at its axis.",
      guide_words, "The motor with the pulley at the large hole, P1 towards the base."};
  if (mechanism.joint.drum_radius > 0)
    words.push_back(
        "The drum under the link, both on the axle: glue or screw them to each other, so that the tendons " +
        std::string("lie on the drum at the heights of ") + (is_helical ? "the table." : "P1 and P2."));
  if (is_helical)
    words.push_back(
        "Tie the tendons to the link at their heights: a wrong height causes a fleet angle, and the tendon climbs the "
        "rib between two turns.");
  if (mechanism.sheath.is_there())
    words.push_back(
        "Sheaths from beside the pins, straight down there, to the sheath exits above the pulley. Their length and "
        "bends are the file’s; the part of the base with the pulley may be mounted anywhere.");
  words.push_back("At home, the axle is on the straight line from the pulley to the link’s hole C.");
  return words;
}

/// Heights of helical tendons.
std::string heights_section(const KitProduct& product) {
  const kit::TendonHeights& heights = *product.plan.heights;
  const bool drum = product.pulley.joint.mechanism.joint.drum_radius > 0;
  const auto span_words = [](const kit::TendonHeights::Span& span) {
    constexpr double k_shown_step = 0.1;  // mm, the resolution of a printed height
    return span.high - span.low < 0.5 * k_shown_step ? mm(span.low) : readable(span.low, 1) + " … " + mm(span.high);
  };
  std::string rows;
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
    rows += "<tr>" + html_cell(i == 0 ? "Tendon 1" : "Tendon 2") + html_number_cell(mm(heights.ends.at(i))) +
            html_number_cell(span_words(heights.guides.at(i))) +
            (drum ? html_number_cell(span_words(heights.drum)) : std::string()) + "</tr>";
  std::vector<std::string> heads{"", "# its end on the link", "# on its guide"};
  if (drum) heads.emplace_back("# both on the drum");
  return html_section("heights", "Heights of the tendons",
                      "<p class=\"lead\">Above the pulley’s lower face, of the tendon’s centre line, over the whole "
                      "range.</p>" +
                          html_table(heads, rows));
}

std::string template_sections(const KitProduct& product) {
  const Mechanism& mechanism = product.pulley.joint.mechanism;
  const bool is_helical = product.plan.heights.has_value();
  const std::vector<TendonLength> lengths = tendon_lengths(product.pulley);
  std::string rows, cuts;
  for (const KitCut& cut : kit_cuts(product)) {
    const auto own_length =
        std::find_if(lengths.begin(), lengths.end(), [&](const TendonLength& one) { return one.side == cut.side; });
    cuts += "<tr>" + html_cell(cut.side == transmission::Side::left ? "Tendon 1" : "Tendon 2") +
            html_number_cell(mm(cut.between_knots)) + html_number_cell(mm(cut.cut, 0)) +
            (is_helical ? html_number_cell(readable(own_length->lap_at_home / k_two_pi, 2)) : std::string()) +
            html_cell(winding_words(cut.side)) + "</tr>";
  }
  std::vector<std::string> heads{"", "# taut, at home", "# cut at"};
  if (is_helical) heads.emplace_back("# turns on the pulley at home");
  heads.emplace_back("direction of winding");
  for (const profile::Condition& condition : product.plan.conditions)
    rows += "<tr>" + html_cell(plain_name(condition.name)) + html_number_cell(mm(condition.value, 2)) +
            html_number_cell(mm(condition.limit, 2)) + "</tr>";
  return html_section("assembly", "Layout",
                      "<div class=\"pictures\"><div>" + inline_svg(kit_template_view(product)) + "</div><div>" +
                          html_list(template_words(product), "ol") + "</div></div>") +
         html_section("tendons", "Tendons",
                      html_table(heads, cuts) +
                          "<p class=\"hint\">Taut: from the knot on the pulley to that at its end on the link, with " +
                          std::string(mechanism.sheath.is_there() ? "its length in the sheath"
                                                                  : "its length on guide and drum") +
                          ".</p>") +
         (is_helical ? heights_section(product) : std::string()) +
         html_section("fit", "Between holes", html_table({"", "# distance", "# at least"}, rows));
}

}  // namespace

std::string kit_html(const KitProduct& product) {
  std::string notes;
  std::vector<std::string> lines = product.plan.warnings;
  lines.insert(lines.end(), product.plan.notes.begin(), product.plan.notes.end());
  if (!lines.empty()) notes = "<section class=\"warnings\">" + html_list(lines) + "</section>";
  const bool drilled = product.plan.drilled;
  const LengthUnit units = product.pulley.joint.mechanism.units;
  const std::string body =
      notes + (drilled ? std::string() : key_section(product)) + coupon_section(product.pulley.joint.mechanism) +
      parts_section(product) + items_section(product) +
      (drilled ? template_sections(product) : pictures(product) + tendon_section(product) + fit_section(product)) +
      plan_steps_html(product.bench);
  Page page{.title = "test rig",
            .kicker = "Test rig",
            .name = product.pulley.joint.mechanism.name,
            .source = "for " + source_html(product.pulley.file),
            .body = lengths_in(units, body),
            .foot = std::string(units == LengthUnit::mm ? "Lengths in mm." : "Lengths as marked; files are in mm.") +
                    " Values that were not measured are marked as assumed.",
            .styles = {embedded::page_css, embedded::plan_css, embedded::kit_css, embedded::figure_css},
            .scripts = {}};
  return html_page(page);
}

}  // namespace fusee::formats
