/// \file
/// Laws of every measured run, whatever bytes it was read from; for the fuzz target and for the test that replays its
/// corpus.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "fusee/measurement.h"

namespace fusee::testing {

/// The broken law of a run, or "".
inline std::string broken_law(const measurement::Run& run) {
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    const measurement::Sample& sample = run.samples[i];
    if (!std::isfinite(sample.alpha) || !std::isfinite(sample.theta)) return "an angle is no number";
    if (run.has_load && !std::isfinite(sample.load)) return "a load is no number";
    if (run.has_time && i > 0 && !(sample.time >= run.samples[i - 1].time)) return "time goes back";
  }
  if (!run.samples.empty() && run.samples.front().after_break) return "the log begins again before it began";
  std::size_t next = 0;
  for (const measurement::Stroke& stroke : run.strokes) {
    if (stroke.first < next || stroke.last < stroke.first || stroke.last >= run.samples.size())
      return "strokes overlap or leave the run";
    const bool is_standstill = run.strokes.size() == 1 && stroke.first == 0 && stroke.last + 1 == run.samples.size();
    if (std::abs(stroke.direction) != 1 && !(stroke.direction == 0 && is_standstill))
      return "a stroke has no direction";
    next = stroke.last + 1;
  }
  return {};
}

/// Reads `bytes` as a run and computes its figures. Returns the broken law, or ""; throws InputError for unreadable
/// bytes.
inline std::string broken_law(std::string_view bytes) {
  // A first byte ! selects other columns, ? columns without units, & counts, so that one corpus covers the options.
  measurement::MeasurementOptions options;
  const char first = bytes.empty() ? ' ' : bytes.front();
  if (first == '!') options.columns = {{"load", "x"}, {"alpha", "a_rad"}, {"time", "t_ms"}};
  if (first == '?')
    options.columns = {{"load", "x"}, {"alpha", "a"}, {"theta", "b"}, {"time", "t"}},
    options.home_readings = {{"theta", 153.2}};
  if (first == '&') {
    options.ticks_per_turn = {{"alpha", 4096}, {"theta", -2000}};
    options.zero_ticks = {{"theta", 100}};
    options.units = {{"time", "us"}, {"load", "lbf"}};
  }
  const bool has_options = std::string_view("!?&").find(first) != std::string_view::npos;
  measurement::Measurement measurement;
  measurement.runs.push_back(
      measurement::parse_run(bytes.substr(has_options ? 1 : 0), "run.csv", options, measurement));
  Mechanism ratio;
  ratio.transmission = RatioTransmission{4.0};
  const std::string broken = broken_law(measurement.runs[0]);
  if (!broken.empty()) return broken;
  if (!measurement.not_testable.empty()) return {};
  measurement::compare_with_declared(ratio, measurement);
  const measurement::NoiseFloor floor = measurement::noise_floor(measurement);
  if (!(floor.rms >= 0) || !std::isfinite(floor.rms) || !std::isfinite(floor.degrees_of_freedom))
    return "the noise floor is no number";
  const measurement::Iso230 figures =
      measurement::iso230(measurement, {std::vector<double>(measurement.runs[0].samples.size(), 1.0)});
  if (std::abs(figures.A) > 1e-9 || std::abs(figures.R) > 1e-9) return "a constant residual has a range";
  return {};
}

}  // namespace fusee::testing
