// Pulleys in their print orientation: no face looks down too flatly, two parts form the whole, and their pins meet.
// Facets and sections are measured here independently of the checks.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>

#include "fusee/solid.h"
#include "solid/broken.h"
#include "solid/print.h"
#include "support/shapes.h"

namespace fusee::solid {
namespace {

using testing::check_named;
using testing::circle;
using testing::failed;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::plain_mechanism;
using testing::pulley_of;
using testing::SupportShape;

// Tolerance of heights, which are rounded to float. mm
constexpr double k_flat = 1e-5;
// Ceilings are steeper than requested by this margin (heights.cpp). Measured values may be off by a float step.
constexpr double k_margin = radians(2.5);
constexpr double k_grain = radians(0.05);
// Faces up to this height above the bed are not measured: those in the first layer, and the ceilings of marks 0.4 mm
// deep, which are narrow bridges.
constexpr double k_above_bed = 0.41;

struct BuiltPiece {
  Mechanism mechanism;
  profile::SynthesisResult shape;
  Pulley pulley;
  BuiltPiece(Mechanism m, profile::SynthesisResult s)
      : mechanism(std::move(m)), shape(std::move(s)), pulley(make_pulley(mechanism, shape)) {}

  /// The parts to print.
  std::vector<TriangleMesh> prints() const {
    if (pulley.parts.empty()) return {pulley.mesh};
    return {pulley.parts[0].mesh, pulley.parts[1].mesh};
  }
  std::string print_failures() const {
    PrintLimits limits;
    limits.overhang = mechanism.print.overhang;
    std::string names;
    for (const TriangleMesh& mesh : prints()) names += failed(check_print(mesh, limits));
    return names;
  }
};

Mechanism printed(Parts parts, double overhang = 45) {
  Mechanism mechanism = plain_mechanism();
  mechanism.print.parts = parts;
  mechanism.print.overhang = radians(overhang);
  return mechanism;
}

// ---- slopes ---------------------------------------------------------------------------------------------------------

bool outside(const profile::Outline& outline, double distance, const Vec2& point) {
  return std::any_of(outline.points.begin(), outline.points.end(),
                     [&](const profile::OutlinePoint& at) { return (point - at.position).dot(at.normal) > distance; });
}

// Least slope of downward faces of grooves, cones and rims above the bed; 90° if there is none.
double flattest_outside(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& is_outside) {
  double flattest = radians(90);
  const double bed = bounds(mesh).low.z();
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    const Vec3 normal = (q - p).cross(r - p);
    // A sliver's normal is dominated by rounding.
    const double longest = std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()});
    if (normal.z() >= 0 || normal.norm() < 1e-3 * longest) continue;
    if (std::max({p.z(), q.z(), r.z()}) <= bed + k_above_bed) continue;
    if (!is_outside(p) || !is_outside(q) || !is_outside(r)) continue;
    flattest = std::min(flattest, std::atan2(normal.head<2>().norm(), -normal.z()));
  }
  return flattest;
}

double flattest_ceiling(const BuiltPiece& made) {
  const Pulley& pulley = made.pulley;
  const double scale = pulley.layout.scale, past_floor = -0.5 * made.mechanism.tendon.diameter - 1e-4;
  const auto at_p1 = [&](const Vec2& place) { return outside(made.shape.p1, past_floor, place / scale); };
  const auto at_p2 = [&](const Vec2& place) { return outside(made.shape.p2, past_floor, place / scale); };
  if (pulley.parts.empty()) {
    return flattest_outside(pulley.mesh, [&](const Vec3& v) {
      return v.z() < scale * pulley.layout.z_mate - 1e-4 ? at_p1(v.head<2>()) : at_p2(v.head<2>());
    });
  }
  const double p1 = flattest_outside(pulley.parts[0].mesh, [&](const Vec3& v) { return at_p1({v.x(), -v.y()}); });
  const double p2 = flattest_outside(pulley.parts[1].mesh, [&](const Vec3& v) { return at_p2(v.head<2>()); });
  return std::min(p1, p2);
}

struct Kind {
  Groove groove;
  Flange flange;
  bool recess;  ///< the bore is a horn's recess
};

std::vector<Kind> kinds() {
  std::vector<Kind> kinds;
  for (const Groove groove : {Groove::u, Groove::v, Groove::flat}) {
    for (const Flange flange : {Flange::follow, Flange::round}) {
      kinds.push_back({groove, flange, false});
    }
  }
  kinds.push_back({Groove::u, Flange::follow, true});
  return kinds;
}

BuiltPiece made_as(const Kind& kind, Mechanism mechanism) {
  mechanism.body.groove = kind.groove;
  mechanism.body.flange = kind.flange;
  if (kind.recess) {
    mechanism.body.bore = Bore::horn;
    mechanism.body.horn = "disc-25T-M3";
  }
  return {mechanism, pulley_of({22, {{2, 2, 0.5}, {1, 2, 0}}}, {25, {{2, -1.5, 1}}})};
}

class PrintShape : public ::testing::TestWithParam<std::tuple<double, Parts>> {};

TEST_P(PrintShape, HasNoFlatDownwardFaces) {
  const auto [overhang, parts] = GetParam();
  for (const Kind& kind : kinds()) {
    const BuiltPiece made = made_as(kind, printed(parts, overhang));
    SCOPED_TRACE(::testing::Message() << "groove " << static_cast<int>(kind.groove) << " flange "
                                      << static_cast<int>(kind.flange) << " recess " << kind.recess);
    ASSERT_TRUE(made.pulley.made()) << made.pulley.brief();
    EXPECT_EQ(made.pulley.parts.size(), parts == Parts::two ? 2u : 0u);
    EXPECT_EQ(made.print_failures(), "");
    const double flattest = flattest_ceiling(made);
    EXPECT_GE(degrees(flattest), degrees(radians(overhang) + k_margin - k_grain));
    // The slope is the requested one and not steeper: the grooves' own walls are 65° above the horizontal.
    if (kind.groove != Groove::u && overhang < 60) {
      EXPECT_LT(degrees(flattest), overhang + 12);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, PrintShape,
                         ::testing::Combine(::testing::Values(30.0, 45.0, 60.0),
                                            ::testing::Values(Parts::one, Parts::two)),
                         [](const auto& param) {
                           return "At" + std::to_string(static_cast<int>(std::get<0>(param.param))) +
                                  (std::get<1>(param.param) == Parts::two ? "InTwo" : "InOne");
                         });

TEST(PrintShapes, SupportsAllowFlatCeilingsAndSymmetricGrooves) {
  for (const Parts parts : {Parts::one, Parts::two}) {
    Mechanism mechanism = printed(parts);
    mechanism.print.supports = true;
    const BuiltPiece made = made_as({Groove::u, Flange::round, false}, mechanism);
    ASSERT_TRUE(made.pulley.made()) << made.pulley.brief();
    const BodyLayout& layout = made.pulley.layout;
    for (const GrooveWalls* walls : {&layout.p1, &layout.p2}) {
      ASSERT_EQ(walls->below.size(), walls->above.size());
      for (std::size_t k = 0; k < walls->below.size(); ++k) {
        EXPECT_EQ(walls->below[k].offset, walls->above[k].offset);
        EXPECT_EQ(walls->below[k].dz, walls->above[k].dz);
      }
    }
    EXPECT_EQ(layout.lower_cone + layout.middle_cone + layout.upper_cone + layout.channel_ceiling, 0);
    EXPECT_NEAR(degrees(flattest_ceiling(made)), 0, 0.01);
    EXPECT_THAT(made.print_failures(), HasSubstr("overhang"));
  }
}

// ---- seats ----------------------------------------------------------------------------------------------------------

struct Seat {
  double below = 1e9;  ///< distance of the tendon's centre line from the wall below the groove's plane, mm
  double above = 1e9;  ///< the same above the plane
};

double from_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + t * (b - a) - p).norm();
}

// Sections of the surface by planes through an axis, as straight lines.
Seat seat_of(const TriangleMesh& mesh, double pitch, double z) {
  Seat seat;
  const Vec2 line(pitch, z);
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 &a = mesh.vertices[triangle[k]], &b = mesh.vertices[triangle[(k + 1) % 3]];
      const Vec2 from(a.head<2>().norm(), a.z()), to(b.head<2>().norm(), b.z());
      if (std::abs(cross(Vec2(a.head<2>()), Vec2(b.head<2>()))) > 1e-4 || (from - to).norm() < 1e-6) continue;
      const double distance = from_segment(line, from, to);
      if (std::min(from.y(), to.y()) < z - 1e-3) seat.below = std::min(seat.below, distance);
      if (std::max(from.y(), to.y()) > z + 1e-3) seat.above = std::min(seat.above, distance);
    }
  }
  return seat;
}

// Marks and tie-offs appear in these sections too, but none of them is closer to the tendon than the seat.
TEST(PrintShapes, SeatsTendonInBothHalves) {
  for (const Groove groove : {Groove::u, Groove::v, Groove::flat}) {
    for (const Parts parts : {Parts::one, Parts::two}) {
      Mechanism mechanism = printed(parts, 60);
      mechanism.body.groove = groove;
      const BuiltPiece made(mechanism, pulley_of(circle(20), circle(22)));
      ASSERT_TRUE(made.pulley.made()) << made.pulley.brief();
      const BodyLayout& layout = made.pulley.layout;
      for (const auto& [pitch, z] : {std::pair{20.0, layout.z_p1}, std::pair{22.0, layout.z_p2}}) {
        const Seat seat = seat_of(made.pulley.mesh, pitch, z);
        EXPECT_NEAR(seat.below, 0.5, 1e-5) << static_cast<int>(groove);
        EXPECT_NEAR(seat.above, 0.5, 1e-5) << static_cast<int>(groove);
      }
    }
  }
}

TEST(PrintShapes, LoadedHalfIsEqualWithSupports) {
  const profile::SynthesisResult shape = pulley_of(circle(20), circle(22));
  Mechanism mechanism = printed(Parts::two);
  const BodyLayout apart = resolve_layout(mechanism, shape);
  mechanism.print.parts = Parts::one;
  const BodyLayout whole = resolve_layout(mechanism, shape);
  mechanism.print.supports = true;
  const BodyLayout supported = resolve_layout(mechanism, shape);
  // P1 is printed turned over where it is printed separately.
  for (const auto& [half, same] :
       {std::pair{&whole.p1.below, &supported.p1.below}, std::pair{&whole.p2.below, &supported.p2.below},
        std::pair{&apart.p1.above, &supported.p1.above}, std::pair{&apart.p2.below, &supported.p2.below}}) {
    ASSERT_EQ(half->size(), same->size());
    for (std::size_t k = 0; k < half->size(); ++k) {
      EXPECT_EQ((*half)[k].offset, (*same)[k].offset);
      EXPECT_EQ((*half)[k].dz, (*same)[k].dz);
    }
  }
}

// ---- two parts ------------------------------------------------------------------------------------------------------

BuiltPiece two_parts() { return {printed(Parts::two), pulley_of(circle(20), circle(24, {2, 1}))}; }

double section_area(const TriangleMesh& mesh, double z) {
  double area = 0;
  for (const Polygon& loop : section(mesh, z)) area += signed_area(loop);
  return area;
}

TEST(TwoParts, FormTheWhole) {
  const BuiltPiece made = two_parts();
  ASSERT_TRUE(made.pulley.made()) << made.pulley.brief();
  ASSERT_EQ(made.pulley.parts.size(), 2u);
  const TriangleMesh &p1 = made.pulley.parts[0].mesh, &p2 = made.pulley.parts[1].mesh;
  const double whole = enclosed_volume(made.pulley.mesh);
  EXPECT_NEAR(enclosed_volume(p1) + enclosed_volume(p2), whole, 1e-6 * whole);
  EXPECT_NEAR(made.pulley.parts[0].expected_volume + made.pulley.parts[1].expected_volume, whole, 1e-6 * whole);
  const double mate = made.pulley.layout.z_mate, top = made.pulley.layout.z_hub;
  for (double z = 0.137; z < top; z += 0.311) {
    if (std::abs(z - mate) < 0.01) continue;
    const double area = section_area(made.pulley.mesh, z);
    EXPECT_NEAR(z < mate ? section_area(p1, mate - z) : section_area(p2, z - mate), area, 1e-4 * area) << z;
  }
}

TEST(TwoParts, LieOnTheirMatingFaces) {
  const BuiltPiece made = two_parts();
  for (const PrintedPart& part : made.pulley.parts) {
    EXPECT_NEAR(bounds(part.mesh).low.z(), 0, k_flat) << transmission::pulley_name(part.side);
    EXPECT_EQ(failed(check_printed_part(part.mesh, part)), "");
    double bed = 0, higher = 0;
    for (const auto& [a, b, c] : part.mesh.triangles) {
      const Vec3 &p = part.mesh.vertices[a], &q = part.mesh.vertices[b], &r = part.mesh.vertices[c];
      const double shadow = 0.5 * (q - p).cross(r - p).z();
      (std::max({p.z(), q.z(), r.z()}) < k_flat ? bed : higher) -= std::min(shadow, 0.0);
    }
    // Only the chamfer at the bed, ceilings and pin holes look down above it.
    EXPECT_GT(bed, higher) << transmission::pulley_name(part.side);
    EXPECT_NEAR(bed, section_area(part.mesh, 1e-3), 0.01 * bed);
  }
  const BodyLayout& layout = made.pulley.layout;
  EXPECT_NEAR(bounds(made.pulley.parts[0].mesh).high.z(), layout.z_mate, 1e-5);
  EXPECT_NEAR(bounds(made.pulley.parts[1].mesh).high.z(), layout.z_hub - layout.z_mate, 1e-5);
}

TEST(TwoParts, LieSideBySideOnPlate) {
  const BuiltPiece made = two_parts();
  const std::vector<TriangleMesh> bodies = bodies_of(plate_of(made.pulley));
  ASSERT_EQ(bodies.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(bounds(bodies[k]).low.z(), 0, k_flat);
    EXPECT_NEAR(enclosed_volume(bodies[k]), enclosed_volume(made.pulley.parts[k].mesh), 1e-3);
  }
  EXPECT_NEAR(bounds(bodies[1]).low.x() - bounds(bodies[0]).high.x(), 5, 1e-5);
  const BuiltPiece one(printed(Parts::one), made.shape);
  EXPECT_EQ(plate_of(one.pulley).vertices, one.pulley.mesh.vertices);
}

// Loops of a polyhole's size, equally far from their centre everywhere.
std::vector<Vec2> pin_holes(const TriangleMesh& mesh, double z, double diameter) {
  std::vector<Vec2> centres;
  for (const Polygon& loop : section(mesh, z)) {
    Vec2 low = loop.front(), high = loop.front();
    for (const Vec2& point : loop) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    const Vec2 middle = 0.5 * (low + high);
    double room = 1e9;
    for (std::size_t i = 0; i < loop.size(); ++i)
      room = std::min(room, from_segment(middle, loop[i], loop[(i + 1) % loop.size()]));
    if (signed_area(loop) < 0 && middle.norm() > 1 && std::abs(2 * room - diameter) < 0.01) centres.push_back(middle);
  }
  return centres;
}

TEST(TwoParts, PinHolesMeet) {
  for (const double r2 : {24.0, 30.0, 17.0}) {
    const BuiltPiece made(printed(Parts::two), pulley_of(circle(20), circle(r2, {2, 1})));
    ASSERT_TRUE(made.pulley.made()) << made.pulley.brief();
    const BodyLayout& layout = made.pulley.layout;
    ASSERT_EQ(layout.dowels.places.size(), 2u);
    EXPECT_NEAR(layout.dowels.hole_diameter, layout.dowels.pin_diameter + 0.2, 1e-12);
    const double d = layout.dowels.hole_diameter;
    std::vector<Vec2> in_p1 = pin_holes(made.pulley.parts[0].mesh, 1.0, d);
    const std::vector<Vec2> in_p2 = pin_holes(made.pulley.parts[1].mesh, 1.0, d);
    ASSERT_EQ(in_p1.size(), 2u);
    ASSERT_EQ(in_p2.size(), 2u);
    for (Vec2& centre : in_p1) {
      centre.y() *= -1;  // put back on P2
      EXPECT_LT(std::min((centre - in_p2[0]).norm(), (centre - in_p2[1]).norm()), 1e-4);
    }
    // Rotated by half a turn, or with one part turned over, the pins do not meet.
    for (const auto& turned : {Vec2(-1, -1), Vec2(1, -1), Vec2(-1, 1)}) {
      double meets = 0;
      for (const Vec2& centre : in_p1) {
        const Vec2 there = centre.cwiseProduct(turned);
        meets = std::max(meets, std::min((there - in_p2[0]).norm(), (there - in_p2[1]).norm()));
      }
      EXPECT_GT(meets, 0.5 * layout.dowels.pin_diameter);
    }
  }
}

double gap_between(const Polygon& a, const Polygon& b) {
  double gap = 1e9;
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    for (const Vec2& point : *from) {
      for (std::size_t i = 0; i < to->size(); ++i)
        gap = std::min(gap, from_segment(point, (*to)[i], (*to)[(i + 1) % to->size()]));
    }
  }
  return gap;
}

TEST(TwoParts, PinsClearTieOffs) {
  const BuiltPiece made = two_parts();
  const BodyLayout& layout = made.pulley.layout;
  for (const Vec2& place : layout.dowels.places) {
    Polygon hole;
    for (int k = 0; k < 48; ++k) hole.push_back(place + 0.5 * layout.dowels.hole_diameter * unit(k_two_pi * k / 48));
    for (const Anchor& anchor : made.pulley.anchors) {
      if (anchor.side == transmission::Side::right && layout.dowels.z_end < layout.z_p2) continue;
      EXPECT_GE(gap_between(hole, anchor.channel), layout.min_wall - 0.01) << transmission::pulley_name(anchor.side);
    }
  }
  // In the sections of both grooves the pin holes are separate loops.
  EXPECT_EQ(pin_holes(made.pulley.mesh, layout.z_p1 + 0.01, layout.dowels.hole_diameter).size(), 2u);
}

// ---- one or two -----------------------------------------------------------------------------------------------------

// Flange 1 reaches to 20 − d/2 + 2 d. The middle one is outside both groove edges by 0.2 mm plus the smooth maximum's
// excess.
double cone_over(double r1, double r2, double overhang) {
  const double higher = r2 + 0.5 * std::log(1 + std::exp((r1 - r2) / 0.5)) + 0.2;
  return (higher - r1) * std::tan(radians(overhang) + k_margin);
}

// One print permits a cone of up to 3 mm (plan.cpp).
TEST(OneOrTwo, DependsOnConeUnderMiddleFlange) {
  int one = 0, two = 0;
  for (const double overhang : {30.0, 45.0, 60.0}) {
    for (const double r2 : {17.0, 20.0, 21.0, 22.0, 22.5, 22.8, 23.5, 24.9, 25.2, 27.0}) {
      const BodyLayout layout = resolve_layout(printed(Parts::automatic, overhang), pulley_of(circle(20), circle(r2)));
      const double cone = cone_over(20, r2, overhang);
      EXPECT_EQ(layout.parts, cone <= 3.0 ? Parts::one : Parts::two) << r2 << " at " << overhang << ", cone " << cone;
      ++(cone <= 3.0 ? one : two);
      if (cone <= 3.0) {
        EXPECT_NEAR(layout.middle_cone, cone, 0.02 * cone + 0.02);
      }
    }
  }
  EXPECT_GE(std::min(one, two), 8);
}

TEST(OneOrTwo, FollowsTheFile) {
  const profile::SynthesisResult near = pulley_of(circle(20), circle(20)), far = pulley_of(circle(20), circle(27));
  EXPECT_EQ(resolve_layout(printed(Parts::two), near).parts, Parts::two);
  EXPECT_EQ(resolve_layout(printed(Parts::one), far).parts, Parts::one);
}

TEST(OneOrTwo, IsOneWithoutSpaceForPins) {
  Mechanism mechanism = printed(Parts::automatic);
  mechanism.tendon.diameter = 0.5;
  mechanism.body.min_wall = 0;
  const auto says_why = ::testing::Contains(HasSubstr("no space for pins"));
  const BodyLayout small = resolve_layout(mechanism, pulley_of(circle(5), circle(11)));
  EXPECT_EQ(small.parts, Parts::one);
  EXPECT_THAT(small.notes, says_why);
  // A flat on the shaft locates the parts without pins.
  mechanism.body.bore = Bore::d;
  const BodyLayout flat = resolve_layout(mechanism, pulley_of(circle(5), circle(11)));
  EXPECT_EQ(flat.parts, Parts::two);
  EXPECT_THAT(flat.notes, Not(says_why));
}

}  // namespace
}  // namespace fusee::solid
