#include "calibration/evidence_model.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "calibration/thresholds.h"

// y − f(x) = D a + e. Columns a of a family have one amplitude λ, noise e has σ; both are integrated out in closed form
// (Woodbury), x by Laplace's method at the summit, and λ and σ are set where the data are likeliest (MacKay 1992: the
// amplitude of a family is its mean square over as many columns as the data determine).

namespace fusee::calibration {
namespace {

constexpr double k_settled = 0.02;  // nats
/// Share of the floor below which a family's amplitude is set to 0.
constexpr double k_nothing = 0.03;
/// Degrees of freedom of Student's t.
constexpr double k_tail = 2.0;
/// Greedy search: members added, candidates of each step, and rounds of their amplitudes.
constexpr int k_most_added = 3;
constexpr std::size_t k_greedy_tries = 3;
constexpr int k_greedy_rounds = 4;

double square(double x) { return x * x; }

/// Log density of Student's t at 0: of two degrees of freedom it is 1/√8.
const double k_log_density_at_0 = -1.5 * elementary::log(2.0);

/// Information of the prior near x: −d²/dx² of its log density, without the negative part.
double information(double x, double prior) {
  return std::isfinite(prior) ? (k_tail + 1.0) / (k_tail * prior * prior + x * x) : 1e-12;
}

std::uint64_t hash_of(const Eigen::Ref<const Eigen::VectorXd>& column) {
  std::uint64_t hash = 0;
  for (const double value : column) hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15ULL;
  return hash ^ (hash >> 32);
}

std::uint64_t new_id() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

/// Products Dᵀ v that a thread computed before, by the hash of v. Tangents share the columns of their base, and each
/// product reads the whole of D.
class ProjectionCache {
 public:
  /// `id`: of D. Valid until the next call.
  const Eigen::VectorXd& of(const Eigen::MatrixXd& D, std::uint64_t id, const Eigen::Ref<const Eigen::VectorXd>& v) {
    Entry& entry = entries_[hash_of(v) % entries_.size()];
    if (entry.id != id || entry.v.size() != v.size() || entry.v != v) entry = {id, v, D.transpose() * v};
    return entry.product;
  }

 private:
  struct Entry {
    std::uint64_t id = 0;
    Eigen::VectorXd v, product;
  };
  std::array<Entry, 256> entries_;
};

}  // namespace

double log_prior(double x, double prior) {
  if (!std::isfinite(prior)) return 0;
  return k_log_density_at_0 - elementary::log(prior) -
         0.5 * (k_tail + 1.0) * elementary::log1p(x * x / (k_tail * prior * prior));
}

void add_numbers(const Eigen::VectorXd& prior, Tangent& tangent) {
  const Eigen::Index before = tangent.x.size();
  const Eigen::Index all = before + prior.size();
  tangent.x.conservativeResize(all);
  tangent.x.tail(prior.size()).setZero();
  tangent.prior.conservativeResize(all);
  tangent.prior.tail(prior.size()) = prior;
  Eigen::MatrixXd caliper_information = Eigen::MatrixXd::Zero(all, all);
  caliper_information.topLeftCorner(before, before) = tangent.caliper_information;
  tangent.caliper_information = std::move(caliper_information);
  tangent.caliper_gradient.conservativeResize(all);
  tangent.caliper_gradient.tail(prior.size()).setZero();
}

/// Solution of the discrepancy's columns at a tangent: A = I + λ DᵀD λ β.
struct EvidenceModel::Solved {
  Eigen::MatrixXd B;      ///< λ DᵀJ β
  Eigen::MatrixXd AB;     ///< A⁻¹ B
  Eigen::VectorXd t, At;  ///< λ Dᵀr β, A⁻¹ t
  Eigen::MatrixXd JJ;     ///< information with the discrepancy integrated out
  Eigen::VectorXd Jr;
  double rr = 0;
  double constant = 0;  ///< log likelihood without its squares
};

EvidenceModel::EvidenceModel(Discrepancy discrepancy, double floor, double independent_share)
    : discrepancy_(std::move(discrepancy)),
      id_(new_id()),
      gram_(discrepancy_.columns.transpose() * discrepancy_.columns),
      floor_(floor),
      independent_share_(independent_share),
      first_guess_(without_discrepancy()) {
  for (double& amplitude : first_guess_.families) amplitude = amplitude == 0 ? floor : amplitude;
}

EvidenceModel::EvidenceModel(const EvidenceModel& other, double independent_share, Amplitudes first_guess)
    : EvidenceModel(other) {
  independent_share_ = independent_share;
  first_guess_ = std::move(first_guess);
}

Amplitudes EvidenceModel::without_discrepancy() const {
  Amplitudes nothing{Eigen::VectorXd::Zero(static_cast<Eigen::Index>(discrepancy_.families.size())), floor_};
  for (Eigen::Index f = 0; f < nothing.families.size(); ++f)
    nothing.families[f] = discrepancy_.families[static_cast<std::size_t>(f)].fixed;
  return nothing;
}

TangentSums EvidenceModel::sums_of(const Tangent& tangent) const {
  TangentSums sums;
  sums.JJ = tangent.J.transpose() * tangent.J;
  static thread_local ProjectionCache projections;
  sums.JD.resize(tangent.J.cols(), discrepancy_.columns.cols());
  for (Eigen::Index k = 0; k < tangent.J.cols(); ++k)
    sums.JD.row(k) = projections.of(discrepancy_.columns, id_, tangent.J.col(k)).transpose();
  sums.Jr = tangent.J.transpose() * tangent.residual;
  sums.Dr = projections.of(discrepancy_.columns, id_, tangent.residual);
  sums.rr = tangent.residual.squaredNorm();
  sums.rows = static_cast<double>(tangent.residual.size());
  sums.x = tangent.x;
  sums.prior = tangent.prior;
  sums.caliper_information = tangent.caliper_information;
  sums.caliper_gradient = tangent.caliper_gradient;
  sums.caliper_chi2 = tangent.caliper_chi2;
  sums.deflection_ratio = tangent.deflection_ratio;
  return sums;
}

ScaledDiscrepancy EvidenceModel::sized(const Amplitudes& amplitudes, double deflection_ratio) const {
  ScaledDiscrepancy u{amplitudes, independent_share_ / (amplitudes.noise * amplitudes.noise), {}, {}, {}};
  std::vector<double> size;
  for (std::size_t f = 0; f < discrepancy_.families.size(); ++f) {
    const Family& family = discrepancy_.families[f];
    const double amplitude = amplitudes.families[static_cast<Eigen::Index>(f)];
    for (Eigen::Index k = 0; amplitude > 0 && k < family.count; ++k) {
      u.columns.push_back(family.first + k);
      size.push_back(family.fixed > 0 ? amplitude * deflection_ratio : amplitude);
    }
  }
  u.size = Eigen::Map<const Eigen::VectorXd>(size.data(), static_cast<Eigen::Index>(size.size()));
  Eigen::MatrixXd A = u.beta * (u.size.asDiagonal() * gram_(u.columns, u.columns) * u.size.asDiagonal());
  A.diagonal().array() += 1.0;
  u.A = Cholesky(A);
  return u;
}

/// Half-Cauchy-type prior on each family's amplitude: −log(1 + (λ / 0.5 σ)²), σ the noise floor.
double EvidenceModel::log_prior_of(const Amplitudes& amplitudes) const {
  double sum = 0;
  for (std::size_t f = 0; f < discrepancy_.families.size(); ++f) {
    const double amplitude = amplitudes.families[static_cast<Eigen::Index>(f)];
    if (!(discrepancy_.families[f].fixed > 0))
      sum -= elementary::log1p(square(amplitude / (k_thresholds.usual_discrepancy * floor_)));
  }
  return sum;
}

EvidenceModel::Solved EvidenceModel::solved(const TangentSums& sums, const ScaledDiscrepancy& u) const {
  Solved s;
  s.B = u.beta * (u.size.asDiagonal() * sums.JD(Eigen::all, u.columns).transpose());
  // Eigen reads the first element even of an empty matrix.
  s.AB = s.B.size() > 0 ? u.A.solve(s.B) : s.B;
  s.t = u.beta * u.size.cwiseProduct(sums.Dr(u.columns));
  s.At = u.A.solve(s.t);
  s.JJ = u.beta * sums.JJ - s.B.transpose() * s.AB;
  s.Jr = u.beta * sums.Jr - s.AB.transpose() * s.t;
  s.rr = u.beta * sums.rr - s.t.dot(s.At);
  const double rows = independent_share_ * sums.rows;
  const double freedom = k_thresholds.noise_freedom;
  const double excess = floor_ * floor_ / (u.amplitudes.noise * u.amplitudes.noise);
  s.constant = log_prior_of(u.amplitudes) + 0.5 * rows * elementary::log(u.beta) - u.A.half_log_determinant() +
               0.5 * freedom * (elementary::log(excess) - excess);
  return s;
}

ReducedTangent EvidenceModel::reduced(const TangentSums& sums, const ScaledDiscrepancy& scaled_discrepancy) const {
  Solved s = solved(sums, scaled_discrepancy);
  return {std::move(s.JJ),       std::move(s.Jr),  s.rr, s.constant, sums.x, sums.prior, sums.caliper_information,
          sums.caliper_gradient, sums.caliper_chi2};
}

double log_evidence_of(const ReducedTangent& tangent, const std::vector<Eigen::Index>& columns) {
  const Eigen::MatrixXd known = tangent.JJ(columns, columns) + tangent.caliper_information(columns, columns);
  const Eigen::VectorXd gradient = tangent.Jr(columns) + tangent.caliper_gradient(columns);
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
                        0.5 * (tangent.rr + tangent.caliper_chi2 + step.dot(known * step) - 2.0 * step.dot(gradient));
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    if (std::isfinite(prior[k])) log_evidence += log_prior(x[k] + step[k], prior[k]) + 0.5 * elementary::log(k_two_pi);
  }
  return log_evidence;
}

Posterior EvidenceModel::posterior_at(const TangentSums& tangent, const ScaledDiscrepancy& u, const Solved& s) const {
  const Eigen::Index count = tangent.x.size();
  Eigen::MatrixXd H = s.JJ + tangent.caliper_information;
  Eigen::VectorXd g = s.Jr + tangent.caliper_gradient;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double known = information(tangent.x[k], tangent.prior[k]);
    H(k, k) += known;
    g[k] -= known * tangent.x[k];
  }
  const Cholesky factor(H);
  Posterior posterior;
  posterior.amplitudes = u.amplitudes;
  posterior.step = count > 0 ? factor.solve(g) : Eigen::VectorXd();
  posterior.covariance = factor.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(count, count)));
  const Eigen::VectorXd& step = posterior.step;
  double squares = s.rr + tangent.caliper_chi2;
  if (count > 0) {
    squares += step.dot(s.JJ * step) - 2.0 * step.dot(s.Jr);
    squares += step.dot(tangent.caliper_information * step) - 2.0 * step.dot(tangent.caliper_gradient);
  }
  posterior.log_density = s.constant - 0.5 * (s.rr + tangent.caliper_chi2);
  posterior.predicted_log_density = s.constant - 0.5 * squares;
  double width = count > 0 ? factor.half_log_determinant() : 0.0;
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!std::isfinite(tangent.prior[k])) continue;
    posterior.log_density += log_prior(tangent.x[k], tangent.prior[k]);
    posterior.predicted_log_density += log_prior(tangent.x[k] + step[k], tangent.prior[k]);
    width -= 0.5 * elementary::log(k_two_pi);
  }
  posterior.log_evidence = posterior.predicted_log_density - width;
  posterior.log_evidence_here = posterior.log_density - width;
  posterior.coefficients = Eigen::VectorXd::Zero(discrepancy_.columns.cols());
  Eigen::VectorXd scaled = s.At;
  if (count > 0) scaled -= s.AB * step;
  for (std::size_t i = 0; i < u.columns.size(); ++i)
    posterior.coefficients[u.columns[i]] = u.size[static_cast<Eigen::Index>(i)] * scaled[static_cast<Eigen::Index>(i)];
  return posterior;
}

Amplitudes EvidenceModel::reestimate(const TangentSums& sums, const Posterior& now, const ScaledDiscrepancy& u,
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
    const double rarer = square(amplitude / (k_thresholds.usual_discrepancy * floor_));
    const double prior_slope = 2.0 * rarer / (1.0 + rarer);  // slope of the log prior over log amplitude
    amplitude = std::sqrt(now.coefficients.segment(family.first, family.count).squaredNorm() / (known + prior_slope));
    if (amplitude < k_nothing * floor_) amplitude = 0;
  }
  // Σ (r − J step − D a)² from the sums.
  const Eigen::VectorXd& a = now.coefficients;
  double squares = sums.rr - 2.0 * a.dot(sums.Dr) + a.dot(gram_ * a);
  if (now.step.size() > 0)
    squares += now.step.dot(sums.JJ * now.step) - 2.0 * now.step.dot(sums.Jr) + 2.0 * now.step.dot(sums.JD * a);
  const double freedom = k_thresholds.noise_freedom;
  const double rows = independent_share_ * sums.rows;
  const double degrees_of_freedom = freedom + std::max(1.0, rows - determined);
  better.noise =
      std::max(floor_, std::sqrt((freedom * floor_ * floor_ + independent_share_ * squares) / degrees_of_freedom));
  return better;
}

Posterior EvidenceModel::at(const TangentSums& sums, const ScaledDiscrepancy& scaled_discrepancy) const {
  return posterior_at(sums, scaled_discrepancy, solved(sums, scaled_discrepancy));
}

Posterior EvidenceModel::best(const TangentSums& sums, Amplitudes from, int rounds) const {
  Posterior best;
  double last = -std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const ScaledDiscrepancy u = sized(from, sums.deflection_ratio);
    const Solved s = solved(sums, u);
    Posterior now = posterior_at(sums, u, s);
    const bool settled = std::abs(now.log_evidence - last) < k_settled;  // may fall during the iteration
    last = now.log_evidence;
    if (round == 0 || now.log_evidence > best.log_evidence) best = now;
    if (settled || round + 1 == rounds) break;
    from = reestimate(sums, now, u, s);
  }
  return best;
}

double EvidenceModel::discrepancy_penalty(const Posterior& posterior) const {
  Eigen::VectorXd coefficients = posterior.coefficients;
  for (const Family& family : discrepancy_.families) {
    if (family.fixed > 0) coefficients.segment(family.first, family.count).setZero();
  }
  const double mean_square = coefficients.dot(gram_ * coefficients) / static_cast<double>(discrepancy_.columns.rows());
  return k_thresholds.neg_log_prior_odds * std::min(1.0, std::max(0.0, mean_square) / square(floor_));
}

double EvidenceModel::log_density_at(const Tangent& tangent, const ScaledDiscrepancy& scaled_discrepancy) const {
  Tangent here = tangent;
  here.J.resize(tangent.J.rows(), 0);
  const Solved s = solved(sums_of(here), scaled_discrepancy);
  double density = s.constant - 0.5 * (s.rr + tangent.caliper_chi2);
  for (Eigen::Index k = 0; k < tangent.x.size(); ++k) density += log_prior(tangent.x[k], tangent.prior[k]);
  return density;
}

namespace {

/// Adds the best member. False if none raises the score.
bool add_best(const EvidenceModel& evidence_model, const std::vector<double>& penalties,
              const std::function<TangentSums(const std::vector<std::size_t>&)>& sums, LinearizedSet& set) {
  double cost = 0;
  for (const std::size_t member : set.members) cost += penalties[member];
  std::vector<std::size_t> wider = set.members;
  wider.push_back(0);
  const ScaledDiscrepancy beside = evidence_model.sized(set.amplitudes, sums(set.members).deflection_ratio);
  std::vector<std::pair<double, std::size_t>> candidates;
  for (std::size_t i = 0; i < penalties.size(); ++i) {
    if (!std::isfinite(penalties[i]) || std::count(set.members.begin(), set.members.end(), i)) continue;
    wider.back() = i;
    candidates.emplace_back(cost + penalties[i] - evidence_model.at(sums(wider), beside).log_evidence, i);
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.resize(std::min(candidates.size(), k_greedy_tries));
  LinearizedSet best = set;
  for (const auto& [predicted, i] : candidates) {
    wider.back() = i;
    Posterior posterior = evidence_model.best(sums(wider), set.amplitudes, k_greedy_rounds);
    const double score = posterior.log_evidence - (cost + penalties[i]);
    if (score > best.score) best = {wider, std::move(posterior.amplitudes), score};
  }
  const bool is_better = best.members.size() > set.members.size();
  set = std::move(best);
  return is_better;
}

}  // namespace

LinearizedSet add_greedily(const EvidenceModel& evidence_model, const std::vector<double>& penalties,
                           const std::function<TangentSums(const std::vector<std::size_t>&)>& sums, LinearizedSet set) {
  for (int added = 0; added < k_most_added && add_best(evidence_model, penalties, sums, set); ++added) {
  }
  return set;
}

}  // namespace fusee::calibration
