#include <algorithm>
#include <cmath>

#include "rig/truths.h"

namespace fusee::rig {
namespace {

constexpr std::size_t k_most_rows = 1200;  // of a run, to limit the time of many joints

double even_ratio(Random& random, double low, double high) {
  return std::exp(random.between(std::log(low), std::log(high)));
}
int whole(Random& random, int low, int high) { return static_cast<int>(std::floor(random.between(low, high + 1.0))); }

double any_load(Random& random, double most) {
  const double share = random.share();
  if (share < 0.25) return 0.0;
  if (share < 0.5) return most;
  if (share < 0.65) return -most;
  return std::round(10.0 * most * random.between(-1.0, 1.0)) / 10.0;
}

Manner any_manner(Random& random) {
  const double share = random.share();
  return share < 0.75 ? Manner::strokes : share < 0.9 ? Manner::staircase : Manner::ends;
}

RunPlan any_run(Random& random, double most_load) {
  RunPlan run;
  run.manner = any_manner(random);
  run.load = any_load(random, most_load);
  run.speed = even_ratio(random, radians(5.0), radians(120.0));
  run.cycles = run.manner == Manner::strokes ? whole(random, 1, 4) : 1;
  if (random.share() < 0.3) run.dwell = random.between(1.0, 8.0);
  run.holds = whole(random, 4, 9);
  if (run.manner == Manner::staircase) {
    run.levels = {0.0, 0.5 * most_load, most_load};
    if (random.share() < 0.4) run.levels = {-most_load, 0.0, most_load};
  } else if (run.manner == Manner::strokes && run.cycles > 1 && random.share() < 0.25) {
    run.levels = {0.0, any_load(random, most_load), most_load};
  }
  return run;
}

SensorPlan any_sensors(Random& random) {
  SensorPlan sensors;
  sensors.noise = even_ratio(random, radians(0.005), radians(0.05));
  if (random.share() < 0.4) sensors.colour = random.between(0.2, 0.8);
  if (random.share() < 0.3) sensors.quantum = sensors.noise * random.between(0.5, 2.0);
  sensors.temperature = random.share() < 0.5;
  return sensors;
}

}  // namespace

Programme random_programme(Random& random, const MadeJoint& joint) {
  Programme programme;
  programme.sensors = any_sensors(random);
  programme.motion.rows_per_stroke = whole(random, 30, 160);
  programme.motion.reach = random.between(0.65, 0.96);
  programme.motion.pause = even_ratio(random, 3.0, 60.0);
  programme.motion.loaded_first = random.share() < 0.5;
  const double most_load = std::round(joint.declared.tendon.pretension * random.between(0.8, 1.8));
  const int runs = whole(random, 2, 7);
  // The first run is strokes.
  programme.runs.push_back({0.0, even_ratio(random, radians(8.0), radians(25.0)), whole(random, 2, 4), 0.0});
  while (programme.runs.size() < static_cast<std::size_t>(runs)) {
    RunPlan run = any_run(random, most_load);
    const auto rows = static_cast<std::size_t>(2 * programme.motion.rows_per_stroke);
    while (run.cycles > 1 && rows * static_cast<std::size_t>(run.cycles) > k_most_rows) --run.cycles;
    programme.runs.push_back(run);
  }
  return programme;
}

}  // namespace fusee::rig
