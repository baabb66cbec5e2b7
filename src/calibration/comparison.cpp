#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "calibration/thresholds.h"
#include "fusee/calibration.h"
#include "measurement/value_range.h"

// The earlier joint is identified from its own runs. Then all runs are explained together, the earlier ones by that
// joint, the later ones by that joint with changes, both beside one discrepancy. An error of the identified joint is
// present in both states, so in the discrepancy, as is the scatter between runs. Changes are selected as effects are.

namespace fusee::calibration {
namespace {

const EffectParameter* find_parameter(const std::string& effect, const std::string& name, JointKind kind) {
  const fusee::Effect* found = find_effect(effect, kind);
  if (found == nullptr) found = find_effect(effect, JointKind::tendons);  // the zero of a joint declared by its ratio
  if (found == nullptr) return nullptr;
  const auto own = std::find_if(found->parameters.begin(), found->parameters.end(),
                                [&](const EffectParameter& p) { return p.name == name; });
  return own == found->parameters.end() ? nullptr : &*own;
}

/// The parameter as fitted to the earlier runs; null if it was not fitted.
const FittedParameter* find_fitted(const Calibration& before, const std::string& effect, const std::string& name) {
  for (const FoundEffect& found : before.effects) {
    for (const FittedParameter& own : found.parameters) {
      if (found.name == effect && own.name == name) return &own;
    }
  }
  return nullptr;
}

/// Factor on a number by slack, which leaves a share of the pretension.
double part_in_use(const EffectParameter& number, const Imperfections& joint) {
  return number.name == "pretension_N" ? joint.tendon.pretension_share() : 1.0;
}

StateChange change_of(const FoundEffect& effect, const DeclaredMechanism& declared, const Comparison& comparison) {
  const JointKind kind = kind_of(declared);
  const Imperfections& before = comparison.before.identified;
  const Imperfections after = changed(before, comparison.changes.identified, kind);
  StateChange change{effect.name, effect.group, effect.place, {}, effect.rms_drop, effect.by_runs, effect.share};
  for (const FittedParameter& fitted : effect.parameters) {
    const EffectParameter* number = find_parameter(effect.name, fitted.name, kind);
    if (number == nullptr) continue;
    const double was = part_in_use(*number, before) * shown_value(*number, before, declared);
    const double part = part_in_use(*number, after);
    ChangedParameter own{fitted.name, was, part * fitted.value, part * fitted.low - was, part * fitted.high - was};
    // A vanished cause is as uncertain as it was before.
    const FittedParameter* fitted_before = find_fitted(comparison.before, effect.name, fitted.name);
    if (fitted_before != nullptr && value_of(after, *number) <= number->least)
      own.low = own.after - fitted_before->high, own.high = own.after - fitted_before->low;
    change.parameters.push_back(own);
  }
  return change;
}

std::string range_words(const measurement::ValueRange& span) {
  return rounded(degrees(span.least), 3) + "° … " + rounded(degrees(span.most), 3) + "°";
}

/// Reason why the files cannot be two states of one joint; "" if they can.
std::string why_not_comparable(const ComparedRuns& runs) {
  const std::string one_of_both = " Name files of one joint after --before and --after.";
  const std::string& unit = runs.before.load_unit;
  if (!unit.empty() && !runs.after.load_unit.empty() && unit != runs.after.load_unit)
    return "The load is in " + unit + " before and in " + runs.after.load_unit +
           " after: these are not two states of one joint. Give the load in one unit.";
  const bool refused_before = !runs.before.not_testable.empty(), refused_after = !runs.after.not_testable.empty();
  if (refused_before != refused_after)
    return std::string("The runs ") + (refused_before ? "before" : "after") +
           " cannot be compared with the others: " + (refused_before ? runs.before : runs.after).not_testable.front() +
           one_of_both;
  const measurement::ValueRange before = measurement::value_range(runs.before, &measurement::Sample::alpha),
                                after = measurement::value_range(runs.after, &measurement::Sample::alpha);
  if (!before.any() || !after.any()) return "";
  const double shared = std::min(before.most, after.most) - std::max(before.least, after.least);
  if (shared < k_thresholds.joint_share * std::min(before.size(), after.size()))
    return "The motor moved over " + range_words(before) + " before and over " + range_words(after) +
           " after: these ranges hardly overlap. Measure the same range in both states.";
  return "";
}

/// Variance of the finite values.
class Variance {
 public:
  void take(double value) {
    if (!std::isfinite(value)) return;
    sum_ += value;
    squares_ += value * value;
    count_ += 1;
  }
  double value() const {
    return count_ > 0 ? std::max(0.0, squares_ / count_ - elementary::pow(sum_ / count_, 2)) : 0.0;
  }

 private:
  double sum_ = 0, squares_ = 0, count_ = 0;
};

/// Excess rms of the later runs over the earlier ones, relative to the earlier joint, by the rms of the motion. Offsets
/// do not count.
double part_of_motion(const ComparedRuns& runs, const std::vector<std::vector<double>>& about_before) {
  Variance own, later, motion;
  for (std::size_t r = 0; r < about_before.size(); ++r) {
    for (const double residual : about_before[r]) (r < runs.before.runs.size() ? own : later).take(residual);
  }
  for (const measurement::Run& run : runs.after.runs) {
    for (const measurement::Sample& sample : run.samples) motion.take(sample.theta);
  }
  return motion.value() > 0 ? std::sqrt(std::max(0.0, later.value() - own.value()) / motion.value()) : 0.0;
}

}  // namespace

std::string_view word(ComparisonVerdict verdict) {
  switch (verdict) {
    case ComparisonVerdict::not_testable:
      return "not_testable";
    case ComparisonVerdict::not_comparable:
      return "not_comparable";
    case ComparisonVerdict::no_change:
      return "no_change";
    case ComparisonVerdict::changed:
      return "changed";
  }
  return "";
}

Comparison compare_states(const DeclaredMechanism& declared, const ComparedRuns& runs,
                          const ComparisonOptions& options) {
  Comparison comparison;
  comparison.why = why_not_comparable(runs);
  if (!comparison.why.empty()) {
    comparison.verdict = ComparisonVerdict::not_comparable;
    return comparison;
  }
  CalibrationOptions of_one;
  of_one.audit = false;
  of_one.context = options.context;
  comparison.before = calibrate(declared, runs.before, of_one);
  if (comparison.before.verdict == CalibrationVerdict::not_testable) {
    comparison.why = "The runs before: " + comparison.before.summary;
    return comparison;
  }
  CalibrationOptions of_changes = of_one;
  of_changes.earlier = joint::EarlierState{comparison.before.identified, runs.before.runs.size()};
  comparison.changes = calibrate(declared, runs.both, of_changes);
  if (comparison.changes.verdict == CalibrationVerdict::not_testable) {
    comparison.why = comparison.changes.summary;
    return comparison;
  }
  comparison.difference = comparison.changes.difference;
  if (const double part = part_of_motion(runs, comparison.changes.residuals_before); part > k_thresholds.joint_share) {
    comparison.verdict = ComparisonVerdict::not_comparable;
    comparison.why = "The runs after differ from the joint before by " + rounded(100 * part, 2) +
                     " % of the motion, a moved zero aside: these are no two states of one joint. Check that all files "
                     "are of the joint "
                     "that SPEC describes.";
    return comparison;
  }
  const bool predicts = comparison.changes.after.held_out_rms < comparison.changes.before.held_out_rms;
  for (const FoundEffect& effect : comparison.changes.effects) {
    if (predicts && effect.rms_drop > 0 && effect.by_runs > k_thresholds.least_by_runs)
      comparison.found.push_back(change_of(effect, declared, comparison));
  }
  comparison.verdict = comparison.found.empty() ? ComparisonVerdict::no_change : ComparisonVerdict::changed;
  return comparison;
}

}  // namespace fusee::calibration
