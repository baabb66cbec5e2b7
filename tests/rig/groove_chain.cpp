#include "rig/groove_chain.h"

#include <algorithm>
#include <cmath>

#include "fusee/base.h"

namespace fusee::rig {
namespace {

constexpr std::size_t k_table = 4096;
/// Springs turn by about this much. Half of it moves no reading of the cases by 1e-4°.
constexpr double k_spring_turn = radians(2.0);
constexpr double k_short = 0.25;  // of that: melted into the next one
/// After this many springs without sliding, the inner ones do not slide. One may have lost half its hold when cut.
constexpr int k_held = 2;
constexpr double k_most_hold = 100;  // μφ: e^100 holds everything

double hold_of(double friction, double turn) { return std::exp(std::min(k_most_hold, friction * turn)); }

}  // namespace

TurningAngle::TurningAngle(const Hull& hull) : around_(hull.around), is_helical_(hull.is_helical()) {
  const std::size_t count = hull.corners.size();
  // Half of a corner's turn belongs to each of its edges, so that the turning is even along a smooth curve. Before a
  // spiral begins, and past its end, it goes straight on.
  std::vector<double> at_corner(count + 1, 0.0);
  const auto edge = [&](std::ptrdiff_t i) -> Vec2 {
    const auto n = std::ssize(hull.corners);
    const auto from = static_cast<std::size_t>(is_helical_ ? std::clamp<std::ptrdiff_t>(i, 0, n - 2) : (i + n) % n);
    return hull.corners[(from + 1) % count] - hull.corners[from];
  };
  const auto turn = [&edge](std::ptrdiff_t corner) {
    const Vec2 before = edge(corner - 1), after = edge(corner);
    return std::atan2(cross(before, after), before.dot(after));
  };
  for (std::size_t i = 1; i <= count; ++i) {
    const auto corner = static_cast<std::ptrdiff_t>(i);
    at_corner[i] = at_corner[i - 1] + 0.5 * (turn(corner - 1) + turn(corner));
  }
  angle_.reserve(k_table + 1);
  std::size_t corner = 0;
  for (std::size_t i = 0; i <= k_table; ++i) {
    const double arc = around_ * static_cast<double>(i) / k_table;
    while (corner + 1 < count && hull.arc[corner + 1] <= arc) ++corner;
    const double end = corner + 1 < count ? hull.arc[corner + 1] : around_;
    const double edge_length = end - hull.arc[corner];
    const double share = edge_length > 0 ? std::min(1.0, (arc - hull.arc[corner]) / edge_length) : 0.0;
    angle_.push_back(at_corner[corner] + share * (at_corner[corner + 1] - at_corner[corner]));
  }
}

double TurningAngle::at(double arc) const {
  const double turns = is_helical_ ? 0.0 : std::floor(arc / around_);
  const double place = (arc / around_ - turns) * k_table;
  const auto i = std::min(k_table - 1, static_cast<std::size_t>(place));
  return turns * angle_.back() + angle_[i] + (place - static_cast<double>(i)) * (angle_[i + 1] - angle_[i]);
}

GrooveChain::GrooveChain(const Hull& hull, double knot, double take_off, double tension, double friction,
                         const Cord& cord)
    : turning_(std::make_shared<TurningAngle>(hull)),
      cord_(cord),
      friction_(friction),
      knot_(knot),
      take_off_(std::max(knot, take_off)) {
  const double turn = turn_to(take_off_) - turn_to(knot_);
  const int count = std::max(1, static_cast<int>(std::ceil(turn / k_spring_turn)));
  const double length = (take_off_ - knot_) / count;
  if (!(length > 0)) return;
  springs_.assign(static_cast<std::size_t>(count), {length, cord.material(length, tension), tension, 1.0});
}

void GrooveChain::measure() {
  const double end = turn_to(take_off_);
  double arc = knot_;
  double from = turn_to(knot_);
  double below = 0;
  Spring* inner = nullptr;
  for (Spring& spring : springs_) {
    arc += spring.length;
    const double to = turn_to(arc);
    if (inner != nullptr) inner->hold = hold_of(friction_, 0.5 * (below + to - from));
    spring.tension = cord_.tension(spring.length, spring.material);
    below = to - from;
    from = to;
    inner = &spring;
  }
  const double fresh = std::max(0.0, end - from);
  if (inner != nullptr) inner->hold = hold_of(friction_, 0.5 * (below + fresh));
  fresh_hold_ = hold_of(friction_, 0.5 * fresh);
}

void GrooveChain::reach(double take_off, double before, const Cord& cord) {
  calm_ = cord == cord_;
  cord_ = cord;
  before_ = before;
  cut_ = 0;
  fresh_ = std::max(0.0, take_off - std::max(knot_, take_off_));
  double off = std::max(0.0, take_off_ - std::max(knot_, take_off));
  while (off > 0 && !springs_.empty()) {
    Spring& last = springs_.back();
    const double share = std::min(1.0, off / last.length);
    cut_ += share * last.material;
    off -= share * last.length;
    if (share >= 1.0) {
      springs_.pop_back();
    } else {
      last.length *= 1.0 - share;
      last.material *= 1.0 - share;
      off = 0;
    }
  }
  take_off_ = std::max(knot_, take_off);
  measure();
}

// Released tendon slides outwards: each tension falls to the most that friction holds against its inner neighbour,
// while the total length is constant.
void GrooveChain::let_go(double material) {
  if (springs_.empty() || material == 0) return;
  double whole = 0;
  for (const Spring& spring : springs_) whole += spring.length;
  springs_.front().material += material;
  calm_ = false;
  const auto kept = [](const Spring& spring, double held) { return std::min(spring.tension, held); };
  const auto length_with = [&](double at_knot) {
    double length = 0;
    double held = at_knot;
    for (const Spring& spring : springs_) {
      length += cord_.length(spring.material, kept(spring, held));
      held *= spring.hold;
    }
    return length;
  };
  double low = 0;
  double high = springs_.front().tension;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (length_with(middle) > whole ? high : low) = middle;
  }
  double held = low;
  double outer = 0;
  for (Spring& spring : springs_) {
    spring.tension = kept(spring, held);
    spring.length = cord_.length(spring.material, spring.tension);
    outer += spring.length;
    held *= spring.hold;
  }
  springs_.front().length -= outer - whole;  // shorter than its material where all hangs loose
}

// From the take-off inwards, each tension is clamped to the friction limits of its outer neighbour.
double GrooveChain::slid_out(double tension, std::vector<double>* after) const {
  double outer = tension;
  double longer = 0;
  if (fresh_ > 0) {
    const double laid = fresh_tension(tension);
    outer = std::clamp(laid, outer / fresh_hold_, outer * fresh_hold_);
    longer += cord_.length(cord_.material(fresh_, laid), outer) - fresh_;
    if (after != nullptr) after->push_back(outer);
  }
  int held = 0;
  for (auto spring = springs_.rbegin(); spring != springs_.rend(); ++spring) {
    const double now = std::clamp(spring->tension, outer / spring->hold, outer * spring->hold);
    held = now == spring->tension ? held + 1 : 0;
    if (calm_ && held > k_held) break;
    longer +=
        cord_.length(spring->material, now) - spring->length;  // one that hangs loose is shorter than its material
    if (after != nullptr) after->push_back(now);
    outer = now;
  }
  return longer;
}

double GrooveChain::taken(double tension) const {
  const double laid = fresh_ > 0 ? cord_.material(fresh_, fresh_tension(tension)) : 0.0;
  return laid - cut_ - cord_.material(slid_out(tension, nullptr), tension);
}

double GrooveChain::settle(double tension) {
  std::vector<double> after;
  after.reserve(springs_.size() + 1);
  double out = slid_out(tension, &after);
  double taken = -cut_;
  auto now = after.begin();
  if (fresh_ > 0) {
    const double material = cord_.material(fresh_, fresh_tension(tension));
    taken += material;
    springs_.push_back({fresh_, material, 0.0, 1.0});
  }
  for (auto spring = springs_.rbegin(); now != after.end(); ++spring, ++now) {
    spring->length = cord_.length(spring->material, *now);
    spring->tension = *now;
  }
  // Material beyond the take-off leaves the groove; if the chain has shrunk, the same amount enters.
  const auto melt = [&] {
    const Spring last = springs_.back();
    springs_.pop_back();
    springs_.back().length += last.length;
    springs_.back().material += last.material;
  };
  while (springs_.size() > 1 && springs_.back().length < out) melt();
  if (!springs_.empty()) {
    const double material = cord_.material(out, tension);
    springs_.back().length -= out;
    springs_.back().material -= material;
    taken -= material;
    if (springs_.size() > 1) {
      const double last = take_off_ - springs_.back().length;
      const double turn = turn_to(take_off_) - turn_to(last);
      const double both = turn_to(take_off_) - turn_to(last - springs_[springs_.size() - 2].length);
      if (turn < k_short * k_spring_turn || both < 1.25 * k_spring_turn) melt();
    }
  }
  cut_ = 0;
  fresh_ = 0;
  return taken;
}

double GrooveChain::knot_tension() const { return springs_.empty() ? 0.0 : springs_.front().tension; }

double GrooveChain::material() const {
  double all = 0;
  for (const Spring& spring : springs_) all += spring.material;
  return all;
}

double GrooveChain::stored() const {
  double energy = 0;
  for (const Spring& spring : springs_)
    energy += 0.5 * spring.tension * cord_.strain_at(spring.tension) * spring.material * cord_.natural;
  return energy;
}

}  // namespace fusee::rig
