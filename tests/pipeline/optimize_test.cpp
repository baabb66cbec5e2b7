// The verbs `optimize` and `analyze`: values and files.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "fusee/transmission.h"
#include "optimize/problem_text.h"
#include "support/mechanisms.h"

namespace {

using namespace fusee;
using ::testing::HasSubstr;
namespace joints = fusee::testing;
namespace fs = std::filesystem;

// ---- points and pins ------------------------------------------------------------------------------------------------

/// Largest T_b per newton over the stroke from which build() makes a pulley.
double tension_of_build(const Mechanism& mechanism) {
  Mechanism loaded = mechanism;
  loaded.load.tip_force = 1.0;
  double most = 0;
  for (const transmission::TransmissionPoint& point : profile::synthesise(mechanism).stroke)
    most = std::max(most, transmission::paper_forces(loaded, point).Tb);
  return most;
}

double tension_of_analyze(const Mechanism& mechanism) {
  MechanismFile file;
  file.mechanism = DeclaredMechanism(mechanism);
  file.mechanism.load.tip_force = 1.0;
  analysis::AnalysisOptions options;
  options.samples = 10;
  return pipeline::analyze(file, options).largest_paper_tension.value;
}

/// A pin of radius 0 is not a point: its tendon's centre line runs at half the tendon's diameter. Only method = "paper"
/// has points.
TEST(Pins, AreEqualInOptimizeAnalyzeAndBuild) {
  for (const double radius : {0.0, 2.0}) {
    for (const Method method : {Method::exact, Method::paper}) {
      Mechanism mechanism = joints::forearm();
      mechanism.guides.radius = radius;
      mechanism.pulley.method = method;
      EXPECT_EQ(mechanism.has_point_pins(), method == Method::paper);
      const double optimized = optimize::evaluate(optimize::Objective::max_tension, mechanism).value;
      EXPECT_NEAR(optimized, tension_of_build(mechanism), 1e-9) << radius;
      EXPECT_NEAR(optimized, tension_of_analyze(mechanism), 1e-9) << radius;
      EXPECT_DOUBLE_EQ(transmission::Transmission(mechanism).place(transmission::Side::right).rho,
                       mechanism.seen_pitch_radius());
    }
  }
}

// ---- the identified joint -------------------------------------------------------------------------------------------

class Optimize : public ::testing::Test {
 protected:
  Optimize() {
    std::string name = (fs::temp_directory_path() / "fusee-optimize-test-XXXXXX").string();
    scratch_ = ::mkdtemp(name.data());
    options_.genetic.population = 12;
    options_.genetic.generations = 3;
  }
  ~Optimize() override { fs::remove_all(scratch_); }

  MechanismFile file_with(const std::string& more, const std::vector<Setting>& settings = {}) const {
    const fs::path path = scratch_ / "joint.toml";
    write_file(path, joints::k_paper_problem + more, /*force=*/true);
    return read_mechanism(path, settings);
  }

  fs::path scratch_;
  pipeline::OptimizeOptions options_;
};

const std::string k_identified = "[identified]\nfriction = 0.1\nlength_mm = 4.0\n";

TEST_F(Optimize, UsesIdentifiedJoint) {
  const MechanismFile file = file_with(k_identified);
  const pipeline::OptimizeResult result = pipeline::optimize(file, options_);
  ASSERT_TRUE(result.found) << result.reason;
  const auto value = [](const Mechanism& mechanism) {
    return optimize::evaluate(optimize::Objective::max_tension, mechanism).value;
  };
  const DeclaredMechanism declared = optimize::mechanism_at(result.problem, result.design);
  EXPECT_DOUBLE_EQ(result.value, value(joint::identified_joint(declared).mechanism));
  EXPECT_DOUBLE_EQ(result.before.value, value(joint::identified_joint(file.mechanism).mechanism));
  EXPECT_GT(result.value, 1.02 * value(declared));
}

/// Bounds and results are declared numbers; identified effects are added to them.
TEST_F(Optimize, WritesDeclaredNumbers) {
  options_.new_file = scratch_ / "new.toml";
  const pipeline::OptimizeResult result = pipeline::optimize(file_with(k_identified), options_);
  const DeclaredMechanism written = read_mechanism(options_.new_file).mechanism;
  EXPECT_EQ(written.joint.R, result.design[0]);
  EXPECT_GE(written.joint.R, 100.0);
  EXPECT_EQ(written.identified.pins.friction, 0.1);
  EXPECT_EQ(written.guides.mu, 0.2);
  EXPECT_THAT(result.new_text, HasSubstr(k_identified));
}

TEST_F(Optimize, CertifiesObjectivesWithIntervalForm) {
  EXPECT_EQ(pipeline::optimize(file_with(k_identified), options_).method(), pipeline::SearchMethod::genetic);
  // Manufacturing errors of the pulley change no objective.
  EXPECT_EQ(
      pipeline::optimize(file_with("[identified]\nradius_offset_mm = 0.1\npulley_scale_percent = 1.0\n"), options_)
          .method(),
      pipeline::SearchMethod::certified);
  options_.method = pipeline::SearchMethod::certified;
  EXPECT_THROW(pipeline::optimize(file_with(k_identified), options_), InputError);
}

// ---- fronts ---------------------------------------------------------------------------------------------------------

class Front : public Optimize {
 protected:
  Front() { options_.front_folder = scratch_ / "front"; }

  pipeline::OptimizeResult front() const {
    return pipeline::optimize(file_with("", {{"optimize.objective", R"(["max_tension", "footprint"])"}}), options_);
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(options_.front_folder), fs::directory_iterator()));
  }
};

TEST_F(Front, FilesMatchItsPoints) {
  const pipeline::OptimizeResult result = front();
  const auto& points = std::get<optimize::ParetoResult>(result.search).front;
  ASSERT_GT(points.size(), 1u);
  ASSERT_EQ(result.front_files.size(), points.size());
  EXPECT_EQ(files(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const fs::path path = options_.front_folder / result.front_files[i].name;
    EXPECT_EQ(read_file(path, 1 << 20), result.front_files[i].bytes);
    EXPECT_NEAR(read_mechanism(path).mechanism.joint.R, points[i].design[0], 1e-9);
  }
  EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                          [&](const optimize::FrontPoint& point) { return point.design == result.design; }));
}

/// The second file cannot be written: the first must not remain either.
TEST_F(Front, LeavesNothingIfOneFileFails) {
  fs::create_directories(options_.front_folder);
  write_file(options_.front_folder / "point_002.toml", "mine", false);
  EXPECT_THROW(front(), OutputError);
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(read_file(options_.front_folder / "point_002.toml", 100), "mine");
}

TEST_F(Front, DryRunWritesNothing) {
  options_.dry_run = true;
  EXPECT_FALSE(front().published);
  EXPECT_FALSE(fs::exists(options_.front_folder));
}

// ---- analyze --------------------------------------------------------------------------------------------------------

TEST(Analyze, RejectsJointWithoutTendons) {
  MechanismFile file;
  file.mechanism.transmission = RatioTransmission{2.0};
  EXPECT_THROW(pipeline::analyze(file), InputError);
}

TEST(Analyze, UsesIdentifiedJoint) {
  MechanismFile file;
  file.mechanism = joints::forearm();
  file.mechanism.load.tip_force = 10.0;
  analysis::AnalysisOptions options;
  options.samples = 10;
  const double declared = pipeline::analyze(file, options).largest_paper_tension.value;
  file.mechanism.identified.pins.friction = 0.2;
  EXPECT_GT(pipeline::analyze(file, options).largest_paper_tension.value, 1.02 * declared);
}

// ---- several turns --------------------------------------------------------------------------------------------------

/// The smaller r1, the smaller the motor torque: over 110 degrees of a drum of 90 mm it determines the number of turns.
pipeline::OptimizeResult least_torque(const std::string& winding, const char* bend_ratio = "8") {
  const MechanismFile file = read_mechanism(fs::path(FUSEE_SOURCE_DIR) / "profiles" / "elbow_capstan.toml",
                                            {{"pulley.r1_mm", "35"},
                                             {"pulley.winding", winding},
                                             {"load.mass_kg", "0"},
                                             {"tendon.bend_ratio", bend_ratio},
                                             {"optimize.objective", "\"motor_torque\""},
                                             {"optimize.variables", "[\"pulley.r1_mm\"]"},
                                             {"optimize.lower", "[7]"},
                                             {"optimize.upper", "[45]"},
                                             {"optimize.feasible", "true"}});
  pipeline::OptimizeOptions options;
  options.method = pipeline::SearchMethod::genetic;
  options.genetic.population = 16;
  options.genetic.generations = 8;
  options.dry_run = true;
  return pipeline::optimize(file, options);
}

TEST(OptimizeTurns, FindsBuildablePulleys) {
  const pipeline::OptimizeResult one = least_torque("\"one_turn\""), several = least_torque("\"auto\"");
  ASSERT_TRUE(one.found) << one.reason;
  ASSERT_TRUE(several.found) << several.reason;
  // 110 degrees of 90 mm are 172.8 mm: a round pulley that winds them in one turn is larger than 27.5 mm.
  EXPECT_GT(one.design[0], 27.5);
  EXPECT_LT(several.design[0], 9.0);
  EXPECT_LT(several.value, 0.35 * one.value);

  MechanismFile found;
  found.path = "found.toml";
  found.mechanism = optimize::mechanism_at(several.problem, several.design);
  pipeline::BuildOptions options;
  options.folder = fs::temp_directory_path() / "fusee-optimize-turns";
  options.dry_run = true;
  const pipeline::BuildResult built = pipeline::build(found, options);
  ASSERT_EQ(built.status, pipeline::BuildStatus::done);
  ASSERT_TRUE(built.product.helix);
  EXPECT_GT(built.product.helix->synthesis.sides[0].turns, 3.0);
  EXPECT_LT(degrees(built.product.as_built.max_theta_error), 0.01);

  // The bend of the 0.6 mm tendon is the limit if it requires more than r1 ≥ 7 mm.
  const pipeline::OptimizeResult gentle = least_torque("\"auto\"", "40");
  ASSERT_TRUE(gentle.found) << gentle.reason;
  EXPECT_GT(gentle.design[0], 12.0);
  EXPECT_LT(gentle.design[0], 13.0);

  const auto warns_of_level_tendons = [](const pipeline::OptimizeResult& result) {
    return std::any_of(result.warnings.begin(), result.warnings.end(), [](const Diagnostic& warning) {
      return warning.message.find("level tendons") != std::string::npos;
    });
  };
  EXPECT_TRUE(warns_of_level_tendons(several));
  EXPECT_FALSE(warns_of_level_tendons(one));
}

}  // namespace
