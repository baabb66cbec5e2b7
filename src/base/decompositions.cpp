#include "base/decompositions.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "fusee/base_elementary.h"

namespace fusee {

SymmetricEigen eigendecomposition(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

bool is_positive_definite(const Eigen::MatrixXd& A) { return A.llt().info() == Eigen::Success; }

Eigen::VectorXd solved(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) { return A.ldlt().solve(b); }
Eigen::MatrixXd solved(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A.ldlt().solve(B); }

Cholesky::Cholesky(const Eigen::MatrixXd& A) : factors_(A) {}
Eigen::MatrixXd Cholesky::lower() const { return factors_.matrixL(); }
double Cholesky::half_log_determinant() const {
  double sum = 0;
  for (const double pivot : factors_.matrixLLT().diagonal()) sum += elementary::log(pivot);
  return sum;
}
Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& b) const { return factors_.solve(b); }
Eigen::MatrixXd Cholesky::solve(const Eigen::MatrixXd& B) const { return factors_.solve(B); }

/// A⁻¹ = L⁻ᵀ L⁻¹: its diagonal holds the squared norms of the columns of L⁻¹. Column k of L⁻¹ is zero above row k.
/// Strips of columns leave out these zeros.
Eigen::VectorXd Cholesky::inverse_diagonal() const {
  constexpr Eigen::Index strip_width = 16;
  const Eigen::MatrixXd& L = factors_.matrixLLT();
  Eigen::VectorXd diagonal(L.rows());
  for (Eigen::Index first = 0; first < L.rows(); first += strip_width) {
    const Eigen::Index rows = L.rows() - first;
    const Eigen::Index count = std::min(strip_width, rows);
    Eigen::MatrixXd columns = Eigen::MatrixXd::Identity(rows, count);
    L.bottomRightCorner(rows, rows).triangularView<Eigen::Lower>().solveInPlace(columns);
    diagonal.segment(first, count) = columns.colwise().squaredNorm();
  }
  return diagonal;
}

LeastSquares::LeastSquares(const Eigen::MatrixXd& A) : factors_(A) {}
Eigen::VectorXd LeastSquares::nearest(const Eigen::VectorXd& b) const { return factors_.solve(b); }

}  // namespace fusee
