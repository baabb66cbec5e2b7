/// \file
/// What the sensor of a joint would have logged, given how it differs from what was declared.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fusee/joint/equilibrium.h"
#include "fusee/joint/joint_model.h"
#include "fusee/joint/simulate.h"
#include "joint/creep_memory.h"
#include "joint/imperfect_joint.h"

namespace fusee {

/// What both tendons of a joint have crept by. It is kept between runs, while the joint rests at home without load.
class TendonCreep {
 public:
  /// `per_decade` of the elastic strain, and the joint at home; tendons that hung there for long creep no more there.
  TendonCreep(double per_decade, double EA, JointMotion home, const JointStep& rest);

  /// Unloaded length added, as a fraction, when the tensions of the moment go on for `time` s.
  std::array<double, 2> after(double time) const;
  /// From the tensions of the moment to those of `now` within `time` s.
  void hold(const EquilibriumPoint& now, double time);
  void rest(double time);

 private:
  std::array<double, 2> strains(const EquilibriumPoint& point) const;

  double per_decade_;
  double EA_;
  std::array<double, 2> at_rest_{};  ///< strain
  std::array<double, 2> beyond_{};   ///< strain beyond that, at the moment
  std::array<CreepMemory, 2> memory_;
};

/// The joint on its bench. Keeps the latest motions of the mechanism, since sensors do not change them, and the
/// latest geometries, which few of the effects change. For one thread.
class Forward {
 public:
  Forward(const Mechanism& declared, const BenchLog& log) : Forward(declared, log, declared) {}
  /// With a pulley that was made for another joint.
  Forward(const Mechanism& declared, const BenchLog& log, const Mechanism& made_for);
  /// With runs of an earlier state, if there is one: imperfections are then what was added to it, and act in the later
  /// runs alone.
  Forward(const Mechanism& declared, const BenchLog& log, const std::optional<EarlierState>& earlier);

  /// NaN where the mechanism has no equilibrium. Where both tendons are slack, where the joint was last pushed.
  Readings operator()(const Imperfections& imperfections);
  /// How far from there the joint could be, since nothing holds it, rad; zero where a tendon is taut.
  const Readings& looseness(const Imperfections& imperfections) { return mechanism(whole(imperfections)).loose; }
  /// All that is known of the joint, row by row.
  std::vector<std::vector<JointState>> states(const Imperfections& imperfections);

 private:
  struct Motion {
    Imperfections key;
    Readings theta;
    Readings loose;
  };

  struct Geometry {
    GeometryError key;
    std::optional<JointModel> model;
  };

  Imperfections whole(const Imperfections& imperfections) const;
  const Motion& mechanism(const Imperfections& imperfections);
  JointMotion at_home(const Imperfections& imperfections);
  /// Calls `found` with what every row of these runs finds; of a joint declared by a ratio only θ is known.
  void move(const Imperfections& imperfections, const std::vector<std::size_t>& runs,
            const std::function<void(std::size_t run, const EquilibriumPoint&)>& found);
  void elastic(std::size_t run, JointMotion motion, const Imperfections& imperfections, TendonCreep& creep,
               const std::function<void(const EquilibriumPoint&)>& found) const;
  std::vector<double> geared(std::size_t run, const Imperfections& imperfections, CreepMemory& drift) const;
  TendonChange change(std::size_t run, const BenchRow& row, const Imperfections& imperfections) const;
  double time_before(std::size_t run) const;

  const Mechanism& declared_;
  const BenchLog& log_;
  std::vector<double> clock_;        ///< added to the time of each run
  std::vector<std::size_t> all_;     ///< runs
  std::vector<std::size_t> driven_;  ///< the first run that was driven as each is, but for its pace
  std::optional<EarlierState> earlier_;
  std::optional<Motion> earlier_motion_;  ///< of all runs, in the earlier state
  double first_temperature_ = 0;
  std::optional<MadePulleys> made_;
  double alpha_least_ = 0;
  double alpha_most_ = 0;
  std::array<Motion, 16> latest_;
  std::size_t next_ = 0;
  std::array<Geometry, 4> latest_geometry_;
  std::size_t next_geometry_ = 0;
};

}  // namespace fusee
