// The eighth split that is kept aside: each fault is what it says, by hand.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "fusee/transmission/transmission.h"
#include "rig/fault_checks.h"

namespace fusee::rig {
namespace unmet {

/// Of what comes within a time constant, after so many of them.
double come(double constants) { return 1.0 - std::exp(-constants); }

// ---- motor and shaft, by hand: a stiff joint stands where the law says ----------------------------------------------

TEST(Unmet, commands_come_in_beats) {
  const Hidden hidden = with("commands_in_beats", 0.1, stiff());
  std::vector<double> memory;
  Moment now;
  now.seconds = 0;
  EXPECT_EQ(acted(hidden.shaft.at(0), now, memory), 0.0);
  // At 2 rad/s; on the beat it is where it should be, and where the plan rests as soon as it is told.
  for (const auto& [seconds, speed, off] : {std::tuple{0.02, 2.0, -0.04},
                                            {0.07, 2.0, -0.18},
                                            {0.02, 2.0, -0.02},
                                            {0.05, 2.0, -0.12},
                                            {0.03, 0.0, -0.12},
                                            {0.05, 0.0, 0.0},
                                            {0.31, -2.0, 0.1}}) {
    now.seconds = seconds, now.alpha_speed = speed;
    now.alpha += seconds * speed;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), off, 1e-9) << now.alpha;
  }
  // Half a beat late on an average, never more than one, and right after a rest.
  const Log log = run_of(hidden, {0.0, k_fast, 2, 2.0}, stiff());
  const Transmission law(stiff().declared);
  double sum = 0, rows = 0;
  for (std::size_t row = 1; row < log.size(); ++row) {
    const double speed = (log[row].alpha - log[row - 1].alpha) / (log[row].time - log[row - 1].time);
    const bool moves = std::abs(speed) > 1e-9;
    if (!moves) {
      const bool settled = row >= 6 && log[row - 6].alpha == log[row].alpha;
      EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha), settled ? 1e-5 : 0.1) << row;
      continue;
    }
    const double least = law.theta(log[row].alpha - speed * 0.101), most = law.theta(log[row].alpha + speed * 1e-3);
    EXPECT_GE(log[row].theta, std::min(least, most)) << row;
    EXPECT_LE(log[row].theta, std::max(least, most)) << row;
    sum += (law.theta(log[row].alpha) - log[row].theta) / (most - least) * 0.102, rows += 1.0;
  }
  EXPECT_NEAR(sum / rows, 0.05, 0.01);
}

TEST(Unmet, every_reversal_beats_the_keyway_wider) {
  const Hidden hidden = with("keyway_beaten_out", 0.01, stiff());
  std::vector<double> memory;
  Moment now;
  for (const auto& [alpha, direction, off] : {std::tuple{0.0, 0.0, 0.0},
                                              {-0.5, -1.0, 0.0},
                                              {-0.2, 1.0, -0.005},
                                              {0.5, 1.0, -0.005},
                                              {0.499, -1.0, -0.004},
                                              {0.3, -1.0, 0.01},
                                              {0.4, 1.0, -0.015}}) {
    now.alpha = alpha, now.direction = direction;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), off, 1e-12) << alpha;
  }
  // Home, down to the sweep's begin, up, down, up, down: one to four blows.
  const Log log = run_of(hidden, {0.0, k_slow, 2}, stiff());
  const auto way = [](std::size_t row) { return (row - 1) / 80; };
  const Transmission law(stiff().declared);
  for (std::size_t row = 1; row < log.size(); ++row) {
    const bool up = way(row) % 2 == 0, taken_up = (row - 1) % 80 >= 5;
    const double half = 0.005 * (1.0 + static_cast<double>(way(row)));
    EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + (up ? -half : half)), taken_up ? 1e-5 : 0.05) << row;
  }
}

TEST(Unmet, beyond_a_soft_limit_the_shaft_stands) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("command_beyond_soft_limit", 0.25, stiff(), {sign, 1.0, 0.5});
    const double end = 0.75 * (sign > 0 ? stiff().alpha_max : stiff().alpha_min);
    const Log log = run_of(hidden, {0.0, k_slow, 1}, stiff());
    const Transmission law(stiff().declared);
    int beyond = 0;
    for (const Row& row : log) {
      const double shaft = sign > 0 ? std::min(row.alpha, end) : std::max(row.alpha, end);
      EXPECT_NEAR(row.theta, law.theta(shaft), 1e-5) << row.alpha;
      beyond += shaft != row.alpha ? 1 : 0;
    }
    EXPECT_GE(beyond, 10);
  }
}

TEST(Unmet, each_turning_down_leaves_a_step) {
  const Hidden hidden = with("step_lost_at_turning", 0.005, stiff());
  std::vector<double> memory;
  Moment now;
  for (const auto& [direction, off] : {std::pair{0.0, 0.0},
                                       {-1.0, 0.0},
                                       {1.0, 0.0},
                                       {1.0, 0.0},
                                       {-1.0, 0.005},
                                       {-1.0, 0.005},
                                       {1.0, 0.005},
                                       {-1.0, 0.01}}) {
    now.direction = direction;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), off, 1e-15) << direction;
  }
  expect_shaft_off(run_of(hidden, {0.0, k_slow, 2}, stiff()),
                   [](std::size_t row) { return 0.005 * static_cast<double>((row + 79) / 160); });
}

TEST(Unmet, a_ratio_that_is_not_as_quoted_turns_further_in_proportion) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("gear_ratio_misquoted", 0.02, stiff(), {sign, 1.0, 0.5});
    const Log log = run_of(hidden, {0.0, k_slow, 1}, stiff());
    expect_shaft_off(log, [&](std::size_t row) { return sign * 0.02 * log[row].alpha; });
  }
}

// ---- tendon, pins, frame --------------------------------------------------------------------------------------------

TEST(Unmet, a_cord_that_rolls_is_shorter_either_way) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("cord_rolling_in_groove", 0.2, soft(), {sign, 1.0, 0.5});
    EXPECT_TRUE(hidden.longer[sign > 0 ? 0 : 1].empty());
    std::vector<double> memory;
    Moment now;
    // It slides from 0.35 rad on.
    for (const auto& [alpha, share] : {std::pair{0.0, 0.0},
                                       {-0.175, 0.25},
                                       {-0.35, 1.0},
                                       {-0.9, 1.0},
                                       {-0.725, 0.25},
                                       {-0.55, 0.0},
                                       {-0.375, 0.25},
                                       {0.8, 1.0},
                                       {0.45, 0.0}}) {
      now.alpha = alpha;
      EXPECT_NEAR(acted(hidden.longer[sign > 0 ? 1 : 0].at(0), now, memory), 0.2 * share, 1e-12) << alpha;
    }
  }
}

TEST(Unmet, a_braid_sticks_and_jumps) {
  // 20 N, 7.5 deg.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("tendon_chattering_on_pin", 400.0, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    for (const auto& [degree, tension, dry] : {std::tuple{0.0, 20.0, 0.0},
                                               {3.75, 20.0, 200.0},
                                               {1.5, 20.0, 320.0},
                                               {1.5, 40.0, 640.0},
                                               {4.5, 40.0, 160.0},
                                               {4.5, 0.0, 0.0}}) {
      now.alpha = radians(degree), now.tension[sign > 0 ? 1 : 0] = tension, now.tension[sign > 0 ? 0 : 1] = 99.0;
      EXPECT_NEAR(acted(hidden.dry.at(0), now, memory), dry, 1e-9) << degree;
    }
  }
}

TEST(Unmet, a_tendon_lies_between_these_threads_or_those) {
  for (const auto& [sign, share, longer] : {std::tuple{1.0, 0.7, 0.1}, {-1.0, 0.2, -0.1}}) {
    const Hidden hidden = with("tendon_between_threads", 0.1, soft(), {sign, 1.0, share});
    const std::size_t side = sign > 0 ? 1 : 0;
    EXPECT_TRUE(hidden.longer[1 - side].empty());
    std::vector<double> memory;
    Moment now;
    EXPECT_EQ(acted(hidden.longer[side].at(0), now, memory), 0.0) << "as it was threaded";
    double last = 0, falls = 0, there = 0;
    const int turnings = 4000;
    for (int turned = 0; turned < turnings; ++turned) {
      now.direction = turned % 2 == 0 ? -1.0 : 1.0;
      const double at = acted(hidden.longer[side][0], now, memory);
      EXPECT_TRUE(at == 0.0 || at == longer) << at;
      now.alpha += 0.3 * now.direction;
      EXPECT_EQ(acted(hidden.longer[side][0], now, memory), at) << "on the way";
      falls += at != last ? 1.0 : 0.0, there += at != 0 ? 1.0 : 0.0;
      last = at;
    }
    EXPECT_NEAR(falls / turnings, 0.5, 0.03);
    EXPECT_NEAR(there / turnings, 0.5, 0.03);
  }
}

TEST(Unmet, a_plate_turns_by_what_one_tendon_pulls_harder) {
  const double each = 0.5 * give(soft());
  const Hidden hidden = with("plate_of_pins_turning", 0.5, soft());
  BothWays ways(hidden);
  Moment now;
  for (const auto& [first, second, apart] :
       {std::tuple{20.0, 18.0, 0.0}, {40.0, 38.0, 0.0}, {20.0, 30.0, 12.0}, {30.0, 8.0, -20.0}, {0.0, 50.0, 52.0}}) {
    now.tension = {first, second};
    const std::array<double, 2> longer = ways(now);
    EXPECT_NEAR(longer[0], each * apart, 1e-12) << first << " " << second;
    EXPECT_NEAR(longer[1], -each * apart, 1e-12) << first << " " << second;
  }
}

// ---- joint, link, bench ---------------------------------------------------------------------------------------------

TEST(Unmet, a_printed_link_sags_by_the_decade) {
  const Hidden hidden = with("printed_link_sagging", 0.004, soft());
  std::vector<double> memory;
  Moment now;
  const auto sagged = [&](double time, std::size_t run, double load) {
    now.time = time, now.run = run, now.load = load, now.theta += 0.1;
    return acted(hidden.reading.at(0), now, memory);
  };
  const auto decades = [](double seconds) {
    return come(seconds / 3.16) + come(seconds / 31.6) + come(seconds / 316.0);
  };
  EXPECT_EQ(sagged(0.0, 0, 20.0), 0.0);
  EXPECT_NEAR(sagged(3.16, 0, 20.0), -0.004 * decades(3.16), 1e-12);
  EXPECT_NEAR(sagged(31.6, 0, 20.0), -0.004 * decades(31.6), 1e-12);
  const double much = sagged(316.0, 0, 20.0);
  EXPECT_NEAR(much, -0.004 * decades(316.0), 1e-12);
  // By the logarithm: from one decade's spring to the next as much again.
  EXPECT_NEAR(decades(100.0) - decades(10.0), decades(300.0) - decades(30.0), 0.15);
  // Nothing hangs on it in the pause, whatever comes after.
  EXPECT_NEAR(sagged(316.0 + 31.6, 1, -40.0) / -0.004,
              come(100.0) * std::exp(-10.0) + come(10.0) * std::exp(-1.0) + come(1.0) * std::exp(-0.1), 1e-9);
  EXPECT_NEAR(sagged(1e9, 1, -40.0), 0.004 * 2.0 * 3.0, 1e-12);
}

TEST(Unmet, a_compressor_shakes_friction_loose) {
  const Hidden hidden = with("friction_shaken_loose", 500.0, soft());
  std::vector<double> none;
  Moment now;
  // 18 s.
  for (const auto& [time, dry] :
       {std::pair{0.0, 0.0}, {7.1, 0.0}, {7.3, 500.0}, {17.9, 500.0}, {18.1, 0.0}, {26.0, 500.0}, {180.1, 0.0}}) {
    now.time = time, now.load = 3.0 * time;
    EXPECT_EQ(acted(hidden.dry.at(0), now, none), dry) << time;
  }
}

TEST(Unmet, a_wearer_breathes) {
  const Hidden hidden = with("wearer_breathing", 500.0, soft(), {1.0, 0.0, 0.5});
  std::vector<double> none;
  Moment now;
  // 4.5 s.
  for (const auto& [time, torque] :
       {std::pair{0.0, 0.0}, {1.125, 500.0}, {2.25, 0.0}, {3.375, -500.0}, {4.875, 250.0}}) {
    now.time = time, now.theta = 0.1 * time;
    EXPECT_NEAR(acted(hidden.torque.at(0), now, none), torque, 1e-9) << time;
  }
  // Through what gives, and not otherwise.
  const RunPlan plan{0.0, k_slow, 1};
  const std::vector<Log> soft_one = {run_of(hidden, plan, soft())}, stiff_one = {run_of(hidden, plan, stiff())};
  EXPECT_GT(moved(soft_one, {run_of({}, plan, soft())}), radians(0.02));
  EXPECT_LT(moved(stiff_one, {run_of({}, plan, stiff())}), radians(1e-3));
}

TEST(Unmet, a_bench_rocks_over_and_stays) {
  // 6 N.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("bench_rocking_on_feet", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    for (const auto& [load, rocked] : {std::pair{0.0, 0.0},
                                       {-20.0, 0.0},
                                       {5.0, 0.0},
                                       {7.0, 1.0},
                                       {90.0, 1.0},
                                       {0.0, 1.0},
                                       {-5.0, 1.0},
                                       {-7.0, 0.0},
                                       {0.0, 0.0}}) {
      now.load = sign * load;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), -sign * 0.01 * rocked, 1e-15) << load;
    }
  }
}

// ---- sensor and log -------------------------------------------------------------------------------------------------

TEST(Unmet, a_link_walks_to_the_shoulder_it_turns_to) {
  const Hidden hidden = with("link_walking_along_axle", 0.01, soft());
  std::vector<double> memory;
  Moment now;
  // Across within 12 deg; the chip is beside the axis at 1 rad.
  for (const auto& [degree, across] : {std::pair{0.0, 0.0},
                                       {-3.0, -0.5},
                                       {-20.0, -1.0},
                                       {-14.0, 0.0},
                                       {-8.0, 1.0},
                                       {25.0, 1.0},
                                       {22.0, 0.5},
                                       {13.0, -1.0}}) {
    now.theta = radians(degree);
    EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), 0.01 * across * std::cos(now.theta - 1.0), 1e-12) << degree;
  }
}

TEST(Unmet, between_messages_the_joint_is_thought_to_go_on) {
  const Hidden hidden = with("reckoned_between_messages", 0.5, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [time, theta, speed, off] : {std::tuple{10.0, 0.1, 0.2, 0.0},
                                                {10.25, 0.15, 0.2, 0.0},
                                                {10.4, 0.16, -0.2, 0.02},
                                                {10.5, 0.14, -0.2, 0.0},
                                                {10.9, 0.10, 0.0, -0.04},
                                                {12.1, 0.10, 0.0, 0.0},
                                                {12.4, 0.13, 0.1, -0.03}}) {
    now.time = time, now.theta = theta, now.theta_speed = speed;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), off, 1e-12) << time;
  }
  // In haste it runs on beyond both ends.
  const RunPlan plan{0.0, k_fast, 3};
  const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
  const auto higher = [](const Row& a, const Row& b) { return a.theta < b.theta; };
  EXPECT_GT(std::max_element(log.begin(), log.end(), higher)->theta,
            std::max_element(plain.begin(), plain.end(), higher)->theta + radians(1.0));
}

TEST(Unmet, a_companded_angle_is_coarse_far_out) {
  const Hidden hidden = with("companded_telemetry", 0.1, soft());
  std::vector<double> none;
  Moment now;
  // 1.25 deg (e^(k/10) − 1): 2.148 and 7.987 deg for k = 10 and 20, and their neighbours' middles by the logarithm.
  for (const auto& [degree, shown] : {std::pair{0.0, 0.0},
                                      {2.0, 2.1478523},
                                      {-2.2, -2.1478523},
                                      {7.7, 7.9863201},
                                      {8.4, 7.9863201},
                                      {-8.2, -7.9863201},
                                      {0.06, 0.0},
                                      {0.07, 0.1314636}}) {
    now.theta = radians(degree);
    EXPECT_NEAR(degrees(now.theta + acted(hidden.reading.at(0), now, none)), shown, 1e-6) << degree;
  }
  std::set<double> near, far;
  for (int i = 0; i < 5000; ++i) {
    for (const bool out : {false, true}) {
      now.theta = radians(out ? 20.0 : 0.0) + radians(1e-3 * i);
      (out ? far : near).insert(std::round(1e9 * (now.theta + acted(hidden.reading[0], now, none))));
    }
  }
  EXPECT_GE(near.size(), 16u);
  EXPECT_LE(far.size(), 4u);
}

TEST(Unmet, a_body_is_clamped_anew_before_each_run) {
  const Hidden hidden = with("body_clamped_by_eye", 0.01, soft());
  std::vector<double> none;
  Moment now;
  double sum = 0, squares = 0, most = 0;
  const int runs = 4000;
  for (now.run = 0; now.run < runs; ++now.run) {
    now.load = 0.0, now.theta = 0.2;
    const double off = acted(hidden.reading.at(0), now, none);
    now.load = 20.0, now.theta = -0.2, now.time += 3.0;
    EXPECT_EQ(acted(hidden.reading[0], now, none), off) << "clamped";
    sum += off, squares += off * off;
    most = std::max(most, std::abs(off));
  }
  EXPECT_NEAR(sum / runs, 0.0, 5e-4);
  EXPECT_NEAR(std::sqrt(squares / runs), 0.01 / std::sqrt(3.0), 2e-4) << "as likely anywhere within it";
  EXPECT_LE(most, 0.01);
  EXPECT_NE(hidden, with("body_clamped_by_eye", 0.01, soft(), {1.0, 1.1, 0.5}));
}

TEST(Unmet, what_is_shown_shrinks_by_the_minute) {
  const RunPlan plan{0.0, k_slow, 2};
  const Log plain = run_of({}, plan, soft()), log = run_of(with("battery_running_down", 0.02, soft()), plan, soft());
  ASSERT_GT(log.back().time, 20.0);
  for (std::size_t row = 0; row < log.size(); ++row)
    EXPECT_NEAR(log[row].theta, plain[row].theta * (1.0 - 0.02 * plain[row].time / 60.0), 1e-12) << row;
}

TEST(Unmet, a_sensor_falls_asleep_at_rest_and_wakes_late) {
  const Hidden hidden = with("sensor_falling_asleep", 0.04, soft());
  std::vector<double> memory;
  Moment now;
  // After 1 s within 0.1 deg.
  for (const auto& [run, time, theta, off] : {std::tuple{0, 5.0, 0.100, 0.0},
                                              {0, 5.9, 0.1001, 0.0},
                                              {0, 6.5, 0.1001, 0.0},
                                              {0, 6.6, 0.130, -0.0299},
                                              {0, 6.8, 0.070, 0.0301},
                                              {0, 6.9, 0.060, 0.0},
                                              {0, 7.0, 0.080, 0.0},
                                              {0, 9.0, 0.100, 0.0},
                                              {0, 10.5, 0.100, 0.0},
                                              {0, 10.6, 0.110, -0.01},
                                              {1, 20.0, 0.110, 0.0}}) {
    now.run = static_cast<std::size_t>(run), now.time = time, now.theta = theta;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), off, 1e-12) << time;
  }
  const auto off_in = [&](double dwell) {
    const RunPlan plan{0.0, k_slow, 2, dwell};
    return moved({run_of(hidden, plan, soft())}, {run_of({}, plan, soft())});
  };
  EXPECT_EQ(off_in(0.0), 0.0) << "without a rest";
  EXPECT_EQ(off_in(0.5), 0.0);
  EXPECT_GT(off_in(2.0), radians(0.05));
}

TEST(Unmet, a_cable_tugs_the_body_before_each_end) {
  const Hidden hidden = with("body_tugged_by_cable", 0.1, soft());
  std::vector<double> memory;
  Moment now;
  // Taut 10.5 deg from home.
  for (const auto& [degree, shifted] : {std::pair{0.0, 0.0},
                                        {-10.0, 0.0},
                                        {-20.5, -1.0},
                                        {-15.5, -1.0},
                                        {10.0, -1.0},
                                        {15.5, 0.5},
                                        {25.5, 1.5},
                                        {20.5, 1.5},
                                        {-10.0, 1.5},
                                        {-12.5, -0.2}}) {
    now.theta = radians(degree);
    EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), -radians(shifted), 1e-12) << degree;
  }
  // Ahead on both ways.
  const RunPlan plan{0.0, k_slow, 2};
  const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
  const auto off = [&](std::size_t row) { return log[row].theta - plain[row].theta; };
  EXPECT_GT(off(1 + 160 + 40), radians(0.5)) << "up";
  EXPECT_LT(off(1 + 80 + 40), -radians(0.5)) << "down";
}

TEST(Unmet, mist_dries_off_the_scale) {
  const Hidden hidden = with("scale_misted_over", 0.01, soft());
  std::vector<double> none;
  Moment now;
  // 50 in a turn, 50 s; from 1 rad of the wave on.
  for (const auto& [time, wave, height] : {std::tuple{0.0, 0.5 * k_pi - 1.0, 1.0 - std::sin(1.0)},
                                           {0.0, 1.5 * k_pi - 1.0, -1.0 - std::sin(1.0)},
                                           {0.0, 0.0, 0.0},
                                           {50.0, 0.5 * k_pi - 1.0, (1.0 - std::sin(1.0)) / std::exp(1.0)},
                                           {5000.0, 1.5 * k_pi - 1.0, 0.0}}) {
    now.time = time, now.theta = wave / 50.0;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, none), 0.01 * height, 1e-12) << time;
  }
}

}  // namespace unmet
}  // namespace fusee::rig
