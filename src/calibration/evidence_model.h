/// \file
/// Evidence of a set of effects: p(data | set), parameters and discrepancy integrated out.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/decompositions.h"
#include "calibration/discrepancy.h"

namespace fusee::calibration {

/// Amplitudes of the discrepancy's families and of the noise, rad.
struct Amplitudes {
  Eigen::VectorXd families;
  double noise = 0;

  bool operator==(const Amplitudes& other) const { return noise == other.noise && families == other.families; }
};

/// Linearization of the model at x: rows in use alone.
struct Tangent {
  Eigen::MatrixXd J;         ///< dθ/dx
  Eigen::VectorXd residual;  ///< measured − model, rad
  Eigen::VectorXd x;
  Eigen::VectorXd prior;                ///< prior size of each x; infinite: no prior
  Eigen::MatrixXd caliper_information;  ///< information of caliper readings about x
  Eigen::VectorXd caliper_gradient;     ///< gradient of caliper readings
  double caliper_chi2 = 0;              ///< χ² of caliper readings at x
  double deflection_ratio = 1;  ///< deflection by that of the declared joint: scales the error of the model itself
};

/// Appends parameters at zero without caliper readings; the caller sets their slopes.
void add_numbers(const Eigen::VectorXd& prior, Tangent& tangent);

/// Unweighted sums over rows of a tangent: sufficient for its evidence.
struct TangentSums {
  Eigen::MatrixXd JJ, JD;
  Eigen::VectorXd Jr, Dr;
  double rr = 0;
  double rows = 0;
  Eigen::VectorXd x, prior;
  Eigen::MatrixXd caliper_information;
  Eigen::VectorXd caliper_gradient;
  double caliper_chi2 = 0;
  double deflection_ratio = 1;
};

/// Laplace approximation of the posterior at a tangent.
struct Posterior {
  double log_evidence = 0;       ///< log evidence at the mode that the tangent predicts
  double log_evidence_here = 0;  ///< log evidence at x itself: counts nothing that the linearization only predicts
  Eigen::VectorXd step;          ///< step from x to the mode
  Eigen::MatrixXd covariance;    ///< covariance of x
  Eigen::VectorXd coefficients;  ///< coefficients of the discrepancy's columns at the mode, rad each
  Amplitudes amplitudes;
  double log_density = 0;            ///< log posterior density at x, up to a constant
  double predicted_log_density = 0;  ///< predicted log posterior density at x + step
};

/// Discrepancy of given amplitudes, shared by all tangents: columns of non-zero amplitude, each scaled by it.
struct ScaledDiscrepancy {
  Amplitudes amplitudes;
  double beta = 0;  ///< weight of a row's square, 1/rad²
  std::vector<Eigen::Index> columns;
  Eigen::VectorXd size;
  Cholesky A;  ///< I + λ DᵀD λ β
};

/// Tangent with noise and discrepancy integrated out: the evidence of any subset of its columns needs a small matrix
/// only.
struct ReducedTangent {
  Eigen::MatrixXd JJ;  ///< information of the data about x
  Eigen::VectorXd Jr;  ///< gradient of the data
  double rr = 0;
  double constant = 0;  ///< log likelihood without its squares
  Eigen::VectorXd x, prior;
  Eigen::MatrixXd caliper_information;
  Eigen::VectorXd caliper_gradient;
  double caliper_chi2 = 0;
};

/// Log evidence with some of its columns, the others fixed at x.
double log_evidence_of(const ReducedTangent& tangent, const std::vector<Eigen::Index>& columns);

/// Evidence model that all sets of effects share: discrepancy, noise and their priors.
class EvidenceModel {
 public:
  static constexpr int k_rounds = 12;

  /// `independent_share`: independent rows in each row; `floor`: rms noise, rad. First guess: every family of the size
  /// of the floor.
  EvidenceModel(Discrepancy discrepancy, double floor, double independent_share);
  /// Copies the model with another independent share and first guess.
  EvidenceModel(const EvidenceModel& other, double independent_share, Amplitudes first_guess);

  const Discrepancy& discrepancy() const { return discrepancy_; }
  double floor() const { return floor_; }
  double independent_share() const { return independent_share_; }
  const Amplitudes& first_guess() const { return first_guess_; }
  /// Amplitudes of noise and of the families with a fixed amplitude alone.
  Amplitudes without_discrepancy() const;

  TangentSums sums_of(const Tangent& tangent) const;
  /// `deflection_ratio`: as TangentSums.
  ScaledDiscrepancy sized(const Amplitudes& amplitudes, double deflection_ratio) const;

  ReducedTangent reduced(const TangentSums& sums, const ScaledDiscrepancy& scaled_discrepancy) const;
  /// Posterior with given amplitudes.
  Posterior at(const TangentSums& sums, const ScaledDiscrepancy& scaled_discrepancy) const;
  Posterior at(const TangentSums& sums, const Amplitudes& amplitudes) const {
    return at(sums, sized(amplitudes, sums.deflection_ratio));
  }
  Posterior at(const Tangent& tangent, const Amplitudes& amplitudes) const { return at(sums_of(tangent), amplitudes); }
  Posterior at(const Tangent& tangent, const ScaledDiscrepancy& scaled_discrepancy) const {
    return at(sums_of(tangent), scaled_discrepancy);
  }
  /// Posterior with the likeliest amplitudes, iterated from `from`; a family that begins at 0 stays 0.
  Posterior best(const TangentSums& sums, Amplitudes from, int rounds = k_rounds) const;
  Posterior best(const Tangent& tangent, Amplitudes from, int rounds = k_rounds) const {
    return best(sums_of(tangent), std::move(from), rounds);
  }
  /// Negative log prior odds of the discrepancy against none, nats.
  double discrepancy_penalty(const Posterior& posterior) const;
  /// Log posterior density at x, up to a constant.
  double log_density_at(const Tangent& tangent, const ScaledDiscrepancy& scaled_discrepancy) const;

 private:
  struct Solved;
  double log_prior_of(const Amplitudes& amplitudes) const;
  Solved solved(const TangentSums& sums, const ScaledDiscrepancy& scaled_discrepancy) const;
  Posterior posterior_at(const TangentSums& sums, const ScaledDiscrepancy& scaled_discrepancy,
                         const Solved& solved) const;
  Amplitudes reestimate(const TangentSums& sums, const Posterior& now, const ScaledDiscrepancy& scaled_discrepancy,
                        const Solved& solved) const;

  Discrepancy discrepancy_;
  std::uint64_t id_;      ///< of the discrepancy, shared by copies
  Eigen::MatrixXd gram_;  ///< DᵀD
  double floor_;
  double independent_share_;
  Amplitudes first_guess_;
};

/// Linearized set of effects or shapes, as indices.
struct LinearizedSet {
  std::vector<std::size_t> members;
  Amplitudes amplitudes;  ///< likeliest ones beside the set
  double score = 0;       ///< log evidence minus the penalties of its members
};

/// Adds the member that raises the score most, up to three times, to a set. All are ranked by the amplitudes of the
/// set, and the amplitudes are estimated for the best three. `sums`: of a set; `penalties`: of each member, infinite for
/// those that must not be added.
LinearizedSet add_greedily(const EvidenceModel& evidence_model, const std::vector<double>& penalties,
                           const std::function<TangentSums(const std::vector<std::size_t>&)>& sums, LinearizedSet set);

/// Log prior density at `x` of a parameter of this size: Student's t with 2 degrees of freedom. Its heavy tails allow
/// rare large faults, and keep pairs of large numbers that cancel from being cheap.
double log_prior(double x, double prior);

}  // namespace fusee::calibration
