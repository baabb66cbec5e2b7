/// \file
/// A cable as a chain of springs with dry friction at every node, relaxed node by node, without play operators or mean
/// angles.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace fusee::testing {

/// Springs in series from the motor to the joint with a total compliance of 1; every node rubs on its guide.
class RubbedChain {
 public:
  /// `share`: ln of the tension ratio that the whole cable sustains, as a capstan; `unloaded`: additional friction of
  /// the whole cable.
  RubbedChain(double share, double unloaded) : share_(share / k_nodes), unloaded_(unloaded / k_nodes) {}

  /// Moves the motor to `driven` under the pull `load`, and returns the joint angle in the unit of `driven`. The
  /// nodes keep their places, which are the memory of the friction.
  double to(double driven, double load) {
    constexpr double overrelaxation = 1.9;  // factor of successive over-relaxation
    constexpr double settled = 1e-10;       // largest step of a node at which the relaxation ends
    for (double moved = 1; moved > settled;) {
      moved = 0;
      for (int i = 0; i < k_nodes; ++i) {
        const double before = i > 0 ? node_[i - 1] : driven, after = i + 1 < k_nodes ? node_[i + 1] : joint_;
        const double to_motor = k_stiffness * (before - node_[i]), to_joint = k_stiffness * (node_[i] - after);
        const double pull = to_motor - to_joint;
        const double held = unloaded_ + std::expm1(share_) * std::max(0.0, std::min(to_motor, to_joint));
        if (std::abs(pull) <= held) continue;
        const double step = overrelaxation * (pull - std::copysign(held, pull)) / (2 * k_stiffness);
        node_[i] += step;
        moved = std::max(moved, std::abs(step));
      }
      const double next = node_.back() - load / k_stiffness;
      moved = std::max(moved, std::abs(next - joint_));
      joint_ = next;
    }
    return joint_;
  }

 private:
  static constexpr int k_nodes = 64;
  static constexpr double k_stiffness = k_nodes + 1;  // of each of k_nodes + 1 springs

  double share_, unloaded_;
  std::vector<double> node_ = std::vector<double>(k_nodes, 0.0);
  double joint_ = 0;
};

}  // namespace fusee::testing
