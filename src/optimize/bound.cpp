#include "optimize/bound.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "base/golden_section.h"
#include "optimize/conditions_at.h"

// A lower bound of  min over designs x of max over places s of f(x, s)  is  min over x of f(x, s)  at any s, so that a
// few well-chosen places suffice. Each place gives
//   1. the interval value of f over the box;
//   2. linear functions below f: from a corner v, f(x) >= f(v) + Σ g_i (x_i − v_i), where g_i is the end of the slope's
//      interval on the safe side of that corner. The conditions on a design give linear functions too, at their
//      tightest places. Together they form a linear program, whose multipliers prove its minimum (relaxation.cpp): the
//      error of the bound is of second order in the size of the box. Parts of the box that they exclude are cut off;
//   3. for point pins T_b is e^{μφ}/sin γ2, and the torque with a round P1 is r1 e^{μφ}/sin γ1. There b/a, the
//      cotangent of γ, is a quotient of two linear functions, which weights bound exactly, while 1 and 2 only
//      approximate it.
//      Without friction whole surfaces of designs tie, and no weaker bound could prove the optimum.
//
// Conditions are evaluated only where the evaluation of designs tests them (at equal steps of the stroke): designs
// excluded by a proof are then never accepted.
//
// While a RoundingUp exists, rounding is directed. Functions that construct one are noinline, so that the compiler does
// not merge them with others.

namespace fusee::optimize {
namespace {

/// Steps of the stroke at whose ends the evaluation of a design tests conditions: evaluate() of objectives.cpp for the
/// basic ones, feasibility.cpp for those of the drawing.
constexpr int k_evaluation_steps = 60;
constexpr int k_drawing_steps = 192;
/// Slack relative to a constraint's largest term: rounding must not cut off designs that constraint_violation()
/// accepts.
constexpr double k_slack = 2e-12;

struct NumberSlot {
  std::string_view key;
  bool is_angle = false;  ///< in degrees in the file
};

constexpr std::size_t k_slot_count = 26;
/// All numbers that a design can change, in the order of FileNumbers, then of WideFileNumbers.
constexpr std::array<NumberSlot, k_slot_count> k_slots{{{"joint.length_mm"},
                                                        {"guides.EB_mm"},
                                                        {"guides.ED_mm"},
                                                        {"guides.OE_mm"},
                                                        {"pulley.EF_mm"},
                                                        {"pulley.r1_mm"},
                                                        {"pulley.ratio"},
                                                        {"guides.friction"},
                                                        {"guides.radius_mm"},
                                                        {"tendon.diameter_mm"},
                                                        {"tendon.modulus_MPa"},
                                                        {"joint.range_deg[0]", true},
                                                        {"joint.range_deg[1]", true},
                                                        {"joint.drum_radius_mm"},
                                                        {"joint.attachment1_mm[0]"},
                                                        {"joint.attachment1_mm[1]"},
                                                        {"joint.attachment2_mm[0]"},
                                                        {"joint.attachment2_mm[1]"},
                                                        {"guides.bearing_radius_mm"},
                                                        {"guides.bearing_friction"},
                                                        {"sheath.length_mm"},
                                                        {"sheath.bend_deg", true},
                                                        {"sheath.friction"},
                                                        {"sheath.stiffness_N_per_mm"},
                                                        {"sheath.exit_across_mm"},
                                                        {"sheath.exit_above_mm"}}};

double radians_of(double value) { return radians(value); }
transmission::Jet radians_of(const transmission::Jet& value) {
  return value * transmission::Jet(transmission::pi_interval() / 180.0);
}

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// The corner of the box at the upper ends of the marked variables and the lower ends of the others.
Box corner_of(const Box& box, const std::array<bool, k_max_variables>& at_upper) {
  Box corner = box;
  for (std::size_t i = 0; i < k_max_variables; ++i)
    (at_upper[i] ? corner.lower[i] : corner.upper[i]) = at_upper[i] ? box.upper[i] : box.lower[i];
  return corner;
}

bool is_finite(const LineBelow& line) {
  double sum = line.constant;
  for (std::size_t i = 0; i < k_max_variables; ++i) sum += line.slope[i] + line.loss[i];
  return std::isfinite(sum);
}

std::vector<double> middle_of(const Box& box, int count) {
  std::vector<double> middle;
  for (std::size_t i = 0; i < index(count); ++i) middle.push_back(0.5 * (box.lower[i] + box.upper[i]));
  return middle;
}

/// Largest relative reduction of a width of the box.
double largest_reduction(const Box& before, const Box& after, int count) {
  double most = 0;
  for (std::size_t i = 0; i < index(count); ++i) {
    const double width = before.upper[i] - before.lower[i];
    if (width > 0) most = std::max(most, 1.0 - (after.upper[i] - after.lower[i]) / width);
  }
  return most;
}

/// Position of the pin in the link's frame: `a` from the line OC and `b` below C. For a point pin tan γ = a/b, and at
/// one joint angle both are linear in the variables.
struct Legs {
  transmission::Jet a, b;
};

Legs legs(const DesignNumbers<transmission::Jet>& d, transmission::Side side,
          const StrokeNumbers<transmission::Jet>& n) {
  const transmission::PinOffset<transmission::Jet> to_C =
      side == transmission::Side::left ? transmission::offset_from_pin_in_link(d.R, d.EB, d.OE, n.theta.mirrored())
                                       : transmission::offset_from_pin_in_link(d.R, d.ED, d.OE, n.theta);
  return {-to_C.x, to_C.y};
}

}  // namespace

/// A function of the designs at one point of the stroke.
struct BoundCalculator::Query {
  enum class Kind { objective, cap, condition } kind = Kind::objective;
  double place = 0;                                     ///< 0 at the lowest, 1 at the highest joint angle
  DesignCondition condition = DesignCondition::wrap_B;  ///< for Kind::condition
  PinAngles least = {};                                 ///< bounds for the box
};

BoundCalculator::BoundCalculator(const Problem& problem, Objective objective)
    : problem_(problem), objective_(objective) {
  // A joint has a drum or an attachment if a variable changes one.
  Design lowest;
  for (const Variable& variable : problem.variables) lowest.push_back(variable.lower);
  const Mechanism base = mechanism_at(problem, lowest);
  base_ = file_numbers(problem.base);
  wide_kind_ = wide_kind(base);
  wide_base_ = wide_file_numbers(base);
  for (const MovingKey& moving : problem.moving) {
    const auto slot =
        std::find_if(k_slots.begin(), k_slots.end(), [&](const NumberSlot& s) { return s.key == moving.key; });
    if (slot != k_slots.end()) numbers_.push_back({static_cast<std::size_t>(slot - k_slots.begin()), &moving});
  }
}

// ---- values ---------------------------------------------------------------------------------------------------------

/// The numbers of a design, or of a box of designs. For intervals, call only while a RoundingUp exists.
template <typename S>
DesignNumbers<S> BoundCalculator::numbers_of(const std::vector<S>& variables) const {
  const FileNumbers<double>& b = base_;
  const WideFileNumbers<double>& w = wide_base_;
  std::array<S, k_slot_count> n{b.R,
                                b.EB,
                                b.ED,
                                b.OE,
                                b.EF,
                                b.r1,
                                b.ratio,
                                b.mu,
                                b.radius,
                                b.diameter,
                                b.modulus,
                                b.theta_min,
                                b.theta_max,
                                w.drum_radius,
                                w.across1,
                                w.along1,
                                w.across2,
                                w.along2,
                                w.bearing_radius,
                                w.bearing_friction,
                                w.sheath_length,
                                w.sheath_bend,
                                w.sheath_mu,
                                w.sheath_stiffness,
                                w.exit_across,
                                w.exit_above};
  for (const Number& number : numbers_) {
    const MovingKey& moving = *number.moving;
    S value(moving.constant);
    // A zero is not added: an interval that is one variable alone stays exact.
    bool is_zero = moving.constant == 0;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (moving.a[i] == 0) continue;
      const S term = moving.a[i] == 1.0 ? variables[i] : S(S(moving.a[i]) * variables[i]);
      value = is_zero ? term : S(value + term);
      is_zero = false;
    }
    n[number.slot] = k_slots[number.slot].is_angle ? S(radians_of(value)) : value;
  }
  DesignNumbers<S> d =
      design_numbers<S>({n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], n[12]},
                        problem_.base.pulley.law, problem_.base.has_point_pins());
  if (!wide_kind_.is_papers())
    d.wide = wide_numbers<S>(
        wide_kind_, {n[13], n[14], n[15], n[16], n[17], n[18], n[19], n[20], n[21], n[22], n[23], n[24], n[25]}, d.R,
        S(2.0 * d.half), d.rho);
  return d;
}

/// The numbers of a box, with derivatives unless it is a single design. Call only while a RoundingUp exists.
DesignNumbers<transmission::Jet> BoundCalculator::numbers_over(const Box& box) const {
  const int count = static_cast<int>(problem_.variables.size());
  const bool is_point = box.lower == box.upper;
  std::vector<transmission::Jet> variables;
  for (int i = 0; i < count; ++i) {
    const transmission::Interval value(box.lower[index(i)], box.upper[index(i)]);
    variables.push_back(is_point ? transmission::Jet(value) : transmission::Jet::variable(value, i, count));
  }
  return numbers_of(variables);
}

/// The objective, or a function that must not be positive.
transmission::Jet BoundCalculator::value_of(const Query& query, const DesignNumbers<transmission::Jet>& numbers,
                                            transmission::Domain& domain) const {
  if (query.kind == Query::Kind::condition) {
    ConditionValues<transmission::Jet> values;
    if (!conditions_at(numbers, transmission::Jet(query.place), index(static_cast<int>(query.condition)) + 1, values)) {
      domain.possible = false;
      return 0.0;
    }
    const ConditionValue<transmission::Jet>& condition = values[static_cast<std::size_t>(query.condition)];
    domain.whole = domain.whole && condition.domain.whole;
    domain.possible = domain.possible && condition.domain.possible;
    return -condition.value;
  }
  const StrokeNumbers<transmission::Jet> stroke = stroke_numbers(numbers, transmission::Jet(query.place), domain);
  if (query.kind == Query::Kind::objective) return objective_of(objective_, numbers, stroke);
  return objective_of(problem_.cap->objective, numbers, stroke) - transmission::Jet(problem_.cap->limit);
}

[[gnu::noinline]] transmission::Jet BoundCalculator::value_at(const Query& query, const Box& box,
                                                              transmission::Domain& domain) const {
  const transmission::RoundingUp rounding;
  DesignNumbers<transmission::Jet> numbers = numbers_over(box);
  numbers.least = query.least;
  return value_of(query, numbers, domain);
}

/// Lower bounds of the tendons' γ in possible designs of the box: below them a wrap would be negative.
[[gnu::noinline]] PinAngles BoundCalculator::least_angles(const Box& box, double place) const {
  constexpr double k_between_places = 2e-3;  // rad: possible negative wrap between tested places
  const transmission::RoundingUp rounding;
  DesignNumbers<transmission::Jet> d = numbers_over(box);
  if (d.wide) return d.least;
  const transmission::Interval theta = (d.theta_min + transmission::Jet(place) * (d.theta_max - d.theta_min)).value;
  transmission::Domain of_1, upper;
  if (!d.linear) {
    const transmission::Interval least =
        lower_line_of(d, d.r1, transmission::Side::left, of_1).normal.value - theta - k_between_places;
    if (of_1.possible) d.least.of_1 = least.lower();
  }
  const StrokeNumbers<transmission::Jet> n = upper_stroke(d, transmission::Jet(place), upper);
  transmission::Domain of_2;
  const transmission::Interval least =
      lower_line_of(d, transmission::Jet(n.r2.value.lower()), transmission::Side::right, of_2).normal.value + theta -
      k_between_places;
  if (upper.possible && of_2.possible) d.least.of_2 = least.lower();
  // Bounds without effect are dropped, to avoid a second evaluation.
  if (!(n.upper1.gamma.value.lower() <= d.least.of_1)) d.least.of_1 = PinAngles().of_1;
  if (!(n.upper2.gamma.value.lower() <= d.least.of_2)) d.least.of_2 = PinAngles().of_2;
  return d.least;
}

/// The value with derivatives for a box that is a single design.
[[gnu::noinline]] transmission::Jet BoundCalculator::slopes_at(const Query& query, const Box& box,
                                                               transmission::Domain& domain) const {
  const transmission::RoundingUp rounding;
  const int count = static_cast<int>(problem_.variables.size());
  std::vector<transmission::Jet> variables;
  for (int i = 0; i < count; ++i) variables.push_back(transmission::Jet::variable(box.lower[index(i)], i, count));
  return value_of(query, numbers_of(variables), domain);
}

// ---- lines ----------------------------------------------------------------------------------------------------------

/// The linear constraints over the box, each relaxed by `slack` relative to its largest term.
BoundCalculator::Lines BoundCalculator::lines_of_constraints(const Box& box, double slack) const {
  Lines lines;
  for (const LinearConstraint& constraint : problem_.constraints) {
    LineBelow line;
    double size = std::abs(constraint.b);
    line.corner = box.lower;
    double at_lower = -constraint.b;
    for (std::size_t i = 0; i < problem_.variables.size(); ++i) {
      line.slope[i] = constraint.a[i];
      at_lower += constraint.a[i] * box.lower[i];
      size = std::max(size, std::abs(constraint.a[i]) * std::max(std::abs(box.lower[i]), std::abs(box.upper[i])));
    }
    line.constant = at_lower - slack * size;
    lines.push_back(line);
  }
  return lines;
}

/// The linear function of 2. from a corner: the one with the lowest value, or with the highest. `over`: value and
/// slopes over the box. `exists` is set to false if there is no such function.
LineBelow BoundCalculator::line_from(const Box& box, const Query& query, const transmission::Jet& over,
                                     bool from_highest, bool& exists) const {
  std::array<bool, k_max_variables> at_upper{};
  for (std::size_t i = 0; i < problem_.variables.size(); ++i) {
    const bool falls = over.slope[i].lower() + over.slope[i].upper() < 0;
    at_upper[i] = from_highest ? !falls : falls;
  }
  const Box corner = corner_of(box, at_upper);
  transmission::Domain domain;
  const transmission::Jet at_corner = value_at(query, corner, domain);
  LineBelow line;
  line.constant = at_corner.value.lower();
  line.corner = corner.lower;
  line.of_objective = query.kind == Query::Kind::objective;
  for (std::size_t i = 0; i < problem_.variables.size(); ++i) {
    line.slope[i] = at_upper[i] ? over.slope[i].upper() : over.slope[i].lower();
    line.loss[i] = (over.slope[i].upper() - over.slope[i].lower()) * (box.upper[i] - box.lower[i]);
  }
  exists = domain.possible && domain.whole && is_finite(line);
  return line;
}

/// Adds the interval value, and lines from the two corners between which the function changes most. Uses both the
/// function itself and its continuation with tendons kept on their pins, which exists in larger boxes and is tighter
/// there, but has a kink where a tendon leaves its pin.
void BoundCalculator::add_lines(const Box& box, Query query, Lines& lines, BoxBound& result, double limit) const {
  const PinAngles least = least_angles(box, query.place);
  query.least = least;
  add_lines_of(box, query, lines, result, limit);
  if (!result.possible || least == PinAngles()) return;
  query.least = {};
  add_lines_of(box, query, lines, result, limit);
}

/// Adds the interval value and lines of this form of the function alone.
void BoundCalculator::add_lines_of(const Box& box, const Query& query, Lines& lines, BoxBound& result,
                                   double limit) const {
  transmission::Domain domain;
  const transmission::Jet over = value_at(query, box, domain);
  ++result.evaluations;
  const bool of_objective = query.kind == Query::Kind::objective;
  if (!domain.possible) {
    // Objectives are also evaluated at places that no design evaluation tests; a missing value proves nothing there.
    if (!of_objective) result.possible = false;
    return;
  }
  const double least = over.value.lower();
  if (of_objective)
    result.bound = std::max(result.bound, least);
  else if (least > 0)
    result.possible = false;
  if (result.bound > limit) result.possible = false;
  if (!result.possible || !domain.whole || over.count == 0) return;
  if (!of_objective && over.value.upper() <= 0) return;  // satisfied by all designs
  for (const bool from_highest : {false, true}) {
    bool exists = false;
    const LineBelow line = line_from(box, query, over, from_highest, exists);
    ++result.evaluations;
    if (exists) lines.push_back(line);
  }
}

// ---- places ---------------------------------------------------------------------------------------------------------

/// Adds the places of the largest maxima of f over the stroke, for the design in the middle of the box.
void BoundCalculator::add_worst_places(Objective objective, bool of_cap, const DesignNumbers<double>& middle,
                                       std::vector<Query>& queries) const {
  constexpr int k_samples = 25;
  constexpr std::size_t k_max_queries = 3;
  constexpr int k_steps = 16;  // to 4e-5 of the stroke; the bound's error is its square
  std::array<double, k_samples> values{};
  const auto value_at_place = [&](double place) {
    transmission::Domain domain;
    const double value = objective_of(objective, middle, stroke_numbers(middle, place, domain));
    return domain.possible && !std::isnan(value) ? value : k_infinite;
  };
  for (int i = 0; i < k_samples; ++i) values[index(i)] = value_at_place(i / (k_samples - 1.0));
  std::vector<std::pair<double, double>> maxima;  // −value, place
  for (int i = 0; i < k_samples; ++i) {
    const std::size_t k = index(i);
    const bool exceeds_left = i == 0 || values[k] >= values[k - 1];
    const bool exceeds_right = i == k_samples - 1 || values[k] >= values[k + 1];
    if (!exceeds_left || !exceeds_right) continue;
    const Bracket neighbours{std::max(0, i - 1) / (k_samples - 1.0),
                             std::min(k_samples - 1, i + 1) / (k_samples - 1.0)};
    const double refined =
        golden_section(neighbours, k_steps, [&](double place) { return -value_at_place(place); }).middle();
    const double place = value_at_place(refined) > values[k] ? refined : i / (k_samples - 1.0);
    maxima.emplace_back(-values[k], place);
  }
  std::sort(maxima.begin(), maxima.end());
  for (std::size_t i = 0; i < std::min(k_max_queries, maxima.size()); ++i)
    queries.push_back({of_cap ? Query::Kind::cap : Query::Kind::objective, maxima[i].second});
}

/// Number of conditions that the bound tests. The curvature conditions have no interval form where a tendon leaves its
/// drum. They are omitted for other joints than the paper's, which leaves a valid bound.
std::size_t BoundCalculator::condition_query_count() const {
  const std::size_t count = condition_count(problem_.feasible, problem_.base.pulley.method);
  return wide_kind_.is_papers() ? count : std::min(count, k_drawing_conditions);
}

/// Adds the tightest place of each condition, for the design in the middle of the box.
void BoundCalculator::add_tightest_places(const DesignNumbers<double>& middle, std::vector<Query>& queries) const {
  constexpr int k_coarse_steps = 12;
  const std::size_t count = condition_query_count();
  const auto value = [&](std::size_t condition, int place, int steps) {
    ConditionValues<double> values;
    if (!conditions_at(middle, static_cast<double>(place) / steps, condition + 1, values)) return -k_infinite;
    const double number = values[condition].value;
    return std::isnan(number) ? -k_infinite : number;
  };
  for (std::size_t condition = 0; condition < count; ++condition) {
    const int steps = condition < k_basic_conditions ? k_evaluation_steps : k_drawing_steps;
    const int stride = steps / k_coarse_steps;
    int tightest = 0;
    double least = k_infinite;
    const auto test_place = [&](int place) {
      if (place < 0 || place > steps) return;
      const double tested = value(condition, place, steps);
      if (!(tested < least)) return;
      least = tested;
      tightest = place;
    };
    for (int place = 0; place <= steps; place += stride) test_place(place);
    for (int distance = stride / 2; distance > 0; distance /= 2) {
      const int around = tightest;
      test_place(around - distance);
      test_place(around + distance);
    }
    queries.push_back(
        {Query::Kind::condition, static_cast<double>(tightest) / steps, static_cast<DesignCondition>(condition)});
  }
}

/// The functions and places to bound, for a box around this design.
std::vector<BoundCalculator::Query> BoundCalculator::queries_around(const std::vector<double>& design) const {
  const DesignNumbers<double> numbers = numbers_of(design);
  std::vector<Query> queries;
  add_tightest_places(numbers, queries);
  if (problem_.cap) add_worst_places(problem_.cap->objective, true, numbers, queries);
  add_worst_places(objective_, false, numbers, queries);
  return queries;
}

// ---- bounds ---------------------------------------------------------------------------------------------------------

/// Bound 3 of the comment at the beginning. −infinity if it does not apply.
[[gnu::noinline]] double BoundCalculator::quotient_bound(const Box& box, double place, const Lines& constraints) const {
  constexpr int k_most_steps = 4;
  const bool torque = objective_ == Objective::motor_torque;
  const bool has_round_P1 = problem_.base.pulley.law == Law::compensate;
  const bool is_quotient = torque ? has_round_P1 : objective_ == Objective::max_tension;
  if (!problem_.base.has_point_pins() || !wide_kind_.is_papers() || !is_quotient) return -k_infinite;
  const transmission::RoundingUp rounding;
  const int count = static_cast<int>(problem_.variables.size());
  const DesignNumbers<transmission::Jet> d = numbers_over(box);
  transmission::Domain domain;
  const StrokeNumbers<transmission::Jet> n = stroke_numbers(d, transmission::Jet(place), domain);
  // The torque depends on γ1, the tension on γ2.
  const transmission::Side side = torque ? transmission::Side::left : transmission::Side::right;
  const Legs over = legs(d, side, n);
  // Linear in the variables only if the angle is a number.
  if (!domain.possible || n.theta.angle.count != 0 || !(over.a.value.lower() > 0)) return -k_infinite;
  const Legs at_lower = legs(numbers_over(corner_of(box, {})), side, n);
  // Lower bound q of b/a. b − q a >= g implies b/a >= q + g/a: from any lower bound, a better one.
  double q = (over.b.value / over.a.value).lower();
  for (int step = 0; step < k_most_steps; ++step) {
    const transmission::Jet difference = over.b - transmission::Jet(q) * over.a;
    LineBelow line;
    line.of_objective = true;
    line.constant = (at_lower.b.value - transmission::Interval(q) * at_lower.a.value).lower();
    line.corner = box.lower;
    for (std::size_t i = 0; i < index(count); ++i) line.slope[i] = difference.slope[i].lower();
    Lines lines = constraints;
    lines.push_back(line);
    Box untouched = box;
    const double least = least_of_lines(untouched, count, lines, -k_infinite, k_infinite).bound;
    const double divisor = least >= 0 ? over.a.value.upper() : over.a.value.lower();  // the one of the smaller quotient
    const double better = (transmission::Interval(q) + transmission::Interval(least) / divisor).lower();
    if (!(better > q)) break;
    q = better;
  }
  const transmission::Interval per_sine =
      transmission::sqrt(1.0 + transmission::squared(transmission::Interval(std::max(q, 0.0))));
  const transmission::Interval lever =
      torque ? transmission::Interval(d.r1.value.lower()) : transmission::Interval(1.0);
  return (lever * transmission::Interval(per_sine.lower()) * transmission::exp(d.mu.value * n.phi.value)).lower();
}

/// Repeats if the box became much narrower, since its bounds are then tighter.
BoxBound BoundCalculator::bound(Box& box, double limit) const {
  constexpr int k_passes = 3;
  constexpr double k_much_narrower = 0.3;
  const int count = static_cast<int>(problem_.variables.size());
  BoxBound result;
  result.bound = box.bound;
  for (int pass = 0; pass < k_passes; ++pass) {
    Lines lines = lines_of_constraints(box, k_slack);
    const auto constraints = static_cast<std::ptrdiff_t>(lines.size());  // number of lines of constraints
    if (!cut_by_lines(box, count, lines, limit)) result.possible = false;
    if (!result.possible) return result;
    const Box before = box;
    const std::vector<Query> queries = queries_around(middle_of(box, count));
    for (const Query& query : queries) {
      add_lines(box, query, lines, result, limit);
      if (!result.possible) return result;
    }
    if (!cut_by_lines(box, count, lines, limit)) result.possible = false;
    if (!result.possible) return result;
    const LeastOfLines least = least_of_lines(box, count, lines, result.bound, limit);
    result.possible = least.possible;
    if (!result.possible) return result;
    result.bound = std::max(result.bound, least.bound);
    result.loss = least.loss;
    result.lowest.assign(least.lowest.begin(), least.lowest.begin() + count);
    if (largest_reduction(before, box, count) > k_much_narrower) continue;
    const Lines of_constraints(lines.begin(), lines.begin() + constraints);
    for (const Query& query : queries) {
      if (query.kind != Query::Kind::objective) continue;
      result.bound = std::max(result.bound, quotient_bound(box, query.place, of_constraints));
    }
    break;
  }
  result.possible = result.bound <= limit;
  return result;
}

// ---- guesses --------------------------------------------------------------------------------------------------------

/// Excess of a cap's objective over its limit, or violation of a condition, for one design. In floating-point numbers,
/// so that it proves nothing.
double BoundCalculator::excess_of(const Query& query, const std::vector<double>& design) const {
  const DesignNumbers<double> numbers = numbers_of(design);
  transmission::Domain domain;
  if (query.kind != Query::Kind::condition)
    return objective_of(problem_.cap->objective, numbers, stroke_numbers(numbers, query.place, domain)) -
           problem_.cap->limit;
  ConditionValues<double> values;
  const auto condition = static_cast<std::size_t>(query.condition);
  return conditions_at(numbers, query.place, condition + 1, values) ? -values[condition].value : k_infinite;
}

// Linearizes at the design. The curvature is estimated from the result and subtracted from the limits of the next
// round; otherwise designs at a convex border would never leave it.
Design BoundCalculator::lowest_around(const Design& design, double size) const {
  constexpr int k_rounds = 4;
  constexpr double k_excess_factor = 1.1;  // a little more than the estimated curvature
  const std::size_t count = problem_.variables.size();
  Box at, around;
  for (std::size_t i = 0; i < count; ++i) {
    const Variable& variable = problem_.variables[i];
    const double half = size * (variable.upper - variable.lower);
    at.lower[i] = at.upper[i] = design[i];
    around.lower[i] = std::max(variable.lower, design[i] - half);
    around.upper[i] = std::min(variable.upper, design[i] + half);
  }
  Lines lines = lines_of_constraints(around, 0.0);
  std::vector<Query> of_lines(lines.size());
  for (const Query& query : queries_around(design)) {
    transmission::Domain domain;
    const transmission::Jet value = slopes_at(query, at, domain);
    LineBelow line;
    line.of_objective = query.kind == Query::Kind::objective;
    line.constant = value.value.upper();
    line.corner = at.lower;
    for (std::size_t i = 0; i < count; ++i) line.slope[i] = value.slope[i].upper();
    if (!domain.possible || !domain.whole || value.count == 0 || !is_finite(line)) continue;
    lines.push_back(line);
    of_lines.push_back(query);
  }
  Design lowest;
  for (int round = 0; round < k_rounds; ++round) {
    Box untouched = around;
    const LeastOfLines least = least_of_lines(untouched, static_cast<int>(count), lines, -k_infinite, k_infinite);
    if (!least.possible) return lowest;
    lowest.assign(least.lowest.begin(), least.lowest.begin() + static_cast<std::ptrdiff_t>(count));
    double largest_excess = 0;
    for (std::size_t r = problem_.constraints.size(); r < lines.size(); ++r) {
      if (lines[r].of_objective) continue;
      for (const Query& query : queries_around(lowest)) {
        if (query.kind != of_lines[r].kind || query.condition != of_lines[r].condition) continue;
        const double excess = excess_of(query, lowest);
        if (!(excess > 0)) continue;
        largest_excess = std::max(largest_excess, excess);
        lines[r].constant += k_excess_factor * excess;
      }
    }
    if (largest_excess == 0) break;
  }
  return lowest;
}

// ---- a single design ------------------------------------------------------------------------------------------------

/// Encloses the objective of one design over a part of the stroke.
[[gnu::noinline]] transmission::Interval BoundCalculator::value_over_piece(const Design& design, double low,
                                                                           double high) const {
  const transmission::RoundingUp rounding;
  const DesignNumbers<transmission::Jet> numbers =
      numbers_of(std::vector<transmission::Jet>(design.begin(), design.end()));
  const auto at = [&](const transmission::Jet& place) {
    transmission::Domain domain;
    const transmission::Jet value = objective_of(objective_, numbers, stroke_numbers(numbers, place, domain));
    return domain.possible && domain.whole ? value : transmission::Jet(transmission::Interval(-k_infinite, k_infinite));
  };
  const transmission::Jet whole = at(transmission::Jet::variable({low, high}, 0, 1));
  transmission::Interval value = whole.value;
  if (whole.count == 0) return value;
  // The mean value form starts from the end towards which the function does not decrease, or from the middle.
  const transmission::Interval slope = whole.slope[0];
  double from = 0.5 * (low + high);
  if (slope.lower() >= 0)
    from = high;
  else if (slope.upper() <= 0)
    from = low;
  const transmission::Interval centred =
      at(transmission::Jet(from)).value + slope * (transmission::Interval(low, high) - from);
  const transmission::Interval sharper = boost::numeric::intersect(value, centred);
  return boost::numeric::empty(sharper) ? value : sharper;
}

double BoundCalculator::rounded_up_value(const Design& design) const {
  struct Piece {
    double low, high;  ///< part of the stroke
    double upper;      ///< upper bound of the objective there
    bool operator<(const Piece& other) const { return upper < other.upper; }
  };
  constexpr int k_first_pieces = 16, k_most_pieces = 20000;
  constexpr double k_sharp = 1e-10;      // relative
  constexpr double k_narrowest = 1e-12;  // of the stroke
  std::priority_queue<Piece> pieces;
  double least = -k_infinite;  // lower bound of the maximum
  const auto add = [&](double low, double high) {
    const transmission::Interval value = value_over_piece(design, low, high);
    pieces.push({low, high, value.upper()});
    least = std::max(least, value_over_piece(design, low, low).lower());
    least = std::max(least, value_over_piece(design, high, high).lower());
  };
  for (int i = 0; i < k_first_pieces; ++i)
    add(i / static_cast<double>(k_first_pieces), (i + 1) / static_cast<double>(k_first_pieces));
  for (int i = 0; i < k_most_pieces; ++i) {
    const Piece worst = pieces.top();
    if (worst.upper - least <= k_sharp * std::abs(least) || worst.high - worst.low < k_narrowest) break;
    pieces.pop();
    const double middle = 0.5 * (worst.low + worst.high);
    add(worst.low, middle);
    add(middle, worst.high);
  }
  return pieces.top().upper;
}

}  // namespace fusee::optimize
