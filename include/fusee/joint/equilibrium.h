/// \file
/// The joint in quasi-static equilibrium along any sequence of pulley angles and loads, with history.
///
/// Model: two elastic tendons that cannot push. Each has two spans with stick-slip capstan friction at the pin between
/// them, and further spans with friction at each bend of a sheath. The wound tendon slides in its groove as far as
/// friction permits (JointModel::groove_friction), as does the tendon on the joint's drum (drum_friction). Limits: the
/// paper's [6]-[11] (tension.h).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "fusee/joint/joint_model.h"

namespace fusee {

/// Changes of both tendons since home: creep, temperature, a slipping anchor. Not included in energies.
struct TendonChange {
  std::array<double, 2> expansion{};  ///< relative change of the unloaded length of tendon 1 and 2
  std::array<double, 2> released{};   ///< length released by the anchors of tendon 1 and 2 since home, mm
};

/// One step of a motion. The model's weight and spring act in addition to tip force and torque.
struct JointStep {
  double alpha = 0;      ///< rad
  double tip_force = 0;  ///< F_c across OC, positive against +θ, N
  double torque = 0;     ///< about O, positive against +θ, N·mm
  TendonChange tendon = {};
};

enum class PinContact {
  stick,      ///< no material crosses the pin; with a sheath: not all of the tendon slides
  slip_up,    ///< material crosses towards the joint: T_up = T_low e^{μφ}
  slip_down,  ///< towards the pulley: T_low = T_up e^{μφ}
  slack,      ///< no tension on either side
};

struct TendonState {
  double upper = 0;    ///< tension between pin and C, N
  double lower = 0;    ///< tension between pulley and pin, N
  double end = 0;      ///< tension at the tendon's end; differs from `upper` by friction on a drum, N
  double slack = 0;    ///< excess of material over the path length, both spans, mm
  double stretch = 0;  ///< excess of path length over material, both spans, mm
  double wrap = 0;     ///< φ on the pin, rad; negative: the tendon would leave the pin, where the model ends
  PinContact contact = PinContact::stick;
};

enum class EquilibriumStatus {
  held,   ///< in equilibrium
  loose,  ///< both tendons slack: nothing holds the joint, and θ is arbitrary within the play
  /// No joint angle between the dead centres carries the load; the point repeats the last θ without tensions
  no_equilibrium,
};

struct EquilibriumPoint {
  EquilibriumStatus status = EquilibriumStatus::held;
  double alpha = 0;  ///< rad
  double theta = 0;  ///< rad
  /// Rotation in −θ and in +θ until a tendon is taut, for a loose joint. rad
  double loose_below = 0;
  double loose_above = 0;
  TendonState t1;  ///< left
  TendonState t2;  ///< right
  /// Torque of the motor on the pulley, towards +α: T2_low p2 − T1_low p1, N·mm.
  double motor_torque = 0;
  double load_torque = 0;  ///< against +θ, N·mm
  /// Joint stiffness with the pulley fixed and no material crossing the pins, N·mm/rad: small disturbances, upper spans
  /// only.
  double stiffness_stuck = 0;
  /// Joint stiffness with pins and groove sliding at the present tension ratios: large disturbances, whole tendons.
  double stiffness = 0;
  double stored = 0;           ///< elastic energy relative to the unloaded home position, N·mm
  double friction = 0;         ///< work lost since home at pins, drum, sheaths and bearing, N·mm
  double groove_friction = 0;  ///< work lost since home in the grooves, N·mm
};

/// A joint in motion. A copy is a snapshot that continues from the same history.
class JointMotion {
 public:
  /// Starts at home, unloaded (without weight and spring): tendon 1 at the pretension, tendon 2 in balance with it,
  /// equal tension in both spans of each.
  explicit JointMotion(JointModel model);
  JointMotion(const JointMotion& other);
  JointMotion& operator=(const JointMotion& other);
  JointMotion(JointMotion&&) noexcept;
  JointMotion& operator=(JointMotion&&) noexcept;
  ~JointMotion();

  /// Moves directly to `step` and stays there. Within one step each pin slips at most one way, so steps should be about
  /// a degree. Without equilibrium the history is unchanged. Never returns NaN.
  EquilibriumPoint to(const JointStep& step);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Moves from home through all `steps` in order.
std::vector<EquilibriumPoint> follow(const JointModel& model, const std::vector<JointStep>& steps);

}  // namespace fusee
