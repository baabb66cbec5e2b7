#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/helical_solid.h"
#include "helical_solid/half_planes.h"
#include "profile/string_above.h"

// Independent check of the synthesis. A string is laid on the groove floors that half-planes found. In plan it goes
// round the corners of an open polygon at half its thickness; along the axis it has the height of the floor's band. Its
// free path is straight when unrolled.

namespace fusee::helical_solid {
namespace {

// Least depth of a groove, mm. Shallower minima are chamfer edges or chords.
constexpr double k_least_depth = 0.3;
// Number of places on either side over which a groove's slope is averaged: a fifth of a turn with 720 half-planes.
// Over few corners the floor's steps would show, and each adds to a steep tendon's length (0.04° of a joint with r1 of
// 3.2 mm and a lead of 6.9 mm).
constexpr std::size_t k_slope_window = 160;
// Polygon sides that turn by less against each other are one side: rounding of a straight line to float, rad.
constexpr double k_straight = 1e-4;

// Sine of the angle by which a line turns at place i.
double turn_at(const FloorLine& line, std::size_t i) {
  const Vec2 before = (line[i] - line[i - 1]).head<2>(), after = (line[i + 1] - line[i]).head<2>();
  return std::abs(cross(before, after)) / (before.norm() * after.norm());
}

// The corner between places i and i + 1 at which two sides of a floor's polygon meet when extended. Empty if a side
// cannot be distinguished from a chord that half-planes cut off.
std::optional<Vec3> corner_after(const FloorLine& line, std::size_t i) {
  if (turn_at(line, i) < k_straight || turn_at(line, i + 1) < k_straight || turn_at(line, i - 1) > k_straight ||
      turn_at(line, i + 2) > k_straight)
    return std::nullopt;
  const Vec2 before = (line[i] - line[i - 1]).head<2>(), after = (line[i + 2] - line[i + 1]).head<2>();
  const Vec2 chord = (line[i + 1] - line[i]).head<2>();
  // The sides meet at this multiple of `before` past place i.
  const double beyond = cross(chord, after) / cross(before, after);
  const Vec2 corner = line[i].head<2>() + beyond * before;
  const double share = (corner - line[i].head<2>()).norm() / chord.norm();
  if (!(beyond > 0 && share < 1)) return std::nullopt;
  return Vec3(corner.x(), corner.y(), line[i].z() + share * (line[i + 1].z() - line[i].z()));
}

// Restores the corners that half-planes cut off. Without them a string would be up to a tenth of a millimetre too short
// in ten turns.
FloorLine with_corners(const FloorLine& line) {
  FloorLine whole;
  for (std::size_t i = 0; i < line.size(); ++i) {
    whole.push_back(line[i]);
    if (i < 2 || i + 3 >= line.size()) continue;
    if (const auto corner = corner_after(line, i)) whole.push_back(*corner);
  }
  return whole;
}

// One string in its helical groove. `hand`: +1 for tendon 2 on the right, −1 for tendon 1 on the left. `end_height`:
// height of the fixed end of the sloping path. `collar`: only the span below the pin slopes. `home_from_knot`: angle
// along the groove from its knot to the take-off at home, rad.
class HelicalString {
 public:
  HelicalString(const FloorLine& floor, const Mechanism& mechanism, double hand, double end_height, bool collar,
                double home_from_knot)
      : floor_(with_corners(floor)),
        hand_(hand),
        half_(0.5 * mechanism.tendon.diameter),
        above_(mechanism, hand),
        end_height_(end_height),
        collar_(collar) {
    along_.push_back(0.0);
    for (std::size_t i = 0; i + 1 < floor_.size(); ++i) {
      const Vec2 edge = plan(i + 1) - plan(i);
      along_.push_back(along_.back() + edge.norm());
      const double normal = profile::direction(edge) - 0.5 * k_pi;
      edge_normals_.push_back(i == 0 ? normal : profile::turned_near(normal, edge_normals_.back()));
    }
    lay_centre_line();
    start(home_from_knot);
    turn_to(0.0);
    home_length_ = length(0.0);
  }

  // Turns the pulley by less than half a turn.
  void turn_to(double alpha) {
    alpha_ = alpha;
    const Vec2 pin = above_.guide_seen_from_pulley(alpha);
    find_corner(pin);
    normal_ = profile::turned_near(tangent_normal(pin), edge_normals_[corner_]);
    span_ = above_.lower_span(pin, plan(corner_));
    if (!(span_ > 0)) throw InputError("", "the guide pin of " + pulley() + " lies inside its groove floor");
    take_off_ = centre_line_at(along_[corner_] + half_ * normal_);
  }

  double hand() const { return hand_; }
  // Length of the string beyond its length at home.
  double excess(double theta) const { return length(theta) - home_length_; }
  std::string name() const { return hand_ > 0 ? "tendon 2" : "tendon 1"; }

  // Fleet angle: between the free path and the groove at the take-off.
  double fleet(double theta) const {
    const double rise = end_height_ - take_off_.height;
    return elementary::atan2(rise, sloping(theta)) - elementary::atan(hand_ * take_off_.slope);
  }

 private:
  // A point of the tendon's centre line in the groove.
  struct CentreLinePoint {
    double wound = 0;  // length along the centre line in space, from the groove's beginning
    double height = 0;
    double slope = 0;  // rise per length in plan
  };

  std::string pulley() const {
    return std::string(transmission::pulley_name(hand_ > 0 ? transmission::Side::right : transmission::Side::left));
  }
  Vec2 plan(std::size_t i) const { return floor_[i].head<2>(); }

  // Length of the string from the groove's beginning to its fixed end, with the wound part negative on the left.
  double length(double theta) const {
    const double rise = end_height_ - take_off_.height, flat = planar(theta) - sloping(theta);
    return hand_ * take_off_.wound + elementary::hypot(sloping(theta), rise) + flat;
  }
  // Length of the free path in plan, and of its sloping part.
  double planar(double theta) const { return span_ + above_.length(theta, normal_ - alpha_); }
  double sloping(double theta) const { return collar_ ? span_ : planar(theta); }

  // The centre line consists of arcs of half the thickness about corners and of edges between them. Floors rise along
  // the edges only, the tendon along both, so its slope is averaged over several corners.
  void lay_centre_line() {
    const std::size_t last = floor_.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      const double before = edge_normals_[i == 0 ? 0 : i - 1], after = edge_normals_[i == last ? last - 1 : i];
      planar_.push_back(along_[i] + half_ * 0.5 * (before + after));
    }
    wound_.push_back(0.0);
    for (std::size_t i = 1; i <= last; ++i)
      wound_.push_back(wound_[i - 1] + (planar_[i] - planar_[i - 1]) * elementary::hypot(1.0, slope_between(i - 1, i)));
  }

  double slope_between(std::size_t a, std::size_t b) const {
    const std::size_t from = a > k_slope_window ? a - k_slope_window : 0,
                      to = std::min(b + k_slope_window, planar_.size() - 1);
    return (floor_[to].z() - floor_[from].z()) / (planar_[to] - planar_[from]);
  }

  CentreLinePoint centre_line_at(double planar) const {
    const auto after = std::upper_bound(planar_.begin() + 1, planar_.end() - 1, planar);
    const auto b = static_cast<std::size_t>(after - planar_.begin()), a = b - 1;
    const double share = (planar - planar_[a]) / (planar_[b] - planar_[a]);
    return {wound_[a] + share * (wound_[b] - wound_[a]), floor_[a].z() + share * (floor_[b].z() - floor_[a].z()),
            slope_between(a, b)};
  }

  // Finds the corner of the take-off at home. On the right the knot is at the beginning of the groove, on the left at
  // its end.
  void start(double home_from_knot) {
    const double wanted = hand_ > 0 ? edge_normals_.front() + home_from_knot : edge_normals_.back() - home_from_knot;
    // The tangent depends on the corner, and the corner on the tangent's normal: three rounds suffice.
    double normal = wanted;
    for (int round = 0; round < 3; ++round) {
      const auto edge = std::lower_bound(edge_normals_.begin(), edge_normals_.end(), normal);
      corner_ = static_cast<std::size_t>(edge - edge_normals_.begin());
      normal = profile::turned_near(tangent_normal(above_.guide_seen_from_pulley(0.0)), wanted);
    }
  }

  double tangent_normal(const Vec2& pin) const { return above_.lower_normal(pin, plan(corner_)); }

  // Walks to the corner whose tangent has both neighbours on its inner side.
  void find_corner(const Vec2& pin) {
    for (std::size_t steps = 0; steps < floor_.size(); ++steps) {
      if (corner_ == 0 || corner_ + 1 >= floor_.size())
        throw InputError(
            "", "the groove of " + pulley() + " ends within the range, at α = " + rounded(degrees(alpha_), 4) + "°");
      const double normal = profile::turned_near(tangent_normal(pin), edge_normals_[corner_]);
      if (normal < edge_normals_[corner_ - 1])
        --corner_;
      else if (normal > edge_normals_[corner_])
        ++corner_;
      else
        return;
    }
    // By rounding, two neighbours may each point to the other. Both are correct.
  }

  FloorLine floor_;
  double hand_;
  double half_;  // half the string's thickness
  profile::StringAbove above_;
  double end_height_;
  bool collar_;
  std::vector<double> along_;         // length of the floor up to each corner, in plan
  std::vector<double> edge_normals_;  // direction of the outward normal of the edge that leaves each corner, rad
  std::vector<double> planar_;        // length of the centre line up to each corner, in plan
  std::vector<double> wound_;         // the same in space
  double home_length_ = 0;

  // The take-off at the pulley's present angle.
  double alpha_ = 0;
  std::size_t corner_ = 0;
  double normal_ = 0;  // direction of the span's normal, rad
  double span_ = 0;    // length of the lower span in plan
  CentreLinePoint take_off_;
};

// The joint angle at which the string is as long as at home.
double taut_angle(const HelicalString& string, double alpha, double guess) {
  constexpr double k_first_reach = 0.005, k_last_reach = 0.7;  // rad
  constexpr int k_bisections = 52;                             // to the last bit of a double
  // Grows with θ on both sides.
  const auto growing = [&string](double theta) { return -string.hand() * string.excess(theta); };
  double reach = k_first_reach;
  while (!(growing(guess - reach) < 0 && growing(guess + reach) > 0)) {
    reach *= 2;
    if (reach > k_last_reach)
      throw InputError("",
                       "no joint angle near the declared one makes " + string.name() +
                           " taut at α = " + rounded(degrees(alpha), 4) + "°",
                       "is this the pulley of this mechanism, in mm, its axis at the origin?");
  }
  double low = guess - reach, high = guess + reach;
  for (int i = 0; i < k_bisections; ++i) {
    const double middle = 0.5 * (low + high);
    (growing(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Turns the pulley through a stroke with both strings.
class Winder {
 public:
  Winder(HelicalString first, HelicalString second) : strings_{std::move(first), std::move(second)} {}

  HelicalRewind wind(const std::vector<transmission::TransmissionPoint>& stroke) {
    for (const transmission::TransmissionPoint& place : stroke) wind_at(place);
    return std::move(rewind_);
  }

 private:
  void wind_at(const transmission::TransmissionPoint& place) {
    turn_to(place.alpha);
    profile::RewindPoint point{place.alpha, place.theta, 0, 0};
    point.theta = taut_angle(strings_[0], place.alpha, place.theta);
    point.excess = -strings_[1].excess(point.theta);
    record(point);
    for (const HelicalString& string : strings_) {
      const double fleet = std::abs(string.fleet(point.theta));
      if (fleet < rewind_.max_fleet) continue;
      rewind_.max_fleet = fleet;
      rewind_.max_fleet_at = place.alpha;
      rewind_.max_fleet_side = string.hand() > 0 ? transmission::Side::right : transmission::Side::left;
    }
  }

  // Turns in small steps, so that the take-offs stay on the right turns of the grooves.
  void turn_to(double alpha) {
    const int steps = 1 + static_cast<int>(std::abs(alpha - alpha_) / radians(10));
    for (int k = 1; k <= steps; ++k) {
      for (HelicalString& string : strings_) string.turn_to(alpha_ + (alpha - alpha_) * k / steps);
    }
    alpha_ = alpha;
  }

  void record(const profile::RewindPoint& point) {
    profile::RewindResult& result = rewind_.result;
    result.points.push_back(point);
    const double error = std::abs(point.theta - point.theta_declared);
    if (error >= result.max_theta_error) {
      result.max_theta_error = error;
      result.max_theta_error_at = point.alpha;
    }
    if (std::abs(point.excess) >= result.max_excess) {
      result.max_excess = std::abs(point.excess);
      result.max_excess_at = point.alpha;
    }
  }

  std::vector<HelicalString> strings_;
  double alpha_ = 0;
  HelicalRewind rewind_;
};

}  // namespace

std::vector<FloorLine> helical_floors(const solid::TriangleMesh& mesh, double scale, int half_planes) {
  const auto planes = static_cast<std::size_t>(half_planes);
  std::vector<std::vector<FloorPlace>> floors;
  for (auto& cut : half_plane_cuts(mesh, planes)) floors.push_back(floors_of(outermost(std::move(cut)), k_least_depth));
  std::vector<FloorLine> lines;
  for (const FloorTrace& trace : floor_traces(floors)) {
    FloorLine& line = lines.emplace_back();
    for (std::size_t k = 0; k < trace.places.size(); ++k) {
      const Vec2 point = trace.places[k].r * unit(half_plane_angle((trace.first + k) % planes, planes));
      line.push_back(Vec3(point.x(), point.y(), trace.places[k].z) / scale);
    }
  }
  return lines;
}

TendonsLaid tendons_laid(const HelicalPulley& pulley, const helix::Spiral& p1, const helix::Spiral& p2,
                         double attachment1, double attachment2, bool collar) {
  TendonsLaid laid;
  laid.z1 = pulley.p1.height(attachment1);
  laid.z2 = pulley.p2.height(attachment2);
  laid.collar = collar;
  laid.spare1 = p1.rows.back().turn - p1.rows[p1.last_used].turn;
  laid.spare2 = p2.rows[p2.first_used].turn - p2.rows.front().turn;
  return laid;
}

HelicalRewind rewind_floors(const FloorLine& floor1, const FloorLine& floor2, const Mechanism& mechanism,
                            const std::vector<transmission::TransmissionPoint>& stroke, const TendonsLaid& laid) {
  demand(!stroke.empty(), "a stroke without places");
  const double alpha_min = stroke.front().alpha, alpha_max = stroke.back().alpha;
  return Winder(HelicalString(floor1, mechanism, -1.0, laid.z1, laid.collar, laid.spare1 + alpha_max),
                HelicalString(floor2, mechanism, +1.0, laid.z2, laid.collar, laid.spare2 - alpha_min))
      .wind(stroke);
}

HelicalRewind rewind_helical(const solid::TriangleMesh& mesh, const Mechanism& mechanism,
                             const std::vector<transmission::TransmissionPoint>& stroke, const TendonsLaid& laid,
                             double scale) {
  const std::vector<FloorLine> floors = helical_floors(mesh, scale);
  if (floors.size() != 2)
    throw InputError(
        "",
        "the mesh has " + std::to_string(floors.size()) + " grooves of more than half a turn, a helical pulley has 2",
        "is it whole, in mm, its axis along z at the origin?");
  return rewind_floors(floors[0], floors[1], mechanism, stroke, laid);
}

}  // namespace fusee::helical_solid
