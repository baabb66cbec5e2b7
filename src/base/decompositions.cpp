#include "base/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace fusee {

SymmetricEigen eigen_of(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> found(symmetric);
  return {found.eigenvalues(), found.eigenvectors()};
}

Eigen::VectorXd relative_eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(A, B, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXd solved(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) { return A.ldlt().solve(b); }
Eigen::MatrixXd solved(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A.ldlt().solve(B); }

LeastSquares::LeastSquares(const Eigen::MatrixXd& A) : factors_(A) {}
Eigen::VectorXd LeastSquares::nearest(const Eigen::VectorXd& b) const { return factors_.solve(b); }

}  // namespace fusee
