#include <cmath>

#include "base/text.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/optimize_text.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

/// Names in the order of SearchMethod, which is also that of the alternatives of OptimizeResult::search.
constexpr std::string_view k_methods[] = {"certified", "ga", "pareto"};

std::optional<pipeline::SearchMethod> method_from(const Arguments& arguments) {
  const auto name = arguments.text("--method");
  if (!name) return std::nullopt;
  for (std::size_t i = 0; i < std::size(k_methods); ++i) {
    if (*name == k_methods[i]) return static_cast<pipeline::SearchMethod>(i);
  }
  throw UsageError("--method must be ga, certified or pareto; '" + *name + "' is not");
}

std::optional<optimize::Objective> second_objective_from(const Arguments& arguments) {
  const auto name = arguments.text("--then");
  if (!name) return std::nullopt;
  std::vector<std::string> names;
  for (const optimize::ObjectiveInfo& candidate : optimize::objectives()) {
    if (candidate.name == *name) return candidate.objective;
    names.emplace_back(candidate.name);
  }
  const std::string nearest = nearest_word(*name, names);
  throw UsageError("--then takes an objective; '" + *name + "' is not one",
                   nearest.empty() ? "fusee explain optimize.objective lists them" : "did you mean " + nearest + "?");
}

/// Progress that is shown again only when its percentage has changed.
RunContext::Progress search_bar(Console& console) {
  return [&console, shown = -1](std::string_view best, std::optional<double> share) mutable {
    const int percent = static_cast<int>(100 * share.value_or(0));
    if (percent != shown) console.progress(best, share.value_or(0));
    shown = percent;
  };
}

pipeline::OptimizeOptions optimize_options_from(const Arguments& arguments) {
  pipeline::OptimizeOptions options;
  options.method = method_from(arguments);
  options.then = second_objective_from(arguments);
  options.genetic.seed =
      static_cast<unsigned>(arguments.whole_number("--seed", 1, 0, k_largest_seed, "(a whole number)"));
  // GeneticOptions requires a multiple of 4.
  options.genetic.population =
      4 * static_cast<unsigned>(std::ceil(arguments.whole_number("--population", 48, 8, 10000, "designs") / 4));
  options.genetic.generations =
      static_cast<unsigned>(arguments.whole_number("--generations", 100, 1, 100000, "generations"));
  options.settings = arguments.settings();
  options.new_file = arguments.text("--out").value_or("");
  options.front_folder = arguments.text("--front").value_or("");
  options.force = arguments.has("--force");
  options.dry_run = arguments.has("--dry-run");
  return options;
}

/// Throws UsageError if an option belongs to another method. Called before the search, which takes long.
void refuse_options_of_other_methods(const MechanismFile& file, const pipeline::OptimizeOptions& options) {
  if (!options.then && options.front_folder.empty()) return;
  const pipeline::SearchMethod method = options.method ? *options.method : pipeline::strongest_method(file);
  if (options.then && method != pipeline::SearchMethod::certified)
    throw UsageError("--then requires --method certified");
  if (!options.front_folder.empty() && method != pipeline::SearchMethod::pareto)
    throw UsageError("--front requires --method pareto");
}

Reply run_optimize(const Arguments& arguments, Console& console, const RunContext& context) {
  const MechanismFile file = read_mechanism(arguments.positionals().front(), arguments.settings(), *context.files);
  const pipeline::OptimizeOptions options = optimize_options_from(arguments);
  refuse_options_of_other_methods(file, options);
  prevent_exit_by_signal();
  const pipeline::OptimizeResult result =
      pipeline::optimize(file, options, {search_bar(console), context.stop, context.files});
  Reply reply;
  reply.diagnostics = file.warnings;
  reply.units = file.mechanism.units;
  reply.fields["method"] = k_methods[result.search.index()];
  add_answer(file.path, options, result, reply);
  add_files(options, result, reply);
  return reply;
}

}  // namespace

Command optimize_command() {
  return {"optimize",
          "SPEC",
          "the best numbers for the mechanism",
          "Varies the variables of [optimize] in SPEC within their bounds and\n"
          "constraints to find the best value of the objective. If the equations\n"
          "allow it, the optimum is proven. The result includes the proven bound\n"
          "and other designs that are as good. NEW.toml is your file with new numbers.",
          {{"-o,--out", "NEW.toml", "write the mechanism with its new numbers"},
           {"--method", "NAME", "certified, ga or pareto (default: certified where\npossible)", false,
            "certified ga pareto"},
           {"--then", "OBJECTIVE", "second objective, among designs that tie (certified)"},
           {"--seed", "N", "random seed of ga and pareto (default 1)"},
           {"--population", "N", "designs in a generation (default 48)"},
           {"--generations", "N", "generations of ga and pareto (default 100)"},
           {"--front", "DIR", "write each point of the front as a mechanism file\n(pareto)"}},
          {{"fusee new paper_optimum > paper.toml", "a mechanism with [optimize] in it"},
           {"fusee optimize paper.toml -o better.toml", "the best numbers, proven"},
           {"fusee optimize paper.toml --method ga --seed 7", "the paper's genetic algorithm"}},
          run_optimize};
}

}  // namespace fusee::cli
