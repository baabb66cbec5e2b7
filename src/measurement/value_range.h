/// \file
/// Internal: range of a logged number, and equal bins over it.
#pragma once

#include <algorithm>
#include <limits>

#include "fusee/measurement.h"

namespace fusee::measurement {

struct ValueRange {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void take(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  /// True for a range of positive size.
  bool any() const { return most > least; }
  double size() const { return most - least; }
};

inline ValueRange value_range(const std::vector<Sample>& samples, double Sample::*number) {
  ValueRange span;
  for (const Sample& sample : samples) span.take(sample.*number);
  return span;
}

/// Range over all runs.
inline ValueRange value_range(const Measurement& measurement, double Sample::*number) {
  ValueRange span;
  for (const Run& run : measurement.runs) {
    for (const Sample& sample : run.samples) span.take(sample.*number);
  }
  return span;
}

/// A range cut into `count` bins of equal width.
struct Bins {
  ValueRange span;
  int count = 1;

  /// Position in bins, clamped to 0 … `count`; 0 for an empty span.
  double place(double value) const {
    if (!span.any()) return 0;
    return std::clamp((value - span.least) / span.size() * count, 0.0, static_cast<double>(count));
  }
  int bin(double value) const { return std::min(static_cast<int>(place(value)), count - 1); }
  /// Lower edge of a bin.
  double edge(int bin) const { return span.least + span.size() * bin / count; }
};

}  // namespace fusee::measurement
