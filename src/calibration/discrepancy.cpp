#include "calibration/discrepancy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "base/decompositions.h"
#include "calibration/row_facts.h"
#include "calibration/thresholds.h"
#include "measurement/value_range.h"

// A Gaussian process over place is represented by its eigenfunctions. Two length scales are combined, for smooth errors
// (a pin's radius) and local ones, and each has its own columns. All other factors multiply these functions: a
// direction, a load, a speed.

namespace fusee::calibration {
namespace {

/// Numbers of curves over the measured range: of place and direction, of their products with other factors, of those
/// with at most one bend, and of those on the short length scale. Each order of bends has an amplitude of its own, so
/// that an effect of one bend has no advantage over the discrepancy.
constexpr Eigen::Index k_smooth = 10;
constexpr Eigen::Index k_simple = 6;
constexpr Eigen::Index k_plain = 3;
constexpr Eigen::Index k_rough = 18;
/// Short length scale as a share of the span, and nodes of its kernel.
constexpr double k_short_scale = 0.06;
constexpr int k_nodes = 41;
/// Decay lengths behind a reversal as shares of the span: from a stiff drive's to a sheathed cable's.
constexpr std::array k_decay_lengths = {0.02, 0.06, 0.2};
/// Number of blocks up to which each has a constant: their cost grows with its cube.
constexpr std::size_t k_most_strokes = 48;

/// Orthonormal Legendre polynomials over the span: shapes with a number of bends, each equally likely.
Eigen::MatrixXd smooth_curves(const std::vector<RowFacts>& facts, Eigen::Index count) {
  Eigen::MatrixXd curves(static_cast<Eigen::Index>(facts.size()), count);
  for (Eigen::Index i = 0; i < curves.rows(); ++i) {
    const double u = 2.0 * facts[static_cast<std::size_t>(i)].place - 1.0;
    for (Eigen::Index k = 0; k < count; ++k)
      curves(i, k) = std::sqrt(2.0 * static_cast<double>(k) + 1.0) * std::legendre(static_cast<unsigned>(k), u);
  }
  return curves;
}

/// Eigenfunctions of a Gaussian process of a short length scale: φ φᵀ is its covariance. Local errors are equally
/// likely anywhere.
Eigen::MatrixXd rough_curves(const std::vector<RowFacts>& facts) {
  const auto kernel = [](double a, double b) {
    return elementary::exp(-0.5 * (a - b) * (a - b) / (k_short_scale * k_short_scale));
  };
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

  /// Adds a family, unless its columns are zero.
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

/// One column for each value of a key: `part` in the rows with that value, else 0.
Eigen::MatrixXd indicators(const std::vector<RowFacts>& facts, std::size_t RowFacts::*key, const Part& part) {
  std::map<std::size_t, Eigen::Index> place;
  for (const RowFacts& row : facts) place.try_emplace(row.*key, static_cast<Eigen::Index>(place.size()));
  Eigen::MatrixXd all =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(facts.size()), static_cast<Eigen::Index>(place.size()));
  for (std::size_t i = 0; i < facts.size(); ++i)
    all(static_cast<Eigen::Index>(i), place[facts[i].*key]) = part(facts[i]);
  return all;
}

/// The curves times `part`, one set for each run.
Eigen::MatrixXd curves_of_runs(const std::vector<RowFacts>& facts, const Eigen::MatrixXd& curves, const Part& part) {
  const Eigen::MatrixXd runs = indicators(facts, &RowFacts::run, part);
  Eigen::MatrixXd all(runs.rows(), runs.cols() * curves.cols());
  for (Eigen::Index k = 0; k < curves.cols(); ++k)
    all.middleCols(k * runs.cols(), runs.cols()) = curves.col(k).asDiagonal() * runs;
  return all;
}

/// Exponential decays behind a reversal.
Eigen::MatrixXd transients(const std::vector<RowFacts>& facts, const Part& part) {
  Eigen::MatrixXd all(static_cast<Eigen::Index>(facts.size()), static_cast<Eigen::Index>(k_decay_lengths.size()));
  for (std::size_t i = 0; i < facts.size(); ++i) {
    for (std::size_t k = 0; k < k_decay_lengths.size(); ++k)
      all(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          part(facts[i]) * elementary::exp(-facts[i].since / k_decay_lengths[k]);
  }
  return all;
}

/// True if a stroke's rows lie at many places. Constants of dwells at one place could explain any data.
bool strokes_span_places(const Evidence& evidence) {
  return std::none_of(evidence.measurement.runs.begin(), evidence.measurement.runs.end(),
                      measurement::is_from_point_to_point);
}

}  // namespace

Eigen::VectorXd sum_of_families(const Discrepancy& discrepancy, const Eigen::VectorXd& coefficients,
                                const std::function<bool(Factor)>& is_in) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(discrepancy.columns.rows());
  for (const Family& family : discrepancy.families) {
    if (is_in(family.factor))
      sum +=
          discrepancy.columns.middleCols(family.first, family.count) * coefficients.segment(family.first, family.count);
  }
  return sum;
}

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
  // Tendons go slack and stiffen. The effects of a joint declared by its ratio contain all of its behaviour under load.
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
  // A difference between states must exceed the scatter between runs of one state, which one run of each state does not
  // show.
  if (evidence.earlier && evidence.measurement.runs.size() > 2) {
    builder.add(Factor::run, curves_of_runs(facts, bent.middleCols(1, k_plain - 1), one));
    builder.add(Factor::run, curves_of_runs(facts, plain, direction));
  }
  builder.add(Factor::drift, indicators(facts, &RowFacts::run, [](const RowFacts& r) { return r.time; }));
  if (evidence.blocks.size() <= k_most_strokes && strokes_span_places(evidence))
    builder.add(Factor::stroke, indicators(facts, &RowFacts::block, one));
  const std::vector<Eigen::Index> rows = evidence.rows();
  // For a joint declared by its ratio the deflection is the load, as with a compliance of 1.
  if (deflection.size() > 0) {
    const Eigen::VectorXd used_deflection = deflection(rows);
    const Eigen::MatrixXd even = used_deflection.asDiagonal() * smooth;
    const Eigen::MatrixXd odd = column(facts, [](const RowFacts& r) { return r.direction; }).asDiagonal() * even;
    builder.add(Factor::model_error, even, k_thresholds.model_error);
    builder.add(Factor::model_error, odd, k_thresholds.model_error);
  }
  return std::move(builder).made();
}

}  // namespace fusee::calibration
