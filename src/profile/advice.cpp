#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "base/text.h"
#include "base/thread_pool.h"
#include "fusee/mechanism_file.h"
#include "fusee/profile.h"
#include "mechanism/lengths.h"

namespace fusee::profile {
namespace {

/// A variable of the search: a number of the file, or both ends of a range together.
struct DesignVariable {
  std::string key;
  std::string symbol;
  std::string unit;
  double value = 0;
  double least = 0;
  double most = 0;
  /// Change at a step of 100 %: the value's magnitude, or a length of the joint for numbers near zero.
  double scale = 1;
  std::function<void(Mechanism&, double)> set;
  LengthUnit units = LengthUnit::mm;  ///< of the file, for a length: its new number has few digits in them
};

/// Numbers of the pulley or its body are easier to change than those of the joint, and change by this multiple of their
/// magnitude in a step of 100 %.
constexpr double k_easier = 3.0;

std::optional<DesignVariable> number_variable(const Mechanism& mechanism, const std::string& key) {
  const Field* field = find_field(key);
  if (field == nullptr || field->kind != FieldKind::number) return std::nullopt;
  DesignVariable variable;
  variable.key = key;
  variable.symbol = field->symbol.empty() ? key : std::string(field->symbol);
  variable.unit = field->unit;
  variable.value = number_of(mechanism, *field);
  variable.least = field->least;
  variable.most = field->most;
  // A coordinate may be zero, and then has no magnitude of its own.
  const bool is_coordinate = field->unit == "mm" && field->least < 0;
  variable.scale = std::max(std::abs(variable.value), is_coordinate ? 0.1 * mechanism.joint.R : 0.0);
  variable.set = [field](Mechanism& changed, double value) { set_number(changed, *field, 0, value); };
  if (is_length(key)) variable.units = mechanism.units;
  return variable;
}

/// Both coordinates of the attachments that the file contains.
std::vector<DesignVariable> attachment_variables(const Mechanism& mechanism) {
  std::vector<DesignVariable> all;
  for (const char* key : {"joint.attachment1_mm", "joint.attachment2_mm"}) {
    const Field* field = find_field(key);
    if (!field->is_set(DeclaredMechanism{mechanism})) continue;
    for (const int coordinate : {0, 1}) {
      const std::string name = std::string(key) + (coordinate == 0 ? "[0]" : "[1]");
      const double value = number_of(mechanism, *field, coordinate);
      const auto set = [field, coordinate](Mechanism& changed, double to) {
        set_number(changed, *field, coordinate, to);
      };
      all.push_back({name, name, "mm", value, field->least, field->most,
                     std::max(std::abs(value), 0.1 * mechanism.joint.R), set, mechanism.units});
    }
  }
  return all;
}

/// Smallest half of a symmetric range that is proposed. deg
constexpr double k_least_half_range = 0.5;
/// Difference of its ends up to which a range is symmetric. deg
constexpr double k_symmetric = 1e-9;

/// One variable for a symmetric range, otherwise one per end.
std::vector<DesignVariable> range_variables(const Mechanism& mechanism) {
  const Field* field = find_field("joint.range_deg");
  if (field == nullptr) return {};
  const double low = number_of(mechanism, *field);
  const double high = number_of(mechanism, *field, 1);
  double least = field->least, most = field->most;
  if (mechanism.pulley.law == Law::table && !mechanism.pulley.rows.empty()) {
    // A table defines no law beyond its rows.
    least = std::max(least, degrees(mechanism.pulley.rows.front().theta));
    most = std::min(most, degrees(mechanism.pulley.rows.back().theta));
  }
  if (mechanism.pulley.law == Law::torque && !mechanism.pulley.torque_rows.empty()) {
    least = std::max(least, degrees(mechanism.pulley.torque_rows.front().theta));
    most = std::min(most, degrees(mechanism.pulley.torque_rows.back().theta));
  }
  DesignVariable half_range{"joint.range_deg",      "the range", "deg", high, k_least_half_range,
                            std::min(most, -least), high,        {},    {}};
  half_range.set = [field](Mechanism& changed, double value) {
    set_number(changed, *field, 0, -value);
    set_number(changed, *field, 1, value);
  };
  if (std::abs(low + high) < k_symmetric) return {half_range};
  DesignVariable lower{"joint.range_deg[0]", "the range's lower end", "deg", low, least, 0.0, std::abs(low), {}, {}};
  lower.set = [field](Mechanism& changed, double value) { set_number(changed, *field, 0, value); };
  DesignVariable upper{"joint.range_deg[1]", "the range's upper end", "deg", high, 0.0, most, std::abs(high), {}, {}};
  upper.set = [field](Mechanism& changed, double value) { set_number(changed, *field, 1, value); };
  return {lower, upper};
}

/// The number that defines the pulley's law; null for a table, and for torque rows.
std::optional<DesignVariable> law_variable(const Mechanism& mechanism) {
  if (mechanism.pulley.law == Law::compensate) return number_variable(mechanism, "pulley.r1_mm");
  if (mechanism.pulley.law == Law::linear) return number_variable(mechanism, "pulley.ratio");
  if (mechanism.pulley.motor_torque != 0) return number_variable(mechanism, "pulley.motor_torque_Nmm");
  return std::nullopt;
}

/// All variables of the search. find_advice() has their list.
std::vector<DesignVariable> design_variables(const Mechanism& mechanism, const std::vector<std::string>& more_keys) {
  const std::vector<std::string> keys{"joint.length_mm",  "guides.EB_mm", "guides.ED_mm",      "guides.OE_mm",
                                      "guides.radius_mm", "pulley.EF_mm", "tendon.diameter_mm"};
  std::vector<DesignVariable> all;
  if (const auto of_law = law_variable(mechanism)) {
    all.push_back(*of_law);
    all.back().scale *= k_easier;
  }
  for (const std::string& key : keys) {
    if (const auto variable = number_variable(mechanism, key)) all.push_back(*variable);
  }
  for (const std::string& key : more_keys) {
    auto variable = number_variable(mechanism, key);
    if (!variable) continue;
    // 0 means "automatic" for these keys.
    variable->least = std::max(variable->least, 1e-3 * variable->value);
    variable->scale *= k_easier;
    all.push_back(*variable);
  }
  if (mechanism.sheath.is_there()) {
    // With a sheath, the tendons depend on the sheath exits and not on the pulley's position.
    std::erase_if(all, [](const DesignVariable& variable) { return variable.key == "pulley.EF_mm"; });
    for (const char* key : {"sheath.exit_across_mm", "sheath.exit_above_mm"})
      all.push_back(*number_variable(mechanism, key));
  }
  if (mechanism.joint.drum_radius > 0) all.push_back(*number_variable(mechanism, "joint.drum_radius_mm"));
  for (const DesignVariable& variable : attachment_variables(mechanism)) all.push_back(variable);
  for (const DesignVariable& variable : range_variables(mechanism)) all.push_back(variable);
  return all;
}

/// "12.3 mm" in the file's unit.
std::string value_text(const DesignVariable& variable, double value) {
  const std::string word = variable.units == LengthUnit::mm ? variable.unit : std::string(unit_word(variable.units));
  const std::string word_after_number = word.empty() ? "" : " " + word;
  const std::string unit = word == "deg" ? "°" : word_after_number;
  return rounded(from_mm(value, variable.units), 3) + unit;
}

std::string change_text(const DesignVariable& variable, double to) {
  if (variable.symbol == "the range") return "the range ±" + rounded(to, 3) + "°";
  return variable.symbol + (to > variable.value ? " ≥ " : " ≤ ") + value_text(variable, to);
}

std::string interval_text(const DesignVariable& variable, double least, double most) {
  if (least == most) return variable.symbol + " = " + value_text(variable, least);
  return value_text(variable, least) + " ≤ " + variable.symbol + " ≤ " + value_text(variable, most);
}

/// A number rounded to three digits in the file's unit: [0] to the nearest, [1] towards `direction`.
std::array<double, 2> in_three_digits(double value_in_key_unit, double direction, LengthUnit units) {
  if (value_in_key_unit == 0) return {0, 0};
  const double value = from_mm(value_in_key_unit, units);
  const double unit = elementary::pow(10.0, std::floor(elementary::log10(std::abs(value))) - 2.0);
  const double scaled = value / unit;
  // Rounded via the text, so that the tested number is the one that the user writes.
  const auto written = [units](double number) { return to_mm(number_of(rounded(number, 3)), units); };
  return {written(std::round(scaled) * unit), written((direction > 0 ? std::ceil(scaled) : std::floor(scaled)) * unit)};
}

/// A variable and the direction of its change.
struct SearchDirection {
  const DesignVariable* variable;
  double direction;

  /// Decreases of a nonnegative number divide it: a step of 100 % halves it, so that it stays positive.
  double at(double step) const {
    const double by = step * variable->scale;
    const bool divided = direction < 0 && variable->least >= 0 && variable->value > 0;
    const double to = divided ? variable->value / (1.0 + by / variable->value) : variable->value + direction * by;
    return std::clamp(to, variable->least, variable->most);
  }
  /// True when a further step changes nothing, because the bound is reached.
  bool ends_before(double step, double before) const { return at(step) == at(before); }
};

// Steps are multiples of DesignVariable::scale. The first search begins at 2 % and ends below 400 %: a number of five
// times its magnitude would describe another joint.
constexpr double k_first_step = 0.02;
constexpr double k_step_ratio = 2.4;
constexpr double k_last_step = 4.0;
// A search over the whole range of a number has smaller steps, up to its bounds. It follows if no near value suffices,
// and precedes for a number that was just typed.
constexpr double k_sweep_ratio = 1.3;
// Bisection ends when the border is known to this step: three digits of the number.
constexpr double k_border_width = 5e-4;
// The end of the values that suffice is searched in these steps of the value, up to a quarter of it.
constexpr double k_limit_step = 0.05;
constexpr int k_limit_steps = 5;
// Number of changes that suffices: with the fast test only, and with full builds.
constexpr std::size_t k_sufficient = 3;
constexpr std::size_t k_sufficient_builds = 2;
// Upper bounds on full builds and fast tests.
constexpr int k_max_builds = 4;
constexpr int k_max_evaluations = 400;
// A search over whole ranges may evaluate more: most of its values fail at the first condition, which is cheap.
constexpr int k_max_sweep_evaluations = 5000;
// Evaluations that are reserved for changes in pairs.
constexpr int k_pair_evaluations = 150;
// Evaluations of the drum of a torque law, after other numbers.
constexpr int k_drum_evaluations = 80;
// Number of the most helpful changes that are combined in pairs.
constexpr std::size_t k_helpful = 4;

/// Search for one mechanism.
class AdviceSearch {
 public:
  AdviceSearch(const Mechanism& mechanism, const FeasibilityOracle& oracle, const std::vector<std::string>& more_keys,
               std::size_t sufficient)
      : mechanism_(mechanism),
        oracle_(oracle),
        variables_(design_variables(mechanism, more_keys)),
        sufficient_(sufficient) {
    for (const DesignVariable& variable : variables_) {
      if (!(variable.scale > 0)) continue;
      for (const double direction : {-1.0, 1.0}) directions_.push_back({&variable, direction});
    }
    records_.resize(directions_.size());
  }

  /// First the numbers that were just typed, over their whole range. Then all numbers within a few times their
  /// magnitude, so that the nearest changes are found first. If none suffices, all over their whole range.
  std::vector<Change> alone() {
    std::vector<Change> found;
    search(found, {k_sweep_ratio, HUGE_VAL, &oracle_.first});
    search(found, {k_step_ratio, k_last_step});
    if (found.empty()) {
      max_evaluations_ = oracle_.is_expensive ? k_max_evaluations - k_pair_evaluations : k_max_sweep_evaluations;
      search(found, {k_sweep_ratio, HUGE_VAL});
    }
    add_drum(found);
    for (Change& change : found) add_end(change);
    return found;
  }

  /// True if no number suffices, at any step up to its bounds.
  bool is_exhausted() const { return is_exhausted_; }

  /// Changes two of the most helpful variables by equal steps, when alone() found nothing.
  std::vector<Change> together() {
    max_evaluations_ = evaluations_ + k_pair_evaluations;
    std::vector<std::size_t> helpful(directions_.size());
    std::iota(helpful.begin(), helpful.end(), std::size_t{0});
    std::stable_sort(helpful.begin(), helpful.end(),
                     [this](std::size_t a, std::size_t b) { return records_[a].gain > records_[b].gain; });
    helpful.resize(std::min(helpful.size(), k_helpful));
    double before = 0;
    for (double step = 2 * k_first_step; step < k_last_step; before = step, step *= k_step_ratio) {
      const std::vector<std::vector<SearchDirection>> pairs = pairs_of(helpful);
      std::vector<Mechanism> changed;
      for (const std::vector<SearchDirection>& pair : pairs)
        changed.push_back(changed_mechanism(pair, values(pair, step)));
      const std::vector<std::vector<Condition>> obstacles = evaluate(changed);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (!obstacles[i].empty()) continue;
        const std::vector<Candidate> proven = built({Candidate{pairs[i], before, step, step, 0, {}}}, 1);
        if (!proven.empty()) return proven.front().changes();
        if (builds_left() == 0) return {};
      }
    }
    return {};
  }

 private:
  /// Beside sufficient changes of other numbers, adds one of the drum that makes a torque law feasible: both pulleys grow
  /// and shrink with it, and the part is often smaller than with a narrow range or another torque.
  void add_drum(std::vector<Change>& found) {
    static const std::vector<std::string> drum{"joint.drum_radius_mm"};
    const bool is_found =
        std::any_of(found.begin(), found.end(), [](const Change& change) { return change.key == drum.front(); });
    const bool has_drum = mechanism_.pulley.law == Law::torque && mechanism_.joint.drum_radius > 0;
    if (!has_drum || found.empty() || is_found) return;
    sufficient_ = found.size() + 1;
    max_evaluations_ = evaluations_ + k_drum_evaluations;
    search(found, {k_sweep_ratio, HUGE_VAL, &drum});
  }

  /// Sets the end of the values that suffice if it is near.
  void add_end(Change& change) const {
    const auto variable =
        std::find_if(variables_.begin(), variables_.end(),
                     [&change](const DesignVariable& candidate) { return candidate.key == change.key; });
    if (variable->symbol == "the range") return;  // the change names both ends
    change.until = last_sufficient(change, *variable);
    if (!change.until) return;
    const auto [least, most] = std::minmax({change.to, *change.until});
    change.text = interval_text(*variable, least, most);
  }

  /// The last value beyond a change that passes the fast test, if one within a quarter of it does not.
  std::optional<double> last_sufficient(const Change& change, const DesignVariable& variable) const {
    const double direction = change.to > change.from ? 1 : -1;
    const auto suffices = [&](double value) {
      Mechanism changed = mechanism_;
      variable.set(changed, value);
      return oracle_.obstacles(changed).empty();
    };
    const double step = k_limit_step * std::abs(change.to);
    double good = change.to;
    std::optional<double> bad;
    for (int k = 1; k <= k_limit_steps && !bad; ++k) {
      const double value = change.to + direction * k * step;
      if (value < variable.least || value > variable.most) return std::nullopt;
      if (suffices(value))
        good = value;
      else
        bad = value;
    }
    if (!bad) return std::nullopt;
    while (std::abs(*bad - good) > 0.1 * step) {
      const double middle = 0.5 * (good + *bad);
      if (suffices(middle))
        good = middle;
      else
        bad = middle;
    }
    const double written = in_three_digits(good, -direction, variable.units)[1];
    return direction * (written - change.to) > 0 && suffices(written) ? written : change.to;
  }

  /// A change of one or two variables by equal steps, whose border of feasibility is narrowed by bisection.
  struct Candidate {
    std::vector<SearchDirection> directions;
    double bad = 0;          ///< largest known infeasible step
    double good = 0;         ///< smallest known feasible step
    double far = 0;          ///< the feasible step at which the candidate was found
    int trials = 0;          ///< number of trials: first at the step `good`, then at `far`
    std::vector<double> to;  ///< the trial values, current or last

    double distance(double step) const {
      const SearchDirection& search = directions.front();
      return std::abs(search.at(step) - search.variable->value) / search.variable->scale;
    }
    bool is_at_border() const { return good - bad <= k_border_width; }
    std::vector<Change> changes() const {
      std::vector<Change> all;
      for (std::size_t i = 0; i < directions.size(); ++i) all.push_back(change(*directions[i].variable, to[i]));
      return all;
    }
  };
  /// Results for one variable and direction.
  struct SearchRecord {
    double step = 0;     ///< the last evaluated step
    double gain = 0;     ///< best reduction of the failed conditions
    int skips_left = 0;  ///< steps to skip before the next evaluation
    int skips = 0;       ///< steps skipped before the last evaluation
  };

  /// Growing steps of a search.
  struct Steps {
    double ratio;                                    ///< of a step to the one before
    double end;                                      ///< steps stay below it; infinite: to the bounds of all numbers
    const std::vector<std::string>* only = nullptr;  ///< only the numbers of these keys; null: all numbers
  };

  /// False for a variable that these steps leave out.
  bool is_searched(const SearchDirection& search, const Steps& steps) const {
    return steps.only == nullptr || std::any_of(steps.only->begin(), steps.only->end(), [&](const std::string& key) {
             return search.variable->key == key || search.variable->key.starts_with(key + "[");
           });
  }

  /// Advances all variables step by step. A variable with a change is finished.
  void search(std::vector<Change>& found, const Steps& steps) {
    for (SearchRecord& record : records_) record.step = 0;
    bool is_at_bounds = false;
    double step = k_first_step;
    for (; step < steps.end && !is_at_bounds && found.size() < sufficient_ && has_evaluations_left();
         step *= steps.ratio) {
      is_at_bounds = true;
      for (std::size_t t = 0; t < directions_.size(); ++t)
        is_at_bounds = is_at_bounds && (!is_searched(directions_[t], steps) || is_finished(t, step));
      const std::vector<std::size_t> due = due_at(step, steps);
      std::vector<Mechanism> changed;
      for (const std::size_t t : due) changed.push_back(changed_mechanism({directions_[t]}, {directions_[t].at(step)}));
      const std::vector<std::vector<Condition>> obstacles = evaluate(changed);
      std::vector<Candidate> here;
      for (std::size_t i = 0; i < due.size(); ++i) {
        SearchRecord& record = records_[due[i]];
        const double before = std::exchange(record.step, step);
        const SearchDirection& search = directions_[due[i]];
        if (!obstacles[i].empty()) {
          record_effect(record, obstacles[i]);
        } else if (!is_done(search)) {
          // Each confirmation is a full build, so a variable is confirmed only once.
          done_.push_back(search.variable);
          here.push_back(Candidate{{search}, before, step, step, 0, {}});
        }
      }
      sort_by_border(here, sufficient_ - found.size());
      for (const Candidate& proven : built(here, sufficient_ - found.size())) found.push_back(proven.changes().front());
    }
    is_exhausted_ = std::isinf(steps.end) && is_at_bounds && done_.empty();
  }

  bool is_done(const SearchDirection& search) const {
    return std::count(done_.begin(), done_.end(), search.variable) != 0;
  }
  bool is_finished(std::size_t t, double step) const {
    return is_done(directions_[t]) || directions_[t].ends_before(step, records_[t].step);
  }

  bool has_evaluations_left() const { return evaluations_ < max_evaluations_; }

  /// Pairs of these changes with different variables, limited by the remaining evaluations.
  std::vector<std::vector<SearchDirection>> pairs_of(const std::vector<std::size_t>& directions) const {
    std::vector<std::vector<SearchDirection>> pairs;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      for (std::size_t j = i + 1; j < directions.size(); ++j) {
        const SearchDirection &one = directions_[directions[i]], &other = directions_[directions[j]];
        if (one.variable != other.variable) pairs.push_back({one, other});
      }
    }
    pairs.resize(std::min(pairs.size(), static_cast<std::size_t>(std::max(0, max_evaluations_ - evaluations_))));
    return pairs;
  }
  /// Evaluations are independent. Two of them run at a time if the oracle has full builds, otherwise one.
  std::vector<std::vector<Condition>> evaluate(const std::vector<Mechanism>& changed) {
    std::vector<std::vector<Condition>> obstacles(changed.size());
    evaluations_ += static_cast<int>(changed.size());
    ThreadPool::shared().each(
        changed.size(), [&](std::size_t i, std::size_t) { obstacles[i] = oracle_.obstacles(changed[i]); },
        oracle_.made ? 2 : 1);
    return obstacles;
  }

  static std::vector<double> values(const std::vector<SearchDirection>& directions, double step) {
    std::vector<double> all;
    for (const SearchDirection& search : directions) all.push_back(search.at(step));
    return all;
  }
  Mechanism changed_mechanism(const std::vector<SearchDirection>& directions, const std::vector<double>& to) const {
    Mechanism changed = mechanism_;
    for (std::size_t i = 0; i < directions.size(); ++i) directions[i].variable->set(changed, to[i]);
    return changed;
  }

  /// The changes to evaluate at `step`.
  std::vector<std::size_t> due_at(double step, const Steps& steps) {
    std::vector<std::size_t> due;
    for (std::size_t t = 0; t < directions_.size(); ++t) {
      if (!is_searched(directions_[t], steps) || is_finished(t, step)) continue;
      if (records_[t].skips_left > 0) {
        --records_[t].skips_left;
      } else {
        due.push_back(t);
      }
    }
    due.resize(std::min(due.size(), static_cast<std::size_t>(max_evaluations_ - evaluations_)));
    return due;
  }

  /// Records the effect of a change that is not sufficient. With an expensive test, a change without effect is
  /// evaluated at growing intervals.
  void record_effect(SearchRecord& record, const std::vector<Condition>& obstacles) {
    if (unchanged_.empty()) unchanged_ = oracle_.obstacles(mechanism_);
    record.gain = std::max(record.gain, weight(unchanged_) - weight(obstacles));
    if (!oracle_.is_expensive) return;
    std::vector<Condition> remaining = obstacles;
    std::erase_if(remaining, [this](const Condition& condition) {
      return std::none_of(unchanged_.begin(), unchanged_.end(),
                          [&condition](const Condition& before) { return before.name == condition.name; });
    });
    record.skips = weight(remaining) < weight(unchanged_) ? 0 : record.skips + 1;
    record.skips_left = record.skips;
  }
  /// Sum over failed conditions of 1 plus the violation relative to the limit, which counts at most 1.
  static double weight(const std::vector<Condition>& obstacles) {
    double sum = 0;
    for (const Condition& condition : obstacles) {
      const double gap = std::abs(condition.value - condition.limit);
      sum += 1.0 + (std::isfinite(gap) ? gap / (gap + std::abs(condition.limit) + 1.0) : 1.0);
    }
    return sum;
  }

  /// Bisects each candidate once towards its border.
  void halve(const std::vector<Candidate*>& candidates) {
    std::vector<Mechanism> middles;
    for (const Candidate* candidate : candidates)
      middles.push_back(changed_mechanism(candidate->directions,
                                          values(candidate->directions, 0.5 * (candidate->bad + candidate->good))));
    const std::vector<std::vector<Condition>> obstacles = evaluate(middles);
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      Candidate& candidate = *candidates[i];
      (obstacles[i].empty() ? candidate.good : candidate.bad) = 0.5 * (candidate.bad + candidate.good);
    }
  }

  /// Sorts the candidates by their borders, as far as the first `wanted` require: others are narrowed only while they
  /// may be among these.
  void sort_by_border(std::vector<Candidate>& candidates, std::size_t wanted) {
    while (!candidates.empty()) {
      std::stable_sort(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.distance(a.good) < b.distance(b.good); });
      const Candidate& last = candidates[std::min(candidates.size(), wanted) - 1];
      std::vector<Candidate*> open;
      for (Candidate& candidate : candidates) {
        if (!candidate.is_at_border() && candidate.distance(candidate.bad) <= last.distance(last.good))
          open.push_back(&candidate);
      }
      if (open.empty() || !has_evaluations_left()) return;
      halve(open);
    }
  }

  /// Chooses the next trial values, rounded to three digits on the safe side; false when there are none.
  bool next_trial(Candidate& candidate) {
    while (!candidate.is_at_border() && has_evaluations_left()) halve({&candidate});
    while (candidate.trials < 2) {
      const double step = candidate.trials++ == 0 ? candidate.good : candidate.far;
      for (const std::size_t rounding : {std::size_t{0}, std::size_t{1}}) {
        std::vector<double> to;
        bool is_new = true;
        for (const SearchDirection& search : candidate.directions) {
          to.push_back(in_three_digits(search.at(step), search.direction, search.variable->units)[rounding]);
          is_new = is_new && to.back() != search.variable->value && to.back() >= search.variable->least &&
                   to.back() <= search.variable->most;
        }
        if (!is_new || !oracle_.obstacles(changed_mechanism(candidate.directions, to)).empty()) continue;
        if (to == candidate.to) break;  // the other rounding differs too little to justify a full build
        candidate.to = to;
        return true;
      }
    }
    return false;
  }

  /// The first `wanted` candidates that pass a full build. Two builds run at a time; the selection does not depend on
  /// their durations.
  std::vector<Candidate> built(std::vector<Candidate> candidates, std::size_t wanted) {
    std::vector<Candidate> proven;
    while (proven.size() < wanted && builds_left() > 0) {
      const std::size_t at_once = std::min({wanted - proven.size(), builds_left(), std::size_t{2}});
      std::vector<Candidate> tried, later;
      for (Candidate& candidate : candidates) {
        const bool is_full = tried.size() == at_once;
        if (is_full)
          later.push_back(std::move(candidate));
        else if (next_trial(candidate))
          tried.push_back(std::move(candidate));
      }
      if (tried.empty()) break;
      const std::vector<bool> made = make(tried);
      candidates.clear();
      for (std::size_t i = 0; i < tried.size(); ++i) (made[i] ? proven : candidates).push_back(std::move(tried[i]));
      candidates.insert(candidates.end(), later.begin(), later.end());
    }
    return proven;
  }

  std::size_t builds_left() const {
    if (!oracle_.made) return k_sufficient;
    const int remaining = k_max_builds - builds_;
    return static_cast<std::size_t>(
        std::max(0, oracle_.builds_left ? std::min(remaining, oracle_.builds_left()) : remaining));
  }

  /// Full builds; true for the candidates that pass.
  std::vector<bool> make(const std::vector<Candidate>& candidates) {
    if (!oracle_.made) return std::vector<bool>(candidates.size(), true);
    builds_ += static_cast<int>(candidates.size());
    std::vector<char> made(candidates.size());  // vector<bool> packs neighbours into one byte: a race of both threads
    ThreadPool::shared().each(candidates.size(), [&](std::size_t i, std::size_t) {
      made[i] = oracle_.made(changed_mechanism(candidates[i].directions, candidates[i].to)) ? 1 : 0;
    });
    return {made.begin(), made.end()};
  }

  static Change change(const DesignVariable& variable, double to) {
    return {variable.key, variable.value, to, variable.unit, change_text(variable, to)};
  }

  const Mechanism& mechanism_;
  const FeasibilityOracle& oracle_;
  std::vector<DesignVariable> variables_;
  std::vector<SearchDirection> directions_;
  std::vector<SearchRecord> records_;        ///< one per direction
  std::vector<Condition> unchanged_;         ///< failed conditions of the mechanism without a change
  std::vector<const DesignVariable*> done_;  ///< with a change that was found or failed to build
  std::size_t sufficient_;
  int max_evaluations_ = k_max_evaluations;
  bool is_exhausted_ = false;
  int evaluations_ = 0;
  int builds_ = 0;
};

}  // namespace

std::vector<Change> nearest_changes(const Mechanism& mechanism, const std::function<bool(const Mechanism&)>& possible,
                                    const std::vector<std::string>& more_keys) {
  // A default condition stands for the reason of infeasibility, which is not known.
  const FeasibilityOracle oracle{[&possible](const Mechanism& changed) {
    return possible(changed) ? std::vector<Condition>{} : std::vector<Condition>(1);
  }};
  return AdviceSearch(mechanism, oracle, more_keys, k_sufficient).alone();
}

Advice find_advice(const Mechanism& mechanism, const FeasibilityOracle& oracle,
                   const std::vector<std::string>& more_keys, std::size_t known) {
  const std::size_t sufficient = oracle.made ? k_sufficient_builds : k_sufficient;
  if (known >= sufficient) return {};
  AdviceSearch search(mechanism, oracle, more_keys, sufficient - known);
  Advice advice;
  advice.alone = search.alone();
  advice.is_exhausted = search.is_exhausted();
  if (advice.alone.empty()) advice.together = search.together();
  return advice;
}

std::string setting_words(const Change& change) {
  if (!change.to_word.empty()) return change.text + " (now \"" + change.from_word + "\")";
  if (change.key == "joint.range_deg") {
    const auto around_home = [](double end) { return "[" + rounded(-end) + ", " + rounded(end) + "]"; };
    return change.key + " = " + around_home(change.to) + " (now " + around_home(change.from) + ")";
  }
  // Enough digits for the number that was tried, in mm or inches.
  constexpr int k_digits = 10;
  const std::string now = " (now " + rounded(change.from, k_digits) + ")";
  const auto [least, most] = std::minmax({change.to, change.until.value_or(change.to)});
  if (least != most)
    return change.key + " = " + rounded(least, k_digits) + " to " + rounded(most, k_digits) + now + change.cost;
  const std::string direction = change.to > change.from ? " or more" : " or less";
  const std::string end = change.until ? "" : direction;
  return change.key + " = " + rounded(change.to, k_digits) + end + now + change.cost;
}

std::string advice_sentence(const std::vector<Change>& changes) {
  std::string sentence;
  for (const Change& change : changes) sentence += (sentence.empty() ? "make " : ", or ") + change.text;
  return sentence;
}

}  // namespace fusee::profile
