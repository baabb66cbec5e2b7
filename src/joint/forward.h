/// \file
/// What the sensors of a joint would have logged, given how it differs from what was declared.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "fusee/measurement/measurement.h"
#include "fusee/mechanism/imperfections.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/joint/equilibrium.h"
#include "fusee/joint/joint_model.h"

namespace fusee {

/// θ as the joint sensor shows it, rad, run by run, parallel to the samples.
using Readings = std::vector<std::vector<double>>;

/// What is added to each run's time so that runs whose clocks begin anew follow one another. s
std::vector<double> bench_clock(const Measurement& measurement);

/// By how much making moves a point of an outline out along its normal `psi`: s sin nψ + c cos nψ, and its derivatives.
struct OutlineWave {
  double outward = 0;  ///< mm
  double slope = 0;
  double bend = 0;
};
OutlineWave outline_wave(double psi, const Imperfections& imperfections);

/// The play operator: follows `input` at a distance of half the `width`, and stands still in between.
class Play {
 public:
  Play(double width, double input) : half_(0.5 * width), output_(input) {}
  double to(double input);

 private:
  double half_;
  double output_;
};

/// The joint on its bench. Keeps the latest motions of the mechanism, since sensors do not change them, and the
/// latest geometries, which few of the effects change. For one thread.
class Forward {
 public:
  Forward(const Mechanism& declared, const Measurement& measurement);

  /// NaN where the mechanism has no equilibrium. Where both tendons are slack, the middle of where the joint may be.
  Readings operator()(const Imperfections& imperfections);
  /// Half the angle within which nothing holds the joint, rad; zero where a tendon is taut.
  const Readings& looseness(const Imperfections& imperfections) { return mechanism(imperfections).loose; }

 private:
  struct Motion {
    Imperfections key;
    Readings theta;
    Readings loose;
  };

  struct Geometry {
    Imperfections key;
    std::optional<JointModel> model;
  };

  const Motion& mechanism(const Imperfections& imperfections);
  JointMotion at_home(const Imperfections& imperfections);
  void elastic(std::size_t run, JointMotion motion, const Imperfections& imperfections, Motion& into) const;
  std::vector<double> geared(std::size_t run, const Imperfections& imperfections) const;
  TendonChange change(std::size_t run, const Sample& sample, const Imperfections& imperfections) const;

  const Mechanism& declared_;
  const Measurement& measurement_;
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

/// The joint as declared but for what acts beyond the tendons' paths: an imperfect mechanism, mounted.
Mechanism mounted(const Mechanism& declared, const Imperfections& imperfections);
/// Its statics: pulleys made for `declared` and imperfect themselves, in the mechanism as mounted.
JointModel imperfect_model(const MadePulleys& made, const Mechanism& declared, const Imperfections& imperfections);

}  // namespace fusee
