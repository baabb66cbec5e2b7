/// \file
/// `fusee new --ask`: six questions, each with a picture and a default, and the mechanism that the answers make.
#pragma once

#include <string>
#include <vector>

#include "cli/console.h"
#include "fusee/mechanism.h"
#include "fusee/profile.h"

namespace fusee::cli {

struct AskedMechanism {
  DeclaredMechanism mechanism;                ///< answers, and proportions of the paper's optimum for all other numbers
  std::vector<std::string> changed;           ///< numbers without a question that had to change: "r1 ≤ 9.3 mm"
  std::vector<profile::Condition> obstacles;  ///< remaining obstacles to a pulley
  std::vector<profile::Change> advice;        ///< changes of the answers that would remove them
  std::string text;                           ///< the file: answers and consequences, each with its meaning
};

/// Asks on stderr and reads lines from stdin. An empty line or the end of the input takes the proposal. Throws
/// InputError after several invalid answers.
AskedMechanism ask_for_mechanism(Console& console);

}  // namespace fusee::cli
