#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.h"
#include "cli/command.h"
#include "cli/measured_columns.h"
#include "fusee/base.h"
#include "fusee/pipeline.h"

namespace fusee::cli {
namespace {

constexpr double k_most_noise = 45.0;  // deg; no angle sensor has more

pipeline::SimulateOptions simulate_options_from(const Arguments& arguments) {
  pipeline::SimulateOptions options;
  options.columns = columns_from(arguments);
  options.corrected = arguments.has("--corrected");
  options.noise = radians(arguments.number("--noise-deg", 0, 0, k_most_noise, "deg"));
  options.seed = static_cast<std::uint64_t>(arguments.whole_number("--seed", 1, 0, k_largest_seed, "(a whole number)"));
  return options;
}

std::string rows_words(std::size_t count) { return std::to_string(count) + (count == 1 ? " row" : " rows"); }

/// Place of the first row with that status, for lookup in the log.
std::string first_place(const formats::Simulation& simulation, joint::EquilibriumStatus status) {
  const auto row = std::find_if(simulation.states.begin(), simulation.states.end(),
                                [&](const joint::JointState& state) { return state.status == status; });
  const measurement::Sample& sample =
      simulation.log.runs.front().samples[static_cast<std::size_t>(row - simulation.states.begin())];
  const std::string time = simulation.log.runs.front().has_time ? " (" + rounded(sample.time) + " s)" : "";
  return "alpha = " + fixed(degrees(sample.alpha), 2) + " deg" + time;
}

std::size_t count_of(const formats::Simulation& simulation, joint::EquilibriumStatus status) {
  return static_cast<std::size_t>(
      std::count_if(simulation.states.begin(), simulation.states.end(),
                    [&](const joint::JointState& state) { return state.status == status; }));
}

void add_findings(const formats::Simulation& simulation, Reply& reply) {
  add_log_notes(simulation.log.runs, simulation.log.sources, reply);
  add_log_notes(simulation.log.runs, simulation.log.notes, reply);
  if (const std::size_t rows = count_of(simulation, joint::EquilibriumStatus::loose); rows > 0) {
    reply.diagnostics.push_back(
        make_diagnostic(Severity::warning,
                        "the joint is loose in " + rows_words(rows) + ", first at " +
                            first_place(simulation, joint::EquilibriumStatus::loose) + ": both tendons are slack",
                        "their status is loose, and loose_deg is the range of possible angles"));
  }
  if (const std::size_t rows = count_of(simulation, joint::EquilibriumStatus::no_equilibrium); rows > 0) {
    reply.exit = Exit::check_failed;
    reply.diagnostics.push_back(make_diagnostic(Severity::error,
                                                "there is no equilibrium in " + rows_words(rows) + ", first at " +
                                                    first_place(simulation, joint::EquilibriumStatus::no_equilibrium),
                                                "the motor exceeds the pulley's range, or the load is too large"));
  }
}

struct RangeText {
  std::string least = "–", most = "–";
};
RangeText range_of(const formats::Simulation& simulation, std::string_view name) {
  for (const formats::SimulationColumn& column : formats::simulation_columns(simulation)) {
    if (column.name != name) continue;
    std::vector<double> known;
    std::copy_if(column.values.begin(), column.values.end(), std::back_inserter(known),
                 [](double value) { return std::isfinite(value); });
    if (known.empty()) return {};
    const auto [least, most] = std::minmax_element(known.begin(), known.end());
    return {fixed(*least, 2), fixed(*most, 2)};
  }
  return {};
}

std::string summary(const formats::Simulation& simulation, const std::string& file) {
  const RangeText theta = range_of(simulation, "theta_deg");
  const RangeText torque = range_of(simulation, "motor_torque_Nmm");
  const RangeText first = range_of(simulation, "tension1_N");
  const RangeText second = range_of(simulation, "tension2_N");
  std::string text = simulation.file.mechanism.name + "\n  rows      " + std::to_string(simulation.states.size()) +
                     "\n  theta     from " + theta.least + " to " + theta.most + " deg\n";
  if (!simulation.file.mechanism.transmission) {
    text += "  tensions  1 from " + first.least + " to " + first.most + " N, 2 from " + second.least + " to " +
            second.most + " N\n  motor     from " + torque.least + " to " + torque.most + " Nmm\n";
  }
  return text + "  in        " + file + "\n";
}

/// NaN becomes null, as JSON has no NaN.
Json columns_json(const formats::Simulation& simulation) {
  Json columns = Json::object();
  for (const formats::SimulationColumn& column : formats::simulation_columns(simulation)) {
    Json values = Json::array();
    for (const double value : column.values) values.push_back(std::isfinite(value) ? Json(value) : Json());
    columns[column.name] = std::move(values);
  }
  columns["status"] = Json::array();
  for (const joint::JointState& state : simulation.states) columns["status"].push_back(formats::word(state.status));
  return columns;
}

Reply run_simulate(const Arguments& arguments, Console&, const RunContext& context) {
  const pipeline::SimulateOptions options = simulate_options_from(arguments);
  const std::vector<std::string>& names = arguments.positionals();
  const MechanismFile file = read_mechanism(names[0], arguments.settings(), *context.files);
  const pipeline::SimulateResult result = pipeline::simulate(file, names[1], options, context);
  Reply reply;
  reply.diagnostics = result.simulation.file.warnings;
  reply.units = file.mechanism.units;
  if (result.without_law) {
    explain_without_law(file.path, *result.without_law, reply);
    return reply;
  }
  add_findings(result.simulation, reply);
  const std::string table = formats::simulation_csv(result.simulation);
  const std::optional<std::string> target = arguments.text("--out");
  if (target && !arguments.has("--dry-run")) write_file(*target, table, arguments.has("--force"), *context.files);
  reply.text = target ? summary(result.simulation, *target) : table;
  reply.fields["name"] = file.mechanism.name;
  reply.fields["rows"] = result.simulation.states.size();
  reply.fields["loose"] = count_of(result.simulation, joint::EquilibriumStatus::loose);
  reply.fields["no_equilibrium"] = count_of(result.simulation, joint::EquilibriumStatus::no_equilibrium);
  if (target) reply.fields["output"] = *target;
  reply.fields["columns"] = columns_json(result.simulation);
  return reply;
}

}  // namespace

Command simulate_command() {
  return {"simulate",
          "SPEC LOG.csv",
          "the joint's angle, tensions and torque for a log",
          "Simulates the joint of the mechanism file SPEC, including [identified],\n"
          "for the motor angles of LOG.csv (alpha_deg and, if known, time_s, load_N,\n"
          "temperature_C; theta_deg may be missing), row by row and with its history: play,\n"
          "friction, slack, sensors. Prints a table that 'fusee calibrate' reads: theta_deg\n"
          "is the reading of the joint's sensor, joint_deg the true joint angle,\n"
          "tension1_N and tension2_N the tensions between pulley and pin,\n"
          "motor_torque_Nmm the torque on the pulley. status marks rows without\n"
          "equilibrium. The pulley is that of the declared mechanism, on which\n"
          "[identified] was measured, unless --corrected is given.",
          with_reading_options({{"-o,--out", "FILE", "write the table to FILE, and show a summary"},
                                {"--corrected", "", "with the corrected pulley that 'fusee build SPEC'\nmakes"},
                                {"--noise-deg", "DEG", "standard deviation of the joint's sensor (default 0)"},
                                {"--seed", "N", "random seed of that noise (default 1)"}}),
          {{"fusee simulate arm.toml out/arm_plan/run_1.csv > shown.csv", "every row"},
           {"fusee simulate arm.toml shown.csv --set identified.backlash_deg=1", "the influence of play"},
           {"fusee simulate arm.toml shown.csv -o rehearsed.csv --noise-deg 0.02", "as a log of a bench"}},
          run_simulate};
}

}  // namespace fusee::cli
