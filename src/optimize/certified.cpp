#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include "base/text.h"
#include "base/thread_pool.h"
#include "fusee/base.h"
#include "fusee/optimize.h"
#include "optimize/bound.h"
#include "optimize/random.h"
#include "optimize/search_progress.h"

namespace fusee::optimize {
namespace {

/// Order of a queue from the lowest bound.
struct HigherBound {
  bool operator()(const Box& a, const Box& b) const { return a.bound > b.bound; }
};

/// Value of the best design before there is one.
constexpr double k_none = 1e300;

/// Throws InputError for an optimum that cannot be certified.
void demand_certifiable(const Problem& problem, Objective objective) {
  const std::string obstacle = cannot_certify(problem, objective);
  if (obstacle.empty()) return;
  std::string names;
  for (const ObjectiveInfo& candidate : objectives()) {
    if (candidate.certifiable) names += (names.empty() ? "" : ", ") + std::string(candidate.name);
  }
  throw InputError("", obstacle,
                   "certified: " + names +
                       ", with law compensate or linear, and for a joint as declared; otherwise use --method ga");
}

/// An evaluated design.
struct EvaluatedDesign {
  Design design;
  Evaluation evaluation;
};

/// Result for one box, independent of other boxes.
struct Outcome {
  bool kept = false;  ///< the box may contain the optimum or a tie
  Box box;
  std::vector<EvaluatedDesign> evaluated;
  long evaluations = 0;
};

class BranchAndBound {
 public:
  BranchAndBound(const Problem& problem, Objective objective, const CertifiedOptions& options,
                 const RunContext& context)
      : problem_(problem),
        count_(problem.variables.size()),
        objective_(objective),
        options_(options),
        context_(context),
        bounds_(problem, objective) {}

  CertifiedResult run() {
    start();
    const bool is_complete = branch();
    CertifiedResult result;
    result.found = !best_.empty();
    if (result.found) {
      finish(result);
      if (!stopped_) gather_ties(result.ties);
    } else {
      result.proven = is_complete;
      result.reason = commonest_reason();
    }
    result.boxes = boxes_;
    result.evaluations = evaluations_;
    return result;
  }

 private:
  double tie_limit() const { return best_.empty() ? k_none : best_value_ + options_.tie * std::abs(best_value_); }

  // ---- branch and bound ---------------------------------------------------------------------------------------------

  /// Evaluates given and random designs, and bounds the whole box.
  void start() {
    for (const Design& design : options_.first_tries) accept_if_better(evaluate(design));
    constexpr int k_first_tries = 200;
    Random random(1);
    for (int i = 0; i < k_first_tries && !must_stop(-k_none); ++i)
      accept_if_better(evaluate(random_design(problem_, random)));
    for (std::size_t i = 0; i < count_; ++i) {
      root_.lower[i] = problem_.variables[i].lower;
      root_.upper[i] = problem_.variables[i].upper;
    }
    root_.bound = -k_none;
    polish();
    process({root_});
  }

  /// Best-first search until the smallest bound meets the best design; false if it is stopped before. The search then
  /// goes on for at most as many boxes again, to a gap a hundred times smaller, because that improves the design.
  bool branch() {
    const bool met = branch_until(0.5 * options_.gap, options_.most_boxes);
    if (met) branch_until(0.005 * options_.gap, std::min(options_.most_boxes, 2 * boxes_));
    return met;
  }

  bool branch_until(double gap, long most_boxes) {
    while (!queue_.empty()) {
      const double bound = queue_.top().bound;
      if (is_met(bound, gap)) return true;
      if (boxes_ >= most_boxes || must_stop(bound)) return false;
      std::vector<Box> batch;
      while (!queue_.empty() && batch.size() < k_batch && !is_met(queue_.top().bound, gap)) {
        for (const Box& half : halves(queue_.top())) batch.push_back(half);
        queue_.pop();
      }
      process(batch);
    }
    return true;
  }

  bool is_met(double bound, double gap) const {
    return !best_.empty() && best_value_ - bound <= gap * std::abs(best_value_);
  }

  /// Reports the progress. True on a request to stop, or if the best design is sufficient.
  bool must_stop(double bound) {
    if (stopped_) return true;
    const double gap = (best_value_ - bound) / std::abs(best_value_);
    // The gap closes by powers of ten.
    const double done = gap > 0 && gap < 1 ? std::min(1.0, elementary::log(gap) / elementary::log(options_.gap)) : 0.0;
    const auto best = best_.empty() ? std::nullopt : std::optional(best_value_);
    stopped_ = !may_continue(context_, done, best) || (best && options_.sufficient && *best < *options_.sufficient);
    return stopped_;
  }

  /// Bounds all boxes in parallel, with the best design of earlier batches. Outcomes have the order of the boxes.
  std::vector<Outcome> outcomes_of(const std::vector<Box>& boxes) {
    std::vector<Outcome> outcomes(boxes.size());
    ThreadPool::shared().each(
        boxes.size(), [&](std::size_t i, std::size_t) { outcomes[i] = bound_box(boxes[i], i < k_repaired); },
        options_.threads);
    boxes_ += static_cast<long>(boxes.size());
    for (const Outcome& outcome : outcomes) evaluations_ += outcome.evaluations;
    return outcomes;
  }

  /// Bounds boxes, accepts better designs, and keeps the boxes that may contain the optimum or a tie.
  void process(const std::vector<Box>& boxes) {
    const std::vector<Outcome> outcomes = outcomes_of(boxes);
    for (const Outcome& outcome : outcomes) {
      for (const EvaluatedDesign& candidate : outcome.evaluated) accept_if_better(candidate);
    }
    // An improvement within a tenth of the gap is not polished: among ties, every batch finds a design that is better
    // by a rounding error.
    if (!best_.empty() && best_value_ < polished_ - 0.1 * options_.gap * std::abs(best_value_)) polish();
    keep(outcomes);
  }

  void keep(const std::vector<Outcome>& outcomes) {
    for (const Outcome& outcome : outcomes) {
      if (!outcome.kept || outcome.box.bound > tie_limit()) continue;
      if (outcome.box.bound > best_value_)
        tie_boxes_.push_back(outcome.box);
      else
        queue_.push(outcome.box);
    }
  }

  /// `repairs`: if the resulting design is infeasible, a feasible one near it is searched.
  Outcome bound_box(const Box& given, bool repairs) const {
    Outcome outcome;
    outcome.box = given;
    const BoxBound bound = bounds_.bound(outcome.box, tie_limit());
    outcome.evaluations = bound.evaluations;
    if (!bound.possible) return outcome;
    outcome.kept = true;
    outcome.box.bound = std::max(outcome.box.bound, bound.bound);
    outcome.box.cut = best_cut(outcome.box, bound);
    if (bound.bound > best_value_) return outcome;
    outcome.evaluated.push_back(
        evaluate(bound.lowest.empty() ? middle_of(outcome.box) : constrained(bound.lowest, outcome.box)));
    if (best_.empty() && !bound.lowest.empty()) outcome.evaluated.push_back(evaluate(middle_of(outcome.box)));
    if (repairs && !bound.lowest.empty() && !outcome.evaluated.front().evaluation.possible) {
      const Design repaired = bounds_.lowest_around(bound.lowest, std::max(1e-3, relative_size(outcome.box)));
      if (!repaired.empty()) outcome.evaluated.push_back(evaluate(constrained(repaired, root_)));
    }
    return outcome;
  }

  /// Moves one variable within the box as far as the constraints require, exactly, unlike a linear program.
  Design moved_into_constraints(Design design, std::size_t i, const Box& box) const {
    for (const LinearConstraint& constraint : problem_.constraints) {
      double excess = -constraint.b;
      for (std::size_t k = 0; k < count_; ++k) excess += constraint.a[k] * design[k];
      if (excess > 0 && constraint.a[i] != 0)
        design[i] = std::clamp(design[i] - excess / constraint.a[i], box.lower[i], box.upper[i]);
    }
    return design;
  }

  /// Satisfies the constraints, if moving a single variable suffices.
  Design constrained(const Design& design, const Box& box) const {
    for (std::size_t i = 0; i < count_ && !problem_.constraints.empty(); ++i) {
      const Design moved = moved_into_constraints(design, i, box);
      if (constraint_violation(problem_, moved) == 0) return moved;
    }
    return design;
  }

  EvaluatedDesign evaluate(const Design& design) const {
    return {design, evaluate_design(problem_, objective_, design)};
  }

  void accept_if_better(const EvaluatedDesign& candidate) {
    if (!candidate.evaluation.possible) {
      if (best_.empty()) ++reasons_[candidate.evaluation.reason.substr(0, candidate.evaluation.reason.find(" at "))];
    } else if (candidate.evaluation.value < best_value_ || best_.empty()) {
      best_ = candidate.design;
      best_value_ = candidate.evaluation.value;
      best_theta_ = candidate.evaluation.theta;
    }
  }

  /// Improves the best design by linear programs in shrinking boxes around it. An early good design reduces the number
  /// of boxes.
  void polish() {
    constexpr double k_first_size = 0.05, k_least_size = 1e-8;  // relative to the range of each variable
    constexpr double k_smaller = 0.25, k_larger = 2.0;
    constexpr int k_steps = 40;
    double size = k_first_size;
    for (int step = 0; step < k_steps && size > k_least_size && !best_.empty() && !must_stop(-k_none); ++step) {
      const double before = best_value_;
      const Design lowest = bounds_.lowest_around(best_, size);
      if (!lowest.empty()) accept_if_better(evaluate(constrained(lowest, root_)));
      size *= best_value_ < before - 1e-3 * options_.gap * std::abs(before) ? k_larger : k_smaller;
    }
    polished_ = best_value_;
  }

  /// The variable to halve.
  int best_cut(const Box& box, const BoxBound& bound) const {
    int cut = 0;
    double most = -1;
    for (std::size_t i = 0; i < count_; ++i) {
      const double range = root_.upper[i] - root_.lower[i];
      const double relative = range > 0 ? (box.upper[i] - box.lower[i]) / range : 0.0;
      // Halves the variable with the largest error of the bound, or the widest one if slopes are missing or
      // uninformative.
      const double gain = bound.lowest.empty() ? relative : bound.loss[i] + 1e-3 * relative * std::abs(bound.bound);
      if (!(relative > 0 && gain > most)) continue;
      most = gain;
      cut = static_cast<int>(i);
    }
    return cut;
  }

  std::array<Box, 2> halves(const Box& box) const {
    const auto i = static_cast<std::size_t>(box.cut);
    const double middle = 0.5 * (box.lower[i] + box.upper[i]);
    std::array<Box, 2> both{box, box};
    both[0].upper[i] = middle;
    both[1].lower[i] = middle;
    return both;
  }

  Design middle_of(const Box& box) const {
    Design middle(count_);
    for (std::size_t i = 0; i < count_; ++i) middle[i] = 0.5 * (box.lower[i] + box.upper[i]);
    return middle;
  }

  // ---- result -------------------------------------------------------------------------------------------------------

  void finish(CertifiedResult& result) {
    result.best = best_;
    result.theta = best_theta_;
    result.value = bounds_.rounded_up_value(best_);
    result.lower_bound = queue_.empty() ? best_value_ : std::min(best_value_, queue_.top().bound);
    result.relative_gap = (result.value - result.lower_bound) / std::abs(result.lower_bound);
    result.proven = result.relative_gap <= options_.gap;
    result.stopped = stopped_;
  }

  std::string commonest_reason() const {
    const auto most = std::max_element(reasons_.begin(), reasons_.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == reasons_.end() ? "no design was possible" : most->first;
  }

  /// Largest width of the box relative to its variable's range.
  double relative_size(const Box& box) const {
    double size = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const double range = problem_.variables[i].upper - problem_.variables[i].lower;
      if (range > 0) size = std::max(size, (box.upper[i] - box.lower[i]) / range);
    }
    return size;
  }

  int widest(const Box& box) const { return best_cut(box, BoxBound()); }

  /// Bisects the largest boxes that may contain a tie, until there are many or all are small.
  void gather_ties(TieSet& ties) {
    constexpr double k_small = 1.0 / 512.0;
    for (; !queue_.empty(); queue_.pop()) tie_boxes_.push_back(queue_.top());
    std::multimap<double, Box, std::greater<>> by_size;
    for (const Box& box : tie_boxes_) {
      if (box.bound <= tie_limit()) by_size.emplace(relative_size(box), box);
    }
    ties.known = {best_, best_};
    while (!by_size.empty() && by_size.begin()->first > k_small && !must_stop(best_value_) &&
           static_cast<long>(by_size.size()) < options_.most_tie_boxes) {
      std::vector<Box> batch;
      for (; !by_size.empty() && by_size.begin()->first > k_small && batch.size() < k_batch;
           by_size.erase(by_size.begin())) {
        Box box = by_size.begin()->second;
        box.cut = widest(box);
        for (const Box& half : halves(box)) batch.push_back(half);
      }
      for (const Outcome& outcome : outcomes_of(batch)) {
        if (!outcome.kept) continue;
        widen_known(ties.known, middle_of(outcome.box));
        by_size.emplace(relative_size(outcome.box), outcome.box);
      }
    }
    describe(ties, by_size);
  }

  /// Widens `known` to a design, if it ties.
  void widen_known(DesignBox& known, const Design& design) {
    const Evaluation evaluation = evaluate_design(problem_, objective_, design);
    if (!evaluation.possible || evaluation.value > tie_limit()) return;
    for (std::size_t i = 0; i < count_; ++i) {
      known.lower[i] = std::min(known.lower[i], design[i]);
      known.upper[i] = std::max(known.upper[i], design[i]);
    }
  }

  void describe(TieSet& ties, const std::multimap<double, Box, std::greater<>>& boxes) const {
    constexpr double k_wide = 0.05;
    ties.hull = {best_, best_};
    for (const auto& [size, box] : boxes) {
      DesignBox design_box{Design(box.lower.begin(), box.lower.begin() + static_cast<std::ptrdiff_t>(count_)),
                           Design(box.upper.begin(), box.upper.begin() + static_cast<std::ptrdiff_t>(count_))};
      double share = 1;
      for (std::size_t i = 0; i < count_; ++i) {
        ties.hull.lower[i] = std::min(ties.hull.lower[i], box.lower[i]);
        ties.hull.upper[i] = std::max(ties.hull.upper[i], box.upper[i]);
        const double range = problem_.variables[i].upper - problem_.variables[i].lower;
        if (range > 0) share *= (box.upper[i] - box.lower[i]) / range;
      }
      ties.share += share;
      ties.boxes.push_back(std::move(design_box));
    }
    for (std::size_t i = 0; i < count_; ++i) {
      const double range = problem_.variables[i].upper - problem_.variables[i].lower;
      if (ties.known.upper[i] - ties.known.lower[i] > k_wide * range) ties.wide = true;
    }
  }

  /// Halves per batch: enough for eight threads, and few compared with a search. The search does not depend on the
  /// number of threads.
  static constexpr std::size_t k_batch = 32;
  static constexpr std::size_t k_repaired = 4;  ///< boxes of a batch with the lowest bounds, whose designs are repaired

  const Problem& problem_;
  std::size_t count_;
  Objective objective_;
  CertifiedOptions options_;
  const RunContext& context_;
  BoundCalculator bounds_;
  Box root_;
  Design best_;
  double best_value_ = k_none;
  double best_theta_ = 0;
  double polished_ = k_none;  ///< result of the last polishing
  std::priority_queue<Box, std::vector<Box>, HigherBound> queue_;
  std::vector<Box> tie_boxes_;           ///< boxes above the best value, within the tie
  std::map<std::string, long> reasons_;  ///< why designs are impossible, and how often; until the first possible one
  long boxes_ = 0;
  long evaluations_ = 0;
  bool stopped_ = false;
};

/// The smallest value of a key over the variables' ranges.
double least_value(const MovingKey& moving, const std::vector<Variable>& variables) {
  double least = moving.constant;
  for (std::size_t i = 0; i < variables.size(); ++i)
    least += std::min(moving.a[i] * variables[i].lower, moving.a[i] * variables[i].upper);
  return least;
}

}  // namespace

std::string cannot_certify(const Problem& problem, Objective objective) {
  if (!info(objective).certifiable)
    return std::string(info(objective).name) + " has no interval form: its optimum cannot be certified";
  if (problem.base.pulley.law == Law::table)
    return "law = \"table\" has no interval form: its optimum cannot be certified";
  if (problem.base.pulley.law == Law::torque)
    return "law = \"torque\" has no interval form: its optimum cannot be certified";
  const bool begins_without_drum = std::any_of(problem.moving.begin(), problem.moving.end(), [&](const MovingKey& key) {
    return key.key == "joint.drum_radius_mm" && !(least_value(key, problem.variables) > 0);
  });
  if (begins_without_drum)
    return "joint.drum_radius_mm with a lower bound of 0 has no interval form: a tiny drum differs from none";
  const bool begins_rigid = std::any_of(problem.moving.begin(), problem.moving.end(), [&](const MovingKey& key) {
    return key.key == "sheath.stiffness_N_per_mm" && !(least_value(key, problem.variables) > 0);
  });
  if (begins_rigid)
    return "sheath.stiffness_N_per_mm with a lower bound of 0 has no interval form: 0 is a rigid sheath, a tiny "
           "stiffness a compliant one";
  if (objective == Objective::max_error && problem.base.joint.drum_mu > 0)
    return "max_error with joint.drum_friction has no interval form: its optimum cannot be certified";
  if (problem.identified_joint)
    return "[identified] has no interval form: the optimum of the identified joint cannot be certified";
  return "";
}

CertifiedResult certified_optimum(const Problem& problem, Objective objective, const CertifiedOptions& options,
                                  const RunContext& context) {
  demand_certifiable(problem, objective);
  return BranchAndBound(problem, objective, options, context).run();
}

}  // namespace fusee::optimize
