/// \file
/// Internal: between what values a logged number lay, and even places in between.
#pragma once

#include <algorithm>
#include <limits>

#include "fusee/measurement/measurement.h"

namespace fusee {

struct SeenSpan {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void take(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  bool any() const { return most > least; }
  double size() const { return most - least; }
};

inline SeenSpan seen_span(const std::vector<Sample>& samples, double Sample::*number) {
  SeenSpan span;
  for (const Sample& sample : samples) span.take(sample.*number);
  return span;
}

/// Over all runs.
inline SeenSpan seen_span(const Measurement& measurement, double Sample::*number) {
  SeenSpan span;
  for (const Run& run : measurement.runs) {
    for (const Sample& sample : run.samples) span.take(sample.*number);
  }
  return span;
}

/// A span cut into `count` bins of one width.
struct Bins {
  SeenSpan span;
  int count = 1;

  /// 0 at the span's beginning, `count` at its end; values beyond lie at the ends. Of no span all lie at its beginning.
  double place(double value) const {
    if (!span.any()) return 0;
    return std::clamp((value - span.least) / span.size() * count, 0.0, static_cast<double>(count));
  }
  int bin(double value) const { return std::min(static_cast<int>(place(value)), count - 1); }
  /// Where a bin begins.
  double edge(int bin) const { return span.least + span.size() * bin / count; }
};

}  // namespace fusee
