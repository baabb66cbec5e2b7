/// \file
/// Internal: the moving side view of the tendons of a multi-turn pulley.
#pragma once

#include <string>
#include <string_view>

#include "fusee/export.h"

namespace fusee::formats {

/// HTML above the drawing.
inline constexpr std::string_view k_moving_helix_words =
    "<p class=\"lead\">From the side, with the joint to the right, to scale: the turning pitch curves, the wound part "
    "of each tendon (thick), and both paths from the take-offs to the guides. The part above turns too.</p>";

/// The HTML inside a section. Requires moving_helix.js and page.css.
std::string moving_helix(const Product& product);

}  // namespace fusee::formats
