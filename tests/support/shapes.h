/// \file
/// Pulleys of known shape for tests of later stages: convex outlines given by their support functions.
#pragma once

#include <cmath>
#include <functional>

#include "fusee/profile.h"

namespace fusee::testing {

/// A support function as a Fourier series: p(ψ) = radius + Σ cosine·cos(kψ) + sine·sin(kψ). k = 1 moves the centre.
struct SupportShape {
  struct Term {
    int k = 1;
    double cosine = 0;
    double sine = 0;
  };
  double radius = 20;
  std::vector<Term> terms;

  double p(double psi) const {
    double sum = radius;
    for (const Term& t : terms) sum += t.cosine * std::cos(t.k * psi) + t.sine * std::sin(t.k * psi);
    return sum;
  }
  double dp(double psi) const {
    double sum = 0;
    for (const Term& t : terms) sum += t.k * (t.sine * std::cos(t.k * psi) - t.cosine * std::sin(t.k * psi));
    return sum;
  }
  double d2p(double psi) const {
    double sum = 0;
    for (const Term& t : terms) sum -= t.k * t.k * (t.cosine * std::cos(t.k * psi) + t.sine * std::sin(t.k * psi));
    return sum;
  }
};

inline SupportShape circle(double radius, Vec2 centre = Vec2::Zero()) {
  return {radius, {{1, centre.x(), centre.y()}}};
}

/// The outline at `count` evenly spaced normals. The active arc runs counter-clockwise between two normals, rad.
inline profile::Outline sampled(const SupportShape& shape, transmission::Side side, int count, double active_from,
                                double active_to) {
  profile::Outline outline;
  outline.side = side;
  for (int i = 0; i < count; ++i) {
    const double psi = k_two_pi * i / count;
    const Vec2 normal = unit(psi);
    outline.points.push_back(
        {psi, shape.p(psi) * normal + shape.dp(psi) * turned_left(normal), normal, shape.p(psi) + shape.d2p(psi)});
  }
  const auto index = [count](double psi) {
    return static_cast<std::size_t>(std::lround(psi / k_two_pi * count) % count);
  };
  outline.active_first = index(active_from);
  outline.active_last = index(active_to);
  return outline;
}

/// Both outlines at the same `count` normals, for a stroke of ±90°. Both active arcs are 200° long.
inline profile::SynthesisResult pulley_of(const SupportShape& p1, const SupportShape& p2, int count = 240) {
  profile::SynthesisResult result;
  result.status = profile::SynthesisStatus::made;
  result.p1 = sampled(p1, transmission::Side::left, count, radians(80), radians(280));
  result.p2 = sampled(p2, transmission::Side::right, count, radians(270), radians(110));
  for (const double alpha : {radians(-90), 0.0, radians(90)}) {
    transmission::TransmissionPoint point;
    point.alpha = alpha;
    result.stroke.push_back(point);
  }
  return result;
}

/// A mechanism with the file's default body and distant pins.
inline DeclaredMechanism plain_mechanism() {
  DeclaredMechanism mechanism;
  mechanism.name = "test";
  mechanism.joint = {100, radians(-30), radians(30)};
  mechanism.guides = {50, 50, -40, 2, 0.12};
  mechanism.pulley.EF = 80;
  mechanism.pulley.r1 = 20;
  mechanism.tendon = {1.0, 40000, 5, 8};
  Body& body = mechanism.body;
  body.groove_angle = radians(50);
  body.seat_ratio = 0.55;
  body.flange_thickness = 1.2;
  body.hub_height = 8;
  body.set_screw = "auto";
  body.nut_trap = true;
  body.mark_depth = 0.4;
  body.min_wall = 1.2;
  mechanism.print.overhang = radians(45);
  mechanism.material.hole_compensation = 0.2;
  mechanism.material.elephant_foot = 0.4;
  return mechanism;
}

}  // namespace fusee::testing
