#include "calibration/next_measurements.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "calibration/explanation.h"
#include "calibration/thresholds.h"
#include "fusee/joint.h"
#include "fusee/plan.h"
#include "joint/joint_effects.h"
#include "measurement/value_range.h"

// Each proposal is simulated with the found effects and with each alternative, as fitted. Proposals produce inputs of
// calibrate only: a run with its columns, or a number with a key of [prior].

namespace fusee::calibration {
namespace {

constexpr std::size_t k_most_proposals = 4;
constexpr double k_lever_load = 0.3;    // share of the pretension, as a tip force
constexpr double k_slow_stroke = 15.0;  // s, without logged times
constexpr int k_rows_a_stroke = 60;
/// Factors to a clearly different speed.
constexpr double k_faster = 5.0, k_slower = 0.1;
constexpr double k_long_dwell = 60.0;  // s: nearly two decades of creep
/// Largest useful margin: of two wider ones the shorter measurement is first.
constexpr double k_wide = 3.0;
/// Least useful share of the margin that distinguishes.
constexpr double k_least_told = 0.6;

const measurement::Run& longest(const measurement::Measurement& measurement) {
  return *std::max_element(
      measurement.runs.begin(), measurement.runs.end(),
      [](const measurement::Run& a, const measurement::Run& b) { return a.samples.size() < b.samples.size(); });
}

double proposed_load(const Evidence& evidence) {
  if (evidence.largest_load > 0 || evidence.declared->transmission) return evidence.largest_load;
  return std::max(1.0, std::round(k_lever_load * evidence.declared->tendon.pretension));
}

/// The measured strokes, without load.
plan::PlannedRun as_before(const measurement::Measurement& measurement) {
  const measurement::Run& run = longest(measurement);
  const measurement::ValueRange seen = measurement::value_range(measurement, &measurement::Sample::alpha);
  plan::PlannedRun before{.from = seen.least, .to = seen.most};
  before.speed = run.has_time && run.speed > 0 ? run.speed : seen.size() / k_slow_stroke;
  return before;
}

/// True if a run at about this speed and load was measured.
bool was_measured(const plan::PlannedRun& run, const measurement::Measurement& measurement) {
  constexpr double k_same_share = 0.2;
  if (run.change != plan::BenchChange::none || run.dwell > 0) return false;
  return std::any_of(measurement.runs.begin(), measurement.runs.end(), [&](const measurement::Run& known) {
    const double load = known.has_load ? known.mean_load : 0.0;
    const bool is_load = std::abs(load - run.load) <= k_same_share * std::max(std::abs(load), std::abs(run.load));
    const bool is_pace = !known.has_time || std::abs(known.speed - run.speed) <= k_same_share * run.speed;
    return is_load && is_pace;
  });
}

/// Possible runs that were not measured, those nearest to the measured ones first.
std::vector<plan::PlannedRun> proposals(const Evidence& evidence) {
  const plan::PlannedRun before = as_before(evidence.measurement);
  const double load = proposed_load(evidence);
  std::vector<plan::PlannedRun> all;
  const auto add = [&](auto change) {
    plan::PlannedRun run = before;
    change(run);
    if (!was_measured(run, evidence.measurement)) all.push_back(run);
  };
  for (const double times : {1.0, -1.0, 2.0}) {
    if (load > 0) add([=](plan::PlannedRun& run) { run.load = times * load; });
  }
  add([](plan::PlannedRun&) {});
  if (longest(evidence.measurement).has_time) {
    add([](plan::PlannedRun& run) { run.speed *= k_faster; });
    add([](plan::PlannedRun& run) { run.speed *= k_slower, run.cycles = 1; });
    add([=](plan::PlannedRun& run) { run.load = load, run.cycles = 2, run.dwell = k_long_dwell; });
  }
  if (evidence.declared->transmission) return all;
  for (const plan::BenchChange change :
       {plan::BenchChange::motor_sensor_turned, plan::BenchChange::joint_sensor_turned})
    add([=](plan::PlannedRun& run) { run.change = change; });
  return all;
}

/// Member of a group in the place of the found effect.
struct Alternative {
  const fusee::Effect* found = nullptr;
  std::string name;                   ///< name of the member
  const Imperfections* at = nullptr;  ///< joint with the member in its place; without both if it was not fitted
  bool is_fitted = false;
};

/// Fit of a member in the place of the found effect; null without one.
const Rival* fitted_in_place(const Selection& selection, const fusee::Effect& found, const std::string& member) {
  const auto rival = std::find_if(selection.rivals.begin(), selection.rivals.end(), [&](const Rival& known) {
    return known.accepted == &found && known.rival->name == member && known.fit.usable;
  });
  return rival == selection.rivals.end() ? nullptr : &*rival;
}

std::vector<Alternative> alternatives(const Selection& selection, const std::vector<FoundEffect>& effects) {
  std::vector<Alternative> all;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const fusee::Effect* found = selection.best.effects[i];
    for (const std::string& member : effects[i].group) {
      if (member == found->name) continue;
      if (const Rival* rival = fitted_in_place(selection, *found, member)) {
        all.push_back({found, member, &rival->fit.at, true});
      } else if (selection.without[i].usable) {
        all.push_back({found, member, &selection.without[i].at, false});
      }
    }
  }
  return all;
}

/// Proposal with the margin by which it distinguishes each alternative: 1 just distinguishes.
struct Proposal {
  plan::NextMeasurement next;
  std::vector<double> margins;
};

class Proposals {
 public:
  Proposals(const Evidence& evidence, const Selection& selection, const std::vector<Alternative>& others)
      : evidence_(evidence), found_(selection.best.at), others_(others) {
    for (const plan::PlannedRun& run : proposals(evidence)) add(run);
    const std::vector<const EffectParameter*> unread = plan::unread_numbers(*evidence.declared);
    for (const fusee::Effect* effect : joint::effects_of(*evidence.declared)) {
      std::vector<const EffectParameter*> numbers;
      for (const EffectParameter* number : unread) {
        const auto is = [&](const EffectParameter& own) { return &own == number; };
        if (std::any_of(effect->parameters.begin(), effect->parameters.end(), is)) numbers.push_back(number);
      }
      if (!numbers.empty()) add(numbers);
    }
  }

  /// Best first, each for an alternative that those before it do not distinguish.
  std::vector<plan::NextMeasurement> best() {
    std::vector<plan::NextMeasurement> chosen;
    std::vector<bool> left(others_.size(), true);
    while (chosen.size() < k_most_proposals) {
      const auto next = std::max_element(all_.begin(), all_.end(), [&](const Proposal& one, const Proposal& other) {
        return is_worse(one, other, left);
      });
      if (next == all_.end() || distinguished(*next, left) == 0) break;
      describe(*next);
      for (std::size_t i = 0; i < left.size(); ++i) left[i] = left[i] && next->margins[i] < 1;
      chosen.push_back(next->next);
      all_.erase(next);
    }
    return chosen;
  }

 private:
  std::vector<std::vector<double>> shown(const Imperfections& at, const plan::PlannedRun& run) const {
    return joint::predict(*evidence_.declared, at, {plan::driven(run, k_rows_a_stroke)});
  }

  /// rms difference between both in the run, beyond their difference in the slow unloaded run, which the data and a
  /// curve of place determine. An unmodelled cause may have any dependence on load and speed.
  double rms_from(const Alternative& other, const plan::PlannedRun& run) const {
    if (!other.is_fitted && run.change == plan::BenchChange::none) return 0;
    plan::PlannedRun before = run;
    before.load = 0;
    before.change = plan::BenchChange::none;
    before.speed = as_before(evidence_.measurement).speed;
    const auto found = shown(found_, run), alternative = shown(*other.at, run);
    auto expected = shown(found_, before);
    const auto alternative_before = shown(*other.at, before);
    for (std::size_t k = 0; k < expected.front().size(); ++k)
      expected.front()[k] = alternative.front()[k] + expected.front()[k] - alternative_before.front()[k];
    return plan::rms_apart(found, expected);
  }

  /// Margins by the noise of the mean of repeated strokes.
  void add(const plan::PlannedRun& run) {
    const auto found = shown(found_, run);
    const auto stands = [](double angle) { return std::isfinite(angle); };
    if (!std::all_of(found.front().begin(), found.front().end(), stands)) return;
    const double noise = evidence_.floor / std::sqrt(2.0 * run.cycles);
    const std::string unit = evidence_.declared->transmission ? evidence_.measurement.load_unit : "N";
    Proposal proposal{plan::next_run(run, as_before(evidence_.measurement).speed, unit), {}};
    for (const Alternative& other : others_)
      proposal.margins.push_back(rms_from(other, run) / noise / k_thresholds.sure);
    all_.push_back(std::move(proposal));
  }

  /// Margins of caliper readings, for alternatives with different values of a number.
  void add(const std::vector<const EffectParameter*>& numbers) {
    Proposal proposal{plan::next_reading(numbers), {}};
    for (const Alternative& other : others_) {
      double squares = 0;
      for (const EffectParameter* number : numbers) {
        const double difference = reading_by_hand(*number, found_, *evidence_.declared) -
                                  reading_by_hand(*number, *other.at, *evidence_.declared);
        squares += elementary::pow(difference / number->by_hand.uncertainty, 2);
      }
      proposal.margins.push_back(std::sqrt(squares) / k_thresholds.sure);
    }
    all_.push_back(std::move(proposal));
  }

  /// Number of the remaining alternatives that it distinguishes; half distinguished ones count in part.
  static double distinguished(const Proposal& proposal, const std::vector<bool>& left) {
    double sum = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (left[i] && proposal.margins[i] >= k_least_told) sum += std::min(1.0, proposal.margins[i]);
    }
    return sum;
  }

  /// Order by the number of alternatives, then by the least of their margins, then by duration.
  static bool is_worse(const Proposal& one, const Proposal& other, const std::vector<bool>& left) {
    const double sum = distinguished(one, left), other_sum = distinguished(other, left);
    if (sum != other_sum) return sum < other_sum;
    const auto narrowest = [&](const Proposal& proposal) {
      double least = k_wide;
      for (std::size_t i = 0; i < left.size(); ++i) {
        if (left[i] && proposal.margins[i] >= k_least_told) least = std::min(least, proposal.margins[i]);
      }
      return least;
    };
    const double margin = narrowest(one), other_margin = narrowest(other);
    return margin != other_margin ? margin < other_margin : one.next.minutes > other.next.minutes;
  }

  void describe(Proposal& proposal) const {
    const fusee::Effect* named = nullptr;
    std::string distinguished;
    const auto separate = [&](const std::string& name) {
      std::vector<std::string>& names = proposal.next.separates;
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    for (std::size_t i = 0; i < others_.size(); ++i) {
      if (proposal.margins[i] < k_least_told) continue;
      const double margin = proposal.margins[i] * k_thresholds.sure;
      const std::string unit = distinguished.empty() ? " × the uncertainty)" : " ×)";
      distinguished += distinguished.empty() ? "" : ", ";
      if (others_[i].found != named) distinguished += others_[i].found->name + " from ";
      named = others_[i].found;
      distinguished += (others_[i].name == k_unmodelled ? "an unmodelled cause" : others_[i].name) + " (" +
                       rounded(std::min(margin, 999.0), 2) + unit;
      separate(others_[i].found->name);
      separate(others_[i].name);
    }
    proposal.next.gain = distinguished;
  }

  const Evidence& evidence_;
  const Imperfections& found_;
  const std::vector<Alternative>& others_;
  std::vector<Proposal> all_;
};

/// Sides from which a dwell was approached.
struct Sides {
  double alpha = 0;
  bool rising = false, falling = false;
};

std::vector<Sides> held_points(const measurement::Measurement& measurement) {
  const measurement::ValueRange seen = measurement::value_range(measurement, &measurement::Sample::alpha);
  std::vector<Sides> points;
  for (const measurement::Run& run : measurement.runs) {
    if (!measurement::is_from_point_to_point(run)) continue;
    for (const measurement::Segment& segment : run.segments) {
      const bool is_first = &segment == &run.segments.front();  // its approach was not logged
      if (!segment.is_dwell || is_first) continue;
      const double alpha = run.samples[segment.first].alpha;
      auto point = std::find_if(points.begin(), points.end(), [&](const Sides& known) {
        return std::abs(known.alpha - alpha) <= k_dwell_tolerance * seen.size();
      });
      if (point == points.end()) point = points.insert(points.end(), {alpha});
      const int direction = run.strokes[segment.stroke].direction;
      point->rising = point->rising || direction > 0;
      point->falling = point->falling || direction < 0;
    }
  }
  return points;
}

/// Range that a run sweeps in both directions; empty without one.
measurement::ValueRange swept_both_ways(const measurement::Run& run) {
  const auto goes = [&](int direction) {
    return std::any_of(run.strokes.begin(), run.strokes.end(), [&](const measurement::Stroke& stroke) {
      return !stroke.partial && stroke.direction == direction;
    });
  };
  if (measurement::is_from_point_to_point(run) || !goes(1) || !goes(-1)) return {};
  return measurement::value_range(run.samples, &measurement::Sample::alpha);
}

void ask(const std::string& words, std::vector<plan::NextMeasurement>& next) {
  const auto is = [&](const plan::NextMeasurement& one) { return one.words == words; };
  if (!words.empty() && std::none_of(next.begin(), next.end(), is)) next.push_back(plan::next_inspection(words));
}

}  // namespace

void ask_for_both_sides(const measurement::Measurement& measurement, std::vector<plan::NextMeasurement>& next) {
  std::vector<Sides> points = held_points(measurement);
  for (const measurement::Run& run : measurement.runs) {
    const measurement::ValueRange swept = swept_both_ways(run);
    std::erase_if(points, [&](const Sides& p) { return p.alpha >= swept.least && p.alpha <= swept.most; });
  }
  const auto both = std::count_if(points.begin(), points.end(), [](const Sides& p) { return p.rising && p.falling; });
  if (2 * static_cast<std::size_t>(both) >= points.size()) return;
  ask("approach each dwell from both sides, up the range and down again: from one side alone, play and friction "
      "look like an error of the place",
      next);
}

std::vector<plan::NextMeasurement> planned_measurements(const DeclaredMechanism& declared) {
  const plan::Plan plan = plan::plan_runs(declared);
  // A law without solution over the range has no motion.
  if (!(plan.slow > 0))
    return {plan::next_inspection(
        "several strokes both ways over the whole range, slowly, at no load and at two loads, and one run faster")};
  std::vector<plan::NextMeasurement> next;
  for (const plan::PlanStep& step : plan.steps) {
    next.push_back(step.run ? plan::next_run(*step.run, plan.slow, plan.load_unit)
                            : plan::next_reading({step.reading}));
    next.back().separates = step.detects;
  }
  return next;
}

std::vector<plan::NextMeasurement> next_measurements(const Evidence& evidence, const Selection& selection,
                                                     const Calibration& calibration) {
  const std::vector<Alternative> others = alternatives(selection, calibration.effects);
  std::vector<plan::NextMeasurement> next;
  if (!others.empty()) next = Proposals(evidence, selection, others).best();
  // No simulated measurement distinguishes them: the effects' own proposals.
  if (next.empty()) {
    for (const Rival* rival : equally_likely_rivals(selection)) ask(rival->rival->separating_run, next);
  }
  for (const FoundEffect& effect : calibration.effects) {
    if (effect.group.back() == k_unmodelled) ask(effect.unmodelled.separating_run, next);
  }
  if (calibration.verdict == CalibrationVerdict::not_repeatable) {
    next.insert(next.begin(), plan::next_inspection(
                                  "tighten what can be loose and repeat one run five times without touching anything"));
  } else if (calibration.verdict == CalibrationVerdict::unexplained) {
    ask("turn the pulley on its shaft by a quarter turn and repeat the slow unloaded run: an error that moves with it "
        "is the pulley's",
        next);
  }
  return next;
}

}  // namespace fusee::calibration
