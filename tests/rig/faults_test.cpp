// Each row of the table of faults acts as its comment says: by examples, random ones by their statistics. Each list of
// HiddenFaults acts at its place in the chain.
#include "rig/faults.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "fusee/joint.h"
#include "fusee/transmission.h"
#include "rig/bench.h"
#include "rig/test_joints.h"
#include "rig/truths.h"

namespace fusee::rig {
namespace fault_examples {

using ::testing::Contains;
using ::testing::Not;

constexpr Character k_middle{1.0, 1.0, 0.5};

HiddenFaults with(const std::string& fault, double size, const Character& character = k_middle,
                  const MadeJoint& joint = soft()) {
  HiddenFaults hidden;
  find_fault(fault).apply(hidden, size, character, joint);
  return hidden;
}

// ---- examples -------------------------------------------------------------------------------------------------------

/// Sets a member of Moment.
struct Input {
  void (*set)(Moment&, double);
};
// clang-format off
constexpr Input alpha{[](Moment& m, double x) { m.alpha = x; }}, theta{[](Moment& m, double x) { m.theta = x; }},
    load{[](Moment& m, double x) { m.load = x; }}, warmth{[](Moment& m, double x) { m.warmth = x; }},
    motor_speed{[](Moment& m, double x) { m.alpha_speed = x; }}, speed{[](Moment& m, double x) { m.theta_speed = x; }},
    time{[](Moment& m, double x) { m.time = x; }}, seconds{[](Moment& m, double x) { m.seconds = x; }},
    direction{[](Moment& m, double x) { m.direction = x; }},
    tension1{[](Moment& m, double x) { m.tension[0] = x; }}, tension2{[](Moment& m, double x) { m.tension[1] = x; }},
    tension{[](Moment& m, double x) { m.tension[m.side] = x; }};  // of the tendon at m.side
// clang-format on

/// The values of an example that change sign with the character.
enum class Sign { nothing, action, action_and_first_input };

/// Rows of inputs and the resulting action in multiples of `unit`, in sequence with one memory. All other members of
/// Moment change from row to row.
struct Example {
  const char* fault;
  double size;
  double unit;
  std::vector<Input> inputs;
  std::vector<std::vector<double>> rows;
  Sign sign = Sign::nothing;
  std::array<double, 2> sides{1.0, 1.0};  ///< factor of each tendon
  Character character = k_middle;
};
void PrintTo(const Example& example, std::ostream* out) { *out << example.fault; }

const double e1 = std::exp(-1.0), e2 = std::exp(-2.0), e3 = std::exp(-3.0);
const double s1 = std::sin(1.0), c1 = std::cos(1.0);
constexpr double k_before_home = radians(-18.0);  // theta_within() for a share of 0

// clang-format off
std::vector<Example> examples() {
  const double turn8 = k_two_pi / 8.0, notch = k_two_pi / 21.0, half = radians(30.0), rim = std::asin(0.98);
  const auto cosine = [](double tenths) { return radians(30.0) * std::cos(tenths * k_pi / 10.0); };
  return {
      // Tuning.
      {"gearbox_error", 0.01, 0.01, {alpha}, {{0, 0}, {1, std::sin(4.7) - s1}, {-1, std::sin(-2.7) - s1}}},
      {"jumping_hub", 0.1, -0.1, {alpha}, {{0, 0}, {0.05, 0.5}, {0.09, 0.9}, {0.12, 0.2}, {0.07, -0.3}, {-0.05, -0.5}}},
      {"lost_counts", 0.01, 0.01, {motor_speed, seconds}, {{0.8, 1, 0}, {1, 2, 2}, {-1, 5, 2}, {2, 1, 4}, {0.5, 1, 4}}},
      {"on_its_own_turns", 0.2, 0.2, {alpha}, {{stiff().alpha_min, 0}, {stiff().alpha_max, 0.5 * (stiff().alpha_max - stiff().alpha_min)}}},
      {"climbing_flank", 0.1, 0.1, {alpha, direction}, {{0.5 * (soft().alpha_min + soft().alpha_max), 1, 1}, {0.5 * (soft().alpha_min + soft().alpha_max), -1, 0}, {5, 1, 0}}},
      {"flat_on_pin", 0.1, -0.1, {theta}, {{0, 1}, {radians(3.0), 0.75}, {radians(-7.0), 0}}},
      {"tightening_knots", 0.3, -0.3, {tension}, {{20, 0}, {40, 1 - e1}, {20, 1 - e1}, {0, 1 - e1}, {60, 1 - e2}}},
      {"rubbing_place", 50, 50, {theta}, {{0, 1}, {radians(4.0), std::exp(-0.5)}, {1, 0}}},
      {"grease", 100, -100, {speed}, {{0, 0}, {0.5, 0.5}, {-2, -2}}},
      {"warm_zero", 1e-3, 1e-3, {warmth}, {{0, 0}, {-5, -5}}, Sign::action},
      {"wrong_load_cell", 0.5, 0.5, {load}, {{0, 0}, {8, 8}, {-6, -6}}},
      // Regression.
      {"turns_side_by_side", 0.1, 0.1, {alpha}, {{0, 0}, {soft().alpha_max, 1 - std::pow((soft().alpha_max + soft().alpha_min) / (soft().alpha_max - soft().alpha_min), 2)}}},
      {"creeping_knot", 0.1, -0.1, {tension2}, {{20, 0}, {26, 0}, {39, 0.5}, {20, 0.5}, {52, 1.5}}},
      {"fibres_rubbing_by_howells_law", 300, 150, {tension1, tension2}, {{0, 0, 0}, {20, 20, 2}, {160, -3, 4}}},
      {"wire_drawn_in_too_slowly", 1, 1, {theta, time}, {{0, 0, 0}, {1, 1, 0}, {0, 2, 1 - radians(6.0)}, {0, 3, 1 - 2 * radians(6.0)}}, Sign::action_and_first_input},
      {"thermometer_glued_to_motor", 0.01, 0.01, {motor_speed, time}, {{1, 0, 0}, {1, 35, 1 - e1}, {0, 70, (1 - e1) * e1}}, Sign::action},
      // Motor, gearbox, shaft.
      {"magnets_for_coupling_leaning", 0.05, -0.05, {load}, {{0, 0}, {30, k_pi / 6}, {-30, -k_pi / 6}, {60 * std::sqrt(0.5), k_pi / 4}, {60, rim}, {-900, -rim}}},
      {"motor_of_uneven_force", 0.01, -0.01, {alpha, load}, {{0, 0, 0}, {0, 20, s1}, {0.25 * turn8, 20, c1}, {0.5 * turn8, 20, -s1}, {0.25 * turn8, -40, -2 * c1}, {3 * turn8, 10, 0.5 * s1}}},
      {"split_gear_pushed_open", 0.01, -0.01, {load}, {{0, 0}, {7.9, 0}, {9, 0.5}, {10.1, 1}, {80, 1}, {-9, 0}, {-80, 0}}, Sign::action_and_first_input},
      {"strain_wave_gear_rubbing_within", 0.005, 0.005, {load}, {{0, 0}, {1, 0.5}, {10, 1}, {10, 1}, {9, 0.5}, {8, 0}, {6, -1}, {0, -1}, {-20, -1}, {-19, -0.5}, {0, 1}}},
      {"worm_shrinking_in_cold", 1e-3, 1e-3, {warmth}, {{0, 0}, {-10, -10}, {5, 5}}, Sign::action},
      {"vee_belt_sinking_into_its_wheel", 0.01, -0.01, {alpha, load}, {{0, 20, 0}, {0.5, 0, 0}, {0.5, 20, 0.5}, {0.5, -20, 0.5}, {-0.5, 40, -1}, {-0.5, -40, -1}}},
      {"shaft_carried_aside_by_oil", 0.1, 0.1, {motor_speed}, {{0, 0}, {1.1 * (std::sqrt(2.0) - 1), 1}, {1.1, std::sqrt(0.75)}, {-1.1, -std::sqrt(0.75)}, {4.4, 0.4 * std::sqrt(0.96)}}, Sign::action, {-1, 1}},
      // Tendons, pins, frame.
      {"tendon_changing_its_crystals", 0.3, 0.3, {tension}, {{20, 0}, {29, 0.5}, {26, 0.5}, {31, 0.75}, {40, 1}, {27.1, 1}, {23, 0.5}, {26, 0.5}, {20, 0.125}, {0, 0}, {25, 0}}},
      {"panel_popping_like_an_oil_can", 0.2, -0.2, {load}, {{0, 0}, {6.9, 0}, {7.1, 1}, {40, 1}, {0, 1}, {-2.2, 1}, {-2.4, 0}, {-40, 0}, {6.9, 0}}, Sign::action_and_first_input, {-1, 1}},
      {"lock_nut_shaken_loose", 0.01, -0.01, {alpha, motor_speed}, {{0.2, 1, 0}, {0.7, 1, 0.5}, {0.2, -2, 2.5}, {0.2, 3, 2.5}, {0.6, 0.1, 2.504}, {1.6, 9, 11.504}}},
      {"ferrule_slipping_at_each_jerk", 0.2, 0.2, {load}, {{0, 0}, {0.9, 0}, {1.1, 1}, {20, 1}, {-20, 1}, {0, 1}, {0, 1}, {-5, 2}, {0, 2}, {3, 3}}},
      {"tape_wandering_on_its_drum", 0.2, 0.2, {alpha, direction}, {{-0.3, 0, 0}, {0.35, 1, 1 - e1}, {1, 1, 1 - e2}, {1, 1, 1 - e2}, {0.35, -1, -1 + (2 - e2) * e1}, {-90, -1, -1}, {-89.35, 1, 1 - 2 * e1}}},
      {"wires_and_pins_galling", 500, 500, {alpha, tension1, tension2}, {{1, 20, 20, 0}, {16, 20, 20, 1 - e1}, {1, 40, 0, 1 - e2}, {1, 60, 60, 3 * (1 - e2)}, {1, 0, -5, 0}, {-4, 60, 60, 3 * (1 - e3)}}},
      {"buffer_spring_closing_up", 0.1, 0.1, {tension}, {{20, 0}, {25, 0.25}, {30, 0.5}, {90, 0.5}, {10, -0.5}, {0, -1}, {-3, -1}}},
      {"tendon_over_edge_of_cover", 500, 500, {theta, tension1}, {{0, 20, 0}, {-0.2, 20, 0}, {0.15, 20, 0.5}, {0.3, 20, 1}, {0.6, 20, 1}, {0.15, 60, 1.5}, {0.3, -5, 0}}},
      {"tendon_over_edge_of_cover", 500, 500, {theta, tension2}, {{k_before_home, 20, 0}, {k_before_home - 0.15, 20, 0.5}}, Sign::nothing, {1, 1}, {-1, 1, 0}},
      // Joint.
      {"ball_rolling_in_hollow_link", 200, 200, {theta}, {{0, 0}, {radians(10.0), 0}, {0, 1}, {radians(-5.0), std::cos(radians(5.0))}, {-1, std::cos(1.0)}, {0, -1}, {radians(5.0), -std::cos(radians(5.0))}, {radians(7.0), -std::cos(radians(7.0))}, {0, 1}}, Sign::action},
      {"axle_with_ball_catch", 200, -200, {theta}, {{0, s1}, {0.25 * notch, c1}, {0.5 * notch, -s1}, {-2 * notch, s1}}},
      {"link_moved_under_water", 500, -500, {motor_speed}, {{0, 0}, {1, 1}, {-1, -1}, {0.1, 0.01}, {-2, -4}}},
      {"axle_nut_tightening_itself", 500, 500, {theta}, {{0.1, 0}, {0.6, 0.5}, {0.35, 0.3}, {0.35, 0.3}, {0.6, 0.55}, {-0.4, 0}, {0, 0.4}}},
      // Load.
      {"compressor_refilling_its_tank", 0.1, 0.1, {time, load}, {{0, 20, 0}, {6, 20, -5}, {11.99, 20, -10 + 0.2 / 24}, {12.01, 20, 10 - 0.2 / 24}, {18, 20, 5}, {18, -40, -10}, {18, 0, 0}, {66, 20, 5}}, Sign::nothing, {1, 1}, {1, k_pi, 0.5}},
      {"air_for_load_throttled", 2, 1, {load, seconds}, {{0, 9, 0}, {20, 2, -20 * e1}, {20, 2, -20 * e2}, {0, 2, 20 * (1 - e2) * e1}, {0, 1e4, 0}, {-10, 2, 10 * e1}, {-10, 1e4, 0}}},
      {"motor_for_load_a_dynamo", 1.5, 1.5, {load, motor_speed}, {{20, 0, 0}, {20, 0.5, 0.5}, {5, -0.5, -0.5}, {-20, 2, 2}, {-20, -2, -2}, {0, 2, 0}}},
      {"gas_for_load_cooling", 0.02, 0.02, {load, warmth}, {{25, 0, 0}, {25, -10, -250}, {-25, -10, 250}, {0, -10, 0}, {25, 5, 125}, {20, -300, -950}}},
      // Joint's sensor, log.
      {"sunbeam_passing_sensor", 0.01, 0.01, {time}, {{30, 1}, {38, std::exp(-0.5)}, {22, std::exp(-0.5)}, {46, e2}, {200, 0}}, Sign::action},
      {"sensor_on_its_own_beat", 0.1, -1, {time, speed}, {{0, 2, 0.074}, {0.05, 2, 0.174}, {0.06, 0.5, 0.0485}, {0.07, 0.5, 0.0035}, {1, -0.5, -0.0185}, {1.07, -0.5, -0.0035}, {1.05, 0, 0}}},
      {"polynomial_of_too_high_degree", 0.004, 0.004, {theta}, {{0, 0}, {half, 1}, {-half, -1}, {cosine(1), 0}, {cosine(2), -1}, {cosine(3), 0}, {cosine(4), 1}, {-cosine(4), -1}, {0.5 * half, 0.5}, {1.1 * half, 16 * 1.61051 - 20 * 1.331 + 5.5}, {5 * half, 16 * 2.48832 - 20 * 1.728 + 6}}, Sign::action},
      {"computer_busy_with_steps", 0.05, -0.05, {motor_speed, speed}, {{0, 0.4, 0}, {1, 0.4, 0.2}, {1.5, 0.4, 0.4}, {-1.5, -0.4, -0.4}, {2, 0.5, 1}, {60, 0.5, 4.5}, {1.5, 0, 0}}},
      {"hair_spring_run_down", 0.01, 1e-3, {theta}, {{-0.1, 0}, {-0.2, 0}, {0.003, -3}, {0.02, -5}, {0.1, -5}, {0.098, -3}, {0.09, 5}, {0.002, 5}, {-0.001, 0}, {0.3, -5}}, Sign::action_and_first_input},
      {"clock_hunting_for_the_other", 0.04, -0.04, {time, speed}, {{0, 0.5, 0.5 * s1}, {12.5, 0.5, 0.5 * c1}, {25, 0.5, -0.5 * s1}, {37.5, -2, 2 * c1}, {150, 0.5, 0.5 * s1}, {12.5, 0, 0}}},
      {"shorted_turns_in_potentiometer", 0.01, -1e-3, {theta}, {{0, 0}, {-0.1, 0}, {0.004, 4}, {0.01, 10}, {0.011, 10}, {0.4, 10}}},
      {"shorted_turns_in_potentiometer", 0.01, 1e-3, {theta}, {{k_before_home - 0.1, 10}, {k_before_home + 0.004, 6}, {k_before_home + 0.01, 0}, {0.4, 0}}, Sign::nothing, {1, 1}, {1, 1, 0}},
  };
}
// clang-format on

/// `now` with every member changed by the row.
Moment changed(const Moment& now, std::size_t row) {
  const double x = static_cast<double>(row + 1);
  Moment other = now;
  other.time += 1.7 * x, other.run_time += x, other.seconds = 0.3 * x, other.run += row;
  other.alpha += 0.1 * x, other.direction = row % 2 == 0 ? 1.0 : -1.0, other.alpha_speed = 0.4 - 0.1 * x;
  other.pulley = 0.1 * x, other.theta += 0.07 * x, other.theta_speed = 0.2 * x - 0.5, other.load = 10.0 - 3.0 * x;
  other.warmth = -x, other.tension = {70.0 + x, 50.0 + x};
  return other;
}

void expect_rows(const Example& example, const Action& action, std::size_t side, double sign) {
  std::vector<double> memory;
  Moment now;
  for (std::size_t row = 0; row < example.rows.size(); ++row) {
    now = changed(now, row);
    now.side = side;
    const std::vector<double>& values = example.rows[row];
    for (std::size_t i = 0; i < example.inputs.size(); ++i)
      example.inputs[i].set(now, i == 0 && example.sign == Sign::action_and_first_input ? sign * values[i] : values[i]);
    const double acts = example.unit * example.sides[side] * values.back();
    EXPECT_NEAR(action.act(now, action.numbers, memory), example.sign == Sign::nothing ? acts : sign * acts,
                1e-9 * std::abs(example.unit) + 1e-12)
        << "row " << row << ", tendon " << side + 1;
  }
}

/// All actions with the index of their tendon, 1 at other places.
std::vector<std::pair<const Action*, std::size_t>> actions_of(const HiddenFaults& hidden) {
  std::vector<std::pair<const Action*, std::size_t>> all;
  for (const auto* list :
       {&hidden.shaft, &hidden.torque, &hidden.dry, &hidden.load, &hidden.reading, &hidden.longer[1]})
    for (const Action& action : *list) all.emplace_back(&action, 1);
  for (const Action& action : hidden.longer[0]) all.emplace_back(&action, 0);
  return all;
}

TEST(FaultExamples, ActAsDescribed) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.fault);
    for (const double sign : {1.0, -1.0}) {
      if (sign < 0 && example.sign == Sign::nothing && find_fault(example.fault).place != Place::one_tendon) continue;
      const Character character{sign * example.character.sign, example.character.angle, example.character.share};
      const HiddenFaults hidden = with(example.fault, example.size, character);
      if (find_fault(example.fault).place == Place::one_tendon) {
        EXPECT_TRUE(hidden.longer[sign > 0 ? 0 : 1].empty());
      }
      const auto actions = actions_of(hidden);
      EXPECT_EQ(actions.size(), find_fault(example.fault).place == Place::both_tendons ? 2u : 1u);
      for (const auto& [action, side] : actions) expect_rows(example, *action, side, sign);
    }
  }
}

TEST(FaultExamples, CoverEveryAction) {
  std::set<std::string> shown;
  for (const char* name : {"gusts_through_a_window", "popcorn_in_amplifier", "laser_on_grainy_rim",
                           "span_set_before_each_run",  // Chance.*
                           "loose_axis", "sliding_ring", "flexure_wandering", "bearing_ring_creeping_round"})
    shown.insert(name);  // Displaced.*
  for (const Example& example : examples()) shown.insert(example.fault);
  for (const Fault& fault : all_faults()) EXPECT_TRUE(fault.act == nullptr || shown.contains(fault.name)) << fault.name;
}

/// Displacement of the link's end across and along after these moments.
std::array<double, 2> across_and_along(const HiddenFaults& hidden, const std::vector<Moment>& moments) {
  std::array<double, 2> acts{};
  for (const std::size_t axis : {0u, 1u}) {
    const Action& action = hidden.longer[1].at(0);
    std::vector<double> memory;
    for (Moment now : moments) {
      now.side = 1, now.pull[1] = Vec2::Unit(static_cast<Eigen::Index>(axis));
      acts[axis] = -action.act(now, action.numbers, memory);
    }
  }
  return acts;
}

TEST(Displaced, LinkEndMoves) {
  Moment home, out, on;
  out.theta = 0.4;
  on.alpha = 5.0 * k_pi;  // a quarter of a turn of the ring
  const auto near = [](std::array<double, 2> found, double across, double along) {
    EXPECT_NEAR(found[0], across, 1e-12);
    EXPECT_NEAR(found[1], along, 1e-12);
  };
  near(across_and_along(with("sliding_ring", 2.0), {home, out}), 1.28 * std::sin(0.4), 1.28 * std::cos(0.4));
  const double far = std::pow(0.4 / soft().declared.joint.theta_max, 2);
  near(across_and_along(with("flexure_wandering", 1.0), {home, out}), far * std::sin(0.2), far * std::cos(0.2));
  near(across_and_along(with("bearing_ring_creeping_round", 0.1), {home, on}), 0.1 * (-s1 - c1), 0.1 * (c1 - s1));
}

TEST(Displaced, LooseAxisShortensLink) {
  // Forces at the link's end that balance about its axis pull along the link.
  const HiddenFaults shorter{.guide_down = 0.4, .joint_length = -0.4};
  Bench loose(soft(), with("loose_axis", 0.4)), short_link(soft(), shorter), plain(soft(), {});
  Conditions at;
  double most_moved = 0;
  for (const double pull : {0.0, 10.0, -10.0}) {
    at.load = pull;
    for (const double angle : {0.0, 0.4, 0.8, 1.2, 0.6, 0.0, -0.7}) {
      const double by_axis = loose.to(angle, angle, at), by_hand = short_link.to(angle, angle, at);
      most_moved = std::max(most_moved, std::abs(by_axis - plain.to(angle, angle, at)));
      EXPECT_NEAR(by_axis, by_hand, 2.5e-5) << pull << " " << angle;
    }
  }
  EXPECT_GT(most_moved, 1e-3);
}

// ---- random numbers -------------------------------------------------------------------------------------------------

double act(const Action& action, const Moment& now, std::vector<double>& memory) {
  return action.act(now, action.numbers, memory);
}

TEST(Chance, GustsAreSquaredNormal) {
  const HiddenFaults hidden = with("gusts_through_a_window", 200.0);
  std::vector<double> memory;
  Moment now;
  const auto after = [&](double step) {
    now.seconds = step, now.theta += 0.1, now.load += 1.0;
    return act(hidden.torque.at(0), now, memory) / 200.0;
  };
  EXPECT_EQ(after(0.0), 0.0) << "calm at first";
  double sum = 0, together = 0;
  for (int draw = 0; draw < 4000; ++draw) {
    const double one = after(1e4);
    EXPECT_NEAR(after(0.0), one, 1e-12 * (1.0 + one)) << "no time has passed";
    sum += one, together += (one - 1.0) * (after(3.5 * std::log(2.0)) - 1.0);
  }
  // Squares of normal numbers: mean 1, variance 2; correlation 1/4 after a half-life of the wind.
  EXPECT_NEAR(sum / 4000.0, 1.0, 0.1);
  EXPECT_NEAR(together / 4000.0, 0.5, 0.25);
}

TEST(Chance, PopcornHasTwoStates) {
  const HiddenFaults hidden = with("popcorn_in_amplifier", 0.008);
  for (const auto& [step, jumps] : {std::pair{0.0, 0.0}, {0.55, 0.5 * (1.0 - std::exp(-0.2))}, {1e4, 0.5}}) {
    std::vector<double> memory;
    Moment now;
    std::vector<double> off;
    for (int row = 0; row <= 20000; ++row) {
      now.time += step, now.theta += 0.1;
      off.push_back(act(hidden.reading.at(0), now, memory));
      EXPECT_TRUE(off.back() == 0.0 || off.back() == 0.008) << off.back();
    }
    double changes = 0;
    for (std::size_t row = 1; row < off.size(); ++row) changes += off[row] != off[row - 1] ? 1 : 0;
    EXPECT_NEAR(changes / 20000.0, jumps, 0.02) << step;
  }
}

TEST(Chance, RimIsSameInEachPass) {
  const HiddenFaults hidden = with("laser_on_grainy_rim", 0.003);
  std::vector<double> none;
  Moment now;
  const auto shown = [&](double points) {
    now.theta = radians(2.0 * points), now.load += 1.0, now.time += 1.0, now.run += 1;
    return act(hidden.reading.at(0), now, none) / 0.003;
  };
  EXPECT_EQ(shown(0.0), 0.0);
  double squares = 0;
  for (int point = -500; point < 500; ++point) {
    const double here = shown(point), next = shown(point + 1.0);
    EXPECT_EQ(shown(point), here);
    EXPECT_NEAR(shown(point + 0.25), here + 0.25 * (next - here), 1e-9) << point;
    squares += std::pow(next - here, 2);
  }
  EXPECT_NEAR(squares / 1000.0, 2.0, 0.3) << "each point by itself";
}

TEST(Chance, SpanDiffersFromRunToRun) {
  const HiddenFaults hidden = with("span_set_before_each_run", 0.005);
  std::vector<double> none;
  double sum = 0, squares = 0;
  Moment now;
  for (now.run = 0; now.run < 1000; ++now.run) {
    now.theta = 0.5;
    const double draw = act(hidden.reading.at(0), now, none) / (0.5 * 0.005);
    now.theta = -0.2, now.load += 10.0, now.time += 1.0;
    EXPECT_NEAR(act(hidden.reading[0], now, none), -0.2 * 0.005 * draw, 1e-15);
    sum += draw, squares += draw * draw;
  }
  EXPECT_NEAR(sum / 1000.0, 0.0, 0.12);
  EXPECT_NEAR(squares / 1000.0, 1.0, 0.2);
}

// ---- places: an action in a list of HiddenFaults reaches the log -----------------------------------------------------

TEST(Place, ShaftTurnsPulley) {
  const transmission::Transmission law(stiff().declared);
  for (const Row& row : run_of(with("gearbox_error", 0.01), single_protocol().front(), stiff()))
    EXPECT_NEAR(row.theta, law.theta(row.alpha + 0.01 * (std::sin(3.7 * row.alpha + 1.0) - s1)), 3e-6);
}

TEST(Place, TorqueTwistsCompliantJoint) {
  const RunPlan fast{0.0, radians(90.0), 2, 0.0};
  const Log plain = run_of({}, fast, soft()), greased = run_of(with("grease", 2000.0), fast, soft());
  const transmission::TransmissionPoint home = transmission::Transmission(soft().declared).at_alpha(0.0);
  const double EA = section_stiffness(soft().declared.tendon);
  const double stiffness = EA * (home.t1.m * home.t1.m / home.t1.length + home.t2.m * home.t2.m / home.t2.length);
  const double rate = (plain[201].theta - plain[199].theta) / (plain[201].time - plain[199].time);
  const double behind = plain[200].theta - greased[200].theta;
  // The tendon in the groove adds compliance.
  EXPECT_GT(behind, 0.95 * 2000.0 * rate / stiffness);
  EXPECT_LT(behind, 1.5 * 2000.0 * rate / stiffness);
}

TEST(Place, ReadingIsAdded) {
  const RunPlan plan = single_protocol().front();
  const Log plain = run_of({}, plan, stiff()), warm = run_of(with("warm_zero", 1e-3), plan, stiff());
  for (std::size_t row = 0; row < plain.size(); ++row)
    EXPECT_NEAR(warm[row].theta - plain[row].theta, 1e-3 * (plain[row].temperature - 31.0), 1e-9);
}

TEST(Place, LoadPullsMoreThanLogged) {
  const Log wrong = run_of(with("wrong_load_cell", 0.5), {4.0, radians(12.0), 1}, soft());
  const Log right = run_of({}, {6.0, radians(12.0), 1}, soft());
  for (std::size_t row = 0; row < wrong.size(); ++row) {
    EXPECT_NEAR(wrong[row].theta, right[row].theta, 1e-9);
    EXPECT_EQ(wrong[row].load, 4.0);
  }
}

// ---- every fault ----------------------------------------------------------------------------------------------------

/// Both loads, fast and slow, rest under load, and no load again after it.
std::vector<Log> short_logs_of(const HiddenFaults& hidden) {
  MotionPlan few_rows;
  few_rows.rows_per_stroke = 40;
  const double slow = radians(12.0), fast = radians(90.0), between = radians(25.0);
  const std::vector<RunPlan> plans = {
      {0.0, slow, 1}, {25.0, fast, 2, 2.0}, {0.0, between, 1}, {-25.0, between, 1, 2.0}};
  return log_runs(soft(), hidden, plans, noiseless(), few_rows);
}

class EveryFault : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Tables, EveryFault, ::testing::Values("named", "tuning", "regression", "heldout_13"),
                         [](const auto& split) { return split.param; });

TEST_P(EveryFault, MovesReadingWithSize) {
  const std::vector<Log> plain = short_logs_of({});
  for (const Fault& fault : faults_in(GetParam())) {
    const double some = rms_difference(short_logs_of(with(fault.name, fault.first)), plain);
    EXPECT_GT(degrees(some), fault.name == "tendon_slip" ? 0.0005 : 0.003) << fault.name;
    EXPECT_GT(rms_difference(short_logs_of(with(fault.name, 2.0 * fault.first)), plain), 1.02 * some) << fault.name;
  }
}

TEST_P(EveryFault, ActionOfSizeZeroIsNothing) {
  HiddenFaults all;
  for (const Fault& fault : faults_in(GetParam())) {
    if (fault.act != nullptr && fault.name != "jumping_hub") fault.apply(all, 0.0, k_middle, soft());
  }
  const std::vector<Log> logs = short_logs_of(all);
  for (const Log& log : logs) EXPECT_TRUE(std::isfinite(log.back().theta));
  EXPECT_LT(degrees(rms_difference(logs, short_logs_of({}))), 1e-9);
}

TEST(FaultTable, RowsAreUniqueAndConsistent) {
  std::set<std::string> names;
  for (const Fault& fault : all_faults()) {
    EXPECT_TRUE(names.insert(fault.name).second) << fault.name;
    EXPECT_NE(fault.set == nullptr, fault.act == nullptr) << fault.name;
    EXPECT_LT(fault.first, fault.most) << fault.name;
    for (const std::string& kin : fault.kin) EXPECT_THAT(names_in("named"), Contains(kin)) << fault.name;
  }
}

TEST(HeldOutFaults, AreAllDrawnButNotInMatrix) {
  const std::vector<std::string> names = names_in("heldout_13");
  EXPECT_GE(names.size(), 32u);
  std::set<std::string> drawn;
  for (std::uint64_t seed = 1; seed < 300; ++seed) {
    const Truth truth = random_truth(Kind::beside, "heldout_13", seed);
    ASSERT_EQ(truth.faults.size(), 2u);
    EXPECT_TRUE(has_name(truth.faults[0]));
    EXPECT_THAT(names, Contains(truth.faults[1]));
    drawn.insert(truth.faults[1]);
  }
  EXPECT_EQ(drawn.size(), names.size());
  for (const Truth& truth : all_truths()) EXPECT_THAT(names, Not(Contains(truth.name)));
}

}  // namespace fault_examples
}  // namespace fusee::rig
