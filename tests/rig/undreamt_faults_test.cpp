// The twelfth split that is kept aside: each fault is what it says, by hand.
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "fusee/transmission/transmission.h"
#include "rig/fault_checks.h"

namespace fusee::rig {
namespace undreamt {

/// One tendon has it, by the sign of the character, and the other has not: what acts on that one.
const Action& only_action(const Hidden& hidden, double sign) {
  EXPECT_TRUE(hidden.longer[sign > 0 ? 0 : 1].empty());
  return hidden.longer[sign > 0 ? 1 : 0].at(0);
}

const double k_once = std::exp(-1.0);  // after one time constant

// ---- motor and shaft ------------------------------------------------------------------------------------------------

TEST(Undreamt, a_gentle_controller_comes_after) {
  const Hidden hidden = with("controller_too_gentle", 0.1, stiff());
  std::vector<double> memory;
  Moment now;
  EXPECT_EQ(acted(hidden.shaft.at(0), now, memory), 0.0);
  // 0.5 rad/s for one time constant, and long; then it stands.
  for (const auto& [seconds, way, late] : {std::tuple{0.1, 0.05, 0.05 * (1.0 - k_once)},
                                           {10.0, 5.0, 0.05},
                                           {0.1, 0.0, 0.05 * k_once},
                                           {10.0, 0.0, 0.0},
                                           {10.0, -5.0, -0.05}}) {
    now.seconds = seconds, now.alpha += way, now.load += 10.0;
    EXPECT_NEAR(acted(hidden.shaft[0], now, memory), -late, 1e-12) << seconds << " " << way;
  }
  // On the way up.
  const Log log = run_of(hidden, {0.0, k_slow, 1, 3.0}, stiff());
  const Transmission law(stiff().declared);
  EXPECT_NEAR(log[40].theta, law.theta(log[40].alpha - 0.1 * k_slow), 1e-5);
}

TEST(Undreamt, rubber_mounts_give_late_and_come_back) {
  // 15 s.
  const Hidden hidden = with("motor_on_rubber_mounts", 0.01, stiff());
  std::vector<double> memory;
  Moment now;
  for (const auto& [load, seconds, back] : {std::tuple{0.0, 9.0, 0.0},
                                            {20.0, 15.0, 1.0 - k_once},
                                            {20.0, 1e4, 1.0},
                                            {-40.0, 1e4, -2.0},
                                            {0.0, 15.0, -2.0 * k_once}}) {
    now.load = load, now.seconds = seconds, now.alpha += 0.1;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), -0.01 * back, 1e-12) << load;
  }
  expect_shaft_off(run_of(hidden, {0.0, k_slow, 1}, stiff()), [](std::size_t) { return 0.0; });
}

TEST(Undreamt, a_belt_gives_more_with_one_span_slack) {
  // From 10 N on.
  const Hidden hidden = with("one_span_of_belt_slack", 0.01, stiff());
  std::vector<double> none;
  Moment now;
  for (const auto& [load, back] :
       {std::pair{0.0, 0.0}, {9.0, 0.0}, {-10.0, 0.0}, {15.0, 0.5}, {30.0, 2.0}, {-30.0, -2.0}}) {
    now.load = load, now.alpha += 0.1;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), -0.01 * back, 1e-15) << load;
  }
}

TEST(Undreamt, a_bubble_gives_more_to_one_side) {
  // 45 N.
  const Hidden hidden = with("bubble_in_hydraulic_line", 0.02, stiff());
  std::vector<double> none;
  Moment now;
  for (const auto& [load, back] :
       {std::pair{0.0, 0.0}, {45.0, 0.5}, {135.0, 0.75}, {-15.0, -0.5}, {-22.5, -1.0}, {-36.0, -4.0}, {-90.0, -4.0}}) {
    now.load = load, now.alpha += 0.1;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), -0.02 * back, 1e-12) << load;
  }
}

TEST(Undreamt, a_wave_is_corrected_too_late) {
  // Two a turn, 0.03 rad high, 1 rad on at home.
  const Hidden hidden = with("wave_corrected_too_late", 0.05, stiff());
  std::vector<double> none;
  Moment now;
  for (const auto& [alpha, speed] : {std::pair{0.0, 0.0}, {0.4, 0.0}, {0.4, 1.5}, {0.4, -1.5}, {-0.9, 0.2}}) {
    now.alpha = alpha, now.alpha_speed = speed, now.load += 10.0;
    const double due = 0.03 * std::sin(2.0 * alpha + 1.0);
    const double taken = 0.03 * std::sin(2.0 * (alpha - 0.05 * speed) + 1.0);
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), due - taken, 1e-15) << alpha << " " << speed;
  }
}

// ---- pulley, tendons, frame -----------------------------------------------------------------------------------------

TEST(Undreamt, a_tape_winds_by_the_square) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("tape_wound_on_itself", 0.4, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    // A turn winds 2 π r with r half a thickness more on an average.
    for (const auto& [turns, longer] :
         {std::pair{0.0, 0.0}, {1.0, 0.4 * k_pi}, {-1.0, 0.4 * k_pi}, {0.5, 0.1 * k_pi}}) {
      now.alpha = k_two_pi * turns, now.load += 10.0;
      EXPECT_NEAR(acted(only_action(hidden, sign), now, none), longer, 1e-12) << turns;
    }
  }
}

TEST(Undreamt, a_disc_wobbles_to_and_fro) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("disc_wobbling_on_shaft", 0.2, soft(), {sign, 0.25 * k_pi, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [eighths, longer] :
         {std::pair{0.0, 0.0}, {1.0, 0.5}, {2.0, 0.0}, {3.0, -0.5}, {-1.0, -0.5}, {5.0, 0.5}}) {
      now.alpha = 0.25 * k_pi * eighths, now.load += 10.0;
      EXPECT_NEAR(acted(only_action(hidden, sign), now, none), 0.2 * longer, 1e-12) << eighths;
    }
  }
}

TEST(Undreamt, a_chain_of_beads_makes_a_polygon) {
  // Twelve pockets; at one of them at home.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("chain_of_beads_for_tendon", 0.1, soft(), {sign, 0.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [pockets, longer] :
         {std::pair{0.0, 0.0}, {0.5, 1.0}, {0.25, 0.75}, {0.9, 0.36}, {-0.1, 0.36}, {-3.5, 1.0}}) {
      now.alpha = k_two_pi * pockets / 12.0, now.load += 10.0;
      EXPECT_NEAR(acted(only_action(hidden, sign), now, none), 0.1 * longer, 1e-12) << pockets;
    }
    const Hidden between = with("chain_of_beads_for_tendon", 0.1, soft(), {sign, k_pi, 0.5});
    now.alpha = 0;
    EXPECT_NEAR(acted(only_action(between, sign), now, none), 0.0, 1e-12) << "home is home";
    now.alpha = k_pi / 12.0;
    EXPECT_NEAR(acted(only_action(between, sign), now, none), -0.1, 1e-12);
  }
}

TEST(Undreamt, a_stiff_link_is_pulled_straight) {
  const Hidden hidden = with("stiff_link_in_chain", 0.4, soft());
  const double place = 0.5 * (soft().alpha_min + soft().alpha_max);
  std::vector<double> none;
  Moment now;
  for (const auto& [widths, tension, longer] : {std::tuple{0.0, 0.0, 1.0},
                                                {0.0, 20.0, 0.5},
                                                {0.0, 60.0, 0.25},
                                                {1.0, 0.0, std::exp(-0.5)},
                                                {-1.0, 20.0, 0.5 * std::exp(-0.5)},
                                                {9.0, 0.0, 0.0}}) {
    now.alpha = place + 0.12 * widths, now.tension = {7.0 * widths, tension};
    EXPECT_NEAR(acted(only_action(hidden, 1.0), now, none), 0.4 * longer, 1e-12) << widths << " " << tension;
  }
}

TEST(Undreamt, a_clamp_is_driven_back_by_each_blow) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("clamp_struck_at_end_of_stroke", 0.1, soft(), {sign, 1.0, 0.5});
    const double low = soft().alpha_min, range = soft().alpha_max - soft().alpha_min;
    std::vector<double> memory;
    Moment now;
    for (const auto& [share, blows] : {std::pair{0.5, 0.0},
                                       {0.79, 0.0},
                                       {0.81, 1.0},
                                       {0.95, 1.0},
                                       {0.75, 1.0},
                                       {0.85, 1.0},
                                       {0.69, 1.0},
                                       {0.85, 2.0},
                                       {0.0, 2.0}}) {
      now.alpha = low + share * range, now.load += 10.0;
      EXPECT_NEAR(acted(only_action(hidden, sign), now, memory), -0.1 * blows, 1e-15) << share;
    }
  }
  // Every stroke comes there, and a stroke later it is longer.
  const Hidden hidden = with("clamp_struck_at_end_of_stroke", 0.3, soft());
  const RunPlan plan{0.0, k_slow, 3};
  const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
  EXPECT_GT(std::abs(log.back().theta - plain.back().theta), std::abs(log[20].theta - plain[20].theta));
}

TEST(Undreamt, fibres_rub_with_two_thirds_of_a_power) {
  const Hidden hidden = with("fibres_rubbing_by_howells_law", 300.0, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [first, second, dry] :
       {std::tuple{20.0, 20.0, 1.0}, {160.0, 0.0, 2.0}, {0.0, 2.5, 0.125}, {0.0, 0.0, 0.0}, {2.5, 160.0, 2.125}}) {
    now.tension = {first, second}, now.load += 10.0;
    EXPECT_NEAR(acted(hidden.dry.at(0), now, none), 300.0 * dry, 1e-9) << first << " " << second;
  }
}

TEST(Undreamt, a_pulley_is_warmed_by_its_motor) {
  // 35 s.
  const Hidden hidden = with("pulley_warmed_by_motor", 0.1, soft());
  BothWays both(hidden);
  Moment now;
  for (const auto& [alpha, speed, seconds, warm] : {std::tuple{0.5, 0.0, 9.0, 0.0},
                                                    {0.5, 1.0, 35.0, 1.0 - k_once},
                                                    {-0.5, -2.0, 1e4, 4.0},
                                                    {0.0, 2.0, 1e4, 4.0},
                                                    {1.0, 0.0, 35.0, 4.0 * k_once}}) {
    now.alpha = alpha, now.alpha_speed = speed, now.seconds = seconds, now.tension = {seconds, 3.0};
    const auto [one, other] = both(now);
    EXPECT_NEAR(other, 0.1 * alpha * warm, 1e-12) << alpha << " " << speed;
    EXPECT_NEAR(one, -other, 1e-15);
  }
}

TEST(Undreamt, a_stand_gives_to_the_side_without_a_guy) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("stand_guyed_on_one_side", 0.2, soft(), {sign, 1.0, 0.5});
    Moment now;
    for (const auto& [load, gives] : {std::pair{0.0, 0.0}, {40.0, 0.0}, {-20.0, 1.0}, {-5.0, 0.25}}) {
      now.load = sign * load, now.tension = {3.0, load};
      expect_ways_apart(hidden, now, -sign * 0.2 * gives, 1e-15);
    }
    // The joint yields to that load, and not to the other.
    const auto off = [&](double load) {
      const RunPlan plan{load, k_slow, 1};
      return run_of(hidden, plan, soft())[40].theta - run_of({}, plan, soft())[40].theta;
    };
    EXPECT_GT(sign * off(-sign * 25.0), radians(0.02));
    EXPECT_EQ(off(sign * 25.0), 0.0);
  }
}

// ---- joint ----------------------------------------------------------------------------------------------------------

TEST(Undreamt, a_link_shrinks_as_it_cools) {
  const Hidden hidden = with("link_shrinking_in_cold", 0.02, soft());
  std::vector<double> none;
  Moment now;
  now.theta = 0.3;
  for (const double turned : {0.0, 0.5, k_pi, -2.0}) {
    for (const double warmth : {0.0, -10.0, 5.0}) {
      // The link's own direction, and each pull that far from it.
      now.pull = {Vec2(std::sin(0.3 - turned), std::cos(0.3 - turned)),
                  Vec2(std::sin(0.3 + turned), std::cos(0.3 + turned))};
      now.warmth = warmth;
      for (const std::size_t side : {0u, 1u})
        EXPECT_NEAR(acted(hidden.longer[side].at(0), now, none), -0.02 * warmth * std::cos(turned), 1e-12) << turned;
    }
  }
}

TEST(Undreamt, grease_is_thinned_by_shear) {
  const Hidden hidden = with("grease_thinned_by_shear", 300.0, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [speed, dry] :
       {std::pair{0.0, 0.0}, {0.5, 1.0}, {-0.5, 1.0}, {16.0, 4.0}, {0.25, 0.757858}, {0.015625, 0.25}}) {
    now.theta_speed = speed, now.load += 10.0;
    EXPECT_NEAR(acted(hidden.dry.at(0), now, none), 300.0 * dry, 1e-3) << speed;
  }
}

TEST(Undreamt, a_seal_swells_by_the_clock) {
  // 120 s.
  const Hidden hidden = with("seal_swelling_in_oil", 500.0, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [time, dry] :
       {std::pair{0.0, 0.0}, {120.0, 1.0 - k_once}, {240.0, 1.0 - k_once * k_once}, {1e5, 1.0}}) {
    now.time = time, now.theta += 0.1;
    EXPECT_NEAR(acted(hidden.dry.at(0), now, none), 500.0 * dry, 1e-9) << time;
  }
}

TEST(Undreamt, copper_brakes_a_passing_magnet) {
  // At home, and at −18 deg.
  for (const auto& [share, place] : {std::pair{0.5, 0.0}, {0.0, radians(-18.0)}}) {
    const Hidden hidden = with("magnet_passing_copper", 500.0, soft(), {1.0, 1.0, share});
    std::vector<double> none;
    Moment now;
    for (const auto& [widths, speed, drag] : {std::tuple{0.0, 0.5, 0.5},
                                              {0.0, -0.5, -0.5},
                                              {0.0, 0.0, 0.0},
                                              {1.0, 2.0, 2.0 * std::exp(-0.5)},
                                              {9.0, 2.0, 0.0}}) {
      now.theta = place + 0.12 * widths, now.theta_speed = speed;
      EXPECT_NEAR(acted(hidden.torque.at(0), now, none), -500.0 * drag, 1e-9) << widths << " " << speed;
    }
  }
}

TEST(Undreamt, magnets_repel_at_the_end) {
  // 30 deg to either side, 0.25 rad between them there.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("magnets_repelling_at_end", 1000.0, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [apart, push] : {std::pair{0.0, 1.0}, {-0.1, 1.0}, {0.25, 0.0625}, {0.75, 1.0 / 256.0}}) {
      now.theta = sign * (radians(30.0) - apart), now.load += 10.0;
      EXPECT_NEAR(acted(hidden.torque.at(0), now, none), -sign * 1000.0 * push, 1e-8) << apart;
    }
  }
}

TEST(Undreamt, a_fan_blows_as_it_looks_that_way) {
  // 0.65 rad/s, 1 rad on at the begin.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("fan_swinging_past_link", 300.0, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [looks, theta, blows] : {std::tuple{k_two_pi, 0.0, 1.0},
                                              {k_two_pi, k_pi / 3.0, 0.5},
                                              {0.5 * k_pi, 0.0, std::exp(-6.0)},
                                              {k_pi, 0.0, std::exp(-12.0)},
                                              {2.0 * k_two_pi, -k_pi / 3.0, 0.5}}) {
      now.time = (looks - 1.0) / 0.65, now.theta = theta;
      EXPECT_NEAR(acted(hidden.torque.at(0), now, none), sign * 300.0 * blows, 1e-8) << looks;
    }
  }
}

// ---- load -----------------------------------------------------------------------------------------------------------

TEST(Undreamt, a_cylinder_sticks_after_each_reversal) {
  // 0.2 rad.
  const Hidden hidden = with("cylinder_for_weight_sticking", 2.0, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [load, direction, alpha, more] : {std::tuple{20.0, 0.0, 0.0, 0.0},
                                                     {20.0, 1.0, 0.1, 1.0},
                                                     {20.0, 1.0, 0.3, k_once},
                                                     {-20.0, 1.0, 0.3, k_once},
                                                     {0.0, 1.0, 0.4, 0.0},
                                                     {-5.0, 1.0, 0.5, k_once * k_once},
                                                     {-5.0, -1.0, 0.45, -1.0},
                                                     {20.0, -1.0, 0.25, -k_once}}) {
    now.load = load, now.direction = direction, now.alpha = alpha;
    EXPECT_NEAR(acted(hidden.load.at(0), now, memory), 2.0 * more, 1e-12) << load << " " << alpha;
  }
}

TEST(Undreamt, a_coil_gets_hot_with_the_square_of_the_load) {
  // 35 s.
  const Hidden hidden = with("coil_for_weight_growing_hot", 0.5, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [load, seconds, less] : {std::tuple{0.0, 1e4, 0.0},
                                            {20.0, 1e4, 20.0 / 3.0},
                                            {-40.0, 1e4, -40.0 * 2.0 / 3.0},
                                            {0.0, 35.0, 0.0},
                                            {20.0, 0.0, 20.0 * 2.0 * k_once / (1.0 + 2.0 * k_once)}}) {
    now.load = load, now.seconds = seconds, now.theta += 0.1;
    EXPECT_NEAR(acted(hidden.load.at(0), now, memory), -less, 1e-9) << load;
  }
}

TEST(Undreamt, a_hanger_is_left_on_after_a_load) {
  const Hidden hidden = with("hanger_left_on_after_load", 1.5, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [load, more] :
       {std::pair{0.0, 0.0}, {20.0, 0.0}, {0.0, 1.5}, {0.0, 1.5}, {-5.0, 0.0}, {0.0, -1.5}, {7.0, 0.0}, {0.0, 1.5}}) {
    now.load = load, now.theta += 0.1, now.run += 1;
    EXPECT_EQ(acted(hidden.load.at(0), now, memory), more) << load;
  }
}

TEST(Undreamt, shut_air_pulls_by_boyles_law) {
  const Hidden hidden = with("cylinder_of_shut_air", 0.5, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [load, theta, more] : {std::tuple{20.0, 0.0, 0.0},
                                          {20.0, 0.4, 5.0},
                                          {20.0, -0.5, -4.0},
                                          {-20.0, -0.4, -5.0},
                                          {-20.0, 0.5, 4.0},
                                          {20.0, 1.9, 60.0},
                                          {0.0, 0.4, 0.0}}) {
    now.load = load, now.theta = theta;
    EXPECT_NEAR(acted(hidden.load.at(0), now, none), more, 1e-12) << load << " " << theta;
  }
}

// ---- sensor, log ----------------------------------------------------------------------------------------------------

TEST(Undreamt, a_short_rod_leans) {
  // Crank and rod, 1 and 5 long, across at home or at −18 deg.
  for (const auto& [share, across] : {std::pair{0.5, 0.0}, {0.0, radians(-18.0)}}) {
    const Hidden hidden = with("slide_gauge_on_short_rod", 0.2, soft(), {1.0, 1.0, share});
    const auto slide = [at = across](double theta) {
      const double x = theta - at;
      return std::sin(x) + std::sqrt(25.0 - std::pow(std::cos(x), 2)) - 5.0;
    };
    std::vector<double> none;
    Moment now;
    for (const double theta : {0.0, 0.3, -0.3, 0.52, -0.52}) {
      now.theta = theta, now.load += 10.0;
      const double endless = std::sin(theta - across) - std::sin(-across);
      EXPECT_NEAR(acted(hidden.reading.at(0), now, none), slide(theta) - slide(0.0) - endless, 1e-12) << theta;
    }
  }
}

TEST(Undreamt, two_converters_take_turns) {
  const Hidden hidden = with("two_converters_in_turn", 0.01, soft());
  std::vector<double> memory;
  Moment now;
  for (int row = 0; row < 20; ++row, now.theta += 0.1, now.time += 0.3)
    EXPECT_EQ(acted(hidden.reading.at(0), now, memory), row % 2 == 0 ? 0.005 : -0.005) << row;
  const RunPlan plan{0.0, k_slow, 1};
  const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
  for (std::size_t row = 1; row < log.size(); ++row) {
    const double step = (log[row].theta - plain[row].theta) - (log[row - 1].theta - plain[row - 1].theta);
    EXPECT_NEAR(std::abs(step), 0.01, 1e-6) << row;
  }
}

TEST(Undreamt, a_clock_is_set_right) {
  // 25 s.
  const Hidden hidden = with("clock_set_right_midway", 0.1, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [time, speed, late] : {std::tuple{0.0, 0.5, 0.0},
                                          {24.9, 0.5, 0.0},
                                          {25.1, 0.5, 0.5},
                                          {25.1, -0.5, -0.5},
                                          {900.0, 2.0, 2.0},
                                          {900.0, 0.0, 0.0}}) {
    now.time = time, now.theta_speed = speed, now.theta += 0.1;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, none), -0.1 * late, 1e-15) << time;
  }
}

TEST(Undreamt, a_surge_comes_with_every_start) {
  // 1.15 s.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("surge_at_every_start", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    for (const auto& [since, speed, off] : {std::tuple{0.0, 0.0, 0.0},
                                            {5.0, 0.2, 1.0},
                                            {1.15, 0.2, k_once},
                                            {1.15, 1.5, k_once * k_once},
                                            {1.15, -0.2, 1.0},
                                            {1.15, 0.0, k_once},
                                            {1e3, 0.0, 0.0},
                                            {1.0, -0.2, 1.0}}) {
      now.time += since, now.alpha_speed = speed, now.theta += 0.1;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), sign * 0.01 * off, 1e-12) << since << " " << speed;
    }
  }
}

TEST(Undreamt, a_disc_is_clamped_anew_in_every_run) {
  const Hidden hidden = with("disc_clamped_anew_in_every_run", 0.02, soft());
  std::vector<double> none;
  std::set<double> quarters;
  for (std::size_t run = 0; run < 20; ++run) {
    Moment now;
    now.run = run;
    const auto shown = [&](double theta) {
      now.theta = theta, now.load += 10.0;
      return acted(hidden.reading.at(0), now, none);
    };
    EXPECT_EQ(shown(0.0), 0.0);
    // sin(θ + φ) − sin φ: at a quarter of a turn cos φ − sin φ, at minus that −cos φ − sin φ.
    const double sine = -0.5 * (shown(0.5 * k_pi) + shown(-0.5 * k_pi));
    const double cosine = 0.5 * (shown(0.5 * k_pi) - shown(-0.5 * k_pi));
    EXPECT_NEAR(std::hypot(sine, cosine), 0.02, 1e-12);
    EXPECT_NEAR(shown(0.3), sine * (std::cos(0.3) - 1.0) + cosine * std::sin(0.3), 1e-12);
    quarters.insert(std::floor(std::atan2(sine, cosine) / (0.5 * k_pi)));
  }
  EXPECT_EQ(quarters.size(), 4u) << "all round";
}

TEST(Undreamt, a_wire_opens_when_it_is_bent) {
  // At home, 2.75 s.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("wire_opening_when_bent", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    for (const auto& [since, degree, drifted] : {std::tuple{0.0, -5.0, 0.0},
                                                 {9.0, -5.0, 0.0},
                                                 {2.75, 5.0, 1.0 - k_once},
                                                 {2.75, 20.0, 1.0 - k_once * k_once},
                                                 {1e4, 1.0, 1.0},
                                                 {0.1, -1.0, 0.0},
                                                 {2.75, 1.0, 1.0 - k_once}}) {
      now.time += since, now.theta = sign * radians(degree);
      EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), 0.01 * drifted, 1e-12) << since << " " << degree;
    }
  }
}

TEST(Undreamt, a_table_of_few_entries_goes_by_chords) {
  // Every 10 deg; one entry at home, or at −18 deg.
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> none;
    Moment now;
    const Hidden middle = with("table_of_few_entries", 0.01, soft(), {sign, 1.0, 0.5});
    for (const auto& [degree, off] :
         {std::pair{0.0, 0.0}, {5.0, 1.0}, {2.5, 0.75}, {-2.5, 0.75}, {-15.0, 1.0}, {29.0, 0.36}}) {
      now.theta = radians(degree), now.load += 10.0;
      EXPECT_NEAR(acted(middle.reading.at(0), now, none), sign * 0.01 * off, 1e-12) << degree;
    }
    // Every 5 deg; home is 0.6 of one from an entry, where it is off by 0.96.
    const Hidden aside = with("table_of_few_entries", 0.01, soft(), {sign, 1.0, 0.0});
    for (const auto& [degree, off] : {std::pair{0.0, 0.0}, {-0.5, 0.04}, {-3.0, -0.96}, {-10.0, 0.0}, {7.0, -0.96}}) {
      now.theta = radians(degree), now.load += 10.0;
      EXPECT_NEAR(acted(aside.reading.at(0), now, none), sign * 0.01 * off, 1e-12) << degree;
    }
  }
}

TEST(Undreamt, a_zero_walks_by_chance) {
  const Hidden hidden = with("zero_walking_by_chance", 1e-3, soft());
  std::vector<double> memory;
  Moment now;
  EXPECT_EQ(acted(hidden.reading.at(0), now, memory), 0.0);
  EXPECT_EQ(acted(hidden.reading.at(0), now, memory), 0.0) << "no time has gone";
  double before = 0, sum = 0, squares = 0;
  for (int step = 0; step < 400; ++step) {
    const double seconds = step % 2 == 0 ? 0.25 : 4.0;
    now.time += seconds, now.theta += 0.1;
    const double off = acted(hidden.reading[0], now, memory);
    const double draw = (off - before) / (1e-3 * std::sqrt(seconds));
    before = off, sum += draw, squares += draw * draw;
  }
  EXPECT_NEAR(sum / 400.0, 0.0, 0.12);
  EXPECT_NEAR(std::sqrt(squares / 400.0), 1.0, 0.1);
}

}  // namespace undreamt
}  // namespace fusee::rig
