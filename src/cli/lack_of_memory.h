/// \file
/// Lack of memory: exit 6 in words, also where no exception can be thrown.
#pragma once

namespace fusee::cli {

inline constexpr const char* k_no_memory = "not enough memory for this";

/// From here on the program ends with exit 6 where GMP, or a function that must not throw, finds no memory; by default
/// both abort. Staged files stay until the next run that publishes there removes them.
void catch_lack_of_memory();

}  // namespace fusee::cli
