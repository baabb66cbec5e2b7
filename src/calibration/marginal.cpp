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
/// Share of the floor below which a family's amplitude is set to 0.
constexpr double k_nothing = 0.03;
/// Degrees of freedom of Student's t.
constexpr double k_tail = 2.0;

double square(double x) { return x * x; }

/// Log density of Student's t at 0. Computed once, before any thread begins: lgamma writes a global sign.
const double k_log_density_at_0 =
    std::lgamma(0.5 * (k_tail + 1.0)) - std::lgamma(0.5 * k_tail) - 0.5 * std::log(k_tail * k_pi);

/// Information of the prior near x: −d²/dx² of its log density, without the negative part.
double information(double x, double prior) {
  return std::isfinite(prior) ? (k_tail + 1.0) / (k_tail * prior * prior + x * x) : 1e-12;
}

}  // namespace

double log_prior(double x, double prior) {
  if (!std::isfinite(prior)) return 0;
  return k_log_density_at_0 - std::log(prior) - 0.5 * (k_tail + 1.0) * std::log1p(x * x / (k_tail * prior * prior));
}

void add_numbers(const Eigen::VectorXd& prior, Tangent& tangent) {
  const Eigen::Index before = tangent.x.size();
  const Eigen::Index all = before + prior.size();
  tangent.x.conservativeResize(all);
  tangent.x.tail(prior.size()).setZero();
  tangent.prior.conservativeResize(all);
  tangent.prior.tail(prior.size()) = prior;
  Eigen::MatrixXd read = Eigen::MatrixXd::Zero(all, all);
  read.topLeftCorner(before, before) = tangent.read;
  tangent.read = std::move(read);
  tangent.pull.conservativeResize(all);
  tangent.pull.tail(prior.size()).setZero();
}

/// Solution of the discrepancy's columns at a tangent: A = I + λ DᵀD λ β.
struct Marginal::Solved {
  Eigen::MatrixXd B;      ///< λ DᵀJ β
  Eigen::MatrixXd AB;     ///< A⁻¹ B
  Eigen::VectorXd t, At;  ///< λ Dᵀr β, A⁻¹ t
  Eigen::MatrixXd JJ;     ///< information with the discrepancy integrated out
  Eigen::VectorXd Jr;
  double rr = 0;
  double constant = 0;  ///< log likelihood without its squares
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
  // Column by column: a product of a few columns with many costs Eigen twice as much.
  sums.JD.resize(tangent.J.cols(), discrepancy_.columns.cols());
  for (Eigen::Index k = 0; k < tangent.J.cols(); ++k)
    sums.JD.row(k) = (discrepancy_.columns.transpose() * tangent.J.col(k)).transpose();
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

SizedDiscrepancy Marginal::sized(const Amplitudes& amplitudes, double give) const {
  SizedDiscrepancy u{amplitudes, worth_ / (amplitudes.noise * amplitudes.noise), {}, {}, {}};
  std::vector<double> size;
  for (std::size_t f = 0; f < discrepancy_.families.size(); ++f) {
    const Family& family = discrepancy_.families[f];
    const double amplitude = amplitudes.families[static_cast<Eigen::Index>(f)];
    for (Eigen::Index k = 0; amplitude > 0 && k < family.count; ++k) {
      u.columns.push_back(family.first + k);
      size.push_back(family.fixed > 0 ? amplitude * give : amplitude);
    }
  }
  u.size = Eigen::Map<const Eigen::VectorXd>(size.data(), static_cast<Eigen::Index>(size.size()));
  Eigen::MatrixXd A = u.beta * (u.size.asDiagonal() * gram_(u.columns, u.columns) * u.size.asDiagonal());
  A.diagonal().array() += 1.0;
  u.A = Cholesky(A);
  return u;
}

/// Half-Cauchy-type prior on each family's amplitude: −log(1 + (λ / 0.5 σ)²), σ the noise floor.
double Marginal::log_prior_of(const Amplitudes& amplitudes) const {
  double sum = 0;
  for (std::size_t f = 0; f < discrepancy_.families.size(); ++f) {
    const double amplitude = amplitudes.families[static_cast<Eigen::Index>(f)];
    if (!(discrepancy_.families[f].fixed > 0))
      sum -= std::log1p(square(amplitude / (k_thresholds.usual_unknown * floor_)));
  }
  return sum;
}

Marginal::Solved Marginal::solved(const TangentSums& sums, const SizedDiscrepancy& u) const {
  Solved s;
  s.B = u.beta * (u.size.asDiagonal() * sums.JD(Eigen::all, u.columns).transpose());
  // Eigen reads the first element even of an empty matrix.
  s.AB = s.B.size() > 0 ? u.A.solve(s.B) : s.B;
  s.t = u.beta * u.size.cwiseProduct(sums.Dr(u.columns));
  s.At = u.A.solve(s.t);
  s.JJ = u.beta * sums.JJ - s.B.transpose() * s.AB;
  s.Jr = u.beta * sums.Jr - s.AB.transpose() * s.t;
  s.rr = u.beta * sums.rr - s.t.dot(s.At);
  const double rows = worth_ * sums.rows;
  const double freedom = k_thresholds.noise_freedom;
  const double excess = floor_ * floor_ / (u.amplitudes.noise * u.amplitudes.noise);
  s.constant = log_prior_of(u.amplitudes) + 0.5 * rows * std::log(u.beta) - u.A.half_log_determinant() +
               0.5 * freedom * (std::log(excess) - excess);
  return s;
}

ReducedTangent Marginal::reduced(const TangentSums& sums, const SizedDiscrepancy& beside) const {
  Solved s = solved(sums, beside);
  return {std::move(s.JJ), std::move(s.Jr), s.rr, s.constant, sums.x, sums.prior, sums.read, sums.pull, sums.against};
}

double log_evidence_of(const ReducedTangent& tangent, const std::vector<Eigen::Index>& columns) {
  const Eigen::MatrixXd known = tangent.JJ(columns, columns) + tangent.read(columns, columns);
  const Eigen::VectorXd gradient = tangent.Jr(columns) + tangent.pull(columns);
  const Eigen::VectorXd x = tangent.x(columns);
  const Eigen::VectorXd prior = tangent.prior(columns);
  Eigen::MatrixXd H = known;
  Eigen::VectorXd g = gradient;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const double by_prior = information(x[k], prior[k]);
    H(k, k) += by_prior;
    g[k] -= by_prior * x[k];
  }
  const Cholesky factor(H);
  const Eigen::VectorXd step = factor.solve(g);
  double log_evidence = tangent.constant - factor.half_log_determinant() -
                        0.5 * (tangent.rr + tangent.against + step.dot(known * step) - 2.0 * step.dot(gradient));
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    if (std::isfinite(prior[k])) log_evidence += log_prior(x[k] + step[k], prior[k]) + 0.5 * std::log(k_two_pi);
  }
  return log_evidence;
}

Explained Marginal::explained(const TangentSums& tangent, const SizedDiscrepancy& u, const Solved& s) const {
  const Eigen::Index count = tangent.x.size();
  Eigen::MatrixXd H = s.JJ + tangent.read;
  Eigen::VectorXd g = s.Jr + tangent.pull;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double known = information(tangent.x[k], tangent.prior[k]);
    H(k, k) += known;
    g[k] -= known * tangent.x[k];
  }
  const Cholesky factor(H);
  Explained explained;
  explained.amplitudes = u.amplitudes;
  explained.step = count > 0 ? factor.solve(g) : Eigen::VectorXd();
  explained.covariance = factor.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(count, count)));
  const Eigen::VectorXd& step = explained.step;
  double squares = s.rr + tangent.against;
  if (count > 0) {
    squares += step.dot(s.JJ * step) - 2.0 * step.dot(s.Jr);
    squares += step.dot(tangent.read * step) - 2.0 * step.dot(tangent.pull);
  }
  explained.height = s.constant - 0.5 * (s.rr + tangent.against);
  explained.height_ahead = s.constant - 0.5 * squares;
  double width = count > 0 ? factor.half_log_determinant() : 0.0;
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!std::isfinite(tangent.prior[k])) continue;
    explained.height += log_prior(tangent.x[k], tangent.prior[k]);
    explained.height_ahead += log_prior(tangent.x[k] + step[k], tangent.prior[k]);
    width -= 0.5 * std::log(k_two_pi);
  }
  explained.log_evidence = explained.height_ahead - width;
  explained.log_evidence_here = explained.height - width;
  explained.unnamed = Eigen::VectorXd::Zero(discrepancy_.columns.cols());
  Eigen::VectorXd scaled = s.At;
  if (count > 0) scaled -= s.AB * step;
  for (std::size_t i = 0; i < u.columns.size(); ++i)
    explained.unnamed[u.columns[i]] = u.size[static_cast<Eigen::Index>(i)] * scaled[static_cast<Eigen::Index>(i)];
  return explained;
}

Amplitudes Marginal::reestimated(const TangentSums& sums, const Explained& now, const SizedDiscrepancy& u,
                                 const Solved& s) const {
  Eigen::VectorXd unknown = u.A.inverse_diagonal();
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
    const double rarer = square(amplitude / (k_thresholds.usual_unknown * floor_));
    const double against = 2.0 * rarer / (1.0 + rarer);  // slope of the log prior over log amplitude
    amplitude = std::sqrt(now.unnamed.segment(family.first, family.count).squaredNorm() / (known + against));
    if (amplitude < k_nothing * floor_) amplitude = 0;
  }
  // Σ (r − J step − D a)² from the sums.
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

Explained Marginal::at(const TangentSums& sums, const SizedDiscrepancy& beside) const {
  return explained(sums, beside, solved(sums, beside));
}

Explained Marginal::best(const TangentSums& sums, Amplitudes from, int rounds) const {
  Explained best;
  double last = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const SizedDiscrepancy u = sized(from, sums.give);
    const Solved s = solved(sums, u);
    Explained now = explained(sums, u, s);
    const bool settled = std::abs(now.log_evidence - last) < k_settled;  // may fall during the iteration
    last = now.log_evidence;
    if (round == 0 || now.log_evidence > best.log_evidence) best = now;
    if (settled || round + 1 == rounds) break;
    from = reestimated(sums, now, u, s);
  }
  return best;
}

double Marginal::rareness_of_rest(const Explained& explained) const {
  Eigen::VectorXd unnamed = explained.unnamed;
  for (const Family& family : discrepancy_.families) {
    if (family.fixed > 0) unnamed.segment(family.first, family.count).setZero();
  }
  const double mean_square = unnamed.dot(gram_ * unnamed) / static_cast<double>(discrepancy_.columns.rows());
  return k_thresholds.rareness * std::min(1.0, std::max(0.0, mean_square) / square(floor_));
}

double Marginal::summit(const Tangent& tangent, const SizedDiscrepancy& beside) const {
  Tangent here = tangent;
  here.J.resize(tangent.J.rows(), 0);
  const Solved s = solved(sums_of(here), beside);
  double density = s.constant - 0.5 * (s.rr + tangent.against);
  for (Eigen::Index k = 0; k < tangent.x.size(); ++k) density += log_prior(tangent.x[k], tangent.prior[k]);
  return density;
}

}  // namespace fusee
