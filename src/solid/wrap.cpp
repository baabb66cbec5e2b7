#include "solid/wrap.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"

namespace fusee::solid {
namespace {

// In [−π, π].
double turn_between(double from, double to) { return std::remainder(to - from, k_two_pi); }

}  // namespace

std::size_t index_at_normal(const profile::Outline& outline, double normal) {
  const auto found =
      std::min_element(outline.points.begin(), outline.points.end(), [normal](const auto& a, const auto& b) {
        return std::abs(turn_between(a.psi, normal)) < std::abs(turn_between(b.psi, normal));
      });
  return static_cast<std::size_t>(found - outline.points.begin());
}

std::size_t index_at_place(const profile::Outline& outline, const Vec2& place) {
  const auto found =
      std::min_element(outline.points.begin(), outline.points.end(), [&place](const auto& a, const auto& b) {
        return (a.position - place).squaredNorm() < (b.position - place).squaredNorm();
      });
  return static_cast<std::size_t>(found - outline.points.begin());
}

WoundArc wound_arc(const profile::Outline& outline, std::size_t from, std::size_t to) {
  const std::size_t count = outline.points.size();
  const std::size_t step = outline.side == transmission::Side::left ? 1 : count - 1;
  WoundArc arc;
  for (std::size_t i = from; i != to;) {
    const std::size_t next = (i + step) % count;
    arc.length += (outline.points[next].position - outline.points[i].position).norm();
    arc.turn += std::abs(turn_between(outline.points[i].psi, outline.points[next].psi));
    i = next;
  }
  return arc;
}

}  // namespace fusee::solid
