/// \file
/// The text file beside this one, compiled in by embed.cmake.
#pragma once

#include <string_view>

namespace fusee::embedded {

extern const std::string_view kit_css;  ///< beside page_css and plan_css

}  // namespace fusee::embedded
