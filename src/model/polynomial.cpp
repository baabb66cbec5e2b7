#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "fusee/base.h"
#include "fusee/model.h"

namespace fusee::model {
namespace {

constexpr int k_fit_intervals = 1000;  ///< number of intervals of the range between the samples of a fit

/// The Chebyshev polynomials T_0(t) … T_degree(t).
Eigen::VectorXd chebyshev(double t, int degree) {
  Eigen::VectorXd values(degree + 1);
  values(0) = 1;
  if (degree > 0) values(1) = t;
  for (int k = 2; k <= degree; ++k) values(k) = 2 * t * values(k - 1) - values(k - 2);
  return values;
}

/// Converts a Chebyshev series in t = (x − middle)/half to a polynomial in x, by T_(k+1) = 2 t T_k − T_(k−1).
Polynomial in_x(const Eigen::VectorXd& c, double middle, double half) {
  const auto degree = static_cast<int>(c.size()) - 1;
  using Coefficients = std::vector<double>;  // in x
  const auto times_t = [&](const Coefficients& factor) {
    Coefficients product(factor.size() + 1, 0);
    for (std::size_t i = 0; i < factor.size(); ++i) {
      product[i + 1] += factor[i] / half;
      product[i] -= factor[i] * middle / half;
    }
    return product;
  };
  Coefficients T{1}, T_next = times_t(T), sum(static_cast<std::size_t>(degree) + 1, 0);
  for (int k = 0; k <= degree; ++k) {
    for (std::size_t i = 0; i < T.size(); ++i) sum[i] += c(k) * T[i];
    Coefficients T_after_next = times_t(T_next);
    for (double& value : T_after_next) value *= 2;
    for (std::size_t i = 0; i < T.size(); ++i) T_after_next[i] -= T[i];
    T = std::exchange(T_next, std::move(T_after_next));
  }
  // Removes coefficients that are zero up to rounding.
  const double largest_x = std::abs(middle) + std::abs(half), scale = c.lpNorm<Eigen::Infinity>();
  double power = 1;
  for (double& value : sum) {
    if (std::abs(value) * power < 1e-12 * scale) value = 0;
    power *= largest_x;
  }
  return {sum};
}

/// Replaces a point of the reference by `entering` so that the signs of the errors keep alternating: the neighbour with
/// the same sign of error leaves. If `entering` lies beyond an end and its sign differs from that end's, the point at
/// the opposite end leaves instead.
void exchange(std::vector<std::size_t>& reference, const std::vector<double>& errors, std::size_t entering) {
  const auto above = std::upper_bound(reference.begin(), reference.end(), entering);
  const bool positive = errors[entering] > 0;
  const auto same_sign = [&](std::size_t i) { return (errors[i] > 0) == positive; };
  if (above == reference.begin()) {
    if (same_sign(reference.front())) {
      reference.front() = entering;
    } else {
      reference.insert(reference.begin(), entering);
      reference.pop_back();
    }
  } else if (above == reference.end()) {
    if (same_sign(reference.back())) {
      reference.back() = entering;
    } else {
      reference.erase(reference.begin());
      reference.push_back(entering);
    }
  } else {
    const auto replaced = same_sign(*(above - 1)) ? above - 1 : above;
    *replaced = entering;
  }
}

/// Solves α = p(θ) for θ by Newton's method from a nearby start.
double solved(const Polynomial& p, double alpha, double start) {
  double theta = start;
  for (int i = 0; i < 20; ++i) {
    const double step = (alpha - p(theta)) / p.slope(theta);
    if (!std::isfinite(step)) break;
    theta += step;
    if (std::abs(step) < 1e-14) break;
  }
  return theta;
}

/// Motor angles, evenly over the range.
std::vector<double> sampled_alphas(const AngleMap& map) {
  std::vector<double> alphas;
  for (int i = 0; i <= k_fit_intervals; ++i)
    alphas.push_back(std::lerp(map.alpha_min, map.alpha_max, double(i) / k_fit_intervals));
  return alphas;
}

EqualityFit fit_of_alpha(const AngleMap& map, int degree) {
  std::vector<FitPoint> points;
  for (const double alpha : sampled_alphas(map)) points.push_back({alpha, map.theta(alpha)});
  return measured({.of_alpha = true, .p = least_largest_error(points, degree).p}, map);
}

/// α = p(θ). An error of α counts by the error of θ that it causes, dθ/dα times as large.
EqualityFit fit_of_theta(const AngleMap& map) {
  std::vector<FitPoint> points;
  for (int i = 0; i <= k_fit_intervals; ++i) {
    const double theta = std::lerp(map.theta_min, map.theta_max, double(i) / k_fit_intervals), alpha = map.alpha(theta);
    points.push_back({theta, alpha, map.slope(alpha)});
  }
  return measured({.of_alpha = false, .p = least_largest_error(points, k_equality_degree).p}, map);
}

}  // namespace

double Polynomial::operator()(double x) const {
  double value = 0;
  for (std::size_t i = c.size(); i-- > 0;) value = value * x + c[i];
  return value;
}

double Polynomial::slope(double x) const {
  double value = 0;
  for (std::size_t i = c.size(); i-- > 1;) value = value * x + static_cast<double>(i) * c[i];
  return value;
}

// On degree + 2 of the points, the reference, the best polynomial p has errors of equal magnitude |h| and alternating
// signs: p(x_i) + (−1)^i h / w_i = y_i, a linear system in the coefficients of p and h. If the largest error over all
// points is at a point of the reference, p is the best polynomial. Otherwise that point enters the reference, and |h|
// increases.
PolynomialFit least_largest_error(const std::vector<FitPoint>& points, int degree) {
  const std::size_t n = static_cast<std::size_t>(degree) + 2;
  demand(points.size() > n && points.back().x > points.front().x,
         "a fit of " + std::to_string(points.size()) + " points");
  const double middle = 0.5 * (points.front().x + points.back().x), half = 0.5 * (points.back().x - points.front().x);
  // The first reference is near the extremes of a Chebyshev polynomial.
  std::vector<std::size_t> reference;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 0.5 - 0.5 * elementary::cos(k_pi * static_cast<double>(i) / static_cast<double>(n - 1));
    const auto at = static_cast<std::size_t>(std::lround(t * static_cast<double>(points.size() - 1)));
    reference.push_back(reference.empty() ? at : std::max(at, reference.back() + 1));
  }
  Eigen::VectorXd best = Eigen::VectorXd::Zero(degree + 1);
  double least = std::numeric_limits<double>::infinity();
  constexpr int k_most_exchanges = 200;
  std::vector<double> errors(points.size());
  for (int step = 0; step < k_most_exchanges; ++step) {
    Eigen::MatrixXd A(n, n);
    Eigen::VectorXd b(n);
    for (std::size_t i = 0; i < n; ++i) {
      const FitPoint& point = points[reference[i]];
      const auto row = static_cast<Eigen::Index>(i);
      A.row(row).head(degree + 1) = chebyshev((point.x - middle) / half, degree).transpose();
      A(row, degree + 1) = (i % 2 == 0 ? 1.0 : -1.0) / point.weight;
      b(row) = point.y;
    }
    const Eigen::VectorXd solution = A.partialPivLu().solve(b);
    std::size_t worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double fitted = chebyshev((points[i].x - middle) / half, degree).dot(solution.head(degree + 1));
      errors[i] = points[i].weight * (points[i].y - fitted);
      if (std::abs(errors[i]) > std::abs(errors[worst])) worst = i;
    }
    if (const double largest = std::abs(errors[worst]); largest < least) {
      least = largest;
      best = solution.head(degree + 1);
    }
    const bool is_best = std::abs(errors[worst]) <= std::abs(solution(degree + 1)) * (1 + 1e-9) + 1e-15;
    if (is_best || std::find(reference.begin(), reference.end(), worst) != reference.end()) break;
    exchange(reference, errors, worst);
  }
  return {in_x(best, middle, half), least};
}

EqualityFit measured(EqualityFit fit, const AngleMap& map) {
  fit.error = fit.slope_error = 0;
  for (const double alpha : sampled_alphas(map)) {
    const double theta = map.theta(alpha), slope = map.slope(alpha);
    const double fitted = fit.of_alpha ? fit.p(alpha) : solved(fit.p, alpha, theta);
    const double fitted_slope = fit.of_alpha ? fit.p.slope(alpha) : 1 / fit.p.slope(fitted);
    const double error = std::abs(fitted - theta), slope_error = std::abs(fitted_slope / slope - 1);
    // An equality that has no solution counts as wrong by half a turn, and its slope by 100 %.
    fit.error = std::isfinite(error) ? std::max(fit.error, error) : k_pi;
    fit.slope_error = std::isfinite(slope_error) ? std::max(fit.slope_error, slope_error) : 1;
  }
  return fit;
}

EqualityFit fit_equality(const AngleMap& map) {
  const EqualityFit of_alpha = fit_of_alpha(map, k_equality_degree);
  const EqualityFit of_theta = fit_of_theta(map);
  return of_theta.error < of_alpha.error ? of_theta : of_alpha;
}

EqualityFit fit_line(const AngleMap& map) { return fit_of_alpha(map, 1); }

}  // namespace fusee::model
