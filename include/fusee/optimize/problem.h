/// \file
/// [optimize] as numbers: a box of variables, what is tied to them, linear constraints, and what is wanted.
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
  std::string symbol;  ///< "R", or the key where there is none
  std::string unit;
  double lower = 0;
  double upper = 0;
};

/// a · x <= b over the variables, the ties put in.
struct LinearConstraint {
  std::vector<double> a;
  double b = 0;
  std::string text;
};

/// A key that a design changes: a variable, or what is tied to some. Its value is constant + a · x.
struct MovingKey {
  std::string key;
  NumberKey number;
  std::vector<double> a;
  double constant = 0;

  double value(const Design& design) const;
};

/// One objective already has its say: designs above `limit` do not count.
struct ObjectiveCap {
  Objective objective = Objective::max_tension;
  double limit = 0;
};

/// From a mechanism as declared to the joint that is judged.
using JointGate = std::function<Mechanism(const DeclaredMechanism& declared)>;

/// What keeps a judged joint, whose only fault is that its pulleys turn further than once, from helical grooves; null
/// where nothing does.
using TurnsGate = std::function<std::optional<std::string>(const Mechanism& judged)>;

struct Problem {
  DeclaredMechanism base;
  JointGate as_it_is;  ///< empty: the joint is as declared
  std::vector<Objective> objectives;
  std::vector<Variable> variables;
  std::vector<MovingKey> moving;  ///< variables in their order, then what is tied
  std::vector<LinearConstraint> constraints;
  bool feasible = false;
  TurnsGate several_turns;  ///< empty: pulleys are of one turn
  std::optional<ObjectiveCap> cap;
};

/// Variables, ties and constraints are of declared numbers; objectives are of the joint that comes of them through
/// `as_it_is`. InputError: nothing to optimise, a variable that no objective depends on.
Problem make_problem(const MechanismFile& file, JointGate as_it_is = {}, TurnsGate several_turns = {});

/// Whether the footprint of its designs is known: of the paper's joint, at its pulley.
bool has_footprint(const Problem& problem);

/// The mechanism of a design as declared, ties followed; without its [optimize].
DeclaredMechanism mechanism_at(const Problem& problem, const Design& design);
/// The joint that a declared one is judged as.
Mechanism judged(const Problem& problem, const DeclaredMechanism& declared);
/// What a design changes in the person's file.
std::vector<ValueEdit> edits_of(const Problem& problem, const Design& design);
/// How far beyond its constraints a design lies, each in units of its own size; 0 when it keeps them all.
double constraint_violation(const Problem& problem, const Design& design);
/// Objective, constraints, ties within their bounds, cap, and (when demanded) whether a pulley can be made.
Evaluation evaluate_design(const Problem& problem, Objective objective, const Design& design);

/// How far a search has come; returning false stops it, and it answers with what it has.
struct SearchProgress {
  double done = 0;             ///< 0 … 1, a guess
  std::optional<double> best;  ///< value of the best design so far, in the objective's unit; none of a front
  double lower_bound = 0;      ///< certified only
  long evaluations = 0;
};
using KeepGoing = std::function<bool(const SearchProgress&)>;

}  // namespace fusee
