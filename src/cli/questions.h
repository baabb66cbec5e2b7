/// \file
/// `fusee new --ask`: six questions, each with a picture and a default, and the mechanism that the answers make.
#pragma once

#include <string>
#include <vector>

#include "cli/console.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/profile/advice.h"
#include "fusee/profile/synthesis.h"

namespace fusee::cli {

struct AskedMechanism {
  DeclaredMechanism mechanism;       ///< answers, and for all else proportions of the paper's optimum
  std::vector<std::string> changed;  ///< numbers that nobody was asked for and that had to be others: "r1 ≤ 9.3 mm"
  std::vector<Condition> obstacles;  ///< what stands in the way of a pulley all the same
  std::vector<Change> advice;        ///< which of the answers would have to be another
  std::string text;                  ///< the file: what was answered and what follows from it, each with its meaning
};

/// Asks on stderr, reads lines of stdin; an empty line, and the end of the input, take what is proposed. InputError
/// when an answer is not to be understood again and again.
AskedMechanism ask_for_mechanism(Console& console);

}  // namespace fusee::cli
