#include "rig/truths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"
#include "fusee/mechanism/fields.h"
#include "fusee/mechanism/file.h"

namespace fusee::rig {
namespace {

constexpr double k_noise = radians(0.02);
constexpr double k_least_seen = 3.0;  // noise rms
constexpr double k_most_seen = 15.0;
constexpr int k_attempts = 40;  // joints drawn

/// What a fault is like but for its size: fixed for a case.
struct Character {
  double sign = 1;
  double angle = 0;  ///< within a turn
  double share = 0;
};

struct Fault {
  const char* name;
  double first;  ///< a size to begin the search with, in the unit of Hidden's member
  double most;   ///< nobody would build worse
  void (*set)(Hidden&, double size, const Character&, const MadeJoint&);
  std::vector<std::string> kin;  ///< empty and `named` false: unlike anything with a name
  bool named = true;
};

// In the order of the chain; then those without a name.
// clang-format off
std::vector<Fault> faults() {
  using H = Hidden;
  using C = Character;
  using J = MadeJoint;
  return {
      {"motor_offset", 0.01, 0.2, [](H& h, double s, const C& c, const J&) { h.motor_offset = c.sign * s; }, {}},
      {"motor_sensor_eccentricity", 0.01, 0.2,
       [](H& h, double s, const C& c, const J&) { h.motor_eccentricity = s, h.motor_eccentricity_phase = c.angle; }, {}},
      {"backlash", 0.02, 0.2, [](H& h, double s, const C&, const J&) { h.backlash = s; }, {}},
      {"radius_offset", 0.1, 1.0, [](H& h, double s, const C& c, const J&) { h.radius_offset = c.sign * s; }, {}},
      {"pulley_scale", 0.01, 0.06, [](H& h, double s, const C& c, const J&) { h.pulley_scale = c.sign * s; }, {}},
      {"pulley_runout", 0.1, 1.5,
       [](H& h, double s, const C& c, const J&) { h.runout_x = s * std::cos(c.angle), h.runout_y = s * std::sin(c.angle); }, {}},
      {"profile_error", 0.05, 0.3,
       [](H& h, double s, const C& c, const J&) { h.profile_error = s, h.profile_phase = c.angle, h.profile_harmonic = c.share < 0.5 ? 2 : 3; }, {}},
      {"tendon_stretch", 1.0, 12.0,
       [](H& h, double s, const C&, const J& j) { h.modulus = j.declared.tendon.modulus / (1.0 + s); }, {}},
      {"slack", 0.1, 3.0, [](H& h, double s, const C&, const J&) { h.slack = s; }, {}},
      {"creep", 0.3, 3.0, [](H& h, double s, const C&, const J&) { h.creep = s; }, {}},
      {"tendon_slip", 0.1, 2.0,
       [](H& h, double s, const C& c, const J&) { h.slip = s, h.slip_side = 1, h.slip_run = 1, h.slip_at = 0.3 + 0.4 * c.share; }, {}},
      {"thermal_expansion", 2e-5, 4e-4, [](H& h, double s, const C&, const J&) { h.expansion = s; }, {}},
      {"capstan_friction", 0.2, 1.5, [](H& h, double s, const C&, const J&) { h.friction = s; }, {}},
      {"guide_radius", 0.5, 6.0, [](H& h, double s, const C&, const J&) { h.guide_radius = s; }, {}},
      {"guide_position", 0.5, 4.0,
       [](H& h, double s, const C& c, const J&) { h.guide_outward = s * std::cos(c.angle), h.guide_down = s * std::sin(c.angle); }, {}},
      {"joint_length", 0.5, 6.0, [](H& h, double s, const C& c, const J&) { h.joint_length = c.sign * s; }, {}},
      {"gravity", 300.0, 20000.0,
       [](H& h, double s, const C& c, const J&) { h.gravity = s, h.gravity_direction = c.angle; }, {}},
      {"zero_offset", 0.002, 0.05, [](H& h, double s, const C& c, const J&) { h.zero = c.sign * s; }, {}},
      {"joint_sensor_gain", 0.005, 0.1, [](H& h, double s, const C& c, const J&) { h.gain = c.sign * s; }, {}},
      {"joint_sensor_eccentricity", 0.01, 0.2,
       [](H& h, double s, const C& c, const J&) { h.joint_eccentricity = s, h.joint_eccentricity_phase = c.angle; }, {}},
      {"sensor_lag", 0.02, 0.5, [](H& h, double s, const C&, const J&) { h.lag = s; }, {}},

      {"lump", 0.1, 3.0,
       [](H& h, double s, const C& c, const J& j) {
         h.lump = c.sign * s, h.lump_width = radians(7.0);
         h.lump_at = j.alpha_min + (0.2 + 0.6 * c.share) * (j.alpha_max - j.alpha_min);
       },
       {}, false},
      // Softer than declared where it is slack, stiffer where it is taut.
      {"hardening_tendon", 3.0, 60.0,
       [](H& h, double s, const C&, const J& j) {
         const Tendon& tendon = j.declared.tendon;
         h.hardening = tendon.pretension / (tendon.modulus * 0.25 * k_pi * tendon.diameter * tendon.diameter);
         h.modulus = tendon.modulus / (1.0 + s);
       },
       {"tendon_stretch", "slack"}, false},
      {"sticking_bearing", 20.0, 4000.0,
       [](H& h, double s, const C&, const J&) { h.bearing = s, h.bearing_stick = 0.6 * s; },
       {"capstan_friction", "tendon_stretch"}, false},
      {"motor_cogging", 0.005, 0.2, [](H& h, double s, const C&, const J&) { h.cogging = s; }, {}, false},
      {"giving_frame", 1e-3, 0.2, [](H& h, double s, const C&, const J&) { h.frame_give = s; }, {"tendon_stretch"},
       false},
      {"encoder_interpolation", 0.002, 0.05, [](H& h, double s, const C&, const J&) { h.interpolation = s; }, {},
       false},
      {"walking_zero", 0.001, 0.03, [](H& h, double s, const C&, const J&) { h.zero_walk = s; }, {}, false},
      {"bedding_in", 0.02, 0.3, [](H& h, double s, const C& c, const J&) { h.bedding = c.sign * s; }, {}, false},
  };
}
// clang-format on

const std::vector<Fault>& known_faults() {
  static const std::vector<Fault> all = faults();
  return all;
}

const Fault& fault(const std::string& name) {
  for (const Fault& known : known_faults()) {
    if (name == known.name) return known;
  }
  throw InputError("rig", "there is no fault '" + name + "'", nearest_word(name, fault_names()));
}

std::vector<RunPlan> plans_of(Protocol protocol, const MadeJoint& joint, double share) {
  // As much more than the pretension as the joints of tests/data/rig carry.
  if (protocol == Protocol::full)
    return full_protocol(std::round(joint.declared.tendon.pretension * (1.4 + 0.4 * share)));
  return single_protocol();
}

SensorPlan silent() {
  SensorPlan sensors;
  sensors.noise = 0;
  return sensors;
}

/// Rms of the reading that the fault moves; 0 where a joint would not hold.
double moved(const MadeJoint& joint, const Hidden& hidden, const std::vector<RunPlan>& plans,
             const std::vector<Log>& without) {
  const std::vector<Log> with = log_runs(joint, hidden, plans, silent());
  double squares = 0;
  double rows = 0;
  for (std::size_t run = 0; run < with.size(); ++run) {
    for (std::size_t row = 0; row < with[run].size(); ++row) {
      const double difference = with[run][row].theta - without[run][row].theta;
      if (!std::isfinite(difference)) return 0;
      squares += difference * difference;
      rows += 1;
    }
  }
  return std::sqrt(squares / rows);
}

/// The size at which the fault moves the reading by `target`, about, or what comes nearest within reason.
struct Sized {
  double size = 0;
  double moved = 0;
};
Sized sized(const Fault& fault, const Character& character, const MadeJoint& joint, const std::vector<RunPlan>& plans,
            const std::vector<Log>& without, double target) {
  Sized best{fault.first, 0};
  for (int look = 0; look < 6; ++look) {
    Hidden hidden;
    fault.set(hidden, best.size, character, joint);
    try {
      best.moved = moved(joint, hidden, plans, without);
    } catch (const InputError&) {
      best.moved = 0;
    }
    if (best.moved == 0) {
      best.size *= 0.4;  // the joint fell apart
    } else if (std::abs(best.moved - target) < 0.15 * target) {
      return best;
    } else {
      best.size = std::min(fault.most, best.size * std::clamp(target / best.moved, 0.1, 10.0));
    }
  }
  return best;
}

bool try_joint(const Truth& truth, Case& made, Random& random, Protocol protocol) {
  made.joint = random_joint(random);
  made.plans = plans_of(protocol, made.joint, random.share());
  made.hidden = {};
  made.seen.clear();
  const std::vector<Log> without = log_runs(made.joint, {}, made.plans, silent());
  for (const std::string& name : truth.faults) {
    const Fault& wanted = fault(name);
    const Character character{random.sign(), random.between(0.0, k_two_pi), random.share()};
    const double target = k_noise * std::exp(random.between(std::log(k_least_seen), std::log(k_most_seen)));
    const Sized found = sized(wanted, character, made.joint, made.plans, without, target);
    if (found.moved < 0.85 * k_least_seen * k_noise || found.moved > 1.3 * k_most_seen * k_noise) return false;
    wanted.set(made.hidden, found.size, character, made.joint);
    made.seen.push_back(found.moved / k_noise);
  }
  return true;
}

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 1469598103934665603ULL;  // FNV-1a
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  return hash;
}

bool finite(const std::vector<Log>& logs) {
  return std::all_of(logs.begin(), logs.end(), [](const Log& log) {
    return std::all_of(log.begin(), log.end(), [](const Row& row) { return std::isfinite(row.theta); });
  });
}

void set_sensors(Case& made) {
  made.sensors.noise = k_noise;
  made.sensors.seed = hash_of(made.truth) + made.seed;
  // Two plain sensors, one whose noise has a memory, one that is coarse, and so on.
  if (made.truth == "nothing_coloured_noise" || made.seed % 4 == 3) made.sensors.colour = 0.6;
  if (made.truth == "nothing_coarse_sensor" || made.seed % 4 == 0) made.sensors.quantum = radians(0.04);
  // Some benches log the temperature whether it matters or not.
  const bool matters = std::find(made.faults.begin(), made.faults.end(), "thermal_expansion") != made.faults.end();
  made.sensors.temperature = matters || made.seed % 2 == 1;
}

std::string quoted_list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "\"" : ", \"") + word + "\"";
  return "[" + text + "]";
}

std::string truth_json(const Case& made) {
  std::string seen;
  for (const double times : made.seen) seen += (seen.empty() ? "" : ", ") + rounded(times, 3);
  return "{\n \"truth\": \"" + made.truth + "\",\n \"faults\": " + quoted_list(made.faults) +
         ",\n \"seen_in_noise_rms\": [" + seen + "],\n \"seed\": " + std::to_string(made.seed) + "\n}\n";
}

}  // namespace

std::vector<std::string> fault_names() {
  std::vector<std::string> names;
  for (const Fault& known : known_faults()) names.emplace_back(known.name);
  return names;
}

bool has_name(const std::string& name) { return fault(name).named; }

std::vector<std::string> kin_of(const std::string& name) { return fault(name).kin; }

std::vector<Truth> all_truths() {
  std::vector<Truth> truths = {{"nothing", {}}, {"nothing_coloured_noise", {}}, {"nothing_coarse_sensor", {}}};
  for (const std::string& name : fault_names()) truths.push_back({name, {name}});
  const std::vector<std::array<const char*, 2>> pairs = {
      {"tendon_stretch", "backlash"},     {"tendon_stretch", "capstan_friction"},
      {"tendon_stretch", "guide_radius"}, {"backlash", "sensor_lag"},
      {"backlash", "zero_offset"},        {"backlash", "pulley_runout"},
      {"pulley_scale", "tendon_stretch"}, {"motor_sensor_eccentricity", "zero_offset"},
  };
  for (const auto& pair : pairs) truths.push_back({std::string(pair[0]) + " + " + pair[1], {pair[0], pair[1]}});
  return truths;
}

MadeJoint random_joint(Random& random) {
  for (;;) {
    DeclaredMechanism joint = default_mechanism();
    joint.name = "measured joint";
    const double R = std::round(std::exp(random.between(std::log(40.0), std::log(160.0))));
    const auto part = [&](double low, double high) { return std::round(10.0 * R * random.between(low, high)) / 10.0; };
    joint.joint = {R, radians(-std::round(random.between(20, 31))), radians(std::round(random.between(22, 34)))};
    joint.guides.EB = part(0.36, 0.46);
    joint.guides.ED = random.share() < 0.6 ? joint.guides.EB : part(0.36, 0.46);
    joint.guides.OE = part(-0.38, -0.22);
    joint.guides.radius = part(0.018, 0.03);
    joint.guides.mu = std::round(100.0 * random.between(0.08, 0.18)) / 100.0;
    joint.pulley.EF = part(0.85, 1.1);
    joint.pulley.r1 = part(0.135, 0.16);
    if (random.share() < 0.25) {
      joint.pulley.law = Law::linear;
      joint.pulley.ratio = std::round(10.0 * random.between(3.2, 4.2)) / 10.0;
    }
    joint.tendon.diameter = part(0.009, 0.02);
    // From a braided polymer to a wire rope.
    joint.tendon.modulus = 1000.0 * std::round(std::exp(random.between(std::log(6.0), std::log(40.0))));
    joint.tendon.pretension = std::round((2.0 + 0.05 * R) * random.between(0.8, 1.3));
    try {
      return make_joint(joint);
    } catch (const InputError&) {
      continue;  // no pulley for these numbers
    }
  }
}

Case make_case(const Truth& truth, std::uint64_t seed, Protocol protocol) {
  Random random(hash_of(truth.name) ^ (seed * 0x9E3779B97F4A7C15ULL));
  Case made;
  made.truth = truth.name;
  made.faults = truth.faults;
  made.seed = seed;
  set_sensors(made);
  for (int attempt = 0; attempt < k_attempts; ++attempt) {
    if (!try_joint(truth, made, random, protocol)) continue;
    made.logs = log_runs(made.joint, made.hidden, made.plans, made.sensors);
    if (finite(made.logs)) return made;
  }
  throw InputError("rig", "no joint was found on which " + truth.name + " is well seen");
}

std::vector<std::pair<std::string, std::string>> files_of(const Case& made) {
  std::vector<std::pair<std::string, std::string>> files = {{"spec.toml", write_mechanism(made.joint.declared)},
                                                            {"truth.json", truth_json(made)}};
  for (std::size_t run = 0; run < made.logs.size(); ++run) {
    files.emplace_back("run_" + std::to_string(run + 1) + ".csv", csv_text(made.logs[run], made.sensors.temperature));
  }
  return files;
}

}  // namespace fusee::rig
