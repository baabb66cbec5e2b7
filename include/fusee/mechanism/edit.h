/// \file
/// New values in a person's own file: its comments, its order and its layout stay.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fusee {

/// A key that gets a new number, in the file's unit.
struct ValueEdit {
  std::string key;  ///< known to find_number_key()
  double value = 0;
};

/// `text` with the values of these keys replaced where they stand; a key that is not written yet is put below its
/// table's header (or with the table at the end), a pair with both its numbers. `text` must be a mechanism file that
/// parses.
std::string edit_values(std::string_view text, const std::vector<ValueEdit>& edits);

}  // namespace fusee
