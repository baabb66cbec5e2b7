#include "base/decompositions.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace fusee {
namespace {

/// A matrix without structure, equal on every machine.
Eigen::MatrixXd dense_matrix(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j)
      matrix(i, j) = std::sin(1.0 + 3.7 * static_cast<double>(i * columns + j) + static_cast<double>(i * j));
  }
  return matrix;
}

Eigen::MatrixXd definite_matrix(Eigen::Index size) {
  const Eigen::MatrixXd root = dense_matrix(size, size);
  return root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(size, size);
}

// The largest size exceeds a block of Eigen's algorithms, which handle small matrices separately.
class Decompositions : public testing::TestWithParam<Eigen::Index> {};

TEST_P(Decompositions, EigenvectorsReproduceMatrix) {
  const Eigen::MatrixXd A = definite_matrix(GetParam());
  const SymmetricEigen eigen = eigendecomposition(A);
  EXPECT_LT((A * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-11 * A.norm());
  EXPECT_LT((eigen.vectors.transpose() * eigen.vectors - Eigen::MatrixXd::Identity(A.rows(), A.rows())).norm(), 1e-11);
  for (Eigen::Index k = 1; k < A.rows(); ++k) EXPECT_LE(eigen.values[k - 1], eigen.values[k]);
}

TEST_P(Decompositions, DetectPositiveDefiniteness) {
  const Eigen::MatrixXd A = definite_matrix(GetParam()), identity = Eigen::MatrixXd::Identity(A.rows(), A.cols());
  const double least = eigendecomposition(A).values[0];
  EXPECT_TRUE(is_positive_definite(A));
  EXPECT_TRUE(is_positive_definite(A - 0.999 * least * identity));
  EXPECT_FALSE(is_positive_definite(A - 1.001 * least * identity));
  EXPECT_FALSE(is_positive_definite(-A));
}

TEST_P(Decompositions, SolutionsSatisfyEquations) {
  const Eigen::MatrixXd A = definite_matrix(GetParam()), X = dense_matrix(GetParam(), 3);
  EXPECT_LT((solved(A, Eigen::MatrixXd(A * X)) - X).norm(), 1e-9 * X.norm());
  EXPECT_LT((solved(A, Eigen::VectorXd(A * X.col(1))) - X.col(1)).norm(), 1e-9 * X.norm());
}

TEST_P(Decompositions, LeastSquaresResidualIsOrthogonal) {
  const Eigen::MatrixXd A = dense_matrix(2 * GetParam(), GetParam());
  const Eigen::VectorXd b = dense_matrix(2 * GetParam(), 1).col(0).array().cos();
  const Eigen::VectorXd residual = b - A * LeastSquares(A).nearest(b);
  EXPECT_LT((A.transpose() * residual).norm(), 1e-10 * b.norm() * A.norm());
  EXPECT_GT(residual.norm(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Decompositions, testing::Values(2, 9, 70));

}  // namespace
}  // namespace fusee
