#include <limits>

#include "fusee/joint.h"

namespace fusee::joint {

std::vector<double> bench_clock(const BenchLog& log) {
  std::vector<double> offsets;
  double end = -std::numeric_limits<double>::infinity();
  for (const BenchRun& run : log) {
    const double start = run.rows.empty() ? 0.0 : run.rows.front().time;
    offsets.push_back(start <= end ? end - start : 0.0);
    if (!run.rows.empty()) end = offsets.back() + run.rows.back().time;
  }
  return offsets;
}

}  // namespace fusee::joint
