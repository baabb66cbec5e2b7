#include "transmission/table_law.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <unsupported/Eigen/Splines>

#include "fusee/base.h"

namespace fusee::transmission {
namespace {

using LawSpline = Eigen::Spline<double, 1>;

/// Control values for which the spline of `degree` over `knots` takes `values` at `places`: a banded system.
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

/// The spline through all rows, with places scaled to 0 … 1.
LawSpline interpolated(const std::vector<LawRow>& rows) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  const double first = rows.front().alpha;
  const double span = rows.back().alpha - first;
  LawSpline::KnotVectorType places(count);
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    places(i) = (rows[static_cast<std::size_t>(i)].alpha - first) / span;
    values(i) = rows[static_cast<std::size_t>(i)].theta;
  }
  places(count - 1) = 1.0;  // exactly, in spite of rounding
  const Eigen::Index degree = std::min<Eigen::Index>(5, count - 1);
  LawSpline::KnotVectorType knots;
  Eigen::KnotAveraging(places, degree, knots);
  return LawSpline(knots, collocate(places, knots, values, degree).transpose());
}

}  // namespace

// The spline is evaluated thousands of times, so each knot span is stored as its polynomial.
Transmission::TableLaw::TableLaw(const std::vector<LawRow>& rows) : last_(rows.empty() ? 0.0 : rows.back().alpha) {
  demand(rows.size() >= 2, "a table law needs two rows or more, not " + std::to_string(rows.size()));
  const double first = rows.front().alpha;
  const double span = last_ - first;
  const LawSpline spline = interpolated(rows);
  const Eigen::Index degree = spline.degree();
  for (Eigen::Index i = degree; i + degree + 1 < spline.knots().size(); ++i) {
    const double begin = spline.knots()(i);
    if (!(spline.knots()(i + 1) > begin)) continue;
    const auto derivatives = spline.derivatives(begin, degree);
    Piece piece{first + begin * span, {}};
    double factor = 1.0;  // 1 / (k! span^k)
    for (Eigen::Index k = 0; k <= degree; ++k) {
      piece.powers[static_cast<std::size_t>(k)] = derivatives(0, k) * factor;
      factor /= static_cast<double>(k + 1) * span;
    }
    pieces_.push_back(piece);
  }
}

std::vector<double> Transmission::TableLaw::breaks() const {
  std::vector<double> all;
  for (const Piece& piece : pieces_) all.push_back(piece.begin);
  return all;
}

LawValue Transmission::TableLaw::at(double alpha) const {
  const double inside = std::clamp(alpha, first_alpha(), last_alpha());
  const auto after = std::upper_bound(pieces_.begin() + 1, pieces_.end(), inside,
                                      [](double value, const Piece& piece) { return value < piece.begin; });
  const Piece& piece = *(after - 1);
  const double x = inside - piece.begin;
  LawValue law;
  for (std::size_t k = piece.powers.size(); k-- > 0;) {  // Horner's scheme for the value and its derivatives together
    law.d3 = law.d3 * x + 3.0 * law.d2;
    law.d2 = law.d2 * x + 2.0 * law.d1;
    law.d1 = law.d1 * x + law.theta;
    law.theta = law.theta * x + piece.powers[k];
  }
  // Beyond the ends, the Taylor polynomial of degree three.
  const double beyond = alpha - inside;
  if (beyond != 0) {
    law.theta += beyond * (law.d1 + beyond * (law.d2 / 2 + beyond * law.d3 / 6));
    law.d1 += beyond * (law.d2 + beyond * law.d3 / 2);
    law.d2 += beyond * law.d3;
  }
  return law;
}

}  // namespace fusee::transmission
