#include "optimize/relaxation.h"

#include <algorithm>
#include <cmath>

// A sum Σ λ_r F_r over lines with weights λ_r >= 0 is bounded from below by one linear function, and that function over
// a box by its corners. This is valid for any weights. They are therefore computed in floating-point numbers
// (simplex.cpp), and only the sum with directed rounding, in functions that the compiler must not merge.

namespace fusee::optimize {
namespace {

/// constant + slope · (x − lower), in intervals.
struct WeightedSum {
  transmission::Interval constant = 0.0;
  std::array<transmission::Interval, k_max_variables> slope{};
  transmission::Interval of_objective = 0.0;  ///< total weight of the objective
};

/// Call only while a RoundingUp exists.
double least_over(const WeightedSum& sum, const Box& box, int count) {
  transmission::Interval least = sum.constant;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const transmission::Interval width = transmission::Interval(box.upper[i]) - box.lower[i];
    if (sum.slope[i].lower() < 0) least += transmission::Interval(sum.slope[i].lower()) * width;
  }
  return least.lower();
}

/// The sum of the lines with these weights.
WeightedSum weighted(const Box& box, int count, const std::vector<LineBelow>& lines,
                     const std::vector<double>& weights) {
  WeightedSum sum;
  for (std::size_t r = 0; r < lines.size(); ++r) {
    if (!(weights[r] > 0)) continue;
    const transmission::Interval weight = weights[r];
    sum.constant += weight * lines[r].constant;
    if (lines[r].of_objective) sum.of_objective += weight;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const transmission::Interval slope = weight * lines[r].slope[i];
      sum.slope[i] += slope;
      sum.constant += slope * (transmission::Interval(box.lower[i]) - lines[r].corner[i]);
    }
  }
  return sum;
}

/// Shrinks the box to contain the designs for which the sum is <= `most`. False if there are none.
bool cut(Box& box, int count, const WeightedSum& sum, double most) {
  const double least = least_over(sum, box, count);
  if (least > most) return false;
  if (!(std::abs(least) < k_infinite)) return true;
  const Box whole = box;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const transmission::Interval width = transmission::Interval(whole.upper[i]) - whole.lower[i];
    const double slope = sum.slope[i].lower();
    // The sum has its minimum at one end of the variable and increases from there by at least |slope| · distance.
    if (slope == 0) continue;
    const double distance = ((transmission::Interval(most) - least) / std::abs(slope)).upper();
    if (!(distance < width.lower())) continue;
    if (slope > 0) box.upper[i] = std::max(box.lower[i], (transmission::Interval(whole.lower[i]) + distance).upper());
    if (slope < 0) box.lower[i] = std::min(box.upper[i], (transmission::Interval(whole.upper[i]) - distance).lower());
  }
  return true;
}

[[gnu::noinline]] bool cut_by_sum(Box& box, int count, const std::vector<LineBelow>& lines,
                                  const std::vector<double>& weights, double limit) {
  const transmission::RoundingUp rounding;
  const WeightedSum sum = weighted(box, count, lines, weights);
  const double most = (sum.of_objective * limit).upper();
  return cut(box, count, sum, most);
}

/// Bound of the objective by the weighted lines; infinite if they prove that there is no design.
[[gnu::noinline]] double bound_by(const Box& box, int count, const std::vector<LineBelow>& lines,
                                  const std::vector<double>& weights) {
  const transmission::RoundingUp rounding;
  const WeightedSum sum = weighted(box, count, lines, weights);
  const double least = least_over(sum, box, count);
  if (sum.of_objective.lower() > 0) return (transmission::Interval(least) / sum.of_objective).lower();
  return least > 0 ? k_infinite : -k_infinite;
}

/// The lines over the unit cube, each scaled to size 1.
struct ScaledProgram {
  LinearProgram program;
  std::vector<double> scale;   ///< one per line, by which it was divided
  double objective_scale = 1;  ///< common scale of the objective's lines
};

ScaledProgram scaled(const Box& box, int count, const std::vector<LineBelow>& lines, double least) {
  ScaledProgram result;
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
  // The start value lies below the bound of every single line, since weights only prove values above the start.
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
  const ScaledProgram scaled_lines = scaled(box, count, lines, least);
  const LinearAnswer answer = solve(scaled_lines.program, limit / scaled_lines.objective_scale);
  std::vector<double> weights(lines.size(), 0.0);
  double objective_weights = 0;
  for (std::size_t r = 0; r < lines.size(); ++r) {
    weights[r] = answer.weights[r] / scaled_lines.scale[r] * scaled_lines.objective_scale;
    if (lines[r].of_objective) objective_weights += weights[r];
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
      const double share = objective_weights > 0 ? weights[r] / objective_weights : weights[r];
      result.loss[i] += share * lines[r].loss[i];
    }
  }
  if (!cut_by_sum(box, count, lines, weights, limit)) result.possible = false;
  return result;
}

}  // namespace fusee::optimize
