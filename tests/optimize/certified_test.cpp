#include "fusee/optimize/certified.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdio>

namespace fusee {
namespace {

TEST(Try, It) {
  const char* text = R"(
schema = 1
[joint]
length_mm = 150
range_deg = [-30, 30]
[guides]
EB_mm = 50
ED_mm = 50
OE_mm = -10
radius_mm = 0
friction = 0.2
[pulley]
EF_mm = 60
r1_mm = 20
[tendon]
diameter_mm = 1
[optimize]
objective = "max_tension"
variables = ["joint.length_mm", "guides.ED_mm", "guides.OE_mm"]
lower = [100.0, 30.0, -40.0]
upper = [300.0, 150.0, 50.0]
tied = ["guides.EB_mm = guides.ED_mm"]
constraints = ["guides.EB_mm <= 0.5 * joint.length_mm"]
)";
  for (const char* mu : {"0.2", "0.1", "0.3", "0.15", "0.01", "0.0"}) {
   for (const char* objective : {"max_tension", "max_error", "motor_torque", "footprint"}) {
    MechanismFile file;
    file.mechanism = parse_mechanism(text, "x", ".", {{"guides.friction", mu}, {"optimize.objective", objective}});
    const Problem problem = make_problem(file);
    const auto start = std::chrono::steady_clock::now();
    CertifiedOptions o; o.most_boxes = 300000;
    const CertifiedResult r = certified_optimum(problem, problem.objectives[0], o);
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("mu %s %s: %.9f >= %.9f gap %.2g boxes %ld evals %ld  %.3f s  best", mu, objective, r.value, r.lower_bound, r.relative_gap, r.boxes, r.evaluations, s);
    for (double v : r.best) std::printf(" %.6f", v);
    std::printf(" ties %zu", r.ties.boxes.size());
    for (int i = 0; r.found && i < 3; ++i) std::printf(" [%.3f %.3f | %.3f %.3f]", r.ties.hull.lower[i], r.ties.known.lower[i], r.ties.known.upper[i], r.ties.hull.upper[i]);
    std::printf("\n");
    std::fflush(stdout);
   }
  }
}

}  // namespace
}  // namespace fusee
