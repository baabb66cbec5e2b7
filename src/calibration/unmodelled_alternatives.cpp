#include "calibration/unmodelled_alternatives.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "base/text.h"
#include "calibration/evidence_model.h"
#include "calibration/row_facts.h"
#include "calibration/statistics.h"
#include "calibration/thresholds.h"
#include "calibration/unmodelled_effects.h"
#include "calibration/words.h"

// The discrepancy is smooth: a kink, a step, a bump or a short wave requires many of its columns. An absent effect with
// a bend near that place would be likelier. Shapes of few parameters complete the discrepancy here, each with the prior
// of an effect with a searched number. The data are explained with and without the effect, and both models may add
// shapes. The remaining difference in score is the evidence for the effect itself. Wrong loads are no shape: each effect
// is tested against them by refits (unmodelled_effects.h).

namespace fusee::calibration {
namespace {

constexpr int k_reading_rounds = 4;
/// Waves: least periods over the span, step in periods, largest by cost, and rows that a period requires.
constexpr double k_least_periods = 0.75;
constexpr double k_period_step = 0.25;
constexpr double k_most_periods = 24.0;
constexpr double k_rows_a_wave = 4.0;
/// Places of steps, kinks and bumps over the span, and widths of bumps.
constexpr int k_shape_places = 13;
constexpr std::array k_widths = {0.04, 0.10};
/// Times of a step, over all runs.
constexpr int k_times = 24;
/// Shares of the session: decay times of a drift, and number of times at which one begins.
constexpr std::array k_settling = {0.03, 0.06, 0.12, 0.25, 0.5, 1.0, 4.0};
constexpr int k_late = 6;

/// Decay lengths behind a reversal, as shares of the span.
constexpr std::array k_shape_ways = {0.01, 0.02, 0.04, 0.08, 0.15, 0.3};

enum class Dependence {
  motor_wave,
  joint_wave,
  place,
  direction,
  reversal,
  load,
  load_size,
  load_direction,
  speed,
  time,
  drift
};

/// Shape with one or two searched parameters.
struct Shape {
  Dependence dependence = Dependence::place;
  Eigen::Index first = 0, count = 0;  ///< first column and number of columns
  int searched = 0;
  std::string words;
};

const char* separating_run(Dependence dependence) {
  switch (dependence) {
    case Dependence::motor_wave:
      return "turn the pulley and the motor's sensor on their shaft by a quarter of such a wave, one at a time, and "
             "repeat the slow unloaded run: an error that moves with one of them is its own";
    case Dependence::joint_wave:
      return "turn the joint's sensor on its axis by a quarter of such a wave and repeat the slow unloaded run: an "
             "error that moves with it is its own";
    case Dependence::place:
      return "repeat the slow unloaded run with ten times as many rows about that place: an effect is smooth there";
    case Dependence::reversal:
      return "make short strokes, of a tenth of the range, at its middle and at both ends: they show only the decay "
             "after reversals";
    case Dependence::direction:
      return "approach each place from both sides in steps, without load and with the largest";
    case Dependence::load:
    case Dependence::load_size:
    case Dependence::load_direction:
      return "hold the motor at three places and apply and remove the load in eight steps, with both signs: the "
             "deflection may be proportional, begin at a threshold, or level off";
    case Dependence::speed:
      return "repeat one run at a tenth of its speed and one at five times";
    case Dependence::time:
      return "repeat the first run as the last, touching nothing in between, and mark the tendon at the pulley";
    case Dependence::drift:
      return "mark both tendons at knots and pulleys, hold one place for as long as the session took, then move "
             "without load, then load without moving: the one in which the drift continues shows its cause";
  }
  return "";
}

using Part = std::function<double(const RowFacts&)>;

/// Shapes over the rows in use, as columns of rms 1.
class Shapes {
 public:
  explicit Shapes(const Evidence& evidence)
      : facts_(row_facts(evidence)), has_loads_(varies(facts_, &RowFacts::load, 0.05)) {
    const auto one = [](const RowFacts&) { return 1.0; };
    const auto direction = [](const RowFacts& r) { return r.direction; };
    const auto load = [](const RowFacts& r) { return r.load; };
    const auto load_size = [](const RowFacts& r) { return std::abs(r.load); };
    const auto load_direction = [](const RowFacts& r) { return std::abs(r.load) * r.direction; };
    add_waves(&RowFacts::alpha, Dependence::motor_wave, "motor");
    add_waves(&RowFacts::theta, Dependence::joint_wave, "joint");
    add_places(one, Dependence::place, "at all loads and directions");
    add_places(direction, Dependence::direction, "that changes sign with the direction");
    add_ways(one, "");
    if (has_loads_) {
      add_ways(load_size, ", with the size of the load");
      add_places(load, Dependence::load, "in proportion to the load");
      add_places(load_size, Dependence::load_size, "with the size of the load");
      add_places(load_direction, Dependence::load_direction, "of a hysteresis that grows with the load");
      add_thresholds();
    }
    if (varies(facts_, &RowFacts::speed, 0.1))
      add_places([](const RowFacts& r) { return r.speed * r.direction; }, Dependence::speed,
                 "of a hysteresis that grows "
                 "with speed");
    add_times();
    add_drifts(&RowFacts::session, "time");
    add_drifts(&RowFacts::way, "distance moved");
    add_drifts(&RowFacts::loading, "load applied and removed");
    columns_.conservativeResize(Eigen::NoChange, used_);
  }

  const Eigen::MatrixXd& columns() const { return columns_; }
  const std::vector<Shape>& all() const { return shapes_; }

 private:
  static double clock(const RowFacts& r) { return static_cast<double>(r.run) + 0.5 * (r.time + 1.0); }

  /// Adds a shape, unless a column is zero or constant.
  void add(Dependence dependence, int searched, std::string words, const std::vector<Part>& parts, bool centred) {
    const auto rows = static_cast<Eigen::Index>(facts_.size());
    const auto count = static_cast<Eigen::Index>(parts.size());
    if (columns_.cols() < used_ + count) columns_.conservativeResize(rows, 2 * (used_ + count) + 64);
    for (Eigen::Index k = 0; k < count; ++k) {
      auto column = columns_.col(used_ + k);
      for (Eigen::Index i = 0; i < rows; ++i)
        column[i] = parts[static_cast<std::size_t>(k)](facts_[static_cast<std::size_t>(i)]);
      if (centred) column.array() -= column.mean();
      const double size = column.norm() / std::sqrt(static_cast<double>(rows));
      if (!(size > 1e-3)) return;
      column /= size;
    }
    shapes_.push_back({dependence, used_, count, searched, std::move(words)});
    used_ += count;
  }

  void add_waves(double RowFacts::*angle, Dependence dependence, const std::string& what) {
    double least = facts_.front().*angle, most = least;
    std::set<long> places;
    for (const RowFacts& row : facts_) least = std::min(least, row.*angle), most = std::max(most, row.*angle);
    const double span = most - least;
    if (!(span > 0)) return;
    for (const RowFacts& row : facts_) places.insert(std::lround(1000 * (row.*angle - least) / span));
    const double shown = static_cast<double>(places.size()) / k_rows_a_wave;
    for (double periods = k_least_periods; periods <= std::min(k_most_periods, shown); periods += k_period_step) {
      const double order = k_two_pi * periods / span;
      add(dependence, 1, "a wave of " + rounded(order, 2) + " times a turn of the " + what,
          {[=](const RowFacts& r) { return elementary::sin(order * (r.*angle)); },
           [=](const RowFacts& r) { return elementary::cos(order * (r.*angle)); }},
          true);
    }
  }

  void add_places(const Part& times, Dependence dependence, const std::string& how) {
    const bool centred = dependence == Dependence::place;
    for (int i = 1; i < k_shape_places; ++i) {
      const double place = static_cast<double>(i) / k_shape_places;
      const std::string at = " at " + rounded(100 * place, 2) + " % of the range, " + how;
      add(dependence, 1, "a kink" + at, {[=](const RowFacts& r) { return times(r) * std::max(0.0, r.place - place); }},
          centred);
      add(dependence, 1, "a jump" + at, {[=](const RowFacts& r) { return r.place > place ? times(r) : 0.0; }}, centred);
      for (const double width : k_widths) {
        add(dependence, 2, "a lump" + at, {[=](const RowFacts& r) {
              const double away = (r.place - place) / width;
              return times(r) * elementary::exp(-0.5 * away * away);
            }},
            centred);
      }
    }
  }

  /// Decays behind a reversal, different at the two ends: exponential, or linear to zero.
  void add_ways(const Part& times, const std::string& how) {
    for (const double way : k_shape_ways) {
      const auto fading = [=](const RowFacts& r) { return times(r) * elementary::exp(-r.since / way); };
      const auto ending = [=](const RowFacts& r) { return times(r) * std::max(0.0, 1.0 - r.since / way); };
      const std::string words = "a decay over " + rounded(100 * way, 2) + " % of the range after a reversal" + how;
      add(Dependence::reversal, 1, words,
          {[=](const RowFacts& r) { return r.direction > 0 ? fading(r) : 0.0; },
           [=](const RowFacts& r) { return r.direction < 0 ? fading(r) : 0.0; }},
          false);
      add(Dependence::reversal, 1, words,
          {[=](const RowFacts& r) { return r.direction > 0 ? ending(r) : 0.0; },
           [=](const RowFacts& r) { return r.direction < 0 ? ending(r) : 0.0; }},
          false);
    }
  }

  /// Compliance from a load threshold on, uniform or growing to one end.
  void add_thresholds() {
    for (const double from : {-0.5, -0.25, 0.0, 0.25, 0.5, 0.75}) {
      const auto beyond = [=](const RowFacts& r) { return std::max(0.0, r.load - from); };
      add(Dependence::load, 1, "a compliance from " + rounded(100 * from, 2) + " % of the load on",
          {beyond, [=](const RowFacts& r) { return beyond(r) * (2 * r.place - 1); }}, true);
    }
  }

  void add_times() {
    double last = 0;
    for (const RowFacts& row : facts_) last = std::max(last, clock(row));
    for (int i = 1; i < k_times; ++i) {
      const double at = last * i / k_times;
      add(Dependence::time, 1, "a jump at one time, equal at all places",
          {[=](const RowFacts& r) { return clock(r) > at ? 1.0 : 0.0; }}, true);
    }
  }

  /// Drifts with time, travel or load changes, decaying or from some moment on.
  void add_drifts(double RowFacts::*by, const std::string& what) {
    for (const double settling : k_settling) {
      add_drift("a drift that decays in " + rounded(100 * settling, 2) + " % of the session, by " + what,
                [=](const RowFacts& r) { return elementary::exp(-(r.*by) / settling); });
    }
    for (int i = 1; i < k_late; ++i) {
      const double from = static_cast<double>(i) / k_late;
      add_drift("a drift from " + rounded(100 * from, 2) + " % of the session on, by " + what,
                [=](const RowFacts& r) { return std::max(0.0, r.*by - from); });
    }
  }

  /// Drift that is uniform, grows to one end, or scales with the load: a longer tendon turns the joint by its moment
  /// arm, and loses pretension.
  void add_drift(std::string words, const Part& drift) {
    std::vector<Part> parts = {drift, [=](const RowFacts& r) { return drift(r) * (2 * r.place - 1); }};
    if (has_loads_) parts.push_back([=](const RowFacts& r) { return drift(r) * r.load; });
    add(Dependence::drift, 1, std::move(words), parts, true);
  }

  std::vector<RowFacts> facts_;
  bool has_loads_ = false;
  Eigen::MatrixXd columns_;
  Eigen::Index used_ = 0;
  std::vector<Shape> shapes_;
};

class ShapeSearch {
 public:
  ShapeSearch(const Evidence& evidence, const Selection& selection)
      : evidence_model_(*evidence.evidence_model),
        evidence_(evidence),
        shapes_(evidence),
        CC_(shapes_.columns().transpose() * shapes_.columns()),
        CD_(shapes_.columns().transpose() * evidence_model_.discrepancy().columns),
        size_(std::max(evidence.floor, rms_of(tangent_of(evidence, selection.none).residual))) {
    for (const Shape& shape : shapes_.all())
      penalties_.push_back(k_thresholds.neg_log_prior_odds + k_thresholds.strong * shape.searched);
  }

  /// `base` with shapes, added as long as they improve the score. `open`: amplitudes of the discrepancy from which a
  /// second search begins.
  LinearizedSet explain(const Fit& base, const Amplitudes& open) const {
    const BaseSums sums_of_base(*this, base);
    const double loose = base.posterior.log_evidence - base.log_evidence;
    const double others = neg_log_prior_odds(base.effects);
    const auto sums_of = [&](const std::vector<std::size_t>& shapes) { return sums(sums_of_base, shapes); };
    LinearizedSet best{{}, {}, -std::numeric_limits<double>::infinity()};
    for (const Amplitudes& start : {base.posterior.amplitudes, open}) {
      const double alone = evidence_model_.best(sums_of_base.own, start, k_reading_rounds).log_evidence;
      LinearizedSet set = add_greedily(evidence_model_, penalties_, sums_of, {{}, start, alone});
      if (set.score > best.score) best = std::move(set);
    }
    best.score -= loose;
    best.score -= others;
    return best;
  }

  const Shape& shape(std::size_t i) const { return shapes_.all()[i]; }

 private:
  /// Sums of a base with the shapes.
  struct BaseSums {
    BaseSums(const ShapeSearch& search, const Fit& base) {
      const Tangent tangent = tangent_of(search.evidence_, base);
      own = search.evidence_model_.sums_of(tangent);
      CJ = search.shapes_.columns().transpose() * tangent.J;
      Cr = search.shapes_.columns().transpose() * tangent.residual;
    }
    TangentSums own;
    Eigen::MatrixXd CJ;
    Eigen::VectorXd Cr;
  };

  /// Sums of the base with these shapes at zero.
  TangentSums sums(const BaseSums& sums_of_base, const std::vector<std::size_t>& chosen) const {
    std::vector<Eigen::Index> columns;
    for (const std::size_t i : chosen) {
      for (Eigen::Index k = 0; k < shape(i).count; ++k) columns.push_back(shape(i).first + k);
    }
    const auto more = static_cast<Eigen::Index>(columns.size());
    const Eigen::Index own = sums_of_base.own.x.size(), all = own + more;
    TangentSums sums = sums_of_base.own;
    sums.JJ.conservativeResize(all, all);
    sums.JJ.bottomRightCorner(more, more) = CC_(columns, columns);
    if (own > 0) {
      sums.JJ.bottomLeftCorner(more, own) = sums_of_base.CJ(columns, Eigen::all);
      sums.JJ.topRightCorner(own, more) = sums.JJ.bottomLeftCorner(more, own).transpose();
    }
    sums.JD.conservativeResize(all, CD_.cols());
    sums.JD.bottomRows(more) = CD_(columns, Eigen::all);
    sums.Jr.conservativeResize(all);
    sums.Jr.tail(more) = sums_of_base.Cr(columns);
    sums.x.conservativeResize(all);
    sums.x.tail(more).setZero();
    sums.prior.conservativeResize(all);
    sums.prior.tail(more).setConstant(size_);
    Eigen::MatrixXd caliper_information = Eigen::MatrixXd::Zero(all, all);
    if (own > 0) caliper_information.topLeftCorner(own, own) = sums_of_base.own.caliper_information;
    sums.caliper_information = std::move(caliper_information);
    sums.caliper_gradient.conservativeResize(all);
    sums.caliper_gradient.tail(more).setZero();
    return sums;
  }

  const EvidenceModel& evidence_model_;
  const Evidence& evidence_;
  Shapes shapes_;
  std::vector<double> penalties_;  ///< of each shape
  Eigen::MatrixXd CC_, CD_;
  double size_ = 0;
};

/// `fit` without one of its effects, the others unchanged. A refit of the others would move them from the values beside
/// the discrepancy.
Fit leave_out(const Fitter& fitter, const Fit& fit, const fusee::Effect& effect) {
  Fit others = fit;
  others.effects = without(fit.effects, effect);
  others.at = without(fit.at, effect);
  const std::vector<Eigen::Index> own = places_of(fit, effect);
  others.residual = fitter.residual(others.at, fit.loose_row);
  others.usable = others.residual.allFinite();
  std::vector<Eigen::Index> kept;
  others.parameters.clear();
  for (Eigen::Index k = 0; k < fit.x.size(); ++k) {
    if (std::count(own.begin(), own.end(), k)) continue;
    kept.push_back(k);
    others.parameters.push_back(fit.parameters[static_cast<std::size_t>(k)]);
  }
  others.x = fit.x(kept);
  others.J = fit.J(Eigen::all, kept);
  return others;
}

/// True for effects that follow temperature or begin at some time: a drift beside them may follow any course (held-out
/// seeds 131078 and 131119: thermal_expansion by 101 and 71 nats beside a slipping press fit and a worn pin).
bool depends_on_time(const fusee::Effect& effect) { return effect.needs.temperature || effect.starts_in_time; }

/// True if the group contains an effect that leaves the joint free within a play, which can absorb any residual.
bool has_loose_member(const std::vector<std::string>& group, const EffectSet& catalogue) {
  return std::any_of(catalogue.begin(), catalogue.end(), [&](const fusee::Effect* effect) {
    return effect->loosens && std::count(group.begin(), group.end(), effect->name) > 0;
  });
}

/// Log odds that an effect requires against the best unmodelled alternative, if no other cause is unexplained.
double required_log_odds(const fusee::Effect& effect, const std::vector<std::string>& group,
                         const EffectSet& catalogue) {
  const bool has_no_shape = depends_on_time(effect) || has_loose_member(group, catalogue);
  return has_no_shape ? k_thresholds.ahead_without_shape : k_thresholds.ahead_of_unmodelled;
}

/// Tests effects that exceed all other alternatives against unmodelled effects. `with`: score with all effects.
void test_unmodelled_effects(const Evidence& evidence, FitterPool& pool, const Selection& selection, double with,
                             std::vector<UnmodelledAlternative>& rivals) {
  std::vector<bool> asked;
  for (const UnmodelledAlternative& rival : rivals) asked.push_back(rival.log_odds >= k_thresholds.ahead_of_unmodelled);
  std::vector<UnmodelledSubstitute> substitutes =
      fit_unmodelled_effects(evidence, pool, selection, asked, with - k_thresholds.ahead_of_unmodelled);
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    if (!(with - substitutes[i].score < rivals[i].log_odds)) continue;
    rivals[i].log_odds = with - substitutes[i].score;
    rivals[i].words = std::move(substitutes[i].words);
    rivals[i].separating_run = std::move(substitutes[i].separating_run);
  }
}

}  // namespace

std::vector<UnmodelledAlternative> find_unmodelled_alternatives(const Evidence& evidence, FitterPool& pool,
                                                                const Selection& selection) {
  const Fit& best = selection.best;
  std::vector<UnmodelledAlternative> rivals(best.effects.size());
  if (rivals.empty()) return rivals;
  const ShapeSearch search(evidence, selection);
  std::vector<LinearizedSet> selections(rivals.size() + 1);
  pool.each(selections.size(), [&](const Fitter& fitter, std::size_t i) {
    const Fit& base = i == 0 ? best : selection.without[i - 1];
    if (!base.usable) return;
    selections[i] = search.explain(base, best.posterior.amplitudes);
    if (i == 0) return;
    const Fit others = leave_out(fitter, best, *best.effects[i - 1]);
    if (!others.usable) return;
    LinearizedSet stayed = search.explain(others, best.posterior.amplitudes);
    if (stayed.score > selections[i].score) selections[i] = std::move(stayed);
  });
  const std::vector<LoadScaleFit> loads = fit_load_scales(evidence, pool, selection);
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    if (!selection.without[i].usable) {
      rivals[i].log_odds = 0;  // The effect cannot be distinguished from an unmodelled cause.
      continue;
    }
    const LinearizedSet& instead = selections[i + 1];
    rivals[i].log_odds = selections.front().score - std::max(instead.score, loads[i].score);
    if (loads[i].score > instead.score) {
      rivals[i].words = "loads of " + rounded(loads[i].times, 2) + " times what was logged";
      rivals[i].separating_run = "hang a known weight where the load acts and compare it with what is logged";
      continue;
    }
    for (const std::size_t shape : instead.members) {
      if (std::count(selections.front().members.begin(), selections.front().members.end(), shape)) continue;
      rivals[i].words = search.shape(shape).words;
      rivals[i].separating_run = separating_run(search.shape(shape).dependence);
      break;
    }
  }
  test_unmodelled_effects(evidence, pool, selection, selections.front().score, rivals);
  return rivals;
}

void add_unmodelled(bool beside_unmodelled, const Selection& selection, std::vector<FoundEffect>& effects) {
  const bool is_sure =
      !beside_unmodelled && std::none_of(effects.begin(), effects.end(),
                                         [](const FoundEffect& effect) { return effect.unmodelled.log_odds < 0; });
  for (std::size_t i = 0; i < effects.size(); ++i) {
    std::vector<std::string>& group = effects[i].group;
    const double least = is_sure ? required_log_odds(*selection.best.effects[i], group, selection.catalogue)
                                 : std::numeric_limits<double>::infinity();
    if (selection.groups[i].absence_probability > k_thresholds.most_false_positives || effects[i].idle_did_as_well ||
        effects[i].unmodelled.log_odds < least)
      group.emplace_back(k_unmodelled);
  }
}

}  // namespace fusee::calibration
