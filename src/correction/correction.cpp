#include "fusee/correction/correction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/evidence.h"
#include "fusee/joint/simulate.h"
#include "fusee/mechanism/effect.h"
#include "fusee/transmission/guide_friction.h"
#include "measurement/seen_span.h"
#include "transmission/declared_law.h"

// Everything here is re-simulated with predict(): the joint as it was found with the pulley it has, and the same joint
// with the pulley that corrected.toml makes. What either misses of the declared θ(α) is its error; what the second
// still misses goes into the table.

namespace fusee {
namespace {

using Angles = std::vector<std::vector<double>>;

// ---- what is known now ----------------------------------------------------------------------------------------------

/// Mean of the logged tip force; the declared one where none was logged.
double mean_load(const Measurement& measurement, const Mechanism& declared) {
  double sum = 0, count = 0;
  for (const Run& run : measurement.runs) {
    for (const Sample& sample : run.samples) {
      sum += run.has_load ? sample.load : declared.load.tip_force;
      count += 1;
    }
  }
  return count > 0 ? sum / count : declared.load.tip_force;
}

/// Upper bound of the motor's way after a reversal until the joint follows in full, rad of α. A cable's last contact
/// holds twice the mean friction.
double lost_motion(const Imperfections& found, const Mechanism& declared, double load) {
  const RatioJointError& joint = found.ratio_joint;
  const double play = 2 * (found.shaft.backlash + joint.slack);
  if (!declared.transmission) return play;
  const double held = 2 * joint.friction.at(load);
  const double turned = 2 * joint.compliance * held + joint.waves.gained(load + held) - joint.waves.gained(load - held);
  return play + std::abs(declared.transmission->ratio * turned);
}

/// What earlier calibrations found was part of the declared model this time, so far as a mechanism can have it; the
/// rest was found anew.
Imperfections composed(const DeclaredMechanism& declared, const Imperfections& found) {
  Imperfections total = merge_findings(declared.identified, found, kind_of(declared));
  total.joint.mean_load = declared.identified.joint.mean_load;
  return total;
}

/// What a sheath takes and gives is in the law that the pulley is drawn for.
bool same_mouths(const Sheath& one, const Sheath& other) {
  return one.is_there() == other.is_there() && one.exit_across == other.exit_across &&
         one.exit_above == other.exit_above;
}

/// Friction moves the joint, not the curves.
bool same_drawing(const DeclaredMechanism& a, const DeclaredMechanism& b) {
  JointAsItIs one = as_it_is(a), other = as_it_is(b);
  one.mechanism = without_friction(std::move(one.mechanism));
  other.mechanism = without_friction(std::move(other.mechanism));
  return one.outline == other.outline && one.mechanism.joint == other.mechanism.joint &&
         one.mechanism.guides == other.mechanism.guides && same_mouths(one.mechanism.sheath, other.mechanism.sheath) &&
         one.mechanism.pulley == other.mechanism.pulley && one.mechanism.material == other.mechanism.material;
}

std::string why_infeasible(const DeclaredMechanism& corrected) {
  SynthesisOptions options;
  options.advice = false;
  const Mechanism mechanism = as_it_is(corrected).mechanism;
  const SynthesisResult made = synthesise(mechanism, options);
  // Whether a body can be wound several times is left to the build.
  const bool is_wound_on = need_several_turns(made) && !kept_to_one_turn(mechanism);
  return made.made() || is_wound_on ? "" : made.brief();
}

// ---- errors ---------------------------------------------------------------------------------------------------------

/// By how much simulated angles miss the declared law.
Angles errors(const Measurement& measurement, const DeclaredLaw& law, Angles theta) {
  for (std::size_t r = 0; r < theta.size(); ++r) {
    for (std::size_t i = 0; i < theta[r].size(); ++i) theta[r][i] -= law.theta(measurement.runs[r].samples[i].alpha);
  }
  return theta;
}

/// Calls visit(run index, sample index, stroke) for every sample whose play is known.
template <typename Visit>
void for_each_known(const Measurement& measurement, Visit visit) {
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    for (const Stroke& stroke : measurement.runs[r].strokes) {
      if (stroke.partial) continue;
      for (std::size_t i = stroke.first; i <= stroke.last; ++i) visit(r, i, stroke);
    }
  }
}

/// About `zero`.
double rms(const Measurement& measurement, const Angles& error, double zero) {
  double squares = 0, count = 0;
  for_each_known(measurement, [&](std::size_t r, std::size_t i, const Stroke&) {
    if (!std::isfinite(error[r][i])) return;
    const double off = error[r][i] - zero;
    squares += off * off;
    count += 1;
  });
  return count > 0 ? std::sqrt(squares / count) : 0;
}

/// The part of `all` that goes when `rest` stays: both rms.
double gone(double all, double rest) { return std::sqrt(std::max(0.0, all * all - rest * rest)); }

// ---- the table ------------------------------------------------------------------------------------------------------

/// A function of α by straight pieces between evenly spaced places; flat beyond them.
struct Curve {
  SeenSpan seen;
  std::vector<double> values;

  double at(double alpha) const {
    const Bins pieces{seen, static_cast<int>(values.size()) - 1};
    const auto i = static_cast<std::size_t>(pieces.bin(alpha));
    const double share = pieces.place(alpha) - static_cast<double>(i);
    return values[i] + share * (values[i + 1] - values[i]);
  }
};

/// Mean over places of α, empty places filled from their neighbours.
class BinnedMean {
 public:
  explicit BinnedMean(const SeenSpan& seen)
      : bins_{seen, k_places}, sums_(k_places + 1, 0), weights_(k_places + 1, 0) {}

  /// Shared between the two places around `alpha`.
  void add(double alpha, double value) {
    const auto i = static_cast<std::size_t>(bins_.bin(alpha));
    const double share = bins_.place(alpha) - static_cast<double>(i);
    sums_[i] += (1 - share) * value;
    weights_[i] += 1 - share;
    sums_[i + 1] += share * value;
    weights_[i + 1] += share;
  }

  Curve curve() const {
    Curve curve{bins_.span, std::vector<double>(k_places + 1, 0)};
    for (int i = 0; i <= k_places; ++i) {
      int nearest = -1;
      for (int step = 0; step <= k_places && nearest < 0; ++step) {
        for (const int j : {i - step, i + step}) {
          if (j >= 0 && j <= k_places && weights_[static_cast<std::size_t>(j)] > 0.2) nearest = j;
        }
      }
      const auto from = static_cast<std::size_t>(nearest);
      if (nearest >= 0) curve.values[static_cast<std::size_t>(i)] = sums_[from] / weights_[from];
    }
    return curve;
  }

 private:
  static constexpr int k_places = 40;
  Bins bins_;
  std::vector<double> sums_, weights_;
};

/// What the joint is off on its way up and on its way down, play taken up: just after a reversal it still stands where
/// it stood.
struct BothWays {
  Curve up, down;
};

BothWays both_ways(const Measurement& measurement, const Angles& error, double play) {
  const SeenSpan seen = seen_span(measurement, &Sample::alpha);
  BinnedMean up(seen), down(seen);
  for_each_known(measurement, [&](std::size_t r, std::size_t i, const Stroke& stroke) {
    const std::vector<Sample>& samples = measurement.runs[r].samples;
    const bool taken_up = std::abs(samples[i].alpha - samples[stroke.first].alpha) > play;
    if (std::isfinite(error[r][i]) && taken_up) (stroke.direction > 0 ? up : down).add(samples[i].alpha, error[r][i]);
  });
  return {up.curve(), down.curve()};
}

/// What stays when the motor goes where the table says.
Angles tabled(const Measurement& measurement, Angles error, const BothWays& table) {
  for_each_known(measurement, [&](std::size_t r, std::size_t i, const Stroke& stroke) {
    error[r][i] -= (stroke.direction > 0 ? table.up : table.down).at(measurement.runs[r].samples[i].alpha);
  });
  return error;
}

/// α at which a curve of (θ, α), sorted by θ, has `theta`.
double alpha_at(const std::vector<LawRow>& rows, double theta) {
  const auto above = std::lower_bound(rows.begin() + 1, rows.end() - 1, theta,
                                      [](const LawRow& row, double value) { return row.theta < value; });
  const LawRow& low = *(above - 1);
  const double span = above->theta - low.theta;
  return span > 0 ? low.alpha + (above->alpha - low.alpha) * (theta - low.theta) / span : low.alpha;
}

/// What the joint is off by: what effects make of it, and the curve of what has no name.
struct Off {
  const BothWays& effects;
  const EmpiricalCurve* curve;  ///< null: none
  SeenSpan seen;                ///< where all of it is known

  double at(double alpha, bool rising) const {
    const double known = (rising ? effects.up : effects.down).at(alpha);
    return curve != nullptr ? known + curve->at(alpha, rising) : known;
  }
};

SeenSpan seen_in(const BothWays& effects, const EmpiricalCurve* curve) {
  SeenSpan seen = effects.up.seen;
  if (curve == nullptr) return seen;
  seen.least = std::max(seen.least, curve->alpha.front());
  seen.most = std::min(seen.most, curve->alpha.back());
  return seen;
}

/// Where the joint is, moving one way, by growing θ.
std::vector<LawRow> motion_rows(const DeclaredLaw& law, const Off& off, bool rising) {
  constexpr int places = 800;
  std::vector<LawRow> rows;
  for (int i = 0; i <= places; ++i) {
    const double alpha = off.seen.least + off.seen.size() * i / places;
    rows.push_back({alpha, law.theta(alpha) + off.at(alpha, rising)});
  }
  if (rows.back().theta < rows.front().theta) std::reverse(rows.begin(), rows.end());
  std::vector<LawRow> growing{rows.front()};
  for (const LawRow& row : rows) {
    if (row.theta > growing.back().theta) growing.push_back(row);
  }
  return growing;
}

/// Where the motor must stand with all that is known, and what of it is the curve's.
struct Motion {
  std::vector<LawRow> all, effects;

  bool any() const { return all.size() > 1 && effects.size() > 1; }
  double alpha(double theta) const { return alpha_at(all, theta); }
  double of_curve(double theta) const { return alpha_at(all, theta) - alpha_at(effects, theta); }
};

Motion motion_of(const DeclaredLaw& law, const Off& off, bool rising) {
  return {motion_rows(law, off, rising), motion_rows(law, {off.effects, nullptr, off.effects.up.seen}, rising)};
}

std::vector<CompensationRow> compensation_rows(const DeclaredLaw& law, const Off& off) {
  const Motion rising = motion_of(law, off, true), falling = motion_of(law, off, false);
  if (!rising.any() || !falling.any()) return {};
  const double low = std::max(rising.all.front().theta, falling.all.front().theta),
               high = std::min(rising.all.back().theta, falling.all.back().theta);
  std::vector<CompensationRow> table;
  constexpr int rows = 60;
  for (int i = 0; i <= rows && high > low; ++i) {
    const double theta = low + (high - low) * i / rows;
    table.push_back(
        {theta, rising.alpha(theta), falling.alpha(theta), rising.of_curve(theta), falling.of_curve(theta)});
  }
  return table;
}

// ---- measured -------------------------------------------------------------------------------------------------------

constexpr const char* k_no_better = "rows that were not fitted do not get better by it";

/// Rows of a run by which a correction is measured.
constexpr std::size_t k_rows_a_run = 300;

/// The joint with what was identified, before and behind the pulley that would correct it.
struct Corrected {
  const DeclaredMechanism& declared;
  const DeclaredMechanism& corrected;
  bool has_pulley = false;
  double tie = 0;  ///< where the motor stands when the pulley's tendons are tied, rad

  Angles now(const Imperfections& at, const BenchLog& log) const { return predict(expected_joint(declared), at, log); }
  Angles then(const Imperfections& at, const BenchLog& log) const {
    if (!has_pulley) return now(at, log);
    Imperfections rest = beyond_mechanism(at, kind_of(declared));
    rest.motor.offset -= tie;
    return predict(expected_joint(corrected), rest, log);
  }
};

BothWays table_of(const Corrected& joint, const Measurement& measurement, const DeclaredLaw& law,
                  const Imperfections& at) {
  return both_ways(measurement, errors(measurement, law, joint.then(at, bench_log(measurement))),
                   lost_motion(at, joint.declared, mean_load(measurement, joint.declared)));
}

/// Squares of rows that were left out: as measured, by what the pulley changes of them, and with the table.
struct Measured {
  double now = 0, with_pulley = 0, with_table = 0, rows = 0;

  void add(const Measurement& held, const Angles& error, const Angles& change, const BothWays& table, double zero) {
    for_each_known(held, [&](std::size_t r, std::size_t i, const Stroke& stroke) {
      const double off = error[r][i] - zero, with = off + change[r][i];
      if (!std::isfinite(with)) return;
      const double taken = (stroke.direction > 0 ? table.up : table.down).at(held.runs[r].samples[i].alpha) - zero;
      now += off * off;
      with_pulley += with * with;
      with_table += (with - taken) * (with - taken);
      rows += 1;
    });
  }
  double gone_by_pulley() const { return rows > 0 ? gone(std::sqrt(now / rows), std::sqrt(with_pulley / rows)) : 0; }
  double gone_by_table() const {
    return rows > 0 ? gone(std::sqrt(with_pulley / rows), std::sqrt(with_table / rows)) : 0;
  }
};

Measurement some_runs(Measurement measurement, const std::vector<std::string>& names, bool those) {
  std::erase_if(measurement.runs, [&](const Run& run) {
    return (std::find(names.begin(), names.end(), run.name) != names.end()) != those;
  });
  return measurement;
}

/// Run by run, with the numbers and the table that the other runs give. A table is made from all where there is no
/// other.
Measured measured(const Corrected& joint, const Measurement& measurement, const DeclaredLaw& law,
                  const std::vector<LeftOut>& left_out) {
  const Measurement thin = with_fewer_rows(measurement, k_rows_a_run);
  Measured all;
  for (const LeftOut& left : left_out) {
    const Measurement held = some_runs(thin, left.runs, true), others = some_runs(thin, left.runs, false);
    const BothWays table = table_of(joint, others.runs.empty() ? held : others, law, left.identified);
    const BenchLog log = bench_log(held);
    Angles theta, change = joint.then(left.identified, log);
    const Angles now = joint.now(left.identified, log);
    for (std::size_t r = 0; r < held.runs.size(); ++r) {
      theta.emplace_back();
      for (std::size_t i = 0; i < held.runs[r].samples.size(); ++i) {
        theta[r].push_back(held.runs[r].samples[i].theta);
        change[r][i] -= now[r][i];
      }
    }
    const double zero = joint.declared.transmission ? left.identified.sensor.zero : 0.0;
    all.add(held, errors(held, law, std::move(theta)), change, table, zero);
  }
  return all;
}

/// Why a file is not handed over.
void judge(const Calibration& calibration, Correction& correction) {
  if (calibration.effects.empty()) {
    correction.why_no_pulley_file = "no effect was found that the declared file lacks";
  } else if (!(calibration.after.held_out_rms < calibration.before.held_out_rms)) {
    correction.why_no_pulley_file = k_no_better;
  }
  if (correction.table.empty()) {
    correction.why_no_table = "there is no range of the joint that was measured both ways";
  } else if (!(correction.by_table > 0)) {
    correction.why_no_table = k_no_better;
  }
  if (!correction.why_no_table.empty()) correction.table.clear();
}

}  // namespace

Correction correct(const DeclaredMechanism& declared, const Measurement& measurement, const Calibration& calibration) {
  const Imperfections& found = calibration.identified;
  Correction correction;
  correction.identified = composed(declared, found);
  const bool gives_way = found.tendon.stretch != 0 || found.sheath.give != 0 || found.joint.weight != WeightError{};
  if (gives_way && !declared.transmission)
    correction.identified.joint.mean_load = mean_load(measurement, declared) - declared.load.tip_force;
  const DeclaredLaw law(declared);
  if (!seen_span(measurement, &Sample::alpha).any() || !law.exists()) {
    judge(calibration, correction);
    return correction;
  }

  DeclaredMechanism corrected = declared;
  corrected.identified = correction.identified;
  correction.has_pulley = !declared.transmission && !same_drawing(declared, corrected);
  if (correction.has_pulley) correction.infeasible = why_infeasible(corrected);
  if (!correction.infeasible.empty()) correction.has_pulley = false;
  const auto rows_left_out = [&](double tie) {
    return measured({declared, corrected, correction.has_pulley, tie}, measurement, law, calibration.left_out);
  };
  if (correction.has_pulley) {
    correction.by_pulley = rows_left_out(tied_at(corrected)).gone_by_pulley();
    correction.has_pulley = correction.by_pulley > 0;
    if (!correction.has_pulley) correction.why_no_pulley_file = k_no_better;
  }
  correction.by_table = rows_left_out(0).gone_by_table();
  if (correction.has_pulley && declared.pulley.law == Law::compensate) correction.round = round_choice(corrected);
  if (correction.has_pulley) correction.tied_at = tied_at(corrected);

  const Corrected joint{declared, corrected, correction.has_pulley};
  const BenchLog log = bench_log(measurement);
  const Angles now = errors(measurement, law, joint.now(found, log)),
               then = errors(measurement, law, joint.then(found, log));
  const BothWays table = both_ways(measurement, then, lost_motion(found, declared, mean_load(measurement, declared)));
  // A ratio says nothing of where the joint's zero is: to stand there is no error.
  const double zero = declared.transmission ? found.sensor.zero : 0.0;
  correction.error_now = rms(measurement, now, zero);
  correction.error_with_pulley = rms(measurement, then, zero);
  correction.error_with_table = rms(measurement, tabled(measurement, then, table), 0.0);
  const EmpiricalCurve* curve = calibration.curve.used ? &calibration.curve : nullptr;
  if (curve != nullptr) correction.by_curve = curve->gain;
  correction.by_table = std::hypot(correction.by_table, correction.by_curve);
  correction.table = compensation_rows(law, {table, curve, seen_in(table, curve)});
  judge(calibration, correction);
  return correction;
}

}  // namespace fusee
