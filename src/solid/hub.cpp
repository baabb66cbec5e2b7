#include "solid/hub.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "base/text.h"
#include "solid/condition_list.h"
#include "solid/set_screw.h"

namespace fusee::solid {
namespace {

bool wants_set_screw(const Body& body) { return body.set_screw != "none" && body.bore != Bore::horn; }

// Threads of an automatic set screw, from the preferred one down.
constexpr std::array k_automatic_screws{"M3", "M2.5", "M2"};

// Wall that carries the torque of a shaft in a hub without a set screw, mm.
constexpr double k_torque_wall = 2.0;

// All hubs that fit, for a layout whose height includes the hub's.
class HubSearch {
 public:
  HubSearch(const BodyLayout& layout, const Mechanism& mechanism, double rim_radius)
      : with_height_(layout), mechanism_(mechanism), body_(mechanism.body), limit_(rim_radius - k_hub_margin) {
    with_height_.z_hub = layout.z_top + body_.hub_height;
  }

  std::vector<HubChoice> all() const {
    std::vector<HubChoice> choices;
    if (body_.hub_height > 0) {
      if (wants_set_screw(body_)) add_with_screws(choices);
      add_without_screw(choices);
    }
    if (choices.empty() || may_be_omitted()) choices.emplace_back();
    return choices;
  }

 private:
  bool is_automatic_screw() const { return body_.set_screw == "auto"; }
  // A hub may be omitted if the file requests neither its diameter nor its screw.
  bool may_be_omitted() const { return body_.hub_diameter <= 0 && (is_automatic_screw() || !wants_set_screw(body_)); }

  // A screw wider than the shaft would bear on the shaft's edges. The smallest screw is always tried.
  bool suits_shaft(const Screw& screw) const {
    return screw.nominal <= with_height_.bore.shaft || screw.name == std::string_view(k_automatic_screws.back());
  }

  void add_with_screws(std::vector<HubChoice>& choices) const {
    if (!is_automatic_screw()) {
      add_with_screw(*find_screw(body_.set_screw), body_.nut_trap, choices);
      return;
    }
    for (const bool nut_trap : {true, false}) {
      if (nut_trap && !body_.nut_trap) continue;
      for (const char* name : k_automatic_screws) {
        if (const Screw& screw = *find_screw(name); suits_shaft(screw)) add_with_screw(screw, nut_trap, choices);
      }
    }
    std::stable_sort(choices.begin(), choices.end(),
                     [](const HubChoice& a, const HubChoice& b) { return a.radius > b.radius; });
  }

  // A screw requested by name is kept in a hub that is too small for it: a condition reports that.
  void add_with_screw(const Screw& screw, bool nut_trap, std::vector<HubChoice>& choices) const {
    const double wall = with_height_.min_wall;
    const SetScrewLayout candidate =
        set_screw_layout(screw, nut_trap, mechanism_.material.hole_compensation, wall, with_height_);
    const double needed = hub_radius_for(candidate, with_height_.bore.radius, wall);
    const double radius = body_.hub_diameter > 0 ? 0.5 * body_.hub_diameter : needed;
    const bool fits = needed <= radius && radius <= limit_ && height_to_spare(candidate, with_height_, wall) >= 0;
    const bool is_kept = !is_automatic_screw() && (body_.hub_diameter > 0 || radius <= limit_);
    // In a hub of requested size a smaller screw saves nothing.
    const bool is_covered =
        body_.hub_diameter > 0 && std::any_of(choices.begin(), choices.end(),
                                              [&](const HubChoice& one) { return one.set_screw.nut_trap == nut_trap; });
    if ((fits || is_kept) && !is_covered) choices.push_back({radius, candidate});
  }

  void add_without_screw(std::vector<HubChoice>& choices) const {
    if (body_.hub_diameter > 0) {
      choices.push_back({0.5 * body_.hub_diameter, {}});
    } else if (const double radius = least_hub_radius(with_height_); radius <= limit_ && body_.bore != Bore::horn) {
      choices.push_back({radius, {}});
    }
  }

  BodyLayout with_height_;
  const Mechanism& mechanism_;
  const Body& body_;
  double limit_;  ///< largest radius of a hub on the upper flange
};

// Rounds up to tenths, as messages print it. A value that exceeds a tenth only by rounding is not raised to the next.
double rounded_up(double value) {
  constexpr double k_rounding = 1e-9;
  return 0.1 * std::ceil(value / 0.1 - k_rounding);
}

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
  if (body.set_screw == "auto" || !wants_set_screw(body)) return;
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

double least_hub_radius(const BodyLayout& layout) {
  return layout.bore.radius + std::max(layout.min_wall, k_torque_wall);
}

std::vector<HubChoice> hub_choices(const BodyLayout& layout, const Mechanism& mechanism, double rim_radius) {
  return HubSearch(layout, mechanism, rim_radius).all();
}

void set_hub(BodyLayout& layout, const Mechanism& mechanism, const HubChoice& choice) {
  const Body& body = mechanism.body;
  layout.hub_radius = choice.radius;
  layout.set_screw = choice.set_screw;
  layout.z_hub = layout.z_top + (choice.radius > 0 ? body.hub_height : 0.0);
  if (body.hub_height <= 0) return;
  if (choice.radius <= 0) {
    if (body.bore == Bore::horn) {
      layout.notes.emplace_back("a servo horn requires no hub: omitted");
    } else {
      layout.omit("hub", fmt::format("no space on the upper flange for a hub of {:.1f} mm: omitted",
                                     2.0 * least_hub_radius(layout)));
    }
  }
  if (!wants_set_screw(body)) return;
  const SetScrewLayout& screw = choice.set_screw;
  if (!screw.present) {
    layout.omit("set_screw", choice.radius > 0 ? "set screw omitted, as there is no space for a hub with one"
                                               : "set screw omitted, as there is no hub for it");
    return;
  }
  const bool is_smaller = body.set_screw == "auto" && screw.thread != k_automatic_screws.front();
  const std::string thread = is_smaller ? " (" + screw.thread + ")" : "";
  if (body.nut_trap && !screw.nut_trap) {
    layout.omit(
        "nut",
        fmt::format("nut omitted, as the hub has no space for it: the set screw{} is screwed into a thread of the hub",
                    thread));
  } else if (is_smaller) {
    layout.notes.push_back(fmt::format("no space for a hub with a larger set screw: it is {}", screw.thread));
  }
}

std::vector<profile::Condition> hub_conditions(const Mechanism& mechanism, const BodyLayout& layout,
                                               double rim_radius) {
  ConditionList list;
  check_hub(list, layout, rim_radius);
  check_set_screw(list, mechanism, layout);
  return list.release();
}

}  // namespace fusee::solid
