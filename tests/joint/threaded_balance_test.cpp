// A tendon in a sheath with friction at every bend. Checks the conditions that make the balance unique: material is
// conserved, no bend exceeds its friction, and sliding bends are at their limit.
#include "joint/threaded_balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

namespace fusee::joint {
namespace {

constexpr std::size_t k_bends = ThreadedSpans::k_bends;
using Slides = std::array<int, k_bends>;

/// Random tendons in a sheath.
class RandomTendon {
 public:
  explicit RandomTendon(unsigned seed) : random_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// Random strains between `least` and `most`, independent for each span.
  ThreadedSpans spans(double least, double most) {
    ThreadedSpans all;
    all.EA = between(1000, 30000);
    for (std::size_t i = 0; i <= k_bends; ++i) {
      all.length[i] = between(20, 150);
      all.material[i] = all.length[i] / (1.0 + between(least, most));
    }
    for (double& hold : all.holds) hold = between(0.0, 0.3);
    return all;
  }
  Slides guess() {
    Slides slides{};
    for (int& one : slides) one = static_cast<int>(std::floor(between(-1, 2)));
    return slides;
  }

 private:
  std::mt19937 random_;
};

/// Material of span `i` after the balance.
double material_after(const ThreadedSpans& spans, const ThreadedBalance& now, std::size_t i) {
  return spans.material[i] + (i < k_bends ? now.crossed[i] : 0.0) - (i > 0 ? now.crossed[i - 1] : 0.0);
}

void expect_balanced(const ThreadedSpans& spans, const ThreadedBalance& now) {
  for (std::size_t i = 0; i <= k_bends; ++i) {
    const double strain = spans.length[i] / material_after(spans, now, i) - 1.0;
    EXPECT_NEAR(now.tension[i], spans.EA * std::max(0.0, strain), 1e-9) << i;
  }
  for (std::size_t j = 0; j < k_bends; ++j) {
    const double above = now.tension[j], below = now.tension[j + 1], most = std::exp(spans.holds[j]);
    EXPECT_LE(above, most * below * (1 + 1e-12)) << j;
    EXPECT_LE(below, most * above * (1 + 1e-12)) << j;
    if (above == 0) continue;
    const double beyond_limit = now.crossed[j] > 0 ? above - most * below : below - most * above;
    EXPECT_LT(std::abs(now.crossed[j]) > 1e-12 ? std::abs(beyond_limit) : 0.0, 1e-9) << j;
  }
}

TEST(Threaded, BalanceIsUnique) {
  RandomTendon random(7);
  int slid = 0, held = 0, mixed = 0;
  for (int i = 0; i < 3000; ++i) {
    const ThreadedSpans spans = random.spans(i % 3 == 0 ? -2e-3 : 1e-3, i % 5 == 0 ? 1.2e-3 : 4e-3);
    const ThreadedBalance now = balance(spans, {});
    expect_balanced(spans, now);
    const ThreadedBalance again = balance(spans, random.guess());
    for (std::size_t k = 0; k <= k_bends; ++k) EXPECT_NEAR(again.tension[k], now.tension[k], 1e-9);
    const int moving =
        static_cast<int>(k_bends - static_cast<std::size_t>(std::count(now.slides.begin(), now.slides.end(), 0)));
    if (moving == 0)
      ++held;
    else if (moving == k_bends)
      ++slid;
    else
      ++mixed;
    if (HasFailure()) return;
  }
  EXPECT_GT(slid, 100);
  EXPECT_GT(held, 20);
  EXPECT_GT(mixed, 500);
}

TEST(Threaded, RatesAgreeWithDifferences) {
  RandomTendon random(11);
  int sliding_throughout = 0;
  for (int i = 0; i < 500; ++i) {
    const ThreadedSpans spans = random.spans(1e-3, 4e-3);
    const ThreadedBalance now = balance(spans, {});
    constexpr double step = 1e-6;
    const auto differ = [&](auto change) {
      ThreadedSpans more = spans, less = spans;
      change(more) += step;
      change(less) -= step;
      return std::pair(balance(more, now.slides), balance(less, now.slides));
    };
    const auto [longer, shorter] = differ([](ThreadedSpans& s) -> double& { return s.length[0]; });
    const auto [firmer, looser] = differ([](ThreadedSpans& s) -> double& { return s.holds[0]; });
    // There is a kink where a bend just begins to slide.
    if (longer.slides != shorter.slides || firmer.slides != looser.slides) continue;
    const double rate = (longer.tension[0] - shorter.tension[0]) / (2 * step);
    EXPECT_NEAR(now.per_length, rate, 1e-5 * rate);
    EXPECT_NEAR(now.lower_per_upper * rate, (longer.tension[k_bends] - shorter.tension[k_bends]) / (2 * step),
                1e-5 * rate);
    EXPECT_NEAR(now.per_hold, (firmer.tension[0] - looser.tension[0]) / (2 * step), 1e-5 * now.tension[0]);
    sliding_throughout += now.lower_per_upper > 0 ? 1 : 0;
  }
  EXPECT_GT(sliding_throughout, 10);
}

TEST(Threaded, SlidingFrontStartsAtPulledEnd) {
  ThreadedSpans spans;
  spans.EA = 10000;
  spans.length.fill(80);
  spans.material.fill(80 / 1.001);  // 10 N everywhere
  spans.holds.fill(0.05);
  std::size_t last = 0;
  for (double pulled = 0; pulled < 1.0; pulled += 0.01) {
    spans.length.back() = 80 + pulled;
    const ThreadedBalance now = balance(spans, {});
    std::size_t moving = 0;
    for (std::size_t j = k_bends; j-- > 0 && now.slides[j] != 0;) ++moving;
    EXPECT_GE(moving, last) << pulled;
    EXPECT_EQ(now.tension[0] > 10.0 + 1e-9, moving == k_bends) << pulled;
    last = moving;
  }
  EXPECT_EQ(last, k_bends);
}

}  // namespace
}  // namespace fusee::joint
