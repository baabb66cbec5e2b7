/// \file
/// Internal: assembly pictures of the test rig in parallel projection, drawn from the parts' outlines.
#pragma once

#include <string>
#include <vector>

#include "export/report/svg.h"
#include "fusee/export.h"

namespace fusee::formats {

/// A step of the assembly.
struct KitStep {
  std::string title;
  std::vector<std::string> parts;  ///< names of the parts added
  bool motor = false;              ///< the step adds the motor
  bool rods = false;               ///< the step adds the rods
  bool pulley = false;             ///< the step adds the pulley
  bool tendons = false;            ///< the step adds the tendons
  std::vector<std::string> words;  ///< instructions
};

/// The rig after step `last`, with the added parts highlighted.
Figure kit_picture(const KitProduct& product, const std::vector<KitStep>& steps, std::size_t last);

/// The joint from above, with the link at home and at both ends of its range.
Figure kit_plan_view(const KitProduct& product);

/// The top view of a joint whose kit is plates to drill: the plates with their holes, drum, pins or idlers, pitch
/// curves, sheaths and tendons.
Figure kit_template_view(const KitProduct& product);

}  // namespace fusee::formats
