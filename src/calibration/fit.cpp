#include "calibration/fit.h"

#include <atomic>
#include <limits>
#include <optional>
#include <utility>

#include "base/decompositions.h"
#include "base/thread_pool.h"
#include "calibration/catalogue.h"

// Gauss-Newton steps to the posterior mode, with the discrepancy marginalised: parameters are not biased by what the
// discrepancy explains equally well. A candidate is stepped by chords: the slopes of the base's parameters stay, those
// of the effect are computed at every step. It costs a dozen simulations, whatever the size of the base. If another
// start explains more without discrepancy, the candidate is fitted from there too, with all slopes.

namespace fusee::calibration {
namespace {

constexpr int k_most_steps_down = 8;
constexpr int k_chords = 3;
/// Passes, each with the amplitudes of the previous mode.
constexpr int k_passes = 3;
/// Rounds of amplitudes during the descent.
constexpr int k_few_rounds = 3;
/// Factor on a step that lowered the density.
constexpr double k_shorter = 0.3;
/// Nats: a step that gained less is the last.
constexpr double k_least_gain = 0.05;
/// Nats: a step that predicts less, a seventieth of a standard error, is not simulated. At 2e-3 a group of one joint in
/// six takes in four members more (random joints of tests/rig).
constexpr double k_worth_a_step = 1e-4;
/// Relative reduction of the squares below which a step is the last.
constexpr double k_least_of_squares = 1e-4;
/// Levenberg and Marquardt: steps, the damping after a first rejected step, and its factor. Numbers that replace one
/// another, as a gain and an error of the ratio, have long steps of no use.
constexpr int k_most_squares_steps = 20;
constexpr double k_least_damping = 1e-3;
constexpr double k_more_damping = 10.0;
/// Prior size of a number without known sizes, in its steps.
constexpr double k_steps_in_practice = 100.0;

/// Prior size, in steps of the parameter.
double size_in_practice(const Evidence& evidence, const EffectParameter& parameter) {
  if (&parameter == free_offset(*evidence.declared)) return std::numeric_limits<double>::infinity();
  if (const auto known = evidence.sizes.find(&parameter); known != evidence.sizes.end()) return known->second;
  if (!(parameter.prior > 0)) return k_steps_in_practice;
  return prior_of(parameter, evidence.largest_load) / parameter.step;
}

/// Numbers after a step, clamped to their bounds.
Imperfections step_within_bounds(const Fit& fit, const Eigen::VectorXd& step) {
  Imperfections at = fit.at;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const EffectParameter& parameter = *fit.parameters[k];
    const double value = (fit.x[static_cast<Eigen::Index>(k)] + step[static_cast<Eigen::Index>(k)]) * parameter.step;
    set_value(at, parameter, std::clamp(value, parameter.least, parameter.most));
  }
  return at;
}

/// `step` without the parameters that are fixed at a bound.
Eigen::VectorXd of_free_numbers(const Fit& fit, Eigen::VectorXd step) {
  for (Eigen::Index k = 0; k < step.size(); ++k) {
    if (fit.J.col(k).isZero(0)) step[k] = 0;
  }
  return step;
}

/// Values, each divided by its step.
Eigen::VectorXd numbers_of(const Parameters& parameters, const Imperfections& at) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(parameters.size()));
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const EffectParameter& parameter = *parameters[static_cast<std::size_t>(k)];
    x[k] = value_of(at, parameter) / parameter.step;
  }
  return x;
}

/// Nats by which loose rows are penalised less than noise.
double play_penalty(const Evidence& evidence, const Fit& fit) {
  double squares = 0;
  for (const Block& block : evidence.blocks) {
    for (const std::size_t row : block.rows)
      squares += play_correction(fit.loose[static_cast<Eigen::Index>(row)], evidence.floor);
  }
  return 0.5 * evidence.evidence_model->independent_share() * squares / (evidence.floor * evidence.floor);
}

/// Evidence that loose rows cost, nats: by their residuals, and by the information of rows at the last pushed position,
/// which narrows the posterior. The mode is sought without it, since places that explain a loose row alternate with
/// places that do not.
double loose_row_penalty(const Evidence& evidence, const Fit& fit) {
  const EvidenceModel& evidence_model = *evidence.evidence_model;
  const std::vector<Eigen::Index> rows = evidence.rows();
  const Eigen::VectorXd residual =
      fit.residual(rows) - evidence_model.discrepancy().columns * fit.posterior.coefficients;
  const LooseRows mixture = loose_rows(residual, fit.loose(rows), evidence.floor);
  double nats = evidence_model.independent_share() * mixture.nats;
  if (fit.x.size() == 0 || mixture.extra_information.isZero()) return nats;
  const Eigen::MatrixXd extra_information =
      mixture.extra_information.cwiseSqrt().asDiagonal() * Eigen::MatrixXd(fit.J(rows, Eigen::all));
  const double beta = evidence_model.independent_share() / (evidence.floor * evidence.floor);
  const Eigen::MatrixXd wider = Cholesky(fit.posterior.covariance).lower();
  const Eigen::MatrixXd gained = Eigen::MatrixXd::Identity(fit.x.size(), fit.x.size()) +
                                 beta * (extra_information * wider).transpose() * (extra_information * wider);
  return nats + Cholesky(gained).half_log_determinant();
}

/// True if a family of the discrepancy is larger than the noise.
bool has_large_discrepancy(const Evidence& evidence, const Fit& fit) {
  const std::vector<Family>& families = evidence.evidence_model->discrepancy().families;
  for (std::size_t f = 0; f < families.size(); ++f) {
    const double amplitude = fit.posterior.amplitudes.families[static_cast<Eigen::Index>(f)];
    if (!(families[f].fixed > 0) && amplitude > evidence.floor) return true;
  }
  return false;
}

/// Cache of the last scaled discrepancy: a descent requires the same amplitudes several times.
class ScaledDiscrepancyCache {
 public:
  explicit ScaledDiscrepancyCache(const EvidenceModel& evidence_model) : evidence_model_(evidence_model) {}

  const ScaledDiscrepancy& of(const Amplitudes& amplitudes, double deflection_ratio) {
    if (!last_ || deflection_ratio_ != deflection_ratio || !(last_->amplitudes == amplitudes))
      last_ = evidence_model_.sized(amplitudes, deflection_ratio);
    deflection_ratio_ = deflection_ratio;
    return *last_;
  }

 private:
  const EvidenceModel& evidence_model_;
  double deflection_ratio_ = 0;
  std::optional<ScaledDiscrepancy> last_;
};

/// The likelier of two that are usable; the first if neither is.
Fit likelier(Fit one, Fit other) {
  const bool is_other = other.usable && (!one.usable || other.log_evidence > one.log_evidence);
  return is_other ? std::move(other) : std::move(one);
}

/// True if the slopes predict a likelier place.
bool predicts_gain(const Fit& fit) { return fit.posterior.log_evidence > fit.posterior.log_evidence_here + 0.5; }

}  // namespace

void hold_at_bounds(Fit& fit) {
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    if (at_end(fit.at, *fit.parameters[k])) fit.J.col(static_cast<Eigen::Index>(k)).setZero();
  }
}

std::vector<Eigen::Index> places_of(const Fit& fit, const fusee::Effect& effect) {
  std::vector<Eigen::Index> own;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const bool is_own = std::any_of(effect.parameters.begin(), effect.parameters.end(),
                                    [&](const EffectParameter& p) { return &p == fit.parameters[k]; });
    if (is_own) own.push_back(static_cast<Eigen::Index>(k));
  }
  return own;
}

Eigen::VectorXd contribution(const Evidence& evidence, const Fit& fit, const fusee::Effect& effect) {
  const std::vector<Eigen::Index> places = places_of(fit, effect);
  return fit.J(evidence.rows(), places) * fit.x(places);
}

Imperfections settled(const Evidence& evidence, const fusee::Effect& effect, Imperfections at) {
  if (effect.settle != nullptr && !evidence.earlier) effect.settle(at, *evidence.declared);
  return at;
}

Fit with_fixed_parameters(const Evidence& evidence, Fit fit) {
  fit.parameters.clear();
  fit.x.resize(0);
  fit.J.resize(fit.residual.size(), 0);
  fit.readings = NormalEquations::none(0);
  for (std::size_t b = 0; b < fit.sums.size(); ++b) fit.sums[b] = sums_of(evidence.blocks[b], fit, evidence.floor);
  return fit;
}

Tangent tangent_of(const Evidence& evidence, const Fit& fit) {
  const std::vector<Eigen::Index> rows = evidence.rows();
  Tangent tangent;
  tangent.residual = fit.residual(rows);
  tangent.J = fit.x.size() > 0 ? Eigen::MatrixXd(fit.J(rows, Eigen::all)) : Eigen::MatrixXd(tangent.residual.size(), 0);
  tangent.x = fit.x;
  tangent.prior.resize(fit.x.size());
  for (Eigen::Index k = 0; k < fit.x.size(); ++k)
    tangent.prior[k] = size_in_practice(evidence, *fit.parameters[static_cast<std::size_t>(k)]);
  const NormalEquations readings = sums_of_readings(evidence, fit);
  const double unit = evidence.floor * evidence.floor;
  tangent.caliper_information = readings.JJ / unit;
  tangent.caliper_gradient = readings.Jr / unit;
  tangent.caliper_chi2 = caliper_chi2(evidence, fit.at);
  tangent.deflection_ratio =
      evidence.declared->transmission ? std::abs(fit.at.ratio_joint.compliance) : 1.0 + fit.at.tendon.stretch;
  return tangent;
}

Tangent move_tangent(Tangent tangent, const Eigen::VectorXd& x) {
  const Eigen::VectorXd step = x - tangent.x;
  tangent.residual -= tangent.J * step;
  tangent.caliper_chi2 += step.dot(tangent.caliper_information * step) - 2.0 * step.dot(tangent.caliper_gradient);
  tangent.x = x;
  return tangent;
}

Fit Fitter::evaluate_at(const EffectSet& effects, const Imperfections& at, LooseRow loose_row) const {
  Fit fit;
  fit.loose_row = loose_row;
  fit.effects = effects;
  fit.parameters = model_.varied(effects);
  fit.at = at;
  ModelResidual evaluation = model_.evaluate(at, loose_row);
  fit.residual = std::move(evaluation.residual);
  fit.loose = std::move(evaluation.loose);
  fit.x = numbers_of(fit.parameters, at);
  return fit;
}

/// Linearization with the slopes of all parameters.
Fit Fitter::linearize_at(const EffectSet& effects, const Imperfections& at, LooseRow loose_row) const {
  Fit fit = evaluate_at(effects, at, loose_row);
  take_slopes(fit, 0);
  fit.usable = is_finite(evidence(), fit);
  return fit;
}

void Fitter::take_slopes(Fit& fit, Eigen::Index from) const {
  fit.J.conservativeResize(fit.residual.size(), fit.x.size());
  for (Eigen::Index k = from; k < fit.x.size(); ++k)
    fit.J.col(k) = model_.slope(fit.at, *fit.parameters[static_cast<std::size_t>(k)], fit.residual, fit.loose_row);
}

/// Model residual at `at`, with the slopes of `base`, and new ones of the parameters that it lacks.
Fit Fitter::at(const Fit& base, const EffectSet& effects, const Imperfections& at) const {
  Fit fit = evaluate_at(effects, at, base.loose_row);
  fit.J = base.J;
  take_slopes(fit, base.x.size());
  fit.usable = is_finite(evidence(), fit);
  return fit;
}

/// Steps as long as they gain or predict a gain; slopes before `from` are kept.
Fit Fitter::descend(Fit fit, Eigen::Index from, int steps, const Amplitudes& amplitudes, int rounds) const {
  const EvidenceModel& evidence_model = *evidence().evidence_model;
  ScaledDiscrepancyCache sized(evidence_model);
  const auto log_density_at = [&](const Tangent& tangent, const Amplitudes& given) {
    return evidence_model.log_density_at(tangent, sized.of(given, tangent.deflection_ratio));
  };
  Tangent here = tangent_of(evidence(), fit);
  const bool stated = rounds == 1;
  Posterior known = evidence_model.best(here, amplitudes, rounds);
  bool estimated = true;  // amplitudes are those of this place
  double share = 1.0;
  for (int i = 0; i < steps; ++i) {
    Imperfections there;
    const auto predict_evidence = [&] {
      there = step_within_bounds(fit, share * known.step);
      const Eigen::VectorXd x = numbers_of(fit.parameters, there);
      const bool whole = (fit.x + known.step - x).isZero(1e-9 * known.step.norm());
      return (whole ? known.predicted_log_density : log_density_at(move_tangent(here, x), known.amplitudes)) -
             known.log_density;
    };
    double predicted_gain = predict_evidence();
    if (predicted_gain < k_worth_a_step) {
      if (estimated) break;
      known = evidence_model.best(here, known.amplitudes, rounds);
      estimated = true;
      predicted_gain = predict_evidence();
      if (predicted_gain < k_worth_a_step) break;
    }
    const double height = known.log_density - play_penalty(evidence(), fit);
    Fit next = evaluate_at(fit.effects, there, fit.loose_row);
    next.J = fit.J;
    next.usable = is_finite(evidence(), next);
    const double reached =
        next.usable ? log_density_at(tangent_of(evidence(), next), known.amplitudes) - play_penalty(evidence(), next)
                    : -std::numeric_limits<double>::infinity();
    // Slopes cost most. A rejected step needs none, and a step that gained as predicted keeps them.
    const bool is_linear = std::abs(reached - height - predicted_gain) < k_least_gain;
    if (reached > height && !is_linear) {
      take_slopes(next, from);
      next.usable = is_finite(evidence(), next);
    }
    if (!(reached > height) || !next.usable) {
      share *= k_shorter;
      continue;
    }
    const bool is_settled = reached < height + k_least_gain;
    fit = std::move(next);
    here = tangent_of(evidence(), fit);
    estimated = i % 2 == 1 || stated;
    known = estimated && !stated ? evidence_model.best(here, known.amplitudes, rounds)
                                 : evidence_model.at(here, sized.of(known.amplitudes, here.deflection_ratio));
    share = 1.0;
    if (is_settled) break;
  }
  return fit;
}

Fit Fitter::fit(const EffectSet& effects, const Imperfections& from) const {
  Fit direct = prefer_pushed(descend_fully(effects, from, LooseRow::anywhere));
  if (!direct.usable || direct.x.size() == 0 || !has_large_discrepancy(evidence(), direct)) return direct;
  // The discrepancy may have taken the effects' share: fit without discrepancy first.
  Fit start = linearize_at(effects, from, LooseRow::anywhere);
  if (!start.usable) return direct;
  return likelier(std::move(direct), refine(fit_effects_first(start)));
}

namespace {

/// Normal equations of a shorter step, by Marquardt's scaling.
NormalEquations damped(NormalEquations sums, double damping) {
  sums.JJ.diagonal() *= 1.0 + damping;
  return sums;
}

}  // namespace

Fit Fitter::fit_least_squares(const Fit& fit) const {
  const double ridge = wide_prior(evidence().floor);
  const auto sums_at = [&](Fit& place) {
    place.readings = sums_of_readings(evidence(), place);
    return sums_of_all(evidence(), place);
  };
  Fit best = linearize_at(fit.effects, fit.at, fit.loose_row);
  double damping = 0;
  for (int i = 0; i < k_most_squares_steps && best.usable; ++i) {
    hold_at_bounds(best);
    const NormalEquations sums = sums_at(best);
    const Eigen::VectorXd step = least_squares_step(damped(sums, damping), best.x, ridge);
    Fit next = evaluate_at(best.effects, step_within_bounds(best, of_free_numbers(best, step)), best.loose_row);
    next.J = best.J;
    const double squares = is_finite(evidence(), next) ? sums_at(next).rr : sums.rr;
    if (squares >= sums.rr) {
      damping = std::max(k_least_damping, k_more_damping * damping);
      continue;
    }
    best = linearize_at(next.effects, next.at, next.loose_row);
    damping /= k_more_damping;
    if (squares > (1.0 - k_least_of_squares) * sums.rr) break;
  }
  return with_evidence(std::move(best));
}

Fit Fitter::descend_fully(const EffectSet& effects, const Imperfections& from, LooseRow loose_row) const {
  Fit start = linearize_at(effects, from, loose_row);
  if (!start.usable) return start;
  if (start.x.size() == 0) return with_evidence(std::move(start));
  return refine(with_evidence(
      descend(std::move(start), 0, k_most_steps_down, evidence().evidence_model->first_guess(), k_few_rounds)));
}

Fit Fitter::refine(Fit fit) const {
  for (int pass = 0; pass < k_passes && fit.usable && predicts_gain(fit); ++pass) {
    Fit further = with_evidence(descend(fit, 0, k_most_steps_down, fit.posterior.amplitudes, 1));
    if (!further.usable || !(further.log_evidence > fit.log_evidence + k_least_gain)) break;
    fit = std::move(further);
  }
  return fit;
}

/// Amplitudes of no discrepancy, with all of the error as noise. Where a discrepancy explains as much, small steps end
/// too soon.
Amplitudes Fitter::amplitudes_without_discrepancy(const Fit& fit) const {
  Amplitudes alone = evidence().evidence_model->without_discrepancy();
  const Eigen::VectorXd residual = tangent_of(evidence(), fit).residual;
  alone.noise = std::max(alone.noise, residual.norm() / std::sqrt(static_cast<double>(residual.size())));
  return alone;
}

/// A few steps with all slopes and no discrepancy.
Fit Fitter::fit_effects_first(const Fit& start) const {
  return with_evidence(descend(start, 0, k_chords, amplitudes_without_discrepancy(start), 1));
}

/// The looser the joint, the less information rows have that rest anywhere, so steps lead to too much play. Rows that
/// rest at the last pushed position lead to the right play.
Fit Fitter::prefer_pushed(Fit fit) const {
  if (!fit.usable || fit.x.size() == 0 || !(fit.loose(evidence().rows()).maxCoeff() > 0)) return fit;
  Fit start = linearize_at(fit.effects, fit.at, LooseRow::pushed);
  if (!start.usable) return fit;
  const Amplitudes alone = amplitudes_without_discrepancy(start);
  const Fit near = descend(std::move(start), 0, k_most_steps_down, alone, 1);
  return likelier(std::move(fit), descend_fully(near.effects, near.at, LooseRow::pushed));
}

/// Model residual at each start of `effect` beside `base`, without those that cannot be simulated.
std::vector<Fit> Fitter::linearize_starts(const Fit& base, const fusee::Effect& effect) const {
  EffectSet effects = base.effects;
  effects.push_back(&effect);
  std::vector<Fit> all;
  for (const std::vector<double>& values : starts_of(evidence(), base, effect)) {
    Imperfections start = base.at;
    for (std::size_t k = 0; k < values.size(); ++k) set_value(start, effect.parameters[k], values[k]);
    Fit fit = at(base, effects, start);
    if (fit.usable) all.push_back(std::move(fit));
  }
  return all;
}

double Fitter::predict_evidence(const Fit& start, const Amplitudes& amplitudes) const {
  const double nats = evidence().evidence_model->at(tangent_of(evidence(), start), amplitudes).log_evidence;
  return std::isfinite(nats) ? nats - play_penalty(evidence(), start) : -std::numeric_limits<double>::infinity();
}

Fitter::PredictedStart Fitter::select_start(const std::vector<Fit>& starts, const Amplitudes& amplitudes) const {
  std::vector<double> predicted;
  for (const Fit& start : starts) predicted.push_back(predict_evidence(start, amplitudes));
  const auto most = std::max_element(predicted.begin(), predicted.end());
  return {static_cast<std::size_t>(most - predicted.begin()), *most};
}

Fit Fitter::add_effect_without_discrepancy(const Fit& base, const fusee::Effect& effect) const {
  const std::vector<Fit> starts = linearize_starts(base, effect);
  if (starts.empty()) return {};
  return fit_effects_first(starts[select_start(starts, amplitudes_without_discrepancy(base)).place]);
}

Fit Fitter::add_effect(const Fit& base, const fusee::Effect& effect) const {
  const std::vector<Fit> starts = linearize_starts(base, effect);
  if (starts.empty()) return {};
  const PredictedStart with_discrepancy = select_start(starts, base.posterior.amplitudes);
  const std::size_t alone = select_start(starts, amplitudes_without_discrepancy(base)).place;
  Fit fit = fit_by_chords(base, starts[with_discrepancy.place], with_discrepancy.nats);
  return alone == with_discrepancy.place ? fit : likelier(std::move(fit), refine(fit_effects_first(starts[alone])));
}

/// Fit with one effect more from `start`, by the slopes of the base. `predicted_evidence`: that of the start, with the
/// amplitudes of the base.
Fit Fitter::fit_by_chords(const Fit& base, const Fit& start, double predicted_evidence) const {
  const auto ended = [&](Fit from) {
    return with_evidence(descend(std::move(from), base.x.size(), k_chords, base.posterior.amplitudes, k_few_rounds));
  };
  Fit first = ended(descend(start, base.x.size(), k_chords, amplitudes_without_discrepancy(start), 1));
  // The prediction is reached: small steps would not find more.
  if (first.usable && first.log_evidence >= predicted_evidence) return prefer_pushed(std::move(first));
  return prefer_pushed(likelier(std::move(first), ended(start)));
}

Fit Fitter::with_evidence(Fit fit) const {
  hold_at_bounds(fit);
  compute_evidence(fit);
  return fit;
}

/// Two states are predicted with the discrepancy, which other runs at the same load and speed determine. Without a
/// whole level there would be no such run, so single runs are held out.
void Fitter::hold_out_of(Fit& fit) const {
  if (evidence().earlier) {
    fit.by_run = hold_out_with_discrepancy(evidence(), fit, fit.posterior.amplitudes, evidence().run_folds).with_all;
    fit.by_factor = fit.by_run;
    return;
  }
  fit.by_factor = hold_out(evidence(), fit, evidence().factor_folds);
  fit.by_run = hold_out(evidence(), fit, evidence().run_folds);
}

void Fitter::compute_evidence(Fit& fit) const {
  fit.usable = fit.usable && is_finite(evidence(), fit);
  if (!fit.usable) return;
  const EvidenceModel& evidence_model = *evidence().evidence_model;
  fit.posterior = evidence_model.best(tangent_of(evidence(), fit), evidence_model.first_guess());
  fit.log_evidence = fit.posterior.log_evidence_here - loose_row_penalty(evidence(), fit);
  fit.discrepancy_penalty = evidence_model.discrepancy_penalty(fit.posterior);
  // Two waves of one order are equal columns: a set without a finite evidence must not enter the weights.
  fit.usable = std::isfinite(fit.log_evidence);
  if (!fit.usable) return;
  fit.readings = sums_of_readings(evidence(), fit);
  fit.caliper_chi2 = caliper_chi2(evidence(), fit.at);
  fit.sums.clear();
  double rows = 0;
  double squares = 0;
  double play_squares = 0;
  for (const Block& block : evidence().blocks) {
    fit.sums.push_back(sums_of(block, fit, evidence().floor));
    rows += fit.sums.back().rows;
    squares += fit.sums.back().rr;
    for (const std::size_t row : block.rows)
      play_squares += play_correction(fit.loose[static_cast<Eigen::Index>(row)], evidence().floor);
  }
  fit.mean_square = squares / rows;
  fit.play_square = play_squares / rows;
  hold_out_of(fit);
}

/// `fit` with the numbers of `effect` at zero, searched ones at the start.
Fit Fitter::extend(const Fit& fit, const fusee::Effect& effect, const std::vector<double>& start) const {
  Fit wider = fit;
  wider.effects.push_back(&effect);
  wider.parameters = model_.varied(wider.effects);
  for (std::size_t k = 0; k < start.size(); ++k) {
    if (effect.parameters[k].searched) set_value(wider.at, effect.parameters[k], start[k]);
  }
  wider.x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(wider.parameters.size()));
  wider.x.head(fit.x.size()) = fit.x;
  return wider;
}

/// `fit` with `effect` at its first start.
Fit Fitter::extend(const Fit& fit, const fusee::Effect& effect) const {
  const std::vector<std::vector<double>> starts = starts_of(evidence(), fit, effect);
  return extend(fit, effect, starts.empty() ? std::vector<double>() : starts.front());
}

Eigen::VectorXd Fitter::contribution_of(const Fit& fit, const fusee::Effect& effect) const {
  return (residual(without(fit.at, effect), fit.loose_row) - fit.residual)(evidence().rows());
}

Fit Fitter::add_slopes(const Fit& fit, const fusee::Effect& effect) const {
  Fit wider = extend(fit, effect);
  take_slopes(wider, fit.x.size());
  compute_evidence(wider);
  return wider;
}

/// Chord over `size` in the number's own unit, shorter at its upper bound.
void Fitter::take_chord(Fit& wider, Eigen::Index k, double size) const {
  const EffectParameter& parameter = *wider.parameters[static_cast<std::size_t>(k)];
  const double value = value_of(wider.at, parameter);
  Imperfections moved = wider.at;
  set_value(moved, parameter, value + size <= parameter.most ? value + size : std::max(parameter.least, value - size));
  const double steps = (value_of(moved, parameter) - value) / parameter.step;
  wider.J.col(k) = (wider.residual - model_.evaluate(moved, wider.loose_row).residual) / steps;
}

Fit Fitter::add_chords(const Fit& fit, const fusee::Effect& effect) const {
  Fit wider = extend(fit, effect);
  wider.J.conservativeResize(wider.residual.size(), wider.x.size());
  for (Eigen::Index k = fit.x.size(); k < wider.x.size(); ++k) {
    const EffectParameter& parameter = *wider.parameters[static_cast<std::size_t>(k)];
    take_chord(wider, k, size_in_practice(evidence(), parameter) * parameter.step);
  }
  wider.usable = is_finite(evidence(), wider);
  return wider;
}

std::vector<Fit> Fitter::add_chords_of_starts(const Fit& fit, const fusee::Effect& effect) const {
  std::vector<Fit> all;
  for (const std::vector<double>& start : starts_that_differ(evidence(), fit, effect)) {
    Fit wider = extend(fit, effect, start);
    wider.J.conservativeResize(wider.residual.size(), wider.x.size());
    for (Eigen::Index k = fit.x.size(); k < wider.x.size(); ++k) {
      const EffectParameter& parameter = *wider.parameters[static_cast<std::size_t>(k)];
      const auto own = static_cast<std::size_t>(&parameter - effect.parameters.data());
      const double begun = own < start.size() ? start[own] : 0.0;
      take_chord(wider, k, begun != 0 ? begun : size_in_practice(evidence(), parameter) * parameter.step);
    }
    wider.usable = is_finite(evidence(), wider);
    all.push_back(std::move(wider));
  }
  return all;
}

FitterPool::FitterPool(const Evidence& evidence, std::stop_token stop) : evidence_(evidence), stop_(std::move(stop)) {
  for (unsigned i = 0; i < ThreadPool::shared().threads(); ++i)
    forwards_.emplace_back(*evidence.declared, evidence.log, evidence.earlier).serve_fits();
}

void FitterPool::each(std::size_t count, const std::function<void(const Fitter&, std::size_t)>& job,
                      const std::function<void(std::size_t)>& done) {
  std::atomic<std::size_t> ended = 0;
  const auto fit = [&](std::size_t index, std::size_t slot) {
    job(Fitter(evidence_, forwards_[slot]), index);
    ++ended;
    if (done && slot == 0) done(ended);
  };
  ThreadPool::shared().each(count, fit, 0, stop_);
}

}  // namespace fusee::calibration
