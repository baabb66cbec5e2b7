// The simulation that fits go through, of a joint declared by its ratio: every reading in closed form.
#include "joint/forward.h"

#include <gmock/gmock.h>

#include "calibration/linear_joint.h"

namespace fusee::linear {
namespace {

class Geared : public testing::Test {
 protected:
  Measurement measurement = measured({0, 5}, [](const Sample&) { return 0.0; });
  BenchLog log = bench_log(measurement);
  Forward forward{joint(), log};

  Imperfections with(const std::string& effect, double value) const {
    Imperfections at;
    set_value(at, named(effect).parameters.front(), value);
    return at;
  }

  /// Of every row, what it should show.
  void expect(const Imperfections& at, const std::function<double(const fusee::Run&, std::size_t)>& expected) {
    const Readings found = forward(at);
    for (std::size_t r = 0; r < found.size(); ++r) {
      for (std::size_t i = 0; i < found[r].size(); ++i)
        EXPECT_NEAR(found[r][i], expected(measurement.runs[r], i), 1e-14) << r << " " << i;
    }
  }
};

double declared(const fusee::Run& run, std::size_t i) { return run.samples[i].alpha / k_ratio; }

TEST_F(Geared, AsDeclared) { expect({}, declared); }

TEST_F(Geared, AZeroIsAdded) {
  Imperfections at;
  set_value(at, *free_offset(joint()), 0.02);
  expect(at, [](const fusee::Run& run, std::size_t i) { return declared(run, i) + 0.02; });
}

TEST_F(Geared, AGainGrowsWithTheAngle) {
  expect(with("joint_sensor_gain", 0.01), [](const fusee::Run& run, std::size_t i) { return 1.01 * declared(run, i); });
}

TEST_F(Geared, ALoadTurnsItDown) {
  expect(with("tendon_stretch", 1e-3),
         [](const fusee::Run& run, std::size_t i) { return declared(run, i) - 1e-3 * run.samples[i].load; });
}

TEST_F(Geared, PlayFollowsAtHalfItsWidth) {
  constexpr double width = 0.3;
  expect(with("backlash", width), [play = 0.0](const fusee::Run& run, std::size_t i) mutable {
    if (i == 0) play = run.samples[0].alpha + 0.5 * width;  // came from home, downwards
    const double alpha = run.samples[i].alpha;
    play = std::clamp(play, alpha - 0.5 * width, alpha + 0.5 * width);
    return play / k_ratio;
  });
}

TEST_F(Geared, ADelayShowsWhatWas) {
  const Imperfections late = with("sensor_lag", 0.25);  // a quarter of the time between rows
  expect(late, [](const fusee::Run& run, std::size_t i) {
    return i == 0 ? declared(run, 0) : 0.25 * declared(run, i - 1) + 0.75 * declared(run, i);
  });
}

TEST_F(Geared, NothingHoldsALooseJointButTendons) {
  for (const std::vector<double>& run : forward.looseness({})) EXPECT_THAT(run, testing::Each(0.0));
}

}  // namespace
}  // namespace fusee::linear
