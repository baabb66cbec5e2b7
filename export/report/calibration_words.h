/// \file
/// Internal: small pieces of text.
#pragma once

#include <string>
#include <vector>

namespace fusee {

std::string open_words(const std::string& name);  ///< "tendon_stretch" → "tendon stretch"
std::string first_upper(std::string words);
std::string joined(const std::vector<std::string>& words, const std::string& between);

}  // namespace fusee
