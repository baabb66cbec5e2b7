// Any bytes as a bundle: a valid one is packed again and reads the same. bundle_test.cpp replays the corpus,
// tests/fuzz/corpus/bundle.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/bundle.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const fusee::Bundle bundle = fusee::read_bundle({reinterpret_cast<const char*>(data), size}, "fuzz.zip");
    for (const fusee::BundledFile& file : bundle.files)
      if (!file.failure && !fusee::is_inner_path(file.path)) std::abort();
    const std::string packed = fusee::bundle_bytes(bundle);
    if (!fusee::is_bundle(packed) || fusee::bundle_bytes(fusee::read_bundle(packed, "fuzz.zip")) != packed)
      std::abort();
  } catch (const fusee::InputError&) {
  }
  return 0;
}
