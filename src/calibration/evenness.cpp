#include "calibration/evenness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "calibration/marginal.h"
#include "calibration/parameters.h"
#include "calibration/row_facts.h"
#include "calibration/statistics.h"

// An effect has one set of numbers for all rows. What it is mistaken for has its own law: in some runs, one way, at one
// end or under some loads it is more of what the effect does, in others less or the opposite. So each effect may be of
// another size in each part of the rows, and what that gains is weighed as any number is. A true effect gains nothing
// by it, or little where what has no name is as large as itself.

namespace fusee {
namespace {

constexpr int k_size_rounds = 6;
constexpr int k_thirds = 3;
/// Of the largest load: what is as good as none, and what is a large one.
constexpr double k_no_load = 0.05;
constexpr double k_large_load = 0.6;
/// An effect may as well be none as twice as large in a part of the rows.
constexpr double k_prior = 1.0;

/// Rows by a number of theirs.
struct Partition {
  const char* words;
  const char* separating_run;
  int (*part)(const RowFacts& row);
};

int load_part(const RowFacts& row) {
  const double size = std::abs(row.load);
  const int step = size < k_no_load ? 0 : size < k_large_load ? 1 : 2;
  return row.load < 0 ? -step : step;
}

constexpr std::array k_partitions = {
    Partition{"from run to run", "repeat one run five times without touching anything: an effect is as large in each",
              [](const RowFacts& row) { return static_cast<int>(row.run); }},
    Partition{"one way than the other",
              "come to each place from both sides in steps, without load and with the largest",
              [](const RowFacts& row) { return row.direction > 0 ? 1 : 0; }},
    Partition{"from place to place", "repeat the slow unloaded run with ten times as many rows",
              [](const RowFacts& row) { return place_bin(row, k_thirds); }},
    Partition{"from load to load",
              "stand at three places and put the load on and off in eight steps, both signs: an effect follows its law "
              "over all of them",
              load_part},
};

/// `base` with a number more for each part of the rows: by how much of itself `done` is larger there.
Tangent of_another_size(const Tangent& base, const Eigen::VectorXd& done, const std::vector<RowFacts>& rows,
                        const Partition& partition) {
  std::map<int, Eigen::Index> places;
  for (const RowFacts& row : rows) places.emplace(partition.part(row), 0);
  Eigen::Index count = 0;
  for (auto& [part, place] : places) place = base.x.size() + count++;
  Tangent tangent = base;
  add_numbers(Eigen::VectorXd::Constant(count, k_prior), tangent);
  tangent.J.conservativeResize(Eigen::NoChange, base.x.size() + count);
  tangent.J.rightCols(count).setZero();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    tangent.J(row, places.at(partition.part(rows[i]))) = done[row];
  }
  return tangent;
}

}  // namespace

std::vector<Evenness> evenness(const Evidence& evidence, Workers& workers, const Selection& selection) {
  const Fit& best = selection.best;
  const std::vector<RowFacts> rows = row_facts(evidence);
  const Tangent base = tangent_of(evidence, best);
  const auto likely = [&](const Tangent& tangent) {
    return evidence.marginal->best(tangent, best.explained.amplitudes, k_size_rounds).log_evidence;
  };
  const double even = likely(base);
  std::vector<Evenness> all(best.effects.size());
  workers.each(all.size(), [&](const Fitter& fitter, std::size_t i) {
    const Eigen::VectorXd done = fitter.done_by(best, *best.effects[i]);
    if (!done.allFinite()) return;
    all[i].part = rms_of(done) / std::max(rms_of(base.residual), std::numeric_limits<double>::min());
    for (const Partition& partition : k_partitions) {
      const double gain = likely(of_another_size(base, done, rows, partition)) - even;
      if (!(gain > all[i].uneven)) continue;
      all[i].uneven = gain;
      all[i].words = partition.words;
      all[i].separating_run = partition.separating_run;
    }
  });
  return all;
}

}  // namespace fusee
