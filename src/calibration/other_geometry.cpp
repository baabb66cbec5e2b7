#include "calibration/other_geometry.h"

#include <limits>

#include "fusee/mechanism/effect.h"

// A curve beside the readings knows nothing of moment arms: under load a path that is longer by a curve turns the joint
// further where its arm is smaller, as every geometry does, and the names of geometry were then far ahead of all that
// has none (unheard split, seeds 241038 and 241092: a flexure's centre that wanders, as a runout, by 52 and 206 nats; by
// 4 and less of such paths). So the set without the effect is fitted again with them, a square and a cube of the angle
// each: what is linear in it is as a drum or a zero, that are there to be found.

namespace fusee {
namespace {

/// mm at 57 degrees, a quarter of it at 29: pins, levers and pulleys are off by as much.
constexpr double k_prior = 2.0;

EffectParameter path_parameter(const char* name, double& (*number)(Imperfections&)) {
  EffectParameter parameter;
  parameter.name = name;
  parameter.number = number;
  parameter.least = -20;
  parameter.most = 20;
  parameter.step = 1e-2;
  parameter.prior = k_prior;
  return parameter;
}

/// In no catalogue: nobody could look for it with a caliper.
const Effect& longer_paths() {
  static const Effect effect = [] {
    Effect paths;
    paths.name = "longer_paths";
    paths.parameters = {path_parameter("square1", [](Imperfections& at) -> double& { return at.joint.path1.square; }),
                        path_parameter("cube1", [](Imperfections& at) -> double& { return at.joint.path1.cube; }),
                        path_parameter("square2", [](Imperfections& at) -> double& { return at.joint.path2.square; }),
                        path_parameter("cube2", [](Imperfections& at) -> double& { return at.joint.path2.cube; })};
    return paths;
  }();
  return effect;
}

}  // namespace

std::vector<double> under_other_geometry(const Evidence& evidence, Workers& workers, const Selection& selection,
                                         const std::vector<bool>& asked) {
  std::vector<double> scores(asked.size(), -std::numeric_limits<double>::infinity());
  if (evidence.declared->transmission) return scores;
  workers.each(asked.size(), [&](const Fitter& fitter, std::size_t i) {
    const Fit& without = selection.without[i];
    if (!asked[i] || !without.usable) return;
    EffectSet effects = without.effects;
    effects.push_back(&longer_paths());
    const Fit fit = fitter.fit(effects, without.at);
    if (fit.usable) scores[i] = score(fit);
  });
  return scores;
}

}  // namespace fusee
