/// \file
/// Forward model: predicts the sensor log of a joint from its deviations.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fusee/joint.h"
#include "joint/creep_memory.h"
#include "joint/imperfect_joint.h"

namespace fusee::joint {

/// Creep of both tendons. It persists between runs, in which the joint rests at home without load.
class TendonCreep {
 public:
  /// `per_decade`: creep as a fraction of the elastic strain. Tendons have rested at home for long and do not creep
  /// further there.
  TendonCreep(double per_decade, double EA, JointMotion home, const JointStep& rest);

  /// Additional relative length of both tendons if the present tensions act for `time` s more.
  std::array<double, 2> after(double time) const;
  /// Proceeds from the present tensions to those of `now` within `time` s.
  void hold(const EquilibriumPoint& now, double time);
  /// Rests at home without load for `time` s.
  void rest(double time);

 private:
  std::array<double, 2> strains(const EquilibriumPoint& point) const;

  double per_decade_;
  double EA_;
  std::array<double, 2> at_rest_{};  ///< strain at rest
  std::array<double, 2> beyond_{};   ///< present strain beyond at_rest_
  std::array<CreepMemory, 2> memory_;
};

/// The joint on its bench. Caches the latest motions, which do not depend on errors of the joint sensor, since a search
/// asks for one in five again, and the latest geometries, which few effects change. Not thread-safe.
class Forward {
 public:
  Forward(const Mechanism& declared, const BenchLog& log) : Forward(declared, log, declared) {}
  /// A joint whose pulley was made for the mechanism `made_for`.
  Forward(const Mechanism& declared, const BenchLog& log, const Mechanism& made_for);
  /// With runs of an earlier state, if any: imperfections are then added to it and act only in the later runs.
  Forward(const Mechanism& declared, const BenchLog& log, const std::optional<EarlierState>& earlier);

  /// Seeks equilibria less accurately from now on, in less time.
  void serve_fits() { is_for_fits_ = true; }

  /// Readings of the joint sensor. NaN without an equilibrium. With both tendons slack: the angle to which the joint
  /// was last pushed.
  Readings operator()(const Imperfections& imperfections);
  /// Play by which the joint angle may deviate from its prediction, rad; zero where a tendon is taut.
  const Readings& looseness(const Imperfections& imperfections) {
    return motion_of(with_earlier_state(imperfections)).loose;
  }
  /// The complete state of the joint at each row.
  std::vector<std::vector<JointState>> states(const Imperfections& imperfections);

 private:
  /// A cached motion of the joint, without the errors of the joint sensor.
  struct Motion {
    Imperfections key;
    Readings theta;  ///< joint angle, rad
    Readings loose;  ///< play about `theta`, rad
  };

  /// A cached model of both tendon paths.
  struct Geometry {
    GeometryError key;
    std::optional<JointModel> model;
  };

  Imperfections with_earlier_state(const Imperfections& imperfections) const;
  const Motion& motion_of(const Imperfections& imperfections);
  JointMotion at_home(const Imperfections& imperfections);
  /// Moves through these runs and calls `on_row` for every row. For a joint declared by a ratio only θ is known.
  void move(const Imperfections& imperfections, const std::vector<std::size_t>& runs,
            const std::function<void(std::size_t run, const EquilibriumPoint&)>& on_row);
  /// One run of a joint with tendons, from home.
  void move_tendon_joint(std::size_t run, JointMotion motion, const Imperfections& imperfections, TendonCreep& creep,
                         const std::function<void(const EquilibriumPoint&)>& on_row) const;
  /// θ at each row of one run of a joint declared by a ratio.
  std::vector<double> ratio_joint_angles(std::size_t run, const Imperfections& imperfections, CreepMemory& drift) const;
  /// Thermal expansion and slip of the tendons at a row.
  TendonChange change(std::size_t run, const BenchRow& row, const Imperfections& imperfections) const;
  double time_before(std::size_t run) const;

  const Mechanism& declared_;
  const BenchLog& log_;
  std::vector<double> clock_;     ///< offset of each run's time, s
  std::vector<std::size_t> all_;  ///< all runs
  /// For each run, the first run with identical inputs except for its speed.
  std::vector<std::size_t> first_alike_;
  std::optional<EarlierState> earlier_;
  std::optional<Motion> earlier_motion_;  ///< all runs in the earlier state
  double first_temperature_ = 0;          ///< °C
  bool is_for_fits_ = false;
  std::optional<MadePulleys> made_;  ///< null for a joint declared by a ratio
  double alpha_least_ = 0;           ///< range of the logged α, home included, rad
  double alpha_most_ = 0;
  std::vector<Motion> latest_;  ///< grows to k_most_motions
  std::size_t next_ = 0;        ///< entry of latest_ that is replaced next
  std::array<Geometry, 4> latest_geometry_;
  std::size_t next_geometry_ = 0;
};

}  // namespace fusee::joint
