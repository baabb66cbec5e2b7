#include "fusee/joint/bench_log.h"

#include "fusee/measurement/measurement.h"

namespace fusee {

BenchLog bench_log(const Measurement& measurement) {
  BenchLog log;
  for (const Run& run : measurement.runs) {
    BenchRun& into = log.emplace_back();
    into.has_load = run.has_load;
    into.has_temperature = run.has_temperature;
    into.rows.reserve(run.samples.size());
    for (const Sample& sample : run.samples)
      into.rows.push_back({sample.time, sample.alpha, sample.load, sample.temperature});
  }
  return log;
}

}  // namespace fusee
