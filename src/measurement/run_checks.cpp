#include "measurement/run_checks.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"
#include "measurement/row_reader.h"
#include "measurement/strokes.h"

namespace fusee::measurement {
namespace {

constexpr std::size_t k_fewest_samples = 20;
/// Smaller motions are rounding of a log's last decimal.
constexpr double k_no_motion = radians(1e-6);

double span_of(const std::vector<Sample>& samples, double Sample::*value) {
  double least = samples.front().*value, most = least;
  for (const Sample& sample : samples) {
    least = std::min(least, sample.*value);
    most = std::max(most, sample.*value);
  }
  return most - least;
}

/// Rows in which one value is exactly constant.
struct Standstill {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Standstills of at least six rows between `first` and `last`.
std::vector<Standstill> standstills(const std::vector<Sample>& samples, double Sample::*value, std::size_t first,
                                    std::size_t last) {
  constexpr std::size_t fewest_rows = 6;
  std::vector<Standstill> found;
  for (std::size_t i = first; i <= last;) {
    std::size_t end = i;
    while (end < last && samples[end + 1].*value == samples[i].*value) ++end;
    if (end - i + 1 >= fewest_rows) found.push_back({i, end});
    i = end + 1;
  }
  return found;
}

std::string place_of(const Run& run, const Standstill& still) {
  if (run.has_time) return "at " + rounded(run.samples[still.first].time) + " s";
  return "at alpha " + rounded(degrees(run.samples[still.first].alpha)) + " deg";
}

/// The longest motion of α during which θ is constant. A standstill at a stroke's beginning may be play: its length
/// counts a quarter.
struct FrozenSpan {
  double alpha_span = 0;  ///< rad, weighted
  Standstill rows;
};

FrozenSpan frozen_theta(const Run& run) {
  FrozenSpan worst;
  for (const Stroke& stroke : run.strokes) {
    for (const Standstill& still : standstills(run.samples, &Sample::theta, stroke.first, stroke.last)) {
      const bool may_be_play = still.first <= stroke.first + 2;
      const double alpha_span =
          std::abs(run.samples[still.last].alpha - run.samples[still.first].alpha) * (may_be_play ? 0.25 : 1.0);
      if (alpha_span > worst.alpha_span) worst = {alpha_span, still};
    }
  }
  return worst;
}

void check_frozen_theta(const Run& run, Measurement& into) {
  const double alpha_span = span_of(run.samples, &Sample::alpha), theta_span = span_of(run.samples, &Sample::theta);
  // A coarse sensor is constant while α moves over one of its steps.
  const double one_step = alpha_span * into.theta_quantum / theta_span;
  const FrozenSpan frozen = frozen_theta(run);
  if (frozen.alpha_span <= std::max(0.1 * alpha_span, 3.0 * one_step)) return;
  const double moved = std::abs(run.samples[frozen.rows.last].alpha - run.samples[frozen.rows.first].alpha);
  into.not_testable.push_back(
      run.name + ": theta is constant at " + rounded(degrees(run.samples[frozen.rows.first].theta)) +
      " deg while alpha moves over " + rounded(degrees(moved), 3) + " deg (" + place_of(run, frozen.rows) +
      "): the sensor is frozen or saturated, or the joint is at a stop; log again without that");
}

/// θ may move at constant α where the load changes: such rows are no fault.
void check_frozen_alpha(const Run& run, Measurement& into) {
  const double theta_span = span_of(run.samples, &Sample::theta);
  const double load_span = run.has_load ? span_of(run.samples, &Sample::load) : 0;
  for (const Standstill& still : standstills(run.samples, &Sample::alpha, 0, run.samples.size() - 1)) {
    const std::vector<Sample> rows(run.samples.begin() + static_cast<std::ptrdiff_t>(still.first),
                                   run.samples.begin() + static_cast<std::ptrdiff_t>(still.last) + 1);
    if (run.has_load && span_of(rows, &Sample::load) > 0.1 * load_span) continue;
    const double moved = span_of(rows, &Sample::theta);
    if (moved <= 0.25 * theta_span) continue;
    into.not_testable.push_back(
        run.name + ": alpha is constant while theta moves over " + rounded(degrees(moved), 3) + " deg (" +
        place_of(run, still) +
        "): the motor's sensor is frozen, or the pulley slips on its shaft; log again without it");
    return;
  }
}

void note_gaps(const Run& run, const NoteSink& add_note) {
  for (const std::size_t gap : gaps_in(run.samples, run.has_time)) {
    if (run.samples[gap].after_break) continue;  // already reported when the log was read
    const double moved = std::abs(run.samples[gap].alpha - run.samples[gap - 1].alpha);
    const std::string time =
        run.has_time ? "of " + rounded(run.samples[gap].time - run.samples[gap - 1].time) + " s " : "";
    add_note("a gap " + time + "(" + place_of(run, {gap, gap}) + ") over which alpha moves " +
             rounded(degrees(moved), 3) + " deg: the play after it is unknown, the stroke is omitted");
  }
}

std::string stops_text(const Run& run) {
  const auto stops =
      std::count_if(run.segments.begin(), run.segments.end(), [](const Segment& segment) { return segment.is_dwell; });
  return "from point to point: alpha is held " + std::to_string(stops) +
         " times (a change of the load counts); a straight motion is assumed between dwells";
}

}  // namespace

void check_run(const Run& run, Measurement& into, const NoteSink& add_note) {
  const auto refuse = [&](const std::string& reason) { into.not_testable.push_back(run.name + ": " + reason); };
  if (run.samples.size() < k_fewest_samples) {
    return refuse(rows_text(run.samples.size()) + " can be used; at least " + std::to_string(k_fewest_samples) +
                  " are needed");
  }
  const double alpha_span = span_of(run.samples, &Sample::alpha), theta_span = span_of(run.samples, &Sample::theta);
  if (alpha_span < k_no_motion && run.strokes.empty())
    return refuse("alpha does not change: the motor did not move, or its sensor is dead");
  if (theta_span < k_no_motion) {
    return refuse("theta does not change while alpha moves over " + rounded(degrees(alpha_span)) +
                  " deg: the joint's sensor is dead, or the joint is stuck");
  }
  if (run.strokes.empty())
    return refuse("alpha only jitters (by " + rounded(degrees(alpha_span), 2) + " deg): there is no motion");
  check_frozen_theta(run, into);
  check_frozen_alpha(run, into);
  if (is_from_point_to_point(run)) {
    add_note(stops_text(run));
  } else {
    note_gaps(run, add_note);
  }
  const auto goes = [&](int direction) {
    return std::any_of(run.strokes.begin(), run.strokes.end(),
                       [&](const Stroke& s) { return s.direction == direction; });
  };
  if (!goes(0) && (!goes(1) || !goes(-1))) add_note("alpha moves in one direction only");
  const Stroke& first = run.strokes.front();
  if (first.partial) {
    add_note("the first stroke (" + rows_text(first.last - first.first + 1) +
             ") does not begin at a reversal, or begins unlike its repeats: its play is unknown, it is omitted");
  }
}

void check_all_runs(Measurement& measurement) {
  if (measurement.runs.empty()) measurement.not_testable.push_back("no run was given");
  if (!measurement.not_testable.empty()) return;
  int up = 0, down = 0;
  bool loaded = false, unloaded = false;
  for (const Run& run : measurement.runs) {
    for (const Stroke& stroke : run.strokes) {
      up += stroke.direction > 0;
      down += stroke.direction < 0;
    }
    for (const Segment& segment : run.segments) {
      loaded = loaded || segment.pull > 0;
      unloaded = unloaded || segment.pull < 0;
    }
  }
  // At a constant motor angle the load moves the joint both ways.
  if ((up > 0 && down > 0) || (loaded && unloaded)) return;
  if (up == 0 && down == 0) {
    measurement.not_testable.push_back(
        std::string("alpha is constant and the load only ") + (loaded ? "grows" : "falls") +
        ": without the return, friction and stretch cannot be distinguished; log both directions");
    return;
  }
  measurement.not_testable.push_back(std::string("alpha only ") + (up > 0 ? "grows" : "falls") +
                                     ": without the return, backlash, friction and delay cannot be distinguished from "
                                     "a wrong shape; log both directions");
}

}  // namespace fusee::measurement
