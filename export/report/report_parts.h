/// \file
/// Internal: the text files of this folder, compiled in by embed.cmake.
#pragma once

#include <string_view>

namespace fusee::embedded {

extern const std::string_view page_html;  ///< the page, with {{parts}} to be filled in
extern const std::string_view page_css;
extern const std::string_view calibration_css;  ///< in addition to page_css
extern const std::string_view plan_css;         ///< in addition to page_css, for a measuring plan
extern const std::string_view figure_css;       ///< for every Figure
extern const std::string_view viewer_js;        ///< the part in 3-D
extern const std::string_view readout_js;       ///< values under the pointer in plots
extern const std::string_view moving_helix_js;  ///< the side view of multi-turn pulleys
extern const std::string_view moving_joint_js;  ///< the joint under the slider
extern const std::string_view pulley_scad;      ///< the program, which follows its parameters and arrays

}  // namespace fusee::embedded
