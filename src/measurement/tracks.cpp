#include "measurement/tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "measurement/columns.h"
#include "measurement/row_reader.h"
#include "measurement/strokes.h"

namespace fusee::measurement {
namespace {

constexpr double k_absent = std::numeric_limits<double>::quiet_NaN();
/// Neighbours that are further apart than this many usual steps have a gap between them: messages were lost.
constexpr double k_longest_gap = 5;
/// Longest sequence of late points. If more points are below the latest time, the clock was set back. As in
/// order_time().
constexpr std::size_t k_most_late_points = 3;
/// ns since 1970 in the year 2000.
constexpr std::int64_t k_since_1970 = 946'684'800'000'000'000;

/// True if the clock soon continues beyond `high`, the latest time before the point `k`.
bool is_late(const std::vector<TrackPoint>& points, std::size_t k, std::int64_t high) {
  const std::size_t end = std::min(points.size(), k + k_most_late_points + 1);
  return std::any_of(points.begin() + static_cast<std::ptrdiff_t>(k), points.begin() + static_cast<std::ptrdiff_t>(end),
                     [high](const TrackPoint& point) { return point.time > high; });
}

/// Adds the `order` of each point at which the track's clock restarts.
void find_restarts(const Track& track, std::set<std::size_t>& restarts) {
  if (track.points.empty()) return;
  std::int64_t high = track.points.front().time;
  for (std::size_t k = 1; k < track.points.size(); ++k) {
    const TrackPoint& point = track.points[k];
    if (point.time < high && is_late(track.points, k, high)) continue;
    if (point.time < high) restarts.insert(point.order);
    high = point.time;
  }
}

/// Median distance of points in time, ns; 0 for none.
double usual_step(const std::vector<TrackPoint>& points) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k].time > points[k - 1].time) steps.push_back(static_cast<double>(points[k].time - points[k - 1].time));
  }
  return median_of(std::move(steps));
}

/// Source of a value in a row.
enum class Origin { absent, logged, interpolated };

/// Values of a track at the times of another.
class TrackReader {
 public:
  TrackReader(const Track& track, const std::set<std::size_t>& restarts)
      : track_(track), member_(member_of(track.role)), usual_step_(usual_step(track.points)) {
    keeps_last_value_ = quantity_of(track.role) != Quantity::angle && usual_step_ > k_longest_step * 1e9;
    segments_.resize(1);
    auto restart = restarts.begin();
    for (const TrackPoint& point : track.points) {
      for (; restart != restarts.end() && *restart <= point.order; ++restart) segments_.emplace_back();
      segments_.back().push_back(point);
    }
    segments_.resize(restarts.size() + 1);
    for (std::vector<TrackPoint>& segment : segments_)
      std::stable_sort(segment.begin(), segment.end(),
                       [](const TrackPoint& a, const TrackPoint& b) { return a.time < b.time; });
  }

  /// Reads the value at the point `base` of the track that gives the times. Calls come in the order of these points.
  /// `segment`: number of restarts before the point.
  Origin read(const TrackPoint& base, std::size_t segment, Sample& into) {
    while (next_ < track_.points.size() && track_.points[next_].order < base.order) ++next_;
    if (next_ < track_.points.size() && track_.points[next_].order == base.order) {
      into.*member_ = track_.points[next_].value;
      return Origin::logged;
    }
    return read_by_time(segments_[segment], base.time, into.*member_);
  }

  const Track& track() const { return track_; }

 private:
  Origin read_by_time(const std::vector<TrackPoint>& points, std::int64_t time, double& value) const {
    const auto after = std::lower_bound(points.begin(), points.end(), time,
                                        [](const TrackPoint& point, std::int64_t t) { return point.time < t; });
    if (after != points.end() && after->time == time) {
      value = after->value;
      return Origin::logged;
    }
    if (after == points.begin()) return Origin::absent;
    const TrackPoint& before = *(after - 1);
    if (keeps_last_value_) {
      value = before.value;
      return Origin::logged;
    }
    if (after == points.end()) return Origin::absent;
    const auto gap = static_cast<double>(after->time - before.time);
    if (gap > k_longest_gap * usual_step_) return Origin::absent;
    const double share = static_cast<double>(time - before.time) / gap;
    const bool jumps = track_.half_turn > 0 && std::abs(after->value - before.value) > track_.half_turn;
    const double nearer = share < 0.5 ? before.value : after->value;
    value = jumps ? nearer : before.value + share * (after->value - before.value);
    return Origin::interpolated;
  }

  const Track& track_;
  double Sample::*member_;  ///< for the role of the track
  double usual_step_;       ///< ns
  bool keeps_last_value_ = false;
  std::vector<std::vector<TrackPoint>> segments_;  ///< points between restarts, by time
  std::size_t next_ = 0;                           ///< first point that is not before the latest row
};

const Track* find_track(const std::vector<Track>& tracks, const std::string& role) {
  const auto found =
      std::find_if(tracks.begin(), tracks.end(), [&role](const Track& track) { return track.role == role; });
  return found == tracks.end() ? nullptr : &*found;
}

/// The track that gives the rows their times.
const Track& base_of(const std::vector<Track>& tracks, bool needs_theta) {
  const Track* const alpha = find_track(tracks, "alpha");
  const Track* const theta = find_track(tracks, "theta");
  demand(alpha != nullptr && (theta != nullptr || !needs_theta), "no track of an angle");
  return needs_theta && theta->points.size() > alpha->points.size() ? *theta : *alpha;
}

class Joiner {
 public:
  Joiner(const std::vector<Track>& tracks, bool needs_theta, RowKeeper& into)
      : base_(base_of(tracks, needs_theta)), needs_theta_(needs_theta), into_(into) {
    for (const Track& track : tracks) find_restarts(track, restarts_);
    for (const Track& track : tracks) {
      if (&track != &base_) readers_.push_back({TrackReader(track, restarts_), Origin::absent, 0});
    }
    if (!base_.points.empty() && base_.points.front().time > k_since_1970) zero_ = base_.points.front().time;
  }

  JoinedRows join() {
    std::size_t segment = 0;
    auto restart = restarts_.begin();
    for (const TrackPoint& point : base_.points) {
      for (; restart != restarts_.end() && *restart <= point.order; ++restart) ++segment;
      add_row(point, segment);
    }
    return {base_.points.size(), notes()};
  }

 private:
  struct CountedReader {
    TrackReader reader;
    Origin latest;             ///< of the value in the latest row
    std::size_t interpolated;  ///< rows with an interpolated value
  };

  void add_row(const TrackPoint& point, std::size_t segment) {
    const double time = static_cast<double>(point.time - zero_) / 1e9;
    Sample sample{time, k_absent, k_absent, k_absent, k_absent, k_absent, k_absent, false};
    sample.*member_of(base_.role) = point.value;
    for (CountedReader& each : readers_) each.latest = each.reader.read(point, segment, sample);
    if (std::isnan(sample.alpha) || (needs_theta_ && std::isnan(sample.theta))) {
      ++omitted_;
      return;
    }
    for (CountedReader& each : readers_) {
      if (each.latest == Origin::interpolated) ++each.interpolated;
    }
    into_.add(sample);
  }

  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    for (const CountedReader& each : readers_) {
      if (each.interpolated > 0)
        notes.push_back(each.reader.track().role + " is interpolated in time in " + rows_text(each.interpolated) +
                        " of " + std::to_string(base_.points.size()));
    }
    if (omitted_ > 0)
      notes.push_back(rows_text(omitted_) + " of " + (base_.role == "alpha" ? "alpha" : "theta") +
                      " omitted: the other angle is not logged there (before its first reading, after its last, or in "
                      "a gap)");
    return notes;
  }

  const Track& base_;
  bool needs_theta_;
  RowKeeper& into_;
  std::set<std::size_t> restarts_;
  std::vector<CountedReader> readers_;
  std::int64_t zero_ = 0;    ///< ns; time of the first row if times count from 1970
  std::size_t omitted_ = 0;  ///< rows without α or θ
};

}  // namespace

void Track::add(const TrackPoint& point) {
  constexpr std::size_t k_most_track_points = std::size_t{1} << 22;
  if (count_++ % stride != 0) return;
  points.push_back(point);
  if (points.size() < k_most_track_points) return;
  for (std::size_t i = 0; 2 * i < points.size(); ++i) points[i] = points[2 * i];
  points.resize((points.size() + 1) / 2);
  stride *= 2;
  count_ = 0;
}

JoinedRows join(const std::vector<Track>& tracks, bool needs_theta, RowKeeper& into) {
  return Joiner(tracks, needs_theta, into).join();
}

}  // namespace fusee::measurement
