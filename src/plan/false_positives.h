/// \file
/// False-positive rates: synthetic data sets with a known cause are drawn, and the cause is inferred from each.
#pragma once

#include <set>

#include "plan/separation.h"

namespace fusee::plan {

struct FalsePositiveRates {
  FalsePositives nothing;  ///< without cause, as declared
  FalsePositives one;      ///< with one of `causes`, of a size drawn from its prior
  /// With one of `causes`, while that cause is missing from the catalogue. To report a cause that the runs do not
  /// resolve from it does not count as wrong.
  FalsePositives unmodelled;
};
/// Draws k_plan.samples data sets of each kind. `rivals`: for each cause the indices of the causes from which it is not
/// resolved.
FalsePositiveRates false_positive_rates(const Signatures& signatures, const Information& known,
                                        const std::vector<Cause>& causes,
                                        const std::vector<std::set<std::size_t>>& rivals, std::uint64_t seed);

}  // namespace fusee::plan
