#include "helical_solid/winding.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"

namespace fusee::helical_solid {
namespace {

// Groove ends closer than this share a column, rad. A narrower column would be a sliver, and the difference is
// negligible for a run-out.
constexpr double k_same_column = 0.004;
// Fraction of the tolerance that the fan uses, because radii of curvature are sampled at columns only.
constexpr double k_share_of_tolerance = 0.9;
// Largest angle from column to column at any tolerance.
constexpr double k_widest_column = radians(8);

// Distance from a groove's end wall to the first filled row, so that the groove edges cover the channel from its entry
// on. mm
constexpr double k_behind_end = 0.1;

// The angle moved by whole turns to between `first` and `first` + 2π.
double into_turn(double angle, double first) { return angle - k_two_pi * std::floor((angle - first) / k_two_pi); }

// Angles at which the fan needs a column: the ends of both grooves, and the first filled rows behind their walls.
std::vector<double> marks_of(const SpiralCurve& p1, const SpiralCurve& p2) {
  const double first = p1.begin();
  std::vector<double> marks{first};
  const auto behind = [](const WindingRow& end) { return std::max(k_behind_end / end.rho, 1.5 * k_same_column); };
  for (const double end :
       {p1.end(), p2.begin(), p2.end(), p1.end() + behind(p1.at(p1.end())), p2.begin() - behind(p2.at(p2.begin()))}) {
    const double mark = into_turn(end, first);
    const bool is_new = std::none_of(marks.begin(), marks.end(), [mark](double known) {
      return std::abs(std::remainder(mark - known, k_two_pi)) < k_same_column;
    });
    if (is_new) marks.push_back(mark);
  }
  std::sort(marks.begin(), marks.end());
  return marks;
}

// Adds the columns between two marks. `step_at`: largest width of a column at an angle. Each column takes an equal
// share of the integral of 1 / step_at.
void add_columns(std::vector<double>& angles, double from, double to, const auto& step_at) {
  constexpr int k_probes = 64;
  std::vector<double> count{0.0};  // number of columns required up to each probe
  for (int k = 0; k < k_probes; ++k) {
    const double step =
        std::min(step_at(from + (to - from) * k / k_probes), step_at(from + (to - from) * (k + 1) / k_probes));
    count.push_back(count.back() + (to - from) / k_probes / step);
  }
  const int steps = std::max(1, static_cast<int>(std::ceil(count.back())));
  int probe = 0;
  for (int i = 0; i < steps; ++i) {
    const double wanted = count.back() * i / steps;
    while (count[static_cast<std::size_t>(probe) + 1] <= wanted && probe + 1 < k_probes) ++probe;
    const double low = count[static_cast<std::size_t>(probe)], high = count[static_cast<std::size_t>(probe) + 1];
    angles.push_back(from + (to - from) * (probe + (wanted - low) / (high - low)) / k_probes);
  }
}

std::size_t nearest_column(const std::vector<double>& angles, double angle) {
  // Shifted while it is moved into the turn, so that an angle just below the first one does not move by a turn.
  const double wanted = into_turn(angle + 0.5 * k_same_column, angles.front());
  std::size_t nearest = 0;
  double least = k_two_pi;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double distance = std::abs(std::remainder(wanted - 0.5 * k_same_column - angles[i], k_two_pi));
    if (distance < least) {
      least = distance;
      nearest = i;
    }
  }
  return nearest;
}

// The rows of a spiral at the fan's columns.
Winding winding_on(const std::vector<double>& angles, const SpiralCurve& curve, double floor_inward) {
  Winding winding;
  winding.first_column = nearest_column(angles, curve.begin());
  const std::size_t columns = angles.size();
  // The curve may begin any number of turns away from the fan's turn.
  const double to_begin = curve.begin() - angles[winding.first_column];
  const double whole_turns = k_two_pi * std::round(to_begin / k_two_pi);
  const auto turn_of = [&](std::size_t j) {
    const std::size_t i = winding.first_column + j;
    return angles[i % columns] + k_two_pi * static_cast<double>(i / columns) + whole_turns;
  };
  for (std::size_t j = 0; turn_of(j) <= curve.end() + k_same_column; ++j) {
    WindingRow row = curve.at(turn_of(j));
    const double before = j > 0 ? turn_of(j) - turn_of(j - 1) : turn_of(j + 1) - turn_of(j);
    const double after = turn_of(j + 1) - turn_of(j);
    // The floor's chords are ρ step³/24 shorter than its arcs, half of that on each side of a row. Moving the row out
    // by x lengthens them by x (before + after)/2. Both are equal at x = ρ (before² − before · after + after²)/24.
    const double out_per_rho = (before * before - before * after + after * after) / 24.0;
    row.position += (row.rho - floor_inward) * out_per_rho * row.normal;
    winding.rows.push_back(row);
  }
  winding.falls = winding.rows.back().height < winding.rows.front().height;
  return winding;
}

// A row past a groove's end, by repetition of the adjacent turn: its row of the same column, shifted by the difference
// between the groove's end and the adjacent turn there.
WindingRow repeated(WindingRow row, const WindingRow& end, const WindingRow& adjacent_to_end) {
  row.position += end.position - adjacent_to_end.position;
  row.height += end.height - adjacent_to_end.height;
  row.turn += end.turn - adjacent_to_end.turn;
  return row;
}

void fill_back(Winding& winding, std::size_t columns, double length) {
  const std::size_t last = winding.rows.size() - 1;
  const WindingRow end = winding.rows[last];
  while ((winding.rows.back().position - end.position).norm() < length && winding.filled_back + 2 < columns) {
    ++winding.filled_back;
    winding.rows.push_back(
        repeated(winding.rows[last + winding.filled_back - columns], end, winding.rows[last - columns]));
  }
}

void fill_front(Winding& winding, std::size_t columns, double length) {
  const WindingRow begin = winding.rows.front();
  std::vector<WindingRow> filled;
  while ((filled.empty() || (filled.back().position - begin.position).norm() < length) && filled.size() + 2 < columns)
    filled.push_back(repeated(winding.rows[columns - filled.size() - 1], begin, winding.rows[columns]));
  winding.filled_front = filled.size();
  winding.first_column = (winding.first_column + columns - filled.size()) % columns;
  winding.rows.insert(winding.rows.begin(), filled.rbegin(), filled.rend());
}

}  // namespace

SpiralCurve::PlaceBetweenRows SpiralCurve::between(double turn) const {
  const std::vector<helix::SpiralRow>& rows = spiral_.rows;
  const auto after = std::upper_bound(rows.begin() + 1, rows.end() - 1, turn,
                                      [](double value, const helix::SpiralRow& row) { return value < row.turn; });
  const helix::SpiralRow &a = *(after - 1), &b = *after;
  return {a, b, b.turn - a.turn, (turn - a.turn) / (b.turn - a.turn)};
}

double SpiralCurve::PlaceBetweenRows::rho() const { return a.rho + (b.rho - a.rho) * std::clamp(u, 0.0, 1.0); }

WindingRow SpiralCurve::at(double turn) const {
  const PlaceBetweenRows here = between(turn);
  const auto& [a, b, step, u] = here;
  // Cubic Hermite interpolation with derivatives dX/dψ = ρ t, dz/dψ = ρ tan λ.
  const double from = (1 + 2 * u) * (1 - u) * (1 - u), to = u * u * (3 - 2 * u);
  const double out_of = u * (1 - u) * (1 - u) * step, into = u * u * (u - 1) * step;
  WindingRow row;
  row.turn = turn;
  row.normal = unit(turn);
  row.rho = here.rho();
  row.position = from * Vec2(a.x, a.y) + to * Vec2(b.x, b.y) + out_of * a.rho * turned_left(unit(a.turn)) +
                 into * b.rho * turned_left(unit(b.turn));
  row.height = place_.height(from * a.z + to * b.z + (out_of * a.rho + into * b.rho) * spiral_.slope);
  return row;
}

double SpiralCurve::largest_rho(double turn) const {
  double rho = 0;
  for (double t = into_turn(turn, begin()); t <= end() + k_same_column; t += k_two_pi)
    rho = std::max(rho, between(t).rho());
  return rho;
}

Fan make_fan(const SpiralCurve& p1, const SpiralCurve& p2, double outward, double floor_inward, double chord_error_mm,
             double filled) {
  const auto step_at = [&](double angle) {
    const double rho = std::max(p1.largest_rho(angle), p2.largest_rho(angle)) + outward;
    return std::min(k_widest_column, std::sqrt(8.0 * k_share_of_tolerance * chord_error_mm / rho));
  };
  Fan fan;
  std::vector<double> marks = marks_of(p1, p2);
  marks.push_back(marks.front() + k_two_pi);
  for (std::size_t k = 0; k + 1 < marks.size(); ++k) add_columns(fan.angles, marks[k], marks[k + 1], step_at);
  fan.p1 = winding_on(fan.angles, p1, floor_inward);
  fan.p2 = winding_on(fan.angles, p2, floor_inward);
  for (const Winding* winding : {&fan.p1, &fan.p2})
    demand(winding->rows.size() > fan.columns(),
           "a spiral of less than a turn: " + std::to_string(winding->rows.size()) + " rows on a fan of " +
               std::to_string(fan.columns()));
  fill_back(fan.p1, fan.columns(), filled);
  fill_front(fan.p2, fan.columns(), filled);
  return fan;
}

}  // namespace fusee::helical_solid
