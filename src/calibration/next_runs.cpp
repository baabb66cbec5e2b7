#include "calibration/next_runs.h"

#include <algorithm>
#include <cmath>

#include "calibration/thresholds.h"
#include "fusee/base/text.h"

namespace fusee {
namespace {

constexpr std::size_t k_most_proposals = 4;
constexpr double k_caliper = 0.05;       // mm
constexpr double k_diameters = 0.003;    // of a print's size, by a caliper
constexpr double k_square = 0.005;       // of a sensor's gain, by a square
constexpr double k_mark = radians(0.2);  // of a sensor's zero, by a mark
constexpr double k_lever_load = 0.3;     // of the pretension, as a tip force

/// A run that could be made: what it would log, and what is changed on the bench for it.
struct Proposal {
  std::string words;
  Measurement measurement;
  Mechanism mechanism;
  /// The imperfections as they act with the bench changed.
  Imperfections (*turned)(const Imperfections&) = [](const Imperfections& at) { return at; };
};

/// A quarter turn against what it measures or drives: once-a-turn errors change their phase.
Imperfections pulley_turned(const Imperfections& at) {
  Imperfections turned = at;
  turned.runout_x = -at.runout_y;
  turned.runout_y = at.runout_x;
  return turned;
}
Imperfections motor_sensor_turned(const Imperfections& at) {
  Imperfections turned = at;
  turned.motor_eccentricity_sin = -at.motor_eccentricity_cos;
  turned.motor_eccentricity_cos = at.motor_eccentricity_sin;
  return turned;
}
Imperfections joint_sensor_turned(const Imperfections& at) {
  Imperfections turned = at;
  turned.joint_eccentricity_sin = -at.joint_eccentricity_cos;
  turned.joint_eccentricity_cos = at.joint_eccentricity_sin;
  return turned;
}

const Run& longest(const Measurement& measurement) {
  return *std::max_element(measurement.runs.begin(), measurement.runs.end(),
                           [](const Run& a, const Run& b) { return a.samples.size() < b.samples.size(); });
}

/// The same strokes at another load and another pace.
Measurement repeated(const Measurement& measurement, double load, double pace) {
  Measurement planned = measurement;
  planned.runs = {longest(measurement)};
  Run& run = planned.runs.front();
  run.has_load = true;
  for (Sample& sample : run.samples) {
    sample.load = load;
    sample.time *= pace;
  }
  return planned;
}

double largest_load(const Evidence& evidence) {
  double most = 0;
  for (const Run& run : evidence.measurement.runs) {
    for (const Sample& sample : run.samples) most = std::max(most, run.has_load ? std::abs(sample.load) : 0.0);
  }
  if (most > 0 || evidence.declared->transmission) return most;
  return std::max(1.0, std::round(k_lever_load * evidence.declared->tendon.pretension));
}

std::string load_words(const Evidence& evidence, double load) {
  const std::string unit = evidence.declared->transmission ? evidence.measurement.load_unit : "N tip force";
  return rounded(load, 3) + " " + unit;
}

std::vector<Proposal> proposals(const Evidence& evidence) {
  const Measurement& seen = evidence.measurement;
  const Mechanism& declared = *evidence.declared;
  const double load = largest_load(evidence);
  const auto as_before = repeated(seen, 0, 1);
  std::vector<Proposal> all;
  if (load > 0) {
    all.push_back({"repeat the strokes slowly at " + load_words(evidence, load), repeated(seen, load, 1), declared});
    all.push_back({"repeat the strokes slowly at " + load_words(evidence, -load), repeated(seen, -load, 1), declared});
    all.push_back(
        {"repeat the strokes slowly at " + load_words(evidence, 2 * load), repeated(seen, 2 * load, 1), declared});
  }
  all.push_back({"repeat the strokes slowly without load", as_before, declared});
  if (longest(seen).has_time) {
    all.push_back({"repeat the strokes five times as fast", repeated(seen, 0, 0.2), declared});
    all.push_back({"repeat the strokes at a tenth of the speed", repeated(seen, 0, 10), declared});
  }
  if (declared.transmission) return all;
  Mechanism tighter = declared;
  tighter.tendon.pretension *= 2;
  all.push_back({"double the pretension and repeat the slow strokes", as_before, tighter});
  all.push_back({"turn the pulley's print on its shaft by a quarter turn and repeat the slow strokes", as_before,
                 declared, pulley_turned});
  all.push_back({"turn the motor's encoder on its shaft by a quarter turn and repeat the slow strokes", as_before,
                 declared, motor_sensor_turned});
  all.push_back({"turn the joint's encoder on its axis by a quarter turn and repeat the slow strokes", as_before,
                 declared, joint_sensor_turned});
  all.push_back(
      {"lay the joint on its side and repeat the slow strokes", as_before, declared, [](const Imperfections& at) {
         Imperfections level = at;
         level.gravity_cos = level.gravity_sin = 0;
         return level;
       }});
  return all;
}

/// A reading by hand tells those apart that give a member different values.
struct Caliper {
  std::string words;
  double Imperfections::*member;
  double uncertainty = k_caliper;
};

std::vector<Caliper> calipers(const Evidence& evidence) {
  if (evidence.declared->transmission) return {};
  return {
      {"measure the guide pins with a caliper and write [prior] guide_radius_mm", &Imperfections::guide_radius},
      {"measure the pins' distance from the middle and write [prior] EB_mm and ED_mm", &Imperfections::guide_outward},
      {"measure how far the pins lie below the joint and write [prior] OE_mm", &Imperfections::guide_down},
      {"measure from the joint's axis to the tendons' attachment and write [prior] length_mm",
       &Imperfections::joint_length},
      {"measure the pulley's groove floor and the tendon with a caliper and write [prior] radius_offset_mm",
       &Imperfections::radius_offset},
      {"measure two diameters of the print with a caliper and write [prior] pulley_scale", &Imperfections::pulley_scale,
       k_diameters},
      {"read the joint's sensor against a square at two angles", &Imperfections::gain, k_square},
      {"drive the joint to a mark at home and read its sensor there", &Imperfections::zero, k_mark}};
}

double rms_apart(const Readings& one, const Readings& other) {
  double squares = 0;
  double rows = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t k = 0; k < one[i].size(); ++k) {
      const double difference = one[i][k] - other[i][k];
      if (!std::isfinite(difference)) continue;
      squares += difference * difference;
      rows += 1;
    }
  }
  return rows > 0 ? std::sqrt(squares / rows) : 0.0;
}

/// How far apart a measurement puts each pair that the data cannot tell apart, in units of the noise.
struct Ranked {
  std::string words;
  std::vector<double> apart;

  std::size_t told() const {
    return static_cast<std::size_t>(
        std::count_if(apart.begin(), apart.end(), [](double a) { return a > k_thresholds.told_apart; }));
  }
  double most() const { return *std::max_element(apart.begin(), apart.end()); }
};

std::string sentence(const Ranked& ranked, const std::vector<const Rival*>& pairs) {
  std::string told;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (ranked.apart[i] <= k_thresholds.told_apart) continue;
    told += (told.empty() ? "" : ", ") + pairs[i]->accepted->name + " from " + pairs[i]->rival->name + " (" +
            rounded(std::min(ranked.apart[i], 999.0), 2) + " × what it is uncertain by)";
  }
  return ranked.words + ": it tells " + told;
}

}  // namespace

std::vector<std::string> next_runs(const Evidence& evidence, const Selection& selection) {
  std::vector<const Rival*> pairs;
  for (const Rival& rival : selection.rivals) {
    if (as_good(evidence, rival.fit, selection.best)) pairs.push_back(&rival);
  }
  if (pairs.empty()) return {};
  std::vector<Ranked> ranked;
  for (const Proposal& proposal : proposals(evidence)) {
    Forward forward(proposal.mechanism, proposal.measurement);
    const Readings found = forward(proposal.turned(selection.best.at));
    Ranked entry{proposal.words, {}};
    for (const Rival* pair : pairs)
      entry.apart.push_back(rms_apart(found, forward(proposal.turned(pair->fit.at))) / evidence.floor);
    ranked.push_back(std::move(entry));
  }
  for (const Caliper& caliper : calipers(evidence)) {
    Ranked entry{caliper.words, {}};
    for (const Rival* pair : pairs)
      entry.apart.push_back(std::abs(selection.best.at.*caliper.member - pair->fit.at.*caliper.member) /
                            caliper.uncertainty);
    ranked.push_back(std::move(entry));
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
    return a.told() != b.told() ? a.told() > b.told() : a.most() > b.most();
  });
  std::vector<std::string> words;
  for (const Ranked& entry : ranked) {
    if (words.size() < k_most_proposals && entry.told() > 0) words.push_back(sentence(entry, pairs));
  }
  // Nothing that can be simulated tells them apart: what each effect itself asks for.
  if (words.empty()) {
    for (const Rival* pair : pairs) words.push_back(pair->rival->separating_run);
  }
  return words;
}

}  // namespace fusee
