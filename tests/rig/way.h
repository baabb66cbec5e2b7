/// \file
/// Motion and load of a run: from its plan to its rows. rad, N, s.
#pragma once

#include <vector>

#include "fusee/base.h"

namespace fusee::rig {

enum class Manner {
  strokes,    ///< there and back `cycles` times
  staircase,  ///< from hold to hold, there and back; at each the load goes through its levels and back
  ends,       ///< to holds at either end in turn, from the outermost to the middle
};

/// One run.
struct RunPlan {
  double load = 0;               ///< tip force across OC, against +θ, N
  double speed = radians(12.0);  ///< of α, rad/s
  int cycles = 3;
  double dwell = 0;  ///< s at every reversal
  Manner manner = Manner::strokes;
  std::vector<double> levels = {};  ///< loads: of cycle after cycle in strokes; at every hold of a staircase
  int holds = 6;                    ///< places in a staircase, or at either end
  double motor_turned = 0;          ///< the motor's sensor on its shaft since home was set, rad
  double joint_turned = 0;          ///< the joint's sensor on its axis, the same
};

/// Motion common to all runs.
struct MotionPlan {
  int rows_per_stroke = 80;
  double reach = 0.93;        ///< share of the declared range of α that is swept
  double pause = 5.0;         ///< s between runs
  bool loaded_first = false;  ///< the load is applied at home, and not where the sweep begins
};

/// A commanded row, in increasing time.
struct WayPoint {
  double time = 0;
  double alpha = 0;
  double load = 0;
  bool logged = true;
  double direction = 0;   ///< of the last motion: ±1
  bool reversal = false;  ///< the direction changes here
};
using Way = std::vector<WayPoint>;

/// Between α = `low` and `high`; the first point is the first row.
Way plan_way(const RunPlan& plan, const MotionPlan& motion, double low, double high);

/// Load of the first row.
double first_load(const RunPlan& plan);

/// Load 0 slow, `load` slow, 0 fast, half slow, reversed slow.
std::vector<RunPlan> full_protocol(double load);
/// One unloaded run of two cycles.
std::vector<RunPlan> single_protocol();

}  // namespace fusee::rig
