/// \file
/// How often measurements would blame falsely: worlds are drawn with a cause that is known, and what they would measure
/// is explained again.
#pragma once

#include "plan/separation.h"

namespace fusee {

struct Blame {
  FalseBlame nothing;  ///< in joints as declared
  FalseBlame one;      ///< in joints with one of `causes`, drawn from its usual sizes
  FalseBlame unknown;  ///< the same, with that cause taken out of the catalogue
};
Blame blame(const Signatures& signatures, const Information& known, const std::vector<Cause>& causes, std::uint64_t seed);

}  // namespace fusee
