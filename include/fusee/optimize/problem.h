/// \file
/// The optimization problem of [optimize] as numbers: variables with bounds, tied keys, linear constraints and
/// objectives.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fusee/mechanism/edit.h"
#include "fusee/mechanism/fields.h"
#include "fusee/mechanism/file.h"
#include "fusee/mechanism/linear_relation.h"
#include "fusee/optimize/objectives.h"

namespace fusee {

/// Values of the variables, in the file's units and order.
using Design = std::vector<double>;

struct Variable {
  std::string key;
  std::string symbol;  ///< "R", or the key if there is no symbol
  std::string unit;
  double lower = 0;
  double upper = 0;
};

/// a · x <= b over the variables, with ties substituted.
struct LinearConstraint {
  std::vector<double> a;
  double b = 0;
  std::string text;
};

/// A key that a design changes: a variable, or a key tied to variables. Its value is constant + a · x.
struct MovingKey {
  std::string key;
  NumberKey number;
  std::vector<double> a;
  double constant = 0;

  double value(const Design& design) const;
};

/// Upper limit on an objective that was optimized before.
struct ObjectiveCap {
  Objective objective = Objective::max_tension;
  double limit = 0;
};

/// Converts a declared mechanism into the joint that is evaluated.
using JointConverter = std::function<Mechanism(const DeclaredMechanism& declared)>;

/// Tests helical grooves for an evaluated joint whose only failed condition is that of one turn. Returns the obstacle,
/// or null if there is none.
using HelicalCheck = std::function<std::optional<std::string>(const Mechanism& judged)>;

struct Problem {
  DeclaredMechanism base;
  JointConverter as_it_is;  ///< empty: the joint is as declared
  std::vector<Objective> objectives;
  std::vector<Variable> variables;
  std::vector<MovingKey> moving;  ///< variables in their order, then tied keys
  std::vector<LinearConstraint> constraints;
  bool feasible = false;
  HelicalCheck several_turns;  ///< empty: pulleys have one turn
  std::optional<ObjectiveCap> cap;
};

/// Variables, ties and constraints refer to declared numbers; objectives refer to the joint after `as_it_is`. Throws
/// InputError if there is nothing to optimize, or if a variable has no effect.
Problem make_problem(const MechanismFile& file, JointConverter as_it_is = {}, HelicalCheck several_turns = {});

/// True if the footprint of its designs is defined: the paper's joint, directly at its pulley.
bool has_footprint(const Problem& problem);

/// The declared mechanism of a design, with ties resolved and without [optimize].
DeclaredMechanism mechanism_at(const Problem& problem, const Design& design);
/// The joint that is evaluated for a declared mechanism.
Mechanism judged(const Problem& problem, const DeclaredMechanism& declared);
/// The edits of the user's file for a design.
std::vector<ValueEdit> edits_of(const Problem& problem, const Design& design);
/// Total violation of the constraints, each relative to its own size; 0 if all are satisfied.
double constraint_violation(const Problem& problem, const Design& design);
/// Evaluates the objective, constraints, bounds of ties, the cap, and (if required) whether a pulley can be made.
Evaluation evaluate_design(const Problem& problem, Objective objective, const Design& design);

}  // namespace fusee
