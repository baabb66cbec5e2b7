#include "plan/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "fusee/analysis.h"
#include "fusee/joint.h"
#include "fusee/transmission.h"

namespace fusee::plan {
namespace {

/// Duration of a slow cycle, s: friction and play dominate, delays hardly show.
constexpr double k_slow_cycle = 30.0;
/// Duration of a fast cycle, s: close to the limit of a hobby servo.
constexpr double k_fast_cycle = 6.0;
/// Number of slow cycles: the first stroke settles the play, and two strokes each way repeat.
constexpr int k_slow_cycles = 3;
constexpr int k_fast_cycles = 5;
/// Dwell, s: nearly two decades of creep, thirty time constants of a delay.
constexpr double k_long_dwell = 60.0;
constexpr int k_dwell_cycles = 2;
/// Simulated rows of a stroke when the load is chosen.
constexpr int k_selection_rows = 24;

/// Weights that a person can hang on, N.
constexpr double k_weights[] = {1, 2, 5, 10, 20, 50, 100};
/// Deflection that a load should cause, in standard deviations of the noise: a tenth of it is still detected in a few
/// dozen rows.
constexpr double k_clear_deflection = 5.0;
/// Largest allowed tension where the tendon's strength is unknown, in pretensions.
constexpr double k_most_pretensions = 10.0;

std::pair<double, double> range_of(const DeclaredMechanism& declared) {
  if (declared.transmission) return {-k_pi, k_pi};
  const transmission::Transmission law(declared);
  return {law.alpha_min(), law.alpha_max()};
}

/// Largest tension that the tendons bear, N: half of their strength at the knot.
double bearable_tension(const Mechanism& declared) {
  if (const auto strength = analysis::likely_strength(declared.tendon)) return 0.5 * strength->at_knot;
  return k_most_pretensions * std::max(1.0, declared.tendon.pretension);
}

/// One simulated cycle of a run under another load.
std::vector<std::vector<joint::JointState>> under_load(const DeclaredMechanism& declared, PlannedRun run, double load) {
  run.load = load;
  run.cycles = 1;
  return joint::simulate(declared, {}, {driven(run, k_selection_rows)});
}

std::vector<std::vector<double>> angles(const std::vector<std::vector<joint::JointState>>& states) {
  std::vector<std::vector<double>> theta;
  for (const auto& run : states) {
    theta.emplace_back();
    for (const joint::JointState& state : run) theta.back().push_back(state.theta);
  }
  return theta;
}

/// True if the joint has an equilibrium in each state, with tensions up to `most`, N.
bool is_borne(const std::vector<joint::JointState>& states, double most) {
  return std::all_of(states.begin(), states.end(), [&](const joint::JointState& state) {
    return state.status != joint::EquilibriumStatus::no_equilibrium &&
           std::max({state.t1.lower, state.t1.upper, state.t2.lower, state.t2.upper}) <= most;
  });
}

bool is_taut(const joint::JointState& state) { return state.t1.slack <= 0 && state.t2.slack <= 0; }

/// The smallest weight whose deflection is clear. If none is, the largest that the tendons bear, but at least the
/// smallest weight of the list. N
double smallest_clear_load(const DeclaredMechanism& declared, const PlannedRun& slow, double noise) {
  const auto without = angles(under_load(declared, slow, 0));
  const double most = bearable_tension(declared);
  double chosen = k_weights[0];
  for (const double weight : k_weights) {
    const auto states = under_load(declared, slow, weight);
    if (!is_borne(states.front(), most)) break;
    chosen = weight;
    if (rms_apart(angles(states), without) >= k_clear_deflection * noise) break;
  }
  return chosen;
}

/// The loads of a plan whose options state none: N, or the unit of the log for a joint that is declared by a ratio.
std::vector<double> usual_loads(const DeclaredMechanism& declared, const PlannedRun& slow, double noise) {
  const double load = declared.transmission ? 1.0 : smallest_clear_load(declared, slow, noise);
  return {0.0, load, 0.5 * load, -load};
}

/// Throws InputError for a load under which the joint has no equilibrium.
void refuse_loads_without_equilibrium(const DeclaredMechanism& declared, const PlannedRun& slow,
                                      const std::vector<double>& loads) {
  if (declared.transmission) return;  // it bears any load
  for (const double load : loads) {
    if (load == 0) continue;
    if (is_borne(under_load(declared, slow, load).front(), std::numeric_limits<double>::infinity())) continue;
    throw InputError("", "the joint has no equilibrium under a load of " + rounded(load, 6) + " N",
                     "choose smaller loads: a tendon bears " + rounded(bearable_tension(declared), 2) + " N");
  }
}

}  // namespace

double Bench::largest_load() const {
  double most = 0;
  for (const double load : loads) most = std::max(most, std::abs(load));
  return most;
}

Bench bench_of(const DeclaredMechanism& declared, const PlanOptions& options) {
  Bench bench;
  std::tie(bench.from, bench.to) = options.range ? *options.range : range_of(declared);
  const double travel = 2 * std::abs(bench.to - bench.from);  // of a cycle
  bench.speeds =
      options.speeds.empty() ? std::vector<double>{travel / k_slow_cycle, travel / k_fast_cycle} : options.speeds;
  std::sort(bench.speeds.begin(), bench.speeds.end());
  const PlannedRun slow{.from = bench.from, .to = bench.to, .speed = bench.speeds.front()};
  refuse_loads_without_equilibrium(declared, slow, options.loads);
  bench.loads = options.loads.empty() ? usual_loads(declared, slow, options.noise) : options.loads;
  std::stable_partition(bench.loads.begin(), bench.loads.end(), [](double load) { return load == 0; });
  return bench;
}

std::optional<double> taut_load_of(const DeclaredMechanism& declared, const Bench& bench) {
  if (declared.transmission) return std::nullopt;
  const PlannedRun slow{.from = bench.from, .to = bench.to, .speed = bench.speeds.front()};
  const auto is_taut_at = [&](double scale) {
    return std::all_of(bench.loads.begin(), bench.loads.end(), [&](double load) {
      const auto states = under_load(declared, slow, scale * load);
      return std::all_of(states.front().begin(), states.front().end(), is_taut);
    });
  };
  if (is_taut_at(1)) return std::nullopt;
  if (!is_taut_at(0)) return 0.0;
  double taut = 0, slack = 1;
  constexpr int k_halvings = 10;  // to a thousandth of the largest load
  for (int i = 0; i < k_halvings; ++i) {
    const double middle = 0.5 * (taut + slack);
    (is_taut_at(middle) ? taut : slack) = middle;
  }
  return taut * bench.largest_load();
}

std::vector<PlannedRun> candidate_runs(const Bench& bench) {
  std::vector<PlannedRun> runs;
  const auto run = [&](double speed, double load) {
    const bool is_slow = speed == bench.speeds.front();
    return PlannedRun{.from = bench.from,
                      .to = bench.to,
                      .cycles = is_slow ? k_slow_cycles : k_fast_cycles,
                      .speed = speed,
                      .load = load};
  };
  // In a fast run a load would also act by its inertia. Fast runs therefore have the first load, which is 0 if the
  // bench includes runs without load.
  const double slow = bench.speeds.front();
  for (const double load : bench.loads) runs.push_back(run(slow, load));
  for (const double speed : bench.speeds) {
    if (speed != slow) runs.push_back(run(speed, bench.loads.front()));
  }
  const auto largest = std::max_element(bench.loads.begin(), bench.loads.end(),
                                        [](double a, double b) { return std::abs(a) < std::abs(b); });
  PlannedRun with_dwells = run(slow, *largest);
  with_dwells.cycles = k_dwell_cycles;
  with_dwells.dwell = k_long_dwell;
  runs.push_back(with_dwells);
  for (const BenchChange change : {BenchChange::motor_sensor_turned, BenchChange::joint_sensor_turned}) {
    PlannedRun turned = run(slow, bench.loads.front());
    turned.change = change;
    runs.push_back(turned);
  }
  return runs;
}

}  // namespace fusee::plan
