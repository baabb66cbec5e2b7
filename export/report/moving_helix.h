/// \file
/// The tendons of a pulley of several turns as a person turns it: seen from the side, where they climb.
#pragma once

#include <string>
#include <string_view>

#include "fusee/export/product.h"

namespace fusee {

/// HTML, what a page says over it.
inline constexpr std::string_view k_climbing_words =
    "<p class=\"lead\">From the side, the joint to the right: pitch curves as they turn, thick what is wound of each "
    "tendon, and both paths from where they leave to the guides, to scale. The part above turns with it.</p>";

/// HTML of a section's inside. Needs moving_helix.js and page.css.
std::string moving_helix(const Product& product);

}  // namespace fusee
