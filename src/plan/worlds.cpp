#include "plan/worlds.h"

#include <algorithm>
#include <cmath>

#include "base/decompositions.h"
#include "base/normal_numbers.h"
#include "plan/thresholds.h"

// What a world measures is needed only as z = Aᵀy: of y = A x + noise that is G x + a normal vector of covariance G,
// with G = AᵀA. The log evidence of the columns Z, each with a normal prior of size 1, is
//   ½ z_Zᵀ (I + G_ZZ)⁻¹ z_Z − ½ log det (I + G_ZZ).
// An explanation is a cause with the model's own error; its rivals are the other causes, the model's error alone, and
// something without a name, which may have any smooth shape, whichever way, load and speed, of several sizes.

namespace fusee {
namespace {

/// Sizes of what has no name, deg at the joint.
constexpr double k_unknown_sizes[] = {0.02, 0.05, 0.15, 0.5};

/// The evidence for some columns, factored once.
class Explanation {
 public:
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
    Eigen::VectorXd seen(sizes_.size());
    for (Eigen::Index i = 0; i < seen.size(); ++i) seen[i] = sizes_[i] * z[columns_[static_cast<std::size_t>(i)]];
    return 0.5 * seen.dot(factor_.solve(seen)) - half_log_determinant_;
  }

 private:
  std::vector<Eigen::Index> columns_;
  Eigen::VectorXd sizes_;
  Cholesky factor_;
  double half_log_determinant_ = 0;
};

std::vector<Eigen::Index> span(Eigen::Index from, Eigen::Index to) {
  std::vector<Eigen::Index> all;
  for (Eigen::Index i = from; i < to; ++i) all.push_back(i);
  return all;
}

class Court {
 public:
  Court(const Signatures& signatures, const Information& known, const std::vector<Cause>& causes)
      : known_(known), causes_(causes), columns_(signatures.columns()) {
    const std::vector<Eigen::Index> model = span(signatures.model_first(), signatures.unknown_first());
    const auto with_model = [&](Eigen::Index first, Eigen::Index count, double size) {
      std::vector<Eigen::Index> all = model;
      const std::vector<Eigen::Index> own = span(first, first + count);
      all.insert(all.end(), own.begin(), own.end());
      Eigen::VectorXd sizes = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(all.size()), size);
      sizes.head(static_cast<Eigen::Index>(model.size())).setOnes();
      return Explanation(known, all, sizes);
    };
    for (const Cause& cause : causes) named_.push_back(with_model(cause.first, cause.count(), 1.0));
    unnamed_.push_back(with_model(0, 0, 1.0));
    for (const double size : k_unknown_sizes)
      unnamed_.push_back(
          with_model(signatures.unknown_first(), signatures.columns() - signatures.unknown_first(), size));
    const SymmetricEigen parts = eigendecomposition(known.runs + known.readings);
    noise_ = parts.vectors * parts.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
    model_first_ = signatures.model_first();
    model_count_ = static_cast<Eigen::Index>(model.size());
  }

  /// What such a world measures: with a cause, or null with none.
  Eigen::VectorXd measured(const Cause* cause, NormalNumbers& numbers) const {
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

  /// The places of the causes that would be named together; none where something without a name does as well.
  /// `without`: not in the catalogue.
  std::vector<std::size_t> named(const Eigen::VectorXd& z, const Cause* without) const {
    double unnamed = -1e300;
    for (const Explanation& explanation : unnamed_) unnamed = std::max(unnamed, explanation.evidence(z));
    std::vector<double> evidence;
    for (std::size_t i = 0; i < causes_.size(); ++i)
      evidence.push_back(&causes_[i] == without ? -1e300 : named_[i].evidence(z));
    const double best = evidence.empty() ? -1e300 : *std::max_element(evidence.begin(), evidence.end());
    std::vector<std::size_t> group;
    for (std::size_t i = 0; best > unnamed + k_plan.odds && i < causes_.size(); ++i) {
      if (evidence[i] > best - k_plan.odds) group.push_back(i);
    }
    return group;
  }

 private:
  const Information& known_;
  const std::vector<Cause>& causes_;
  Eigen::Index columns_, model_first_ = 0, model_count_ = 0;
  std::vector<Explanation> named_, unnamed_;
  Eigen::MatrixXd noise_;
};

constexpr std::size_t k_none = static_cast<std::size_t>(-1);

/// `kin`: what the truth, if it is not in the group itself, may be taken for.
void count(const std::vector<std::size_t>& group, std::size_t truth, const std::set<std::size_t>& kin,
           FalseBlame& into) {
  ++into.worlds;
  const bool holds = std::find(group.begin(), group.end(), truth) != group.end();
  const bool near = std::any_of(group.begin(), group.end(), [&](std::size_t i) { return kin.count(i) > 0; });
  if (!group.empty() && !holds && !near) ++into.blamed;
  if (holds) ++(group.size() == 1 ? into.alone : into.group);
}

}  // namespace

Blame blame(const Signatures& signatures, const Information& known, const std::vector<Cause>& causes,
            const std::vector<std::set<std::size_t>>& rivals, std::uint64_t seed) {
  Blame blame;
  const Court court(signatures, known, causes);
  NormalNumbers numbers(seed);
  for (int world = 0; world < k_plan.worlds; ++world) {
    count(court.named(court.measured(nullptr, numbers), nullptr), k_none, {}, blame.nothing);
    if (causes.empty()) continue;
    const std::size_t truth = static_cast<std::size_t>(world) % causes.size();
    const Eigen::VectorXd z = court.measured(&causes[truth], numbers);
    count(court.named(z, nullptr), truth, {}, blame.one);
    count(court.named(z, &causes[truth]), k_none, rivals[truth], blame.unknown);
  }
  return blame;
}

}  // namespace fusee
