#include "solid/hub.h"

#include <fmt/format.h>

#include <algorithm>

#include "solid/set_screw.h"

namespace fusee {
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
        layout_.notes.push_back("no room in the hub for a nut: the set screw's thread is cut into the hub");
        return;
      }
      layout_.notes.push_back("no room in the hub for a set screw: left out");
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
    // What is asked for by name stays in, and a condition says what is wrong with it.
    if (!fits && automatic_screw()) return false;
    if (!fits && body_.hub_diameter <= 0 && radius > limit_) return false;
    layout_.set_screw = candidate;
    layout_.hub_radius = radius;
    return true;
  }

  void take_plain() {
    const double radius = body_.hub_diameter > 0 ? 0.5 * body_.hub_diameter : plain_hub_radius(layout_, layout_.min_wall);
    if (body_.hub_diameter > 0 || (radius <= limit_ && body_.bore != Bore::horn)) {
      layout_.hub_radius = radius;
      return;
    }
    layout_.z_hub = layout_.z_top;
    layout_.notes.push_back(
        body_.bore == Bore::horn
            ? "a servo horn needs no hub: left out"
            : fmt::format("no room on the upper flange for a hub of {:.1f} mm: left out", 2.0 * radius));
  }

  BodyLayout& layout_;
  const Mechanism& mechanism_;
  const Body& body_;
  double limit_;
};

}  // namespace

void choose_hub(BodyLayout& layout, const Mechanism& mechanism, double rim_radius) {
  HubChooser(layout, mechanism, rim_radius).choose();
}

}  // namespace fusee
