// The sixth split that is kept aside: each fault is what it says, by hand.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "fusee/transmission/transmission.h"
#include "rig/fault_checks.h"

namespace fusee::rig {
namespace unread {

// ---- motor and shaft, by hand: a stiff joint stands where the law says ----------------------------------------------

TEST(Unread, a_shaft_is_ahead_of_a_late_motor_sensor) {
  const Transmission law(stiff().declared);
  const Log log = run_of(with("late_motor_sensor", 0.02, stiff()), {0.0, k_fast, 1, 2.0}, stiff());
  int resting = 0;
  for (std::size_t row = 1; row < log.size(); ++row) {
    const double turned = log[row].alpha - log[row - 1].alpha;
    // 90 deg/s for 20 ms.
    const double ahead = turned > 0 ? radians(1.8) : turned < 0 ? -radians(1.8) : 0.0;
    EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + ahead), 1e-5) << row;
    resting += turned == 0 ? 1 : 0;
  }
  EXPECT_EQ(resting, 20);
}

TEST(Unread, a_load_holds_teeth_together_that_have_play) {
  const Hidden hidden = with("play_pressed_by_load", 0.1, stiff());
  std::vector<double> memory;
  Moment now;
  // 4 N.
  for (const auto& [alpha, load, off] : {std::tuple{0.0, 0.0, 0.0},
                                         {0.5, 0.0, -0.05},
                                         {0.48, 0.0, -0.03},
                                         {0.3, 0.0, 0.05},
                                         {0.3, 4.0, -0.05},
                                         {0.6, 4.0, -0.05},
                                         {0.2, 9.0, -0.05},
                                         {0.2, 0.0, -0.05},
                                         {0.19, 0.0, -0.04},
                                         {0.19, -4.0, 0.05},
                                         {0.19, -2.0, 0.05},
                                         {0.3, -2.0, 0.0},
                                         {0.1, -2.0, 0.05},
                                         {0.2, 2.0, -0.05},
                                         {0.1, 2.0, 0.0}}) {
    now.alpha = alpha, now.load = load;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), off, 1e-12) << alpha << " " << load;
  }
  const Transmission law(stiff().declared);
  for (const double load : {20.0, -20.0, 0.0}) {
    const Log log = run_of(hidden, {load, k_slow, 1}, stiff());
    for (std::size_t row = 3; row < log.size(); ++row) {
      if (load == 0 && row > 80 && row < 84) continue;  // within the play
      const double off = load > 0 ? -0.05 : load < 0 ? 0.05 : row <= 80 ? -0.05 : 0.05;
      EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + off), 2e-4) << load << " " << row;
    }
  }
}

TEST(Unread, one_flank_has_a_wave_where_it_carries) {
  const Hidden hidden = with("one_bad_flank", 0.01, stiff());
  std::vector<double> memory;
  Moment now;
  // Nine in a turn, 1 rad on; 2 N.
  for (const auto& [alpha, load, off] : {std::tuple{0.0, 0.0, 0.0042073549},
                                         {0.5, 0.0, -0.0070554033},
                                         {0.5 - radians(1.0), 0.0, -0.0040385717},
                                         {0.4, 0.0, 0.0},
                                         {0.4, 2.0, -0.0049684555},
                                         {0.4, 4.0, -0.0099369100},
                                         {0.6, 4.0, 0.0011654920},
                                         {0.6, -2.0, 0.0005827460},
                                         {0.6, -4.0, 0.0}}) {
    now.alpha = alpha, now.load = load;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), off, 1e-8) << alpha << " " << load;
  }
  const Transmission law(stiff().declared);
  for (const double load : {20.0, -20.0, 0.0}) {
    const Log log = run_of(hidden, {load, k_slow, 1}, stiff());
    for (std::size_t row = 1; row < log.size(); ++row) {
      const bool carries = load > 0 || (load == 0 && row <= 80);
      const double off = carries ? 0.01 * std::sin(9.0 * log[row].alpha + 1.0) : 0.0;
      EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + off), 2e-4) << load << " " << row;
    }
  }
}

TEST(Unread, a_motor_gives_way_by_its_load_and_what_that_heated) {
  const Hidden hidden = with("motor_weak_when_hot", 0.03, soft());
  std::vector<double> memory;
  Moment now;
  // 37.5 s.
  for (const auto& [load, seconds, off] : {std::tuple{0.0, 5.0, 0.0},
                                           {20.0, 1e-9, 0.0},
                                           {20.0, 37.5, -0.0189636168},
                                           {-20.0, 1e-9, 0.0189636168},
                                           {10.0, 1e9, -0.00375},
                                           {0.0, 37.5, 0.0},
                                           {20.0, 1e-9, -0.0027590958}}) {
    now.load = load, now.seconds = seconds;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), off, 1e-10) << load << " " << seconds;
  }
}

TEST(Unread, a_bracket_bends_under_both_tendons) {
  const Hidden hidden = with("motor_bracket_bending", 0.02, soft());
  BothWays ways(hidden);
  Moment now;
  // Pins at 50 beside and 80 above: cos(2 atan 5/8) = 39/89.
  for (const auto& [first, second, longer1, longer2] : {std::tuple{20.0, 20.0, 0.0, 0.0},
                                                        {30.0, 20.0, -0.2, -0.2 * 39 / 89},
                                                        {20.0, 50.0, -0.6 * 39 / 89, -0.6},
                                                        {20.0, 20.0, 0.0, 0.0},
                                                        {0.0, 20.0, 0.4, 0.4 * 39 / 89}}) {
    now.tension = {first, second};
    const std::array<double, 2> longer = ways(now);
    EXPECT_NEAR(longer[0], longer1, 1e-12) << first << " " << second;
    EXPECT_NEAR(longer[1], longer2, 1e-12) << first << " " << second;
  }
}

// ---- pulley, tendon, pins -------------------------------------------------------------------------------------------

TEST(Unread, a_tendon_comes_off_as_it_was_laid_and_is_laid_anew) {
  const Hidden hidden = with("tendon_laid_anew", 0.2, soft());
  EXPECT_TRUE(hidden.longer[0].empty());
  const double piece = radians(16.5), bottom = 1.2 * soft().alpha_min;
  std::vector<double> memory;
  Moment now;
  const auto longer = [&](double pieces) {
    now.alpha = bottom + pieces * piece;
    return acted(hidden.longer[1].at(0), now, memory);
  };
  now.alpha = 0.0;
  EXPECT_EQ(acted(hidden.longer[1].at(0), now, memory), 0.0) << "cut to length at home";
  const double low = longer(3.0), middle = longer(9.5), high = longer(12.0);
  const double end = longer(13.0);
  EXPECT_NEAR(longer(12.5), 0.5 * (high + end), 1e-12) << "straight within a piece";
  EXPECT_NEAR(longer(12.0), high, 1e-12);
  EXPECT_NEAR(longer(9.5), middle, 1e-12);
  EXPECT_NEAR(longer(3.0), low, 1e-12);
  longer(9.5);
  EXPECT_GT(std::abs(longer(12.0) - high), 1e-3);
  EXPECT_NEAR(longer(3.0), low, 1e-12) << "what was not unwound lies where it lay";
  // 0.2 mm times a piece, on an average.
  double sum = 0, squares = 0;
  const int times = 4000;
  for (int time = 0; time < times; ++time) {
    const double before = longer(4.0), height = (longer(5.0) - before) / (0.2 * piece);
    longer(3.5);
    sum += height, squares += height * height;
  }
  EXPECT_NEAR(sum / times, 0.0, 0.06);
  EXPECT_NEAR(std::sqrt(squares / times), 1.0, 0.04);
}

TEST(Unread, a_barb_scrapes_over_its_pin_one_way) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("barb_on_tendon", 400.0, soft(), {sign, 1.0, 0.5});
    const double at = 0.5 * (soft().alpha_min + soft().alpha_max), wide = radians(5.0 + 7.5 / k_pi);
    std::vector<double> none;
    Moment now;
    for (const auto& [off, way, tension, dry] : {std::tuple{0.0, 1.0, 20.0, 400.0},
                                                 {0.0, -1.0, 20.0, 0.0},
                                                 {0.0, 0.0, 20.0, 0.0},
                                                 {1.0, 1.0, 20.0, 242.612264},
                                                 {-1.0, 1.0, 40.0, 485.224528},
                                                 {3.0, 1.0, 20.0, 4.443599},
                                                 {0.0, 1.0, 0.0, 0.0}}) {
      now.alpha = at + off * wide, now.direction = sign * way;
      now.tension = {sign > 0 ? 90.0 : tension, sign > 0 ? tension : 90.0};
      EXPECT_NEAR(acted(hidden.dry.at(0), now, none), dry, 1e-5) << off << " " << way;
    }
  }
}

TEST(Unread, a_tendon_is_tightened_before_a_run) {
  for (const auto& [share, from] : {std::pair{0.5, 1u}, {0.8, 2u}}) {
    const Hidden hidden = with("retensioned_between_runs", 0.5, soft(), {-1.0, 1.0, share});
    EXPECT_TRUE(hidden.longer[1].empty());
    std::vector<double> none;
    Moment now;
    for (now.run = 0; now.run < 4; ++now.run)
      EXPECT_EQ(acted(hidden.longer[0].at(0), now, none), now.run >= from ? 0.5 : 0.0) << now.run;
  }
  EXPECT_TRUE(with("retensioned_between_runs", 0.5, soft()).longer[0].empty());
  const std::vector<RunPlan> plans = {{0.0, k_slow, 1}, {0.0, k_slow, 1}};
  const std::vector<Log> plain = short_logs_of({}, plans);
  const std::vector<Log> logs = short_logs_of(with("retensioned_between_runs", 0.5, soft()), plans);
  for (std::size_t row = 1; row < plain[0].size(); ++row) {
    EXPECT_EQ(logs[0][row].theta, plain[0][row].theta) << row;
    EXPECT_GT(logs[1][row].theta - plain[1][row].theta, radians(0.1)) << "drawn to its side " << row;
  }
}

TEST(Unread, a_stiff_wire_stands_off_its_pin_where_it_is_slack) {
  const Hidden hidden = with("wire_standing_off_pin", 0.1, soft());
  for (const std::size_t side : {0u, 1u}) {
    std::vector<double> memory;
    Moment now;
    for (const auto& [tension, off] :
         {std::pair{20.0, 0.0}, {40.0, -0.05}, {10.0, 0.1}, {4.0, 0.4}, {1.0, 0.4}, {0.0, 0.4}, {80.0, -0.075}}) {
      now.tension[side] = tension, now.tension[1 - side] = 33.0;
      EXPECT_NEAR(acted(hidden.longer[side].at(0), now, memory), off, 1e-12) << tension;
    }
    memory.clear();
    now.tension[side] = 25.0;
    EXPECT_EQ(acted(hidden.longer[side][0], now, memory), 0.0) << "cut to length at home";
    now.tension[side] = 20.0;
    EXPECT_NEAR(acted(hidden.longer[side][0], now, memory), 0.02, 1e-12);
  }
}

TEST(Unread, the_slacker_of_two_tendons_goes_round_the_other) {
  const Hidden hidden = with("tendons_across_each_other", 0.4, soft());
  BothWays ways(hidden);
  Moment now;
  for (const auto& [first, second, longer1, longer2] : {std::tuple{20.0, 20.0, 0.0, 0.0},
                                                        {5.0, 5.0, 0.0, 0.0},
                                                        {30.0, 10.0, -0.075, 0.125},
                                                        {6.0, 2.0, -0.075, 0.125},
                                                        {0.0, 40.0, 0.3, -0.1},
                                                        {0.0, 0.0, 0.0, 0.0}}) {
    now.tension = {first, second};
    const std::array<double, 2> longer = ways(now);
    EXPECT_NEAR(longer[0], longer1, 1e-12) << first << " " << second;
    EXPECT_NEAR(longer[1], longer2, 1e-12) << first << " " << second;
  }
}

// ---- load, joint, link ----------------------------------------------------------------------------------------------

TEST(Unread, a_rubber_band_pulls_by_its_length_and_is_softer_on_the_way_back) {
  const Hidden hidden = with("rubber_band_for_load", 0.5, soft());
  std::vector<double> memory;
  Moment now;
  // A fifth more for 0.4 rad; 0.3 of what it is back from its furthest.
  for (const auto& [load, theta, more] : {std::tuple{20.0, -0.4, -4.0},
                                          {20.0, 0.0, 0.0},
                                          {20.0, 0.4, 4.0},
                                          {20.0, 0.2, 1.5},
                                          {20.0, 0.0, -1.0},
                                          {20.0, 0.3, 2.75},
                                          {20.0, 0.5, 5.0},
                                          {0.0, 0.2, 0.0},
                                          {20.0, 0.0, 0.0},
                                          {-10.0, -0.4, -2.0},
                                          {-10.0, 0.4, 3.0}}) {
    now.load = load, now.theta = theta;
    EXPECT_NEAR(acted(hidden.load.at(0), now, memory), more, 1e-12) << load << " " << theta;
  }
  const Hidden wild = with("rubber_band_for_load", 3.0, soft());
  memory.clear();
  now.load = 20.0, now.theta = -0.4;
  EXPECT_EQ(acted(wild.load.at(0), now, memory), -20.0) << "a band does not push";
}

TEST(Unread, a_wheel_off_its_middle_makes_a_wave_of_the_load) {
  const Hidden hidden = with("eccentric_load_wheel", 0.1, soft());
  std::vector<double> none;
  Moment now;
  // Seven to one, 1 rad on.
  for (const auto& [load, theta, more] :
       {std::tuple{20.0, 0.0, 0.0}, {20.0, 0.3, -1.59978064}, {-10.0, -0.3, 1.73267834}, {0.0, 0.3, 0.0}}) {
    now.load = load, now.theta = theta;
    EXPECT_NEAR(acted(hidden.load.at(0), now, none), more, 1e-7) << load << " " << theta;
  }
}

TEST(Unread, a_hose_is_as_stiff_as_the_compressor_makes_it) {
  const Hidden hidden = with("hose_under_pressure", 2000.0, soft());
  std::vector<double> none;
  Moment now;
  // Every 24 s, 7.2 s of them pumping.
  for (const auto& [time, beside, torque] : {std::tuple{0.0, 0.1, 0.0},
                                             {3.6, 0.1, -100.0},
                                             {7.2, 0.1, -200.0},
                                             {7.2, 0.0, 0.0},
                                             {7.2, -0.2, 400.0},
                                             {15.6, -0.2, 200.0},
                                             {24.0, -0.2, 0.0},
                                             {31.2, 0.1, -200.0}}) {
    now.time = time, now.theta = radians(9.0) + beside;
    EXPECT_NEAR(acted(hidden.torque.at(0), now, none), torque, 1e-9) << time;
  }
}

TEST(Unread, an_axis_climbs_its_hole_the_way_it_turns) {
  const Hidden hidden = with("axis_climbing_in_hole", 0.1, soft());
  BothWays ways(hidden);
  Moment now;
  now.pull = {Vec2(-0.6, -0.8), Vec2(0.8, -0.6)};
  for (const auto& [degree, across] :
       {std::pair{0.0, 0.0}, {0.5, 0.05}, {5.0, 0.1}, {4.0, 0.0}, {3.0, -0.1}, {-9.0, -0.1}}) {
    now.theta = radians(degree);
    const std::array<double, 2> longer = ways(now);
    EXPECT_NEAR(longer[0], 0.6 * across, 1e-12) << degree;
    EXPECT_NEAR(longer[1], -0.8 * across, 1e-12) << degree;
  }
  // Behind on both ways.
  const RunPlan plan{0.0, k_slow, 1};
  const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
  for (std::size_t row = 6; row < log.size(); ++row) {
    if (row > 80 && row < 90) continue;
    const double off = log[row].theta - plain[row].theta;
    EXPECT_LT(row <= 80 ? off : -off, -5e-4) << row;
  }
}

TEST(Unread, a_bearing_runs_in_with_its_way) {
  const Hidden hidden = with("bearing_running_in", 500.0, soft());
  std::vector<double> memory;
  Moment now;
  // 6 rad.
  for (const auto& [theta, dry] : {std::pair{0.0, 500.0},
                                   {0.5, 460.022207},
                                   {0.0, 423.240862},
                                   {0.0, 423.240862},
                                   {-0.5, 389.400392},
                                   {4.0, 183.939721}}) {
    now.theta = theta;
    EXPECT_NEAR(acted(hidden.dry.at(0), now, memory), dry, 1e-5) << theta;
  }
}

// ---- sensor and log -------------------------------------------------------------------------------------------------

TEST(Unread, a_sensors_linkage_has_play_of_its_own) {
  const Hidden hidden = with("play_at_joint_sensor", 0.05, soft());
  for (const double load : {0.0, 25.0}) {
    const RunPlan plan{load, k_slow, 2};
    const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
    double shown = plain[0].theta;
    for (std::size_t row = 0; row < log.size(); ++row) {
      if (plain[row].theta - shown > 0.025) shown = plain[row].theta - 0.025;
      if (shown - plain[row].theta > 0.025) shown = plain[row].theta + 0.025;
      EXPECT_NEAR(log[row].theta, shown, 1e-6) << row;
    }
    EXPECT_NEAR(log[80].theta, plain[80].theta - 0.025, 1e-9);
    EXPECT_NEAR(log[160].theta, plain[160].theta + 0.025, 1e-9);
  }
}

TEST(Unread, a_magnet_that_cools_shows_more) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("gain_going_with_warmth", 0.002, soft(), {sign, 1.0, 0.5});
    const RunPlan plan{0.0, k_slow, 2};
    const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
    for (std::size_t row = 0; row < log.size(); ++row) {
      const double share = sign * 0.002 * (log[row].temperature - 31.0);
      EXPECT_NEAR(log[row].theta, (1.0 + share) * plain[row].theta, 1e-9) << row;
    }
    EXPECT_LT(log.back().temperature, 28.0);
  }
}

TEST(Unread, iron_that_passes_turns_the_field_under_either_load) {
  const Hidden hidden = with("iron_near_sensor", 0.02, soft());
  std::vector<double> none;
  Moment now;
  // In the middle, 6.59155 deg; 4 N.
  for (const auto& [load, off, shown] : {std::tuple{20.0, 0.0, 0.02},
                                         {-20.0, 0.0, 0.02},
                                         {2.0, 0.0, 0.01},
                                         {0.0, 0.0, 0.0},
                                         {20.0, 1.0, 0.0070710678},
                                         {20.0, -3.0, 0.0006324555}}) {
    now.load = load, now.theta = off * radians(5.0 + 5.0 / k_pi);
    EXPECT_NEAR(acted(hidden.reading.at(0), now, none), shown, 1e-9) << load << " " << off;
  }
}

TEST(Unread, a_wheel_loses_its_way_up) {
  const Hidden hidden = with("wheel_slipping_one_way", 0.01, soft());
  const RunPlan plan{0.0, k_slow, 3};
  const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
  const double stroke = plain[80].theta - plain[0].theta;
  for (const auto& [row, lost] : {std::pair{0u, 0.0}, {80u, 1.0}, {160u, 1.0}, {240u, 2.0}, {320u, 2.0}, {480u, 3.0}})
    EXPECT_NEAR(log[row].theta, plain[row].theta - 0.01 * stroke * lost, 1e-4) << row;
  std::vector<double> memory;
  Moment now;
  for (const auto& [theta, off] : {std::pair{0.1, 0.0}, {0.6, -0.005}, {0.2, -0.005}, {0.6, -0.009}, {0.6, -0.009}}) {
    now.theta = theta;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), off, 1e-12) << theta;
  }
}

TEST(Unread, what_a_joint_does_until_its_index_is_seen_is_lost) {
  const Hidden hidden = with("index_caught_late", 0.05, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [degree, speed, off] : {std::tuple{-30.0, 0.5, 0.0},
                                           {-1.0, 0.5, 0.0},
                                           {1.0, 0.5, -0.025},
                                           {20.0, 0.2, -0.025},
                                           {20.0, 0.0, -0.025},
                                           {10.0, -0.3, -0.025},
                                           {-2.0, -0.2, 0.01},
                                           {-20.0, -0.9, 0.01},
                                           {2.0, 1.2, -0.06}}) {
    now.theta = radians(degree), now.theta_speed = speed;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), off, 1e-12) << degree;
  }
}

}  // namespace unread
}  // namespace fusee::rig
