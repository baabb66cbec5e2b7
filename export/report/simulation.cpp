// The table of `fusee simulate`: one row for each row of the log.

#include <functional>

#include "base/text.h"
#include "export/report/csv_cells.h"
#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::formats {
namespace {

using RowValue = std::function<double(const measurement::Sample& row, const joint::JointState& state)>;

std::vector<double> values(const Simulation& simulation, const RowValue& row_value) {
  std::vector<double> all;
  const std::vector<measurement::Sample>& rows = simulation.log.runs.front().samples;
  for (std::size_t i = 0; i < rows.size(); ++i) all.push_back(row_value(rows[i], simulation.states[i]));
  return all;
}

}  // namespace

std::string_view word(joint::EquilibriumStatus status) {
  switch (status) {
    case joint::EquilibriumStatus::loose:
      return "loose";
    case joint::EquilibriumStatus::no_equilibrium:
      return "no_equilibrium";
    case joint::EquilibriumStatus::held:
      break;
  }
  return "held";
}

std::vector<SimulationColumn> simulation_columns(const Simulation& simulation) {
  const measurement::Run& run = simulation.log.runs.front();
  const Mechanism& declared = simulation.file.mechanism;
  const std::string& unit = simulation.log.load_unit;
  std::vector<SimulationColumn> columns;
  const auto add = [&](const std::string& name, const RowValue& row_value) {
    columns.push_back({name, values(simulation, row_value)});
  };
  if (run.has_time) add("time_s", [](const measurement::Sample& row, const joint::JointState&) { return row.time; });
  add("alpha_deg", [](const measurement::Sample& row, const joint::JointState&) { return degrees(row.alpha); });
  add("theta_deg", [](const measurement::Sample&, const joint::JointState& state) { return degrees(state.shown); });
  if (run.has_load) {
    add("load" + (unit.empty() ? "" : "_" + unit),
        [](const measurement::Sample& row, const joint::JointState&) { return row.load; });
  } else if (!declared.transmission) {
    add("load_N", [&](const measurement::Sample&, const joint::JointState&) { return declared.load.tip_force; });
  }
  if (!declared.transmission) {
    const auto has_equilibrium = [](const joint::JointState& state) {
      return state.status != joint::EquilibriumStatus::no_equilibrium;
    };
    const auto or_nan = [has_equilibrium](double value, const joint::JointState& state) {
      return has_equilibrium(state) ? value : std::nan("");
    };
    add("tension1_N",
        [or_nan](const measurement::Sample&, const joint::JointState& state) { return or_nan(state.t1.lower, state); });
    add("tension2_N",
        [or_nan](const measurement::Sample&, const joint::JointState& state) { return or_nan(state.t2.lower, state); });
    add("motor_torque_Nmm",
        [](const measurement::Sample&, const joint::JointState& state) { return state.motor_torque; });
    add("tension1_joint_N",
        [or_nan](const measurement::Sample&, const joint::JointState& state) { return or_nan(state.t1.upper, state); });
    add("tension2_joint_N",
        [or_nan](const measurement::Sample&, const joint::JointState& state) { return or_nan(state.t2.upper, state); });
    add("loose_deg", [](const measurement::Sample&, const joint::JointState& state) { return degrees(state.loose); });
  }
  add("joint_deg", [](const measurement::Sample&, const joint::JointState& state) { return degrees(state.theta); });
  // The angles by which sensors were turned have the columns of a log, because `fusee calibrate` reads this table.
  const auto add_mounting = [&](std::string_view role, double turned) {
    if (turned != 0)
      add(std::string(role) + "_deg",
          [turned](const measurement::Sample&, const joint::JointState&) { return degrees(turned); });
  };
  add_mounting(measurement::k_motor_sensor_turned, run.mounting.motor_sensor_turned);
  add_mounting(measurement::k_joint_sensor_turned, run.mounting.joint_sensor_turned);
  if (run.has_temperature)
    add("temperature_C", [](const measurement::Sample& row, const joint::JointState&) { return row.temperature_C; });
  return columns;
}

std::string simulation_csv(const Simulation& simulation) {
  const std::vector<SimulationColumn> columns = simulation_columns(simulation);
  std::string table;
  for (const SimulationColumn& column : columns) table += column.name + ",";
  table += "status\n";
  for (std::size_t i = 0; i < simulation.states.size(); ++i) {
    for (const SimulationColumn& column : columns) table += csv_cell(column.values[i]) + ",";
    table += word(simulation.states[i].status);
    table += "\n";
  }
  return table;
}

}  // namespace fusee::formats
