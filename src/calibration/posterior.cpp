#include "calibration/posterior.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fusee::calibration {

bool shares(const EffectSet& one, const EffectSet& other) {
  return std::any_of(one.begin(), one.end(), [&](const fusee::Effect* effect) { return contains(other, *effect); });
}

namespace {

/// Weights relative to the likeliest set.
std::vector<double> weights_of(const std::vector<WeightedSet>& sets) {
  double most = -std::numeric_limits<double>::infinity();
  for (const WeightedSet& set : sets) most = std::max(most, set.log_weight);
  std::vector<double> weights;
  for (const WeightedSet& set : sets) weights.push_back(elementary::exp(set.log_weight - most));
  return weights;
}

/// Share of the weight of sets without any of these members.
double absence_probability_of(const std::vector<WeightedSet>& sets, const std::vector<double>& weights,
                              const EffectSet& members) {
  double without = 0, all = 0;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    all += weights[i];
    if (!shares(sets[i].effects, members)) without += weights[i];
  }
  return all > 0 ? without / all : 1.0;
}

/// Effect outside `best` with the most weight among sets without `members`; null without one.
const fusee::Effect* in_their_place(const std::vector<WeightedSet>& sets, const std::vector<double>& weights,
                                    const EffectSet& members, const EffectSet& best) {
  std::vector<std::pair<const fusee::Effect*, double>> others;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (shares(sets[i].effects, members)) continue;
    for (const fusee::Effect* effect : sets[i].effects) {
      if (contains(best, *effect)) continue;
      const auto known =
          std::find_if(others.begin(), others.end(), [&](const auto& other) { return other.first == effect; });
      if (known == others.end()) {
        others.emplace_back(effect, weights[i]);
      } else {
        known->second += weights[i];
      }
    }
  }
  const auto largest =
      std::max_element(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return largest == others.end() ? nullptr : largest->first;
}

}  // namespace

CredibleGroup credible_group(const std::vector<WeightedSet>& sets, const EffectSet& best, const fusee::Effect& named,
                             double most_absence, double least_gain) {
  const std::vector<double> weights = weights_of(sets);
  CredibleGroup group{{&named}, absence_probability_of(sets, weights, {&named})};
  while (group.absence_probability > most_absence) {
    const fusee::Effect* other = in_their_place(sets, weights, group.members, best);
    if (other == nullptr) break;
    EffectSet wider = group.members;
    wider.push_back(other);
    const double absence_probability = absence_probability_of(sets, weights, wider);
    if (!(absence_probability < (1.0 - least_gain) * group.absence_probability)) break;
    group = {std::move(wider), absence_probability};
  }
  return group;
}

}  // namespace fusee::calibration
