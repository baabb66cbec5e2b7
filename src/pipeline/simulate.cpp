#include "base/normal_numbers.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "mechanism/effect.h"
#include "pipeline/multi_turn.h"
#include "pipeline/without_law.h"
#include "transmission/target_motion.h"

namespace fusee::pipeline {
namespace {

/// A mechanism and the imperfections of its joint.
struct SimulatedJoint {
  DeclaredMechanism mechanism;
  Imperfections imperfections;
};

/// The joint with the pulley that build() makes (`corrected`), or with the declared one.
SimulatedJoint with_pulley(const DeclaredMechanism& declared, bool corrected) {
  if (!corrected) return {declared, declared.identified};
  return {joint::expected_joint(declared), beyond_mechanism(declared.identified, kind_of(declared))};
}

/// Marks rows beyond the pulley's range, where the law's formulas are meaningless.
void mark_rows_beyond_range(const DeclaredMechanism& mechanism, const measurement::Run& run,
                            std::vector<joint::JointState>& states) {
  const transmission::TargetMotion law(mechanism);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!law.reaches(run.samples[i].alpha)) states[i] = {joint::EquilibriumStatus::no_equilibrium};
  }
}

void add_noise(std::vector<joint::JointState>& states, double noise, std::uint64_t seed) {
  NormalNumbers numbers(seed);
  for (joint::JointState& state : states) state.shown += noise * numbers.next();
}

}  // namespace

SimulateResult simulate(const MechanismFile& file, const std::filesystem::path& log, const SimulateOptions& options,
                        const RunContext& context) {
  context.begin_step("moving the joint through " + log.string());
  SimulateResult result;
  formats::Simulation& simulation = result.simulation;
  simulation.file = with_plausibility_warnings_and_turns(file);
  simulation.log = measurement::read_driving(log, file.mechanism, options.columns, *context.files);
  result.without_law = without_law(file.mechanism);
  if (result.without_law) return result;
  const SimulatedJoint joint = with_pulley(file.mechanism, options.corrected);
  simulation.states =
      joint::simulate(joint.mechanism, joint.imperfections, measurement::bench_log(simulation.log)).front();
  mark_rows_beyond_range(joint.mechanism, simulation.log.runs.front(), simulation.states);
  if (options.noise > 0) add_noise(simulation.states, options.noise, options.seed);
  return result;
}

}  // namespace fusee::pipeline
