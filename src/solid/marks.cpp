#include "solid/marks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fusee/base.h"

namespace fusee::solid {
namespace {

// Clearance to every edge of the face.
constexpr double k_margin = 0.5;
// Heights of letters. A stroke is a fifth as wide, 0.5 mm to 0.8 mm, which a nozzle prints well.
constexpr double k_letter_height = 4.0;
constexpr double k_smallest_letter = 2.5;
// Size of the home mark. Its tip is blunt.
constexpr double k_home_half_width = 0.8;
constexpr double k_home_length = 2.0;
constexpr double k_tip_half_width = 0.03;
// Half the width of the clocking mark.
constexpr double k_clocking_half_width = 0.4;

// Letters on a grid 3 wide and 5 high with strokes 1 wide, origin at the lower left.
std::vector<std::vector<Polygon>> glyph(char letter) {
  switch (letter) {
    case 'P':
      return {{{{0, 0}, {1, 0}, {1, 2}, {3, 2}, {3, 5}, {0, 5}}, {{1, 3}, {1, 4}, {2, 4}, {2, 3}}}};
    case '1':
      return {{{{1, 0}, {2, 0}, {2, 5}, {1, 5}, {0, 4}, {1, 4}}}};
    default:
      return {{{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 5}, {0, 5}, {0, 4}, {2, 4}, {2, 3}, {0, 3}}}};
  }
}

// "P1" or "P2" about `centre`, as read when looking at the face. Both letters and the gap between them are 7 grid units
// wide.
std::vector<Mark> label(char digit, const Vec2& centre, double height, bool on_top) {
  const double unit_length = height / 5.0;
  std::vector<Mark> marks;
  double left = -3.5;
  for (const char letter : {'P', digit}) {
    for (const auto& loops : glyph(letter)) {
      Mark mark;
      mark.on_top = on_top;
      for (const Polygon& loop : loops) {
        Polygon placed;
        for (const Vec2& corner : loop) {
          const Vec2 local = unit_length * Vec2(left + corner.x(), corner.y() - 2.5);
          placed.push_back(centre + (on_top ? local : Vec2(-local.x(), local.y())));
        }
        mark.loops.push_back(std::move(placed));
      }
      marks.push_back(std::move(mark));
    }
    left += 4.0;
  }
  return marks;
}

// One end face: its rim and all features that stand on it or open in it.
class Face {
 public:
  Face(const BodyPlan& plan, bool on_top) : rim_(on_top ? plan.rims.upper : plan.rims.lower), on_top_(on_top) {
    const BodyLayout& layout = plan.layout;
    const double middle = std::max(layout.bore.radius, on_top ? layout.hub_radius : 0.0);
    bars_.push_back({Vec2::Zero(), Vec2::Zero(), middle});
    edge_ = on_top ? 0.0 : layout.elephant_foot;
    if (!on_top) {
      for (const Vec2& place : layout.dowels.places) bars_.push_back({place, place, 0.5 * layout.dowels.hole_diameter});
    }
    for (const Polygon& hole : layout.bore.screw_holes) {
      for (const Vec2& corner : hole) bars_.push_back({corner, corner, 0.0});
    }
    for (const PlannedAnchor& anchor : plan.anchors) {
      if ((anchor.side == transmission::Side::right) != on_top) continue;
      bars_.push_back({anchor.pocket(), anchor.pocket(), anchor.pocket_radius(layout)});
      if (anchor.tail) bars_.push_back({anchor.tail->from, anchor.tail->to, 0.5 * anchor.tail->head_or_width()});
    }
  }

  void occupy(const Bar& bar) { bars_.push_back(bar); }

  bool is_free(const Bar& bar) const {
    const double depth = std::min(rim_.depth_of(bar.a), rim_.depth_of(bar.b)) - bar.radius;
    if (depth < k_margin + edge_) return false;
    return std::all_of(bars_.begin(), bars_.end(), [&bar](const Bar& other) { return gap(bar, other) >= k_margin; });
  }

  // Distance from the axis towards +y at which the face ends, by bisection.
  double reach_up() const {
    double low = 0, high = 1e4;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (low + high);
      (rim_.depth_of({0.0, middle}) > 0 ? low : high) = middle;
    }
    return low - edge_;
  }

  bool on_top() const { return on_top_; }

 private:
  ConvexSides rim_;
  bool on_top_;
  double edge_ = 0;  ///< width of the chamfer at the rim
  std::vector<Bar> bars_;
};

// A triangle that points at the rim in the direction of the joint at home (top), a bar at the same place below. Both
// together allow parts made separately to be aligned.
std::optional<Mark> home_mark(Face& face) {
  const double tip = face.reach_up() - k_margin - 0.1, foot = tip - k_home_length;
  if (!face.is_free({{0, tip - k_home_half_width}, {0, foot + k_home_half_width}, k_home_half_width - 0.1}))
    return std::nullopt;
  face.occupy({{0, tip}, {0, foot}, k_home_half_width});
  Mark mark;
  mark.on_top = face.on_top();
  mark.shows_home = true;
  if (face.on_top()) {
    mark.loops = {
        {{-k_home_half_width, foot}, {k_home_half_width, foot}, {k_tip_half_width, tip}, {-k_tip_half_width, tip}}};
  } else {
    mark.loops = {{{-k_clocking_half_width, foot},
                   {k_clocking_half_width, foot},
                   {k_clocking_half_width, tip},
                   {-k_clocking_half_width, tip}}};
  }
  return mark;
}

// Tries places all round the axis, large letters before small ones.
std::vector<Mark> label_on(Face& face, char digit) {
  const double reach = face.reach_up();
  for (double height = k_letter_height; height >= k_smallest_letter; height *= 0.85) {
    const double half_length = 0.7 * height;
    for (const double angle_degrees : {270.0, 180.0, 0.0, 225.0, 315.0, 135.0, 45.0, 247.0, 293.0}) {
      for (double radius = 0.15 * reach; radius < 1.6 * reach; radius += 0.5) {
        const Vec2 centre = radius * unit(radians(angle_degrees));
        const double half_height = 0.5 * height;
        const Vec2 to_end(half_length - half_height, 0);
        const Bar bar{centre - to_end, centre + to_end, 1.25 * half_height};
        if (!face.is_free(bar)) continue;
        face.occupy(bar);
        return label(digit, centre, height, face.on_top());
      }
    }
  }
  return {};
}

}  // namespace

std::vector<Mark> marks_of(Marks kind, BodyPlan& plan) {
  std::vector<Mark> marks;
  if (kind == Marks::none) return marks;
  for (const bool on_top : {false, true}) {
    Face face(plan, on_top);
    if (auto home = home_mark(face)) {
      marks.push_back(std::move(*home));
    } else {
      plan.layout.omit(on_top ? "home_mark" : "clocking_mark",
                       on_top ? "no space for the home mark on the top face: omitted"
                              : "no space for the clocking mark on the bottom face: omitted");
    }
    auto letters = label_on(face, on_top ? '2' : '1');
    if (letters.empty())
      plan.layout.omit(on_top ? "label_P2" : "label_P1",
                       on_top ? "no space for the label P2: omitted" : "no space for the label P1: omitted");
    std::move(letters.begin(), letters.end(), std::back_inserter(marks));
  }
  return marks;
}

}  // namespace fusee::solid
