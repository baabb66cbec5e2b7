#include "fusee/correction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/evidence.h"
#include "fusee/joint.h"
#include "fusee/transmission.h"
#include "measurement/value_range.h"
#include "mechanism/effect.h"
#include "transmission/target_motion.h"

// Errors are simulated with predict(), for the identified joint with its present pulley and with the pulley of
// corrected.toml. Errors on held-out rows are measured, and only their change by the pulley is simulated. The error is
// the deviation of the joint from the declared θ(α), without errors of the joint sensor's reading: a correction that
// followed a wrong reading would move a joint that is right. The table corrects the residual error with the corrected
// pulley.

namespace fusee::correction {
namespace {

/// Joint angles or errors, rad, by run and sample.
using Angles = std::vector<std::vector<double>>;

// ---- identified joint -----------------------------------------------------------------------------------------------

/// Mean logged tip force; the declared one if no load was logged.
double mean_load(const measurement::Measurement& measurement, const Mechanism& declared) {
  double sum = 0, count = 0;
  for (const measurement::Run& run : measurement.runs) {
    for (const measurement::Sample& sample : run.samples) {
      sum += run.has_load ? sample.load : declared.load.tip_force;
      count += 1;
    }
  }
  return count > 0 ? sum / count : declared.load.tip_force;
}

/// Upper bound of the motor's lost motion after a reversal, rad of α: play, and the twist of a joint declared by a
/// ratio until it overcomes friction. The play is doubled as a margin. The friction is doubled because a cable's last
/// contact slips at twice the mean friction.
double lost_motion(const Imperfections& found, const Mechanism& declared, double load) {
  const RatioJointError& joint = found.ratio_joint;
  const double play = 2 * (found.shaft.backlash + joint.slack);
  if (!declared.transmission) return play;
  const double friction = 2 * joint.friction.at(load);
  const double twist =
      2 * joint.compliance * friction + joint.waves.gained(load + friction) - joint.waves.gained(load - friction);
  return play + std::abs(declared.transmission->ratio * twist);
}

/// Combines earlier and new imperfections. Earlier imperfections of the mechanism are part of the model of this
/// calibration, so the new ones add to them. All others are replaced. correct() decides the mean load.
Imperfections combined(const DeclaredMechanism& declared, const Imperfections& found) {
  Imperfections total = merge_findings(declared.identified, found, kind_of(declared));
  total.joint.mean_load = declared.identified.joint.mean_load;
  return total;
}

/// The identified joint with a joint sensor that reads right. The zero of a joint declared by a ratio is arbitrary, and
/// stays.
Imperfections with_right_reading(Imperfections found, const Mechanism& declared) {
  found.sensor = {.zero = declared.transmission ? found.sensor.zero : 0.0};
  return found;
}

/// True if both sheaths end at the same places. Their other properties act through the law for which the pulley is
/// drawn.
bool has_same_exits(const Sheath& one, const Sheath& other) {
  return one.is_there() == other.is_there() && one.exit_across == other.exit_across &&
         one.exit_above == other.exit_above;
}

/// True if both mechanisms have the same pulley. Friction moves the joint, not the curves.
bool has_same_pulley(const DeclaredMechanism& a, const DeclaredMechanism& b) {
  joint::IdentifiedJoint one = joint::identified_joint(a), other = joint::identified_joint(b);
  one.mechanism = transmission::without_friction(std::move(one.mechanism));
  other.mechanism = transmission::without_friction(std::move(other.mechanism));
  return one.outline == other.outline && one.mechanism.joint == other.mechanism.joint &&
         one.mechanism.guides == other.mechanism.guides &&
         has_same_exits(one.mechanism.sheath, other.mechanism.sheath) &&
         one.mechanism.pulley == other.mechanism.pulley && one.mechanism.material == other.mechanism.material;
}

/// The reason why the corrected pulley cannot be made; "" if it can.
std::string why_infeasible(const DeclaredMechanism& corrected) {
  profile::SynthesisOptions options;
  options.advice = false;
  const Mechanism mechanism = joint::identified_joint(corrected).mechanism;
  const profile::SynthesisResult made = profile::synthesise(mechanism, options);
  // The build decides whether a multi-turn pulley is feasible.
  const bool may_be_multi_turn = profile::needs_multi_turn(made) && !profile::kept_to_one_turn(mechanism);
  return made.made() || may_be_multi_turn ? "" : made.brief();
}

// ---- errors ---------------------------------------------------------------------------------------------------------

/// Deviation of angles from the target motion, rad, by run and sample.
Angles errors(const measurement::Measurement& measurement, const transmission::TargetMotion& law, Angles theta) {
  for (std::size_t r = 0; r < theta.size(); ++r) {
    for (std::size_t i = 0; i < theta[r].size(); ++i) theta[r][i] -= law.theta(measurement.runs[r].samples[i].alpha);
  }
  return theta;
}

/// Calls visit(run index, sample index, stroke) for every sample with known play state.
template <typename Visit>
void for_each_known(const measurement::Measurement& measurement, Visit visit) {
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    for (const measurement::Stroke& stroke : measurement.runs[r].strokes) {
      if (stroke.partial) continue;
      for (std::size_t i = stroke.first; i <= stroke.last; ++i) visit(r, i, stroke);
    }
  }
}

/// Rms of the error about `zero`, rad, over all samples with known play state.
double rms(const measurement::Measurement& measurement, const Angles& error, double zero) {
  double squares = 0, count = 0;
  for_each_known(measurement, [&](std::size_t r, std::size_t i, const measurement::Stroke&) {
    if (!std::isfinite(error[r][i])) return;
    const double off = error[r][i] - zero;
    squares += off * off;
    count += 1;
  });
  return count > 0 ? std::sqrt(squares / count) : 0;
}

/// Rms of the removed part of an error, from the rms values before and after.
double removed_rms(double before, double after) { return std::sqrt(std::max(0.0, before * before - after * after)); }

// ---- the table ------------------------------------------------------------------------------------------------------

/// Piecewise linear function of α at even distances, constant beyond its ends.
struct Curve {
  measurement::ValueRange alphas;
  std::vector<double> values;

  double at(double alpha) const {
    const measurement::Bins pieces{alphas, static_cast<int>(values.size()) - 1};
    const auto i = static_cast<std::size_t>(pieces.bin(alpha));
    const double share = pieces.place(alpha) - static_cast<double>(i);
    return values[i] + share * (values[i + 1] - values[i]);
  }
};

/// Mean of values at evenly spaced nodes of α; a node without values takes those of its nearest neighbour.
class NodeMeans {
 public:
  explicit NodeMeans(const measurement::ValueRange& alphas)
      : bins_{alphas, k_intervals}, sums_(k_intervals + 1, 0), weights_(k_intervals + 1, 0) {}

  /// Distributes the value over the two nodes next to `alpha`.
  void add(double alpha, double value) {
    const auto i = static_cast<std::size_t>(bins_.bin(alpha));
    const double share = bins_.place(alpha) - static_cast<double>(i);
    sums_[i] += (1 - share) * value;
    weights_[i] += 1 - share;
    sums_[i + 1] += share * value;
    weights_[i + 1] += share;
  }

  Curve curve() const {
    constexpr double k_least_weight = 0.2;  // values; a node with less counts as one without values
    Curve curve{bins_.span, std::vector<double>(k_intervals + 1, 0)};
    for (int i = 0; i <= k_intervals; ++i) {
      int nearest = -1;
      for (int step = 0; step <= k_intervals && nearest < 0; ++step) {
        for (const int j : {i - step, i + step}) {
          if (j >= 0 && j <= k_intervals && weights_[static_cast<std::size_t>(j)] > k_least_weight) nearest = j;
        }
      }
      const auto from = static_cast<std::size_t>(nearest);
      if (nearest >= 0) curve.values[static_cast<std::size_t>(i)] = sums_[from] / weights_[from];
    }
    return curve;
  }

 private:
  static constexpr int k_intervals = 40;
  measurement::Bins bins_;
  std::vector<double> sums_, weights_;
};

/// Error while α rises and while it falls.
struct DirectionalCurves {
  Curve up, down;
};

/// Mean error of either direction. Samples just after a reversal are omitted: within `play`, rad of α, the joint does
/// not move.
DirectionalCurves directional_curves(const measurement::Measurement& measurement, const Angles& error, double play) {
  const measurement::ValueRange alphas = measurement::value_range(measurement, &measurement::Sample::alpha);
  NodeMeans up(alphas), down(alphas);
  for_each_known(measurement, [&](std::size_t r, std::size_t i, const measurement::Stroke& stroke) {
    const std::vector<measurement::Sample>& samples = measurement.runs[r].samples;
    const bool is_play_taken_up = std::abs(samples[i].alpha - samples[stroke.first].alpha) > play;
    if (!std::isfinite(error[r][i]) || !is_play_taken_up) return;
    NodeMeans& means = stroke.direction > 0 ? up : down;
    means.add(samples[i].alpha, error[r][i]);
  });
  return {up.curve(), down.curve()};
}

/// Residual error if the motor follows the table.
Angles with_table(const measurement::Measurement& measurement, Angles error, const DirectionalCurves& table) {
  for_each_known(measurement, [&](std::size_t r, std::size_t i, const measurement::Stroke& stroke) {
    error[r][i] -= (stroke.direction > 0 ? table.up : table.down).at(measurement.runs[r].samples[i].alpha);
  });
  return error;
}

/// Interpolates α at `theta` in rows that are sorted by θ.
double alpha_at(const std::vector<LawRow>& rows, double theta) {
  const auto above = std::lower_bound(rows.begin() + 1, rows.end() - 1, theta,
                                      [](const LawRow& row, double value) { return row.theta < value; });
  const LawRow& low = *(above - 1);
  const double span = above->theta - low.theta;
  return span > 0 ? low.alpha + (above->alpha - low.alpha) * (theta - low.theta) / span : low.alpha;
}

/// Error of the joint, rad: from effects, and from the empirical curve of the unmodelled error.
struct JointDeviation {
  const DirectionalCurves& effects;
  const calibration::EmpiricalCurve* curve;  ///< null if there is none
  measurement::ValueRange alphas;            ///< range in which both are known

  double at(double alpha, bool rising) const {
    const double by_effects = (rising ? effects.up : effects.down).at(alpha);
    return curve != nullptr ? by_effects + curve->at(alpha, rising) : by_effects;
  }
};

measurement::ValueRange common_span(const DirectionalCurves& effects, const calibration::EmpiricalCurve* curve) {
  measurement::ValueRange alphas = effects.up.alphas;
  if (curve == nullptr) return alphas;
  alphas.least = std::max(alphas.least, curve->alpha.front());
  alphas.most = std::min(alphas.most, curve->alpha.back());
  return alphas;
}

/// Motion of the joint in one direction, sorted by θ. Rows in which θ does not grow are omitted.
std::vector<LawRow> motion_rows(const transmission::TargetMotion& law, const JointDeviation& deviation, bool rising) {
  constexpr int steps = 800;
  std::vector<LawRow> rows;
  for (int i = 0; i <= steps; ++i) {
    const double alpha = deviation.alphas.least + deviation.alphas.size() * i / steps;
    rows.push_back({alpha, law.theta(alpha) + deviation.at(alpha, rising)});
  }
  if (rows.back().theta < rows.front().theta) std::reverse(rows.begin(), rows.end());
  std::vector<LawRow> growing{rows.front()};
  for (const LawRow& row : rows) {
    if (row.theta > growing.back().theta) growing.push_back(row);
  }
  return growing;
}

/// Motion of the joint in one direction, from which motor angles are read.
struct MotorPath {
  std::vector<LawRow> all;      ///< with effects and the empirical curve
  std::vector<LawRow> effects;  ///< without the empirical curve

  bool any() const { return all.size() > 1 && effects.size() > 1; }
  double alpha(double theta) const { return alpha_at(all, theta); }
  /// Part of alpha() from the empirical curve.
  double of_curve(double theta) const { return alpha_at(all, theta) - alpha_at(effects, theta); }
};

MotorPath motion_of(const transmission::TargetMotion& law, const JointDeviation& deviation, bool rising) {
  return {motion_rows(law, deviation, rising),
          motion_rows(law, {deviation.effects, nullptr, deviation.effects.up.alphas}, rising)};
}

std::vector<CompensationRow> compensation_rows(const transmission::TargetMotion& law, const JointDeviation& deviation) {
  const MotorPath rising = motion_of(law, deviation, /*rising=*/true),
                  falling = motion_of(law, deviation, /*rising=*/false);
  if (!rising.any() || !falling.any()) return {};
  const double low = std::max(rising.all.front().theta, falling.all.front().theta),
               high = std::min(rising.all.back().theta, falling.all.back().theta);
  std::vector<CompensationRow> table;
  constexpr int steps = 60;
  for (int i = 0; i <= steps && high > low; ++i) {
    const double theta = low + (high - low) * i / steps;
    table.push_back(
        {theta, rising.alpha(theta), falling.alpha(theta), rising.of_curve(theta), falling.of_curve(theta)});
  }
  return table;
}

// ---- held-out rows --------------------------------------------------------------------------------------------------

/// Reason for a file that is not written.
constexpr const char* k_no_better = "it does not improve rows that were not fitted";

/// Rows of a run on which a correction is evaluated.
constexpr std::size_t k_rows_a_run = 300;

/// The identified joint with its present pulley and with the corrected one.
struct CorrectedJoint {
  const DeclaredMechanism& declared;
  const DeclaredMechanism& corrected;
  bool has_pulley = false;
  double assembly_angle = 0;  ///< motor angle at which the corrected pulley's tendons are tied, rad

  /// Joint angles with the present pulley.
  Angles with_present_pulley(const Imperfections& found, const joint::BenchLog& log) const {
    return joint::predict(joint::expected_joint(declared), found, log);
  }
  /// Joint angles with the corrected pulley; with the present one if there is no corrected one.
  Angles with_corrected_pulley(const Imperfections& found, const joint::BenchLog& log) const {
    if (!has_pulley) return with_present_pulley(found, log);
    // The corrected mechanism contains the other imperfections.
    Imperfections further = beyond_mechanism(found, kind_of(declared));
    further.motor.offset -= assembly_angle;
    return joint::predict(joint::expected_joint(corrected), further, log);
  }
};

/// Error of the joint with the corrected pulley and these imperfections: the content of the table.
DirectionalCurves table_of(const CorrectedJoint& joint, const measurement::Measurement& measurement,
                           const transmission::TargetMotion& law, const Imperfections& found) {
  return directional_curves(
      measurement, errors(measurement, law, joint.with_corrected_pulley(found, measurement::bench_log(measurement))),
      lost_motion(found, joint.declared, mean_load(measurement, joint.declared)));
}

/// Sums of squared errors on held-out rows, rad²: as measured, with the corrected pulley, and with the table.
struct HeldOutSquares {
  double as_measured = 0, with_pulley = 0, with_table = 0;
  double rows = 0;

  /// Adds rows. `error`: as measured; `change`: by the corrected pulley, simulated; `zero`: part of `error`
  /// and of `table` that is no error, the arbitrary zero of a joint declared by a ratio.
  void add(const measurement::Measurement& held_out, const Angles& error, const Angles& change,
           const DirectionalCurves& table, double zero) {
    for_each_known(held_out, [&](std::size_t r, std::size_t i, const measurement::Stroke& stroke) {
      const double measured_error = error[r][i] - zero, pulley_error = measured_error + change[r][i];
      if (!std::isfinite(pulley_error)) return;
      const Curve& correction = stroke.direction > 0 ? table.up : table.down;
      const double table_error = pulley_error - (correction.at(held_out.runs[r].samples[i].alpha) - zero);
      as_measured += measured_error * measured_error;
      with_pulley += pulley_error * pulley_error;
      with_table += table_error * table_error;
      rows += 1;
    });
  }
  double removed_by_pulley() const {
    return rows > 0 ? removed_rms(std::sqrt(as_measured / rows), std::sqrt(with_pulley / rows)) : 0;
  }
  double removed_by_table() const {
    return rows > 0 ? removed_rms(std::sqrt(with_pulley / rows), std::sqrt(with_table / rows)) : 0;
  }
};

/// The runs of these names, or with `others` all other runs.
measurement::Measurement some_runs(measurement::Measurement measurement, const std::vector<std::string>& names,
                                   bool others) {
  std::erase_if(measurement.runs, [&](const measurement::Run& run) {
    const bool is_named = std::find(names.begin(), names.end(), run.name) != names.end();
    return is_named == others;
  });
  return measurement;
}

/// Evaluates each run with the parameters and table from the other runs. With a single run the table is made from it.
HeldOutSquares held_out_squares(const CorrectedJoint& joint, const measurement::Measurement& measurement,
                                const transmission::TargetMotion& law,
                                const std::vector<calibration::HeldOutFit>& fits) {
  const measurement::Measurement thinned = calibration::with_fewer_rows(measurement, k_rows_a_run);
  HeldOutSquares all;
  for (const calibration::HeldOutFit& fit : fits) {
    const measurement::Measurement held_out = some_runs(thinned, fit.runs, /*others=*/false),
                                   others = some_runs(thinned, fit.runs, /*others=*/true);
    const joint::BenchLog log = measurement::bench_log(held_out);
    const Imperfections found = with_right_reading(fit.identified, joint.declared);
    Angles theta, change = joint.with_corrected_pulley(found, log);
    const Angles present = joint.with_present_pulley(found, log),
                 reading = found == fit.identified ? present : joint.with_present_pulley(fit.identified, log);
    for (std::size_t r = 0; r < held_out.runs.size(); ++r) {
      theta.emplace_back();
      for (std::size_t i = 0; i < held_out.runs[r].samples.size(); ++i) {
        theta[r].push_back(held_out.runs[r].samples[i].theta - (reading[r][i] - present[r][i]));
        change[r][i] -= present[r][i];
      }
    }
    const DirectionalCurves table = table_of(joint, others.runs.empty() ? held_out : others, law, found);
    all.add(held_out, errors(held_out, law, std::move(theta)), change, table, found.sensor.zero);
  }
  return all;
}

/// Fills the reasons for which a file is not written.
void fill_reasons(const calibration::Calibration& calibration, Correction& correction) {
  if (calibration.effects.empty()) {
    correction.why_no_pulley_file = "no effect was found that the declared file lacks";
  } else if (!(calibration.after.held_out_rms < calibration.before.held_out_rms)) {
    correction.why_no_pulley_file = k_no_better;
  }
  const bool is_reading_alone =
      !calibration.effects.empty() &&
      std::all_of(calibration.effects.begin(), calibration.effects.end(),
                  [](const auto& effect) { return effect.place == ChainPlace::joint_sensor; });
  if (correction.table.empty()) {
    correction.why_no_table = "no range of the joint was measured in both directions";
  } else if (is_reading_alone && correction.by_curve == 0) {
    const bool is_certain = std::all_of(calibration.effects.begin(), calibration.effects.end(),
                                        [](const auto& effect) { return effect.group.size() <= 1; });
    correction.why_no_table = is_certain ? "the joint sensor reads wrong, and the joint is right"
                                         : "the joint sensor may read wrong, which a table would follow";
  } else if (!(correction.by_table > 0)) {
    correction.why_no_table = k_no_better;
  }
  if (!correction.why_no_table.empty()) correction.table.clear();
}

}  // namespace

Correction correct(const DeclaredMechanism& declared, const measurement::Measurement& measurement,
                   const calibration::Calibration& calibration) {
  const Imperfections& found = calibration.identified;
  Correction correction;
  correction.identified = combined(declared, found);
  const bool is_compliant =
      found.tendon.stretch != 0 || found.sheath.compliance != 0 || found.joint.weight != WeightError{};
  // The pulley of a compliant joint is drawn for the measured load, here as its excess over the declared one.
  if (is_compliant && !declared.transmission)
    correction.identified.joint.mean_load = mean_load(measurement, declared) - declared.load.tip_force;
  const transmission::TargetMotion law(declared);
  if (!measurement::value_range(measurement, &measurement::Sample::alpha).any() || !law.exists()) {
    fill_reasons(calibration, correction);
    return correction;
  }

  DeclaredMechanism corrected = declared;
  corrected.identified = correction.identified;
  correction.has_pulley = !declared.transmission && !has_same_pulley(declared, corrected);
  if (correction.has_pulley) correction.infeasible = why_infeasible(corrected);
  if (!correction.infeasible.empty()) correction.has_pulley = false;
  const auto held_out_rows = [&](double assembly_angle) {
    return held_out_squares({declared, corrected, correction.has_pulley, assembly_angle}, measurement, law,
                            calibration.left_out);
  };
  // Without the table, the tendons are tied at assembly_angle(). With the table they are tied at 0, and the
  // table contains that offset.
  if (correction.has_pulley) {
    correction.by_pulley = held_out_rows(joint::assembly_angle(corrected)).removed_by_pulley();
    correction.has_pulley = correction.by_pulley > 0;
    if (!correction.has_pulley) correction.why_no_pulley_file = k_no_better;
  }
  correction.by_table = held_out_rows(/*assembly_angle=*/0).removed_by_table();
  if (correction.has_pulley && declared.pulley.law == Law::compensate)
    correction.round = joint::round_choice(corrected);
  if (correction.has_pulley) correction.assembly_angle = joint::assembly_angle(corrected);

  const CorrectedJoint joint{declared, corrected, correction.has_pulley};
  const joint::BenchLog log = measurement::bench_log(measurement);
  const Imperfections right = with_right_reading(found, declared);
  const Angles present_error = errors(measurement, law, joint.with_present_pulley(right, log)),
               corrected_error = errors(measurement, law, joint.with_corrected_pulley(right, log));
  const DirectionalCurves table =
      directional_curves(measurement, corrected_error, lost_motion(found, declared, mean_load(measurement, declared)));
  // The zero of a joint declared by a ratio is arbitrary, so its offset is not an error.
  const double zero = right.sensor.zero;
  correction.error_now = rms(measurement, present_error, zero);
  correction.error_with_pulley = rms(measurement, corrected_error, zero);
  correction.error_with_table = rms(measurement, with_table(measurement, corrected_error, table), 0.0);
  const calibration::EmpiricalCurve* curve = calibration.curve.used ? &calibration.curve : nullptr;
  if (curve != nullptr) correction.by_curve = curve->gain;
  correction.by_table = elementary::hypot(correction.by_table, correction.by_curve);
  correction.table = compensation_rows(law, {table, curve, common_span(table, curve)});
  fill_reasons(calibration, correction);
  return correction;
}

}  // namespace fusee::correction
