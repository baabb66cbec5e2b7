#include "calibration/discrepancy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "base/decompositions.h"
#include "calibration/row_facts.h"
#include "calibration/thresholds.h"
#include "measurement/seen_span.h"

// A Gaussian process over place of one length is its eigenfunctions: smooth ones with much of the variance, wrigglier
// ones with less. Two lengths stand beside each other, so that what is bent like a pin's radius and what is bent like a
// lump are both described, and each pays for its own columns alone. Everything else is these functions times what the
// runs vary: a direction, a load, a speed.

namespace fusee {
namespace {

/// Curves over the seen span: of place and direction, of what else they are multiplied by, those of no more than one
/// bend, and those that bend most. Each order of bends has an amplitude of its own: what is bent once is no cheaper by
/// a name than without.
constexpr Eigen::Index k_smooth = 10;
constexpr Eigen::Index k_simple = 6;
constexpr Eigen::Index k_plain = 3;
constexpr Eigen::Index k_rough = 18;
/// Share of the span over which the latter bend, and places at which they are known.
constexpr double k_bend = 0.06;
constexpr int k_nodes = 41;
/// Ways over which what a reversal leaves dies away, of the span: from a stiff drive's to a sheathed cable's.
constexpr std::array k_ways = {0.02, 0.06, 0.2};

/// Legendre's polynomials over the span, orthonormal: any shape of so many bends, each as likely.
Eigen::MatrixXd smooth_curves(const std::vector<RowFacts>& facts, Eigen::Index count) {
  Eigen::MatrixXd curves(static_cast<Eigen::Index>(facts.size()), count);
  for (Eigen::Index i = 0; i < curves.rows(); ++i) {
    const double u = 2.0 * facts[static_cast<std::size_t>(i)].place - 1.0;
    for (Eigen::Index k = 0; k < count; ++k)
      curves(i, k) = std::sqrt(2.0 * static_cast<double>(k) + 1.0) * std::legendre(static_cast<unsigned>(k), u);
  }
  return curves;
}

/// Eigenfunctions of a Gaussian process that bends over a small part of the span: φ φᵀ is its covariance. A lump
/// anywhere is as likely as any.
Eigen::MatrixXd rough_curves(const std::vector<RowFacts>& facts) {
  const auto kernel = [](double a, double b) { return std::exp(-0.5 * (a - b) * (a - b) / (k_bend * k_bend)); };
  const auto node = [](Eigen::Index i) { return static_cast<double>(i) / (k_nodes - 1); };
  Eigen::MatrixXd K(k_nodes, k_nodes);
  for (Eigen::Index i = 0; i < k_nodes; ++i) {
    for (Eigen::Index j = 0; j < k_nodes; ++j) K(i, j) = kernel(node(i), node(j));
  }
  const SymmetricEigen eigen = eigendecomposition(K);
  Eigen::MatrixXd at_rows(static_cast<Eigen::Index>(facts.size()), k_nodes);
  for (Eigen::Index i = 0; i < at_rows.rows(); ++i) {
    for (Eigen::Index j = 0; j < k_nodes; ++j)
      at_rows(i, j) = kernel(facts[static_cast<std::size_t>(i)].place, node(j));
  }
  const Eigen::VectorXd size = eigen.values.tail(k_rough).cwiseSqrt().cwiseInverse();
  return at_rows * eigen.vectors.rightCols(k_rough) * size.asDiagonal();
}

class Builder {
 public:
  explicit Builder(Eigen::Index rows) : rows_(rows) {}

  /// Nothing where the columns are nothing.
  void add(Factor factor, const Eigen::MatrixXd& columns, double fixed = 0) {
    const double square = columns.squaredNorm() / static_cast<double>(rows_);
    if (!(square > 1e-12)) return;
    made_.families.push_back(
        {factor, made_.columns.cols(), columns.cols(), fixed > 0 ? fixed * std::sqrt(square) : 0.0});
    Eigen::MatrixXd all(rows_, made_.columns.cols() + columns.cols());
    if (made_.columns.cols() > 0) all.leftCols(made_.columns.cols()) = made_.columns;
    all.rightCols(columns.cols()) = columns / std::sqrt(square);
    made_.columns = std::move(all);
  }

  Discrepancy made() && { return std::move(made_); }

 private:
  Eigen::Index rows_;
  Discrepancy made_;
};

using Part = std::function<double(const RowFacts&)>;

Eigen::VectorXd column(const std::vector<RowFacts>& facts, const Part& part) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(facts.size()));
  for (Eigen::Index i = 0; i < all.size(); ++i) all[i] = part(facts[static_cast<std::size_t>(i)]);
  return all;
}

/// One column for each value of a key, about their common mean.
Eigen::MatrixXd indicators(const std::vector<RowFacts>& facts, std::size_t RowFacts::*key, const Part& part) {
  std::map<std::size_t, Eigen::Index> place;
  for (const RowFacts& row : facts) place.try_emplace(row.*key, static_cast<Eigen::Index>(place.size()));
  Eigen::MatrixXd all =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(facts.size()), static_cast<Eigen::Index>(place.size()));
  for (std::size_t i = 0; i < facts.size(); ++i)
    all(static_cast<Eigen::Index>(i), place[facts[i].*key]) = part(facts[i]);
  return all;
}

/// The curves times `part`, of each run its own.
Eigen::MatrixXd curves_of_runs(const std::vector<RowFacts>& facts, const Eigen::MatrixXd& curves, const Part& part) {
  const Eigen::MatrixXd runs = indicators(facts, &RowFacts::run, part);
  Eigen::MatrixXd all(runs.rows(), runs.cols() * curves.cols());
  for (Eigen::Index k = 0; k < curves.cols(); ++k)
    all.middleCols(k * runs.cols(), runs.cols()) = curves.col(k).asDiagonal() * runs;
  return all;
}

/// What dies away behind a reversal.
Eigen::MatrixXd transients(const std::vector<RowFacts>& facts, const Part& part) {
  Eigen::MatrixXd all(static_cast<Eigen::Index>(facts.size()), static_cast<Eigen::Index>(k_ways.size()));
  for (std::size_t i = 0; i < facts.size(); ++i) {
    for (std::size_t k = 0; k < k_ways.size(); ++k)
      all(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          part(facts[i]) * std::exp(-facts[i].since / k_ways[k]);
  }
  return all;
}

/// Whether a stroke's rows lie at many places. A constant of each stand at one place is any data whatever.
bool strokes_span_places(const Evidence& evidence) {
  return std::none_of(evidence.measurement.runs.begin(), evidence.measurement.runs.end(), is_from_point_to_point);
}

}  // namespace

Discrepancy discrepancy_of(const Evidence& evidence, const Eigen::VectorXd& deflection) {
  const std::vector<RowFacts> facts = row_facts(evidence);
  Builder builder(static_cast<Eigen::Index>(facts.size()));
  if (facts.empty()) return std::move(builder).made();
  const Eigen::MatrixXd bent = smooth_curves(facts, k_smooth);
  const Eigen::MatrixXd smooth = bent.leftCols(k_simple);
  const Eigen::MatrixXd rough = rough_curves(facts);
  const auto times = [&](const Part& part, const Eigen::MatrixXd& curve) -> Eigen::MatrixXd {
    return column(facts, part).asDiagonal() * curve;
  };
  const Eigen::MatrixXd plain = bent.leftCols(k_plain), more = bent.middleCols(k_plain, k_simple - k_plain),
                        most = bent.rightCols(k_smooth - k_simple);
  const auto direction = [](const RowFacts& r) { return r.direction; };
  builder.add(Factor::place, plain);
  builder.add(Factor::place, more);
  builder.add(Factor::place, most);
  builder.add(Factor::place, rough);
  builder.add(Factor::direction, times(direction, plain));
  builder.add(Factor::direction, times(direction, more));
  builder.add(Factor::direction, times(direction, most));
  builder.add(Factor::direction, times(direction, rough));
  builder.add(Factor::reversal, transients(facts, direction));
  if (varies(facts, &RowFacts::load, 0.05)) {
    builder.add(Factor::load, times([](const RowFacts& r) { return r.load; }, smooth));
    builder.add(Factor::load_size, times([](const RowFacts& r) { return std::abs(r.load); }, smooth));
    builder.add(Factor::load_direction,
                times([](const RowFacts& r) { return std::abs(r.load) * r.direction; }, smooth));
  }
  // Tendons go slack and stiffen. What a joint declared by its ratio does under load is all in its effects.
  if (varies(facts, &RowFacts::load, 0.05) && !evidence.declared->transmission) {
    builder.add(Factor::load,
                times([](const RowFacts& r) { return 2.5 * r.load * r.load * r.load - 1.5 * r.load; }, plain));
    builder.add(Factor::load_size, times([](const RowFacts& r) { return 1.5 * r.load * r.load - 0.5; }, plain));
    builder.add(Factor::load_direction, times([](const RowFacts& r) { return r.load * r.direction; }, plain));
    builder.add(Factor::reversal, transients(facts, [](const RowFacts& r) { return std::abs(r.load) * r.direction; }));
  }
  if (varies(facts, &RowFacts::speed, 0.1)) {
    builder.add(Factor::speed, times([](const RowFacts& r) { return r.speed; }, smooth));
    builder.add(Factor::speed_direction, times([](const RowFacts& r) { return r.speed * r.direction; }, smooth));
  }
  const auto one = [](const RowFacts&) { return 1.0; };
  if (evidence.measurement.runs.size() > 1) builder.add(Factor::run, indicators(facts, &RowFacts::run, one));
  // A difference between states must exceed the scatter between runs of one state. One run each does not show it.
  if (evidence.earlier && evidence.measurement.runs.size() > 2) {
    builder.add(Factor::run, curves_of_runs(facts, bent.middleCols(1, k_plain - 1), one));
    builder.add(Factor::run, curves_of_runs(facts, plain, direction));
  }
  builder.add(Factor::drift, indicators(facts, &RowFacts::run, [](const RowFacts& r) { return r.time; }));
  if (evidence.blocks.size() <= k_thresholds.most_strokes && strokes_span_places(evidence))
    builder.add(Factor::stroke, indicators(facts, &RowFacts::block, one));
  const std::vector<Eigen::Index> rows = evidence.rows();
  if (deflection.size() > 0) {  // of a joint declared by a ratio: what a unit of load does to one of compliance 1
    const Eigen::VectorXd yielding = deflection(rows);
    const Eigen::MatrixXd even = yielding.asDiagonal() * smooth;
    const Eigen::MatrixXd odd = column(facts, [](const RowFacts& r) { return r.direction; }).asDiagonal() * even;
    builder.add(Factor::model_error, even, k_thresholds.trusted);
    builder.add(Factor::model_error, odd, k_thresholds.trusted);
  }
  return std::move(builder).made();
}

}  // namespace fusee
