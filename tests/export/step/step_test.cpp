// pulley.step, if this fusee can write it. FreeCAD checks it in tests/oracle/judge_step.py.
#include "export/step/step.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "export/step/step_build.h"
#include "fusee/base.h"
#include "fusee/pipeline.h"
#include "pipeline/design.h"
#include "pipeline/multi_turn.h"

namespace fusee::formats {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

Product designed(const std::string& profile, const std::vector<Setting>& settings = {}) {
  Product product;
  product.file = read_mechanism(fs::path(FUSEE_SOURCE_DIR) / "profiles" / (profile + ".toml"), settings);
  product.joint = joint::identified_joint(product.file.mechanism);
  pipeline::design(product, 0.01, {}, solid::TieOffSearch::brief);
  return product;
}

const Product& small() {
  static const Product product = designed("finger_mcp");
  return product;
}

/// The file of `small`, written once.
const StepFile& small_file() {
  static const StepFile file = step_file(small());
  return file;
}

class Step : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const auto why = step_missing()) GTEST_SKIP() << *why;
    path_ = fs::temp_directory_path() / ("fusee-step-test-" + std::to_string(::getpid()) + ".step");
  }
  void TearDown() override { fs::remove(path_); }

  std::vector<Check> checks_of(const std::string& bytes) {
    write_file(path_, bytes, true);
    return inspect_step(path_, small(), 0.01).checks;
  }

  fs::path path_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST_F(Step, IsOneSolidThatPassesItsChecks) {
  ASSERT_EQ(small_file().complaint, "");
  for (const Check& check : checks_of(small_file().bytes))
    EXPECT_TRUE(check.ok) << check.name << " " << check.value << " " << check.limit;
  EXPECT_THAT(small_file().bytes, HasSubstr("FILE_NAME('pulley.step','1970-01-01T00:00:00'"));
}

TEST_F(Step, DetectsMissingFace) {
  const std::string& bytes = small_file().bytes;
  const std::size_t shell = bytes.find("CLOSED_SHELL('',(") + 17, end = bytes.find(',', shell);
  std::string broken = bytes;
  broken.erase(shell, end - shell + 1);
  EXPECT_FALSE(all_ok(checks_of(broken)));
}

TEST_F(Step, RejectsOtherUnits) {
  // A file in metres, too large for a fine mesh.
  EXPECT_FALSE(all_ok(checks_of(replaced(small_file().bytes, ".MILLI.", "$"))));
  EXPECT_THAT(checks_of(replaced(small_file().bytes, ".MILLI.", ".CENTI.")),
              Contains(::testing::AllOf(Field(&Check::name, "floor_error"), Field(&Check::ok, false))));
}

TEST_F(Step, NoStepIsNoSolid) {
  EXPECT_THAT(checks_of("ISO-10303-21;\n"),
              Contains(::testing::AllOf(Field(&Check::name, "solids"), Field(&Check::ok, false))));
}

/// A multi-turn product.
const Product& helical() {
  static const Product product = [] {
    Product made;
    made.file = read_mechanism(fs::path(FUSEE_SOURCE_DIR) / "profiles" / "wrist_turns.toml",
                               {{"pulley.ratio", "5.5"}, {"body.spare_turns", "0.5"}});
    made.joint = joint::identified_joint(made.file.mechanism);
    pipeline::design_multi_turn(made, 0.02, {});
    return made;
  }();
  return product;
}

class HelicalStep : public Step {
 protected:
  static const StepFile& file() {
    static const StepFile made = step_file(helical());
    return made;
  }
  StepInspection inspect(const std::string& bytes) {
    write_file(path_, bytes, true);
    return inspect_step(path_, helical(), 0.02);
  }
};

TEST_F(HelicalStep, IsSoundSolidAndWinds) {
  ASSERT_TRUE(helical().pulley.made());
  ASSERT_EQ(file().complaint, "");
  const StepInspection inspection = inspect(file().bytes);
  for (const Check& check : inspection.checks) EXPECT_TRUE(check.ok) << check.name << " " << check.value;
  const helical_solid::HelicalRewind wound = pipeline::rewind_multi_turn(helical(), inspection.helical);
  // Measured on the surfaces themselves: the error is far below that of facets.
  EXPECT_LT(degrees(wound.result.max_theta_error), 0.002);
  EXPECT_LT(wound.result.max_excess, 0.001);
}

TEST_F(HelicalStep, DetectsFloorsOfAnotherTendon) {
  write_file(path_, file().bytes, true);
  Product other = helical();
  other.joint.mechanism.tendon.diameter += 0.001;  // mm; the floor moves by half of it, five times the limit
  EXPECT_THAT(inspect_step(path_, other, 0.02).checks,
              Contains(::testing::AllOf(Field(&Check::name, "floor_error"), Field(&Check::ok, false))));
}

TEST_F(HelicalStep, DetectsMissingFace) {
  std::string broken = file().bytes;
  const std::size_t shell = broken.find("CLOSED_SHELL('',(") + 17, end = broken.find(',', shell);
  broken.erase(shell, end - shell + 1);
  EXPECT_FALSE(all_ok(inspect(broken).checks));
}

/// P1 of the paper's law is round about the axis: its rows are circles. P2's are splines.
TEST(StepPart, RoundGrooveHasCircles) {
  const StepPart part = step_part(designed("paper_optimum", {{"body.marks", "none"}}));
  int circles = 0, splines = 0;
  for (const StepRow& row : part.rows) (row.radius > 0 ? circles : splines) += 1;
  EXPECT_GE(circles, 5);
  EXPECT_GE(splines, 5);
  EXPECT_EQ(part.bands.size() + 1, part.rows.size());
}

TEST(StepPart, RejectsTooLargePartsEarly) {
  Product product = small();
  for (profile::Outline* outline : {&product.synthesis.p1, &product.synthesis.p2}) {
    for (profile::OutlinePoint& point : outline->points) point.position *= 100;
  }
  try {
    step_part(product);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("too large for STEP"));
  }
}

}  // namespace
}  // namespace fusee::formats
