/// \file
/// The paper's problem as a mechanism file, for tests to use and to break.
#pragma once

#include <string>

#include "fusee/optimize.h"

namespace fusee::testing {

inline const std::string k_paper_problem = R"(schema = 1
name = "paper"
[joint]
length_mm = 150     # R
range_deg = [-30, 30]
[guides]
EB_mm = 50
ED_mm = 50
OE_mm = -10
radius_mm = 0
friction = 0.2
[pulley]
EF_mm = 60
r1_mm = 20
method = "paper"
[tendon]
diameter_mm = 1
[optimize]
objective = "max_tension"
variables = ["joint.length_mm", "guides.ED_mm", "guides.OE_mm"]
lower = [100.0, 30.0, -40.0]
upper = [300.0, 150.0, 50.0]
tied = ["guides.EB_mm = guides.ED_mm"]
constraints = ["guides.EB_mm <= 0.5 * joint.length_mm"]
)";

inline optimize::Problem paper_problem(const std::vector<Setting>& settings = {},
                                       const std::string& text = k_paper_problem) {
  MechanismFile file;
  file.path = "paper.toml";
  file.mechanism = parse_mechanism(text, file.path, ".", settings);
  return optimize::make_problem(file);
}

}  // namespace fusee::testing
