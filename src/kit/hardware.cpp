#include "kit/hardware.h"

#include <cmath>
#include <optional>

#include "base/text.h"
#include "mechanism/lengths.h"

namespace fusee::kit {

const Thread& thread_within(double diameter, LengthUnit units) {
  const Thread* found = &threads_of(units).front();
  for (const Thread& thread : threads_of(units)) {
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

namespace {

/// Stock lengths of inch screws.
struct InchLength {
  double inches = 0;
  std::string_view words;
};
constexpr std::array<InchLength, 15> k_inch_lengths{{{0.25, "1/4"},
                                                     {0.375, "3/8"},
                                                     {0.5, "1/2"},
                                                     {0.625, "5/8"},
                                                     {0.75, "3/4"},
                                                     {1.0, "1"},
                                                     {1.25, "1 1/4"},
                                                     {1.5, "1 1/2"},
                                                     {1.75, "1 3/4"},
                                                     {2.0, "2"},
                                                     {2.25, "2 1/4"},
                                                     {2.5, "2 1/2"},
                                                     {3.0, "3"},
                                                     {3.5, "3 1/2"},
                                                     {4.0, "4"}}};

std::string inch_length_words(double length) {
  for (const InchLength& stock : k_inch_lengths) {
    if (length <= to_mm(stock.inches, LengthUnit::inch)) return std::string(stock.words);
  }
  return rounded(0.5 * std::ceil(2 * from_mm(length, LengthUnit::inch)));
}

}  // namespace

double stock_rod(double at_least, LengthUnit units) {
  constexpr std::array k_metric{1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0};
  constexpr std::array k_inch{1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0};  // sixteenths
  constexpr double k_tolerance = 1e-6;                                       // mm
  const auto thick_enough = [&](const auto& rods, double unit) -> std::optional<double> {
    for (const double rod : rods) {
      if (at_least <= rod * unit + k_tolerance) return rod * unit;
    }
    return std::nullopt;
  };
  const auto rod = units == LengthUnit::mm ? thick_enough(k_metric, 1) : thick_enough(k_inch, to_mm(1, units) / 16);
  return rod.value_or(at_least);
}

std::string screw_words(const Thread& thread, double length) {
  if (thread.name.starts_with('#')) return std::string(thread.name) + " × " + inch_length_words(length) + " in";
  return std::string(thread.name) + " × " + rounded(stock_length(length));
}

}  // namespace fusee::kit
