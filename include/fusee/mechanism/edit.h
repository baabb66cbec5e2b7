/// \file
/// Edits of values in a user's file that keep its comments, order and layout.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fusee {

/// A new number for a key, in the file's unit.
struct ValueEdit {
  std::string key;  ///< known to find_number_key()
  double value = 0;
};

/// Replaces the values of these keys in `text`. A missing key is added below its table's header, or with its table at
/// the end; a pair gets both numbers. `text` must be a valid mechanism file.
std::string edit_values(std::string_view text, const std::vector<ValueEdit>& edits);

}  // namespace fusee
