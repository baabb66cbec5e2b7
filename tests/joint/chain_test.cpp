// The full model compared with an independent program that shares only the target motion. It computes the geometry from
// coordinates, and models the tendon on the pin as a chain of short springs over many points of friction that slip by
// relaxation. The wound tendon is a stack of short pieces (backward Euler instead of the trapezoidal rule), and false
// position solves for the joint. Without friction only the step differs. With friction the chain slips gradually along
// the pin, and the model all at once: the differences are larger.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

#include "fusee/joint.h"
#include "support/mechanisms.h"

namespace fusee::joint {
namespace {

struct UpperLine {
  double free = 0;    ///< mm
  double normal = 0;  ///< direction of the outward normal, rad
  double arm = 0;     ///< moment arm about the joint, mm
};

/// Tangent from C to the outer side of the pin, by vectors.
UpperLine upper_line(double R, double theta, const Vec2& pin, double rho) {
  const Vec2 C(R * std::sin(theta), R * std::cos(theta));
  const Vec2 to_tip = C - pin;
  const double distance = to_tip.norm();
  // The tangent point in the frame of the line pin–C.
  const double along = rho * rho / distance;
  const double across = rho / distance * std::sqrt(distance * distance - rho * rho);
  const Vec2 direction = to_tip / distance;
  const Vec2 tangent = pin + along * direction - across * turned_left(direction);
  const Vec2 line = (C - tangent).normalized();
  UpperLine upper;
  upper.free = (C - tangent).norm();
  upper.normal = std::atan2(-line.x(), line.y());  // line rotated to the right
  upper.arm = std::abs(cross(C, line));
  return upper;
}

/// A tendon below its pin, in its right-hand image: from the pin's tangent point to the contact on the pulley.
struct LowerPart {
  double reach = 0;   ///< mm
  double normal = 0;  ///< direction of the outward normal, rad
};

/// The contact is the intersection of neighbouring lines in the pulley's frame.
LowerPart free_below(const transmission::Transmission& law, transmission::Side side, double image_alpha) {
  struct Line {
    double p, reach, normal;
  };
  const auto line = [&](double alpha) {
    const transmission::TransmissionPoint at = law.at_alpha(transmission::mirror_sign(side) * alpha);
    const transmission::TendonPoint& tendon = side == transmission::Side::right ? at.t2 : at.t1;
    return Line{tendon.p, tendon.lower_reach,
                side == transmission::Side::right ? tendon.lower_normal : k_pi - tendon.lower_normal};
  };
  constexpr double step = 1e-4;
  const Line here = line(image_alpha), before = line(image_alpha - step), after = line(image_alpha + step);
  const double turned_before = before.normal - step - here.normal, turned_after = after.normal + step - here.normal;
  // Both lines with the normals (cos, sin) of their directions: position of the intersection along the line in between.
  const double crossing =
      (std::cos(turned_before) * after.p - std::cos(turned_after) * before.p) / std::sin(turned_after - turned_before);
  return {here.reach - crossing, here.normal};
}

/// The mechanism's numbers for one tendon, in its right-hand image.
struct TendonInputs {
  TendonInputs(const Mechanism& mechanism, transmission::Side its_side)
      : law(mechanism),
        side(its_side),
        R(mechanism.joint.R),
        pin(side == transmission::Side::right ? mechanism.guides.ED : mechanism.guides.EB, -mechanism.guides.OE),
        rho(mechanism.guide_pitch_radius()),
        EA(mechanism.tendon.modulus * k_pi / 4 * mechanism.tendon.diameter * mechanism.tendon.diameter) {}

  UpperLine upper(double image_theta) const { return upper_line(R, image_theta, pin, rho); }
  LowerPart lower(double image_alpha) const { return free_below(law, side, image_alpha); }
  /// Moment arm about the pulley's axis.
  double arm(double image_alpha) const {
    const transmission::TransmissionPoint at = law.at_alpha(transmission::mirror_sign(side) * image_alpha);
    return side == transmission::Side::right ? at.t2.p : at.t1.p;
  }

  transmission::Transmission law;
  transmission::Side side;
  double R;
  Vec2 pin;
  double rho, EA;
};

/// A span or a piece of the wrap.
struct Piece {
  double length = 0;
  double material = 0;
};

double tension(const Piece& piece, double EA) {
  return std::max(0.0, EA * (piece.length - piece.material) / piece.material);
}

/// One tendon, in its right-hand image.
class Chain {
 public:
  Chain(const Mechanism& mechanism, transmission::Side side, double home_tension, int points)
      : inputs_(mechanism, side), mu_(mechanism.guides.mu), lower_(inputs_.lower(0.0)) {
    const double home = inputs_.upper(0.0).normal;
    const double spacing = (home - lower_.normal) / points;
    for (int i = -40 * points; i <= 40 * points; ++i) rim_.push_back(lower_.normal + (i + 0.5) * spacing);
    pieces_ = {{1.0, 1.0}};
    first_ = last_ = index_above(lower_.normal);
    fit(pieces_, first_, last_, inputs_.upper(0.0), lower_);
    for (Piece& piece : pieces_) piece.material = piece.length / (1.0 + home_tension / inputs_.EA);
    home_density_ = 1.0 / (1.0 + home_tension / inputs_.EA);
  }

  /// Turns the pulley; θ is not known yet.
  void turn(double image_alpha) {
    next_ = inputs_.lower(image_alpha);
    winding_ = wound_by(image_alpha);
    alpha_next_ = image_alpha;
  }

  struct Pull {
    double upper = 0;  ///< tensions, N
    double lower = 0;
    double torque = 0;  ///< on the joint, N·mm
  };

  Pull pull(double image_theta, bool keep = false) {
    std::vector<Piece> pieces = pieces_;
    std::size_t first = first_;
    std::size_t last = last_;
    const UpperLine upper = inputs_.upper(image_theta);
    if (winding_ < 0) pieces.front().material += paid_out();
    fit(pieces, first, last, upper, next_);
    if (winding_ > 0) pieces.front().length += winding_;
    relax(pieces, first, upper.normal);
    const Pull result{tension(pieces.back(), inputs_.EA), tension(pieces.front(), inputs_.EA),
                      tension(pieces.back(), inputs_.EA) * upper.arm};
    if (keep) {
      move_wound(result.lower);
      if (winding_ > 0) {
        pieces.front().length -= winding_;
        pieces.front().material -= winding_ / (1.0 + result.lower / inputs_.EA);
      }
      pieces_ = std::move(pieces);
      first_ = first;
      last_ = last;
      lower_ = next_;
      alpha_ = alpha_next_;
    }
    return result;
  }

 private:
  /// Arc wound onto the pulley: material passing the pin (∫p dα, Simpson) minus the change of the lower line.
  double wound_by(double image_alpha) const {
    const double between = inputs_.arm(0.5 * (alpha_ + image_alpha));
    const double over = (image_alpha - alpha_) / 6 * (inputs_.arm(alpha_) + 4 * between + inputs_.arm(image_alpha));
    return over - (next_.reach - lower_.reach) + inputs_.rho * (next_.normal - lower_.normal);
  }

  std::size_t index_above(double normal) const {
    return static_cast<std::size_t>(std::lower_bound(rim_.begin(), rim_.end(), normal) - rim_.begin());
  }

  /// Splits the end pieces at new friction points, joins them at abandoned ones, and then updates the lengths.
  void fit(std::vector<Piece>& pieces, std::size_t& first, std::size_t& last, const UpperLine& upper,
           const LowerPart& lower) const {
    const std::size_t new_first = index_above(lower.normal);
    const std::size_t new_last = index_above(upper.normal);
    while (last > new_last) {
      pieces[pieces.size() - 2].material += pieces.back().material;
      pieces.pop_back();
      --last;
    }
    while (first < new_first) {
      pieces[1].material += pieces[0].material;
      pieces.erase(pieces.begin());
      ++first;
    }
    const auto split = [&](double share, std::size_t at) {
      Piece part = pieces[at];
      part.material *= share;
      pieces[at].material *= 1.0 - share;
      return part;
    };
    while (last < new_last) {
      const double below = inputs_.rho * (rim_[last] - (last > first ? rim_[last - 1] : lower.normal)) +
                           (last > first ? 0.0 : lower.reach);
      const double above = upper.free + inputs_.rho * (upper.normal - rim_[last]);
      const Piece part = split(below / (below + above), pieces.size() - 1);
      pieces.insert(pieces.end() - 1, part);
      ++last;
    }
    while (first > new_first) {
      const double above = inputs_.rho * ((first < last ? rim_[first] : upper.normal) - rim_[first - 1]) +
                           (first < last ? 0.0 : upper.free);
      const double below = lower.reach + inputs_.rho * (rim_[first - 1] - lower.normal);
      const Piece part = split(below / (below + above), 0);
      pieces.insert(pieces.begin(), part);
      --first;
    }
    if (first == last) {
      pieces[0].length = upper.free + inputs_.rho * (upper.normal - lower.normal) + lower.reach;
      return;
    }
    pieces.front().length = lower.reach + inputs_.rho * (rim_[first] - lower.normal);
    for (std::size_t i = first + 1; i < last; ++i) pieces[i - first].length = inputs_.rho * (rim_[i] - rim_[i - 1]);
    pieces.back().length = upper.free + inputs_.rho * (upper.normal - rim_[last - 1]);
  }

  /// Lets material slip at each friction point until no tension ratio exceeds its limit.
  void relax(std::vector<Piece>& pieces, std::size_t first, double upper_normal) const {
    const std::size_t points = pieces.size() - 1;
    std::vector<double> ratio(points);
    for (std::size_t j = 0; j < points; ++j) {
      const double below = j == 0 ? next_.normal : 0.5 * (rim_[first + j - 1] + rim_[first + j]);
      const double above = j + 1 == points ? upper_normal : 0.5 * (rim_[first + j] + rim_[first + j + 1]);
      ratio[j] = std::exp(mu_ * (above - below));
    }
    for (int pass = 0; pass < 4000; ++pass) {
      double moved = 0;
      for (std::size_t k = 0; k < 2 * points; ++k) {
        const std::size_t j = k < points ? k : 2 * points - 1 - k;
        moved = std::max(moved, slip(pieces[j], pieces[j + 1], ratio[j]));
      }
      if (moved < 1e-13) break;
    }
  }

  double slip(Piece& below, Piece& above, double ratio) const {
    const double up = tension(above, inputs_.EA);
    const double down = tension(below, inputs_.EA);
    double factor = 0;  // wanted up/down
    if (up > ratio * down) factor = ratio;
    if (down > ratio * up) factor = 1.0 / ratio;
    if (factor == 0) return 0;
    // One Newton step on up = factor · down; the next pass corrects it.
    const double up_slope = -inputs_.EA * above.length / (above.material * above.material);
    const double down_slope = inputs_.EA * below.length / (below.material * below.material);
    double crossing = -(up - factor * down) / (up_slope - factor * down_slope);
    crossing = std::clamp(crossing, -0.5 * above.material, 0.5 * below.material);
    above.material += crossing;
    below.material -= crossing;
    return std::abs(crossing);
  }

  struct WoundPiece {
    double arc = 0;
    double density = 0;
  };

  double paid_out() const {
    double remaining = -winding_;
    double material = 0;
    for (auto piece = wound_.rbegin(); piece != wound_.rend() && remaining > 0; ++piece) {
      const double arc = std::min(remaining, piece->arc);
      material += arc * piece->density;
      remaining -= arc;
    }
    return material + remaining * home_density_;
  }

  void move_wound(double lower_tension) {
    if (winding_ >= 0) {
      wound_.push_back({winding_, 1.0 / (1.0 + lower_tension / inputs_.EA)});
      return;
    }
    double remaining = -winding_;
    while (!wound_.empty() && remaining > 0) {
      const double arc = std::min(remaining, wound_.back().arc);
      wound_.back().arc -= arc;
      remaining -= arc;
      if (wound_.back().arc <= 0) wound_.pop_back();
    }
  }

  TendonInputs inputs_;
  double mu_;
  std::vector<double> rim_;    ///< normals of the friction points, fixed on the rim
  std::vector<Piece> pieces_;  ///< from the pulley upwards
  std::size_t first_, last_;   ///< first and last rim points that the tendon touches
  LowerPart lower_, next_;
  double alpha_ = 0, alpha_next_ = 0, winding_ = 0;
  std::vector<WoundPiece> wound_;  ///< on the pulley, last wound last
  double home_density_ = 1;        ///< of the tendon that was wound before
};

/// A tendon without friction on its pin, in its right-hand image: elements of equal material from the knot on, each
/// with its strain on the pulley. Those beyond the take-off form the span.
class Elements {
 public:
  Elements(const Mechanism& mechanism, transmission::Side side, double home_tension, int count)
      : inputs_(mechanism, side), mu_(mechanism.pulley.mu) {
    survey();
    const double home = home_tension / inputs_.EA;
    turn(0.0);
    material_ = (arc_now_ + span(0.0)) / (1.0 + home) / count;
    strain_.assign(static_cast<std::size_t>(arc_now_ / (1.0 + home) / material_) + 1, home);
    total_ = count * material_;
  }

  void turn(double image_alpha) {
    const std::size_t last = alphas_.size() - 1;
    const double place =
        (image_alpha - alphas_.front()) / (alphas_.back() - alphas_.front()) * static_cast<double>(last);
    const std::size_t i = std::min(static_cast<std::size_t>(std::max(0.0, place)), last - 1);
    const double share = place - static_cast<double>(i);
    arc_now_ = arcs_[i] + share * (arcs_[i + 1] - arcs_[i]);
    turn_now_ = turns_[i] + share * (turns_[i + 1] - turns_[i]);
    lower_ = inputs_.lower(image_alpha);
  }

  Chain::Pull pull(double image_theta, bool keep = false) {
    const double length = span(image_theta);
    double low = 0, high = 2 * strain_.back() + 1e-6;
    double at_low = excess(low, length, nullptr);
    double at_high = excess(high, length, nullptr);
    if (at_low <= 0) high = 0;
    for (int i = 0; i < 60 && high - low > 1e-14 && at_low > 0; ++i) {
      // Illinois method.
      const double strain = low - at_low * (high - low) / (at_high - at_low);
      const double value = excess(strain, length, nullptr);
      if (std::abs(value) < 1e-13) {
        low = high = strain;
      } else if (value > 0) {
        low = strain;
        at_low = value;
        at_high *= 0.5;
      } else {
        high = strain;
        at_high = value;
        at_low *= 0.5;
      }
    }
    if (keep) {
      std::vector<double> strains;
      excess(high, length, &strains);
      strain_ = std::move(strains);
    }
    return {inputs_.EA * high, inputs_.EA * high, inputs_.EA * high * inputs_.upper(image_theta).arm};
  }

 private:
  /// Arc from the knot and turn of the normal along the range: material passing the pin (∫p dα) minus the change of the
  /// lower line.
  void survey() {
    const bool right = inputs_.side == transmission::Side::right;
    const double from = right ? inputs_.law.alpha_min() : -inputs_.law.alpha_max();
    const double to = right ? inputs_.law.alpha_max() : -inputs_.law.alpha_min();
    constexpr int count = 4000;
    double over = 0;
    LowerPart first;
    for (int i = 0; i <= count; ++i) {
      const double alpha = from + (to - from) * i / count;
      const double step = (to - from) / count;
      if (i > 0)
        over += step / 6 * (inputs_.arm(alpha - step) + 4 * inputs_.arm(alpha - 0.5 * step) + inputs_.arm(alpha));
      const LowerPart here = inputs_.lower(alpha);
      if (i == 0) first = here;
      alphas_.push_back(alpha);
      arcs_.push_back(5.0 + over - (here.reach - first.reach) + inputs_.rho * (here.normal - first.normal));
      turns_.push_back(5.0 / inputs_.arm(from) + here.normal - first.normal + alpha - from);
    }
  }
  double turn_at(double arc) const {
    if (arc <= arcs_.front()) return turns_.front() * arc / arcs_.front();
    const auto after = std::upper_bound(arcs_.begin(), arcs_.end(), arc);
    if (after == arcs_.end()) return turns_.back();
    const auto i = static_cast<std::size_t>(after - arcs_.begin());
    return turns_[i - 1] + (turns_[i] - turns_[i - 1]) * (arc - arcs_[i - 1]) / (arcs_[i] - arcs_[i - 1]);
  }
  double span(double image_theta) const {
    const UpperLine upper = inputs_.upper(image_theta);
    return upper.free + inputs_.rho * (upper.normal - lower_.normal) + lower_.reach;
  }

  /// Length of the span that its material does not fill at this strain, mm.
  double excess(double strain, double length, std::vector<double>* strains) const {
    double arc = 0;
    double on_pulley = 0;
    for (std::size_t k = 0;; ++k) {
      double here = strain;
      if (k < strain_.size()) {
        const double wrap = std::max(0.0, turn_now_ - turn_at(arc + 0.5 * material_));
        here = std::clamp(strain_[k], strain * std::exp(-mu_ * wrap), strain * std::exp(mu_ * wrap));
      }
      const double fits = (arc_now_ - arc) / (material_ * (1.0 + here));
      if (strains != nullptr) strains->push_back(here);
      on_pulley += material_ * std::min(1.0, fits);
      if (fits <= 1.0) break;
      arc += material_ * (1.0 + here);
    }
    return length - (total_ - on_pulley) * (1.0 + strain);
  }

  TendonInputs inputs_;
  double mu_;
  std::vector<double> alphas_, arcs_, turns_;
  std::vector<double> strain_;
  double material_ = 0, total_ = 0;
  double arc_now_ = 0, turn_now_ = 0;
  LowerPart lower_;
};

struct SimulatedState {
  double theta = 0;
  Chain::Pull t1, t2;
};

struct Row {
  double alpha = 0;  ///< rad
  double load = 0;   ///< torque, N·mm
};

/// Moves from home through `rows`.
template <typename Tendon>
std::vector<SimulatedState> simulate(const Mechanism& mechanism, const std::vector<Row>& rows, int points) {
  const Vec2 left_pin(mechanism.guides.EB, -mechanism.guides.OE);
  const Vec2 right_pin(mechanism.guides.ED, -mechanism.guides.OE);
  const double rho = mechanism.guide_pitch_radius();
  const double T1 = mechanism.tendon.pretension;
  const double T2 =
      T1 * upper_line(mechanism.joint.R, 0, left_pin, rho).arm / upper_line(mechanism.joint.R, 0, right_pin, rho).arm;
  Tendon left(mechanism, transmission::Side::left, T1, points);
  Tendon right(mechanism, transmission::Side::right, T2, points);
  std::vector<SimulatedState> results;
  double theta = 0;
  for (const auto& [alpha, load] : rows) {
    left.turn(-alpha);
    right.turn(alpha);
    const auto excess_torque = [&, load = load](double t) {
      return right.pull(t).torque - left.pull(-t).torque - load;
    };
    double low = theta - 0.05;
    double high = theta + 0.05;
    double at_low = excess_torque(low);
    double at_high = excess_torque(high);
    for (int i = 0; i < 60; ++i) {
      // Illinois method: false position that halves the value of an end kept twice.
      theta = low - at_low * (high - low) / (at_high - at_low);
      const double value = excess_torque(theta);
      if (std::abs(value) < 1e-9 || high - low < 1e-14) break;
      if (value > 0) {
        low = theta;
        at_low = value;
        at_high *= 0.5;
      } else {
        high = theta;
        at_high = value;
        at_low *= 0.5;
      }
    }
    results.push_back({theta, left.pull(-theta, true), right.pull(theta, true)});
  }
  return results;
}

std::vector<Row> up_and_down(const Mechanism& mechanism, double load, int steps) {
  const transmission::Transmission law(mechanism);
  std::vector<Row> rows;
  const auto run = [&](double from, double to) {
    for (int i = 1; i <= steps; ++i) rows.push_back({from + (to - from) * i / steps, load});
  };
  rows.push_back({0.0, load});
  run(0.0, law.alpha_max());
  run(law.alpha_max(), 0.0);
  run(0.0, law.alpha_min());
  run(law.alpha_min(), 0.0);
  return rows;
}

struct Disagreement {
  double theta = 0;    ///< largest difference of θ relative to the largest deviation from the law
  double tension = 0;  ///< largest difference of a tension relative to the largest tension
};

Disagreement disagreement(const Mechanism& mechanism, const std::vector<Row>& rows,
                          const std::vector<SimulatedState>& other) {
  JointMotion motion(joint_model(mechanism));
  const transmission::Transmission law(mechanism);
  double theta = 0;
  double deviation = 0;
  double tension_difference = 0;
  double largest_tension = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const EquilibriumPoint at = motion.to({rows[i].alpha, 0.0, rows[i].load});
    theta = std::max(theta, std::abs(at.theta - other[i].theta));
    deviation = std::max(deviation, std::abs(at.theta - law.theta(rows[i].alpha)));
    for (const auto& [ours, theirs] : {std::pair{at.t1.upper, other[i].t1.upper},
                                       {at.t1.lower, other[i].t1.lower},
                                       {at.t2.upper, other[i].t2.upper},
                                       {at.t2.lower, other[i].t2.lower}}) {
      tension_difference = std::max(tension_difference, std::abs(ours - theirs));
      largest_tension = std::max(largest_tension, ours);
    }
  }
  return {theta / deviation, tension_difference / largest_tension};
}

Disagreement from_chain(const Mechanism& mechanism, double load, int steps, int points) {
  const std::vector<Row> rows = up_and_down(mechanism, load, steps);
  return disagreement(mechanism, rows, simulate<Chain>(mechanism, rows, points));
}

Mechanism rubbery(double radius, double friction) {
  Mechanism mechanism = testing::unsymmetric();
  mechanism.guides.radius = radius;
  mechanism.guides.mu = friction;
  mechanism.tendon.modulus = 3000.0;
  mechanism.tendon.pretension = 20.0;
  mechanism.pulley.mu = 1e12;
  return mechanism;
}

TEST(Chain, AgreesWithoutFriction) {
  const Disagreement coarse = from_chain(rubbery(2.0, 0.0), 500.0, 15, 1);
  const Disagreement fine = from_chain(rubbery(2.0, 0.0), 500.0, 60, 1);
  EXPECT_LT(fine.theta, 2e-4);
  EXPECT_LT(fine.tension, 5e-5);
  // With backward Euler the difference is proportional to the step.
  EXPECT_NEAR(coarse.theta / fine.theta, 4.0, 1.0);
}

TEST(Chain, AgreesWithFriction) {
  const Disagreement rough = from_chain(rubbery(6.0, 0.15), 500.0, 40, 3);
  EXPECT_LT(rough.theta, 5e-3);
  EXPECT_LT(rough.tension, 5e-3);
}

// The wound tendon as 500 moving elements, each kept within the bounds of the capstan law: no profile by place, no cut
// pieces, no equivalent spans.
TEST(Elements, AgreeWithGrooveSliding) {
  // Measured differences: 1.3e-4, 5.3e-4 and 5.8e-4 of the deviation, for these coefficients.
  const std::vector<double> all{0.05, 0.2, 0.5}, one{0.2};
  for (const double friction : std::getenv("FUSEE_LONG_TESTS") != nullptr ? all : one) {
    Mechanism mechanism = rubbery(2.0, 0.0);
    mechanism.pulley.mu = friction;
    std::vector<Row> rows = up_and_down(mechanism, 500.0, 30);
    for (int i = 1; i <= 20; ++i) rows.push_back({0.0, 500.0 - 50.0 * i});  // to −500 N·mm
    for (const Row& row : up_and_down(mechanism, -500.0, 20)) rows.push_back(row);
    const std::vector<SimulatedState> elements = simulate<Elements>(mechanism, rows, 500);
    const Disagreement difference = disagreement(mechanism, rows, elements);
    EXPECT_LT(difference.theta, 1e-3) << friction;
    EXPECT_LT(difference.tension, 2e-4) << friction;
    // Another friction coefficient must be detected.
    mechanism.pulley.mu = friction + 0.15;
    EXPECT_GT(disagreement(mechanism, rows, elements).theta, 1e-2) << friction;
  }
}

}  // namespace
}  // namespace fusee::joint
