// libFuzzer target: any bytes as a measured run give an InputError, or a run for which all laws hold.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "measurement_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string broken = fusee::testing::broken_law(std::string_view(reinterpret_cast<const char*>(data), size));
    if (!broken.empty()) {
      std::fprintf(stderr, "%s\n", broken.c_str());
      std::abort();
    }
  } catch (const fusee::InputError&) {
  }
  return 0;
}
