#include "solid/hub.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.h"
#include "solid/condition_list.h"
#include "solid/set_screw.h"

namespace fusee::solid {
namespace {

double plain_hub_radius(const BodyLayout& layout, double wall) { return layout.bore.radius + std::max(wall, 2.0); }

class HubChooser {
 public:
  HubChooser(BodyLayout& layout, const Mechanism& mechanism, double rim_radius)
      : layout_(layout), mechanism_(mechanism), body_(mechanism.body), limit_(rim_radius - k_hub_margin) {}

  void choose() {
    if (body_.hub_height <= 0) return;
    layout_.z_hub = layout_.z_top + body_.hub_height;
    if (wants_screw()) {
      if (take_screw(body_.nut_trap)) return;
      if (automatic_screw() && body_.nut_trap && take_screw(false)) {
        layout_.notes.push_back("no space in the hub for a nut: the set screw's thread is cut into the hub");
        return;
      }
      layout_.notes.push_back("no space in the hub for a set screw: omitted");
    }
    take_plain();
  }

 private:
  bool automatic_screw() const { return body_.set_screw == "auto"; }
  bool wants_screw() const { return body_.set_screw != "none" && body_.bore != Bore::horn; }

  bool take_screw(bool nut_trap) {
    const Screw* screw = find_screw(automatic_screw() ? "M3" : body_.set_screw);
    if (screw == nullptr) return false;
    const double wall = layout_.min_wall;
    const SetScrewLayout candidate =
        set_screw_layout(*screw, nut_trap, mechanism_.material.hole_compensation, wall, layout_);
    const double needed = hub_radius_for(candidate, layout_.bore.radius, wall);
    const double radius = body_.hub_diameter > 0 ? 0.5 * body_.hub_diameter : needed;
    const bool fits = needed <= radius && radius <= limit_ && height_to_spare(candidate, layout_, wall) >= 0;
    // A feature requested by name is kept, and a condition reports why it does not fit.
    if (!fits && automatic_screw()) return false;
    if (!fits && body_.hub_diameter <= 0 && radius > limit_) return false;
    layout_.set_screw = candidate;
    layout_.hub_radius = radius;
    return true;
  }

  void take_plain() {
    const double radius =
        body_.hub_diameter > 0 ? 0.5 * body_.hub_diameter : plain_hub_radius(layout_, layout_.min_wall);
    if (body_.hub_diameter > 0 || (radius <= limit_ && body_.bore != Bore::horn)) {
      layout_.hub_radius = radius;
      return;
    }
    layout_.z_hub = layout_.z_top;
    layout_.notes.push_back(
        body_.bore == Bore::horn
            ? "a servo horn requires no hub: omitted"
            : fmt::format("no space on the upper flange for a hub of {:.1f} mm: omitted", 2.0 * radius));
  }

  BodyLayout& layout_;
  const Mechanism& mechanism_;
  const Body& body_;
  double limit_;
};

double rounded_up(double value) { return 0.1 * std::ceil(value / 0.1 - 1e-9); }

void check_hub(ConditionList& list, const BodyLayout& layout, double rim_radius) {
  if (layout.hub_radius <= 0) return;
  // A horn's screws pass through the hub as the bore does.
  double reach = layout.bore.radius;
  for (const Polygon& hole : layout.bore.screw_holes) reach = std::max(reach, circumradius(hole));
  const double diameter = 2.0 * layout.hub_radius, wall = layout.hub_radius - reach;
  list.add_least(
      "hub_wall", wall, layout.min_wall,
      fmt::format(
          "a hub of {} mm (body.hub_diameter_mm) leaves {} about {}; at least {} mm is required (body.min_wall_mm)",
          rounded(diameter), wall_words(wall), reach > layout.bore.radius ? "the horn's holes" : "the bore",
          rounded(layout.min_wall, 3)));
  const double limit = 2.0 * (rim_radius - k_hub_margin);
  list.add_most(
      "hub_on_flange", diameter, limit,
      fmt::format("the upper flange has space for a hub of {} mm, but this one has {} mm (body.hub_diameter_mm)",
                  rounded(limit), rounded(diameter)));
}

double hub_radius_for_named_screw(const Mechanism& mechanism, const BodyLayout& layout) {
  const Body& body = mechanism.body;
  const Screw* screw = find_screw(body.set_screw);
  if (screw == nullptr) return 0;
  return hub_radius_for(
      set_screw_layout(*screw, body.nut_trap, mechanism.material.hole_compensation, layout.min_wall, layout),
      layout.bore.radius, layout.min_wall);
}

// Only a set screw requested by name can fail.
void check_set_screw(ConditionList& list, const Mechanism& mechanism, const BodyLayout& layout) {
  const Body& body = mechanism.body;
  if (body.set_screw == "auto" || body.set_screw == "none" || body.bore == Bore::horn) return;
  const double diameter = 2.0 * layout.hub_radius, needed = 2.0 * hub_radius_for_named_screw(mechanism, layout);
  if (!layout.set_screw.present) {
    list.add(
        "set_screw_wall", diameter, needed, false,
        fmt::format("there is no place for set screw {} (body.set_screw), which requires a hub of {:.1f} mm with a "
                    "side free of knot pockets",
                    body.set_screw, rounded_up(needed)));
    return;
  }
  list.add_least(
      "set_screw_wall", diameter, needed,
      fmt::format("set screw {} (body.set_screw{}) requires a hub of {:.1f} mm, this one has {} mm "
                  "(body.hub_diameter_mm)",
                  body.set_screw, body.nut_trap ? ", with body.nut_trap" : "", rounded_up(needed), rounded(diameter)));
  const double spare = height_to_spare(layout.set_screw, layout, layout.min_wall);
  list.add_least("set_screw_height", spare, 0.0,
                 fmt::format("a hub {} mm high (body.hub_height_mm) is {} mm too low for set screw {}",
                             rounded(body.hub_height), rounded(-spare, 3), body.set_screw));
}

}  // namespace

std::string wall_words(double wall) {
  return wall > 0 ? "a wall of " + rounded(wall, 3) + " mm" : "no wall (overlap of " + rounded(-wall, 3) + " mm)";
}

void choose_hub(BodyLayout& layout, const Mechanism& mechanism, double rim_radius) {
  HubChooser(layout, mechanism, rim_radius).choose();
}

std::vector<profile::Condition> hub_conditions(const Mechanism& mechanism, const BodyLayout& layout,
                                               double rim_radius) {
  ConditionList list;
  check_hub(list, layout, rim_radius);
  check_set_screw(list, mechanism, layout);
  return list.taken();
}

}  // namespace fusee::solid
