// Duration of a sweep of three cycles, 1002 points, with the elastic model.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>

#include "fusee/joint.h"
#include "support/mechanisms.h"

namespace {

using namespace fusee;

std::vector<joint::JointStep> three_cycles(const transmission::Transmission& transmission, double tip_force) {
  const double ends[] = {transmission.alpha_max(), transmission.alpha_min()};
  std::vector<joint::JointStep> steps;
  double from = 0;
  for (int stroke = 0; stroke < 6; ++stroke) {
    const double to = ends[stroke % 2];
    constexpr int k_points = 167;  // of a stroke
    for (int i = 1; i <= k_points; ++i) steps.push_back({from + (to - from) * i / k_points, tip_force, 0.0});
    from = to;
  }
  return steps;
}

/// Best of `runs`, ms.
double best_of(int runs, const std::function<void()>& work) {
  double best = 1e300;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

struct Case {
  const char* name;
  Mechanism mechanism;
  double tip_force;
};

Mechanism changed(Mechanism mechanism, double pretension, double friction, double modulus) {
  mechanism.tendon.pretension = pretension;
  mechanism.guides.mu = friction;
  mechanism.tendon.modulus = modulus;
  return mechanism;
}

/// The forearm's law as a table of 45 rows, two of them beyond each end of the range.
Mechanism table_law() {
  Mechanism mechanism = testing::forearm();
  const transmission::Transmission source(mechanism);
  mechanism.pulley.law = Law::table;
  for (int i = -2; i <= 42; ++i) {
    const double theta = mechanism.joint.theta_min + (mechanism.joint.theta_max - mechanism.joint.theta_min) * i / 40;
    mechanism.pulley.rows.push_back({source.alpha(theta), theta});
  }
  return mechanism;
}

void time_sweep(const char* name, const joint::JointModel& model, const Mechanism& mechanism, double tip_force) {
  const std::vector<joint::JointStep> steps = three_cycles(transmission::Transmission(mechanism), tip_force);
  const double ms = best_of(20, [&] { joint::follow(model, steps); });
  std::printf("equilibrium, 3 cycles, %zu points, %-24s %8.2f ms\n", steps.size(), name, ms);
}

}  // namespace

int main() {
  const Case cases[] = {{"one tendon slack", testing::forearm(), 10.0},
                        {"both taut", changed(testing::forearm(), 30.0, 0.12, 40000.0), 5.0},
                        {"both taut, soft, rough", changed(testing::forearm(), 30.0, 0.4, 1000.0), 5.0},
                        {"both taut, no friction", changed(testing::forearm(), 30.0, 0.0, 40000.0), 5.0},
                        {"no tension at all", changed(testing::forearm(), 0.0, 0.12, 40000.0), 0.0},
                        {"linear law", testing::linear_wrist(), 5.0},
                        {"table law", table_law(), 5.0}};
  for (const Case& one : cases) time_sweep(one.name, joint::joint_model(one.mechanism), one.mechanism, one.tip_force);
  Mechanism mounted = testing::forearm();
  mounted.guides.EB += 0.5;
  mounted.guides.radius += 0.3;
  time_sweep("made for other pins",
             joint::joint_model(joint::MadePulleys(testing::forearm()), joint::MountedMechanism{mounted}),
             testing::forearm(), 5.0);
  return 0;
}
