#include "transmission/torque_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "transmission/load.h"

namespace fusee::transmission {
namespace {

/// Positive nodes and weights of the eight-point Gauss quadrature on [−1, 1], exact to degree 15.
constexpr std::array<std::array<double, 2>, 4> k_gauss_eight{{{0.1834346424956498, 0.3626837833783620},
                                                              {0.5255324099163290, 0.3137066458778873},
                                                              {0.7966664774136267, 0.2223810344533745},
                                                              {0.9602898564975363, 0.1012285362903763}}};
/// Number of intervals over the range. Within one, the sine in a weight's torque equals a polynomial of degree 15 to
/// the last digit.
constexpr int k_intervals = 64;
/// Extension beyond the range, as a fraction of it, in which the law continues where possible.
constexpr double k_extension = 0.1;
/// Minimum dα/dθ in the extension, as a fraction of its value at the end of the range.
constexpr double k_least_share = 0.3;
/// Number of angles at which an extension is checked.
constexpr int k_samples = 16;

/// The table as a spline of M over θ: LawRow::alpha holds θ and LawRow::theta holds M. Null when one torque applies
/// everywhere.
template <typename Spline>
std::shared_ptr<const Spline> spline_of(const std::vector<TorqueRow>& rows) {
  if (rows.empty()) return nullptr;
  std::vector<LawRow> spline_rows;
  for (const TorqueRow& row : rows) spline_rows.push_back({row.theta, row.torque});
  return std::make_shared<const Spline>(spline_rows);
}

}  // namespace

double Transmission::TorqueLaw::wanted(double theta) const {
  return wanted_ ? wanted_->at(theta).theta : mechanism_.pulley.motor_torque;
}

TorqueMatch Transmission::TorqueLaw::match(double theta) const {
  return {theta, law_load_torque(mechanism_, theta).value, wanted(theta)};
}

double Transmission::TorqueLaw::slope(double theta) const { return match(theta).slope(); }

void Transmission::TorqueLaw::examine(double theta) {
  const TorqueMatch here = match(theta);
  // An angle without a value counts as the tightest.
  constexpr double none = -std::numeric_limits<double>::infinity();
  const auto slope_of = [](const TorqueMatch& at) { return std::isfinite(at.slope()) ? at.slope() : none; };
  if (slope_of(here) < slope_of(tightest_)) tightest_ = here;
  if (!(slope_of(here) > 0) && (!fails_at_ || std::abs(theta) < std::abs(*fails_at_))) fails_at_ = theta;
}

Transmission::TorqueLaw::TorqueLaw(const Mechanism& mechanism)
    : mechanism_(mechanism), wanted_(spline_of<TableLaw>(mechanism.pulley.torque_rows)) {
  const double low = mechanism.joint.theta_min, high = mechanism.joint.theta_max;
  tightest_ = match(low);
  std::vector<double> breaks = {0.0};
  for (int i = 0; i <= k_intervals; ++i) breaks.push_back((low * (k_intervals - i) + high * i) / k_intervals);
  if (wanted_) {
    for (const double theta : wanted_->breaks()) breaks.push_back(std::clamp(theta, low, high));
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  places_ = breaks;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    examine(places_[i]);
    if (i > 0) {
      const double middle = 0.5 * (places_[i - 1] + places_[i]), half = 0.5 * (places_[i] - places_[i - 1]);
      for (const auto& [at, weight] : k_gauss_eight) {
        examine(middle - half * at);
        examine(middle + half * at);
      }
    }
  }
  if (!fails_at_) set_ends();
}

/// Beyond the range the load may change its sign and the table's last polynomial may diverge, so the extension is
/// checked.
void Transmission::TorqueLaw::set_ends() {
  const double low = places_.front(), high = places_.back();
  const auto extended = [this](double from, double beyond) {
    const double least_slope = k_least_share * slope(from);
    for (int halvings = 0; halvings < 4; ++halvings, beyond *= 0.5) {
      bool exists = true;
      for (int i = 1; i <= k_samples; ++i) {
        const double value = slope(from + beyond * i / k_samples);
        exists = exists && value > least_slope && std::isfinite(value);
      }
      if (exists) return from + beyond;
    }
    return from;
  };
  extended_min_ = extended(low, -k_extension * (high - low));
  extended_max_ = extended(high, k_extension * (high - low));
  if (extended_min_ < low) places_.insert(places_.begin(), extended_min_);
  if (extended_max_ > high) places_.push_back(extended_max_);

  const std::size_t home = static_cast<std::size_t>(std::find(places_.begin(), places_.end(), 0.0) - places_.begin());
  alphas_.assign(places_.size(), 0.0);
  for (std::size_t i = home + 1; i < places_.size(); ++i)
    alphas_[i] = alphas_[i - 1] + integral(places_[i - 1], places_[i]);
  for (std::size_t i = home; i-- > 0;) alphas_[i] = alphas_[i + 1] - integral(places_[i], places_[i + 1]);
}

double Transmission::TorqueLaw::integral(double from, double to) const {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0;
  for (const auto& [at, weight] : k_gauss_eight)
    sum += weight * (slope(middle - half * at) + slope(middle + half * at));
  return half * sum;
}

double Transmission::TorqueLaw::alpha(double theta) const {
  const double inside = std::clamp(theta, extended_min_, extended_max_);
  const auto after = std::upper_bound(places_.begin() + 1, places_.end() - 1, inside);
  const std::size_t i = static_cast<std::size_t>(after - places_.begin()) - 1;
  const double alpha = alphas_[i] + integral(places_[i], inside);
  return theta == inside ? alpha : alpha + (theta - inside) * slope(inside);
}

LawValue Transmission::TorqueLaw::at(double theta) const {
  const double inside = std::clamp(theta, extended_min_, extended_max_);
  // `motor.theta` is M, see spline_of().
  const LawValue motor = wanted_ ? wanted_->at(inside) : LawValue{mechanism_.pulley.motor_torque};
  const TorqueOverTheta load = law_load_torque(mechanism_, inside);
  const double u = motor.theta / load.value;
  if (theta != inside) return {theta, u, 0, 0};
  // u τ = M, differentiated twice.
  const double du = (motor.d1 - u * load.d1) / load.value;
  const double d2u = (motor.d2 - 2.0 * du * load.d1 - u * load.d2) / load.value;
  return {theta, u, u * du, u * (du * du + u * d2u)};
}

TorqueMatch tightest_torque(const Mechanism& mechanism) { return Transmission::TorqueLaw(mechanism).tightest(); }

std::vector<double> wanted_torques(const Mechanism& mechanism, const std::vector<double>& thetas) {
  const Transmission::TorqueLaw law(mechanism);
  std::vector<double> torques;
  for (const double theta : thetas) torques.push_back(law.wanted(theta));
  return torques;
}

}  // namespace fusee::transmission
