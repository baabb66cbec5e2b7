/// \file
/// Law of every edit of a mechanism file: a number that is written again, also one with its default value, leaves the
/// same mechanism. For the fuzz target and for the test that replays its corpus.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism_file.h"

namespace fusee::edit_laws {

/// Every `share`-th number key with its present value: those whose index plus `first` is a multiple of `share`. Keys
/// that do not apply are omitted.
inline std::vector<ValueEdit> own_values(const DeclaredMechanism& mechanism, std::size_t first, std::size_t share) {
  std::vector<ValueEdit> edits;
  std::size_t i = first;
  for (const std::string& name : number_key_names()) {
    const auto key = find_number_key(name);
    const Field& field = *key->field;
    if (i++ % share != 0 || field.table == "transmission" || !is_used(field, mechanism)) continue;
    // An omitted key without a default has no value of its own. The first key of a sheath makes another mechanism, and
    // so does a first attachment, even at C.
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
