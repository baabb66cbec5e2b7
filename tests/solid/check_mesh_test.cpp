// Each check of a mesh fails, alone if possible, on a solid damaged on purpose.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

#include "fusee/base.h"
#include "solid/broken.h"

namespace fusee::solid {
namespace {

using testing::check_named;
using testing::cube;
using testing::failed;
using testing::joined;
using testing::turned_inside_out;

TEST(CheckMesh, AcceptsCube) {
  EXPECT_EQ(failed(check_mesh(cube(10))), "");
  EXPECT_DOUBLE_EQ(enclosed_volume(cube(10)), 1000.0);
  EXPECT_EQ(bounds(cube(2, {1, 2, 3})).low, Vec3(1, 2, 3));
  EXPECT_EQ(bounds(cube(2, {1, 2, 3})).high, Vec3(3, 4, 5));
}

TEST(CheckMesh, RejectsMissingFacet) {
  TriangleMesh mesh = cube(10);
  mesh.triangles.erase(mesh.triangles.begin() + 4);
  const auto checks = check_mesh(mesh);
  EXPECT_EQ(failed(checks), "open_edges");
  EXPECT_EQ(check_named(checks, "open_edges").value, 3);
  EXPECT_EQ(check_named(checks, "open_edges").where.substr(0, 6), "facet ");
}

TEST(CheckMesh, ReportsFlippedFacetWithPlace) {
  TriangleMesh mesh = cube(9);
  std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
  const auto checks = check_mesh(mesh);
  EXPECT_EQ(failed(checks), "flipped_facets");
  EXPECT_EQ(check_named(checks, "flipped_facets").where, "facet 0 at (3.000, 3.000, 0.000) mm");
}

TEST(CheckMesh, RejectsPartInsideOut) { EXPECT_EQ(failed(check_mesh(turned_inside_out(cube(10)))), "inverted_parts"); }

TEST(CheckMesh, RejectsOneOfTwoPartsInsideOut) {
  EXPECT_EQ(failed(check_mesh(joined(cube(10), cube(5, {20, 0, 0})))), "");
  EXPECT_EQ(failed(check_mesh(joined(cube(10), turned_inside_out(cube(5, {20, 0, 0}))))), "inverted_parts");
}

TEST(CheckMesh, AcceptsCavity) {
  EXPECT_EQ(failed(check_mesh(joined(cube(10), turned_inside_out(cube(4, {3, 3, 3}))))), "");
  EXPECT_EQ(failed(check_mesh(joined(cube(10), cube(4, {3, 3, 3})))), "inverted_parts");
}

TEST(CheckMesh, RejectsDuplicateFacet) {
  TriangleMesh mesh = cube(10);
  mesh.triangles.push_back(mesh.triangles[7]);
  const auto checks = check_mesh(mesh);
  EXPECT_EQ(failed(checks), "duplicate_facets");
  EXPECT_EQ(check_named(checks, "duplicate_facets").value, 1);
}

TEST(CheckMesh, RejectsDegenerateFacet) {
  // A vertex in the middle of an edge, and a facet without area that closes the gap.
  TriangleMesh mesh = cube(10);
  mesh.vertices.emplace_back(5, 5, 0);
  mesh.triangles[0] = {0, 2, 8};
  mesh.triangles.push_back({0, 8, 1});
  mesh.triangles.push_back({1, 8, 2});
  const auto checks = check_mesh(mesh);
  EXPECT_EQ(failed(checks), "degenerate_facets");
  EXPECT_EQ(check_named(checks, "degenerate_facets").value, 1);
}

// Poles of spheres and capsules are exported with facets of two equal corners.
TEST(CheckMesh, ReportsCollapsedFacetOnce) {
  for (const std::array<std::uint32_t, 3>& slit : {std::array<std::uint32_t, 3>{0, 0, 1}, {4, 2, 4}, {5, 5, 5}}) {
    TriangleMesh mesh = cube(10);
    mesh.triangles.insert(mesh.triangles.begin() + 3, slit);
    const auto checks = check_mesh(mesh);
    EXPECT_EQ(failed(checks), "degenerate_facets");
    EXPECT_EQ(check_named(checks, "degenerate_facets").where.substr(0, 7), "facet 3");
  }
}

TEST(CheckMesh, ReportsNeedleOnce) {
  TriangleMesh mesh = cube(10);
  mesh.vertices.emplace_back(5, 0, 0);
  mesh.triangles.push_back({0, 8, 1});
  EXPECT_EQ(failed(check_mesh(mesh)), "degenerate_facets");
}

// Needles along one edge: each needle's neighbour is the next one, and the last facet is split several times.
TEST(CheckMesh, ReportsRowOfNeedlesOnce) {
  TriangleMesh mesh = cube(10);
  mesh.vertices.emplace_back(5, 5, 0);
  mesh.vertices.emplace_back(2.5, 7.5, 0);
  mesh.triangles[0] = {0, 2, 9};
  mesh.triangles.push_back({0, 9, 8});
  mesh.triangles.push_back({0, 8, 1});
  mesh.triangles.push_back({1, 8, 2});
  mesh.triangles.push_back({8, 9, 2});
  const auto checks = check_mesh(mesh);
  EXPECT_EQ(failed(checks), "degenerate_facets");
  EXPECT_EQ(check_named(checks, "degenerate_facets").value, 2);
}

// The other checks exclude the degenerate facet and report the original facet numbers.
TEST(CheckMesh, FindsFaultsBesideDegenerateFacet) {
  TriangleMesh mesh = cube(10);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  mesh.triangles.pop_back();
  EXPECT_EQ(failed(check_mesh(mesh)), "degenerate_facets open_edges");
  mesh = joined(cube(10), cube(10, {4.5, 4.25, 4.125}));
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  EXPECT_EQ(failed(check_mesh(mesh)), "degenerate_facets self_intersections");
  mesh = cube(9);
  std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  EXPECT_EQ(check_named(check_mesh(mesh), "flipped_facets").where, "facet 1 at (3.000, 3.000, 0.000) mm");
}

// Two holes that share a corner count as two holes.
TEST(CheckMesh, CornerOfHolesIsNotPinched) {
  TriangleMesh mesh = cube(10);
  // A facet of the bottom, and one of a side that has a single corner in common with it.
  const auto share = [](const auto& s, const auto& t) {
    return std::count_if(s.begin(), s.end(), [&](std::uint32_t v) { return std::count(t.begin(), t.end(), v) > 0; });
  };
  const auto first = mesh.triangles.front();
  mesh.triangles.erase(mesh.triangles.begin());
  mesh.triangles.erase(
      std::find_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) { return share(first, t) == 1; }));
  EXPECT_EQ(failed(check_mesh(mesh)), "open_edges");
}

TEST(CheckMesh, RejectsCrossingParts) {
  const auto checks = check_mesh(joined(cube(10), cube(10, {4.5, 4.25, 4.125})));
  EXPECT_EQ(failed(checks), "self_intersections");
  EXPECT_NE(check_named(checks, "self_intersections").where.find("crosses facet"), std::string::npos);
}

TEST(CheckMesh, RejectsTouchingParts) {
  EXPECT_EQ(failed(check_mesh(joined(cube(10), cube(2, {4, 4, 10})))), "self_intersections");
}

TEST(CheckMesh, RejectsFoldedFacet) {
  // The top's corner is moved within the top's plane beyond the opposite edge, so that facets with a common edge
  // overlap.
  TriangleMesh mesh = cube(10);
  mesh.vertices[7] = {2, 2, 10};
  EXPECT_NE(failed(check_mesh(mesh)).find("self_intersections"), std::string::npos);
}

TEST(CheckMesh, RejectsTwoCubesOnOneEdge) {
  EXPECT_EQ(failed(check_mesh(joined(cube(10), cube(10, {10, 10, 0})))), "edges_of_more_than_two_facets");
}

TEST(CheckMesh, RejectsTwoCubesOnOneCorner) {
  EXPECT_EQ(failed(check_mesh(joined(cube(10), cube(10, {10, 10, 10})))), "pinched_vertices");
}

TEST(CheckMesh, WeldsVerticesOfEachFacet) {
  TriangleMesh soup;
  const TriangleMesh mesh = cube(10);
  for (const auto& triangle : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t index : triangle) soup.vertices.push_back(mesh.vertices[index]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(failed(check_mesh(soup)), "");
  EXPECT_EQ(weld(soup).vertices.size(), 8u);
}

TEST(CheckMesh, RejectsEmptyMesh) {
  const auto checks = check_mesh({});
  EXPECT_EQ(failed(checks), "facets");
  EXPECT_EQ(check_named(checks, "facets").where, "there are no facets");
}

TEST(CheckMesh, RejectsSingleFacet) {
  const auto checks = check_mesh({{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, {{0, 1, 2}}});
  EXPECT_EQ(failed(checks), "facets");
  EXPECT_EQ(check_named(checks, "facets").where, "1 facet encloses no solid: at least 4 are required");
}

TEST(CheckMesh, RejectsIndicesOutOfRange) {
  TriangleMesh mesh = cube(10);
  mesh.triangles[3][1] = 4'000'000'000u;
  const auto checks = check_mesh(mesh);
  EXPECT_EQ(check_named(checks, "indices_out_of_range").value, 1);
  EXPECT_EQ(failed(checks), "indices_out_of_range");
}

TEST(CheckMesh, RejectsNanAndInfinity) {
  for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    TriangleMesh mesh = cube(10);
    mesh.vertices[5].y() = value;
    const auto checks = check_mesh(mesh);
    EXPECT_EQ(check_named(checks, "vertices_not_finite").where, "vertex 5");
    EXPECT_EQ(failed(checks), "vertices_not_finite");
  }
}

TEST(CheckMesh, DecidesHugeAndTinyCoordinatesExactly) {
  EXPECT_EQ(failed(check_mesh(cube(1e30))), "");
  EXPECT_EQ(failed(check_mesh(cube(1e-30))), "");
  EXPECT_EQ(failed(check_mesh(joined(cube(1e-30), cube(1e30, {1, 1, 1})))), "");
}

// The search for crossings among equal facets took 20 s for each 100 000.
TEST(CheckMesh, EndsOnManyEqualFacets) {
  TriangleMesh mesh = cube(10);
  for (int k = 0; k < 200'000; ++k) mesh.triangles.push_back(mesh.triangles[0]);
  const auto begin = std::chrono::steady_clock::now();
  const auto checks = check_mesh(mesh);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  EXPECT_EQ(check_named(checks, "duplicate_facets").value, 200'000);
  EXPECT_EQ(failed(checks), "duplicate_facets");
}

// Facets about one edge are all neighbours of each other.
TEST(CheckMesh, SkipsCrossingsAtCrowdedEdge) {
  TriangleMesh mesh{{{0, 0, 0}, {0, 0, 1}}, {}};
  for (std::uint32_t k = 0; k < 15'000; ++k) {
    mesh.vertices.emplace_back(5 + std::cos(k / 1e4), std::sin(k / 1e4), 0.5);
    mesh.triangles.push_back({0, 1, k + 2});
  }
  EXPECT_THAT(check_named(check_mesh(mesh), "self_intersections").where,
              ::testing::HasSubstr("too many overlapping facets"));
}

TEST(Section, CutsCubeIntoSquare) {
  const auto loops = section(cube(10), 4);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_DOUBLE_EQ(signed_area(loops[0]), 100.0);
  EXPECT_TRUE(section(cube(10), 10.5).empty());
  EXPECT_TRUE(section(cube(10), -0.5).empty());
}

TEST(Section, AtFlatFaceCutsJustBelow) {
  // A plane through a flat face cuts just below it.
  EXPECT_DOUBLE_EQ(signed_area(outer_loop(section(cube(10), 10))), 100.0);
  EXPECT_TRUE(section(cube(10), 0).empty());
}

TEST(Section, HolesRunClockwise) {
  const auto loops = section(joined(cube(10), turned_inside_out(cube(4, {3, 3, 3}))), 5);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_DOUBLE_EQ(signed_area(loops[0]) + signed_area(loops[1]), 84.0);
  EXPECT_DOUBLE_EQ(signed_area(outer_loop(loops)), 100.0);
}

TEST(Section, OmitsLoopOfOpenMesh) {
  TriangleMesh mesh = cube(10);
  mesh.triangles.erase(mesh.triangles.begin() + 4);
  EXPECT_TRUE(section(mesh, 2).empty());
  EXPECT_THROW(outer_loop(section(mesh, 2)), InputError);
}

TEST(Section, SkipsBadIndices) {
  TriangleMesh mesh = cube(10);
  mesh.triangles.push_back({0, 1, 99});
  EXPECT_DOUBLE_EQ(signed_area(outer_loop(section(mesh, 4))), 100.0);
}

TEST(RoundedToFloat, RoundsEveryCoordinate) {
  TriangleMesh mesh;
  for (int k = 0; k < 100; ++k) mesh.vertices.emplace_back(0.1 + k, 8.7320158389 + k, 1e-3 * k + 0.7);
  for (const Vec3& vertex : rounded_to_float(mesh).vertices) {
    for (int k = 0; k < 3; ++k) {
      volatile float narrow = static_cast<float>(vertex[k]);
      EXPECT_EQ(vertex[k], static_cast<double>(narrow));
    }
  }
}

}  // namespace
}  // namespace fusee::solid
