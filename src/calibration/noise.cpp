#include <algorithm>
#include <cmath>

#include "calibration/strokes.h"
#include "fusee/calibration/measurement.h"

namespace fusee {
namespace {

/// What was found of pure scatter, with the correlation from row to row that says how much it is worth.
struct Scatter {
  double squares = 0;   ///< of differences scaled to the spread of a single row
  double products = 0;  ///< of neighbours
  double count = 0;
  double pairs = 0;

  void add(const std::vector<double>& differences) {
    for (std::size_t i = 0; i < differences.size(); ++i) {
      squares += differences[i] * differences[i];
      count += 1;
      if (i == 0) continue;
      products += differences[i] * differences[i - 1];
      pairs += 1;
    }
  }
  double variance() const { return count > 0 ? squares / count : 0; }
  double effective() const {
    const double correlation = squares > 0 && pairs > 0 ? std::clamp(products / pairs / variance(), 0.0, 0.99) : 0.0;
    return count * (1 - correlation) / (1 + correlation);
  }
};

/// θ at α on a stroke by the cubic through four neighbours, and the sum of squares of its weights; nothing outside.
struct Looked {
  bool inside = false;
  double theta = 0;
  double load = 0;
  double weight = 1;
};

Looked look_up(const Run& run, const Stroke& stroke, double alpha) {
  const auto at = [&](std::size_t i) -> const Sample& { return run.samples[i]; };
  const double sign = stroke.direction;
  std::size_t low = stroke.first, high = stroke.last;
  if (high - low < 4 || sign * alpha < sign * at(low).alpha || sign * alpha > sign * at(high).alpha) return {};
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (sign * at(middle).alpha <= sign * alpha ? low : high) = middle;
  }
  const std::size_t first = std::clamp(low, stroke.first + 1, stroke.last - 2) - 1;
  Looked looked{true, 0, 0, 0};
  for (std::size_t j = first; j < first + 4; ++j) {
    double weight = 1;
    for (std::size_t k = first; k < first + 4; ++k) {
      const double gap = at(j).alpha - at(k).alpha;
      if (k == j) continue;
      // Rows that stand nearly on one another (a dwell, a quantum) make no cubic.
      if (std::abs(gap) < 0.05 * std::abs(at(high).alpha - at(low).alpha) || gap == 0) return {};
      weight *= (alpha - at(k).alpha) / gap;
    }
    looked.theta += weight * at(j).theta;
    looked.weight += weight * weight;
  }
  looked.load = at(low).load;
  return looked.weight < 3 ? looked : Looked{};
}

/// Away from reversals, where play and friction are still on their way.
bool is_inner(const Run& run, const Stroke& stroke, double alpha) {
  const double from = run.samples[stroke.first].alpha, to = run.samples[stroke.last].alpha;
  const double share = (alpha - from) / (to - from);
  return share > 0.03 && share < 0.97;
}

/// Strokes of one run and direction, whole ones.
std::vector<const Stroke*> whole_strokes(const Run& run, int direction) {
  std::vector<const Stroke*> strokes;
  for (const Stroke& stroke : run.strokes) {
    if (stroke.direction == direction && !stroke.partial) strokes.push_back(&stroke);
  }
  return strokes;
}

bool same_load(const Run& run, double a, double b, double span) { return !run.has_load || std::abs(a - b) <= 0.1 * span + 1e-9; }

double load_span(const Run& run) {
  double least = 0, most = 0;
  bool first = true;
  for (const Sample& sample : run.samples) {
    least = first ? sample.load : std::min(least, sample.load);
    most = first ? sample.load : std::max(most, sample.load);
    first = false;
  }
  return most - least;
}

/// Second differences over three strokes leave out a steady drift; first differences of two do with what there is.
void add_repeats(const Run& run, const std::vector<const Stroke*>& strokes, Scatter& scatter) {
  const double span = run.has_load ? load_span(run) : 0;
  const std::size_t neighbours = strokes.size() >= 3 ? 2 : 1;
  for (std::size_t k = 1; k + neighbours - 1 < strokes.size(); ++k) {
    std::vector<double> differences;
    const Stroke& here = *strokes[k];
    for (std::size_t i = here.first; i <= here.last; ++i) {
      const Sample& sample = run.samples[i];
      if (!is_inner(run, here, sample.alpha)) continue;
      const Looked before = look_up(run, *strokes[k - 1], sample.alpha);
      if (!before.inside || !same_load(run, before.load, sample.load, span)) continue;
      if (neighbours == 1) {
        differences.push_back((sample.theta - before.theta) / std::sqrt(1 + before.weight));
        continue;
      }
      const Looked after = look_up(run, *strokes[k + 1], sample.alpha);
      if (!after.inside || !same_load(run, after.load, sample.load, span)) continue;
      differences.push_back((2 * sample.theta - before.theta - after.theta) / std::sqrt(4 + before.weight + after.weight));
    }
    scatter.add(differences);
  }
}

/// Third differences of neighbouring rows: what is left where there are no repeats. Noise with colour hides from them.
void add_neighbours(const Run& run, Scatter& scatter) {
  for (const Stroke& stroke : run.strokes) {
    std::vector<double> differences;
    for (std::size_t i = stroke.first + 3; i <= stroke.last; ++i) {
      const auto& s = run.samples;
      differences.push_back((s[i].theta - 3 * s[i - 1].theta + 3 * s[i - 2].theta - s[i - 3].theta) / std::sqrt(20.0));
    }
    scatter.add(differences);
  }
}

}  // namespace

NoiseFloor noise_floor(const Measurement& measurement) {
  Scatter repeats;
  for (const Run& run : measurement.runs) {
    for (const int direction : {1, -1}) add_repeats(run, whole_strokes(run, direction), repeats);
  }
  NoiseFloor floor;
  floor.from_repeats = repeats.count >= 20;
  Scatter scatter = repeats;
  if (!floor.from_repeats) {
    scatter = {};
    for (const Run& run : measurement.runs) add_neighbours(run, scatter);
  }
  const double quantum = measurement.theta_quantum / std::sqrt(12.0);
  floor.rms = std::sqrt(scatter.variance() + quantum * quantum);
  floor.degrees_of_freedom = floor.from_repeats ? scatter.effective() : scatter.count / 4;
  return floor;
}

}  // namespace fusee
