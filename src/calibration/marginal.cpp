#include "calibration/marginal.h"

#include <cmath>
#include <limits>

#include "calibration/thresholds.h"

// y − f(x) = D a + e. Columns a of a family have one amplitude λ, noise e has σ; both are integrated out in closed form
// (Woodbury), x by Laplace's method at the summit, and λ and σ are set where the data are likeliest (MacKay 1992: the
// amplitude of a family is its mean square over as many columns as the data determine).

namespace fusee {
namespace {

constexpr double k_settled = 0.02;  // nats
/// Of the floor: below it a family is nothing.
constexpr double k_nothing = 0.03;
/// Degrees of freedom of Student's t.
constexpr double k_tail = 2.0;

/// Information that the prior gives near x.
double information(double x, double prior) {
  return std::isfinite(prior) ? (k_tail + 1.0) / (k_tail * prior * prior + x * x) : 1e-12;
}

/// Of A⁻¹ = L⁻ᵀ L⁻¹, strip by strip: a column of L⁻¹ begins at its own row.
Eigen::VectorXd inverse_diagonal(const Eigen::LLT<Eigen::MatrixXd>& A) {
  constexpr Eigen::Index strip = 16;
  const Eigen::MatrixXd& L = A.matrixLLT();
  Eigen::VectorXd diagonal(L.rows());
  for (Eigen::Index first = 0; first < L.rows(); first += strip) {
    const Eigen::Index left = L.rows() - first;
    const Eigen::Index count = std::min(strip, left);
    Eigen::MatrixXd columns = Eigen::MatrixXd::Identity(left, count);
    L.bottomRightCorner(left, left).triangularView<Eigen::Lower>().solveInPlace(columns);
    diagonal.segment(first, count) = columns.colwise().squaredNorm();
  }
  return diagonal;
}

}  // namespace

double log_prior(double x, double prior) {
  if (!std::isfinite(prior)) return 0;
  const double constant = std::lgamma(0.5 * (k_tail + 1.0)) - std::lgamma(0.5 * k_tail) - 0.5 * std::log(k_tail * k_pi);
  return constant - std::log(prior) - 0.5 * (k_tail + 1.0) * std::log1p(x * x / (k_tail * prior * prior));
}

/// Of one pair of amplitudes: everything over the columns in use, scaled by their amplitudes.
struct Marginal::Solved {
  std::vector<Eigen::Index> columns;
  Eigen::VectorXd size;
  Eigen::LLT<Eigen::MatrixXd> A;  ///< I + λ DᵀD λ β
  Eigen::MatrixXd B;              ///< λ DᵀJ β
  Eigen::MatrixXd AB;             ///< A⁻¹ B
  Eigen::VectorXd t, At;          ///< λ Dᵀr β, A⁻¹ t
  Eigen::MatrixXd JJ;             ///< with the discrepancy integrated out
  Eigen::VectorXd Jr;
  double rr = 0;
  double constant = 0;  ///< log of the likelihood without its squares
};

Marginal::Marginal(Discrepancy discrepancy, double floor, double worth)
    : discrepancy_(std::move(discrepancy)),
      gram_(discrepancy_.columns.transpose() * discrepancy_.columns),
      floor_(floor),
      worth_(worth),
      first_guess_(nothing_unnamed()) {
  for (double& amplitude : first_guess_.families) amplitude = amplitude == 0 ? floor : amplitude;
}

Marginal::Marginal(const Marginal& other, double worth, Amplitudes first_guess) : Marginal(other) {
  worth_ = worth;
  first_guess_ = std::move(first_guess);
}

Amplitudes Marginal::nothing_unnamed() const {
  Amplitudes nothing{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(discrepancy_.families.size())), floor_};
  for (Eigen::Index f = 0; f < nothing.families.size(); ++f)
    nothing.families[f] = discrepancy_.families[static_cast<std::size_t>(f)].fixed;
  return nothing;
}

TangentSums Marginal::sums_of(const Tangent& tangent) const {
  TangentSums sums;
  sums.JJ = tangent.J.transpose() * tangent.J;
  sums.JD = tangent.J.transpose() * discrepancy_.columns;
  sums.Jr = tangent.J.transpose() * tangent.residual;
  sums.Dr = discrepancy_.columns.transpose() * tangent.residual;
  sums.rr = tangent.residual.squaredNorm();
  sums.rows = static_cast<double>(tangent.residual.size());
  sums.x = tangent.x;
  sums.prior = tangent.prior;
  sums.read = tangent.read;
  sums.pull = tangent.pull;
  sums.against = tangent.against;
  sums.give = tangent.give;
  return sums;
}

Marginal::Solved Marginal::solved(const TangentSums& sums, const Amplitudes& amplitudes) const {
  Solved s;
  std::vector<double> size;
  for (std::size_t f = 0; f < discrepancy_.families.size(); ++f) {
    const Family& family = discrepancy_.families[f];
    const double amplitude = amplitudes.families[static_cast<Eigen::Index>(f)];
    for (Eigen::Index k = 0; amplitude > 0 && k < family.count; ++k) {
      s.columns.push_back(family.first + k);
      size.push_back(family.fixed > 0 ? amplitude * sums.give : amplitude);
    }
  }
  s.size = Eigen::Map<const Eigen::VectorXd>(size.data(), static_cast<Eigen::Index>(size.size()));
  const double beta = worth_ / (amplitudes.noise * amplitudes.noise);
  Eigen::MatrixXd A = beta * (s.size.asDiagonal() * gram_(s.columns, s.columns) * s.size.asDiagonal());
  A.diagonal().array() += 1.0;
  s.A.compute(A);
  s.B = beta * (s.size.asDiagonal() * sums.JD(Eigen::all, s.columns).transpose());
  // Where there is no effect there is nothing to solve: Eigen looks at the first number even of none.
  s.AB = s.B;
  if (s.AB.size() > 0) s.A.solveInPlace(s.AB);
  s.t = beta * s.size.cwiseProduct(sums.Dr(s.columns));
  s.At = s.A.solve(s.t);
  s.JJ = beta * sums.JJ - s.B.transpose() * s.AB;
  s.Jr = beta * sums.Jr - s.AB.transpose() * s.t;
  s.rr = beta * sums.rr - s.t.dot(s.At);
  const double rows = worth_ * sums.rows;
  const double freedom = k_thresholds.noise_freedom;
  const double excess = floor_ * floor_ / (amplitudes.noise * amplitudes.noise);
  double rarity = 0;
  for (std::size_t f = 0; f < discrepancy_.families.size(); ++f) {
    const double ratio = amplitudes.families[static_cast<Eigen::Index>(f)] / (k_thresholds.usual_unknown * floor_);
    if (!(discrepancy_.families[f].fixed > 0)) rarity += std::log1p(ratio * ratio);
  }
  s.constant = -rarity + 0.5 * rows * std::log(beta) - s.A.matrixLLT().diagonal().array().log().sum() +
               0.5 * freedom * (std::log(excess) - excess);
  return s;
}

Explained Marginal::explained(const TangentSums& tangent, const Amplitudes& amplitudes, const Solved& s) const {
  const Eigen::Index count = tangent.x.size();
  Eigen::MatrixXd H = s.JJ + tangent.read;
  Eigen::VectorXd g = s.Jr + tangent.pull;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double known = information(tangent.x[k], tangent.prior[k]);
    H(k, k) += known;
    g[k] -= known * tangent.x[k];
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(H);
  Explained explained;
  explained.amplitudes = amplitudes;
  explained.step = count > 0 ? Eigen::VectorXd(factor.solve(g)) : Eigen::VectorXd();
  explained.covariance = factor.solve(Eigen::MatrixXd::Identity(count, count));
  const Eigen::VectorXd& step = explained.step;
  double squares = s.rr + tangent.against;
  if (count > 0) {
    squares += step.dot(s.JJ * step) - 2.0 * step.dot(s.Jr);
    squares += step.dot(tangent.read * step) - 2.0 * step.dot(tangent.pull);
  }
  explained.log_evidence = s.constant - 0.5 * squares;
  explained.log_evidence_here = s.constant - 0.5 * (s.rr + tangent.against);
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!std::isfinite(tangent.prior[k])) continue;
    explained.log_evidence += log_prior(tangent.x[k] + step[k], tangent.prior[k]) + 0.5 * std::log(k_two_pi);
    explained.log_evidence_here += log_prior(tangent.x[k], tangent.prior[k]) + 0.5 * std::log(k_two_pi);
  }
  const double width = count > 0 ? factor.matrixLLT().diagonal().array().log().sum() : 0.0;
  explained.log_evidence -= width;
  explained.log_evidence_here -= width;
  explained.unnamed = Eigen::VectorXd::Zero(discrepancy_.columns.cols());
  Eigen::VectorXd u = s.At;
  if (count > 0) u -= s.AB * step;
  for (std::size_t i = 0; i < s.columns.size(); ++i)
    explained.unnamed[s.columns[i]] = s.size[static_cast<Eigen::Index>(i)] * u[static_cast<Eigen::Index>(i)];
  return explained;
}

Amplitudes Marginal::reestimated(const TangentSums& sums, const Explained& now, const Solved& s) const {
  Eigen::VectorXd unknown = inverse_diagonal(s.A);
  if (now.step.size() > 0) unknown += (s.AB * now.covariance).cwiseProduct(s.AB).rowwise().sum();
  Amplitudes better = now.amplitudes;
  double determined = static_cast<double>(now.step.size());
  Eigen::Index place = 0;
  for (std::size_t f = 0; f < discrepancy_.families.size(); ++f) {
    const Family& family = discrepancy_.families[f];
    double& amplitude = better.families[static_cast<Eigen::Index>(f)];
    if (!(amplitude > 0)) continue;
    const double known = std::max(1e-6, static_cast<double>(family.count) - unknown.segment(place, family.count).sum());
    place += family.count;
    determined += known;
    if (family.fixed > 0) continue;
    const double ratio = amplitude / (k_thresholds.usual_unknown * floor_);
    const double rarity = 2.0 * ratio * ratio / (1.0 + ratio * ratio);
    amplitude = std::sqrt(now.unnamed.segment(family.first, family.count).squaredNorm() / (known + rarity));
    if (amplitude < k_nothing * floor_) amplitude = 0;
  }
  // Σ (r − J step − D a)², by what the sums know.
  const Eigen::VectorXd& a = now.unnamed;
  double squares = sums.rr - 2.0 * a.dot(sums.Dr) + a.dot(gram_ * a);
  if (now.step.size() > 0)
    squares += now.step.dot(sums.JJ * now.step) - 2.0 * now.step.dot(sums.Jr) + 2.0 * now.step.dot(sums.JD * a);
  const double freedom = k_thresholds.noise_freedom;
  const double rows = worth_ * sums.rows;
  const double left = freedom + std::max(1.0, rows - determined);
  better.noise = std::max(floor_, std::sqrt((freedom * floor_ * floor_ + worth_ * squares) / left));
  return better;
}

Explained Marginal::at(const TangentSums& sums, const Amplitudes& amplitudes) const {
  return explained(sums, amplitudes, solved(sums, amplitudes));
}

Explained Marginal::best(const TangentSums& sums, Amplitudes from, int rounds) const {
  Explained best;
  double last = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const Solved s = solved(sums, from);
    Explained now = explained(sums, from, s);
    const bool settled = std::abs(now.log_evidence - last) < k_settled;  // on the way it may fall
    last = now.log_evidence;
    if (round == 0 || now.log_evidence > best.log_evidence) best = now;
    if (settled || round + 1 == rounds) break;
    from = reestimated(sums, now, s);
  }
  return best;
}

double Marginal::summit(const Tangent& tangent, const Amplitudes& amplitudes) const {
  Tangent here = tangent;
  here.J.resize(tangent.J.rows(), 0);
  const Solved s = solved(sums_of(here), amplitudes);
  double density = s.constant - 0.5 * (s.rr + tangent.against);
  for (Eigen::Index k = 0; k < tangent.x.size(); ++k) density += log_prior(tangent.x[k], tangent.prior[k]);
  return density;
}

}  // namespace fusee
