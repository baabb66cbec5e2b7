#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "fusee/model.h"
#include "transmission/load.h"

namespace fusee::model {
namespace {

const AngleMap& way_of(const JointCurve& curve, std::size_t way) {
  return curve.ways ? (*curve.ways)[way] : curve.middle;
}

/// The place of entry i of a table from `first` to `last`.
double entry_place(double first, double last, int i, int pieces) { return first + (last - first) * i / pieces; }

OneWayTable one_way(const AngleMap& map, const MotorUnit& unit, const JointTable& table) {
  OneWayTable result;
  const double at_min = unit.of(map.alpha_min) - unit.zero, at_max = unit.of(map.alpha_max) - unit.zero;
  result.first = static_cast<float>(std::min(at_min, at_max));
  result.last = static_cast<float>(std::max(at_min, at_max));
  for (int i = 0; i <= table.pieces; ++i) {
    const double motor = entry_place(double(result.first), double(result.last), i, table.pieces);
    result.theta_deg.push_back(static_cast<float>(degrees(map.theta(unit.alpha(motor + unit.zero)))));
    const double theta =
        radians(entry_place(double(table.theta_first_deg), double(table.theta_last_deg), i, table.pieces));
    result.motor.push_back(static_cast<float>(unit.of(map.alpha(theta)) - unit.zero));
  }
  return result;
}

JointTable table_of(const JointCurve& curve, const Mechanism& mechanism, const MotorUnit& unit, int pieces) {
  JointTable table;
  table.unit = unit;
  table.pieces = pieces;
  table.theta_first_deg = static_cast<float>(degrees(curve.middle.theta_min));
  table.theta_last_deg = static_cast<float>(degrees(curve.middle.theta_max));
  for (std::size_t way = 0; way < (curve.ways ? 2u : 1u); ++way)
    table.ways.push_back(one_way(way_of(curve, way), unit, table));
  const OneWayTable& first = table.ways.front();
  bool loaded = false;
  for (int i = 0; i <= pieces; ++i) {
    const double alpha = unit.alpha(entry_place(double(first.first), double(first.last), i, pieces) + unit.zero);
    const double slope = curve.middle.slope(alpha),
                 load = transmission::load_torque(mechanism, curve.middle.theta(alpha));
    table.slope.push_back(static_cast<float>(slope));
    table.holding.push_back(static_cast<float>(slope * load));
    loaded = loaded || load != 0;
  }
  if (!loaded) table.holding.clear();
  table.errors = measured(table, curve);
  return table;
}

/// Interpolates as the generated header does, in 32-bit arithmetic throughout.
float read_at(const std::vector<float>& entries, float value, float first, float last) {
  const float per_step = static_cast<float>((static_cast<double>(entries.size()) - 1) / (double(last) - double(first)));
  return interpolated(entries, (value - first) * per_step);
}

}  // namespace

double MotorUnit::of(double alpha) const { return zero + alpha / k_two_pi * per_turn; }
double MotorUnit::alpha(double reading) const { return (reading - zero) / per_turn * k_two_pi; }

float interpolated(const std::vector<float>& table, float at) {
  const auto last = static_cast<float>(table.size() - 1);
  if (!(at > 0.0f)) return table.front();
  if (!(at < last)) return table.back();
  const auto i = static_cast<std::size_t>(at);
  const float share = at - static_cast<float>(i);
  return table[i] + share * (table[i + 1] - table[i]);
}

TableErrors measured(const JointTable& table, const JointCurve& curve) {
  constexpr int samples = 8;  // per piece: the middle, where a linear piece has its largest error, and others
  TableErrors errors;
  for (std::size_t way = 0; way < table.ways.size(); ++way) {
    const AngleMap& map = way_of(curve, way);
    const OneWayTable& one = table.ways[way];
    for (int i = 0; i <= samples * table.pieces; ++i) {
      const auto motor =
          static_cast<float>(entry_place(double(one.first), double(one.last), i, samples * table.pieces));
      const double alpha = table.unit.alpha(double(motor) + table.unit.zero);
      const float theta = read_at(one.theta_deg, motor, one.first, one.last);
      errors.theta = std::max(errors.theta, std::abs(radians(double(theta)) - map.theta(alpha)));
      const auto asked = static_cast<float>(
          entry_place(double(table.theta_first_deg), double(table.theta_last_deg), i, samples * table.pieces));
      const double wanted = std::clamp(radians(double(asked)), map.theta_min, map.theta_max);
      const double sent = table.unit.alpha(
          double(read_at(one.motor, asked, table.theta_first_deg, table.theta_last_deg)) + table.unit.zero);
      errors.motor = std::max(errors.motor, std::abs(sent - map.alpha(wanted)));
      errors.returned = std::max(errors.returned, std::abs(map.theta(sent) - wanted));
    }
  }
  return errors;
}

std::optional<JointTable> joint_table(const JointCurve& curve, const Mechanism& mechanism, const MotorUnit& unit,
                                      double most) {
  constexpr int k_fewest_pieces = 16;
  for (int pieces = k_fewest_pieces; pieces <= k_most_pieces; pieces *= 2) {
    JointTable table = table_of(curve, mechanism, unit, pieces);
    if (table.errors.theta <= most && table.errors.returned <= most) return table;
  }
  return std::nullopt;
}

}  // namespace fusee::model
