// Normal equations, held-out errors, fits and intervals against least squares done another way.
#include <gmock/gmock.h>

#include "calibration/explanation.h"
#include "calibration/intervals.h"
#include "calibration/linear_joint.h"
#include "calibration/thresholds.h"
#include "calibration/validation.h"
#include "fusee/base.h"

namespace fusee::calibration::linear {
namespace {

/// Slopes of two parameters, and a residual.
struct Problem {
  calibration::Evidence evidence;
  Eigen::MatrixXd J;
  Eigen::VectorXd r;
};

Problem some_problem() {
  Problem problem{evidence_of(measured({0, 5}, [](const measurement::Sample&) { return 0.0; })), {}, {}};
  const Eigen::Index rows = problem.evidence.theta.size();
  problem.J.resize(rows, 2);
  problem.r.resize(rows);
  const auto noise = white_noise(1.0, 7);
  for (Eigen::Index i = 0; i < rows; ++i) {
    problem.J(i, 0) = 1;
    problem.J(i, 1) = noise({});
    problem.r[i] = 0.3 - 0.2 * problem.J(i, 1) + 0.1 * noise({});
  }
  return problem;
}

Eigen::VectorXd by_qr(const Eigen::MatrixXd& J, const Eigen::VectorXd& r) { return J.householderQr().solve(r); }

TEST(LeastSquares, StepEqualsOrthogonalFactorisation) {
  const Problem problem = some_problem();
  const calibration::Fit fit = hand_made(problem.evidence, problem.J, problem.r);
  const calibration::NormalEquations all = calibration::sums_of_all(problem.evidence, fit);
  const Eigen::VectorXd step = calibration::least_squares_step(all, fit.x, 0);
  EXPECT_LT((step - by_qr(problem.J, problem.r)).norm(), 1e-12);
  EXPECT_NEAR(all.squares_after(step), (problem.r - problem.J * step).squaredNorm(), 1e-10);
  EXPECT_EQ(all.rows, static_cast<double>(problem.r.size()));
}

TEST(LeastSquares, RidgeEqualsUninformativeRow) {
  const Problem problem = some_problem();
  calibration::Fit fit = hand_made(problem.evidence, problem.J, problem.r);
  fit.x << 2, -1;
  const double ridge = 9;
  Eigen::MatrixXd J(problem.J.rows() + 2, 2);
  J << problem.J, std::sqrt(ridge) * Eigen::Matrix2d::Identity();
  Eigen::VectorXd r(J.rows());
  r << problem.r, -std::sqrt(ridge) * fit.x;
  EXPECT_LT(
      (calibration::least_squares_step(calibration::sums_of_all(problem.evidence, fit), fit.x, ridge) - by_qr(J, r))
          .norm(),
      1e-12);
}

TEST(LeastSquares, BlocksAddUp) {
  const Problem problem = some_problem();
  const calibration::Fit fit = hand_made(problem.evidence, problem.J, problem.r);
  calibration::NormalEquations sum = calibration::NormalEquations::none(2);
  for (const calibration::NormalEquations& block : fit.sums) sum += block;
  const calibration::NormalEquations all = calibration::sums_of_all(problem.evidence, fit);
  EXPECT_LT((sum.JJ - all.JJ).norm(), 1e-9);
  sum -= all;
  EXPECT_LT(sum.Jr.norm(), 1e-9);
}

TEST(LeastSquares, CaliperCountsAsRowOfNoise) {
  calibration::Evidence evidence = evidence_of(measured({0, 5}, [](const measurement::Sample&) { return 0.0; }));
  const Effect& stretch = named("tendon_stretch");
  evidence.readings = {{&stretch.parameters.front(), 0.02, 0.004}};
  calibration::Fit fit;
  fit.parameters = {&stretch.parameters.front()};
  fit.x = Eigen::VectorXd::Zero(1);
  const double step = stretch.parameters.front().step;
  const calibration::NormalEquations row = calibration::sums_of_readings(evidence, fit);
  EXPECT_DOUBLE_EQ(row.JJ(0, 0), std::pow(step / 0.004 * k_floor, 2));
  EXPECT_NEAR(calibration::least_squares_step(row, fit.x, 0)[0] * step, 0.02, 1e-15);
  EXPECT_DOUBLE_EQ(calibration::caliper_chi2(evidence, {}), 25.0);
}

// ---- held out -------------------------------------------------------------------------------------------------------

/// Mean square of a block's rows, fitted to all rows but those of `fold`.
double error_without(const Problem& problem, const calibration::Fold& fold, std::size_t of) {
  std::vector<Eigen::Index> rest, own;
  for (std::size_t b = 0; b < problem.evidence.blocks.size(); ++b) {
    const bool held = std::find(fold.begin(), fold.end(), b) != fold.end();
    for (const std::size_t row : problem.evidence.blocks[b].rows) {
      if (!held) rest.push_back(static_cast<Eigen::Index>(row));
      if (b == of) own.push_back(static_cast<Eigen::Index>(row));
    }
  }
  const Eigen::VectorXd step = by_qr(problem.J(rest, Eigen::all), problem.r(rest));
  return (problem.r(own) - problem.J(own, Eigen::all) * step).squaredNorm() / static_cast<double>(own.size());
}

TEST(HeldOut, EqualsErrorOfFitToOthers) {
  Problem problem = some_problem();
  problem.evidence.factor_folds = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  const calibration::Fit fit = hand_made(problem.evidence, problem.J, problem.r);
  double sum = 0;
  for (std::size_t b = 0; b < 8; ++b) {
    const calibration::Fold fold = problem.evidence.factor_folds[b / 4];
    EXPECT_NEAR(fit.by_factor.by_block[b], error_without(problem, fold, b), 1e-7) << b;
    EXPECT_NEAR(fit.by_run.by_block[b], error_without(problem, {b}, b), 1e-7) << b;
    sum += fit.by_factor.by_block[b] / 8;
  }
  EXPECT_NEAR(fit.by_factor.mean_square, sum, 1e-12);
}

TEST(HeldOut, DecisiveLevelIsHeldOutByStrokes) {
  Problem problem = some_problem();
  problem.J.col(1).head(4 * k_rows).setZero();  // the first run contains no information about the second parameter
  problem.evidence.factor_folds = {{4, 5, 6, 7}};
  const calibration::Fit fit = hand_made(problem.evidence, problem.J, problem.r);
  for (std::size_t b = 0; b < 4; ++b) EXPECT_TRUE(std::isnan(fit.by_factor.by_block[b]));
  double sum = 0;
  for (std::size_t b = 4; b < 8; ++b) {
    EXPECT_NEAR(fit.by_factor.by_block[b], error_without(problem, {b}, b), 1e-7);
    sum += fit.by_factor.by_block[b] / 4;
  }
  EXPECT_NEAR(fit.by_factor.mean_square, sum, 1e-12);
}

/// Families of place, load and run, each of some size, beside two numbers.
calibration::Amplitudes some_amplitudes(const calibration::Evidence& evidence) {
  calibration::Amplitudes amplitudes = evidence.evidence_model->without_discrepancy();
  const std::vector<calibration::Family>& families = evidence.evidence_model->discrepancy().families;
  for (std::size_t f = 0; f < families.size(); ++f) {
    const bool is_used =
        families[f].factor == calibration::Factor::place || families[f].factor == calibration::Factor::load;
    if (is_used) amplitudes.families[static_cast<Eigen::Index>(f)] = 0.2;
  }
  amplitudes.noise = 0.1;
  return amplitudes;
}

/// Least squares with one additional row for each prior, over columns and parameters together, by orthogonal
/// factorisation. Errors of a block that was left out with its fold: by the parameters alone, and with the columns of
/// place.
std::pair<double, double> errors_beside(const Problem& problem, const calibration::Amplitudes& amplitudes,
                                        const calibration::Fold& fold, std::size_t of) {
  const calibration::Discrepancy& discrepancy = problem.evidence.evidence_model->discrepancy();
  std::vector<Eigen::Index> rest, own, rest_used, own_used;  // of all rows, of rows in use
  Eigen::Index used = 0;
  for (std::size_t b = 0; b < problem.evidence.blocks.size(); ++b) {
    const bool held = std::find(fold.begin(), fold.end(), b) != fold.end();
    for (const std::size_t row : problem.evidence.blocks[b].rows) {
      if (!held) rest.push_back(static_cast<Eigen::Index>(row)), rest_used.push_back(used);
      if (b == of) own.push_back(static_cast<Eigen::Index>(row)), own_used.push_back(used);
      ++used;
    }
  }
  const double noise = amplitudes.noise / std::sqrt(problem.evidence.evidence_model->independent_share());
  std::vector<Eigen::Index> columns;
  std::vector<double> prior;
  std::vector<bool> of_place;
  for (std::size_t f = 0; f < discrepancy.families.size(); ++f) {
    const calibration::Family& family = discrepancy.families[f];
    const double amplitude = amplitudes.families[static_cast<Eigen::Index>(f)];
    for (Eigen::Index k = 0; amplitude > 0 && k < family.count; ++k) {
      columns.push_back(family.first + k);
      prior.push_back(noise / amplitude);
      of_place.push_back(family.factor == calibration::Factor::place);
    }
  }
  const auto n = static_cast<Eigen::Index>(rest.size()), m = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, 2 + m);
  A.topLeftCorner(n, 2) = problem.J(rest, Eigen::all);
  A.topRightCorner(n, m) = discrepancy.columns(rest_used, columns);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n + m);
  y.head(n) = problem.r(rest);
  for (Eigen::Index k = 0; k < m; ++k) A(n + k, 2 + k) = prior[static_cast<std::size_t>(k)];
  const Eigen::VectorXd x = by_qr(A, y);
  Eigen::VectorXd place = x.tail(m);
  for (Eigen::Index k = 0; k < m; ++k) place[k] *= of_place[static_cast<std::size_t>(k)] ? 1.0 : 0.0;
  const Eigen::VectorXd left = problem.r(own) - problem.J(own, Eigen::all) * x.head(2);
  const Eigen::VectorXd less = left - discrepancy.columns(own_used, columns) * place;
  const auto rows = static_cast<double>(own.size());
  return {left.squaredNorm() / rows, less.squaredNorm() / rows};
}

TEST(HeldOut, EqualsErrorBesideDiscrepancyToo) {
  Problem problem = some_problem();
  Eigen::Index used = 0;
  for (const calibration::Block& block : problem.evidence.blocks) {
    for (const std::size_t row : block.rows)
      problem.r[static_cast<Eigen::Index>(row)] += std::sin(3.0 * static_cast<double>(used++ % k_rows) / k_rows);
  }
  const calibration::Fit fit = hand_made(problem.evidence, problem.J, problem.r);
  const calibration::Amplitudes amplitudes = some_amplitudes(problem.evidence);
  const std::vector<calibration::Fold> folds = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  const calibration::HeldOutWithDiscrepancy held =
      calibration::hold_out_with_discrepancy(problem.evidence, fit, amplitudes, folds);
  for (std::size_t b = 0; b < 8; ++b) {
    const auto [effects, with_place] = errors_beside(problem, amplitudes, folds[b / 4], b);
    EXPECT_NEAR(held.effects.by_block[b], effects, 1e-5 * effects) << b;
    EXPECT_NEAR(held.with_place.by_block[b], with_place, 1e-5 * with_place) << b;
    EXPECT_LT(with_place, effects) << b;
  }
}

// ---- fits through the simulation ------------------------------------------------------------------------------------

constexpr double k_offset = 0.01;      // rad
constexpr double k_compliance = 2e-3;  // rad per N

calibration::Evidence yielding(unsigned seed) {
  return evidence_of(
      measured({0, 5, -5}, [noise = white_noise(k_floor, seed)](const measurement::Sample& sample) mutable {
        return k_offset - k_compliance * sample.load + noise(sample);
      }));
}

/// Offset and compliance by straight least squares.
Eigen::VectorXd regression(const calibration::Evidence& evidence) {
  Eigen::MatrixXd J(evidence.theta.size(), 2);
  Eigen::VectorXd r = evidence.theta;
  Eigen::Index row = 0;
  for (const fusee::measurement::Run& run : evidence.measurement.runs) {
    for (const measurement::Sample& sample : run.samples) {
      J.row(row) << 1, -sample.load;
      r[row++] -= sample.alpha / k_ratio;
    }
  }
  return by_qr(J, r);
}

class LinearFit : public testing::Test {
 protected:
  calibration::Evidence evidence = yielding(3);
  joint::Forward forward{joint(), evidence.log};
  calibration::Fitter fitter{evidence, forward};
  const Effect& stretch = named("tendon_stretch");

  double compliance(const calibration::Fit& fit) const { return value_of(fit.at, stretch.parameters.front()); }
};

TEST_F(LinearFit, IsLeastSquares) {
  const calibration::Fit fit = fitter.fit({&stretch}, {});
  const Eigen::VectorXd expected = regression(evidence);
  ASSERT_TRUE(fit.usable);
  // Prior sizes and a discrepancy move it by less than 10 % of a standard error.
  const double standard_error = k_floor / std::sqrt(8 * k_rows);
  EXPECT_NEAR(value_of(fit.at, *fit.parameters[0]), expected[0], 0.1 * standard_error);
  EXPECT_NEAR(compliance(fit), expected[1], 0.1 * standard_error / 5);
  EXPECT_NEAR(compliance(fit), k_compliance, 5e-5);
  EXPECT_NEAR(fit.mean_square, k_floor * k_floor, 0.2 * k_floor * k_floor);
  EXPECT_EQ(fit.play_square, 0);
}

TEST_F(LinearFit, CandidateByChordsEndsAtFit) {
  const calibration::Fit base = fitter.fit({}, {});
  const calibration::Fit candidate = fitter.add_effect(base, stretch);
  ASSERT_TRUE(candidate.usable);
  EXPECT_NEAR(compliance(candidate), compliance(fitter.fit({&stretch}, {})), 1e-6);
  EXPECT_EQ(candidate.effects, calibration::EffectSet{&stretch});
  EXPECT_LT(candidate.by_run.mean_square, 0.1 * base.by_run.mean_square);
}

TEST_F(LinearFit, AddedSlopesChangeNoFit) {
  const calibration::Fit base = fitter.fit({}, {});
  const calibration::Fit wider = fitter.add_slopes(base, stretch);
  EXPECT_EQ(wider.at, base.at);
  EXPECT_EQ(wider.x[1], 0);
  EXPECT_EQ(wider.residual, base.residual);
  const double step = stretch.parameters.front().step;
  Eigen::Index row = 0;
  for (const fusee::measurement::Run& run : evidence.measurement.runs) {
    for (const measurement::Sample& sample : run.samples) EXPECT_NEAR(wider.J(row++, 1), -step * sample.load, 1e-12);
  }
}

TEST_F(LinearFit, IntervalsContainTrueValue) {
  const calibration::Fit fit = fitter.fit({&stretch}, {});
  const std::vector<calibration::ConfidenceInterval> found = calibration::intervals(fit);
  const double step = stretch.parameters.front().step;
  EXPECT_LT(found[1].low * step, k_compliance);
  EXPECT_GT(found[1].high * step, k_compliance);
}

// ---- reported parameters beside an unmodelled cause -----------------------------------------------------------------

/// A joint whose compliance changes with the angle, an unmodelled cause.
calibration::Evidence bending_with_the_load() {
  return evidence_of(
      measured({0, 2, 5, -3}, [noise = white_noise(k_floor, 5)](const measurement::Sample& sample) mutable {
        return k_offset - k_compliance * sample.load + 5e-3 * sample.load * std::pow(sample.alpha, 2) + noise(sample);
      }));
}

class LeastSquaresFits : public testing::Test {
 protected:
  calibration::Evidence evidence = bending_with_the_load();
  calibration::FitterPool pool{evidence};
  const Effect& stretch = named("tendon_stretch");
  const calibration::Fit mode = pool.one().fit({&stretch}, {});

  double residual_norm(const calibration::Fit& fit) const { return fit.residual.norm(); }
  double compliance(const calibration::Fit& fit) const { return value_of(fit.at, stretch.parameters.front()); }
};

TEST_F(LeastSquaresFits, EqualRegression) {
  const calibration::Fit squares = pool.one().fit_least_squares(mode);
  const Eigen::VectorXd expected = regression(evidence);
  EXPECT_NEAR(value_of(squares.at, *squares.parameters[0]), expected[0], 1e-6);
  EXPECT_NEAR(compliance(squares), expected[1], 1e-6);
  EXPECT_LT(residual_norm(squares), residual_norm(mode));
}

TEST_F(LeastSquaresFits, NumbersStayWithinBounds) {
  const Effect& gain = named("joint_sensor_gain");
  const EffectParameter& number = gain.parameters.front();
  const calibration::Evidence scaled =
      evidence_of(measured({0, 2}, [&, noise = white_noise(k_floor, 5)](const measurement::Sample& sample) mutable {
        return k_offset + 1.5 * number.most * sample.alpha / k_ratio + noise(sample);
      }));
  calibration::FitterPool fitters(scaled);
  const calibration::Fit squares = fitters.one().fit_least_squares(fitters.one().fit({&gain}, {}));
  EXPECT_NEAR(value_of(squares.at, number), number.most, 1e-12);
  EXPECT_NEAR(squares.residual.mean(), 0, 1e-9);  // the offset is fitted beside it
}

/// Log of a cable joint like the jaw of docs/background/real-joint.md. No law of the catalogue describes how its
/// hysteresis shrinks with the load.
measurement::Measurement shrinking_hysteresis(double gain = 0) {
  const std::vector<double> loads = {0, 0.01, 0.02, 0.03}, widths = {3.5, 2, 0.5, 0.5};
  measurement::Measurement all = measured(loads, white_noise(radians(0.02), 5));
  all.load_unit = "Nm";
  for (std::size_t r = 0; r < loads.size(); ++r) {
    const double half = 0.5 * radians(widths[r]);
    double position = radians(180);  // the joint, in its play
    for (measurement::Sample& sample : all.runs[r].samples) {
      const double middle = sample.alpha / k_ratio;
      position = std::clamp(position, middle - half, middle + half);
      sample.theta += position - middle - radians(90) * sample.load + gain * position;
    }
  }
  return all;
}

/// Stretch and a slack that a load takes up are identified, and explain a part of the error.
class ReportedEffects : public testing::Test {
 protected:
  explicit ReportedEffects(double gain = 0) : evidence(evidence_of(shrinking_hysteresis(gain))) {}

  calibration::Evidence evidence;
  calibration::FitterPool pool{evidence};
  calibration::Selection selection;

  calibration::ReportedParameters reported_parameters() {
    const Effect& stretch = named("tendon_stretch");
    const Effect& slack = named("slack");
    Imperfections start;
    set_value(start, stretch.parameters[0], radians(90));
    set_value(start, slack.parameters[0], radians(3.5));
    set_value(start, slack.parameters[1], radians(70));
    selection.none = pool.one().fit({}, {});
    selection.best = pool.one().fit({&stretch, &slack}, start);
    for (std::size_t k = 0; k < selection.best.parameters.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double variance = selection.best.posterior.covariance(i, i);
      selection.variance[selection.best.parameters[k]] = {variance, variance};
    }
    return calibration::choose_reported_parameters(evidence, pool, selection,
                                                   calibration::describe_discrepancy(evidence, selection.best));
  }
};

TEST_F(ReportedEffects, ReportsLeastSquaresThatPredictBetter) {
  const calibration::ReportedParameters made = reported_parameters();
  EXPECT_LT(made.estimate.fit.mean_square, 0.7 * selection.best.mean_square);
  EXPECT_LT(made.estimate.fit.by_run.mean_square, std::pow(radians(0.22), 2));
  EXPECT_FALSE(made.curve.used);
}

TEST_F(ReportedEffects, IntervalsCoverReplacedParameters) {
  const calibration::ReportedParameters made = reported_parameters();
  selection.groups = {{{&named("tendon_stretch")}, 0}, {{&named("slack")}, 0}};
  selection.without.resize(2);
  for (auto& [parameter, variance] : selection.variance) variance = {1e-12, 1e-12};  // the mode alone
  for (const calibration::FoundEffect& found : calibration::found_effects(evidence, selection, made.reported)) {
    for (const calibration::FittedParameter& number : found.parameters) {
      EXPECT_LE(number.low, number.value);
      EXPECT_GE(number.high, number.value);
      EXPECT_LE(number.low_if_only, number.value);
      EXPECT_GE(number.high_if_only, number.value);
    }
  }
}

/// The joint's sensor also has a gain, which is a member of a group.
class ReportedGroup : public ReportedEffects {
 protected:
  explicit ReportedGroup(double gain = 0.05) : ReportedEffects(gain) {
    selection.groups = {{{&named("tendon_stretch"), &named("joint_sensor_gain")}, 0}, {{&named("slack")}, 0}};
  }

  bool holds_gain(const calibration::ReportedParameters& made) {
    return calibration::contains(made.estimate.fit.effects, named("joint_sensor_gain"));
  }
};

TEST_F(ReportedGroup, BetterPredictingMemberIsAdded) {
  const calibration::ReportedParameters made = reported_parameters();
  ASSERT_TRUE(holds_gain(made));
  EXPECT_LT(made.estimate.fit.by_run.mean_square, std::pow(radians(0.25), 2));
  selection.without.resize(2);
  const std::vector<calibration::FoundEffect> found = calibration::found_effects(evidence, selection, made.reported);
  ASSERT_EQ(found.size(), 2u);
  ASSERT_EQ(found[0].beside.size(), 1u);
  EXPECT_TRUE(found[1].beside.empty());
  EXPECT_EQ(found[0].beside[0].name, "joint_sensor_gain");
  EXPECT_NEAR(found[0].beside[0].parameters[0].value, 5.0, 0.5);
}

TEST_F(ReportedGroup, EffectOutsideGroupsStaysOut) {
  selection.groups[0].members.pop_back();
  EXPECT_FALSE(holds_gain(reported_parameters()));
}

class UselessGroupMember : public ReportedGroup {
 protected:
  UselessGroupMember() : ReportedGroup(0) {}
};

TEST_F(UselessGroupMember, ExcludesMemberThatPredictsNothing) { EXPECT_FALSE(holds_gain(reported_parameters())); }

TEST_F(LinearFit, ModeIsReportedWithoutDiscrepancy) {
  calibration::FitterPool pool(evidence);
  calibration::Selection selection;
  selection.none = fitter.fit({}, {});
  selection.best = fitter.fit({&stretch}, {});
  const calibration::DiscrepancyFit unmodelled = calibration::describe_discrepancy(evidence, selection.best);
  ASSERT_FALSE(calibration::is_unexplained(unmodelled, evidence.floor));
  EXPECT_EQ(calibration::choose_reported_parameters(evidence, pool, selection, unmodelled).estimate.fit.at,
            selection.best.at);
}

}  // namespace
}  // namespace fusee::calibration::linear
