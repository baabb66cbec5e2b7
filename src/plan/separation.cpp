#include "plan/separation.h"

#include <algorithm>
#include <cmath>

#include "base/decompositions.h"
#include "plan/thresholds.h"

namespace fusee::plan {
namespace {

Eigen::MatrixXd block(const Eigen::MatrixXd& squares, const Cause& one, const Cause& other) {
  return squares.block(one.first, other.first, one.count(), other.count());
}

/// Trace of the residual of a cause after the others are fitted to it: G_aa − G_az (prior + G_zz)⁻¹ G_za.
double residual_trace(const Eigen::MatrixXd& own, const Eigen::MatrixXd& shared, const Eigen::MatrixXd& others,
                      const Eigen::MatrixXd& precision) {
  if (others.size() == 0) return own.trace();
  const Eigen::MatrixXd taken = shared * solved(precision + others, Eigen::MatrixXd(shared.transpose()));
  return std::max(0.0, (own - taken).trace());
}

}  // namespace

Information Information::none(Eigen::Index columns) {
  return {Eigen::MatrixXd::Zero(columns, columns), Eigen::MatrixXd::Zero(columns, columns), 0};
}

Information Information::with(const Signatures::RunEquations& seen) const {
  return {runs + seen.squares, readings, rows + seen.rows};
}
Information Information::with(const Eigen::MatrixXd& reading) const { return {runs, readings + reading, rows}; }

double usual_rms(const Information& known, const Cause& cause) {
  return known.rows > 0 ? std::sqrt(block(known.runs, cause, cause).trace() / known.rows) : 0.0;
}

double margin(const Signatures& signatures, const Information& known, const Cause& cause, const Cause* rival) {
  const Eigen::Index model = signatures.unmodelled_first() - signatures.model_first();
  const Eigen::Index beside = rival != nullptr ? rival->count() : 0;
  // Model error first, then the rival.
  Eigen::MatrixXd shared(cause.count(), model + beside);
  Eigen::MatrixXd others(model + beside, model + beside);
  shared.leftCols(model) = known.runs.block(cause.first, signatures.model_first(), cause.count(), model);
  others.topLeftCorner(model, model) =
      known.runs.block(signatures.model_first(), signatures.model_first(), model, model);
  Eigen::MatrixXd precision = Eigen::MatrixXd::Identity(model + beside, model + beside);
  if (rival != nullptr) {
    shared.rightCols(beside) = block(known.runs, cause, *rival);
    others.bottomRightCorner(beside, beside) = block(known.runs, *rival, *rival);
    others.topRightCorner(model, beside) = known.runs.block(signatures.model_first(), rival->first, model, beside);
    others.bottomLeftCorner(beside, model) = others.topRightCorner(model, beside).transpose();
    precision.bottomRightCorner(beside, beside) += block(known.readings, *rival, *rival);
  }
  const Eigen::MatrixXd own = block(known.runs, cause, cause);
  const double read = block(known.readings, cause, cause).trace();
  const double residual = residual_trace(own, shared, others, precision);
  const double beyond_noise = std::sqrt(residual + read) / k_plan.resolved_distance;
  if (!(own.trace() > 0)) return std::sqrt(read) / k_plan.resolved_distance;
  double trusted = 1e9;
  if (rival != nullptr) {
    const double rest = residual_trace(own, shared.rightCols(beside), others.bottomRightCorner(beside, beside),
                                       precision.bottomRightCorner(beside, beside));
    trusted = std::sqrt(rest / own.trace()) / k_plan.model_share;
  }
  return std::max(std::min(beyond_noise, trusted), std::sqrt(read) / k_plan.resolved_distance);
}

}  // namespace fusee::plan
