// The third split that is kept aside: each fault is what it says, by hand.
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "fusee/transmission/transmission.h"
#include "rig/fault_checks.h"

namespace fusee::rig {
namespace withheld {

// ---- motor and shaft, by hand: a stiff joint stands where the law says ----------------------------------------------

TEST(Withheld, a_belt_creeps_before_the_load_whichever_way_it_runs) {
  const Transmission law(stiff().declared);
  const std::vector<RunPlan> plans = {{20.0, k_slow, 1}, {-20.0, k_slow, 1}};
  const std::vector<Log> logs = log_runs(stiff(), with("creeping_belt", 0.01, stiff()), plans, silent());
  // 20 N of 20 N: a hundredth of the way, there and back; −20 N undo it. In between it is not loaded.
  double way = 0;
  for (std::size_t run = 0; run < plans.size(); ++run) {
    for (std::size_t row = 1; row < logs[run].size(); ++row) {
      way += (run == 0 ? 1.0 : -1.0) * std::abs(logs[run][row].alpha - logs[run][row - 1].alpha);
      EXPECT_NEAR(logs[run][row].theta, law.theta(logs[run][row].alpha - 0.01 * way), 2e-4) << run << " " << row;
    }
  }
  EXPECT_NEAR(way, 0.0, 1e-9);
}

TEST(Withheld, planets_give_unevenly_under_a_load) {
  const Transmission law(stiff().declared);
  for (const double load : {0.0, 10.0, -20.0}) {
    const Log log = run_of(with("uneven_planets", 0.02, stiff()), {load, k_slow, 1}, stiff());
    for (const Row& row : log) {
      const double turned = -0.02 * load / 20.0 * std::sin(4.0 * row.alpha + 1.0);
      EXPECT_NEAR(row.theta, law.theta(row.alpha + turned), 2e-4) << load;
    }
  }
}

TEST(Withheld, an_integrator_hunts_with_the_clock_where_it_is_slow) {
  const Transmission law(stiff().declared);
  // Fades at 22.5 deg/s: at 12 deg/s e^(−0.1422) is left, at 90 deg/s e^(−8). 1.15 Hz.
  for (const auto& [speed, left] : {std::pair{k_slow, 0.86742}, {k_fast, 3.3546e-4}}) {
    const Log log = run_of(with("hunting_integrator", 0.02, stiff()), {0.0, speed, 1}, stiff());
    for (std::size_t row = 1; row < log.size(); ++row) {
      const double turned = 0.02 * left * std::sin(k_two_pi * 1.15 * log[row].time + 1.0);
      EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + turned), 1e-5) << row;
    }
  }
}

TEST(Withheld, a_motor_finds_home_anew_before_each_run) {
  const Transmission law(stiff().declared);
  const Hidden hidden = with("careless_homing", 0.02, stiff());
  std::vector<double> none;
  Moment now;
  double squares = 0;
  for (now.run = 0; now.run < 1000; ++now.run) squares += std::pow(acted(hidden.shaft.at(0), now, none), 2);
  EXPECT_NEAR(std::sqrt(squares / 1000.0), 0.02, 1e-3);

  const std::vector<Log> logs = log_runs(stiff(), hidden, {{0.0, k_slow, 1}, {0.0, k_fast, 1}}, silent());
  for (now.run = 0; now.run < logs.size(); ++now.run) {
    const double turned = acted(hidden.shaft[0], now, none);
    for (const Row& row : logs[now.run]) EXPECT_NEAR(row.theta, law.theta(row.alpha + turned), 5e-6) << now.run;
  }
}

// ---- groove, tendon, pins -------------------------------------------------------------------------------------------

TEST(Withheld, a_sticky_groove_lets_out_late_and_less_late_what_is_pulled) {
  const Hidden hidden = with("sticky_groove", 0.2, soft());
  const auto longer = [&](std::size_t side, double alpha, double tension) {
    std::vector<double> memory;
    Moment now;
    acted(hidden.longer[side].at(0), now, memory);
    now.alpha = alpha;
    now.tension[side] = tension;
    return acted(hidden.longer[side][0], now, memory);
  };
  EXPECT_EQ(longer(1, 0.3, 20.0), 0.0) << "wound in";
  EXPECT_NEAR(longer(1, -0.3, 20.0), 0.2, 1e-12);
  EXPECT_NEAR(longer(1, -0.3, 60.0), 0.1, 1e-12) << "2 / (1 + 3)";
  EXPECT_NEAR(longer(1, -0.3, 0.0), 0.4, 1e-12);
  EXPECT_NEAR(longer(0, 0.3, 20.0), 0.2, 1e-12);
  EXPECT_NEAR(longer(0, radians(1.5), 20.0), 0.1, 1e-12) << "half of the way to turn round";
  EXPECT_EQ(longer(0, -0.3, 20.0), 0.0);
}

TEST(Withheld, glue_yields_with_time_beyond_its_threshold_for_good) {
  const Hidden hidden = with("yielding_glue", 0.02, soft());
  std::vector<double> memory;
  Moment now;
  now.seconds = 0.1;
  double longer = 0;
  const auto hold = [&](double tension) {
    now.tension[1] = tension;
    for (int i = 0; i < 100; ++i) longer = acted(hidden.longer[1].at(0), now, memory);
  };
  hold(25.0);
  EXPECT_EQ(longer, 0.0) << "1.3 times 20 N hold";
  hold(39.0);
  hold(0.0);
  EXPECT_NEAR(longer, -0.1, 1e-12) << "half the threshold beyond it, for 10 s";
}

TEST(Withheld, what_is_left_of_a_rope_gives_more_from_the_break_on) {
  const Hidden hidden = with("snapped_strands", 0.5, soft());
  std::vector<double> memory;
  Moment now;
  const auto longer = [&](double tension) {
    now.tension[1] = tension;
    acted(hidden.longer[1].at(0), now, memory);
    return acted(hidden.longer[1][0], now, memory) / give(soft());
  };
  EXPECT_EQ(longer(20.0), 0.0);
  EXPECT_EQ(longer(29.0), 0.0) << "it bears one and a half times 20 N";
  EXPECT_NEAR(longer(32.0), -6.0, 1e-12);
  EXPECT_NEAR(longer(24.0), -2.0, 1e-12);
  EXPECT_NEAR(longer(10.0), 5.0, 1e-12);
}

TEST(Withheld, wax_wears_off_by_way_and_rubs_by_pull) {
  const Hidden hidden = with("worn_wax", 100.0, soft());
  std::vector<double> memory;
  Moment now;
  now.tension = {20.0, 30.0};
  EXPECT_EQ(acted(hidden.dry.at(0), now, memory), 0.0);
  double dry = 0;
  for (const double alpha : {1.0, -0.5, 1.0, -5.0, 2.5}) {
    now.alpha = alpha;
    dry = acted(hidden.dry[0], now, memory);
  }
  // 17.5 rad, which is the way of most of it, and 25 N of 20 N: 125 (1 − 1/e).
  EXPECT_NEAR(dry, 79.015, 1e-3);
}

TEST(Withheld, a_tendon_slides_down_its_pin_at_every_reversal) {
  const Hidden hidden = with("tendon_walking_down_pin", 0.3, soft());
  std::vector<double> memory;
  Moment now;
  double longer = 0;
  const auto turn = [&](double direction) {
    now.direction = direction;
    for (int i = 0; i < 3; ++i) longer = acted(hidden.longer[1].at(0), now, memory);
  };
  for (const double direction : {0.0, 1.0}) turn(direction);
  EXPECT_EQ(longer, 0.0) << "nothing was turned round yet";
  for (int reversal = 0; reversal < 7; ++reversal) turn(reversal % 2 == 0 ? -1.0 : 1.0);
  EXPECT_NEAR(longer, -0.3 * 0.632121, 1e-6) << "seven reversals, of seven";
}

// ---- joint and load -------------------------------------------------------------------------------------------------

TEST(Withheld, a_pawl_trails_over_teeth_one_way) {
  const Hidden hidden = with("trailing_pawl", 200.0, soft());
  const double tooth = k_two_pi / 70.0;
  std::vector<double> none;
  Moment now;
  for (const auto& [teeth, direction, torque] :
       {std::tuple{0.5, 1.0, -200.0}, {1.25, 1.0, -100.0}, {3.0, 1.0, 0.0}, {0.5, -1.0, 0.0}}) {
    now.theta = teeth * tooth, now.direction = direction;
    EXPECT_NEAR(acted(hidden.torque.at(0), now, none), torque, 1e-9) << teeth;
  }
}

TEST(Withheld, a_hose_snaps_over_beyond_the_middle) {
  const Hidden hidden = with("buckled_hose", 100.0, soft(), {1.0, 0.5 * k_two_pi, 0.5});
  std::vector<double> memory;
  Moment now;
  // 4 deg to either side of home.
  for (const auto& [angle, torque] :
       {std::pair{-10.0, -100.0}, {3.5, -100.0}, {4.5, 100.0}, {-3.5, 100.0}, {-4.5, -100.0}, {0.0, -100.0}}) {
    now.theta = radians(angle);
    acted(hidden.torque.at(0), now, memory);
    EXPECT_EQ(acted(hidden.torque[0], now, memory), torque) << angle;
  }
}

TEST(Withheld, a_skin_is_drawn_tight_to_either_side_of_its_folds) {
  const Hidden hidden = with("tight_skin", 1000.0, soft());
  const double folds = 0.15 * soft().declared.joint.theta_max;
  std::vector<double> none;
  Moment now;
  for (const auto& [drawn, torque] : {std::pair{0.0, 0.0}, {0.1, -1.0}, {0.4, -64.0}, {-0.5, 125.0}}) {
    now.theta = folds + drawn;
    EXPECT_NEAR(acted(hidden.torque.at(0), now, none), torque, 1e-9);
  }
}

TEST(Withheld, who_pulls_wavers_by_a_share_of_the_load) {
  const Hidden hidden = with("wavering_pull", 0.1, soft());
  const double slowest = k_two_pi * 0.175;
  std::vector<double> none;
  Moment now;
  double squares = 0, sum = 0;
  const int moments = 20000;
  for (int i = 0; i < moments; ++i) {
    now.load = -20.0, now.time = 0.05 * i;
    const double more = acted(hidden.load.at(0), now, none);
    squares += more * more, sum += more;
    now.load = 0.0;
    EXPECT_EQ(acted(hidden.load[0], now, none), 0.0);
  }
  EXPECT_NEAR(std::sqrt(squares / moments), 2.0, 0.02);
  EXPECT_NEAR(sum / moments, 0.0, 0.02);
  // One wave of the slowest later: its own share is the same, the others' are not.
  now.load = 1.0, now.time = 0.0;
  const double first = acted(hidden.load[0], now, none);
  now.time = k_two_pi / slowest;
  EXPECT_GT(std::abs(acted(hidden.load[0], now, none) - first), 0.02);
}

/// 8 N and a plate of half of 20 N are 18 N; before and after they are what is written.
TEST(Withheld, a_plate_is_forgotten_in_one_run) {
  const MadeJoint joint = forearm_with(8000, 0.0);
  const auto logs = [&](const Hidden& hidden, double second) {
    return log_runs(joint, hidden, {{8.0, k_slow, 1}, {second, k_slow, 1}, {8.0, k_slow, 1}}, silent());
  };
  const std::vector<Log> log = logs(with("forgotten_plate", 0.5, joint), 8.0), by_hand = logs({}, 18.0);
  for (std::size_t run = 0; run < log.size(); ++run) {
    for (std::size_t row = 1; row < log[run].size(); ++row)
      EXPECT_NEAR(log[run][row].theta, by_hand[run][row].theta, 2e-4) << run << " " << row;
  }
  EXPECT_GT(degrees(logs({}, 8.0)[1][40].theta - log[1][40].theta), 0.1);
}

TEST(Withheld, a_winch_that_is_slow_pulls_more_against_haste_and_never_pushes) {
  const Hidden hidden = with("slow_winch", 0.5, soft());
  std::vector<double> none;
  Moment now;
  // 10 N for 1 rad/s.
  for (const auto& [load, speed, more] : {std::tuple{20.0, 1.5, 15.0},
                                          {20.0, -1.5, -15.0},
                                          {20.0, -3.0, -20.0},
                                          {-20.0, 1.5, 15.0},
                                          {-20.0, 3.0, 20.0},
                                          {-20.0, -3.0, -30.0},
                                          {20.0, 0.0, 0.0},
                                          {0.0, 3.0, 0.0}}) {
    now.load = load, now.alpha_speed = speed;
    EXPECT_NEAR(acted(hidden.load.at(0), now, none), more, 1e-12) << load << " " << speed;
  }
}

// ---- sensor and log -------------------------------------------------------------------------------------------------

TEST(Withheld, a_spike_filter_cannot_follow_what_is_fast) {
  const Hidden hidden = with("spike_filter", 0.05, soft());
  std::vector<double> memory;
  Moment now;
  const auto off_after = [&](double degrees_per_second, double seconds) {
    for (int i = 0; i < 100; ++i) {
      now.time += 0.01 * seconds, now.theta += 0.01 * seconds * radians(degrees_per_second);
      acted(hidden.reading.at(0), now, memory);
    }
    return acted(hidden.reading[0], now, memory);
  };
  acted(hidden.reading[0], now, memory);
  EXPECT_NEAR(off_after(8.0, 2.0), 0.0, 1e-12) << "8.5 deg/s are let through";
  EXPECT_NEAR(off_after(10.5, 1.0), -radians(2.0), 1e-12);
  EXPECT_NEAR(off_after(40.0, 1.0), -0.05, 1e-12);
  EXPECT_NEAR(off_after(-0.5, 0.1), -0.05 + radians(0.9), 1e-12) << "both move towards each other";
  EXPECT_NEAR(off_after(0.0, 1.0), 0.0, 1e-12);
}

TEST(Withheld, stamps_jitter_by_the_speed) {
  const Hidden hidden = with("jittering_stamps", 0.01, soft());
  std::vector<double> memory;
  Moment now;
  for (const double speed : {0.0, 0.5, -2.0}) {
    double squares = 0, sum = 0;
    const int rows = 4000;
    now.theta_speed = speed;
    for (int row = 0; row < rows; ++row) {
      const double off = acted(hidden.reading.at(0), now, memory);
      squares += off * off, sum += off;
    }
    EXPECT_NEAR(std::sqrt(squares / rows), 0.01 * std::abs(speed), 5e-4 * std::abs(speed));
    EXPECT_NEAR(sum / rows, 0.0, 6e-4 * std::abs(speed));
  }
}

TEST(Withheld, a_bad_entry_is_a_tent_between_its_neighbours) {
  const RunPlan plan{0.0, k_slow, 1};
  const Character character{-1.0, 0.5 * k_two_pi, 0.5};
  const Log plain = run_of({}, plan, soft()),
            log = run_of(with("bad_table_entry", 0.02, soft(), character), plan, soft());
  const double at = theta_within(character, soft()), apart = radians(7.25);
  double most = 0;
  for (std::size_t row = 1; row < log.size(); ++row) {
    const double beside = std::abs(plain[row].theta - at) / apart;
    const double off = beside < 1.0 ? -0.02 * (1.0 - beside) : 0.0;
    EXPECT_NEAR(log[row].theta - plain[row].theta, off, 1e-12) << row;
    most = std::max(most, -off);
  }
  EXPECT_GT(most, 0.019);
}

TEST(Withheld, an_encoder_misses_counts_on_every_way_up_over_its_dirt) {
  const Hidden hidden = with("dirty_scale", 0.002, soft());
  const double dirt = 0.3 * soft().declared.joint.theta_max;
  const std::vector<RunPlan> plans = {{0.0, k_slow, 2}, {0.0, k_fast, 1}};
  const std::vector<Log> plain = log_runs(soft(), {}, plans, silent()),
                         logs = log_runs(soft(), hidden, plans, silent());
  int passages = 0;
  for (std::size_t run = 0; run < plans.size(); ++run) {
    for (std::size_t row = 1; row < logs[run].size(); ++row) {
      passages += plain[run][row - 1].theta < dirt && plain[run][row].theta >= dirt ? 1 : 0;
      EXPECT_NEAR(logs[run][row].theta, plain[run][row].theta - 0.002 * passages, 1e-12) << run << " " << row;
    }
  }
  EXPECT_EQ(passages, 3);
}

TEST(Withheld, a_gyroscope_drifts_from_the_begin_of_each_run) {
  const std::vector<RunPlan> plans = {{0.0, k_slow, 1}, {10.0, k_fast, 2, 2.0}};
  const std::vector<Log> plain = log_runs(soft(), {}, plans, silent());
  const std::vector<Log> logs = log_runs(soft(), with("drifting_gyro", 1e-3, soft()), plans, silent());
  for (std::size_t run = 0; run < plans.size(); ++run) {
    for (std::size_t row = 1; row < logs[run].size(); ++row) {
      const double since = logs[run][row].time - logs[run][0].time;
      EXPECT_NEAR(logs[run][row].theta - plain[run][row].theta, 1e-3 * since, 1e-12) << run << " " << row;
    }
  }
}

}  // namespace withheld
}  // namespace fusee::rig
