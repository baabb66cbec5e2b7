#include "rig/truths.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "fusee/transmission.h"
#include "joint/joint_effects.h"

namespace fusee::rig {
namespace {

constexpr double k_noise = radians(0.02);
constexpr double k_most_seen = 15.0;  // noise rms
constexpr int k_attempts = 40;        // joints drawn
constexpr int k_iterations = 6;       // of a size
constexpr double k_tolerance = 0.15;  // of the movement of the reading, relative

std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 1469598103934665603ULL;  // FNV-1a
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  return hash;
}

SensorPlan sensors_of(const std::string& truth, std::uint64_t seed) {
  SensorPlan sensors = usual_sensors(seed);
  if (truth == "nothing_coloured_noise") sensors.colour = 0.6;
  if (truth == "nothing_coarse_sensor") sensors.quantum = radians(0.04);
  // Some benches log the temperature without need.
  sensors.temperature = seed % 2 == 1;
  return sensors;
}

/// Tip force per tendon force at home: the smaller moment arm over the lever of the tip force.
double tip_force_ratio(const MadeJoint& joint) {
  const transmission::TransmissionPoint home = transmission::Transmission(joint.declared).at_alpha(0.0);
  return std::min(home.t1.m, home.t2.m) / joint.declared.joint.R;
}

Programme draw_programme(const Case& made, const CaseOptions& options, Random& random) {
  const Protocol protocol = options.protocol;
  Programme programme;
  if (protocol == Protocol::random) {
    programme = random_programme(random, made.joint);
  } else {
    // The ratio of load to pretension of the joints of tests/data/rig.
    const double pull = made.joint.declared.tendon.pretension * (1.4 + 0.4 * random.share());
    const double load = options.joint != nullptr ? pull * tip_force_ratio(made.joint) : std::round(pull);
    programme = {
        protocol == Protocol::full ? full_protocol(load) : single_protocol(), {}, sensors_of(made.truth, made.seed)};
  }
  const auto& faults = made.faults;
  if (std::find(faults.begin(), faults.end(), "thermal_expansion") != faults.end())
    programme.sensors.temperature = true;
  programme.sensors.seed = hash_of(made.truth) + made.seed;
  return programme;
}

std::vector<Log> logs_of(const Case& made, const HiddenFaults& hidden, const SensorPlan& sensors) {
  return log_runs(made.joint, hidden, made.plans, sensors, made.motion);
}

bool try_joint(Case& made, Random& random, const CaseOptions& options) {
  made.joint = options.joint != nullptr ? *options.joint : random_joint(random);
  const Programme programme = draw_programme(made, options, random);
  made.plans = programme.runs;
  made.motion = programme.motion;
  made.sensors = programme.sensors;
  HiddenFaults plain;
  if (options.any_groove) plain.groove_friction = std::exp(random.between(std::log(0.05), std::log(0.5)));
  made.hidden = plain;
  made.seen.clear();
  const std::vector<Log> without = logs_of(made, plain, noiseless());
  HiddenFaults all = plain;
  for (const std::string& name : made.faults) {
    const Fault& wanted = find_fault(name);
    const Character character{random.sign(), random.between(0.0, k_two_pi), random.share()};
    const double noise = made.sensors.noise;
    const double target = noise * std::exp(random.between(std::log(wanted.least_seen), std::log(k_most_seen)));
    const SizedFault found = find_size(wanted.first, wanted.most, target, k_iterations, [&](double size) {
      HiddenFaults hidden = plain;
      wanted.apply(hidden, size, character, made.joint);
      return rms_difference(logs_of(made, hidden, noiseless()), without);
    });
    if (found.moved < (1.0 - k_tolerance) * wanted.least_seen * noise || found.moved > 1.3 * k_most_seen * noise)
      return false;
    wanted.apply(all, found.size, character, made.joint);
    made.seen.push_back(found.moved / noise);
  }
  made.hidden = all;
  return true;
}

bool are_finite(const std::vector<Log>& logs) {
  return std::all_of(logs.begin(), logs.end(), [](const Log& log) {
    return std::all_of(log.begin(), log.end(), [](const Row& row) { return std::isfinite(row.theta); });
  });
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

SensorPlan usual_sensors(std::uint64_t seed) {
  SensorPlan sensors;
  sensors.noise = k_noise;
  if (seed % 4 == 3) sensors.colour = 0.6;
  if (seed % 4 == 0) sensors.quantum = radians(0.04);
  return sensors;
}

SizedFault find_size(double first, double most, double target, int iterations,
                     const std::function<double(double)>& movement) {
  SizedFault best{first};
  for (int i = 0; i < iterations; ++i) {
    try {
      best.moved = movement(best.size);
    } catch (const InputError&) {
      best.moved = 0;
    }
    best.is_met = best.moved > 0 &&
                  (std::abs(best.moved - target) < k_tolerance * target || (best.size >= most && best.moved < target));
    if (best.is_met) break;
    // No equilibrium of the joint: a smaller fault.
    const double factor = best.moved == 0 ? 0.4 : std::clamp(target / best.moved, 0.1, 10.0);
    best.size = best.moved == 0 ? factor * best.size : std::min(most, best.size * factor);
  }
  return best;
}

bool has_name(const std::string& name) {
  const std::string& split = find_fault(name).split;
  return split == "named" || split == "wide";
}

std::vector<Truth> wide_truths(const MadeJoint& joint) {
  std::vector<Truth> truths = {{"nothing", {}}};
  const std::vector<const Effect*> possible = joint::effects_of(joint.declared);
  const auto add_possible = [&](const char* list) {
    for (const std::string& name : names_in(list)) {
      const auto is = [&](const Effect* effect) { return effect->name == name; };
      if (std::any_of(possible.begin(), possible.end(), is)) truths.push_back({name, {name}});
    }
  };
  add_possible("wide");
  if (joint.is_helical()) add_possible("named");
  return truths;
}

Truth truth_of(const std::string& name) {
  Truth truth{name, {}};
  if (name.starts_with("nothing")) return truth;
  const std::string separator = " + ";
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + separator.size()) {
    end = name.find(separator, begin);
    truth.faults.push_back(find_fault(name.substr(begin, end - begin)).name);
  }
  return truth;
}

std::vector<Truth> all_truths() {
  std::vector<Truth> truths = {{"nothing", {}}, {"nothing_coloured_noise", {}}, {"nothing_coarse_sensor", {}}};
  for (const char* split : {"named", "tuning"}) {
    for (const std::string& name : names_in(split)) truths.push_back({name, {name}});
  }
  for (const char* pair :
       {"tendon_stretch + backlash", "tendon_stretch + capstan_friction", "tendon_stretch + guide_radius",
        "backlash + sensor_lag", "backlash + zero_offset", "backlash + pulley_runout", "pulley_scale + tendon_stretch",
        "motor_sensor_eccentricity + zero_offset"})
    truths.push_back(truth_of(pair));
  return truths;
}

Truth random_truth(Kind kind, const std::string& split, std::uint64_t seed) {
  faults_in(split);  // throws for an unknown split, also for kinds that draw nothing from it
  // heldout_13 was named "unsuspected" when its joints were drawn. Its seeds keep that name.
  Random random(hash_of(split == "heldout_13" ? "unsuspected" : split) ^ (seed * 0xD1B54A32D192ED03ULL));
  Truth truth;
  const auto add = [&](const std::vector<std::string>& names) {
    std::string name;
    do {
      name = names[static_cast<std::size_t>(random.share() * static_cast<double>(names.size()))];
    } while (std::find(truth.faults.begin(), truth.faults.end(), name) != truth.faults.end());
    truth.faults.push_back(name);
    truth.name += (truth.name.empty() ? "" : " + ") + name;
  };
  const std::vector<std::string> named = names_in("named");
  const int count = kind == Kind::three ? 3 : kind == Kind::two ? 2 : kind == Kind::one || kind == Kind::beside ? 1 : 0;
  for (int i = 0; i < count; ++i) add(named);
  if (kind == Kind::unknown || kind == Kind::beside) add(names_in(split));
  if (truth.faults.empty()) truth.name = "nothing";
  return truth;
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

Case make_case(const Truth& truth, std::uint64_t seed, const CaseOptions& options) {
  Random random(hash_of(truth.name) ^ (seed * 0x9E3779B97F4A7C15ULL));
  Case made;
  made.truth = truth.name;
  made.faults = truth.faults;
  made.seed = seed;
  for (int attempt = 0; attempt < k_attempts; ++attempt) {
    if (!try_joint(made, random, options)) continue;
    made.logs = logs_of(made, made.hidden, made.sensors);
    if (are_finite(made.logs)) return made;
  }
  throw InputError("rig", "no joint was found on which " + truth.name + " is well seen");
}

std::vector<std::pair<std::string, std::string>> files_of(const Case& made) {
  std::vector<std::pair<std::string, std::string>> files = {{"spec.toml", write_mechanism(made.joint.declared)},
                                                            {"truth.json", truth_json(made)}};
  for (std::size_t run = 0; run < made.logs.size(); ++run) {
    files.emplace_back("run_" + std::to_string(run + 1) + ".csv",
                       csv_text(made.logs[run], made.sensors.temperature, made.plans[run]));
  }
  return files;
}

}  // namespace fusee::rig
