/// \file
/// The program from its arguments to its exit code.
#pragma once

#include <string>
#include <vector>

namespace fusee::cli {

/// `words`: the arguments without the program's name. Never throws.
int run(const std::vector<std::string>& words);

}  // namespace fusee::cli
