#include "kit/hardware.h"

#include <cmath>

#include "base/text.h"

namespace fusee::kit {

const Thread& thread_within(double diameter) {
  const Thread* found = &k_threads.front();
  for (const Thread& thread : k_threads) {
    if (thread.diameter <= diameter + 1e-9) found = &thread;
  }
  return *found;
}

double nut_corner_radius(const Thread& thread) { return thread.nut / std::sqrt(3.0); }

double stock_length(double length) {
  constexpr std::array k_stock{4, 5, 6, 8, 10, 12, 16, 20, 25, 30, 35, 40, 45, 50, 60, 70, 80, 90, 100};
  for (const int stock : k_stock) {
    if (length <= stock) return stock;
  }
  return 10 * std::ceil(length / 10);
}

std::string screw_words(const Thread& thread, double length) {
  return std::string(thread.name) + " × " + rounded(stock_length(length));
}

}  // namespace fusee::kit
