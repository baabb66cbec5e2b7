#include <algorithm>
#include <cmath>

#include "calibration/audit.h"
#include "calibration/catalogue.h"
#include "calibration/changes.h"
#include "calibration/empirical_curve.h"
#include "calibration/explanation.h"
#include "calibration/next_measurements.h"
#include "calibration/unmodelled_alternatives.h"
#include "calibration/validation.h"
#include "calibration/verdict.h"
#include "fusee/calibration.h"
#include "fusee/joint.h"

namespace fusee::calibration {
namespace {

std::vector<std::vector<double>> residuals(const measurement::Measurement& measurement, const joint::Readings& model) {
  std::vector<std::vector<double>> all;
  for (std::size_t i = 0; i < measurement.runs.size(); ++i) {
    all.emplace_back();
    for (std::size_t k = 0; k < model[i].size(); ++k)
      all.back().push_back(measurement.runs[i].samples[k].theta - model[i][k]);
  }
  return all;
}

/// Figures over whole strokes.
ErrorFigures figures(const measurement::Measurement& measurement, const std::vector<std::vector<double>>& all,
                     double held_out) {
  ErrorFigures error;
  double squares = 0;
  double rows = 0;
  for (std::size_t i = 0; i < measurement.runs.size(); ++i) {
    for (const measurement::Stroke& stroke : measurement.runs[i].strokes) {
      for (std::size_t k = stroke.first; !stroke.partial && k <= stroke.last; ++k) {
        if (!std::isfinite(all[i][k])) continue;
        squares += all[i][k] * all[i][k];
        rows += 1;
        error.max = std::max(error.max, std::abs(all[i][k]));
      }
    }
  }
  error.rms = rows > 0 ? std::sqrt(squares / rows) : 0;
  error.held_out_rms = held_out;
  return error;
}

void name_held_out(const Evidence& evidence, Calibration& calibration) {
  calibration.held_out_factors = evidence.factors;
  const std::vector<measurement::Run>& runs = evidence.measurement.runs;
  std::vector<bool> held(runs.size(), false);
  for (const Fold& fold : evidence.run_folds) {
    for (const std::size_t block : fold) held[evidence.blocks[block].run] = true;
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (held[i]) calibration.held_out_runs.push_back(runs[i].name);
  }
}

Calibration not_testable(const DeclaredMechanism& declared, const measurement::Measurement& measurement,
                         const std::vector<std::string>& reasons) {
  Calibration calibration;
  calibration.verdict = CalibrationVerdict::not_testable;
  for (const std::string& reason : reasons) calibration.summary += (calibration.summary.empty() ? "" : " ") + reason;
  calibration.next = planned_measurements(declared);
  ask_for_both_sides(measurement, calibration.next);
  return calibration;
}

bool is_named(const measurement::Run& run, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), run.name) != names.end();
}

/// The runs to fit, or those kept for validation.
measurement::Measurement select_runs(const measurement::Measurement& measurement,
                                     const std::vector<std::string>& hold_out, bool held) {
  measurement::Measurement chosen = measurement;
  std::erase_if(chosen.runs, [&](const measurement::Run& run) { return is_named(run, hold_out) != held; });
  return chosen;
}

/// Replaces the held-out figures by those of the runs kept for validation.
void validate(const Mechanism& declared, const measurement::Measurement& kept, const ValidatedAnswer& answer,
              Calibration& calibration) {
  if (kept.runs.empty()) return;
  const auto residuals_at = [&](const Imperfections& at) {
    return residuals(kept, joint::predict(declared, at, measurement::bench_log(kept)));
  };
  const RowsOfRuns outliers = outliers_of(kept, calibration.noise.rms, residuals_at(answer.declared.fit.at));
  const auto rms = [&](const Imperfections& at) {
    std::vector<std::vector<double>> all = residuals_at(at);
    exclude_rows(outliers, all);
    return figures(kept, all, 0).rms;
  };
  calibration.before.held_out_rms = rms(answer.declared.fit.at);
  calibration.after.held_out_rms = rms(answer.reported.estimate.fit.at);
  calibration.held_out_runs.clear();
  for (const measurement::Run& run : kept.runs) calibration.held_out_runs.push_back(run.name);
}

/// Adds the curve, times `sign`, to the residuals, and computes their figures.
void add_curve(const measurement::Measurement& measurement, double sign, double held_out, Calibration& calibration) {
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    const std::vector<double> values = curve_at_samples(measurement.runs[r], calibration.curve);
    for (std::size_t i = 0; i < values.size(); ++i) calibration.residuals_after[r][i] += sign * values[i];
  }
  calibration.after = figures(measurement, calibration.residuals_after, held_out);
  calibration.iso_after = measurement::iso230(measurement, calibration.residuals_after);
}

/// Corrects by the empirical curve if it holds on every logged row.
void apply_curve(const measurement::Measurement& measurement, const EmpiricalCurve& curve,
                 const std::vector<std::string>& hold_out, Calibration& calibration) {
  calibration.after_effects = calibration.after;
  calibration.curve = curve;
  validate_curve(measurement, calibration.residuals_after, hold_out, calibration.curve);
  if (!calibration.curve.used) return;
  const double square =
      elementary::pow(calibration.after_effects.held_out_rms, 2) - elementary::pow(calibration.curve.gain, 2);
  add_curve(measurement, -1.0, std::sqrt(std::max(0.0, square)), calibration);
}

/// The elastic model of tendons requires a force in N across OC; read_measurement() and compare_with_declared() convert
/// it.
bool is_torque(const Mechanism& declared, const measurement::Measurement& measurement) {
  return !declared.transmission && (measurement.load_unit == "Nm" || measurement.load_unit == "Nmm");
}

std::vector<std::string> why_not_testable(const Mechanism& declared, const measurement::Measurement& measurement) {
  if (measurement.not_testable.empty() && is_torque(declared, measurement))
    return {"The load column holds a torque in " + measurement.load_unit +
            ", and the declared joint takes a tip force: read the runs for this joint."};
  return measurement.not_testable;
}

void describe_errors(const Evidence& evidence, const measurement::Measurement& measurement,
                     const ValidatedAnswer& answer, Calibration& calibration) {
  const joint::BenchLog log = measurement::bench_log(measurement);
  const auto residuals_of = [&](const Estimate& estimate) {
    return residuals(measurement, joint::predict(*evidence.declared, estimate.fit.at, log, evidence.earlier));
  };
  const auto held_out_rms = [&](const Estimate& estimate) {
    if (evidence.earlier) return std::sqrt(std::max(0.0, estimate.fit.by_run.mean_square - estimate.fit.play_square));
    const double square = hold_out(evidence, estimate, evidence.run_folds).mean_square;
    return std::sqrt(std::max(0.0, square - estimate.fit.play_square));
  };
  const Estimate &before = answer.declared, &after = answer.reported.estimate;
  calibration.residuals_before = residuals_of(before);
  calibration.residuals_after = residuals_of(after);
  const RowsOfRuns outliers = outliers_of(measurement, evidence.floor, calibration.residuals_before);
  exclude_rows(outliers, calibration.residuals_after);
  calibration.rows_left_out = exclude_rows(outliers, calibration.residuals_before);
  calibration.before = figures(measurement, calibration.residuals_before, held_out_rms(before));
  calibration.after = figures(measurement, calibration.residuals_after, held_out_rms(after));
  calibration.iso_before = measurement::iso230(measurement, calibration.residuals_before);
  calibration.iso_after = measurement::iso230(measurement, calibration.residuals_after);
}

/// Measurement minus the declared joint: between sparse rows θ(α) bends by more than noise. As logged if the declared
/// joint has no equilibrium.
measurement::Measurement about_declared(const Mechanism& declared, const measurement::Measurement& measurement,
                                        const std::optional<joint::EarlierState>& earlier) {
  const joint::Readings model = joint::predict(declared, {}, measurement::bench_log(measurement), earlier);
  measurement::Measurement about = measurement;
  for (std::size_t i = 0; i < about.runs.size(); ++i) {
    for (std::size_t k = 0; k < model[i].size(); ++k) {
      if (!std::isfinite(model[i][k])) return measurement;
      about.runs[i].samples[k].theta -= model[i][k];
    }
  }
  return about;
}

/// Settled numbers; those that have no effect are reset to the declared value.
Imperfections meaningful_numbers(const Evidence& evidence, const Fit& fit, const Imperfections& numbers) {
  Imperfections at = numbers;
  for (const fusee::Effect* effect : fit.effects) at = settled(evidence, *effect, at);
  for (const EffectParameter* parameter : fit.parameters) {
    if (is_idle(*parameter, numbers)) reset(at, *parameter);
  }
  return at;
}

void describe_changes(const Evidence& evidence, const Selection& selection, Calibration& calibration) {
  calibration.difference = state_difference(evidence, selection.none, selection.best);
  const std::vector<double> sizes = sizes_by_scatter(evidence, selection.best);
  const double before = elementary::pow(calibration.difference.before, 2);
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    FoundEffect& effect = calibration.effects[i];
    effect.by_runs = sizes[i];
    const Fit& others = selection.without[i].usable ? selection.without[i] : selection.none;
    const StateDifference own = state_difference(evidence, others, selection.best);
    const double removed = elementary::pow(own.before, 2) - elementary::pow(own.after, 2);
    effect.share = before > 0 ? std::clamp(removed / before, 0.0, 1.0) : 0.0;
  }
}

/// Held-out rows for the validation of a correction: the runs kept for validation, or whole runs left out in turn. A
/// single run is validated with the numbers of all its strokes.
std::vector<HeldOutFit> left_out(const Evidence& evidence, const Estimate& estimate,
                                 const std::vector<std::string>& kept, const Imperfections& identified) {
  if (!kept.empty()) return {{kept, identified}};
  if (evidence.measurement.runs.size() < 2) return {{{evidence.measurement.runs.front().name}, identified}};
  const std::vector<Imperfections> numbers = estimates_without(evidence, estimate, evidence.run_folds);
  std::vector<HeldOutFit> all;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    all.push_back({evidence.run_names(evidence.run_folds[i]), numbers[i]});
  return all;
}

/// Adds the true causes of an effect's false positives to its group.
void take_audit(const std::vector<AuditResult>& audited, Calibration& calibration) {
  for (std::size_t i = 0; i < audited.size(); ++i) {
    FoundEffect& effect = calibration.effects[i];
    effect.audit = audited[i].counts;
    for (const fusee::Effect* other : audited[i].true_causes) {
      if (std::find(effect.group.begin(), effect.group.end(), other->name) == effect.group.end())
        effect.group.push_back(other->name);
    }
  }
}

Calibration calibrate_by_catalogue(const DeclaredMechanism& declared, const measurement::Measurement& measurement,
                                   const CalibrationOptions& options) {
  if (const auto reasons = why_not_testable(declared, measurement); !reasons.empty())
    return not_testable(declared, measurement, reasons);
  const measurement::Measurement fitted_runs = select_runs(measurement, options.hold_out, false);
  const measurement::NoiseFloor noise =
      measurement::noise_floor(about_declared(declared, fitted_runs, options.earlier));
  Evidence evidence = gather(declared, fitted_runs, std::max(noise.rms, 1e-9), options.earlier);
  evidence.floor_freedom = noise.degrees_of_freedom;
  if (evidence.blocks.size() < 2)
    return not_testable(declared, measurement,
                        {"There are fewer than two whole strokes of six rows or more: nothing can be held out."});
  FitterPool pool(evidence, options.context.stop);
  evidence.sizes =
      expected_sizes(catalogue(declared, measurement, options.more_effects, options.without), evidence, pool);
  Selection selection = select_effects(evidence, pool, options);
  if (!selection.none.usable)
    return not_testable(
        declared, measurement,
        {"The declared joint has no equilibrium at some of the logged angles and loads: the file and the data are not "
         "of one joint."});
  Calibration calibration;
  calibration.noise = noise;
  const measurement::Measurement kept = select_runs(measurement, options.hold_out, true);
  const ValidatedAnswer answer =
      options.earlier ? changes_beside(evidence, selection) : validate_answer(evidence, pool, kept, selection);
  const Fit& numbers = answer.reported.estimate.fit;
  calibration.dropped = answer.dropped;
  calibration.effects = found_effects(evidence, selection, answer.reported.reported);
  if (options.audit) {
    take_audit(audit(evidence, pool, selection), calibration);
    const std::vector<UnmodelledAlternative> unmodelled = find_unmodelled_alternatives(evidence, pool, selection);
    for (std::size_t i = 0; i < unmodelled.size(); ++i) calibration.effects[i].unmodelled = unmodelled[i];
  }
  calibration.null_combinations = null_combinations(evidence, selection);
  calibration.tried = selection.tried;
  calibration.detectable = detectable_sizes(evidence, pool, selection);
  calibration.identified = meaningful_numbers(evidence, numbers, numbers.at);
  calibration.left_out = left_out(evidence, answer.reported.estimate, options.hold_out, calibration.identified);
  for (HeldOutFit& left : calibration.left_out)
    left.identified = meaningful_numbers(evidence, numbers, left.identified);
  describe_errors(evidence, measurement, answer, calibration);
  name_held_out(evidence, calibration);
  validate(declared, kept, answer, calibration);
  apply_curve(measurement, answer.reported.curve, options.hold_out, calibration);
  conclude(evidence, selection, answer, calibration);
  if (!options.earlier) {
    calibration.next = next_measurements(evidence, selection, calibration);
    ask_for_both_sides(fitted_runs, calibration.next);
  }
  summarize(evidence, selection, calibration);
  if (options.earlier) describe_changes(evidence, selection, calibration);
  return calibration;
}

}  // namespace

void reject_curve(const measurement::Measurement& measurement, const std::string& why, Calibration& calibration) {
  if (!calibration.curve.used) return;
  add_curve(measurement, 1.0, calibration.after_effects.held_out_rms, calibration);
  calibration.curve.used = false;
  calibration.curve.why = why;
}

Calibration calibrate(const DeclaredMechanism& declared, const measurement::Measurement& measurement,
                      const CalibrationOptions& options) {
  if (!options.earlier) return calibrate_by_catalogue(declared, measurement, options);
  const JointKind kind = kind_of(declared);
  const std::vector<fusee::Effect> changes = changes_from(options.earlier->joint, kind);
  CalibrationOptions change_options = options;
  for (const fusee::Effect& effect : effects(kind)) change_options.without.push_back(effect.name);
  for (const fusee::Effect& change : changes) {
    change_options.more_effects.push_back(&change);
    std::erase(change_options.without, change.name);
  }
  for (const std::string& name : options.without) change_options.without.push_back(name);
  return calibrate_by_catalogue(declared, measurement, change_options);
}

}  // namespace fusee::calibration
