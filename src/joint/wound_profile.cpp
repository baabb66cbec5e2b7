#include "joint/wound_profile.h"

#include <algorithm>
#include <array>
#include <cmath>

// The capstan law bounds the tension: T e^{∓μφ} at the wrap φ behind the take-off, where the tension is T. The sliding
// part reaches from the take-off to the point at which this bound meets the stored tension. The stored profile obeys
// the law, so that nothing beyond that point can slide.
//
// The profile is stored by place, not by element: material that slides moves by a small fraction of a millimetre. This
// is exact where the tendon slides, because the bound determines the state, and where it does not, because nothing
// moves.
//
// A part that slid is one piece of any length. A part that was laid has one piece per step. Over a stroke each piece is
// pushed and popped once.

namespace fusee::joint {
namespace {

double strain_of(double density, double swelling) { return std::max(0.0, 1.0 / (swelling * density) - 1.0); }
double density_of(double strain, double swelling) { return 1.0 / (swelling * (1.0 + strain)); }

/// Elastic energy per arc length, over EA.
double energy_per_arc(double density, double swelling) {
  const double strain = strain_of(density, swelling);
  return 0.5 * strain * strain / (1.0 + strain);
}

/// Content of an arc that was laid with linearly varying density. Trapezoidal rule.
WoundContent laid_content(double arc, double density_from, double density_to, double swelling) {
  return {0.5 * (density_from + density_to) * arc,
          0.5 * (energy_per_arc(density_from, swelling) + energy_per_arc(density_to, swelling)) * arc};
}

/// Nodes and weights of the three-point Gauss quadrature on [−1, 1].
constexpr std::array<std::array<double, 2>, 3> k_gauss{
    {{-0.774596669241483377, 5.0 / 18.0}, {0.0, 8.0 / 18.0}, {0.774596669241483377, 5.0 / 18.0}}};
/// Largest width of a quadrature panel, both in wrap φ (rad) and in μφ. The relative error of the integral is 1e-7.
constexpr double k_panel = 1.0;
/// Strain that counts as zero in logarithms.
constexpr double k_no_strain = 1e-17;

double log_of(double strain) { return elementary::log(std::max(strain, k_no_strain)); }

/// e^x and e^−x to machine precision, for |x| ≤ 0.4.
std::array<double, 2> exp_of_both_signs(double x) {
  const double y = x * x;
  const double even =
      1.0 + y * (1.0 / 2 + y * (1.0 / 24 + y * (1.0 / 720 + y * (1.0 / 40320 + y * (1.0 / 3628800 + y / 479001600)))));
  const double odd = x * (1.0 + y * (1.0 / 6 + y * (1.0 / 120 + y * (1.0 / 5040 + y * (1.0 / 362880 + y / 39916800)))));
  return {even + odd, even - odd};
}

/// Tendon on a segment that has slid.
struct SlidContent {
  WoundContent content;
  double length = 0;  ///< length of the equivalent span (Slide::length)
};

/// Content between `from` and `to` for the strain ε e^{fall (turn_to − turn)}, where ε = `strain` is that at `to`.
///
/// With q = e^{fall (turn_to − ψ)}, integration by parts gives
///   ∫ f(q) ds = f(1) (s_to − s_from) + fall ∫ (s − s_from) q f'(q) dψ.
/// Gauss quadrature computes the last integral. For fall = 0 this term vanishes.
SlidContent slid_content(const GrooveArc& groove, const GroovePlace& from, const GroovePlace& to, double strain,
                         double fall, double swelling) {
  const double arc = to.arc - from.arc;
  const double elongation = 1.0 + strain;  // length per material
  SlidContent sum{{arc / elongation, 0.5 * strain * strain / elongation * arc}, arc};
  const double turn = to.turn - from.turn;
  if (fall != 0 && turn > 0) {
    const int panels = static_cast<int>(std::ceil(turn * std::max(1.0, std::abs(fall)) / k_panel));
    const double origin = groove.arc(to.turn) - arc;
    const double width = turn / panels;
    const double half_fall = elementary::exp(0.5 * fall * width);
    // q at the nodes of the first panel. One exponential serves all panels, as q has the same ratio from panel to
    // panel.
    const auto [ahead, behind] = exp_of_both_signs(0.5 * fall * width * k_gauss[2][0]);
    const std::array<double, 3> q_at_nodes{half_fall * behind, half_fall, half_fall * ahead};
    double material = 0, energy = 0, length = 0;
    double q_at_panel = 1;
    for (int panel = 0; panel < panels; ++panel) {
      for (std::size_t i = 0; i < k_gauss.size(); ++i) {
        const auto& [node, weight] = k_gauss[i];
        const double turned = (panel + 0.5 * (1.0 + node)) * width;
        const double q = q_at_panel * q_at_nodes[i];
        const double local_strain = strain * q;
        const double density = 1.0 / (1.0 + local_strain);
        const double moved = weight * q * density * density * (groove.arc(to.turn - turned) - origin);
        material -= moved;
        energy += moved * local_strain * (1.0 + 0.5 * local_strain);
        length += moved * (1.0 - local_strain) * density;
      }
      q_at_panel *= half_fall * half_fall;
    }
    const double scale = fall * width;
    sum.content.material += scale * strain * material;
    sum.content.energy += scale * strain * energy;
    sum.length += scale * elongation * elongation * length;
  }
  sum.content.material /= swelling;
  return sum;
}

WoundContent operator-(const WoundContent& all, const WoundContent& part) {
  return {all.material - part.material, all.energy - part.energy};
}

/// The part of `piece` below `place`. Integrates over the removed or the remaining part, whichever is shorter.
WoundPiece part_below(const GrooveArc& groove, WoundPiece piece, const GroovePlace& place, double swelling) {
  if (piece.slid) {
    const double above = strain_of(piece.density_to, swelling);
    const double here = above * elementary::exp(piece.fall * (piece.to.turn - place.turn));
    const bool takes_little = piece.swelling == swelling && piece.to.turn - place.turn < place.turn - piece.from.turn;
    piece.content = takes_little
                        ? piece.content - slid_content(groove, place, piece.to, above, piece.fall, swelling).content
                        : slid_content(groove, piece.from, place, here, piece.fall, swelling).content;
    piece.to = place;
    piece.density_to = density_of(here, swelling);
    piece.swelling = swelling;
    return piece;
  }
  const double share = (place.arc - piece.from.arc) / (piece.to.arc - piece.from.arc);
  piece.density_to = piece.density_from + share * (piece.density_to - piece.density_from);
  piece.to = place;
  piece.content = laid_content(piece.to.arc - piece.from.arc, piece.density_from, piece.density_to, swelling);
  return piece;
}

/// The capstan bound on the strain. Its logarithm is linear in the turn.
struct Bound {
  double turn = 0;        ///< turn of its upper end
  double log_strain = 0;  ///< logarithm of the bound at `turn`
  double fall = 0;        ///< increase of that logarithm per rad towards the knot
  bool pulls = true;      ///< true: a higher strain pulls the tendon out; false: a lower one lets it slip back

  /// Logarithm of bound / stored strain at the turn `at`; `log_stored`: logarithm of the stored strain. Positive if the
  /// tendon slides.
  double beyond(double at, double log_stored) const {
    const double excess = log_strain + fall * (turn - at) - log_stored;
    return pulls ? excess : -excess;
  }
};

/// The place on `piece` below which the tendon does not slide: `piece.to` if nothing slides, `piece.from` if all does.
/// `log_from`, `log_to`: logarithms of the stored strains at its ends.
GroovePlace cut_of(const WoundPiece& piece, double log_from, double log_to, const Bound& bound,
                   const GrooveArc& groove) {
  const double at_to = bound.beyond(piece.to.turn, log_to);
  if (!(at_to > 0)) return piece.to;
  const double at_from = bound.beyond(piece.from.turn, log_from);
  if (at_from > 0) return piece.from;
  // Linear interpolation: exact for a slid piece, and a piece laid in one step is short.
  const double share = at_to / (at_to - at_from);
  const double turn = piece.to.turn - share * (piece.to.turn - piece.from.turn);
  if (!piece.slid) return {turn, piece.to.arc - share * (piece.to.arc - piece.from.arc)};
  const double arc = piece.to.arc - (groove.arc(piece.to.turn) - groove.arc(turn));
  return {turn, std::clamp(arc, piece.from.arc, piece.to.arc)};
}

}  // namespace

// Cubic Hermite interpolation. The slope at a node is that of the parabola through it and its neighbours.
GrooveArc::GrooveArc(std::vector<GroovePlace> along, double knot_beyond) {
  const std::size_t last = along.size() - 1;
  const auto slope = [&](std::size_t i) {
    return (along[i + 1].arc - along[i].arc) / (along[i + 1].turn - along[i].turn);
  };
  for (std::size_t i = 0; i <= last; ++i) {
    double node_slope = slope(std::min(i, last - 1));
    if (i > 0 && i < last) {
      const double left = along[i].turn - along[i - 1].turn, right = along[i + 1].turn - along[i].turn;
      node_slope = (slope(i - 1) * right + slope(i) * left) / (left + right);
    }
    nodes_.push_back({along[i].turn, along[i].arc, node_slope, 0, 0});
  }
  for (std::size_t i = 0; i < last; ++i) {
    const double h = along[i + 1].turn - along[i].turn;
    const double from = nodes_[i].slope - slope(i), to = nodes_[i + 1].slope - slope(i);
    nodes_[i].bend = -(2.0 * from + to) / h;
    nodes_[i].twist = (from + to) / (h * h);
  }
  per_turn_ = static_cast<double>(last) / (nodes_.back().turn - nodes_.front().turn);
  knot_ = {nodes_.front().turn - knot_beyond / nodes_.front().slope, nodes_.front().arc - knot_beyond};
}

// The straight part between drum and knot has the strain at the drum's end. slid_content() starts at the knot's arc, so
// this part acts as additional arc at the same turn.
GrooveArc GrooveArc::round(double radius, double behind) {
  GrooveArc drum({{0.0, 0.0}, {1.0, radius}}, 0.0);
  drum.knot_.arc -= behind;
  return drum;
}

double GrooveArc::arc(double turn) const {
  const Node& first = nodes_.front();
  const Node& last = nodes_.back();
  if (turn <= first.turn) return first.arc + (turn - first.turn) * first.slope;
  if (turn >= last.turn) return last.arc + (turn - last.turn) * last.slope;
  // The nodes are nearly equidistant.
  std::size_t i = std::min(static_cast<std::size_t>((turn - first.turn) * per_turn_), nodes_.size() - 2);
  while (nodes_[i].turn > turn) --i;
  while (nodes_[i + 1].turn < turn) ++i;
  const Node& from = nodes_[i];
  const double h = turn - from.turn;
  return from.arc + h * (from.slope + h * (from.bend + h * from.twist));
}

WoundProfile::WoundProfile(std::shared_ptr<const GrooveArc> groove, double friction, const GroovePlace& take_off,
                           double density)
    : groove_(std::move(groove)), friction_(friction), home_density_(density), take_off_(take_off), density_(density) {
  if (!(groove_->knot().arc < take_off.arc)) return;
  WoundPiece all{groove_->knot(), take_off, density, density, true, 0.0, {}, 1.0};
  all.content = slid_content(*groove_, all.from, all.to, strain_of(density, 1.0), 0.0, 1.0).content;
  pieces_.push_back(all);
}

double WoundProfile::strain(double swelling) const { return strain_of(density_, swelling); }

double WoundProfile::strain_at_knot(double swelling) const {
  return pieces_.empty() ? strain(swelling) : strain_of(pieces_.front().density_from, swelling);
}

TurnedPulley WoundProfile::turned_to(const GroovePlace& take_off, double swelling) const {
  TurnedPulley turned;
  turned.take_off = take_off;
  turned.before = take_off.arc > take_off_.arc ? take_off_ : take_off;
  turned.wound_strain = strain(swelling);
  turned.log_wound_strain = log_of(turned.wound_strain);
  std::size_t remaining = pieces_.size();
  while (remaining > 0 && pieces_[remaining - 1].from.arc >= turned.before.arc)
    turned.came_off += pieces_[--remaining].content.material;
  if (remaining == 0) {
    // All pieces have come off. Beyond them the tendon has the density of home.
    const double bottom = pieces_.empty() ? take_off_.arc : pieces_.front().from.arc;
    turned.past_knot = laid_content(bottom - turned.before.arc, home_density_, home_density_, swelling);
    turned.came_off += turned.past_knot.material;
    return turned;
  }
  turned.below = remaining - 1;
  turned.top = pieces_[remaining - 1];
  turned.has_top = true;
  if (turned.top.to.arc > turned.before.arc) {
    turned.came_off += turned.top.content.material;
    turned.top = part_below(*groove_, turned.top, turned.before, swelling);
    turned.came_off -= turned.top.content.material;
  }
  // The common case needs no further logarithm: the density continues across the take-off.
  const bool is_continuous = turned.top.density_to == density_;
  const double top_strain = is_continuous ? turned.wound_strain : strain_of(turned.top.density_to, swelling);
  turned.log_top = is_continuous ? turned.log_wound_strain : log_of(top_strain);
  if (take_off.arc < take_off_.arc) {
    turned.wound_strain = top_strain;
    turned.log_wound_strain = turned.log_top;
  }
  return turned;
}

Slide WoundProfile::slide(const TurnedPulley& turned, double strain, double swelling) const {
  Slide slide;
  slide.strain = strain;
  slide.below = turned.below;
  slide.remainder = turned.top;
  slide.has_remainder = turned.has_top;
  slide.freed = turned.came_off;
  const double laid = turned.take_off.arc - turned.before.arc;
  const double wound_strain = turned.wound_strain;
  Bound bound{turned.before.turn, 0, strain > wound_strain ? -friction_ : friction_, strain > wound_strain};
  const double log_q = bound.fall * (turned.take_off.turn - turned.before.turn);
  bound.log_strain = log_of(strain) + log_q;
  slide.slides = turned.has_top && bound.beyond(bound.turn, turned.log_wound_strain) > 0;
  // Strain at `before` per strain at the take-off, where the tendon slides.
  const double q = slide.slides ? elementary::exp(log_q) : 1.0;
  const double strain_before = slide.slides ? strain * q : wound_strain;
  slide.at_before = laid > 0 ? strain_before : strain;
  // Material at `before` is freed with the strain ε at the take-off as 1/(1 + qε) decreases: by q/(1 + qε)² per strain
  // and length. That is `per_length` times 1/(1 + ε)², the unit of Slide::length.
  const double ratio = (1.0 + strain) / (1.0 + strain_before);
  const double per_length = slide.slides ? q * ratio * ratio : 0.0;
  if (laid > 0) {
    slide.freed -= 0.5 * laid * (density_of(strain_before, swelling) + density_of(strain, swelling));
    slide.length = 0.5 * laid * (1.0 + per_length);
  }
  if (!slide.slides) return slide;
  slide.fall = bound.fall;
  // Goes down from piece to piece until one does not slide as a whole.
  double came_loose = 0;  // material of the pieces that slide
  double log_to = turned.log_top;
  for (;;) {
    const double log_from = slide.remainder.density_from == slide.remainder.density_to
                                ? log_to
                                : log_of(strain_of(slide.remainder.density_from, swelling));
    slide.cut = cut_of(slide.remainder, log_from, log_to, bound, *groove_);
    if (slide.cut.arc >= slide.remainder.to.arc) break;
    came_loose += slide.remainder.content.material;
    if (slide.cut.arc > slide.remainder.from.arc) {
      slide.remainder = part_below(*groove_, slide.remainder, slide.cut, swelling);
      came_loose -= slide.remainder.content.material;
      break;
    }
    slide.has_remainder = slide.below > 0;
    if (!slide.has_remainder) break;
    const double density = slide.remainder.density_from;
    slide.remainder = pieces_[--slide.below];
    log_to = slide.remainder.density_to == density ? log_from : log_of(strain_of(slide.remainder.density_to, swelling));
  }
  const SlidContent slid = slid_content(*groove_, slide.cut, turned.before, strain_before, bound.fall, swelling);
  slide.sliding = slid.content;
  slide.freed += came_loose - slid.content.material;
  slide.length += slid.length * per_length;
  return slide;
}

WoundContent WoundProfile::accept(const TurnedPulley& turned, const Slide& slide, double swelling) {
  WoundContent more{-turned.past_knot.material, -turned.past_knot.energy};
  for (std::size_t i = slide.below; i < pieces_.size(); ++i) {
    more.material -= pieces_[i].content.material;
    more.energy -= pieces_[i].content.energy;
  }
  pieces_.resize(slide.below);
  const auto put = [&](const WoundPiece& piece) {
    more.material += piece.content.material;
    more.energy += piece.content.energy;
    pieces_.push_back(piece);
  };
  if (slide.has_remainder) put(slide.remainder);
  const double at_before = density_of(slide.at_before, swelling);
  if (slide.slides && turned.before.arc > slide.cut.arc) {
    const double at_cut = slide.at_before * elementary::exp(slide.fall * (turned.before.turn - slide.cut.turn));
    put({slide.cut, turned.before, density_of(at_cut, swelling), at_before, true, slide.fall, slide.sliding, swelling});
  }
  if (const double laid = turned.take_off.arc - turned.before.arc; laid > 0) {
    const double now = density_of(slide.strain, swelling);
    put({turned.before, turned.take_off, at_before, now, false, 0.0, laid_content(laid, at_before, now, swelling),
         swelling});
  }
  take_off_ = turned.take_off;
  density_ = density_of(slide.strain, swelling);
  return more;
}

}  // namespace fusee::joint
