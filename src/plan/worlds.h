/// \file
/// How often measurements would blame falsely: worlds are drawn with a cause that is known, and what they would measure
/// is explained again.
#pragma once

#include <set>

#include "plan/separation.h"

namespace fusee {

struct Blame {
  FalseBlame nothing;  ///< in joints as declared
  FalseBlame one;      ///< in joints with one of `causes`, drawn from its usual sizes
  /// The same, with that cause taken out of the catalogue. A name that the measurements do not tell from it anyway is
  /// not false.
  FalseBlame unknown;
};
/// `rivals`: of every cause the places of those that it is not told from.
Blame blame(const Signatures& signatures, const Information& known, const std::vector<Cause>& causes,
            const std::vector<std::set<std::size_t>>& rivals, std::uint64_t seed);

}  // namespace fusee
