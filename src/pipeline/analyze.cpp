#include "fusee/joint/as_it_is.h"
#include "fusee/pipeline.h"

namespace fusee {

AnalysisResult analyze(const MechanismFile& file, const AnalysisOptions& options) {
  if (file.mechanism.transmission) {
    throw InputError(file.path, "a joint with [transmission] has no tendons to analyze",
                     "[transmission] is for 'fusee calibrate'");
  }
  return analyse(as_it_is(file.mechanism).mechanism, options);
}

}  // namespace fusee
