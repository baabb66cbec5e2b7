/// \file
/// What every cause makes of every run, as columns: the linear model that a plan is judged by.
#pragma once

#include <Eigen/Dense>
#include <string>
#include <utility>
#include <vector>

#include "fusee/plan/plan.h"
#include "joint/forward.h"
#include "plan/candidates.h"

namespace fusee {

/// A cause and its columns: [first, first + count), one a number, each at its usual size.
struct Cause {
  const Effect* effect = nullptr;
  std::vector<const EffectParameter*> numbers;
  Eigen::Index first = 0;
  Eigen::Index count() const { return static_cast<Eigen::Index>(numbers.size()); }
};

/// The usual size of a number, in its own unit.
double usual_size(const EffectParameter& number, double largest_load);

/// Columns of every run: causes, then the error that the model itself may make, then what has no name.
class Signatures {
 public:
  Signatures(const DeclaredMechanism& declared, const Bench& bench, double noise);

  const std::vector<Cause>& causes() const { return causes_; }
  const std::vector<std::pair<std::string, std::string>>& left_out() const { return left_out_; }
  Eigen::Index model_first() const { return model_first_; }
  Eigen::Index unknown_first() const { return unknown_first_; }
  Eigen::Index columns() const { return columns_; }

  /// AᵀA of a run, rows in units of the noise; and how many rows there are. None where the joint has no equilibrium in
  /// it.
  struct Seen {
    Eigen::MatrixXd squares;
    double rows = 0;
  };
  std::optional<Seen> of(const PlannedRun& run) const;
  /// The same of a number read by hand.
  Eigen::MatrixXd of(const EffectParameter& reading) const;
  double largest_load() const { return bench_.largest_load(); }

 private:
  Eigen::VectorXd moved_by(Forward& forward, const Imperfections& from, const EffectParameter& number) const;
  void add(const Effect& effect);
  std::string why_not(const Effect& effect) const;

  Mechanism expected_;
  const Bench& bench_;
  double noise_;
  std::vector<Cause> causes_;
  std::vector<std::pair<std::string, std::string>> left_out_;
  Eigen::Index model_first_ = 0, unknown_first_ = 0, columns_ = 0;
};

}  // namespace fusee
