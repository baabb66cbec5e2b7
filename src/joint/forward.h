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
#include "joint/imperfect_joint.h"

namespace fusee {

/// The joint on its bench. Keeps the latest motions of the mechanism, since sensors do not change them, and the
/// latest geometries, which few of the effects change. For one thread.
class Forward {
 public:
  Forward(const Mechanism& declared, const BenchLog& log) : Forward(declared, log, declared) {}
  /// With a pulley that was made for another joint.
  Forward(const Mechanism& declared, const BenchLog& log, const Mechanism& made_for);

  /// NaN where the mechanism has no equilibrium. Where both tendons are slack, the middle of where the joint may be.
  Readings operator()(const Imperfections& imperfections);
  /// Half the angle within which nothing holds the joint, rad; zero where a tendon is taut.
  const Readings& looseness(const Imperfections& imperfections) { return mechanism(imperfections).loose; }
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

  const Motion& mechanism(const Imperfections& imperfections);
  JointMotion at_home(const Imperfections& imperfections);
  /// Calls `found` with the equilibrium of each row.
  void elastic(std::size_t run, JointMotion motion, const Imperfections& imperfections,
               const std::function<void(const EquilibriumPoint&)>& found) const;
  std::vector<double> geared(std::size_t run, const Imperfections& imperfections) const;
  TendonChange change(std::size_t run, const BenchRow& row, const Imperfections& imperfections) const;

  const Mechanism& declared_;
  const BenchLog& log_;
  std::vector<double> clock_;
  double first_temperature_ = 0;
  std::optional<MadePulleys> made_;
  double alpha_least_ = 0;
  double alpha_most_ = 0;
  std::array<Motion, 4> latest_;
  std::size_t next_ = 0;
  std::array<Geometry, 4> latest_geometry_;
  std::size_t next_geometry_ = 0;
};

}  // namespace fusee
