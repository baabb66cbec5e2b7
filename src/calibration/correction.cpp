#include "fusee/calibration/correction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calibration/forward.h"
#include "fusee/transmission/equilibrium.h"

// The corrected pulley is drawn so that what was identified undoes itself:
//   geometry, friction, tendon   the mechanism has them, and the law stays the declared θ(α) as a table (or P1 round where that suffices);
//   radius offset δ              the tendon's centre line lies δ further out than drawn: a tendon thicker by 2δ over pins thinner by δ;
//   scale 1 + s                  one more shrinkage;
//   profile error                the law is drawn at the angle that the pulley acts at;
//   runout                       the curves are drawn off the axis the other way (pulley_shift).

namespace fusee {
namespace {

/// P1 stays round below this miss of the declared law.
constexpr double k_round_suffices = radians(0.02);
constexpr int k_law_rows = 160;

/// What moves the joint's geometry or statics.
bool changes_joint(const Imperfections& at) {
  return at.guide_radius != 0 || at.guide_outward != 0 || at.guide_down != 0 || at.joint_length != 0 || at.stretch != 0 || at.pretension != 0 ||
         at.friction != 0;
}
bool changes_geometry(const Imperfections& at) {
  return at.guide_radius != 0 || at.guide_outward != 0 || at.guide_down != 0 || at.joint_length != 0;
}
bool changes_drawing(const Imperfections& at) { return at.radius_offset != 0 || at.pulley_scale != 0 || at.profile_sin != 0 || at.profile_cos != 0; }

double acting_angle(double alpha, const Imperfections& at) {
  return alpha + at.profile_sin * std::sin(2 * alpha) + at.profile_cos * (std::cos(2 * alpha) - 1);
}

/// The declared law as rows, a little beyond the range where it goes on. Empty where it does not exist.
std::vector<LawRow> declared_rows(const Mechanism& declared, const Imperfections& at) {
  const Transmission law(declared);
  if (law.dead_centre()) return {};
  const double low = declared.joint.theta_min, high = declared.joint.theta_max;
  const double more = 0.02 * (high - low);
  std::vector<LawRow> rows;
  for (int i = 0; i <= k_law_rows; ++i) {
    const double theta = low - more + (high - low + 2 * more) * i / k_law_rows;
    const LawRow row{acting_angle(law.alpha(theta), at), theta};
    if (!std::isfinite(row.alpha) || (!rows.empty() && row.alpha <= rows.back().alpha)) continue;
    rows.push_back(row);
  }
  return rows;
}

Mechanism undrawn(Mechanism mechanism, const Imperfections& at) {
  Tendon& tendon = mechanism.tendon;
  const double drawn = tendon.diameter + 2 * at.radius_offset;
  if (drawn > 0 && at.radius_offset != 0) {
    tendon.modulus *= tendon.diameter * tendon.diameter / (drawn * drawn);
    tendon.diameter = drawn;
    mechanism.guides.radius -= at.radius_offset;
  }
  if (at.pulley_scale != 0) mechanism.material.shrinkage = 1 - (1 - mechanism.material.shrinkage) * (1 + at.pulley_scale);
  return mechanism;
}

// ---- what a pulley and a table take out -----------------------------------------------------------------------------

/// The part that the pulley answers for, without sensors, shaft, loads and time.
Imperfections pulley_part(const Imperfections& all) {
  Imperfections part;
  part.radius_offset = all.radius_offset;
  part.pulley_scale = all.pulley_scale;
  part.runout_x = all.runout_x;
  part.runout_y = all.runout_y;
  part.profile_sin = all.profile_sin;
  part.profile_cos = all.profile_cos;
  part.guide_radius = all.guide_radius;
  part.guide_outward = all.guide_outward;
  part.guide_down = all.guide_down;
  part.joint_length = all.joint_length;
  return part;
}

/// A function of α by straight pieces between evenly spaced places; flat beyond them.
struct Curve {
  double low = 0, high = 0;
  std::vector<double> values;

  double at(double alpha) const {
    if (values.empty()) return 0;
    const double last = static_cast<double>(values.size() - 1);
    const double place = std::clamp((alpha - low) / (high - low) * last, 0.0, last);
    const std::size_t i = std::min(static_cast<std::size_t>(place), values.size() - 2);
    const double share = place - static_cast<double>(i);
    return values[i] + share * (values[i + 1] - values[i]);
  }
};

struct Seen {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool any() const { return high > low; }
};

Seen range_seen(const Measurement& measurement) {
  Seen seen;
  for (const Run& run : measurement.runs) {
    for (const Sample& sample : run.samples) {
      seen.low = std::min(seen.low, sample.alpha);
      seen.high = std::max(seen.high, sample.alpha);
    }
  }
  return seen;
}

/// θ of the unloaded joint over the range, the mean of both directions.
Curve mean_motion(const Mechanism& declared, const Imperfections& at, const Seen& seen) {
  constexpr int places = 160;
  Mechanism unloaded = declared;
  unloaded.load = {};
  const JointModel model = imperfect_model(MadePulleys(declared), unloaded, at);
  JointMotion motion(model);
  const auto to = [&](double alpha) {
    const EquilibriumPoint point = motion.to({acting_angle(alpha, at), 0, 0});
    return point.status == EquilibriumStatus::no_equilibrium ? std::numeric_limits<double>::quiet_NaN() : point.theta;
  };
  for (int i = 1; i <= 40; ++i) to(seen.low * i / 40);
  Curve curve{seen.low, seen.high, std::vector<double>(places + 1, 0)};
  const auto alpha_of = [&](int i) { return seen.low + (seen.high - seen.low) * i / places; };
  for (int i = 0; i <= places; ++i) curve.values[static_cast<std::size_t>(i)] = 0.5 * to(alpha_of(i));
  for (int i = places; i >= 0; --i) curve.values[static_cast<std::size_t>(i)] += 0.5 * to(alpha_of(i));
  return curve;
}

/// θ(α) as declared, without elasticity.
double declared_theta(const Mechanism& declared, const std::optional<Transmission>& law, double alpha) {
  return law ? law->theta(alpha) : alpha / declared.transmission->ratio;
}

/// Calls visit(run index, sample index, direction) for every sample whose play is known.
template <typename Visit>
void for_each_known(const Measurement& measurement, Visit visit) {
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    for (const Stroke& stroke : measurement.runs[r].strokes) {
      if (stroke.partial) continue;
      for (std::size_t i = stroke.first; i <= stroke.last; ++i) visit(r, i, stroke.direction);
    }
  }
}

/// What the accepted effects add to the declared model at a sample.
double modelled(const Calibration& calibration, std::size_t run, std::size_t sample) {
  if (run >= calibration.residuals_before.size() || run >= calibration.residuals_after.size()) return 0;
  const auto& before = calibration.residuals_before[run];
  const auto& after = calibration.residuals_after[run];
  if (sample >= before.size() || sample >= after.size()) return 0;
  const double change = before[sample] - after[sample];
  return std::isfinite(change) ? change : 0;
}

/// Mean over places of α, empty places filled from their neighbours.
class BinnedMean {
 public:
  explicit BinnedMean(const Seen& seen) : seen_(seen), sums_(k_places + 1, 0), weights_(k_places + 1, 0) {}

  /// Shared between the two places around `alpha`.
  void add(double alpha, double value) {
    const double place = std::clamp((alpha - seen_.low) / (seen_.high - seen_.low) * k_places, 0.0, static_cast<double>(k_places));
    const std::size_t i = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(k_places - 1));
    const double share = place - static_cast<double>(i);
    sums_[i] += (1 - share) * value;
    weights_[i] += 1 - share;
    sums_[i + 1] += share * value;
    weights_[i + 1] += share;
  }

  Curve curve() const {
    Curve curve{seen_.low, seen_.high, std::vector<double>(k_places + 1, 0)};
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
  Seen seen_;
  std::vector<double> sums_, weights_;
};

/// α at which a curve of (θ, α), sorted by θ, has `theta`.
double alpha_at(const std::vector<LawRow>& rows, double theta) {
  const auto above = std::lower_bound(rows.begin() + 1, rows.end() - 1, theta, [](const LawRow& row, double value) { return row.theta < value; });
  const LawRow& low = *(above - 1);
  const double span = above->theta - low.theta;
  return span > 0 ? low.alpha + (above->alpha - low.alpha) * (theta - low.theta) / span : low.alpha;
}

/// Where the joint is, moving one way, by growing θ.
std::vector<LawRow> motion_rows(const Mechanism& declared, const std::optional<Transmission>& law, const Curve& beyond) {
  constexpr int places = 800;
  std::vector<LawRow> rows;
  for (int i = 0; i <= places; ++i) {
    const double alpha = beyond.low + (beyond.high - beyond.low) * i / places;
    rows.push_back({alpha, declared_theta(declared, law, alpha) + beyond.at(alpha)});
  }
  if (rows.back().theta < rows.front().theta) std::reverse(rows.begin(), rows.end());
  std::vector<LawRow> growing{rows.front()};
  for (const LawRow& row : rows) {
    if (row.theta > growing.back().theta) growing.push_back(row);
  }
  return growing;
}

std::vector<CompensationRow> compensation_rows(const Mechanism& declared, const std::optional<Transmission>& law, const Curve& up, const Curve& down) {
  const std::vector<LawRow> rising = motion_rows(declared, law, up), falling = motion_rows(declared, law, down);
  if (rising.size() < 2 || falling.size() < 2) return {};
  const double low = std::max(rising.front().theta, falling.front().theta), high = std::min(rising.back().theta, falling.back().theta);
  std::vector<CompensationRow> table;
  constexpr int rows = 60;
  for (int i = 0; i <= rows && high > low; ++i) {
    const double theta = low + (high - low) * i / rows;
    table.push_back({theta, alpha_at(rising, theta), alpha_at(falling, theta)});
  }
  return table;
}

}  // namespace

Vec2 pulley_shift(const Mechanism& mechanism) { return {-mechanism.identified.runout_x, -mechanism.identified.runout_y}; }

namespace {

/// The joint with identified geometry and statics, still with the declared law's keys.
Mechanism identified_joint(const Mechanism& mechanism) {
  Mechanism joint = mounted(mechanism, mechanism.identified);
  joint.identified = {};
  joint.identified.runout_x = mechanism.identified.runout_x;
  joint.identified.runout_y = mechanism.identified.runout_y;
  return joint;
}

double worst_miss(const Mechanism& joint, const std::vector<LawRow>& rows) {
  const Transmission law(joint);
  if (law.dead_centre()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (const LawRow& row : rows) worst = std::max(worst, std::abs(law.theta(row.alpha) - row.theta));
  return std::isfinite(worst) ? worst : std::numeric_limits<double>::infinity();
}

}  // namespace

RoundChoice round_choice(const Mechanism& mechanism) {
  Mechanism joint = identified_joint(mechanism);
  const std::vector<LawRow> rows = declared_rows(mechanism, {});
  RoundChoice choice;
  choice.r1 = joint.pulley.r1;
  if (mechanism.pulley.law != Law::compensate || rows.empty()) return choice;
  // The worst miss has one minimum over r1: golden section.
  double low = 0.8 * choice.r1, high = 1.25 * choice.r1;
  const auto miss = [&](double r1) {
    joint.pulley.r1 = r1;
    return worst_miss(joint, rows);
  };
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 40; ++i) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    if (miss(a) < miss(b)) {
      high = b;
    } else {
      low = a;
    }
  }
  choice.r1 = 0.5 * (low + high);
  choice.max_error = miss(choice.r1);
  choice.suffices = choice.max_error <= k_round_suffices;
  return choice;
}

Mechanism as_it_is(const Mechanism& mechanism) {
  const Imperfections& at = mechanism.identified;
  if (mechanism.transmission || !(changes_joint(at) || changes_drawing(at))) return mechanism;
  Mechanism joint = identified_joint(mechanism);
  if (changes_geometry(at) || at.profile_sin != 0 || at.profile_cos != 0) {
    const RoundChoice choice = round_choice(mechanism);
    const bool bent = at.profile_sin != 0 || at.profile_cos != 0;
    if (choice.suffices && !bent) {
      joint.pulley.r1 = choice.r1;
    } else {
      joint.pulley.rows = declared_rows(mechanism, at);
      if (!joint.pulley.rows.empty()) joint.pulley.law = Law::table;
    }
  }
  return undrawn(joint, at);
}

Mechanism expected_joint(const Mechanism& declared) {
  // A corrected pulley's profile error undoes itself: it is drawn, and it is made.
  Mechanism made = declared;
  made.identified.profile_sin = made.identified.profile_cos = 0;
  made = as_it_is(made);
  made.identified = {};
  return made;
}

Correction correct(const Mechanism& declared, const Measurement& measurement, const Calibration& calibration) {
  Correction correction;
  const Imperfections& before = declared.identified;
  const Imperfections& found = calibration.identified;
  correction.identified = found;
  Imperfections& total = correction.identified;
  // What the earlier calibration put into the joint was its declared model this time; the rest was found anew.
  for (double Imperfections::* member :
       {&Imperfections::radius_offset, &Imperfections::runout_x, &Imperfections::runout_y, &Imperfections::profile_sin, &Imperfections::profile_cos,
        &Imperfections::pretension, &Imperfections::friction, &Imperfections::guide_radius, &Imperfections::guide_outward, &Imperfections::guide_down,
        &Imperfections::joint_length}) {
    total.*member += before.*member;
  }
  total.stretch = (1 + before.stretch) * (1 + found.stretch) - 1;
  total.pulley_scale = (1 + before.pulley_scale) * (1 + found.pulley_scale) - 1;
  const Seen seen = range_seen(measurement);
  if (!seen.any()) return correction;

  const Imperfections part = pulley_part(found);
  correction.has_pulley = !declared.transmission && !(part == Imperfections{});
  Curve pulley;
  std::optional<Transmission> law;
  const Mechanism expected = expected_joint(declared);
  if (!declared.transmission) law.emplace(expected);
  if (correction.has_pulley) {
    const Curve actual = mean_motion(expected, part, seen), wanted = mean_motion(expected, {}, seen);
    pulley = actual;
    for (std::size_t i = 0; i < pulley.values.size(); ++i) {
      const double change = actual.values[i] - wanted.values[i];
      pulley.values[i] = std::isfinite(change) ? change : 0;
    }
    Mechanism corrected = declared;
    corrected.identified = total;
    if (declared.pulley.law == Law::compensate) correction.round = round_choice(corrected);
  }

  BinnedMean up(seen), down(seen);
  double squares = 0, count = 0;
  for_each_known(measurement, [&](std::size_t r, std::size_t i, int direction) {
    const double alpha = measurement.runs[r].samples[i].alpha;
    const double taken = pulley.at(alpha);
    squares += taken * taken;
    count += 1;
    (direction > 0 ? up : down).add(alpha, modelled(calibration, r, i) - taken);
  });
  if (count == 0) return correction;
  correction.by_pulley = std::sqrt(squares / count);
  const Curve rising = up.curve(), falling = down.curve();
  double left = 0, left_after = 0;
  for_each_known(measurement, [&](std::size_t r, std::size_t i, int direction) {
    const double alpha = measurement.runs[r].samples[i].alpha;
    const double rest = modelled(calibration, r, i) - pulley.at(alpha);
    const double after = rest - (direction > 0 ? rising : falling).at(alpha);
    left += rest * rest;
    left_after += after * after;
  });
  correction.by_table = std::sqrt(std::max(0.0, left - left_after) / count);
  correction.table = compensation_rows(expected, law, rising, falling);
  return correction;
}

}  // namespace fusee
