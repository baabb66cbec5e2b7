#include "calibration/verdict.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "fusee/base/text.h"

namespace fusee {
namespace {

constexpr int k_bins = 12;
/// The rest is at the floor while its mean square is less than this many times the floor's.
constexpr double k_at_floor = 1.35;

std::string in_degrees(double angle) { return rounded(degrees(angle), 3) + "°"; }

struct Bin {
  double sum = 0;
  double count = 0;
  double mean() const { return count > 0 ? sum / count : 0; }
};

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

Rest look_at_rest(const Evidence& evidence, const Fit& fit) {
  Rest rest;
  rest.structure = std::sqrt(std::max(0.0, fit.by_run.mean_square - fit.price - evidence.floor * evidence.floor));
  double least = 1e300;
  double most = -1e300;
  std::vector<const Sample*> samples;
  for (const Run& run : evidence.measurement.runs) {
    for (const Sample& sample : run.samples) {
      samples.push_back(&sample);
      least = std::min(least, sample.alpha);
      most = std::max(most, sample.alpha);
    }
  }
  const auto bin_of = [&](std::size_t row) {
    return std::clamp(static_cast<int>(k_bins * (samples[row]->alpha - least) / (most - least)), 0, k_bins - 1);
  };
  std::map<std::pair<int, int>, Bin> places;  // by place and direction, over all runs
  double products = 0;
  double squares = 0;
  for (const Block& block : evidence.blocks) {
    const int direction = evidence.measurement.runs[block.run].strokes[block.stroke].direction;
    for (std::size_t i = 0; i < block.rows.size(); ++i) {
      const double r = fit.residual[static_cast<Eigen::Index>(block.rows[i])];
      if (i > 0) products += r * fit.residual[static_cast<Eigen::Index>(block.rows[i - 1])];
      squares += r * r;
      Bin& bin = places[{bin_of(block.rows[i]), direction}];
      bin.sum += r;
      bin.count += 1;
    }
  }
  rest.autocorrelation = squares > 0 ? products / squares : 0;
  const auto largest = std::max_element(places.begin(), places.end(), [](const auto& a, const auto& b) {
    return std::abs(a.second.mean()) < std::abs(b.second.mean());
  });
  if (largest != places.end()) {
    const double from = least + (most - least) * largest->first.first / k_bins;
    rest.where = "largest at alpha " + rounded(degrees(from), 3) + " … " +
                 rounded(degrees(from + (most - least) / k_bins), 3) + "°, " +
                 (largest->first.second > 0 ? "rising" : "falling") + ": " + in_degrees(largest->second.mean()) +
                 " on average";
  }
  return rest;
}

void conclude(const Evidence& evidence, const Selection& selection, Calibration& calibration) {
  const Rest rest = look_at_rest(evidence, selection.best);
  const double floor = evidence.floor;
  const double after = std::pow(held_out_rms(selection.best), 2);
  const bool above = after > k_at_floor * floor * floor;
  const StrokeScatter scatter = stroke_scatter(evidence, selection.best);
  std::vector<std::string> names;
  bool confounded = false;
  for (const FoundEffect& effect : calibration.effects) {
    names.push_back(effect.group.size() > 1 ? "one of {" + list(effect.group) + "}" : effect.name);
    confounded = confounded || effect.group.size() > 1;
  }
  const std::string figures = "Held-out error " + in_degrees(calibration.before.held_out_rms) + " before, " +
                              in_degrees(calibration.after.held_out_rms) + " after, noise floor " + in_degrees(floor) +
                              ".";
  calibration.rest_autocorrelation = rest.autocorrelation;
  if (above) {
    calibration.unexplained_rms = rest.structure;
    calibration.unexplained_where = rest.where;
  }
  if (is_walking(scatter)) {
    calibration.verdict = "not_repeatable";
    calibration.summary = "The same angle, direction and load give joint angles that differ by " +
                          in_degrees(scatter.between) +
                          " rms from stroke to stroke: look for something loose before any correction. " + figures;
    calibration.next_runs.insert(calibration.next_runs.begin(),
                                 "tighten what can be loose and repeat one run five times without touching anything");
  } else if (above) {
    calibration.verdict = "unexplained";
    calibration.summary =
        (names.empty() ? "No effect of the catalogue explains what was measured" : "Found " + list(names)) + "; " +
        in_degrees(rest.structure) + " rms stay unexplained, " + rest.where + ". " + figures;
    calibration.next_runs.push_back(
        "turn the pulley on its shaft by a quarter turn and repeat the slow unloaded run: what moves with it is the "
        "pulley's");
  } else if (confounded) {
    calibration.verdict = "confounded";
    calibration.summary = "The data are explained by " + list(names) + ", and cannot tell which. " + figures;
  } else if (!names.empty()) {
    calibration.verdict = "explained";
    calibration.summary = "The data are explained by " + list(names) + ". " + figures;
  } else {
    calibration.verdict = "no_effect";
    calibration.summary = "The joint does what its file declares, as far as the data can tell. " + figures;
  }
}

}  // namespace fusee
