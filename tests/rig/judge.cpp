#include "rig/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <utility>

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

/// Well enough that not to name it is to miss it.
constexpr double k_well_seen = 2.5;  // noise rms

bool is_outside(const std::string& fault, const std::vector<std::string>& without) {
  return !has_name(fault) || holds(without, fault);
}

/// The groove rubs otherwise than the file says, whatever other faults there are.
bool has_other_groove(const Case& made) { return made.hidden.groove_friction != Hidden{}.groove_friction; }

bool holds_truth(const std::vector<std::string>& group, const Case& made, const std::vector<std::string>& without) {
  if (has_other_groove(made) && holds(group, "groove_friction")) return true;
  return std::any_of(made.faults.begin(), made.faults.end(), [&](const std::string& fault) {
    if (!is_outside(fault, without)) return holds(group, fault);
    const std::vector<std::string> kin = kin_of(fault);
    return std::any_of(kin.begin(), kin.end(), [&](const std::string& name) { return holds(group, name); });
  });
}

/// How large a fault must be to show, rad at the joint, as the answer has it; 0 where it does not say.
double detectable_size(const Calibration& found, const std::string& fault) {
  for (const Detectable& one : found.detectable) {
    if (one.name == fault) return one.smallest;
  }
  return 0;
}

/// The numbers of `fault` that `effect` reports.
void add_covered(const std::string& fault, const FoundEffect& effect, const Case& made, std::vector<Covered>& all) {
  const auto numbers = find_fault(fault).numbers;
  if (effect.name != fault || numbers == nullptr) return;
  for (const auto& [name, value] : numbers(made.hidden, made.joint)) {
    for (const FittedParameter& found : effect.parameters) {
      // What is searched among whole numbers has no interval.
      if (found.name != name || !(found.high > found.low)) continue;
      const double away = (value - 0.5 * (found.low + found.high)) / (0.5 * (found.high - found.low));
      all.push_back({fault + " " + name, found.low <= value && value <= found.high, away});
    }
  }
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw OutputError("cannot write " + path.string(), "is there room, and permission?");
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

/// Each number by itself, in the order of its first case.
std::string coverage_table(const std::vector<Judgement>& judgements) {
  std::vector<std::pair<std::string, Rate>> rows;
  for (const Judgement& one : judgements) {
    for (const Covered& number : one.numbers) {
      auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& known) { return known.first == number.name; });
      if (row == rows.end()) row = rows.insert(rows.end(), {number.name, {}});
      row->second.part += number.within ? 1 : 0;
      ++row->second.all;
    }
  }
  if (rows.empty()) return "";
  std::string text = "\n| number | within its 95 % interval | of |\n|---|--:|--:|\n";
  for (const auto& [name, rate] : rows)
    text += "| " + name + " | " + std::to_string(rate.part) + " | " + std::to_string(rate.all) + " |\n";
  return text;
}

}  // namespace

Judgement judge(const Case& made, const Calibration& found, const std::vector<std::string>& without) {
  Judgement one;
  one.truth = made.truth;
  one.verdict = found.verdict;
  one.nothing = made.faults.empty();
  std::string lost;
  for (std::size_t i = 0; i < made.faults.size(); ++i) {
    const std::string& fault = made.faults[i];
    if (is_outside(fault, without)) {
      one.outside.push_back(fault);
      continue;
    }
    for (const FoundEffect& effect : found.effects) add_covered(fault, effect, made, one.numbers);
    if (i < made.seen.size() && made.seen[i] < k_well_seen) continue;
    ++one.named;
    const auto in = [&](const FoundEffect& effect) { return holds(effect.group, fault); };
    const bool is_held = std::any_of(found.effects.begin(), found.effects.end(), in);
    one.held += is_held ? 1 : 0;
    if (!is_held) {
      const double size = i < made.seen.size() ? made.seen[i] * made.sensors.noise : 0;
      const double least = detectable_size(found, fault);
      one.beyond += size >= least ? 1 : 0;
      lost += "  (" + fault + " " + (least > 0 ? rounded(size / least, 2) : "?") + ")";
    }
    one.held_by_names += std::any_of(found.effects.begin(), found.effects.end(),
                                     [&](const FoundEffect& e) { return in(e) && !holds(e.group, k_unmodelled); })
                             ? 1
                             : 0;
    one.alone += std::any_of(found.effects.begin(), found.effects.end(),
                             [&](const FoundEffect& e) { return in(e) && e.group.size() == 1; })
                     ? 1
                     : 0;
  }
  std::string groups;
  for (const FoundEffect& effect : found.effects) {
    if (has_other_groove(made) && !holds(made.faults, "groove_friction"))
      add_covered("groove_friction", effect, made, one.numbers);
    const bool wrong = !holds_truth(effect.group, made, without);
    one.false_groups += wrong ? 1 : 0;
    one.false_names += wrong && !holds(effect.group, k_unmodelled) ? 1 : 0;
    one.wrong_alone += wrong && effect.group.size() == 1 ? 1 : 0;
    groups += (wrong ? "  !{" : "  {") + joined(effect.group) + "}" + rounded(effect.evidence, 2) + "~" +
              rounded(effect.unmodelled.log_odds, 2) + "[" + effect.unmodelled.words + "]";
  }
  std::string seen;
  for (const double times : made.seen) seen += (seen.empty() ? "" : ", ") + rounded(times, 3);
  one.words = made.truth + " #" + std::to_string(made.seed) + " (" + (seen.empty() ? "-" : seen) +
              " x noise): " + std::string(word(one.verdict)) + groups;
  for (const Covered& number : one.numbers) one.words += "  <" + number.name + " " + rounded(number.away, 2) + ">";
  one.words += lost;
  if (found.unexplained_rms > 0) one.words += "  left " + rounded(found.unexplained_rms / found.noise.rms, 2);
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

Answer calibrate_case(const Case& made, const std::filesystem::path& folder, const std::vector<std::string>& without) {
  const std::vector<std::filesystem::path> runs = write_case(made, folder);
  const DeclaredMechanism declared = read_mechanism(folder / "spec.toml").mechanism;
  Measurement measurement = read_measurement(runs);
  compare_with_declared(declared, measurement);
  CalibrationOptions options;
  options.without = without;
  Answer answer;
  answer.found = calibrate(declared, measurement, options);
  answer.judgement = judge(made, answer.found, without);
  return answer;
}

Bounds wilson(const Rate& rate) {
  if (rate.all == 0) return {};
  constexpr double z = 1.959963984540054;  // of 97.5 % of a normal distribution
  const auto n = static_cast<double>(rate.all);
  const double middle = rate.share() + z * z / (2 * n);
  const double half = z * std::sqrt(rate.share() * (1 - rate.share()) / n + z * z / (4 * n * n));
  const double whole = 1 + z * z / n;
  return {std::max(0.0, (middle - half) / whole), std::min(1.0, (middle + half) / whole)};
}

Rates rates(const std::vector<Judgement>& judgements) {
  Rates all;
  const auto count = [](Rate& rate, bool is) {
    rate.part += is ? 1 : 0;
    ++rate.all;
  };
  for (const Judgement& one : judgements) {
    const bool blamed = one.false_groups > 0;
    count(!one.outside.empty() ? all.false_blame_outside : all.false_blame, blamed);
    count(!one.outside.empty() ? all.false_names_outside : all.false_names, one.false_names > 0);
    all.held_by_names.part += one.held_by_names;
    all.held_by_names.all += one.named;
    all.alone.part += one.alone;
    all.alone.all += one.named;
    count(all.wrong_alone, one.wrong_alone > 0);
    count(all.untestable, one.verdict == CalibrationVerdict::not_testable);
    if (!one.outside.empty()) {
      all.kept.part += one.held;
      all.kept.all += one.named;
      count(all.unexplained_outside,
            one.verdict == CalibrationVerdict::unexplained || one.verdict == CalibrationVerdict::not_repeatable);
    } else {
      all.miss.part += one.named - one.held;
      all.miss.all += one.named;
      all.beyond += one.beyond;
    }
    if (one.nothing) {
      count(all.false_blame_nothing, blamed);
      count(all.quiet, one.verdict == CalibrationVerdict::no_effect);
    }
    for (const Covered& number : one.numbers) count(all.covered, number.within);
  }
  return all;
}

std::string rate_table(const std::vector<Judgement>& judgements) {
  std::string text = "| rate | | of | 95 % bounds (Wilson) |\n|---|--:|--:|---|\n";
  const auto row = [&](const char* words, const Rate& rate) {
    const Bounds bounds = wilson(rate);
    text += std::string("| ") + words + " | " + (rate.all == 0 ? "–" : percent(rate.share())) + " | " +
            std::to_string(rate.all) + " | " +
            (rate.all == 0 ? "–" : percent(bounds.low) + " … " + percent(bounds.high)) + " |\n";
  };
  const Rates found = rates(judgements);
  row("false blame: a reported group that names nothing of what is there and does not say that it may be something "
      "without a name, per joint whose faults all have names, or that has none",
      found.false_names);
  row("the same, per joint with a fault without a name (its kin among the named do not count)",
      found.false_names_outside);
  row("a reported group that names nothing of what is there, whatever else it says, per joint whose faults all have "
      "names, or that has none",
      found.false_blame);
  row("the same, per joint as declared", found.false_blame_nothing);
  row("the same, per joint with a fault without a name (its kin among the named do not count)",
      found.false_blame_outside);
  row("named alone and not there, per joint", found.wrong_alone);
  row("named alone and there, per fault with a name, on all joints", found.alone);
  row("in a reported group that does not say that it may be something without a name, the same", found.held_by_names);
  row("held: in a reported group, per fault with a name, where all have one",
      {found.miss.all - found.miss.part, found.miss.all});
  row("the same, of those that are held or larger than what `detectable` says would have shown",
      {found.miss.all - found.miss.part, found.miss.all - found.miss.part + found.beyond});
  row("kept: in a reported group, per fault with a name beside one without", found.kept);
  row("unexplained or not repeatable, per joint with a fault without a name", found.unexplained_outside);
  row("no effect, per joint as declared", found.quiet);
  row("not testable, per joint (what such a joint has counts as not held)", found.untestable);
  row("true number within its 95 % interval, per number of a fault that is named", found.covered);
  return text;
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
  text += "\n" + rate_table(judgements) + coverage_table(judgements);
  text += "\nheld: in a reported group; alone: the group has no other member.\n";
  std::set<std::string> outside;
  for (const Judgement& one : judgements) outside.insert(one.outside.begin(), one.outside.end());
  std::string kin;
  for (const std::string& fault : outside) {
    if (!kin_of(fault).empty()) kin += (kin.empty() ? "" : "; ") + fault + " is like " + joined(kin_of(fault));
  }
  if (!kin.empty()) text += "Kin, of faults without a name or whose name is left out: " + kin + ".\n";
  return text;
}

}  // namespace fusee::rig
