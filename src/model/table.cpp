#include <algorithm>
#include <cmath>

#include "fusee/base.h"
#include "fusee/model.h"
#include "transmission/load.h"

namespace fusee::model {
namespace {

/// The curve of a direction; the mean curve if both directions are equal.
const AngleMap& way_of(const JointCurve& curve, std::size_t way) {
  return curve.ways ? (*curve.ways)[way] : curve.middle;
}

/// Argument of entry i of a table of linear pieces from `first` to `last`.
double entry_argument(double first, double last, int i, int pieces) { return first + (last - first) * i / pieces; }

/// The tables of one direction, with pieces and θ range of `table`.
OneWayTable one_way_table(const AngleMap& map, const MotorUnit& unit, const JointTable& table) {
  OneWayTable result;
  const double at_min = unit.of(map.alpha_min) - unit.zero, at_max = unit.of(map.alpha_max) - unit.zero;
  result.first = static_cast<float>(std::min(at_min, at_max));
  result.last = static_cast<float>(std::max(at_min, at_max));
  for (int i = 0; i <= table.pieces; ++i) {
    const double motor = entry_argument(double(result.first), double(result.last), i, table.pieces);
    result.theta_deg.push_back(static_cast<float>(degrees(map.theta(unit.alpha(motor + unit.zero)))));
    const double theta =
        radians(entry_argument(double(table.theta_first_deg), double(table.theta_last_deg), i, table.pieces));
    result.motor.push_back(static_cast<float>(unit.of(map.alpha(theta)) - unit.zero));
  }
  return result;
}

/// The tables of a given number of pieces.
JointTable table_of(const JointCurve& curve, const Mechanism& mechanism, const MotorUnit& unit, int pieces) {
  JointTable table;
  table.unit = unit;
  table.pieces = pieces;
  table.theta_first_deg = static_cast<float>(degrees(curve.middle.theta_min));
  table.theta_last_deg = static_cast<float>(degrees(curve.middle.theta_max));
  for (std::size_t way = 0; way < (curve.ways ? 2u : 1u); ++way)
    table.ways.push_back(one_way_table(way_of(curve, way), unit, table));
  const OneWayTable& first_way = table.ways.front();
  bool is_loaded = false;
  for (int i = 0; i <= pieces; ++i) {
    const double motor = entry_argument(double(first_way.first), double(first_way.last), i, pieces);
    const double alpha = unit.alpha(motor + unit.zero);
    const double slope = curve.middle.slope(alpha),
                 load = transmission::load_torque(mechanism, curve.middle.theta(alpha));
    // By virtual work, the motor torque is dθ/dα times the torque at the joint.
    table.slope.push_back(static_cast<float>(slope));
    table.holding.push_back(static_cast<float>(slope * load));
    is_loaded = is_loaded || load != 0;
  }
  if (!is_loaded) table.holding.clear();
  table.errors = measured(table, curve);
  return table;
}

/// Interpolates at `argument` as the generated header does, in 32-bit arithmetic throughout.
float read_at(const std::vector<float>& entries, float argument, float first, float last) {
  const float pieces_per_unit =
      static_cast<float>((static_cast<double>(entries.size()) - 1) / (double(last) - double(first)));
  return interpolated(entries, (argument - first) * pieces_per_unit);
}

}  // namespace

double MotorUnit::of(double alpha) const { return zero + alpha / k_two_pi * per_turn; }
double MotorUnit::alpha(double reading) const { return (reading - zero) / per_turn * k_two_pi; }

float interpolated(const std::vector<float>& table, float position) {
  const auto last = static_cast<float>(table.size() - 1);
  if (!(position > 0.0f)) return table.front();
  if (!(position < last)) return table.back();
  const auto i = static_cast<std::size_t>(position);
  const float share = position - static_cast<float>(i);
  return table[i] + share * (table[i + 1] - table[i]);
}

TableErrors measured(const JointTable& table, const JointCurve& curve) {
  constexpr int samples = 8;  // per piece: the middle, where a linear piece has its largest error, and others
  TableErrors errors;
  for (std::size_t way = 0; way < table.ways.size(); ++way) {
    const AngleMap& map = way_of(curve, way);
    const OneWayTable& one_way = table.ways[way];
    for (int i = 0; i <= samples * table.pieces; ++i) {
      const auto motor =
          static_cast<float>(entry_argument(double(one_way.first), double(one_way.last), i, samples * table.pieces));
      const double alpha = table.unit.alpha(double(motor) + table.unit.zero);
      const float theta = read_at(one_way.theta_deg, motor, one_way.first, one_way.last);
      errors.theta = std::max(errors.theta, std::abs(radians(double(theta)) - map.theta(alpha)));
      const auto wanted_deg = static_cast<float>(
          entry_argument(double(table.theta_first_deg), double(table.theta_last_deg), i, samples * table.pieces));
      const double wanted = std::clamp(radians(double(wanted_deg)), map.theta_min, map.theta_max);
      const double alpha_read = table.unit.alpha(
          double(read_at(one_way.motor, wanted_deg, table.theta_first_deg, table.theta_last_deg)) + table.unit.zero);
      errors.motor = std::max(errors.motor, std::abs(alpha_read - map.alpha(wanted)));
      errors.returned = std::max(errors.returned, std::abs(map.theta(alpha_read) - wanted));
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
