#include "calibration/next_runs.h"

#include <algorithm>
#include <cmath>

#include "calibration/thresholds.h"
#include "fusee/base/text.h"

namespace fusee {
namespace {

constexpr std::size_t k_most_proposals = 4;
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
  turned.pulley.outline.runout_x = -at.pulley.outline.runout_y;
  turned.pulley.outline.runout_y = at.pulley.outline.runout_x;
  return turned;
}
Imperfections motor_sensor_turned(const Imperfections& at) {
  Imperfections turned = at;
  turned.motor.eccentricity_sin = -at.motor.eccentricity_cos;
  turned.motor.eccentricity_cos = at.motor.eccentricity_sin;
  return turned;
}
Imperfections joint_sensor_turned(const Imperfections& at) {
  Imperfections turned = at;
  turned.sensor.eccentricity_sin = -at.sensor.eccentricity_cos;
  turned.sensor.eccentricity_cos = at.sensor.eccentricity_sin;
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
  const DeclaredMechanism& declared = *evidence.declared;
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
         level.joint.weight = {};
         return level;
       }});
  return all;
}

/// A reading by hand tells those apart that give a number different values.
std::vector<const EffectParameter*> calipers(const Evidence& evidence) {
  std::vector<const EffectParameter*> readable;
  if (evidence.declared->transmission) return readable;
  for (const Effect& effect : effects(kind_of(*evidence.declared))) {
    for (const EffectParameter& parameter : effect.parameters) {
      if (!parameter.by_hand.words.empty()) readable.push_back(&parameter);
    }
  }
  return readable;
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
  const Effect* named = nullptr;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (ranked.apart[i] <= k_thresholds.told_apart) continue;
    const std::string unit = told.empty() ? " × what it is uncertain by)" : " ×)";
    told += told.empty() ? "" : ", ";
    if (pairs[i]->accepted != named) told += pairs[i]->accepted->name + " from ";
    named = pairs[i]->accepted;
    told += pairs[i]->rival->name + " (" + rounded(std::min(ranked.apart[i], 999.0), 2) + unit;
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
    const BenchLog log = bench_log(proposal.measurement);
    Forward forward(proposal.mechanism, log);
    const Readings found = forward(proposal.turned(selection.best.at));
    Ranked entry{proposal.words, {}};
    for (const Rival* pair : pairs)
      entry.apart.push_back(rms_apart(found, forward(proposal.turned(pair->fit.at))) / evidence.floor);
    ranked.push_back(std::move(entry));
  }
  for (const EffectParameter* number : calipers(evidence)) {
    Ranked entry{std::string(number->by_hand.words), {}};
    for (const Rival* pair : pairs)
      entry.apart.push_back(std::abs(value_of(selection.best.at, *number) - value_of(pair->fit.at, *number)) /
                            number->by_hand.uncertainty);
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
