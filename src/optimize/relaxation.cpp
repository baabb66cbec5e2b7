#include "optimize/relaxation.h"

#include <algorithm>
#include <cmath>

// Σ λ_r F_r over lines of weight λ_r >= 0 is bounded from below by one linear function, and that over a box by its
// corners: whatever the weights are, the outcome is true. So the weights come from plain numbers (simplex.cpp), and
// only the sum is computed with directed rounding, in functions that the compiler must not merge.

namespace fusee {
namespace {

/// constant + slope · (x − lower), in intervals.
struct Sum {
  Interval constant = 0.0;
  std::array<Interval, k_most_variables> slope{};
  Interval of_objective = 0.0;  ///< weight of the objective in it
};

/// To be called while a RoundingUp lives.
double least_over(const Sum& sum, const Box& box, int count) {
  Interval least = sum.constant;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const Interval width = Interval(box.upper[i]) - box.lower[i];
    if (sum.slope[i].lower() < 0) least += Interval(sum.slope[i].lower()) * width;
  }
  return least.lower();
}

Sum weighted(const Box& box, int count, const std::vector<LineBelow>& lines, const std::vector<double>& weights) {
  Sum sum;
  for (std::size_t r = 0; r < lines.size(); ++r) {
    if (!(weights[r] > 0)) continue;
    const Interval weight = weights[r];
    sum.constant += weight * lines[r].constant;
    if (lines[r].of_objective) sum.of_objective += weight;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const Interval slope = weight * lines[r].slope[i];
      sum.slope[i] += slope;
      sum.constant += slope * (Interval(box.lower[i]) - lines[r].corner[i]);
    }
  }
  return sum;
}

/// Designs at which the sum stays <= `most` lie in what is left of the box.
bool cut(Box& box, int count, const Sum& sum, double most) {
  const double least = least_over(sum, box, count);
  if (least > most) return false;
  if (!(std::abs(least) < k_infinite)) return true;
  const Box whole = box;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const Interval width = Interval(whole.upper[i]) - whole.lower[i];
    const double slope = sum.slope[i].lower();
    // The sum is least at one end of the variable; from there it grows by |slope| · way at least.
    if (slope == 0) continue;
    const double way = ((Interval(most) - least) / std::abs(slope)).upper();
    if (!(way < width.lower())) continue;
    if (slope > 0) box.upper[i] = std::max(box.lower[i], (Interval(whole.lower[i]) + way).upper());
    if (slope < 0) box.lower[i] = std::min(box.upper[i], (Interval(whole.upper[i]) - way).lower());
  }
  return true;
}

[[gnu::noinline]] bool cut_by_sum(Box& box, int count, const std::vector<LineBelow>& lines,
                                  const std::vector<double>& weights, double limit) {
  const RoundingUp rounding;
  const Sum sum = weighted(box, count, lines, weights);
  const double most = (sum.of_objective * limit).upper();
  return cut(box, count, sum, most);
}

/// What the weighted lines prove of the objective; infinite when they prove that there is no design.
[[gnu::noinline]] double bound_by(const Box& box, int count, const std::vector<LineBelow>& lines,
                                  const std::vector<double>& weights) {
  const RoundingUp rounding;
  const Sum sum = weighted(box, count, lines, weights);
  const double least = least_over(sum, box, count);
  if (sum.of_objective.lower() > 0) return (Interval(least) / sum.of_objective).lower();
  return least > 0 ? k_infinite : -k_infinite;
}

/// The lines over the unit cube, each of size 1.
struct Scaled {
  LinearProgram program;
  std::vector<double> scale;
  double objective_scale = 1;
};

Scaled scaled(const Box& box, int count, const std::vector<LineBelow>& lines, double least) {
  Scaled result;
  result.program.variables = count;
  double objective_size = 0;
  double least_of_rows = -k_infinite;
  for (const LineBelow& line : lines) {
    LinearProgram::Row row;
    row.b = line.constant;
    double size = 0, low = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      row.a[i] = line.slope[i] * (box.upper[i] - box.lower[i]);
      row.b += line.slope[i] * (box.lower[i] - line.corner[i]);
      size = std::max(size, std::abs(row.a[i]));
      low += std::min(row.a[i], 0.0);
    }
    if (line.of_objective) {
      objective_size = std::max({objective_size, size, std::abs(row.b)});
      least_of_rows = std::max(least_of_rows, row.b + low);
      row.s = 1;
    }
    result.scale.push_back(size > 0 ? size : 1.0);
    result.program.rows.push_back(row);
  }
  if (!(objective_size > 0)) objective_size = 1;
  if (least_of_rows == -k_infinite) least_of_rows = std::max(least, -objective_size);
  result.objective_scale = objective_size;
  for (std::size_t r = 0; r < lines.size(); ++r) {
    LinearProgram::Row& row = result.program.rows[r];
    if (lines[r].of_objective) result.scale[r] = objective_size;
    for (double& a : row.a) a /= result.scale[r];
    row.b /= result.scale[r];
  }
  // Below what any line says alone: what is there from the start has no weights that prove it.
  result.program.least_t = std::max(least / objective_size, least_of_rows / objective_size - 1.0);
  return result;
}

}  // namespace

bool cut_by_lines(Box& box, int count, const std::vector<LineBelow>& lines, double limit) {
  std::vector<double> weights(lines.size(), 0.0);
  for (std::size_t r = 0; r < lines.size(); ++r) {
    weights[r] = 1;
    if (!cut_by_sum(box, count, lines, weights, limit)) return false;
    weights[r] = 0;
  }
  return true;
}

LeastOfLines least_of_lines(Box& box, int count, const std::vector<LineBelow>& lines, double least, double limit) {
  LeastOfLines result;
  result.bound = least;
  const Scaled scale = scaled(box, count, lines, least);
  const LinearAnswer answer = solve(scale.program, limit / scale.objective_scale);
  std::vector<double> weights(lines.size(), 0.0);
  double sum_of_weights = 0;
  for (std::size_t r = 0; r < lines.size(); ++r) {
    weights[r] = answer.weights[r] / scale.scale[r] * scale.objective_scale;
    if (lines[r].of_objective) sum_of_weights += weights[r];
  }
  const double bound = bound_by(box, count, lines, weights);
  if (bound > limit) {
    result.possible = false;
    return result;
  }
  result.bound = std::max(result.bound, bound);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    result.lowest[i] =
        std::clamp(box.lower[i] + answer.y[i] * (box.upper[i] - box.lower[i]), box.lower[i], box.upper[i]);
    for (std::size_t r = 0; r < lines.size(); ++r) {
      const double share = sum_of_weights > 0 ? weights[r] / sum_of_weights : weights[r];
      result.loss[i] += share * lines[r].loss[i];
    }
  }
  if (!cut_by_sum(box, count, lines, weights, limit)) result.possible = false;
  return result;
}

}  // namespace fusee
