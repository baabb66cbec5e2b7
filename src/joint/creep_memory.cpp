#include "joint/creep_memory.h"

#include <cmath>
#include <numeric>

namespace fusee::joint {

// τ ẋ = driver − x, solved exactly for a constant driver.
void CreepMemory::hold(double driver, double time) {
  if (!(time > 0)) return;
  for (std::size_t i = 0; i < elements_.size(); ++i)
    elements_[i] = driver + (elements_[i] - driver) * elementary::exp(-time / k_times[i]);
}

double CreepMemory::crept() const { return std::accumulate(elements_.begin(), elements_.end(), 0.0); }

}  // namespace fusee::joint
