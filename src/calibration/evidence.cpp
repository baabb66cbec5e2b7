#include "calibration/evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "calibration/evidence_model.h"
#include "calibration/statistics.h"
#include "measurement/strokes.h"
#include "measurement/value_range.h"
#include "transmission/target_motion.h"

namespace fusee::calibration {
namespace {

/// Rows of a run in a fit: enough for the shape of every stroke, few enough for hundreds of fits.
constexpr std::size_t k_rows_a_run = 170;
constexpr std::size_t k_most_rows = 1500;
/// Factor on the rows of a joint declared by its ratio, which costs next to nothing to simulate.
constexpr std::size_t k_cheaper = 5;
constexpr std::size_t k_least_rows_a_block = 6;
/// Least rows of a dwell in a run of many dwells.
constexpr std::size_t k_rows_a_dwell = 3;
/// Segments repeat one another only if their α end points agree within this share of the range of α. A load that varies
/// with the motion divides strokes into segments at different places; their difference is θ(α), not noise (the jaw of
/// docs/background/real-joint.md).
constexpr double k_place_tolerance = 0.1;

/// Selects whole cycles, evenly spread, so that each keeps enough rows; of other strokes the ends are kept as history.
std::vector<bool> select_strokes(const measurement::Run& run, std::size_t most_pairs) {
  const std::size_t pairs = (run.strokes.size() + 1) / 2;
  std::vector<bool> chosen(run.strokes.size(), true);
  for (std::size_t i = 0; pairs > most_pairs && i < chosen.size(); ++i)
    chosen[i] = (i / 2) * most_pairs / pairs != (i / 2 + 1) * most_pairs / pairs;
  return chosen;
}

/// Use of each row of a run in a fit.
struct RowSelection {
  std::vector<bool> counted;  ///< rows in the residual
  std::vector<bool> kept;     ///< rows in the residual or the history of the motion
};

/// Every n-th row of the selected strokes.
RowSelection sample_every_nth(const measurement::Run& run, std::size_t most) {
  const std::vector<bool> chosen = select_strokes(run, std::max<std::size_t>(1, most / (4 * k_least_rows_a_block)));
  // Rows before, between and after strokes are history if all strokes are selected.
  std::vector<bool> inside(run.samples.size(), std::find(chosen.begin(), chosen.end(), false) == chosen.end());
  for (std::size_t s = 0; s < run.strokes.size(); ++s) {
    for (std::size_t i = run.strokes[s].first; chosen[s] && i <= run.strokes[s].last; ++i) inside[i] = true;
  }
  const auto rows = static_cast<std::size_t>(std::count(inside.begin(), inside.end(), true));
  const std::size_t every = (rows + most - 1) / std::max<std::size_t>(1, most);
  RowSelection selected{std::vector<bool>(run.samples.size(), false), {}};
  std::size_t seen = 0;
  for (std::size_t i = 0; i < run.samples.size(); ++i) selected.counted[i] = inside[i] && seen++ % every == 0;
  selected.kept = selected.counted;
  return selected;
}

/// Equally many rows of each dwell, however long it is.
RowSelection sample_each_dwell(const measurement::Run& run, std::size_t most) {
  const auto dwells = static_cast<std::size_t>(std::count_if(run.segments.begin(), run.segments.end(),
                                                             [](const measurement::Segment& s) { return s.is_dwell; }));
  const std::size_t most_pairs = std::max<std::size_t>(1, most * ((run.strokes.size() + 1) / 2) / dwells);
  const std::vector<bool> chosen = select_strokes(run, most_pairs);
  const std::size_t rows = std::max(most / dwells, k_rows_a_dwell);
  RowSelection selected{std::vector<bool>(run.samples.size(), false), {}};
  for (const measurement::Segment& segment : run.segments) {
    if (!chosen[segment.stroke]) continue;
    const std::size_t count = segment.last - segment.first + 1, used = std::min(count, rows);
    for (std::size_t i = 0; i < used; ++i) selected.counted[segment.first + (2 * i + 1) * count / (2 * used)] = true;
  }
  selected.kept = selected.counted;
  return selected;
}

/// Strokes whose history play and friction require: all, or, of very many, the selected ones and two before each.
std::vector<bool> strokes_kept(const measurement::Run& run, const RowSelection& selected, std::size_t most) {
  std::vector<bool> kept(run.strokes.size(), 2 * run.segments.size() <= 10 * most);
  for (std::size_t s = 0; s < run.strokes.size(); ++s) {
    const auto first = selected.counted.begin() + static_cast<std::ptrdiff_t>(run.strokes[s].first),
               end = selected.counted.begin() + static_cast<std::ptrdiff_t>(run.strokes[s].last) + 1;
    if (std::find(first, end, true) == end) continue;
    for (std::size_t before = 0; before <= std::min<std::size_t>(2, s); ++before) kept[s - before] = true;
  }
  return kept;
}

/// Thins a run, and keeps both ends of each segment as history. `counted`: rows in the residual, in which ends would
/// weigh too much.
measurement::Run thinned(const measurement::Run& run, std::size_t most, std::vector<bool>& counted) {
  if (run.samples.size() <= most) {
    counted.insert(counted.end(), run.samples.size(), true);
    return run;
  }
  RowSelection selected =
      measurement::is_from_point_to_point(run) ? sample_each_dwell(run, most) : sample_every_nth(run, most);
  const std::vector<bool> strokes = strokes_kept(run, selected, most);
  const std::vector<measurement::Segment> segments = measurement::segments_of(run);
  for (const measurement::Segment& segment : segments) {
    if (strokes[segment.stroke]) selected.kept[segment.first] = selected.kept[segment.last] = true;
  }
  measurement::Run thin = run;
  thin.samples.clear();
  thin.strokes.clear();
  thin.segments.clear();
  std::vector<std::size_t> place(run.samples.size());
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    place[i] = thin.samples.size();
    if (!selected.kept[i]) continue;
    thin.samples.push_back(run.samples[i]);
    counted.push_back(selected.counted[i]);
  }
  std::vector<std::size_t> stroke_place(run.strokes.size());
  for (std::size_t s = 0; s < run.strokes.size(); ++s) {
    stroke_place[s] = thin.strokes.size();
    if (!strokes[s]) continue;
    measurement::Stroke stroke = run.strokes[s];
    stroke.first = place[stroke.first];
    stroke.last = place[stroke.last];
    thin.strokes.push_back(stroke);
  }
  for (measurement::Segment segment : segments) {
    if (!strokes[segment.stroke]) continue;
    segment.first = place[segment.first];
    segment.last = place[segment.last];
    segment.stroke = stroke_place[segment.stroke];
    thin.segments.push_back(segment);
  }
  return thin;
}

/// Load level: the mean, or its size if the sign changes within the rows.
class LoadLevel {
 public:
  void take(double load) {
    sum_ += load;
    squares_ += load * load;
    ++count_;
  }
  double mean() const { return sum_ / static_cast<double>(std::max<std::size_t>(1, count_)); }
  double load() const {
    const double size = std::sqrt(squares_ / static_cast<double>(std::max<std::size_t>(1, count_)));
    return std::abs(mean()) > 0.5 * size ? std::copysign(size, sum_) : size;
  }

 private:
  double sum_ = 0, squares_ = 0;
  std::size_t count_ = 0;
};

LoadLevel level_of(const measurement::Run& run, std::size_t first, std::size_t last) {
  LoadLevel level;
  for (std::size_t i = first; run.has_load && i <= last; ++i) level.take(run.samples[i].load);
  return level;
}

/// Groups of about equal values, as indices into `values`.
std::vector<std::vector<std::size_t>> levels(const std::vector<double>& values, double tolerance) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<std::vector<std::size_t>> found;
  for (const std::size_t i : order) {
    if (found.empty() || values[i] - values[found.back().front()] > tolerance) found.emplace_back();
    found.back().push_back(i);
  }
  return found;
}

double load_tolerance(const std::vector<double>& loads) {
  if (loads.empty()) return 0;
  const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
  return std::max(1e-9, 0.08 * (*most - *least));
}

/// Blocks with a load level of their own: loads of one direction differ within the run. A load that changes sign with
/// the motion is a level of the run.
std::vector<bool> have_their_own_load(const Evidence& evidence) {
  std::vector<double> loads;
  for (const Block& block : evidence.blocks) loads.push_back(block.load);
  const double tolerance = load_tolerance(loads);
  std::map<std::pair<std::size_t, int>, measurement::ValueRange> spans;
  const auto key = [&](const Block& block) {
    return std::pair(block.run, evidence.measurement.runs[block.run].strokes[block.stroke].direction);
  };
  for (const Block& block : evidence.blocks) spans[key(block)].take(block.load);
  std::vector<bool> own;
  for (const Block& block : evidence.blocks) {
    const measurement::ValueRange& span = spans[key(block)];
    const double largest = std::max(std::abs(span.least), std::abs(span.most));
    own.push_back(span.any() && span.size() > std::max(2 * tolerance, 0.1 * largest));
  }
  return own;
}

/// Load levels, as folds of blocks.
std::vector<Fold> load_levels(const Evidence& evidence) {
  const std::vector<bool> own = have_their_own_load(evidence);
  std::vector<double> runs, loads;
  for (const measurement::Run& run : evidence.measurement.runs)
    runs.push_back(run.samples.empty() ? 0 : level_of(run, 0, run.samples.size() - 1).load());
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b)
    loads.push_back(own[b] ? evidence.blocks[b].load : runs[evidence.blocks[b].run]);
  return levels(loads, load_tolerance(loads));
}

std::vector<Fold> speed_levels(const Evidence& evidence) {
  // Dwells have no speed: slower than any sweep.
  constexpr double held = -20;
  std::vector<double> speeds;
  for (const Block& block : evidence.blocks) {
    const measurement::Run& run = evidence.measurement.runs[block.run];
    speeds.push_back(!run.has_time                              ? 0.0
                     : run.speed > 0                            ? elementary::log(run.speed)
                     : measurement::is_from_point_to_point(run) ? held
                                                                : 0.0);
  }
  return levels(speeds, 0.15);
}

std::vector<std::size_t> blocks_of(const Evidence& evidence, const std::vector<std::size_t>& runs) {
  std::vector<std::size_t> found;
  for (std::size_t b = 0; b < evidence.blocks.size(); ++b) {
    if (std::find(runs.begin(), runs.end(), evidence.blocks[b].run) != runs.end()) found.push_back(b);
  }
  return found;
}

/// Whole runs in turn, or the blocks of a single run.
std::vector<Fold> run_folds(const Evidence& evidence) {
  std::vector<Fold> folds;
  if (evidence.measurement.runs.size() == 1) {
    for (std::size_t b = 0; b < evidence.blocks.size(); ++b) folds.push_back({b});
    return folds;
  }
  for (std::size_t i = 0; i < evidence.measurement.runs.size(); ++i) {
    Fold fold = blocks_of(evidence, {i});
    if (!fold.empty()) folds.push_back(std::move(fold));
  }
  return folds;
}

/// Whole levels of load and speed if enough data remain to fit; blocks in no such level as in run_folds().
void choose_factor_folds(Evidence& evidence) {
  std::set<std::size_t> held;
  const auto hold = [&](const std::string& factor, std::vector<Fold> all) {
    bool any = false;
    for (Fold& fold : all) {
      if (all.size() < 2 || fold.size() > 0.6 * static_cast<double>(evidence.blocks.size())) continue;
      std::sort(fold.begin(), fold.end());
      held.insert(fold.begin(), fold.end());
      evidence.factor_folds.push_back(fold);
      any = true;
    }
    if (any) evidence.factors.push_back(factor);
  };
  hold("load", load_levels(evidence));
  hold("speed", speed_levels(evidence));
  if (evidence.factors.empty()) {
    evidence.factor_folds = evidence.run_folds;
    return;
  }
  for (Fold fold : evidence.run_folds) {
    std::erase_if(fold, [&](std::size_t block) { return held.count(block) > 0; });
    if (!fold.empty()) evidence.factor_folds.push_back(std::move(fold));
  }
}

/// Rows of a stroke near their neighbours: no effect moves a single row.
std::vector<std::size_t> without_outliers(const Eigen::VectorXd& residual, std::size_t first, std::size_t last,
                                          double floor) {
  std::vector<std::size_t> rows;
  for (std::size_t i = first; i <= last; ++i) {
    std::vector<double> near;
    const std::size_t from = i >= first + 2 ? i - 2 : first;
    for (std::size_t j = from; j <= std::min(last, i + 2); ++j) near.push_back(residual[static_cast<Eigen::Index>(j)]);
    const double middle = measurement::median_of(near);
    double spread = 0;
    for (const double value : near)
      spread = std::max(spread, value == residual[static_cast<Eigen::Index>(i)] ? 0.0 : std::abs(value - middle));
    if (std::abs(residual[static_cast<Eigen::Index>(i)] - middle) <= 6.0 * floor + 3.0 * spread) rows.push_back(i);
  }
  return rows;
}

// ---- caliper readings -----------------------------------------------------------------------------------------------

std::vector<HandReading> hand_readings(const DeclaredMechanism& declared) {
  std::vector<HandReading> readings;
  for (const fusee::Effect& effect : effects(kind_of(declared))) {
    for (const EffectParameter& parameter : effect.parameters) {
      if (parameter.by_hand.readings == nullptr) continue;
      for (const ManualReading& reading : parameter.by_hand.readings(declared))
        readings.push_back({&parameter, reading.value, reading.uncertainty});
    }
  }
  return readings;
}

}  // namespace

RowsOfRuns outliers_of(const measurement::Measurement& measurement, double floor,
                       const std::vector<std::vector<double>>& about_declared) {
  RowsOfRuns outliers(measurement.runs.size());
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    const std::vector<double>& about = about_declared[r];
    const Eigen::VectorXd all =
        Eigen::Map<const Eigen::VectorXd>(about.data(), static_cast<Eigen::Index>(about.size()));
    for (const measurement::Segment& segment : measurement::segments_of(measurement.runs[r])) {
      const std::vector<std::size_t> kept = without_outliers(all, segment.first, segment.last, floor);
      for (std::size_t i = segment.first; i <= segment.last; ++i) {
        if (!std::binary_search(kept.begin(), kept.end(), i)) outliers[r].push_back(i);
      }
    }
  }
  return outliers;
}

std::size_t exclude_rows(const RowsOfRuns& rows, std::vector<std::vector<double>>& residuals) {
  std::size_t count = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (const std::size_t i : rows[r]) {
      count += std::isfinite(residuals[r][i]) ? 1 : 0;
      residuals[r][i] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return count;
}

Eigen::VectorXd flat(const joint::Readings& readings) {
  std::size_t count = 0;
  for (const auto& run : readings) count += run.size();
  Eigen::VectorXd all(static_cast<Eigen::Index>(count));
  Eigen::Index i = 0;
  for (const auto& run : readings) {
    for (const double value : run) all[i++] = value;
  }
  return all;
}

std::vector<std::string> Evidence::run_names(const Fold& fold) const {
  std::vector<std::string> names;
  for (const std::size_t block : fold) {
    const std::string& name = measurement.runs[blocks[block].run].name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::vector<Eigen::Index> Evidence::rows() const {
  std::vector<Eigen::Index> all;
  for (const Block& block : blocks) {
    for (const std::size_t row : block.rows) all.push_back(static_cast<Eigen::Index>(row));
  }
  return all;
}

std::size_t Evidence::rows_used() const {
  std::size_t rows = 0;
  for (const Block& block : blocks) rows += block.rows.size();
  return rows;
}

namespace {

/// Thins all runs to the rows that many fits can afford.
measurement::Measurement thinned(const Mechanism& declared, measurement::Measurement measurement,
                                 std::vector<bool>& counted) {
  const std::size_t runs = std::max<std::size_t>(1, measurement.runs.size());
  const std::size_t cheaper = declared.transmission ? k_cheaper : 1;
  const std::size_t most = cheaper * std::min(k_rows_a_run, std::max<std::size_t>(60, k_most_rows / runs));
  for (measurement::Run& run : measurement.runs) run = thinned(run, most, counted);
  return measurement;
}

Eigen::VectorXd measured_theta(const measurement::Measurement& measurement) {
  joint::Readings theta;
  for (const measurement::Run& run : measurement.runs) {
    theta.emplace_back();
    for (const measurement::Sample& sample : run.samples) theta.back().push_back(sample.theta);
  }
  return flat(theta);
}

double largest_load(const measurement::Measurement& measurement) {
  double most = 0;
  for (const measurement::Run& run : measurement.runs) {
    for (const measurement::Sample& sample : run.samples)
      most = std::max(most, run.has_load ? std::abs(sample.load) : 0.0);
  }
  return most;
}

/// Properties by which two segments of a run repeat each other.
struct SegmentKind {
  int direction = 0;
  bool is_dwell = false;
  int pull = 0;
  double load = 0;
  double from = 0, to = 0;  ///< α at its ends; for joined dwells those of the first
};

class BlockMaker {
 public:
  BlockMaker(const Evidence& evidence, const std::vector<bool>& counted)
      : evidence_(evidence),
        counted_(counted),
        alphas_(measurement::value_range(evidence.measurement, &measurement::Sample::alpha)) {
    measurement::ValueRange loads;
    for (const measurement::Run& run : evidence.measurement.runs) {
      for (const measurement::Sample& sample : run.samples) loads.take(run.has_load ? sample.load : 0.0);
    }
    load_tolerance_ = loads.any() ? 0.12 * loads.size() : 0;
    joint::Forward forward(*evidence.declared, evidence.log, evidence.earlier);
    residual_ = evidence.theta - flat(forward({}));
  }

  std::vector<Block> made() {
    for (std::size_t i = 0; i < evidence_.measurement.runs.size(); ++i) add_run(i);
    return std::move(blocks_);
  }

 private:
  /// Dwells of too few rows, to be joined with others of their kind.
  struct PendingBlock {
    SegmentKind kind;
    Block block;
  };

  void add_run(std::size_t i) {
    const measurement::Run& run = evidence_.measurement.runs[i];
    kinds_.clear();
    pending_.clear();
    for (const measurement::Segment& segment : measurement::segments_of(run)) {
      if (is_settling(run, segment)) continue;
      const std::size_t first = offset_ + segment.first, last = offset_ + segment.last;
      Block block{i, segment.stroke, without_outliers(residual_, first, last, evidence_.floor)};
      std::erase_if(block.rows, [&](std::size_t row) { return !counted_[row]; });
      if (block.rows.empty()) continue;
      block.load = level_of(run, segment.first, segment.last).mean();
      const SegmentKind kind{run.strokes[segment.stroke].direction,
                             segment.is_dwell,
                             segment.pull,
                             block.load,
                             run.samples[segment.first].alpha,
                             run.samples[segment.last].alpha};
      if (block.rows.size() >= k_least_rows_a_block) {
        add(kind, std::move(block));
      } else if (segment.is_dwell) {
        join(kind, std::move(block));
      }
    }
    // The last joined dwells may have half the rows.
    for (PendingBlock& left : pending_) {
      if (2 * left.block.rows.size() >= k_least_rows_a_block) add(left.kind, std::move(left.block));
    }
    offset_ += run.samples.size();
  }

  /// The state of the play at the beginning of the log is unknown. The first stroke determines it, or the move to the
  /// second dwell.
  static bool is_settling(const measurement::Run& run, const measurement::Segment& segment) {
    if (run.strokes[segment.stroke].partial) return true;
    if (measurement::is_from_point_to_point(run))
      return segment.first == run.segments.front().first && run.segments.size() > 2;
    return segment.stroke == 0 && run.strokes.size() > 2;
  }

  bool in_one_place(const SegmentKind& a, const SegmentKind& b) const {
    const double tolerance =
        (a.is_dwell ? k_dwell_tolerance : k_place_tolerance) * (alphas_.any() ? alphas_.size() : 0.0);
    return std::abs(a.from - b.from) <= tolerance && std::abs(a.to - b.to) <= tolerance;
  }

  bool are_alike(const SegmentKind& a, const SegmentKind& b, bool anywhere) const {
    return a.direction == b.direction && a.is_dwell == b.is_dwell && a.pull == b.pull &&
           (anywhere || in_one_place(a, b)) && std::abs(a.load - b.load) <= load_tolerance_;
  }

  void add(const SegmentKind& kind, Block block) {
    auto found =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const SegmentKind& k) { return are_alike(k, kind, false); });
    if (found == kinds_.end()) found = kinds_.insert(kinds_.end(), kind);
    block.alike = static_cast<std::size_t>(found - kinds_.begin());
    blocks_.push_back(std::move(block));
  }

  void join(const SegmentKind& kind, Block block) {
    const auto found = std::find_if(pending_.begin(), pending_.end(),
                                    [&](const PendingBlock& other) { return are_alike(other.kind, kind, true); });
    if (found == pending_.end()) {
      pending_.push_back({kind, std::move(block)});
      return;
    }
    Block& joined = found->block;
    const double before = static_cast<double>(joined.rows.size()), more = static_cast<double>(block.rows.size());
    joined.load = (before * joined.load + more * block.load) / (before + more);
    joined.rows.insert(joined.rows.end(), block.rows.begin(), block.rows.end());
    if (joined.rows.size() < k_least_rows_a_block) return;
    add(found->kind, std::move(joined));
    pending_.erase(found);
  }

  const Evidence& evidence_;
  const std::vector<bool>& counted_;
  measurement::ValueRange alphas_;
  double load_tolerance_ = 0;
  Eigen::VectorXd residual_;  ///< residual of the declared joint
  std::size_t offset_ = 0;
  std::vector<SegmentKind> kinds_;  ///< kinds of this run
  std::vector<PendingBlock> pending_;
  std::vector<Block> blocks_;
};

/// Deflection of the declared joint, all rows, rad. For a joint declared by its ratio, which is rigid, the load.
Eigen::VectorXd deflection(const Evidence& evidence, const Eigen::VectorXd& declared) {
  const transmission::TargetMotion law(*evidence.declared);
  Eigen::VectorXd deflection = declared;
  if (evidence.declared->transmission) {
    Eigen::Index at = 0;
    for (const measurement::Run& run : evidence.measurement.runs) {
      for (const measurement::Sample& sample : run.samples) deflection[at++] = run.has_load ? sample.load : 0.0;
    }
    return deflection;
  }
  if (!law.exists()) return {};
  Eigen::Index row = 0;
  for (const measurement::Run& run : evidence.measurement.runs) {
    for (const measurement::Sample& sample : run.samples) deflection[row++] -= law.theta_extrapolated(sample.alpha);
  }
  for (double& angle : deflection) angle = std::isfinite(angle) ? angle : 0.0;
  return deflection;
}

}  // namespace

void weigh(Evidence& evidence) {
  joint::Forward forward(*evidence.declared, evidence.log, evidence.earlier);
  const Eigen::VectorXd declared = flat(forward({}));
  Discrepancy discrepancy = discrepancy_of(evidence, deflection(evidence, declared));
  const Eigen::VectorXd residual = (evidence.theta - declared)(evidence.rows());
  Tangent nothing;
  nothing.residual = residual.unaryExpr([](double angle) { return std::isfinite(angle) ? angle : 0.0; });
  nothing.J.resize(residual.size(), 0);
  const EvidenceModel white(std::move(discrepancy), evidence.floor, 1.0);
  const Posterior explained = white.best(nothing, white.first_guess());
  const Eigen::VectorXd noise = nothing.residual - white.discrepancy().columns * explained.coefficients;
  const double autocorrelation = std::clamp(lag_one_correlation(evidence, noise), 0.0, 0.95);
  evidence.evidence_model = std::make_shared<const EvidenceModel>(
      white, (1.0 - autocorrelation) / (1.0 + autocorrelation), explained.amplitudes);
}

measurement::Measurement with_fewer_rows(measurement::Measurement measurement, std::size_t most_a_run) {
  std::vector<bool> counted;
  for (measurement::Run& run : measurement.runs) run = thinned(run, most_a_run, counted);
  return measurement;
}

Evidence gather(const DeclaredMechanism& declared, const measurement::Measurement& measurement, double floor,
                const std::optional<joint::EarlierState>& earlier) {
  Evidence evidence;
  evidence.declared = &declared;
  evidence.earlier = earlier;
  evidence.floor = floor;
  std::vector<bool> counted;
  evidence.measurement = thinned(declared, measurement, counted);
  evidence.log = measurement::bench_log(evidence.measurement);
  evidence.theta = measured_theta(evidence.measurement);
  evidence.largest_load = largest_load(evidence.measurement);
  evidence.blocks = BlockMaker(evidence, counted).made();
  evidence.run_folds = run_folds(evidence);
  choose_factor_folds(evidence);
  if (!earlier) evidence.readings = hand_readings(declared);  // calipers measure a joint and no change
  weigh(evidence);
  return evidence;
}

}  // namespace fusee::calibration
