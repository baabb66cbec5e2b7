#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/helical_solid.h"
#include "helical_solid/helical_blank.h"
#include "helical_solid/helical_plan.h"
#include "helical_solid/run_out.h"
#include "helical_solid/winding.h"
#include "solid/boolean.h"
#include "solid/bore.h"
#include "solid/condition_list.h"
#include "solid/cut_variants.h"
#include "solid/euler.h"
#include "solid/groove.h"
#include "solid/heights.h"
#include "solid/hub.h"
#include "solid/self_intersection.h"
#include "solid/set_screw.h"
#include "solid/size.h"
#include "solid/support_attribution.h"
#include "solid/tools.h"

namespace fusee::helical_solid {
namespace {

// Thickness of a rib: two lines of a 0.4 mm nozzle, plus the loss of a typical printer. mm
constexpr double k_rib = 0.9;
// Diameters tried for an automatic bore, as for one-turn pulleys (solid/plan.cpp). mm
constexpr std::array<double, 6> k_bore_diameters{5.0, 4.0, 3.0, 2.5, 2.0, 1.5};
// Additional slope of ceilings. Slicers simplify outlines (PrusaSlicer to 0.0125 mm at layers of 0.2 mm), and
// neighbouring layers of a groove's flank get different corners. With the margin of other parts, 2.5° above the
// requested slope, PrusaSlicer put supports under 3 of 64 parts (seed 17001). A layer then projects too far already at
// 47.9°, because 0.2/tan(46°) − 0.0125 = 0.2/tan(47.9°). With this addition a part has the same margin as others.
constexpr double k_simplification_slope = radians(1.5);
// Automatic wall, as for one-turn pulleys: of parts of ordinary size (mm), per mm of radius for small ones, and the
// least (mm).
constexpr double k_wall = 1.2, k_wall_per_radius = 0.12, k_least_wall = 0.4;
// Fractions of the automatic knot pocket tried if the full size does not fit. Knots are 2.5 to 3 tendons thick.
constexpr std::array k_pocket_shares{1.0, 0.9, 0.8, 0.72};
// Size of the groove edge that the chamfer at the bed must leave, outwards and upwards. mm
constexpr double k_least_groove_edge = 0.2;
// Minimum material between a channel and the outside, mm.
constexpr double k_channel_cover = 0.25;
// Least depth of a groove in tendon diameters. In a shallower one a channel stays open too long for its ceiling to be
// supported.
constexpr double k_least_depth_ratio = 2.0 / 3.0;
// Tolerance of rounding for a size at its limit, mm.
constexpr double k_grain = 1e-6;
// Minimum height of the cone between the middle flange's two rings, which keeps them distinct. mm
constexpr double k_least_cone = 0.2;

profile::Condition condition_of(std::string name, bool ok, double value, double limit, std::string message) {
  profile::Condition condition;
  condition.name = std::move(name);
  condition.ok = ok;
  condition.value = value;
  condition.limit = limit;
  condition.unit = "mm";
  condition.message = std::move(message);
  return condition;
}

std::string mm(double value) { return rounded(value, 3) + " mm"; }

class Planner {
 public:
  Planner(const Mechanism& mechanism, const helix::Spiral& p1, const helix::Spiral& p2, double chord_error_mm)
      : mechanism_(mechanism),
        p1_(p1),
        p2_(p2),
        chord_error_mm_(chord_error_mm),
        d_(mechanism.tendon.diameter),
        section_(helical_section(mechanism)) {}

  HelicalPulley make(solid::TieOffSearch search) {
    if (plan().empty()) cut(search == solid::TieOffSearch::brief ? solid::k_brief_cut_variants : solid::k_cut_variants);
    return std::move(pulley_);
  }

  /// Returns the conditions that fail.
  std::vector<profile::Condition> plan() {
    if (!are_spirals_long_enough()) return profile::failed_of(pulley_.conditions);
    lay_out();
    const solid::BodyLayout layout = pulley_.layout;
    for (const double share : k_pocket_shares) {
      pulley_.layout = layout;
      size_run_outs(share);
      place_along_axis();
      if (mechanism_.body.knot_pocket > 0 || pockets_fit()) break;
    }
    add_conditions();
    return profile::failed_of(pulley_.conditions);
  }

 private:
  void add(std::string name, double value, double limit, std::string message) {
    pulley_.conditions.push_back(condition_of(std::move(name), value >= limit, value, limit, std::move(message)));
  }

  // Adds the conditions on length and size of both spirals. True if they hold.
  bool are_spirals_long_enough() {
    for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
      const std::vector<helix::SpiralRow>& rows = spiral(side).rows;
      const auto stands_still = [](const helix::SpiralRow& a, const helix::SpiralRow& b) { return !(b.turn > a.turn); };
      const bool grows = rows.size() >= 2 && std::adjacent_find(rows.begin(), rows.end(), stands_still) == rows.end();
      const double turn = grows ? rows.back().turn - rows.front().turn : 0.0;
      // Slightly more than a turn, so that every column has a row.
      constexpr double k_least_turn = k_two_pi + radians(10);
      profile::Condition condition = condition_of(
          fmt::format("whole_turn_{}", transmission::pulley_name(side)), turn >= k_least_turn, degrees(turn),
          degrees(k_least_turn),
          grows ? fmt::format("{}'s groove is {:.0f}° long, a helical one requires {:.0f}°. Increase body.spare_turns",
                              transmission::pulley_name(side), degrees(turn), degrees(k_least_turn))
                : fmt::format("{}'s pitch curve is straight at one place: a helical groove cannot follow it yet",
                              transmission::pulley_name(side)));
      condition.unit = "deg";
      pulley_.conditions.push_back(condition);
      const double reach = circumradius(spiral(side));
      if (auto far = solid::too_far_out(side, reach, reach)) pulley_.conditions.push_back(std::move(*far));
    }
    return profile::failed_of(pulley_.conditions).empty();
  }

  const helix::Spiral& spiral(transmission::Side side) const { return side == transmission::Side::left ? p1_ : p2_; }

  static double circumradius(const helix::Spiral& spiral) {
    double most = 0;
    for (const helix::SpiralRow& row : spiral.rows) most = std::max(most, elementary::hypot(row.x, row.y));
    return most;
  }
  double floor_radius(const helix::Spiral& spiral) const {
    double least = std::numeric_limits<double>::infinity();
    for (const helix::SpiralRow& row : spiral.rows)
      least = std::min(least, (Vec2(row.x, row.y) - 0.5 * d_ * unit(row.turn)).norm());
    return least - chord_error_mm_;
  }
  double least_floor() const { return std::min(floor_radius(p1_), floor_radius(p2_)); }

  // Sets the layout except heights, bore and hub.
  void lay_out() {
    solid::BodyLayout& layout = pulley_.layout;
    layout.parts = Parts::one;
    layout.tendon_diameter = d_;
    layout.ceiling_slope = section_.ceiling_slope;
    layout.p1 = layout.p2 = section_.walls;
    layout.groove_depth = section_.depth;
    layout.flange_thickness = mechanism_.body.flange_thickness;
    layout.scale = 1.0 / (1.0 - mechanism_.material.shrinkage);
    layout.min_wall = mechanism_.body.min_wall > 0
                          ? mechanism_.body.min_wall
                          : std::clamp(k_wall_per_radius * least_floor(), k_least_wall, k_wall);
    layout.elephant_foot =
        std::clamp(std::min(section_.depth - k_least_groove_edge,
                            (layout.flange_thickness - k_least_groove_edge) / solid::rise_of(layout, 1.0)),
                   0.0, mechanism_.material.elephant_foot);
    layout.notes.push_back("multi-turn pulleys have no marks and no slots for the tails");
  }

  void size_run_outs(double share) {
    solid::BodyLayout& layout = pulley_.layout;
    const RunOutSizes sizes = run_out_sizes(mechanism_, layout, share);
    run_outs_ = {sizes, sizes};
    layout.channel_width = 2.0 * sizes.channel_radius;
    layout.pocket_radius = sizes.pocket_radius;
    if (share < 1.0 && mechanism_.body.knot_pocket <= 0)
      layout.notes.push_back(
          fmt::format("knot pockets reduced to {} for lack of space", mm(2.0 * sizes.pocket_radius)));
  }

  // The place of a spiral with its last row at height 0. The height falls as the turn grows. The ends that stay wound,
  // P1's last and P2's first, are therefore at the outer faces.
  SpiralPlace placed(const helix::Spiral& spiral) const {
    SpiralPlace place;
    place.direction = spiral.slope > 0 ? -1.0 : 1.0;
    place.offset = -place.direction * spiral.rows.back().z;
    return place;
  }

  void place_along_axis() {
    solid::BodyLayout& layout = pulley_.layout;
    const double flange = layout.flange_thickness, groove_edge = section_.depth - 0.5 * d_;
    // Length of the filled rows, which must enclose the run-out.
    const double filled = run_outs_[0].bend_radius + 2.0 * layout.pocket_radius + layout.min_wall;
    const double fall1 = std::abs(p1_.slope) * filled, fall2 = std::abs(p2_.slope) * filled;
    pulley_.p1 = placed(p1_);
    pulley_.p2 = placed(p2_);
    fan_ = make_fan(SpiralCurve(p1_, pulley_.p1), SpiralCurve(p2_, pulley_.p2), groove_edge, 0.5 * d_, chord_error_mm_,
                    filled);
    ends_ = {GrooveEnd{transmission::Side::left, fan_.p1.groove_back(), 1.0, -1.0, 0.0},
             GrooveEnd{transmission::Side::right, fan_.p2.groove_front(), -1.0, 1.0, 0.0}};
    for (std::size_t i = 0; i < ends_.size(); ++i)
      run_outs_[i] = fitted_into(rim_of(fan_, ends_[i].side, groove_edge), ends_[i], run_outs_[i], layout.min_wall);

    layout.z_p1 = std::max(flange + section_.walls.below_width() + fall1, run_outs_[0].height());
    raise(fan_.p1, pulley_.p1, layout.z_p1);
    heights_.lower = fan_.p1.rows.front().height + section_.walls.above_width() + 0.5 * flange;
    layout.middle_cone =
        layout.ceiling_slope > 0 ? solid::rise_of(layout, std::max(0.0, middle_step(fan_, groove_edge))) : 0.0;
    heights_.upper = heights_.lower + std::max(layout.middle_cone, k_least_cone);
    raise(fan_.p2, pulley_.p2,
          heights_.upper + 0.5 * flange + section_.walls.below_width() - fan_.p2.rows.back().height);
    layout.z_p2 = fan_.p2.groove_front().height;
    layout.z_middle = heights_.lower;
    layout.z_mate = heights_.upper;
    layout.z_top = layout.z_p2 + std::max(flange + section_.walls.above_width() + fall2, run_outs_[1].height());
    layout.z_hub = layout.z_top;
    heights_.top = layout.z_top;
    ends_[0].row = fan_.p1.groove_back();
    ends_[1].row = fan_.p2.groove_front();
    ends_[1].face = layout.z_top;
    cover_channels();
    choose_bore();
    solid::set_hub(layout, mechanism_,
                   solid::hub_choices(layout, mechanism_, std::min(upper_rim(), pocket_inside(1))).front());
    heights_.hub_top = layout.z_hub;
  }

  // In a shallow groove a channel would break through the groove edges and leave an unsupported tooth of its ceiling.
  // It therefore widens along the way, and the groove edges over its entry project as far as the faces below support
  // them.
  void cover_channels() {
    const solid::BodyLayout& layout = pulley_.layout;
    const double groove_edge = section_.depth - 0.5 * d_;
    // The projection that a face of this height supports.
    const auto supported_projection = [&](double rise) {
      return layout.ceiling_slope > 0 ? rise / solid::rise_of(layout, 1.0) : std::numeric_limits<double>::max();
    };
    const std::array<double, 2> supported_low = {
        supported_projection(layout.z_p1 - section_.walls.below_width() - layout.flange_thickness),
        supported_projection(least_rise_to_fill(fan_.p2))};
    const std::array<Winding*, 2> windings = {&fan_.p1, &fan_.p2};
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const Polygon rim = rim_of(fan_, ends_[i].side, groove_edge);
      const double cover = entry_cover(rim, ends_[i], run_outs_[i]), wanted = std::max(0.0, k_channel_cover - cover);
      // The entry lies half-way between the two groove edges, so the mean of their bulges counts.
      Winding& winding = *windings[i];
      winding.bulge_low = std::clamp(supported_low[i], 0.0, wanted);
      winding.bulge_high =
          std::min(2.0 * wanted - winding.bulge_low, winding.bulge_low + supported_projection(section_.width()));
      const double bulge = 0.5 * (winding.bulge_low + winding.bulge_high);
      const double to_neighbour =
          axial_lead(i) - (i == 0 ? section_.walls.below_width() : section_.walls.above_width());
      run_outs_[i].channel_radii =
          channel_radii(rim, ends_[i], run_outs_[i], {k_channel_cover - bulge, section_.depth, to_neighbour});
    }
  }

  // Axial distance from groove end i to the turn beside it.
  double axial_lead(std::size_t i) const {
    const std::vector<WindingRow>& rows = i == 0 ? fan_.p1.rows : fan_.p2.rows;
    const std::size_t end = i == 0 ? rows.size() - 1 - fan_.p1.filled_back : fan_.p2.filled_front;
    const std::size_t beside = i == 0 ? end - fan_.columns() : end + fan_.columns();
    return std::abs(rows[end].height - rows[beside].height);
  }

  // Minimum height between the edges of the filled rows and of the turn below, less the height that the step between
  // both radii requires.
  double least_rise_to_fill(const Winding& winding) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < winding.filled_front && j + fan_.columns() < winding.rows.size(); ++j) {
      const WindingRow &above = winding.rows[j], &below = winding.rows[j + fan_.columns()];
      const double growth = (above.position - below.position).dot(above.normal);
      least = std::min(least, above.height - below.height - section_.width() - solid::rise_of(pulley_.layout, growth));
    }
    return least;
  }

  static void raise(Winding& winding, SpiralPlace& place, double by) {
    place.offset += by;
    for (WindingRow& row : winding.rows) row.height += by;
  }

  // Radius of the largest circle about the axis within every groove edge of P2 and the upper face's rim, which does not
  // follow the outermost turn everywhere.
  double upper_rim() const {
    double least = face_rim(transmission::Side::right);
    for (const WindingRow& row : fan_.p2.rows) least = std::min(least, row.position.norm() + section_.depth - 0.5 * d_);
    return least;
  }
  // Radius of the largest circle about the axis within the rim of an end face.
  double face_rim(transmission::Side side) const {
    return solid::inradius(rim_of(fan_, side, section_.depth - 0.5 * d_));
  }
  // Least distance of a groove's floor or a face's rim from the axis.
  double least_radius() const {
    return std::min({least_floor(), face_rim(transmission::Side::left) - pulley_.layout.elephant_foot,
                     face_rim(transmission::Side::right)});
  }

  // Distance of a pocket's edge from the axis.
  double pocket_inside(std::size_t i) const {
    return pocket_place(ends_[i], run_outs_[i]).norm() - run_outs_[i].pocket_radius;
  }
  // Largest possible radius of the bore.
  double room_for_bore() const {
    return std::min({least_radius(), pocket_inside(0), pocket_inside(1)}) - pulley_.layout.min_wall;
  }

  void choose_bore() {
    solid::BodyLayout& layout = pulley_.layout;
    const bool is_given = mechanism_.body.bore_diameter > 0 || mechanism_.body.bore == Bore::horn;
    for (const double diameter : k_bore_diameters) {
      layout.bore = solid::bore_layout(mechanism_, is_given ? std::max(mechanism_.body.bore_diameter, 0.0) : diameter);
      if (is_given || (reach() <= room_for_bore() && !solid::flat_off_shaft(mechanism_.body, layout.bore.shaft))) {
        if (!is_given && diameter < k_bore_diameters.front())
          layout.notes.push_back(
              fmt::format("no space for a bore of {} mm: made {} mm", k_bore_diameters.front(), diameter));
        return;
      }
    }
  }
  // Largest radius of the bore and a horn's holes.
  double reach() const {
    double furthest = pulley_.layout.bore.radius;
    for (const Polygon& hole : pulley_.layout.bore.screw_holes)
      furthest = std::max(furthest, fusee::circumradius(hole));
    return furthest;
  }

  void add_conditions() {
    const solid::BodyLayout& layout = pulley_.layout;
    add_neighbouring_turns(fan_.p1, transmission::Side::left);
    add_neighbouring_turns(fan_.p2, transmission::Side::right);
    add_free_end(transmission::Side::left, p1_.rows[p1_.first_used].s - p1_.rows.front().s,
                 p1_.rows[p1_.first_used].rho);
    add_free_end(transmission::Side::right, p2_.rows.back().s - p2_.rows[p2_.last_used].s, p2_.rows[p2_.last_used].rho);
    const double bore_wall = least_radius() - reach();
    add("bore_wall", bore_wall, layout.min_wall,
        fmt::format(
            "the bore leaves {} to a groove's floor or a face's rim; at least {} is required (body.min_wall_mm)",
            solid::wall_words(bore_wall), mm(layout.min_wall)));
    if (auto flat = solid::flat_off_shaft(mechanism_.body, layout.bore.shaft))
      pulley_.conditions.push_back(std::move(*flat));
    for (profile::Condition& condition : solid::hub_conditions(mechanism_, layout, upper_rim()))
      pulley_.conditions.push_back(std::move(condition));
    if (auto tall = solid::too_tall(layout)) pulley_.conditions.push_back(std::move(*tall));
    for (std::size_t i = 0; i < ends_.size(); ++i) add_knot_pocket(i);
    add("groove_depth_at_knot", section_.depth, k_least_depth_ratio * d_,
        fmt::format("a groove of {} (body.groove_depth_mm) leaves the channel to the knot open; at least two thirds of "
                    "the tendon's diameter is required: {}",
                    mm(section_.depth), mm(k_least_depth_ratio * d_)));
    if (layout.bore.horn_recess > 0)
      pulley_.conditions.push_back(
          condition_of("horn_recess", false, layout.bore.horn_recess, 0.0,
                       "a multi-turn pulley requires a flat horn or a shaft: a horn that sinks in "
                       "(horn.boss_height_mm, horn.spline_length_mm) is not supported yet"));
    if (mechanism_.print.parts == Parts::two)
      pulley_.conditions.push_back(
          condition_of("parts", false, 2, 1, "a multi-turn pulley is printed in one part (print.parts)"));
  }

  // Wall between pocket i and the bore or the hub. Towards the hub no wall is required, but the pocket must stay
  // outside.
  double wall_inside(std::size_t i) const {
    const solid::BodyLayout& layout = pulley_.layout;
    const double hub = ends_[i].side == transmission::Side::right ? layout.hub_radius : 0.0;
    return pocket_inside(i) - std::max(reach(), hub > 0 ? hub - layout.min_wall : 0.0);
  }
  // Wall between pocket i and the rim of its face.
  double wall_outside(std::size_t i) const {
    return rim_wall(rim_of(fan_, ends_[i].side, section_.depth - 0.5 * d_), ends_[i], run_outs_[i]);
  }
  bool pockets_fit() const {
    const double least = std::min({wall_inside(0), wall_inside(1), wall_outside(0), wall_outside(1)});
    return least >= pulley_.layout.min_wall - k_grain;
  }

  void add_knot_pocket(std::size_t i) {
    const solid::BodyLayout& layout = pulley_.layout;
    const auto pulley = transmission::pulley_name(ends_[i].side);
    const auto add_wall = [&](const std::string& name, double wall, const std::string& to) {
      add(fmt::format("{}_{}", name, pulley), wall, layout.min_wall - k_grain,
          fmt::format("{}'s knot pocket of {} (body.knot_pocket_mm) leaves {} to {}; at least {} is required "
                      "(body.min_wall_mm)",
                      pulley, mm(2.0 * layout.pocket_radius), solid::wall_words(wall), to, mm(layout.min_wall)));
    };
    add_wall("knot_pocket", wall_inside(i), "the bore or the hub");
    add_wall("knot_pocket_rim", wall_outside(i), "the rim");
  }

  // Condition on the pair of neighbouring turns with the least axial clearance.
  void add_neighbouring_turns(const Winding& winding, transmission::Side side) {
    double least_clearance = std::numeric_limits<double>::infinity(), lead = 0, needed = 0;
    const WindingRow* tightest = nullptr;
    for (std::size_t j = 0; j + fan_.columns() < winding.rows.size(); ++j) {
      const WindingRow *low = &winding.rows[j], *high = &winding.rows[j + fan_.columns()];
      if (low->height > high->height) std::swap(low, high);
      const double lead_here = high->height - low->height;
      const double needed_here = least_lead(section_, (high->position - low->position).dot(low->normal));
      if (lead_here - needed_here >= least_clearance) continue;
      least_clearance = lead_here - needed_here;
      lead = lead_here;
      needed = needed_here;
      tightest = low;
    }
    if (tightest == nullptr) return;
    add(fmt::format("neighbouring_turns_{}", transmission::pulley_name(side)), lead, needed - k_grain,
        fmt::format(
            "{}'s turns are {} apart at {:.0f}°, a groove, its rib and the step between them require {} (body.lead_mm)",
            transmission::pulley_name(side), mm(lead), degrees(std::remainder(tightest->turn, k_two_pi)), mm(needed)));
  }

  // The straight tendon must rise above the groove edge before the groove ends. It rises by h from a circle of radius ρ
  // over the length sqrt((ρ + h)² − ρ²) of the tangent. `available`: length of the groove beyond the working arc, mm.
  // `rho`: radius of curvature there.
  void add_free_end(transmission::Side side, double available, double rho) {
    const double rise = section_.depth, needed = std::sqrt(rise * (2.0 * rho + rise));
    add(fmt::format("free_end_{}", transmission::pulley_name(side)), available, needed,
        fmt::format(
            "{}'s groove ends {} beyond the tendon's working arc; at least {} is required for the tendon to clear the "
            "end (body.spare_turns)",
            transmission::pulley_name(side), mm(available), mm(needed)));
  }

  solid::TriangleMesh scaled(solid::TriangleMesh mesh) const {
    for (Vec3& vertex : mesh.vertices) vertex *= pulley_.layout.scale;
    return solid::rounded_to_float(std::move(mesh));
  }

  void cut(int wanted_variants) {
    const solid::BodyLayout& layout = pulley_.layout;
    const solid::TriangleMesh blank = scaled(helical_blank(fan_, section_, layout, heights_));
    const double volume = solid::enclosed_volume(blank);
    const bool has_screw = layout.set_screw.present;
    // Every passage is a handle: bore, screw holes, run-outs, and branches for the set screw and its nut.
    int screw_handles = 0;
    if (has_screw) screw_handles = layout.set_screw.nut_trap ? 2 : 1;
    const int handles = 1 + static_cast<int>(layout.bore.screw_holes.size() + ends_.size()) + screw_handles;
    pulley_.expected_euler = 2 - 2 * handles;
    const int variants = solid::cut_variants(blank.triangles.size(), wanted_variants);
    for (int variant = 0; variant < variants; ++variant) {
      std::vector<solid::TriangleMesh> tools;
      for (std::size_t i = 0; i < ends_.size(); ++i) {
        auto tool = run_out_tool(ends_[i], run_outs_[i], variant);
        if (tool) tools.push_back(std::move(*tool));
      }
      if (tools.size() < ends_.size()) continue;
      if (has_screw) tools.push_back(solid::set_screw_tool(layout.set_screw, layout.hub_radius, layout.z_hub, variant));
      if (cut_with(blank, volume, tools)) return;
    }
    if (!unprintable_.empty()) {
      pulley_.conditions.push_back(
          solid::does_not_print(mechanism_.name, unprintable_, "for any variant of its run-outs"));
      return;
    }
    pulley_.conditions.push_back(
        condition_of("features", false, 0, 1,
                     fmt::format("run-outs and screw intersect one another: none of {} cut variants leaves a valid "
                                 "solid",
                                 variants)));
  }

  bool cut_with(const solid::TriangleMesh& blank, double volume, const std::vector<solid::TriangleMesh>& tools) {
    std::vector<solid::TriangleMesh> cutters;
    for (const solid::TriangleMesh& tool : tools) {
      cutters.push_back(scaled(tool));
      // Boolean operations with a self-intersecting cutter may not terminate.
      if (solid::find_crossing(cutters.back()).facets) return false;
    }
    auto cut = solid::subtract_each(blank, cutters);
    if (!cut) return false;
    for (const double common : cut->common_volumes) volume -= common;
    std::vector<Check> checks = solid::check_mesh(cut->mesh);
    // Reject a cut that detaches a chip or opens an unplanned passage.
    if (!all_ok(checks) || solid::euler_number(cut->mesh) != pulley_.expected_euler || !prints(cut->mesh)) return false;
    pulley_.mesh = std::move(cut->mesh);
    pulley_.mesh_checks = std::move(checks);
    pulley_.expected_volume = volume;
    for (std::size_t i = 0; i < ends_.size(); ++i) pulley_.anchors.push_back(anchor_at(ends_[i], run_outs_[i]));
    pulley_.plan = std::make_shared<const HelicalPlan>(HelicalPlan{fan_, section_, heights_, ends_, run_outs_});
    pulley_.made = true;
    return true;
  }

  bool prints(const solid::TriangleMesh& mesh) {
    if (mechanism_.print.supports) return true;
    unprintable_ = solid::unprintable_places(mesh, solid::Piece::whole, pulley_.layout,
                                             mechanism_.print.overhang + k_simplification_slope, solid::Corners::round);
    return unprintable_.empty();
  }

  const Mechanism& mechanism_;
  const helix::Spiral &p1_, &p2_;
  double chord_error_mm_;
  double d_;  ///< diameter of the tendon
  HelicalSection section_;
  HelicalPulley pulley_;
  std::array<RunOutSizes, 2> run_outs_;
  Fan fan_;
  RingHeights heights_;
  std::array<GrooveEnd, 2> ends_;
  std::vector<Vec3> unprintable_;  ///< unprintable places of the last cut
};

}  // namespace

HelicalSection helical_section(const Mechanism& mechanism) {
  HelicalSection section;
  section.depth = mechanism.groove_depth();
  section.rib = k_rib;
  section.ceiling_slope =
      mechanism.print.supports ? 0.0 : mechanism.print.overhang + solid::k_slope_margin + k_simplification_slope;
  const double lean = 0.5 * mechanism.body.groove_angle;
  const auto half = [&](double angle) {
    return solid::groove_half(mechanism.body, angle, mechanism.tendon.diameter, section.depth);
  };
  section.walls = {half(lean), half(std::max(lean, section.ceiling_slope))};
  return section;
}

double least_lead(const HelicalSection& section, double growth) {
  const double step = section.ceiling_slope > 0 ? std::max(0.0, growth) * elementary::tan(section.ceiling_slope) : 0.0;
  return section.width() + std::max(section.rib, step);
}

std::string HelicalPulley::brief() const {
  if (made)
    return fmt::format("a multi-turn body, {} facets, {:.1f} cm³", mesh.triangles.size(), expected_volume / 1000.0);
  std::string text = "this multi-turn body cannot be built";
  for (const profile::Condition& condition : conditions) {
    if (!condition.ok) text += "; " + condition.message;
  }
  return text;
}

std::vector<profile::Condition> helical_obstacles(const Mechanism& mechanism, const helix::Spiral& p1,
                                                  const helix::Spiral& p2, double chord_error_mm) {
  return Planner(mechanism, p1, p2, chord_error_mm).plan();
}

HelicalPulley make_helical_pulley(const Mechanism& mechanism, const helix::Spiral& p1, const helix::Spiral& p2,
                                  double chord_error_mm, solid::TieOffSearch search) {
  return Planner(mechanism, p1, p2, chord_error_mm).make(search);
}

}  // namespace fusee::helical_solid
