/// \file
/// The evidence of a set of effects: how likely the data are with it, numbers and discrepancy integrated out.
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "base/decompositions.h"
#include "calibration/discrepancy.h"

namespace fusee {

/// How large the families of the discrepancy and the noise are, rad.
struct Amplitudes {
  Eigen::VectorXd families;
  double noise = 0;

  bool operator==(const Amplitudes& other) const { return noise == other.noise && families == other.families; }
};

/// A place in the space of the parameters and what is known there: rows in use alone.
struct Tangent {
  Eigen::MatrixXd J;         ///< dθ/dx
  Eigen::VectorXd residual;  ///< measured − model, rad
  Eigen::VectorXd x;
  Eigen::VectorXd prior;  ///< size of each x in practice; infinite: not known
  Eigen::MatrixXd read;   ///< of what was measured by hand: information about x …
  Eigen::VectorXd pull;   ///< … and its gradient
  double against = 0;     ///< … and squares at x
  double give = 1;        ///< deflection there by the declared joint's: what the model is trusted to grows with it
};

/// With numbers more, of which nothing was read, where they do nothing; its slopes are the caller's.
void add_numbers(const Eigen::VectorXd& prior, Tangent& tangent);

/// A tangent's sums over rows, not weighted: all that its evidence needs.
struct TangentSums {
  Eigen::MatrixXd JJ, JD;
  Eigen::VectorXd Jr, Dr;
  double rr = 0;
  double rows = 0;
  Eigen::VectorXd x, prior;
  Eigen::MatrixXd read;
  Eigen::VectorXd pull;
  double against = 0;
  double give = 1;
};

/// What the data say at a tangent.
struct Explained {
  double log_evidence = 0;       ///< at the summit that the tangent promises
  double log_evidence_here = 0;  ///< at x itself: a promise that a bend does not keep counts for nothing
  Eigen::VectorXd step;          ///< of x to the posterior's summit
  Eigen::MatrixXd covariance;    ///< of x
  Eigen::VectorXd unnamed;       ///< what the discrepancy's columns add at the summit, rad each
  Amplitudes amplitudes;
  double height = 0;        ///< log of the posterior's density at x, as Marginal::summit()
  double height_ahead = 0;  ///< … and what the tangent promises of it at x + step
};

/// A discrepancy of amplitudes that are given: what all tangents beside it share. Columns in use alone, each scaled by
/// its amplitude.
struct SizedDiscrepancy {
  Amplitudes amplitudes;
  double beta = 0;  ///< of a row's square, 1/rad²
  std::vector<Eigen::Index> columns;
  Eigen::VectorXd size;
  Cholesky A;  ///< I + λ DᵀD λ β
};

/// A tangent with noise and discrepancy integrated out: any choice of its columns is weighed by a small matrix.
struct ReducedTangent {
  Eigen::MatrixXd JJ;  ///< information about x that the data give …
  Eigen::VectorXd Jr;  ///< … and its gradient
  double rr = 0;
  double constant = 0;  ///< log of the likelihood without its squares
  Eigen::VectorXd x, prior;
  Eigen::MatrixXd read;
  Eigen::VectorXd pull;
  double against = 0;
};

/// As Explained, with some of its columns, the others staying where they are.
double log_evidence_of(const ReducedTangent& tangent, const std::vector<Eigen::Index>& columns);

/// Sums over the rows in use that every set of effects shares.
class Marginal {
 public:
  static constexpr int k_rounds = 12;

  /// `worth`: independent rows in each row; `floor`: rms noise, rad. The first guess: every family of the floor's size.
  Marginal(Discrepancy discrepancy, double floor, double worth);
  /// Of another worth, and with another first guess.
  Marginal(const Marginal& other, double worth, Amplitudes first_guess);

  const Discrepancy& discrepancy() const { return discrepancy_; }
  double floor() const { return floor_; }
  double worth() const { return worth_; }
  const Amplitudes& first_guess() const { return first_guess_; }
  /// Of the noise and what is stated alone.
  Amplitudes nothing_unnamed() const;

  TangentSums sums_of(const Tangent& tangent) const;
  /// DᵀD
  const Eigen::MatrixXd& gram() const { return gram_; }

  /// `give`: as TangentSums.
  SizedDiscrepancy sized(const Amplitudes& amplitudes, double give) const;

  ReducedTangent reduced(const TangentSums& sums, const SizedDiscrepancy& beside) const;
  /// With amplitudes as they are given.
  Explained at(const TangentSums& sums, const SizedDiscrepancy& beside) const;
  Explained at(const TangentSums& sums, const Amplitudes& amplitudes) const {
    return at(sums, sized(amplitudes, sums.give));
  }
  Explained at(const Tangent& tangent, const Amplitudes& amplitudes) const { return at(sums_of(tangent), amplitudes); }
  Explained at(const Tangent& tangent, const SizedDiscrepancy& beside) const { return at(sums_of(tangent), beside); }
  /// With those that make the data likeliest, sought from there; a family of none there has none.
  Explained best(const TangentSums& sums, Amplitudes from, int rounds = k_rounds) const;
  Explained best(const Tangent& tangent, Amplitudes from, int rounds = k_rounds) const {
    return best(sums_of(tangent), std::move(from), rounds);
  }
  /// By how much what has no name is rarer than none, nats.
  double rareness_of_rest(const Explained& explained) const;
  /// Log of posterior density at x itself but for a constant.
  double summit(const Tangent& tangent, const SizedDiscrepancy& beside) const;

 private:
  struct Solved;
  double log_prior_of(const Amplitudes& amplitudes) const;
  Solved solved(const TangentSums& sums, const SizedDiscrepancy& beside) const;
  Explained explained(const TangentSums& sums, const SizedDiscrepancy& beside, const Solved& solved) const;
  Amplitudes reestimated(const TangentSums& sums, const Explained& now, const SizedDiscrepancy& beside,
                         const Solved& solved) const;

  Discrepancy discrepancy_;
  Eigen::MatrixXd gram_;
  double floor_;
  double worth_;
  Amplitudes first_guess_;
};

/// Log of the density of a number of this size in practice at `x`: bounded tails, since some joints are worse than any
/// practice, and no pair of giants that cancel is cheap.
double log_prior(double x, double prior);

}  // namespace fusee
