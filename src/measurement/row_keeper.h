/// \file
/// Internal: keeps rows in bounded memory.
#pragma once

#include <cstddef>
#include <vector>

#include "fusee/measurement.h"

namespace fusee::measurement {

/// Keeps at most `most` rows. Of a longer log every second row is kept, then every fourth, and so on.
class RowKeeper {
 public:
  explicit RowKeeper(std::size_t most) : most_(most) {}

  /// Marks that the log restarts before the next row.
  void begin_again() { after_break_ = true; }
  void add(Sample sample);

  std::vector<Sample> samples;
  std::size_t stride = 1;  ///< every `stride`-th row is kept

 private:
  void thin_out();

  std::size_t most_;
  std::size_t counter_ = 0;   ///< rows added
  bool after_break_ = false;  ///< the log restarts before the next kept row
};

}  // namespace fusee::measurement
