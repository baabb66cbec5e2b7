/// \file
/// Every number by which a plan decides, with its reason.
#pragma once

namespace fusee {

struct PlanThresholds {
  /// In standard errors: of two causes that these runs put so far apart, noise makes the wrong one fit better in 2 % of
  /// all cases (normal distribution at half of it).
  double told_apart = 4.1;
  /// The part of a cause's own signature by which a rival must miss it: what the model itself is trusted to.
  double model_share = 0.05;
  /// The same of what the joint gives way by under its load: an error of the tendons' model, smooth over the range.
  double deflection_share = 0.03;
  /// Of the usual size of a cause: half of them are smaller than two thirds of it, a third is still worth a name.
  double worth_a_name = 1.0 / 3.0;
  /// Log evidence by which one explanation must beat another: 50 to 1, the odds of 2 %.
  double odds = 3.9;
  /// Of all that could be told: a step that tells less is not worth its minutes.
  double least_gain = 0.004;
  /// Joints that are simulated for each of the three rates of blame: 2 % is 5 of 250.
  int worlds = 250;
};
inline constexpr PlanThresholds k_plan;

/// Minutes that changes on the bench take, as a rule of thumb.
struct BenchMinutes {
  double load = 1;      ///< another weight on the cord
  double mounting = 5;  ///< an encoder turned, and home set again, twice: there and back
  double reading = 2;   ///< a caliper, with two repeats
  double inspection = 5;
};
inline constexpr BenchMinutes k_bench_minutes;

}  // namespace fusee
