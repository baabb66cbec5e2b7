// The reader of measured runs on any bytes: an InputError or a run, never a crash.

#include <cstdint>
#include <string_view>

#include "fusee/calibration/measurement.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fusee::Measurement measurement;
  try {
    const fusee::MeasurementOptions options{{{"load", "load_N"}}};
    measurement.runs.push_back(fusee::parse_run({reinterpret_cast<const char*>(data), size}, "run.csv",
                                                size % 2 == 0 ? options : fusee::MeasurementOptions{}, measurement));
  } catch (const fusee::InputError&) {
    return 0;
  }
  if (!measurement.not_testable.empty()) return 0;
  fusee::noise_floor(measurement);
  fusee::iso230(measurement, {std::vector<double>(measurement.runs[0].samples.size(), 1.0)});
  return 0;
}
