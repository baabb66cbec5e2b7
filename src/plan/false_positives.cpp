#include "plan/false_positives.h"

#include <algorithm>
#include <cmath>

#include "base/decompositions.h"
#include "base/normal_numbers.h"
#include "plan/thresholds.h"

// A data set y = A x + noise enters the evidence only through z = Aᵀy. With G = AᵀA, summed over runs and readings, z
// is G x plus a normal vector of covariance G. The log evidence of the columns Z, each scaled by the standard deviation
// of its normal prior, is
//   ½ z_Zᵀ (I + G_ZZ)⁻¹ z_Z − ½ log det (I + G_ZZ).
// An explanation is one cause plus model error. Its alternatives are the other causes, model error alone, and an
// unmodelled cause at several sizes. The unmodelled cause has any smooth shape over the range, and may depend on
// direction, load and speed.

namespace fusee::plan {
namespace {

/// Sizes of an unmodelled cause, deg at the joint.
constexpr double k_unmodelled_sizes[] = {0.02, 0.05, 0.15, 0.5};

/// Lower than any log evidence.
constexpr double k_no_evidence = -1e300;

/// Log evidence of a set of columns; its matrix is factored once.
class Explanation {
 public:
  /// `sizes`: standard deviation of the prior of each column.
  Explanation(const Information& known, std::vector<Eigen::Index> columns, const Eigen::VectorXd& sizes)
      : columns_(std::move(columns)), sizes_(sizes) {
    const auto count = static_cast<Eigen::Index>(columns_.size());
    Eigen::MatrixXd M(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j < count; ++j) {
        const auto a = columns_[static_cast<std::size_t>(i)], b = columns_[static_cast<std::size_t>(j)];
        M(i, j) = sizes_[i] * sizes_[j] * (known.runs(a, b) + known.readings(a, b)) + (i == j ? 1.0 : 0.0);
      }
    }
    factor_ = Cholesky(M);
    half_log_determinant_ = factor_.half_log_determinant();
  }

  double evidence(const Eigen::VectorXd& z) const {
    Eigen::VectorXd scaled(sizes_.size());
    for (Eigen::Index i = 0; i < scaled.size(); ++i) scaled[i] = sizes_[i] * z[columns_[static_cast<std::size_t>(i)]];
    return 0.5 * scaled.dot(factor_.solve(scaled)) - half_log_determinant_;
  }

 private:
  std::vector<Eigen::Index> columns_;
  Eigen::VectorXd sizes_;
  Cholesky factor_;
  double half_log_determinant_ = 0;
};

/// The columns from … to − 1.
std::vector<Eigen::Index> columns_between(Eigen::Index from, Eigen::Index to) {
  std::vector<Eigen::Index> all;
  for (Eigen::Index i = from; i < to; ++i) all.push_back(i);
  return all;
}

/// Draws data sets, and selects the cause that explains one best.
class CauseSelector {
 public:
  CauseSelector(const Signatures& signatures, const Information& known, const std::vector<Cause>& causes)
      : known_(known), causes_(causes), columns_(signatures.columns()) {
    const std::vector<Eigen::Index> model = columns_between(signatures.model_first(), signatures.unmodelled_first());
    const auto with_model_error = [&](Eigen::Index first, Eigen::Index count, double size) {
      std::vector<Eigen::Index> all = model;
      const std::vector<Eigen::Index> own = columns_between(first, first + count);
      all.insert(all.end(), own.begin(), own.end());
      Eigen::VectorXd sizes = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(all.size()), size);
      sizes.head(static_cast<Eigen::Index>(model.size())).setOnes();
      return Explanation(known, all, sizes);
    };
    for (const Cause& cause : causes) explanations_.push_back(with_model_error(cause.first, cause.count(), 1.0));
    unmodelled_.push_back(with_model_error(0, 0, 1.0));
    for (const double size : k_unmodelled_sizes)
      unmodelled_.push_back(
          with_model_error(signatures.unmodelled_first(), signatures.columns() - signatures.unmodelled_first(), size));
    // With G = V Λ Vᵀ, V √Λ is a square root of G. Rounding makes some eigenvalues slightly negative.
    const SymmetricEigen eigen = eigendecomposition(known.runs + known.readings);
    noise_ = eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
    model_first_ = signatures.model_first();
    model_count_ = static_cast<Eigen::Index>(model.size());
  }

  /// Draws z of a data set with the given cause, or with none if null.
  Eigen::VectorXd drawn(const Cause* cause, NormalNumbers& numbers) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(columns_);
    for (Eigen::Index i = 0; i < model_count_; ++i) x[model_first_ + i] = numbers.next();
    for (Eigen::Index i = 0; cause != nullptr && i < cause->count(); ++i) {
      const double size = numbers.next();
      const bool one_sided = cause->numbers[static_cast<std::size_t>(i)]->least >= 0;
      x[cause->first + i] = one_sided ? std::abs(size) : size;
    }
    Eigen::VectorXd noise(columns_);
    for (Eigen::Index i = 0; i < columns_; ++i) noise[i] = numbers.next();
    return (known_.runs + known_.readings) * x + noise_ * noise;
  }

  /// Indices of the causes that are reported together: the likeliest, and all within k_plan.odds of it. None if the
  /// likeliest does not exceed every unmodelled explanation by k_plan.odds. `without`: a cause that is removed from the
  /// catalogue, or null.
  std::vector<std::size_t> reported(const Eigen::VectorXd& z, const Cause* without) const {
    double unmodelled = k_no_evidence;
    for (const Explanation& explanation : unmodelled_) unmodelled = std::max(unmodelled, explanation.evidence(z));
    std::vector<double> evidence;
    for (std::size_t i = 0; i < causes_.size(); ++i)
      evidence.push_back(&causes_[i] == without ? k_no_evidence : explanations_[i].evidence(z));
    const double best = evidence.empty() ? k_no_evidence : *std::max_element(evidence.begin(), evidence.end());
    std::vector<std::size_t> group;
    for (std::size_t i = 0; best > unmodelled + k_plan.odds && i < causes_.size(); ++i) {
      if (evidence[i] > best - k_plan.odds) group.push_back(i);
    }
    return group;
  }

 private:
  const Information& known_;
  const std::vector<Cause>& causes_;
  Eigen::Index columns_, model_first_ = 0, model_count_ = 0;
  std::vector<Explanation> explanations_;  ///< by the causes, in their order
  std::vector<Explanation> unmodelled_;    ///< by model error alone, and by an unmodelled cause of each size
  Eigen::MatrixXd noise_;                  ///< square root of the covariance G of z
};

constexpr std::size_t k_no_cause = static_cast<std::size_t>(-1);

/// Counts the outcome of one data set. `group`: the reported causes; `truth`: index of the true one or k_no_cause;
/// `acceptable`: causes that do not count as wrong although they are not the truth.
void count(const std::vector<std::size_t>& group, std::size_t truth, const std::set<std::size_t>& acceptable,
           FalsePositives& into) {
  ++into.samples;
  const bool has_truth = std::find(group.begin(), group.end(), truth) != group.end();
  const bool has_acceptable =
      std::any_of(group.begin(), group.end(), [&](std::size_t i) { return acceptable.count(i) > 0; });
  if (!group.empty() && !has_truth && !has_acceptable) ++into.wrong;
  if (has_truth && group.size() == 1) ++into.alone;
  if (has_truth && group.size() > 1) ++into.group;
}

}  // namespace

FalsePositiveRates false_positive_rates(const Signatures& signatures, const Information& known,
                                        const std::vector<Cause>& causes,
                                        const std::vector<std::set<std::size_t>>& rivals, std::uint64_t seed) {
  FalsePositiveRates rates;
  const CauseSelector selector(signatures, known, causes);
  NormalNumbers numbers(seed);
  for (int sample = 0; sample < k_plan.samples; ++sample) {
    count(selector.reported(selector.drawn(nullptr, numbers), nullptr), k_no_cause, {}, rates.nothing);
    if (causes.empty()) continue;
    const std::size_t truth = static_cast<std::size_t>(sample) % causes.size();
    const Eigen::VectorXd z = selector.drawn(&causes[truth], numbers);
    count(selector.reported(z, nullptr), truth, {}, rates.one);
    count(selector.reported(z, &causes[truth]), k_no_cause, rivals[truth], rates.unmodelled);
  }
  return rates;
}

}  // namespace fusee::plan
