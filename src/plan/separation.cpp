#include "plan/separation.h"

#include <algorithm>
#include <cmath>

#include "base/decompositions.h"
#include "plan/thresholds.h"

namespace fusee::plan {
namespace {

/// The part of AᵀA between the columns of two causes.
Eigen::MatrixXd block(const Eigen::MatrixXd& squares, const Cause& one, const Cause& other) {
  return squares.block(one.first, other.first, one.count(), other.count());
}

/// Trace of the residual of a cause after the others are fitted to it, G_aa − G_az (prior + G_zz)⁻¹ G_za. Arguments:
/// G_aa, G_az, G_zz and the precision of the prior.
double residual_trace(const Eigen::MatrixXd& own, const Eigen::MatrixXd& shared, const Eigen::MatrixXd& others,
                      const Eigen::MatrixXd& precision) {
  if (others.size() == 0) return own.trace();
  const Eigen::MatrixXd explained = shared * solved(precision + others, Eigen::MatrixXd(shared.transpose()));
  return std::max(0.0, (own - explained).trace());
}

}  // namespace

Information Information::none(Eigen::Index columns) {
  return {Eigen::MatrixXd::Zero(columns, columns), Eigen::MatrixXd::Zero(columns, columns), 0};
}

Information Information::with(const Signatures::RunEquations& run) const {
  return {runs + run.squares, readings, rows + run.rows};
}
Information Information::with(const Eigen::MatrixXd& reading) const { return {runs, readings + reading, rows}; }

double usual_rms(const Information& known, const Cause& cause) {
  return known.rows > 0 ? std::sqrt(block(known.runs, cause, cause).trace() / known.rows) : 0.0;
}

double margin(const Signatures& signatures, const Information& known, const Cause& cause, const Cause* rival) {
  const Eigen::Index model_count = signatures.unmodelled_first() - signatures.model_first();
  const Eigen::Index rival_count = rival != nullptr ? rival->count() : 0;
  // Model error first, then the rival.
  Eigen::MatrixXd shared(cause.count(), model_count + rival_count);
  Eigen::MatrixXd others(model_count + rival_count, model_count + rival_count);
  shared.leftCols(model_count) = known.runs.block(cause.first, signatures.model_first(), cause.count(), model_count);
  others.topLeftCorner(model_count, model_count) =
      known.runs.block(signatures.model_first(), signatures.model_first(), model_count, model_count);
  Eigen::MatrixXd precision = Eigen::MatrixXd::Identity(model_count + rival_count, model_count + rival_count);
  if (rival != nullptr) {
    shared.rightCols(rival_count) = block(known.runs, cause, *rival);
    others.bottomRightCorner(rival_count, rival_count) = block(known.runs, *rival, *rival);
    others.topRightCorner(model_count, rival_count) =
        known.runs.block(signatures.model_first(), rival->first, model_count, rival_count);
    others.bottomLeftCorner(rival_count, model_count) = others.topRightCorner(model_count, rival_count).transpose();
    precision.bottomRightCorner(rival_count, rival_count) += block(known.readings, *rival, *rival);
  }
  const Eigen::MatrixXd own = block(known.runs, cause, cause);
  const double read = block(known.readings, cause, cause).trace();  // information of the cause's own hand measurements
  const double residual = residual_trace(own, shared, others, precision);
  const double beyond_noise = std::sqrt(residual + read) / k_plan.resolved_distance;
  const double by_reading = std::sqrt(read) / k_plan.resolved_distance;
  if (!(own.trace() > 0)) return by_reading;
  double beyond_model_accuracy = 1e9;
  if (rival != nullptr) {
    const double unexplained =
        residual_trace(own, shared.rightCols(rival_count), others.bottomRightCorner(rival_count, rival_count),
                       precision.bottomRightCorner(rival_count, rival_count));
    beyond_model_accuracy = std::sqrt(unexplained / own.trace()) / k_plan.model_share;
  }
  return std::max(std::min(beyond_noise, beyond_model_accuracy), by_reading);
}

}  // namespace fusee::plan
