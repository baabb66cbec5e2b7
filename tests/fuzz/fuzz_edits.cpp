// Any bytes as a mechanism file whose numbers are written again, also those with default values. It must read as the
// same mechanism. Corpus: tests/fuzz/corpus/mechanism.
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string_view>

#include "edit_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fusee::DeclaredMechanism mechanism;
  try {
    mechanism = fusee::parse_mechanism(text, "fuzz");
  } catch (const fusee::InputError&) {
    return 0;
  }
  constexpr std::size_t k_share = 5;  // one key in five, selected by a hash of the text
  if (!fusee::edit_laws::keeps_mechanism(text, mechanism, std::hash<std::string_view>{}(text) % k_share, k_share))
    std::abort();
  return 0;
}
