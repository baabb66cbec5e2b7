// Any bytes as a person's mechanism file that gets its own numbers anew, some of them where none was written: the same
// mechanism is read. Corpus: tests/fuzz/corpus/mechanism.
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism/edit.h"
#include "fusee/mechanism/fields.h"
#include "fusee/mechanism/file.h"

namespace {

/// Some keys of those that have a use there, chosen by the text, each with the number that it has.
std::vector<fusee::ValueEdit> own_values(std::string_view text, const fusee::DeclaredMechanism& mechanism) {
  constexpr std::size_t k_share = 5;  // one in so many
  const std::size_t choice = std::hash<std::string_view>{}(text);
  std::vector<fusee::ValueEdit> edits;
  std::size_t i = 0;
  for (const std::string& name : fusee::number_key_names()) {
    const auto key = fusee::find_number_key(name);
    if ((choice + i++) % k_share != 0 || key->field->table == "transmission") continue;
    // One that gets a place of its own, even C's, is another mechanism.
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
  if (mechanism.transmission) return 0;  // has none of the tables that most keys stand in
  const std::string edited = fusee::edit_values(text, own_values(text, mechanism));
  if (!(fusee::parse_mechanism(edited, "edited") == mechanism)) std::abort();
  return 0;
}
