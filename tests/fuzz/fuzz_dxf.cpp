// Any bytes as a drawing: read, then checked. Corpus: tests/fuzz/corpus/dxf, which read_dxf_test.cpp replays.
#include <cstddef>
#include <cstdint>

#include "fusee/base.h"
#include "fusee/export.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    fusee::formats::check_drawing(fusee::formats::read_dxf({reinterpret_cast<const char*>(data), size}, "fuzz.dxf"));
  } catch (const fusee::InputError&) {
  }
  return 0;
}
