#include "export/step/normal_spline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/decompositions.h"
#include "fusee/base.h"
#include "profile/pitch_curve.h"

namespace fusee::formats {
namespace {

constexpr int k_order = k_step_degree + 1;
constexpr double k_first_span = radians(30);
/// Error of a circle of the radius `reach` that the fitted normals draw, mm. It must coincide with the exact circle.
constexpr double k_circle_tolerance = 2e-6;
/// Shorter spans are not divided: beside a bridge, the directions of two samples can be this close.
constexpr double k_shortest_span = radians(0.01);
constexpr std::size_t k_most_spans = 300;
constexpr int k_samples_a_span = 13;
/// Spans are refined together if their error is at least this share of the worst one.
constexpr double k_share_of_worst = 0.25;
/// Kinks closer than this are merged.
constexpr double k_same_kink = radians(0.002);
/// Ratio of a curve's mean radius to those of both adjacent samples above which the curve is straight.
constexpr double k_straight_beside = 3;
/// Turn of the normals over a straight: its middle projects by an eighth of that, 1e-5 of its length.
constexpr double k_straight_turn = radians(0.005);

/// A knot and its multiplicity.
struct Break {
  double psi = 0;
  int multiplicity = 1;
};

std::size_t span_of(const std::vector<double>& knots, double psi) {
  const auto last = knots.end() - k_order;
  const auto above = std::upper_bound(knots.begin() + k_order, last, psi);
  return static_cast<std::size_t>(above - knots.begin()) - 1;
}

/// The non-zero basis functions at ψ, by the recursion of Cox and de Boor. The first has the number span − degree.
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
    knots.insert(knots.end(), static_cast<std::size_t>(breaks[i].multiplicity), breaks[i].psi);
  knots.insert(knots.end(), k_order, breaks.back().psi);
  return knots;
}

std::vector<Break> first_breaks(double from, double to, const std::vector<double>& kinks) {
  std::vector<Break> breaks{{from, 1}};
  std::vector<double> inside;
  for (const double kink : kinks) {
    const double psi = profile::turned_into(from, kink);
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

/// Least squares fit of samples, with exact ends and end tangents. Adjacent pieces then join as smoothly as the curve.
class SectorFit {
 public:
  explicit SectorFit(const SplineTarget& target) : target_(target) {}

  SplineBundle fit_on(const std::vector<Break>& breaks) const {
    SplineBundle spline{flat_knots(breaks), {}};
    const std::size_t count = spline.knots.size() - k_order;
    // Poles at each end that are given by the end, and by its tangent if there are enough poles.
    const std::size_t fixed = count >= 6 ? 2 : 1;
    const double from = breaks.front().psi, to = breaks.back().psi;
    Eigen::MatrixXd& poles = spline.poles;
    poles = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(count), target_.at(from).size());
    set_end(poles, spline.knots, 0, from, fixed);
    set_end(poles, spline.knots, count - 1, to, fixed);
    const auto free = static_cast<Eigen::Index>(count - 2 * fixed);
    if (free > 0) {
      Eigen::MatrixXd normal_matrix = Eigen::MatrixXd::Zero(free, free);
      Eigen::MatrixXd right_side = Eigen::MatrixXd::Zero(free, poles.cols());
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const double begin = breaks[i].psi, width = breaks[i + 1].psi - begin;
        for (int k = 0; k < k_samples_a_span; ++k) {
          const double psi = begin + width * (k + 0.5) / k_samples_a_span;
          const std::size_t span = span_of(spline.knots, psi);
          const auto basis = basis_at(spline.knots, span, psi);
          Eigen::RowVectorXd residual = target_.at(psi);
          const std::size_t first = span - k_step_degree;
          for (std::size_t a = 0; a < k_order; ++a) {
            if (is_fixed(first + a, count, fixed))
              residual -= basis[a] * poles.row(static_cast<Eigen::Index>(first + a));
          }
          for (std::size_t a = 0; a < k_order; ++a) {
            if (is_fixed(first + a, count, fixed)) continue;
            const auto row = static_cast<Eigen::Index>(first + a - fixed);
            right_side.row(row) += width * basis[a] * residual;
            for (std::size_t b = 0; b < k_order; ++b) {
              if (!is_fixed(first + b, count, fixed))
                normal_matrix(row, static_cast<Eigen::Index>(first + b - fixed)) += width * basis[a] * basis[b];
            }
          }
        }
      }
      poles.middleRows(static_cast<Eigen::Index>(fixed), free) = solved(normal_matrix, right_side);
    }
    return spline;
  }

  /// The spans to refine, in order: their error exceeds the tolerance, and k_share_of_worst of the worst one. Other
  /// spans wait, because a sharp bend makes the fit oscillate beside it until the bend is resolved.
  std::vector<std::size_t> coarse_spans(const SplineBundle& spline, const std::vector<Break>& breaks) const {
    constexpr int k_samples = 24;
    std::vector<double> errors;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const double begin = breaks[i].psi, width = breaks[i + 1].psi - begin;
      double worst = 0;
      for (int k = 0; k < k_samples; ++k) {
        const double psi = begin + width * (k + 0.31) / k_samples;  // between the samples of the fit
        worst = std::max(worst, target_.error(spline.at(psi), psi));
      }
      errors.push_back(width > k_shortest_span ? worst : 0.0);
    }
    const double threshold = k_share_of_worst * *std::max_element(errors.begin(), errors.end());
    std::vector<std::size_t> coarse;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (errors[i] > std::max(1.0, threshold)) coarse.push_back(i);
    }
    return coarse;
  }

 private:
  static bool is_fixed(std::size_t i, std::size_t count, std::size_t fixed) { return i < fixed || i + fixed >= count; }

  void set_end(Eigen::MatrixXd& poles, const std::vector<double>& knots, std::size_t pole, double psi,
               std::size_t fixed) const {
    const auto row = static_cast<Eigen::Index>(pole);
    poles.row(row) = target_.at(psi);
    if (fixed < 2) return;
    const bool first = pole == 0;
    const double step =
        first ? knots[k_order] - knots[k_order - 1] : knots[knots.size() - k_order - 1] - knots[knots.size() - k_order];
    const double share = step / k_step_degree;
    poles.row(first ? row + 1 : row - 1) = poles.row(row) + share * target_.slope(psi);
  }

  const SplineTarget& target_;
};

/// Removes the knots without which the tolerance is still met.
std::vector<Break> thinned(const SectorFit& sector, std::vector<Break> breaks) {
  for (std::size_t i = 1; i + 1 < breaks.size();) {
    std::vector<Break> fewer = breaks;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    if (breaks[i].multiplicity == 1 && sector.coarse_spans(sector.fit_on(fewer), fewer).empty())
      breaks = std::move(fewer);
    else
      ++i;
  }
  return breaks;
}

/// A curve's radii at its samples, from the chords to both neighbours.
std::vector<double> radii_beside(const std::vector<double>& psi, const std::vector<Vec2>& points) {
  std::vector<double> means, radii;
  for (std::size_t i = 0; i + 1 < psi.size(); ++i)
    means.push_back((points[i + 1] - points[i]).norm() / (psi[i + 1] - psi[i]));
  for (std::size_t i = 0; i < means.size(); ++i) {
    const auto [less, more] = std::minmax(means[i], means[i == 0 ? means.size() - 1 : i - 1]);
    // Beside a straight, the radius of the curved side is used.
    radii.push_back(more > k_straight_beside * less ? less : 2 * less * more / (less + more));
  }
  return radii;
}

}  // namespace

std::array<double, 6> hermite_powers(double h0, double d0, double e0, double h1, double d1, double e1) {
  // Remainders at u = 1, of the value and of its first and half its second derivative, after the first three powers.
  const double rise = h1 - h0 - d0 - e0, slope_rise = d1 - d0 - 2 * e0, bend_rise = e1 - e0;
  return {h0,
          d0,
          e0,
          10 * rise - 4 * slope_rise + bend_rise,
          -15 * rise + 7 * slope_rise - 2 * bend_rise,
          6 * rise - 3 * slope_rise + bend_rise};
}

SupportCurve::SupportCurve(std::vector<double> psi, std::vector<Vec2> points, std::vector<double> radii) {
  const auto close = [&] {
    psi.push_back(psi.front() + k_two_pi);
    points.push_back(points.front());
  };
  close();
  if (radii.empty()) radii = radii_beside(psi, points);
  radii.push_back(radii.front());
  for (std::size_t i = 0; i + 1 < psi.size(); ++i) {
    const Sample from{psi[i], points[i], radii[i]}, to{psi[i + 1], points[i + 1], radii[i + 1]};
    const auto straight = straight_between(from, to);
    add(from, straight ? straight->first : to);
    if (!straight) continue;
    kinks_.insert(kinks_.end(), {straight->first.psi, straight->second.psi});
    add(straight->first, straight->second);
    add(straight->second, to);
  }
  psi_.push_back(psi.back());
}

// The Hermite polynomial of degree 5 with the radii of both ends. If the curve is then not convex, as beside a bridge
// over a hollow: the one of degree 3, which ignores the radii.
void SupportCurve::add(const Sample& from, const Sample& to) {
  constexpr int k_samples = 8;
  const double width = to.psi - from.psi;
  const double h0 = from.support(), d0 = width * from.slope(), e0 = 0.5 * width * width * (from.radius - h0);
  const double h1 = to.support(), d1 = width * to.slope(), e1 = 0.5 * width * width * (to.radius - h1);
  psi_.push_back(from.psi);
  support_.push_back(hermite_powers(h0, d0, e0, h1, d1, e1));
  for (int k = 1; k < k_samples; ++k) {
    if (values_in(support_.size() - 1, width, static_cast<double>(k) / k_samples).radius >= 0) continue;
    support_.back() = {h0, d0, 3 * (h1 - h0) - 2 * d0 - d1, d0 + d1 - 2 * (h1 - h0), 0, 0};
    return;
  }
}

std::size_t SupportCurve::interval_of(double psi) const {
  const auto above = std::upper_bound(psi_.begin() + 1, psi_.end() - 1, psi);
  return static_cast<std::size_t>(above - psi_.begin()) - 1;
}

SupportCurve::Values SupportCurve::values_in(std::size_t interval, double width, double u) const {
  double h = 0, dh = 0, half_ddh = 0;
  for (auto c = support_[interval].rbegin(); c != support_[interval].rend(); ++c) {
    half_ddh = half_ddh * u + dh;
    dh = dh * u + h;
    h = h * u + *c;
  }
  return {h, dh / width, h + 2 * half_ddh / (width * width)};
}

SupportCurve::Values SupportCurve::values_at(double psi) const {
  psi = profile::turned_into(psi_.front(), psi);
  const std::size_t i = interval_of(psi);
  const double width = psi_[i + 1] - psi_[i];
  return values_in(i, width, (psi - psi_[i]) / width);
}

Vec2 SupportCurve::at(double psi) const {
  const Values values = values_at(psi);
  return values.support * unit(psi) + values.slope * turned_left(unit(psi));
}

// The common outer tangent of both circles of curvature: n · (c1 − c0) = r0 − r1. Its single normal
// is spread over the angle k_straight_turn, so that the straight has an extent in ψ.
std::optional<std::pair<SupportCurve::Sample, SupportCurve::Sample>> SupportCurve::straight_between(const Sample& from,
                                                                                                    const Sample& to) {
  const double width = to.psi - from.psi, mean = (to.point - from.point).norm() / width;
  if (mean <= k_straight_beside * std::max(from.radius, to.radius)) return std::nullopt;
  const Vec2 c0 = from.point - from.radius * unit(from.psi), c1 = to.point - to.radius * unit(to.psi);
  const Vec2 between = c1 - c0;
  const double half = 0.5 * k_straight_turn;
  // Cosine of the angle between the tangent's normal and the line of centres.
  const double cosine = (from.radius - to.radius) / between.norm();
  if (!(std::abs(cosine) < 1)) return std::nullopt;
  const double psi = profile::turned_into(from.psi - 0.5 * k_pi,
                                          elementary::atan2(between.y(), between.x()) - elementary::acos(cosine));
  if (psi - from.psi < 2 * half || to.psi - psi < 2 * half) return std::nullopt;
  const auto on_circle = [](const Vec2& centre, double radius, double at) {
    return Sample{at, centre + radius * unit(at), radius};
  };
  return std::pair(on_circle(c0, from.radius, psi - half), on_circle(c1, to.radius, psi + half));
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

Eigen::RowVectorXd SplineBundle::at(double psi) const {
  const std::size_t span = span_of(knots, psi);
  const auto basis = basis_at(knots, span, psi);
  Eigen::RowVectorXd values = Eigen::RowVectorXd::Zero(poles.cols());
  for (std::size_t a = 0; a < k_order; ++a)
    values += basis[a] * poles.row(static_cast<Eigen::Index>(span - k_step_degree + a));
  return values;
}

std::optional<SplineBundle> fit(const SplineTarget& target, double from, double to, const std::vector<double>& kinks) {
  const SectorFit sector(target);
  std::vector<Break> breaks = first_breaks(from, to, kinks);
  while (true) {
    const SplineBundle spline = sector.fit_on(breaks);
    const std::vector<std::size_t> coarse = sector.coarse_spans(spline, breaks);
    if (coarse.empty()) return sector.fit_on(thinned(sector, breaks));
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

std::optional<NormalSpline> fit(const SupportCurve& curve, double from, double to, const std::vector<double>& kinks,
                                double tolerance, double reach) {
  const auto row_of = [](const Vec2& point, const Vec2& normal) {
    return Eigen::RowVectorXd(Eigen::RowVector4d(point.x(), point.y(), normal.x(), normal.y()));
  };
  SplineTarget target;
  target.at = [&](double psi) { return row_of(curve.at(psi), unit(psi)); };
  target.slope = [&](double psi) {
    const Vec2 tangent = turned_left(unit(psi));
    return row_of(curve.radius_at(psi) * tangent, tangent);
  };
  target.error = [&](const Eigen::RowVectorXd& fitted, double psi) {
    return std::max((Vec2(fitted(0), fitted(1)) - curve.at(psi)).norm() / tolerance,
                    reach * (Vec2(fitted(2), fitted(3)) - unit(psi)).norm() / k_circle_tolerance);
  };
  std::vector<double> all_kinks = kinks;
  all_kinks.insert(all_kinks.end(), curve.kinks().begin(), curve.kinks().end());
  const auto fitted = fit(target, from, to, all_kinks);
  if (!fitted) return std::nullopt;
  NormalSpline spline{fitted->knots, {}, {}};
  for (Eigen::Index i = 0; i < fitted->poles.rows(); ++i) {
    spline.position.emplace_back(fitted->poles(i, 0), fitted->poles(i, 1));
    spline.normal.emplace_back(fitted->poles(i, 2), fitted->poles(i, 3));
  }
  return spline;
}

}  // namespace fusee::formats
