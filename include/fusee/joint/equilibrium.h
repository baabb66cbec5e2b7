/// \file
/// The joint in quasi-static equilibrium along any sequence of pulley angles and loads, history carried along.
///
/// Two elastic tendons, each in two spans with stick-slip capstan friction at the pin between them, and through a
/// sheath in more, with friction at each of its bends; what is wound on a pulley slides in its groove as far as
/// friction lets it (JointModel::groove_friction), and so does what lies on the joint's drum (drum_friction); a tendon
/// cannot push. Source of the limits: the paper's [6]-[11]
/// (tension.h).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "fusee/joint/joint_model.h"

namespace fusee {

/// By how much both tendons are not what they were at home: creep, heat, an anchor that gave way. Energies are counted
/// for none of it.
struct TendonChange {
  std::array<double, 2> expansion{};  ///< of tendon 1 and 2: unloaded length added, as a fraction
  std::array<double, 2> released{};   ///< material that the anchors of tendon 1 and 2 have let go since home, mm
};

/// One place of a motion. Beside tip force and torque the model's weight and spring act.
struct JointStep {
  double alpha = 0;      ///< rad
  double tip_force = 0;  ///< F_c across OC, positive against +θ, N
  double torque = 0;     ///< about O, positive against +θ, N·mm
  TendonChange tendon = {};
};

enum class PinContact {
  stick,      ///< no material crosses the pin; through a sheath: not all of the tendon slides
  slip_up,    ///< material crosses towards the joint: T_up = T_low e^{μφ}
  slip_down,  ///< towards the pulley: T_low = T_up e^{μφ}
  slack,      ///< no tension on either side
};

struct TendonState {
  double upper = 0;    ///< tension between pin and C, N
  double lower = 0;    ///< tension between pulley and pin, N
  double end = 0;      ///< tension at the tendon's end: `upper`, but for what rubs on a drum, N
  double slack = 0;    ///< material beyond the path's length, both spans, mm
  double stretch = 0;  ///< path beyond the material's length, both spans, mm
  double wrap = 0;     ///< φ on the pin, rad; negative: the tendon would leave the pin, and the model ends there
  PinContact contact = PinContact::stick;
};

enum class EquilibriumStatus {
  held,            ///< in equilibrium
  loose,           ///< both tendons slack: nothing holds the joint, θ is anywhere between
  no_equilibrium,  ///< no joint angle between the dead centres carries this load: the point repeats the last θ and
                   ///< holds no tensions
};

struct EquilibriumPoint {
  EquilibriumStatus status = EquilibriumStatus::held;
  double alpha = 0;  ///< rad
  double theta = 0;  ///< rad
  double loose_below =
      0;  ///< by how much the joint may turn down, and up, before a tendon is taut: where it is loose. rad
  double loose_above = 0;
  TendonState t1;  ///< left
  TendonState t2;  ///< right
  /// What the motor must turn the pulley with, towards +α: T2_low p2 − T1_low p1, N·mm.
  double motor_torque = 0;
  double load_torque = 0;  ///< against +θ, N·mm
  /// Torque per joint angle with the pulley held, N·mm/rad: with no material crossing the pins (small disturbances,
  /// upper spans alone) …
  double stiffness_stuck = 0;
  /// … and with pins and groove that let it pass at the present ratio of tensions (large ones, whole tendons).
  double stiffness = 0;
  double stored = 0;           ///< elastic energy, above that of home unloaded, N·mm
  double friction = 0;         ///< lost at pins, on the drum, in sheaths and in the joint's bearing since home, N·mm
  double groove_friction = 0;  ///< lost in the grooves since home, N·mm
};

/// A joint on its way. Copies are snapshots: each goes on from the same history.
class JointMotion {
 public:
  /// At home, unloaded (neither weight nor spring): tendon 1 at the pretension, tendon 2 balancing it, equal tension in
  /// both spans of each.
  explicit JointMotion(JointModel model);
  JointMotion(const JointMotion& other);
  JointMotion& operator=(const JointMotion& other);
  JointMotion(JointMotion&&) noexcept;
  JointMotion& operator=(JointMotion&&) noexcept;
  ~JointMotion();

  /// Moves straight on to `step` and stays there. Within one step each pin slips at most one way: steps of a degree or
  /// so. Where there is no equilibrium the history stays as it was. Never NaN.
  EquilibriumPoint to(const JointStep& step);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// From home through all `steps`, in their order.
std::vector<EquilibriumPoint> follow(const JointModel& model, const std::vector<JointStep>& steps);

}  // namespace fusee
