/// \file
/// A valid mechanism file for tests to break.
#pragma once

#include <string>

namespace fusee {

/// A valid file with one key per line, so that a test knows each key's line.
inline const std::string k_good_file =
    "schema = 1\n"                 // 1
    "name = \"test\"\n"            // 2
    "[joint]\n"                    // 3
    "length_mm = 100\n"            // 4
    "range_deg = [-30.0, 30.0]\n"  // 5
    "[guides]\n"                   // 6
    "EB_mm = 50\n"                 // 7
    "ED_mm = 50\n"                 // 8
    "OE_mm = -40\n"                // 9
    "[pulley]\n"                   // 10
    "EF_mm = 80\n"                 // 11
    "r1_mm = 16\n"                 // 12
    "[tendon]\n"                   // 13
    "diameter_mm = 1\n";           // 14

/// `text` with the first `from` replaced; throws when there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace fusee
