// Any bytes as a bundle. What is read can be packed again, and is the same then. Corpus: tests/fuzz/corpus/bundle,
// which bundle_test.cpp replays.
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
