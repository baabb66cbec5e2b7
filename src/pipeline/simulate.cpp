#include "fusee/pipeline.h"

#include "base/normal_numbers.h"
#include "fusee/joint.h"
#include "mechanism/effect.h"
#include "pipeline/several_turns.h"
#include "pipeline/without_law.h"
#include "transmission/declared_law.h"

namespace fusee {
namespace {

/// A mechanism and the imperfections of its joint.
struct SimulatedJoint {
  DeclaredMechanism mechanism;
  Imperfections at;
};

SimulatedJoint with_pulley(const DeclaredMechanism& declared, bool corrected) {
  if (!corrected) return {declared, declared.identified};
  return {expected_joint(declared), beyond_mechanism(declared.identified, kind_of(declared))};
}

/// Marks rows beyond the pulley's range, where the law's formulas are meaningless.
void mark_rows_beyond_range(const DeclaredMechanism& mechanism, const Run& run, std::vector<JointState>& states) {
  const DeclaredLaw law(mechanism);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!law.reaches(run.samples[i].alpha)) states[i] = {EquilibriumStatus::no_equilibrium};
  }
}

void add_noise(std::vector<JointState>& states, double noise, std::uint64_t seed) {
  NormalNumbers numbers(seed);
  for (JointState& state : states) state.shown += noise * numbers.next();
}

}  // namespace

SimulateResult simulate(const MechanismFile& file, const std::filesystem::path& log, const SimulateOptions& options,
                        const RunContext& context) {
  context.begin_step("moving the joint through " + log.string());
  SimulateResult result;
  Simulation& simulation = result.simulation;
  simulation.file = with_plausibility_warnings_and_turns(file);
  simulation.log = read_driving(log, file.mechanism, options.columns, *context.files);
  result.without_law = without_law(file.mechanism);
  if (result.without_law) return result;
  const SimulatedJoint joint = with_pulley(file.mechanism, options.corrected);
  simulation.states = simulate(joint.mechanism, joint.at, bench_log(simulation.log)).front();
  mark_rows_beyond_range(joint.mechanism, simulation.log.runs.front(), simulation.states);
  if (options.noise > 0) add_noise(simulation.states, options.noise, options.seed);
  return result;
}

}  // namespace fusee
