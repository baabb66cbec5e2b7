#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "fusee/base.h"
#include "fusee/joint.h"
#include "joint/tendon_balance.h"
#include "joint/threaded_balance.h"
#include "joint/upper_span_table.h"
#include "joint/wound_profile.h"
#include "transmission/load.h"

// State of a tendon: the material above its reference point on the pin's rim, below it, and on the pulley. Material
// crosses the reference point only by slipping. The reference point is fixed, so that the tendon pulls with exactly
// T_up m(θ) on the joint and T_low p(α) on the pulley, and energy balances: with U = T²/(2 EA) per material, motor work
// − load work = stored + (T_up + U_up − T_low − U_low) · crossed + losses in the groove.
//
// Winding an arc ds takes ds/(1 + T_low/EA) of material, by the trapezoidal rule over a step with the step's own T_low.
// Paying out returns the stored material, last first. Deeper material slides (wound_profile.h) and exchanges material
// with the span, more so the further T_low departs from its earlier value. The balance of the spans sees this as a
// longer lower span whose length depends on T_low, and both are solved together.
//
// The simpler law, paying out at the present tension, is wrong with friction. Tension is higher while winding than
// while paying out, so each cycle would carry material past the pulley and θ would drift by 0.005° a cycle (EA 31 kN, 5
// N on both, μ 0.15; 0.18° at EA 850 N). The stored profile settles within three cycles.

namespace fusee::joint {
namespace {

/// Total slack of both tendons above which the joint has play. mm
constexpr double k_min_play = 1e-6;
/// Iterations for the sliding on the pulleys and for the tension ratio over a compliant pin. Usually two or three
/// suffice. A tendon that sticks on a compliant pin converges more slowly, and a reversal of the sliding may need some
/// halving.
constexpr int k_rounds = 40;
/// Lower limit of the tolerance for a slide's strain.
constexpr double k_min_strain = 1e-14;
/// Tolerance of the first search, and limit below which single Newton steps converge quadratically.
constexpr double k_rough_step = 1e-5;   // rad
constexpr double k_newton_step = 1e-3;  // rad
constexpr int k_newton_rounds = 6;
/// Distance below which Newton steps are used without a search: most rows start closer to their solution.
constexpr double k_newton_range = 0.02;  // rad
/// Relative tolerance of dry friction that depends on tension, and the maximum number of iterations for it.
constexpr double k_friction_tolerance = 1e-4;
constexpr int k_friction_rounds = 6;
/// Tension below which a tendon counts as slack: the rounding error after a tendon has pushed a loose joint. N
constexpr double k_min_tension = 1e-4;
/// Distance before the lift-off angle at which the tendon still lies on the drum. rad
constexpr double k_before_lift_off = 1e-9;
/// Relative tolerance, for rounding, of the tension that moves the joint against its friction.
constexpr double k_rounding = 1e-6;

/// Elastic energy per unstretched length. N·mm/mm
double energy_per_material(double tension, double EA) { return 0.5 * tension * tension / EA; }

/// Number of points at which the friction of a sheath acts, each in the middle of its section (threaded_balance.h).
/// Without friction one point suffices.
std::size_t bends_of(const transmission::SheathLoad& sheath) {
  return sheath.log_ratio > 0 ? ThreadedSpans::k_bends : 1;
}
/// Fraction of the sheath that belongs to each end span; each inner piece has twice that.
double end_share(const transmission::SheathLoad& sheath) { return 0.5 / static_cast<double>(bends_of(sheath)); }

/// Share of a sheath's compliance that belongs to one span, relative to its length when mounted at home. A spring of c
/// mm/N equals a tendon of length EA c without temperature and creep (see PinCompliance).
struct SheathShare {
  double length = 0;          ///< of the sheath's share, mm
  double virtual_length = 0;  ///< EA c of its compliance, mm
  double mounted = 0;         ///< elongation of the spring at home relative to zero tension, mm

  SheathShare(const transmission::SheathLoad& sheath, double share, double EA, double home)
      : length(share * sheath.length),
        virtual_length(share * sheath.compliance * EA),
        mounted(share * sheath.compliance * home) {}
};

/// The tendon between the bends of a sheath, from the joint to the pulley.
struct SheathHistory {
  std::array<double, ThreadedSpans::k_bends - 1> material{};  ///< unstretched length, mm
  std::array<double, ThreadedSpans::k_bends - 1> tension{};   ///< N
  std::array<int, ThreadedSpans::k_bends> slides{};           ///< ThreadedBalance::slides of the last step
};

/// One tendon in its right-hand image, with its history.
struct TendonHistory {
  transmission::Side side = transmission::Side::left;
  double rim_reference = 0;   ///< normal of the rim's reference point between upper and lower part, rad
  double upper_material = 0;  ///< unstretched length of the upper span, mm
  double lower_material = 0;  ///< unstretched length of the lower span, mm
  SheathHistory sheath;
  WoundProfile wound;  ///< the tendon on the pulley
  /// The tendon on the joint's drum, in the frame of the link, if it rubs there; otherwise that part belongs to the
  /// upper span.
  std::optional<WoundProfile> on_drum;
  double behind_drum = 0;  ///< straight length from the drum to the tendon's end, mm
  double upper = 0;        ///< tensions of the spans at the last step, N
  double lower = 0;
  double home = 0;       ///< tension at home, N
  Vec2 home_push{0, 0};  ///< force on its pin at home, where the pin is as declared, N
  double ratio = 1;      ///< lower per upper tension, for PinCompliance
  double strained = 0;   ///< increase of the lower span's strain in the last step
};

/// Unit vectors along a tendon away from its pin, and its force on the pin.
struct PinDirections {
  Vec2 up, down;

  PinDirections(double upper_normal, double lower_normal)
      : up(-elementary::sin(upper_normal), elementary::cos(upper_normal)),
        down(elementary::sin(lower_normal), -elementary::cos(lower_normal)) {}
  Vec2 push(double upper, double lower) const { return upper * up + lower * down; }
};

/// A pin of compliance c mm/N shortens the two parts of the path by up·d and down·d, d = c (push − home_push): to first
/// order, with the moment arms of the undisplaced pin. The effect of a span's own tension is a spring in series, equal
/// to an additional length of tendon EA c, and no equation changes: path and material of each span get the same
/// virtual length. The other span's tension enters by its ratio to this one's, which the step iterates.
struct PinCompliance {
  double upper_virtual = 0;
  double lower_virtual = 0;
  double upper_length = 0;  ///< change due to the force at home, which the declared path includes
  double lower_length = 0;

  PinCompliance() = default;
  PinCompliance(const PinDirections& at, const TendonHistory& tendon, double per_newton, double EA) {
    const double across = at.up.dot(at.down);
    upper_virtual = per_newton * EA * (1.0 + across * tendon.ratio);
    lower_virtual = per_newton * EA * (1.0 + across / tendon.ratio);
    upper_length = per_newton * at.up.dot(tendon.home_push);
    lower_length = per_newton * at.down.dot(tendon.home_push);
  }
};

/// A tendon at the pulley angle of a step, before θ is known.
struct TendonAtAlpha {
  LowerPath path;
  double lower_length = 0;  ///< length of the lower span from the rim's reference point, mm
  double swelling = 1;      ///< 1 + expansion of the material since home
  Spans spans;              ///< without the upper length, the capstan factor and the exchange with the pulley
  TurnedPulley turned;
  Slide slide;       ///< sliding on the pulley at a strain close to the solution
  double moved = 0;  ///< last change of that strain by update_slide()
};

/// The drum as a groove that turns with the link, from the tendon's end to the take-off. A free tendon has nothing on
/// it.
GroovePlace place_on_drum(const transmission::PinPlace& place, double on_drum, double behind) {
  return {on_drum, on_drum > 0 ? place.drum * on_drum : -behind};
}

GroovePlace place_of(transmission::Side side, const LowerPath& path, double alpha) {
  return {path.normal + transmission::mirror_sign(side) * alpha, path.wound};
}

TendonAtAlpha at_alpha(const TendonHistory& tendon, const LowerPath& path, const JointModel& model,
                       const JointStep& step) {
  const transmission::PinPlace& pin = model.pins[tendon.side == transmission::Side::left ? 0 : 1];
  const double expansion = step.tendon.expansion[tendon.side == transmission::Side::left ? 0 : 1];
  TendonAtAlpha at;
  at.path = path;
  at.lower_length = path.reach + pin.rho * (tendon.rim_reference - pin.off_pin(path.normal)) +
                    end_share(model.sheath) * model.sheath.length;
  at.swelling = 1.0 + expansion;
  at.spans.EA = model.EA;
  at.spans.upper_material = at.swelling * tendon.upper_material;
  at.spans.lower_length = at.lower_length;
  at.spans.lower_material = at.swelling * tendon.lower_material;
  at.turned = tendon.wound.turned_to(place_of(tendon.side, path, step.alpha), at.swelling);
  // The strain usually continues its trend.
  const double last = tendon.wound.strain(at.swelling);
  at.slide = tendon.wound.slide(at.turned, std::max(0.5 * last, last + tendon.strained), at.swelling);
  return at;
}

void add_compliance(Spans& spans, const SheathShare& sheath) {
  spans.upper_length += sheath.virtual_length + sheath.mounted;
  spans.upper_material += sheath.virtual_length;
  spans.lower_length += sheath.virtual_length + sheath.mounted;
  spans.lower_material += sheath.virtual_length;
}

void add_compliance(Spans& spans, const PinCompliance& pin) {
  spans.upper_length += pin.upper_virtual + pin.upper_length;
  spans.upper_material += pin.upper_virtual;
  spans.lower_length += pin.lower_virtual + pin.lower_length;
  spans.lower_material += pin.lower_virtual;
}

/// A span of a tendon whose waves straighten, linearized at the tension `pull`: a spring of compliance
/// waves.slope(pull), equal to a tendon of length EA times that without temperature (see PinCompliance).
Spans with_waves(Spans spans, const CableStiffening& waves, double pull, double home) {
  const double slope = waves.slope(pull), virtual_length = slope * spans.EA;
  spans.upper_length += virtual_length + slope * pull + waves.gained(home) - waves.gained(pull);
  spans.upper_material += virtual_length;
  return spans;
}

/// Includes the sliding on the pulley as part of the lower span: exact in value and slope at the slide's own strain.
Spans with_slide(Spans spans, const TendonAtAlpha& at) {
  spans.lower_length += at.slide.length;
  spans.lower_material += at.swelling * at.slide.freed + at.slide.length / (1.0 + at.slide.strain);
  return spans;
}

/// Tolerance of the strain for which a slide is computed.
double strain_tolerance(const JointModel& model) { return std::max(model.last_step, k_min_strain); }

/// Updates the slide to the expected strain `next`. Returns true if it was already consistent with the strain `now`, or
/// if the predicted exchange with its span was accurate.
///
/// Newton steps. Near a kink (a reversal of the sliding) they may cycle; halved steps break the cycle.
bool update_slide(TendonAtAlpha& at, const WoundProfile& wound, double now, double next, const JointModel& model) {
  const double tolerance = strain_tolerance(model);
  const double strain = at.slide.strain, freed = at.slide.freed, length = at.slide.length;
  const bool was_consistent = std::abs(now - strain) <= tolerance;
  double step = std::max(next, 0.0) - strain;
  if (std::abs(step) <= tolerance) return was_consistent;
  const bool swings = step * at.moved < 0 && std::abs(step) > 0.5 * std::abs(at.moved);
  if (swings) step *= 0.5;
  at.moved = step;
  at.slide = wound.slide(at.turned, strain + step, at.swelling);
  const double predicted = length * (1.0 / (1.0 + strain) - 1.0 / (1.0 + at.slide.strain));
  const double error = std::abs(at.swelling * (at.slide.freed - freed) - predicted);
  return was_consistent || (!swings && error <= model.last_step * at.path.p);
}

/// Spans with the tendon in a sheath with friction, and their balance.
struct ThreadedState {
  ThreadedSpans spans;
  ThreadedBalance balance;
};

/// Sliding on the joint's drum.
struct DrumSlide {
  TurnedPulley turned;
  Slide slide;
};

/// A tendon at a trial θ. Rarely used parts are allocated separately, so that copies are cheap.
struct Trial {
  UpperSpanTable::Values span;
  double upper_length = 0;                  ///< path length of the upper span, mm
  Spans spans;                              ///< with compliances, and with sliding as additional length
  std::unique_ptr<ThreadedState> threaded;  ///< the same spans with friction in a sheath
  std::unique_ptr<DrumSlide> on_drum;       ///< set if the tendon rubs on the drum
  TendonBalance balance;
  double wrap = 0;         ///< on the pin, rad
  double pull = 0;         ///< torque on the joint, towards the tendon's own side: T_up m, N·mm
  double slope = 0;        ///< derivative of `pull` by the image's θ
  double lower_slope = 0;  ///< derivative of the lower span's tension by the image's θ
};

/// The spans including the pieces of tendon between the bends of the sheath.
ThreadedSpans threaded(const Spans& spans, const TendonHistory& tendon, const JointModel& model, double swelling) {
  const SheathShare piece(model.sheath, 2.0 * end_share(model.sheath), spans.EA, tendon.home);
  ThreadedSpans all;
  all.EA = spans.EA;
  all.holds.fill(model.sheath.log_ratio / ThreadedSpans::k_bends);
  all.length.fill(piece.length + piece.virtual_length + piece.mounted);
  all.length.front() = spans.upper_length;
  all.length.back() = spans.lower_length;
  all.material.front() = spans.upper_material;
  all.material.back() = spans.lower_material;
  for (std::size_t i = 0; i < tendon.sheath.material.size(); ++i)
    all.material[i + 1] = swelling * tendon.sheath.material[i] + piece.virtual_length;
  return all;
}

/// The balance of the first and the last span.
TendonBalance from_ends(const ThreadedBalance& all) {
  return {all.tension.front(), all.tension.back(), all.crossed.front(), all.contact, all.per_length, all.per_hold};
}

/// Couples the tendon on the drum with the upper span, as sliding on the pulley is coupled with the lower span.
/// `balanced` returns the resulting strain of the span. Newton steps, halved near a kink.
template <typename Balanced>
void rub_on_drum(Trial& trial, const TendonHistory& tendon, const TendonAtAlpha& at, const JointModel& model,
                 Balanced balanced) {
  const transmission::PinPlace& pin = model.pins[tendon.side == transmission::Side::left ? 0 : 1];
  const GroovePlace takes_off = place_on_drum(pin, trial.span.on_drum, tendon.behind_drum);
  trial.upper_length -= takes_off.arc + tendon.behind_drum;
  // The span ends at the take-off from the drum.
  const double length = trial.spans.upper_length - takes_off.arc - tendon.behind_drum;
  const double material = trial.spans.upper_material;
  trial.on_drum = std::make_unique<DrumSlide>(DrumSlide{tendon.on_drum->turned_to(takes_off, at.swelling), {}});
  double strain = tendon.on_drum->strain(at.swelling), moved = 0;
  for (int i = 0; i < k_rounds; ++i) {
    const Slide& slide = trial.on_drum->slide = tendon.on_drum->slide(trial.on_drum->turned, strain, at.swelling);
    trial.spans.upper_length = length + slide.length;
    trial.spans.upper_material = material + at.swelling * slide.freed + slide.length / (1.0 + strain);
    double step = balanced() - strain;
    if (std::abs(step) <= strain_tolerance(model)) return;
    if (step * moved < 0 && std::abs(step) > 0.5 * std::abs(moved)) step *= 0.5;
    moved = step;
    strain += step;
  }
}

Trial evaluate_trial(const TendonHistory& tendon, const TendonAtAlpha& at, const UpperSpanTable& upper,
                     const JointModel& model, double theta) {
  const transmission::PinPlace& pin = model.pins[tendon.side == transmission::Side::left ? 0 : 1];
  const double off_pin = pin.off_pin(at.path.normal);
  const SheathShare sheath(model.sheath, end_share(model.sheath), at.spans.EA, tendon.home);
  Trial trial;
  trial.span = upper.at(transmission::mirror_sign(tendon.side) * theta);
  trial.spans = with_slide(at.spans, at);
  trial.upper_length = trial.spans.upper_length = trial.span.length - pin.rho * tendon.rim_reference + sheath.length;
  if (model.pin_compliance > 0)
    add_compliance(trial.spans, PinCompliance({trial.span.normal, off_pin}, tendon, model.pin_compliance, at.spans.EA));
  if (model.sheath.compliance > 0) add_compliance(trial.spans, sheath);
  trial.wrap = trial.span.normal - off_pin;
  const double on_pin = model.guide.log_ratio(trial.wrap);
  if (bends_of(model.sheath) > 1) trial.threaded = std::make_unique<ThreadedState>();
  const auto balance_once = [&] {
    if (trial.threaded) {
      ThreadedSpans& spans = trial.threaded->spans = threaded(trial.spans, tendon, model, at.swelling);
      spans.holds.front() += on_pin;
      trial.threaded->balance = balance(spans, tendon.sheath.slides);
      trial.balance = from_ends(trial.threaded->balance);
    } else {
      trial.spans.capstan = elementary::exp(on_pin);
      trial.balance = balance(trial.spans);
    }
    return trial.balance.upper;
  };
  const auto balanced = [&] {
    if (!(model.waves.most > 0)) return balance_once() / at.spans.EA;
    // The spring stiffens with tension, so Newton steps converge from one side.
    const Spans straight = trial.spans;
    double pull = tendon.upper;
    for (int i = 0; i < k_rounds; ++i) {
      trial.spans = with_waves(straight, model.waves, pull, tendon.home);
      const double next = balance_once();
      if (std::abs(next - pull) <= strain_tolerance(model) * at.spans.EA) break;
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
  double rate = -m * trial.balance.per_length;  // of T_up by the image's θ; dL/dθ = −m
  if (trial.wrap > 0) rate += trial.balance.per_capstan * model.guide.slope(trial.wrap) * trial.span.dnormal;
  trial.slope = rate * m + trial.balance.upper * trial.span.dm;
  if (trial.threaded)
    trial.lower_slope = rate * trial.threaded->balance.lower_per_upper;
  else if (trial.balance.crossed != 0 && trial.balance.upper > 0)
    trial.lower_slope = rate * trial.balance.lower / trial.balance.upper;
  return trial;
}

/// Value and slope of a function whose root is sought.
struct Residual {
  double value = 0;
  double slope = 0;
};

/// Root of a function that decreases from `least` to `most`: Newton steps within the known bracket. Before a bracket is
/// known, steps grow towards the end. The last step is shorter than `last_step`. Null when the function does not change
/// its sign.
template <typename Function>
std::optional<double> find_root(double start, double least, double most, double last_step, Function function) {
  constexpr int k_most_steps = 200;
  double low = least;
  double high = most;
  bool low_seen = false;
  bool high_seen = false;
  double stride = 0.01;  // rad
  double x = std::clamp(start, least, most);
  for (int i = 0; i < k_most_steps; ++i) {
    const Residual residual = function(x);
    if (residual.value == 0) return x;
    const bool is_above = residual.value > 0;  // the root, since the function decreases
    (is_above ? low : high) = x;
    (is_above ? low_seen : high_seen) = true;
    if ((is_above && x >= most) || (!is_above && x <= least)) return std::nullopt;
    double next = residual.slope < 0 ? x - residual.value / residual.slope : x + (is_above ? stride : -stride);
    if (low_seen && high_seen) {
      // Kinks can make Newton steps cycle, so the last two of twelve steps bisect.
      const bool bisects = i % 12 > 9;
      if (!(next > low && next < high) || bisects) next = 0.5 * (low + high);
    } else {
      next = std::clamp(next, x - stride, x + stride);
      next = is_above ? std::min(std::max(next, x), most) : std::max(std::min(next, x), least);
      stride *= 2.0;
    }
    // Newton steps converge quadratically, except across a kink.
    if (std::abs(next - x) <= last_step || !(high - low > last_step)) return next;
    x = next;
  }
  return x;
}

/// Straight length between drum and tendon end, constant while the tendon lies on the drum.
double straight_behind(const transmission::PinPlace& place) {
  const auto leaves = transmission::lift_off(place);
  return leaves ? transmission::upper_span(place, *leaves - k_before_lift_off).behind_drum : 0.0;
}

/// Samples of the groove over the range; its radius changes little between them.
constexpr int k_groove_places = 64;

/// The groove of one tendon over the range of the pulley.
std::shared_ptr<const GrooveArc> groove_of(const JointModel& model, transmission::Side side) {
  const bool right = side == transmission::Side::right;
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
  // A curve that turns inward everywhere is not a groove; a round one is assumed.
  if (along.size() < 2) {
    const LowerPath home = model.lower(0.0)[right ? 1 : 0];
    const GroovePlace place = place_of(side, home, 0.0);
    along = {place, {place.turn + 1.0, place.arc + std::abs(home.p)}};
  }
  return std::make_shared<const GrooveArc>(std::move(along), model.arcs_to_knots[right ? 1 : 0]);
}

/// A tendon at home with the same `tension` everywhere.
TendonHistory at_home(transmission::Side side, const JointModel& model, const LowerPath& path, double tension) {
  const transmission::PinPlace& place = model.pins[side == transmission::Side::left ? 0 : 1];
  const transmission::UpperSpan span = transmission::upper_span(place, 0.0);
  TendonHistory tendon;
  tendon.side = side;
  const double off_pin = place.off_pin(path.normal), in_sheath = end_share(model.sheath) * model.sheath.length;
  tendon.rim_reference = 0.5 * (span.normal + off_pin);
  const double density = 1.0 / (1.0 + tension / model.EA);  // material per length
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
  tendon.home_push = PinDirections(span.normal, off_pin).push(tension, tension);
  return tendon;
}

/// Energy balance of a pulley over a step: the energy of the wound tendon minus the work of the released material, at
/// the mean take-off strain of the step, minus the increase of the stored energy. Releasing dM at the strain ε takes EA
/// (ε + ε²/2) dM of work.
struct WindingEnergy {
  double energy = 0;  ///< increase of the stored energy
  double friction = 0;
};

WindingEnergy accept_winding(WoundProfile& wound, const TurnedPulley& turned, const Slide& slide, double swelling,
                             double EA) {
  const double before = wound.strain(swelling);
  const double now = slide.strain;
  const double arc = turned.take_off.arc - wound.take_off().arc;
  const auto mean = [&](auto function) { return 0.5 * (function(before) + function(now)); };
  const double laid = arc * mean([](double strain) { return 1.0 / (1.0 + strain); });
  const double energy = arc * mean([](double strain) { return 0.5 * strain * strain / (1.0 + strain); });
  const double work = mean([](double strain) { return strain * (1.0 + 0.5 * strain); });
  const double stored = EA * wound.accept(turned, slide, swelling).energy;
  return {stored, EA * (work * (swelling * slide.freed + laid) + energy) - stored};
}

/// Work carried by a unit of material that crosses at the tension `t`: T + T²/(2 EA).
double work_per_material(double t, double EA) { return t + energy_per_material(t, EA); }

/// Work lost at the bends of a sheath; updates its pieces.
double accept_sheath(TendonHistory& tendon, const ThreadedState& threaded, double swelling) {
  const double EA = threaded.spans.EA;
  const ThreadedBalance& now = threaded.balance;
  SheathHistory& sheath = tendon.sheath;
  std::array<double, ThreadedSpans::k_bends + 1> before{};
  before.front() = tendon.upper;
  before.back() = tendon.lower;
  std::copy(sheath.tension.begin(), sheath.tension.end(), before.begin() + 1);
  double lost = 0;
  for (std::size_t j = 0; j < now.crossed.size(); ++j) {
    // Trapezoidal rule over the step.
    const double lost_before = work_per_material(before[j], EA) - work_per_material(before[j + 1], EA);
    lost += 0.5 * (lost_before + work_per_material(now.tension[j], EA) - work_per_material(now.tension[j + 1], EA)) *
            now.crossed[j];
  }
  for (std::size_t i = 0; i < sheath.material.size(); ++i) {
    sheath.material[i] += (now.crossed[i + 1] - now.crossed[i]) / swelling;
    sheath.tension[i] = now.tension[i + 1];
  }
  sheath.slides = now.slides;
  return lost;
}

/// Energy changes of a tendon in one step.
struct EnergyChange {
  double wound = 0;  ///< energy wound onto pulley and drum (negative: unwound)
  double friction = 0;
  double groove_friction = 0;
};

/// Makes a trial permanent. The slide is recomputed only if its strain is off by more than `tolerance`.
EnergyChange accept_trial(TendonHistory& tendon, TendonAtAlpha& at, const Trial& trial, double tolerance) {
  const double EA = at.spans.EA;
  const TendonBalance& now = trial.balance;
  const ThreadedState* threaded = trial.threaded.get();
  // Material that left the lower span.
  const double to_joint = threaded ? threaded->balance.crossed.back() : now.crossed;
  if (std::abs(at.slide.strain - now.lower / EA) > tolerance)
    at.slide = tendon.wound.slide(at.turned, now.lower / EA, at.swelling);
  const WindingEnergy on_pulley = accept_winding(tendon.wound, at.turned, at.slide, at.swelling, EA);
  EnergyChange change{on_pulley.energy, 0, on_pulley.friction};
  const auto lost_per_material = [EA](double upper, double lower) {
    return work_per_material(upper, EA) - work_per_material(lower, EA);
  };
  change.friction =
      threaded ? accept_sheath(tendon, *threaded, at.swelling)
               : 0.5 * (lost_per_material(tendon.upper, tendon.lower) + lost_per_material(now.upper, now.lower)) *
                     now.crossed;
  tendon.upper_material += now.crossed / at.swelling;
  if (tendon.on_drum) {
    const WindingEnergy on_drum =
        accept_winding(*tendon.on_drum, trial.on_drum->turned, trial.on_drum->slide, at.swelling, EA);
    tendon.upper_material += trial.on_drum->slide.freed;
    change.wound += on_drum.energy;
    change.friction += on_drum.friction;
  }
  tendon.lower_material = (at.spans.lower_material - to_joint) / at.swelling + at.slide.freed;
  tendon.strained = (now.lower - tendon.lower) / EA;
  tendon.upper = now.upper;
  tendon.lower = now.lower;
  return change;
}

TendonState state_of(const TendonHistory& tendon, const TendonAtAlpha& at, const Trial& trial) {
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

/// Energy of a compliant pin, relative to home.
double energy_of_pin(const TendonHistory& tendon, const TendonAtAlpha& at, const Trial& trial,
                     const JointModel& model) {
  if (!(model.pin_compliance > 0)) return 0;
  const transmission::PinPlace& place = model.pins[tendon.side == transmission::Side::left ? 0 : 1];
  const PinDirections pin(trial.span.normal, place.off_pin(at.path.normal));
  return 0.5 * model.pin_compliance *
         (pin.push(tendon.upper, tendon.lower).squaredNorm() - tendon.home_push.squaredNorm());
}

/// Energy of a compliant sheath, relative to home.
double energy_of_sheath(const TendonHistory& tendon, const transmission::SheathLoad& sheath) {
  if (!(sheath.compliance > 0)) return 0;
  const double share = end_share(sheath), at_home = tendon.home * tendon.home;
  double sum = share * (tendon.upper * tendon.upper + tendon.lower * tendon.lower - 2.0 * at_home);
  if (bends_of(sheath) > 1) {
    for (const double inside : tendon.sheath.tension) sum += 2.0 * share * (inside * inside - at_home);
  }
  return 0.5 * sheath.compliance * sum;
}

/// Result of the equilibrium search.
struct RestState {
  double theta = 0;            ///< rad
  double friction_torque = 0;  ///< of the dry friction, towards −θ, N·mm
  bool stays = false;          ///< true if the joint did not move
  std::array<Trial, 2> trials = {};
};

}  // namespace

struct JointMotion::State {
  JointModel model;
  std::array<TendonHistory, 2> tendons;
  std::array<double, 2> released{};  ///< length released so far, mm
  double theta = 0;
  bool loose = false;          ///< the joint was loose at the last step
  double dry = 0;              ///< limit of the dry friction on the joint, N·mm
  double expected = 0;         ///< model.expected at the last step
  double wound_energy = 0;     ///< energy wound onto the pulleys since home, N·mm
  double home_energy = 0;      ///< energy of the spans at home, N·mm
  double friction = 0;         ///< EquilibriumPoint::friction at the last step
  double groove_friction = 0;  ///< EquilibriumPoint::groove_friction at the last step

  explicit State(JointModel joint);
  /// Torque of the tendons minus that of the load, towards +θ.
  Residual residual(const std::array<Trial, 2>& trials, const JointStep& step, double at_theta) const;
  std::array<Trial, 2> trials(const std::array<TendonAtAlpha, 2>& at, double at_theta) const;
  std::optional<RestState> solve_theta(const std::array<TendonAtAlpha, 2>& at, const JointStep& step, double start,
                                       double last_step) const;
  std::optional<RestState> solve_coupled(std::array<TendonAtAlpha, 2>& at, const JointStep& step, double start);
  std::optional<RestState> solve_with_friction(std::array<TendonAtAlpha, 2>& at, const JointStep& step, double start);
  bool update_coupling(std::array<TendonAtAlpha, 2>& at, const std::array<Trial, 2>& now, double move);
  bool is_loose(const EquilibriumPoint& point, const std::array<Trial, 2>& now) const;
  EquilibriumPoint accept(std::array<TendonAtAlpha, 2>& at, const JointStep& step, const RestState& rest);
  EquilibriumPoint without_equilibrium(const JointStep& step) const;
};

JointMotion::State::State(JointModel joint) : model(std::move(joint)) {
  const std::array<LowerPath, 2> paths = model.lower(0.0);
  const double arm1 = transmission::upper_span(model.pins[0], 0.0).m;
  const double arm2 = transmission::upper_span(model.pins[1], 0.0).m;
  tendons[0] = at_home(transmission::Side::left, model, paths[0], model.pretension);
  tendons[1] = at_home(transmission::Side::right, model, paths[1], model.pretension * arm1 / arm2);
  expected = model.expected(0.0);
  dry = model.dry_friction(model.pretension, model.pretension * arm1 / arm2);
  for (const TendonHistory& tendon : tendons) home_energy += energy_of_spans(tendon, model);
}

std::array<Trial, 2> JointMotion::State::trials(const std::array<TendonAtAlpha, 2>& at, double at_theta) const {
  return {evaluate_trial(tendons[0], at[0], model.upper->left, model, at_theta),
          evaluate_trial(tendons[1], at[1], model.upper->right, model, at_theta)};
}

Residual JointMotion::State::residual(const std::array<Trial, 2>& trials, const JointStep& step,
                                      double at_theta) const {
  const auto& [left, right] = trials;
  return {right.pull - left.pull - step.tip_force * model.lever - step.torque - model.own_torque(at_theta),
          right.slope + left.slope - model.own_slope(at_theta)};
}

/// Solves for θ with the sliding on the pulleys as given in `at`.
std::optional<RestState> JointMotion::State::solve_theta(const std::array<TendonAtAlpha, 2>& at, const JointStep& step,
                                                         double start, double last_step) const {
  // Friction of the bearing holds the joint up to its limit; beyond it the joint moves until the torque equals the
  // limit.
  double friction_torque = 0;
  const auto unbalanced = [&](double at_theta) {
    Residual torque = residual(trials(at, at_theta), step, at_theta);
    torque.value -= friction_torque;
    return torque;
  };
  // The joint stays if friction holds it. A loose joint is only pushed, so its search starts at the present angle;
  // otherwise it starts at the expected angle plus the present deviation.
  if (theta > model.theta_least && theta < model.theta_most) {
    const double here = unbalanced(theta).value;
    if (std::abs(here) <= dry) return RestState{theta, 0, true};
    friction_torque = std::copysign(dry, here);
    if (loose || dry > 0) start = theta;
  }
  const auto found = find_root(start, model.theta_least, model.theta_most, last_step, unbalanced);
  if (!found) return std::nullopt;
  return RestState{*found, friction_torque, false};
}

/// Updates the sliding on both pulleys, and the tension ratios of compliant pins, to the state expected after the joint
/// moves by `move`. Returns true if they were consistent already.
bool JointMotion::State::update_coupling(std::array<TendonAtAlpha, 2>& at, const std::array<Trial, 2>& now,
                                         double move) {
  constexpr double k_ratio_tolerance = 1e-7;
  bool was_consistent = true;
  for (std::size_t i = 0; i < 2; ++i) {
    const TendonBalance& balance = now[i].balance;
    const double next = balance.lower + transmission::mirror_sign(tendons[i].side) * move * now[i].lower_slope;
    const double EA = at[i].spans.EA;
    was_consistent = update_slide(at[i], tendons[i].wound, balance.lower / EA, next / EA, model) && was_consistent;
    if (!(model.pin_compliance > 0 && balance.upper > 0 && balance.lower > 0)) continue;
    const double ratio = balance.lower / balance.upper;
    if (std::abs(ratio - tendons[i].ratio) <= k_ratio_tolerance) continue;
    tendons[i].ratio = ratio;
    was_consistent = false;
  }
  return was_consistent;
}

/// Solves for the joint angle and the sliding together by simultaneous Newton steps. Falls back to alternating searches
/// at a kink, with friction of the bearing, or without taut tendons.
std::optional<RestState> JointMotion::State::solve_coupled(std::array<TendonAtAlpha, 2>& at, const JointStep& step,
                                                           double start) {
  bool searched = false;
  const auto search = [&](double from) {
    const double tolerance = std::exchange(searched, true) ? model.last_step : std::max(model.last_step, k_rough_step);
    return solve_theta(at, step, from, tolerance);
  };
  // With compliant pins there may be two solutions; the search finds the one consistent with the history.
  const bool first_search = loose || dry > 0 || model.pin_compliance > 0;
  auto rest =
      first_search ? search(start) : std::optional(RestState{std::clamp(start, model.theta_least, model.theta_most)});
  for (int i = 0; i < k_rounds && rest; ++i) {
    rest->trials = trials(at, rest->theta);
    const Residual torque = residual(rest->trials, step, rest->theta);
    const double move = torque.slope < 0 && !rest->stays ? -(torque.value - rest->friction_torque) / torque.slope : 0.0;
    const bool was_consistent = update_coupling(at, rest->trials, move);
    const bool is_taut = std::max(rest->trials[0].balance.upper, rest->trials[1].balance.upper) >= k_min_tension;
    if (!searched && !(is_taut && torque.slope < 0 && std::abs(move) <= k_newton_range)) {
      rest = search(start);
      continue;
    }
    if (was_consistent && std::abs(move) <= model.last_step) {
      rest->theta += move;  // its error is now of the order of move²
      return rest;
    }
    if (rest->stays || (searched && std::abs(move) > k_newton_step) || i >= k_newton_rounds)
      rest = search(rest->theta);
    else
      rest->theta += move;
  }
  if (rest) rest->trials = trials(at, rest->theta);
  return rest;
}

/// Solves with dry friction that depends on the resulting tensions.
std::optional<RestState> JointMotion::State::solve_with_friction(std::array<TendonAtAlpha, 2>& at,
                                                                 const JointStep& step, double start) {
  std::optional<RestState> rest = solve_coupled(at, step, start);
  for (int i = 0; i < k_friction_rounds && rest; ++i) {
    const double due = model.dry_friction(rest->trials[0].balance.upper, rest->trials[1].balance.upper);
    if (std::abs(due - dry) <= k_friction_tolerance * due) break;
    dry = due;
    rest = solve_coupled(at, step, start);
  }
  return rest;
}

/// True if only the bearing's friction keeps the joint in place within its play. This counts as loose, since θ can rest
/// anywhere in the play. Otherwise calibration takes such rows as certain: an identified friction of 0.007 N·mm caused
/// false positives in 4 of 34 wide joints.
bool JointMotion::State::is_loose(const EquilibriumPoint& point, const std::array<Trial, 2>& now) const {
  const auto hardly_pulls = [&](const TendonState& tendon, const Trial& trial) {
    const double held_by_friction = dry > 0 ? (1.0 + k_rounding) * dry / trial.span.m : 0.0;
    return tendon.upper < k_min_tension + held_by_friction;
  };
  if (!hardly_pulls(point.t1, now[0]) || !hardly_pulls(point.t2, now[1])) return false;
  // The stretch that friction sustains is released before the play begins.
  const double taken_up = dry > 0 ? point.t1.stretch + point.t2.stretch : 0.0;
  return point.t1.slack + point.t2.slack - taken_up > k_min_play;
}

EquilibriumPoint JointMotion::State::accept(std::array<TendonAtAlpha, 2>& at, const JointStep& step,
                                            const RestState& rest) {
  const std::array<Trial, 2>& now = rest.trials;
  const double found = rest.theta;
  EquilibriumPoint point;
  point.alpha = step.alpha;
  point.load_torque = step.tip_force * model.lever + step.torque + model.own_torque(found);
  friction += dry * std::abs(found - theta);
  point.theta = theta = found;
  point.stiffness = point.stiffness_stuck = model.own_slope(found);
  for (std::size_t i = 0; i < 2; ++i) {
    const EnergyChange change = accept_trial(tendons[i], at[i], now[i], strain_tolerance(model));
    wound_energy += change.wound;
    friction += change.friction;
    groove_friction += change.groove_friction;
    point.stored += energy_of_spans(tendons[i], model) + energy_of_pin(tendons[i], at[i], now[i], model) +
                    energy_of_sheath(tendons[i], model.sheath);
    (i == 0 ? point.t1 : point.t2) = state_of(tendons[i], at[i], now[i]);
    const double m = now[i].span.m;
    const double geometric = now[i].balance.upper * now[i].span.dm;
    point.stiffness_stuck += stuck_rate(now[i].spans, now[i].balance) * m * m - geometric;
    const ThreadedState* threaded = now[i].threaded.get();
    const double sliding =
        threaded ? sliding_rate(threaded->spans, threaded->balance) : sliding_rate(now[i].spans, now[i].balance);
    point.stiffness += sliding * m * m - geometric;
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

EquilibriumPoint JointMotion::State::without_equilibrium(const JointStep& step) const {
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
  std::array<TendonAtAlpha, 2> at;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!std::isfinite(paths[i].wound)) return state.without_equilibrium(step);
    at[i] = at_alpha(state.tendons[i], paths[i], model, step);
    at[i].spans.lower_material += at[i].swelling * (step.tendon.released[i] - state.released[i]);
    const bool has_path =
        at[i].lower_length > 0 && at[i].spans.lower_material + at[i].swelling * at[i].turned.came_off > 0;
    if (!has_path) return state.without_equilibrium(step);
  }
  // Beyond the law's range nothing is expected: the search starts from the present angle.
  const double known = model.expected(step.alpha);
  const double expected = std::isfinite(known) ? known : state.expected;
  const auto rest = state.solve_with_friction(at, step, state.theta + expected - state.expected);
  if (!rest) return state.without_equilibrium(step);
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

}  // namespace fusee::joint
