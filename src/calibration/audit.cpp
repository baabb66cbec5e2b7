#include "calibration/audit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/normal_numbers.h"
#include "calibration/thresholds.h"

// Synthetic data: the declared joint with all found effects but one, logged as these runs were, with their noise. One
// of four replaces the effect: nothing, an effect of the catalogue, an effect that the search does not know, or a
// smooth discrepancy of its size. The model is linear about the fit, by chords of each effect over its expected sizes,
// so a data set is a vector of sums and a search takes milliseconds. The search adds the best effect, at the penalty of
// a reported effect. A true cause that would join the group is no false positive.

namespace fusee::calibration {
namespace {

constexpr int k_data_sets = 200;
/// True causes that join a group.
constexpr std::size_t k_most_true_causes = 6;
constexpr int k_rounds = 6;
/// Least size of a true cause, as a share of the size of the found effect.
constexpr double k_as_large = 0.5;

/// Columns of an effect's chords over the rows in use.
struct ChordColumns {
  const fusee::Effect* effect = nullptr;
  Eigen::Index first = 0;
  Eigen::Index count = 0;
};

/// Prior size of a number, with caliper readings.
double known_size(const Tangent& tangent, Eigen::Index k) {
  return 1.0 / std::sqrt(1.0 / (tangent.prior[k] * tangent.prior[k]) + tangent.caliper_information(k, k));
}

void count(const fusee::Effect* effect, std::vector<std::pair<int, const fusee::Effect*>>& counts) {
  const auto known = std::find_if(counts.begin(), counts.end(), [&](const auto& one) { return one.second == effect; });
  if (known == counts.end()) {
    counts.emplace_back(1, effect);
  } else {
    ++known->first;
  }
}

class Auditor {
 public:
  Auditor(const Evidence& evidence, FitterPool& pool, const Selection& selection);

  AuditResult audit_effect(std::size_t found, FitterPool& pool) const;

 private:
  struct SyntheticDataset {
    Eigen::VectorXd projections;  ///< Aᵀ z
    double rr = 0;
    const fusee::Effect* true_cause = nullptr;  ///< true cause in the place of the found effect
    const fusee::Effect* excluded = nullptr;    ///< effect that the search does not know
    Amplitudes start;
  };
  using Set = std::vector<std::size_t>;
  SyntheticDataset synthesize(std::size_t found, std::size_t number) const;
  Eigen::VectorXd noise(NormalNumbers& normal) const;
  TangentSums sums(const SyntheticDataset& data, const Set& set) const;
  double penalty(const Set& set) const;
  LinearizedSet evaluate(const SyntheticDataset& data, const Set& set) const;
  Set search(const SyntheticDataset& data, const Set& set) const;
  bool is_group_member(const SyntheticDataset& data, const Set& found, std::size_t named) const;

  const Evidence& evidence_;
  const Selection& selection_;
  const EvidenceModel& evidence_model_;
  std::vector<ChordColumns> chords_;
  Eigen::VectorXd x_;  ///< numbers as found; zero for other effects
  Eigen::VectorXd prior_;
  Eigen::MatrixXd all_;  ///< chords, then columns of the discrepancy
  Eigen::MatrixXd gram_;
  Eigen::Index own_ = 0;  ///< number of chord columns
  double deflection_ratio_ = 1;
};

Auditor::Auditor(const Evidence& evidence, FitterPool& pool, const Selection& selection)
    : evidence_(evidence), selection_(selection), evidence_model_(*evidence.evidence_model) {
  const EffectSet& catalogue = selection.catalogue;
  std::vector<Tangent> candidates(catalogue.size());
  const Tangent best = tangent_of(evidence, selection.best);
  deflection_ratio_ = best.deflection_ratio;
  pool.each(catalogue.size(), [&](const Fitter& fitter, std::size_t i) {
    if (contains(selection.best.effects, *catalogue[i])) return;
    const Fit wider = fitter.add_chords(selection.best, *catalogue[i]);
    if (wider.usable) candidates[i] = tangent_of(evidence, wider);
  });
  std::vector<Eigen::VectorXd> columns;
  std::vector<double> x, prior;
  for (std::size_t i = 0; i < catalogue.size(); ++i) {
    ChordColumns own{catalogue[i], static_cast<Eigen::Index>(columns.size()), 0};
    if (contains(selection.best.effects, *catalogue[i])) {
      for (const Eigen::Index at : places_of(selection.best, *catalogue[i])) {
        columns.push_back(best.J.col(at));
        x.push_back(best.x[at]);
        prior.push_back(known_size(best, at));
      }
    } else if (candidates[i].x.size() > best.x.size()) {
      for (Eigen::Index k = best.x.size(); k < candidates[i].x.size(); ++k) {
        columns.push_back(candidates[i].J.col(k));
        x.push_back(0);
        prior.push_back(known_size(candidates[i], k));
      }
    }
    own.count = static_cast<Eigen::Index>(columns.size()) - own.first;
    chords_.push_back(own);
  }
  own_ = static_cast<Eigen::Index>(columns.size());
  const Eigen::MatrixXd& D = evidence_model_.discrepancy().columns;
  all_.resize(D.rows(), own_ + D.cols());
  for (Eigen::Index k = 0; k < own_; ++k) all_.col(k) = columns[static_cast<std::size_t>(k)];
  all_.rightCols(D.cols()) = D;
  gram_ = all_.transpose() * all_;
  x_ = Eigen::Map<const Eigen::VectorXd>(x.data(), own_);
  prior_ = Eigen::Map<const Eigen::VectorXd>(prior.data(), own_);
}

/// Noise of the size and autocorrelation of these runs.
Eigen::VectorXd Auditor::noise(NormalNumbers& normal) const {
  const double colour = (1.0 - evidence_model_.independent_share()) / (1.0 + evidence_model_.independent_share());
  const double size = selection_.best.posterior.amplitudes.noise;
  Eigen::VectorXd noise(all_.rows());
  Eigen::Index row = 0;
  for (const Block& block : evidence_.blocks) {
    double last = normal.next();
    for (std::size_t i = 0; i < block.rows.size(); ++i, ++row) {
      noise[row] = size * last;
      last = colour * last + std::sqrt(1.0 - colour * colour) * normal.next();
    }
  }
  return noise;
}

Auditor::SyntheticDataset Auditor::synthesize(std::size_t found, std::size_t number) const {
  NormalNumbers normal(1000003ULL * (found + 1) + number);
  const std::vector<Family>& families = evidence_model_.discrepancy().families;
  SyntheticDataset data;
  data.start = evidence_model_.first_guess();
  // Families of many columns cost most of the time: used only if the data required them.
  const auto keep = [&](std::size_t f) {
    const Family& family = families[f];
    return family.count <= 12 || selection_.best.posterior.amplitudes.families[static_cast<Eigen::Index>(f)] > 0;
  };
  for (std::size_t f = 0; f < families.size(); ++f) {
    double& amplitude = data.start.families[static_cast<Eigen::Index>(f)];
    if (families[f].fixed > 0) continue;
    amplitude = keep(f) ? std::max(amplitude, evidence_model_.floor()) : 0.0;
  }
  Eigen::VectorXd z = noise(normal);
  double size = 0;
  for (const ChordColumns& one : chords_) {
    if (one.count == 0 || !contains(selection_.best.effects, *one.effect)) continue;
    const Eigen::VectorXd part = all_.middleCols(one.first, one.count) * x_.segment(one.first, one.count);
    if (one.effect == selection_.best.effects[found]) {
      size = rms_of(part);
    } else {
      z += part;
    }
  }
  for (std::size_t f = 0; f < families.size(); ++f) {
    const Family& family = families[f];
    const double amplitude = family.fixed > 0
                                 ? family.fixed * deflection_ratio_
                                 : selection_.best.posterior.amplitudes.families[static_cast<Eigen::Index>(f)];
    if (!(amplitude > 0)) continue;
    for (Eigen::Index k = 0; k < family.count; ++k) z += amplitude * normal.next() * all_.col(own_ + family.first + k);
  }
  const double found_size = size;
  size *= elementary::exp(0.5 * normal.next());
  std::vector<std::size_t> others, shapes;
  for (std::size_t i = 0; i < chords_.size(); ++i) {
    // Equally likely rivals are members of the group already.
    const bool in_group = std::any_of(selection_.rivals.begin(), selection_.rivals.end(), [&](const Rival& rival) {
      return rival.accepted == selection_.best.effects[found] && rival.rival == chords_[i].effect &&
             is_as_good(rival.fit, selection_.best);
    });
    if (chords_[i].count > 0 && !in_group && !contains(selection_.best.effects, *chords_[i].effect))
      others.push_back(i);
  }
  for (std::size_t f = 0; f < families.size(); ++f) {
    if (!(families[f].fixed > 0) && families[f].factor != Factor::stroke) shapes.push_back(f);
  }
  const std::size_t kind = number % 4;  // nothing, an effect, an effect that is not in the search, a discrepancy
  if ((kind == 1 || kind == 2) && !others.empty()) {
    const ChordColumns& other = chords_[others[(number / 4) % others.size()]];
    Eigen::VectorXd part = Eigen::VectorXd::Zero(all_.rows());
    for (Eigen::Index k = 0; k < other.count; ++k)
      part += prior_[other.first + k] * normal.next() * all_.col(other.first + k);
    z += part;
    if (rms_of(part) > k_as_large * found_size) data.true_cause = other.effect;
    if (kind == 2) data.excluded = other.effect;
  } else if (kind == 3 && !shapes.empty()) {
    const std::size_t f = shapes[(number / 4) % shapes.size()];
    const Family& family = families[f];
    Eigen::VectorXd part = Eigen::VectorXd::Zero(all_.rows());
    for (Eigen::Index k = 0; k < family.count; ++k) part += normal.next() * all_.col(own_ + family.first + k);
    z += part * (size / std::max(1e-12, rms_of(part)));
    data.start.families[static_cast<Eigen::Index>(f)] = std::max(size, evidence_model_.floor());
  }
  data.projections = all_.transpose() * z;
  data.rr = z.squaredNorm();
  return data;
}

TangentSums Auditor::sums(const SyntheticDataset& data, const Set& set) const {
  std::vector<Eigen::Index> columns;
  for (const std::size_t i : set) {
    for (Eigen::Index k = 0; k < chords_[i].count; ++k) columns.push_back(chords_[i].first + k);
  }
  const Eigen::Index m = all_.cols() - own_;
  TangentSums sums;
  sums.JJ = gram_(columns, columns);
  sums.JD = gram_(columns, Eigen::seqN(own_, m));
  sums.Jr = data.projections(columns);
  sums.Dr = data.projections.tail(m);
  sums.rr = data.rr;
  sums.rows = static_cast<double>(all_.rows());
  const auto count = static_cast<Eigen::Index>(columns.size());
  sums.x = Eigen::VectorXd::Zero(count);
  sums.prior = prior_(columns);
  sums.caliper_information = Eigen::MatrixXd::Zero(count, count);
  sums.caliper_gradient = Eigen::VectorXd::Zero(count);
  sums.deflection_ratio = deflection_ratio_;
  return sums;
}

double Auditor::penalty(const Set& set) const {
  double sum = 0;
  for (const std::size_t i : set) sum += reporting_penalty(*chords_[i].effect);
  return sum;
}

LinearizedSet Auditor::evaluate(const SyntheticDataset& data, const Set& set) const {
  Posterior posterior = evidence_model_.best(sums(data, set), data.start, k_rounds);
  return {set, std::move(posterior.amplitudes), posterior.log_evidence - penalty(set)};
}

Auditor::Set Auditor::search(const SyntheticDataset& data, const Set& set) const {
  std::vector<double> penalties;
  for (const ChordColumns& chord : chords_) {
    const bool is_known = chord.count > 0 && chord.effect != data.excluded;
    penalties.push_back(is_known ? reporting_penalty(*chord.effect) : std::numeric_limits<double>::infinity());
  }
  const auto sums_of = [&](const Set& wider) { return sums(data, wider); };
  return add_greedily(evidence_model_, penalties, sums_of, evaluate(data, set)).members;
}

/// True if the true cause would be a member of the group of the reported effect.
bool Auditor::is_group_member(const SyntheticDataset& data, const Set& found, std::size_t reported) const {
  if (data.true_cause == nullptr || data.true_cause == data.excluded) return false;
  Set swapped;
  for (const std::size_t i : found) {
    if (chords_[i].effect == data.true_cause) return true;
    if (i != reported) swapped.push_back(i);
  }
  for (std::size_t i = 0; i < chords_.size(); ++i) {
    if (chords_[i].effect == data.true_cause) swapped.push_back(i);
  }
  return evaluate(data, swapped).score > evaluate(data, found).score - k_thresholds.temperature * k_thresholds.decisive;
}

AuditResult Auditor::audit_effect(std::size_t found, FitterPool& pool) const {
  const fusee::Effect* reported = selection_.best.effects[found];
  Set others;
  for (std::size_t i = 0; i < chords_.size(); ++i) {
    if (chords_[i].effect != reported && contains(selection_.best.effects, *chords_[i].effect)) others.push_back(i);
  }
  const auto data_sets = std::size_t{k_data_sets};
  std::vector<char> is_false_positive(data_sets, 0);
  std::vector<const fusee::Effect*> true_cause(data_sets, nullptr);
  pool.each(data_sets, [&](const Fitter&, std::size_t i) {
    const SyntheticDataset data = synthesize(found, i);
    const Set set = search(data, others);
    for (const std::size_t chord : set) {
      if (chords_[chord].effect == reported) is_false_positive[i] = !is_group_member(data, set, chord);
    }
    true_cause[i] = data.true_cause;
  });
  AuditResult audited;
  audited.counts.data_sets = k_data_sets;
  std::vector<std::pair<int, const fusee::Effect*>> causes;
  for (std::size_t i = 0; i < data_sets; ++i) {
    if (!is_false_positive[i]) continue;
    ++audited.counts.false_positives;
    if (true_cause[i] != nullptr) count(true_cause[i], causes);
  }
  std::stable_sort(causes.begin(), causes.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  int unattributed = audited.counts.false_positives;
  for (const auto& [false_positives, effect] : causes) {
    if (unattributed <= k_thresholds.most_false_positives * audited.counts.data_sets ||
        audited.true_causes.size() == k_most_true_causes)
      break;
    audited.true_causes.push_back(effect);
    unattributed -= false_positives;
  }
  return audited;
}

}  // namespace

std::vector<AuditResult> audit(const Evidence& evidence, FitterPool& pool, const Selection& selection) {
  std::vector<AuditResult> all;
  if (selection.best.effects.empty()) return all;
  const Auditor auditor(evidence, pool, selection);
  for (std::size_t i = 0; i < selection.best.effects.size(); ++i) all.push_back(auditor.audit_effect(i, pool));
  return all;
}

}  // namespace fusee::calibration
