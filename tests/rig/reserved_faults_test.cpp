// The fourth split that is kept aside: each fault is what it says, by hand.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "fusee/transmission/transmission.h"
#include "rig/fault_checks.h"

namespace fusee::rig {
namespace reserved {

// ---- motor and shaft, by hand: a stiff joint stands where the law says ----------------------------------------------

TEST(Reserved, a_driver_that_makes_up_for_no_play_is_ahead_on_both_ways) {
  const Transmission law(stiff().declared);
  const Hidden hidden = with("overdone_compensation", 0.02, stiff());
  for (const double speed : {k_slow, k_fast}) {
    const Log log = run_of(hidden, {0.0, speed, 1}, stiff());
    // Fed in within 1.15 deg, and rows are further apart.
    for (std::size_t row = 1; row < log.size(); ++row)
      EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + (row <= 80 ? 0.01 : -0.01)), 5e-6) << row;
  }
  std::vector<double> memory;
  Moment now;
  for (const auto& [to, ahead] : {std::pair{0.0, 0.0}, {20.0, 0.01}, {19.425, 0.0}, {10.0, -0.01}, {10.2875, -0.005}}) {
    now.alpha = radians(to);
    EXPECT_NEAR(acted(hidden.shaft.at(0), now, memory), ahead, 1e-9) << to;
  }
}

TEST(Reserved, a_worm_stutters_as_it_lowers) {
  const Transmission law(stiff().declared);
  const std::vector<RunPlan> plans = {{10.0, k_slow, 1}, {-20.0, k_fast, 1}, {0.0, k_slow, 1}};
  const std::vector<Log> logs = log_runs(stiff(), with("stuttering_worm", 0.05, stiff()), plans, silent());
  // 10 N of 20 N: half of 0.05 on the way down; −20 N: all of it on the way up.
  for (std::size_t run = 0; run < plans.size(); ++run) {
    double most = 0;
    for (std::size_t row = 1; row < logs[run].size(); ++row) {
      const double alpha = logs[run][row].alpha;
      double turned = 0;
      if (run == 0 && row > 80) turned = std::fmod(logs[run][80].alpha - alpha, 0.025);
      if (run == 1 && row <= 80) turned = -std::fmod(alpha - logs[run][0].alpha, 0.05);
      EXPECT_NEAR(logs[run][row].theta, law.theta(alpha + turned), 2e-4) << run << " " << row;
      most = std::max(most, std::abs(turned));
    }
    EXPECT_EQ(most > 0.02, run < 2) << run;
  }
}

TEST(Reserved, a_stepper_loses_steps_once_on_every_hard_stroke) {
  const Transmission law(stiff().declared);
  // 20 N of 20 N at 90 deg/s ask 1.57, 19 N at 12 deg/s 0.199, 21 N 0.220; 0.2 are there.
  const std::vector<RunPlan> plans = {
      {20.0, k_fast, 2}, {-20.0, k_fast, 1}, {19.0, k_slow, 1}, {0.0, k_fast, 1}, {21.0, k_slow, 1}};
  const std::vector<Log> logs = log_runs(stiff(), with("lost_steps", 0.02, stiff()), plans, silent());
  const auto lost = [](std::size_t run, std::size_t row) {
    if (run == 0) return row <= 160 ? 1.0 : 2.0;
    return (run == 1 && row <= 80) || run == 4 ? 2.0 : 1.0;
  };
  for (std::size_t run = 0; run < plans.size(); ++run) {
    for (std::size_t row = 1; row < logs[run].size(); ++row) {
      const double alpha = logs[run][row].alpha - 0.02 * lost(run, row);
      EXPECT_NEAR(logs[run][row].theta, law.theta(alpha), 3e-4) << run << " " << row;
    }
  }
}

TEST(Reserved, a_shaft_lies_in_its_bushing_where_the_tendons_pull_it) {
  const Hidden hidden = with("worn_shaft_bushing", 0.2, soft());
  BothWays ways(hidden);
  Moment now;
  // Pins 50 mm to either side and 80 mm above: cos φ = 0.847998, cos 2φ = 0.438202.
  const auto longer = [&](double first, double second) {
    now.tension = {first, second};
    return ways(now);
  };
  EXPECT_NEAR(longer(20.0, 20.0)[1], 0.0, 1e-12);
  for (const double pull : {5.0, 40.0}) {
    EXPECT_NEAR(longer(0.0, pull)[1], -0.2 * (1.0 - 0.847998), 1e-6) << "towards the pin, whatever the pull";
    EXPECT_NEAR(longer(0.0, pull)[0], 0.2 * (0.847998 - 0.438202), 1e-6);
    EXPECT_NEAR(longer(pull, 0.0)[1], 0.2 * (0.847998 - 0.438202), 1e-6);
  }
  EXPECT_NEAR(longer(10.0, 10.0)[0], 0.0, 1e-12);
}

// ---- groove, tendon, pins -------------------------------------------------------------------------------------------

TEST(Reserved, a_wire_cuts_its_groove_by_pull_and_way_and_loses_what_is_wound) {
  const Hidden hidden = with("groove_cut_by_wire", 0.01, soft());
  std::array<std::vector<double>, 2> memories;
  Moment now;
  double longer = 0;
  const auto to = [&](std::size_t side, double alpha, double tension) {
    now.alpha = alpha, now.tension[side] = tension;
    longer = acted(hidden.longer[side].at(0), now, memories[side]);
  };
  for (const double alpha : {0.0, 1.0, -0.5, 0.5}) to(1, alpha, 40.0);
  EXPECT_NEAR(longer, -0.01 * 2.0 * 3.5 * (0.5 - soft().alpha_min), 1e-12) << "40 N of 20 N over 3.5 rad";
  to(1, 0.5, 0.0);
  for (const double alpha : {1.0, -1.0, 0.5}) to(1, alpha, 0.0);
  EXPECT_NEAR(longer, -0.01 * 2.0 * 3.5 * (0.5 - soft().alpha_min), 1e-12) << "nothing pulls";
  to(1, soft().alpha_min, 0.0);
  EXPECT_NEAR(longer, 0.0, 1e-12) << "nothing is wound";
  for (const double alpha : {0.0, -1.0}) to(0, alpha, 20.0);
  EXPECT_NEAR(longer, -0.01 * (soft().alpha_max + 1.0), 1e-12);
}

TEST(Reserved, a_chip_lifts_the_tendon_until_it_falls_out) {
  const Hidden hidden = with("chip_that_falls_out", 0.3, soft());
  const double at = alpha_within(k_middle, soft());
  std::vector<double> memory;
  Moment now;
  const auto longer = [&](double beside) {
    now.alpha = at + beside;
    return acted(hidden.longer[1].at(0), now, memory);
  };
  longer(-0.5);
  for (int passage = 0; passage < 2; ++passage) {
    EXPECT_NEAR(longer(1e-9), 0.3, 1e-9) << passage;
    EXPECT_NEAR(longer(radians(6.0)), 0.181959, 1e-6) << passage;
    EXPECT_LT(longer(0.5), 1e-4);
    EXPECT_LT(longer(-0.5), 1e-4);
  }
  EXPECT_EQ(longer(1e-9), 0.0);
}

TEST(Reserved, a_turn_hops_up_and_falls_off_further_back) {
  const Hidden hidden = with("turn_hopping_up", 0.3, soft());
  const double hops = 0.4 * soft().alpha_max, falls = hops - radians(5.0 + 25.0 / k_two_pi);
  const Log plain = run_of({}, {0.0, k_slow, 1}, soft()), log = run_of(hidden, {0.0, k_slow, 1}, soft());
  for (std::size_t row = 1; row < log.size(); ++row) {
    const double alpha = log[row].alpha, more = degrees(log[row].theta - plain[row].theta);
    const bool up = row <= 80 ? alpha > hops : alpha > falls;
    // Its memory in groove and pins is not all gone when it has fallen off.
    if (up) {
      EXPECT_GT(more, 0.1) << row;
    } else {
      EXPECT_LT(std::abs(more), row <= 80 ? 1e-9 : 0.05) << row;
    }
  }
  std::vector<double> memory;
  Moment now;
  for (const auto& [alpha, longer] : {std::pair{hops - 0.01, 0.0},
                                      {hops + 0.01, 0.3},
                                      {falls + 0.01, 0.3},
                                      {falls - 0.01, 0.0},
                                      {hops - 0.01, 0.0}}) {
    now.alpha = alpha;
    EXPECT_EQ(acted(hidden.longer[1].at(0), now, memory), longer) << alpha;
  }
}

TEST(Reserved, a_ratchet_takes_in_a_tooth_whenever_its_tendon_went_slack) {
  const Hidden hidden = with("ratcheting_tensioner", 0.1, soft());
  std::vector<double> memory;
  Moment now;
  // It takes in below 4 N, and again after 8 N.
  const auto longer = [&](double tension) {
    now.tension[0] = tension;
    acted(hidden.longer[0].at(0), now, memory);
    return acted(hidden.longer[0][0], now, memory);
  };
  for (const auto& [tension, teeth] :
       {std::pair{20.0, 0.0}, {5.0, 0.0}, {3.0, 1.0}, {0.0, 1.0}, {7.0, 1.0}, {1.0, 1.0}, {9.0, 1.0}, {1.0, 2.0}}) {
    EXPECT_NEAR(longer(tension), 0.1 * teeth, 1e-12) << tension;
  }
  for (int i = 0; i < 20; ++i) longer(i % 2 == 0 ? 20.0 : 0.0);
  EXPECT_NEAR(longer(20.0), 0.8, 1e-12) << "eight at most";
  EXPECT_TRUE(hidden.longer[1].empty());
}

TEST(Reserved, a_sleeve_rubs_once_in_each_of_its_turns) {
  const Hidden hidden = with("gritty_sleeve", 200.0, soft());
  std::vector<double> none;
  Moment now;
  // 24 of its radians to one of the joint, 1 rad on at home.
  for (const auto& [turned, pull, dry] : {std::tuple{0.0, 20.0, 200.0},
                                          {0.5 * k_pi, 20.0, 50.0},
                                          {k_pi, 20.0, 0.0},
                                          {k_two_pi, 50.0, 500.0},
                                          {0.0, 0.0, 0.0}}) {
    now.theta = (turned - 1.0) / 24.0, now.tension = {70.0, pull};
    EXPECT_NEAR(acted(hidden.dry.at(0), now, none), dry, 1e-9) << turned;
  }
}

TEST(Reserved, somebody_leans_on_the_bench_for_a_while) {
  const Hidden hidden = with("leaning_on_bench", 0.2, soft(), {1.0, 1.0, 0.8});
  Moment now;
  for (const auto& [run, second, share] : {std::tuple{1, 4.9, 0.0},
                                           {1, 5.25, 0.5},
                                           {1, 5.5, 1.0},
                                           {1, 17.0, 1.0},
                                           {1, 17.25, 0.5},
                                           {1, 17.6, 0.0},
                                           {0, 10.0, 0.0},
                                           {2, 10.0, 0.0}}) {
    now.run = static_cast<std::size_t>(run), now.run_time = second;
    SCOPED_TRACE(::testing::Message() << run << " " << second);
    expect_ways_apart(hidden, now, 0.2 * share, 1e-12);
  }
}

// ---- joint and load -------------------------------------------------------------------------------------------------

TEST(Reserved, a_magnet_draws_the_link_to_its_place_on_both_ways) {
  const Character character{1.0, 1.0, 0.7};
  const Hidden hidden = with("magnetic_catch", 500.0, soft(), character);
  const double at = theta_within(character, soft()), most_at = radians(1.5 + 4.5 / k_two_pi);
  std::vector<double> none;
  Moment now;
  for (const auto& [off, torque] :
       {std::pair{0.0, 0.0}, {1.0, -500.0}, {-1.0, 500.0}, {2.0, -223.130}, {-4.0, 1.10617}}) {
    now.theta = at + off * most_at;
    EXPECT_NEAR(acted(hidden.torque.at(0), now, none), torque, 1e-3) << off;
  }
  const Log plain = run_of({}, {0.0, k_slow, 1}, soft()), log = run_of(hidden, {0.0, k_slow, 1}, soft());
  for (std::size_t row = 1; row < log.size(); ++row) {
    const double off = (plain[row].theta - at) / most_at, more = degrees(log[row].theta - plain[row].theta);
    if (std::abs(off) < 0.5 || std::abs(off) > 1.5) continue;
    EXPECT_GT(off < 0 ? more : -more, 0.01) << row;
  }
}

TEST(Reserved, a_seal_sets_at_rest_and_is_torn_off_by_way) {
  const Hidden hidden = with("seal_that_sets", 1000.0, soft());
  std::vector<double> memory;
  Moment now;
  const auto dry = [&](double seconds, double way) {
    now.seconds = seconds, now.theta += way;
    return acted(hidden.dry.at(0), now, memory);
  };
  const double torn = radians(1.0 + 4.0 / k_two_pi);
  EXPECT_NEAR(dry(1e-9, 0.0), 0.0, 1e-3);
  for (int i = 0; i < 9; ++i) dry(0.925, 0.0);
  EXPECT_NEAR(dry(0.925, 0.0), 632.121, 1e-3) << "9.25 s in all";
  EXPECT_NEAR(dry(1e-9, -torn), 232.544, 1e-3);
  EXPECT_NEAR(dry(1e-9, 2.0 * torn), 31.4714, 1e-3);
  EXPECT_NEAR(dry(1000.0, 0.0), 1000.0, 1e-3);
}

TEST(Reserved, a_weight_on_rubber_bounces_after_a_change_of_speed) {
  for (const auto& [load, speed] : {std::pair{20.0, 1.5}, {20.0, -1.5}, {-10.0, -1.5}, {0.0, 1.5}}) {
    const Hidden hidden = with("bouncing_weight", 0.003, soft());
    std::vector<double> memory;
    Moment now;
    now.load = load;
    const auto more = [&](double seconds) {
      now.seconds = seconds;
      return acted(hidden.load.at(0), now, memory);
    };
    EXPECT_EQ(more(1.0), 0.0);
    now.alpha_speed = speed;
    EXPECT_EQ(more(1e-3), 0.0);
    // 2 Hz, and dying away within 2 s: e^(−1/16) is left of a sine after a quarter.
    const double lifted = load > 0 ? speed : -speed;
    const double peak = load * 0.003 * 2.0 * k_two_pi * lifted * 0.939413;
    EXPECT_NEAR(more(0.125), peak, 1e-5) << load << " " << speed;
    EXPECT_NEAR(more(0.125), 0.0, 1e-9);
    EXPECT_NEAR(more(0.125), -peak * 0.939413 * 0.939413, 1e-5);
  }
  const Hidden wild = with("bouncing_weight", 1.0, soft());
  std::vector<double> memory;
  Moment now;
  now.load = 20.0, now.seconds = 0.05;
  double least = 0, most = 0;
  for (int i = 0; i < 20; ++i) {
    now.alpha_speed = i < 2 ? 0.0 : 1.0;
    const double more = acted(wild.load.at(0), now, memory);
    least = std::min(least, more), most = std::max(most, more);
  }
  EXPECT_EQ(least, -20.0) << "a cord does not push";
  EXPECT_GT(most, 20.0);
}

/// As if the last row's pull had been there all the time.
TEST(Reserved, a_cell_pulls_more_by_its_warmth_and_not_by_its_load) {
  const MadeJoint joint = forearm_with(8000, 0.0);
  const Hidden hidden = with("drifting_cell_zero", 3.0, joint);
  for (const double load : {0.0, 10.0}) {
    const Log plain = run_of({}, {load, k_slow, 1}, joint), log = run_of(hidden, {load, k_slow, 1}, joint);
    const double pull = 3.0 * (log.back().temperature - log.front().temperature);
    EXPECT_LT(pull, -3.0);
    EXPECT_NEAR(log[1].theta, plain[1].theta, 5e-4);
    EXPECT_NEAR(log.back().theta, run_of({}, {load + pull, k_slow, 1}, joint).back().theta, 4e-4) << load;
    EXPECT_GT(log.back().theta - plain.back().theta, 3e-3);
  }
}

// ---- sensor and log -------------------------------------------------------------------------------------------------

TEST(Reserved, a_potentiometer_under_load_bends) {
  const Hidden hidden = with("loaded_potentiometer", 0.2, soft());
  std::vector<double> none;
  Moment now;
  // Half of 270 deg at home: 0.5 shows 0.5 / 1.05, 0.6 shows 0.6 / 1.048, 0.4 shows 0.4 / 1.048.
  for (const auto& [angle, off] : {std::pair{0.0, 0.0}, {27.0, -0.99128}, {-27.0, 1.48201}}) {
    now.theta = radians(angle);
    EXPECT_NEAR(degrees(acted(hidden.reading.at(0), now, none)), off, 1e-4) << angle;
  }
}

TEST(Reserved, an_amplifier_shows_less_near_its_rail) {
  for (const double sign : {1.0, -1.0}) {
    const Character character{sign, 1.0, 0.5};
    const std::vector<RunPlan> plans = {{0.0, k_slow, 1}, {20.0, k_fast, 1}};
    const std::vector<Log> plain = log_runs(soft(), {}, plans, silent());
    const std::vector<Log> logs =
        log_runs(soft(), with("amplifier_near_its_rail", 0.4, soft(), character), plans, silent());
    const double rail = 0.575 * end_of_range(character, soft());
    double most = 0;
    for (std::size_t run = 0; run < plans.size(); ++run) {
      for (std::size_t row = 1; row < logs[run].size(); ++row) {
        const double beyond = std::max(0.0, sign * (plain[run][row].theta - rail));
        EXPECT_NEAR(logs[run][row].theta, plain[run][row].theta - sign * 0.4 * beyond, 1e-12) << run << " " << row;
        most = std::max(most, beyond);
      }
    }
    EXPECT_GT(most, radians(5.0));
  }
}

TEST(Reserved, an_inclinometer_sways_with_what_speeds_up) {
  const Hidden hidden = with("swayed_inclinometer", 0.01, soft());
  std::vector<double> memory;
  Moment now;
  double off = 0;
  const auto go = [&](double seconds, double from, double to) {
    for (int i = 1; i <= 1000; ++i) {
      now.time += 1e-3 * seconds, now.theta_speed = from + (to - from) * i / 1000.0;
      off = acted(hidden.reading.at(0), now, memory);
    }
  };
  go(10.0, 0.5, 0.5);
  EXPECT_NEAR(off, 0.0, 1e-9) << "however fast";
  go(1e-3, 0.5, 1.5);
  EXPECT_NEAR(off, -0.01 / 0.3, 1e-4) << "a blow";
  go(0.3, 1.5, 1.5);
  EXPECT_NEAR(off, -0.01 / 0.3 * 0.367879, 1e-4);
  go(10.0, 1.5, -18.5);
  EXPECT_NEAR(off, 0.01 * 2.0, 1e-9) << "2 rad/s² less";
}

TEST(Reserved, a_sensor_that_balances_itself_leaks_where_it_stands) {
  const Hidden hidden = with("leaking_sensor", 0.005, soft());
  std::vector<double> memory;
  Moment now;
  now.theta = 0.5;
  const auto off_after = [&](double seconds) {
    now.run_time += seconds;
    return acted(hidden.reading.at(0), now, memory);
  };
  EXPECT_EQ(off_after(0.0), 0.0);
  for (int i = 0; i < 9; ++i) off_after(10.0);
  const double leaked = off_after(10.0);
  EXPECT_NEAR(leaked, -0.5 * (1.0 - 0.606531), 1e-6) << "100 s of 200 s";
  now.theta = 0.0;
  EXPECT_NEAR(off_after(1e-6), leaked, 1e-6) << "ahead on the way back";
  now.run = 1, now.run_time = 0.0;
  EXPECT_EQ(off_after(0.0), 0.0) << "set to the truth";
}

TEST(Reserved, a_track_crackles_where_it_is_rough) {
  const Character character{1.0, 1.0, 0.3};
  const Hidden hidden = with("crackling_track", 0.02, soft(), character);
  const double at = theta_within(character, soft()), wide = radians(2.0 + 4.0 / k_two_pi);
  std::vector<double> memory;
  Moment now;
  for (const auto& [beside, rms] : {std::pair{0.0, 0.02}, {-1.0, 0.0121306}, {6.0, 0.0}}) {
    double squares = 0, sum = 0;
    const int rows = 4000;
    now.theta = at + beside * wide;
    for (int row = 0; row < rows; ++row) {
      const double off = acted(hidden.reading.at(0), now, memory);
      squares += off * off, sum += off;
    }
    EXPECT_NEAR(std::sqrt(squares / rows), rms, 0.05 * rms + 1e-9) << beside;
    EXPECT_NEAR(sum / rows, 0.0, 0.06 * rms + 1e-9) << beside;
  }
}

TEST(Reserved, a_bus_that_hangs_repeats_the_last_angle) {
  const std::vector<RunPlan> plans = {{0.0, k_slow, 1}, {10.0, k_fast, 2}};
  const std::vector<Log> plain = log_runs(soft(), {}, plans, silent());
  const std::vector<Log> logs = log_runs(soft(), with("hanging_bus", 0.5, soft()), plans, silent());
  int repeated = 0;
  for (std::size_t run = 0; run < plans.size(); ++run) {
    double last = plain[run][0].theta;
    for (std::size_t row = 1; row < logs[run].size(); ++row) {
      const double since = logs[run][row].time - (2.0 + 1.0 / 3.0);
      const bool hangs = since > 0 && since - 8.0 * std::floor(since / 8.0) < 0.5;
      if (!hangs) last = plain[run][row].theta;
      EXPECT_NEAR(logs[run][row].theta, last, 1e-12) << run << " " << row;
      repeated += hangs && std::abs(plain[run][row].theta - last) > radians(0.1) ? 1 : 0;
    }
  }
  EXPECT_GE(repeated, 10);
}

}  // namespace reserved
}  // namespace fusee::rig
