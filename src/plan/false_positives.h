/// \file
/// False-positive rates: synthetic data sets with a known cause are drawn and explained again.
#pragma once

#include <set>

#include "plan/separation.h"

namespace fusee::plan {

struct FalsePositiveRates {
  FalsePositives nothing;  ///< without cause, as declared
  FalsePositives one;      ///< with one of `causes`, of a size drawn from its prior
  /// With one of `causes`, while that cause is missing from the catalogue. Naming a cause that the runs do not resolve
  /// from it does not count as wrong.
  FalsePositives unmodelled;
};
/// `rivals`: for each cause the indices of the causes that it is not resolved from.
FalsePositiveRates false_positive_rates(const Signatures& signatures, const Information& known,
                                        const std::vector<Cause>& causes,
                                        const std::vector<std::set<std::size_t>>& rivals, std::uint64_t seed);

}  // namespace fusee::plan
