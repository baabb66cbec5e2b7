/// \file
/// Common parts of campaigns: tests that build random designs.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace fusee::testing {

/// A random number generator with equal results on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}
  /// Uniform in [low, high): the upper 53 bits are a share of the interval.
  double between(double low, double high) { return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  bool happens(double probability) { return between(0, 1) < probability; }
  template <std::size_t count>
  const char* one_of(const std::array<const char*, count>& words) {
    return words[static_cast<std::size_t>(between(0, static_cast<double>(count)))];
  }

 private:
  std::mt19937_64 bits_;
};

/// The number in an environment variable, or `otherwise` if it is not set.
inline int number_in(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atoi(text);
}

/// Results of a build of a random design. A refusal and bad input are valid results, too.
enum class BuildEnd { made, refused, bad_input };

}  // namespace fusee::testing
