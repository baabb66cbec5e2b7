#include "solid/outline_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/decompositions.h"
#include "fusee/base.h"

namespace fusee::solid {
namespace {

// Number of directions in which outlines are compared: every half degree. A facet of a pulley's outline turns by up to
// two degrees.
constexpr int k_directions = 720;
// Number of directions for rating the turns that are tried.
constexpr int k_coarse_directions = 180;
// Number of turns tried. A descent from within 2° of the correct turn finds it, because outlines of pulleys have no
// finer features.
constexpr int k_coarse_turns = 180;
// Number of turns from which a descent starts, its largest number of steps, and the step at which it ends (rad and mm).
constexpr std::size_t k_descents = 6;
constexpr int k_most_steps = 40;
constexpr double k_last_step = 1e-10;
// Outlines are round if every turn fits with a smaller rms distance, mm. Three times the sagitta of a pulley's facets.
constexpr double k_round_rms = 0.03;
// Fraction of the directions that count as undisturbed.
constexpr double k_kept_share = 0.75;
// Distance at which Tukey's weights become 0, in medians of the distances, and its least value: the resolution of
// floats, 0.1 µm.
constexpr double k_medians_kept = 6.0;
constexpr double k_least_kept = 1e-4;

/// The support function of a convex hull.
class HullSupport {
 public:
  explicit HullSupport(const Polygon& outline) : corners_(convex_hull(outline)) {
    demand(corners_.size() >= 3, "an outline without an inside");
    const std::size_t n = corners_.size();
    double last = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 edge = corners_[(i + 1) % n] - corners_[i];
      double normal = elementary::atan2(-edge.x(), edge.y());
      if (i > 0) normal += k_two_pi * std::ceil((last - normal) / k_two_pi);
      normals_.push_back(normal);
      last = normal;
    }
  }

  /// The corner furthest along unit(psi).
  const Vec2& furthest(double psi) const {
    const double first = normals_.front();
    const double from_first = psi - first - k_two_pi * std::floor((psi - first) / k_two_pi);
    const auto next = std::upper_bound(normals_.begin(), normals_.end(), first + from_first);
    return corners_[static_cast<std::size_t>(next - normals_.begin()) % corners_.size()];
  }

 private:
  Polygon corners_;
  std::vector<double> normals_;  ///< of the edge that leaves each corner, increasing
};

struct SupportPair {
  HullSupport found;
  HullSupport expected;
};

std::vector<SupportPair> supports_of(const std::vector<OutlinePair>& pairs) {
  std::vector<SupportPair> supports;
  for (const OutlinePair& pair : pairs) supports.push_back({HullSupport(pair.found), HullSupport(pair.expected)});
  return supports;
}

/// Distance of the found tangent outside the expected one along each direction, and its derivatives by turn and shift.
struct Gaps {
  Eigen::VectorXd size;
  Eigen::Matrix<double, Eigen::Dynamic, 3> slope;
};

Gaps gaps(const std::vector<SupportPair>& pairs, const PlaneMotion& motion, int directions) {
  const auto rows = static_cast<Eigen::Index>(pairs.size()) * directions;
  Gaps all{Eigen::VectorXd(rows), Eigen::Matrix<double, Eigen::Dynamic, 3>(rows, 3)};
  Eigen::Index row = 0;
  for (const SupportPair& pair : pairs) {
    for (int k = 0; k < directions; ++k, ++row) {
      const double psi = k_two_pi * k / directions;
      const Vec2 normal = unit(psi);
      const Vec2 arm = turned(pair.found.furthest(psi - motion.turn), motion.turn);
      all.size[row] = (arm + motion.shift - pair.expected.furthest(psi)).dot(normal);
      all.slope.row(row) << cross(arm, normal), normal.x(), normal.y();
    }
  }
  return all;
}

std::vector<double> sorted_sizes(const Eigen::VectorXd& gaps) {
  std::vector<double> sizes(static_cast<std::size_t>(gaps.size()));
  for (std::size_t i = 0; i < sizes.size(); ++i) sizes[i] = std::abs(gaps[static_cast<Eigen::Index>(i)]);
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

// The rms distance without the worst directions.
double kept_rms(const Eigen::VectorXd& gaps) {
  std::vector<double> sizes = sorted_sizes(gaps);
  sizes.resize(static_cast<std::size_t>(k_kept_share * static_cast<double>(sizes.size())));
  const double squares = std::inner_product(sizes.begin(), sizes.end(), sizes.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(sizes.size()));
}

// Tukey's biweight, which is 0 from the distance `end` on.
double tukey_weight(double gap, double end) {
  const double share = gap / end;
  return std::abs(share) < 1 ? (1 - share * share) * (1 - share * share) : 0.0;
}

/// The Gauss-Newton step (turn, shift): the solution of the weighted normal equations.
Eigen::Vector3d step_of(const Gaps& gaps, const Eigen::VectorXd& weights) {
  const Eigen::Matrix3d normal_matrix = gaps.slope.transpose() * weights.asDiagonal() * gaps.slope;
  const Eigen::VectorXd right_side = gaps.slope.transpose() * weights.asDiagonal() * gaps.size;
  return -solved(normal_matrix, right_side);
}

/// The Gauss-Newton step of the shift alone.
Eigen::Vector3d shift_step_of(const Gaps& gaps, const Eigen::VectorXd& weights) {
  const auto slope = gaps.slope.rightCols<2>();
  const Eigen::Matrix2d normal_matrix = slope.transpose() * weights.asDiagonal() * slope;
  const Eigen::VectorXd right_side = slope.transpose() * weights.asDiagonal() * gaps.size;
  const Eigen::VectorXd step = -solved(normal_matrix, right_side);
  return {0.0, step.x(), step.y()};
}

/// The best motion near `motion`, by Gauss-Newton steps with Tukey's weights. Without `may_turn` it keeps its turn.
PlaneMotion descended(const std::vector<SupportPair>& pairs, PlaneMotion motion, bool may_turn) {
  for (int i = 0; i < k_most_steps; ++i) {
    const Gaps here = gaps(pairs, motion, k_directions);
    const std::vector<double> sizes = sorted_sizes(here.size);
    const double end = std::max(k_least_kept, k_medians_kept * sizes[sizes.size() / 2]);
    const Eigen::VectorXd weights = here.size.unaryExpr([end](double gap) { return tukey_weight(gap, end); });
    const Eigen::Vector3d step = may_turn ? step_of(here, weights) : shift_step_of(here, weights);
    motion.turn += step[0];
    motion.shift += step.tail<2>();
    if (step.norm() < k_last_step) break;
  }
  return motion;
}

struct RatedMotion {
  PlaneMotion motion;
  double rms = 0;
};

/// All coarse turns, each with its best shift by least squares. For N evenly spread directions with unit normals n this
/// is −2/N Σ gap · n.
std::vector<RatedMotion> coarse_motions(const std::vector<SupportPair>& pairs) {
  std::vector<RatedMotion> all;
  for (int k = 0; k < k_coarse_turns; ++k) {
    PlaneMotion motion{k_two_pi * k / k_coarse_turns, Vec2::Zero()};
    const Gaps unshifted = gaps(pairs, motion, k_coarse_directions);
    motion.shift = -2.0 / static_cast<double>(k_coarse_directions * pairs.size()) *
                   unshifted.slope.rightCols<2>().transpose() * unshifted.size;
    all.push_back({motion, kept_rms(gaps(pairs, motion, k_coarse_directions).size)});
  }
  return all;
}

/// The local minima, from which descents start.
std::vector<RatedMotion> valleys_of(const std::vector<RatedMotion>& all) {
  std::vector<RatedMotion> lowest;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const RatedMotion &before = all[(k + all.size() - 1) % all.size()], &after = all[(k + 1) % all.size()];
    if (all[k].rms <= before.rms && all[k].rms <= after.rms) lowest.push_back(all[k]);
  }
  std::stable_sort(lowest.begin(), lowest.end(), [](const auto& a, const auto& b) { return a.rms < b.rms; });
  lowest.resize(std::min(lowest.size(), k_descents));
  return lowest;
}

bool are_round(const std::vector<RatedMotion>& turns) {
  return std::all_of(turns.begin(), turns.end(), [](const RatedMotion& turn) { return turn.rms < k_round_rms; });
}

}  // namespace

double deviation(const std::vector<OutlinePair>& pairs, const PlaneMotion& motion) {
  return kept_rms(gaps(supports_of(pairs), motion, k_directions).size);
}

OutlineFit fit_outlines(const std::vector<OutlinePair>& pairs) {
  const std::vector<SupportPair> supports = supports_of(pairs);
  const std::vector<RatedMotion> turns = coarse_motions(supports);
  if (are_round(turns)) return {descended(supports, turns.front().motion, false), false};
  OutlineFit best;
  double least = std::numeric_limits<double>::infinity();
  for (const RatedMotion& start : valleys_of(turns)) {
    const PlaneMotion motion = descended(supports, start.motion, true);
    const double rms = kept_rms(gaps(supports, motion, k_directions).size);
    if (rms >= least) continue;
    best.motion = motion;
    least = rms;
  }
  return best;
}

}  // namespace fusee::solid
