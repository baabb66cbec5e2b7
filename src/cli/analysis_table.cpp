#include "cli/analysis_table.h"

#include <cmath>
#include <limits>
#include <optional>

#include "base/text.h"
#include "cli/table.h"

namespace fusee::cli {
namespace {

constexpr std::size_t k_short_table = 13;  // rows of a table for terminals

// ---- columns of the files -------------------------------------------------------------------------------------------

/// A column of numbers: declared geometry, or the paper's equations.
struct RowColumn {
  std::string_view name;
  double (*value)(const analysis::AnalysisRow&);
};

/// A column of numbers of the full model, in either direction.
struct StateColumn {
  std::string_view name;
  double (*value)(const joint::EquilibriumPoint&, const analysis::AnalysisRow&);
};

const std::vector<RowColumn>& row_columns() {
  using Row = analysis::AnalysisRow;
  static const std::vector<RowColumn> all = {
      {"alpha_deg", [](const Row& row) { return degrees(row.declared.alpha); }},
      {"theta_deg", [](const Row& row) { return degrees(row.declared.theta); }},
      {"r1_mm", [](const Row& row) { return row.declared.t1.p; }},
      {"r2_mm", [](const Row& row) { return row.declared.t2.p; }},
      {"gamma1_deg", [](const Row& row) { return degrees(row.paper.gamma1); }},
      {"gamma2_deg", [](const Row& row) { return degrees(row.paper.gamma2); }},
      {"phi1_deg", [](const Row& row) { return degrees(row.declared.t1.wrap); }},
      {"phi2_deg", [](const Row& row) { return degrees(row.paper.phi); }},
      {"paper_T1_N", [](const Row& row) { return row.paper.T1; }},
      {"paper_T2_N", [](const Row& row) { return row.paper.T2; }},
      {"paper_Tb_N", [](const Row& row) { return row.paper.Tb; }},
      {"paper_motor_torque_Nmm", [](const Row& row) { return row.paper.motor_torque; }},
      {"paper_elongation_mm", [](const Row& row) { return row.paper.elongation; }},
      {"paper_theta_error_deg", [](const Row& row) { return degrees(row.paper.theta_error); }},
      {"paper_stiffness_Nmm_per_deg", [](const Row& row) { return radians(row.paper.stiffness); }},
  };
  return all;
}

const std::vector<StateColumn>& state_columns() {
  using Point = joint::EquilibriumPoint;
  using Row = analysis::AnalysisRow;
  static const std::vector<StateColumn> all = {
      {"theta_deg", [](const Point& point, const Row&) { return degrees(point.theta); }},
      {"T1_N", [](const Point& point, const Row&) { return point.t1.upper; }},
      {"T1_below_N", [](const Point& point, const Row&) { return point.t1.lower; }},
      {"T2_N", [](const Point& point, const Row&) { return point.t2.upper; }},
      {"T2_below_N", [](const Point& point, const Row&) { return point.t2.lower; }},
      {"slack1_mm", [](const Point& point, const Row&) { return point.t1.slack; }},
      {"slack2_mm", [](const Point& point, const Row&) { return point.t2.slack; }},
      {"phi1_deg", [](const Point& point, const Row&) { return degrees(point.t1.wrap); }},
      {"phi2_deg", [](const Point& point, const Row&) { return degrees(point.t2.wrap); }},
      {"motor_torque_Nmm", [](const Point& point, const Row&) { return point.motor_torque; }},
      {"elongation1_mm", [](const Point& point, const Row&) { return point.t1.stretch; }},
      {"elongation2_mm", [](const Point& point, const Row&) { return point.t2.stretch; }},
      {"theta_error_deg", [](const Point& point, const Row& row) { return degrees(row.declared.theta - point.theta); }},
      {"stiffness_Nmm_per_deg", [](const Point& point, const Row&) { return radians(point.stiffness); }},
      {"stiffness_stuck_Nmm_per_deg", [](const Point& point, const Row&) { return radians(point.stiffness_stuck); }},
  };
  return all;
}

bool has_equilibrium(const joint::EquilibriumPoint& point) {
  return point.status != joint::EquilibriumStatus::no_equilibrium;
}

std::string_view name(joint::EquilibriumStatus status) {
  switch (status) {
    case joint::EquilibriumStatus::held:
      return "held";
    case joint::EquilibriumStatus::loose:
      return "loose";
    case joint::EquilibriumStatus::no_equilibrium:
      break;
  }
  return "no_equilibrium";
}

std::string_view name(joint::PinContact contact) {
  switch (contact) {
    case joint::PinContact::stick:
      return "stick";
    case joint::PinContact::slip_up:
      return "slip_up";
    case joint::PinContact::slip_down:
      return "slip_down";
    case joint::PinContact::slack:
      break;
  }
  return "slack";
}

struct Direction {
  std::string prefix;
  joint::EquilibriumPoint analysis::AnalysisRow::*point;
};

const std::vector<Direction>& directions() {
  static const std::vector<Direction> both = {{"rising_", &analysis::AnalysisRow::rising},
                                              {"falling_", &analysis::AnalysisRow::falling}};
  return both;
}

/// Calls number(name, value or nullopt) and word(name, word) for every column in order.
template <typename OnNumber, typename OnWord>
void for_each_column(const analysis::AnalysisRow& row, OnNumber number, OnWord word) {
  for (const RowColumn& column : row_columns()) number(std::string(column.name), std::optional(column.value(row)));
  for (const Direction& direction : directions()) {
    const joint::EquilibriumPoint& point = row.*direction.point;
    word(direction.prefix + "status", name(point.status));
    for (const StateColumn& column : state_columns()) {
      number(direction.prefix + std::string(column.name),
             has_equilibrium(point) ? std::optional(column.value(point, row)) : std::nullopt);
    }
    word(direction.prefix + "pin1", has_equilibrium(point) ? name(point.t1.contact) : "");
    word(direction.prefix + "pin2", has_equilibrium(point) ? name(point.t2.contact) : "");
  }
}

// ---- tables for terminals -------------------------------------------------------------------------------------------

std::string cell(double value) {
  // Smaller values are rounding errors in all of these quantities.
  return std::abs(value) < 1e-9 ? "0" : rounded(value, 4);
}

std::string full_cell(const joint::EquilibriumPoint& point, double value) {
  return has_equilibrium(point) ? cell(value) : "-";
}

std::vector<analysis::AnalysisRow> thinned(const std::vector<analysis::AnalysisRow>& rows, bool all) {
  if (all || rows.size() <= k_short_table) return rows;
  std::vector<analysis::AnalysisRow> few;
  for (std::size_t i = 0; i < k_short_table; ++i) few.push_back(rows[i * (rows.size() - 1) / (k_short_table - 1)]);
  return few;
}

using Cells = std::vector<std::string>;

std::string stroke_table(const std::vector<std::string_view>& titles, const std::vector<analysis::AnalysisRow>& rows,
                         Cells (*cells)(const analysis::AnalysisRow&)) {
  std::vector<Column> columns;
  for (const std::string_view title : titles) columns.push_back({title, Align::right});
  std::vector<Cells> lines;
  for (const analysis::AnalysisRow& row : rows) lines.push_back(cells(row));
  return table(columns, lines);
}

Cells geometry_cells(const analysis::AnalysisRow& row) {
  return {fixed(degrees(row.declared.alpha), 1),
          fixed(degrees(row.declared.theta), 2),
          fixed(row.declared.t1.p, 3),
          fixed(row.declared.t2.p, 3),
          fixed(degrees(row.paper.gamma1), 2),
          fixed(degrees(row.paper.gamma2), 2),
          fixed(degrees(row.declared.t1.wrap), 2),
          fixed(degrees(row.paper.phi), 2)};
}

/// True if the load is on tendon 1. By the paper's equations only one tendon has a tension.
bool is_first_loaded(const analysis::AnalysisRow& row) { return row.paper.T1 > 0; }

Cells force_cells(const analysis::AnalysisRow& row) {
  const joint::EquilibriumPoint& full = row.rising;
  const bool first_is_loaded = is_first_loaded(row);
  return {fixed(degrees(row.declared.alpha), 1),
          cell(row.paper.T1),
          full_cell(full, full.t1.upper),
          cell(row.paper.T2),
          full_cell(full, full.t2.upper),
          cell(row.paper.Tb),
          full_cell(full, first_is_loaded ? full.t1.lower : full.t2.lower),
          cell(row.paper.motor_torque),
          full_cell(full, full.motor_torque)};
}

Cells elastic_cells(const analysis::AnalysisRow& row) {
  const joint::EquilibriumPoint& full = row.rising;
  const bool first_is_loaded = is_first_loaded(row);
  const bool has_hysteresis = has_equilibrium(full) && has_equilibrium(row.falling);
  return {fixed(degrees(row.declared.alpha), 1),
          cell(row.paper.elongation),
          full_cell(full, first_is_loaded ? full.t1.stretch : full.t2.stretch),
          cell(degrees(row.paper.theta_error)),
          full_cell(full, degrees(row.declared.theta - full.theta)),
          has_hysteresis ? cell(degrees(full.theta - row.falling.theta)) : "-",
          cell(radians(row.paper.stiffness)),
          full_cell(full, radians(full.stiffness))};
}

}  // namespace

std::string stroke_tables(const std::vector<analysis::AnalysisRow>& rows, bool all) {
  const std::vector<analysis::AnalysisRow> shown = thinned(rows, all);
  std::string text = "Geometry (deg, mm)\n";
  text += stroke_table({"alpha", "theta", "r1", "r2", "gamma1", "gamma2", "phi1", "phi2"}, shown, geometry_cells);
  text += "\nForces (N, Nmm): the paper's [6]-[8] beside the full model, alpha growing\n";
  text += stroke_table({"alpha", "T1", "full", "T2", "full", "T_b", "full", "torque", "full"}, shown, force_cells);
  text += "\nCompliance (mm, deg, Nmm/deg): the paper's [9]-[11] beside the full model\n";
  text += stroke_table({"alpha", "Delta", "full", "dtheta", "full", "loop", "stiffness", "full"}, shown, elastic_cells);
  return text;
}

std::string stroke_csv(const std::vector<analysis::AnalysisRow>& rows) {
  std::string text;
  for (const analysis::AnalysisRow& row : rows) {
    std::string names;
    std::string values;
    const auto add = [&](const std::string& name, const std::string& value) {
      names += (names.empty() ? "" : ",") + name;
      values += (values.empty() ? "" : ",") + value;
    };
    for_each_column(
        row, [&](const std::string& name, std::optional<double> value) { add(name, value ? shortest(*value) : ""); },
        [&](const std::string& name, std::string_view word) { add(name, std::string(word)); });
    if (text.empty()) text = names + "\n";
    text += values + "\n";
  }
  return text;
}

Json stroke_json(const std::vector<analysis::AnalysisRow>& rows) {
  Json list = Json::array();
  for (const analysis::AnalysisRow& row : rows) {
    Json object;
    for_each_column(
        row,
        [&](const std::string& name, std::optional<double> value) { object[name] = value ? Json(*value) : Json(); },
        [&](const std::string& name, std::string_view word) { object[name] = word; });
    list.push_back(std::move(object));
  }
  return list;
}

}  // namespace fusee::cli
