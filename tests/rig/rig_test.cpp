// The rig that judges calibration, judged itself: by circles, by virtual work, by hand, by the declared law, and by
// joints that another rig measured.
#include "rig/rig.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "fusee/joint/joint_model.h"
#include "fusee/measurement/measurement.h"
#include "fusee/mechanism/file.h"
#include "fusee/profile/rewind.h"
#include "fusee/transmission/load.h"
#include "fusee/transmission/transmission.h"
#include "rig/bench.h"
#include "rig/random.h"
#include "rig/string_geometry.h"
#include "support/mechanisms.h"

namespace fusee::rig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

SensorPlan silent() {
  SensorPlan sensors;
  sensors.noise = 0;
  return sensors;
}

/// One unloaded run.
Log run_of(const MadeJoint& joint, const Hidden& hidden, const SensorPlan& sensors = silent()) {
  return log_runs(joint, hidden, single_protocol(), sensors).front();
}

// ---- strings --------------------------------------------------------------------------------------------------------

Polygon circle(double radius, int corners) {
  Polygon polygon;
  for (int i = 0; i < corners; ++i) polygon.push_back(radius * unit(k_two_pi * i / corners));
  return polygon;
}

Polygon ellipse(double a, double b, int corners) {
  Polygon polygon = circle(1.0, corners);
  for (Vec2& corner : polygon) corner = {a * corner.x(), b * corner.y()};
  return polygon;
}

TEST(String, winds_on_a_circle_as_on_a_circle) {
  const Hull hull = hull_of(circle(7.0, 20000));
  const Circle pin{{15.0, 40.0}, 2.0};
  const LowerString string = lower_string(hull, pin, first_look(hull, pin));
  const double c = pin.centre.norm();
  EXPECT_NEAR(string.length, std::sqrt(c * c - 25.0), 5e-3);  // a corner may lie half a side off
  EXPECT_NEAR(string.arm, 7.0, 1e-6);
  EXPECT_NEAR(std::atan2(string.normal.y(), string.normal.x()), std::atan2(40.0, 15.0) - std::acos(5.0 / c), 2e-4);
  EXPECT_NEAR(hull.around, 7.0 * k_two_pi, 1e-5);
}

TEST(String, counts_the_arc_on_through_whole_turns) {
  const Hull hull = hull_of(circle(7.0, 720));
  const Circle pin{{15.0, 40.0}, 2.0};
  const LowerString once = lower_string(hull, pin, first_look(hull, pin));
  const LowerString later = lower_string(hull, pin, once.corner + 3 * 720);
  EXPECT_NEAR(later.arc - once.arc, 3 * hull.around, 1e-10);
  const LowerString earlier = lower_string(hull, pin, once.corner - 720);
  EXPECT_NEAR(earlier.arc - once.arc, -hull.around, 1e-10);
}

/// Length from a mark on the pin's rim to the anchor, with the pulley turned clockwise by `angle`, but for a constant.
double length_below(const Hull& hull, const Vec2& pin_from_axis, double radius, double angle) {
  const Vec2 seen = {std::cos(angle) * pin_from_axis.x() - std::sin(angle) * pin_from_axis.y(),
                     std::sin(angle) * pin_from_axis.x() + std::cos(angle) * pin_from_axis.y()};
  const Circle pin{seen, radius};
  const LowerString string = lower_string(hull, pin, first_look(hull, pin));
  return string.arc + string.length - radius * (std::atan2(string.normal.y(), string.normal.x()) - angle);
}

TEST(String, virtual_work_below_the_pin) {
  const Hull hull = hull_of(ellipse(12.0, 8.0, 40000));
  const Vec2 pin(15.0, 40.0);
  for (const double angle : {-0.6, -0.1, 0.0, 0.4, 0.7}) {
    const double h = 1e-3;
    const double winding =
        (length_below(hull, pin, 2.0, angle + h) - length_below(hull, pin, 2.0, angle - h)) / (2 * h);
    const Circle seen{
        {std::cos(angle) * 15.0 - std::sin(angle) * 40.0, std::sin(angle) * 15.0 + std::cos(angle) * 40.0}, 2.0};
    EXPECT_NEAR(winding, lower_string(hull, seen, first_look(hull, seen)).arm, 2e-3) << angle;
    EXPECT_GT(std::abs(winding - 10.0), 0.01) << "an ellipse's arm is not that of its mean circle";
  }
}

TEST(String, virtual_work_above_the_pin) {
  const Circle pin{{18.0, 14.0}, 1.4};
  const auto at = [&](double theta) { return upper_string({40.0 * std::sin(theta), 40.0 * std::cos(theta)}, pin); };
  const auto length = [&](double theta) {
    return at(theta).length + pin.radius * std::atan2(at(theta).normal.y(), at(theta).normal.x());
  };
  for (const double theta : {-0.5, 0.0, 0.5}) {
    const double h = 1e-5;
    EXPECT_NEAR(-(length(theta + h) - length(theta - h)) / (2 * h), at(theta).arm, 1e-8) << theta;
  }
}

TEST(String, bridges_a_hollow) {
  Polygon notched = circle(10.0, 360);
  for (std::size_t i = 20; i < 40; ++i) notched[i] *= 0.9;
  EXPECT_NEAR(hull_of(notched).around, hull_of(circle(10.0, 360)).around, 0.05);
  EXPECT_LT(hull_of(notched).corners.size(), 345u);
}

TEST(String, says_when_the_pin_is_within_the_pulley) {
  const Hull hull = hull_of(circle(7.0, 360));
  EXPECT_THROW(lower_string(hull, {{1.0, 2.0}, 1.0}, 0), InputError);
}

// ---- the joint as declared ------------------------------------------------------------------------------------------

/// Stiff and without friction.
DeclaredMechanism ideal(DeclaredMechanism mechanism) {
  mechanism.guides.mu = 0;
  mechanism.tendon.modulus = 1e8;
  return mechanism;
}

TEST(Rig, follows_the_declared_law_to_six_digits) {
  for (const DeclaredMechanism& mechanism : {testing::forearm(), testing::unsymmetric(), testing::linear_wrist()}) {
    const DeclaredMechanism stiff = ideal(mechanism);
    const Transmission law(stiff);
    for (const Row& row : run_of(make_joint(stiff), {})) {
      ASSERT_NEAR(row.theta, law.theta(row.alpha), 2e-6) << mechanism.name << " at " << degrees(row.alpha) << " deg";
    }
  }
}

TEST(Rig, sees_a_wrong_outline) {
  const DeclaredMechanism stiff = ideal(testing::forearm());
  MadeJoint joint = make_joint(stiff);
  for (OutlinePoint& point : joint.p1.points) point.position *= 1.001;
  const Transmission law(stiff);
  double worst = 0;
  for (const Row& row : run_of(joint, {})) worst = std::max(worst, std::abs(row.theta - law.theta(row.alpha)));
  EXPECT_GT(worst, 1e-4);
}

struct Logged {
  std::vector<std::array<double, 3>> rows;  ///< deg, deg, N
};

Logged read_log(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  Logged log;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string cell;
    std::array<double, 4> values{};
    for (double& value : values) {
      std::getline(cells, cell, ',');
      value = std::stod(cell);
    }
    log.rows.push_back({values[1], values[2], values[3]});
  }
  return log;
}

/// Rms between this rig without noise and data that another one made with 0.02° of it; the first row of a run is left
/// out, since what came before it is not told. deg
double difference(const std::string& name, const Hidden& hidden, const std::vector<RunPlan>& plans) {
  const std::filesystem::path folder = std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/data/rig" / name;
  const std::vector<Log> logs =
      log_runs(make_joint(read_mechanism(folder / "spec.toml").mechanism), hidden, plans, silent());
  double squares = 0;
  double rows = 0;
  for (std::size_t run = 0; run < logs.size(); ++run) {
    const Logged other = read_log(folder / ("run_" + std::to_string(run + 1) + ".csv"));
    EXPECT_EQ(other.rows.size(), logs[run].size());
    for (std::size_t row = 1; row < std::min(logs[run].size(), other.rows.size()); ++row) {
      EXPECT_NEAR(degrees(logs[run][row].alpha), other.rows[row][0], 1e-4);
      EXPECT_EQ(logs[run][row].load, other.rows[row][2]);
      const double miss = degrees(logs[run][row].theta) - other.rows[row][1];
      squares += miss * miss;
      rows += 1;
    }
  }
  return std::sqrt(squares / rows);
}

TEST(Rig, measures_what_another_rig_measured) {
  Hidden soft, lash, small;
  soft.modulus = 9000;
  lash.backlash = radians(2.4);
  small.pulley_scale = -0.02;
  EXPECT_LT(difference("a_declared_right", {}, full_protocol(6)), 0.0204);
  EXPECT_LT(difference("b_stretch", soft, full_protocol(6)), 0.0204);
  EXPECT_LT(difference("c_backlash", lash, full_protocol(14)), 0.0207);
  EXPECT_LT(difference("e_one_sweep_only", small, single_protocol()), 0.0206);
  EXPECT_GT(difference("b_stretch", {}, full_protocol(6)), 0.1) << "a rig that takes no notice of its faults";
}

// ---- faults, by hand ------------------------------------------------------------------------------------------------

const MadeJoint& forearm() {
  static const MadeJoint joint = make_joint(ideal(testing::forearm()));
  return joint;
}

/// Up and down strokes of the second cycle: θ of both at the row in the middle of a stroke, and the rows.
struct Middle {
  double up = 0, down = 0, slope = 0, speed = 0;
};

Middle middle_of(const Log& log) {
  const std::size_t up = 200;
  const std::size_t down = 280;
  EXPECT_NEAR(log[up].alpha, log[down].alpha, 1e-12);
  return {log[up].theta, log[down].theta,
          (log[up + 1].theta - log[up - 1].theta) / (log[up + 1].alpha - log[up - 1].alpha),
          (log[up + 1].alpha - log[up - 1].alpha) / (log[up + 1].time - log[up - 1].time)};
}

Log unloaded(const Hidden& hidden) { return run_of(forearm(), hidden); }

TEST(Fault, none_moves_nothing) {
  const Log log = unloaded({});
  const Middle middle = middle_of(log);
  EXPECT_NEAR(middle.up, middle.down, 1e-10);
}

TEST(Fault, sensors_show_what_they_should) {
  const Log plain = unloaded({});
  Hidden hidden;
  hidden.zero = 0.01;
  hidden.gain = 0.02;
  hidden.joint_eccentricity = 0.003;
  hidden.joint_eccentricity_phase = 0.4;
  hidden.interpolation = 0.001;
  const Log log = unloaded(hidden);
  for (std::size_t row = 0; row < log.size(); ++row) {
    const double t = plain[row].theta;
    EXPECT_NEAR(log[row].theta, 0.01 + 1.02 * t + 0.003 * (std::sin(t + 0.4) - std::sin(0.4)) + 0.001 * std::sin(8 * t),
                1e-12);
  }
}

TEST(Fault, waves_of_both_sensors_are_waves) {
  const Transmission law(forearm().declared);
  Hidden hidden;
  hidden.motor_harmonic = 0.01;
  hidden.motor_harmonic_phase = 0.3;
  hidden.motor_harmonic_order = 3;
  hidden.joint_harmonic = 0.002;
  hidden.joint_harmonic_phase = 1.1;
  for (const Row& row : unloaded(hidden)) {
    const double theta = law.theta(row.alpha + 0.01 * (std::sin(3 * row.alpha + 0.3) - std::sin(0.3)));
    EXPECT_NEAR(row.theta, theta + 0.002 * (std::sin(2 * theta + 1.1) - std::sin(1.1)), 3e-6);
  }
}

TEST(Fault, a_filter_is_as_late_as_a_delay_in_a_long_stroke_and_softer_at_its_ends) {
  Hidden late, filter;
  late.lag = filter.lag_filter = 0.05;
  const Log delayed = unloaded(late);
  const Log filtered = unloaded(filter);
  EXPECT_NEAR(filtered[200].theta, delayed[200].theta, 2e-5);
  Hidden slow;
  slow.lag_filter = 2.0;
  const Log plain = unloaded({});
  const Log soft = unloaded(slow);
  // From rest into a ramp: behind by τ (1 − e^(−t/τ)) times the speed, while the law is straight enough.
  const double speed = (plain[3].theta - plain[0].theta) / (plain[3].time - plain[0].time);
  const double time = plain[3].time - plain[0].time;
  const double behind = speed * 2.0 * (1.0 - std::exp(-time / 2.0));
  EXPECT_NEAR(plain[3].theta - soft[3].theta, behind, 0.02 * behind);
}

TEST(Fault, backlash_and_delay_open_loops_of_known_width) {
  Hidden lash, late;
  lash.backlash = 0.03;
  late.lag = 0.05;
  const Middle play = middle_of(unloaded(lash));
  EXPECT_NEAR((play.down - play.up) / play.slope, 0.03, 1e-4);
  const Middle delay = middle_of(unloaded(late));
  EXPECT_NEAR((delay.down - delay.up) / (delay.slope * delay.speed), 2 * 0.05, 1e-3);
}

TEST(Fault, the_motor_stands_elsewhere) {
  const Transmission law(forearm().declared);
  Hidden hidden;
  hidden.motor_offset = 0.01;
  hidden.motor_eccentricity = 0.02;
  hidden.motor_eccentricity_phase = 0.7;
  hidden.cogging = 0.004;
  for (const Row& row : unloaded(hidden)) {
    const double shaft =
        row.alpha + 0.01 + 0.02 * (std::sin(row.alpha + 0.7) - std::sin(0.7)) + 0.004 * std::sin(30 * row.alpha);
    EXPECT_NEAR(row.theta, law.theta(shaft), 3e-6);
  }
}

TEST(Fault, a_larger_pulley_turns_the_joint_further) {
  const Transmission law(forearm().declared);
  Hidden offset, scale;
  offset.radius_offset = 0.1;
  scale.pulley_scale = 0.005;
  const Log with_offset = unloaded(offset);
  const Log with_scale = unloaded(scale);
  for (const std::size_t row : {100u, 130u, 150u}) {
    // Stiff tendons share what they disagree on: only the mean of both sides is known by hand.
    const TransmissionPoint at = law.at_alpha(with_offset[row].alpha);
    const double arm = 0.5 * (at.t1.m + at.t2.m);
    EXPECT_NEAR(with_offset[row].theta - at.theta, 0.1 * at.alpha / arm, 0.03 * std::abs(0.1 * at.alpha / arm) + 1e-5);
    EXPECT_NEAR(with_scale[row].theta - at.theta, 0.005 * at.theta, 0.08 * 0.005 * std::abs(at.theta) + 1e-5);
  }
}

/// How a fault of the geometry is told to rewind(), which takes mechanisms and groove floors.
struct Twin {
  const char* name;
  Hidden hidden;
  DeclaredMechanism mechanism;
  std::function<Vec2(const OutlinePoint&)> floor;
};

std::vector<Twin> twins() {
  const DeclaredMechanism declared = forearm().declared;
  const double half = 0.5 * declared.tendon.diameter;
  const auto as_made = [half](const OutlinePoint& point) -> Vec2 { return point.position - half * point.normal; };
  std::vector<Twin> all(7, {"", {}, declared, as_made});
  all[0].name = "guide radius";
  all[0].hidden.guide_radius = all[0].mechanism.guides.radius = 1.0;
  all[0].mechanism.guides.radius += declared.guides.radius;
  all[1].name = "guide position";
  all[1].hidden.guide_outward = 0.7;
  all[1].hidden.guide_down = -0.4;
  all[1].mechanism.guides.EB += 0.7;
  all[1].mechanism.guides.ED += 0.7;
  all[1].mechanism.guides.OE -= 0.4;
  all[1].mechanism.pulley.EF += 0.4;
  all[2].name = "joint length";
  all[2].hidden.joint_length = all[2].mechanism.joint.R = 1.5;
  all[2].mechanism.joint.R += declared.joint.R;
  all[3].name = "radius offset";
  all[3].hidden.radius_offset = 0.3;
  all[3].floor = [=](const OutlinePoint& point) -> Vec2 { return as_made(point) + 0.3 * point.normal; };
  all[4].name = "pulley scale";
  all[4].hidden.pulley_scale = -0.02;
  all[4].floor = [=](const OutlinePoint& point) -> Vec2 { return 0.98 * point.position - half * point.normal; };
  all[5].name = "runout";
  all[5].hidden.runout_x = 0.3;
  all[5].hidden.runout_y = -0.2;
  all[5].floor = [=](const OutlinePoint& point) -> Vec2 { return as_made(point) + Vec2(0.3, -0.2); };
  all[6].name = "profile error";
  all[6].hidden.profile_error = 0.2;
  all[6].hidden.profile_harmonic = 3;
  all[6].hidden.profile_phase = 0.5;
  all[6].floor = [=](const OutlinePoint& point) -> Vec2 {
    return as_made(point) + 0.2 * std::cos(3 * point.psi + 0.5) * point.normal;
  };
  return all;
}

Polygon floor_of(const Outline& outline, const Twin& twin) {
  Polygon floor;
  for (const OutlinePoint& point : outline.points) floor.push_back(twin.floor(point));
  return floor;
}

/// With tendon 1 carrying alone, the joint stands where an inextensible tendon 1 holds it: what rewind() finds.
TEST(Fault, a_wrong_geometry_does_what_rewinding_it_does) {
  for (const Twin& twin : twins()) {
    Bench bench(forearm(), twin.hidden);
    Conditions at;
    at.load = -1.0;
    at.let_go[1] = 30.0;
    double moved = 0;
    const RewindResult expected =
        rewind(twin.mechanism, floor_of(forearm().p1, twin), floor_of(forearm().p2, twin), 60);
    for (const RewindPoint& point : expected.points) {
      EXPECT_NEAR(bench.to(point.alpha, point.alpha, at), point.theta, 1e-5)
          << twin.name << " at " << degrees(point.alpha);
      moved = std::max(moved, std::abs(point.theta - Transmission(forearm().declared).theta(point.alpha)));
    }
    EXPECT_GT(moved, 1e-3) << twin.name << ": a twin that is no different tells nothing";
  }
}

/// Each pin by itself is a mechanism of its own.
TEST(Fault, one_pin_out_of_place_moves_its_own_tendon) {
  Hidden left;
  left.pin_outward[0] = 0.7;
  left.pin_down[0] = -0.4;
  DeclaredMechanism twin = forearm().declared;
  twin.guides.EB += 0.7;
  twin.guides.OE -= 0.4;
  twin.pulley.EF += 0.4;
  Twin unmoved{"", {}, twin, {}};
  unmoved.floor = [&](const OutlinePoint& point) -> Vec2 {
    return point.position - 0.5 * twin.tendon.diameter * point.normal;
  };
  Bench bench(forearm(), left);
  Conditions at;
  at.load = -1.0;
  at.let_go[1] = 30.0;
  for (const RewindPoint& point :
       rewind(twin, floor_of(forearm().p1, unmoved), floor_of(forearm().p2, unmoved), 20).points)
    EXPECT_NEAR(bench.to(point.alpha, point.alpha, at), point.theta, 1e-5);
}

/// What lies in the groove stays as it was laid: the springs that give are the free spans.
Hidden held(Hidden hidden = {}) {
  hidden.groove_friction = 1e3;
  return hidden;
}
/// What lies in the groove slides up to the knot.
Hidden sliding(Hidden hidden = {}) {
  hidden.groove_friction = 0;
  return hidden;
}

/// At home, both tendons taut, no friction.
DeclaredMechanism elastic() {
  DeclaredMechanism mechanism = testing::forearm();
  mechanism.guides.mu = 0;
  mechanism.tendon.pretension = 20;
  return mechanism;
}

/// Torque per angle of both tendons at home, but for what the arms change. N·mm/rad
double stiffness_by_hand(const DeclaredMechanism& mechanism, double modulus) {
  const TransmissionPoint home = Transmission(mechanism).at_alpha(0.0);
  const double EA = modulus * 0.25 * k_pi * mechanism.tendon.diameter * mechanism.tendon.diameter;
  return EA * (home.t1.m * home.t1.m / home.t1.length + home.t2.m * home.t2.m / home.t2.length);
}

TEST(Fault, a_frame_gives_as_much_as_the_pins_are_pushed) {
  const MadeJoint joint = make_joint(elastic());
  Hidden hidden;
  hidden.frame_give = 2e-3;
  Bench bench(joint, hidden);
  Conditions at;
  at.load = 1.0;
  const TransmissionPoint home = Transmission(joint.declared).at_alpha(0.0);
  const double EA = section_stiffness(joint.declared.tendon);
  double stiffness = 0;
  for (const TendonPoint& tendon : {home.t1, home.t2}) {
    const double push = 2.0 * std::sin(0.5 * tendon.wrap);  // per tension, along the bisector
    stiffness += tendon.m * tendon.m / (tendon.length / EA + 2e-3 * push * push);
  }
  EXPECT_NEAR(bench.to(0.0, 0.0, at), -100.0 / stiffness, 0.01 * 100.0 / stiffness);
  EXPECT_LT(stiffness, 0.75 * stiffness_by_hand(joint.declared, joint.declared.tendon.modulus)) << "it shows";
}

TEST(Fault, a_pulley_beds_in_over_the_first_strokes) {
  const Transmission law(forearm().declared);
  Hidden hidden;
  hidden.bedding = 0.02;
  const Log log = unloaded(hidden);
  const double half_stroke = 0.5 * (log[80].alpha - log[0].alpha);
  for (const std::size_t row : {0u, 40u, 80u, 160u, 320u}) {
    const double travel = half_stroke * static_cast<double>(row) / 40.0;
    EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + 0.02 * std::exp(-travel / half_stroke)), 3e-6) << row;
  }
}

TEST(Fault, a_zero_walks_at_reversals_alone) {
  const Log plain = unloaded({});
  Hidden hidden;
  hidden.zero_walk = 0.01;
  const Log log = unloaded(hidden);
  const auto off = [&](std::size_t row) { return log[row].theta - plain[row].theta; };
  for (std::size_t stroke = 0; stroke < 4; ++stroke) {
    EXPECT_NEAR(off(80 * stroke + 1), off(80 * stroke + 79), 1e-12);
    if (stroke > 0) {
      EXPECT_GT(std::abs(off(80 * stroke + 1) - off(80 * stroke - 1)), 1e-5);
    }
  }
}

TEST(Fault, a_load_stretches_the_tendons_as_by_hand) {
  const MadeJoint joint = make_joint(elastic());
  for (const double modulus : {40000.0, 10000.0}) {
    Hidden hidden;
    hidden.modulus = modulus;
    Bench bench(joint, held(hidden));
    Conditions at;
    EXPECT_NEAR(bench.to(0.0, 0.0, at), 0.0, 1e-9);
    at.load = 3.0;
    const double by_hand = 3.0 * 100.0 / stiffness_by_hand(joint.declared, modulus);
    EXPECT_NEAR(bench.to(0.0, 0.0, at), -by_hand, 0.01 * by_hand);
    EXPECT_GT(bench.tendon(1).upper_tension, 20.0);
    EXPECT_LT(bench.tendon(0).upper_tension, 20.0);
    at.load = 0.0;
    EXPECT_NEAR(bench.to(0.0, 0.0, at), 0.0, 1e-9) << "no friction: nothing stays";
  }
}

TEST(Fault, a_groove_without_friction_makes_the_tendon_longer_and_a_rubbing_one_makes_it_less_so) {
  const MadeJoint joint = make_joint(elastic());
  const TransmissionPoint home = Transmission(joint.declared).at_alpha(0.0);
  const double EA = section_stiffness(joint.declared.tendon);
  const auto under_load = [&](double friction) {
    Hidden hidden;
    hidden.groove_friction = friction;
    Bench bench(joint, hidden);
    Conditions at;
    at.load = 3.0;
    return -bench.to(0.0, 0.0, at);
  };
  double stiffness = 0;
  const Bench bench(joint, sliding());
  for (const std::size_t side : {0u, 1u}) {
    const TendonPoint& tendon = side == 0 ? home.t1 : home.t2;
    stiffness += EA * tendon.m * tendon.m / (tendon.length + bench.tendon(side).laid.length());
  }
  const double longer = 300.0 / stiffness;
  EXPECT_NEAR(under_load(0.0), longer, 0.01 * longer);
  EXPECT_NEAR(under_load(1e3), 300.0 / stiffness_by_hand(joint.declared, joint.declared.tendon.modulus), 0.01 * longer);
  EXPECT_LT(under_load(0.2), 0.9 * longer);
  EXPECT_GT(under_load(0.2), 1.01 * under_load(1e3));
}

TEST(Fault, creep_adds_its_share_with_every_decade_and_remembers) {
  const MadeJoint joint = make_joint(elastic());
  Hidden hidden;
  hidden.creep = 0.2;
  Bench bench(joint, held(hidden));
  Conditions at;
  at.load = 3.0;
  at.seconds = 1e-6;
  const double first = bench.to(0.0, 0.0, at);
  const auto after = [&](double load, int seconds) {
    at.load = load;
    at.seconds = 1.0;
    double theta = 0;
    for (int i = 0; i < seconds; ++i) theta = bench.to(0.0, 0.0, at);
    return theta / first;
  };
  // What the springs of five decades have given by then.
  const auto given = [](double time) {
    double all = 0;
    for (double decade = 3.16; decade < 1e5; decade *= 10.0) all += 1.0 - std::exp(-time / decade);
    return all;
  };
  EXPECT_NEAR(after(3.0, 100), 1.0 + 0.2 * given(99.0), 0.01);
  EXPECT_NEAR(after(3.0, 900), 1.0 + 0.2 * given(999.0), 0.01);
  EXPECT_NEAR(given(1e3) - given(1e2), 1.0, 0.1) << "a decade is a decade";
  EXPECT_NEAR(after(0.0, 101), 0.2 * (given(1100.0) - given(100.0)), 0.015) << "let go, it comes back by decades too";
}

TEST(Fault, a_tendon_that_carries_alone_lets_the_joint_down_by_what_it_slips) {
  const MadeJoint joint = make_joint(elastic());
  Bench bench(joint, sliding());
  Conditions at;
  at.load = 60.0;  // tendon 1 is slack
  const double before = bench.to(0.0, 0.0, at);
  EXPECT_EQ(bench.tendon(0).upper_tension, 0.0);
  at.let_go[1] = 0.2;
  const double arm = Transmission(joint.declared).at_theta(before).t2.m;
  EXPECT_NEAR(before - bench.to(0.0, 0.0, at), 0.2 / arm, 0.01 * 0.2 / arm);
}

TEST(Fault, a_warm_tendon_that_carries_alone_grows) {
  const MadeJoint joint = make_joint(elastic());
  Hidden hidden;
  hidden.expansion = 5e-5;
  Bench bench(joint, sliding(hidden));
  Conditions at;
  at.load = 60.0;
  const double before = bench.to(0.0, 0.0, at);
  at.warmth = 10.0;
  const TendonPoint right = Transmission(joint.declared).at_theta(before).t2;
  const double by_hand = 5e-5 * 10.0 * (right.length + bench.tendon(1).laid.length()) / right.m;
  EXPECT_NEAR(before - bench.to(0.0, 0.0, at), by_hand, 0.02 * by_hand);
}

TEST(Fault, gravity_is_a_load_that_turns_with_the_joint) {
  const MadeJoint joint = make_joint(elastic());
  Hidden hidden;
  hidden.gravity = 300.0;
  hidden.gravity_direction = 0.5 * k_pi;
  Bench heavy(joint, hidden), loaded(joint, {});
  Conditions none, three;
  three.load = 3.0;
  EXPECT_NEAR(heavy.to(0.0, 0.0, none), loaded.to(0.0, 0.0, three), 1e-8);
  hidden.gravity_direction = 0;
  EXPECT_NEAR(Bench(joint, hidden).to(0.0, 0.0, none), 0.0, 1e-9) << "hanging straight above the axis";
}

TEST(Fault, slack_is_lost_motion_and_the_joint_stays_where_it_was_left) {
  DeclaredMechanism declared = elastic();
  const MadeJoint joint = make_joint(declared);
  Hidden hidden;
  hidden.slack = 0.5;
  Bench bench(joint, hidden);
  Conditions at;
  EXPECT_EQ(bench.to(0.0, 0.0, at), 0.0);
  at.load = 0.01;
  const double low = bench.to(0.0, 0.0, at);
  at.load = 0.0;
  EXPECT_NEAR(bench.to(0.0, 0.0, at), low, 1e-5);
  at.load = -0.01;
  const double high = bench.to(0.0, 0.0, at);
  const double arm = Transmission(declared).at_alpha(0.0).t2.m;
  EXPECT_NEAR(high - low, 0.5 / arm, 0.02 * 0.5 / arm);
}

TEST(Fault, friction_over_a_pin_comes_to_the_capstan_ratio_and_not_beyond) {
  DeclaredMechanism declared = testing::forearm();
  declared.guides.mu = 0.3;
  const MadeJoint joint = make_joint(declared);
  Bench bench(joint, {});
  Conditions at;
  const Transmission law(declared);
  for (int step = 1; step <= 60; ++step) {
    const double alpha = 0.01 * step;
    bench.to(alpha, alpha, at);
    const TransmissionPoint point = law.at_theta(bench.theta());
    for (const std::size_t side : {0u, 1u}) {
      const double limit = 0.3 * (side == 0 ? point.t1.wrap : point.t2.wrap);
      const double used = std::log(bench.tendon(side).lower_tension / bench.tendon(side).upper_tension);
      EXPECT_LE(std::abs(used), limit * 1.0001);
      // Tendon 2 is pulled down over its pin, tendon 1 is pulled up.
      if (step > 30) {
        EXPECT_NEAR(used, side == 1 ? limit : -limit, 1e-3 * limit);
      }
    }
  }
}

/// Work of motor and load over the second of two cycles of ±0.5 rad under 5 N.
struct CycleWork {
  double motor = 0, load = 0;
};
CycleWork work_of_a_cycle(const MadeJoint& joint, const Hidden& hidden) {
  Bench bench(joint, hidden);
  const auto motor_torque = [&](double alpha) {
    double torque = 0;
    for (const std::size_t side : {0u, 1u}) {
      const BenchTendon& tendon = bench.tendon(side);
      const Vec2 pin = tendon.pin.centre - tendon.axis;
      const double turn = tendon.sign * alpha;
      const Circle seen{
          {std::cos(turn) * pin.x() - std::sin(turn) * pin.y(), std::sin(turn) * pin.x() + std::cos(turn) * pin.y()},
          tendon.pin.radius};
      torque += tendon.sign * tendon.lower_tension * lower_string(tendon.hull, seen, tendon.corner).arm;
    }
    return torque;
  };
  constexpr int quarter = 200;
  const auto alpha_at = [](int step) { return 0.5 * std::sin(0.5 * k_pi * step / quarter); };
  CycleWork work;
  Conditions at;
  at.load = 5.0;
  bench.to(0.0, 0.0, at);
  for (int step = 1; step <= 8 * quarter; ++step) {
    const double before = motor_torque(alpha_at(step - 1));
    const double theta = bench.theta();
    bench.to(alpha_at(step), alpha_at(step), at);
    if (step <= 4 * quarter) continue;
    work.motor += 0.5 * (before + motor_torque(alpha_at(step))) * (alpha_at(step) - alpha_at(step - 1));
    work.load += at.load * 100.0 * (bench.theta() - theta);
  }
  return work;
}

TEST(Fault, no_friction_gives_back_all_work) {
  const MadeJoint joint = make_joint(elastic());
  for (const double mu : {0.0, 0.2}) {
    Hidden hidden;
    hidden.friction = mu;
    const CycleWork work = work_of_a_cycle(joint, held(hidden));
    EXPECT_NEAR(work.load, 0.0, 1e-3);
    // Both tendons over their pins, four times the swing a cycle.
    const TransmissionPoint home = Transmission(joint.declared).at_alpha(0.0);
    const double swing = Transmission(joint.declared).theta(0.5);
    const double by_hand = 20.0 * mu * (home.t1.wrap * home.t1.m + home.t2.wrap * home.t2.m) * 4.0 * swing;
    EXPECT_NEAR(work.motor, by_hand, 0.1 * by_hand + 0.05);
  }
}

/// Of a load that goes ±8 N round at a motor that stands, second time. N·mm
double work_of_a_load_cycle(const MadeJoint& joint, const Hidden& hidden) {
  Bench bench(joint, hidden);
  double work = 0;
  Conditions at;
  constexpr int quarter = 100;
  for (int step = 1; step <= 8 * quarter; ++step) {
    const double theta = bench.theta();
    const double before = at.load;
    at.load = 8.0 * std::sin(0.5 * k_pi * step / quarter);
    bench.to(0.0, 0.0, at);
    if (step > 4 * quarter) work -= 0.5 * (before + at.load) * joint.declared.joint.R * (bench.theta() - theta);
  }
  return work;
}

TEST(Fault, a_groove_takes_work_and_gives_none) {
  DeclaredMechanism soft = elastic();
  soft.tendon.modulus = 2000;
  const MadeJoint joint = make_joint(soft);
  EXPECT_NEAR(work_of_a_load_cycle(joint, held()), 0.0, 1e-3);
  EXPECT_NEAR(work_of_a_load_cycle(joint, sliding()), 0.0, 1e-3);
  for (const double friction : {0.02, 0.1, 0.3}) {
    Hidden hidden;
    hidden.groove_friction = friction;
    EXPECT_GT(work_of_a_load_cycle(joint, hidden), 0.1) << friction;
    EXPECT_GT(work_of_a_cycle(joint, hidden).motor, -1e-3) << friction;
  }
}

TEST(Fault, a_sticking_bearing_holds_until_it_is_pulled_enough) {
  const MadeJoint joint = make_joint(elastic());
  Hidden hidden;
  hidden.bearing = 100;
  hidden.bearing_stick = 50;
  Bench bench(joint, held(hidden));
  Conditions at;
  at.load = 1.4;  // 140 N mm
  EXPECT_EQ(bench.to(0.0, 0.0, at), 0.0);
  at.load = 3.0;
  const double by_hand = (300.0 - 150.0) / stiffness_by_hand(joint.declared, joint.declared.tendon.modulus);
  EXPECT_NEAR(bench.to(0.0, 0.0, at), -by_hand, 0.01 * by_hand);
}

TEST(Fault, a_hardening_tendon_is_as_declared_at_its_pretension_alone) {
  const MadeJoint joint = make_joint(elastic());
  Hidden hidden;
  hidden.hardening = 1e-3;
  Bench hard(joint, hidden), plain(joint, {});
  Conditions at;
  EXPECT_NEAR(hard.to(0.0, 0.0, at), 0.0, 1e-9);
  at.load = 0.5;
  EXPECT_NEAR(hard.to(0.0, 0.0, at) / plain.to(0.0, 0.0, at), 1.0, 0.01);
  at.load = 60.0;
  EXPECT_LT(hard.to(0.0, 0.0, at) / plain.to(0.0, 0.0, at), 0.95);
}

TEST(Fault, a_lump_moves_the_joint_where_it_is) {
  Hidden hidden;
  hidden.lump = 0.1;
  hidden.lump_at = radians(40);
  hidden.lump_width = radians(5);
  const Transmission law(forearm().declared);
  const double arm = law.at_alpha(radians(40)).t2.m;
  double most = 0;
  for (const Row& row : unloaded(hidden)) {
    const double moved = row.theta - law.theta(row.alpha);
    most = std::max(most, moved);
    if (std::abs(row.alpha - radians(40)) > radians(25)) {
      EXPECT_NEAR(moved, 0.0, 3e-6);
    }
  }
  EXPECT_NEAR(most, 0.1 / arm, 0.06 * 0.1 / arm);
}

// ---- sensors and protocols ------------------------------------------------------------------------------------------

TEST(Random, is_splitmix64) {
  Random random(0);
  EXPECT_EQ(random.bits(), 0xE220A8397B1DCDAFULL);
  EXPECT_EQ(random.bits(), 0x6E789E6AA1B965F4ULL);
}

TEST(Random, normal_numbers_are_normal) {
  Random random(7);
  double sum = 0, squares = 0, fourth = 0;
  constexpr int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.01);
  EXPECT_NEAR(squares / count, 1.0, 0.01);
  EXPECT_NEAR(fourth / count, 3.0, 0.05);
}

struct NoiseFigures {
  double rms = 0, lag1 = 0;
};

NoiseFigures noise_of(const SensorPlan& sensors) {
  const Log plain = unloaded({});
  const Log noisy = run_of(forearm(), {}, sensors);
  double squares = 0, products = 0;
  for (std::size_t row = 0; row < plain.size(); ++row) {
    const double now = noisy[row].theta - plain[row].theta;
    squares += now * now;
    if (row > 0) products += now * (noisy[row - 1].theta - plain[row - 1].theta);
  }
  return {std::sqrt(squares / static_cast<double>(plain.size())), products / squares};
}

TEST(Sensors, noise_has_the_size_and_colour_asked_for) {
  SensorPlan sensors;
  const NoiseFigures white = noise_of(sensors);
  EXPECT_NEAR(degrees(white.rms), 0.02, 0.0025);
  EXPECT_NEAR(white.lag1, 0.0, 0.15);
  sensors.colour = 0.8;
  const NoiseFigures coloured = noise_of(sensors);
  EXPECT_NEAR(degrees(coloured.rms), 0.02, 0.005);
  EXPECT_NEAR(coloured.lag1, 0.8, 0.1);
}

TEST(Sensors, a_coarse_sensor_has_steps) {
  SensorPlan sensors;
  sensors.quantum = radians(0.05);
  for (const Row& row : run_of(forearm(), {}, sensors)) {
    const double steps = degrees(row.theta) / 0.05;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
}

TEST(Rig, is_the_same_every_time) {
  Hidden hidden;
  hidden.zero_walk = 0.001;
  SensorPlan sensors;
  const auto text = [&] { return csv_text(run_of(forearm(), hidden, sensors), true); };
  const std::string once = text();
  EXPECT_EQ(once, text());
  sensors.seed = 2;
  EXPECT_NE(once, text());
}

TEST(Rig, a_run_has_the_strokes_the_speed_and_the_dwell_it_was_planned_with) {
  const Log log = log_runs(forearm(), {}, {{0.0, radians(30.0), 2, 4.0}}, silent())[0];
  ASSERT_EQ(log.size(), 1u + 4 * (80 + 10));
  EXPECT_NEAR((log[1].alpha - log[0].alpha) / (log[1].time - log[0].time), radians(30.0), 1e-9);
  EXPECT_EQ(log[80].alpha, log[90].alpha);
  EXPECT_NEAR(log[90].time - log[80].time, 4.0, 1e-9);
  EXPECT_LT(log[91].alpha, log[90].alpha);
}

TEST(Rig, its_files_are_read_by_fusee) {
  const std::vector<Log> logs = log_runs(forearm(), {}, full_protocol(6.0));
  Measurement measurement;
  const fusee::Run run = parse_run(csv_text(logs[1], true), "run_2.csv", {}, measurement);
  EXPECT_EQ(run.samples.size(), logs[1].size());
  EXPECT_TRUE(run.has_time && run.has_load && run.has_temperature);
  EXPECT_EQ(run.strokes.size(), 6u);
  EXPECT_NEAR(run.mean_load, 6.0, 1e-9);
  EXPECT_NEAR(degrees(run.speed), 12.0, 0.01);
}

TEST(Rig, shares_no_equation_with_what_it_judges) {
  for (const char* name : {"string_geometry.h", "string_geometry.cpp", "cord.h", "groove_chain.h", "groove_chain.cpp",
                           "bench.h", "bench.cpp", "rig.h", "rig.cpp"}) {
    std::ifstream file(std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/rig" / name);
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_THAT(text.str(), HasSubstr("namespace fusee::rig")) << name;
    EXPECT_THAT(text.str(), Not(HasSubstr("calibration/"))) << name;
    EXPECT_THAT(text.str(), Not(HasSubstr("transmission/"))) << name;
  }
}

}  // namespace
}  // namespace fusee::rig
