/// \file
/// Decision thresholds of the planner, each with its reason.
#pragma once

namespace fusee::plan {

struct PlanThresholds {
  /// Separation in standard errors at which two causes count as resolved. At this distance noise makes the wrong cause
  /// fit better in 2 % of cases: the normal distribution beyond half the distance.
  double resolved_distance = 4.1;
  /// Accuracy of an effect's model: a rival within this share of a cause's response is not resolved from it.
  double model_share = 0.05;
  /// Error of the tendon model, smooth over the range, as a share of the elastic deflection.
  double deflection_share = 0.03;
  /// Smallest share of a cause's usual size that is worth identifying. Half of all causes are smaller than 2/3 of their
  /// usual size, the median of a normal distribution.
  double least_share = 1.0 / 3.0;
  /// Log evidence by which one explanation must exceed another: log 50, for odds of 50 : 1, or 2 %.
  double odds = 3.9;
  /// Smallest gain in separation (scale 0 … 1) that makes a step worth its minutes.
  double least_gain = 0.004;
  /// Synthetic data sets for each of the three false-positive rates: 2 % is 5 of 250.
  int samples = 250;
};
inline constexpr PlanThresholds k_plan;

/// Minutes that changes and measurements at the bench take, as a rule of thumb.
struct BenchMinutes {
  double load = 1;        ///< another weight on the cord
  double mounting = 5;    ///< an encoder turned and home set again, twice: there and back
  double reading = 2;     ///< a dimension by caliper, with two repeats
  double inspection = 5;  ///< any other measurement
};
inline constexpr BenchMinutes k_bench_minutes;

}  // namespace fusee::plan
