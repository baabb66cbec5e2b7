#include "fusee/plan.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.h"
#include "plan/false_positives.h"
#include "plan/separation.h"
#include "plan/thresholds.h"

// Greedy selection. The number of resolved pairs is submodular in the set of measurements, so repeatedly adding the
// step of largest gain per minute is near-optimal (Nemhauser, Wolsey and Fisher 1978; with costs, Sviridenko 2004).
// Steps that later ones made redundant are removed at the end.

namespace fusee::plan {
namespace {

/// A candidate measurement and its information.
struct Candidate {
  PlanStep step;
  std::optional<Signatures::RunEquations> run_equations;  ///< empty for a hand measurement
  Eigen::MatrixXd reading_equations;                      ///< of a hand measurement

  Information added_to(const Information& known) const {
    return run_equations ? known.with(*run_equations) : known.with(reading_equations);
  }
};

/// Margins at the size worth identifying, one row per cause: first against no cause, then against each cause.
using Margins = std::vector<std::vector<double>>;

/// Plans for the causes that the set of all candidate measurements detects.
class Planner {
 public:
  Planner(const DeclaredMechanism& declared, const PlanOptions& options, const RunContext& context)
      : options_(options),
        context_(context),
        bench_(bench_of(declared, options)),
        taut_load_(taut_load_of(declared, bench_)),
        signatures_(declared, bench_, options.noise) {
    load_unit_ = declared.transmission ? "" : "N";
    for (const PlannedRun& run : candidate_runs(bench_)) add(run);
    for (const fusee::EffectParameter* reading : unread_numbers(declared)) add(*reading);
    start_ = Information::none(signatures_.columns());
    add_known_readings(declared);
    keep_detectable();
  }

  Plan plan() const {
    Plan plan;
    plan.slow = bench_.speeds.front();
    plan.from = bench_.from;
    plan.to = bench_.to;
    plan.load_unit = load_unit_;
    plan.taut_load = taut_load_;
    plan.left_out = left_out_;
    std::vector<std::size_t> chosen = choose(options_.minutes, {});
    chosen = without_redundant(chosen);
    constexpr double k_unlimited = 1e9;  // minutes
    const std::vector<std::size_t> all = choose(k_unlimited, chosen);
    Information known = start_;
    append_steps(chosen, known, 0, plan.steps);
    plan.minutes = plan.steps.empty() ? 0.0 : plan.steps.back().end_minute;
    add_causes(known, plan);
    const std::vector<std::size_t> further(all.begin() + static_cast<std::ptrdiff_t>(chosen.size()), all.end());
    append_steps(further, known, plan.minutes, plan.beyond);
    return plan;
  }

 private:
  void report(const std::string& step) const { context_.begin_step("simulating: " + step); }

  void add(const PlannedRun& run) {
    report(words(run, bench_.speeds.front(), load_unit_));
    const auto equations = signatures_.of(run);
    if (!equations) return;
    Candidate candidate;
    candidate.step.run = run;
    candidate.step.words = words(run, bench_.speeds.front(), load_unit_);
    candidate.step.setup_minutes = setup_minutes_of(run);
    candidate.step.minutes = minutes_of(run) + candidate.step.setup_minutes;
    candidate.run_equations = equations;
    candidates_.push_back(std::move(candidate));
  }

  void add(const fusee::EffectParameter& reading) {
    Candidate candidate;
    candidate.step.reading = &reading;
    candidate.step.words = reading_words(reading);
    candidate.step.minutes = candidate.step.setup_minutes = k_bench_minutes.reading;
    candidate.reading_equations = signatures_.of(reading);
    candidates_.push_back(std::move(candidate));
  }

  /// Adds the information of the values in [prior].
  void add_known_readings(const DeclaredMechanism& declared) {
    for (const Cause& cause : signatures_.causes()) {
      for (const fusee::EffectParameter* number : cause.numbers) {
        if (number->by_hand.readings == nullptr) continue;
        for (const ManualReading& reading : number->by_hand.readings(declared)) {
          fusee::EffectParameter read = *number;
          read.by_hand.uncertainty = reading.uncertainty;
          start_ = start_.with(signatures_.of(read));
        }
      }
    }
  }

  Information everything() const {
    Information known = start_;
    for (const Candidate& candidate : candidates_) known = candidate.added_to(known);
    return known;
  }

  /// Keeps the causes that all candidates together detect.
  void keep_detectable() {
    left_out_ = signatures_.left_out();
    const Information all = everything();
    for (const Cause& cause : signatures_.causes()) {
      const double size = usual_rms(all, cause) * options_.noise;
      if (margin(signatures_, all, cause, nullptr) >= 1) {
        causes_.push_back(cause);
      } else {
        left_out_.emplace_back(cause.effect->name,
                               "too small to matter here: at its usual size it moves the joint by " +
                                   rounded(degrees(size), 2) + " deg rms");
      }
    }
  }

  Margins margins_of(const Information& known) const {
    Margins margins;
    for (const Cause& cause : causes_) {
      std::vector<double>& row = margins.emplace_back();
      row.push_back(k_plan.least_share * margin(signatures_, known, cause, nullptr));
      for (const Cause& rival : causes_) {
        const bool is_itself = &rival == &cause;
        row.push_back(
            is_itself ? 1.0 : std::min(row.front(), k_plan.least_share * margin(signatures_, known, cause, &rival)));
      }
    }
    return margins;
  }

  /// Share of all separations that is reached, 0 … 1, as the mean over the causes. Half of a cause's share is the mean
  /// over its detection and its rivals; half is the separation from its nearest rival.
  double separation(const Information& known) const {
    double sum = 0;
    for (const std::vector<double>& row : margins_of(known)) {
      double reached = 0;
      for (const double margin_of_pair : row) reached += std::min(1.0, margin_of_pair);
      const double nearest = *std::min_element(row.begin(), row.end());
      sum += 0.5 * reached / static_cast<double>(row.size()) + 0.5 * std::min(1.0, nearest);
    }
    return causes_.empty() ? 1.0 : sum / static_cast<double>(causes_.size());
  }

  /// Adds the step of largest gain per minute to `chosen`, and repeats this until no step that fits into the minutes
  /// reaches the least gain.
  std::vector<std::size_t> choose(double minutes, std::vector<std::size_t> chosen) const {
    Information known = start_;
    double used = 0;
    for (const std::size_t i : chosen) {
      known = candidates_[i].added_to(known);
      used += candidates_[i].step.minutes;
    }
    // The slow run comes first: its repeats measure the noise floor.
    if (chosen.empty() && !candidates_.empty() && candidates_.front().step.run) {
      if (candidates_.front().step.minutes > minutes) return {};
      chosen = {0};
      known = candidates_.front().added_to(known);
      used = candidates_.front().step.minutes;
    }
    double before = separation(known);
    while (true) {
      double best = 0;  // largest gain per minute
      std::size_t next = candidates_.size();
      double after = before;
      for (std::size_t i = 0; i < candidates_.size(); ++i) {
        const Candidate& candidate = candidates_[i];
        if (std::find(chosen.begin(), chosen.end(), i) != chosen.end()) continue;
        if (used + candidate.step.minutes > minutes) continue;
        const double gained = separation(candidate.added_to(known)) - before;
        if (gained < k_plan.least_gain || gained / candidate.step.minutes <= best) continue;
        best = gained / candidate.step.minutes;
        next = i;
        after = before + gained;
      }
      if (next == candidates_.size()) return chosen;
      chosen.push_back(next);
      known = candidates_[next].added_to(known);
      used += candidates_[next].step.minutes;
      before = after;
    }
  }

  /// Removes steps, the last one first, without which the others reach the same separation up to the least gain. The
  /// first step, the slow run, stays.
  std::vector<std::size_t> without_redundant(std::vector<std::size_t> chosen) const {
    const auto separation_by = [&](const std::vector<std::size_t>& set) {
      Information known = start_;
      for (const std::size_t i : set) known = candidates_[i].added_to(known);
      return separation(known);
    };
    for (std::size_t k = chosen.size(); k-- > 1;) {
      std::vector<std::size_t> fewer = chosen;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
      if (separation_by(fewer) > separation_by(chosen) - k_plan.least_gain) chosen = fewer;
    }
    return chosen;
  }

  /// Lists the separations, cause by cause, that `after` reaches and `before` does not.
  void list_gain(const Margins& before, const Margins& after, PlanStep& step) const {
    constexpr std::size_t k_most_names = 4;
    for (std::size_t a = 0; a < causes_.size(); ++a) {
      const std::string& name = causes_[a].effect->name;
      const auto is_new = [&](std::size_t i) { return before[a][i] < 1 && after[a][i] >= 1; };
      if (is_new(0)) step.detects.push_back(name);
      std::vector<std::string> rivals;
      for (std::size_t b = 0; b < causes_.size(); ++b) {
        if (b != a && is_new(b + 1)) rivals.push_back(causes_[b].effect->name);
      }
      if (rivals.empty()) continue;
      std::string from;
      for (std::size_t i = 0; i < rivals.size() && rivals.size() <= k_most_names; ++i)
        from += (i > 0 ? ", " : "") + rivals[i];
      step.resolves.push_back(name + " from " + (from.empty() ? std::to_string(rivals.size()) + " others" : from));
    }
  }

  /// For each cause the indices of the causes that it is not resolved from.
  std::vector<std::set<std::size_t>> rivals_in(const Information& known) const {
    std::vector<std::set<std::size_t>> rivals(causes_.size());
    for (std::size_t a = 0; a < causes_.size(); ++a) {
      for (std::size_t b = 0; b < causes_.size(); ++b) {
        if (a != b && margin(signatures_, known, causes_[a], &causes_[b]) < 1) rivals[a].insert(b);
      }
    }
    return rivals;
  }

  void append_steps(const std::vector<std::size_t>& chosen, Information& known, double minutes,
                    std::vector<PlanStep>& into) const {
    Margins before = margins_of(known);
    for (const std::size_t i : chosen) {
      known = candidates_[i].added_to(known);
      const Margins after = margins_of(known);
      PlanStep step = candidates_[i].step;
      minutes += step.minutes;
      step.end_minute = minutes;
      list_gain(before, after, step);
      into.push_back(std::move(step));
      before = after;
    }
  }

  PlannedCause planned_cause(const Information& known, const Cause& cause) const {
    PlannedCause planned;
    planned.name = cause.effect->name;
    planned.usual = usual_rms(known, cause) * options_.noise;
    const double detection = margin(signatures_, known, cause, nullptr);
    planned.smallest = planned.usual / std::max(detection, 1e-9);
    double least = detection;
    for (const Cause& rival : causes_) {
      if (&rival == &cause) continue;
      const double from_rival = margin(signatures_, known, cause, &rival);
      least = std::min(least, from_rival);
      if (detection >= 1 && from_rival < 1) planned.rivals.push_back(rival.effect->name);
    }
    if (least >= 1) planned.smallest_alone = planned.usual / least;
    const fusee::EffectParameter& number = *cause.numbers.front();
    const double size = usual_size(number, bench_.largest_load()) / std::max(detection, 1e-9);
    planned.key = number.key.name;
    planned.smallest_key = number.key.to_file != nullptr ? number.key.to_file(size) : size;
    return planned;
  }

  /// Groups of a cause and its unresolved rivals; a group that is contained in another is omitted.
  static std::vector<std::vector<std::string>> groups_of(const std::vector<PlannedCause>& causes) {
    std::vector<std::set<std::string>> all;
    for (const PlannedCause& cause : causes) {
      std::set<std::string> group(cause.rivals.begin(), cause.rivals.end());
      if (!group.insert(cause.name).second || group.size() < 2) continue;
      all.push_back(std::move(group));
    }
    const auto contains = [](const std::set<std::string>& whole, const std::set<std::string>& part) {
      return std::includes(whole.begin(), whole.end(), part.begin(), part.end());
    };
    std::vector<std::vector<std::string>> groups;
    for (std::size_t i = 0; i < all.size(); ++i) {
      bool is_needed = true;
      for (std::size_t j = 0; j < all.size() && is_needed; ++j) {
        const bool is_first_of_equals = all[j] == all[i] && i < j;
        is_needed = i == j || !contains(all[j], all[i]) || is_first_of_equals;
      }
      if (is_needed) groups.emplace_back(all[i].begin(), all[i].end());
    }
    return groups;
  }

  void add_causes(const Information& known, Plan& plan) const {
    if (plan.steps.empty()) return;
    for (const Cause& cause : causes_) plan.causes.push_back(planned_cause(known, cause));
    plan.groups = groups_of(plan.causes);
    report("estimating the false-positive rate");
    const FalsePositiveRates rates = false_positive_rates(signatures_, known, causes_, rivals_in(known), options_.seed);
    plan.nothing = rates.nothing;
    plan.one = rates.one;
    plan.unmodelled = rates.unmodelled;
  }

  const PlanOptions& options_;
  const RunContext& context_;
  Bench bench_;
  std::optional<double> taut_load_;
  Signatures signatures_;
  std::string load_unit_;
  std::vector<Candidate> candidates_;
  Information start_;          ///< information before the first step: that of the values in [prior]
  std::vector<Cause> causes_;  ///< those that the plan considers
  std::vector<std::pair<std::string, std::string>> left_out_;
};

}  // namespace

std::string Plan::slack_words() const {
  if (!taut_load) return "";
  const std::string when = *taut_load > 0 ? "at loads beyond " + rounded(*taut_load, 2) + " N" : "even without load";
  return "a tendon slackens " + when +
         ": such runs also show its slack. A larger tendon.pretension_N keeps both taut, and --loads of fusee plan "
         "chooses other loads";
}

Plan plan_runs(const DeclaredMechanism& declared, const PlanOptions& options, const RunContext& context) {
  return Planner(declared, options, context).plan();
}

}  // namespace fusee::plan
