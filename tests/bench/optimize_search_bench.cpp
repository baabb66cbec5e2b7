// Searches over six lengths: cost of a feasible design compared with drawing it completely, and duration of a proof on
// one and two threads.
#include <benchmark/benchmark.h>

#include "fusee/optimize.h"
#include "fusee/profile.h"
#include "optimize/problem_text.h"
#include "optimize/random.h"

namespace fusee {
namespace {

optimize::Problem six_lengths(const std::string& feasible) {
  return testing::paper_problem(
      {{"pulley.method", "exact"},
       {"guides.radius_mm", "2"},
       {"guides.friction", "0.12"},
       {"optimize.tied", "[]"},
       {"optimize.constraints", "[]"},
       {"optimize.feasible", feasible},
       {"optimize.variables",
        R"(["joint.length_mm", "guides.ED_mm", "guides.EB_mm", "guides.OE_mm", "pulley.EF_mm", "pulley.r1_mm"])"},
       {"optimize.lower", "[60, 20, 20, -40, 60, 8]"},
       {"optimize.upper", "[120, 60, 60, 20, 120, 20]"}});
}

/// Forty random designs that have a value of the objective.
std::vector<Mechanism> designs(const optimize::Problem& problem) {
  optimize::Random random(1);
  std::vector<Mechanism> all;
  while (all.size() < 40) {
    const Mechanism mechanism = optimize::mechanism_at(problem, optimize::random_design(problem, random));
    if (optimize::evaluate(optimize::Objective::max_tension, mechanism).possible) all.push_back(mechanism);
  }
  return all;
}

void feasible_by_conditions(benchmark::State& state) {
  const std::vector<Mechanism> all = designs(six_lengths("true"));
  for (auto _ : state) {
    for (const Mechanism& mechanism : all) benchmark::DoNotOptimize(profile::obstacle_to(mechanism));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}
BENCHMARK(feasible_by_conditions)->Unit(benchmark::kMillisecond);

void feasible_by_drawing(benchmark::State& state) {
  const std::vector<Mechanism> all = designs(six_lengths("true"));
  profile::SynthesisOptions options;
  options.advice = false;
  for (auto _ : state) {
    for (const Mechanism& mechanism : all) {
      // Nearly straight curves need gigabytes of points. They are omitted, which favours the drawing.
      if (profile::obstacle_to(mechanism) || optimize::evaluate(optimize::Objective::min_bend, mechanism).value > 1e4)
        continue;
      benchmark::DoNotOptimize(profile::synthesise(mechanism, options));
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}
BENCHMARK(feasible_by_drawing)->Unit(benchmark::kMillisecond);

void genetic_of_feasible_designs(benchmark::State& state) {
  const optimize::Problem problem = six_lengths("true");
  optimize::GeneticOptions options;
  options.generations = 20;
  options.threads = static_cast<unsigned>(state.range(0));
  long evaluations = 0;
  for (auto _ : state)
    evaluations += optimize::genetic_optimum(problem, optimize::Objective::max_tension, options).evaluations;
  state.SetItemsProcessed(evaluations);
}
BENCHMARK(genetic_of_feasible_designs)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void proof_of_six_lengths(benchmark::State& state) {
  const optimize::Problem problem = six_lengths("false");
  optimize::CertifiedOptions options;
  options.gap = 1e-3;
  options.most_tie_boxes = 1;
  options.threads = static_cast<unsigned>(state.range(0));
  optimize::CertifiedResult result;
  for (auto _ : state) result = optimize::certified_optimum(problem, optimize::Objective::max_tension, options);
  state.counters["gap"] = result.relative_gap;
  state.counters["boxes"] = static_cast<double>(result.boxes);
}
BENCHMARK(proof_of_six_lengths)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace fusee
