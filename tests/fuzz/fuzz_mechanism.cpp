// libFuzzer target: any bytes as a mechanism file. An accepted file must survive writing and reading.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fusee/mechanism_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const fusee::DeclaredMechanism mechanism = fusee::parse_mechanism(text, "fuzz");
    if (!(fusee::parse_mechanism(fusee::write_mechanism(mechanism), "written") == mechanism)) std::abort();
  } catch (const fusee::InputError&) {
  }
  return 0;
}
