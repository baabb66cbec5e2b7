/// \file
/// What is asked of every split of faults that is kept aside, and the joints it is asked on.
#pragma once

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "fusee/transmission/transmission.h"
#include "rig/fault_shapes.h"
#include "rig/truths.h"
#include "support/mechanisms.h"

namespace fusee::rig {

constexpr Character k_middle{1.0, 1.0, 0.5};
constexpr double k_slow = radians(12.0), k_fast = radians(90.0);

/// Both loads, fast and slow, rest under load, and without a load again after it.
inline std::vector<RunPlan> loads_and_rests() {
  return {{0.0, k_slow, 1}, {25.0, k_fast, 2, 2.0}, {0.0, radians(25.0), 1}, {-25.0, radians(25.0), 1, 2.0}};
}

inline double acted(const Action& action, const Moment& now, std::vector<double>& memory) {
  return action.act(now, action.numbers, memory);
}

/// Both tendons one after another, each with what it remembers.
class BothWays {
 public:
  explicit BothWays(const Hidden& hidden) : hidden_(hidden) {}
  std::array<double, 2> operator()(const Moment& now) {
    return {acted(hidden_.longer[0].at(0), now, memories_[0]), acted(hidden_.longer[1].at(0), now, memories_[1])};
  }

 private:
  const Hidden& hidden_;
  std::array<std::vector<double>, 2> memories_;
};

/// One tendon's way is longer by so much, the other's as much shorter; of what has no memory.
inline void expect_ways_apart(const Hidden& hidden, const Moment& now, double longer, double tolerance) {
  std::vector<double> none;
  EXPECT_NEAR(acted(hidden.longer[0].at(0), now, none), longer, tolerance);
  EXPECT_NEAR(acted(hidden.longer[1].at(0), now, none), -longer, tolerance);
}

inline SensorPlan silent() {
  SensorPlan sensors;
  sensors.noise = 0;
  return sensors;
}

inline MadeJoint forearm_with(double modulus, double friction) {
  DeclaredMechanism mechanism = testing::forearm();
  mechanism.guides.mu = friction;
  mechanism.tendon.modulus = modulus;
  mechanism.tendon.pretension = 20;
  return make_joint(mechanism);
}
/// Without friction at its pins, and so stiff that θ is the law's under any load.
inline const MadeJoint& stiff() {
  static const MadeJoint joint = forearm_with(1e8, 0.0);
  return joint;
}
inline const MadeJoint& soft() {
  static const MadeJoint joint = forearm_with(8000, 0.12);
  return joint;
}

inline Hidden with(const std::string& fault, double size, const MadeJoint& joint,
                   const Character& character = k_middle) {
  Hidden hidden;
  find_fault(fault).set(hidden, size, character, joint);
  return hidden;
}

inline Log run_of(const Hidden& hidden, const RunPlan& plan, const MadeJoint& joint) {
  return log_runs(joint, hidden, {plan}, silent()).front();
}

/// The angle that the law has for every row's α and what the shaft is off by there.
template <typename Off>
void expect_shaft_off(const Log& log, Off off) {
  const Transmission law(stiff().declared);
  for (std::size_t row = 1; row < log.size(); ++row)
    EXPECT_NEAR(log[row].theta, law.theta(log[row].alpha + off(row)), 1e-5) << row;
}

inline std::vector<Log> short_logs_of(const Hidden& hidden, const std::vector<RunPlan>& plans) {
  MotionPlan few_rows;
  few_rows.rows_per_stroke = 40;
  return log_runs(soft(), hidden, plans, silent(), few_rows);
}

/// Rms over all rows, NaN where a joint does not hold.
inline double moved(const std::vector<Log>& logs, const std::vector<Log>& plain) {
  double squares = 0, rows = 0;
  for (std::size_t run = 0; run < logs.size(); ++run) {
    for (std::size_t row = 0; row < logs[run].size(); ++row, ++rows)
      squares += std::pow(logs[run][row].theta - plain[run][row].theta, 2);
  }
  return std::sqrt(squares / rows);
}

/// In no other list; how many of them are like no named effect.
inline std::size_t kinds_without_kin(const std::string& split) {
  using ::testing::Contains;
  using ::testing::Not;
  std::size_t without_kin = 0;
  for (const FaultList& list : fault_lists()) {
    if (list.split != split) continue;
    for (const Fault& fault : list.faults) {
      for (const FaultList& other : fault_lists()) {
        if (other.split == split) continue;
        EXPECT_THAT(names_in(other.split), Not(Contains(fault.name)));
      }
      EXPECT_LE(fault.kin.size(), 1u) << fault.name;
      for (const std::string& kin : fault.kin) EXPECT_THAT(names_in("named"), Contains(kin)) << fault.name;
      without_kin += fault.kin.empty() ? 1 : 0;
      EXPECT_LT(fault.first, fault.most) << fault.name;
    }
  }
  return without_kin;
}

inline void expect_nothing_at_size_nought(const std::vector<Fault>& faults, const std::vector<RunPlan>& plans) {
  Hidden all;
  for (const Fault& fault : faults) {
    const Hidden before = all;
    fault.set(all, 0.0, k_middle, soft());
    EXPECT_FALSE(all == before) << fault.name;
  }
  EXPECT_LT(degrees(moved(short_logs_of(all, plans), short_logs_of({}, plans))), 1e-9);
}

inline void expect_more_by_size(const std::vector<Fault>& faults, const std::vector<RunPlan>& plans) {
  const std::vector<Log> plain = short_logs_of({}, plans);
  for (const Fault& fault : faults) {
    const double some = moved(short_logs_of(with(fault.name, fault.first, soft()), plans), plain);
    const double more = moved(short_logs_of(with(fault.name, 2.0 * fault.first, soft()), plans), plain);
    EXPECT_GT(degrees(some), 0.005) << fault.name;
    EXPECT_GT(more, 1.2 * some) << fault.name;
  }
}

inline void expect_drawn_from(const std::string& split) {
  using ::testing::Contains;
  using ::testing::Not;
  const std::vector<std::string> names = names_in(split);
  std::set<std::string> drawn;
  for (std::uint64_t seed = 1; seed < 300; ++seed) {
    const Truth truth = random_truth(Kind::beside, split, seed);
    ASSERT_EQ(truth.faults.size(), 2u);
    EXPECT_TRUE(has_name(truth.faults[0]));
    EXPECT_THAT(names, Contains(truth.faults[1]));
    drawn.insert(truth.faults[1]);
  }
  EXPECT_EQ(drawn.size(), names.size()) << "each gets its turn";
  for (const Truth& truth : all_truths()) EXPECT_THAT(names, Not(Contains(truth.name)));
}

/// Minutes.
inline void expect_joints_on_which_each_is_well_seen(const std::string& split) {
  for (const std::string& name : names_in(split)) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Case made = make_case({name, {name}}, seed, {Protocol::random, true});
      EXPECT_GE(made.seen.front(), 2.5) << name;
      EXPECT_LE(made.seen.front(), 20.0) << name;
    }
  }
}

}  // namespace fusee::rig
