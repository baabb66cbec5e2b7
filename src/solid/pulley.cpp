#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <utility>

#include "base/text.h"
#include "base/thread_pool.h"
#include "fusee/base.h"
#include "fusee/solid.h"
#include "solid/body.h"
#include "solid/boolean.h"
#include "solid/channel_entries.h"
#include "solid/cut_variants.h"
#include "solid/dowels.h"
#include "solid/euler.h"
#include "solid/face_holes.h"
#include "solid/manifold_check.h"
#include "solid/place.h"
#include "solid/plan.h"
#include "solid/plane_distance.h"
#include "solid/rings.h"
#include "solid/self_intersection.h"
#include "solid/support_attribution.h"
#include "solid/tie_off_tools.h"
#include "solid/tools.h"

namespace fusee::solid {
namespace {

// Number of facets of a large body. Parts of ordinary size and tolerance have half as many.
constexpr std::size_t k_large_body = 30'000;
// Number of times that tie-offs that do not print are planned again.
constexpr int k_rounds = 8;
constexpr int k_brief_rounds = 1;

/// Effort before a body is rejected.
struct Effort {
  int variants = k_cut_variants;
  int rounds = k_rounds;
};
constexpr Effort k_brief{k_brief_cut_variants, k_brief_rounds};

// Gap between two parts on the printer, mm.
constexpr double k_between_parts = 5.0;

// True if no facets cross after coordinates are rounded as other programs do. Formats and slicers keep fewer digits
// than floats near the axis, so faces closer than k_coarsest_grain would intersect there. Draco's finest grid is about
// a tenth of it.
bool survives_rounding(TriangleMesh mesh) {
  constexpr double k_coarsest_grain = 0x1p-15;  // mm
  for (Vec3& vertex : mesh.vertices) vertex = k_coarsest_grain * (vertex / k_coarsest_grain).array().round().matrix();
  return !find_crossing(mesh).facets;
}

// A facet this thin, a few float steps, has no normal that another program would reproduce, mm.
constexpr double k_thinnest_facet = 1e-5;

bool has_needles(const TriangleMesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&mesh](const auto& triangle) {
    const Vec3 &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]], &c = mesh.vertices[triangle[2]];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    return (b - a).cross(c - a).norm() < k_thinnest_facet * longest;
  });
}

// Soundness: robustness of a mesh against processing by other programs, in increasing order.
constexpr int k_any = 0;
constexpr int k_survives_rounding = 1;
constexpr int k_sound = 2;  // survives rounding and has no needles
int soundness_of(const TriangleMesh& mesh) {
  if (!survives_rounding(mesh)) return k_any;
  return has_needles(mesh) ? k_survives_rounding : k_sound;
}

// A body with its features, and the expected values of its measurements.
struct CutPiece {
  TriangleMesh mesh;
  double volume = 0;
  std::vector<Check> checks = {};
  int soundness = k_any;
  std::vector<Vec3> unprintable = {};  // places in the whole; empty for a piece that is not printed itself
};

// Moves a piece from its position in the whole to its print orientation: P1 is turned over about the x axis.
TriangleMesh laid_on_bed(TriangleMesh mesh, Piece piece, double mate) {
  if (piece == Piece::whole) return mesh;
  for (Vec3& vertex : mesh.vertices) {
    vertex.z() -= mate;
    if (piece == Piece::p1) vertex.tail<2>() = -vertex.tail<2>();
  }
  return rounded_to_float(std::move(mesh));
}

class FeatureCutter {
 public:
  FeatureCutter(const Mechanism& mechanism, const BodyPlan& plan, const std::vector<Mark>& marks, Corners corners,
                Piece piece)
      : mechanism_(mechanism),
        plan_(plan),
        layout_(plan.layout),
        marks_(marks),
        corners_(corners),
        piece_(piece),
        has_p1_(piece != Piece::p2),
        has_p2_(piece != Piece::p1) {}

  // Empty if the result is no valid solid. Another variant may succeed.
  std::optional<CutPiece> cut(const TriangleMesh& body, double volume, int variant) const {
    // Features that may overlap are cut one after the other: two channel entries meet outside the flanges.
    std::vector<std::vector<TriangleMesh>> passes;
    for (const PlannedAnchor& anchor : plan_.anchors) {
      if (has(anchor)) passes.push_back({tie_off_tool(plan_, anchor, variant)});
    }
    for (auto& pass : {dowels_screw_and_marks(variant), tail_slots(), clamp_pilots()}) passes.push_back(pass);
    std::vector<TriangleMesh> tools;
    for (const std::vector<TriangleMesh>& pass : passes) {
      TriangleMesh tool = placed(pass);
      if (tool.triangles.empty()) continue;
      // Boolean operations with a self-intersecting tool may not terminate.
      if (find_crossing(tool).facets) return std::nullopt;
      tools.push_back(std::move(tool));
    }
    auto cut = subtract_each(body, tools);
    if (!cut) return std::nullopt;
    CutPiece result{std::move(cut->mesh), volume};
    for (const double common : cut->common_volumes) result.volume -= common;
    if (const TriangleMesh raised = placed(raised_marks()); !raised.triangles.empty()) {
      const double added = enclosed_volume(raised);
      const auto outcome = unite(result.mesh, raised);
      if (!outcome) return std::nullopt;
      result.mesh = outcome->mesh;
      result.volume = result.volume + added - outcome->common_volume;
    }
    result.mesh = laid_on_bed(std::move(result.mesh), piece_, layout_.scale * layout_.z_mate);
    auto soundness = run_async([&result] { return soundness_of(result.mesh); }, piece_ == Piece::whole);
    // On a large part the search for unprintable places takes long, and is wasted if the mesh has a fault. There it
    // runs when get() is called, after the checks.
    const bool is_worth_a_thread = is_printed() && result.mesh.triangles.size() < k_large_body;
    auto unprintable = run_async([&] { return unprintable_places_of(result.mesh); }, is_worth_a_thread);
    result.checks = check_mesh(result.mesh);
    if (!all_ok(result.checks)) return std::nullopt;
    if (piece_ == Piece::whole) result.soundness = soundness.get();
    result.unprintable = unprintable.get();
    return result;
  }

 private:
  // True for a piece that is printed without supports.
  bool is_printed() const {
    return !mechanism_.print.supports && (piece_ == Piece::whole) == (layout_.parts == Parts::one);
  }
  std::vector<Vec3> unprintable_places_of(const TriangleMesh& mesh) const {
    if (!is_printed()) return {};
    return unprintable_places(mesh, piece_, layout_, mechanism_.print.overhang, corners_);
  }

  // Converts from the layout's mm to the mesh's floats.
  TriangleMesh placed(const std::vector<TriangleMesh>& tools) const {
    TriangleMesh all = together(tools);
    for (Vec3& vertex : all.vertices) vertex *= layout_.scale;
    return rounded_to_float(std::move(all));
  }

  // Tools for features that overlap none of the others.
  std::vector<TriangleMesh> dowels_screw_and_marks(int variant) const {
    std::vector<TriangleMesh> tools;
    for (const Vec2& place : layout_.dowels.places) tools.push_back(dowel_tool(layout_.dowels, place));
    if (has_p2_ && layout_.set_screw.present)
      tools.push_back(set_screw_tool(layout_.set_screw, layout_.hub_radius, layout_.z_hub, variant));
    const double depth = layout_.mark_depth;
    for (const Mark& mark : marks_) {
      if (has_p1_ && !mark.on_top) tools.push_back(prism(mark.loops, -k_overshoot, depth));
      if (has_p2_ && mark.on_top && mechanism_.body.marks == Marks::engraved)
        tools.push_back(prism(mark.loops, layout_.z_top - depth, layout_.z_top + k_overshoot));
    }
    return tools;
  }

  bool has(const PlannedAnchor& anchor) const { return anchor.side == transmission::Side::left ? has_p1_ : has_p2_; }

  std::vector<TriangleMesh> tail_slots() const {
    std::vector<TriangleMesh> tools;
    for (const PlannedAnchor& anchor : plan_.anchors) {
      if (anchor.tail && has(anchor)) tools.push_back(tail_slot_tool(layout_, anchor.side, *anchor.tail));
    }
    return tools;
  }

  std::vector<TriangleMesh> clamp_pilots() const {
    std::vector<TriangleMesh> tools;
    for (const PlannedAnchor& anchor : plan_.anchors) {
      if (anchor.tail && anchor.tail->pilot_diameter > 0 && has(anchor))
        tools.push_back(clamp_pilot_tool(layout_, anchor.side, *anchor.tail));
    }
    return tools;
  }

  std::vector<TriangleMesh> raised_marks() const {
    std::vector<TriangleMesh> raised;
    if (mechanism_.body.marks != Marks::raised || !has_p2_) return raised;
    for (const Mark& mark : marks_) {
      if (mark.on_top)
        raised.push_back(prism(mark.loops, layout_.z_top - 0.5 * layout_.flange_thickness,
                               layout_.z_top + mechanism_.body.mark_depth));
    }
    return raised;
  }

  const Mechanism& mechanism_;
  const BodyPlan& plan_;
  const BodyLayout& layout_;
  const std::vector<Mark>& marks_;
  Corners corners_;
  Piece piece_;
  bool has_p1_, has_p2_;
};

// Number of handles of a piece's surface, which has the Euler number 2 − 2 · handles. Every passage is a handle:
//   - each hole of the bore
//   - a tunnel for each channel
//   - for the set screw, a branch from the bore to the hub's side; with a nut trap another to the hub's top
//   - in P1, the holes for pins, which end in P2
int handles(const RingStack& stack, const BodyPlan& plan, Piece piece) {
  const SetScrewLayout& screw = plan.layout.set_screw;
  std::size_t count = stack.through.size() + (recess_goes_through(stack) ? 1 : 0);
  for (const PlannedAnchor& anchor : plan.anchors) {
    const bool has = piece == Piece::whole || (anchor.side == transmission::Side::left) == (piece == Piece::p1);
    if (has && std::holds_alternative<AnchorPath>(anchor.tie_off)) ++count;
  }
  if (piece == Piece::p1) count += plan.layout.dowels.places.size();
  if (piece != Piece::p1 && screw.present) count += screw.nut_trap ? 2 : 1;
  return static_cast<int>(count);
}

// True if every vertex is used and no two coincide. Spare vertices would hide a passage, and a reader would weld a body
// at a place where it touches itself.
bool is_welded(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) used[vertex] = true;
  }
  if (std::find(used.begin(), used.end(), false) != used.end()) return false;
  std::vector<Vec3> places = mesh.vertices;
  std::sort(places.begin(), places.end(), [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  return std::adjacent_find(places.begin(), places.end()) == places.end();
}

// Tests the Euler number. That of a welded closed mesh follows from its counts alone, which is faster.
bool has_euler(const TriangleMesh& mesh, int expected) {
  // V − E + F with E = 3 F / 2
  const auto of_counts =
      static_cast<std::ptrdiff_t>(mesh.vertices.size()) - static_cast<std::ptrdiff_t>(mesh.triangles.size() / 2);
  return (of_counts == expected && is_welded(mesh)) || euler_number(mesh) == expected;
}

// A piece whose Euler number is the expected one.
struct BuiltPiece {
  TriangleMesh mesh;
  double volume = 0;
  int euler = 0;
  std::vector<Check> checks = {};
  int soundness = k_any;  // measured for the whole only
  std::vector<Vec3> unprintable = {};
};

// A variant shifts the channels slightly. True if they still keep their walls to the axial holes.
bool keeps_walls(const BodyPlan& plan, int variant) {
  const BodyLayout& layout = plan.layout;
  std::vector<Bar> holes{{Vec2::Zero(), Vec2::Zero(), layout.bore.radius}};
  for (const Polygon& hole : layout.bore.screw_holes) {
    const RoundHole circle = circle_within(hole);
    holes.push_back({circle.centre, circle.centre, (hole.front() - circle.centre).norm()});
  }
  return std::all_of(plan.anchors.begin(), plan.anchors.end(), [&](const PlannedAnchor& anchor) {
    const auto* channel = std::get_if<AnchorPath>(&anchor.tie_off);
    if (channel == nullptr) return true;
    const AnchorPath path = varied(*channel, variant);
    std::vector<Bar> bars = path.bars(layout.channel_width);
    bars.push_back({path.pocket(), path.pocket(), layout.pocket_radius});
    for (const Bar& side : path.tab_sides(layout.channel_width, layout.pocket_radius)) bars.push_back(side);
    return std::all_of(bars.begin(), bars.end(), [&](const Bar& bar) {
      return std::all_of(holes.begin(), holes.end(),
                         [&](const Bar& hole) { return gap(bar, hole) >= layout.min_wall; });
    });
  });
}

// The pieces of a pulley before any cut, the whole first.
class PieceMaker {
 public:
  PieceMaker(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const BodyPlan& plan,
             std::vector<Mark> marks, Corners corners)
      : mechanism_(mechanism), plan_(plan), marks_(std::move(marks)), corners_(corners) {
    std::vector<Piece> pieces{Piece::whole};
    if (plan.layout.parts == Parts::two) pieces = {Piece::whole, Piece::p1, Piece::p2};
    for (const Piece piece : pieces) {
      const RingStack stack = scaled_to_float(body_stack(synthesis.p1, synthesis.p2, mechanism_.tendon.diameter,
                                                         mechanism_.body.flange, plan_.layout, piece),
                                              plan_.layout.scale);
      blanks_.push_back({piece, mesh_of(stack), volume_of(stack), 2 - 2 * handles(stack, plan_, piece)});
    }
  }

  void demand_solids() const {
    for (const Blank& blank : blanks_) demand_solid(blank.mesh, "body");
  }

  // Number of cut variants that take a bounded time, at most `wanted`.
  int variant_count(int wanted) const {
    std::size_t facets = 0;
    for (const Blank& blank : blanks_) facets += blank.mesh.triangles.size();
    return cut_variants(facets, wanted);
  }

  // Cuts all pieces with the same features, so that the parts form the whole. Empty if one of them is no valid solid or
  // has an unplanned passage, such as a mark that opens a channel.
  std::vector<BuiltPiece> cut(int variant, bool marked) const {
    std::vector<BuiltPiece> made;
    if (variant > 0 && !keeps_walls(plan_, variant)) return made;
    for (const Blank& blank : blanks_) {
      auto featured = FeatureCutter(mechanism_, plan_, marked ? marks_ : k_no_marks, corners_, blank.piece)
                          .cut(blank.mesh, blank.volume, variant);
      if (!featured || !has_euler(featured->mesh, blank.euler)) return {};
      made.push_back({std::move(featured->mesh), featured->volume, blank.euler, std::move(featured->checks),
                      featured->soundness, std::move(featured->unprintable)});
    }
    return made;
  }

 private:
  struct Blank {
    Piece piece;
    TriangleMesh mesh;
    double volume;
    int euler;
  };

  inline static const std::vector<Mark> k_no_marks;

  const Mechanism& mechanism_;
  const BodyPlan& plan_;
  std::vector<Mark> marks_;
  Corners corners_;
  std::vector<Blank> blanks_;
};

// The condition that fails if no variant leaves a valid solid. Features that keep their walls in plan may still
// intersect in space.
profile::Condition uncut_features(int variants) {
  profile::Condition condition;
  condition.name = "features";
  condition.ok = false;
  condition.value = 0;
  condition.limit = 1;
  condition.unit = "1";
  condition.message = fmt::format(
      "tie-offs, screws and marks intersect one another: none of {} cut variants leaves a valid solid", variants);
  return condition;
}

Anchor anchor_of(const PlannedAnchor& planned, const BodyPlan& plan, int variant) {
  const BodyLayout& layout = plan.layout;
  Anchor anchor{planned.side, planned.wound_end, planned.start(), {}, {}, planned.pocket(), {}, {}, planned.tail};
  if (const auto* channel = std::get_if<AnchorPath>(&planned.tie_off)) {
    const AnchorPath path = varied(*channel, variant);
    anchor.channel =
        outline_of(keyhole(path, layout.channel_width, layout.pocket_radius, pocket_facets(layout.pocket_radius)));
    const ChannelEdges edges = channel_edges(plan, planned.side, path);
    anchor.entry = edges.outer;
    anchor.entry.insert(anchor.entry.end(), edges.inner.rbegin(), edges.inner.rend());
    anchor.bend = ChannelBend{path.start - path.fillet * path.normal, path.fillet, path.heading(), path.straight,
                              channel_half_height(layout, variant)};
  } else {
    const auto& hole = std::get<FaceHole>(planned.tie_off);
    anchor.channel = hole_outline(hole, variant);
    anchor.seat = FaceSeat{hole.room, countersink_depth(layout, hole),
                           planned.side == transmission::Side::left ? 0.0 : layout.z_top, hole.hole, hole.length};
  }
  return anchor;
}

// The failed condition, if an entry reaches into the active arc. That may happen if the closing arc is hardly longer
// than the entry.
std::optional<profile::Condition> entry_in_active_arc(const Anchor& anchor, const std::vector<Vec2>& active_floor) {
  for (const Vec2& point : active_floor) {
    if (!is_inside(anchor.entry, point) && !is_inside(anchor.channel, point)) continue;
    profile::Condition condition;
    condition.name = "tie_off_mouth";
    condition.ok = false;
    condition.limit = 0;
    condition.unit = "mm";
    condition.message =
        fmt::format("{}'s tie-off has no space behind the active arc: its channel entry would cut into that arc at {}",
                    anchor.side == transmission::Side::left ? "P1" : "P2", place_of(Vec3(point.x(), point.y(), 0)));
    return condition;
  }
  return std::nullopt;
}

// The anchors as one variant cuts them.
struct VariedAnchors {
  std::vector<Anchor> anchors;
  std::optional<profile::Condition> failed;  // condition that the variant fails
};

class AnchorVariants {
 public:
  AnchorVariants(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const BodyPlan& plan)
      : plan_(plan) {
    for (const profile::Outline* outline : {&synthesis.p1, &synthesis.p2}) {
      const Polygon floor = profile::parallel(*outline, -0.5 * mechanism.tendon.diameter);
      std::vector<Vec2>& active = outline->side == transmission::Side::left ? floor1_ : floor2_;
      for (std::size_t i = 0; i < floor.size(); ++i) {
        if (outline->is_active(i)) active.push_back(floor[i]);
      }
    }
  }

  VariedAnchors at(int variant) const {
    VariedAnchors varied;
    for (const PlannedAnchor& planned : plan_.anchors) {
      varied.anchors.push_back(anchor_of(planned, plan_, variant));
      varied.failed =
          entry_in_active_arc(varied.anchors.back(), planned.side == transmission::Side::left ? floor1_ : floor2_);
      if (varied.failed) break;
    }
    return varied;
  }
  bool is_possible(int variant) const { return !at(variant).failed; }

 private:
  const BodyPlan& plan_;
  std::vector<Vec2> floor1_, floor2_;  // the parts that the tendons wind on
};

struct BestCut {
  std::vector<BuiltPiece> pieces;  // empty if no variant leaves a valid solid
  int variant = 0;
};

// Tries variants from `first` on. Returns the first cut of at least `enough` soundness, or else the soundest one.
BestCut best_cut(const PieceMaker& maker, bool marked, const AnchorVariants& anchors, int first, int variants,
                 int enough) {
  BestCut taken;
  int best = k_any;
  for (int variant = first; variant < variants; ++variant) {
    if (variant > first && !anchors.is_possible(variant)) continue;
    std::vector<BuiltPiece> made = maker.cut(variant, marked);
    if (made.empty()) continue;
    if (enough == k_any) {
      taken = {std::move(made), variant};
      break;
    }
    const int soundness = made.front().soundness;
    if (!taken.pieces.empty() && soundness <= best) continue;
    taken = {std::move(made), variant};
    best = soundness;
    if (best >= enough) break;
  }
  return taken;
}

struct RatedPulley {
  Pulley pulley;
  int soundness = k_any;
  std::vector<Vec3> unprintable = {};  // places where a layer projects too far or begins in mid-air
};

// Cuts the pulley of a plan, with at least `enough` soundness if a variant has it. The result may be unprintable.
RatedPulley pulley_of(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, BodyPlan plan,
                      Corners corners, const Effort& effort, int enough) {
  RatedPulley rated;
  Pulley& pulley = rated.pulley;
  pulley.conditions = plan.conditions;
  pulley.layout = plan.layout;
  if (!plan.is_possible()) return rated;
  const AnchorVariants anchors(mechanism, synthesis, plan);
  int first = 0;
  while (first < effort.variants && !anchors.is_possible(first)) ++first;
  if (first == effort.variants) {
    pulley.conditions.push_back(*anchors.at(0).failed);
    return rated;
  }
  const std::vector<Mark>& marks = plan.marks;
  const PieceMaker maker(mechanism, synthesis, plan, marks, corners);
  // A blank that is no valid solid is a bug, not a rejection.
  auto solids_demanded = run_async([&maker] { maker.demand_solids(); });
  const int variants = std::min(effort.variants, first + maker.variant_count(effort.variants));
  bool is_marked = true;
  BestCut cut = best_cut(maker, true, anchors, first, variants, enough);
  if (cut.pieces.empty() && !marks.empty()) {
    cut = best_cut(maker, false, anchors, first, variants, enough);
    is_marked = cut.pieces.empty();
    if (!is_marked) plan.layout.omit("marks", "the marks would cut into a tie-off: omitted");
  }
  solids_demanded.get();
  auto& [pieces, taken] = cut;
  pulley.layout = plan.layout;
  if (pieces.empty()) {
    pulley.conditions.push_back(uncut_features(variants - first));
    return rated;
  }
  rated.soundness = pieces.front().soundness;
  for (const BuiltPiece& piece : pieces)
    rated.unprintable.insert(rated.unprintable.end(), piece.unprintable.begin(), piece.unprintable.end());
  pulley.anchors = anchors.at(taken).anchors;
  if (is_marked) pulley.marks = marks;
  pulley.mesh = std::move(pieces.front().mesh);
  pulley.expected_volume = pieces.front().volume;
  pulley.expected_euler = pieces.front().euler;
  pulley.mesh_checks = std::move(pieces.front().checks);
  for (std::size_t k = 1; k < pieces.size(); ++k)
    pulley.parts.push_back({k == 1 ? transmission::Side::left : transmission::Side::right, std::move(pieces[k].mesh),
                            pieces[k].volume, pieces[k].euler, std::move(pieces[k].checks)});
  pulley.status = PulleyStatus::made;
  return rated;
}

std::vector<Rejection> new_rejections(std::vector<Rejection> rejections, const std::vector<Rejection>& known) {
  std::erase_if(rejections, [&known](const Rejection& rejection) {
    return std::find(known.begin(), known.end(), rejection) != known.end();
  });
  return rejections;
}

// The pulley with the condition that it cannot be printed without supports.
Pulley refused(Pulley pulley, const Mechanism& mechanism, const std::vector<Vec3>& places) {
  pulley.conditions.push_back(does_not_print(mechanism.name, places, "for any position of its tie-offs"));
  pulley.status = PulleyStatus::impossible;
  return pulley;
}

bool fails_printing(const Pulley& pulley) {
  return std::any_of(pulley.conditions.begin(), pulley.conditions.end(),
                     [](const profile::Condition& condition) { return condition.name == k_prints && !condition.ok; });
}

// Plans tie-offs again as long as one of them has a layer that projects too far.
Pulley search_printable_tie_offs(const Mechanism& mechanism, const profile::SynthesisResult& synthesis,
                                 double entry_lean, Corners corners, const Effort& effort) {
  TieOffWishes wishes;
  wishes.entry_lean = entry_lean;
  std::optional<Pulley> printable;  // printable, but with a mesh that is not fully sound
  for (int round = 0;; ++round) {
    const BodyPlan plan = plan_body(mechanism, synthesis, wishes);
    if (mechanism.print.supports) return pulley_of(mechanism, synthesis, plan, corners, effort, k_sound).pulley;
    // Any cut shows whether the plan prints. The soundest one is searched for only then.
    RatedPulley rated = pulley_of(mechanism, synthesis, plan, corners, effort, k_any);
    if (rated.pulley.made() && rated.unprintable.empty()) {
      if (rated.soundness == k_sound) return std::move(rated.pulley);
      printable = std::move(rated.pulley);
      rated = pulley_of(mechanism, synthesis, plan, corners, effort, k_sound);
    }
    Pulley& pulley = rated.pulley;
    if (pulley.made() && rated.unprintable.empty()) return std::move(pulley);
    if (!pulley.made()) return printable ? std::move(*printable) : std::move(pulley);
    const std::vector<Rejection> rejections =
        new_rejections(attribute_supports(rated.unprintable, plan), wishes.rejected);
    if (rejections.empty() || round == effort.rounds)
      return printable ? std::move(*printable) : refused(std::move(pulley), mechanism, rated.unprintable);
    wishes.rejected.insert(wishes.rejected.end(), rejections.begin(), rejections.end());
  }
}

}  // namespace

Polygon TailSlot::outline() const {
  const Vec2 across = 0.5 * width * turned_left((to - from).normalized());
  return {from - across, to - across, to + across, from + across};
}

double pocket_radius(const Anchor& anchor, const BodyLayout& layout) {
  return anchor.seat ? anchor.seat->radius : layout.pocket_radius;
}

bool Pulley::has_home_mark() const {
  return std::any_of(marks.begin(), marks.end(), [](const Mark& mark) { return mark.shows_home && mark.on_top; });
}

std::string Pulley::brief() const {
  if (made()) {
    return fmt::format("a body of {} facets, {:.1f} cm³, {} tie-offs", mesh.triangles.size(), expected_volume / 1000.0,
                       anchors.size());
  }
  std::string text = "this body cannot be built";
  for (const profile::Condition& condition : conditions) {
    if (!condition.ok) text += "; " + condition.message;
  }
  return text;
}

// If no steep entry fits, a wide one whose tip a squared corner supports is used.
Pulley make_pulley(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, TieOffSearch search) {
  demand(synthesis.made(), "a body of an infeasible profile");
  const bool is_brief = search == TieOffSearch::brief;
  Pulley pulley =
      search_printable_tie_offs(mechanism, synthesis, k_steep_lean, Corners::round, is_brief ? k_brief : Effort{});
  if (is_brief || !fails_printing(pulley)) return pulley;
  return search_printable_tie_offs(mechanism, synthesis, k_wide_lean, Corners::squared, Effort{});
}

double diameter_about_axis(const TriangleMesh& mesh) {
  double reach = 0;
  for (const Vec3& vertex : mesh.vertices) reach = std::max(reach, vertex.head<2>().norm());
  return 2.0 * reach;
}

OuterSize outer_size(const Pulley& pulley) {
  if (pulley.mesh.vertices.empty()) return {};
  const Bounds box = bounds(pulley.mesh);
  return {diameter_about_axis(pulley.mesh) / pulley.layout.scale, (box.high.z() - box.low.z()) / pulley.layout.scale};
}

TriangleMesh plate_of(const Pulley& pulley) {
  if (pulley.parts.empty()) return pulley.mesh;
  TriangleMesh plate = pulley.parts[0].mesh, other = pulley.parts[1].mesh;
  const double shift = bounds(plate).high.x() + k_between_parts - bounds(other).low.x();
  for (Vec3& vertex : other.vertices) vertex.x() += shift;
  return together({plate, rounded_to_float(std::move(other))});
}

}  // namespace fusee::solid
