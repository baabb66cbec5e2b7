// Speed of evaluating designs, and duration of the searches of the paper's problem. Prints one JSON document, which
// optimize_peers.py reads.
#include <Eigen/Core>
#include <chrono>
#include <cstdio>
#include <functional>

#include "fusee/optimize.h"
#include "optimize/objective_at.h"
#include "optimize/problem_text.h"

namespace fusee {
namespace {

/// All 61 points of the stroke as one vector.
struct Lanes {
  using Array = Eigen::Array<double, 61, 1>;
  Array v;
  Lanes() = default;
  Lanes(double x) : v(Array::Constant(x)) {}  // NOLINT: constants occur in formulas
  Lanes(const Array& x) : v(x) {}             // NOLINT
};
Lanes operator+(const Lanes& a, const Lanes& b) { return {a.v + b.v}; }
Lanes operator-(const Lanes& a, const Lanes& b) { return {a.v - b.v}; }
Lanes operator-(const Lanes& a) { return {-a.v}; }
Lanes operator*(const Lanes& a, const Lanes& b) { return {a.v * b.v}; }
Lanes operator/(const Lanes& a, const Lanes& b) { return {a.v / b.v}; }
Lanes squared(const Lanes& a) { return {a.v.square()}; }
Lanes sqrt(const Lanes& a) { return {a.v.sqrt()}; }
Lanes exp(const Lanes& a) { return {a.v.exp()}; }
Lanes sin(const Lanes& a) { return {a.v.sin()}; }
Lanes cos(const Lanes& a) { return {a.v.cos()}; }
Lanes acos(const Lanes& a) { return {a.v.acos()}; }
Lanes larger(const Lanes& a, const Lanes& b) { return {a.v.max(b.v)}; }
Lanes positive_part(const Lanes& a, transmission::Domain& domain) {
  domain.possible = domain.possible && (a.v > 0).all();
  return a;
}
Lanes unit_part(const Lanes& a, transmission::Domain& domain) {
  domain.possible = domain.possible && (a.v.abs() <= 1).all();
  return a;
}
void demand_not_negative(const Lanes& a, transmission::Domain& domain) {
  domain.possible = domain.possible && (a.v >= 0).all();
}
Lanes hypot(const Lanes& a, const Lanes& b) { return sqrt(squared(a) + squared(b)); }
Lanes cathetus(const Lanes& hypotenuse, const Lanes& other, transmission::Domain& domain) {
  return sqrt(positive_part((hypotenuse - other) * (hypotenuse + other), domain));
}
/// atan2(y, x), for y > 0 only: pins are below C, and the pulley is below its pins.
Lanes direction(const Lanes& x, const Lanes& y, transmission::Domain& domain) {
  domain.whole = domain.whole && (y.v > 0).all();
  return 0.5 * k_pi - Lanes((x.v / y.v).atan());
}

double scalar_value(const optimize::FileNumbers<double>& n) {
  const auto design = optimize::design_numbers(n, Law::compensate, true);
  double largest = 0;
  for (int i = 0; i <= 60; ++i) {
    transmission::Domain domain;
    largest = std::max(largest, optimize::objective_at(optimize::Objective::max_tension, design, i / 60.0, domain));
  }
  return largest;
}

double batched_value(const optimize::FileNumbers<double>& n) {
  const optimize::FileNumbers<Lanes> lanes{n.R,  n.EB,     n.ED,       n.OE,      n.EF,        n.r1,       n.ratio,
                                           n.mu, n.radius, n.diameter, n.modulus, n.theta_min, n.theta_max};
  transmission::Domain domain;
  const Lanes places(Lanes::Array(Lanes::Array::LinSpaced(61, 0.0, 1.0)));
  return optimize::objective_at(optimize::Objective::max_tension,
                                optimize::design_numbers(lanes, Law::compensate, true), places, domain)
      .v.maxCoeff();
}

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Best of five: other load on the machine only increases the time.
double best_seconds(const std::function<void()>& work) {
  double best = 1e300;
  for (int i = 0; i < 5; ++i) best = std::min(best, seconds(work));
  return best;
}

double per_second(const std::function<double(const optimize::FileNumbers<double>&)>& value,
                  const optimize::Problem& problem) {
  constexpr int count = 20000;
  double sum = 0;
  optimize::FileNumbers<double> numbers = optimize::file_numbers(problem.base);
  const double time = best_seconds([&] {
    for (int i = 0; i < count; ++i) {
      numbers.OE = -40.0 + 1e-4 * i;
      sum += value(numbers);
    }
  });
  return sum > 0 ? count / time : 0;
}

}  // namespace
}  // namespace fusee

int main() {
  using namespace fusee;
  const optimize::Problem problem = testing::paper_problem();
  optimize::CertifiedResult certified;
  optimize::GeneticResult genetic;
  const double certified_time =
      best_seconds([&] { certified = optimize::certified_optimum(problem, optimize::Objective::max_tension); });
  const double genetic_time =
      best_seconds([&] { genetic = optimize::genetic_optimum(problem, optimize::Objective::max_tension); });
  std::printf("{\"evaluations_per_s\": {\"scalar\": %.0f, \"batched\": %.0f},\n", per_second(scalar_value, problem),
              per_second(batched_value, problem));
  std::printf(
      " \"certified\": {\"value\": %.12g, \"lower_bound\": %.12g, \"boxes\": %ld, \"evaluations\": %ld, \"seconds\": "
      "%.6f},\n",
      certified.value, certified.lower_bound, certified.boxes, certified.evaluations, certified_time);
  std::printf(" \"genetic\": {\"value\": %.12g, \"evaluations\": %ld, \"seconds\": %.6f}}\n", genetic.value,
              genetic.evaluations, genetic_time);
}
