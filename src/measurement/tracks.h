/// \file
/// Internal: joins numbers that are logged at different times to rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "measurement/row_keeper.h"

namespace fusee::measurement {

struct TrackPoint {
  std::int64_t time = 0;  ///< ns
  double value = 0;
  std::size_t order = 0;  ///< number of its message or row in the log; equal for numbers of one message
};

/// One logged number.
struct Track {
  std::string role;                ///< "alpha", "theta", "load" …
  std::vector<TrackPoint> points;  ///< by their `order`
  double half_turn = 0;            ///< half a turn of an angle, in the unit of the values; 0: unknown
  std::size_t stride = 1;          ///< every `stride`-th point is kept

  /// Keeps the point. Beyond four million points, every second one is kept, then every fourth, and so on.
  void add(const TrackPoint& point);

 private:
  std::size_t count_ = 0;  ///< points since the last thinning
};

struct JoinedRows {
  std::size_t rows = 0;  ///< points of the track that gives the times, with those whose row is omitted
  std::vector<std::string> notes;
};

/// Joins the tracks to rows at the times of α or θ, whichever has more points; of α if `needs_theta` is false.
///
/// A number of the same message, or of the same time, is taken unchanged. Others are interpolated linearly between
/// their neighbours in time. There is no interpolation before the first point, after the last point, or over a gap of
/// more than 5 usual steps of that number. At a jump of more than half a turn the nearer point is taken. Rows without α
/// or θ are omitted, with a note. Loads and temperatures that are logged less than every 2 s keep their last value:
/// they are set by hand. Where a clock goes back, a new log begins: no interpolation crosses it.
///
/// Times since 1970 become s since the first row; other times are kept, in s.
JoinedRows join(const std::vector<Track>& tracks, bool needs_theta, RowKeeper& into);

}  // namespace fusee::measurement
