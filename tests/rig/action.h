/// \file
/// Actions of unmodelled faults: functions of the joint's state with numbers and, if needed, a memory. rad, mm, N, s.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "fusee/base.h"

namespace fusee::rig {

/// State of the joint at an instant. Results of the equilibrium are those of the current iteration for elongations, as
/// is θ for torques. All others are of the step before.
struct Moment {
  double time = 0;      ///< on the session's clock
  double run_time = 0;  ///< since the first row of the run
  double seconds = 1;   ///< since the last step
  std::size_t run = 0;
  double alpha = 0;        ///< as the motor's sensor shows it
  double direction = 0;    ///< of its last movement: ±1; 0 before any
  double alpha_speed = 0;  ///< rad/s
  double pulley = 0;       ///< where the pulley stands
  double theta = 0;
  double theta_speed = 0;
  double load = 0;                                       ///< tip force across OC, against +θ
  double warmth = 0;                                     ///< K above the session's begin
  std::array<double, 2> tension{};                       ///< at the link; [0] is tendon 1
  std::array<Vec2, 2> pull{Vec2::Zero(), Vec2::Zero()};  ///< unit, from the link's end towards the pins
  std::size_t side = 0;                                  ///< the tendon that is acted on, where one is; 0 is tendon 1
};

/// A function of a moment with its numbers; equal where name, numbers and function are.
struct Action {
  std::string name;
  std::vector<double> numbers;
  double (*act)(const Moment& now, const std::vector<double>& numbers, std::vector<double>& memory) = nullptr;

  bool operator==(const Action&) const = default;
};

/// The actions at one place with their memories.
class Actors {
 public:
  Actors() = default;
  explicit Actors(const std::vector<Action>& actions, std::size_t side = 0)
      : actions_(actions), memories_(actions.size()), side_(side) {}

  bool empty() const { return actions_.empty(); }
  /// Sum of the actions; updates their memories.
  double operator()(const Moment& now) { return sum(now, memories_); }
  /// Sum of the actions; memories unchanged.
  double preview(const Moment& now) const {
    std::vector<std::vector<double>> scratch = memories_;
    return sum(now, scratch);
  }

 private:
  double sum(const Moment& now, std::vector<std::vector<double>>& memories) const {
    Moment here = now;
    here.side = side_;
    double all = 0;
    for (std::size_t i = 0; i < actions_.size(); ++i) {
      all += actions_[i].act(here, actions_[i].numbers, memories[i]);
    }
    return all;
  }

  std::vector<Action> actions_;
  std::vector<std::vector<double>> memories_;
  std::size_t side_ = 0;
};

}  // namespace fusee::rig
