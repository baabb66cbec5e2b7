#include "calibration/next_runs.h"

#include <algorithm>
#include <cmath>

#include "calibration/explanation.h"
#include "calibration/thresholds.h"
#include "fusee/base/text.h"
#include "fusee/plan/bench_run.h"
#include "measurement/seen_span.h"

namespace fusee {
namespace {

constexpr std::size_t k_most_proposals = 4;
constexpr double k_lever_load = 0.3;    // of the pretension, as a tip force
constexpr double k_slow_stroke = 15.0;  // s, where no time was logged
constexpr int k_rows_a_stroke = 60;
/// Of a pace that is clearly another one.
constexpr double k_faster = 5.0, k_slower = 0.1;

const Run& longest(const Measurement& measurement) {
  return *std::max_element(measurement.runs.begin(), measurement.runs.end(),
                           [](const Run& a, const Run& b) { return a.samples.size() < b.samples.size(); });
}

double largest_load(const Evidence& evidence) {
  double most = 0;
  for (const Run& run : evidence.measurement.runs) {
    for (const Sample& sample : run.samples) most = std::max(most, run.has_load ? std::abs(sample.load) : 0.0);
  }
  if (most > 0 || evidence.declared->transmission) return most;
  return std::max(1.0, std::round(k_lever_load * evidence.declared->tendon.pretension));
}

/// The strokes that were measured, without load.
PlannedRun as_before(const Measurement& measurement) {
  const Run& run = longest(measurement);
  const SeenSpan seen = seen_span(measurement, &Sample::alpha);
  PlannedRun before{.from = seen.least, .to = seen.most};
  before.speed = run.has_time && run.speed > 0 ? run.speed : seen.size() / k_slow_stroke;
  return before;
}

/// What could be driven next, beginning from what was.
std::vector<PlannedRun> proposals(const Evidence& evidence) {
  const PlannedRun before = as_before(evidence.measurement);
  const double load = largest_load(evidence);
  std::vector<PlannedRun> all;
  const auto add = [&](auto... changes) {
    PlannedRun run = before;
    (changes(run), ...);
    all.push_back(run);
  };
  const auto loaded = [](double by) { return [by](PlannedRun& run) { run.load = by; }; };
  const auto paced = [](double by) { return [by](PlannedRun& run) { run.speed *= by; }; };
  const auto with = [](BenchChange change) { return [change](PlannedRun& run) { run.change = change; }; };
  for (const double times : {1.0, -1.0, 2.0}) {
    if (load > 0) add(loaded(times * load));
  }
  add();
  if (longest(evidence.measurement).has_time) {
    add(paced(k_faster));
    add(paced(k_slower));
  }
  if (evidence.declared->transmission) return all;
  for (const BenchChange change : {BenchChange::doubled_pretension, BenchChange::motor_sensor_turned,
                                   BenchChange::joint_sensor_turned, BenchChange::on_its_side})
    add(with(change));
  return all;
}

/// In the joint that was found and in each of its rivals.
RankedMeasurement tried(const PlannedRun& run, const Evidence& evidence, const Selection& selection,
                        const std::vector<const Rival*>& pairs) {
  const BenchLog log = {driven(run, k_rows_a_stroke)};
  const auto shown = [&](const Imperfections& at) {
    const ChangedJoint joint = changed(*evidence.declared, at, run.change);
    return predict(joint.declared, joint.at, log);
  };
  const Readings found = shown(selection.best.at);
  const std::string unit = evidence.declared->transmission ? evidence.measurement.load_unit : "N";
  RankedMeasurement measurement{words(run, as_before(evidence.measurement).speed, unit), minutes_of(run), {}};
  for (const Rival* pair : pairs)
    measurement.margins.push_back(rms_apart(found, shown(pair->fit.at)) / evidence.floor / k_thresholds.told_apart);
  return measurement;
}

/// A reading by hand tells those apart that give a number different values.
RankedMeasurement tried(const EffectParameter& number, const Selection& selection,
                        const std::vector<const Rival*>& pairs) {
  RankedMeasurement measurement{std::string(number.by_hand.words), 0, {}};
  for (const Rival* pair : pairs)
    measurement.margins.push_back(std::abs(value_of(selection.best.at, number) - value_of(pair->fit.at, number)) /
                                  number.by_hand.uncertainty / k_thresholds.told_apart);
  return measurement;
}

std::string sentence(const RankedMeasurement& ranked, const std::vector<const Rival*>& pairs) {
  std::string told;
  const Effect* named = nullptr;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (ranked.margins[i] <= 1) continue;
    const double apart = ranked.margins[i] * k_thresholds.told_apart;
    const std::string unit = told.empty() ? " × what it is uncertain by)" : " ×)";
    told += told.empty() ? "" : ", ";
    if (pairs[i]->accepted != named) told += pairs[i]->accepted->name + " from ";
    named = pairs[i]->accepted;
    told += pairs[i]->rival->name + " (" + rounded(std::min(apart, 999.0), 2) + unit;
  }
  return ranked.words + ": it tells " + told;
}

}  // namespace

namespace {

/// Of a held point: from where it was come to.
struct Sides {
  double alpha = 0;
  bool rising = false, falling = false;
};

std::vector<Sides> held_points(const Measurement& measurement) {
  const SeenSpan seen = seen_span(measurement, &Sample::alpha);
  std::vector<Sides> points;
  for (const Run& run : measurement.runs) {
    if (!is_from_point_to_point(run)) continue;
    for (const Stretch& stretch : run.stretches) {
      const bool is_first = &stretch == &run.stretches.front();  // where it came from was not logged
      if (!stretch.held || is_first) continue;
      const double alpha = run.samples[stretch.first].alpha;
      auto point = std::find_if(points.begin(), points.end(), [&](const Sides& known) {
        return std::abs(known.alpha - alpha) <= k_one_stand * seen.size();
      });
      if (point == points.end()) point = points.insert(points.end(), {alpha});
      const int direction = run.strokes[stretch.stroke].direction;
      point->rising = point->rising || direction > 0;
      point->falling = point->falling || direction < 0;
    }
  }
  return points;
}

/// Where a run sweeps there and back; nothing where it does not.
SeenSpan swept_both_ways(const Run& run) {
  const auto goes = [&](int direction) {
    return std::any_of(run.strokes.begin(), run.strokes.end(),
                       [&](const Stroke& stroke) { return !stroke.partial && stroke.direction == direction; });
  };
  if (is_from_point_to_point(run) || !goes(1) || !goes(-1)) return {};
  return seen_span(run.samples, &Sample::alpha);
}

}  // namespace

void ask_for_both_sides(const Measurement& measurement, std::vector<std::string>& next) {
  std::vector<Sides> points = held_points(measurement);
  for (const Run& run : measurement.runs) {
    const SeenSpan swept = swept_both_ways(run);
    std::erase_if(points, [&](const Sides& p) { return p.alpha >= swept.least && p.alpha <= swept.most; });
  }
  const auto both = std::count_if(points.begin(), points.end(), [](const Sides& p) { return p.rising && p.falling; });
  if (2 * static_cast<std::size_t>(both) >= points.size()) return;
  next.push_back(
      "come to each held point from both sides, up the range and down again: from one side alone play and friction "
      "look like an error of the place");
}

std::vector<std::string> next_runs(const Evidence& evidence, const Selection& selection) {
  const std::vector<const Rival*> pairs = rivals_as_good(evidence, selection);
  if (pairs.empty()) return {};
  std::vector<RankedMeasurement> ranked;
  for (const PlannedRun& run : proposals(evidence)) ranked.push_back(tried(run, evidence, selection, pairs));
  for (const EffectParameter* number : hand_readable(*evidence.declared))
    ranked.push_back(tried(*number, selection, pairs));
  rank(ranked);
  std::vector<std::string> words;
  for (const RankedMeasurement& entry : ranked) {
    if (words.size() < k_most_proposals && entry.told() > 0) words.push_back(sentence(entry, pairs));
  }
  // Nothing that can be simulated tells them apart: what each effect itself asks for.
  if (words.empty()) {
    for (const Rival* pair : pairs) words.push_back(pair->rival->separating_run);
  }
  return words;
}

}  // namespace fusee
