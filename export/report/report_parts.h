/// \file
/// The text files beside this one, compiled in by embed.cmake.
#pragma once

#include <string_view>

namespace fusee::embedded {

extern const std::string_view page_html;  ///< the page, with {{parts}} to be filled in
extern const std::string_view page_css;
extern const std::string_view calibration_css;  ///< beside page_css
extern const std::string_view plan_css;         ///< the same, of a measuring plan
extern const std::string_view figure_css;       ///< of every Figure
extern const std::string_view viewer_js;        ///< the part in 3-D
extern const std::string_view readout_js;       ///< values under the pointer in plots
extern const std::string_view moving_helix_js;  ///< the same of several turns
extern const std::string_view moving_joint_js;  ///< the joint under the slider
extern const std::string_view pulley_scad;      ///< the program under its parameters and arrays

}  // namespace fusee::embedded
