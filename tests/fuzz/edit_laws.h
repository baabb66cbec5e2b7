/// \file
/// Law of every edit of a mechanism file: a number that is written again, also one with its default value, leaves the
/// same mechanism. For the fuzz target and for the test that replays its corpus.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism_file.h"

namespace fusee::edit_laws {

/// Every `share`-th applicable number key from the `first` on, with its present value.
inline std::vector<ValueEdit> own_values(const DeclaredMechanism& mechanism, std::size_t first, std::size_t share) {
  std::vector<ValueEdit> edits;
  std::size_t i = first;
  for (const std::string& name : number_key_names()) {
    const auto key = find_number_key(name);
    const Field& field = *key->field;
    if (i++ % share != 0 || field.table == "transmission" || !is_used(field, mechanism)) continue;
    // An omitted key without a default has no value of its own; a first attachment makes another mechanism, even at C.
    const bool makes_another = field.kind == FieldKind::point || field.table == "sheath" || field.fallback.empty();
    if (makes_another && field.is_set != nullptr && !field.is_set(mechanism)) continue;
    edits.push_back({name, key->get(mechanism)});
  }
  return edits;
}

/// True when `text`, which reads as `mechanism`, reads as the same after its own values were written into it.
inline bool keeps_mechanism(std::string_view text, const DeclaredMechanism& mechanism, std::size_t first,
                            std::size_t share) {
  if (mechanism.transmission) return true;  // it has no tables for most keys
  return parse_mechanism(edit_values(text, own_values(mechanism, first, share)), "edited") == mechanism;
}

}  // namespace fusee::edit_laws
