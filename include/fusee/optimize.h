/// \file
/// Optimization of a mechanism: certified by branch and bound, or by evolutionary search.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"
#include "fusee/mechanism_file.h"

namespace fusee::optimize {

// ---- Objectives -----------------------------------------------------------------------------------------------------
// Objectives: functions of a mechanism to minimize or maximize. Forces and errors are per newton of tip force, by the
// paper's formulas [1]-[11].

/// Functions of a mechanism; objectives() has their units and meanings.
enum class Objective { max_tension, max_error, footprint, motor_torque, min_bend };

/// Name, unit and meaning of an objective.
struct ObjectiveInfo {
  Objective objective;
  std::string_view name;  ///< in the mechanism file
  std::string_view unit;
  std::string_view meaning;
  bool is_maximized = false;  ///< instead of minimized
  bool certifiable = true;    ///< an interval form of its equations exists
};

/// All objectives, in the order of the enumeration.
std::span<const ObjectiveInfo> objectives();
/// The description of one objective.
const ObjectiveInfo& info(Objective objective);
Objective find_objective(std::string_view name);  ///< a name valid in the mechanism file

/// Value of an objective, or the reason why there is none. Finite if possible.
struct Evaluation {
  bool possible = false;
  double value = 0;
  double theta = 0;    ///< joint angle of that value, rad
  std::string reason;  ///< set if not possible

  /// Cost to minimize, for every objective; 1e300 if not possible.
  double cost(Objective objective) const;
};

/// Supports all laws. Pins are points if has_point_pins().
Evaluation evaluate(Objective objective, const Mechanism& mechanism);

// ---- Problem --------------------------------------------------------------------------------------------------------
// The optimization problem of [optimize] as numbers: variables with bounds, tied keys, linear constraints and
// objectives.

/// Values of the variables, in the file's units and order.
using Design = std::vector<double>;

/// A number that the search varies, with its bounds in the file's unit.
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

  /// Value of the key in a design, in the file's unit.
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

/// An optimization problem, made by make_problem().
struct Problem {
  DeclaredMechanism base;
  JointConverter identified_joint;  ///< empty: the joint is as declared
  std::vector<Objective> objectives;
  std::vector<Variable> variables;
  std::vector<MovingKey> moving;  ///< variables in their order, then tied keys
  std::vector<LinearConstraint> constraints;
  bool feasible = false;
  HelicalCheck multi_turn;  ///< empty: pulleys have one turn
  std::optional<ObjectiveCap> cap;
};

/// Variables, ties and constraints refer to declared numbers; objectives refer to the joint after `identified_joint`.
/// Throws InputError if there is nothing to optimize, or if a variable has no effect.
Problem make_problem(const MechanismFile& file, JointConverter identified_joint = {}, HelicalCheck multi_turn = {});

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
/// The design with each number that is within rounding of a bound moved to it: 50 in place of 49.99999999999999. Bounds
/// are those of the variables and of the constraints.
Design moved_to_bounds(const Problem& problem, Design design);
/// Evaluates the objective, constraints, bounds of ties, the cap, and (if required) whether a pulley can be made.
Evaluation evaluate_design(const Problem& problem, Objective objective, const Design& design);

// ---- Certified optimum ----------------------------------------------------------------------------------------------
// Proven global optimum: branch and bound with outward-rounded intervals over the variables and the stroke.
// Constraints are satisfied to 1e-12 of their largest term, in the bound and in the designs.

/// Accuracy and limits of certified_optimum().
struct CertifiedOptions {
  double gap = 1e-6;          ///< relative, between the best design's value and the proven bound
  double tie = 1e-3;          ///< relative: designs this close to the best one tie with it
  long most_boxes = 1000000;  ///< limit of memory (150 MB) and time
  long most_tie_boxes = 3000;
  std::vector<Design> first_tries;  ///< designs known to be good
  /// The search ends at a design with a smaller value.
  std::optional<double> sufficient = std::nullopt;
  unsigned threads = 0;  ///< at most as many; 0: all of the thread pool. The result does not depend on it
};

/// All designs between two corners.
struct DesignBox {
  Design lower;
  Design upper;
};

/// Enclosure of all designs within `tie` of the optimum: none lies outside of `boxes`.
struct TieSet {
  std::vector<DesignBox> boxes;
  DesignBox hull;    ///< encloses all boxes
  DesignBox known;   ///< encloses evaluated designs that tie: the set is at least this large
  double share = 0;  ///< volume of the boxes relative to the whole box
  /// True if a variable can change by more than a twentieth of its range within the set.
  bool wide = false;
};

/// Result of certified_optimum().
struct CertifiedResult {
  bool found = false;    ///< false: no design satisfies all conditions (proven if `proven`)
  bool proven = false;   ///< the gap was reached
  bool stopped = false;  ///< by RunContext::stop, or by `sufficient`: the best design so far
  Design best;
  double value = 0;        ///< value of the best design, rounded up over the whole range
  double theta = 0;        ///< joint angle of that value, rad
  double lower_bound = 0;  ///< lower bound on all designs, rounded down
  double relative_gap = 0;
  TieSet ties;
  long boxes = 0;        ///< number of examined boxes
  long evaluations = 0;  ///< interval evaluations of the formulas at one angle
  std::string reason;    ///< if nothing was found: the most frequent cause
};

/// Reason why this optimum cannot be certified; empty if it can.
std::string cannot_certify(const Problem& problem, Objective objective);

/// Requires a certifiable objective, law compensate or linear, and a joint as declared; otherwise throws InputError
/// with the certifiable objectives. With Problem::feasible, no design with a drawable pulley is below the bound. Two
/// conditions of profile/feasibility.cpp are omitted from the bound, which can only lower it: one turn suffices, and an
/// arc closes the curve. The best design satisfies all of them. Progress: "best 2.367", or "" before the first design.
CertifiedResult certified_optimum(const Problem& problem, Objective objective, const CertifiedOptions& options = {},
                                  const RunContext& context = {});

// ---- Evolutionary search --------------------------------------------------------------------------------------------
// Evolutionary search (pagmo): the paper's genetic algorithm, and NSGA-II for two or three objectives. Seeded: every
// run gives the same bytes.

/// Size and seed of the evolutionary searches.
struct GeneticOptions {
  unsigned population = 48;  ///< a multiple of 4
  unsigned generations = 100;
  unsigned seed = 1;
  unsigned threads = 0;  ///< at most as many; 0: all of the thread pool. The result does not depend on it
};

/// One generation of the single-objective algorithm, as in the paper's Fig. 7.
struct Generation {
  unsigned number = 0;
  double best = 0;  ///< best value so far
  double mean = 0;  ///< mean over the possible designs of this generation
};

/// Result of genetic_optimum().
struct GeneticResult {
  bool found = false;
  bool stopped = false;  ///< by RunContext::stop
  Design best;
  double value = 0;
  double theta = 0;
  std::vector<Generation> generations;
  long evaluations = 0;
  std::string reason;  ///< cause if nothing was found
};

/// A stopped search returns its best design. Progress: "best 2.367", or "" before the first design.
GeneticResult genetic_optimum(const Problem& problem, Objective objective, const GeneticOptions& options = {},
                              const RunContext& context = {});

/// One design of a Pareto front.
struct FrontPoint {
  Design design;
  std::vector<double> values;  ///< values of the problem's objectives, in their units
};

/// Result of pareto_front().
struct ParetoResult {
  bool stopped = false;           ///< by RunContext::stop
  unsigned generations = 0;       ///< completed generations
  std::vector<FrontPoint> front;  ///< non-dominated designs, sorted by the first objective
  long evaluations = 0;
  std::string reason;  ///< cause if the front is empty
};

/// Requires two or three objectives; otherwise throws InputError.
ParetoResult pareto_front(const Problem& problem, const GeneticOptions& options = {}, const RunContext& context = {});

}  // namespace fusee::optimize
