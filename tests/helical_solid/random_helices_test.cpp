// Random helical pulleys: each is a valid solid or reports why it cannot be built.
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include "fusee/helical_solid.h"
#include "helical_solid/spirals.h"
#include "solid/print.h"
#include "support/mechanisms.h"
#include "support/shapes.h"

namespace fusee::helical_solid {
namespace {

struct RandomPulley {
  Mechanism mechanism = testing::forearm();
  helix::Spiral p1, p2;
  std::string words;
};

class PulleyGenerator {
 public:
  explicit PulleyGenerator(unsigned seed) : random_(seed) {}

  RandomPulley next() {
    RandomPulley random;
    Mechanism& m = random.mechanism;
    m.body = testing::plain_mechanism().body;
    m.material = testing::plain_mechanism().material;
    m.print = testing::plain_mechanism().print;
    m.tendon.diameter = within(0.4, 1.6);
    m.body.groove =
        std::array{Groove::u, Groove::u, Groove::v, Groove::flat}[static_cast<std::size_t>(within(0, 3.999))];
    m.body.groove_angle = radians(within(30, 90));
    m.body.flange_thickness = within(0.8, 2.0);
    const HelicalSection section = helical_section(m);
    random.p1 = spiral(section, random.words);
    random.p2 = spiral(section, random.words);
    return random;
  }

 private:
  double within(double low, double high) {
    constexpr double k_most = 4294967295.0;  // std::mt19937::max()
    return low + (high - low) * static_cast<double>(random_()) / k_most;
  }

  helix::Spiral spiral(const HelicalSection& section, std::string& words) {
    const double turns = within(1.2, 8.0), radius = within(9, 28), begin = within(-10, 10);
    const double per_turn = within(-0.5, 0.5) * (radius - 5.0) / turns,
                 wave = within(0, 0.14) * std::min(radius, radius + per_turn * turns);
    const testing::SupportCurve curve = testing::oval(radius, per_turn, wave, begin);
    const double slope =
        (testing::slope_for(curve, begin, turns, section) * within(1.0, 1.3) + 1e-6) * (within(0, 1) < 0.2 ? -1 : 1);
    words += " r " + std::to_string(radius) + " turns " + std::to_string(turns) + " per turn " +
             std::to_string(per_turn) + " wave " + std::to_string(wave);
    helix::Spiral spiral = testing::spiral_of(curve, begin, turns, slope);
    // Every spiral has a free end that is long enough.
    spiral.first_used = spiral.last_used = spiral.rows.size() / 2;
    return spiral;
  }

  std::mt19937 random_;
};

std::string failed(const std::vector<Check>& checks) {
  std::string text;
  for (const Check& check : checks) {
    if (!check.ok) text += " " + check.name + " " + std::to_string(check.value) + " " + check.where;
  }
  return text;
}

// FUSEE_HELICES: number of pulleys. FUSEE_HELICES_SEED: seed.
TEST(RandomHelices, AreSolidsOrReportWhyNot) {
  const char* wanted = std::getenv("FUSEE_HELICES");
  const char* seed = std::getenv("FUSEE_HELICES_SEED");
  const int count = wanted != nullptr ? std::atoi(wanted) : 12;
  PulleyGenerator generator(seed != nullptr ? static_cast<unsigned>(std::atoi(seed)) : 20261122u);
  int made = 0;
  double longest = 0;
  for (int n = 0; n < count; ++n) {
    const RandomPulley random = generator.next();
    const auto begin = std::chrono::steady_clock::now();
    const HelicalPulley pulley = make_helical_pulley(random.mechanism, random.p1, random.p2);
    longest = std::max(longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    const std::string which =
        std::to_string(n) + random.words + " d " + std::to_string(random.mechanism.tendon.diameter);
    if (!pulley.made) {
      EXPECT_EQ(pulley.brief().find("intersect one another"), std::string::npos) << which << pulley.brief();
      if (count > 50) printf("%d not made: %s\n", n, pulley.brief().c_str());
      continue;
    }
    ++made;
    EXPECT_EQ(failed(check_helical_pulley(pulley.mesh, pulley, helical_section(random.mechanism))), "") << which;
    EXPECT_EQ(failed(solid::check_print(pulley.mesh)), "") << which;
    EXPECT_EQ(helical_floors(pulley.mesh, pulley.layout.scale).size(), 2u) << which;
  }
  EXPECT_GT(made, count / 2);
  RecordProperty("made", made);
  printf("%d of %d made, the longest took %.2f s\n", made, count, longest);
}

}  // namespace
}  // namespace fusee::helical_solid
