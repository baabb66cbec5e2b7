/// \file
/// `fusee new --ask`: seven questions, and the mechanism file of a joint whose pulley is known to be feasible, because
/// it was built once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/console.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "pipeline/layout.h"

namespace fusee::cli {

/// Another answer to one question with which a layout exists, as a trial has shown.
struct OtherAnswer {
  int question = 0;    ///< 1 … 7
  std::string words;   ///< "room for the pulley"
  std::string answer;  ///< "24.5 mm"
  std::string given;   ///< "12 mm"
};

struct AskedMechanism {
  pipeline::LayoutSearch search;
  std::string text;                 ///< the file; "" without a layout
  std::vector<OtherAnswer> others;  ///< without a layout
  std::optional<OtherAnswer> room;  ///< with which the named motor holds the load, if it cannot hold it now
  std::string room_words;           ///< the layout with that room beside the chosen one
  LengthUnit units = LengthUnit::mm;
};

/// Asks on stderr and reads lines from stdin. An empty line takes the proposal; an answer that cannot be used is asked
/// again with the reason. Answers without a layout are asked again, too, until the input ends. `settings` overrule the
/// answers. Throws InputError if the input ends before the last answer or if a question has no usable answer in many
/// tries, and Stopped after a signal.
AskedMechanism ask_for_mechanism(Console& console, const std::vector<Setting>& settings, const RunContext& context);

}  // namespace fusee::cli
