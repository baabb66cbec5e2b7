/// \file
/// The model as it grows, in parallel projection, drawn from the parts' own outlines.
#pragma once

#include <string>
#include <vector>

#include "export/report/svg.h"
#include "fusee/export/kit.h"

namespace fusee {

/// A step of the assembly.
struct KitStep {
  std::string title;
  std::vector<std::string> parts;  ///< names of the parts that come to it
  bool motor = false;              ///< what else comes to it
  bool rods = false;
  bool pulley = false;
  bool tendons = false;
  std::vector<std::string> words;  ///< what to do
};

/// What is there after step `last`; what comes with it stands out.
Figure kit_picture(const KitProduct& product, const std::vector<KitStep>& steps, std::size_t last);

/// The joint from above, with the room that the link takes over the range.
Figure kit_plan_view(const KitProduct& product);

/// The same of a joint whose kit is plates to drill by: drum, ends, pins or idlers, sheaths and their mouths, pulley.
Figure kit_template_view(const KitProduct& product);

}  // namespace fusee
