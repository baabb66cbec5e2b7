#include "fusee/joint/equilibrium.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "fusee/base/plane.h"
#include "fusee/transmission/load.h"
#include "joint/tendon_balance.h"
#include "joint/threaded_balance.h"
#include "joint/upper_span_table.h"
#include "joint/wound_profile.h"

// What is known of a tendon is how much material lies above its reference point on the pin's rim, below it, and on the
// pulley. Material crosses the reference point only by slipping. The reference stands still, so the tendon's pull on
// the joint is exactly T_up m(θ) and on the pulley exactly T_low p(α), and energy balances: with U = T²/(2 EA) per
// material, motor work − load work = stored + (T_up + U_up − T_low − U_low) · crossed + what is lost in the groove.
//
// Winding an arc ds takes ds/(1 + T_low/EA) of material: by the trapezoid over a step, with the step's own T_low.
// Paying out gives back what lies there, last first. What lies deeper slides (wound_profile.h) and gives material to
// the span or takes it, the more the further T_low goes from what it was: to the balance of the spans a longer lower
// span, of a length that depends on T_low, found together with it.
//
// The simpler law, to pay out at the tension of the moment, was tried and is wrong with friction: as tension is
// higher while winding than while paying out, each cycle carries material past the pulley, and θ creeps by 0.005° a
// cycle (EA 31 kN, 5 N on both, μ 0.15; 0.18° at EA 850 N) for ever, where the profile settles within three cycles.

namespace fusee {
namespace {

/// Both tendons slack by more than this together: the joint has play. mm
constexpr double k_least_play = 1e-6;
/// Searches for what slides on the pulleys, and for the ratio of a tendon's tensions over a pin that gives way. Two or
/// three do; where a tendon sticks on such a pin each leaves the give's share of the compliance, and where what slides
/// turns round it may take some halving.
constexpr int k_rounds = 40;
constexpr double k_least_strain = 1e-14;
/// The first search, and the last ones by single steps, which square the miss.
constexpr double k_rough_step = 1e-5;   // rad
constexpr double k_newton_step = 1e-3;  // rad
constexpr int k_newton_rounds = 6;
/// The same before the joint's place was searched for: from row to row it is mostly nearer than this to where it is
/// looked for.
constexpr double k_glide = 0.02;  // rad
/// Dry friction that goes by the tendons' pull is found to this share of itself, or in so many rounds more.
constexpr double k_near_dry = 1e-4;
constexpr int k_rubbing_rounds = 6;
/// Tendons at less hold nothing: what rounding leaves in one that just pushed a loose joint along. N
constexpr double k_least_hold = 1e-4;
/// Before the place where a tendon leaves its drum. rad
constexpr double k_hair = 1e-9;
/// A joint that moves is pulled by its friction, but for this share.
constexpr double k_rounding = 1e-6;

double energy_per_material(double tension, double EA) { return 0.5 * tension * tension / EA; }

/// A sheath holds at so many places, each in the middle of its part (threaded_balance.h). One without friction is one
/// place, and as good as none.
std::size_t bends_of(const SheathLoad& sheath) { return sheath.log_ratio > 0 ? ThreadedSpans::k_bends : 1; }
/// What each of both spans has of what lies in the sheath; of the pieces between bends each has twice that.
double end_share(const SheathLoad& sheath) { return 0.5 / static_cast<double>(bends_of(sheath)); }

/// So is its give shared, a spring of each span, at home as it was mounted. A spring of c N⁻¹ is to its span as EA c of
/// tendon that no temperature and no creep reaches (see Give).
struct SheathShare {
  double length = 0;
  double unseen = 0;
  double mounted = 0;  ///< by how much the spring is longer at home than without tension

  SheathShare(const SheathLoad& sheath, double share, double EA, double home)
      : length(share * sheath.length),
        unseen(share * sheath.compliance * EA),
        mounted(share * sheath.compliance * home) {}
};

/// Of what lies between the bends of a sheath, from the joint to the pulley.
struct InSheath {
  std::array<double, ThreadedSpans::k_bends - 1> material{};
  std::array<double, ThreadedSpans::k_bends - 1> tension{};
  std::array<int, ThreadedSpans::k_bends> slides{};  ///< at the last step
};

/// One tendon in its right-hand image, with its history.
struct TendonHistory {
  Side side = Side::left;
  double rim_reference = 0;  ///< normal of the point of the rim between upper and lower part, rad
  double upper_material = 0;
  double lower_material = 0;
  InSheath sheath;
  WoundProfile wound;
  /// What lies on the joint's drum, seen from the link, where it rubs there; else that is a part of the upper span.
  std::optional<WoundProfile> on_drum;
  double behind_drum = 0;  ///< straight, from the drum to the tendon's end
  double upper = 0;        ///< tensions at the last step
  double lower = 0;
  double home = 0;       ///< tension at home, N
  Vec2 home_push{0, 0};  ///< on its pin at home, which stands there as declared, N
  double ratio = 1;      ///< lower per upper tension that Give is seen with
  double strained = 0;   ///< by how much the strain of the lower span grew in the last step
};

/// A tendon's directions at its pin, away from it, and what it pushes the pin with.
struct AtPin {
  Vec2 up, down;

  AtPin(double upper_normal, double lower_normal)
      : up(-std::sin(upper_normal), std::cos(upper_normal)), down(std::sin(lower_normal), -std::cos(lower_normal)) {}
  Vec2 push(double upper, double lower) const { return upper * up + lower * down; }
};

/// A pin that gives way by c N⁻¹ takes up·d and down·d from the path's two parts, d = c (push − home's): to first
/// order, with the moment arms of the pin where it was. By the span's own tension that is a spring behind it, and as EA
/// times its compliance is a length of tendon that nobody sees, no equation changes: both spans get their `unseen`
/// length of path and material. The tension of the other span acts by its ratio to this one's, which the step finds by
/// repeating.
struct Give {
  double upper_unseen = 0;
  double lower_unseen = 0;
  double upper_length = 0;  ///< by what home's push no longer takes
  double lower_length = 0;

  Give() = default;
  Give(const AtPin& at, const TendonHistory& tendon, double per_newton, double EA) {
    const double across = at.up.dot(at.down);
    upper_unseen = per_newton * EA * (1.0 + across * tendon.ratio);
    lower_unseen = per_newton * EA * (1.0 + across / tendon.ratio);
    upper_length = per_newton * at.up.dot(tendon.home_push);
    lower_length = per_newton * at.down.dot(tendon.home_push);
  }
};

/// A tendon at the pulley angle of a step, before θ is known.
struct AtAlpha {
  LowerPath path;
  double lower_length = 0;  ///< of the span, from the rim's reference
  double swelling = 1;      ///< 1 + expansion: of material since home
  Spans spans;              ///< all but the upper length and the capstan factor, without what comes from the pulley
  Turned turned;
  Slide slide;       ///< what slides on the pulley, at a strain near the one that will be found
  double moved = 0;  ///< by how much the search last moved that strain
};

/// The drum as a groove that turns with the link: from the tendon's end to where the span takes off. A tendon that is
/// free of it has nothing there.
GroovePlace place_on_drum(const PinPlace& place, double on_drum, double behind) {
  return {on_drum, on_drum > 0 ? place.drum * on_drum : -behind};
}

GroovePlace place_of(Side side, const LowerPath& path, double alpha) {
  return {path.normal + mirror_sign(side) * alpha, path.wound};
}

AtAlpha at_alpha(const TendonHistory& tendon, const LowerPath& path, const JointModel& model, const JointStep& step) {
  const PinPlace& pin = model.pins[tendon.side == Side::left ? 0 : 1];
  const double expansion = step.tendon.expansion[tendon.side == Side::left ? 0 : 1];
  AtAlpha at;
  at.path = path;
  at.lower_length = path.reach + pin.rho * (tendon.rim_reference - pin.off_pin(path.normal)) +
                    end_share(model.sheath) * model.sheath.length;
  at.swelling = 1.0 + expansion;
  at.spans.EA = model.EA;
  at.spans.upper_material = at.swelling * tendon.upper_material;
  at.spans.lower_length = at.lower_length;
  at.spans.lower_material = at.swelling * tendon.lower_material;
  at.turned = tendon.wound.turned_to(place_of(tendon.side, path, step.alpha), at.swelling);
  // Mostly the strain goes on as it went.
  const double last = tendon.wound.strain(at.swelling);
  at.slide = tendon.wound.slide(at.turned, std::max(0.5 * last, last + tendon.strained), at.swelling);
  return at;
}

void give_way(Spans& spans, const SheathShare& sheath) {
  spans.upper_length += sheath.unseen + sheath.mounted;
  spans.upper_material += sheath.unseen;
  spans.lower_length += sheath.unseen + sheath.mounted;
  spans.lower_material += sheath.unseen;
}

void give_way(Spans& spans, const Give& give) {
  spans.upper_length += give.upper_unseen + give.upper_length;
  spans.upper_material += give.upper_unseen;
  spans.lower_length += give.lower_unseen + give.lower_length;
  spans.lower_material += give.lower_unseen;
}

/// A span of a tendon whose waves straighten, about the tension `pull`: to first order a spring of the compliance
/// waves.slope(pull), which is to the span as EA times that of tendon that no temperature reaches (see Give).
Spans with_waves(Spans spans, const CableStiffening& waves, double pull, double home) {
  const double slope = waves.slope(pull), unseen = slope * spans.EA;
  spans.upper_length += unseen + slope * pull + waves.gained(home) - waves.gained(pull);
  spans.upper_material += unseen;
  return spans;
}

/// With what slides on the pulley as a part of the lower span: exact in value and slope at the slide's own strain.
Spans with_slide(Spans spans, const AtAlpha& at) {
  spans.lower_length += at.slide.length;
  spans.lower_material += at.swelling * at.slide.freed + at.slide.length / (1.0 + at.slide.strain);
  return spans;
}

/// How near a slide's strain has to be to the one found with it.
double near_strain(const JointModel& model) { return std::max(model.last_step, k_least_strain); }

/// Slides by the strain that is expected `next`. Was it already as by the one that was found `now`: by its strain, or
/// because what it gives up to there is what its span said of it?
///
/// Newton's steps; where they swing back they run in circles round a kink (what slides turns round), and half of one
/// breaks the circle.
bool slide_found(AtAlpha& at, const WoundProfile& wound, double now, double next, const JointModel& model) {
  const double near = near_strain(model);
  const double strain = at.slide.strain, freed = at.slide.freed, length = at.slide.length;
  const bool same = std::abs(now - strain) <= near;
  double by = std::max(next, 0.0) - strain;
  if (std::abs(by) <= near) return same;
  const bool swings = by * at.moved < 0 && std::abs(by) > 0.5 * std::abs(at.moved);
  if (swings) by *= 0.5;
  at.moved = by;
  at.slide = wound.slide(at.turned, strain + by, at.swelling);
  const double said = length * (1.0 / (1.0 + strain) - 1.0 / (1.0 + at.slide.strain));
  const double missed = std::abs(at.swelling * (at.slide.freed - freed) - said);
  return same || (!swings && missed <= model.last_step * at.path.p);
}

/// Spans with what lies in a sheath of friction.
struct Threaded {
  ThreadedSpans spans;
  ThreadedBalance slid;
};

/// What rubs on the joint's drum.
struct Rubbing {
  Turned turned;
  Slide slide;
};

/// A tendon at a trial θ. What few joints have is not copied with those of the others.
struct Trial {
  UpperSpanTable::Look span;
  double upper_length = 0;  ///< of the path
  Spans spans;
  std::unique_ptr<Threaded> threaded;  ///< the same spans, where friction in a sheath holds
  std::unique_ptr<Rubbing> on_drum;    ///< where the tendon rubs there
  TendonBalance balance;
  double wrap = 0;
  double pull = 0;         ///< on the joint, towards the tendon's own side: T_up m
  double slope = 0;        ///< of pull with respect to the image's θ
  double lower_slope = 0;  ///< of the lower span's tension
};

/// The spans with the pieces of tendon between the bends of their sheath.
ThreadedSpans threaded(const Spans& spans, const TendonHistory& tendon, const JointModel& model, double swelling) {
  const SheathShare piece(model.sheath, 2.0 * end_share(model.sheath), spans.EA, tendon.home);
  ThreadedSpans all;
  all.EA = spans.EA;
  all.holds.fill(model.sheath.log_ratio / ThreadedSpans::k_bends);
  all.length.fill(piece.length + piece.unseen + piece.mounted);
  all.length.front() = spans.upper_length;
  all.length.back() = spans.lower_length;
  all.material.front() = spans.upper_material;
  all.material.back() = spans.lower_material;
  for (std::size_t i = 0; i < tendon.sheath.material.size(); ++i)
    all.material[i + 1] = swelling * tendon.sheath.material[i] + piece.unseen;
  return all;
}

/// What is seen of it from both ends.
TendonBalance from_ends(const ThreadedBalance& slid) {
  return {slid.tension.front(), slid.tension.back(), slid.crossed.front(),
          slid.contact,         slid.per_length,     slid.per_hold};
}

/// What rubs on the drum is to the upper span what slides on the pulley is to the lower one; `balanced` gives the
/// strain that the span then has. Newton's steps, halved where a kink throws them back.
template <typename Balanced>
void rub_on_drum(Trial& trial, const TendonHistory& tendon, const AtAlpha& at, const JointModel& model,
                 Balanced balanced) {
  const PinPlace& pin = model.pins[tendon.side == Side::left ? 0 : 1];
  const GroovePlace takes_off = place_on_drum(pin, trial.span.on_drum, tendon.behind_drum);
  trial.upper_length -= takes_off.arc + tendon.behind_drum;
  const double length = trial.spans.upper_length - takes_off.arc - tendon.behind_drum;
  const double material = trial.spans.upper_material;
  trial.on_drum = std::make_unique<Rubbing>(Rubbing{tendon.on_drum->turned_to(takes_off, at.swelling), {}});
  double strain = tendon.on_drum->strain(at.swelling), moved = 0;
  for (int i = 0; i < k_rounds; ++i) {
    const Slide& slide = trial.on_drum->slide = tendon.on_drum->slide(trial.on_drum->turned, strain, at.swelling);
    trial.spans.upper_length = length + slide.length;
    trial.spans.upper_material = material + at.swelling * slide.freed + slide.length / (1.0 + strain);
    double by = balanced() - strain;
    if (std::abs(by) <= near_strain(model)) return;
    if (by * moved < 0 && std::abs(by) > 0.5 * std::abs(moved)) by *= 0.5;
    moved = by;
    strain += by;
  }
}

Trial tried(const TendonHistory& tendon, const AtAlpha& at, const UpperSpanTable& upper, const JointModel& model,
            double theta) {
  const PinPlace& pin = model.pins[tendon.side == Side::left ? 0 : 1];
  const double off_pin = pin.off_pin(at.path.normal);
  const SheathShare sheath(model.sheath, end_share(model.sheath), at.spans.EA, tendon.home);
  Trial trial;
  trial.span = upper.at(mirror_sign(tendon.side) * theta);
  trial.spans = with_slide(at.spans, at);
  trial.upper_length = trial.spans.upper_length = trial.span.length - pin.rho * tendon.rim_reference + sheath.length;
  if (model.pin_give > 0)
    give_way(trial.spans, Give({trial.span.normal, off_pin}, tendon, model.pin_give, at.spans.EA));
  if (model.sheath.compliance > 0) give_way(trial.spans, sheath);
  trial.wrap = trial.span.normal - off_pin;
  const double on_pin = model.guide.log_ratio(trial.wrap);
  if (bends_of(model.sheath) > 1) trial.threaded = std::make_unique<Threaded>();
  const auto balance_once = [&] {
    if (trial.threaded) {
      ThreadedSpans& spans = trial.threaded->spans = threaded(trial.spans, tendon, model, at.swelling);
      spans.holds.front() += on_pin;
      trial.threaded->slid = balance(spans, tendon.sheath.slides);
      trial.balance = from_ends(trial.threaded->slid);
    } else {
      trial.spans.capstan = std::exp(on_pin);
      trial.balance = balance(trial.spans);
    }
    return trial.balance.upper;
  };
  const auto balanced = [&] {
    if (!(model.waves.most > 0)) return balance_once() / at.spans.EA;
    // The spring stiffens as it is pulled, so that Newton's steps come from one side.
    const Spans straight = trial.spans;
    double pull = tendon.upper;
    for (int i = 0; i < k_rounds; ++i) {
      trial.spans = with_waves(straight, model.waves, pull, tendon.home);
      const double next = balance_once();
      if (std::abs(next - pull) <= near_strain(model) * at.spans.EA) break;
      pull = next;
    }
    return trial.balance.upper / at.spans.EA;
  };
  if (tendon.on_drum)
    rub_on_drum(trial, tendon, at, model, balanced);
  else
    balanced();
  const double m = trial.span.m;
  trial.pull = trial.balance.upper * m;
  double rate = -m * trial.balance.per_length;  // dL/dθ = −m
  if (trial.wrap > 0) rate += trial.balance.per_capstan * model.guide.slope(trial.wrap) * trial.span.dnormal;
  trial.slope = rate * m + trial.balance.upper * trial.span.dm;
  if (trial.threaded)
    trial.lower_slope = rate * trial.threaded->slid.lower_per_upper;
  else if (trial.balance.crossed != 0 && trial.balance.upper > 0)
    trial.lower_slope = rate * trial.balance.lower / trial.balance.upper;
  return trial;
}

struct Residual {
  double value = 0;
  double slope = 0;
};

/// A root of a function that falls from `least` to `most`: Newton's steps, kept within what is known to enclose it.
/// Where it is not known yet, steps grow towards the end; the last one is shorter than `last_step`. Null when the
/// function does not change its sign.
template <typename Function>
std::optional<double> fallen_to_zero(double start, double least, double most, double last_step, Function function) {
  double low = least;
  double high = most;
  bool low_seen = false;
  bool high_seen = false;
  double stride = 0.01;
  double x = std::clamp(start, least, most);
  for (int i = 0; i < 200; ++i) {
    const Residual at = function(x);
    if (at.value == 0) return x;
    const bool falls = at.value > 0;
    (falls ? low : high) = x;
    (falls ? low_seen : high_seen) = true;
    if ((falls && x >= most) || (!falls && x <= least)) return std::nullopt;
    double next = at.slope < 0 ? x - at.value / at.slope : x + (falls ? stride : -stride);
    if (low_seen && high_seen) {
      // Kinks can make Newton's steps run in circles: now and then a step halves what is left.
      if (!(next > low && next < high) || i % 12 > 9) next = 0.5 * (low + high);
    } else {
      next = std::clamp(next, x - stride, x + stride);
      next = falls ? std::min(std::max(next, x), most) : std::max(std::min(next, x), least);
      stride *= 2.0;
    }
    // Newton's steps square the miss, but for a kink in between.
    if (std::abs(next - x) <= last_step || !(high - low > last_step)) return next;
    x = next;
  }
  return x;
}

/// Between a drum and the tendon's end there is as much at every angle at which the tendon lies on the drum.
double straight_behind(const PinPlace& place) {
  const auto leaves = lift_off(place);
  return leaves ? upper_span(place, *leaves - k_hair).behind_drum : 0.0;
}

/// Samples of the groove over the range: its radius changes little from one to the next.
constexpr int k_groove_places = 64;

/// The groove of one tendon as the pulley's turning lays it open.
std::shared_ptr<const GrooveArc> groove_of(const JointModel& model, Side side) {
  const bool right = side == Side::right;
  const double from = right ? model.alpha_least : model.alpha_most;
  const double to = right ? model.alpha_most : model.alpha_least;
  std::vector<GroovePlace> along;
  for (int i = 0; i <= k_groove_places; ++i) {
    const double alpha = from + (to - from) * i / k_groove_places;
    const LowerPath path = model.lower(alpha)[right ? 1 : 0];
    const GroovePlace place = place_of(side, path, alpha);
    if (!std::isfinite(place.arc)) continue;
    if (!along.empty() && !(place.turn > along.back().turn && place.arc > along.back().arc)) continue;
    along.push_back(place);
  }
  // What turns inward all along is no groove, and no pulley; who asks all the same is told of a round one.
  if (along.size() < 2) {
    const LowerPath home = model.lower(0.0)[right ? 1 : 0];
    const GroovePlace place = place_of(side, home, 0.0);
    along = {place, {place.turn + 1.0, place.arc + std::abs(home.p)}};
  }
  return std::make_shared<const GrooveArc>(std::move(along), model.knots_beyond[right ? 1 : 0]);
}

TendonHistory at_home(Side side, const JointModel& model, const LowerPath& path, double tension) {
  const PinPlace& place = model.pins[side == Side::left ? 0 : 1];
  const UpperSpan span = upper_span(place, 0.0);
  TendonHistory tendon;
  tendon.side = side;
  const double off_pin = place.off_pin(path.normal), in_sheath = end_share(model.sheath) * model.sheath.length;
  tendon.rim_reference = 0.5 * (span.normal + off_pin);
  const double density = 1.0 / (1.0 + tension / model.EA);
  double free = span.free;
  if (model.drum_friction > 0 && place.drum > 0) {
    tendon.behind_drum = straight_behind(place);
    const GroovePlace takes_off = place_on_drum(place, span.on_drum, tendon.behind_drum);
    const auto drum = std::make_shared<const GrooveArc>(GrooveArc::round(place.drum, tendon.behind_drum));
    tendon.on_drum = WoundProfile(drum, model.drum_friction, takes_off, density);
    free -= takes_off.arc + tendon.behind_drum;
  }
  tendon.upper_material =
      density * (free + place.rho * (span.normal - tendon.rim_reference) + in_sheath) + 0.5 * model.slack;
  tendon.lower_material =
      density * (path.reach + place.rho * (tendon.rim_reference - off_pin) + in_sheath) + 0.5 * model.slack;
  tendon.sheath.material.fill(density * 2.0 * in_sheath);
  tendon.sheath.tension.fill(tension);
  tendon.wound = WoundProfile(groove_of(model, side), model.groove_friction, place_of(side, path, 0.0), density);
  tendon.upper = tendon.lower = tendon.home = tension;
  tendon.home_push = AtPin(span.normal, off_pin).push(tension, tension);
  return tendon;
}

/// What the pulley takes in with the tendon that is wound and what it gives with the material that slides out, at the
/// take-off's strain of the step's beginning and end, less what it holds more. What slides out by dM at strain ε takes
/// EA (ε + ε²/2) dM of work.
struct Wound {
  double energy = 0;  ///< that it holds more
  double friction = 0;
};

Wound wind(WoundProfile& wound, const Turned& turned, const Slide& slide, double swelling, double EA) {
  const double before = wound.strain(swelling);
  const double now = slide.strain;
  const double arc = turned.take_off.arc - wound.take_off().arc;
  const auto mean = [&](auto of) { return 0.5 * (of(before) + of(now)); };
  const double laid = arc * mean([](double strain) { return 1.0 / (1.0 + strain); });
  const double energy = arc * mean([](double strain) { return 0.5 * strain * strain / (1.0 + strain); });
  const double work = mean([](double strain) { return strain * (1.0 + 0.5 * strain); });
  const double more = EA * wound.accept(turned, slide, swelling).energy;
  return {more, EA * (work * (swelling * slide.freed + laid) + energy) - more};
}

/// Work that a tendon at the tension `t` brings with material that crosses to it.
double head(double t, double EA) { return t + energy_per_material(t, EA); }

/// What is lost at every bend of a sheath, and what its pieces then are.
double pull_through(TendonHistory& tendon, const Threaded& threaded, double swelling) {
  const double EA = threaded.spans.EA;
  const ThreadedBalance& now = threaded.slid;
  InSheath& sheath = tendon.sheath;
  std::array<double, ThreadedSpans::k_bends + 1> before{};
  before.front() = tendon.upper;
  before.back() = tendon.lower;
  std::copy(sheath.tension.begin(), sheath.tension.end(), before.begin() + 1);
  double lost = 0;
  for (std::size_t j = 0; j < now.crossed.size(); ++j) {
    const double then = head(before[j], EA) - head(before[j + 1], EA);
    lost += 0.5 * (then + head(now.tension[j], EA) - head(now.tension[j + 1], EA)) * now.crossed[j];
  }
  for (std::size_t i = 0; i < sheath.material.size(); ++i) {
    sheath.material[i] += (now.crossed[i + 1] - now.crossed[i]) / swelling;
    sheath.tension[i] = now.tension[i + 1];
  }
  sheath.slides = now.slides;
  return lost;
}

/// What a tendon's step did with energy.
struct Spent {
  double wound = 0;  ///< energy that went onto pulley and drum (negative: came off)
  double friction = 0;
  double groove_friction = 0;
};

/// Takes a trial as what happened; what slides, but for `near`.
Spent settle(TendonHistory& tendon, AtAlpha& at, const Trial& trial, double near) {
  const double EA = at.spans.EA;
  const TendonBalance& now = trial.balance;
  const Threaded* threaded = trial.threaded.get();
  const double to_joint = threaded ? threaded->slid.crossed.back() : now.crossed;  // out of the lower span
  if (std::abs(at.slide.strain - now.lower / EA) > near)
    at.slide = tendon.wound.slide(at.turned, now.lower / EA, at.swelling);
  const Wound on_pulley = wind(tendon.wound, at.turned, at.slide, at.swelling, EA);
  Spent spent{on_pulley.energy, 0, on_pulley.friction};
  const auto dropped = [EA](double upper, double lower) { return head(upper, EA) - head(lower, EA); };
  spent.friction = threaded ? pull_through(tendon, *threaded, at.swelling)
                            : 0.5 * (dropped(tendon.upper, tendon.lower) + dropped(now.upper, now.lower)) * now.crossed;
  tendon.upper_material += now.crossed / at.swelling;
  if (tendon.on_drum) {
    const Wound on_drum = wind(*tendon.on_drum, trial.on_drum->turned, trial.on_drum->slide, at.swelling, EA);
    tendon.upper_material += trial.on_drum->slide.freed;
    spent.wound += on_drum.energy;
    spent.friction += on_drum.friction;
  }
  tendon.lower_material = (at.spans.lower_material - to_joint) / at.swelling + at.slide.freed;
  tendon.strained = (now.lower - tendon.lower) / EA;
  tendon.upper = now.upper;
  tendon.lower = now.lower;
  return spent;
}

TendonState state_of(const TendonHistory& tendon, const AtAlpha& at, const Trial& trial) {
  TendonState state;
  state.upper = trial.balance.upper;
  state.lower = trial.balance.lower;
  state.end = tendon.on_drum ? at.spans.EA * tendon.on_drum->strain_at_knot(at.swelling) : state.upper;
  state.wrap = trial.wrap;
  state.contact = trial.balance.contact;
  for (const double stretch : {trial.upper_length - at.swelling * tendon.upper_material,
                               at.lower_length - at.swelling * tendon.lower_material}) {
    (stretch > 0 ? state.stretch : state.slack) += std::abs(stretch);
  }
  return state;
}

double energy_of_pieces(const TendonHistory& tendon, double EA) {
  double sum = 0;
  for (std::size_t i = 0; i < tendon.sheath.material.size(); ++i)
    sum += tendon.sheath.material[i] * energy_per_material(tendon.sheath.tension[i], EA);
  return sum;
}

double energy_of_spans(const TendonHistory& tendon, const JointModel& model) {
  const double EA = model.EA;
  const double inside = bends_of(model.sheath) > 1 ? energy_of_pieces(tendon, EA) : 0.0;
  return inside + model.waves.energy(tendon.upper) + tendon.upper_material * energy_per_material(tendon.upper, EA) +
         tendon.lower_material * energy_per_material(tendon.lower, EA);
}

/// Above that of home, where the pin gives way already.
double energy_of_pin(const TendonHistory& tendon, const AtAlpha& at, const Trial& trial, const JointModel& model) {
  if (!(model.pin_give > 0)) return 0;
  const PinPlace& place = model.pins[tendon.side == Side::left ? 0 : 1];
  const AtPin pin(trial.span.normal, place.off_pin(at.path.normal));
  return 0.5 * model.pin_give * (pin.push(tendon.upper, tendon.lower).squaredNorm() - tendon.home_push.squaredNorm());
}

/// The same of its sheath, every part of which gives way to the tension in it.
double energy_of_sheath(const TendonHistory& tendon, const SheathLoad& sheath) {
  if (!(sheath.compliance > 0)) return 0;
  const double share = end_share(sheath), at_home = tendon.home * tendon.home;
  double sum = share * (tendon.upper * tendon.upper + tendon.lower * tendon.lower - 2.0 * at_home);
  if (bends_of(sheath) > 1) {
    for (const double inside : tendon.sheath.tension) sum += 2.0 * share * (inside * inside - at_home);
  }
  return 0.5 * sheath.compliance * sum;
}

/// Where a joint comes to rest.
struct Rest {
  double theta = 0;
  double held = 0;     ///< by its bearing against what pulls it, N·mm
  bool stays = false;  ///< where it was
  std::array<Trial, 2> trials = {};
};

}  // namespace

struct JointMotion::State {
  JointModel model;
  std::array<TendonHistory, 2> tendons;
  std::array<double, 2> released{};  ///< so far, mm
  double theta = 0;
  bool loose = false;       ///< at the last step
  double dry = 0;           ///< friction that holds the joint, N·mm
  double expected = 0;      ///< model.expected at the last step
  double wound_energy = 0;  ///< since home
  double home_energy = 0;
  double friction = 0;
  double groove_friction = 0;

  explicit State(JointModel joint);
  /// Pull of the tendons beyond the load, towards +θ.
  Residual residual(const std::array<Trial, 2>& trials, const JointStep& step, double at_theta) const;
  std::array<Trial, 2> trials(const std::array<AtAlpha, 2>& at, double at_theta) const;
  std::optional<Rest> balanced(const std::array<AtAlpha, 2>& at, const JointStep& step, double start,
                               double last_step) const;
  std::optional<Rest> settled(std::array<AtAlpha, 2>& at, const JointStep& step, double start);
  std::optional<Rest> rubbed(std::array<AtAlpha, 2>& at, const JointStep& step, double start);
  bool consistent(std::array<AtAlpha, 2>& at, const std::array<Trial, 2>& now, double move);
  bool is_loose(const EquilibriumPoint& point, const std::array<Trial, 2>& now) const;
  EquilibriumPoint accept(std::array<AtAlpha, 2>& at, const JointStep& step, const Rest& rest);
  EquilibriumPoint refuse(const JointStep& step) const;
};

JointMotion::State::State(JointModel joint) : model(std::move(joint)) {
  const std::array<LowerPath, 2> paths = model.lower(0.0);
  const double arm1 = upper_span(model.pins[0], 0.0).m;
  const double arm2 = upper_span(model.pins[1], 0.0).m;
  tendons[0] = at_home(Side::left, model, paths[0], model.pretension);
  tendons[1] = at_home(Side::right, model, paths[1], model.pretension * arm1 / arm2);
  expected = model.expected(0.0);
  dry = model.dry_friction(model.pretension, model.pretension * arm1 / arm2);
  for (const TendonHistory& tendon : tendons) home_energy += energy_of_spans(tendon, model);
}

std::array<Trial, 2> JointMotion::State::trials(const std::array<AtAlpha, 2>& at, double at_theta) const {
  return {tried(tendons[0], at[0], model.upper->left, model, at_theta),
          tried(tendons[1], at[1], model.upper->right, model, at_theta)};
}

Residual JointMotion::State::residual(const std::array<Trial, 2>& trials, const JointStep& step,
                                      double at_theta) const {
  const auto& [left, right] = trials;
  return {right.pull - left.pull - step.tip_force * model.lever - step.torque - model.own_torque(at_theta),
          right.slope + left.slope - model.own_slope(at_theta)};
}

/// With what slides on the pulleys as `at` has it.
std::optional<Rest> JointMotion::State::balanced(const std::array<AtAlpha, 2>& at, const JointStep& step, double start,
                                                 double last_step) const {
  // Its bearing holds the joint as long as it is not pulled by more; then it moves on until it is pulled by that much.
  double held = 0;
  const auto pull = [&](double at_theta) {
    Residual beyond = residual(trials(at, at_theta), step, at_theta);
    beyond.value -= held;
    return beyond;
  };
  // A joint that nothing pulls stays where it is, and one that is loose is only pushed; any other keeps its deviation
  // from where it is expected.
  if (theta > model.theta_least && theta < model.theta_most) {
    const double here = pull(theta).value;
    if (std::abs(here) <= dry) return Rest{theta, 0, true};
    held = std::copysign(dry, here);
    if (loose || dry > 0) start = theta;
  }
  const auto found = fallen_to_zero(start, model.theta_least, model.theta_most, last_step, pull);
  if (!found) return std::nullopt;
  return Rest{*found, held, false};
}

/// What slides on both pulleys, and where pins give way the ratios of both tendons' tensions, taken as they will be
/// when the joint has moved on by `move`; were they so already?
bool JointMotion::State::consistent(std::array<AtAlpha, 2>& at, const std::array<Trial, 2>& now, double move) {
  constexpr double near_ratio = 1e-7;
  bool same = true;
  for (std::size_t i = 0; i < 2; ++i) {
    const TendonBalance& balance = now[i].balance;
    const double next = balance.lower + mirror_sign(tendons[i].side) * move * now[i].lower_slope;
    const double EA = at[i].spans.EA;
    same = slide_found(at[i], tendons[i].wound, balance.lower / EA, next / EA, model) && same;
    if (!(model.pin_give > 0 && balance.upper > 0 && balance.lower > 0)) continue;
    const double ratio = balance.lower / balance.upper;
    if (std::abs(ratio - tendons[i].ratio) <= near_ratio) continue;
    tendons[i].ratio = ratio;
    same = false;
  }
  return same;
}

/// The joint's place and what slides, found together, both by a step of Newton's each. Where that does not do (a kink,
/// a bearing that holds, nothing that holds) one after the other.
std::optional<Rest> JointMotion::State::settled(std::array<AtAlpha, 2>& at, const JointStep& step, double start) {
  bool searched = false;
  const auto search = [&](double from) {
    const double exactly = std::exchange(searched, true) ? model.last_step : std::max(model.last_step, k_rough_step);
    return balanced(at, step, from, exactly);
  };
  // Where pins give way there may be two places that hold, and the search finds the one that is in keeping.
  const bool first_search = loose || dry > 0 || model.pin_give > 0;
  auto rest =
      first_search ? search(start) : std::optional(Rest{std::clamp(start, model.theta_least, model.theta_most)});
  for (int i = 0; i < k_rounds && rest; ++i) {
    rest->trials = trials(at, rest->theta);
    const Residual beyond = residual(rest->trials, step, rest->theta);
    const double move = beyond.slope < 0 && !rest->stays ? -(beyond.value - rest->held) / beyond.slope : 0.0;
    const bool same = consistent(at, rest->trials, move);
    const bool held = std::max(rest->trials[0].balance.upper, rest->trials[1].balance.upper) >= k_least_hold;
    if (!searched && !(held && beyond.slope < 0 && std::abs(move) <= k_glide)) {
      rest = search(start);
      continue;
    }
    if (same && std::abs(move) <= model.last_step) return rest;
    if (rest->stays || (searched && std::abs(move) > k_newton_step) || i >= k_newton_rounds)
      rest = search(rest->theta);
    else
      rest->theta += move;
  }
  if (rest) rest->trials = trials(at, rest->theta);
  return rest;
}

/// Settled, with as much dry friction as the tendons' pull asks for there.
std::optional<Rest> JointMotion::State::rubbed(std::array<AtAlpha, 2>& at, const JointStep& step, double start) {
  std::optional<Rest> rest = settled(at, step, start);
  for (int i = 0; i < k_rubbing_rounds && rest; ++i) {
    const double due = model.dry_friction(rest->trials[0].balance.upper, rest->trials[1].balance.upper);
    if (std::abs(due - dry) <= k_near_dry * due) break;
    dry = due;
    rest = settled(at, step, start);
  }
  return rest;
}

/// Nothing but its bearing's friction keeps the joint where it is in its play. That is no hold: a joint was named whose
/// friction of 0.007 N·mm made rows sure that without it rest anywhere (four false groups of 34 on wide joints).
bool JointMotion::State::is_loose(const EquilibriumPoint& point, const std::array<Trial, 2>& now) const {
  const auto hardly_pulls = [&](const TendonState& tendon, const Trial& trial) {
    const double held = dry > 0 ? (1.0 + k_rounding) * dry / trial.span.m : 0.0;
    return tendon.upper < k_least_hold + held;
  };
  if (!hardly_pulls(point.t1, now[0]) || !hardly_pulls(point.t2, now[1])) return false;
  // What keeps a tendon taut until the friction is used up is given back before the play begins.
  const double taken_up = dry > 0 ? point.t1.stretch + point.t2.stretch : 0.0;
  return point.t1.slack + point.t2.slack - taken_up > k_least_play;
}

EquilibriumPoint JointMotion::State::accept(std::array<AtAlpha, 2>& at, const JointStep& step, const Rest& rest) {
  const std::array<Trial, 2>& now = rest.trials;
  const double found = rest.theta;
  EquilibriumPoint point;
  point.alpha = step.alpha;
  point.load_torque = step.tip_force * model.lever + step.torque + model.own_torque(found);
  friction += dry * std::abs(found - theta);
  point.theta = theta = found;
  point.stiffness = point.stiffness_stuck = model.own_slope(found);
  for (std::size_t i = 0; i < 2; ++i) {
    const Spent spent = settle(tendons[i], at[i], now[i], near_strain(model));
    wound_energy += spent.wound;
    friction += spent.friction;
    groove_friction += spent.groove_friction;
    point.stored += energy_of_spans(tendons[i], model) + energy_of_pin(tendons[i], at[i], now[i], model) +
                    energy_of_sheath(tendons[i], model.sheath);
    (i == 0 ? point.t1 : point.t2) = state_of(tendons[i], at[i], now[i]);
    const double m = now[i].span.m;
    const double geometric = now[i].balance.upper * now[i].span.dm;
    point.stiffness_stuck += stuck_rate(now[i].spans, now[i].balance) * m * m - geometric;
    const Threaded* threaded = now[i].threaded.get();
    const double passing =
        threaded ? sliding_rate(threaded->spans, threaded->slid) : sliding_rate(now[i].spans, now[i].balance);
    point.stiffness += passing * m * m - geometric;
  }
  point.motor_torque = point.t2.lower * at[1].path.p - point.t1.lower * at[0].path.p;
  point.stored += wound_energy - home_energy;
  point.friction = friction;
  point.groove_friction = groove_friction;
  loose = is_loose(point, now);
  if (loose) {
    point.status = EquilibriumStatus::loose;
    point.loose_below = point.t2.slack / now[1].span.m;
    point.loose_above = point.t1.slack / now[0].span.m;
  }
  return point;
}

EquilibriumPoint JointMotion::State::refuse(const JointStep& step) const {
  EquilibriumPoint point;
  point.status = EquilibriumStatus::no_equilibrium;
  point.alpha = step.alpha;
  point.theta = theta;
  point.load_torque = step.tip_force * model.lever + step.torque + model.own_torque(theta);
  point.friction = friction;
  point.groove_friction = groove_friction;
  return point;
}

JointMotion::JointMotion(JointModel model) : state_(std::make_unique<State>(std::move(model))) {}
JointMotion::JointMotion(const JointMotion& other) : state_(std::make_unique<State>(*other.state_)) {}
JointMotion& JointMotion::operator=(const JointMotion& other) {
  if (this != &other) state_ = std::make_unique<State>(*other.state_);
  return *this;
}
JointMotion::JointMotion(JointMotion&&) noexcept = default;
JointMotion& JointMotion::operator=(JointMotion&&) noexcept = default;
JointMotion::~JointMotion() = default;

EquilibriumPoint JointMotion::to(const JointStep& step) {
  State& state = *state_;
  const JointModel& model = state.model;
  const std::array<LowerPath, 2> paths = model.lower(step.alpha);
  std::array<AtAlpha, 2> at;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!std::isfinite(paths[i].wound)) return state.refuse(step);
    at[i] = at_alpha(state.tendons[i], paths[i], model, step);
    at[i].spans.lower_material += at[i].swelling * (step.tendon.released[i] - state.released[i]);
    const bool has_path =
        at[i].lower_length > 0 && at[i].spans.lower_material + at[i].swelling * at[i].turned.came_off > 0;
    if (!has_path) return state.refuse(step);
  }
  // Where the law ends nothing is expected: the search starts from where the joint stands.
  const double known = model.expected(step.alpha);
  const double expected = std::isfinite(known) ? known : state.expected;
  const auto rest = state.rubbed(at, step, state.theta + expected - state.expected);
  if (!rest) return state.refuse(step);
  state.expected = expected;
  state.released = step.tendon.released;
  return state.accept(at, step, *rest);
}

std::vector<EquilibriumPoint> follow(const JointModel& model, const std::vector<JointStep>& steps) {
  JointMotion motion(model);
  std::vector<EquilibriumPoint> points;
  points.reserve(steps.size());
  for (const JointStep& step : steps) points.push_back(motion.to(step));
  return points;
}

}  // namespace fusee
