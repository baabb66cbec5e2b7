#include "joint/wound_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// With T at the take-off, the sliding part ends where the bound T e^{∓μφ} meets what lies there: the stored profile
// obeys the law itself, so that nothing beyond can slide. Material that slides moves along the arc by its strain's
// share of a millimetre; the profile is kept by place, not by element. Exact where it slides, since there the bound is
// all there is to know, and where it does not, since nothing moves.
//
// No piece is a grid's: what slid is one piece however long, what was laid one a step. Over a stroke each piece is
// pushed and popped once.

namespace fusee {
namespace {

double strain_of(double density, double swelling) { return std::max(0.0, 1.0 / (swelling * density) - 1.0); }
double density_of(double strain, double swelling) { return 1.0 / (swelling * (1.0 + strain)); }

/// Elastic energy of an arc length, over EA.
double energy_per_arc(double density, double swelling) {
  const double strain = strain_of(density, swelling);
  return 0.5 * strain * strain / (1.0 + strain);
}

WoundContent linear(double arc, double density_from, double density_to, double swelling) {
  return {0.5 * (density_from + density_to) * arc,
          0.5 * (energy_per_arc(density_from, swelling) + energy_per_arc(density_to, swelling)) * arc};
}

/// Gauss's places and weights on [0, 1].
constexpr std::array<std::array<double, 2>, 4> k_gauss{{{0.069431844202973712, 0.173927422568726929},
                                                        {0.330009478207571868, 0.326072577431273071},
                                                        {0.669990521792428132, 0.326072577431273071},
                                                        {0.930568155797026288, 0.173927422568726929}}};
constexpr double k_panel = 1.0;  ///< rad: e^{μφ} for μ ≤ 2 to 1e-7 of its change

struct SlidStretch {
  WoundContent held;
  double length = 0;  ///< as Slide::length
};

/// What lies between `from` and `to` with the strain ε e^{fall (to − turn)}, ε at `to`.
///
/// By parts: ∫ f(q) ds over q = e^{fall φ} is f(1) (s_to − s_from) + fall ∫ (s − s_from) q f'(q) dψ, exact where nothing
/// falls.
SlidStretch sliding(const GrooveArc& groove, const GroovePlace& from, const GroovePlace& to, double strain, double fall,
                double swelling) {
  const double arc = to.arc - from.arc;
  const double whole = 1.0 + strain;
  SlidStretch sum{{arc / whole, 0.5 * strain * strain / whole * arc}, arc};
  const double turn = to.turn - from.turn;
  if (fall != 0 && turn > 0) {
    const int panels = std::max(1, static_cast<int>(std::ceil(turn / k_panel)));
    const double width = turn / panels;
    double material = 0, energy = 0, length = 0;
    for (int panel = 0; panel < panels; ++panel) {
      for (const auto& [place, weight] : k_gauss) {
        const double behind = (panel + place) * width;
        const double q = std::exp(fall * behind);
        const double here = strain * q;
        const double stretched = 1.0 / (1.0 + here);
        const double moved = weight * q * stretched * stretched * (groove.arc(to.turn - behind) - from.arc);
        material -= moved;
        energy += moved * here * (1.0 + 0.5 * here);
        length += moved * (1.0 - here) * stretched;
      }
    }
    const double scale = fall * width;
    sum.held.material += scale * strain * material;
    sum.held.energy += scale * strain * energy;
    sum.length += scale * whole * whole * length;
  }
  sum.held.material /= swelling;
  return sum;
}

/// `piece` below `place`.
WoundPiece below(const GrooveArc& groove, WoundPiece piece, const GroovePlace& place, double swelling) {
  if (piece.slid) {
    const double strain = strain_of(piece.density_to, swelling) * std::exp(piece.fall * (piece.to.turn - place.turn));
    piece.to = place;
    piece.density_to = density_of(strain, swelling);
    piece.held = sliding(groove, piece.from, piece.to, strain, piece.fall, swelling).held;
    return piece;
  }
  const double share = (place.arc - piece.from.arc) / (piece.to.arc - piece.from.arc);
  piece.density_to = piece.density_from + share * (piece.density_to - piece.density_from);
  piece.to = place;
  piece.held = linear(piece.to.arc - piece.from.arc, piece.density_from, piece.density_to, swelling);
  return piece;
}

/// The bound of what slides: a strain at a place and how it falls behind it.
struct Bound {
  GroovePlace top;
  double strain = 0;
  double fall = 0;  ///< −μ: it pulls; μ: it lets go

  double at(double turn) const {
    const double bound = strain * std::exp(fall * (top.turn - turn));
    // Nothing times what overflowed: friction without end holds what is there.
    return std::isnan(bound) ? std::numeric_limits<double>::infinity() : bound;
  }
  /// Does it move what has this strain?
  bool moves(double bound_there, double there) const { return fall < 0 ? bound_there > there : bound_there < there; }
};

/// Where the bound stops moving `piece`, which it moves at its upper end; `piece.from` where it moves all.
GroovePlace cut_of(const WoundPiece& piece, const Bound& bound, double bound_at_to, const GrooveArc& groove,
                   double swelling) {
  const double to = strain_of(piece.density_to, swelling);
  const double turn = piece.to.turn - piece.from.turn;
  if (piece.slid) {
    // ln ε + f φ of both: they meet where the difference is gone.
    const double faster = bound.fall - piece.fall;
    if (faster == 0 || !(to > 0) || !(bound_at_to > 0)) return piece.from;
    const double behind = std::log(to / bound_at_to) / faster;
    if (!(behind >= 0 && behind < turn)) return piece.from;
    const double at = piece.to.turn - behind;
    return {at, std::clamp(groove.arc(at), piece.from.arc, piece.to.arc)};
  }
  const double from = strain_of(piece.density_from, swelling);
  const double bound_at_from = bound.at(piece.from.turn);
  if (bound.moves(bound_at_from, from)) return piece.from;
  const double miss_to = bound_at_to - to;
  const double miss_from = bound_at_from - from;
  if (!std::isfinite(miss_from)) return piece.to;
  const double share = miss_to / (miss_to - miss_from);
  return {piece.to.turn - share * turn, piece.to.arc - share * (piece.to.arc - piece.from.arc)};
}

}  // namespace

GrooveArc::GrooveArc(std::vector<GroovePlace> along, double beyond, double knot_beyond) : beyond_(beyond) {
  const std::size_t last = along.size() - 1;
  const auto slope = [&](std::size_t i) {
    return (along[i + 1].arc - along[i].arc) / (along[i + 1].turn - along[i].turn);
  };
  for (std::size_t i = 0; i <= last; ++i) {
    double here = slope(std::min(i, last - 1));
    if (i > 0 && i < last) {
      const double left = along[i].turn - along[i - 1].turn, right = along[i + 1].turn - along[i].turn;
      here = (slope(i - 1) * right + slope(i) * left) / (left + right);
    }
    knots_.push_back({along[i].turn, along[i].arc, here});
  }
  per_turn_ = static_cast<double>(last) / (knots_.back().turn - knots_.front().turn);
  knot_ = {knots_.front().turn - knot_beyond / beyond_, knots_.front().arc - knot_beyond};
}

double GrooveArc::arc(double turn) const {
  const Knot& first = knots_.front();
  const Knot& last = knots_.back();
  if (turn <= first.turn) return first.arc + (turn - first.turn) * beyond_;
  if (turn >= last.turn) return last.arc + (turn - last.turn) * beyond_;
  // The knots are nearly as far apart everywhere.
  std::size_t i = std::min(static_cast<std::size_t>((turn - first.turn) * per_turn_), knots_.size() - 2);
  while (knots_[i].turn > turn) --i;
  while (knots_[i + 1].turn < turn) ++i;
  const Knot& from = knots_[i];
  const Knot& to = knots_[i + 1];
  const double h = to.turn - from.turn;
  const double u = (turn - from.turn) / h;
  const double v = 1.0 - u;
  return v * v * ((1.0 + 2.0 * u) * from.arc + u * h * from.slope) + u * u * ((1.0 + 2.0 * v) * to.arc - v * h * to.slope);
}

WoundProfile::WoundProfile(std::shared_ptr<const GrooveArc> groove, double friction, const GroovePlace& take_off,
                           double density)
    : groove_(std::move(groove)), friction_(friction), home_density_(density), take_off_(take_off) {
  if (!(groove_->knot().arc < take_off.arc)) return;
  WoundPiece all{groove_->knot(), take_off, density, density, true, 0.0, {}};
  all.held = sliding(*groove_, all.from, all.to, strain_of(density, 1.0), 0.0, 1.0).held;
  pieces_.push_back(all);
}

double WoundProfile::strain(double swelling) const {
  return strain_of(pieces_.empty() ? home_density_ : pieces_.back().density_to, swelling);
}

Turned WoundProfile::turned_to(const GroovePlace& take_off, double swelling) const {
  Turned turned;
  turned.take_off = take_off;
  turned.before = take_off.arc > take_off_.arc ? take_off_ : take_off;
  std::size_t left = pieces_.size();
  while (left > 0 && pieces_[left - 1].from.arc >= turned.before.arc)
    turned.came_off += pieces_[--left].held.material;
  if (left == 0) {
    const double bottom = pieces_.empty() ? take_off_.arc : pieces_.front().from.arc;
    turned.past_knot = linear(bottom - turned.before.arc, home_density_, home_density_, swelling);
    turned.came_off += turned.past_knot.material;
    return turned;
  }
  turned.below = left - 1;
  turned.top = pieces_[left - 1];
  turned.has_top = true;
  if (turned.top.to.arc > turned.before.arc) {
    turned.came_off += turned.top.held.material;
    turned.top = below(*groove_, turned.top, turned.before, swelling);
    turned.came_off -= turned.top.held.material;
  }
  return turned;
}

Slide WoundProfile::slide(const Turned& turned, double strain, double swelling) const {
  Slide slide;
  slide.strain = strain;
  slide.below = turned.below;
  slide.rest = turned.top;
  slide.has_rest = turned.has_top;
  slide.freed = turned.came_off;
  const double laid = turned.take_off.arc - turned.before.arc;
  const double lies = turned.has_top ? strain_of(turned.top.density_to, swelling) : strain_of(home_density_, swelling);
  Bound bound{turned.before, strain, strain > lies ? -friction_ : friction_};
  const double q = laid > 0 ? std::exp(bound.fall * (turned.take_off.turn - turned.before.turn)) : 1.0;
  slide.slides = turned.has_top && bound.moves(strain * q, lies);
  bound.strain = slide.slides ? strain * q : lies;
  slide.at_before = laid > 0 ? bound.strain : strain;
  const double ratio = (1.0 + strain) / (1.0 + bound.strain);
  const double shared = slide.slides ? q * ratio * ratio : 0.0;
  if (laid > 0) {
    slide.freed -= 0.5 * laid * (density_of(bound.strain, swelling) + density_of(strain, swelling));
    slide.length = 0.5 * laid * (1.0 + shared);
  }
  if (!slide.slides) return slide;
  slide.fall = bound.fall;
  slide.cut = turned.top.from;
  double came_loose = 0;
  for (;;) {
    const double bound_there = slide.rest.to.turn == bound.top.turn ? bound.strain : bound.at(slide.rest.to.turn);
    if (!bound.moves(bound_there, strain_of(slide.rest.density_to, swelling))) {
      slide.cut = slide.rest.to;
      break;
    }
    slide.cut = cut_of(slide.rest, bound, bound_there, *groove_, swelling);
    came_loose += slide.rest.held.material;
    if (slide.cut.arc > slide.rest.from.arc) {
      slide.rest = below(*groove_, slide.rest, slide.cut, swelling);
      came_loose -= slide.rest.held.material;
      break;
    }
    slide.has_rest = slide.below > 0;
    if (!slide.has_rest) break;
    slide.rest = pieces_[--slide.below];
  }
  const SlidStretch moved = sliding(*groove_, slide.cut, turned.before, bound.strain, bound.fall, swelling);
  slide.sliding = moved.held;
  slide.freed += came_loose - moved.held.material;
  slide.length += moved.length * shared;
  return slide;
}

WoundContent WoundProfile::accept(const Turned& turned, const Slide& slide, double swelling) {
  WoundContent more{turned.past_knot.material, turned.past_knot.energy};
  for (std::size_t i = slide.below; i < pieces_.size(); ++i) {
    more.material -= pieces_[i].held.material;
    more.energy -= pieces_[i].held.energy;
  }
  pieces_.resize(slide.below);
  const auto put = [&](const WoundPiece& piece) {
    more.material += piece.held.material;
    more.energy += piece.held.energy;
    pieces_.push_back(piece);
  };
  if (slide.has_rest) put(slide.rest);
  const double at_before = density_of(slide.at_before, swelling);
  if (slide.slides && turned.before.arc > slide.cut.arc) {
    const double at_cut = slide.at_before * std::exp(slide.fall * (turned.before.turn - slide.cut.turn));
    put({slide.cut, turned.before, density_of(at_cut, swelling), at_before, true, slide.fall, slide.sliding});
  }
  if (const double laid = turned.take_off.arc - turned.before.arc; laid > 0) {
    const double now = density_of(slide.strain, swelling);
    put({turned.before, turned.take_off, at_before, now, false, 0.0, linear(laid, at_before, now, swelling)});
  }
  take_off_ = turned.take_off;
  return more;
}

}  // namespace fusee
