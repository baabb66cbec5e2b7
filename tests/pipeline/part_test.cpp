// Rewinding what is right gives the declared law; what was broken on purpose is found out.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "fusee/pipeline.h"
#include "pipeline/agreement.h"

namespace {

using namespace fusee;

class MadePart : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    mechanism_ =
        new Mechanism(read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles/forearm.toml").mechanism);
    synthesis_ = new SynthesisResult(synthesise(*mechanism_));
    mesh_ = new TriangleMesh(make_pulley(*mechanism_, *synthesis_).mesh);
  }
  static void TearDownTestSuite() {
    delete mechanism_;
    delete synthesis_;
    delete mesh_;
  }

  template <typename Change>
  static TriangleMesh changed(Change change) {
    TriangleMesh mesh = *mesh_;
    for (Vec3& vertex : mesh.vertices) change(vertex);
    return mesh;
  }
  /// The names of what fails when tendons are wound on it.
  static std::vector<std::string> failures(const Part& part) {
    std::vector<std::string> names;
    for (const Check& check : as_built_checks(*mechanism_, rewind_part({*mechanism_, {}}, part), {})) {
      if (!check.ok) names.push_back(check.name);
    }
    return names;
  }
  static DrawingPath path(const std::string& layer, const Outline& outline, double distance) {
    return {layer, "LWPOLYLINE", 1, true, parallel(outline, distance)};
  }

  static Mechanism* mechanism_;
  static SynthesisResult* synthesis_;
  static TriangleMesh* mesh_;
};
Mechanism* MadePart::mechanism_ = nullptr;
SynthesisResult* MadePart::synthesis_ = nullptr;
TriangleMesh* MadePart::mesh_ = nullptr;

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST_F(MadePart, AsMadePasses) { EXPECT_THAT(failures(*mesh_), IsEmpty()); }

TEST_F(MadePart, InsideOutGivesTheSameAngles) {
  TriangleMesh mesh = *mesh_;
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_NEAR(rewind_part({*mechanism_, {}}, mesh).max_theta_error, rewind_part({*mechanism_, {}}, *mesh_).max_theta_error, 1e-9);
}

TEST_F(MadePart, PrintedTooSmallGivesWrongAngles) {
  EXPECT_THAT(failures(changed([](Vec3& v) { v.head<2>() *= 0.995; })), Contains("theta_error"));
}

TEST_F(MadePart, BoredOffCentreGivesWrongAnglesAndSlack) {
  EXPECT_THAT(failures(changed([](Vec3& v) { v.x() += 0.2; })), ElementsAre("theta_error", "slack"));
}

TEST_F(MadePart, MirroredIsFoundOut) {
  EXPECT_THAT(failures(changed([](Vec3& v) { v.x() = -v.x(); })), Contains("slack"));
}

TEST_F(MadePart, TurnedOnItsShaftLeavesSlack) {
  // The profile meets the tendons at the wrong place.
  const double c = std::cos(radians(5.0)), s = std::sin(radians(5.0));
  EXPECT_THAT(failures(changed([&](Vec3& v) { v.head<2>() = Vec2(c * v.x() - s * v.y(), s * v.x() + c * v.y()); })),
              Contains("slack"));
}

TEST_F(MadePart, WithoutGroovesIsBadInput) {
  EXPECT_THROW(rewind_part({*mechanism_, {}}, changed([](Vec3& v) { v.z() += 1000; })), InputError);
  EXPECT_THROW(rewind_part({*mechanism_, {}}, TriangleMesh()), InputError);
}

TEST_F(MadePart, AsADrawingOfFloorsOrOfPitchCurvesGivesTheSameAngles) {
  const double floor = -0.5 * mechanism_->tendon.diameter;
  Drawing floors, pitches;
  floors.paths = {path("P1_FLOOR", synthesis_->p1, floor), path("P2_FLOOR", synthesis_->p2, floor)};
  pitches.paths = {path("P1_PITCH", synthesis_->p1, 0), path("P2_PITCH", synthesis_->p2, 0)};
  const RewindResult by_floors = rewind_part({*mechanism_, {}}, floors), by_pitches = rewind_part({*mechanism_, {}}, pitches);
  EXPECT_LT(degrees(by_floors.max_theta_error), 0.005);
  // The tolerance of the polygons: 0.01 mm of tendon is 0.01° here.
  EXPECT_NEAR(degrees(by_floors.max_theta_error), degrees(by_pitches.max_theta_error), 0.005);
  std::swap(floors.paths[0].layer, floors.paths[1].layer);
  EXPECT_THAT(failures(floors), Contains("slack"));
}

TEST_F(MadePart, AsADrawingWithoutLayersIsBadInput) {
  Drawing drawing;
  drawing.paths = {path("P1_FLOOR", synthesis_->p1, 0)};
  EXPECT_THROW(rewind_part({*mechanism_, {}}, drawing), InputError);
}

TEST_F(MadePart, LargerForShrinkageIsWoundAtItsShrunkSize) {
  Mechanism shrinking = *mechanism_;
  shrinking.material.shrinkage = 0.02;
  const TriangleMesh mesh = make_pulley(shrinking, synthesise(shrinking)).mesh;
  EXPECT_LT(degrees(rewind_part({shrinking, {}}, mesh).max_theta_error), 0.005);
  EXPECT_GT(degrees(rewind_part({*mechanism_, {}}, mesh).max_theta_error), 0.1);
}

bool agree(const std::vector<Check>& checks) { return all_ok(checks); }

TEST_F(MadePart, AgreesWithItselfAlone) {
  EXPECT_TRUE(agree(same_mesh(*mesh_, *mesh_)));
  TriangleMesh moved = *mesh_;
  moved.vertices[100].x() = std::nextafter(static_cast<float>(moved.vertices[100].x()), 1000.0F);
  EXPECT_FALSE(agree(same_mesh(*mesh_, moved)));
  TriangleMesh fewer = *mesh_;
  fewer.triangles.pop_back();
  EXPECT_FALSE(agree(same_mesh(*mesh_, fewer)));
  EXPECT_FALSE(agree(near_mesh(*mesh_, fewer, 0.01)));
}

TEST_F(MadePart, IsNearWhatIsReorderedAndRounded) {
  TriangleMesh other = changed([](Vec3& v) { v = (v * 256.0).array().round() / 256.0; });
  std::reverse(other.triangles.begin(), other.triangles.end());
  EXPECT_TRUE(agree(near_mesh(*mesh_, other, 0.01)));
  EXPECT_FALSE(agree(near_mesh(*mesh_, other, 0.001)));
  other.vertices[7].z() += 0.5;
  EXPECT_FALSE(agree(near_mesh(*mesh_, other, 0.01)));
}

}  // namespace
