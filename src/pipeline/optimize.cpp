#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/plausibility.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "pipeline/design_file.h"
#include "pipeline/multi_turn.h"

namespace fusee::pipeline {
namespace {

/// True if an identified effect changes an objective. Manufacturing errors of the pulley do not.
bool joint_differs(DeclaredMechanism declared) {
  declared.identified.pulley.scale = 0;
  return !(joint::identified_joint(declared).mechanism == static_cast<const Mechanism&>(declared));
}

/// Converter from a declared design to the joint that is evaluated: identified effects add to the declared numbers.
/// Empty if there are none.
optimize::JointConverter joint_converter(const DeclaredMechanism& declared) {
  if (declared.transmission || !joint_differs(declared)) return {};
  return [](const DeclaredMechanism& design) { return joint::identified_joint(design).mechanism; };
}

SearchMethod strongest_method(const optimize::Problem& problem) {
  if (problem.objectives.size() > 1) return SearchMethod::pareto;
  return optimize::cannot_certify(problem, problem.objectives.front()).empty() ? SearchMethod::certified
                                                                               : SearchMethod::genetic;
}

optimize::Problem problem_of(const MechanismFile& file) {
  return optimize::make_problem(file, joint_converter(file.mechanism), obstacle_to_multi_turn);
}

void demand_one_objective(const MechanismFile& file, const optimize::Problem& problem) {
  const std::size_t count = problem.objectives.size();
  if (count == 1) return;
  throw InputError(
      file.path, "optimize.objective names " + std::to_string(count) + " objectives, and this method takes one",
      "--method pareto, or --set optimize.objective=" + std::string(optimize::info(problem.objectives.front()).name));
}

template <typename Found>
void take_best(const Found& found, OptimizeResult& result) {
  result.found = found.found;
  result.stopped = found.stopped;
  result.reason = found.reason;
  result.design = found.best;
  result.value = found.value;
  result.theta = found.theta;
}

/// Selects the best of the designs that tie with the first optimum, by another objective.
void break_ties(optimize::Objective second, const optimize::CertifiedResult& first, const RunContext& context,
                OptimizeResult& result) {
  optimize::CertifiedOptions options;
  const optimize::Objective objective = result.problem.objectives.front();
  optimize::Problem tied_designs = result.problem;
  tied_designs.cap = optimize::ObjectiveCap{objective, first.value + options.tie * std::abs(first.value)};
  options.first_tries = {first.best};
  // Ties of 0.1 % need no finer gap, and the edge of a thin set of designs is costly to follow.
  options.gap = options.tie;
  options.most_boxes = 300000;
  result.then = optimize::certified_optimum(tied_designs, second, options, context);
  result.stopped = result.then->stopped;
  result.design = result.then->best;
  const optimize::Evaluation value = optimize::evaluate_design(result.problem, objective, result.design);
  result.value = value.value;
  result.theta = value.theta;
}

void search_certified(const OptimizeOptions& options, const RunContext& context, OptimizeResult& result) {
  const optimize::CertifiedResult found =
      optimize::certified_optimum(result.problem, result.problem.objectives.front(), {}, context);
  take_best(found, result);
  result.search = found;
  if (found.found && options.then && !found.stopped) break_ties(*options.then, found, context, result);
}

void search_genetic(const optimize::GeneticOptions& options, const RunContext& context, OptimizeResult& result) {
  const optimize::GeneticResult found =
      optimize::genetic_optimum(result.problem, result.problem.objectives.front(), options, context);
  take_best(found, result);
  result.search = found;
}

/// The point of the front nearest to the ideal point, with each objective scaled by its span on the front.
const optimize::FrontPoint& balanced_point(const std::vector<optimize::FrontPoint>& front,
                                           const std::vector<optimize::Objective>& objectives) {
  std::vector<double> distances(front.size(), 0.0);
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    const double sign = optimize::info(objectives[k]).is_maximized ? -1.0 : 1.0;
    double low = 1e300, high = -1e300;
    for (const optimize::FrontPoint& point : front) {
      low = std::min(low, sign * point.values[k]);
      high = std::max(high, sign * point.values[k]);
    }
    if (!(high > low)) continue;
    for (std::size_t i = 0; i < distances.size(); ++i)
      distances[i] += elementary::pow((sign * front[i].values[k] - low) / (high - low), 2);
  }
  return front.at(static_cast<std::size_t>(std::min_element(distances.begin(), distances.end()) - distances.begin()));
}

void search_front(const optimize::GeneticOptions& options, const RunContext& context, OptimizeResult& result) {
  const optimize::ParetoResult found = optimize::pareto_front(result.problem, options, context);
  result.stopped = found.stopped;
  result.found = !found.front.empty();
  result.reason = found.reason;
  result.search = found;
  if (!result.found) return;
  const optimize::FrontPoint& best = balanced_point(found.front, result.problem.objectives);
  result.design = best.design;
  result.value = best.values.front();
}

void search(SearchMethod method, const OptimizeOptions& options, const RunContext& context, OptimizeResult& result) {
  switch (method) {
    case SearchMethod::certified:
      return search_certified(options, context, result);
    case SearchMethod::genetic:
      return search_genetic(options.genetic, context, result);
    case SearchMethod::pareto:
      return search_front(options.genetic, context, result);
  }
}

/// Moves the found designs to bounds within rounding, unless no pulley is possible there.
void move_to_bounds(OptimizeResult& result) {
  const optimize::Problem& problem = result.problem;
  const auto moved = [&problem](const optimize::Design& design) -> std::optional<optimize::Design> {
    optimize::Design at_bounds = optimize::moved_to_bounds(problem, design);
    const bool is_same = at_bounds == design;
    if (is_same || !optimize::evaluate_design(problem, problem.objectives.front(), at_bounds).possible)
      return std::nullopt;
    return at_bounds;
  };
  if (const auto design = moved(result.design)) result.design = *design;
  if (auto* pareto = std::get_if<optimize::ParetoResult>(&result.search)) {
    for (optimize::FrontPoint& point : pareto->front)
      if (const auto design = moved(point.design)) point.design = *design;
  }
}

/// File name of a point: point_001.toml …
std::string point_name(std::size_t number) {
  const std::string digits = std::to_string(number);
  return "point_" + std::string(3 - std::min<std::size_t>(3, digits.size()), '0') + digits + ".toml";
}

void write_texts(const MechanismFile& file, const OptimizeOptions& options, FileAccess& files, OptimizeResult& result) {
  const auto text_of = [&](const optimize::Design& design, std::vector<Diagnostic>& warnings) {
    DesignFile written = design_file(file, result.problem, design, options.settings, files);
    warnings = std::move(written.warnings);
    return std::move(written.text);
  };
  std::vector<Diagnostic> warnings;  // equal for every point
  if (const auto* pareto = std::get_if<optimize::ParetoResult>(&result.search);
      pareto && !options.front_folder.empty()) {
    for (const optimize::FrontPoint& point : pareto->front)
      result.front_files.push_back({point_name(result.front_files.size() + 1), text_of(point.design, warnings)});
  }
  if (!options.new_file.empty()) result.new_text = text_of(result.design, warnings);
  result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
}

/// Adds the notes and warnings about several turns to the result.
void add_notes_on_turns(const MechanismFile& file, OptimizeResult& result) {
  MechanismFile found = file;
  found.mechanism = optimize::mechanism_at(result.problem, result.design);
  if (const auto note = note_on_turns(found)) result.warnings.push_back(*note);
  for (Diagnostic& warning : warnings_of_turns(found)) result.warnings.push_back(std::move(warning));
}

void publish(const OptimizeOptions& options, OutputFolder& front_folder, FileAccess& files, OptimizeResult& result) {
  for (const OutputFile& file : result.front_files) front_folder.stage(file);
  front_folder.publish(result.warnings);
  if (!options.new_file.empty()) write_file(options.new_file, result.new_text, options.force, files);
  result.published = true;
}

}  // namespace

SearchMethod strongest_method(const MechanismFile& file) { return strongest_method(problem_of(file)); }

OptimizeResult optimize(const MechanismFile& file, const OptimizeOptions& options, const RunContext& context) {
  OptimizeResult result;
  result.problem = problem_of(file);
  result.warnings = analysis::plausibility_warnings(file);
  const std::vector<Diagnostic> bends = analysis::tight_bends(file);
  result.warnings.insert(result.warnings.end(), bends.begin(), bends.end());
  const SearchMethod method = options.method ? *options.method : strongest_method(result.problem);
  if (method != SearchMethod::pareto) demand_one_objective(file, result.problem);
  // Without the stop token: the best design of a stopped search is published.
  OutputFolder front_folder(options.front_folder, options.force, {.files = context.files});
  // Before the work, so that a refusal costs no time.
  if (!options.front_folder.empty()) front_folder.claim({point_name(1)});
  search(method, options, context, result);
  result.before =
      optimize::evaluate(result.problem.objectives.front(), optimize::judged(result.problem, result.problem.base));
  if (!result.found) return result;
  move_to_bounds(result);
  add_notes_on_turns(file, result);
  write_texts(file, options, *context.files, result);
  if (!options.dry_run) publish(options, front_folder, *context.files, result);
  return result;
}

}  // namespace fusee::pipeline
