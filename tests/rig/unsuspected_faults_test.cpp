// The thirteenth split that is kept aside: each fault is what it says, by hand.
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "fusee/transmission/transmission.h"
#include "rig/fault_checks.h"

namespace fusee::rig {
namespace unsuspected {

/// One tendon has it, by the sign of the character, and the other has not: what acts on that one.
const Action& only_action(const Hidden& hidden, double sign) {
  EXPECT_TRUE(hidden.longer[sign > 0 ? 0 : 1].empty());
  return hidden.longer[sign > 0 ? 1 : 0].at(0);
}

const double k_once = std::exp(-1.0);  // after one time constant
const double k_twice = k_once * k_once;

// ---- motor and shaft ------------------------------------------------------------------------------------------------

TEST(Unsuspected, magnets_lean_by_an_arc_sine) {
  // 60 N.
  const Hidden hidden = with("magnets_for_coupling_leaning", 0.05, stiff());
  std::vector<double> none;
  Moment now;
  for (const auto& [load, back] : {std::pair{0.0, 0.0},
                                   {30.0, k_pi / 6.0},
                                   {-30.0, -k_pi / 6.0},
                                   {60.0 * std::sqrt(0.5), 0.25 * k_pi},
                                   {60.0, std::asin(0.98)},
                                   {-900.0, -std::asin(0.98)}}) {
    now.load = load, now.alpha += 0.1;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), -0.05 * back, 1e-12) << load;
  }
  expect_shaft_off(run_of(hidden, {30.0, k_slow, 1}, stiff()), [](std::size_t) { return -0.05 * k_pi / 6.0; });
}

TEST(Unsuspected, an_uneven_motor_goes_back_unevenly) {
  // Eight a turn, 1 rad on at home.
  const Hidden hidden = with("motor_of_uneven_force", 0.01, stiff());
  std::vector<double> none;
  Moment now;
  for (const auto& [eighths, load, back] : {std::tuple{0.0, 0.0, 0.0},
                                            {0.0, 20.0, std::sin(1.0)},
                                            {0.25, 20.0, std::cos(1.0)},
                                            {0.5, 20.0, -std::sin(1.0)},
                                            {0.25, -40.0, -2.0 * std::cos(1.0)},
                                            {3.0, 10.0, 0.5 * std::sin(1.0)},
                                            {0.25, 0.0, 0.0}}) {
    now.alpha = k_two_pi * eighths / 8.0, now.load = load;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), -0.01 * back, 1e-12) << eighths << " " << load;
  }
}

TEST(Unsuspected, a_split_gear_is_pushed_open_once) {
  // 8 … 10 N.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("split_gear_pushed_open", 0.01, stiff(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [load, back] :
         {std::pair{0.0, 0.0}, {7.9, 0.0}, {9.0, 0.5}, {10.1, 1.0}, {80.0, 1.0}, {-9.0, 0.0}, {-80.0, 0.0}}) {
      now.load = sign * load, now.alpha += 0.1, now.direction = -now.direction;
      EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), -sign * 0.01 * back, 1e-12) << load;
    }
  }
}

TEST(Unsuspected, a_strain_wave_gear_stays_behind_its_load) {
  // 2 N to either side.
  const Hidden hidden = with("strain_wave_gear_rubbing_within", 0.005, stiff());
  std::vector<double> memory;
  Moment now;
  for (const auto& [load, ahead] : {std::pair{0.0, 0.0},
                                    {1.0, 0.5},
                                    {10.0, 1.0},
                                    {10.0, 1.0},
                                    {9.0, 0.5},
                                    {8.0, 0.0},
                                    {6.0, -1.0},
                                    {0.0, -1.0},
                                    {-20.0, -1.0},
                                    {-19.0, -0.5},
                                    {0.0, 1.0}}) {
    now.load = load, now.alpha += 0.1;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), 0.005 * ahead, 1e-12) << load;
  }
}

TEST(Unsuspected, a_worm_shrinks_as_it_cools) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("worm_shrinking_in_cold", 1e-3, stiff(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [warmth, off] : {std::pair{0.0, 0.0}, {-10.0, -0.01}, {5.0, 0.005}}) {
      now.warmth = warmth, now.alpha += 0.1, now.load += 10.0;
      EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), sign * off, 1e-15) << warmth;
    }
  }
}

TEST(Unsuspected, a_vee_belt_sinks_under_either_load) {
  const Hidden hidden = with("vee_belt_sinking_into_its_wheel", 0.01, stiff());
  std::vector<double> none;
  Moment now;
  for (const auto& [alpha, load, back] : {std::tuple{0.0, 20.0, 0.0},
                                          {0.5, 0.0, 0.0},
                                          {0.5, 20.0, 0.5},
                                          {0.5, -20.0, 0.5},
                                          {-0.5, 40.0, -1.0},
                                          {-0.5, -40.0, -1.0}}) {
    now.alpha = alpha, now.load = load;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), -0.01 * back, 1e-15) << alpha << " " << load;
  }
}

TEST(Unsuspected, a_shaft_is_carried_aside_by_its_oil) {
  // 1.1 rad/s.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("shaft_carried_aside_by_oil", 0.1, soft(), {sign, 1.0, 0.5});
    Moment now;
    for (const auto& [speed, aside] : {std::pair{0.0, 0.0},
                                       {1.1 * (std::sqrt(2.0) - 1.0), 1.0},
                                       {1.1, std::sqrt(0.75)},
                                       {-1.1, -std::sqrt(0.75)},
                                       {4.4, 0.4 * std::sqrt(0.96)}}) {
      now.alpha_speed = speed, now.alpha += 0.1, now.load += 10.0;
      expect_ways_apart(hidden, now, -sign * 0.1 * aside, 1e-12);
    }
  }
}

// ---- tendons, pins, frame -------------------------------------------------------------------------------------------

TEST(Unsuspected, crystals_change_and_change_back_late) {
  // Over 25 … 33 N, and back over 27 … 19 N; the other tendon by its own pull.
  const Hidden hidden = with("tendon_changing_its_crystals", 0.3, soft());
  BothWays both(hidden);
  Moment now;
  for (const auto& [tension, changed] : {std::pair{20.0, 0.0},
                                         {29.0, 0.5},
                                         {26.0, 0.5},
                                         {31.0, 0.75},
                                         {40.0, 1.0},
                                         {27.1, 1.0},
                                         {23.0, 0.5},
                                         {26.0, 0.5},
                                         {20.0, 0.125},
                                         {0.0, 0.0},
                                         {25.0, 0.0}}) {
    now.tension = {21.0, tension}, now.load += 1.0, now.alpha += 0.1;
    const auto [one, other] = both(now);
    EXPECT_NEAR(other, 0.3 * changed, 1e-12) << tension;
    EXPECT_EQ(one, 0.0);
  }
  now.tension = {29.0, 0.0};
  EXPECT_NEAR(both(now)[0], 0.15, 1e-12);
}

TEST(Unsuspected, a_panel_pops_over_and_stays) {
  // Over at 7 N, back at 2.33 N to the other side.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("panel_popping_like_an_oil_can", 0.2, soft(), {sign, 1.0, 0.5});
    BothWays both(hidden);
    Moment now;
    for (const auto& [load, over] : {std::pair{0.0, 0.0},
                                     {6.9, 0.0},
                                     {7.1, 1.0},
                                     {40.0, 1.0},
                                     {0.0, 1.0},
                                     {-2.2, 1.0},
                                     {-2.4, 0.0},
                                     {-40.0, 0.0},
                                     {6.9, 0.0}}) {
      now.load = sign * load, now.tension = {load, 3.0};
      const auto [one, other] = both(now);
      EXPECT_NEAR(one, sign * 0.2 * over, 1e-15) << load;
      EXPECT_NEAR(other, -sign * 0.2 * over, 1e-15) << load;
    }
    // The joint yields to that load, and not to the other.
    const auto off = [&](double load) {
      const RunPlan plan{load, k_slow, 1};
      return run_of(hidden, plan, soft())[40].theta - run_of({}, plan, soft())[40].theta;
    };
    EXPECT_LT(sign * off(sign * 25.0), -radians(0.02));
    EXPECT_EQ(off(-sign * 25.0), 0.0);
  }
}

TEST(Unsuspected, a_lock_nut_is_shaken_loose_when_fast) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("lock_nut_shaken_loose", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    for (const auto& [alpha, speed, shaken] : {std::tuple{0.2, 1.0, 0.0},
                                               {0.7, 1.0, 0.5},
                                               {0.2, -2.0, 2.5},
                                               {0.2, 3.0, 2.5},
                                               {0.6, 0.1, 2.504},
                                               {1.6, 9.0, 11.504}}) {
      now.alpha = alpha, now.alpha_speed = speed, now.load += 10.0, now.time += 1.0;
      EXPECT_NEAR(acted(only_action(hidden, sign), now, memory), -0.01 * shaken, 1e-12) << alpha << " " << speed;
    }
  }
}

TEST(Unsuspected, a_ferrule_slips_at_each_jerk) {
  // From 1 N on.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("ferrule_slipping_at_each_jerk", 0.2, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    for (const auto& [load, jerks] : {std::pair{0.0, 0.0},
                                      {0.9, 0.0},
                                      {1.1, 1.0},
                                      {20.0, 1.0},
                                      {-20.0, 1.0},
                                      {0.0, 1.0},
                                      {0.0, 1.0},
                                      {-5.0, 2.0},
                                      {0.0, 2.0},
                                      {3.0, 3.0}}) {
      now.load = load, now.alpha += 0.1;
      EXPECT_NEAR(acted(only_action(hidden, sign), now, memory), 0.2 * jerks, 1e-15) << load;
    }
  }
}

TEST(Unsuspected, a_tape_wanders_along_the_stroke) {
  // 0.65 rad.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("tape_wandering_on_its_drum", 0.2, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    for (const auto& [alpha, direction, aside] : {std::tuple{-0.3, 0.0, 0.0},
                                                  {0.35, 1.0, 1.0 - k_once},
                                                  {1.0, 1.0, 1.0 - k_twice},
                                                  {1.0, 1.0, 1.0 - k_twice},
                                                  {0.35, -1.0, -1.0 + (2.0 - k_twice) * k_once},
                                                  {-90.0, -1.0, -1.0},
                                                  {-89.35, 1.0, 1.0 - 2.0 * k_once}}) {
      now.alpha = alpha, now.direction = direction, now.load += 10.0, now.time += 5.0;
      EXPECT_NEAR(acted(only_action(hidden, sign), now, memory), 0.2 * aside, 1e-12) << alpha;
    }
  }
}

TEST(Unsuspected, wires_gall_by_their_work) {
  // 15 rad.
  const Hidden hidden = with("wires_and_pins_galling", 500.0, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [alpha, first, second, dry] : {std::tuple{1.0, 20.0, 20.0, 0.0},
                                                  {16.0, 20.0, 20.0, 1.0 - k_once},
                                                  {1.0, 40.0, 0.0, 1.0 - k_twice},
                                                  {1.0, 60.0, 60.0, 3.0 * (1.0 - k_twice)},
                                                  {1.0, 0.0, -5.0, 0.0},
                                                  {-4.0, 60.0, 60.0, 3.0 * (1.0 - k_twice * k_once)}}) {
    now.alpha = alpha, now.tension = {first, second}, now.time += 100.0, now.load += 10.0;
    EXPECT_NEAR(acted(hidden.dry.at(0), now, memory), 500.0 * dry, 1e-9) << alpha << " " << first;
  }
}

TEST(Unsuspected, a_buffer_spring_closes_up) {
  // 30 N.
  const Hidden hidden = with("buffer_spring_closing_up", 0.1, soft());
  BothWays both(hidden);
  Moment now;
  for (const auto& [tension, longer] :
       {std::pair{20.0, 0.0}, {25.0, 0.25}, {30.0, 0.5}, {90.0, 0.5}, {10.0, -0.5}, {0.0, -1.0}, {-3.0, -1.0}}) {
    now.load += 10.0;
    now.tension = {20.0, tension};
    EXPECT_NEAR(both(now)[1], 0.1 * longer, 1e-15) << tension;
    now.tension = {tension, 20.0};
    EXPECT_NEAR(both(now)[0], 0.1 * longer, 1e-15) << tension;
    EXPECT_NEAR(both(now)[1], 0.0, 1e-15);
  }
}

TEST(Unsuspected, a_tendon_rubs_on_the_edge_of_a_cover) {
  // From home on, or from −18 deg on; the tendon on the far side.
  for (const auto& [share, place] : {std::pair{0.5, 0.0}, {0.0, radians(-18.0)}}) {
    for (const double sign : {1.0, -1.0}) {
      const Hidden hidden = with("tendon_over_edge_of_cover", 500.0, soft(), {sign, 1.0, share});
      std::vector<double> none;
      Moment now;
      for (const auto& [beyond, tension, dry] : {std::tuple{0.0, 20.0, 0.0},
                                                 {-0.2, 20.0, 0.0},
                                                 {0.15, 20.0, 0.5},
                                                 {0.3, 20.0, 1.0},
                                                 {0.6, 20.0, 1.0},
                                                 {0.15, 60.0, 1.5},
                                                 {0.3, -5.0, 0.0}}) {
        now.theta = place + sign * beyond, now.load += 10.0;
        now.tension[sign > 0 ? 0 : 1] = tension, now.tension[sign > 0 ? 1 : 0] = 77.0;
        EXPECT_NEAR(acted(hidden.dry.at(0), now, none), 500.0 * dry, 1e-9) << beyond << " " << tension;
      }
    }
  }
}

// ---- joint ----------------------------------------------------------------------------------------------------------

TEST(Unsuspected, a_ball_rolls_over_when_the_joint_has_turned) {
  // 6 deg.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("ball_rolling_in_hollow_link", 200.0, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    for (const auto& [degree, lies] : {std::pair{0.0, 0.0},
                                       {5.0, 0.0},
                                       {10.0, 0.0},
                                       {10.0, 1.0},
                                       {-5.0, 1.0},
                                       {-60.0, 1.0},
                                       {-60.0, -1.0},
                                       {0.0, -1.0},
                                       {5.0, -1.0},
                                       {7.0, -1.0},
                                       {0.0, 1.0}}) {
      now.theta = radians(degree), now.load += 10.0;
      EXPECT_NEAR(acted(hidden.torque.at(0), now, memory), sign * 200.0 * lies * std::cos(radians(degree)), 1e-9)
          << degree;
    }
  }
}

TEST(Unsuspected, a_ring_creeps_round_and_round) {
  // A rad in ten; 1 rad on at first.
  const Hidden hidden = with("bearing_ring_creeping_round", 0.1, soft());
  BothWays both(hidden);
  Moment now;
  const double c = std::cos(1.0), s = std::sin(1.0);
  now.pull = {Vec2(1.0, 0.0), Vec2(0.0, 1.0)};
  for (const auto& [alpha, across, along] : {std::tuple{3.0, 0.0, 0.0},
                                             {3.0 + 5.0 * k_pi, -s - c, c - s},
                                             {3.0, -2.0 * c, -2.0 * s},
                                             {3.0 - 10.0 * k_pi, 0.0, 0.0},
                                             {3.0 - 15.0 * k_pi, -s - c, c - s}}) {
    now.alpha = alpha, now.theta += 0.1, now.load += 10.0;
    const auto [one, other] = both(now);
    EXPECT_NEAR(one, -0.1 * across, 1e-12) << alpha;
    EXPECT_NEAR(other, -0.1 * along, 1e-12) << alpha;
  }
}

TEST(Unsuspected, a_ball_catch_draws_to_the_nearest_notch) {
  // 21 a turn, 1 rad on at home.
  const Hidden hidden = with("axle_with_ball_catch", 200.0, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [notches, draws] :
       {std::pair{0.0, -std::sin(1.0)}, {0.25, -std::cos(1.0)}, {0.5, std::sin(1.0)}, {-2.0, -std::sin(1.0)}}) {
    now.theta = k_two_pi * notches / 21.0, now.alpha += 0.1, now.load += 10.0;
    EXPECT_NEAR(acted(hidden.torque.at(0), now, none), 200.0 * draws, 1e-9) << notches;
  }
  // Stable at a notch.
  now.theta = -1.0 / 21.0 + 0.01;
  EXPECT_LT(acted(hidden.torque[0], now, none), 0.0);
  now.theta = -1.0 / 21.0 - 0.01;
  EXPECT_GT(acted(hidden.torque[0], now, none), 0.0);
}

TEST(Unsuspected, water_drags_with_the_square_of_the_speed) {
  const Hidden hidden = with("link_moved_under_water", 500.0, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [speed, drag] : {std::pair{0.0, 0.0}, {1.0, 1.0}, {-1.0, -1.0}, {0.1, 0.01}, {-2.0, -4.0}}) {
    now.alpha_speed = speed, now.theta += 0.1, now.load += 10.0;
    EXPECT_NEAR(acted(hidden.torque.at(0), now, none), -500.0 * drag, 1e-9) << speed;
  }
  // It is behind on the way up, and on the way down on the other side.
  const RunPlan plan{0.0, k_fast, 1};
  const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
  EXPECT_LT(log[40].theta, plain[40].theta - radians(0.02));
  EXPECT_GT(log[120].theta, plain[120].theta + radians(0.02));
}

TEST(Unsuspected, gusts_come_by_chance) {
  // 3.5 s.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("gusts_through_a_window", 200.0, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    now.seconds = 0;
    EXPECT_EQ(acted(hidden.torque.at(0), now, memory), 0.0) << "calm at first";
    const auto after = [&](double seconds) {
      now.seconds = seconds, now.theta += 0.1, now.load += 1.0;
      return acted(hidden.torque[0], now, memory) / (sign * 200.0);
    };
    double sum = 0, together = 0;
    for (int draw = 0; draw < 4000; ++draw) {
      const double one = after(1e4);
      EXPECT_GE(one, 0.0);
      EXPECT_NEAR(after(0.0), one, 1e-12 * (1.0 + one)) << "no time has gone";
      const double later = after(3.5 * std::log(2.0));
      sum += one;
      together += (one - 1.0) * (later - 1.0);
    }
    // Squares of Gaussian numbers of mean 1 and variance 2; the wind is half the same after a half-life, its square a
    // quarter.
    EXPECT_NEAR(sum / 4000.0, 1.0, 0.1);
    EXPECT_NEAR(together / 4000.0, 0.5, 0.25);
  }
}

TEST(Unsuspected, a_nut_tightens_more_than_it_loosens) {
  const Hidden hidden = with("axle_nut_tightening_itself", 500.0, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [theta, tight] :
       {std::pair{0.1, 0.0}, {0.6, 0.5}, {0.35, 0.3}, {0.35, 0.3}, {0.6, 0.55}, {-0.4, 0.0}, {0.0, 0.4}}) {
    now.theta = theta, now.time += 10.0, now.load += 10.0;
    EXPECT_NEAR(acted(hidden.dry.at(0), now, memory), 500.0 * tight, 1e-9) << theta;
  }
}

// ---- load -----------------------------------------------------------------------------------------------------------

TEST(Unsuspected, a_tank_is_refilled_again_and_again) {
  // 24 s; half of that has gone.
  const Hidden hidden = with("compressor_refilling_its_tank", 0.1, soft(), {1.0, k_pi, 0.5});
  std::vector<double> none;
  Moment now;
  for (const auto& [time, load, more] : {std::tuple{0.0, 20.0, 0.0},
                                         {6.0, 20.0, -0.5},
                                         {11.99, 20.0, -2.0 * (0.5 - 0.01 / 24.0)},
                                         {12.01, 20.0, 2.0 * (0.5 - 0.01 / 24.0)},
                                         {18.0, 20.0, 0.5},
                                         {18.0, -40.0, -1.0},
                                         {18.0, 0.0, 0.0},
                                         {66.0, 20.0, 0.5}}) {
    now.time = time, now.load = load, now.theta += 0.1;
    EXPECT_NEAR(acted(hidden.load.at(0), now, none), more, 1e-9) << time << " " << load;
  }
}

TEST(Unsuspected, air_comes_through_a_throttle) {
  const Hidden hidden = with("air_for_load_throttled", 2.0, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [load, seconds, more] : {std::tuple{0.0, 9.0, 0.0},
                                            {20.0, 2.0, -20.0 * k_once},
                                            {20.0, 2.0, -20.0 * k_twice},
                                            {0.0, 2.0, 20.0 * (1.0 - k_twice) * k_once},
                                            {0.0, 1e4, 0.0},
                                            {-10.0, 2.0, 10.0 * k_once},
                                            {-10.0, 1e4, 0.0}}) {
    now.load = load, now.seconds = seconds, now.theta += 0.1;
    EXPECT_NEAR(acted(hidden.load.at(0), now, memory), more, 1e-12) << load << " " << seconds;
  }
  // At the begin of a loaded run it is not all there, in the end it is.
  const RunPlan plan{25.0, k_slow, 1};
  const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
  EXPECT_GT(log.front().theta, plain.front().theta + radians(0.05));
  EXPECT_NEAR(log.back().theta, plain.back().theta, radians(0.02));
}

TEST(Unsuspected, a_motor_for_a_load_is_a_dynamo_too) {
  const Hidden hidden = with("motor_for_load_a_dynamo", 1.5, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [load, speed, more] : {std::tuple{20.0, 0.0, 0.0},
                                          {20.0, 0.5, 0.75},
                                          {5.0, -0.5, -0.75},
                                          {-20.0, 2.0, 3.0},
                                          {-20.0, -2.0, -3.0},
                                          {0.0, 2.0, 0.0}}) {
    now.load = load, now.alpha_speed = speed, now.theta += 0.1;
    EXPECT_NEAR(acted(hidden.load.at(0), now, none), more, 1e-15) << load << " " << speed;
  }
}

TEST(Unsuspected, a_gas_pulls_less_as_it_cools) {
  const Hidden hidden = with("gas_for_load_cooling", 0.02, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [load, warmth, more] : {std::tuple{25.0, 0.0, 0.0},
                                           {25.0, -10.0, -5.0},
                                           {-25.0, -10.0, 5.0},
                                           {0.0, -10.0, 0.0},
                                           {25.0, 5.0, 2.5},
                                           {20.0, -300.0, -19.0}}) {
    now.load = load, now.warmth = warmth, now.theta += 0.1, now.time += 10.0;
    EXPECT_NEAR(acted(hidden.load.at(0), now, none), more, 1e-12) << load << " " << warmth;
  }
}

// ---- sensor, log ----------------------------------------------------------------------------------------------------

TEST(Unsuspected, a_sunbeam_passes) {
  // At 30 s, 8 s wide.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("sunbeam_passing_sensor", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [time, off] :
         {std::pair{30.0, 1.0}, {38.0, std::exp(-0.5)}, {22.0, std::exp(-0.5)}, {46.0, std::exp(-2.0)}, {200.0, 0.0}}) {
      now.time = time, now.theta += 0.1, now.load += 10.0, now.run += 1;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, none), sign * 0.01 * off, 1e-12) << time;
    }
  }
}

TEST(Unsuspected, a_sensor_has_its_own_beat) {
  // Beats at 0.063 s, 0.163 s, … .
  const Hidden hidden = with("sensor_on_its_own_beat", 0.1, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [time, speed, old] : {std::tuple{0.0, 2.0, 0.037},
                                         {0.05, 2.0, 0.087},
                                         {0.06, 0.5, 0.097},
                                         {0.07, 0.5, 0.007},
                                         {1.0, -0.5, 0.037},
                                         {1.07, -0.5, 0.007},
                                         {1.05, 0.0, 0.087}}) {
    now.time = time, now.theta_speed = speed, now.theta += 0.1;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, none), -speed * old, 1e-12) << time;
  }
}

TEST(Unsuspected, a_polynomial_swings_and_runs_away) {
  // 30 deg to either side of home.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("polynomial_of_too_high_degree", 0.004, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [x, swings] : {std::pair{0.0, 0.0},
                                    {1.0, 1.0},
                                    {-1.0, -1.0},
                                    {std::cos(0.1 * k_pi), 0.0},
                                    {std::cos(0.2 * k_pi), -1.0},
                                    {std::cos(0.3 * k_pi), 0.0},
                                    {std::cos(0.4 * k_pi), 1.0},
                                    {-std::cos(0.4 * k_pi), -1.0},
                                    {0.5, 0.5},
                                    {1.1, 16.0 * 1.61051 - 20.0 * 1.331 + 5.5},
                                    {5.0, 16.0 * 2.48832 - 20.0 * 1.728 + 6.0}}) {
      now.theta = radians(30.0) * x, now.load += 10.0;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, none), sign * 0.004 * swings, 1e-12) << x;
    }
  }
}

TEST(Unsuspected, popcorn_has_two_states) {
  // 5.5 s.
  const Hidden hidden = with("popcorn_in_amplifier", 0.008, soft());
  std::vector<double> memory;
  Moment now;
  for (int row = 0; row < 100; ++row) EXPECT_EQ(acted(hidden.reading.at(0), now, memory), 0.0) << "no time has gone";
  const auto jumps_in = [&](double seconds) {
    int jumps = 0, high = 0;
    double before = acted(hidden.reading[0], now, memory);
    for (int row = 0; row < 20000; ++row) {
      now.time += seconds, now.theta += 0.1;
      const double off = acted(hidden.reading[0], now, memory);
      EXPECT_TRUE(off == 0.0 || off == 0.008) << off;
      jumps += off != before ? 1 : 0, high += off != 0 ? 1 : 0;
      before = off;
    }
    EXPECT_NEAR(high / 20000.0, 0.5, 0.07) << "as long in one as in the other";
    return jumps / 20000.0;
  };
  EXPECT_NEAR(jumps_in(0.55), 0.5 * (1.0 - std::exp(-0.2)), 0.01);
  EXPECT_NEAR(jumps_in(1e4), 0.5, 0.02);
}

TEST(Unsuspected, a_grainy_rim_is_the_same_in_each_pass) {
  // Every 2 deg.
  const Hidden hidden = with("laser_on_grainy_rim", 0.003, soft());
  std::vector<double> none;
  Moment now;
  const auto shown = [&](double points) {
    now.theta = radians(2.0 * points), now.load += 1.0, now.time += 1.0, now.run += 1;
    return acted(hidden.reading.at(0), now, none);
  };
  EXPECT_EQ(shown(0.0), 0.0);
  double sum = 0, squares = 0;
  for (int point = -500; point < 500; ++point) {
    const double here = shown(point), next = shown(point + 1.0);
    EXPECT_EQ(shown(point), here) << "again";
    EXPECT_NEAR(shown(point + 0.25), here + 0.25 * (next - here), 1e-12) << point;
    sum += (next - here) / 0.003, squares += std::pow((next - here) / 0.003, 2);
  }
  EXPECT_NEAR(sum / 1000.0, 0.0, 0.02);
  EXPECT_NEAR(squares / 1000.0, 2.0, 0.3) << "each drawn by itself";
}

TEST(Unsuspected, a_busy_computer_is_late) {
  // 3 rad/s.
  const Hidden hidden = with("computer_busy_with_steps", 0.05, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [motor, joint, late] : {std::tuple{0.0, 0.4, 0.0},
                                           {1.0, 0.4, 0.2},
                                           {1.5, 0.4, 0.4},
                                           {-1.5, -0.4, -0.4},
                                           {2.0, 0.5, 1.0},
                                           {60.0, 0.5, 4.5},
                                           {1.5, 0.0, 0.0}}) {
    now.alpha_speed = motor, now.theta_speed = joint, now.theta += 0.1, now.time += 10.0;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, none), -0.05 * late, 1e-12) << motor;
  }
}

TEST(Unsuspected, a_hair_spring_has_run_down_beyond_a_place) {
  // From home on, or from −18 deg on.
  for (const auto& [share, place] : {std::pair{0.5, 0.0}, {0.0, radians(-18.0)}}) {
    for (const double sign : {1.0, -1.0}) {
      const Hidden hidden = with("hair_spring_run_down", 0.01, soft(), {sign, 1.0, share});
      std::vector<double> memory;
      Moment now;
      for (const auto& [beyond, off] : {std::pair{-0.1, 0.0},
                                        {-0.2, 0.0},
                                        {0.003, -0.003},
                                        {0.02, -0.005},
                                        {0.1, -0.005},
                                        {0.098, -0.003},
                                        {0.09, 0.005},
                                        {0.002, 0.005},
                                        {-0.001, 0.0},
                                        {0.3, -0.005}}) {
        now.theta = place + sign * beyond, now.load += 10.0;
        EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), sign * off, 1e-12) << beyond;
      }
    }
  }
}

TEST(Unsuspected, a_span_is_set_before_each_run) {
  const Hidden hidden = with("span_set_before_each_run", 0.005, soft());
  std::vector<double> none;
  double sum = 0, squares = 0;
  for (std::size_t run = 0; run < 1000; ++run) {
    Moment now;
    now.run = run;
    const auto shown = [&](double theta) {
      now.theta = theta, now.load += 10.0, now.time += 1.0;
      return acted(hidden.reading.at(0), now, none);
    };
    EXPECT_EQ(shown(0.0), 0.0);
    const double draw = shown(0.5) / (0.5 * 0.005);
    EXPECT_NEAR(shown(-0.2), -0.2 * 0.005 * draw, 1e-15);
    sum += draw, squares += draw * draw;
  }
  EXPECT_NEAR(sum / 1000.0, 0.0, 0.12);
  EXPECT_NEAR(squares / 1000.0, 1.0, 0.2);
}

TEST(Unsuspected, a_clock_hunts_to_both_sides) {
  // 50 s, 1 rad on at the begin.
  const Hidden hidden = with("clock_hunting_for_the_other", 0.04, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [periods, speed, late] : {std::tuple{0.0, 0.5, 0.5 * std::sin(1.0)},
                                             {0.25, 0.5, 0.5 * std::cos(1.0)},
                                             {0.5, 0.5, -0.5 * std::sin(1.0)},
                                             {0.75, -2.0, 2.0 * std::cos(1.0)},
                                             {3.0, 0.5, 0.5 * std::sin(1.0)},
                                             {0.25, 0.0, 0.0}}) {
    now.time = 50.0 * periods, now.theta_speed = speed, now.theta += 0.1, now.run += 1;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, none), -0.04 * late, 1e-12) << periods;
  }
}

TEST(Unsuspected, shorted_turns_are_lacking_ever_after) {
  std::vector<double> none;
  Moment now;
  const Hidden at_home = with("shorted_turns_in_potentiometer", 0.01, soft());
  for (const auto& [theta, off] :
       {std::pair{0.0, 0.0}, {-0.1, 0.0}, {0.004, -0.004}, {0.01, -0.01}, {0.011, -0.01}, {0.4, -0.01}}) {
    now.theta = theta, now.load += 10.0;
    EXPECT_NEAR(acted(at_home.reading.at(0), now, none), off, 1e-15) << theta;
  }
  // From −18 deg on: home is beyond them.
  const Hidden before = with("shorted_turns_in_potentiometer", 0.01, soft(), {1.0, 1.0, 0.0});
  for (const auto& [beyond, off] : {std::pair{-0.1, 0.01}, {0.004, 0.006}, {0.01, 0.0}, {0.4, 0.0}}) {
    now.theta = radians(-18.0) + beyond, now.load += 10.0;
    EXPECT_NEAR(acted(before.reading.at(0), now, none), off, 1e-12) << beyond;
  }
}

}  // namespace unsuspected
}  // namespace fusee::rig
