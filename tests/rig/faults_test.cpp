// Faults without a name, each held against what it is by hand; programmes as people measure.
#include "rig/faults.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "fusee/joint/joint_model.h"
#include "fusee/measurement/measurement.h"
#include "fusee/transmission/transmission.h"
#include "rig/bench.h"
#include "rig/fault_checks.h"
#include "rig/truths.h"
#include "support/mechanisms.h"

namespace fusee::rig {
namespace tuning {

/// Stiff and without friction: θ is the law's, whatever the load.
const MadeJoint& forearm() {
  static const MadeJoint joint = [] {
    DeclaredMechanism mechanism = testing::forearm();
    mechanism.guides.mu = 0;
    mechanism.tendon.modulus = 1e8;
    return make_joint(mechanism);
  }();
  return joint;
}

/// With tendons that give, μ 0.12 at the pins.
const MadeJoint& soft_forearm() {
  static const MadeJoint joint = [] {
    DeclaredMechanism mechanism = testing::forearm();
    mechanism.tendon.modulus = 8000;
    mechanism.tendon.pretension = 20;
    return make_joint(mechanism);
  }();
  return joint;
}

Hidden with(const std::string& fault, double size, const Character& character = {},
            const MadeJoint& joint = forearm()) {
  Hidden hidden;
  find_fault(fault).set(hidden, size, character, joint);
  return hidden;
}

Log run_of(const Hidden& hidden, const RunPlan& plan = single_protocol().front()) {
  return run_of(hidden, plan, forearm());
}

TEST(Unnamed, a_gear_turns_the_shaft) {
  const Transmission law(forearm().declared);
  for (const Row& row : run_of(with("gearbox_error", 0.01, {1.0, 0.5, 0.0})))
    EXPECT_NEAR(row.theta, law.theta(row.alpha + 0.01 * (std::sin(3.7 * row.alpha + 0.5) - std::sin(0.5))), 3e-6);
}

TEST(Unnamed, a_hub_that_jumps_is_behind_by_up_to_its_jump) {
  const Transmission law(forearm().declared);
  double least = 1, most = -1;
  const Log log = run_of(with("jumping_hub", 0.1));
  for (std::size_t row = 100; row < 160; ++row) {  // back
    const double h = 1e-4;
    const double slope = (law.theta(log[row].alpha + h) - law.theta(log[row].alpha - h)) / (2 * h);
    const double ahead = (log[row].theta - law.theta(log[row].alpha)) / slope;
    least = std::min(least, ahead);
    most = std::max(most, ahead);
  }
  EXPECT_NEAR(least, 0.0, 0.03);
  EXPECT_NEAR(most, 0.1, 0.03);
}

TEST(Unnamed, counts_are_lost_for_good_and_at_speed_alone) {
  const Transmission law(forearm().declared);
  MotionPlan slowly;
  slowly.pause = 60.0;  // home and back between the runs is slow too
  const std::vector<RunPlan> plans = {{0.0, radians(12.0), 1}, {0.0, radians(90.0), 2}, {0.0, radians(12.0), 1}};
  const std::vector<Log> logs = log_runs(forearm(), with("lost_counts", 0.01), plans, silent(), slowly);
  for (const Row& row : logs[0]) EXPECT_NEAR(row.theta, law.theta(row.alpha), 3e-6);
  const double stroke = logs[1][80].alpha - logs[1][0].alpha;
  for (const Row& row : logs[2]) EXPECT_NEAR(row.theta, law.theta(row.alpha + 2 * 0.01 * stroke), 1e-4);
}

TEST(Unnamed, a_flank_is_climbed_one_way) {
  const Transmission law(forearm().declared);
  const Log log = run_of(with("climbing_flank", 0.1, {1.0, 0.0, 0.5}));
  double up = 0, down = 0;
  for (std::size_t row = 1; row < log.size(); ++row) {
    const double moved = std::abs(log[row].theta - law.theta(log[row].alpha));
    (log[row].alpha > log[row - 1].alpha ? up : down) =
        std::max(log[row].alpha > log[row - 1].alpha ? up : down, moved);
  }
  EXPECT_GT(up, 1e-4);
  EXPECT_LT(down, 3e-6);
}

/// Tendon 2 alone carries; it is shorter by what was wound in more.
TEST(Unnamed, a_tendon_on_its_own_turns_winds_further_out) {
  Bench plain(forearm(), {}), stacked(forearm(), with("on_its_own_turns", 0.5, {1.0, 0.0, 0.0}));
  Conditions at;
  at.load = 5.0;
  at.let_go[0] = 30.0;
  const double from = forearm().alpha_min + 0.2 * (forearm().alpha_max - forearm().alpha_min);
  double before = 0;
  for (double alpha = from - 0.2; alpha < from + 0.5; alpha += 0.05) {
    const double theta = plain.to(alpha, alpha, at);
    const double moved = stacked.to(alpha, alpha, at) - theta;
    const double by_hand = 0.5 * std::max(0.0, alpha - from) / Transmission(forearm().declared).at_theta(theta).t2.m;
    EXPECT_NEAR(moved, by_hand, 0.05 * by_hand + 1e-6) << alpha;
    before = std::max(before, moved);
  }
  EXPECT_GT(before, 1e-3);
}

TEST(Unnamed, a_ring_that_slides_is_a_longer_link_there) {
  const double theta = radians(15.0);
  Hidden longer;
  longer.joint_length = 2.0 * theta * theta / 0.25;
  Bench ring(forearm(), with("sliding_ring", 2.0)), link(forearm(), longer);
  Conditions at;
  at.load = 5.0;
  at.let_go[0] = 30.0;
  // Both begin at home with the length they have there.
  double alpha = 0, standing = 0;
  while (standing < theta) alpha += 0.02, standing = ring.to(alpha, alpha, at);
  Bench plain(forearm(), {});
  const double moved = standing - plain.to(alpha, alpha, at);
  const Vec2 out(std::sin(theta), std::cos(theta));
  const Vec2 pull = ring.now().pull[1];
  const double arm = Transmission(forearm().declared).at_theta(theta).t2.m;
  // The link's end lies further out, against the pull: the tendon is too short and turns the joint on.
  const double by_hand = -longer.joint_length * out.dot(pull) / arm;
  EXPECT_NEAR(moved, by_hand, 0.06 * by_hand);
  EXPECT_GT(std::abs(moved), 1e-4);
}

TEST(Unnamed, a_loose_axis_is_pulled_along_the_link_and_shortens_it) {
  // All that pulls at the link pulls at its end, and holds it in balance about the axis: it pulls along the link.
  Hidden shorter;
  shorter.joint_length = -0.4;
  shorter.guide_down = 0.4;
  Bench loose(soft_forearm(), with("loose_axis", 0.4)), short_link(soft_forearm(), shorter), plain(soft_forearm(), {});
  Conditions at;
  double most_moved = 0;
  for (const double load : {0.0, 10.0, -10.0}) {
    at.load = load;
    for (const double alpha : {0.0, 0.4, 0.8, 1.2, 0.6, 0.0, -0.7}) {
      const double by_axis = loose.to(alpha, alpha, at), by_hand = short_link.to(alpha, alpha, at);
      most_moved = std::max(most_moved, std::abs(by_axis - plain.to(alpha, alpha, at)));
      EXPECT_NEAR(by_axis, by_hand, 2.5e-5) << load << " " << alpha;
    }
  }
  EXPECT_GT(most_moved, 1e-3);
}

TEST(Unnamed, grease_behind_a_stiffness_is_a_filter) {
  const MadeJoint& joint = soft_forearm();
  const RunPlan fast{0.0, radians(90.0), 2, 0.0};
  const Log plain = run_of({}, fast, joint);
  const Log greased = run_of(with("grease", 2000.0, {}, joint), fast, joint);
  const TransmissionPoint home = Transmission(joint.declared).at_alpha(0.0);
  const double EA = section_stiffness(joint.declared.tendon);
  const double stiffness = EA * (home.t1.m * home.t1.m / home.t1.length + home.t2.m * home.t2.m / home.t2.length);
  const double speed = (plain[201].theta - plain[199].theta) / (plain[201].time - plain[199].time);
  const double behind = plain[200].theta - greased[200].theta;
  // What lies in the groove makes the tendons longer.
  EXPECT_GT(behind, 0.95 * 2000.0 * speed / stiffness);
  EXPECT_LT(behind, 1.5 * 2000.0 * speed / stiffness);
}

TEST(Unnamed, a_zero_goes_with_the_temperature) {
  const Log plain = run_of({});
  const Log warm = run_of(with("warm_zero", 1e-3));
  for (std::size_t row = 0; row < plain.size(); ++row)
    EXPECT_NEAR(warm[row].theta - plain[row].theta, 1e-3 * (plain[row].temperature - 31.0), 1e-9);
}

TEST(Unnamed, a_wrong_load_cell_logs_less_than_pulls) {
  const MadeJoint& joint = soft_forearm();
  const Log wrong = run_of(with("wrong_load_cell", 0.5, {}, joint), {4.0, radians(12.0), 1}, joint);
  const Log right = run_of({}, {6.0, radians(12.0), 1}, joint);
  for (std::size_t row = 0; row < wrong.size(); ++row) {
    EXPECT_NEAR(wrong[row].theta, right[row].theta, 1e-9);
    EXPECT_EQ(wrong[row].load, 4.0);
  }
}

TEST(Unnamed, knots_tighten_once) {
  const MadeJoint& joint = soft_forearm();
  Bench bench(joint, with("tightening_knots", 0.3, {}, joint));
  Conditions at;
  const auto under = [&](double load) {
    at.load = load;
    double theta = 0;
    for (int i = 0; i < 40; ++i) theta = bench.to(0.0, 0.0, at);
    return theta;
  };
  under(0.0);
  under(15.0);
  under(-15.0);
  const double first = under(0.0);
  under(15.0);
  under(-15.0);
  EXPECT_NEAR(under(0.0), first, 6e-5) << "the second time it is tight";
  EXPECT_LT(bench.now().tension[1], 20.0);
}

/// Every fault does something, and equal joints are equal.
TEST(Unnamed, each_moves_the_reading) {
  const std::vector<RunPlan> plans = {{0.0, radians(12.0), 1}, {8.0, radians(90.0), 1}};
  const std::vector<Log> plain = log_runs(soft_forearm(), {}, plans, silent());
  std::vector<std::string> names = names_in("named");
  for (const std::string& name : names_in("tuning")) names.push_back(name);
  for (const std::string& name : names) {
    if (name == "tendon_slip") continue;  // in its own run
    const Fault& fault = find_fault(name);
    const Hidden hidden = with(name, fault.most, {1.0, 1.0, 0.5}, soft_forearm());
    EXPECT_FALSE(hidden == Hidden{}) << name;
    EXPECT_TRUE(hidden == with(name, fault.most, {1.0, 1.0, 0.5}, soft_forearm())) << name;
    std::vector<Log> logs;
    try {
      logs = log_runs(soft_forearm(), with(name, 0.1 * fault.most, {1.0, 1.0, 0.5}, soft_forearm()), plans, silent());
    } catch (const std::exception& error) {
      ADD_FAILURE() << name << ": " << error.what();
      continue;
    }
    double moved = 0;
    for (std::size_t run = 0; run < logs.size(); ++run) {
      for (std::size_t row = 0; row < logs[run].size(); ++row)
        moved = std::max(moved, std::abs(logs[run][row].theta - plain[run][row].theta));
    }
    EXPECT_GT(degrees(moved), 0.003) << name;
  }
}

// ---- programmes -----------------------------------------------------------------------------------------------------

TEST(Programme, a_staircase_holds_its_angles_and_goes_through_its_loads) {
  RunPlan plan;
  plan.manner = Manner::staircase;
  plan.levels = {0.0, 5.0, 10.0};
  plan.holds = 4;
  plan.cycles = 1;
  const Log log = run_of({}, plan, soft_forearm());
  std::set<long> angles;
  for (const Row& row : log) angles.insert(std::lround(1e6 * row.alpha));
  EXPECT_EQ(angles.size(), 4u);
  // Seven holds there and back, five levels at each, three rows a level, and the first row.
  EXPECT_EQ(log.size(), 1u + 7 * 5 * 3);
  for (const double load : plan.levels)
    EXPECT_GT(std::count_if(log.begin(), log.end(), [&](const Row& row) { return row.load == load; }), 20);
  EXPECT_LT(log[12].theta, log[2].theta) << "the load turns the joint back";
}

TEST(Programme, points_at_both_ends_in_turn) {
  RunPlan plan;
  plan.manner = Manner::ends;
  plan.holds = 3;
  plan.cycles = 1;
  const Log log = run_of({}, plan);
  ASSERT_EQ(log.size(), 1u + 2 * 3 * 3);
  for (std::size_t i = 1; i < log.size(); i += 6) {
    EXPECT_LT(log[i].alpha, 0.0);
    EXPECT_GT(log[i + 3].alpha, 0.0);
  }
  EXPECT_LT(log.back().alpha, log[4].alpha);
}

TEST(Programme, a_load_may_change_from_cycle_to_cycle) {
  RunPlan plan;
  plan.cycles = 2;
  plan.levels = {0.0, 6.0};
  const Log log = run_of({}, plan, soft_forearm());
  EXPECT_EQ(log[100].load, 0.0);
  EXPECT_EQ(log[163].load, 6.0);
  EXPECT_EQ(log[161].alpha, log[160].alpha) << "the motor stands while it is hung on";
}

TEST(Programme, a_random_one_is_within_what_people_do_and_the_same_every_time) {
  std::set<std::size_t> runs;
  std::set<Manner> manners;
  for (std::uint64_t seed = 1; seed < 60; ++seed) {
    Random random(seed), again(seed);
    const Programme one = random_programme(random, forearm());
    const Programme two = random_programme(again, forearm());
    EXPECT_EQ(one.runs.size(), two.runs.size());
    EXPECT_EQ(one.sensors.noise, two.sensors.noise);
    EXPECT_GE(degrees(one.sensors.noise), 0.005);
    EXPECT_LE(degrees(one.sensors.noise), 0.05);
    runs.insert(one.runs.size());
    for (const RunPlan& run : one.runs) manners.insert(run.manner);
  }
  EXPECT_EQ(*runs.begin(), 2u);
  EXPECT_EQ(*runs.rbegin(), 7u);
  EXPECT_EQ(manners.size(), 3u);
}

TEST(Programme, a_case_of_it_is_made_and_read_by_fusee) {
  const Case made = make_case({"backlash", {"backlash"}}, 2, {Protocol::random, true});
  EXPECT_NE(made.hidden.groove_friction, 0.2);
  Measurement measurement;
  for (const auto& [name, text] : files_of(made)) {
    if (name.ends_with(".csv")) measurement.runs.push_back(parse_run(text, name, {}, measurement));
  }
  EXPECT_EQ(measurement.runs.size(), made.plans.size());
}

TEST(Programme, random_truths_are_of_the_kind_asked_for) {
  EXPECT_TRUE(random_truth(Kind::nothing, "tuning", 1).faults.empty());
  EXPECT_EQ(random_truth(Kind::three, "tuning", 1).faults.size(), 3u);
  const Truth beside = random_truth(Kind::beside, "tuning", 4);
  ASSERT_EQ(beside.faults.size(), 2u);
  EXPECT_TRUE(has_name(beside.faults[0]));
  EXPECT_FALSE(has_name(beside.faults[1]));
  EXPECT_NE(random_truth(Kind::two, "tuning", 1).name, random_truth(Kind::two, "tuning", 2).name);
}

}  // namespace tuning
}  // namespace fusee::rig
