#include "calibration/expected_sizes.h"

#include <algorithm>
#include <vector>

#include "calibration/statistics.h"
#include "calibration/thresholds.h"

// The known size of a number comes from all joints, also those with large errors. On a joint with a small error it
// penalises each number of an effect, so that an effect of four numbers would lose to an effect of one.

namespace fusee::calibration {
namespace {

/// Chords over the known sizes; empty if the joint cannot be simulated.
struct Chords {
  Parameters parameters;
  Tangent tangent;
};

}  // namespace

std::map<const EffectParameter*, double> expected_sizes(const EffectSet& catalogue, const Evidence& evidence,
                                                        FitterPool& pool) {
  std::map<const EffectParameter*, double> sizes;
  const Fit none = pool.one().fit({}, {});
  if (!none.usable) return sizes;
  const double seen = std::max(k_thresholds.most_expected * rms_of(tangent_of(evidence, none).residual),
                               k_thresholds.least_expected * evidence.floor);
  std::vector<Chords> all(catalogue.size());
  pool.each(catalogue.size(), [&](const Fitter& fitter, std::size_t i) {
    const Fit wider = fitter.add_chords(none, *catalogue[i]);
    if (wider.usable) all[i] = {wider.parameters, tangent_of(evidence, wider)};
  });
  for (const Chords& of_one : all) {
    for (Eigen::Index k = none.x.size(); k < of_one.tangent.x.size(); ++k) {
      const double size = of_one.tangent.prior[k];
      const double moved = size * rms_of(of_one.tangent.J.col(k));
      if (moved > seen) sizes[of_one.parameters[static_cast<std::size_t>(k)]] = size * seen / moved;
    }
  }
  return sizes;
}

}  // namespace fusee::calibration
