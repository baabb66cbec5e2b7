// The split that is kept aside: each fault is what it says, by hand.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "fusee/transmission/transmission.h"
#include "rig/bench.h"
#include "rig/fault_checks.h"

namespace fusee::rig {
namespace unseen {

// ---- one by one, by hand --------------------------------------------------------------------------------------------

TEST(Unseen, a_gap_in_the_scale_is_one_step) {
  const Transmission law(stiff().declared);
  const double at = alpha_within(k_middle, stiff());
  for (const Row& row : run_of(with("glued_scale", 0.05, stiff()), {0.0, radians(12.0), 1}, stiff())) {
    const double shaft = row.alpha + 0.05 * ((row.alpha > at ? 1.0 : 0.0) - (0.0 > at ? 1.0 : 0.0));
    EXPECT_NEAR(row.theta, law.theta(shaft), 5e-6);
  }
}

TEST(Unseen, an_integrator_unwinds_with_time_at_any_speed) {
  const Transmission law(stiff().declared);
  const double constant = 0.3 + 1.7 * k_middle.share;
  for (const double speed : {radians(12.0), radians(90.0)}) {
    const Log log = run_of(with("integrator_windup", 0.05, stiff()), {0.0, speed, 1}, stiff());
    for (std::size_t row = 81; row < log.size(); ++row) {
      // The step in which it reverses counts.
      const double behind = 0.05 * std::exp(-(log[row].time - log[80].time) / constant);
      EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + behind), 5e-6) << row;
    }
  }
}

TEST(Unseen, a_spider_gives_by_the_load_and_saturates) {
  const Transmission law(stiff().declared);
  for (const double load : {0.0, 10.0, -30.0}) {
    const double turned = -0.1 * load / (10.0 + std::abs(load));
    for (const Row& row : run_of(with("rubber_coupling", 0.1, stiff()), {load, radians(12.0), 1}, stiff()))
      EXPECT_NEAR(row.theta, law.theta(row.alpha + turned), 2e-4) << load;
  }
}

TEST(Unseen, a_bolt_holds_below_its_threshold_and_opens_by_its_play) {
  for (const auto& [load, turned] : {std::pair{5.0, 0.0}, {11.0, -0.01}, {-11.0, 0.01}, {30.0, -0.02}}) {
    const RunPlan plan{load, radians(12.0), 1};
    const Log plain = run_of({}, plan, soft()), loose = run_of(with("loose_link_bolt", 0.02, soft()), plan, soft());
    for (std::size_t row = 0; row < plain.size(); ++row)
      EXPECT_NEAR(loose[row].theta - plain[row].theta, turned, 1e-9) << load;
  }
}

/// A weight that leans as far as the link has turned keeps its direction: its torque is W R cos(θ + lean at home).
TEST(Unseen, a_hanging_weight_keeps_its_direction) {
  const Fault& fault = find_fault("hanging_weight");
  Hidden hidden;
  fault.set(hidden, 1.0, {1.0, 0.4, 0.0}, soft());
  Moment now;
  now.load = 7.0;
  std::vector<double> none;
  const double lean = 0.5 * std::sin(0.4);
  const double weight = 7.0 / std::cos(lean);
  for (now.theta = -0.5; now.theta < 0.5; now.theta += 0.1) {
    const Vec2 along(std::cos(lean), std::sin(lean));              // fixed in the frame
    const Vec2 across(std::cos(now.theta), -std::sin(now.theta));  // of the link
    EXPECT_NEAR(now.load + hidden.load[0].act(now, hidden.load[0].numbers, none), weight * along.dot(across), 1e-12);
  }
}

TEST(Unseen, a_tired_cell_is_right_at_small_loads) {
  const RunPlan small{5.0, radians(12.0), 1}, great{15.0, radians(12.0), 1};
  const Hidden tired = with("tired_load_cell", 0.5, soft());
  EXPECT_EQ(csv_text(run_of(tired, small, soft())), csv_text(run_of({}, small, soft())));
  const Log log = run_of(tired, great, soft());
  const Log truly = run_of({}, {21.75, radians(12.0), 1}, soft());  // 15 + 0.5 · 9² / 6
  for (std::size_t row = 0; row < log.size(); ++row) EXPECT_NEAR(log[row].theta, truly[row].theta, 1e-3);
}

TEST(Unseen, a_worn_track_shows_where_contact_was_lost) {
  const Log plain = run_of({}, {0.0, radians(12.0), 1}, stiff());
  const Log worn = run_of(with("worn_track", 0.1, stiff()), {0.0, radians(12.0), 1}, stiff());
  const double middle = theta_within(k_middle, stiff());
  int across = 0;
  for (std::size_t row = 1; row < plain.size(); ++row) {
    const double theta = plain[row].theta;
    const bool off = std::abs(theta - middle) < 0.05;
    const double edge = middle + (row <= 80 ? -0.05 : 0.05);
    EXPECT_NEAR(worn[row].theta, off ? edge : theta, 1e-9) << row;
    across += off ? 1 : 0;
  }
  EXPECT_GT(across, 8);
}

/// x'' + 2 x'/τ + (ω² + 1/τ²) x = 0 after each blow, by small steps.
TEST(Unseen, a_struck_link_rings_as_a_mass_on_a_spring) {
  const Hidden hidden = with("ringing_link", 0.05, soft());
  const Action& ringing = hidden.reading.at(0);
  const double omega = ringing.numbers[1], rate = 1.0 / ringing.numbers[2];
  std::vector<double> memory;
  Moment now;
  double x = 0, v = 0, struck = 0;
  for (int row = 0; row < 60; ++row) {
    now.time = 0.03 * row;
    now.alpha_speed = row < 20 ? 0.4 : row < 35 ? -0.4 : 0.0;
    if (row == 0) struck = now.alpha_speed;
    EXPECT_NEAR(ringing.act(now, ringing.numbers, memory), x, 1e-5) << row;
    v -= 0.05 * omega * (now.alpha_speed - struck);
    struck = now.alpha_speed;
    constexpr int steps = 3000;
    for (int i = 0; i < steps; ++i) {
      const double h = 0.03 / steps;
      v += h * (-2 * rate * v - (omega * omega + rate * rate) * x);
      x += h * v;
    }
  }
}

/// The work of the tendon's pressure on a rim that stands out by e cos 6(φ − φ0), summed over the wrap.
TEST(Unseen, a_hexagon_lengthens_the_way_by_what_its_rim_stands_out) {
  const Hidden hidden = with("hexagonal_pin", 0.5, soft());
  const Action& hexagon = hidden.longer[1].at(0);
  const double first = -1.4;
  std::vector<double> memory;
  Moment now;
  for (const double last : {first, -1.2, -0.9, -0.5}) {
    now.pull[1] = {std::cos(last), std::sin(last)};
    double by_hand = 0;
    constexpr int steps = 2000;
    for (int i = 0; i < steps; ++i) {
      const double phi = first + (last - first) * (i + 0.5) / steps;
      by_hand += 0.5 * std::cos(6 * (phi - hexagon.numbers[1])) * (last - first) / steps;
    }
    EXPECT_NEAR(hexagon.act(now, hexagon.numbers, memory), by_hand, 1e-6);
  }
}

/// What a loop of the tension costs: each third of the play, its width times twice the tension's way less that width.
TEST(Unseen, strands_that_rub_take_energy_in_a_loop_and_leave_none_behind) {
  const Hidden hidden = with("rubbing_strands", 0.5, soft());
  const Action& rub = hidden.longer[1].at(0);
  std::vector<double> memory;
  Moment now;
  double lost = 0, way = 0;
  const auto to = [&](double tension, bool count) {
    constexpr int steps = 4000;
    const double from = now.tension[1];
    for (int i = 1; i <= steps; ++i) {
      now.tension[1] = from + (tension - from) * i / steps;
      const double next = -rub.act(now, rub.numbers, memory);
      if (count) lost += now.tension[1] * (next - way);
      way = next;
    }
  };
  now.tension[1] = 20.0;
  to(50.0, false);
  to(10.0, false);
  const double begin = way;
  to(50.0, true);
  to(10.0, true);
  double by_hand = 0;
  for (std::size_t i = 1; i < 4; ++i)
    by_hand += rub.numbers[0] / 3.0 * 2.0 * rub.numbers[i] * std::max(0.0, 40.0 - 2.0 * rub.numbers[i]);
  EXPECT_NEAR(way, begin, 1e-12) << "the loop is closed";
  EXPECT_NEAR(lost, by_hand, 2e-3 * by_hand);
}

TEST(Unseen, a_braid_opens_when_loose_and_closes_by_way_alone) {
  const Hidden hidden = with("opening_braid", 0.4, soft());
  const Action& braid = hidden.longer[0].at(0);
  std::vector<double> memory;
  Moment now;
  const auto shorter = [&](double tension, double alpha) {
    now.tension[0] = tension;
    now.alpha = alpha;
    return braid.act(now, braid.numbers, memory);
  };
  shorter(20.0, 0.0);
  EXPECT_EQ(shorter(20.0, 0.5), 0.0);
  EXPECT_DOUBLE_EQ(shorter(0.0, 0.5), 0.4);
  now.seconds = 1e4;
  EXPECT_DOUBLE_EQ(shorter(20.0, 0.5), 0.4) << "time closes nothing";
  EXPECT_NEAR(shorter(20.0, 0.5 - braid.numbers[2]), 0.4 * std::exp(-1.0), 1e-12);
}

TEST(Unseen, a_pin_rolls_so_far_and_then_slips) {
  const Hidden hidden = with("rolling_pin", 0.3, soft());
  const Action& pin = hidden.longer[1].at(0);
  std::vector<double> memory;
  Moment now;
  const auto at = [&](double rolled) {
    now.theta = rolled / pin.numbers[3];
    return pin.act(now, pin.numbers, memory);
  };
  const auto wave = [&](double turned) { return 0.3 * (std::sin(turned + 1.0) - std::sin(1.0)); };
  const double most = pin.numbers[2];
  at(0.0);
  EXPECT_NEAR(at(1.0), wave(1.0), 1e-12);
  EXPECT_NEAR(at(7.0), wave(most), 1e-12) << "it slips";
  EXPECT_NEAR(at(7.0 - most), wave(0.0), 1e-12);
  EXPECT_NEAR(at(-3.0), wave(-most), 1e-12);
}

TEST(Unseen, a_cable_takes_energy_in_a_loop) {
  const Hidden hidden = with("cable_drag", 200.0, soft());
  const Action& cable = hidden.torque.at(0);
  std::vector<double> memory;
  Moment now;
  double work = 0;
  for (int i = 0; i <= 40000; ++i) {
    const double before = now.theta;
    now.theta = 0.1 + 0.3 * std::sin(k_two_pi * i / 20000);
    const double torque = cable.act(now, cable.numbers, memory);
    if (i > 20000) work -= torque * (now.theta - before);
  }
  // Over 0.1 ± 0.3 rad its drag is 200 (0.2 + end − θ), there and back, but for the turning round.
  const double end = soft().declared.joint.theta_max, way = 1.2 - 4 * radians(2.0);
  EXPECT_NEAR(work, 200.0 * (0.2 + end - 0.1) * way, 0.01 * work);
}

/// Where the reading begins to fall behind.
TEST(Unseen, a_stop_is_felt_from_its_place_on) {
  const double place = (0.4 + 0.3 * k_middle.share) * soft().declared.joint.theta_max;
  const RunPlan plan{0.0, radians(12.0), 1};
  const Log plain = run_of({}, plan, soft()), stopped = run_of(with("early_stop", 1e5, soft()), plan, soft());
  double most = 0;
  for (std::size_t row = 0; row <= 80; ++row) {
    const double behind = plain[row].theta - stopped[row].theta;
    if (plain[row].theta < place) {
      EXPECT_NEAR(behind, 0.0, 1e-9) << row;
    }
    most = std::max(most, behind);
  }
  EXPECT_GT(degrees(most), 0.5);
}

TEST(Unseen, a_splice_and_a_burr_are_where_they_are) {
  const double at = alpha_within({1.0, 1.0, 0.9}, soft());
  const auto longer = [&](const char* name, std::size_t side, double alpha, double load) {
    const Hidden hidden = with(name, 0.5, soft(), {1.0, 1.0, 0.9});
    std::vector<double> none;
    Moment now;
    now.alpha = alpha;
    now.load = load;
    return hidden.longer[side].at(0).act(now, hidden.longer[side][0].numbers, none);
  };
  EXPECT_EQ(longer("spliced_tendon", 0, at, 0.0), 0.5);
  EXPECT_EQ(longer("spliced_tendon", 0, at + radians(14.0), 9.0), 0.5);
  EXPECT_NEAR(longer("spliced_tendon", 0, at + radians(17.5), 0.0), 0.25, 1e-12);
  EXPECT_EQ(longer("spliced_tendon", 0, at - radians(21.0), 0.0), 0.0);
  EXPECT_EQ(longer("burr_under_load", 1, at, 8.0), 0.5);
  EXPECT_EQ(longer("burr_under_load", 1, at, 4.0), 0.25);
  EXPECT_EQ(longer("burr_under_load", 1, at, -8.0), 0.0);
  EXPECT_NEAR(longer("burr_under_load", 1, at + radians(12.0), 8.0), 0.5 * std::exp(-4.5), 1e-12);
}

/// What depends on what was done, and how much of it.
TEST(Unseen, knots_count_pulls_turnbuckles_way_and_frames_work) {
  Moment now;
  const auto acted = [&](const Action& action, std::vector<double>& memory) {
    return action.act(now, action.numbers, memory);
  };
  const Hidden knot = with("creeping_knot", 0.1, soft());
  std::vector<double> memory;
  for (int pull = 1; pull <= 3; ++pull) {
    for (const double tension : {20.0, 40.0, 52.0, 30.0, 0.0}) {  // twice 26 N, which is where it begins
      now.tension[1] = tension;
      acted(knot.longer[1].at(0), memory);
    }
    EXPECT_NEAR(acted(knot.longer[1].at(0), memory), -0.1 * pull, 1e-12);
  }
  const Hidden turnbuckle = with("unscrewing_turnbuckle", 0.01, soft());
  memory.clear();
  double let_go = 0;
  for (const double alpha : {0.0, 1.0, 1.0, -1.0, 0.0}) {
    now.alpha = alpha;
    let_go = acted(turnbuckle.longer[0].at(0), memory);
  }
  EXPECT_NEAR(let_go, -0.04, 1e-12);
  const Hidden frame = with("self_heating_frame", 0.01, soft());
  const double cooling = frame.longer[0].at(0).numbers[1];
  memory.clear();
  now.alpha_speed = 2.0;
  now.seconds = 0.01;
  double bent = 0;
  for (int i = 0; i < 6000; ++i) bent = acted(frame.longer[0].at(0), memory);
  EXPECT_NEAR(bent, 0.01 * 4.0 * cooling * (1.0 - std::exp(-60.0 / cooling)), 1e-3 * bent);
}

TEST(Unseen, a_warm_tendon_gives_more_and_only_under_more_than_home) {
  const Hidden hidden = with("softer_when_warm", 0.01, soft());
  const Action& softer = hidden.longer[0].at(0);
  std::vector<double> memory;
  Moment now;
  EXPECT_EQ(softer.act(now, softer.numbers, memory), 0.0) << "before anything pulls";
  now.warmth = -10.0;
  now.tension[0] = 20.0;
  EXPECT_EQ(softer.act(now, softer.numbers, memory), 0.0);
  now.tension[0] = 30.0;
  const Tendon& tendon = soft().declared.tendon;
  const double length = soft().declared.joint.R + soft().declared.pulley.EF;
  const double stretch = 10.0 * length / section_stiffness(tendon);
  EXPECT_NEAR(softer.act(now, softer.numbers, memory), 0.1 * stretch, 1e-12) << "a tenth less, ten kelvin colder";
}

}  // namespace unseen
}  // namespace fusee::rig
