#include "calibration/acceptance.h"

#include "calibration/thresholds.h"

namespace fusee {

bool accepted(const Evidence& evidence, const Fit& before, const Fit& after, Candidate& candidate) {
  if (!after.usable) {
    candidate.why = "the joint could not be simulated with it";
    return false;
  }
  const double floor2 = evidence.floor * evidence.floor;
  const Comparison drop = compare(evidence, before, after);
  candidate.held_out_rms = std::sqrt(after.by_factor.mean_square);
  candidate.margin = drop.t;
  candidate.delta_bic = bic_drop(evidence, before, after);
  const double gain = before.by_factor.mean_square - after.by_factor.mean_square;
  const double excess = std::max(1e-30, before.by_factor.mean_square - floor2);
  if (!(gain > std::pow(k_thresholds.least_drop * evidence.floor, 2))) {
    candidate.why = "the held-out error does not fall by what the noise would show";
  } else if (!(drop.t > drop.needed_t) || !(drop.t_over_runs > k_thresholds.least_t_over_runs)) {
    candidate.why = "the held-out error falls in some strokes and not in others";
  } else if (!(candidate.delta_bic > k_thresholds.least_bic_drop)) {
    candidate.why = "too many numbers for what it explains";
  } else if (!(gain > k_thresholds.least_share * excess)) {
    candidate.why = "it explains a small part of what is there";
  } else {
    return true;
  }
  return false;
}

double score(const Evidence& evidence, const Fit& fit) {
  const double rows = static_cast<double>(std::max<std::size_t>(1, evidence.rows_used()));
  return fit.by_factor.mean_square + evidence.floor * evidence.floor * fit.against_readings / rows;
}

}  // namespace fusee
