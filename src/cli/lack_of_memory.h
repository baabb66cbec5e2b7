/// \file
/// Out of memory: exit 6 with a message, also where no exception can be thrown.
#pragma once

namespace fusee::cli {

inline constexpr const char* k_no_memory = "not enough memory for this";

/// From now on the program exits with 6 if GMP or a noexcept function runs out of memory; by default both abort. Staged
/// files remain until the next run that publishes there removes them.
void catch_lack_of_memory();

}  // namespace fusee::cli
