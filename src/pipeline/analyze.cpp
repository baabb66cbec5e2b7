#include "fusee/analysis/plausibility.h"
#include "fusee/joint/as_it_is.h"
#include "fusee/pipeline.h"
#include "pipeline/several_turns.h"

namespace fusee {
namespace {

/// What forces say, and what they leave out, where one turn does not suffice.
std::optional<Diagnostic> note_on_turns(const MechanismFile& file) {
  SynthesisOptions options;
  options.advice = false;
  if (!need_several_turns(synthesise(as_it_is(file.mechanism).mechanism, options))) return std::nullopt;
  return Diagnostic{Severity::note,
                    file.place_of("pulley.winding"),
                    "the tendons are wound several times: forces are those of level tendons that are tied 5 mm beyond "
                    "the range; the slope of their paths, the spare turns and what guides.collar does to theta are not "
                    "in them",
                    {}};
}

}  // namespace

AnalysisResult analyze(const MechanismFile& file, const AnalysisOptions& options) {
  if (file.mechanism.transmission) {
    throw InputError(file.path, "a joint with [transmission] has no tendons to analyze",
                     "[transmission] is for 'fusee calibrate'");
  }
  AnalysisResult result = analyse(as_it_is(file.mechanism).mechanism, options);
  result.warnings = likely_slips(file);
  // A tendon that breaks is no doubt but an error.
  if (const auto overloaded = overloaded_tendon(file); overloaded && !result.breaks_at)
    result.warnings.push_back(*overloaded);
  const std::vector<Diagnostic> bends = tight_bends(file);
  result.warnings.insert(result.warnings.end(), bends.begin(), bends.end());
  if (const auto turns = note_on_turns(file)) result.warnings.push_back(*turns);
  return result;
}

}  // namespace fusee
