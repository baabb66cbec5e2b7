#include "calibration/row_facts.h"

#include <algorithm>
#include <cmath>

#include "measurement/seen_span.h"

namespace fusee {

std::vector<RowFacts> row_facts(const Evidence& evidence) {
  const SeenSpan span = seen_span(evidence.measurement, &Sample::alpha);
  double most_load = 0;
  double most_speed = 0;
  std::vector<std::size_t> offset;
  std::size_t rows = 0;
  for (const Run& run : evidence.measurement.runs) {
    offset.push_back(rows);
    rows += run.samples.size();
    most_speed = std::max(most_speed, run.has_time ? run.speed : 0.0);
    for (const Sample& sample : run.samples)
      most_load = std::max(most_load, run.has_load ? std::abs(sample.load) : 0.0);
  }
  std::vector<RowFacts> facts;
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b) {
    const Block& block = evidence.blocks[b];
    const Run& run = evidence.measurement.runs[block.run];
    const double begin = run.samples.front().time;
    const double half = std::max(1e-9, 0.5 * (run.samples.back().time - begin));
    for (const std::size_t row : block.rows) {
      const Sample& sample = run.samples[row - offset[block.run]];
      const double begun = run.samples[run.strokes[block.stroke].first].alpha;
      facts.push_back({sample.alpha, sample.theta, span.any() ? (sample.alpha - span.least) / span.size() : 0.0,
                       static_cast<double>(run.strokes[block.stroke].direction),
                       span.any() ? std::abs(sample.alpha - begun) / span.size() : 0.0,
                       run.has_load && most_load > 0 ? sample.load / most_load : 0.0,
                       run.has_time && most_speed > 0 ? run.speed / most_speed : 0.0,
                       run.has_time ? (sample.time - begin) / half - 1.0 : 0.0, block.run, b});
    }
  }
  return facts;
}

bool varies(const std::vector<RowFacts>& facts, double RowFacts::*number, double least) {
  SeenSpan span;
  for (const RowFacts& row : facts) span.take(row.*number);
  return span.size() > least;
}

}  // namespace fusee
