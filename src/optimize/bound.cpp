#include "optimize/bound.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "optimize/objective_at.h"

// A lower bound of  min over designs x of max over places s of f(x, s)  is  min over x of f(x, s)  at any s: so few,
// well chosen places do. At one place there are three bounds, each rigorous; the best counts:
//   1. the interval value of f over the box;
//   2. a linear function that is nowhere above f: from a corner v, f(x) >= f(v) + Σ g_i (x_i − v_i) with g_i the end of
//   the slope's
//      interval that is on the safe side of that corner. Its least value over the box and the constraints a·x <= b is
//      bounded by weighting the constraints: any ν >= 0 gives a valid bound, good ones are found by going through the
//      breaks of ν one by one;
//   3. over point pins T_b is e^{μφ}/sin γ2, and the torque with a round P1 r1 e^{μφ}/sin γ1. There b/a, the cotangent
//   of γ, is a quotient of
//      two linear functions, and is bounded by weights exactly, where 1 and 2 only come near. Without friction whole
//      surfaces of designs tie, and nothing less sharp could prove it.
//
// Everything between RoundingUp's construction and its end is computed with directed rounding, in functions the
// compiler must not merge.

namespace fusee {
namespace {

using JetDesign = FileNumbers<Jet>;

struct NumberSlot {
  std::string_view key;
  Jet FileNumbers<Jet>::*member;
  bool angle = false;
};

constexpr std::array<NumberSlot, 13> k_slots{{{"joint.length_mm", &JetDesign::R},
                                              {"guides.EB_mm", &JetDesign::EB},
                                              {"guides.ED_mm", &JetDesign::ED},
                                              {"guides.OE_mm", &JetDesign::OE},
                                              {"pulley.EF_mm", &JetDesign::EF},
                                              {"pulley.r1_mm", &JetDesign::r1},
                                              {"pulley.ratio", &JetDesign::ratio},
                                              {"guides.friction", &JetDesign::mu},
                                              {"guides.radius_mm", &JetDesign::radius},
                                              {"tendon.diameter_mm", &JetDesign::diameter},
                                              {"tendon.modulus_MPa", &JetDesign::modulus},
                                              {"joint.range_deg[0]", &JetDesign::theta_min, true},
                                              {"joint.range_deg[1]", &JetDesign::theta_max, true}}};

FileNumbers<Jet> constants(const Mechanism& mechanism) {
  const FileNumbers<double> n = file_numbers(mechanism);
  return {n.R, n.EB, n.ED, n.OE, n.EF, n.r1, n.ratio, n.mu, n.radius, n.diameter, n.modulus, n.theta_min, n.theta_max};
}

/// The numbers over a box. To be called while a RoundingUp lives.
DesignNumbers<Jet> numbers_over(const Problem& problem, const std::vector<Jet>& variables) {
  FileNumbers<Jet> numbers = constants(problem.base);
  for (const MovingKey& moving : problem.moving) {
    const auto slot =
        std::find_if(k_slots.begin(), k_slots.end(), [&](const NumberSlot& s) { return s.key == moving.key; });
    if (slot == k_slots.end()) continue;
    Jet value(moving.constant);
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (moving.a[i] == 1.0)
        value = moving.constant == 0 && value.count == 0 ? variables[i] : value + variables[i];
      else if (moving.a[i] != 0)
        value = value + Jet(moving.a[i]) * variables[i];
    }
    numbers.*(slot->member) = slot->angle ? value * Jet(pi_interval() / 180.0) : value;
  }
  return design_numbers(numbers, problem.base.pulley.law, problem.base.has_point_pins());
}

std::vector<Jet> variables_over(const Problem& problem, const Box& box) {
  const int count = static_cast<int>(problem.variables.size());
  std::vector<Jet> variables;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    variables.push_back(Jet::variable({box.lower[k], box.upper[k]}, i, count));
  }
  return variables;
}

/// f over a box (all of it, or a single corner) at one place.
struct PlaceValue {
  Jet value;
  Domain domain;
};

[[gnu::noinline]] PlaceValue value_over(const Problem& problem, Objective objective, const Box& box, double place) {
  const RoundingUp rounding;
  PlaceValue result;
  result.value =
      objective_at(objective, numbers_over(problem, variables_over(problem, box)), Jet(place), result.domain);
  return result;
}

/// constant + slope · x.
struct Line {
  std::array<Interval, Jet::k_most> slope{};
  Interval constant = 0.0;
};

double least_of(const Interval& slope, double lower, double upper) {
  const Interval product = slope * Interval(lower, upper);
  return product.lower();
}

/// Rigorous: the least of line + Σ ν_j (a_j · x − b_j) over the box.
double weighted_least(const Problem& problem, const Box& box, const Line& line, const std::vector<double>& weights) {
  Interval sum = line.constant;
  for (std::size_t j = 0; j < weights.size(); ++j) sum -= Interval(weights[j]) * problem.constraints[j].b;
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    Interval slope = line.slope[i];
    for (std::size_t j = 0; j < weights.size(); ++j) slope += Interval(weights[j]) * problem.constraints[j].a[i];
    sum += least_of(slope, box.lower[i], box.upper[i]);
  }
  return sum.lower();
}

/// Weights by going through the breaks of each in turn: the bound is a concave, piecewise linear function of them.
double constrained_least(const Problem& problem, const Box& box, const Line& line) {
  std::vector<double> weights(problem.constraints.size(), 0.0);
  double best = weighted_least(problem, box, line, weights);
  for (std::size_t j = 0; j < weights.size(); ++j) {
    std::array<double, Jet::k_most> breaks{};
    for (std::size_t i = 0; i < problem.variables.size(); ++i) {
      double slope = 0.5 * (line.slope[i].lower() + line.slope[i].upper());
      for (std::size_t k = 0; k < weights.size(); ++k) {
        if (k != j) slope += weights[k] * problem.constraints[k].a[i];
      }
      const double a = problem.constraints[j].a[i];
      breaks[i] = a != 0 ? -slope / a : 0.0;
    }
    const double before = weights[j];
    double kept = before;
    for (std::size_t i = 0; i < problem.variables.size(); ++i) {
      if (!(breaks[i] > 0)) continue;
      weights[j] = breaks[i];
      const double here = weighted_least(problem, box, line, weights);
      if (here > best) best = here, kept = breaks[i];
    }
    weights[j] = kept;
  }
  return best;
}

/// Bound 2. `corner_value`: f at that corner.
[[gnu::noinline]] double linear_bound(const Problem& problem, const Box& box, const Jet& over_box,
                                      const Interval& corner_value, const std::array<bool, Jet::k_most>& at_upper) {
  const RoundingUp rounding;
  Line line;
  line.constant = corner_value.lower();
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    line.slope[i] = at_upper[i] ? over_box.slope[i].upper() : over_box.slope[i].lower();
    line.constant -= line.slope[i] * Interval(at_upper[i] ? box.upper[i] : box.lower[i]);
  }
  return constrained_least(problem, box, line);
}

/// In the link's frame the pin lies `a` beside OC and `b` below C: tan γ = a/b over a point pin, and at one joint angle
/// both are linear in the variables.
struct Legs {
  Jet a, b;
};

Legs legs(const DesignNumbers<Jet>& d, bool of_tendon_1, const StrokeNumbers<Jet>& n) {
  const FromPin<Jet> to_C =
      of_tendon_1 ? from_pin_in_link(d.R, d.EB, d.OE, n.theta.mirrored()) : from_pin_in_link(d.R, d.ED, d.OE, n.theta);
  return {-to_C.x, to_C.y};
}

/// Least of b − q a over the box and the constraints.
double least_difference(const Problem& problem, const Box& box, const Legs& over, const Legs& at_lower, double q) {
  Line line;
  const Jet difference = over.b - Jet(q) * over.a;
  line.constant = at_lower.b.value - Interval(q) * at_lower.a.value;
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    line.slope[i] = difference.slope[i];
    line.constant -= line.slope[i] * Interval(box.lower[i]);
  }
  return constrained_least(problem, box, line);
}

/// Bound 3. −infinity where it does not apply.
[[gnu::noinline]] double quotient_bound(const Problem& problem, Objective objective, const Box& box, double place) {
  const RoundingUp rounding;
  const bool torque = objective == Objective::motor_torque;
  constexpr double none = -std::numeric_limits<double>::infinity();
  if (!problem.base.has_point_pins() ||
      !(torque ? problem.base.pulley.law == Law::compensate : objective == Objective::max_tension))
    return none;
  const DesignNumbers<Jet> d = numbers_over(problem, variables_over(problem, box));
  Domain domain;
  const StrokeNumbers<Jet> n = stroke_numbers(d, Jet(place), domain);
  const Legs over = legs(d, torque, n);
  // Linear in the variables only where the angle is a number.
  if (!domain.possible || n.theta.angle.count != 0 || !(over.a.value.lower() > 0)) return none;
  Box lower_corner = box;
  lower_corner.upper = box.lower;
  const Legs at_lower = legs(numbers_over(problem, variables_over(problem, lower_corner)), torque, n);
  // b − q a >= g means b/a >= q + g/a: from any q that is below, one that is nearer.
  double q = (over.b.value / over.a.value).lower();
  for (int step = 0; step < 4; ++step) {
    const double least = least_difference(problem, box, over, at_lower, q);
    const double better =
        (Interval(q) + Interval(least) / (least >= 0 ? over.a.value.upper() : over.a.value.lower())).lower();
    if (!(better > q)) break;
    q = better;
  }
  const Interval per_sine = sqrt(1.0 + squared(Interval(std::max(q, 0.0))));
  const Interval lever = torque ? Interval(d.r1.value.lower()) : Interval(1.0);
  return (lever * Interval(per_sine.lower()) * exp(d.mu.value * n.phi.value)).lower();
}

/// One piece of the stroke of one design.
[[gnu::noinline]] Interval value_over_piece(const Problem& problem, Objective objective, const Design& design,
                                            double low, double high) {
  const RoundingUp rounding;
  std::vector<Jet> variables;
  for (const double value : design) variables.emplace_back(value);
  const auto numbers = numbers_over(problem, variables);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto at = [&](const Jet& place) {
    Domain domain;
    const Jet value = objective_at(objective, numbers, place, domain);
    return domain.possible && domain.whole ? value : Jet(Interval(-infinite, infinite));
  };
  const Jet whole = at(Jet::variable({low, high}, 0, 1));
  Interval value = whole.value;
  if (whole.count == 0) return value;
  // From the end towards which it does not fall, or from the middle.
  const Interval slope = whole.slope[0];
  const double from = slope.lower() >= 0 ? high : slope.upper() <= 0 ? low : 0.5 * (low + high);
  const Interval centred = at(Jet(from)).value + slope * (Interval(low, high) - from);
  const Interval sharper = boost::numeric::intersect(value, centred);
  return boost::numeric::empty(sharper) ? value : sharper;
}

Design centre_of(const Box& box, std::size_t count) {
  Design centre(count);
  for (std::size_t i = 0; i < count; ++i) centre[i] = 0.5 * (box.lower[i] + box.upper[i]);
  return centre;
}

}  // namespace

Bounder::Bounder(const Problem& problem, Objective objective) : problem_(problem), objective_(objective) {}

bool Bounder::contract(Box& box) const {
  constexpr double k_slack = 1e-12;  // rounding here must not cut off a design
  const std::size_t count = problem_.variables.size();
  for (const LinearConstraint& constraint : problem_.constraints) {
    double least = 0, size = std::abs(constraint.b);
    for (std::size_t i = 0; i < count; ++i) {
      const double term = constraint.a[i] * (constraint.a[i] > 0 ? box.lower[i] : box.upper[i]);
      least += term;
      size = std::max(size, std::abs(term));
    }
    const double slack = k_slack * size;
    if (least > constraint.b + slack) return false;
    for (std::size_t i = 0; i < count; ++i) {
      const double a = constraint.a[i];
      if (a == 0) continue;
      const double others = least - a * (a > 0 ? box.lower[i] : box.upper[i]);
      const double limit = (constraint.b - others + slack) / a;
      if (a > 0) box.upper[i] = std::clamp(limit, box.lower[i], box.upper[i]);
      if (a < 0) box.lower[i] = std::clamp(limit, box.lower[i], box.upper[i]);
    }
  }
  return true;
}

/// Where f is largest, and where it is largest of its neighbours, in the middle of the box.
std::vector<double> Bounder::worst_places(const Box& box) const {
  constexpr int places = 25;
  const Mechanism middle = mechanism_at(problem_, centre_of(box, problem_.variables.size()));
  const auto numbers = design_numbers(file_numbers(middle), middle.pulley.law, middle.has_point_pins());
  std::array<double, places> values{};
  for (int i = 0; i < places; ++i) {
    Domain domain;
    const double value = objective_at(objective_, numbers, i / (places - 1.0), domain);
    values[static_cast<std::size_t>(i)] =
        domain.possible && value == value ? value : std::numeric_limits<double>::infinity();
  }
  std::vector<std::pair<double, double>> found;  // −value, place
  for (int i = 0; i < places; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool left = i == 0 || values[k] >= values[k - 1], right = i == places - 1 || values[k] >= values[k + 1];
    if (!left || !right) continue;
    double place = i / (places - 1.0);
    if (i > 0 && i < places - 1 && std::isfinite(values[k - 1] + values[k] + values[k + 1])) {
      const double bend = values[k - 1] - 2.0 * values[k] + values[k + 1];
      if (bend < 0) place += 0.5 * (values[k - 1] - values[k + 1]) / bend / (places - 1.0);
    }
    found.emplace_back(-values[k], place);
  }
  std::sort(found.begin(), found.end());
  std::vector<double> worst;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, found.size()); ++i) worst.push_back(found[i].second);
  return worst;
}

void Bounder::bound_at(const Box& box, double place, BoxBound& best, double enough) const {
  const std::size_t count = problem_.variables.size();
  const auto raise = [&best](double bound) {
    if (bound > best.bound) best.bound = bound;
  };
  ++evaluations_;
  const PlaceValue over = value_over(problem_, objective_, box, place);
  if (!over.domain.possible) {
    best.possible = false;
    return;
  }
  const bool leads = over.value.value.lower() > best.bound || best.best_corner.empty();
  raise(over.value.value.lower());
  if (best.bound > enough || !over.domain.whole || over.value.count == 0) return;

  std::array<bool, Jet::k_most> at_upper{};
  Box corner = box;
  for (std::size_t i = 0; i < count; ++i) {
    at_upper[i] = over.value.slope[i].lower() + over.value.slope[i].upper() < 0;
    (at_upper[i] ? corner.lower[i] : corner.upper[i]) = at_upper[i] ? box.upper[i] : box.lower[i];
  }
  ++evaluations_;
  const PlaceValue there = value_over(problem_, objective_, corner, place);
  if (there.domain.possible) {
    const double before = best.bound;
    raise(linear_bound(problem_, box, over.value, there.value.value, at_upper));
    if (leads || best.bound > before) {
      best.best_corner.assign(corner.lower.begin(), corner.lower.begin() + static_cast<std::ptrdiff_t>(count));
      for (std::size_t i = 0; i < count; ++i) {
        const double steepest = std::max(std::abs(over.value.slope[i].lower()), std::abs(over.value.slope[i].upper()));
        best.influence[i] = steepest * (box.upper[i] - box.lower[i]);
      }
    }
  }
  if (best.bound <= enough) raise(quotient_bound(problem_, objective_, box, place));
}

BoxBound Bounder::bound(const Box& box, double enough) const {
  BoxBound best;
  best.bound = box.bound;
  for (const double place : worst_places(box)) {
    bound_at(box, place, best, enough);
    if (!best.possible || best.bound > enough) break;
  }
  return best;
}

double Bounder::rounded_up_value(const Design& design) const {
  struct Piece {
    double low, high, upper;
    bool operator<(const Piece& other) const { return upper < other.upper; }
  };
  constexpr int k_most_pieces = 20000;
  constexpr double k_sharp = 1e-10;
  std::priority_queue<Piece> pieces;
  double least = -std::numeric_limits<double>::infinity();
  const auto add = [&](double low, double high) {
    ++evaluations_;
    const Interval value = value_over_piece(problem_, objective_, design, low, high);
    pieces.push({low, high, value.upper()});
    least = std::max(least, value_over_piece(problem_, objective_, design, low, low).lower());
    least = std::max(least, value_over_piece(problem_, objective_, design, high, high).lower());
  };
  for (int i = 0; i < 16; ++i) add(i / 16.0, (i + 1) / 16.0);
  for (int i = 0; i < k_most_pieces; ++i) {
    const Piece worst = pieces.top();
    if (worst.upper - least <= k_sharp * std::abs(least) || worst.high - worst.low < 1e-12) break;
    pieces.pop();
    const double middle = 0.5 * (worst.low + worst.high);
    add(worst.low, middle);
    add(middle, worst.high);
  }
  return pieces.top().upper;
}

}  // namespace fusee
