// The eleventh split that is kept aside: each fault is what it says, by hand.
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
namespace unimagined {

/// One tendon has it, by the sign of the character, and the other has not: what acts on that one.
const Action& only_action(const Hidden& hidden, double sign) {
  EXPECT_TRUE(hidden.longer[sign > 0 ? 0 : 1].empty());
  return hidden.longer[sign > 0 ? 1 : 0].at(0);
}

/// Mean and rms of these draws are those of a spread of 1.
void expect_spread(const std::vector<double>& draws) {
  double sum = 0, squares = 0;
  for (const double draw : draws) sum += draw, squares += draw * draw;
  const auto all = static_cast<double>(draws.size());
  EXPECT_NEAR(sum / all, 0.0, 0.1);
  EXPECT_NEAR(std::sqrt(squares / all), 1.0, 0.1);
}

// ---- motor and shaft ------------------------------------------------------------------------------------------------

TEST(Unimagined, a_universal_joint_makes_two_waves_a_turn) {
  const Hidden hidden = with("shaft_through_universal_joint", 0.01, stiff());
  // tan φ = cos β tan x, with tan² β/2 = 0.01, and 1 rad on at home.
  const double c = 0.99 / 1.01;
  const auto turned = [&](double x) { return std::atan(c * std::tan(x)) - x; };
  std::vector<double> none;
  Moment now;
  for (const double x : {1.0, 0.3, 0.0, -0.7, -1.5}) {
    now.alpha = x - 1.0, now.load += 10.0;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), turned(x) - turned(1.0), 1e-12) << x;
    now.alpha += k_pi;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, none), turned(x) - turned(1.0), 1e-12) << "half a turn on " << x;
  }
  const Log log = run_of(hidden, {0.0, k_slow, 1}, stiff());
  expect_shaft_off(log, [&](std::size_t row) {
    return -0.01 * (std::sin(2.0 * (log[row].alpha + 1.0)) - std::sin(2.0)) +
           0.00005 * (std::sin(4.0 * (log[row].alpha + 1.0)) - std::sin(4.0));
  });
}

TEST(Unimagined, a_long_shaft_twists_by_what_the_tendons_pull) {
  const Hidden hidden = with("long_shaft_twisting", 0.01, soft());
  const TransmissionPoint home = Transmission(soft().declared).at_alpha(0.0);
  for (const auto& [first, second] : {std::pair{20.0, 20.0}, {20.0, 60.0}, {60.0, 20.0}, {5.0, 50.0}}) {
    BothWays both(hidden);
    Moment now;
    now.tension = {20.0, 20.0};
    both(now);
    now.tension = {first, second};
    const auto [one, other] = both(now);
    const double twist = -0.01 * ((second - 20.0) * home.t2.p - (first - 20.0) * home.t1.p) / (20.0 * home.t2.p);
    EXPECT_NEAR(other, home.t2.p * twist, 1e-9);
    EXPECT_NEAR(one, -home.t1.p * twist, 1e-9);
  }
  // A load takes the joint with it, to its own side, and next to nothing does without.
  const auto off = [&](double load) {
    const RunPlan plan{load, k_slow, 1};
    return run_of(hidden, plan, soft())[40].theta - run_of({}, plan, soft())[40].theta;
  };
  EXPECT_LT(off(40.0), radians(-0.1));
  EXPECT_GT(off(-40.0), radians(0.1));
  EXPECT_LT(std::abs(off(0.0)), 0.3 * std::abs(off(40.0)));
}

TEST(Unimagined, a_clutch_creeps_by_the_clock_under_its_load) {
  const Hidden hidden = with("clutch_creeping_under_load", 1e-3, stiff());
  std::vector<double> memory;
  Moment now;
  for (const auto& [load, seconds, off] :
       {std::tuple{0.0, 100.0, 0.0}, {20.0, 5.0, -5.0}, {40.0, 5.0, -15.0}, {0.0, 60.0, -15.0}, {-20.0, 10.0, -5.0}}) {
    now.load = load, now.seconds = seconds;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), 1e-3 * off, 1e-15) << load;
  }
  expect_shaft_off(run_of(hidden, {0.0, k_slow, 1}, stiff()), [](std::size_t) { return 0.0; });
  const Log log = run_of(hidden, {20.0, k_slow, 1, 3.0}, stiff());
  double before = 0;  // what the load's coming on took
  const Transmission law(stiff().declared);
  while (std::abs(law.theta(log[0].alpha - before) - log[0].theta) > 1e-6 && before < 0.01) before += 1e-6;
  EXPECT_LT(before, 0.002);
  expect_shaft_off(log, [&](std::size_t row) { return -before - 1e-3 * (log[row].time - log[0].time); });
}

TEST(Unimagined, a_shaft_is_drawn_to_its_poles_where_it_stands) {
  // 36 of them.
  const Hidden hidden = with("shaft_drawn_to_poles_at_rest", 0.01, stiff());
  std::vector<double> memory;
  Moment now;
  for (const auto& [wave, speed, seconds, off] : {std::tuple{1.0, 0.2, 1.0, 0.0},
                                                  {0.5 * k_pi, 0.0, 0.2, 0.0},
                                                  {0.5 * k_pi, 0.0, 0.2, -1.0},
                                                  {0.5 * k_pi, 0.0, 9.0, -1.0},
                                                  {k_pi, 0.1, 9.0, 0.0},
                                                  {k_pi, 0.0, 9.0, 0.0},
                                                  {1.5 * k_pi, -0.1, 9.0, 0.0},
                                                  {1.5 * k_pi, 0.0, 0.31, 1.0}}) {
    now.alpha = (wave - 1.0) / 36.0, now.alpha_speed = speed, now.seconds = seconds, now.load += 10.0;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), 0.01 * off, 1e-12) << wave;
  }
  // Nothing where it never stands.
  expect_shaft_off(run_of(hidden, {20.0, k_slow, 1}, stiff()), [](std::size_t) { return 0.0; });
}

TEST(Unimagined, play_comes_and_goes_with_the_wheel) {
  // Four rounds to one of the shaft.
  const Hidden hidden = with("play_going_round_with_wheel", 0.02, stiff());
  std::vector<double> memory;
  Moment now;
  const double widest = -0.25, none = (k_pi - 1.0) / 4.0;
  for (const auto& [alpha, off] : {std::pair{none, 0.0},
                                   {widest, 0.01},
                                   {widest + 0.002, 0.008},
                                   {none, 0.0},
                                   {widest + 0.5 * k_pi, -0.01},
                                   {widest + 0.5 * k_pi - 0.005, -0.005},
                                   {none, 0.0}}) {
    now.alpha = alpha, now.load += 10.0;
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), off, 2e-6) << alpha;
  }
}

TEST(Unimagined, a_hand_cranks_to_each_mark_anew) {
  const Hidden hidden = with("cranked_to_marks_by_hand", 0.02, stiff());
  std::vector<double> memory, draws;
  Moment now;
  EXPECT_EQ(acted(hidden.shaft.at(0), now, memory), 0.0) << "home was set";
  for (int mark = 0; mark < 400; ++mark) {
    now.alpha = 0.01 * (mark % 7 + 1);
    const double off = acted(hidden.shaft[0], now, memory);
    now.load += 10.0, now.time += 3.0;
    EXPECT_EQ(acted(hidden.shaft[0], now, memory), off) << "while he is there";
    draws.push_back(off / 0.02);
  }
  expect_spread(draws);
}

// ---- pulley, tendons, frame -----------------------------------------------------------------------------------------

TEST(Unimagined, a_pulley_goes_oval_by_the_decade) {
  // 6.5 s.
  const Hidden hidden = with("pulley_going_oval", 0.1, soft());
  Moment now;
  for (const auto& [time, decades] : {std::pair{0.0, 0.0}, {58.5, 1.0}, {643.5, 2.0}}) {
    for (const double alpha : {0.0, 0.5, -1.0, k_pi}) {
      now.time = time, now.alpha = alpha, now.tension = {time, 3.0};
      const double longer = 0.1 * decades * (std::sin(2.0 * alpha + 1.0) - std::sin(1.0));
      expect_ways_apart(hidden, now, -longer, 1e-12);
    }
  }
}

TEST(Unimagined, a_cord_takes_up_damp_by_the_root_of_the_time) {
  // 225 s.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("cord_taking_up_damp", 0.4, soft(), {sign, 1.0, 0.5});
    const Action& action = only_action(hidden, sign);
    std::vector<double> none;
    Moment now;
    for (const auto& [time, share] : {std::pair{0.0, 0.0}, {2.25, 0.1}, {56.25, 0.5}, {225.0, 1.0}, {1e4, 1.0}}) {
      now.time = time, now.alpha += 0.1, now.load += 10.0;
      EXPECT_NEAR(acted(action, now, none), -0.4 * share, 1e-12) << time;
    }
  }
}

TEST(Unimagined, a_strut_bows_faster_than_in_proportion) {
  // It buckles at 120 N.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("strut_on_its_way_to_buckling", 0.5, soft(), {sign, 1.0, 0.5});
    BothWays both(hidden);
    Moment now;
    for (const auto& [first, second, more] : {std::tuple{20.0, 20.0, 0.5},
                                              {40.0, 20.0, 1.0},
                                              {20.0, 40.0, 1.0},
                                              {50.0, 40.0, 3.0},
                                              {200.0, 0.0, 4.0},
                                              {0.0, 0.0, 0.0}}) {
      now.tension = {first, second};
      const auto [one, other] = both(now);
      EXPECT_NEAR(one, sign * 0.5 * (more - 0.5), 1e-12) << first << " " << second;
      EXPECT_NEAR(other, -one, 1e-15);
    }
  }
  // To one side, whichever way the load pulls.
  const Hidden hidden = with("strut_on_its_way_to_buckling", 0.5, soft());
  for (const double load : {40.0, -40.0}) {
    const RunPlan plan{load, k_slow, 1};
    EXPECT_LT(run_of(hidden, plan, soft())[40].theta, run_of({}, plan, soft())[40].theta - radians(0.02)) << load;
  }
}

TEST(Unimagined, a_tendon_is_warmed_by_pull_and_haste) {
  // 25 s.
  const Hidden hidden = with("tendon_warmed_by_its_rubbing", 0.1, soft());
  const double some = 1.0 - std::exp(-1.0);
  for (const std::size_t side : {0u, 1u}) {
    std::vector<double> memory;
    Moment now;
    for (const auto& [tension, speed, seconds, warm] : {std::tuple{20.0, 0.0, 9.0, 0.0},
                                                        {90.0, 0.0, 1e4, 0.0},
                                                        {0.0, 3.0, 1e4, 0.0},
                                                        {20.0, 1.0, 25.0, some},
                                                        {20.0, -1.0, 1e4, 1.0},
                                                        {60.0, 2.0, 1e4, 6.0},
                                                        {60.0, 0.0, 25.0, 6.0 * std::exp(-1.0)}}) {
      now.tension[side] = tension, now.tension[1 - side] = 7.0, now.alpha_speed = speed, now.seconds = seconds;
      EXPECT_NEAR(acted(hidden.longer[side].at(0), now, memory), -0.1 * warm, 1e-12) << tension << " " << speed;
    }
  }
  // A load goes down further with every fast stroke, and less with slow ones.
  const auto lower = [&](double speed) {
    const RunPlan plan{40.0, speed, 3};
    const Log plain = run_of({}, plan, soft()), log = run_of(hidden, plan, soft());
    return (plain[360].theta - log[360].theta) - (plain[40].theta - log[40].theta);
  };
  EXPECT_GT(lower(k_fast), radians(0.02));
  EXPECT_LT(lower(k_slow), 0.5 * lower(k_fast));
}

TEST(Unimagined, a_shackle_swings_to_where_it_is_drawn) {
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("guide_on_swinging_shackle", 10.0, soft(), {sign, 1.0, 0.5});
    const Action& action = only_action(hidden, sign);
    const std::size_t side = sign > 0 ? 1 : 0;
    const double up = ways_to_pins(soft())[side];
    const Vec2 down = -up_to_pins(up, up)[side];
    // Ring to pulley and ring to link; where the link's part has turned by an angle, the resultant has by its half.
    const auto pulled = [&](double turned) {
      const double way = (side == 1 ? up : -up) + 0.4 + turned;
      return Vec2(std::sin(way), std::cos(way));
    };
    std::vector<double> memory;
    Moment now;
    now.pull[side] = pulled(0.0);
    EXPECT_NEAR(acted(action, now, memory), 0.0, 1e-12);
    for (const double turned : {0.2, -0.2, 0.4}) {
      now.pull[side] = pulled(turned), now.tension = {5.0 * turned, 30.0};
      const double resultant = (down - now.pull[side]).norm();
      EXPECT_NEAR(acted(action, now, memory), -10.0 * resultant * (1.0 - std::cos(0.5 * turned)), 1e-9) << turned;
    }
    now.pull[side] = pulled(0.0);
    EXPECT_NEAR(acted(action, now, memory), 0.0, 1e-12) << "back again";
  }
}

// ---- joint, load ----------------------------------------------------------------------------------------------------

TEST(Unimagined, grease_is_pressed_out_and_comes_back) {
  // 25 s.
  const Hidden hidden = with("grease_pressed_out_by_load", 500.0, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [load, seconds, dry] : {std::tuple{0.0, 1e4, 0.0},
                                           {20.0, 25.0, 1.0 - std::exp(-1.0)},
                                           {20.0, 1e4, 1.0},
                                           {-40.0, 1e4, 2.0},
                                           {0.0, 25.0, 2.0 * std::exp(-1.0)},
                                           {0.0, 1e4, 0.0}}) {
    now.load = load, now.seconds = seconds, now.theta += 0.1;
    EXPECT_NEAR(acted(hidden.dry.at(0), now, memory), 500.0 * dry, 1e-9) << load;
  }
}

TEST(Unimagined, a_wearer_notices_and_helps_along) {
  // 0.4 s.
  const Hidden hidden = with("wearer_helping_along", 500.0, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [direction, speed, helps] : {std::tuple{0.0, 0.0, 0.0},
                                                {1.0, 0.2, 0.0},
                                                {1.0, 0.2, 0.0},
                                                {1.0, 0.2, 1.0},
                                                {1.0, 0.0, 0.0},
                                                {-1.0, -0.2, 0.0},
                                                {-1.0, -0.2, 0.0},
                                                {-1.0, -0.2, -1.0},
                                                {-1.0, -1.5, -1.0}}) {
    now.direction = direction, now.alpha_speed = speed, now.seconds = 0.21, now.load += 10.0;
    EXPECT_EQ(acted(hidden.torque.at(0), now, memory), 500.0 * helps) << direction << " " << speed;
  }
  // The joint is ahead, on both ways.
  const Hidden more = with("wearer_helping_along", 2000.0, soft());
  const RunPlan plan{0.0, k_slow, 1};
  const Log plain = run_of({}, plan, soft()), log = run_of(more, plan, soft());
  EXPECT_GT(log[40].theta, plain[40].theta + radians(0.05));
  EXPECT_LT(log[120].theta, plain[120].theta - radians(0.05));
}

TEST(Unimagined, every_plate_has_its_own_error) {
  // 7 N each.
  const Hidden hidden = with("plates_none_like_another", 0.1, soft());
  std::vector<double> none;
  const auto more = [&](double load) {
    Moment now;
    now.load = load;
    return acted(hidden.load.at(0), now, none);
  };
  EXPECT_EQ(more(0.0), 0.0);
  std::set<double> errors;
  for (int plate = 0; plate < 30; ++plate) {
    const double error = more(7.0 * (plate + 1)) - more(7.0 * plate);
    EXPECT_LE(std::abs(error), 0.7);
    EXPECT_NEAR(more(7.0 * plate + 3.5) - more(7.0 * plate), 0.5 * error, 1e-9) << "half of it";
    EXPECT_NEAR(more(-7.0 * plate), -more(7.0 * plate), 1e-12) << "to the other side as well";
    errors.insert(error);
  }
  EXPECT_EQ(errors.size(), 30u);
  EXPECT_LT(*errors.begin(), -0.35);
  EXPECT_GT(*errors.rbegin(), 0.35);
}

TEST(Unimagined, a_weight_swings_from_being_hung_on) {
  // 4.5 rad/s, 13 s.
  const Hidden hidden = with("weight_swinging_when_hung_on", 0.2, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [run_time, load] : {std::pair{0.0, 20.0}, {2.0, 20.0}, {13.0, -40.0}, {1.0, 0.0}, {1e3, 20.0}}) {
    now.run_time = run_time, now.load = load, now.time += 50.0;
    const double swings = std::exp(-run_time / 13.0) * std::cos(4.5 * run_time);
    EXPECT_NEAR(acted(hidden.load.at(0), now, none), 0.2 * load * swings, 1e-12) << run_time;
  }
}

TEST(Unimagined, a_cord_loses_its_lever_beyond_a_corner) {
  // At home, and 30 deg to either side.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("cord_over_corner_of_link", 0.2, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [degree, load, less] : {std::tuple{30.0, 20.0, 4.0},
                                             {15.0, 20.0, 2.0},
                                             {15.0, -40.0, -4.0},
                                             {15.0, 0.0, 0.0},
                                             {0.0, 20.0, 0.0},
                                             {-15.0, 20.0, 0.0}}) {
      now.theta = sign * radians(degree), now.load = load;
      EXPECT_NEAR(acted(hidden.load.at(0), now, none), -less, 1e-12) << degree << " " << load;
    }
  }
}

TEST(Unimagined, a_hand_goes_under_the_weight_where_the_motor_stands) {
  // 0.65 s.
  const Hidden hidden = with("hand_under_weight_at_rests", 0.3, soft());
  std::vector<double> memory;
  Moment now;
  for (const auto& [load, speed, seconds, less] : {std::tuple{20.0, 0.2, 5.0, 0.0},
                                                   {20.0, 0.0, 0.5, 0.0},
                                                   {20.0, 0.0, 0.5, 6.0},
                                                   {-40.0, 0.0, 0.5, -12.0},
                                                   {0.0, 0.0, 5.0, 0.0},
                                                   {20.0, -0.2, 5.0, 0.0},
                                                   {20.0, 0.0, 0.5, 0.0}}) {
    now.load = load, now.alpha_speed = speed, now.seconds = seconds;
    EXPECT_NEAR(acted(hidden.load.at(0), now, memory), -less, 1e-12) << load << " " << speed;
  }
}

// ---- sensor, log ----------------------------------------------------------------------------------------------------

TEST(Unimagined, the_heaviest_bit_steps_at_half_the_scale) {
  // At home, and at −18 deg of 30; a scale of 120.
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> none;
    Moment now;
    const Hidden middle = with("heaviest_bit_misweighed", 0.01, soft(), {sign, 1.0, 0.5});
    const Hidden aside = with("heaviest_bit_misweighed", 0.01, soft(), {sign, 1.0, 0.0});
    for (const auto& [degree, of_middle, of_aside] : {std::tuple{0.0, 0.0, 0.0},
                                                      {0.001, 1.0, 0.0},
                                                      {30.0, 0.75, -0.25},
                                                      {-17.999, 0.15, 0.15},
                                                      {-18.001, 0.15, -0.85},
                                                      {-30.0, 0.25, -0.75}}) {
      now.theta = radians(degree), now.load += 10.0;
      EXPECT_NEAR(acted(middle.reading.at(0), now, none), sign * 0.01 * of_middle, 1e-6) << degree;
      EXPECT_NEAR(acted(aside.reading.at(0), now, none), sign * 0.01 * of_aside, 1e-6) << degree;
    }
  }
}

TEST(Unimagined, a_rest_is_cut_off_towards_nought) {
  const Hidden hidden = with("rest_cut_off_towards_nought", 0.01, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [theta, shown] :
       {std::pair{0.0, 0.0}, {0.009, 0.0}, {-0.009, 0.0}, {0.011, 0.01}, {0.0299, 0.02}, {-0.0299, -0.02}}) {
    now.theta = theta;
    EXPECT_NEAR(theta + acted(hidden.reading.at(0), now, none), shown, 1e-15) << theta;
  }
}

TEST(Unimagined, a_sector_is_told_too_late_on_the_way_up) {
  // Borders at home and every 0.04 rad, 15 % behind them.
  const Hidden hidden = with("fine_track_in_wrong_sector", 0.04, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [theta, speed, sectors] : {std::tuple{0.001, 0.2, 1.0},
                                              {0.0059, 0.2, 1.0},
                                              {0.0061, 0.2, 0.0},
                                              {0.001, -0.2, 0.0},
                                              {0.001, 0.0, 0.0},
                                              {-0.001, 0.2, 0.0},
                                              {-0.039, 0.2, 1.0},
                                              {0.205, 0.2, 1.0},
                                              {0.215, 0.2, 0.0}}) {
    now.theta = theta, now.theta_speed = speed;
    EXPECT_EQ(acted(hidden.reading.at(0), now, none), -0.04 * sectors) << theta << " " << speed;
  }
}

TEST(Unimagined, a_protractor_is_read_in_round_numbers) {
  for (const auto& [share, apart] : {std::pair{0.5, 5.0}, {0.9, 10.0}}) {
    const Hidden hidden = with("protractor_read_in_round_numbers", 0.01, soft(), {1.0, 1.0, share});
    std::vector<double> none;
    Moment now;
    for (const auto& [marks, drawn] :
         {std::pair{0.0, 0.0}, {0.25, -0.5}, {0.49, -0.98}, {0.51, 0.98}, {2.75, 0.5}, {-0.25, 0.5}, {-3.0, 0.0}}) {
      now.theta = radians(apart * marks), now.load += 10.0;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, none), 0.01 * drawn, 1e-12) << marks;
    }
  }
}

TEST(Unimagined, a_sensor_is_cold_at_every_start) {
  // 22.5 s.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("sensor_cold_at_every_start", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [run_time, cold] : {std::pair{0.0, 1.0}, {22.5, std::exp(-1.0)}, {1e4, 0.0}, {0.0, 1.0}}) {
      now.run_time = run_time, now.time += run_time, now.theta += 0.1;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, none), sign * 0.01 * cold, 1e-12) << run_time;
    }
  }
}

TEST(Unimagined, a_thermometer_on_the_motor_follows_its_work) {
  // 35 s.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("thermometer_glued_to_motor", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> memory;
    Moment now;
    for (const auto& [since, speed, warm] : {std::tuple{0.0, 1.0, 0.0},
                                             {35.0, 1.0, 1.0 - std::exp(-1.0)},
                                             {1e4, -1.0, 1.0},
                                             {1e4, 0.5, 0.25},
                                             {35.0, 0.0, 0.25 * std::exp(-1.0)}}) {
      now.time += since, now.alpha_speed = speed, now.theta += 0.1;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, memory), sign * 0.01 * warm, 1e-12) << speed;
    }
  }
}

TEST(Unimagined, a_lost_difference_is_missing_until_the_angle_comes) {
  // Every 7.5 s.
  const Hidden hidden = with("difference_lost_on_bus", 0.1, soft());
  std::vector<double> memory;
  std::set<double> when;
  Moment now;
  for (int interval = 0; interval < 40; ++interval) {
    bool lost = false;
    for (int step = 0; step < 75; ++step) {
      now.time = 7.5 * interval + 0.1 * step + 0.05, now.theta_speed = 0.01 * (step + 1);
      const double off = acted(hidden.reading.at(0), now, memory);
      if (!lost && off != 0) {
        lost = true;
        EXPECT_NEAR(off, -0.1 * now.theta_speed, 1e-15) << interval;
        when.insert(step + 0.01 * interval);
      }
      EXPECT_EQ(off != 0, lost) << "until the interval is over";
    }
  }
  EXPECT_GE(when.size(), 36u);
  EXPECT_LT(*when.begin(), 15.0);
  EXPECT_GT(*when.rbegin(), 60.0);
}

TEST(Unimagined, air_shimmers_over_a_warm_motor) {
  // 35 s.
  const Hidden hidden = with("air_shimmering_over_motor", 0.02, soft());
  std::vector<double> memory, draws;
  Moment now;
  for (int row = 0; row < 20; ++row, now.time += 10.0)
    EXPECT_EQ(acted(hidden.reading.at(0), now, memory), 0.0) << "it has not moved";
  now.alpha_speed = 2.0, now.time += 1e4;
  for (int row = 0; row < 400; ++row, now.time += 0.2)
    draws.push_back(acted(hidden.reading[0], now, memory) / (0.02 * 4.0));
  expect_spread(draws);
}

TEST(Unimagined, a_sine_is_read_before_its_cosine) {
  // Ten of them a turn.
  const Hidden hidden = with("sine_read_before_cosine", 0.1, soft());
  std::vector<double> none;
  Moment now;
  for (const auto& [wave, speed, late] : {std::tuple{0.0, 0.5, 0.5},
                                          {0.5 * k_pi, 0.5, 0.0},
                                          {0.25 * k_pi, 0.5, 0.25},
                                          {k_pi, -0.5, -0.5},
                                          {0.3, 0.0, 0.0}}) {
    now.theta = (wave - 1.0) / 10.0, now.theta_speed = speed;
    EXPECT_NEAR(acted(hidden.reading.at(0), now, none), -0.1 * late, 1e-12) << wave;
  }
}

TEST(Unimagined, an_inclinometer_on_a_sloping_axle_shows_less) {
  // At home, and at −18 deg.
  for (const auto& [share, upright] : {std::pair{0.5, 0.0}, {0.0, radians(-18.0)}}) {
    const Hidden hidden = with("inclinometer_on_sloping_axle", 0.02, soft(), {1.0, 1.0, share});
    const auto shown = [at = upright](double theta) { return std::asin(0.98 * std::sin(theta - at)); };
    std::vector<double> none;
    Moment now;
    for (const double theta : {0.0, 0.3, -0.3, 0.52, -0.52}) {
      now.theta = theta, now.load += 10.0;
      EXPECT_NEAR(acted(hidden.reading.at(0), now, none), shown(theta) - shown(0.0) - theta, 1e-12) << theta;
    }
  }
}

TEST(Unimagined, a_knock_at_the_sensor_stays) {
  // 25 s.
  for (const double sign : {1.0, -1.0}) {
    const Hidden hidden = with("sensor_knocked_in_passing", 0.01, soft(), {sign, 1.0, 0.5});
    std::vector<double> none;
    Moment now;
    for (const auto& [time, off] : {std::pair{0.0, 0.0}, {24.9, 0.0}, {25.1, 1.0}, {500.0, 1.0}}) {
      now.time = time, now.run += 1, now.theta += 0.1;
      EXPECT_EQ(acted(hidden.reading.at(0), now, none), sign * 0.01 * off) << time;
    }
  }
}

TEST(Unimagined, a_sensor_learns_its_range) {
  const Hidden hidden = with("sensor_learning_its_range", 0.5, soft());
  std::vector<double> memory;
  Moment now;
  // It takes −15 … 15 deg for −30 … 30, then −15 … 20, −20 … 20, and all.
  for (const auto& [degree, stretched] : {std::pair{0.0, 0.0},
                                          {7.5, 15.0},
                                          {20.0, 30.0},
                                          {2.5, 0.0},
                                          {-20.0, -30.0},
                                          {10.0, 15.0},
                                          {30.0, 30.0},
                                          {-30.0, -30.0},
                                          {10.0, 10.0}}) {
    now.theta = radians(degree), now.load += 10.0;
    EXPECT_NEAR(degrees(acted(hidden.reading.at(0), now, memory)), 0.5 * (stretched - degree), 1e-9) << degree;
  }
}

}  // namespace unimagined
}  // namespace fusee::rig
