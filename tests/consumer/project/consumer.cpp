// A program of another project: reads a mechanism, finds the pulley and prints how its second radius varies.
#include <algorithm>
#include <cstdio>

#include "fusee/pipeline.h"

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const fusee::MechanismFile file = fusee::read_mechanism(arguments[1]);
  const fusee::profile::SynthesisResult synthesis = fusee::profile::synthesise(file.mechanism);
  if (!synthesis.made()) return 4;
  const auto [least, most] = std::minmax_element(synthesis.stroke.begin(), synthesis.stroke.end(),
                                                 [](const auto& a, const auto& b) { return a.t2.p < b.t2.p; });
  std::printf("r2 from %.3f to %.3f mm\n", least->t2.p, most->t2.p);
}
