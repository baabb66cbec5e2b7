// libFuzzer target: any bytes as a recording of ROS 2 (MCAP, SQLite, packed or not) give an InputError, or a run for
// which all laws hold. Text is left to fuzz_measurement. Corpus: tests/fuzz/corpus/bags, which bags_test.cpp replays.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "measurement/log_file.h"
#include "measurement_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (fusee::measurement::format_of(bytes) == fusee::measurement::LogFormat::csv) return 0;
  try {
    const std::string broken = fusee::testing::broken_law(bytes);
    if (!broken.empty()) {
      std::fprintf(stderr, "%s\n", broken.c_str());
      std::abort();
    }
  } catch (const fusee::InputError&) {
  }
  return 0;
}
