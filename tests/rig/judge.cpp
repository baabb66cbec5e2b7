#include "rig/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <utility>

#include "base/text.h"
#include "calibration/words.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee::rig {
namespace {

constexpr std::array k_verdicts = {
    calibration::CalibrationVerdict::explained,      calibration::CalibrationVerdict::confounded,
    calibration::CalibrationVerdict::unexplained,    calibration::CalibrationVerdict::no_effect,
    calibration::CalibrationVerdict::not_repeatable, calibration::CalibrationVerdict::not_testable};

bool holds(const std::vector<std::string>& group, const std::string& name) {
  return std::find(group.begin(), group.end(), name) != group.end();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "|") + word;
  return text;
}

constexpr double k_visible = 2.5;  // noise rms from which a fault is counted

bool is_outside(const std::string& fault, const std::vector<std::string>& without) {
  return !has_name(fault) || holds(without, fault);
}

/// The friction of the groove differs from the file.
bool has_other_groove(const Case& made) { return made.hidden.groove_friction != HiddenFaults{}.groove_friction; }

bool holds_truth(const std::vector<std::string>& group, const Case& made, const std::vector<std::string>& without) {
  if (has_other_groove(made) && holds(group, "groove_friction")) return true;
  return std::any_of(made.faults.begin(), made.faults.end(), [&](const std::string& fault) {
    if (!is_outside(fault, without)) return holds(group, fault);
    const std::vector<std::string> kin = find_fault(fault).kin;
    return std::any_of(kin.begin(), kin.end(), [&](const std::string& name) { return holds(group, name); });
  });
}

/// The reported detectable size of a fault, rad at the joint; 0: none reported.
double detectable_size(const calibration::Calibration& found, const std::string& fault) {
  for (const calibration::Detectable& one : found.detectable) {
    if (one.name == fault) return one.smallest;
  }
  return 0;
}

Deviation deviation_from(double low, double high, double value) {
  return {(value - 0.5 * (low + high)) / (0.5 * (high - low))};
}

/// Checks the intervals that `effect` reports for `fault`.
void check_intervals(const std::string& fault, const calibration::FoundEffect& effect, const Case& made,
                     std::vector<IntervalCheck>& all) {
  const auto numbers = find_fault(fault).numbers;
  if (effect.name != fault || numbers == nullptr) return;
  for (const auto& [name, value] : numbers(made.hidden, made.joint)) {
    for (const calibration::FittedParameter& found : effect.parameters) {
      // Integers, such as the order of a wave, have no interval.
      if (found.name != name || !(found.high > found.low && found.high_if_only > found.low_if_only)) continue;
      all.push_back({fault + " " + name, deviation_from(found.low, found.high, value),
                     deviation_from(found.low_if_only, found.high_if_only, value)});
    }
  }
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw OutputError("cannot write " + path.string(), "check free space and permissions");
}

std::string percent(double value) { return fixed(100.0 * value, 1) + " %"; }

/// Counts of one truth.
struct MatrixRow {
  std::string truth;
  std::size_t joints = 0, named = 0, held = 0, alone = 0, with_false_group = 0, wrong_alone = 0;
  std::array<std::size_t, k_verdicts.size()> verdicts{};
};

void add(MatrixRow& row, const Judgement& one) {
  ++row.joints;
  row.named += one.named;
  row.held += one.held;
  row.alone += one.alone;
  row.with_false_group += one.false_groups > 0 ? 1 : 0;
  row.wrong_alone += one.wrong_alone > 0 ? 1 : 0;
  for (std::size_t i = 0; i < k_verdicts.size(); ++i) row.verdicts[i] += one.verdict == k_verdicts[i] ? 1 : 0;
}

std::string row_text(const MatrixRow& row) {
  const auto count = [](std::size_t value) { return value == 0 ? std::string("·") : std::to_string(value); };
  std::string text = "| " + row.truth + " | " + std::to_string(row.joints) + " | ";
  text += row.named == 0 ? "– | – | – | "
                         : count(row.held) + " | " + count(row.alone) + " | " + count(row.named - row.held) + " | ";
  text += count(row.with_false_group) + " | " + count(row.wrong_alone);
  for (const std::size_t verdict : row.verdicts) text += " | " + count(verdict);
  return text + " |\n";
}

/// Coverage of each parameter, in the order of first occurrence.
std::string coverage_table(const std::vector<Judgement>& judgements) {
  std::vector<std::pair<std::string, Rate>> rows;
  for (const Judgement& one : judgements) {
    for (const IntervalCheck& number : one.numbers) {
      auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& known) { return known.first == number.name; });
      if (row == rows.end()) row = rows.insert(rows.end(), {number.name, {}});
      row->second.part += number.overall.is_within() ? 1 : 0;
      ++row->second.all;
    }
  }
  if (rows.empty()) return "";
  std::string text = "\n| parameter | within its 95 % interval | of |\n|---|--:|--:|\n";
  for (const auto& [name, rate] : rows)
    text += "| " + name + " | " + std::to_string(rate.part) + " | " + std::to_string(rate.all) + " |\n";
  return text;
}

}  // namespace

Judgement judge(const Case& made, const calibration::Calibration& found, const std::vector<std::string>& without) {
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
    for (const calibration::FoundEffect& effect : found.effects) check_intervals(fault, effect, made, one.numbers);
    if (i < made.seen.size() && made.seen[i] < k_visible) continue;
    ++one.named;
    const auto is_in_group = [&](const auto& accepts) {
      return std::any_of(found.effects.begin(), found.effects.end(), [&](const calibration::FoundEffect& effect) {
        return holds(effect.group, fault) && accepts(effect.group);
      });
    };
    using Group = std::vector<std::string>;
    const bool is_held = is_in_group([](const Group&) { return true; });
    one.held += is_held ? 1 : 0;
    one.held_by_names +=
        is_in_group([](const Group& group) { return !holds(group, calibration::k_unmodelled); }) ? 1 : 0;
    one.alone += is_in_group([](const Group& group) { return group.size() == 1; }) ? 1 : 0;
    if (is_held) continue;
    const double size = i < made.seen.size() ? made.seen[i] * made.sensors.noise : 0;
    const double least = detectable_size(found, fault);
    one.beyond += size >= least ? 1 : 0;
    lost += "  (" + fault + " " + (least > 0 ? rounded(size / least, 2) : "?") + ")";
  }
  std::string groups;
  for (const calibration::FoundEffect& effect : found.effects) {
    if (has_other_groove(made) && !holds(made.faults, "groove_friction"))
      check_intervals("groove_friction", effect, made, one.numbers);
    const bool wrong = !holds_truth(effect.group, made, without);
    one.false_groups += wrong ? 1 : 0;
    one.false_names += wrong && !holds(effect.group, calibration::k_unmodelled) ? 1 : 0;
    one.wrong_alone += wrong && effect.group.size() == 1 ? 1 : 0;
    groups += (wrong ? "  !{" : "  {") + joined(effect.group) + "}" + rounded(effect.evidence, 2) + "~" +
              rounded(effect.unmodelled.log_odds, 2) + "[" + effect.unmodelled.words + "]";
  }
  std::string seen;
  for (const double times : made.seen) seen += (seen.empty() ? "" : ", ") + rounded(times, 3);
  one.words = made.truth + " #" + std::to_string(made.seed) + " (" + (seen.empty() ? "-" : seen) +
              " x noise): " + std::string(calibration::word(one.verdict)) + groups;
  for (const IntervalCheck& number : one.numbers)
    one.words += "  <" + number.name + " " + rounded(number.overall.in_half_widths, 2) + "; " +
                 rounded(number.if_only.in_half_widths, 2) + ">";
  one.words += lost;
  if (found.unexplained_rms > 0) one.words += "  residual " + rounded(found.unexplained_rms / found.noise.rms, 2);
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
  measurement::Measurement measurement = measurement::read_measurement(runs);
  measurement::compare_with_declared(declared, measurement);
  calibration::CalibrationOptions options;
  options.without = without;
  Answer answer;
  answer.found = calibration::calibrate(declared, measurement, options);
  answer.judgement = judge(made, answer.found, without);
  return answer;
}

Bounds wilson(const Rate& rate) {
  if (rate.all == 0) return {};
  constexpr double z = 1.959963984540054;  // 97.5 % quantile of the normal distribution
  const auto n = static_cast<double>(rate.all);
  const double middle = rate.share() + z * z / (2 * n);
  const double half = z * std::sqrt(rate.share() * (1 - rate.share()) / n + z * z / (4 * n * n));
  const double whole = 1 + z * z / n;
  return {std::max(0.0, (middle - half) / whole), std::min(1.0, (middle + half) / whole)};
}

Rates rates(const std::vector<Judgement>& judgements) {
  Rates all;
  const auto add_to = [](Rate& rate, std::size_t part, std::size_t of) { rate.part += part, rate.all += of; };
  const auto count = [&](Rate& rate, bool is) { add_to(rate, is ? 1 : 0, 1); };
  for (const Judgement& one : judgements) {
    const bool is_modelled = one.outside.empty();
    count(is_modelled ? all.false_groups : all.false_groups_outside, one.false_groups > 0);
    count(is_modelled ? all.false_names : all.false_names_outside, one.false_names > 0);
    add_to(all.held_by_names, one.held_by_names, one.named);
    add_to(all.alone, one.alone, one.named);
    count(all.wrong_alone, one.wrong_alone > 0);
    count(all.untestable, one.verdict == calibration::CalibrationVerdict::not_testable);
    if (is_modelled) {
      add_to(all.miss, one.named - one.held, one.named);
      all.beyond += one.beyond;
    } else {
      add_to(all.kept, one.held, one.named);
      count(all.unexplained_outside, one.verdict == calibration::CalibrationVerdict::unexplained ||
                                         one.verdict == calibration::CalibrationVerdict::not_repeatable);
    }
    if (one.nothing) {
      count(all.false_groups_nothing, one.false_groups > 0);
      count(all.quiet, one.verdict == calibration::CalibrationVerdict::no_effect);
    }
    for (const IntervalCheck& number : one.numbers) {
      count(all.covered, number.overall.is_within());
      count(all.covered_if_only, number.if_only.is_within());
    }
  }
  return all;
}

namespace {

std::string rate_table(const std::vector<Judgement>& judgements) {
  const Rates found = rates(judgements);
  const std::size_t held = found.miss.all - found.miss.part;
  const std::pair<const char*, Rate> rows[] = {
      {"false positive: a false group without `unmodelled`, per modelled joint", found.false_names},
      {"false positive, per joint with an unmodelled fault", found.false_names_outside},
      {"false group, with or without `unmodelled`, per modelled joint", found.false_groups},
      {"false group, per joint as declared", found.false_groups_nothing},
      {"false group, per joint with an unmodelled fault", found.false_groups_outside},
      {"false group of one member, per joint", found.wrong_alone},
      {"alone: named fault alone in a group, all joints", found.alone},
      {"named fault in a group without `unmodelled`, all joints", found.held_by_names},
      {"held: named fault in a group, modelled joints", {held, found.miss.all}},
      {"held, omitting missed faults smaller than `detectable`", {held, held + found.beyond}},
      {"kept: named fault in a group, beside an unmodelled fault", found.kept},
      {"unexplained or not repeatable, per joint with an unmodelled fault", found.unexplained_outside},
      {"no effect, per joint as declared", found.quiet},
      {"not testable, per joint (its faults count as missed)", found.untestable},
      {"true value within its 95 % interval, per reported parameter of a true fault", found.covered},
      {"the same, within the interval if the reported effects are the only causes", found.covered_if_only},
  };
  std::string text = "| rate | | of | 95 % bounds (Wilson) |\n|---|--:|--:|---|\n";
  for (const auto& [words, rate] : rows) {
    const Bounds bounds = wilson(rate);
    text += std::string("| ") + words + " | " + (rate.all == 0 ? "–" : percent(rate.share())) + " | " +
            std::to_string(rate.all) + " | " +
            (rate.all == 0 ? "–" : percent(bounds.low) + " … " + percent(bounds.high)) + " |\n";
  }
  return text +
         "\nmodelled: a joint with named faults only, or none. false group: neither a fault of the joint nor a "
         "kin of an unmodelled one.\n";
}

}  // namespace

std::string matrix(const std::vector<Judgement>& judgements) {
  std::string text = "| truth | joints | held | alone | missed | false group | false and alone";
  for (const calibration::CalibrationVerdict verdict : k_verdicts)
    text += " | " + std::string(calibration::word(verdict));
  text += " |\n|---|";
  for (std::size_t i = 0; i < 6 + k_verdicts.size(); ++i) text += "--:|";
  text += "\n";
  std::vector<MatrixRow> rows;
  for (const Judgement& one : judgements) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const MatrixRow& known) { return known.truth == one.truth; });
    if (row == rows.end()) row = rows.insert(rows.end(), MatrixRow{one.truth});
    add(*row, one);
  }
  for (const MatrixRow& row : rows) text += row_text(row);
  text += "\n" + rate_table(judgements) + coverage_table(judgements);
  std::set<std::string> outside;
  for (const Judgement& one : judgements) outside.insert(one.outside.begin(), one.outside.end());
  std::string kin;
  for (const std::string& fault : outside) {
    const std::string names = joined(find_fault(fault).kin);
    if (!names.empty()) kin += (kin.empty() ? "" : "; ") + fault + " is like " + names;
  }
  if (!kin.empty()) text += "\nKin of faults that are unmodelled or left out: " + kin + ".\n";
  return text;
}

}  // namespace fusee::rig
