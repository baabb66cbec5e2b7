// The seventh split that is kept aside: each fault is what it says, by hand.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "fusee/transmission/transmission.h"
#include "rig/fault_checks.h"

namespace fusee::rig {
namespace untold {

/// 63 %, 37 %: of what comes or goes within a time constant.
const double k_come = 1.0 - std::exp(-1.0), k_left = std::exp(-1.0);

// ---- motor and shaft, by hand: a stiff joint stands where the law says ----------------------------------------------

TEST(Untold, a_stepper_is_behind_near_one_speed) {
  const Hidden hidden = with("stepper_in_resonance", 0.02, stiff());
  std::vector<double> none;
  Moment now;
  // 14 deg/s, 4.2 wide.
  for (const auto& [speed, off] : {std::pair{14.0, -0.02},
                                   {-14.0, 0.02},
                                   {18.2, -0.0121306132},
                                   {9.8, -0.0121306132},
                                   {-22.4, 0.0027067057},
                                   {60.0, 0.0}}) {
    now.alpha_speed = radians(speed), now.direction = speed > 0 ? 1.0 : -1.0;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), off, 1e-9) << speed;
  }
  const Transmission law(stiff().declared);
  for (const auto& [speed, behind] : {std::pair{radians(14.0), 0.02}, {k_fast, 0.0}}) {
    const Log log = run_of(hidden, {0.0, speed, 1}, stiff());
    for (std::size_t row = 1; row < log.size(); ++row)
      EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + (row <= 80 ? -behind : behind)), 1e-5) << row;
  }
}

TEST(Untold, a_disc_goes_on_when_the_motor_turns_round_in_haste) {
  const Hidden hidden = with("motor_disc_slipping", 0.02, stiff());
  std::vector<double> memory;
  Moment now;
  // Beyond 40 deg/s.
  for (const auto& [speed, off] : {std::pair{0.0, 0.0},
                                   {60.0, 0.4},
                                   {60.0, 0.4},
                                   {-60.0, -1.2},
                                   {0.0, -0.8},
                                   {30.0, -0.8},
                                   {-9.0, -0.8},
                                   {35.0, -0.72}}) {
    now.alpha_speed = radians(speed);
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), radians(off), 1e-12) << speed;
  }
  // From rest by 90 deg/s, then round by 180.
  const Transmission law(stiff().declared);
  const Log log = run_of(hidden, {0.0, k_fast, 2}, stiff());
  for (std::size_t row = 1; row < log.size(); ++row) {
    const bool up = (row - 1) / 80 % 2 == 0;
    EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + radians(up ? 1.0 : -1.8)), 1e-5) << row;
  }
  const Log slow = run_of(hidden, {0.0, k_slow, 1}, stiff());
  for (const Row& row : slow) EXPECT_NEAR(row.theta, law.theta(row.alpha), 1e-5);
}

TEST(Untold, a_cold_gear_is_behind_by_its_speed) {
  const Hidden hidden = with("gear_grease_thickening", 0.05, stiff());
  const Transmission law(stiff().declared);
  for (const double speed : {k_slow, k_fast}) {
    const Log log = run_of(hidden, {0.0, speed, 2}, stiff());
    for (std::size_t row = 1; row < log.size(); ++row) {
      const double behind = 0.005 * speed * (31.0 - log[row].temperature);
      const bool up = (row - 1) / 80 % 2 == 0;
      EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + (up ? -behind : behind)), 1e-5) << row;
    }
  }
  std::vector<double> none;
  Moment now;
  now.alpha_speed = 1.0, now.warmth = 2.0;
  EXPECT_EQ(acted(hidden.shaft.at(0), now, none), 0.0) << "warmer than at the begin";
}

// ---- pulley, tendon -------------------------------------------------------------------------------------------------

TEST(Untold, a_tendon_unwound_to_its_knot_lets_out_by_the_sine) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("unwound_to_its_knot", 0.6, soft(), {sign, 1.0, 0.5});
    const Action& action = hidden.longer[sign > 0 ? 1 : 0].at(0);
    EXPECT_TRUE(hidden.longer[sign > 0 ? 0 : 1].empty());
    const double radius = action.numbers[1], end = sign > 0 ? soft().alpha_min : soft().alpha_max;
    EXPECT_NEAR(radius, 16.0, sign > 0 ? 1.0 : 1e-3) << "r1; the other pulley is not quite round";
    std::vector<double> none;
    Moment now;
    // x − sin x
    for (const auto& [before, longer] :
         {std::pair{0.1, 0.0205744614}, {0.3, 0.0044797933}, {0.5, 0.0001665834}, {0.6, 0.0}, {2.0, 0.0}}) {
      now.alpha = end + sign * before;
      EXPECT_NEAR(acted(action, now, none), radius * longer, 1e-7) << before;
    }
  }
  const RunPlan plan{0.0, k_slow, 1};
  const Log plain = run_of({}, plan, soft());
  const Log log = run_of(with("unwound_to_its_knot", 1.0, soft()), plan, soft());
  EXPECT_GT(log[1].theta - plain[1].theta, radians(0.1)) << "held back by tendon 2";
  const std::size_t at_home = plain.size() / 4;
  EXPECT_NEAR(log[at_home].theta, plain[at_home].theta, radians(0.02));
}

TEST(Untold, one_pulley_winds_more_than_its_own) {
  std::vector<double> none;
  Moment now;
  for (const double alpha : {-0.8, 0.0, 0.5}) {
    now.alpha = alpha;
    const Hidden second = with("one_pulley_larger", 0.2, soft());
    EXPECT_TRUE(second.longer[0].empty());
    EXPECT_NEAR(acted(second.longer[1].at(0), now, none), 0.2 * alpha, 1e-15);
    const Hidden first = with("one_pulley_larger", 0.2, soft(), {-1.0, 1.0, 0.5});
    EXPECT_TRUE(first.longer[1].empty());
    EXPECT_NEAR(acted(first.longer[0].at(0), now, none), -0.2 * alpha, 1e-15);
  }
}

TEST(Untold, a_string_hums_where_the_speed_meets_its_tension) {
  for (const std::size_t side : {0u, 1u}) {
    const Hidden hidden = with("humming_tendon", 0.2, soft(), {side == 1 ? 1.0 : -1.0, 1.0, 0.5});
    EXPECT_TRUE(hidden.longer[1 - side].empty());
    std::vector<double> memory;
    Moment now;
    const auto longer = [&](double tension, double speed, double seconds) {
      now.tension[side] = tension, now.tension[1 - side] = 3.0;
      now.alpha_speed = radians(speed), now.seconds = seconds;
      return acted(hidden.longer[side].at(0), now, memory);
    };
    EXPECT_EQ(longer(20.0, 0.0, 1e-9), 0.0) << "at home";
    // In tune at 20 deg/s under 20 N.
    EXPECT_NEAR(longer(20.0, 20.0, 0.3), 0.2 * k_come, 1e-12);
    EXPECT_NEAR(longer(20.0, -20.0, 1e9), 0.2, 1e-12);
    EXPECT_NEAR(longer(20.0, 0.0, 0.3), 0.2 * k_left, 1e-12) << "dies away";
    EXPECT_NEAR(longer(20.0, 30.0, 1e9), 0.1, 1e-12);
    EXPECT_NEAR(longer(80.0, 15.0, 1e9), 0.09, 1e-12) << "struck by 9/16";
    EXPECT_NEAR(longer(80.0, 20.0, 1e9), 0.04, 1e-12);
    EXPECT_NEAR(longer(0.0, 40.0, 1e9), 0.2, 1e-12) << "twice the tone under four times the pull";
    EXPECT_NEAR(longer(20.0, 20.0, 1e9), 0.04, 1e-12) << "a loose string has none";
  }
}

TEST(Untold, what_rested_on_the_pin_is_bent_until_it_is_drawn) {
  // 3.25 s, 1.75 rad.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("tendon_set_at_rest", 0.2, soft(), {sign, 1.0, 0.5});
    EXPECT_TRUE(hidden.longer[sign > 0 ? 0 : 1].empty());
    std::vector<double> memory;
    Moment now;
    const double once = k_come * k_left;
    for (const auto& [alpha, seconds, share] : {std::tuple{0.0, 1e-9, 0.0},
                                                {0.0, 2.25, 0.0},
                                                {0.0, 1.0, 0.0},
                                                {1.75, 1.0, once},
                                                {1.75, 1e-9, once},
                                                {1.75, 3.25, once},
                                                {0.0, 1.0, once * k_left + once},
                                                {3.5, 1.0, (once * k_left + once) * k_left * k_left}}) {
      now.alpha = alpha, now.seconds = seconds;
      EXPECT_NEAR(acted(hidden.longer[sign > 0 ? 1 : 0].at(0), now, memory), 0.2 * share, 1e-8) << alpha;
    }
    // One width of the pin's wrap away: 1 − e^(−1/2) of the bend is off it.
    memory.clear();
    now.alpha = 0.5, now.seconds = 1e9;
    acted(hidden.longer[sign > 0 ? 1 : 0][0], now, memory);
    now.alpha += radians(6.0);
    const double off = acted(hidden.longer[sign > 0 ? 1 : 0][0], now, memory);
    EXPECT_NEAR(off, 0.2 * 0.3934693403 * std::exp(-radians(6.0) / 1.75), 1e-9);
    EXPECT_NEAR(acted(hidden.longer[sign > 0 ? 1 : 0][0], now, memory), off, 1e-9) << "what is off stays off";
  }
}

TEST(Untold, a_wire_breaks_at_every_reversal) {
  const double each = 0.1 * give(soft());
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("wires_breaking_one_by_one", 0.1, soft(), {sign, 1.0, 0.5});
    const std::size_t side = sign > 0 ? 1 : 0;
    EXPECT_TRUE(hidden.longer[1 - side].empty());
    std::vector<double> memory;
    Moment now;
    for (const auto& [direction, tension, broken] : {std::tuple{0.0, 18.0, 0.0},
                                                     {-1.0, 30.0, 0.0},
                                                     {1.0, 30.0, 1.0},
                                                     {1.0, 10.0, 1.0},
                                                     {-1.0, 10.0, 2.0},
                                                     {1.0, 50.0, 3.0},
                                                     {1.0, 18.0, 3.0}}) {
      now.direction = direction, now.tension[side] = tension, now.tension[1 - side] = 99.0;
      EXPECT_NEAR(acted(hidden.longer[side].at(0), now, memory), -each * broken * (tension - 18.0), 1e-12) << tension;
    }
  }
}

TEST(Untold, a_tensioner_gives_way_by_time_and_comes_back) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("leaking_tensioner", 0.02, soft(), {sign, 1.0, 0.5});
    const std::size_t side = sign > 0 ? 1 : 0;
    EXPECT_TRUE(hidden.longer[1 - side].empty());
    std::vector<double> memory;
    Moment now;
    for (const auto& [tension, seconds, longer] : {std::tuple{20.0, 1e-9, 0.0},
                                                   {20.0, 10.0, 0.0},
                                                   {40.0, 5.0, -0.1},
                                                   {40.0, 5.0, -0.2},
                                                   {10.0, 5.0, -0.15},
                                                   {0.0, 10.0, 0.05}}) {
      now.tension[side] = tension, now.tension[1 - side] = 99.0, now.seconds = seconds;
      EXPECT_NEAR(acted(hidden.longer[side].at(0), now, memory), longer, 1e-12) << tension;
    }
  }
}

// ---- pins, frame ----------------------------------------------------------------------------------------------------

TEST(Untold, tendons_float_on_oil_when_they_are_quick) {
  const Hidden hidden = with("tendon_floating_on_oil", 400.0, soft());
  std::vector<double> none;
  Moment now;
  // 20 N, 20 deg/s.
  for (const auto& [first, second, speed, dry] : {std::tuple{20.0, 20.0, 0.0, 400.0},
                                                  {10.0, 50.0, 0.0, 600.0},
                                                  {0.0, 0.0, 0.0, 0.0},
                                                  {20.0, 20.0, 20.0, 242.612264},
                                                  {20.0, 20.0, -20.0, 242.612264},
                                                  {40.0, 40.0, 60.0, 8.887197}}) {
    now.tension = {first, second}, now.alpha_speed = radians(speed);
    EXPECT_NEAR(acted(hidden.dry.at(0), now, none), dry, 1e-5) << speed;
  }
}

TEST(Untold, a_pin_stands_elsewhere_from_a_run_on) {
  // Pins at 50 beside and 80 above.
  const double up = 80.0 / std::hypot(50.0, 80.0), beside = 50.0 / std::hypot(50.0, 80.0);
  for (const double sign : {1.0, -1.0}) {
    for (const auto& [share, from] : {std::pair{0.5, 1u}, {0.8, 2u}}) {
      const Hidden hidden = with("pin_knocked_between_runs", 0.5, soft(), {sign, 1.0, share});
      const std::size_t side = sign > 0 ? 1 : 0;
      EXPECT_TRUE(hidden.longer[1 - side].empty());
      std::vector<double> none;
      Moment now;
      now.pull[side] = Vec2(0.6, -0.8);
      const double right = 0.5 * std::cos(1.0), higher = 0.5 * std::sin(1.0);
      for (now.run = 0; now.run < 4; ++now.run) {
        const double longer = now.run < from ? 0.0 : right * (0.6 + sign * beside) + higher * (up - 0.8);
        EXPECT_NEAR(acted(hidden.longer[side].at(0), now, none), longer, 1e-12) << now.run;
      }
    }
  }
  // As the ways from a place to another by way of a pin, drawn.
  const Hidden hidden = with("pin_knocked_between_runs", 1e-3, soft(), {1.0, 2.0, 0.5});
  const Vec2 moved = 1e-3 * Vec2(std::cos(2.0), std::sin(2.0));
  const Vec2 pulley(0.0, 0.0), pin(50.0, 80.0), end(20.0, 210.0);
  std::vector<double> none;
  Moment now;
  now.run = 1, now.pull[1] = (pin - end).normalized();
  const auto way = [&](const Vec2& over) { return (over - pulley).norm() + (over - end).norm(); };
  EXPECT_NEAR(acted(hidden.longer[1].at(0), now, none), way(pin + moved) - way(pin), 1e-7);
  const std::vector<RunPlan> plans = {{0.0, k_slow, 1}, {0.0, k_slow, 1}};
  const std::vector<Log> plain = short_logs_of({}, plans);
  const std::vector<Log> logs = short_logs_of(with("pin_knocked_between_runs", 1.0, soft()), plans);
  double most = 0;
  for (std::size_t row = 0; row < plain[0].size(); ++row) {
    EXPECT_EQ(logs[0][row].theta, plain[0][row].theta) << row;
    most = std::max(most, std::abs(logs[1][row].theta - plain[1][row].theta));
  }
  EXPECT_GT(most, radians(0.1));
}

TEST(Untold, an_axle_bends_under_tendons_and_load) {
  const Hidden hidden = with("axle_bending", 0.01, soft());
  BothWays ways(hidden);
  Moment now;
  now.pull = {Vec2(-0.6, -0.8), Vec2(0.6, -0.8)};
  // (0, −32) N at home.
  for (const auto& [first, second, load, longer1, longer2] : {std::tuple{20.0, 20.0, 0.0, 0.0, 0.0},
                                                              // Down by 16 N: 0.16 mm, of which 0.8 along both.
                                                              {30.0, 30.0, 0.0, -0.128, -0.128},
                                                              // Right by 6 N, down by 8 N.
                                                              {20.0, 30.0, 0.0, -0.028, -0.1},
                                                              // Left by 10 N.
                                                              {20.0, 20.0, 10.0, -0.06, 0.06},
                                                              {20.0, 20.0, -10.0, 0.06, -0.06},
                                                              {0.0, 0.0, 0.0, 0.256, 0.256}}) {
    now.tension = {first, second}, now.load = load;
    const std::array<double, 2> longer = ways(now);
    EXPECT_NEAR(longer[0], longer1, 1e-12) << first << " " << second;
    EXPECT_NEAR(longer[1], longer2, 1e-12) << first << " " << second;
  }
  // The load turns with the link.
  now.tension = {20.0, 20.0}, now.load = 10.0, now.theta = k_pi / 2.0;
  EXPECT_NEAR(ways(now)[0], 0.08, 1e-12);
}

// ---- joint, link, load ----------------------------------------------------------------------------------------------

TEST(Untold, a_muscle_pulls_back_when_it_is_stretched_quickly) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("stretched_muscle", 1000.0, soft(), {sign, k_pi, 0.5});
    std::vector<double> memory;
    Moment now;
    // 17.5 deg/s, 0.6 s.
    for (const auto& [speed, seconds, torque] : {std::tuple{17.0, 5.0, 0.0},
                                                 {-60.0, 5.0, 0.0},
                                                 {35.0, 1e9, -500.0},
                                                 {70.0, 1e9, -750.0},
                                                 {0.0, 0.6, -750.0 * k_left},
                                                 {-60.0, 0.6, -750.0 * k_left * k_left},
                                                 {0.0, 1e9, 0.0},
                                                 {35.0, 0.6, -500.0 * k_come}}) {
      now.theta_speed = sign * radians(speed), now.seconds = seconds;
      EXPECT_NEAR(acted(hidden.torque.at(0), now, memory), sign * torque, 1e-9) << speed;
    }
  }
  // Behind on the way on which it is stretched, and at its end for a while.
  const RunPlan plan{0.0, k_fast, 1, 3.0};
  const Log plain = run_of({}, plan, soft()), log = run_of(with("stretched_muscle", 3000.0, soft()), plan, soft());
  EXPECT_LT(log[60].theta - plain[60].theta, -radians(0.05));
  EXPECT_LT(std::abs(log.back().theta - plain.back().theta), radians(0.02));
}

TEST(Untold, a_spring_of_which_nothing_is_said_is_straight) {
  std::vector<double> none;
  Moment now;
  // Loose at half of the range's 30 deg.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("forgotten_return_spring", 800.0, soft(), {sign, 1.0, 0.5});
    for (const auto& [off, torque] : {std::pair{0.0, 0.0}, {0.25, -200.0}, {-0.5, 400.0}}) {
      now.theta = sign * radians(15.0) + off;
      EXPECT_NEAR(acted(hidden.torque.at(0), now, none), torque, 1e-9) << off;
    }
  }
}

TEST(Untold, water_runs_to_the_lower_end_late) {
  const Hidden hidden = with("water_in_link", 500.0, soft(), {1.0, k_pi, 0.5});
  std::vector<double> memory;
  Moment now;
  // All of it 10 deg to a side, with 2.75 s.
  for (const auto& [degree, seconds, torque] : {std::tuple{0.0, 1.0, 0.0},
                                                {5.0, 2.75, 0.0},
                                                {5.0, 2.75, 250.0 * k_come},
                                                {5.0, 1e9, 250.0},
                                                {25.0, 1e9, 250.0},
                                                {-25.0, 2.75, 500.0 - 250.0 * k_left},
                                                {-25.0, 1e9, -500.0}}) {
    now.theta = radians(degree), now.seconds = seconds;
    EXPECT_NEAR(acted(hidden.torque.at(0), now, memory), torque, 1e-9) << degree;
  }
}

TEST(Untold, the_load_hangs_in_another_hole_in_every_run) {
  const Hidden hidden = with("hung_in_another_hole", 0.1, soft());
  std::vector<double> none;
  Moment now;
  double sum = 0, squares = 0, last = 0;
  const int runs = 4000;
  for (now.run = 0; now.run < runs; ++now.run) {
    now.load = 20.0;
    const double more = acted(hidden.load.at(0), now, none);
    now.load = -10.0, now.time += 3.0, now.theta += 0.1;
    EXPECT_NEAR(acted(hidden.load[0], now, none), -0.5 * more, 1e-12) << "of the same lever";
    now.load = 0.0;
    EXPECT_EQ(acted(hidden.load[0], now, none), 0.0);
    EXPECT_NE(more, last);
    last = more;
    sum += more / 2.0, squares += more * more / 4.0;
  }
  EXPECT_NEAR(sum / runs, 0.0, 0.06);
  EXPECT_NEAR(std::sqrt(squares / runs), 1.0, 0.04);
  const Hidden wild = with("hung_in_another_hole", 1e6, soft());
  for (now.run = 0; now.run < 20; ++now.run) {
    now.load = 20.0;
    EXPECT_GE(acted(wild.load.at(0), now, none), -20.0) << "a weight does not push";
  }
}

TEST(Untold, a_hook_goes_out_with_every_reversal_until_it_is_hung_anew) {
  const Hidden hidden = with("hook_working_outwards", 0.01, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [load, direction, more] : {std::tuple{0.0, 0.0, 0.0},
                                              {0.0, 1.0, 0.0},
                                              {0.0, -1.0, 0.0},
                                              {20.0, -1.0, 0.0},
                                              {20.0, 1.0, 0.2},
                                              {20.0, 1.0, 0.2},
                                              {20.0, -1.0, 0.4},
                                              {-20.0, 1.0, -0.6},
                                              {0.0, 1.0, 0.0},
                                              {20.0, 1.0, 0.0},
                                              {20.0, -1.0, 0.2}}) {
    now.load = load, now.direction = direction;
    EXPECT_NEAR(acted(hidden.load.at(0), now, memory), more, 1e-12) << load << " " << direction;
  }
}

// ---- sensor and log -------------------------------------------------------------------------------------------------

TEST(Untold, what_is_shaken_is_off_one_way) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("inclinometer_shaken", 0.01, soft(), {sign, 1.0, 0.5});
    for (const auto& [speed, off] : {std::pair{k_fast, 0.01}, {0.5 * k_fast, 0.0025}}) {
      const RunPlan plan{0.0, speed, 1, 2.0};
      const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
      int resting = 0;
      for (std::size_t row = 1; row < log.size(); ++row) {
        const bool rests = log[row].alpha == log[row - 1].alpha;
        EXPECT_NEAR(log[row].theta - plain[row].theta, rests ? 0.0 : sign * off, 1e-9) << row;
        resting += rests ? 1 : 0;
      }
      EXPECT_EQ(resting, 20);
    }
  }
}

TEST(Untold, a_contact_comes_and_goes_by_chance) {
  const Hidden hidden = with("loose_contact", 0.02, soft());
  std::vector<double> none;
  Moment now;
  // 3.25 s.
  int off = 0, changes = 0;
  double last = 0;
  const int times = 4000;
  for (int time = 0; time < times; ++time) {
    now.time = 3.25 * time + 0.01;
    const double begins = acted(hidden.reading.at(0), now, none);
    now.time += 3.23;
    EXPECT_EQ(acted(hidden.reading[0], now, none), begins) << time;
    EXPECT_TRUE(begins == 0.02 || begins == 0.0) << begins;
    off += begins != 0 ? 1 : 0;
    changes += begins != last ? 1 : 0;
    last = begins;
  }
  EXPECT_NEAR(off / double(times), 0.4, 0.03);
  EXPECT_NEAR(changes / double(times), 0.48, 0.03) << "by chance, each time";
  EXPECT_NE(hidden, with("loose_contact", 0.02, soft(), {1.0, 1.1, 0.5}));
}

TEST(Untold, a_driver_that_holds_a_load_makes_noise) {
  const Hidden hidden = with("noise_of_driver_under_load", 0.01, soft());
  for (const auto& [load, rms] : {std::pair{0.0, 0.0}, {20.0, 0.01}, {-40.0, 0.02}}) {
    std::vector<double> memory;
    Moment now;
    now.load = load;
    double sum = 0, squares = 0;
    const int rows = 4000;
    for (int row = 0; row < rows; ++row) {
      const double noise = acted(hidden.reading.at(0), now, memory);
      sum += noise, squares += noise * noise;
    }
    EXPECT_NEAR(sum / rows, 0.0, 0.06 * rms) << load;
    EXPECT_NEAR(std::sqrt(squares / rows), rms, 0.04 * rms) << load;
  }
}

TEST(Untold, a_ground_is_lifted_by_load_times_speed) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("ground_lifted_by_power", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    // 20 N.
    for (const auto& [load, speed, off] :
         {std::tuple{20.0, 1.0, 0.01}, {20.0, -1.0, -0.01}, {-40.0, 0.5, -0.01}, {0.0, 2.0, 0.0}, {40.0, 0.0, 0.0}}) {
      now.load = load, now.alpha_speed = speed;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, none), sign * off, 1e-15) << load << " " << speed;
    }
  }
}

TEST(Untold, an_amplifier_loses_what_is_about_its_middle) {
  const RunPlan plan{0.0, k_slow, 1};
  const Log plain = run_of({}, plan, soft()), log = run_of(with("crossover_of_amplifier", 0.02, soft()), plan, soft());
  int still = 0;
  for (std::size_t row = 0; row < log.size(); ++row) {
    const double theta = plain[row].theta;
    const double shown = theta > 0.02 ? theta - 0.02 : theta < -0.02 ? theta + 0.02 : 0.0;
    EXPECT_NEAR(log[row].theta, shown, 1e-9) << row;
    still += shown == 0 ? 1 : 0;
  }
  EXPECT_GE(still, 2);
  // Elsewhere home is nought all the same: half of 0.3 · 60 deg on.
  const Hidden hidden = with("crossover_of_amplifier", 0.02, soft(), {1.0, 1.0, 1.0});
  std::vector<double> none;
  Moment now;
  for (const auto& [off, shown] : {std::pair{-0.5, 0.0}, {-0.02, 0.0}, {0.0, -0.02}, {0.01, -0.03}, {0.3, -0.04}}) {
    now.theta = radians(9.0) + off;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, none), shown, 1e-12) << off;
  }
  now.theta = 0.0;
  EXPECT_EQ(acted(hidden.reading[0], now, none), 0.0);
}

TEST(Untold, a_filter_is_the_quicker_the_faster_the_joint) {
  const Hidden hidden = with("adaptive_smoothing", 0.4, soft());
  std::vector<double> memory;
  Moment now;
  // 8.5 deg/s; 0.4 s at rest, 0.2 s at that speed.
  for (const auto& [time, theta, speed, off] : {std::tuple{1.0, 0.1, 0.0, 0.0},
                                                {1.4, 0.2, 0.0, -0.1 * k_left},
                                                {1.6, 0.2, 8.5, -0.1 * k_left * k_left},
                                                {1.8, 0.2, -8.5, -0.1 * k_left * k_left * k_left},
                                                {1.9, 0.2, 25.5, -0.1 * std::exp(-4.0)},
                                                {1.9, 0.2, 0.0, -0.1 * std::exp(-4.0)}}) {
    now.time = time, now.theta = theta, now.theta_speed = radians(speed);
    EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), off, 1e-12) << time;
  }
  // Not as much later as it is faster.
  std::array<double, 2> behind{};
  for (const std::size_t fast : {0u, 1u}) {
    memory.clear();
    const double speed = radians(fast == 1 ? 85.0 : 8.5);
    for (int row = 0; row <= 4000; ++row) {
      now.time = 1e-3 * row, now.theta = speed * now.time, now.theta_speed = speed;
      behind[fast] = -acted(hidden.reading[0], now, memory);
    }
  }
  EXPECT_NEAR(behind[0], radians(8.5) * 0.2, 2e-4);
  EXPECT_NEAR(behind[1], radians(85.0) * 0.4 / 11.0, 2e-3);
}

TEST(Untold, a_gyroscopes_scale_is_seen_in_what_moves) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("gyro_scale_beside_inclinometer", 0.02, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    // 2.875 s.
    for (const auto& [time, theta, off] : {std::tuple{10.0, 0.3, 0.0},
                                           {10.0, 0.5, 0.004},
                                           {12.875, 0.5, 0.004 * k_left},
                                           {12.875, 0.3, 0.004 * k_left - 0.004},
                                           {1e9, 0.3, 0.0}}) {
      now.time = time, now.theta = theta;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), sign * off, 1e-12) << time;
    }
  }
}

}  // namespace untold
}  // namespace fusee::rig
