#include "transmission/table_law.h"

#include <Eigen/SparseLU>
#include <algorithm>

#include "fusee/base/diagnostics.h"

namespace fusee {
namespace {

using LawSpline = Eigen::Spline<double, 1>;

/// Control values so that the spline of `degree` over `knots` takes `values` at `places`: a banded system.
Eigen::VectorXd collocate(const LawSpline::KnotVectorType& places, const LawSpline::KnotVectorType& knots,
                          const Eigen::VectorXd& values, Eigen::Index degree) {
  const Eigen::Index count = places.size();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(count * (degree + 1)));
  for (Eigen::Index row = 0; row < count; ++row) {
    const Eigen::Index span = LawSpline::Span(places(row), degree, knots);
    const auto basis = LawSpline::BasisFunctions(places(row), degree, knots);
    for (Eigen::Index k = 0; k <= degree; ++k) entries.emplace_back(row, span - degree + k, basis(k));
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  demand(solver.info() == Eigen::Success, "collocation of a table law is singular");
  return solver.solve(values);
}

}  // namespace

Transmission::TableLaw::TableLaw(const std::vector<LawRow>& rows) {
  demand(rows.size() >= 2, "a table law needs two rows or more, not " + std::to_string(rows.size()));
  const auto count = static_cast<Eigen::Index>(rows.size());
  first_ = rows.front().alpha;
  span_ = rows.back().alpha - first_;
  LawSpline::KnotVectorType places(count);
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    places(i) = (rows[static_cast<std::size_t>(i)].alpha - first_) / span_;
    values(i) = rows[static_cast<std::size_t>(i)].theta;
  }
  places(count - 1) = 1.0;
  const Eigen::Index degree = std::min<Eigen::Index>(5, count - 1);
  LawSpline::KnotVectorType knots;
  Eigen::KnotAveraging(places, degree, knots);
  spline_ = LawSpline(knots, collocate(places, knots, values, degree).transpose());
}

LawValue Transmission::TableLaw::at(double alpha) const {
  const double place = (alpha - first_) / span_;
  const double inside = std::clamp(place, 0.0, 1.0);
  const auto values = spline_.derivatives(inside, 3);
  LawValue law{values(0, 0), values(0, 1) / span_, values(0, 2) / (span_ * span_), values(0, 3) / (span_ * span_ * span_)};
  const double beyond = (place - inside) * span_;
  if (beyond != 0) {
    law.theta += beyond * (law.d1 + beyond * (law.d2 / 2 + beyond * law.d3 / 6));
    law.d1 += beyond * (law.d2 + beyond * law.d3 / 2);
    law.d2 += beyond * law.d3;
  }
  return law;
}

}  // namespace fusee
