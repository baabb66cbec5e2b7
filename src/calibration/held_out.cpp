#include "calibration/held_out.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/decompositions.h"
#include "calibration/discrepancy_fit.h"
#include "calibration/fit.h"

namespace fusee::calibration {
namespace {

double reading_of(const HandReading& reading, const Evidence& evidence, const Imperfections& at) {
  return reading_by_hand(*reading.parameter, at, *evidence.declared);
}

/// d(reading)/dx, by a step of each number.
Eigen::VectorXd slopes_of(const HandReading& reading, const Evidence& evidence, const Fit& fit) {
  Eigen::VectorXd slopes(fit.x.size());
  const double here = reading_of(reading, evidence, fit.at);
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    Imperfections moved = fit.at;
    set_value(moved, *fit.parameters[k], value_of(fit.at, *fit.parameters[k]) + fit.parameters[k]->step);
    slopes[static_cast<Eigen::Index>(k)] = reading_of(reading, evidence, moved) - here;
  }
  return slopes;
}

void add_row(const Fit& fit, Eigen::Index row, double floor, NormalEquations& normal) {
  for (Eigen::Index k = 0; k < fit.x.size(); ++k) {
    for (Eigen::Index i = 0; i < fit.x.size(); ++i) normal.JJ(i, k) += fit.J(row, i) * fit.J(row, k);
    normal.Jr[k] += fit.J(row, k) * fit.residual[row];
  }
  normal.rr += fit.residual[row] * fit.residual[row] + play_correction(fit.loose[row], floor);
  normal.rows += 1;
}

}  // namespace

NormalEquations NormalEquations::none(Eigen::Index parameters) {
  return {Eigen::MatrixXd::Zero(parameters, parameters), Eigen::VectorXd::Zero(parameters), 0, 0};
}

NormalEquations& NormalEquations::operator+=(const NormalEquations& other) {
  JJ += other.JJ;
  Jr += other.Jr;
  return *this;
}

NormalEquations& NormalEquations::operator-=(const NormalEquations& other) {
  JJ -= other.JJ;
  Jr -= other.Jr;
  return *this;
}

Eigen::VectorXd least_squares_step(const NormalEquations& normal, const Eigen::VectorXd& x, double ridge) {
  if (normal.empty()) return {};
  const Eigen::MatrixXd A = normal.JJ + ridge * Eigen::MatrixXd::Identity(normal.JJ.rows(), normal.JJ.cols());
  return solved(A, Eigen::VectorXd(normal.Jr - ridge * x));
}

NormalEquations sums_of(const Block& block, const Fit& fit, double floor) {
  NormalEquations sums = NormalEquations::none(fit.x.size());
  for (const std::size_t row : block.rows) add_row(fit, static_cast<Eigen::Index>(row), floor, sums);
  return sums;
}

NormalEquations sums_of_readings(const Evidence& evidence, const Fit& fit) {
  NormalEquations sums = NormalEquations::none(fit.x.size());
  for (const HandReading& reading : evidence.readings) {
    const double scale = evidence.floor / reading.uncertainty;
    const Eigen::VectorXd slopes = scale * slopes_of(reading, evidence, fit);
    sums.JJ.noalias() += slopes * slopes.transpose();
    sums.Jr += slopes * scale * (reading.value - reading_of(reading, evidence, fit.at));
  }
  return sums;
}

double caliper_chi2(const Evidence& evidence, const Imperfections& at) {
  double squares = 0;
  for (const HandReading& reading : evidence.readings)
    squares += elementary::pow((reading.value - reading_of(reading, evidence, at)) / reading.uncertainty, 2);
  return squares;
}

NormalEquations sums_of_all(const Evidence& evidence, const Fit& fit) {
  NormalEquations normal = fit.readings;
  for (const Eigen::Index row : evidence.rows()) add_row(fit, row, evidence.floor, normal);
  return normal;
}

bool is_finite(const Evidence& evidence, const Fit& fit) {
  for (const Eigen::Index row : evidence.rows()) {
    if (!std::isfinite(fit.residual[row])) return false;
    for (Eigen::Index k = 0; k < fit.x.size(); ++k) {
      if (!std::isfinite(fit.J(row, k))) return false;
    }
  }
  return true;
}

namespace {

/// Share of the information in each direction that must remain without a fold (a delay beside play is determined by the
/// one fast run).
constexpr double k_least_known = 0.03;

/// True if the blocks outside a fold determine every direction that all of them determine: rest − k all is positive
/// definite, scaled to unit diagonal.
bool can_do_without(const Eigen::MatrixXd& remaining, const Eigen::MatrixXd& all) {
  if (all.rows() == 0) return true;
  const Eigen::VectorXd size = all.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = size.asDiagonal() * all * size.asDiagonal();
  const Eigen::MatrixXd part = size.asDiagonal() * remaining * size.asDiagonal();
  const Eigen::MatrixXd ridge = 1e-9 * Eigen::MatrixXd::Identity(all.rows(), all.cols());
  return is_positive_definite(part + ridge - k_least_known * (scaled + ridge));
}

/// Sums of each block and of caliper readings at the fit.
struct FitSums {
  std::vector<NormalEquations> sums;
  NormalEquations all;
  Eigen::VectorXd x;
  Eigen::Index named = 0;  ///< number of effect parameters: the first of x
};

/// Parameters that take part in a prediction: 1, or 0.
using Mask = Eigen::VectorXd;

class Folds {
 public:
  /// One prediction for each mask.
  Folds(const FitSums& fitted, double floor, std::vector<Mask> masks)
      : fitted_(fitted),
        ridge_(wide_prior(floor)),
        masks_(std::move(masks)),
        error_(masks_.size(), std::vector<double>(fitted.sums.size(), 0.0)),
        times_(fitted.sums.size(), 0) {}

  void leave_out(const Fold& fold) {
    const NormalEquations remaining = without(fold);
    if (is_enough(remaining)) return add_errors(fold, remaining);
    for (const std::size_t block : fold) add_errors({block}, without({block}));
  }

  /// Step of the effects' parameters to the fit of the other blocks; zero if these do not determine them.
  Eigen::VectorXd step_without(const Fold& fold) const {
    const NormalEquations remaining = without(fold);
    if (!is_enough(remaining)) return Eigen::VectorXd::Zero(fitted_.named);
    return least_squares_step(remaining, fitted_.x, ridge_).head(fitted_.named);
  }

  /// `else_square`: the result if nothing is held out.
  HeldOut errors(std::size_t mask, double else_square) const {
    HeldOut held;
    double rows = 0;
    double squares = 0;
    for (std::size_t b = 0; b < times_.size(); ++b) {
      held.by_block.push_back(times_[b] > 0 ? error_[mask][b] / times_[b] : std::numeric_limits<double>::quiet_NaN());
      if (times_[b] == 0) continue;
      rows += fitted_.sums[b].rows;
      squares += fitted_.sums[b].rows * held.by_block[b];
    }
    held.mean_square = rows > 0 ? squares / rows : else_square;
    return held;
  }

 private:
  NormalEquations without(const Fold& fold) const {
    NormalEquations remaining = fitted_.all;
    for (const std::size_t block : fold) remaining -= fitted_.sums[block];
    return remaining;
  }

  bool is_enough(const NormalEquations& remaining) const {
    const auto known = [this](const NormalEquations& sums) {
      return sums.JJ.topLeftCorner(fitted_.named, fitted_.named);
    };
    return can_do_without(known(remaining), known(fitted_.all));
  }

  void add_errors(const Fold& fold, const NormalEquations& remaining) {
    const Eigen::VectorXd step = least_squares_step(remaining, fitted_.x, ridge_);
    for (const std::size_t block : fold) {
      const NormalEquations& sums = fitted_.sums[block];
      for (std::size_t mask = 0; mask < masks_.size(); ++mask)
        error_[mask][block] += std::max(0.0, sums.squares_after(masks_[mask].cwiseProduct(step))) / sums.rows;
      ++times_[block];
    }
  }

  const FitSums& fitted_;
  double ridge_;
  std::vector<Mask> masks_;
  std::vector<std::vector<double>> error_;  ///< errors by mask and block
  std::vector<int> times_;
};

FitSums effects_alone(const Fit& fit) {
  FitSums fitted{fit.sums, fit.readings, fit.x, fit.x.size()};
  for (const NormalEquations& sums : fit.sums) fitted.all += sums;
  return fitted;
}

// ---- discrepancy beside the effects ---------------------------------------------------------------------------------

/// Columns of the discrepancy in use, scaled so that the wide prior of their coefficients is the prior with the fitted
/// amplitudes.
struct ScaledColumns {
  std::vector<Eigen::Index> columns;
  std::vector<double> size;
  std::vector<bool> of_place;  ///< true for factors of place and direction
};

ScaledColumns scaled(const Evidence& evidence, const Amplitudes& amplitudes) {
  const EvidenceModel& evidence_model = *evidence.evidence_model;
  const double unit = std::sqrt(wide_prior(evidence.floor) * evidence_model.independent_share()) / amplitudes.noise;
  ScaledColumns used;
  const std::vector<Family>& families = evidence_model.discrepancy().families;
  for (std::size_t f = 0; f < families.size(); ++f) {
    const double amplitude = amplitudes.families[static_cast<Eigen::Index>(f)];
    for (Eigen::Index k = 0; amplitude > 0 && k < families[f].count; ++k) {
      used.columns.push_back(families[f].first + k);
      used.size.push_back(amplitude * unit);
      used.of_place.push_back(is_of_place(families[f].factor));
    }
  }
  return used;
}

/// Normal equations of effects and discrepancy together.
FitSums effects_beside(const Evidence& evidence, const Fit& fit, const ScaledColumns& used) {
  const auto more = static_cast<Eigen::Index>(used.columns.size());
  FitSums fitted;
  fitted.named = fit.x.size();
  fitted.x = Eigen::VectorXd::Zero(fitted.named + more);
  fitted.x.head(fitted.named) = fit.x;
  fitted.all = NormalEquations::none(fitted.x.size());
  fitted.all.JJ.topLeftCorner(fitted.named, fitted.named) = fit.readings.JJ;
  fitted.all.Jr.head(fitted.named) = fit.readings.Jr;
  const Eigen::MatrixXd& columns = evidence.evidence_model->discrepancy().columns;
  const Eigen::Map<const Eigen::VectorXd> size(used.size.data(), more);
  Eigen::Index first = 0;  // row among the rows in use
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b) {
    const std::vector<std::size_t>& rows = evidence.blocks[b].rows;
    const auto count = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd J(count, fitted.x.size());
    Eigen::VectorXd r(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto row = static_cast<Eigen::Index>(rows[static_cast<std::size_t>(i)]);
      if (fitted.named > 0) J.row(i).head(fitted.named) = fit.J.row(row);
      r[i] = fit.residual[row];
    }
    J.rightCols(more) = columns.middleRows(first, count)(Eigen::all, used.columns) * size.asDiagonal();
    first += count;
    fitted.sums.push_back({J.transpose() * J, J.transpose() * r, r.squaredNorm(), static_cast<double>(count)});
    fitted.all += fitted.sums.back();
  }
  return fitted;
}

}  // namespace

HeldOut hold_out(const Evidence& evidence, const Fit& fit, const std::vector<Fold>& folds) {
  const FitSums fitted = effects_alone(fit);
  Folds held(fitted, evidence.floor, {Mask::Ones(fit.x.size())});
  for (const Fold& fold : folds) held.leave_out(fold);
  return held.errors(0, fit.mean_square);
}

std::vector<Eigen::VectorXd> numbers_without(const Evidence& evidence, const Fit& fit, const Amplitudes* beside,
                                             const std::vector<Fold>& folds) {
  const FitSums fitted =
      beside != nullptr ? effects_beside(evidence, fit, scaled(evidence, *beside)) : effects_alone(fit);
  const Folds held(fitted, evidence.floor, {});
  std::vector<Eigen::VectorXd> numbers;
  for (const Fold& fold : folds) numbers.push_back(fit.x + held.step_without(fold));
  return numbers;
}

HeldOutWithDiscrepancy hold_out_with_discrepancy(const Evidence& evidence, const Fit& fit, const Amplitudes& amplitudes,
                                                 const std::vector<Fold>& folds) {
  const ScaledColumns used = scaled(evidence, amplitudes);
  const FitSums fitted = effects_beside(evidence, fit, used);
  Mask effects = Mask::Zero(fitted.x.size());
  effects.head(fitted.named).setOnes();
  Mask with_place = effects;
  for (std::size_t k = 0; k < used.of_place.size(); ++k)
    with_place[fitted.named + static_cast<Eigen::Index>(k)] = used.of_place[k] ? 1.0 : 0.0;
  Folds held(fitted, evidence.floor, {effects, with_place, Mask::Ones(fitted.x.size())});
  for (const Fold& fold : folds) held.leave_out(fold);
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  return {held.errors(0, nothing), held.errors(1, nothing), held.errors(2, nothing)};
}

}  // namespace fusee::calibration
