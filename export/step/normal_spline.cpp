#include "export/step/normal_spline.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "fusee/base/units.h"
#include "profile/pitch_curve.h"

namespace fusee {
namespace {

constexpr int k_order = k_step_degree + 1;
constexpr double k_first_span = radians(30);
/// Of a circle within reach that is drawn by the normals, mm: it has to meet the true one.
constexpr double k_circle_tolerance = 2e-6;
/// Nothing is gained by shorter ones: directions of the samples themselves are as near as this beside a bridge.
constexpr double k_shortest_span = radians(0.01);
constexpr std::size_t k_most_spans = 300;
constexpr int k_samples_a_span = 13;
constexpr double k_share_of_worst = 0.25;
/// Two kinks nearer than this are one.
constexpr double k_same_kink = radians(0.02);

/// A knot and how often it counts.
struct Break {
  double psi = 0;
  int times = 1;
};

std::size_t span_of(const std::vector<double>& knots, double psi) {
  const auto last = knots.end() - k_order;
  const auto above = std::upper_bound(knots.begin() + k_order, last, psi);
  return static_cast<std::size_t>(above - knots.begin()) - 1;
}

/// The basis functions that are not 0 at ψ, by the recursion of Cox and de Boor; the first is number span − degree.
std::array<double, k_order> basis_at(const std::vector<double>& knots, std::size_t span, double psi) {
  std::array<double, k_order> values{1.0};
  std::array<double, k_order> left{}, right{};
  for (std::size_t j = 1; j < k_order; ++j) {
    left[j] = psi - knots[span + 1 - j];
    right[j] = knots[span + j] - psi;
    double saved = 0;
    for (std::size_t r = 0; r < j; ++r) {
      const double share = values[r] / (right[r + 1] + left[j - r]);
      values[r] = saved + right[r + 1] * share;
      saved = left[j - r] * share;
    }
    values[j] = saved;
  }
  return values;
}

std::vector<double> flat_knots(const std::vector<Break>& breaks) {
  std::vector<double> knots(k_order, breaks.front().psi);
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i)
    knots.insert(knots.end(), static_cast<std::size_t>(breaks[i].times), breaks[i].psi);
  knots.insert(knots.end(), k_order, breaks.back().psi);
  return knots;
}

std::vector<Break> first_breaks(double from, double to, const std::vector<double>& kinks) {
  std::vector<Break> breaks{{from, 1}};
  std::vector<double> inside;
  for (const double kink : kinks) {
    const double psi = turned_into(from, kink);
    if (psi > from + k_same_kink && psi < to - k_same_kink) inside.push_back(psi);
  }
  std::sort(inside.begin(), inside.end());
  inside.push_back(to);
  for (const double psi : inside) {
    const double begin = breaks.back().psi;
    if (psi - begin < k_same_kink) continue;
    const int spans = std::max(1, static_cast<int>(std::ceil((psi - begin) / k_first_span)));
    for (int k = 1; k < spans; ++k) breaks.push_back({begin + (psi - begin) * k / spans, 1});
    breaks.push_back({psi, k_step_degree - 1});
  }
  return breaks;
}

/// Least squares through samples, both ends met exactly, and where radii are known both tangents' lengths too: pieces
/// side by side then join as smoothly as the curve.
class SectorFit {
 public:
  SectorFit(const SupportCurve& curve, double tolerance, double reach)
      : curve_(curve), tolerance_(tolerance), reach_(reach) {}

  NormalSpline on(const std::vector<Break>& breaks) const {
    NormalSpline spline{flat_knots(breaks), {}, {}};
    const std::size_t count = spline.knots.size() - k_order;
    const std::size_t fixed = curve_.is_drawn_with_radii() && count >= 6 ? 2 : 1;
    Eigen::MatrixXd poles = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(count), 4);
    const double from = breaks.front().psi, to = breaks.back().psi;
    set_end(poles, spline.knots, 0, from, fixed);
    set_end(poles, spline.knots, count - 1, to, fixed);
    const auto free = static_cast<Eigen::Index>(count - 2 * fixed);
    if (free > 0) {
      Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(free, free), right = Eigen::MatrixXd::Zero(free, 4);
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const double begin = breaks[i].psi, width = breaks[i + 1].psi - begin;
        for (int k = 0; k < k_samples_a_span; ++k) {
          const double psi = begin + width * (k + 0.5) / k_samples_a_span;
          const std::size_t span = span_of(spline.knots, psi);
          const auto basis = basis_at(spline.knots, span, psi);
          Eigen::RowVector4d rest = wanted(psi);
          const std::size_t first = span - k_step_degree;
          for (std::size_t a = 0; a < k_order; ++a) {
            if (is_fixed(first + a, count, fixed)) rest -= basis[a] * poles.row(static_cast<Eigen::Index>(first + a));
          }
          for (std::size_t a = 0; a < k_order; ++a) {
            if (is_fixed(first + a, count, fixed)) continue;
            const auto row = static_cast<Eigen::Index>(first + a - fixed);
            right.row(row) += width * basis[a] * rest;
            for (std::size_t b = 0; b < k_order; ++b) {
              if (!is_fixed(first + b, count, fixed))
                normal(row, static_cast<Eigen::Index>(first + b - fixed)) += width * basis[a] * basis[b];
            }
          }
        }
      }
      poles.middleRows(static_cast<Eigen::Index>(fixed), free) = normal.ldlt().solve(right);
    }
    for (Eigen::Index i = 0; i < poles.rows(); ++i) {
      spline.position.emplace_back(poles(i, 0), poles(i, 1));
      spline.normal.emplace_back(poles(i, 2), poles(i, 3));
    }
    return spline;
  }

  /// The spans within which the spline is too far off, the worst first: a place that is bent sharply makes its
  /// neighbours swing, which are well when it is.
  std::vector<std::size_t> coarse_spans(const NormalSpline& spline, const std::vector<Break>& breaks) const {
    constexpr int k_looks = 24;
    const StepSpline positions{spline.knots, spline.position}, normals{spline.knots, spline.normal};
    std::vector<double> errors;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const double begin = breaks[i].psi, width = breaks[i + 1].psi - begin;
      double worst = 0;
      for (int k = 0; k < k_looks; ++k) {
        const double psi = begin + width * (k + 0.31) / k_looks;
        worst = std::max({worst, (point_on(positions, psi) - curve_.at(psi)).norm() / tolerance_,
                          reach_ * (point_on(normals, psi) - unit(psi)).norm() / k_circle_tolerance});
      }
      errors.push_back(width > k_shortest_span ? worst : 0.0);
    }
    const double most = k_share_of_worst * *std::max_element(errors.begin(), errors.end());
    std::vector<std::size_t> coarse;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (errors[i] > std::max(1.0, most)) coarse.push_back(i);
    }
    return coarse;
  }

 private:
  static bool is_fixed(std::size_t i, std::size_t count, std::size_t fixed) { return i < fixed || i + fixed >= count; }

  Eigen::RowVector4d wanted(double psi) const {
    const Vec2 point = curve_.at(psi), normal = unit(psi);
    return {point.x(), point.y(), normal.x(), normal.y()};
  }

  void set_end(Eigen::MatrixXd& poles, const std::vector<double>& knots, std::size_t end, double psi,
               std::size_t fixed) const {
    const auto row = static_cast<Eigen::Index>(end);
    poles.row(row) = wanted(psi);
    if (fixed < 2) return;
    const bool first = end == 0;
    const double step =
        first ? knots[k_order] - knots[k_order - 1] : knots[knots.size() - k_order - 1] - knots[knots.size() - k_order];
    const Vec2 tangent = turned_left(unit(psi));
    const double radius = curve_.radius_near(psi), share = step / k_step_degree;
    Eigen::RowVector4d slope;
    slope << radius * tangent.x(), radius * tangent.y(), tangent.x(), tangent.y();
    poles.row(first ? row + 1 : row - 1) = poles.row(row) + share * slope;
  }

  const SupportCurve& curve_;
  double tolerance_;
  double reach_;
};

}  // namespace

SupportCurve::SupportCurve(std::vector<double> psi, const std::vector<Vec2>& points, const std::vector<double>& radii)
    : psi_(std::move(psi)), with_radii_(!radii.empty()) {
  for (std::size_t i = 0; i < psi_.size(); ++i) {
    const Vec2 normal = unit(psi_[i]);
    h_.push_back(points[i].dot(normal));
    dh_.push_back(points[i].dot(turned_left(normal)));
    if (with_radii_) ddh_.push_back(radii[i] - h_.back());
  }
  for (auto* values : {&h_, &dh_, &ddh_}) {
    if (!values->empty()) values->push_back(values->front());
  }
  psi_.push_back(psi_.front() + k_two_pi);
}

std::size_t SupportCurve::interval_of(double& psi) const {
  psi = turned_into(psi_.front(), psi);
  const auto above = std::upper_bound(psi_.begin() + 1, psi_.end() - 1, psi);
  return static_cast<std::size_t>(above - psi_.begin()) - 1;
}

double SupportCurve::radius_near(double psi) const {
  const std::size_t i = interval_of(psi);
  const double share = (psi - psi_[i]) / (psi_[i + 1] - psi_[i]);
  return (1 - share) * (h_[i] + ddh_[i]) + share * (h_[i + 1] + ddh_[i + 1]);
}

// Newton's form on the nodes 0, 0, (0,) 1, 1, (1) of the interval, and its derivative.
Vec2 SupportCurve::at(double psi) const {
  const std::size_t i = interval_of(psi);
  const double width = psi_[i + 1] - psi_[i], u = (psi - psi_[i]) / width;
  const double h0 = h_[i], h1 = h_[i + 1], d0 = width * dh_[i], d1 = width * dh_[i + 1];
  double h = 0, dh = 0;
  const double rise = h1 - h0, b0 = rise - d0, b1 = d1 - rise;
  // Beside a bridge over a hollow radii are no second derivatives.
  const bool quintic = with_radii_ && std::abs(dh_[i + 1] - dh_[i] - 0.5 * width * (ddh_[i] + ddh_[i + 1])) <=
                                          0.1 * std::abs(0.5 * width * (h0 + ddh_[i] + h1 + ddh_[i + 1]));
  if (quintic) {
    const double e0 = 0.5 * width * width * ddh_[i], e1 = 0.5 * width * width * ddh_[i + 1];
    const double c0 = b0 - e0, c1 = b1 - b0, c2 = e1 - b1;
    const double f0 = c1 - c0, f1 = c2 - c1, g = f1 - f0, v = u - 1;
    h = h0 + u * (d0 + u * (e0 + u * (c0 + v * (f0 + v * g))));
    dh = d0 + 2 * u * e0 + 3 * u * u * c0 + f0 * (3 * u * u * v + u * u * u) +
         g * (3 * u * u * v * v + 2 * u * u * u * v);
  } else {
    const double c = b1 - b0, v = u - 1;
    h = h0 + u * (d0 + u * (b0 + v * c));
    dh = d0 + 2 * u * b0 + c * (2 * u * v + u * u);
  }
  return h * unit(psi) + dh / width * turned_left(unit(psi));
}

StepSpline NormalSpline::parallel(double distance) const {
  StepSpline spline{knots, position};
  for (std::size_t i = 0; i < spline.poles.size(); ++i) spline.poles[i] += distance * normal[i];
  return spline;
}

Vec2 point_on(const StepSpline& spline, double psi) {
  const std::size_t span = span_of(spline.knots, psi);
  const auto basis = basis_at(spline.knots, span, psi);
  Vec2 point = Vec2::Zero();
  for (std::size_t a = 0; a < k_order; ++a) point += basis[a] * spline.poles[span - k_step_degree + a];
  return point;
}

std::optional<NormalSpline> fit(const SupportCurve& curve, double from, double to, const std::vector<double>& kinks,
                                double tolerance, double reach) {
  const SectorFit sector(curve, tolerance, reach);
  std::vector<Break> breaks = first_breaks(from, to, kinks);
  while (true) {
    const NormalSpline spline = sector.on(breaks);
    const std::vector<std::size_t> coarse = sector.coarse_spans(spline, breaks);
    if (coarse.empty()) return spline;
    if (breaks.size() + coarse.size() > k_most_spans) return std::nullopt;
    std::vector<Break> finer;
    auto next = coarse.begin();
    for (std::size_t i = 0; i < breaks.size(); ++i) {
      finer.push_back(breaks[i]);
      if (next == coarse.end() || *next != i) continue;
      finer.push_back({0.5 * (breaks[i].psi + breaks[i + 1].psi), 1});
      ++next;
    }
    breaks = std::move(finer);
  }
}

}  // namespace fusee
