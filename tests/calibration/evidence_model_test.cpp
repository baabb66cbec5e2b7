// Evidence of sets, compared with densities computed in full, and discrepancies.
#include "calibration/evidence_model.h"

#include <gmock/gmock.h>

#include <random>

#include "calibration/discrepancy_fit.h"
#include "calibration/linear_joint.h"
#include "calibration/thresholds.h"

namespace fusee::calibration::linear {
namespace {

/// Normal random numbers.
Eigen::VectorXd drawn(Eigen::Index count, std::mt19937& random, double standard_deviation = 1) {
  std::normal_distribution<double> normal(0.0, standard_deviation);
  return Eigen::VectorXd::NullaryExpr(count, [&](Eigen::Index) { return normal(random); });
}

/// Two families of three columns over `rows` rows. An amplitude is about the rms of its family, hence the √3.
calibration::Discrepancy two_families(Eigen::Index rows, std::mt19937& random) {
  calibration::Discrepancy discrepancy;
  discrepancy.columns.resize(rows, 6);
  for (Eigen::Index k = 0; k < 6; ++k) discrepancy.columns.col(k) = drawn(rows, random) / std::sqrt(3.0);
  discrepancy.families = {{calibration::Factor::place, 0, 3, 0}, {calibration::Factor::load, 3, 3, 0}};
  return discrepancy;
}

calibration::Tangent nothing_varied(const Eigen::VectorXd& residual) {
  calibration::Tangent tangent;
  tangent.residual = residual;
  tangent.J.resize(residual.size(), 0);
  tangent.caliper_information.resize(0, 0);
  return tangent;
}

/// log N(r; 0, σ² I + D λ² Dᵀ) without the factor 2π, plus the log of Cauchy's density at each λ, up to a constant.
double log_density(const Eigen::VectorXd& r, const calibration::Discrepancy& D,
                   const calibration::Amplitudes& amplitudes, double floor) {
  Eigen::MatrixXd C = amplitudes.noise * amplitudes.noise * Eigen::MatrixXd::Identity(r.size(), r.size());
  for (std::size_t f = 0; f < D.families.size(); ++f) {
    const Eigen::MatrixXd own = D.columns.middleCols(D.families[f].first, D.families[f].count);
    C += std::pow(amplitudes.families[static_cast<Eigen::Index>(f)], 2) * own * own.transpose();
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(C);
  const double usual = calibration::k_thresholds.usual_discrepancy * floor;
  const double prior = -(1.0 + (amplitudes.families / usual).array().square()).log().sum();
  return prior - 0.5 * r.dot(factor.solve(r)) - factor.matrixLLT().diagonal().array().log().sum();
}

TEST(EvidenceModel, EqualsFullDensity) {
  std::mt19937 random(1);
  const calibration::Discrepancy D = two_families(40, random);
  // The noise floor is 0.1, and all rows are independent (share 1).
  const calibration::EvidenceModel evidence_model(D, 0.1, 1.0);
  const calibration::Amplitudes one{Eigen::Vector2d(0.3, 0.0), 0.1}, other{Eigen::Vector2d(0.05, 0.4), 0.1};
  const Eigen::VectorXd r = drawn(40, random, 0.2);
  const double found =
      evidence_model.at(nothing_varied(r), one).log_evidence - evidence_model.at(nothing_varied(r), other).log_evidence;
  EXPECT_NEAR(found, log_density(r, D, one, 0.1) - log_density(r, D, other, 0.1), 1e-8);
}

TEST(EvidenceModel, IntegratesParameterOverItsPrior) {
  std::mt19937 random(2);
  const calibration::Discrepancy D = two_families(60, random);
  const calibration::EvidenceModel evidence_model(D, 0.1, 1.0);
  const calibration::Amplitudes amplitudes{Eigen::Vector2d(0.2, 0.1), 0.1};
  const Eigen::VectorXd slope = drawn(60, random);
  const Eigen::VectorXd r = 0.7 * slope + drawn(60, random, 0.1);
  calibration::Tangent tangent = nothing_varied(r);
  const double without = evidence_model.at(tangent, amplitudes).log_evidence;
  tangent.J = slope;
  tangent.x = tangent.caliper_gradient = Eigen::VectorXd::Zero(1);
  tangent.prior = Eigen::VectorXd::Constant(1, 0.5);
  tangent.caliper_information = Eigen::MatrixXd::Zero(1, 1);
  // The evidence is taken at the mode, where a fit ends.
  const double mode = evidence_model.at(tangent, amplitudes).step[0];
  tangent.x[0] = mode;
  tangent.residual -= mode * slope;
  const double found = evidence_model.at(tangent, amplitudes).log_evidence - without;
  double sum = 0;
  const double step = 1e-4, reference = log_density(r - mode * slope, D, amplitudes, 0.1);
  for (double x = mode - 0.5; x < mode + 0.5; x += step)
    sum += step * std::exp(log_density(r - x * slope, D, amplitudes, 0.1) + calibration::log_prior(x, 0.5) - reference);
  EXPECT_NEAR(found, std::log(sum) + reference - log_density(r, D, amplitudes, 0.1), 0.02);
}

TEST(EvidenceModel, SubsetOfColumnsEqualsSmallerTangent) {
  std::mt19937 random(4);
  const calibration::EvidenceModel evidence_model(two_families(60, random), 0.1, 1.0);
  const calibration::Amplitudes amplitudes{Eigen::Vector2d(0.2, 0.1), 0.1};
  calibration::Tangent all = nothing_varied(drawn(60, random, 0.2));
  all.J.resize(60, 4);
  for (Eigen::Index k = 0; k < 4; ++k) all.J.col(k) = drawn(60, random);
  calibration::add_numbers(Eigen::Vector4d(0.5, 1.0, std::numeric_limits<double>::infinity(), 2.0), all);
  all.x = Eigen::Vector4d(0.3, -0.1, 0.0, 0.2);
  all.caliper_information.diagonal().setConstant(3.0);
  all.caliper_gradient.setConstant(0.4);
  const std::vector<Eigen::Index> chosen = {0, 2};
  calibration::Tangent few = all;
  few.J = all.J(Eigen::all, chosen);
  few.x = all.x(chosen);
  few.prior = all.prior(chosen);
  few.caliper_information = all.caliper_information(chosen, chosen);
  few.caliper_gradient = all.caliper_gradient(chosen);
  const calibration::TangentSums sums = evidence_model.sums_of(all);
  const calibration::ReducedTangent reduced =
      evidence_model.reduced(sums, evidence_model.sized(amplitudes, all.deflection_ratio));
  EXPECT_NEAR(calibration::log_evidence_of(reduced, chosen), evidence_model.at(few, amplitudes).log_evidence, 1e-9);
}

TEST(EvidenceModel, FindsAmplitudesAndDropsAbsentFamilies) {
  std::mt19937 random(3);
  const Eigen::Index rows = 400, count = 40;
  calibration::Discrepancy D;
  D.columns.resize(rows, 2 * count);
  for (Eigen::Index k = 0; k < 2 * count; ++k)
    D.columns.col(k) = drawn(rows, random) / std::sqrt(static_cast<double>(count));
  D.families = {{calibration::Factor::place, 0, count, 0}, {calibration::Factor::load, count, count, 0}};
  const calibration::EvidenceModel evidence_model(D, 0.1, 1.0);
  const Eigen::VectorXd r = D.columns.leftCols(count) * drawn(count, random, 0.5) + drawn(rows, random, 0.1);
  const calibration::Posterior found = evidence_model.best(nothing_varied(r), evidence_model.first_guess(), 40);
  EXPECT_NEAR(found.amplitudes.families[0], 0.5, 0.15);
  EXPECT_LT(found.amplitudes.families[1], 0.05);
  EXPECT_NEAR(found.amplitudes.noise, 0.1, 0.01);
}

// The penalty of a discrepancy grows up to the prior odds of an effect, at an rms of one noise floor. The model's own
// error, a fixed family, has no penalty.
TEST(EvidenceModel, PenalizesDiscrepancyUpToOneFloor) {
  std::mt19937 random(5);
  calibration::Discrepancy D = two_families(50, random);
  D.families[1].fixed = 0.3;
  const calibration::EvidenceModel evidence_model(D, 0.1, 1.0);
  calibration::Posterior posterior;
  posterior.coefficients = drawn(6, random);
  const Eigen::VectorXd deflection = D.columns.leftCols(3) * posterior.coefficients.head(3);
  const double rms = std::sqrt(deflection.squaredNorm() / 50.0);
  for (const double floors : {0.0, 0.3, 0.99, 1.01, 7.0}) {
    calibration::Posterior sized = posterior;
    sized.coefficients.head(3) *= floors * 0.1 / rms;
    EXPECT_NEAR(evidence_model.discrepancy_penalty(sized),
                calibration::k_thresholds.neg_log_prior_odds * std::min(1.0, floors * floors), 1e-9);
  }
}

TEST(EvidenceModel, IntervalsHaveStatedCoverage) {
  std::mt19937 random(4);
  const calibration::Discrepancy D = two_families(60, random);
  const calibration::EvidenceModel evidence_model(D, 0.1, 1.0);
  const calibration::Amplitudes amplitudes{Eigen::Vector2d(0.2, 0.3), 0.1};
  calibration::Tangent tangent = nothing_varied(Eigen::VectorXd::Zero(60));
  tangent.J = drawn(60, random);
  tangent.x = tangent.caliper_gradient = Eigen::VectorXd::Zero(1);
  tangent.prior = Eigen::VectorXd::Constant(1, 100.0);
  tangent.caliper_information = Eigen::MatrixXd::Zero(1, 1);
  constexpr int trials = 2000;
  int covered = 0;
  for (int i = 0; i < trials; ++i) {
    tangent.residual = 0.4 * tangent.J + D.columns.leftCols(3) * drawn(3, random, 0.2) +
                       D.columns.rightCols(3) * drawn(3, random, 0.3) + drawn(60, random, 0.1);
    const calibration::Posterior found = evidence_model.at(tangent, amplitudes);
    covered += std::abs(found.step[0] - 0.4) <= 1.96 * std::sqrt(found.covariance(0, 0)) ? 1 : 0;
  }
  EXPECT_NEAR(covered / static_cast<double>(trials), 0.95, 0.02);
}

TEST(EvidenceModel, PriorIsDensityWithHeavyTails) {
  double sum = 0;
  for (double x = -2000; x < 2000; x += 0.01) sum += 0.01 * std::exp(calibration::log_prior(x, 1.0));
  EXPECT_NEAR(sum, 1, 1e-3);
  EXPECT_LT(calibration::log_prior(12, 1.0), calibration::log_prior(0, 1.0) - 5);
  EXPECT_GT(calibration::log_prior(12, 1.0), calibration::log_prior(0, 1.0) - 72);  // 72: the penalty of a normal prior
}

TEST(DiscrepancyFit, WaveOfMotorShaftHasItsOrder) {
  measurement::Measurement measurement;
  measurement.load_unit = "N";
  measurement.runs = {run_of("one", 0, 12), run_of("two", 5, 12)};
  auto noise = white_noise(k_floor, 5);
  for (fusee::measurement::Run& run : measurement.runs) {
    for (measurement::Sample& sample : run.samples)
      sample.theta += 4 * k_floor * std::sin(21 * sample.alpha) + noise(sample);
  }
  const calibration::Evidence evidence = evidence_of(measurement);
  joint::Forward forward(joint(), evidence.log);
  const calibration::DiscrepancyFit found =
      calibration::describe_discrepancy(evidence, calibration::Fitter(evidence, forward).fit({}, {}));
  EXPECT_TRUE(calibration::is_unexplained(found, k_floor));
  const auto wave = std::find_if(found.parts.begin(), found.parts.end(),
                                 [](const calibration::DiscrepancyComponent& part) { return part.order > 0; });
  ASSERT_NE(wave, found.parts.end());
  EXPECT_EQ(wave->factor, "motor harmonic");
  EXPECT_NEAR(wave->order, 21, 0.8);
  EXPECT_NEAR(wave->rms, 4 * k_floor / std::sqrt(2.0), 0.5 * k_floor);
  EXPECT_THAT(wave->words, testing::HasSubstr("of the motor's shaft"));
}

TEST(DiscrepancyFit, NoiseIsNotDescribed) {
  const calibration::Evidence evidence = evidence_of(measured({0, 5}, white_noise(k_floor, 6)));
  joint::Forward forward(joint(), evidence.log);
  const calibration::DiscrepancyFit found =
      calibration::describe_discrepancy(evidence, calibration::Fitter(evidence, forward).fit({}, {}));
  EXPECT_FALSE(calibration::is_unexplained(found, k_floor));
  EXPECT_TRUE(found.parts.empty());
}

}  // namespace
}  // namespace fusee::calibration::linear
