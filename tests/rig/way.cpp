#include "rig/way.h"

#include <algorithm>
#include <cmath>

namespace fusee::rig {
namespace {

constexpr int k_dwell_rows = 10;
constexpr int k_hold_rows = 3;           // at one load
constexpr double k_hold_time = 0.5;      // s between them
constexpr double k_step = radians(2.5);  // of an unlogged way

class Builder {
 public:
  Builder(double alpha, double load) { way_.push_back({0.0, alpha, load}); }

  void add(double seconds, double alpha, double load, bool logged = true) {
    const WayPoint& last = way_.back();
    WayPoint next{last.time + seconds, alpha, load, logged, last.direction};
    if (alpha != last.alpha) next.direction = alpha > last.alpha ? 1.0 : -1.0;
    next.reversal = last.direction != 0 && next.direction != last.direction;
    way_.push_back(next);
  }
  /// Not logged.
  void go(double alpha, double speed) {
    const double from = way_.back().alpha;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(alpha - from) / k_step)));
    for (int i = 1; i <= steps; ++i)
      add(std::max(1e-3, std::abs(alpha - from) / steps / speed), from + (alpha - from) * i / steps, way_.back().load,
          false);
  }
  void hold(double load) {
    for (int row = 0; row < k_hold_rows; ++row) add(k_hold_time, way_.back().alpha, load);
  }
  Way done() { return std::move(way_); }

 private:
  Way way_;
};

Way strokes(const RunPlan& plan, const MotionPlan& motion, double low, double high) {
  const double step_time = (high - low) / motion.rows_per_stroke / plan.speed;
  Builder way(low, first_load(plan));
  for (int stroke = 0; stroke < 2 * plan.cycles; ++stroke) {
    const double from = stroke % 2 == 0 ? low : high;
    const double to = stroke % 2 == 0 ? high : low;
    const auto level = static_cast<std::size_t>(stroke / 2);
    const double load = plan.levels.empty() ? plan.load : plan.levels[level % plan.levels.size()];
    if (!plan.levels.empty() && stroke % 2 == 0 && stroke > 0) way.hold(load);
    for (int row = 1; row <= motion.rows_per_stroke; ++row)
      way.add(step_time, from + (to - from) * row / motion.rows_per_stroke, load);
    for (int row = 0; plan.dwell > 0 && row < k_dwell_rows; ++row) way.add(plan.dwell / k_dwell_rows, to, load);
  }
  return way.done();
}

void hold_levels(Builder& way, const std::vector<double>& levels) {
  for (const double load : levels) way.hold(load);
  for (auto load = std::next(levels.rbegin()); load != levels.rend(); ++load) way.hold(*load);
}

Way staircase(const RunPlan& plan, double low, double high) {
  const std::vector<double> levels = plan.levels.empty() ? std::vector<double>{plan.load} : plan.levels;
  Builder way(low, levels.front());
  const int last = std::max(1, plan.holds - 1);
  for (int cycle = 0; cycle < plan.cycles; ++cycle) {
    for (int i = cycle == 0 ? 0 : 1; i <= 2 * last; ++i) {
      way.go(low + (high - low) * (i <= last ? i : 2 * last - i) / last, plan.speed);
      hold_levels(way, levels);
    }
  }
  return way.done();
}

Way ends(const RunPlan& plan, double low, double high) {
  Builder way(low, plan.load);
  const double half = 0.5 * (high - low);
  for (int cycle = 0; cycle < plan.cycles; ++cycle) {
    for (int i = 0; i < plan.holds; ++i) {
      const double in = half * i / std::max(1, plan.holds);
      for (const double alpha : {low + in, high - in}) {
        way.go(alpha, plan.speed);
        way.hold(plan.load);
      }
    }
  }
  return way.done();
}

}  // namespace

double first_load(const RunPlan& plan) { return plan.levels.empty() ? plan.load : plan.levels.front(); }

Way plan_way(const RunPlan& plan, const MotionPlan& motion, double low, double high) {
  switch (plan.manner) {
    case Manner::strokes:
      return strokes(plan, motion, low, high);
    case Manner::staircase:
      return staircase(plan, low, high);
    case Manner::ends:
      return ends(plan, low, high);
  }
  return {};
}

std::vector<RunPlan> full_protocol(double load) {
  constexpr double fast = radians(90.0);
  constexpr double slow = radians(12.0);
  return {{0.0, slow, 3, 0.0},
          {load, slow, 3, 0.0},
          {0.0, fast, 4, 0.0},
          {0.5 * load, slow, 2, 0.0},
          {-load, slow, 2, 0.0}};
}

std::vector<RunPlan> single_protocol() { return {{0.0, radians(12.0), 2, 0.0}}; }

}  // namespace fusee::rig
