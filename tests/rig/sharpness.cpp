#include "rig/sharpness.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/text.h"
#include "fusee/joint.h"
#include "mechanism/effect.h"

namespace fusee::rig {
namespace {

constexpr double k_certain = 1000;                 // log odds
constexpr double k_two_sided = 1.959963984540054;  // 95 % of a normal distribution, in standard deviations

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_there(const std::string& effect, const Case& made) {
  const bool other_groove = made.hidden.groove_friction != HiddenFaults{}.groove_friction;
  return holds(made.faults, effect) || (other_groove && effect == "groove_friction");
}

/// A fitted number with its reported value.
struct ReportedNumber {
  const EffectParameter* parameter = nullptr;
  const calibration::FittedParameter* number = nullptr;
};

/// Numbers of the reported effects that are faults of the joint.
std::vector<ReportedNumber> true_numbers(const Case& made, const CaseInput& input,
                                         const calibration::Calibration& found) {
  std::vector<ReportedNumber> all;
  for (const calibration::FoundEffect& reported : found.effects) {
    const Effect* effect = find_effect(reported.name, kind_of(input.declared));
    if (effect == nullptr || !is_there(effect->name, made)) continue;
    for (const EffectParameter& parameter : effect->parameters) {
      const auto number =
          std::find_if(reported.parameters.begin(), reported.parameters.end(),
                       [&](const calibration::FittedParameter& one) { return one.name == parameter.name; });
      if (!parameter.searched && number != reported.parameters.end() && !is_idle(parameter, found.identified))
        all.push_back({&parameter, &*number});
    }
  }
  return all;
}

Eigen::VectorXd predicted(const CaseInput& input, const Imperfections& at) {
  const joint::Readings readings = joint::predict(input.declared, at, measurement::bench_log(input.measurement));
  std::vector<double> all;
  for (const std::vector<double>& run : readings) all.insert(all.end(), run.begin(), run.end());
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

Eigen::VectorXd slope(const CaseInput& input, const Imperfections& at, const EffectParameter& parameter) {
  const double value = value_of(at, parameter);
  const double low = std::max(parameter.least, value - parameter.step);
  const double high = std::min(parameter.most, value + parameter.step);
  Imperfections below = at, above = at;
  set_value(below, parameter, low);
  set_value(above, parameter, high);
  return (predicted(input, above) - predicted(input, below)) / (high - low);
}

/// Information of one row about the joint angle, 1/rad². A quantum is uniform noise. Noise with a memory counts as
/// fewer rows.
double information_of_row(const SensorPlan& sensors) {
  const double variance = sensors.noise * sensors.noise + sensors.quantum * sensors.quantum / 12;
  return (1 - sensors.colour) / (1 + sensors.colour) / variance;
}

/// Standard deviations by the Cramér-Rao bound; empty if the numbers are not determined.
Eigen::VectorXd bounds_of(const Case& made, const CaseInput& input, const Imperfections& at,
                          const std::vector<ReportedNumber>& numbers) {
  const auto count = static_cast<Eigen::Index>(numbers.size());
  const Eigen::Index rows = predicted(input, at).size();
  Eigen::MatrixXd J(rows, count);
  // Scaled by the steps: the numbers differ by many orders.
  for (Eigen::Index k = 0; k < count; ++k) {
    const EffectParameter& parameter = *numbers[static_cast<std::size_t>(k)].parameter;
    J.col(k) = parameter.step * slope(input, at, parameter);
  }
  J = J.unaryExpr([](double value) { return std::isfinite(value) ? value : 0.0; });
  const Eigen::MatrixXd information = information_of_row(made.sensors) * (J.transpose() * J);
  const Eigen::LDLT<Eigen::MatrixXd> factors(information);
  if (factors.info() != Eigen::Success || !(factors.rcond() > 1e-12)) return {};
  Eigen::VectorXd bounds = factors.solve(Eigen::MatrixXd::Identity(count, count)).diagonal().cwiseSqrt();
  for (Eigen::Index k = 0; k < count; ++k) bounds[k] *= numbers[static_cast<std::size_t>(k)].parameter->step;
  return bounds;
}

/// Standard deviation in the unit of the report.
double shown_bound(const EffectParameter& parameter, double value, double bound, const Mechanism& declared) {
  // A small step: the conversion may be a reciprocal.
  const double step = 0.01 * bound;
  return std::abs(parameter.shown(value + step, declared) - parameter.shown(value, declared)) / 0.01;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Means over some of the joints.
struct Column {
  std::size_t groups = 0, members = 0, alone = 0;
  std::vector<double> widths, widths_if_only;
};

Column column_of(const std::vector<Sharpness>& all, bool has_unmodelled) {
  Column column;
  for (const Sharpness& one : all) {
    if (one.has_unmodelled != has_unmodelled) continue;
    column.groups += one.group_sizes.size();
    for (const std::size_t size : one.group_sizes) {
      column.members += size;
      column.alone += size == 1 ? 1 : 0;
    }
    column.widths.insert(column.widths.end(), one.widths.begin(), one.widths.end());
    column.widths_if_only.insert(column.widths_if_only.end(), one.widths_if_only.begin(), one.widths_if_only.end());
  }
  return column;
}

std::string ratio(std::size_t part, std::size_t all, double factor) {
  return all == 0 ? "–" : fixed(factor * static_cast<double>(part) / static_cast<double>(all), 1);
}

std::string median_text(const std::vector<double>& values) {
  return values.empty() ? "–" : fixed(median(values), 2) + " (" + std::to_string(values.size()) + ")";
}

}  // namespace

double unmodelled_log_odds(const calibration::Calibration& found) {
  if (found.verdict == calibration::CalibrationVerdict::not_repeatable) return k_certain;
  double odds = -k_certain;
  for (const calibration::FoundEffect& effect : found.effects) odds = std::max(odds, -effect.unmodelled.log_odds);
  for (const calibration::DiscrepancyComponent& part : found.discrepancy) odds = std::max(odds, part.evidence);
  return std::min(odds, k_certain);
}

Sharpness sharpness_of(const Case& made, const CaseInput& input, const Answer& answer) {
  const calibration::Calibration& found = answer.found;
  Sharpness one;
  one.has_unmodelled = !answer.judgement.outside.empty();
  one.unmodelled_log_odds = unmodelled_log_odds(found);
  for (const calibration::FoundEffect& effect : found.effects) one.group_sizes.push_back(effect.group.size());
  const std::vector<ReportedNumber> numbers = true_numbers(made, input, found);
  if (numbers.empty()) return one;
  const Eigen::VectorXd bounds = bounds_of(made, input, found.identified, numbers);
  for (Eigen::Index k = 0; k < bounds.size(); ++k) {
    const auto& [parameter, number] = numbers[static_cast<std::size_t>(k)];
    const double bound = shown_bound(*parameter, value_of(found.identified, *parameter), bounds[k], input.declared);
    const double width = 2 * k_two_sided * bound;
    if (!(width > 0) || !(number->high > number->low)) continue;
    one.widths.push_back((number->high - number->low) / width);
    one.widths_if_only.push_back((number->high_if_only - number->low_if_only) / width);
  }
  return one;
}

double area_under_roc(const std::vector<double>& positive, const std::vector<double>& negative) {
  if (positive.empty() || negative.empty()) return std::numeric_limits<double>::quiet_NaN();
  double wins = 0;
  for (const double high : positive) {
    for (const double low : negative) wins += high > low ? 1.0 : high == low ? 0.5 : 0.0;
  }
  return wins / (static_cast<double>(positive.size()) * static_cast<double>(negative.size()));
}

std::string sharpness_table(const std::vector<Sharpness>& all) {
  const Column modelled = column_of(all, false), beside = column_of(all, true);
  std::string text = "\n| sharpness | faults of the catalogue or none | with an unmodelled fault |\n|---|--:|--:|\n";
  const auto row = [&](const char* words, const std::string& one, const std::string& other) {
    text += std::string("| ") + words + " | " + one + " | " + other + " |\n";
  };
  row("members of a reported group, mean", ratio(modelled.members, modelled.groups, 1),
      ratio(beside.members, beside.groups, 1));
  row("reported groups of one name, %", ratio(modelled.alone, modelled.groups, 100),
      ratio(beside.alone, beside.groups, 100));
  row("width of the 95 % interval over the Cramér-Rao bound, median (numbers)", median_text(modelled.widths),
      median_text(beside.widths));
  row("the same, if the reported effects are the only causes", median_text(modelled.widths_if_only),
      median_text(beside.widths_if_only));
  std::vector<double> positive, negative;
  for (const Sharpness& one : all) (one.has_unmodelled ? positive : negative).push_back(one.unmodelled_log_odds);
  const double area = area_under_roc(positive, negative);
  text += "\nAUROC of an unmodelled fault: " + (std::isnan(area) ? std::string("–") : fixed(area, 3)) + " (" +
          std::to_string(positive.size()) + " joints with, " + std::to_string(negative.size()) + " without).\n";
  return text;
}

}  // namespace fusee::rig
