#include "fusee/optimize/certified.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"
#include "optimize/bound.h"
#include "optimize/random.h"

namespace fusee {
namespace {

struct HigherBound {
  bool operator()(const Box& a, const Box& b) const { return a.bound > b.bound; }
};

constexpr double k_none = 1e300;

void demand_certifiable(const Problem& problem, Objective objective) {
  const std::string obstacle = cannot_certify(problem, objective);
  if (obstacle.empty()) return;
  std::string names;
  for (const ObjectiveInfo& candidate : objectives()) {
    if (candidate.certifiable) names += (names.empty() ? "" : ", ") + std::string(candidate.name);
  }
  throw InputError(
      "", obstacle,
      "certified: " + names +
          ", with law compensate or linear, without feasible = true and of a joint as declared; else --method ga");
}

class Search {
 public:
  Search(const Problem& problem, Objective objective, const CertifiedOptions& options)
      : problem_(problem),
        count_(problem.variables.size()),
        objective_(objective),
        options_(options),
        bounder_(problem, objective) {
    if (problem.cap) cap_.emplace(problem, problem.cap->objective);
  }

  CertifiedResult run() {
    start();
    const bool to_the_end = branch();
    CertifiedResult result;
    result.found = !best_.empty();
    if (result.found) {
      finish(result);
      gather_ties(result.ties);
    } else {
      result.proven = to_the_end;
      result.reason = commonest_reason();
    }
    result.boxes = boxes_;
    result.evaluations = bounder_.evaluations() + (cap_ ? cap_->evaluations() : 0);
    return result;
  }

 private:
  double tie_limit() const { return best_.empty() ? k_none : best_value_ + options_.tie * std::abs(best_value_); }

  // ---- branch and bound
  // ------------------------------------------------------------------------------------------------

  void start() {
    for (const Design& design : options_.first_tries) try_design(design);
    constexpr int k_first_tries = 200;
    Random random(1);
    for (int i = 0; i < k_first_tries; ++i) try_design(random_design(problem_, random));
    Box root;
    for (std::size_t i = 0; i < count_; ++i) {
      root.lower[i] = problem_.variables[i].lower;
      root.upper[i] = problem_.variables[i].upper;
    }
    root.bound = -k_none;
    add(root);
  }

  /// Best first, until the least bound left meets the best design. Then as much work again at most for a hundred times
  /// less: what is wanted is the proof, but a better design on the way is welcome. False when it was stopped before.
  bool branch() {
    const bool met = branch_until(0.5 * options_.gap, options_.most_boxes);
    if (met) branch_until(0.005 * options_.gap, std::min(options_.most_boxes, 2 * boxes_));
    return met;
  }

  bool branch_until(double gap, long most_boxes) {
    while (!queue_.empty()) {
      const Box box = queue_.top();
      if (!best_.empty() && best_value_ - box.bound <= gap * std::abs(best_value_)) return true;
      if (boxes_ >= most_boxes || stopped(box.bound)) return false;
      queue_.pop();
      for (const Box& half : halves(box)) add(half);
    }
    return true;
  }

  bool stopped(double bound) {
    if (!options_.keep_going || boxes_ < next_report_) return false;
    next_report_ = boxes_ + 200;
    SearchProgress progress;
    if (!best_.empty()) progress.best = best_value_;
    progress.lower_bound = bound;
    progress.evaluations = bounder_.evaluations();
    const double gap = (best_value_ - bound) / std::abs(best_value_);
    // The gap closes by powers of ten.
    progress.done = gap > 0 && gap < 1 ? std::min(1.0, std::log(gap) / std::log(options_.gap)) : 0.0;
    return !options_.keep_going(progress);
  }

  /// Bounds a box, tries designs of it, and keeps it where it may hold the optimum or a tie.
  void add(Box box) {
    if (!bounded(box)) return;
    if (box.bound > best_value_)
      tie_boxes_.push_back(box);
    else
      queue_.push(box);
  }

  /// False when the box holds neither the optimum nor a tie.
  bool bounded(Box& box) {
    ++boxes_;
    if (!bounder_.contract(box)) return false;
    if (cap_) {
      Box of_cap = box;
      of_cap.bound = -k_none;  // the box's own bound is of the other objective
      const BoxBound first = cap_->bound(of_cap, problem_.cap->limit);
      if (!first.possible || first.bound > problem_.cap->limit) return false;
    }
    const BoxBound bound = bounder_.bound(box, tie_limit());
    if (!bound.possible) return false;
    box.bound = std::max(box.bound, bound.bound);
    if (box.bound > tie_limit()) return false;
    try_designs_of(box, bound);
    box.cut = promising_cut(box, bound);
    return box.bound <= tie_limit();
  }

  void try_designs_of(const Box& box, const BoxBound& bound) {
    if (bound.best_corner.empty() || boxes_ % 8 == 0) try_design(middle_of(box));
    if (bound.best_corner.empty()) return;
    if (constraint_violation(problem_, bound.best_corner) == 0) return try_design(bound.best_corner);
    for (std::size_t i = 0; i < count_; ++i) try_design(moved_into_constraints(bound.best_corner, i, box));
  }

  /// Moves variable i as far as the constraints ask, within the box.
  Design moved_into_constraints(Design design, std::size_t i, const Box& box) const {
    for (const LinearConstraint& constraint : problem_.constraints) {
      double excess = -constraint.b;
      for (std::size_t k = 0; k < count_; ++k) excess += constraint.a[k] * design[k];
      if (excess > 0 && constraint.a[i] != 0)
        design[i] = std::clamp(design[i] - excess / constraint.a[i], box.lower[i], box.upper[i]);
    }
    return design;
  }

  void try_design(const Design& design) {
    const Evaluation evaluation = evaluate_design(problem_, objective_, design);
    if (!evaluation.possible) {
      ++reasons_[evaluation.reason.substr(0, evaluation.reason.find(" at θ"))];
    } else if (evaluation.value < best_value_ || best_.empty()) {
      best_ = design;
      best_value_ = evaluation.value;
      best_theta_ = evaluation.theta;
    }
  }

  int promising_cut(const Box& box, const BoxBound& bound) const {
    int cut = 0;
    double most = -1;
    for (std::size_t i = 0; i < count_; ++i) {
      const double range = problem_.variables[i].upper - problem_.variables[i].lower;
      const double relative = range > 0 ? (box.upper[i] - box.lower[i]) / range : 0.0;
      // Without slopes, or where they say nothing, the widest; else where the objective changes most.
      const double promise =
          bound.best_corner.empty() ? relative : bound.influence[i] + 1e-3 * relative * std::abs(bound.bound);
      if (relative > 0 && promise > most) most = promise, cut = static_cast<int>(i);
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

  // ---- the answer
  // ------------------------------------------------------------------------------------------------------

  void finish(CertifiedResult& result) {
    result.best = best_;
    result.theta = best_theta_;
    result.value = bounder_.rounded_up_value(best_);
    result.lower_bound = queue_.empty() ? best_value_ : std::min(best_value_, queue_.top().bound);
    result.relative_gap = (result.value - result.lower_bound) / std::abs(result.lower_bound);
    result.proven = result.relative_gap <= options_.gap;
  }

  std::string commonest_reason() const {
    const auto most = std::max_element(reasons_.begin(), reasons_.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == reasons_.end() ? "no design was possible" : most->first;
  }

  double relative_size(const Box& box) const {
    double size = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const double range = problem_.variables[i].upper - problem_.variables[i].lower;
      if (range > 0) size = std::max(size, (box.upper[i] - box.lower[i]) / range);
    }
    return size;
  }

  int widest(const Box& box) const {
    BoxBound no_slopes;
    return promising_cut(box, no_slopes);
  }

  /// Halves the widest boxes that may hold a tie until there are many or all are small.
  void gather_ties(TieSet& ties) {
    constexpr double k_small = 1.0 / 512.0;
    for (; !queue_.empty(); queue_.pop()) tie_boxes_.push_back(queue_.top());
    std::multimap<double, Box, std::greater<>> by_size;
    for (const Box& box : tie_boxes_) {
      if (box.bound <= tie_limit()) by_size.emplace(relative_size(box), box);
    }
    ties.known = {best_, best_};
    while (!by_size.empty() && by_size.begin()->first > k_small &&
           static_cast<long>(by_size.size()) < options_.most_tie_boxes) {
      Box box = by_size.begin()->second;
      by_size.erase(by_size.begin());
      box.cut = widest(box);
      for (Box half : halves(box)) {
        if (!bounded(half)) continue;
        widen_known(ties.known, middle_of(half));
        by_size.emplace(relative_size(half), half);
      }
    }
    describe(ties, by_size);
  }

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

  const Problem& problem_;
  std::size_t count_;
  Objective objective_;
  CertifiedOptions options_;
  Bounder bounder_;
  std::optional<Bounder> cap_;
  Design best_;
  double best_value_ = k_none;
  double best_theta_ = 0;
  std::priority_queue<Box, std::vector<Box>, HigherBound> queue_;
  std::vector<Box> tie_boxes_;  ///< above the best value, within the tie
  std::map<std::string, long> reasons_;
  long boxes_ = 0;
  long next_report_ = 0;
};

}  // namespace

std::string cannot_certify(const Problem& problem, Objective objective) {
  if (!info(objective).certifiable)
    return std::string(info(objective).name) + " has no interval form: its optimum cannot be certified";
  if (problem.base.pulley.law == Law::table)
    return "law = \"table\" has no interval form: its optimum cannot be certified";
  if (problem.feasible) return "feasible = true has no interval form: the optimum cannot be certified";
  if (problem.as_it_is)
    return "[identified] has no interval form: the optimum of the joint as it is cannot be certified";
  return "";
}

CertifiedResult certified_optimum(const Problem& problem, Objective objective, const CertifiedOptions& options) {
  demand_certifiable(problem, objective);
  return Search(problem, objective, options).run();
}

}  // namespace fusee
