// Rewinding an intact part gives the target motion; deliberate faults are detected.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "fusee/pipeline.h"
#include "fusee/solid.h"
#include "pipeline/agreement.h"

namespace {

using namespace fusee;

class MadePart : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    mechanism_ =
        new Mechanism(read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles/forearm.toml").mechanism);
    synthesis_ = new profile::SynthesisResult(profile::synthesise(*mechanism_));
    mesh_ = new solid::TriangleMesh(solid::make_pulley(*mechanism_, *synthesis_).mesh);
  }
  static void TearDownTestSuite() {
    delete mechanism_;
    delete synthesis_;
    delete mesh_;
  }

  template <typename Change>
  static solid::TriangleMesh changed(Change change) {
    solid::TriangleMesh mesh = *mesh_;
    for (Vec3& vertex : mesh.vertices) change(vertex);
    return mesh;
  }
  /// The names of failed checks after winding tendons on the part.
  static std::vector<std::string> failures(const pipeline::Part& part) {
    std::vector<std::string> names;
    for (const Check& check :
         pipeline::as_built_checks(*mechanism_, pipeline::rewind_part({*mechanism_, {}}, part), {})) {
      if (!check.ok) names.push_back(check.name);
    }
    return names;
  }
  static formats::DrawingPath path(const std::string& layer, const profile::Outline& outline, double distance) {
    return {layer, "LWPOLYLINE", 1, true, profile::parallel(outline, distance)};
  }

  static Mechanism* mechanism_;
  static profile::SynthesisResult* synthesis_;
  static solid::TriangleMesh* mesh_;
};
Mechanism* MadePart::mechanism_ = nullptr;
profile::SynthesisResult* MadePart::synthesis_ = nullptr;
solid::TriangleMesh* MadePart::mesh_ = nullptr;

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST_F(MadePart, UnchangedPartPasses) { EXPECT_THAT(failures(*mesh_), IsEmpty()); }

TEST_F(MadePart, InsideOutHasSameAngles) {
  solid::TriangleMesh mesh = *mesh_;
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_NEAR(pipeline::rewind_part({*mechanism_, {}}, mesh).max_theta_error,
              pipeline::rewind_part({*mechanism_, {}}, *mesh_).max_theta_error, 1e-9);
}

TEST_F(MadePart, DetectsSmallPrint) {
  EXPECT_THAT(failures(changed([](Vec3& v) { v.head<2>() *= 0.995; })), Contains("theta_error"));
}

TEST_F(MadePart, DetectsEccentricBore) {
  EXPECT_THAT(failures(changed([](Vec3& v) { v.x() += 0.2; })), ElementsAre("theta_error", "excess_length"));
}

TEST_F(MadePart, DetectsMirroring) {
  EXPECT_THAT(failures(changed([](Vec3& v) { v.x() = -v.x(); })), Contains("excess_length"));
}

TEST_F(MadePart, DetectsTurnOnShaft) {
  // The profile meets the tendons at the wrong place.
  const double c = std::cos(radians(5.0)), s = std::sin(radians(5.0));
  EXPECT_THAT(failures(changed([&](Vec3& v) { v.head<2>() = Vec2(c * v.x() - s * v.y(), s * v.x() + c * v.y()); })),
              Contains("excess_length"));
}

TEST_F(MadePart, RejectsPartWithoutGrooves) {
  EXPECT_THROW(pipeline::rewind_part({*mechanism_, {}}, changed([](Vec3& v) { v.z() += 1000; })), InputError);
  EXPECT_THROW(pipeline::rewind_part({*mechanism_, {}}, solid::TriangleMesh()), InputError);
}

// ---- moved parts ----------------------------------------------------------------------------------------------------

/// Turned over about x or not, then turned about its axis, then moved; rounded to floats as in an STL.
solid::TriangleMesh placed(solid::TriangleMesh mesh, bool over, double turn_deg, const Vec3& by) {
  for (Vec3& v : mesh.vertices) {
    if (over) v = Vec3(v.x(), -v.y(), -v.z());
    v.head<2>() = turned(v.head<2>(), radians(turn_deg));
    v += by;
  }
  return solid::rounded_to_float(mesh);
}

TEST_F(MadePart, UnmovedPartIsNotChanged) {
  const pipeline::RewoundPart part = pipeline::rewind_moved_part({*mechanism_, {}}, *mesh_);
  EXPECT_EQ(part.place, pipeline::PartPlace::as_made);
  EXPECT_THAT(part.placements, IsEmpty());
  const profile::RewindResult unmoved = pipeline::rewind_part({*mechanism_, {}}, *mesh_);
  EXPECT_EQ(part.as_built.max_theta_error, unmoved.max_theta_error);
  EXPECT_EQ(part.as_built.max_excess, unmoved.max_excess);
}

TEST_F(MadePart, MovedPartHasSameAngles) {
  const profile::RewindResult unmoved = pipeline::rewind_part({*mechanism_, {}}, *mesh_);
  for (const bool over : {false, true}) {
    for (const double turn : {0.0, 90.0, 213.4}) {
      const pipeline::RewoundPart part =
          pipeline::rewind_moved_part({*mechanism_, {}}, placed(*mesh_, over, turn, Vec3(125, 105, 30)));
      ASSERT_EQ(part.place, pipeline::PartPlace::found);
      ASSERT_EQ(part.placements.size(), 1u);
      EXPECT_EQ(part.placements[0].turned_over, over);
      for (std::size_t i = 0; i < unmoved.points.size(); ++i)
        EXPECT_NEAR(degrees(part.as_built.points[i].theta), degrees(unmoved.points[i].theta), 1e-4);
      EXPECT_NEAR(part.as_built.max_excess, unmoved.max_excess, 1e-4);
    }
  }
}

TEST_F(MadePart, ReportsScaleOfMesh) {
  EXPECT_EQ(pipeline::rewind_moved_part({*mechanism_, {}}, *mesh_).scale, 1);
  for (const double scale : {1.015, 0.995}) {
    const solid::TriangleMesh mesh = changed([&](Vec3& v) { v *= scale; });
    EXPECT_NEAR(pipeline::rewind_moved_part({*mechanism_, {}}, mesh).scale, scale, 3e-4);
    EXPECT_NEAR(pipeline::rewind_moved_part({*mechanism_, {}}, placed(mesh, true, 40, Vec3(125, 105, 30))).scale, scale,
                3e-4);
  }
  // Another fault is no scale.
  EXPECT_EQ(pipeline::rewind_moved_part({*mechanism_, {}}, changed([](Vec3& v) { v.x() *= 1.01; })).scale, 1);
}

TEST_F(MadePart, FaultRemainsAfterMove) {
  // Half a percent too small: the part fits no better elsewhere, so it is not moved, and its error remains.
  const solid::TriangleMesh small = changed([](Vec3& v) { v.head<2>() *= 0.995; });
  const profile::RewindResult unmoved = pipeline::rewind_part({*mechanism_, {}}, small);
  EXPECT_EQ(pipeline::rewind_moved_part({*mechanism_, {}}, small).place, pipeline::PartPlace::as_made);
  const pipeline::RewoundPart moved =
      pipeline::rewind_moved_part({*mechanism_, {}}, placed(small, true, 40, Vec3(125, 105, 30)));
  EXPECT_EQ(moved.place, pipeline::PartPlace::found);
  EXPECT_NEAR(degrees(moved.as_built.max_theta_error), degrees(unmoved.max_theta_error), 0.02);
  EXPECT_GT(degrees(moved.as_built.max_theta_error), 0.05);
}

TEST_F(MadePart, RejectsMirroredOrScaledPart) {
  const auto message = [](const solid::TriangleMesh& mesh) {
    try {
      pipeline::rewind_moved_part({*mechanism_, {}}, mesh);
    } catch (const InputError& error) {
      return error.diagnostics().front().message + "; " + error.diagnostics().front().hint;
    }
    return std::string("taken");
  };
  EXPECT_THAT(message(changed([](Vec3& v) { v.x() = -v.x(); })), ::testing::HasSubstr("mirror image"));
  EXPECT_THAT(message(placed(changed([](Vec3& v) { v.z() = -v.z(); }), false, 30, Vec3(9, 9, 9))),
              ::testing::HasSubstr("mirror image"));
  EXPECT_THAT(message(changed([](Vec3& v) { v /= 25.4; })), ::testing::HasSubstr("inches: scale it by 25.4"));
  EXPECT_THAT(message(changed([](Vec3& v) { v *= 1.1; })), ::testing::HasSubstr("1.1 times the size"));
  // Other scales are not explained by a unit.
  EXPECT_THAT(message(changed([](Vec3& v) { v *= 1.1; })), ::testing::HasSubstr("another pulley.r1_mm"));
  EXPECT_EQ(message(*mesh_), "taken");
  EXPECT_EQ(message(changed([](Vec3& v) { v *= 1.004; })), "taken");
}

TEST_F(MadePart, FindsPulleysSideBySide) {
  const solid::BodyLayout layout = solid::resolve_layout(*mechanism_, *synthesis_);
  const double middle = 0.5 * (layout.z_p1 + layout.z_p2);
  // Facets between the grooves bridge the cut, and are omitted.
  solid::TriangleMesh lower{mesh_->vertices, {}}, upper = lower;
  for (const auto& triangle : mesh_->triangles) {
    const auto is_above = [&](std::uint32_t vertex) { return mesh_->vertices[vertex].z() > middle; };
    const auto above = std::count_if(triangle.begin(), triangle.end(), is_above);
    if (above == 0) lower.triangles.push_back(triangle);
    if (above == 3) upper.triangles.push_back(triangle);
  }
  const pipeline::RewoundPart p2 =
      pipeline::rewind_moved_part({*mechanism_, {}}, placed(upper, true, 70, Vec3(60, 0, 20)));
  EXPECT_EQ(p2.alone, transmission::Side::right);
  EXPECT_LT(degrees(p2.as_built.max_theta_error), 0.01);
  EXPECT_EQ(p2.as_built.max_excess, 0);

  solid::TriangleMesh both = placed(lower, false, 10, Vec3(-40, 7, 0));
  const solid::TriangleMesh other = placed(upper, true, 70, Vec3(60, 0, 20));
  const auto first = static_cast<std::uint32_t>(both.vertices.size());
  both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& [a, b, c] : other.triangles) both.triangles.push_back({first + a, first + b, first + c});
  const pipeline::RewoundPart part = pipeline::rewind_moved_part({*mechanism_, {}}, both);
  ASSERT_EQ(part.placements.size(), 2u);
  EXPECT_FALSE(part.alone);
  EXPECT_LT(degrees(part.as_built.max_theta_error), 0.01);
  EXPECT_LT(part.as_built.max_excess, 0.01);
}

TEST_F(MadePart, ReportsPartOfAnotherMechanism) {
  Mechanism other = *mechanism_;
  other.guides.ED = 62;
  other.guides.OE = -25;
  EXPECT_EQ(pipeline::rewind_moved_part({other, {}}, *mesh_).place, pipeline::PartPlace::not_recognised);
  try {
    pipeline::rewind_moved_part({other, {}}, placed(*mesh_, false, 0, Vec3(0, 0, 500)));
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_THAT(error.diagnostics().front().hint, ::testing::HasSubstr("nor do its grooves fit anywhere else"));
  }
  Mechanism impossible = *mechanism_;
  impossible.pulley.r1 = 60;
  EXPECT_THROW(pipeline::rewind_moved_part({impossible, {}}, *mesh_), InputError);
}

TEST_F(MadePart, SizeMatchesMeshOrDrawing) {
  const pipeline::PartSize size = pipeline::size_of(*mesh_, pipeline::check_part(*mesh_));
  const solid::Bounds box = solid::bounds(*mesh_);
  EXPECT_EQ(*size.extent, box.high - box.low);
  EXPECT_DOUBLE_EQ(*size.volume, solid::enclosed_volume(*mesh_));
  EXPECT_FALSE(size.contours);
  solid::TriangleMesh open = *mesh_;
  open.triangles.pop_back();
  EXPECT_FALSE(pipeline::size_of(open, pipeline::check_part(open)).volume);
  EXPECT_FALSE(pipeline::size_of(solid::TriangleMesh(), {}).extent);
  formats::Drawing drawing;
  drawing.paths = {{"A", "LWPOLYLINE", 1, true, {{0, 0}, {3, 0}, {3, 4}}}, {"A", "LINE", 2, false, {{0, 0}, {-1, 0}}}};
  const pipeline::PartSize flat = pipeline::size_of(drawing, pipeline::check_part(drawing));
  EXPECT_EQ(*flat.extent, Vec3(4, 4, 0));
  EXPECT_EQ(flat.contours, 1u);
  EXPECT_FALSE(flat.volume);
  drawing.paths.push_back({"NOTES", "LINE", 3, false, {{0, -68}, {1, -68}}});
  EXPECT_EQ(*pipeline::size_of(drawing, {}).extent, Vec3(4, 4, 0));
}

TEST_F(MadePart, ReadsUtf16AndCarriageReturns) {
  const std::string square = "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n0\n40\n50\n0\nENDSEC\n0\nEOF\n";
  std::string utf16 = "\xFF\xFE", cr = square;
  for (const char c : square) utf16 += {c, '\0'};
  std::replace(cr.begin(), cr.end(), '\n', '\r');
  for (const std::string& bytes : {utf16, cr}) {
    // Without a file name ending that shows the format.
    const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "round_part";
    std::ofstream(file, std::ios::binary) << bytes;
    const pipeline::Part part = pipeline::read_part(file);
    ASSERT_TRUE(std::holds_alternative<formats::Drawing>(part));
    EXPECT_EQ(*pipeline::size_of(part, pipeline::check_part(part)).extent, Vec3(100, 100, 0));
    std::filesystem::remove(file);
  }
}

TEST_F(MadePart, DrawingHasSameAngles) {
  const double floor = -0.5 * mechanism_->tendon.diameter;
  formats::Drawing floors, pitches;
  floors.paths = {path("P1_FLOOR", synthesis_->p1, floor), path("P2_FLOOR", synthesis_->p2, floor)};
  pitches.paths = {path("P1_PITCH", synthesis_->p1, 0), path("P2_PITCH", synthesis_->p2, 0)};
  const profile::RewindResult by_floors = pipeline::rewind_part({*mechanism_, {}}, floors),
                              by_pitches = pipeline::rewind_part({*mechanism_, {}}, pitches);
  EXPECT_LT(degrees(by_floors.max_theta_error), 0.005);
  // Chord error of the polygons: 0.01 mm of tendon is 0.01° here.
  EXPECT_NEAR(degrees(by_floors.max_theta_error), degrees(by_pitches.max_theta_error), 0.005);
  std::swap(floors.paths[0].layer, floors.paths[1].layer);
  EXPECT_THAT(failures(floors), Contains("excess_length"));
}

TEST_F(MadePart, RejectsDrawingWithoutLayers) {
  formats::Drawing drawing;
  drawing.paths = {path("P1_FLOOR", synthesis_->p1, 0)};
  EXPECT_THROW(pipeline::rewind_part({*mechanism_, {}}, drawing), InputError);
}

TEST_F(MadePart, RewindsAtShrunkSize) {
  Mechanism shrinking = *mechanism_;
  shrinking.material.shrinkage = 0.02;
  const solid::TriangleMesh mesh = solid::make_pulley(shrinking, profile::synthesise(shrinking)).mesh;
  EXPECT_LT(degrees(pipeline::rewind_part({shrinking, {}}, mesh).max_theta_error), 0.005);
  EXPECT_GT(degrees(pipeline::rewind_part({*mechanism_, {}}, mesh).max_theta_error), 0.1);
}

TEST_F(MadePart, EqualsOnlyItself) {
  EXPECT_TRUE(all_ok(pipeline::same_mesh(*mesh_, *mesh_)));
  solid::TriangleMesh moved = *mesh_;
  moved.vertices[100].x() = std::nextafter(static_cast<float>(moved.vertices[100].x()), 1000.0F);
  EXPECT_FALSE(all_ok(pipeline::same_mesh(*mesh_, moved)));
  solid::TriangleMesh fewer = *mesh_;
  fewer.triangles.pop_back();
  EXPECT_FALSE(all_ok(pipeline::same_mesh(*mesh_, fewer)));
  EXPECT_FALSE(all_ok(pipeline::near_mesh(*mesh_, fewer, 0.01)));
}

TEST_F(MadePart, ToleratesReorderingAndRounding) {
  solid::TriangleMesh other = changed([](Vec3& v) { v = (v * 256.0).array().round() / 256.0; });
  std::reverse(other.triangles.begin(), other.triangles.end());
  EXPECT_TRUE(all_ok(pipeline::near_mesh(*mesh_, other, 0.01)));
  EXPECT_FALSE(all_ok(pipeline::near_mesh(*mesh_, other, 0.001)));
  other.vertices[7].z() += 0.5;
  EXPECT_FALSE(all_ok(pipeline::near_mesh(*mesh_, other, 0.01)));
}

}  // namespace
