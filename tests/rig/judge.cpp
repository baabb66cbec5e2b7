#include "rig/judge.h"

#include <algorithm>
#include <array>
#include <fstream>

#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"
#include "fusee/calibration/words.h"
#include "fusee/mechanism/file.h"

namespace fusee::rig {
namespace {

constexpr std::array k_verdicts = {CalibrationVerdict::explained,      CalibrationVerdict::confounded,
                                   CalibrationVerdict::unexplained,    CalibrationVerdict::no_effect,
                                   CalibrationVerdict::not_repeatable, CalibrationVerdict::not_testable};

bool holds(const std::vector<std::string>& group, const std::string& name) {
  return std::find(group.begin(), group.end(), name) != group.end();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "|") + word;
  return text;
}

bool holds_truth(const std::vector<std::string>& group, const std::vector<std::string>& faults) {
  return std::any_of(faults.begin(), faults.end(), [&](const std::string& fault) {
    const std::vector<std::string> kin = kin_of(fault);
    return holds(group, fault) ||
           std::any_of(kin.begin(), kin.end(), [&](const std::string& name) { return holds(group, name); });
  });
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw OutputError("cannot write " + path.string(), "is there room, and permission?");
}

double share(std::size_t part, std::size_t all) {
  return all == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(all);
}

std::string percent(double value) { return fixed(100.0 * value, 1) + " %"; }

/// Sums of one row of the matrix.
struct Sums {
  std::string truth;
  std::size_t joints = 0, named = 0, held = 0, alone = 0, blamed = 0, wrong_alone = 0;
  std::array<std::size_t, k_verdicts.size()> verdicts{};
};

void add(Sums& sums, const Judgement& one) {
  ++sums.joints;
  sums.named += one.named;
  sums.held += one.held;
  sums.alone += one.alone;
  sums.blamed += one.false_groups > 0 ? 1 : 0;
  sums.wrong_alone += one.wrong_alone > 0 ? 1 : 0;
  for (std::size_t i = 0; i < k_verdicts.size(); ++i) sums.verdicts[i] += one.verdict == k_verdicts[i] ? 1 : 0;
}

std::string row_text(const Sums& sums) {
  const auto count = [](std::size_t value) { return value == 0 ? std::string("·") : std::to_string(value); };
  std::string text = "| " + sums.truth + " | " + std::to_string(sums.joints) + " | ";
  text += sums.named == 0
              ? "– | – | – | "
              : count(sums.held) + " | " + count(sums.alone) + " | " + count(sums.named - sums.held) + " | ";
  text += count(sums.blamed) + " | " + count(sums.wrong_alone);
  for (const std::size_t verdict : sums.verdicts) text += " | " + count(verdict);
  return text + " |\n";
}

}  // namespace

Judgement judge(const Case& made, const Calibration& found) {
  Judgement one;
  one.truth = made.truth;
  one.verdict = found.verdict;
  for (const std::string& fault : made.faults) {
    if (!has_name(fault)) {
      one.outside = true;
      continue;
    }
    ++one.named;
    const auto in = [&](const FoundEffect& effect) { return holds(effect.group, fault); };
    one.held += std::any_of(found.effects.begin(), found.effects.end(), in) ? 1 : 0;
    one.alone += std::any_of(found.effects.begin(), found.effects.end(),
                             [&](const FoundEffect& e) { return in(e) && e.group.size() == 1; })
                     ? 1
                     : 0;
  }
  std::string groups;
  for (const FoundEffect& effect : found.effects) {
    const bool wrong = !holds_truth(effect.group, made.faults);
    one.false_groups += wrong ? 1 : 0;
    one.wrong_alone += wrong && effect.group.size() == 1 ? 1 : 0;
    groups += (wrong ? "  !{" : "  {") + joined(effect.group) + "}";
  }
  std::string seen;
  for (const double times : made.seen) seen += (seen.empty() ? "" : ", ") + rounded(times, 3);
  one.words = made.truth + " #" + std::to_string(made.seed) + " (" + (seen.empty() ? "-" : seen) +
              " x noise): " + std::string(word(one.verdict)) + groups;
  return one;
}

std::vector<std::filesystem::path> write_case(const Case& made, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::vector<std::filesystem::path> runs;
  for (const auto& [name, text] : files_of(made)) {
    write(folder / name, text);
    if (name.ends_with(".csv")) runs.push_back(folder / name);
  }
  return runs;
}

Judgement calibrate_case(const Case& made, const std::filesystem::path& folder) {
  const std::vector<std::filesystem::path> runs = write_case(made, folder);
  const DeclaredMechanism declared = read_mechanism(folder / "spec.toml").mechanism;
  Measurement measurement = read_measurement(runs);
  compare_with_declared(declared, measurement);
  return judge(made, calibrate(declared, measurement));
}

Rates rates(const std::vector<Judgement>& judgements) {
  std::size_t named = 0, held = 0, inside = 0, inside_blamed = 0, outside = 0, outside_blamed = 0, alone = 0, said = 0,
              plain = 0, quiet = 0;
  for (const Judgement& one : judgements) {
    named += one.named;
    held += one.held;
    (one.outside ? outside : inside) += 1;
    (one.outside ? outside_blamed : inside_blamed) += one.false_groups > 0 ? 1 : 0;
    alone += one.wrong_alone > 0 ? 1 : 0;
    said += one.outside && (one.verdict == CalibrationVerdict::unexplained ||
                            one.verdict == CalibrationVerdict::not_repeatable)
                ? 1
                : 0;
    if (one.outside || one.named > 0) continue;
    ++plain;
    quiet += one.verdict == CalibrationVerdict::no_effect ? 1 : 0;
  }
  return {share(named - held, named),      share(inside_blamed, inside), share(outside_blamed, outside),
          share(alone, judgements.size()), share(said, outside),         share(quiet, plain)};
}

std::string matrix(const std::vector<Judgement>& judgements) {
  std::string text = "| truth | joints | held | alone | missed | false blame | wrong alone";
  for (const CalibrationVerdict verdict : k_verdicts) text += " | " + std::string(word(verdict));
  text += " |\n|---|";
  for (std::size_t i = 0; i < 6 + k_verdicts.size(); ++i) text += "--:|";
  text += "\n";
  std::vector<Sums> rows;
  for (const Judgement& one : judgements) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const Sums& sums) { return sums.truth == one.truth; });
    if (row == rows.end()) row = rows.insert(rows.end(), Sums{one.truth});
    add(*row, one);
  }
  for (const Sums& row : rows) text += row_text(row);
  const Rates found = rates(judgements);
  text += "\n| rate | |\n|---|--:|\n";
  text +=
      "| miss: a fault with a name that stands in no reported group, per such fault | " + percent(found.miss) + " |\n";
  text +=
      "| false blame: a reported group that holds nothing of what is there, per joint whose faults all have names, or "
      "that has none | " +
      percent(found.false_blame) + " |\n";
  text += "| the same per joint with a fault without a name (its kin among the named do not count) | " +
          percent(found.false_blame_outside) + " |\n";
  text += "| named alone and not there, per joint | " + percent(found.wrong_alone) + " |\n";
  text += "| unexplained or not repeatable, per joint with a fault without a name | " +
          percent(found.unexplained_outside) + " |\n";
  text += "| no effect, per joint as declared | " + percent(found.quiet) + " |\n";
  text += "\nheld: in a reported group; alone: the group has no other member.\nKin:";
  for (const std::string& fault : fault_names()) {
    if (const std::vector<std::string> kin = kin_of(fault); !kin.empty())
      text += " " + fault + " is like " + joined(kin) + ";";
  }
  text.back() = '.';
  return text + "\n";
}

}  // namespace fusee::rig
