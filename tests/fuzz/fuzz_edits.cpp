// Any bytes as a mechanism file whose numbers are written again, also those with default values. It must read as the
// same mechanism. Corpus: tests/fuzz/corpus/mechanism.
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism_file.h"

namespace {

/// Some applicable keys, selected by a hash of the text, with their present values.
std::vector<fusee::ValueEdit> own_values(std::string_view text, const fusee::DeclaredMechanism& mechanism) {
  constexpr std::size_t k_share = 5;  // one key in five
  const std::size_t choice = std::hash<std::string_view>{}(text);
  std::vector<fusee::ValueEdit> edits;
  std::size_t i = 0;
  for (const std::string& name : fusee::number_key_names()) {
    const auto key = fusee::find_number_key(name);
    if ((choice + i++) % k_share != 0 || key->field->table == "transmission") continue;
    // A first attachment makes another mechanism, even at C.
    const bool makes_another = key->field->kind == fusee::FieldKind::point || key->field->table == "sheath";
    if (makes_another && !key->field->is_set(mechanism)) continue;
    if (fusee::is_used(*key->field, mechanism)) edits.push_back({name, key->get(mechanism)});
  }
  return edits;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fusee::DeclaredMechanism mechanism;
  try {
    mechanism = fusee::parse_mechanism(text, "fuzz");
  } catch (const fusee::InputError&) {
    return 0;
  }
  if (mechanism.transmission) return 0;  // it has no tables for most keys
  const std::string edited = fusee::edit_values(text, own_values(text, mechanism));
  if (!(fusee::parse_mechanism(edited, "edited") == mechanism)) std::abort();
  return 0;
}
