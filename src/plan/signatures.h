/// \file
/// Design matrix of a plan: the response of each run to each cause.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <utility>
#include <vector>

#include "fusee/plan.h"
#include "joint/forward.h"
#include "mechanism/effect.h"
#include "plan/candidates.h"

namespace fusee::plan {

/// A cause and its columns [first, first + count): one column for each number, the response at its usual size.
struct Cause {
  const Effect* effect = nullptr;
  std::vector<const fusee::EffectParameter*> numbers;
  Eigen::Index first = 0;
  Eigen::Index count() const { return static_cast<Eigen::Index>(numbers.size()); }
};

/// The usual size of a number, in its own unit. `largest_load`: N.
double usual_size(const fusee::EffectParameter& number, double largest_load);

/// Columns of the design matrix: causes, then model error, then unmodelled causes.
class Signatures {
 public:
  Signatures(const DeclaredMechanism& declared, const Bench& bench, double noise);

  const std::vector<Cause>& causes() const { return causes_; }
  /// Effects that the plan omits, each with the reason.
  const std::vector<std::pair<std::string, std::string>>& left_out() const { return left_out_; }
  Eigen::Index model_first() const { return model_first_; }            ///< first column of the model error
  Eigen::Index unmodelled_first() const { return unmodelled_first_; }  ///< first column of the unmodelled causes
  Eigen::Index columns() const { return columns_; }

  /// Normal equations AᵀA of one run, in units of the noise, and its number of rows. Empty if the joint has no
  /// equilibrium somewhere in the run.
  struct RunEquations {
    Eigen::MatrixXd squares;
    double rows = 0;
  };
  std::optional<RunEquations> of(const PlannedRun& run) const;
  /// Normal equations of a dimension that is read by hand.
  Eigen::MatrixXd of(const fusee::EffectParameter& reading) const;
  double largest_load() const { return bench_.largest_load(); }

 private:
  Eigen::VectorXd response_to(joint::Forward& forward, const Imperfections& from,
                              const fusee::EffectParameter& number) const;
  void add(const Effect& effect);
  std::string reason_to_leave_out(const Effect& effect) const;

  Mechanism expected_;  ///< the joint with its known imperfections
  const Bench& bench_;
  double noise_;  ///< of the joint's sensor, rad
  std::vector<Cause> causes_;
  std::vector<std::pair<std::string, std::string>> left_out_;
  Eigen::Index model_first_ = 0, unmodelled_first_ = 0, columns_ = 0;
};

}  // namespace fusee::plan
