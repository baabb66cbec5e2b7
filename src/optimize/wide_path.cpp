#include "optimize/wide_path.h"

#include <algorithm>
#include <cmath>

namespace fusee::optimize {

WideKind wide_kind(const Mechanism& mechanism) {
  return {mechanism.joint.drum_radius > 0,
          mechanism.joint.attachment1.has_value(),
          mechanism.joint.attachment2.has_value(),
          mechanism.guides.kind == GuideKind::idler,
          mechanism.sheath.is_there(),
          mechanism.sheath.stiffness > 0};
}

WideFileNumbers<double> wide_file_numbers(const Mechanism& mechanism) {
  const Attachment C{0, mechanism.joint.R};
  const Attachment end1 = mechanism.joint.attachment1.value_or(C), end2 = mechanism.joint.attachment2.value_or(C);
  return {mechanism.joint.drum_radius,
          end1.across,
          end1.along,
          end2.across,
          end2.along,
          mechanism.guides.bearing_radius,
          mechanism.guides.bearing_friction,
          mechanism.sheath.length,
          mechanism.sheath.bend,
          mechanism.sheath.mu,
          mechanism.sheath.stiffness,
          mechanism.sheath.exit_across,
          mechanism.sheath.exit_above};
}

double twist_of(double across, double along, transmission::Domain&) {
  // An end straight below O is reached from the right, as in pin_place().
  return across == 0 && along < 0 ? k_pi : elementary::atan2(across, along);
}

transmission::Jet twist_of(const transmission::Jet& across, const transmission::Jet& along,
                           transmission::Domain& domain) {
  const transmission::Interval quarter = 0.5 * transmission::pi_interval();
  if (along.value.lower() > 0) return transmission::atan(across / along);
  if (across.value.lower() > 0) return transmission::Jet(quarter) - transmission::atan(along / across);
  if (across.value.upper() < 0) return transmission::Jet(-quarter) - transmission::atan(along / across);
  domain.whole = false;
  return boost::numeric::hull(-transmission::pi_interval(), transmission::pi_interval());
}

namespace {

double quarter_turn(double) { return 0.5 * k_pi; }
transmission::Jet quarter_turn(const transmission::Jet&) {
  return transmission::Jet(0.5 * transmission::pi_interval());
}

transmission::UpperLine<double> line_from_end(double away, double e, double oe, double rho,
                                              const transmission::RotationAngle<double>& turned,
                                              transmission::Domain& domain) {
  return transmission::upper_line(transmission::offset_from_pin_in_link(away, e, oe, turned), rho, domain);
}
transmission::UpperLine<transmission::Jet> line_from_end(const transmission::Jet& away, const transmission::Jet& e,
                                                         const transmission::Jet& oe, const transmission::Jet& rho,
                                                         const transmission::RotationAngle<transmission::Jet>& turned,
                                                         transmission::Domain& domain) {
  const SharpLine line = sharp_upper_line(away, e, oe, rho, turned, domain);
  return {line.normal, line.reach};
}

template <typename S>
WidePath<S> free_path(const TendonEnd<S>& end, const S& e, const S& oe, const S& rho, const S& theta,
                      transmission::Domain& domain) {
  const transmission::RotationAngle<S> turned = transmission::rotation_angle(S(theta + end.twist));
  const transmission::UpperLine<S> line = line_from_end(end.away, e, oe, rho, turned, domain);
  return {line.normal - turned.angle, end.away * transmission::sin(line.normal), line.free};
}

/// The line that touches drum and pin, (P − O)·n = ρ0 − ρ.
template <typename S>
struct DrumLine {
  S normal, length;
};
template <typename S>
DrumLine<S> drum_line(const S& drum, const S& e, const S& oe, const S& rho, transmission::Domain& domain) {
  const S distance = transmission::hypot(e, oe), beyond = drum - rho;
  return {transmission::atan(S(-oe / e)) + transmission::acos(transmission::unit_part(S(beyond / distance), domain)),
          transmission::cathetus(distance, beyond, domain)};
}

enum class DrumState { free, on_drum, either };
DrumState drum_state(double wound) { return wound >= 0 ? DrumState::on_drum : DrumState::free; }
DrumState drum_state(const transmission::Jet& wound) {
  if (wound.value.lower() >= 0) return DrumState::on_drum;
  return wound.value.upper() < 0 ? DrumState::free : DrumState::either;
}

/// Never needed for numbers, whose tendon is either free or on the drum.
double hull_of(double a, double) { return a; }
transmission::Jet hull_of(const transmission::Jet& a, const transmission::Jet& b) {
  transmission::Jet both(boost::numeric::hull(a.value, b.value));
  both.count = std::max(a.count, b.count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(both.count); ++i)
    both.slope[i] = boost::numeric::hull(a.slope[i], b.slope[i]);
  return both;
}

template <typename S>
WidePath<S> path_of(const TendonEnd<S>& end, const std::optional<S>& drum, const S& e, const S& oe, const S& rho,
                    const S& theta, transmission::Domain& domain) {
  if (!drum) return free_path(end, e, oe, rho, theta, domain);
  const DrumLine<S> line = drum_line(*drum, e, oe, rho, domain);
  const S opening =
      end.is_on_drum ? S(0.0) : S(transmission::acos(transmission::unit_part(S(*drum / end.away), domain)));
  // The tendon lies on the drum between the normal of its line from the end, which is `opening` before the end's
  // direction, and the normal of its line to the pin. Negative: the tendon is clear of the drum.
  const S wound = quarter_turn(theta) - (theta + end.twist) - opening - line.normal;
  const DrumState state = drum_state(wound);
  if (state == DrumState::free) return free_path(end, e, oe, rho, theta, domain);
  const S to_drum = end.is_on_drum ? S(0.0) : S(transmission::cathetus(end.away, *drum, domain));
  const WidePath<S> on_drum{line.normal, *drum, to_drum + *drum * wound + line.length};
  if (state == DrumState::on_drum) return on_drum;
  transmission::Domain of_free;
  const WidePath<S> free = free_path(end, e, oe, rho, theta, of_free);
  domain.whole = domain.whole && of_free.whole;
  if (!of_free.possible) return on_drum;
  return {hull_of(on_drum.normal, free.normal), hull_of(on_drum.arm, free.arm), hull_of(on_drum.free, free.free)};
}

}  // namespace

WidePath<double> wide_path(const TendonEnd<double>& end, const std::optional<double>& drum, double e, double oe,
                           double rho, double theta, transmission::Domain& domain) {
  return path_of(end, drum, e, oe, rho, theta, domain);
}

WidePath<transmission::Jet> wide_path(const TendonEnd<transmission::Jet>& end,
                                      const std::optional<transmission::Jet>& drum, const transmission::Jet& e,
                                      const transmission::Jet& oe, const transmission::Jet& rho,
                                      const transmission::Jet& theta, transmission::Domain& domain) {
  return path_of(end, drum, e, oe, rho, theta, domain);
}

}  // namespace fusee::optimize
