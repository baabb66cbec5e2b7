// Files and logs with errors, of faultless joints. The data are from a rig that shares no code with the fit.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/calibration.h"
#include "fusee/mechanism_file.h"
#include "fusee/transmission.h"
#include "rig/random.h"
#include "rig/truths.h"

namespace fusee::calibration {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Reads the logs as those of a bench.
measurement::Measurement logged(const std::vector<rig::Log>& logs) {
  measurement::Measurement measurement;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const std::string name = "run_" + std::to_string(i + 1) + ".csv";
    measurement.runs.push_back(measurement::parse_run(rig::csv_text(logs[i]), name, {}, measurement));
  }
  return measurement;
}

struct Bench {
  DeclaredMechanism joint;  ///< without input errors, until a test makes one
  measurement::Measurement data;
};

Bench random_bench(std::uint64_t seed) {
  rig::Random random(seed);
  const rig::MadeJoint joint = rig::random_joint(random);
  return {joint.declared, logged(rig::log_runs(joint, {}, rig::full_protocol(0.05 * joint.declared.joint.R)))};
}

/// Random unsymmetric joints of the rig: one with law = "compensate", one with law = "linear".
const Bench& compensating() {
  static const Bench bench = random_bench(3 * 7919);
  return bench;
}
const Bench& linear() {
  static const Bench bench = random_bench(6 * 7919);
  return bench;
}

/// Data of another rig.
Bench rig_data(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/data/rig" / name;
  std::vector<std::filesystem::path> runs;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".csv") runs.push_back(entry.path());
  }
  std::sort(runs.begin(), runs.end());
  return {read_mechanism(folder / "spec.toml").mechanism, measurement::read_measurement(runs)};
}

std::vector<std::string> words(const std::vector<LikelyInputError>& errors) {
  std::vector<std::string> all;
  for (const LikelyInputError& error : errors) all.push_back(input_error_words(error));
  return all;
}

Calibration calibrated(const DeclaredMechanism& file, measurement::Measurement data, bool search_effects = true) {
  measurement::compare_with_declared(file, data);
  CalibrationOptions options;
  options.search_effects = search_effects;
  return calibrate(file, data, options);
}

/// Rms over all rows with nothing fitted, rad. As in the test of a hypothesis, no rows are left out.
double residual_of(const DeclaredMechanism& file, const measurement::Measurement& data) {
  return calibrated(file, data, false).before.rms;
}

/// Input errors after calibrate(), which searches no effects if an error is obvious, as the program does.
std::vector<LikelyInputError> errors_of(const DeclaredMechanism& file, const measurement::Measurement& data) {
  return find_input_errors(file, data, calibrated(file, data, !is_input_error_obvious(file, data)));
}

std::vector<std::string> error_words(const DeclaredMechanism& file, const measurement::Measurement& data) {
  return words(errors_of(file, data));
}

/// Input errors of a calibration that explains nothing, without its minute of search.
std::vector<std::string> error_words_if_unexplained(const DeclaredMechanism& file,
                                                    const measurement::Measurement& data) {
  Calibration found;
  found.verdict = CalibrationVerdict::unexplained;
  found.before = {radians(5.0), radians(10.0), radians(5.0)};
  found.after = {radians(0.5), radians(1.0), radians(0.5)};
  return words(find_input_errors(file, data, found));
}

// ---- one error after another ----------------------------------------------------------------------------------------

struct InputErrorCase {
  const char* name;
  void (*file)(DeclaredMechanism&);
  const char* words;
};

const InputErrorCase k_file_errors[] = {
    {"OE", [](DeclaredMechanism& m) { m.guides.OE *= -1; }, "guides.OE_mm = -"},
    {"exchanged", [](DeclaredMechanism& m) { std::swap(m.guides.EB, m.guides.ED); }, "guides.EB_mm, guides.ED_mm = "},
    {"R", [](DeclaredMechanism& m) { m.joint.R /= 10; }, "joint.length_mm = "},
    {"EB", [](DeclaredMechanism& m) { m.guides.EB /= 10; }, "guides.EB_mm = "},
    {"r1", [](DeclaredMechanism& m) { m.pulley.r1 *= 10; }, "pulley.r1_mm = "},
    {"modulus", [](DeclaredMechanism& m) { m.tendon.modulus /= 1000; }, "tendon.modulus_MPa = "},
    {"range",
     [](DeclaredMechanism& m) {
       m.joint.theta_min = radians(m.joint.theta_min);
       m.joint.theta_max = radians(m.joint.theta_max);
     },
     "joint.range_deg = "},
};

TEST(InputErrors, ReportKeyAndCorrectValue) {
  const Bench& bench = compensating();
  for (const InputErrorCase& error : k_file_errors) {
    DeclaredMechanism file = bench.joint;
    error.file(file);
    EXPECT_THAT(error_words_if_unexplained(file, bench.data),
                ElementsAre(AllOf(HasSubstr(error.words), HasSubstr("to 0.02°"))))
        << error.name;
  }
}

TEST(InputErrors, ReportInvertedRatio) {
  const Bench& bench = linear();
  ASSERT_EQ(bench.joint.pulley.law, Law::linear);
  DeclaredMechanism file = bench.joint;
  file.pulley.ratio = 1.0 / file.pulley.ratio;
  EXPECT_THAT(error_words(file, bench.data),
              ElementsAre(AllOf(HasSubstr("pulley.ratio = "), HasSubstr("alpha per theta?"))));
}

/// The data with other signs or in another unit.
measurement::Measurement times(measurement::Measurement data, double alpha, double theta) {
  for (measurement::Run& run : data.runs) {
    for (measurement::Sample& sample : run.samples) {
      sample.alpha *= alpha;
      sample.theta *= theta;
    }
    for (measurement::Stroke& stroke : run.strokes) stroke.direction *= alpha < 0 ? -1 : 1;
  }
  return data;
}

TEST(InputErrors, ReportAngleOfLog) {
  const Bench& bench = compensating();
  const auto logged_times = [&](double alpha, double theta) {
    return error_words_if_unexplained(bench.joint, times(bench.data, alpha, theta));
  };
  EXPECT_THAT(logged_times(1, -1), ElementsAre(HasSubstr("the logged theta times -1")));
  EXPECT_THAT(logged_times(-1, 1), ElementsAre(HasSubstr("the logged alpha times -1")));
  EXPECT_THAT(logged_times(-1, -1), ElementsAre(HasSubstr("the logged alpha and theta times -1")));
  EXPECT_THAT(logged_times(1, radians(1)), ElementsAre(HasSubstr("the logged theta times 57.296")));
}

TEST(InputErrors, ConsiderPulleyMadeFromWrongFile) {
  const Bench& bench = linear();
  DeclaredMechanism file = bench.joint;
  file.guides.OE *= -1;
  rig::MadeJoint mounted = rig::make_joint(file);
  mounted.declared = bench.joint;
  const measurement::Measurement data = logged(rig::log_runs(mounted, {}, rig::full_protocol(0.05 * file.joint.R)));
  EXPECT_THAT(error_words_if_unexplained(file, data),
              ElementsAre(AllOf(HasSubstr("guides.OE_mm = -52.7 in place of 52.7"),
                                HasSubstr("the pulley that was made from this file"))));
}

// ---- conditions of the runs -----------------------------------------------------------------------------------------

/// Runs in which nothing hung on the joint, without their load column.
measurement::Measurement unloaded_runs(const Bench& bench) {
  measurement::Measurement data = bench.data;
  std::erase_if(data.runs, [](const measurement::Run& run) { return std::abs(run.mean_load) > 1e-6; });
  for (measurement::Run& run : data.runs) run.has_load = false;
  data.load_unit.clear();
  return data;
}

TEST(InputErrors, ReportThatNothingHungOnJoint) {
  Bench bench = compensating();
  bench.joint.load.tip_force = 0.5 * bench.joint.joint.R;
  bench.joint.load.torque = 10;
  bench.joint.load.mass_kg = 0;
  const measurement::Measurement data = unloaded_runs(bench);
  ASSERT_FALSE(data.runs.empty());
  const std::vector<LikelyInputError> errors = errors_of(bench.joint, data);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].key, "load.tip_force_N, load.torque_Nmm");
  EXPECT_EQ(errors[0].would_be, (std::vector<double>{0, 0}));
  EXPECT_THAT(errors[0].remedy, HasSubstr("--set load.tip_force_N=0 --set load.torque_Nmm=0"));
  EXPECT_LT(errors[0].rms, 1.1 * measurement::noise_floor(data).rms);
}

TEST(InputErrors, LeaveLoggedLoadAsItIs) {
  Bench bench = compensating();
  bench.joint.load.tip_force = 0.5 * bench.joint.joint.R;
  EXPECT_THAT(error_words(bench.joint, bench.data), IsEmpty());
}

/// The data of sensors whose zeros are at these angles, rad.
measurement::Measurement with_zeros_at(measurement::Measurement data, double alpha, double theta) {
  for (measurement::Run& run : data.runs) {
    for (measurement::Sample& sample : run.samples) {
      sample.alpha -= alpha;
      sample.theta -= theta;
    }
  }
  return data;
}

TEST(InputErrors, ReportBothZerosAtAnEnd) {
  const Bench bench = rig_data("a_declared_right");
  const transmission::Transmission law(bench.joint);
  for (const auto& [theta, end] :
       {std::pair(bench.joint.joint.theta_min, "lower"), std::pair(bench.joint.joint.theta_max, "upper")}) {
    const double alpha = law.alpha(theta);
    const std::vector<LikelyInputError> errors = errors_of(bench.joint, with_zeros_at(bench.data, alpha, theta));
    ASSERT_EQ(errors.size(), 1u) << end;
    ASSERT_EQ(errors[0].would_be.size(), 2u) << end;
    EXPECT_NEAR(errors[0].would_be[0], -degrees(alpha), 0.2) << end;
    EXPECT_NEAR(errors[0].would_be[1], -degrees(theta), 0.2) << end;
    EXPECT_THAT(errors[0].question, HasSubstr(end));
    EXPECT_THAT(errors[0].remedy, HasSubstr("--home-reading alpha=" + rounded(errors[0].would_be[0], 4) +
                                            " --home-reading theta=" + rounded(errors[0].would_be[1], 4)));
    EXPECT_LT(errors[0].rms, 1.5 * measurement::noise_floor(bench.data).rms) << end;
  }
}

// Beyond the range of zero_offset and motor_offset.
TEST(InputErrors, ReportBothZerosAnywhere) {
  const Bench bench = rig_data("a_declared_right");
  const transmission::Transmission law(bench.joint);
  const double theta = 0.6 * bench.joint.joint.theta_max, alpha = law.alpha(theta);
  const std::vector<LikelyInputError> errors = errors_of(bench.joint, with_zeros_at(bench.data, alpha, theta));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].question, "is that what the sensors read at home?");
  EXPECT_NEAR(errors[0].would_be[0], -degrees(alpha), 0.2);
}

// ---- the whole way --------------------------------------------------------------------------------------------------

// The search for effects runs although the error is obvious.
TEST(InputErrors, AreReportedIfNoEffectExplainsData) {
  Bench bench = rig_data("a_declared_right");
  bench.joint.guides.OE *= -1;
  const Calibration found = calibrated(bench.joint, bench.data);
  ASSERT_EQ(found.verdict, CalibrationVerdict::unexplained);
  const std::vector<LikelyInputError> errors = find_input_errors(bench.joint, bench.data, found);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].key, "guides.OE_mm");
  EXPECT_THAT(errors[0].declared, ElementsAre(14.0));
  EXPECT_THAT(errors[0].would_be, ElementsAre(-14.0));
  const double residual = residual_of(rig_data("a_declared_right").joint, bench.data);
  EXPECT_NEAR(errors[0].rms, residual, 0.1 * residual);
  EXPECT_LT(errors[0].rms, 1.1 * found.noise.rms);
  EXPECT_EQ(input_error_words(errors[0]), "guides.OE_mm = -14 in place of 14 would explain the data to " +
                                              rounded(degrees(errors[0].rms), 2) + "°: is the sign right?");
}

TEST(InputErrors, AreFoundBeforeAnySearchIfObvious) {
  // The error alone, with a fault beside it, with an unmodelled cause.
  for (const char* name : {"a_declared_right", "b_stretch", "f_not_in_any_catalogue"}) {
    Bench bench = rig_data(name);
    EXPECT_FALSE(is_input_error_obvious(bench.joint, bench.data)) << name;
    bench.joint.guides.OE *= -1;
    EXPECT_TRUE(is_input_error_obvious(bench.joint, bench.data)) << name;
    const Calibration found = calibrated(bench.joint, bench.data, false);
    EXPECT_EQ(found.verdict, CalibrationVerdict::unexplained);
    EXPECT_THAT(found.effects, IsEmpty());
    EXPECT_THAT(words(find_input_errors(bench.joint, bench.data, found)),
                ElementsAre(HasSubstr("guides.OE_mm = -14 in place of 14")))
        << name;
  }
}

TEST(InputErrors, AreReportedForRefusedData) {
  Bench bench = rig_data("a_declared_right");
  bench.joint.guides.EB /= 10;
  EXPECT_EQ(calibrated(bench.joint, bench.data).verdict, CalibrationVerdict::not_testable);
  EXPECT_THAT(error_words(bench.joint, bench.data), ElementsAre(HasSubstr("guides.EB_mm = 18 in place of 1.8")));
}

TEST(InputErrors, AllowEffectBesideThem) {
  Bench bench = rig_data("b_stretch");
  bench.joint.guides.OE *= -1;
  EXPECT_THAT(error_words(bench.joint, bench.data), ElementsAre(HasSubstr("with tendon_stretch beside it")));
}

TEST(InputErrors, AllowUnmodelledCauseBesideThem) {
  Bench bench = rig_data("f_not_in_any_catalogue");
  const double residual = residual_of(bench.joint, bench.data);
  bench.joint.guides.OE *= -1;
  const std::vector<LikelyInputError> errors = errors_of(bench.joint, bench.data);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].key, "guides.OE_mm");
  EXPECT_THAT(errors[0].beside, IsEmpty());
  EXPECT_NEAR(errors[0].rms, residual, 0.1 * residual);
}

TEST(InputErrors, AreReportedBeforeImplausiblyLargeEffects) {
  const Bench& bench = compensating();
  DeclaredMechanism file = bench.joint;
  std::swap(file.guides.EB, file.guides.ED);
  Calibration found;
  found.verdict = CalibrationVerdict::explained;
  found.noise.rms = found.after.held_out_rms = radians(0.02);
  found.before.held_out_rms = radians(1.0);
  EXPECT_THAT(words(find_input_errors(file, bench.data, found)), ElementsAre(HasSubstr("are the two exchanged?")));
  found.before.held_out_rms = radians(0.2);  // as large as any effect
  EXPECT_THAT(find_input_errors(file, bench.data, found), IsEmpty());
}

// ---- where they must not be reported --------------------------------------------------------------------------------

TEST(InputErrors, AreNotReportedForCorrectFile) {
  for (const char* name : {"a_declared_right", "b_stretch", "c_backlash", "d_guide_radius", "e_one_sweep_only",
                           "f_not_in_any_catalogue"}) {
    const Bench bench = rig_data(name);
    EXPECT_THAT(error_words(bench.joint, bench.data), IsEmpty()) << name;
  }
}

// No row of the 40 reports one with seeds 1 and 2 (46 s a seed). These two have the largest unexplained residual.
TEST(InputErrors, AreNotReportedBesideUnmodelledCause) {
  for (const char* fault : {"lump", "motor_cogging"}) {
    const rig::Case made = rig::make_case({fault, {fault}}, 1);
    const measurement::Measurement data = logged(made.logs);
    const Calibration found = calibrated(made.joint.declared, data);
    EXPECT_EQ(found.verdict, CalibrationVerdict::unexplained) << fault;
    EXPECT_THAT(find_input_errors(made.joint.declared, data, found), IsEmpty()) << fault;
  }
}

TEST(InputErrors, AreNotSearchedInUntestableData) {
  Bench bench = rig_data("a_declared_right");
  bench.joint.guides.OE *= -1;
  bench.data.not_testable = {"one direction"};
  EXPECT_THAT(error_words(bench.joint, bench.data), IsEmpty());
}

}  // namespace
}  // namespace fusee::calibration
