// Reads a mechanism file, computes both pulleys and prints their radii, or why they cannot be made.
#include <cstdio>

#include "fusee/pipeline.h"

int main(int, char** arguments) {
  const fusee::MechanismFile file = fusee::read_mechanism(arguments[1]);
  const fusee::profile::SynthesisResult pulleys = fusee::profile::synthesise(file.mechanism);
  std::puts(pulleys.brief().c_str());
  return pulleys.made() ? 0 : 4;
}
