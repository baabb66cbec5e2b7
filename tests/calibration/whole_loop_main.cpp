// Prints the whole-loop table of the documentation as Markdown: whole_loop SPEC.toml LOAD_N [EFFECT].
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "base/text.h"
#include "calibration/whole_loop.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee::rig {
namespace {

std::string deg(double angle) { return fixed(degrees(angle), 4); }

void print_row(const LoopOutcome& outcome) {
  std::printf("| %s | %s | %s | %s | %s | %s %% | %s | %s | %s |\n", outcome.name.c_str(), outcome.verdict.c_str(),
              outcome.found.c_str(), deg(outcome.before).c_str(), deg(outcome.after).c_str(),
              fixed(100.0 * outcome.after / outcome.before, 1).c_str(), deg(outcome.after_assembled_at_zero).c_str(),
              deg(outcome.after_table).c_str(), deg(outcome.declared).c_str());
  std::fflush(stdout);
}

constexpr const char* k_head =
    "Joint error: rms of θ − θ(α) as declared over two cycles, without noise, in degrees. *After*: with the pulley of "
    "corrected.toml on the same joint\n"
    "with the same fault, at its assembly angle; *at 0*: assembled with the motor at 0; *by the table*: as at 0,\n"
    "with compensation.csv in the controller; *no fault*: the declared joint, where friction and the pulley's facets "
    "remain. "
    "In brackets: effects that the data do not distinguish.\n\n"
    "| hidden effect | verdict | found | before | after | after / before | at 0 | by the table | no fault |\n"
    "|---|---|---|--:|--:|--:|--:|--:|--:|\n";

int run(const std::filesystem::path& spec, double load, const std::string& only) {
  const std::string text = read_file(spec, 1 << 20);
  const MadeJoint joint = make_joint(parse_mechanism(text, spec.string(), spec.parent_path()));
  std::fputs(k_head, stdout);
  for (const LoopCase& one : loop_cases(joint.declared, load)) {
    if (!only.empty() && only != one.name) continue;
    try {
      const LoopOutcome outcome =
          turn_loop(joint, text, one, std::filesystem::temp_directory_path() / ("fusee-whole-loop-" + one.name));
      print_row(outcome);
      if (!only.empty()) std::printf("\n%s\n", outcome.corrected_toml.c_str());
    } catch (const InputError& error) {
      std::printf("| %s | no such pulley: %s |\n", one.name.c_str(), error.what());
    }
  }
  return 0;
}

}  // namespace
}  // namespace fusee::rig

int main(int count, char** words) {
  if (count < 3) {
    std::fputs("usage: whole_loop SPEC.toml LOAD_N [EFFECT]\n", stderr);
    return 2;
  }
  try {
    return fusee::rig::run(words[1], std::strtod(words[2], nullptr), count > 3 ? words[3] : "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "whole_loop: %s\n", error.what());
    return 1;
  }
}
