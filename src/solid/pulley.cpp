#include "fusee/solid/pulley.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <utility>

#include "base/run_async.h"
#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"
#include "solid/blame.h"
#include "solid/body.h"
#include "solid/boolean.h"
#include "solid/cut_ways.h"
#include "solid/dowels.h"
#include "solid/euler.h"
#include "solid/face_holes.h"
#include "solid/gate.h"
#include "solid/marks.h"
#include "solid/mouths.h"
#include "solid/place.h"
#include "solid/plan.h"
#include "solid/plane_distance.h"
#include "solid/rings.h"
#include "solid/self_intersection.h"
#include "solid/tie_off_tools.h"
#include "solid/tools.h"

namespace fusee {
namespace {

// Facets; parts of ordinary size and tolerance have half as many.
constexpr std::size_t k_large_body = 30'000;
// How often tie-offs that do not print are planned anew.
constexpr int k_rounds = 8;
constexpr int k_brief_rounds = 1;

/// How much is tried before a body is given up.
struct Effort {
  int variants = k_cut_ways;
  int rounds = k_rounds;
};
constexpr Effort k_brief{k_brief_cut_ways, k_brief_rounds};

// Room between two parts on the printer.
constexpr double k_between_parts = 5.0;

// Formats and slicers keep fewer digits than a float near the axis has: faces that lie closer than this would cross
// there. Draco's finest grid is about a tenth of it.
bool stands_rounding(TriangleMesh mesh) {
  constexpr double k_coarsest_grain = 0x1p-15;  // mm
  for (Vec3& vertex : mesh.vertices) vertex = k_coarsest_grain * (vertex / k_coarsest_grain).array().round().matrix();
  return !find_crossing(mesh).facets;
}

// A facet this thin, a few grains of a float, has no normal that another program would find again, mm.
constexpr double k_thinnest_facet = 1e-5;

bool has_needles(const TriangleMesh& mesh) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&mesh](const auto& triangle) {
    const Vec3 &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]], &c = mesh.vertices[triangle[2]];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    return (b - a).cross(c - a).norm() < k_thinnest_facet * longest;
  });
}

// How well a mesh bears what other programs do to it: the larger, the better.
constexpr int k_any = 0;
constexpr int k_sound = 2;
int soundness_of(const TriangleMesh& mesh) { return !stands_rounding(mesh) ? 0 : has_needles(mesh) ? 1 : k_sound; }

// A body with its features, and what it must measure.
struct Featured {
  TriangleMesh mesh;
  double volume = 0;
  std::vector<Check> checks = {};
  int soundness = k_any;
  std::vector<Vec3> unprintable = {};  // places of the whole; of a piece that is printed as it is
};

// From where a piece stands in the whole to where it lies on the printer: P1 is turned over about the x axis.
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

  // Null when the result is no solid: the next variant may do better.
  std::optional<Featured> cut(const TriangleMesh& body, double volume, int variant) const {
    // What may overlap is cut one after the other: two mouths meet outside of the flanges.
    std::vector<std::vector<TriangleMesh>> passes;
    for (const PlannedAnchor& anchor : plan_.anchors) {
      if (has(anchor)) passes.push_back({tie_off_tool(plan_, anchor, variant)});
    }
    for (auto& pass : {cuts(variant), tail_slots(), clamp_pilots()}) passes.push_back(pass);
    std::vector<TriangleMesh> tools;
    for (const std::vector<TriangleMesh>& pass : passes) {
      TriangleMesh tool = placed(pass);
      if (tool.triangles.empty()) continue;
      // What crosses itself cannot be cut with: it may never end.
      if (find_crossing(tool).facets) return std::nullopt;
      tools.push_back(std::move(tool));
    }
    auto cut = subtract_each(body, tools);
    if (!cut) return std::nullopt;
    Featured result{std::move(cut->mesh), volume};
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
    // Of a large part it takes long, and is for nothing where its mesh has a fault: then it waits for the checks.
    const bool is_worth_a_thread = is_printed() && result.mesh.triangles.size() < k_large_body;
    auto unprintable = run_async([&] { return unprintable_places_of(result.mesh); }, is_worth_a_thread);
    result.checks = check_mesh(result.mesh);
    if (!all_ok(result.checks)) return std::nullopt;
    if (piece_ == Piece::whole) result.soundness = soundness.get();
    result.unprintable = unprintable.get();
    return result;
  }

 private:
  // Without supports.
  bool is_printed() const {
    return !mechanism_.print.supports && (piece_ == Piece::whole) == (layout_.parts == Parts::one);
  }
  std::vector<Vec3> unprintable_places_of(const TriangleMesh& mesh) const {
    if (!is_printed()) return {};
    return unprintable_places(mesh, piece_, layout_, mechanism_.print.overhang, corners_);
  }

  // From the layout's mm to the mesh's floats.
  TriangleMesh placed(const std::vector<TriangleMesh>& tools) const {
    TriangleMesh all = together(tools);
    for (Vec3& vertex : all.vertices) vertex *= layout_.scale;
    return rounded_to_float(std::move(all));
  }

  std::vector<TriangleMesh> cuts(int variant) const {
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

  bool has(const PlannedAnchor& anchor) const { return anchor.side == Side::left ? has_p1_ : has_p2_; }

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

// Every way through the body is a handle. The bore's holes, a tunnel for each channel, for the set screw a branch from
// the bore to the hub's side and, with a nut trap, another to its top; and P1's pins, which end in P2.
int handles(const RingStack& stack, const BodyPlan& plan, Piece piece) {
  const SetScrewLayout& screw = plan.layout.set_screw;
  std::size_t count = stack.through.size() + (recess_goes_through(stack) ? 1 : 0);
  for (const PlannedAnchor& anchor : plan.anchors) {
    const bool has = piece == Piece::whole || (anchor.side == Side::left) == (piece == Piece::p1);
    if (has && std::holds_alternative<AnchorPath>(anchor.way)) ++count;
  }
  if (piece == Piece::p1) count += plan.layout.dowels.places.size();
  if (piece != Piece::p1 && screw.present) count += screw.nut_trap ? 2 : 1;
  return static_cast<int>(count);
}

// Whether every vertex is in use, and none where another is: spare ones hide a way through, and where a body touches
// itself whoever reads it welds one.
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

// A closed mesh that is welded is counted at a glance.
bool has_euler(const TriangleMesh& mesh, int expected) {
  const auto at_a_glance =
      static_cast<std::ptrdiff_t>(mesh.vertices.size()) - static_cast<std::ptrdiff_t>(mesh.triangles.size() / 2);
  return (at_a_glance == expected && is_welded(mesh)) || euler_number(mesh) == expected;
}

struct Made {
  TriangleMesh mesh;
  double volume = 0;
  int euler = 0;
  std::vector<Check> checks = {};
  int soundness = k_any;  // of the whole
  std::vector<Vec3> unprintable = {};
};

// A variant moves channels a little, within the walls to what is cut along the axis.
bool keeps_walls(const BodyPlan& plan, int variant) {
  const BodyLayout& layout = plan.layout;
  std::vector<Bar> holes{{Vec2::Zero(), Vec2::Zero(), layout.bore.radius}};
  for (const Polygon& hole : layout.bore.screw_holes) {
    const RoundHole circle = circle_within(hole);
    holes.push_back({circle.centre, circle.centre, (hole.front() - circle.centre).norm()});
  }
  return std::all_of(plan.anchors.begin(), plan.anchors.end(), [&](const PlannedAnchor& anchor) {
    const auto* channel = std::get_if<AnchorPath>(&anchor.way);
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

// The pieces of a pulley before anything is cut out of them, the whole first.
class PieceMaker {
 public:
  PieceMaker(const Mechanism& mechanism, const SynthesisResult& synthesis, const BodyPlan& plan,
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

  // In how many ways it may be cut, of as many as are wanted.
  int ways(int wanted) const {
    std::size_t facets = 0;
    for (const Blank& blank : blanks_) facets += blank.mesh.triangles.size();
    return cut_ways(facets, wanted);
  }

  // All with the same features, so that the parts make the whole; none when one of them is no solid, or has a way
  // through that nobody planned: a mark that opens a channel.
  std::vector<Made> cut(int variant, bool marked) const {
    std::vector<Made> made;
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

// No variant left a solid: walls between features, each wide enough seen along the axis, meet in space.
Condition uncut_features(int ways) {
  Condition condition;
  condition.name = "features";
  condition.ok = false;
  condition.value = 0;
  condition.limit = 1;
  condition.unit = "1";
  condition.message =
      fmt::format("tie-offs, screws and marks run into one another: none of {} ways to cut them leaves a solid", ways);
  return condition;
}

Anchor anchor_of(const PlannedAnchor& planned, const BodyPlan& plan, int variant) {
  const BodyLayout& layout = plan.layout;
  Anchor anchor{planned.side, planned.wound_end, planned.start(), {}, {}, planned.pocket(), {}, {}, planned.tail};
  if (const auto* channel = std::get_if<AnchorPath>(&planned.way)) {
    const AnchorPath path = varied(*channel, variant);
    anchor.channel =
        outline_of(keyhole(path, layout.channel_width, layout.pocket_radius, pocket_facets(layout.pocket_radius)));
    const ChannelEdges edges = channel_edges(plan, planned.side, path);
    anchor.mouth = edges.outer;
    anchor.mouth.insert(anchor.mouth.end(), edges.inner.rbegin(), edges.inner.rend());
    anchor.bend = ChannelBend{path.start - path.fillet * path.normal, path.fillet, path.heading(), path.straight,
                              channel_half_height(layout, variant)};
  } else {
    const auto& hole = std::get<FaceHole>(planned.way);
    anchor.channel = hole_outline(hole, variant);
    anchor.seat = FaceSeat{hole.room, countersink_depth(layout, hole), planned.side == Side::left ? 0.0 : layout.z_top,
                           hole.hole, hole.length};
  }
  return anchor;
}

// Where a closing arc is hardly longer than a mouth, the mouth may reach into the arc that the tendon winds on.
std::optional<Condition> mouth_in_active_arc(const Anchor& anchor, const std::vector<Vec2>& active_floor) {
  for (const Vec2& point : active_floor) {
    if (!is_inside(anchor.mouth, point) && !is_inside(anchor.channel, point)) continue;
    Condition condition;
    condition.name = "tie_off_mouth";
    condition.ok = false;
    condition.limit = 0;
    condition.unit = "mm";
    condition.message = fmt::format(
        "{}'s tie-off has no room behind the arc that the tendon winds on: its mouth would cut into that arc at {}",
        anchor.side == Side::left ? "P1" : "P2", place_of(Vec3(point.x(), point.y(), 0)));
    return condition;
  }
  return std::nullopt;
}

// As a variant cuts them.
struct VariedAnchors {
  std::vector<Anchor> anchors;
  std::optional<Condition> cut_into;  // what is wrong with it
};

class AnchorVariants {
 public:
  AnchorVariants(const Mechanism& mechanism, const SynthesisResult& synthesis, const BodyPlan& plan) : plan_(plan) {
    for (const Outline* outline : {&synthesis.p1, &synthesis.p2}) {
      const Polygon floor = parallel(*outline, -0.5 * mechanism.tendon.diameter);
      std::vector<Vec2>& active = outline->side == Side::left ? floor1_ : floor2_;
      for (std::size_t i = 0; i < floor.size(); ++i) {
        if (outline->is_active(i)) active.push_back(floor[i]);
      }
    }
  }

  VariedAnchors at(int variant) const {
    VariedAnchors varied;
    for (const PlannedAnchor& planned : plan_.anchors) {
      varied.anchors.push_back(anchor_of(planned, plan_, variant));
      varied.cut_into = mouth_in_active_arc(varied.anchors.back(), planned.side == Side::left ? floor1_ : floor2_);
      if (varied.cut_into) break;
    }
    return varied;
  }
  bool may_be(int variant) const { return !at(variant).cut_into; }

 private:
  const BodyPlan& plan_;
  std::vector<Vec2> floor1_, floor2_;  // that the tendons wind on
};

struct BestCut {
  std::vector<Made> pieces;  // none where no variant leaves a solid
  int variant = 0;
};

// From a variant that may be on: the first that bears so much, or what bears most.
BestCut best_cut(const PieceMaker& maker, bool marked, const AnchorVariants& anchors, int first, int variants,
                 int enough) {
  BestCut taken;
  int best = k_any;
  for (int variant = first; variant < variants; ++variant) {
    if (variant > first && !anchors.may_be(variant)) continue;
    std::vector<Made> made = maker.cut(variant, marked);
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
  std::vector<Vec3> unprintable = {};  // where a layer stands out too far, or begins in mid-air
};

// Whether it prints is another question.
RatedPulley pulley_of(const Mechanism& mechanism, const SynthesisResult& synthesis, BodyPlan plan, Corners corners,
                      const Effort& effort, int enough) {
  RatedPulley rated;
  Pulley& pulley = rated.pulley;
  pulley.conditions = plan.conditions;
  pulley.layout = plan.layout;
  if (!plan.possible()) return rated;
  const AnchorVariants anchors(mechanism, synthesis, plan);
  int first = 0;
  while (first < effort.variants && !anchors.may_be(first)) ++first;
  if (first == effort.variants) {
    pulley.conditions.push_back(*anchors.at(0).cut_into);
    return rated;
  }
  const std::vector<Mark> marks = marks_of(mechanism.body.marks, plan);
  const PieceMaker maker(mechanism, synthesis, plan, marks, corners);
  // What is no solid has no cut, but is a bug and not a refusal.
  auto gate = run_async([&maker] { maker.demand_solids(); });
  const int variants = std::min(effort.variants, first + maker.ways(effort.variants));
  bool is_marked = true;
  BestCut cut = best_cut(maker, true, anchors, first, variants, enough);
  if (cut.pieces.empty() && !marks.empty()) {
    cut = best_cut(maker, false, anchors, first, variants, enough);
    is_marked = cut.pieces.empty();
    if (!is_marked) plan.layout.notes.push_back("the marks would run into a tie-off: left out");
  }
  gate.get();
  auto& [pieces, taken] = cut;
  pulley.layout = plan.layout;
  if (pieces.empty()) {
    pulley.conditions.push_back(uncut_features(variants - first));
    return rated;
  }
  rated.soundness = pieces.front().soundness;
  for (const Made& piece : pieces)
    rated.unprintable.insert(rated.unprintable.end(), piece.unprintable.begin(), piece.unprintable.end());
  pulley.anchors = anchors.at(taken).anchors;
  if (is_marked) pulley.marks = marks;
  pulley.mesh = std::move(pieces.front().mesh);
  pulley.expected_volume = pieces.front().volume;
  pulley.expected_euler = pieces.front().euler;
  pulley.mesh_checks = std::move(pieces.front().checks);
  for (std::size_t k = 1; k < pieces.size(); ++k)
    pulley.parts.push_back({k == 1 ? Side::left : Side::right, std::move(pieces[k].mesh), pieces[k].volume,
                            pieces[k].euler, std::move(pieces[k].checks)});
  pulley.status = PulleyStatus::made;
  return rated;
}

std::vector<Rejection> news(std::vector<Rejection> blamed, const std::vector<Rejection>& known) {
  std::erase_if(blamed, [&known](const Rejection& rejection) {
    return std::find(known.begin(), known.end(), rejection) != known.end();
  });
  return blamed;
}

// No way was found to print it without supports.
Pulley refused(Pulley pulley, const Mechanism& mechanism, const std::vector<Vec3>& places) {
  pulley.conditions.push_back(does_not_print(mechanism.name, places, "wherever its tie-offs lie"));
  pulley.status = PulleyStatus::impossible;
  return pulley;
}

bool lacks_a_print(const Pulley& pulley) {
  return std::any_of(pulley.conditions.begin(), pulley.conditions.end(),
                     [](const Condition& condition) { return condition.name == k_prints && !condition.ok; });
}

// Tie-offs are planned elsewhere as long as one of them has a layer that stands out too far.
Pulley with_tie_offs_that_print(const Mechanism& mechanism, const SynthesisResult& synthesis, double mouth_lean,
                                Corners corners, const Effort& effort) {
  TieOffWishes wishes;
  wishes.mouth_lean = mouth_lean;
  std::optional<Pulley> printable;  // of a mesh that bears less than it might
  for (int round = 0;; ++round) {
    const BodyPlan plan = plan_body(mechanism, synthesis, wishes);
    if (mechanism.print.supports) return pulley_of(mechanism, synthesis, plan, corners, effort, k_sound).pulley;
    // Any cut shows whether it prints; the best is looked for where it does.
    RatedPulley rated = pulley_of(mechanism, synthesis, plan, corners, effort, k_any);
    if (rated.pulley.made() && rated.unprintable.empty()) {
      if (rated.soundness == k_sound) return std::move(rated.pulley);
      printable = std::move(rated.pulley);
      rated = pulley_of(mechanism, synthesis, plan, corners, effort, k_sound);
    }
    Pulley& pulley = rated.pulley;
    if (pulley.made() && rated.unprintable.empty()) return std::move(pulley);
    if (!pulley.made()) return printable ? std::move(*printable) : std::move(pulley);
    const std::vector<Rejection> blamed = news(blamed_for(rated.unprintable, plan), wishes.rejected);
    if (blamed.empty() || round == effort.rounds)
      return printable ? std::move(*printable) : refused(std::move(pulley), mechanism, rated.unprintable);
    wishes.rejected.insert(wishes.rejected.end(), blamed.begin(), blamed.end());
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

std::string Pulley::brief() const {
  if (made()) {
    return fmt::format("a body of {} facets, {:.1f} cm³, {} tie-offs", mesh.triangles.size(), expected_volume / 1000.0,
                       anchors.size());
  }
  std::string text = "no such body can be made";
  for (const Condition& condition : conditions) {
    if (!condition.ok) text += "; " + condition.message;
  }
  return text;
}

// Where no steep mouth has room, a wide one whose tip a squared corner holds is better than none.
Pulley make_pulley(const Mechanism& mechanism, const SynthesisResult& synthesis, TieOffSearch search) {
  demand(synthesis.made(), "a body of an infeasible profile");
  const bool is_brief = search == TieOffSearch::brief;
  Pulley pulley =
      with_tie_offs_that_print(mechanism, synthesis, k_steep_lean, Corners::round, is_brief ? k_brief : Effort{});
  if (is_brief || !lacks_a_print(pulley)) return pulley;
  return with_tie_offs_that_print(mechanism, synthesis, k_wide_lean, Corners::squared, Effort{});
}

TriangleMesh plate_of(const Pulley& pulley) {
  if (pulley.parts.empty()) return pulley.mesh;
  TriangleMesh plate = pulley.parts[0].mesh, other = pulley.parts[1].mesh;
  const double shift = bounds(plate).high.x() + k_between_parts - bounds(other).low.x();
  for (Vec3& vertex : other.vertices) vertex.x() += shift;
  return together({plate, rounded_to_float(std::move(other))});
}

}  // namespace fusee
