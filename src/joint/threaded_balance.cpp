#include "joint/threaded_balance.h"

#include <algorithm>
#include <cmath>

#include "joint/tendon_balance.h"

namespace fusee::joint {
namespace {

constexpr std::size_t k_bends = ThreadedSpans::k_bends;
constexpr std::size_t k_spans = k_bends + 1;
using Slides = std::array<int, k_bends>;

/// The set of sliding bends is found by trial. Few sets are tried, since sliding spreads through the sheath from one
/// end. Only rounding can make a set recur, which the limit ends.
constexpr int k_most_trials = 64;
/// Limit of the Newton steps for one tension.
constexpr int k_most_steps = 60;
/// Relative Newton step that ends the search: convergence is quadratic, so the error left is rounding.
constexpr double k_last_relative_step = 1e-7;
/// Material passing a bend in the wrong direction below this fraction of a span is rounding.
constexpr double k_rounding = 1e-14;

/// Spans `first` … `last` with all bends between them sliding: their tensions have fixed ratios to that of the first.
struct SlidingSpans {
  const ThreadedSpans& spans;
  std::size_t first, last;
  std::array<double, k_spans> ratio{};

  SlidingSpans(const ThreadedSpans& all, const Slides& slides, std::size_t begin)
      : spans(all), first(begin), last(begin) {
    ratio[first] = 1.0;
    while (last < k_bends && slides[last] != 0) {
      ratio[last + 1] = ratio[last] * elementary::exp(-slides[last] * spans.holds[last]);
      ++last;
    }
  }
  double stretch() const {
    double sum = 0;
    for (std::size_t i = first; i <= last; ++i) sum += spans.length[i] - spans.material[i];
    return sum;
  }
  /// Derivative of the stretch of span `i` by the tension `t` of the first span. mm/N
  double compliance(std::size_t i, double t) const {
    const double density = 1.0 / (1.0 + ratio[i] * t / spans.EA);
    return spans.length[i] * ratio[i] / spans.EA * density * density;
  }
  double compliance(double t) const {
    double sum = 0;
    for (std::size_t i = first; i <= last; ++i) sum += compliance(i, t);
    return sum;
  }
  /// Newton step towards the tension at which all material is in these spans: Σ L/(1 + r t/EA) = Σ n.
  double step_from(double t) const {
    double beyond = 0, slope = 0;
    for (std::size_t i = first; i <= last; ++i) {
      const double density = 1.0 / (1.0 + ratio[i] * t / spans.EA);
      beyond += spans.length[i] * density - spans.material[i];
      slope += spans.length[i] * ratio[i] * density * density;
    }
    return beyond * spans.EA / slope;
  }
  // The function is convex, so that steps from 0 converge monotonically and quadratically.
  double tension() const {
    if (first == last) return tension_of(spans.EA, spans.length[first], spans.material[first]);
    if (!(stretch() > 0)) return 0;
    double t = 0, by = 0;
    for (int step = 0; step < k_most_steps && (step == 0 || std::abs(by) > k_last_relative_step * t); ++step) {
      by = step_from(t);
      t = std::max(0.0, t + by);
    }
    return t;
  }
};

/// Sets the material of spans without tension: excess material of some spans fills the missing length of others, and no
/// more moves.
void fill_slack(const ThreadedSpans& spans, std::size_t first, std::size_t last,
                std::array<double, k_spans>& material) {
  double wanted = 0;
  for (std::size_t i = first; i <= last; ++i) {
    const double missing = std::max(0.0, spans.length[i] - spans.material[i]);
    material[i] = spans.material[i] + missing;
    wanted += missing;
  }
  for (std::size_t i = first; i <= last; ++i) {
    const double given = std::clamp(material[i] - spans.length[i], 0.0, wanted);
    material[i] -= given;
    wanted -= given;
  }
}

/// The balance if these bends slide.
ThreadedBalance balance_of(const ThreadedSpans& spans, const Slides& slides) {
  ThreadedBalance now;
  now.slides = slides;
  for (std::size_t first = 0; first < k_spans;) {
    const SlidingSpans sliding(spans, slides, first);
    const double t = sliding.tension();
    std::array<double, k_spans> material = spans.material;
    for (std::size_t i = first; i <= sliding.last; ++i) {
      now.tension[i] = sliding.ratio[i] * t;
      if (sliding.last > first) material[i] = spans.length[i] / (1.0 + now.tension[i] / spans.EA);
    }
    if (sliding.last > first && t == 0) fill_slack(spans, first, sliding.last, material);
    double gained = 0;
    for (std::size_t i = first; i < sliding.last; ++i) {
      gained += material[i] - spans.material[i];
      now.crossed[i] = gained;
    }
    if (first == 0 && t > 0) {
      const double all = sliding.compliance(t);
      now.per_length = 1.0 / ((1.0 + t / spans.EA) * all);
      now.per_hold = slides[0] * t * (all - sliding.compliance(0, t)) / all;
      now.lower_per_upper = sliding.last == k_bends ? sliding.ratio[k_bends] : 0.0;
    }
    first = sliding.last + 1;
  }
  return now;
}

/// Lets those bends slide at which the ratio of tensions exceeds what friction sustains. False if there are none.
bool let_slide(const ThreadedSpans& spans, const ThreadedBalance& now, Slides& slides) {
  bool any = false;
  for (std::size_t j = 0; j < k_bends; ++j) {
    if (slides[j] != 0) continue;
    const double most = elementary::exp(spans.holds[j]);
    if (now.tension[j] > most * now.tension[j + 1]) slides[j] = 1;
    if (now.tension[j + 1] > most * now.tension[j]) slides[j] = -1;
    any = any || slides[j] != 0;
  }
  return any;
}

/// Stops the bend that slides most against its friction. False if there is none.
bool stop_worst(const ThreadedSpans& spans, const ThreadedBalance& now, Slides& slides) {
  std::size_t worst = k_bends;
  double most = k_rounding;
  for (std::size_t j = 0; j < k_bends; ++j) {
    if (slides[j] == 0 || now.tension[j] == 0) continue;
    const double wrong = -slides[j] * now.crossed[j] / spans.length[j];
    if (!(wrong > most)) continue;
    worst = j;
    most = wrong;
  }
  if (worst == k_bends) return false;
  slides[worst] = 0;
  return true;
}

PinContact contact_of(const ThreadedBalance& now) {
  if (now.tension.front() == 0 && now.tension.back() == 0) return PinContact::slack;
  for (const int one : now.slides) {
    if (one == 0 || one != now.slides[0]) return PinContact::stick;
  }
  return now.slides[0] > 0 ? PinContact::slip_up : PinContact::slip_down;
}

}  // namespace

ThreadedBalance balance(const ThreadedSpans& spans, const Slides& likely) {
  Slides slides = likely;
  ThreadedBalance now = balance_of(spans, slides);
  for (int trial = 0; trial < k_most_trials; ++trial) {
    if (!stop_worst(spans, now, slides) && !let_slide(spans, now, slides)) break;
    now = balance_of(spans, slides);
  }
  now.contact = contact_of(now);
  return now;
}

double sliding_rate(const ThreadedSpans& spans, const ThreadedBalance& now) {
  const double t = now.tension[0];
  if (!(t > 0)) return 0;
  double compliance = 0;
  for (std::size_t i = 0; i < k_spans; ++i) {
    const double density = 1.0 / (1.0 + now.tension[i] / spans.EA);
    compliance += spans.length[i] * now.tension[i] / (t * spans.EA) * density * density;
  }
  return 1.0 / ((1.0 + t / spans.EA) * compliance);
}

}  // namespace fusee::joint
