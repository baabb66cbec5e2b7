/// \file
/// Eigen's decompositions for matrices of any size. They are compiled once, as each template takes seconds to compile.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>

namespace fusee {

/// Eigenvalues of a symmetric matrix in ascending order, and the eigenvectors as columns.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen eigendecomposition(const Eigen::MatrixXd& symmetric);

/// True when the symmetric matrix satisfies xᵀA x > 0 for every x ≠ 0.
bool is_positive_definite(const Eigen::MatrixXd& A);

/// A⁻¹ b for a symmetric, semidefinite A.
Eigen::VectorXd solved(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
Eigen::MatrixXd solved(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// Cholesky factorization A = L Lᵀ of a symmetric positive definite matrix.
class Cholesky {
 public:
  Cholesky() = default;
  explicit Cholesky(const Eigen::MatrixXd& A);
  Eigen::MatrixXd lower() const;  ///< L
  /// ½ log det A: the sum of the logarithms of L's diagonal.
  double half_log_determinant() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  /// The diagonal of A⁻¹.
  Eigen::VectorXd inverse_diagonal() const;

 private:
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

/// Least-squares solver: the x that minimizes |A x - b|, for one A of full rank and any b.
class LeastSquares {
 public:
  explicit LeastSquares(const Eigen::MatrixXd& A);
  Eigen::VectorXd nearest(const Eigen::VectorXd& b) const;

 private:
  Eigen::HouseholderQR<Eigen::MatrixXd> factors_;
};

}  // namespace fusee
