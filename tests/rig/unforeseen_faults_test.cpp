// The tenth split that is kept aside: each fault is what it says, by hand.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "fusee/transmission/transmission.h"
#include "rig/fault_checks.h"

namespace fusee::rig {
namespace unforeseen {

/// One tendon has it, by the sign of the character, and the other has not: what acts on that one.
const Action& only_action(const Hidden& hidden, double sign) {
  EXPECT_TRUE(hidden.longer[sign > 0 ? 0 : 1].empty());
  return hidden.longer[sign > 0 ? 1 : 0].at(0);
}

/// `expected` for one tension after another in the tendon that has it, whatever the other's is.
void expect_by_tension(const std::string& fault, double size, const std::vector<std::pair<double, double>>& expected,
                       double tolerance = 1e-12) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with(fault, size, soft(), {sign, 1.0, 0.5});
    const Action& action = only_action(hidden, sign);
    std::vector<double> memory;
    Moment now;
    for (const auto& [tension, longer] : expected) {
      now.tension[sign > 0 ? 1 : 0] = tension, now.tension[sign > 0 ? 0 : 1] = 99.0 - tension;
      EXPECT_NEAR(acted(action, now, memory), longer, tolerance) << tension;
    }
  }
}

// ---- motor and shaft ------------------------------------------------------------------------------------------------

TEST(Unforeseen, a_gear_rubs_by_what_it_carries) {
  const Hidden hidden = with("gear_rubbing_by_its_load", 0.01, stiff());
  std::vector<double> memory;
  Moment now;
  // Turned round within a degree to either side; 20 N.
  for (const auto& [degree, load, off] : {std::tuple{0.0, 20.0, 0.0},
                                          {0.5, 20.0, -0.5},
                                          {5.0, 20.0, -1.0},
                                          {5.0, -20.0, -1.0},
                                          {5.0, 0.0, 0.0},
                                          {4.0, 40.0, 0.0},
                                          {0.0, 10.0, 0.5}}) {
    now.alpha = radians(degree), now.load = load;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), 0.01 * off, 1e-12) << degree << " " << load;
  }
  expect_shaft_off(run_of(hidden, {0.0, k_slow, 1}, stiff()), [](std::size_t) { return 0.0; });
  for (const double load : {20.0, -20.0}) {
    const Log log = run_of(hidden, {load, k_slow, 1}, stiff());
    double where = log[0].alpha + radians(1.0);
    expect_shaft_off(log, [&](std::size_t row) {
      return -0.01 * degrees(log[row].alpha - behind(log[row].alpha, radians(1.0), where));
    });
  }
}

TEST(Unforeseen, a_hub_frets_with_each_reversal_under_load) {
  const Hidden hidden = with("hub_fretting_under_load", 0.01, stiff());
  std::vector<double> memory;
  Moment now;
  for (const auto& [direction, load, off] : {std::tuple{0.0, 0.0, 0.0},
                                             {-1.0, 20.0, 0.0},
                                             {1.0, 0.0, 0.0},
                                             {-1.0, 20.0, -1.0},
                                             {-1.0, 40.0, -1.0},
                                             {1.0, 40.0, -3.0},
                                             {-1.0, -20.0, -2.0},
                                             {-1.0, 0.0, -2.0}}) {
    now.direction = direction, now.load = load;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), 0.01 * off, 1e-15) << direction << " " << load;
  }
  // There, and back once: one reversal within the run, one as it begins.
  expect_shaft_off(run_of(hidden, {20.0, k_slow, 1}, stiff()),
                   [](std::size_t row) { return row <= 80 ? -0.01 : -0.02; });
  expect_shaft_off(run_of(hidden, {0.0, k_slow, 2}, stiff()), [](std::size_t) { return 0.0; });
}

TEST(Unforeseen, a_supply_dips_by_the_clock_and_a_load_shows_it) {
  // Every 6 s.
  const Hidden hidden = with("supply_dipping", 0.02, stiff());
  std::vector<double> none;
  Moment now;
  for (const auto& [time, load, off] : {std::tuple{0.3, 20.0, -1.0},
                                        {0.7, 20.0, 0.0},
                                        {5.9, 20.0, 0.0},
                                        {6.5, -40.0, 2.0},
                                        {6.5, 0.0, 0.0},
                                        {12.61, 20.0, 0.0}}) {
    now.time = time, now.load = load;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), 0.02 * off, 1e-15) << time << " " << load;
  }
  const Log log = run_of(hidden, {20.0, k_slow, 1}, stiff());
  expect_shaft_off(log, [&](std::size_t row) { return std::fmod(log[row].time, 6.0) < 0.6 ? -0.02 : 0.0; });
}

TEST(Unforeseen, a_second_motor_comes_late) {
  static const MadeJoint slippery = forearm_with(8000, 0.0);
  const Transmission law(slippery.declared);
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("second_motor_late", 0.01, slippery, {sign, 1.0, 0.5});
    const Action& action = only_action(hidden, sign);
    const double arm = sign > 0 ? law.at_alpha(0.0).t2.p : 16.0;
    std::vector<double> none;
    Moment now;
    for (const double speed : {0.0, 1.5, -0.5}) {
      now.alpha_speed = speed;
      EXPECT_NEAR(acted(action, now, none), -sign * 0.01 * arm * speed, 1e-9) << speed;
    }
    // Two tendons as stiff as each other: by half of it behind, on either way.
    const RunPlan plan{0.0, k_fast, 1};
    const Log plain = run_of({}, plan, slippery), log = run_of(hidden, plan, slippery);
    const double behind_by = 0.5 * 0.01 * k_fast * law.at_alpha(log[40].alpha).g;
    EXPECT_NEAR(plain[40].theta - log[40].theta, behind_by, 0.15 * behind_by);
    EXPECT_NEAR(log[120].theta - plain[120].theta, behind_by, 0.15 * behind_by);
  }
}

// ---- pulley ---------------------------------------------------------------------------------------------------------

TEST(Unforeseen, a_rim_gives_between_its_spokes) {
  // Five of them, the first 1 rad of the wave on.
  const Hidden hidden = with("rim_bending_between_spokes", 0.5, soft());
  for (const std::size_t side : {0u, 1u}) {
    std::vector<double> memory;
    Moment now;
    for (const auto& [tension, wave, stretched] : {std::tuple{20.0, 1.0, 0.0},
                                                   {50.0, k_pi, 30.0},
                                                   {50.0, 0.0, 0.0},
                                                   {50.0, 0.5 * k_pi, 15.0},
                                                   {10.0, k_pi, -10.0},
                                                   {20.0, k_pi, 0.0}}) {
      now.tension[side] = tension, now.tension[1 - side] = 7.0, now.alpha = (wave - 1.0) / 5.0;
      EXPECT_NEAR(acted(hidden.longer[side].at(0), now, memory), -0.5 * give(soft()) * stretched, 1e-12) << wave;
    }
  }
}

TEST(Unforeseen, one_groove_lies_off_the_axis) {
  const Hidden hidden = with("layers_shifted_in_print", 0.3, soft());
  const Action& second = only_action(hidden, 1.0);
  std::vector<double> none;
  Moment now;
  EXPECT_EQ(acted(second, now, none), 0.0);
  // Nearest to the pin, and furthest.
  now.alpha = -1.0;
  EXPECT_NEAR(acted(second, now, none), -0.3 * (1.0 - std::cos(1.0)), 1e-12);
  now.alpha = k_pi - 1.0, now.tension = {50.0, 3.0};
  EXPECT_NEAR(acted(second, now, none), 0.3 * (1.0 + std::cos(1.0)), 1e-12);
  // As a whole pulley's on a joint whose other tendon hangs, and the hull is wound by no formula.
  Hidden made;
  const double to_pin = ways_to_pins(soft())[1];
  made.runout_x = 0.1 * std::sin(1.0 + to_pin), made.runout_y = 0.1 * std::cos(1.0 + to_pin);
  const Hidden layer = with("layers_shifted_in_print", 0.1, soft());
  const RunPlan pulled{60.0, k_slow, 1};
  const Log plain = run_of({}, pulled, soft()), by_hull = run_of(made, pulled, soft()),
            by_formula = run_of(layer, pulled, soft());
  for (const std::size_t row : {10u, 60u})
    EXPECT_NEAR(by_formula[row].theta - plain[row].theta, by_hull[row].theta - plain[row].theta, 5e-4) << row;
}

TEST(Unforeseen, turns_side_by_side_make_a_tendon_go_aslant) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("turns_side_by_side", 0.2, soft(), {sign, 1.0, 0.5});
    const Action& action = only_action(hidden, sign);
    const double middle = 0.5 * (soft().alpha_min + soft().alpha_max);
    const double half = 0.5 * (soft().alpha_max - soft().alpha_min), home = middle * middle / (half * half);
    std::vector<double> none;
    Moment now;
    for (const auto& [alpha, longer] : {std::pair{0.0, 0.0},
                                        {middle, -home},
                                        {soft().alpha_min, 1.0 - home},
                                        {soft().alpha_max, 1.0 - home},
                                        {middle + 0.5 * half, 0.25 - home}}) {
      now.alpha = alpha;
      EXPECT_NEAR(acted(action, now, none), 0.2 * longer, 1e-12) << alpha;
    }
  }
}

TEST(Unforeseen, a_cord_slips_round_its_pulley) {
  // Beyond e^1.2.
  const Hidden hidden = with("cord_slipping_round_pulley", 0.1, soft());
  BothWays both(hidden);
  Moment now;
  for (const auto& [first, second, slipped] : {std::tuple{20.0, 20.0, 0.0},
                                               {20.0, 20.0 * std::exp(1.2), 0.0},
                                               {20.0, 20.0 * std::exp(1.7), 0.5},
                                               {20.0, 20.0, 0.5},
                                               {20.0 * std::exp(0.7), 20.0, 0.5},
                                               {20.0 * std::exp(1.2), 20.0, 0.0},
                                               {20.0 * std::exp(2.2), 20.0, -1.0},
                                               {0.0, 60.0, std::log(30.0) - 1.2}}) {
    now.tension = {first, second};
    const auto [one, other] = both(now);
    EXPECT_NEAR(one, 0.1 * slipped, 1e-12) << first << " " << second;
    EXPECT_NEAR(other, -0.1 * slipped, 1e-12) << first << " " << second;
  }
  // A load takes the joint back, and it stays there without.
  const std::vector<RunPlan> plans = {{0.0, k_slow, 1}, {60.0, k_slow, 1}, {0.0, k_slow, 1}};
  const std::vector<Log> plain = short_logs_of({}, plans), logs = short_logs_of(hidden, plans);
  EXPECT_NEAR(logs[0][20].theta, plain[0][20].theta, 1e-9);
  EXPECT_LT(logs[1][20].theta, plain[1][20].theta - radians(0.05));
  EXPECT_LT(logs[2][20].theta, plain[2][20].theta - radians(0.05));
}

// ---- tendons, sheaths, pins -----------------------------------------------------------------------------------------

TEST(Unforeseen, a_turnbuckle_hangs_through_where_nothing_pulls) {
  expect_by_tension("turnbuckle_hanging_through", 0.05,
                    {{20.0, 0.0}, {40.0, -0.0375}, {10.0, 0.15}, {20.0 / 3.0, 0.4}, {0.0, 0.4}});
}

TEST(Unforeseen, a_safety_cord_helps_from_a_pull_on) {
  const double less = 0.4 * give(soft());
  expect_by_tension("safety_cord_coming_taut", 0.4,
                    {{20.0, 0.0}, {27.0, 0.0}, {37.0, 10.0 * less}, {0.0, 0.0}, {67.0, 40.0 * less}});
  // Under the load that its tendon holds up the joint gives way less.
  const Hidden hidden = with("safety_cord_coming_taut", 0.4, soft());
  const auto off = [&](double load) {
    const RunPlan plan{load, k_slow, 1};
    return run_of(hidden, plan, soft())[40].theta - run_of({}, plan, soft())[40].theta;
  };
  EXPECT_NEAR(off(0.0), 0.0, 1e-9);
  EXPECT_NEAR(off(-40.0), 0.0, 1e-9);
  EXPECT_GT(off(40.0), radians(0.1));
}

TEST(Unforeseen, fingers_warm_a_tendon_before_each_run) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("tendon_plucked_before_runs", 0.1, soft(), {sign, 1.0, 0.5});
    const Action& action = only_action(hidden, sign);
    std::vector<double> none;
    Moment now;
    for (const auto& [run_time, warm] : {std::pair{0.0, 1.0}, {22.5, std::exp(-1.0)}, {1e4, 0.0}, {0.0, 1.0}}) {
      now.run_time = run_time, now.time += run_time;
      EXPECT_NEAR(acted(action, now, none), -0.1 * warm, 1e-12) << run_time;
    }
  }
}

TEST(Unforeseen, a_loop_rolls_on_its_post_before_it_slides) {
  // 0.175 rad to either side.
  for (const double sign : {1.0, -1.0}) {
    for (const auto& [angle, round] : {std::pair{1.0, 1.0}, {4.0, -1.0}}) {
      const Hidden hidden = with("loop_gripping_its_post", 2.0, soft(), {sign, angle, 0.5});
      const Action& action = only_action(hidden, sign);
      std::vector<double> memory;
      Moment now;
      now.pull = {Vec2(-0.6, -0.8), Vec2(0.6, -0.8)};
      for (const auto& [theta, rolled] : {std::pair{0.0, 0.0},
                                          {0.1, 0.1},
                                          {0.175, 0.175},
                                          {0.5, 0.175},
                                          {0.4, 0.075},
                                          {0.15, -0.175},
                                          {-0.4, -0.175}}) {
        now.theta = theta, now.load += 10.0;
        EXPECT_NEAR(acted(action, now, memory), 2.0 * round * rolled, 1e-12) << theta;
      }
      // The tendon's own turning bends it as well, each one's to its own side: 0.1 rad.
      now.pull = {Vec2(-std::sin(0.7435), -std::cos(0.7435)), Vec2(std::sin(0.7435), -std::cos(0.7435))};
      EXPECT_NEAR(acted(action, now, memory), 2.0 * round * (sign > 0 ? -0.075 : -0.175), 1e-4);
    }
  }
}

TEST(Unforeseen, a_cord_lies_inside_of_its_bend) {
  for (const double sign : {1.0, -1.0}) {
    // Straight at home, and at −18 deg.
    for (const auto& [share, straight] : {std::pair{0.5, 0.0}, {0.0, -18.0}}) {
      const Hidden hidden = with("cord_inside_of_its_bend", 0.5, soft(), {sign, 1.0, share});
      const Action& action = only_action(hidden, sign);
      std::vector<double> none;
      Moment now;
      for (const double degree : {0.0, -18.0, 10.0, 30.0, -30.0}) {
        now.theta = radians(degree);
        const double more = std::abs(degree - straight) - std::abs(straight);
        EXPECT_NEAR(acted(action, now, none), -0.5 * radians(more), 1e-12) << degree;
      }
    }
  }
}

TEST(Unforeseen, sheaths_rub_the_more_they_are_bent) {
  const Hidden hidden = with("sheaths_bent_by_joint", 400.0, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [first, second, degree, dry] : {std::tuple{20.0, 20.0, 30.0, 400.0},
                                                   {20.0, 20.0, -15.0, 100.0},
                                                   {50.0, 10.0, 30.0, 600.0},
                                                   {50.0, 10.0, 0.0, 0.0},
                                                   {0.0, 0.0, 30.0, 0.0}}) {
    now.tension = {first, second}, now.theta = radians(degree);
    EXPECT_NEAR(acted(hidden.dry.at(0), now, none), dry, 1e-9) << degree;
  }
}

TEST(Unforeseen, a_bracket_follows_as_far_as_its_gap) {
  // 7 N.
  expect_by_tension("gap_under_bracket", 0.1,
                    {{20.0, 0.0}, {23.5, -0.05}, {27.0, -0.1}, {90.0, -0.1}, {16.5, 0.05}, {0.0, 0.1}});
}

// ---- joint, load ----------------------------------------------------------------------------------------------------

TEST(Unforeseen, a_bearing_is_oiled_before_a_run) {
  for (const auto& [share, oiled] : {std::pair{0.5, 1}, {0.9, 2}}) {
    const Hidden hidden = with("bearing_oiled_between_runs", 500.0, soft(), {1.0, 1.0, share});
    std::vector<double> none;
    Moment now;
    for (int run = 0; run < 5; ++run) {
      now.run = static_cast<std::size_t>(run), now.theta += 0.1;
      EXPECT_EQ(acted(hidden.dry.at(0), now, none), run < oiled ? 500.0 : 0.0) << run;
    }
  }
  const std::vector<RunPlan> plans = {{0.0, k_slow, 1}, {0.0, k_slow, 1}};
  const std::vector<Log> logs = short_logs_of(with("bearing_oiled_between_runs", 2000.0, soft()), plans);
  const auto loop = [](const Log& log) { return log[60].theta - log[20].theta; };
  EXPECT_GT(loop(logs[0]), loop(logs[1]) + radians(0.1)) << "a wider loop";
}

TEST(Unforeseen, an_arm_tires_and_recovers_in_the_pause) {
  // 37.5 s.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("wearer_tiring", 500.0, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    const double some = 1.0 - std::exp(-1.0);
    for (const auto& [run_time, seconds, tired] : {std::tuple{0.0, 5.0, 0.0},
                                                   {37.5, 37.5, some},
                                                   {0.0, 37.5, some * std::exp(-1.0)},
                                                   {1e4, 1e4, 1.0},
                                                   {0.0, 1e4, 0.0}}) {
      now.run_time = run_time, now.seconds = seconds, now.theta += 0.1;
      EXPECT_NEAR(acted(hidden.torque.at(0), now, memory), sign * 500.0 * tired, 1e-9) << run_time;
    }
  }
}

TEST(Unforeseen, a_pan_hangs_wherever_something_does) {
  const Hidden hidden = with("pan_never_counted", 2.0, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [load, pan] : {std::pair{0.0, 0.0}, {5.0, 2.0}, {40.0, 2.0}, {-5.0, -2.0}, {-40.0, -2.0}}) {
    now.load = load;
    EXPECT_EQ(acted(hidden.load.at(0), now, none), pan) << load;
  }
  for (const double load : {20.0, -20.0}) {
    const RunPlan told{load, k_slow, 1}, true_one{1.1 * load, k_slow, 1};
    EXPECT_NEAR(run_of(hidden, told, soft())[40].theta, run_of({}, true_one, soft())[40].theta, 1e-6) << load;
  }
}

TEST(Unforeseen, a_cell_creeps_and_the_winch_lets_off) {
  // 35 s.
  const Hidden hidden = with("load_cell_creeping", 0.1, soft());
  std::vector<double> memory;
  Moment now;
  const double some = 1.0 - std::exp(-1.0);
  for (const auto& [load, seconds, less] : {std::tuple{0.0, 9.0, 0.0},
                                            {20.0, 35.0, 2.0 * some},
                                            {20.0, 1e4, 2.0},
                                            {0.0, 35.0, 2.0 * (1.0 - some)},
                                            {-40.0, 1e4, -4.0}}) {
    now.load = load, now.seconds = seconds;
    EXPECT_NEAR(acted(hidden.load.at(0), now, memory), -less, 1e-12) << load;
  }
  // It comes back from the load.
  const RunPlan plan{40.0, k_slow, 3};
  const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
  EXPECT_GT(log[360].theta - plain[360].theta, 1.3 * (log[40].theta - plain[40].theta));
}

// ---- sensor, log ----------------------------------------------------------------------------------------------------

TEST(Unforeseen, a_lens_draws_in_what_is_far_off) {
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> none;
    Moment now;
    const Hidden middle = with("picture_drawn_in_by_lens", 0.01, soft(), {sign, 1.0, 0.5});
    const Hidden aside = with("picture_drawn_in_by_lens", 0.01, soft(), {sign, 1.0, 0.0});  // −18 deg of 30
    for (const auto& [degree, of_middle, of_aside] : {std::tuple{0.0, 0.0, 0.0},
                                                      {30.0, -1.0, -4.096 + 0.216},
                                                      {-30.0, 1.0, 0.064 + 0.216},
                                                      {15.0, -0.125, -1.331 + 0.216},
                                                      {-18.0, 0.216, 0.216}}) {
      now.theta = radians(degree);
      EXPECT_NEAR(acted(middle.reading.at(0), now, none), sign * 0.01 * of_middle, 1e-12) << degree;
      EXPECT_NEAR(acted(aside.reading.at(0), now, none), sign * 0.01 * of_aside, 1e-12) << degree;
    }
  }
}

TEST(Unforeseen, a_hall_plate_is_clipped_at_its_peak) {
  // At home, and at −18 deg.
  for (const auto& [share, peak] : {std::pair{0.5, 0.0}, {0.0, radians(-18.0)}}) {
    const Hidden hidden = with("hall_plate_clipped", 0.1, soft(), {1.0, 1.0, share});
    const auto shown = [at = peak](double theta) {
      const double from_peak = theta - at;
      return at + std::atan2(std::min(std::cos(from_peak), 0.9), -std::sin(from_peak)) - 0.5 * k_pi;
    };
    std::vector<double> none;
    Moment now;
    for (const double theta : {0.0, 0.1, 0.3, 0.5, -0.2, -0.3, -0.5, 0.9}) {
      now.theta = theta;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, none), shown(theta) - shown(0.0) - theta, 1e-12) << theta;
    }
  }
  const Hidden hidden = with("hall_plate_clipped", 0.1, soft());
  std::vector<double> none;
  Moment now;
  now.theta = 0.3;
  EXPECT_NEAR(acted(hidden.reading.at(0), now, none), 0.01726, 1e-4);
  now.theta = 0.5;
  EXPECT_EQ(acted(hidden.reading[0], now, none), 0.0) << "its cosine is below";
}

TEST(Unforeseen, the_motors_channel_is_seen_in_the_joints) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("ghost_of_motor_channel", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const double alpha : {0.0, 0.7, -1.3}) {
      now.alpha = alpha, now.theta += 0.1, now.load += 10.0;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, none), sign * 0.01 * alpha, 1e-15) << alpha;
    }
  }
}

TEST(Unforeseen, a_converter_runs_on_where_the_joint_turns_round) {
  const Hidden hidden = with("converter_running_on", 0.1, soft());
  // Whether it looks often or seldom.
  for (const int looks : {1, 4}) {
    std::vector<double> memory;
    Moment now;
    const auto gone = [&](double seconds, double speed) {
      double ahead = 0;
      for (int i = 0; i < looks; ++i) {
        now.time += seconds / looks, now.theta += speed * seconds / looks;
        ahead = acted(hidden.reading.at(0), now, memory);
      }
      return ahead;
    };
    EXPECT_EQ(acted(hidden.reading.at(0), now, memory), 0.0);
    EXPECT_NEAR(gone(0.1, 0.5), -0.05 * std::exp(-1.0), 1e-12) << "it has to find the speed";
    EXPECT_NEAR(gone(9.0, 0.5), 0.0, 1e-12) << "right at a steady speed";
    EXPECT_NEAR(gone(0.1, -0.5), 0.1 * std::exp(-1.0), 1e-12);
    EXPECT_NEAR(gone(0.2, -0.5), 0.3 * std::exp(-3.0), 1e-12);
    EXPECT_NEAR(gone(9.0, -0.5), 0.0, 1e-12);
    EXPECT_NEAR(gone(0.1, 0.0), -0.05 * std::exp(-1.0), 1e-12) << "beyond a stop";
    EXPECT_NEAR(gone(9.0, 0.0), 0.0, 1e-12);
    now.run = 1, now.theta = 0.3, now.time += 5.0;
    EXPECT_EQ(acted(hidden.reading[0], now, memory), 0.0) << "it stood in the pause";
  }
}

TEST(Unforeseen, a_sensor_is_tared_under_its_load) {
  const Hidden hidden = with("tared_under_load", 0.5, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [run, theta, off] : {std::tuple{0, 0.10, 0.0},
                                        {0, 0.40, 0.0},
                                        {1, 0.06, 0.02},
                                        {1, 0.40, 0.02},
                                        {2, 0.13, -0.015},
                                        {2, 0.10, -0.015},
                                        {3, 0.10, 0.0}}) {
    now.run = static_cast<std::size_t>(run), now.theta = theta;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), off, 1e-15) << run;
  }
}

TEST(Unforeseen, a_telephone_lies_there_for_a_while) {
  // From 25 s on, for 40 s; 1 rad.
  const Hidden hidden = with("telephone_beside_sensor", 0.01, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [time, theta, turned] : {std::tuple{0.0, 0.3, 0.0},
                                            {24.9, 0.3, 0.0},
                                            {25.1, 1.0, 1.0},
                                            {64.9, 1.0 - k_pi / 3.0, 0.5},
                                            {65.1, 0.3, 0.0}}) {
    now.time = time, now.theta = theta;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, none), 0.01 * turned, 1e-12) << time;
  }
}

TEST(Unforeseen, tape_creeps_by_the_decade) {
  // 6.5 s.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("sensor_on_creeping_tape", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [time, decades] : {std::pair{0.0, 0.0}, {58.5, 1.0}, {643.5, 2.0}}) {
      now.time = time, now.load += 10.0, now.theta += 0.1;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, none), sign * 0.01 * decades, 1e-12) << time;
    }
  }
}

TEST(Unforeseen, each_run_is_started_by_two_hands) {
  const Hidden hidden = with("logs_started_by_two_hands", 0.1, soft());
  std::vector<double> none;
  std::set<double> all;
  Moment now;
  for (std::size_t run = 0; run < 20; ++run) {
    now.run = run, now.theta_speed = 0.0;
    EXPECT_EQ(acted(hidden.reading.at(0), now, none), 0.0) << "at rest";
    now.theta_speed = 1.0;
    const double off = acted(hidden.reading[0], now, none);
    EXPECT_LE(std::abs(off), 0.1);
    now.theta_speed = -0.5, now.theta += 0.1;
    EXPECT_NEAR(acted(hidden.reading[0], now, none), -0.5 * off, 1e-15) << "all run";
    all.insert(off);
  }
  EXPECT_EQ(all.size(), 20u);
  EXPECT_LT(*all.begin(), -0.05);
  EXPECT_GT(*all.rbegin(), 0.05);
}

TEST(Unforeseen, a_body_is_seen_whenever_there_is_a_load) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("body_beside_sensor_when_loaded", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [load, seen] : {std::pair{0.0, 0.0}, {5.0, 1.0}, {40.0, 1.0}, {-40.0, 1.0}}) {
      now.load = load, now.theta += 0.1;
      EXPECT_EQ(acted(hidden.reading.at(0), now, none), sign * 0.01 * seen) << load;
    }
  }
}

TEST(Unforeseen, a_camera_looks_for_its_focus_at_each_reversal) {
  const Hidden hidden = with("camera_refocusing", 0.02, soft());
  std::vector<double> memory;
  std::set<double> gains;
  Moment now;
  now.direction = 1.0;
  for (int stroke = 0; stroke < 20; ++stroke, now.direction = -now.direction) {
    now.theta = 1.0;
    const double gain = acted(hidden.reading.at(0), now, memory);
    EXPECT_LE(std::abs(gain), 0.02);
    now.theta = -0.4;
    EXPECT_NEAR(acted(hidden.reading[0], now, memory), -0.4 * gain, 1e-15) << stroke;
    now.theta = 0.0;
    EXPECT_EQ(acted(hidden.reading[0], now, memory), 0.0) << stroke;
    gains.insert(gain);
  }
  EXPECT_EQ(gains.size(), 20u);
  EXPECT_LT(*gains.begin(), -0.01);
  EXPECT_GT(*gains.rbegin(), 0.01);
}

}  // namespace unforeseen
}  // namespace fusee::rig
