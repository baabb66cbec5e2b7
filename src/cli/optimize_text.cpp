#include "cli/optimize_text.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "cli/pins.h"
#include "cli/table.h"
#include "mechanism/lengths.h"

namespace fusee::cli {
namespace {

std::string unit_text(std::string_view unit) { return unit.empty() ? "" : " " + std::string(unit); }
std::string value_text(optimize::Objective objective, double value) {
  return rounded(value, 7) + unit_text(optimize::info(objective).unit);
}

// ---- a design -------------------------------------------------------------------------------------------------------

Json design_json(const optimize::Problem& problem, const optimize::Design& design) {
  Json json = Json::object();
  for (const ValueEdit& edit : optimize::edits_of(problem, design)) json[edit.key] = edit.value;
  return json;
}

/// True if two values are equal but for rounding. `range`: width of the variable's bounds.
bool is_near(double a, double b, double range) { return std::abs(a - b) <= 1e-6 * range; }

std::string design_text(const optimize::Problem& problem, const optimize::Design& design) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < problem.moving.size(); ++i) {
    const optimize::MovingKey& moving = problem.moving[i];
    const Field& field = *moving.number.field;
    const double value = moving.value(design);
    // The variables come first, then the keys that relations tie to them.
    std::string bound = i < design.size() ? "" : "tied";
    if (i < design.size()) {
      const optimize::Variable& variable = problem.variables[i];
      const double range = variable.upper - variable.lower;
      if (is_near(value, variable.lower, range))
        bound = "at its lower bound";
      else if (is_near(value, variable.upper, range))
        bound = "at its upper bound";
    }
    const LengthUnit units = is_length(moving.key) ? problem.base.units : LengthUnit::mm;
    rows.push_back({"  " + moving.key, rounded(from_mm(value, units), 7), std::string(unit_in_file(field, units)),
                    "was " + rounded(from_mm(moving.number.get(problem.base), units), 7), bound});
  }
  return table({{"  key"}, {"value", Align::right}, {"unit"}, {"in the file"}, {""}}, rows);
}

/// States how pins and identified effects are treated.
void add_joint(const pipeline::OptimizeResult& result, Reply& reply) {
  const optimize::Problem& problem = result.problem;
  const Mechanism joint = optimize::judged(problem, optimize::mechanism_at(problem, result.design));
  reply.fields["pins"] = pins_json(joint);
  reply.text += titled("pins", pins_text(joint));
  if (!problem.identified_joint) return;
  reply.fields["joint"] = "as_it_is";
  reply.text += titled("joint", "identified: [identified] is added to these numbers");
}

void add_value(const pipeline::OptimizeResult& result, Reply& reply) {
  const optimize::Objective objective = result.problem.objectives.front();
  const optimize::Evaluation& now = result.before;
  reply.fields["objective"] = optimize::info(objective).name;
  reply.fields["unit"] = optimize::info(objective).unit;
  reply.fields["value"] = result.value;
  reply.fields["theta_deg"] = degrees(result.theta);
  if (now.possible) reply.fields["value_before"] = now.value;
  reply.fields["design"] = design_json(result.problem, result.design);
  const std::string before = now.possible ? "; as declared: " + value_text(objective, now.value) : "";
  reply.text += titled(
      std::string(optimize::info(objective).name),
      value_text(objective, result.value) + " at theta = " + rounded(degrees(result.theta), 4) + " deg" + before);
  add_joint(result, reply);
  reply.text += design_text(result.problem, result.design);
}

// ---- the three methods ----------------------------------------------------------------------------------------------

void report_no_design(const std::string& path, const pipeline::OptimizeResult& result, bool proven, Reply& reply) {
  reply.exit = Exit::infeasible;
  Diagnostic error = about_file(
      Severity::error, path,
      std::string(proven ? "no design of the box is feasible (proven)" : "no feasible design was found in the box") +
          "; the most frequent reason: " + result.reason);
  error.hint = "widen lower and upper, or drop a constraint";
  if (result.problem.feasible) error.hint += ", or remove optimize.feasible";
  reply.diagnostics.push_back(error);
  reply.fields["found"] = false;
  reply.fields["reason"] = result.reason;
}

/// Text such as "24 of 100 generations of 48".
std::string generations_text(const optimize::GeneticOptions& options, std::size_t finished) {
  const std::string all = std::to_string(options.generations);
  return (finished < options.generations ? std::to_string(finished) + " of " + all : all) + " generations of " +
         std::to_string(options.population);
}

/// The number of generations after the random first one, or of the boxes of a certified search.
std::string progress_text(const pipeline::OptimizeOptions& options, const pipeline::OptimizeResult& result) {
  if (const auto* genetic = std::get_if<optimize::GeneticResult>(&result.search)) {
    const std::size_t finished = genetic->generations.size();
    return generations_text(options.genetic, finished > 0 ? finished - 1 : 0);
  }
  if (const auto* pareto = std::get_if<optimize::ParetoResult>(&result.search))
    return generations_text(options.genetic, pareto->generations);
  const auto& certified = std::get<optimize::CertifiedResult>(result.search);
  return std::to_string(certified.boxes) + " boxes";
}

void report_interruption(const pipeline::OptimizeOptions& options, const pipeline::OptimizeResult& result,
                         Reply& reply) {
  reply.exit = Exit::interrupted;
  reply.diagnostics.push_back(make_diagnostic(
      Severity::warning, "interrupted after " + progress_text(options, result) +
                             (result.found ? ": this is the best design so far" : ": no design was found so far")));
  reply.fields["stopped"] = true;
}

std::string box_text(const optimize::Problem& problem, const optimize::TieSet& ties) {
  std::string text;
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    const optimize::Variable& variable = problem.variables[i];
    text += (text.empty() ? "" : ", ") + variable.symbol + " " + rounded(ties.known.lower[i], 5) + " to " +
            rounded(ties.known.upper[i], 5) + unit_text(variable.unit);
  }
  return text;
}

Json ties_json(const optimize::TieSet& ties) {
  Json json;
  json["wide"] = ties.wide;
  json["known"] = {ties.known.lower, ties.known.upper};
  json["hull"] = {ties.hull.lower, ties.hull.upper};
  json["share"] = ties.share;
  json["boxes"] = Json::array();
  for (const optimize::DesignBox& box : ties.boxes) json["boxes"].push_back({box.lower, box.upper});
  return json;
}

void add_ties(const optimize::Problem& problem, const optimize::TieSet& ties, bool has_second_objective, Reply& reply) {
  reply.fields["ties"] = ties_json(ties);
  if (!ties.wide || has_second_objective) return;
  reply.text += titled("ties", "within 0.1 %: " + box_text(problem, ties));
  const optimize::Objective first = problem.objectives.front();
  optimize::Objective other = optimize::Objective::footprint;
  if (first == other || !optimize::has_footprint(problem)) other = optimize::Objective::max_tension;
  if (first == other) other = optimize::Objective::max_error;
  reply.diagnostics.push_back(make_diagnostic(
      Severity::note, "many designs tie within 0.1 %: " + box_text(problem, ties),
      "--then " + std::string(optimize::info(other).name) + " selects the best of them by a second objective"));
}

std::string then_line(optimize::Objective objective, const optimize::CertifiedResult& second) {
  return titled("then", std::string(optimize::info(objective).name) + " " + value_text(objective, second.value) +
                            " among the designs within 0.1 % (gap " + rounded(second.relative_gap, 2) + ")");
}

void add_then(optimize::Objective objective, const optimize::CertifiedResult& second, Reply& reply) {
  reply.fields["then"] = {{"objective", optimize::info(objective).name},
                          {"value", second.value},
                          {"lower_bound", second.lower_bound},
                          {"relative_gap", second.relative_gap}};
}

/// Adds the certified result. `result.then` is empty if the search stopped before the second objective.
void add_certified(const pipeline::OptimizeOptions& options, const pipeline::OptimizeResult& result,
                   const optimize::CertifiedResult& search, Reply& reply) {
  const optimize::Objective objective = result.problem.objectives.front();
  if (result.then) add_then(*options.then, *result.then, reply);
  reply.fields["boxes"] = search.boxes;
  reply.fields["evaluations"] = search.evaluations;
  reply.text = std::string(optimize::info(objective).name) + " of " + result.problem.base.name +
               (search.proven ? ", proven by branch and bound\n" : ", by branch and bound, not finished\n");
  add_value(result, reply);
  reply.fields["found"] = true;
  reply.fields["lower_bound"] = search.lower_bound;
  reply.fields["relative_gap"] = search.relative_gap;
  reply.fields["proven"] = search.proven;
  reply.text += titled(search.proven ? "proven" : "bound", "no design is below " + rounded(search.lower_bound, 8) +
                                                               unit_text(optimize::info(objective).unit));
  reply.text += titled("searched",
                       std::to_string(search.boxes) + " boxes, " + std::to_string(search.evaluations) + " evaluations");
  if (result.problem.feasible)
    reply.text += titled("feasible",
                         "the proof requires convex curves and contact with the pins for every design; the "
                         "best one is feasible");
  if (result.then) reply.text += then_line(*options.then, *result.then);
  add_ties(result.problem, search.ties, options.then.has_value(), reply);
  if (search.proven || options.then || result.stopped) return;
  // A relative gap of 0.1 % is below manufacturing accuracy: an unfinished proof with such a gap is a warning, and no
  // failure.
  constexpr double k_sufficient_gap = 1e-3;
  const bool is_enough = search.relative_gap <= k_sufficient_gap;
  if (!is_enough) reply.exit = Exit::check_failed;
  reply.diagnostics.push_back(
      make_diagnostic(is_enough ? Severity::warning : Severity::error,
                      "the proof is not finished: relative gap " + rounded(search.relative_gap, 2) + ", required 1e-6",
                      "narrow the bounds, or use fewer variables"));
}

void add_genetic(const pipeline::OptimizeOptions& options, const pipeline::OptimizeResult& result,
                 const optimize::GeneticResult& search, Reply& reply) {
  reply.fields["evaluations"] = search.evaluations;
  reply.text = std::string(optimize::info(result.problem.objectives.front()).name) + " of " + result.problem.base.name +
               ", by the genetic algorithm (not proven)\n";
  add_value(result, reply);
  reply.text += titled("searched", progress_text(options, result) + ", seed " + std::to_string(options.genetic.seed) +
                                       ", " + std::to_string(search.evaluations) + " evaluations");
  reply.fields["found"] = true;
  reply.fields["seed"] = options.genetic.seed;
  reply.fields["generations"] = Json::array();
  for (const optimize::Generation& generation : search.generations) {
    reply.fields["generations"].push_back(
        {{"number", generation.number}, {"best", generation.best}, {"mean", generation.mean}});
  }
}

std::string front_table(const optimize::Problem& problem, const std::vector<optimize::FrontPoint>& front) {
  std::vector<Column> columns{{"  point"}};
  for (const optimize::Objective objective : problem.objectives)
    columns.push_back({optimize::info(objective).name, Align::right});
  for (const optimize::Variable& variable : problem.variables) columns.push_back({variable.symbol, Align::right});
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < front.size(); ++i) {
    std::vector<std::string> row{"  " + std::to_string(i + 1)};
    for (const double value : front[i].values) row.push_back(rounded(value, 5));
    for (const double value : front[i].design) row.push_back(rounded(value, 5));
    rows.push_back(std::move(row));
  }
  return table(columns, rows);
}

void add_front(const optimize::GeneticOptions& options, const pipeline::OptimizeResult& result,
               const optimize::ParetoResult& search, Reply& reply) {
  const optimize::Problem& problem = result.problem;
  reply.fields["evaluations"] = search.evaluations;
  reply.text = "front of " + problem.base.name + ", " + std::to_string(search.front.size()) +
               " points by NSGA-II (not proven)\n" + front_table(problem, search.front);
  add_joint(result, reply);
  reply.fields["found"] = true;
  reply.fields["seed"] = options.seed;
  reply.fields["front"] = Json::array();
  for (const optimize::FrontPoint& point : search.front) {
    Json values = Json::object();
    for (std::size_t k = 0; k < point.values.size(); ++k)
      values[std::string(optimize::info(problem.objectives[k]).name)] = point.values[k];
    reply.fields["front"].push_back({{"values", values}, {"design", design_json(problem, point.design)}});
  }
  reply.fields["design"] = design_json(problem, result.design);
}

void add_no_design(const std::string& path, const pipeline::OptimizeResult& result, Reply& reply) {
  const auto* certified = std::get_if<optimize::CertifiedResult>(&result.search);
  if (certified) reply.fields["boxes"] = certified->boxes;
  reply.fields["evaluations"] = std::visit([](const auto& search) { return search.evaluations; }, result.search);
  if (result.stopped) return;
  report_no_design(path, result, certified && certified->proven, reply);
}

}  // namespace

void add_answer(const std::string& path, const pipeline::OptimizeOptions& options,
                const pipeline::OptimizeResult& result, Reply& reply) {
  if (!result.found)
    add_no_design(path, result, reply);
  else if (const auto* certified = std::get_if<optimize::CertifiedResult>(&result.search))
    add_certified(options, result, *certified, reply);
  else if (const auto* genetic = std::get_if<optimize::GeneticResult>(&result.search))
    add_genetic(options, result, *genetic, reply);
  else
    add_front(options.genetic, result, std::get<optimize::ParetoResult>(result.search), reply);
  if (result.stopped) report_interruption(options, result, reply);
}

void add_files(const pipeline::OptimizeOptions& options, const pipeline::OptimizeResult& result, Reply& reply) {
  reply.diagnostics.insert(reply.diagnostics.end(), result.warnings.begin(), result.warnings.end());
  if (!result.published) return;
  if (!result.front_files.empty())
    reply.text += titled("files", std::to_string(result.front_files.size()) + " in " + options.front_folder.string());
  if (options.new_file.empty()) return;
  reply.text += titled("file", options.new_file.string());
  reply.fields["file"] = options.new_file.string();
}

}  // namespace fusee::cli
