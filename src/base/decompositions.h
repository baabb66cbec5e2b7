/// \file
/// Eigen's decompositions of matrices of any size. Each costs seconds to compile: here once, and not where it is used.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>

namespace fusee {

/// Of a symmetric matrix, the least first; a column of `vectors` each.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen eigen_of(const Eigen::MatrixXd& symmetric);

/// Of a symmetric matrix: xᵀA x is above zero for every x.
bool is_positive_definite(const Eigen::MatrixXd& A);

/// A⁻¹ b of a symmetric matrix that is not indefinite.
Eigen::VectorXd solved(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXd solved(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// A = L Lᵀ of a symmetric A that is positive definite.
class Cholesky {
 public:
  Cholesky() = default;
  explicit Cholesky(const Eigen::MatrixXd& A);
  Eigen::MatrixXd lower() const;  ///< L
  /// Half of log det A.
  double half_log_determinant() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// Of A⁻¹.
  Eigen::VectorXd inverse_diagonal() const;

 private:
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

/// The x nearest to A x = b, for one A of full rank and any b.
class LeastSquares {
 public:
  explicit LeastSquares(const Eigen::MatrixXd& A);
  Eigen::VectorXd nearest(const Eigen::VectorXd& b) const;

 private:
  Eigen::HouseholderQR<Eigen::MatrixXd> factors_;
};

}  // namespace fusee
