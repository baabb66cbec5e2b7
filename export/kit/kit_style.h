/// \file
/// Internal: the text file in this folder, compiled in by embed.cmake.
#pragma once

#include <string_view>

namespace fusee::embedded {

extern const std::string_view kit_css;  ///< in addition to page_css and plan_css

}  // namespace fusee::embedded
