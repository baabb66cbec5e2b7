#include "optimize/simplex.h"

#include <algorithm>
#include <cmath>
#include <utility>

// Every row has a slack, s t − a·y − b >= 0. Initially the slacks are basic, and y and t are at their lower ends. The
// costs are 0 for y and 1 for t, so that the start is dual feasible and every step preserves this. At any end of the
// iteration the costs of the slacks are weights that prove a bound.

namespace fusee::optimize {
namespace {

constexpr double k_tolerance = 1e-10;     ///< tolerance of violations: rows have size 1
constexpr double k_pivot = 1e-9;          ///< smaller pivots only spread rounding errors
constexpr double k_equal_ratios = 1e-14;  ///< cost ratios that differ by less are equal
constexpr int k_max_steps = 100;
/// Small cost of each y: where t does not determine the best y, equal steps would cycle.
constexpr double k_cost_of_place = 1e-9;

/// The state of the iteration: basic variables as linear functions of the nonbasic ones.
class Tableau {
 public:
  explicit Tableau(const LinearProgram& program)
      : program_(program),
        columns_(static_cast<std::size_t>(program.variables) + 1),
        table_(program.rows.size() * columns_),
        value_(program.rows.size()) {
    for (std::size_t j = 0; j < columns_; ++j) nonbasic_.push_back({j, false});
    for (std::size_t j = 0; j < columns_; ++j) cost_.push_back(k_cost_of_place * static_cast<double>(j + 1));
    cost_.back() = 1.0;
    for (std::size_t i = 0; i < program.rows.size(); ++i) {
      const LinearProgram::Row& row = program.rows[i];
      for (std::size_t j = 0; j + 1 < columns_; ++j) at(i, j) = -row.a[j];
      at(i, columns_ - 1) = row.s;
      value_[i] = row.s * program.least_t - row.b;
      basic_.push_back(columns_ + i);
    }
    t_ = program.least_t;
  }

  LinearAnswer run(double enough) {
    LinearAnswer answer;
    for (int step = 0; step < k_max_steps && t_ <= enough; ++step) {
      const std::size_t row = most_violated();
      if (row == basic_.size()) break;
      const std::size_t column = entering(row);
      if (column == columns_) {
        answer.possible = false;
        answer.weights = weights_against(row);
        return answer;
      }
      pivot(row, column);
    }
    answer.t = t_;
    answer.weights.assign(program_.rows.size(), 0.0);
    for (std::size_t j = 0; j < columns_; ++j) {
      if (nonbasic_[j].variable >= columns_) answer.weights[nonbasic_[j].variable - columns_] = std::max(0.0, cost_[j]);
    }
    answer.y = point();
    return answer;
  }

 private:
  struct Nonbasic {
    std::size_t variable;
    bool at_upper;
  };

  double& at(std::size_t row, std::size_t column) { return table_[row * columns_ + column]; }
  double lower(std::size_t variable) const { return variable == columns_ - 1 ? program_.least_t : 0.0; }
  double upper(std::size_t variable) const { return variable < columns_ - 1 ? 1.0 : k_infinite; }
  /// Violation of the lower (< 0) or upper (> 0) bound.
  double excess(std::size_t row) const {
    const double low = lower(basic_[row]), high = upper(basic_[row]);
    if (value_[row] < low) return value_[row] - low;
    return value_[row] > high ? value_[row] - high : 0.0;
  }

  /// The row with the largest violation; the number of rows if there is none.
  std::size_t most_violated() const {
    std::size_t most = basic_.size();
    double largest = k_tolerance;
    for (std::size_t i = 0; i < basic_.size(); ++i) {
      if (!(std::abs(excess(i)) > largest)) continue;
      largest = std::abs(excess(i));
      most = i;
    }
    return most;
  }

  /// The column that moves the row's variable towards its bound and has the smallest cost ratio; among equals, the
  /// largest pivot.
  std::size_t entering(std::size_t row) {
    const double direction = excess(row) < 0 ? 1.0 : -1.0;
    std::size_t best = columns_;
    double least = k_infinite, pivot = 0;
    for (std::size_t j = 0; j < columns_; ++j) {
      const double entry = at(row, j) * direction * (nonbasic_[j].at_upper ? -1.0 : 1.0);
      if (!(entry > k_pivot)) continue;
      const double ratio = std::abs(cost_[j]) / entry;
      const bool is_smaller = ratio < least - k_equal_ratios;
      const bool is_equal_with_larger_pivot = ratio <= least + k_equal_ratios && entry > pivot;
      if (!is_smaller && !is_equal_with_larger_pivot) continue;
      least = ratio;
      pivot = entry;
      best = j;
    }
    return best;
  }

  /// Exchanges a basic variable, which goes to its violated bound, with a nonbasic one.
  void pivot(std::size_t row, std::size_t column) {
    const double entry = at(row, column), over = excess(row);
    const double move = -over / entry;
    const std::size_t leaving = basic_[row], coming = nonbasic_[column].variable;
    const double start = nonbasic_[column].at_upper ? upper(coming) : lower(coming);
    t_ += cost_[column] * move;
    for (std::size_t i = 0; i < basic_.size(); ++i) value_[i] += at(i, column) * move;
    value_[row] = start + move;
    basic_[row] = coming;
    nonbasic_[column] = {leaving, over > 0};
    for (std::size_t j = 0; j < columns_; ++j) at(row, j) = j == column ? 1.0 / entry : -at(row, j) / entry;
    for (std::size_t i = 0; i < basic_.size(); ++i) {
      if (i == row) continue;
      const double factor = at(i, column);
      if (factor == 0) continue;
      for (std::size_t j = 0; j < columns_; ++j) at(i, j) = (j == column ? 0.0 : at(i, j)) + factor * at(row, j);
    }
    const double factor = cost_[column];
    for (std::size_t j = 0; j < columns_; ++j) cost_[j] = (j == column ? 0.0 : cost_[j]) + factor * at(row, j);
  }

  /// Weights from a row whose variable cannot be moved towards the violated bound.
  std::vector<double> weights_against(std::size_t row) {
    const double sign = excess(row) < 0 ? 1.0 : -1.0;
    std::vector<double> weights(program_.rows.size(), 0.0);
    if (basic_[row] >= columns_) weights[basic_[row] - columns_] = 1.0;
    for (std::size_t j = 0; j < columns_; ++j) {
      if (nonbasic_[j].variable >= columns_)
        weights[nonbasic_[j].variable - columns_] = std::max(0.0, -sign * at(row, j));
    }
    return weights;
  }

  /// The present y.
  std::array<double, k_max_variables> point() const {
    std::array<double, k_max_variables> y{};
    for (const Nonbasic& variable : nonbasic_) {
      if (variable.variable + 1 < columns_) y[variable.variable] = variable.at_upper ? 1.0 : 0.0;
    }
    for (std::size_t i = 0; i < basic_.size(); ++i) {
      if (basic_[i] + 1 < columns_) y[basic_[i]] = std::clamp(value_[i], 0.0, 1.0);
    }
    return y;
  }

  const LinearProgram& program_;
  std::size_t columns_;  ///< variables and t; the slack of row i is variable columns_ + i
  std::vector<double> table_;
  std::vector<double> value_;  ///< values of the basic variables
  std::vector<std::size_t> basic_;
  std::vector<Nonbasic> nonbasic_;
  std::vector<double> cost_;
  double t_ = 0;
};

}  // namespace

LinearAnswer solve(const LinearProgram& program, double enough) { return Tableau(program).run(enough); }

}  // namespace fusee::optimize
