#include "calibration/row_facts.h"

#include <algorithm>
#include <cmath>

#include "fusee/joint.h"
#include "measurement/value_range.h"

namespace fusee::calibration {
namespace {

/// Time, travel and load changes before a row.
struct SessionProgress {
  double time = 0, way = 0, loading = 0;
};

/// Progress at each row of each run, as shares of the session's totals.
std::vector<std::vector<SessionProgress>> session_progress(const Evidence& evidence) {
  const std::vector<double> clock = joint::bench_clock(evidence.log);
  std::vector<std::vector<SessionProgress>> all;
  const measurement::Sample* before = nullptr;
  SessionProgress so_far;
  double begin = 0;
  for (std::size_t i = 0; i < clock.size(); ++i) {
    std::vector<SessionProgress>& run = all.emplace_back();
    for (const measurement::Sample& sample : evidence.measurement.runs[i].samples) {
      const double now = clock[i] + sample.time;
      if (before == nullptr) {
        begin = now;
      } else {
        so_far.way += std::abs(sample.alpha - before->alpha);
        so_far.loading += std::abs(sample.load - before->load);
      }
      so_far.time = now - begin;
      run.push_back(so_far);
      before = &sample;
    }
  }
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  for (std::vector<SessionProgress>& run : all) {
    for (SessionProgress& by : run)
      by = {share(by.time, so_far.time), share(by.way, so_far.way), share(by.loading, so_far.loading)};
  }
  return all;
}

}  // namespace

int place_bin(const RowFacts& row, int count) { return measurement::Bins{{0, 1}, count}.bin(row.place); }

std::vector<RowFacts> row_facts(const Evidence& evidence) {
  const measurement::ValueRange span = measurement::value_range(evidence.measurement, &measurement::Sample::alpha);
  const std::vector<std::vector<SessionProgress>> gone = session_progress(evidence);
  double most_speed = 0;
  std::vector<std::size_t> offset;
  std::size_t rows = 0;
  for (const measurement::Run& run : evidence.measurement.runs) {
    offset.push_back(rows);
    rows += run.samples.size();
    most_speed = std::max(most_speed, run.has_time ? run.speed : 0.0);
  }
  std::vector<RowFacts> facts;
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b) {
    const Block& block = evidence.blocks[b];
    const measurement::Run& run = evidence.measurement.runs[block.run];
    const double begin = run.samples.front().time;
    const double half = std::max(1e-9, 0.5 * (run.samples.back().time - begin));
    for (const std::size_t row : block.rows) {
      const std::size_t place = row - offset[block.run];
      const measurement::Sample& sample = run.samples[place];
      const SessionProgress& by = gone[block.run][place];
      const double begun = run.samples[run.strokes[block.stroke].first].alpha;
      facts.push_back({sample.alpha, sample.theta, span.any() ? (sample.alpha - span.least) / span.size() : 0.0,
                       static_cast<double>(run.strokes[block.stroke].direction),
                       span.any() ? std::abs(sample.alpha - begun) / span.size() : 0.0,
                       run.has_load && evidence.largest_load > 0 ? sample.load / evidence.largest_load : 0.0,
                       run.has_time && most_speed > 0 ? run.speed / most_speed : 0.0,
                       run.has_time ? (sample.time - begin) / half - 1.0 : 0.0, by.time, by.way, by.loading, block.run,
                       b});
    }
  }
  return facts;
}

bool varies(const std::vector<RowFacts>& facts, double RowFacts::*number, double least) {
  measurement::ValueRange span;
  for (const RowFacts& row : facts) span.take(row.*number);
  return span.size() > least;
}

}  // namespace fusee::calibration
