#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/table.h"
#include "fusee/base/files.h"
#include "fusee/base/text.h"
#include "fusee/optimize/certified.h"
#include "fusee/optimize/genetic.h"

namespace fusee::cli {
namespace {

constexpr std::size_t k_largest_file = 1 << 20;

enum class SearchMethod { genetic, certified, pareto };

/// All that the answer is made of.
struct Job {
  const Arguments& arguments;
  Console& console;
  MechanismFile file;
  Problem problem;
  SearchMethod method = SearchMethod::certified;
  GeneticOptions genetic;
  std::optional<Objective> then;

  Objective objective() const { return problem.objectives.front(); }
};

std::string unit_text(std::string_view unit) { return unit.empty() ? "" : " " + std::string(unit); }
std::string value_text(Objective objective, double value) {
  return rounded(value, 7) + unit_text(info(objective).unit);
}

SearchMethod chosen_method(const Arguments& arguments, const Problem& problem) {
  const auto name = arguments.text("--method");
  if (!name) {
    if (problem.objectives.size() > 1) return SearchMethod::pareto;
    const bool can =
        info(problem.objectives.front()).certifiable && !problem.feasible && problem.base.pulley.law != Law::table;
    return can ? SearchMethod::certified : SearchMethod::genetic;
  }
  if (*name == "ga") return SearchMethod::genetic;
  if (*name == "certified") return SearchMethod::certified;
  if (*name == "pareto") return SearchMethod::pareto;
  throw UsageError("--method must be ga, certified or pareto; '" + *name + "' is not");
}

std::optional<Objective> second_objective(const Arguments& arguments) {
  const auto name = arguments.text("--then");
  if (!name) return std::nullopt;
  std::vector<std::string> names;
  for (const ObjectiveInfo& candidate : objectives()) {
    if (candidate.name == *name) return candidate.objective;
    names.emplace_back(candidate.name);
  }
  const std::string nearest = nearest_word(*name, names);
  throw UsageError("--then names an objective; '" + *name + "' is none",
                   nearest.empty() ? "fusee explain optimize.objective lists them" : "did you mean " + nearest + "?");
}

void demand_agreement(const Job& job) {
  const bool front = job.method == SearchMethod::pareto;
  const std::size_t count = job.problem.objectives.size();
  if (!front && count > 1) {
    throw InputError(job.file.path,
                     "optimize.objective names " + std::to_string(count) + " objectives, and this method takes one",
                     "--method pareto, or --set optimize.objective=" + std::string(info(job.objective()).name));
  }
  if (job.then && job.method != SearchMethod::certified) throw UsageError("--then goes with --method certified only");
  if (job.arguments.has("--front") && !front) throw UsageError("--front goes with --method pareto only");
}

/// A bar of 20 places on the progress line, and a flag for Ctrl-C.
KeepGoing progress_bar(Job& job) {
  return [&job, shown = -1](const SearchProgress& progress) mutable {
    const int percent = static_cast<int>(100 * std::clamp(progress.done, 0.0, 1.0));
    if (percent != shown) {
      shown = percent;
      const auto full = static_cast<std::size_t>(percent / 5);
      std::string bar =
          "[" + std::string(full, '#') + std::string(20 - full, '.') + "] " + std::to_string(percent) + " %";
      if (job.method != SearchMethod::pareto && std::abs(progress.best) < 1e299)
        bar += ", best " + rounded(progress.best, 6);
      job.console.progress(bar);
    }
    return !is_interrupted();
  };
}

// ---- what is said
// -----------------------------------------------------------------------------------------------------

std::string line(std::string title, const std::string& text) {
  title.resize(std::max<std::size_t>(12, title.size() + 1), ' ');
  return "  " + title + text + "\n";
}

Json design_json(const Problem& problem, const Design& design) {
  Json json = Json::object();
  for (const ValueEdit& edit : edits_of(problem, design)) json[edit.key] = edit.value;
  return json;
}

bool is_near(double a, double b, double range) { return std::abs(a - b) <= 1e-6 * range; }

std::string design_text(const Problem& problem, const Design& design) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < problem.moving.size(); ++i) {
    const MovingKey& moving = problem.moving[i];
    const Field& field = *moving.number.field;
    const double value = moving.value(design);
    std::string where = i < design.size() ? "" : "tied";
    if (i < design.size()) {
      const Variable& variable = problem.variables[i];
      const double range = variable.upper - variable.lower;
      if (is_near(value, variable.lower, range))
        where = "at its lower bound";
      else if (is_near(value, variable.upper, range))
        where = "at its upper bound";
    }
    rows.push_back({"  " + moving.key, rounded(value, 7), std::string(field.unit),
                    "was " + rounded(moving.number.get(problem.base), 7), where});
  }
  return table({{"  key"}, {"value", Align::right}, {"unit"}, {"in the file"}, {""}}, rows);
}

std::string box_text(const Problem& problem, const TieSet& ties) {
  std::string text;
  for (std::size_t i = 0; i < problem.variables.size(); ++i) {
    const Variable& variable = problem.variables[i];
    text += (text.empty() ? "" : ", ") + variable.symbol + " " + rounded(ties.known.lower[i], 5) + " to " +
            rounded(ties.known.upper[i], 5) + unit_text(variable.unit);
  }
  return text;
}

Json ties_json(const TieSet& ties) {
  Json json;
  json["wide"] = ties.wide;
  json["known"] = {ties.known.lower, ties.known.upper};
  json["hull"] = {ties.hull.lower, ties.hull.upper};
  json["share"] = ties.share;
  json["boxes"] = Json::array();
  for (const DesignBox& box : ties.boxes) json["boxes"].push_back({box.lower, box.upper});
  return json;
}

void add_value(const Job& job, Reply& reply, const Design& design, double value, double theta) {
  const Objective objective = job.objective();
  const Evaluation now = evaluate(objective, job.problem.base, job.problem.point_pins);
  reply.fields["objective"] = info(objective).name;
  reply.fields["unit"] = info(objective).unit;
  reply.fields["value"] = value;
  reply.fields["theta_deg"] = degrees(theta);
  if (now.possible) reply.fields["value_before"] = now.value;
  reply.fields["design"] = design_json(job.problem, design);
  const std::string before = now.possible ? "; the file as it is: " + value_text(objective, now.value) : "";
  reply.text += line(std::string(info(objective).name),
                     value_text(objective, value) + " at theta = " + rounded(degrees(theta), 4) + " deg" + before);
  reply.text +=
      line("pins", job.problem.point_pins ? "points (the paper's equations)" : "with their radius and the tendon's");
  reply.text += design_text(job.problem, design);
}

void say_none(const Job& job, Reply& reply, const std::string& reason, bool proven) {
  reply.exit = Exit::infeasible;
  std::string hint = "widen lower and upper, or drop a constraint";
  if (job.problem.feasible) hint += ", or leave out feasible";
  Diagnostic error = about_file(
      Severity::error, job.file.path,
      std::string(proven ? "no design of the box is possible (proven)" : "no possible design was found in the box") +
          "; most often: " + reason);
  error.hint = hint;
  reply.diagnostics.push_back(error);
  reply.fields["found"] = false;
  reply.fields["reason"] = reason;
}

// ---- files
// ------------------------------------------------------------------------------------------------------------

/// Whether an edited file is one, and has the numbers that were meant.
bool holds(const std::string& text, const std::vector<ValueEdit>& edits, const std::string& path) {
  try {
    const Mechanism read = parse_mechanism(text, path, std::filesystem::path(path).parent_path());
    return std::all_of(edits.begin(), edits.end(), [&read](const ValueEdit& edit) {
      return std::abs(find_number_key(edit.key)->get(read) - edit.value) <= 1e-12 * std::abs(edit.value);
    });
  } catch (const InputError&) {
    return false;
  }
}

/// The person's file with the design's numbers. What --set gave and is a number goes in too.
std::string new_text(const Job& job, const Design& design, std::vector<Diagnostic>& diagnostics) {
  std::vector<ValueEdit> edits;
  for (const Setting& setting : job.arguments.settings()) {
    const auto key = find_number_key(setting.key);
    if (key)
      edits.push_back({setting.key, key->get(job.problem.base)});
    else
      diagnostics.push_back(
          note(Severity::warning, "the new file does not hold --set " + setting.key + "=" + setting.value));
  }
  for (const ValueEdit& edit : edits_of(job.problem, design)) {
    std::erase_if(edits, [&edit](const ValueEdit& earlier) { return earlier.key == edit.key; });
    edits.push_back(edit);
  }
  const std::string text = edit_values(read_file(job.file.path, k_largest_file), edits);
  if (holds(text, edits, job.file.path)) return text;
  // Tables written as dotted keys have no place for a new key.
  diagnostics.push_back(
      note(Severity::warning, "the layout of " + job.file.path + " could not be kept: the new file has every key"));
  Mechanism whole = mechanism_at(job.problem, design);
  whole.optimize = job.file.mechanism.optimize;
  return write_mechanism(whole);
}

void write_new_file(const Job& job, const Design& design, const std::string& path, Reply& reply) {
  const std::string text = new_text(job, design, reply.diagnostics);
  if (job.arguments.has("--dry-run")) return;
  write_file(path, text, job.arguments.has("--force"));
  reply.text += line("file", path);
  reply.fields["file"] = path;
}

// ---- the three methods
// ------------------------------------------------------------------------------------------------

void answer_stopped(Reply& reply) {
  reply.exit = Exit::interrupted;
  reply.diagnostics.push_back(note(Severity::warning, "interrupted: this is the best so far"));
  reply.fields["stopped"] = true;
}

CertifiedResult certified(Job& job, Reply& reply) {
  CertifiedOptions options;
  options.keep_going = progress_bar(job);
  CertifiedResult result = certified_optimum(job.problem, job.objective(), options);
  if (!result.found || !job.then || is_interrupted()) return result;
  // Among those that tie, the best by another measure.
  const double limit = result.value + options.tie * std::abs(result.value);
  Problem among = job.problem;
  among.cap = ObjectiveCap{job.objective(), limit};
  options.first_tries = {result.best};
  // Among ties of 0.1 % nobody asks for a millionth, and the edge of a thin set of designs is costly to follow.
  options.gap = options.tie;
  options.most_boxes = 300000;
  const CertifiedResult second = certified_optimum(among, *job.then, options);
  reply.fields["then"] = {{"objective", info(*job.then).name},
                          {"value", second.value},
                          {"lower_bound", second.lower_bound},
                          {"relative_gap", second.relative_gap}};
  reply.text += line("then", std::string(info(*job.then).name) + " " + value_text(*job.then, second.value) +
                                 " among the designs within 0.1 % (gap " + rounded(second.relative_gap, 2) + ")");
  result.best = second.best;
  const Evaluation first = evaluate_design(job.problem, job.objective(), result.best);
  result.value = first.value;
  result.theta = first.theta;
  return result;
}

void answer_ties(const Job& job, const CertifiedResult& result, Reply& reply) {
  reply.fields["ties"] = ties_json(result.ties);
  if (!result.ties.wide || job.then) return;
  reply.text += line("ties", "within 0.1 %: " + box_text(job.problem, result.ties));
  const char* other = job.objective() == Objective::footprint ? "max_tension" : "footprint";
  reply.diagnostics.push_back(
      note(Severity::note, "many designs tie within 0.1 %: " + box_text(job.problem, result.ties),
           std::string("--then ") + other + " takes the one of them that is best by a second measure"));
}

void answer_certified(Job& job, Reply& reply) {
  std::string head =
      std::string(info(job.objective()).name) + " of " + job.problem.base.name + ", proven by branch and bound\n";
  const CertifiedResult result = certified(job, reply);
  reply.fields["boxes"] = result.boxes;
  reply.fields["evaluations"] = result.evaluations;
  if (!result.found) {
    reply.text.clear();
    if (is_interrupted()) return answer_stopped(reply);
    return say_none(job, reply, result.reason, result.proven);
  }
  const std::string second = std::exchange(reply.text, head);
  add_value(job, reply, result.best, result.value, result.theta);
  reply.fields["found"] = true;
  reply.fields["lower_bound"] = result.lower_bound;
  reply.fields["relative_gap"] = result.relative_gap;
  reply.fields["proven"] = result.proven;
  reply.text +=
      line("proven", "no design is below " + rounded(result.lower_bound, 8) + unit_text(info(job.objective()).unit));
  reply.text += line("searched",
                     std::to_string(result.boxes) + " boxes, " + std::to_string(result.evaluations) + " evaluations") +
                second;
  answer_ties(job, result, reply);
  if (is_interrupted()) return answer_stopped(reply);
  if (!result.proven && !job.then) {
    reply.exit = Exit::check_failed;
    reply.diagnostics.push_back(note(
        Severity::error, "the proof is not finished: relative gap " + rounded(result.relative_gap, 2) + ", wanted 1e-6",
        "narrow the bounds, or take fewer variables"));
  }
}

void answer_genetic(Job& job, Reply& reply) {
  job.genetic.keep_going = progress_bar(job);
  const GeneticResult result = genetic_optimum(job.problem, job.objective(), job.genetic);
  reply.fields["evaluations"] = result.evaluations;
  if (!result.found) return say_none(job, reply, result.reason, false);
  reply.text = std::string(info(job.objective()).name) + " of " + job.problem.base.name +
               ", by the genetic algorithm (not proven)\n";
  add_value(job, reply, result.best, result.value, result.theta);
  reply.text +=
      line("searched", std::to_string(job.genetic.generations) + " generations of " +
                           std::to_string(job.genetic.population) + ", seed " + std::to_string(job.genetic.seed) +
                           ", " + std::to_string(result.evaluations) + " evaluations");
  reply.fields["found"] = true;
  reply.fields["seed"] = job.genetic.seed;
  reply.fields["generations"] = Json::array();
  for (const Generation& generation : result.generations) {
    reply.fields["generations"].push_back(
        {{"number", generation.number}, {"best", generation.best}, {"mean", generation.mean}});
  }
  if (result.stopped) answer_stopped(reply);
}

std::string front_table(const Job& job, const ParetoResult& result) {
  std::vector<Column> columns{{"  point"}};
  for (const Objective objective : job.problem.objectives) columns.push_back({info(objective).name, Align::right});
  for (const Variable& variable : job.problem.variables) columns.push_back({variable.symbol, Align::right});
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    std::vector<std::string> row{"  " + std::to_string(i + 1)};
    for (const double value : result.front[i].values) row.push_back(rounded(value, 5));
    for (const double value : result.front[i].design) row.push_back(rounded(value, 5));
    rows.push_back(std::move(row));
  }
  return table(columns, rows);
}

/// The point of the front that is nearest to the best of everything, each objective measured by its span on the front.
std::size_t balanced_point(const ParetoResult& result, const std::vector<Objective>& objectives) {
  std::vector<double> distances(result.front.size(), 0.0);
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    const double sign = info(objectives[k]).largest ? -1.0 : 1.0;
    double low = 1e300, high = -1e300;
    for (const FrontPoint& point : result.front)
      low = std::min(low, sign * point.values[k]), high = std::max(high, sign * point.values[k]);
    if (!(high > low)) continue;
    for (std::size_t i = 0; i < distances.size(); ++i)
      distances[i] += std::pow((sign * result.front[i].values[k] - low) / (high - low), 2);
  }
  return static_cast<std::size_t>(std::min_element(distances.begin(), distances.end()) - distances.begin());
}

void write_front(const Job& job, const ParetoResult& result, const std::string& folder, Reply& reply) {
  if (job.arguments.has("--dry-run")) return;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  std::vector<Diagnostic> said_once;
  for (std::size_t i = 0; i < result.front.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    const auto path = std::filesystem::path(folder) /
                      ("point_" + std::string(3 - std::min<std::size_t>(3, number.size()), '0') + number + ".toml");
    said_once.clear();
    write_file(path, new_text(job, result.front[i].design, said_once), job.arguments.has("--force"));
  }
  reply.diagnostics.insert(reply.diagnostics.end(), said_once.begin(), said_once.end());
  reply.text += line("files", std::to_string(result.front.size()) + " in " + folder);
}

void answer_pareto(Job& job, Reply& reply) {
  job.genetic.keep_going = progress_bar(job);
  const ParetoResult result = pareto_front(job.problem, job.genetic);
  reply.fields["evaluations"] = result.evaluations;
  if (result.front.empty()) return say_none(job, reply, result.reason, false);
  reply.text = "front of " + job.problem.base.name + ", " + std::to_string(result.front.size()) +
               " points by NSGA-II (not proven)\n" + front_table(job, result);
  reply.fields["found"] = true;
  reply.fields["seed"] = job.genetic.seed;
  reply.fields["front"] = Json::array();
  for (const FrontPoint& point : result.front) {
    Json values = Json::object();
    for (std::size_t k = 0; k < point.values.size(); ++k)
      values[std::string(info(job.problem.objectives[k]).name)] = point.values[k];
    reply.fields["front"].push_back({{"values", values}, {"design", design_json(job.problem, point.design)}});
  }
  const FrontPoint& balanced = result.front[balanced_point(result, job.problem.objectives)];
  reply.fields["design"] = design_json(job.problem, balanced.design);
  if (const auto folder = job.arguments.text("--front")) write_front(job, result, *folder, reply);
  if (result.stopped) answer_stopped(reply);
}

Reply run_optimize(const Arguments& arguments, Console& console) {
  const std::string path = arguments.positionals().front();
  MechanismFile file = read_mechanism(path, arguments.settings());
  Problem problem = make_problem(file);
  Job job{arguments,
          console,
          std::move(file),
          std::move(problem),
          SearchMethod::certified,
          GeneticOptions(),
          second_objective(arguments)};
  job.method = chosen_method(arguments, job.problem);
  job.genetic.seed = static_cast<unsigned>(arguments.number("--seed", 1, 0, 4e9, ""));
  job.genetic.population =
      4 * static_cast<unsigned>(std::ceil(arguments.number("--population", 48, 8, 10000, "designs") / 4));
  job.genetic.generations = static_cast<unsigned>(arguments.number("--generations", 100, 1, 100000, "generations"));
  demand_agreement(job);
  const InterruptsDeferred deferred;
  Reply reply;
  reply.diagnostics = job.file.warnings;
  constexpr const char* k_names[] = {"ga", "certified", "pareto"};
  reply.fields["method"] = k_names[static_cast<int>(job.method)];
  if (job.method == SearchMethod::certified) answer_certified(job, reply);
  if (job.method == SearchMethod::genetic) answer_genetic(job, reply);
  if (job.method == SearchMethod::pareto) answer_pareto(job, reply);
  const auto out = arguments.text("--out");
  if (out && reply.fields.contains("design")) {
    Design design;
    for (const Variable& variable : job.problem.variables) design.push_back(reply.fields["design"][variable.key]);
    write_new_file(job, design, *out, reply);
  }
  return reply;
}

}  // namespace

Command optimize_command() {
  return {"optimize",
          "SPEC",
          "better numbers for the mechanism",
          "Changes the variables that [optimize] in SPEC names, within their bounds and\n"
          "constraints, until the objective is as good as it can be. Where the equations\n"
          "allow it the optimum is proven; the answer says how far from it any design can\n"
          "be, and which other designs are as good. NEW.toml is your file with new numbers.",
          {{"-o,--out", "NEW.toml", "write the mechanism with its new numbers"},
           {"--method", "NAME", "certified, ga or pareto (default: what can prove most)"},
           {"--then", "OBJECTIVE", "choose by this among designs that tie (certified)"},
           {"--seed", "N", "of ga and pareto (default 1)"},
           {"--population", "N", "designs in a generation (default 48)"},
           {"--generations", "N", "of ga and pareto (default 100)"},
           {"--front", "DIR", "each point of the front as a mechanism file (pareto)"}},
          {{"fusee new paper_optimum > paper.toml", "a mechanism with [optimize] in it"},
           {"fusee optimize paper.toml -o better.toml", "the best numbers, proven"},
           {"fusee optimize paper.toml --method ga --seed 7", "the paper's way"}},
          run_optimize};
}

}  // namespace fusee::cli
