#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "fusee/optimize.h"
#include "fusee/profile.h"
#include "mechanism/linear_relation.h"
#include "optimize/random.h"
#include "profile/feasibility.h"

namespace fusee::optimize {
namespace {

/// constant + a · x.
struct Affine {
  std::vector<double> a;
  double constant = 0;
};

/// The expression as a function of the variables x.
Affine affine(const Problem& problem, const LinearExpression& expression) {
  Affine sum{std::vector<double>(problem.variables.size(), 0.0), expression.constant};
  for (const LinearTerm& term : expression.terms) {
    const auto moving = std::find_if(problem.moving.begin(), problem.moving.end(),
                                     [&](const MovingKey& m) { return m.key == term.key; });
    if (moving == problem.moving.end()) {
      sum.constant += term.factor * find_number_key(term.key)->get(problem.base);
      continue;
    }
    for (std::size_t i = 0; i < sum.a.size(); ++i) sum.a[i] += term.factor * moving->a[i];
    sum.constant += term.factor * moving->constant;
  }
  return sum;
}

void add_moving(Problem& problem, const std::string& key, const LinearExpression& value) {
  const Affine sum = affine(problem, value);
  problem.moving.push_back({key, *find_number_key(key), sum.a, sum.constant});
}

/// left <= right
void add_constraint(Problem& problem, const Affine& left, const Affine& right, const std::string& text) {
  LinearConstraint constraint{left.a, right.constant - left.constant, text};
  for (std::size_t i = 0; i < constraint.a.size(); ++i) constraint.a[i] -= right.a[i];
  problem.constraints.push_back(std::move(constraint));
}

void add_moving_keys(Problem& problem, const Optimization& table) {
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    MovingKey moving{problem.variables[i].key, *find_number_key(problem.variables[i].key),
                     std::vector<double>(problem.variables.size(), 0.0), 0.0};
    moving.a[i] = 1.0;
    problem.moving.push_back(std::move(moving));
  }
  for (const std::string& text : table.tied) {
    const LinearRelation tie = parse_relation(text, problem.base.units).relation;
    add_moving(problem, tie.left.terms.front().key, tie.right);
  }
}

void add_constraints(Problem& problem, const Optimization& table) {
  for (const std::string& text : table.constraints) {
    const LinearRelation relation = parse_relation(text, problem.base.units).relation;
    const Affine left = affine(problem, relation.left), right = affine(problem, relation.right);
    add_constraint(problem, left, right, text);
    if (relation.relation == Relation::equal) add_constraint(problem, right, left, text);
  }
  // A tied key must stay within the file's bounds.
  const Affine none{std::vector<double>(problem.variables.size(), 0.0), 0.0};
  for (std::size_t i = problem.variables.size(); i < problem.moving.size(); ++i) {
    const MovingKey& tied = problem.moving[i];
    const Field& field = *tied.number.field;
    Affine least = none, most = none;
    least.constant = field.least;
    most.constant = field.most;
    add_constraint(problem, least, {tied.a, tied.constant}, tied.key + " >= " + shortest(field.least));
    add_constraint(problem, {tied.a, tied.constant}, most, tied.key + " <= " + shortest(field.most));
  }
}

std::vector<Variable> variables_of(const Optimization& table) {
  std::vector<Variable> variables;
  for (std::size_t i = 0; i < table.variables.size(); ++i) {
    const Field& field = *find_number_key(table.variables[i])->field;
    const std::string symbol =
        field.symbol.empty() || field.kind == FieldKind::range ? table.variables[i] : std::string(field.symbol);
    variables.push_back({table.variables[i], symbol, std::string(field.unit), table.lower[i], table.upper[i]});
  }
  return variables;
}

/// Values of the conditions of a pulley.
std::vector<double> feasibility_values(const Mechanism& mechanism) {
  const transmission::Transmission transmission(mechanism);
  std::vector<double> values;
  for (const profile::Condition& condition : profile::attempt(mechanism, transmission).conditions)
    values.push_back(condition.value);
  return values;
}

/// True if changing this variable alone affects an objective, its possibility or (if required) the conditions of the
/// pulley.
bool has_effect(const Problem& problem, std::size_t variable) {
  Random random(1);
  constexpr int k_trials = 12;
  bool nothing_is_possible = true;  // then effects are unknown as well
  for (int trial = 0; trial < k_trials; ++trial) {
    Design a = random_design(problem, random);
    Design b = a;
    a[variable] = problem.variables[variable].lower;
    b[variable] = problem.variables[variable].upper;
    const Mechanism at_a = judged(problem, mechanism_at(problem, a)), at_b = judged(problem, mechanism_at(problem, b));
    for (const Objective objective : problem.objectives) {
      const Evaluation value_a = evaluate(objective, at_a), value_b = evaluate(objective, at_b);
      if (value_a.possible != value_b.possible || value_a.value != value_b.value) return true;
      if (value_a.possible) nothing_is_possible = false;
    }
    if (problem.feasible && feasibility_values(at_a) != feasibility_values(at_b)) return true;
  }
  return nothing_is_possible;
}

/// Throws InputError for variables without effect.
void demand_effects(const Problem& problem, const std::string& file) {
  std::vector<Diagnostic> errors;
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    const Variable& variable = problem.variables[i];
    if (variable.lower == variable.upper || has_effect(problem, i)) continue;
    std::string names;
    for (const Objective objective : problem.objectives)
      names += (names.empty() ? "" : ", ") + std::string(info(objective).name);
    Diagnostic error;
    error.place.file = file;
    error.message = "optimize.variables: " + variable.key + " has no effect on " + names;
    error.hint = "leave it out, or choose an objective that depends on it";
    if (problem.base.guides.mu == 0) error.hint += " (guides.friction is 0)";
    errors.push_back(std::move(error));
  }
  if (!errors.empty()) throw InputError(errors);
}

}  // namespace

double MovingKey::value(const Design& design) const {
  double sum = constant;
  for (std::size_t i = 0; i < design.size(); ++i) sum += a[i] * design[i];
  return sum;
}

DeclaredMechanism mechanism_at(const Problem& problem, const Design& design) {
  DeclaredMechanism mechanism = problem.base;
  for (const MovingKey& moving : problem.moving) moving.number.set(mechanism, moving.value(design));
  return mechanism;
}

Mechanism judged(const Problem& problem, const DeclaredMechanism& declared) {
  return problem.identified_joint ? problem.identified_joint(declared) : static_cast<const Mechanism&>(declared);
}

std::vector<ValueEdit> edits_of(const Problem& problem, const Design& design) {
  std::vector<ValueEdit> edits;
  for (const MovingKey& moving : problem.moving) edits.push_back({moving.key, moving.value(design)});
  return edits;
}

Design moved_to_bounds(const Problem& problem, Design design) {
  const auto is_near = [](double number, double bound) {
    constexpr double k_rounding = 1e-12;
    return std::abs(number - bound) <= k_rounding * std::abs(bound);
  };
  const auto digits = [](double number) { return fmt::format("{}", number).size(); };
  for (std::size_t i = 0; i < design.size(); ++i) {
    const Variable& variable = problem.variables[i];
    for (const double bound : {variable.lower, variable.upper})
      if (is_near(design[i], bound)) design[i] = bound;
  }
  for (const LinearConstraint& constraint : problem.constraints) {
    for (std::size_t i = 0; i < design.size(); ++i) {
      if (constraint.a[i] == 0) continue;
      double remainder = constraint.b;
      for (std::size_t j = 0; j < design.size(); ++j) {
        if (j != i) remainder -= constraint.a[j] * design[j];
      }
      const double bound = remainder / constraint.a[i];
      // The number of a constraint that has the rounding error moves, not the round one.
      if (is_near(design[i], bound) && digits(bound) < digits(design[i])) design[i] = bound;
    }
  }
  return design;
}

double constraint_violation(const Problem& problem, const Design& design) {
  constexpr double k_rounding = 1e-12;  // relative to the largest term of a constraint
  double violation = 0;
  for (const LinearConstraint& constraint : problem.constraints) {
    double excess = -constraint.b, size = std::abs(constraint.b);
    for (std::size_t i = 0; i < design.size(); ++i) {
      excess += constraint.a[i] * design[i];
      size = std::max(size, std::abs(constraint.a[i] * design[i]));
    }
    if (excess > k_rounding * size) violation += excess / size;
  }
  return violation;
}

namespace {

/// Obstacle to pulleys of one turn or, if allowed, of several.
std::optional<std::string> obstacle_to_pulleys(const Problem& problem, const Mechanism& mechanism) {
  const auto obstacle = profile::obstacle_to(mechanism);
  if (!obstacle) return std::nullopt;
  if (!profile::is_of_one_turn(*obstacle) || !problem.multi_turn || profile::kept_to_one_turn(mechanism))
    return obstacle->message;
  if (const auto other = profile::obstacle_but_one_turn(mechanism)) return other->message;
  return problem.multi_turn(mechanism);
}

}  // namespace

Evaluation evaluate_design(const Problem& problem, Objective objective, const Design& design) {
  Evaluation impossible;
  if (constraint_violation(problem, design) > 0) {
    impossible.reason = "a constraint is violated";
    return impossible;
  }
  const Mechanism mechanism = judged(problem, mechanism_at(problem, design));
  if (problem.cap) {
    const Evaluation capped = evaluate(problem.cap->objective, mechanism);
    if (!capped.possible) return capped;
    if (!(capped.cost(problem.cap->objective) <= problem.cap->limit)) {
      impossible.reason = std::string(info(problem.cap->objective).name) + " is beyond its limit";
      return impossible;
    }
  }
  Evaluation evaluation = evaluate(objective, mechanism);
  if (evaluation.possible && problem.feasible) {
    if (const auto obstacle = obstacle_to_pulleys(problem, mechanism)) {
      impossible.reason = "no pulley can be made: " + *obstacle;
      return impossible;
    }
  }
  return evaluation;
}

namespace {

/// True if the file or a variable adds a drum or attachments.
bool is_widened(const Problem& problem) {
  return !problem.base.joint.is_plain() ||
         std::any_of(problem.moving.begin(), problem.moving.end(), [](const MovingKey& moving) {
           return moving.key.starts_with("joint.drum") || moving.key.starts_with("joint.attachment");
         });
}

}  // namespace

bool has_footprint(const Problem& problem) { return !is_widened(problem) && !problem.base.sheath.is_there(); }

Problem make_problem(const MechanismFile& file, JointConverter identified_joint, HelicalCheck multi_turn) {
  const Optimization& table = file.mechanism.optimize;
  if (file.mechanism.transmission)
    throw InputError(file.path, "declares [transmission] in place of a mechanism",
                     "only a joint with guides and pulley can be optimised");
  if (table.variables.empty()) {
    throw InputError(file.path, "has no [optimize] variables",
                     "add variables, for example variables = [\"joint.length_mm\"], lower = [100], upper = [300]");
  }
  if (table.objectives.empty())
    throw InputError(file.path, "optimize.objective is empty", "name one, for example objective = \"max_tension\"");
  Problem problem;
  problem.base = file.mechanism;
  problem.base.optimize = {};  // designs are copied by the thousand
  problem.identified_joint = std::move(identified_joint);
  problem.multi_turn = std::move(multi_turn);
  for (const std::string& name : table.objectives) problem.objectives.push_back(find_objective(name));
  problem.variables = variables_of(table);
  add_moving_keys(problem, table);
  add_constraints(problem, table);
  problem.feasible = table.feasible;
  const bool asks_footprint =
      std::count(problem.objectives.begin(), problem.objectives.end(), Objective::footprint) > 0;
  if (asks_footprint && is_widened(problem))
    throw InputError(file.path, "footprint is not defined for drums and separate attachments",
                     "choose another objective");
  if (asks_footprint && problem.base.sheath.is_there())
    throw InputError(file.path, "footprint is not defined for joints with sheaths", "choose another objective");
  const bool varies_sheath = std::any_of(problem.moving.begin(), problem.moving.end(),
                                         [](const MovingKey& moving) { return moving.key.starts_with("sheath."); });
  if (varies_sheath && !problem.base.sheath.is_there())
    throw InputError(file.path, "[optimize] varies a key of [sheath], which the file lacks", "declare the sheath");
  demand_effects(problem, file.path);
  return problem;
}

}  // namespace fusee::optimize
