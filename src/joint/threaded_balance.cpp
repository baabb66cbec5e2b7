#include "joint/threaded_balance.h"

#include <algorithm>
#include <cmath>

namespace fusee {
namespace {

constexpr std::size_t k_bends = ThreadedSpans::k_bends;
constexpr std::size_t k_spans = k_bends + 1;
using Slides = std::array<int, k_bends>;

/// Which bends hold and which slide is found by trial. Sets that were tried are few (a front that runs through the
/// sheath from one end); rounding alone can make one return.
constexpr int k_most_trials = 64;
constexpr int k_most_steps = 60;
/// After a step of this share what is left is rounding.
constexpr double k_squared_away = 1e-7;
/// Material that goes the wrong way past a bend by less is rounding's, of the length of a span.
constexpr double k_rounding = 1e-14;

double tension_of(double EA, double length, double material) {
  return length > material ? EA * (length / material - 1.0) : 0.0;
}

/// Spans `first` … `last`, all bends between them sliding: tensions in fixed ratios to that of the first.
struct Joined {
  const ThreadedSpans& spans;
  std::size_t first, last;
  std::array<double, k_spans> ratio{};

  Joined(const ThreadedSpans& all, const Slides& slides, std::size_t begin) : spans(all), first(begin), last(begin) {
    ratio[first] = 1.0;
    while (last < k_bends && slides[last] != 0) {
      ratio[last + 1] = ratio[last] * std::exp(-slides[last] * spans.holds[last]);
      ++last;
    }
  }
  double stretch() const {
    double sum = 0;
    for (std::size_t i = first; i <= last; ++i) sum += spans.length[i] - spans.material[i];
    return sum;
  }
  double softness(std::size_t i, double t) const {
    const double share = 1.0 / (1.0 + ratio[i] * t / spans.EA);
    return spans.length[i] * ratio[i] / spans.EA * share * share;
  }
  double softness(double t) const {
    double sum = 0;
    for (std::size_t i = first; i <= last; ++i) sum += softness(i, t);
    return sum;
  }
  /// Newton's step to where all material is in these spans: Σ L/(1 + r t/EA) = Σ n.
  double step_from(double t) const {
    double beyond = 0, slope = 0;
    for (std::size_t i = first; i <= last; ++i) {
      const double share = 1.0 / (1.0 + ratio[i] * t / spans.EA);
      beyond += spans.length[i] * share - spans.material[i];
      slope += spans.length[i] * ratio[i] * share * share;
    }
    return beyond * spans.EA / slope;
  }
  // Hollow: steps from 0 come up to it, and each squares the miss.
  double tension() const {
    if (first == last) return tension_of(spans.EA, spans.length[first], spans.material[first]);
    if (!(stretch() > 0)) return 0;
    double t = 0, by = 0;
    for (int step = 0; step < k_most_steps && (step == 0 || std::abs(by) > k_squared_away * t); ++step) {
      by = step_from(t);
      t = std::max(0.0, t + by);
    }
    return t;
  }
};

/// Without tension what hangs loose fills what is short, and no more moves: the spans' material.
void fill(const ThreadedSpans& spans, std::size_t first, std::size_t last, std::array<double, k_spans>& material) {
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

/// What comes out if these bends slide.
ThreadedBalance with(const ThreadedSpans& spans, const Slides& slides) {
  ThreadedBalance now;
  now.slides = slides;
  for (std::size_t first = 0; first < k_spans;) {
    const Joined joined(spans, slides, first);
    const double t = joined.tension();
    std::array<double, k_spans> material = spans.material;
    for (std::size_t i = first; i <= joined.last; ++i) {
      now.tension[i] = joined.ratio[i] * t;
      if (joined.last > first) material[i] = spans.length[i] / (1.0 + now.tension[i] / spans.EA);
    }
    if (joined.last > first && t == 0) fill(spans, first, joined.last, material);
    double gained = 0;
    for (std::size_t i = first; i < joined.last; ++i) {
      gained += material[i] - spans.material[i];
      now.crossed[i] = gained;
    }
    if (first == 0 && t > 0) {
      const double all = joined.softness(t);
      now.per_length = 1.0 / ((1.0 + t / spans.EA) * all);
      now.per_hold = slides[0] * t * (all - joined.softness(0, t)) / all;
      now.lower_per_upper = joined.last == k_bends ? joined.ratio[k_bends] : 0.0;
    }
    first = joined.last + 1;
  }
  return now;
}

/// Bends that hold more than they can slide. False if there are none.
bool let_slide(const ThreadedSpans& spans, const ThreadedBalance& now, Slides& slides) {
  bool any = false;
  for (std::size_t j = 0; j < k_bends; ++j) {
    if (slides[j] != 0) continue;
    const double most = std::exp(spans.holds[j]);
    if (now.tension[j] > most * now.tension[j + 1]) slides[j] = 1;
    if (now.tension[j + 1] > most * now.tension[j]) slides[j] = -1;
    any = any || slides[j] != 0;
  }
  return any;
}

/// The bend that slides against its friction by most holds. False if there is none.
bool hold(const ThreadedSpans& spans, const ThreadedBalance& now, Slides& slides) {
  std::size_t worst = k_bends;
  double most = k_rounding;
  for (std::size_t j = 0; j < k_bends; ++j) {
    if (slides[j] == 0 || now.tension[j] == 0) continue;
    const double wrong = -slides[j] * now.crossed[j] / spans.length[j];
    if (wrong > most) worst = j, most = wrong;
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
  ThreadedBalance now = with(spans, slides);
  for (int trial = 0; trial < k_most_trials; ++trial) {
    if (!hold(spans, now, slides) && !let_slide(spans, now, slides)) break;
    now = with(spans, slides);
  }
  now.contact = contact_of(now);
  return now;
}

double sliding_rate(const ThreadedSpans& spans, const ThreadedBalance& now) {
  const double t = now.tension[0];
  if (!(t > 0)) return 0;
  double softness = 0;
  for (std::size_t i = 0; i < k_spans; ++i) {
    const double share = 1.0 / (1.0 + now.tension[i] / spans.EA);
    softness += spans.length[i] * now.tension[i] / (t * spans.EA) * share * share;
  }
  return 1.0 / ((1.0 + t / spans.EA) * softness);
}

}  // namespace fusee
