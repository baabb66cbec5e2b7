#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/model.h"
#include "mechanism/effect.h"

namespace fusee::model {
namespace {

constexpr int k_law_intervals = 2000;  ///< number of intervals of the range at whose ends a law is checked

/// Column `y` where column `x` has the value `at`: linear interpolation in rows that increase in both columns, constant
/// beyond the ends.
double between_rows(const std::vector<LawRow>& rows, double at, double LawRow::*x, double LawRow::*y) {
  if (!(at > rows.front().*x)) return rows.front().*y;
  if (!(at < rows.back().*x)) return rows.back().*y;
  const auto above =
      std::upper_bound(rows.begin(), rows.end(), at, [x](double value, const LawRow& row) { return value < row.*x; });
  const LawRow &low = *(above - 1), &high = *above;
  return std::lerp(low.*y, high.*y, (at - low.*x) / (high.*x - low.*x));
}

// ---- an identified joint --------------------------------------------------------------------------------------------

/// A quasi-static motion from home to `high`, `low`, `high` and `low` motor angle, rad. The first two strokes take up
/// play.
joint::BenchRun sweep(double low, double high) {
  // Rows of a stroke: linear interpolation between them is accurate to a millionth of the range.
  constexpr int steps = 600;
  joint::BenchRun run;
  const auto stroke = [&run](double from, double to) {
    for (int i = 1; i <= steps; ++i) run.rows.push_back({0, std::lerp(from, to, double(i) / steps), 0, 0});
  };
  run.rows.push_back({});
  stroke(0, high);
  stroke(high, low);
  stroke(low, high);
  stroke(high, low);
  return run;
}

/// Joint angle of a state: the true one, or the one that the joint sensor shows.
using ThetaOfState = double joint::JointState::*;

/// Rows of the third stroke of sweep() (`is_rising`) or of its fourth, by increasing α, in which the joint moves.
std::vector<LawRow> increasing_rows(const joint::BenchRun& run, const std::vector<joint::JointState>& states,
                                    bool is_rising, ThetaOfState angle) {
  const std::size_t count = run.rows.size(), steps = (count - 1) / 4;
  const std::size_t end = is_rising ? count - steps : count;
  const std::size_t first = end - steps - 1;
  std::vector<LawRow> rows;
  for (std::size_t i = first; i < end; ++i) {
    const double theta = states[i].*angle;
    if (std::isfinite(theta)) rows.push_back({run.rows[i].alpha, theta});
  }
  if (!is_rising) std::reverse(rows.begin(), rows.end());
  // Rows at rest, while play is taken up, are removed.
  constexpr double k_least_step = 1e-9;  // rad
  std::vector<LawRow> growing;
  for (const LawRow& row : rows) {
    if (growing.empty() || row.theta > growing.back().theta + k_least_step) growing.push_back(row);
  }
  return growing;
}

/// Motor angles of both directions, over the part of the joint's range that the joint reaches in both. Empty if there
/// is no such part.
std::vector<TwoWayRow> two_way_rows(const joint::BenchRun& run, const std::vector<joint::JointState>& states,
                                    const Joint& joint, ThetaOfState angle) {
  const std::vector<LawRow> up = increasing_rows(run, states, /*is_rising=*/true, angle),
                            down = increasing_rows(run, states, /*is_rising=*/false, angle);
  if (up.size() < 2 || down.size() < 2) return {};
  const double low = std::max({up.front().theta, down.front().theta, joint.theta_min});
  const double high = std::min({up.back().theta, down.back().theta, joint.theta_max});
  if (!(high > low)) return {};
  constexpr int places = 600;
  std::vector<TwoWayRow> rows;
  for (int i = 0; i <= places; ++i) {
    const double theta = std::lerp(low, high, double(i) / places);
    rows.push_back({theta, between_rows(up, theta, &LawRow::theta, &LawRow::alpha),
                    between_rows(down, theta, &LawRow::theta, &LawRow::alpha)});
  }
  return rows;
}

}  // namespace

AngleMap angle_map(const transmission::Transmission& law) {
  AngleMap map;
  map.alpha_min = law.alpha_min();
  map.alpha_max = law.alpha_max();
  map.theta_min = law.theta(map.alpha_min);
  map.theta_max = law.theta(map.alpha_max);
  const auto alpha_in = [low = map.alpha_min, high = map.alpha_max](double a) { return std::clamp(a, low, high); };
  const auto theta_in = [low = map.theta_min, high = map.theta_max](double t) { return std::clamp(t, low, high); };
  map.theta = [law, alpha_in](double alpha) { return law.theta(alpha_in(alpha)); };
  map.alpha = [law, theta_in](double theta) { return law.alpha(theta_in(theta)); };
  map.slope = [law, alpha_in](double alpha) { return law.at_alpha(alpha_in(alpha)).g; };
  return map;
}

AngleMap angle_map(std::vector<LawRow> rows) {
  demand(rows.size() >= 2, "a map of " + std::to_string(rows.size()) + " rows");
  AngleMap map;
  map.alpha_min = rows.front().alpha;
  map.alpha_max = rows.back().alpha;
  map.theta_min = rows.front().theta;
  map.theta_max = rows.back().theta;
  const auto shared = std::make_shared<const std::vector<LawRow>>(std::move(rows));
  map.theta = [shared](double alpha) { return between_rows(*shared, alpha, &LawRow::alpha, &LawRow::theta); };
  map.alpha = [shared](double theta) { return between_rows(*shared, theta, &LawRow::theta, &LawRow::alpha); };
  // Mean slope over 1/30 of the range, since the corners between rows are no property of the joint.
  map.slope = [theta = map.theta, low = map.alpha_min, high = map.alpha_max](double alpha) {
    const double half = (high - low) / 60;
    const double from = std::max(low, std::min(alpha, high) - half), to = std::min(high, std::max(alpha, low) + half);
    return (theta(to) - theta(from)) / (to - from);
  };
  return map;
}

std::vector<TwoWayRow> refined(const std::vector<TwoWayRow>& rows, const transmission::Transmission& law) {
  const AngleMap map = angle_map(law);
  // Beyond its range the law is constant, which distorts the rows there: 2 % of the range are tolerated.
  const double beyond = 0.02 * (map.theta_max - map.theta_min);
  if (rows.front().theta < map.theta_min - beyond || rows.back().theta > map.theta_max + beyond) return rows;
  std::vector<LawRow> up, down;  // with the motor's offset from the law in place of α
  for (const TwoWayRow& row : rows) {
    up.push_back({row.up - law.alpha(row.theta), row.theta});
    down.push_back({row.down - law.alpha(row.theta), row.theta});
  }
  constexpr int places = 600;
  std::vector<TwoWayRow> result;
  for (int i = 0; i <= places; ++i) {
    const double theta = std::lerp(rows.front().theta, rows.back().theta, double(i) / places), alpha = law.alpha(theta);
    const TwoWayRow row{theta, alpha + between_rows(up, theta, &LawRow::theta, &LawRow::alpha),
                        alpha + between_rows(down, theta, &LawRow::theta, &LawRow::alpha)};
    // The maps require that the motor angles increase.
    if (!result.empty() && !(row.up > result.back().up && row.down > result.back().down)) return rows;
    result.push_back(row);
  }
  return result;
}

JointCurve two_way_curve(const std::vector<TwoWayRow>& rows, CurveSource source) {
  JointCurve curve;
  curve.source = source;
  std::vector<LawRow> up, down, middle;
  for (const TwoWayRow& row : rows) {
    up.push_back({row.up, row.theta});
    down.push_back({row.down, row.theta});
    middle.push_back({0.5 * (row.up + row.down), row.theta});
  }
  curve.middle = angle_map(middle);
  curve.ways = {angle_map(std::move(up)), angle_map(std::move(down))};
  for (const LawRow& row : middle) {
    for (const AngleMap& way : *curve.ways) {
      if (row.alpha >= way.alpha_min && row.alpha <= way.alpha_max)
        curve.half_hysteresis = std::max(curve.half_hysteresis, std::abs(way.theta(row.alpha) - row.theta));
    }
  }
  return curve;
}

bool grows(const transmission::Transmission& law) {
  for (int i = 0; i <= k_law_intervals; ++i) {
    if (!(law.at_alpha(std::lerp(law.alpha_min(), law.alpha_max(), double(i) / k_law_intervals)).g > 0)) return false;
  }
  return law.alpha_max() > law.alpha_min();
}

std::optional<JointCurves> joint_curves(const DeclaredMechanism& declared) {
  const transmission::Transmission law(declared);
  if (declared.identified == Imperfections{}) {
    const JointCurve curve{CurveSource::law, angle_map(law), std::nullopt, 0};
    return JointCurves{curve, curve};
  }
  const DeclaredMechanism joint = joint::expected_joint(declared);
  if (transmission::Transmission(joint).dead_centre()) return std::nullopt;
  // The reversals lie outside the range, so that the motor has taken up play and compliance before the range begins:
  // twice the backlash, and 3 % of the range for the compliance.
  const double beyond = 2 * declared.identified.shaft.backlash + 0.03 * (law.alpha_max() - law.alpha_min());
  const joint::BenchRun run = sweep(law.alpha_min() - beyond, law.alpha_max() + beyond);
  Imperfections imperfections = beyond_mechanism(declared.identified, kind_of(declared));
  imperfections.sensor.lag = 0;  // a motion at rest has no lag
  const std::vector<joint::JointState> states = joint::simulate(joint, imperfections, {run}).front();
  const std::vector<TwoWayRow> physical = two_way_rows(run, states, declared.joint, &joint::JointState::theta),
                               sensed = two_way_rows(run, states, declared.joint, &joint::JointState::shown);
  if (physical.empty() || sensed.empty()) return std::nullopt;
  return JointCurves{two_way_curve(physical, CurveSource::identified), two_way_curve(sensed, CurveSource::identified)};
}

}  // namespace fusee::model
