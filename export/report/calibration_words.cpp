#include "export/report/calibration_words.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/text.h"
#include "calibration/words.h"
#include "export/report/svg.h"
#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::formats {
namespace {

struct NamedUnit {
  std::string_view ending;
  std::string_view shown;
};
// An ending stands before a shorter one that also matches, because the first match is taken.
constexpr std::array<NamedUnit, 10> k_units{{{"_percent_per_decade", " % per decade"},
                                             {"_deg_per_load", "° per "},
                                             {"_percent", " %"},
                                             {"_ppm_per_K", " ppm per K"},
                                             {"_deg", "°"},
                                             {"_Nmm", " N·mm"},
                                             {"_mm", " mm"},
                                             {"_ms", " ms"},
                                             {"_N", " N"},
                                             {"_s", " s"}}};

bool ends_with(std::string_view text, std::string_view ending) {
  return text.size() > ending.size() && text.substr(text.size() - ending.size()) == ending;
}

/// The text that notes about different files share: without the name before the first ": ", and without digits.
std::string shared_text(const std::string& note) {
  const std::size_t colon = note.find(": ");
  std::string text = colon == std::string::npos ? note : note.substr(colon);
  std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
  return text;
}

}  // namespace

std::string open_words(const std::string& name) {
  std::string words = name;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string first_upper(std::string words) {
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

std::string audit_words(const calibration::FoundEffect& effect) {
  if (effect.audit.data_sets == 0) return "";
  return "In " + std::to_string(effect.audit.data_sets) + " simulated joints without " + open_words(effect.name) +
         ", these runs would have reported it in " + std::to_string(effect.audit.false_positives) + ".";
}

std::string unmodelled_words(const calibration::FoundEffect& effect) {
  if (effect.group.empty() || effect.group.back() != calibration::k_unmodelled) return "";
  const calibration::UnmodelledAlternative& rival = effect.unmodelled;
  const std::string alternative = (rival.words.empty() ? "a smooth curve" : rival.words) +
                                  ". Odds for the reported cause: " + calibration::odds(rival.log_odds);
  return "Or an unmodelled cause with the same effect: " + alternative +
         (rival.separating_run.empty() ? "." : ". To distinguish them: " + rival.separating_run + ".");
}

std::string beside_words(const calibration::FoundEffect& effect, const std::string& load_unit) {
  std::vector<std::string> members;
  for (const calibration::GroupMember& member : effect.beside) {
    std::vector<std::string> numbers;
    for (const calibration::FittedParameter& parameter : member.parameters)
      numbers.push_back(parameter_words(parameter, load_unit));
    members.push_back(open_words(member.name) + " (" + joined(numbers, "; ") + ")");
  }
  if (members.empty()) return "";
  return "Perhaps " + joined(members, " and ") +
         " acts too: with both, as in corrected.toml and compensation.csv, held-out runs are predicted best.";
}

std::string discrepancy_words(const calibration::DiscrepancyComponent& part) {
  return rounded(degrees(part.rms), 2) + "° rms, " + part.factor + ": " + part.words;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) text += (i > 0 ? between : "") + words[i];
  return text;
}

std::string share_words(double share) {
  return share > 0.995 ? "all" : share < 0.005 ? "< 1 %" : readable_rounded(std::round(100 * share), 2) + " %";
}

NameAndUnit name_and_unit(const std::string& parameter, const std::string& load_unit) {
  for (const NamedUnit& known : k_units) {
    if (!ends_with(parameter, known.ending)) continue;
    std::string unit(known.shown);
    // An angle per load ends with the load's own unit.
    if (unit == "° per ") unit += load_unit.empty() ? "unit of load" : load_unit;
    return {open_words(parameter.substr(0, parameter.size() - known.ending.size())), unit};
  }
  return {open_words(parameter), ""};
}

std::string parameter_words(const calibration::FittedParameter& parameter, const std::string& load_unit) {
  const auto [name, unit] = name_and_unit(parameter.name, load_unit);
  const std::string if_only = interval_words(parameter.low_if_only, parameter.high_if_only);
  const std::string otherwise = interval_words(parameter.low, parameter.high);
  return name + " = " + readable_rounded(parameter.value) + unit +
         (parameter.sense.empty() ? "" : ": " + parameter.sense) + " (95 %: " + if_only +
         (if_only == otherwise ? "" : " if this is the only cause, else " + otherwise) + ")";
}

std::vector<std::string> rivals_of(const calibration::FoundEffect& effect) {
  std::vector<std::string> rivals;
  for (const std::string& member : effect.group) {
    if (member != effect.name) rivals.push_back(member);
  }
  return rivals;
}

std::string round_words(const correction::Correction& correction) {
  const double error = degrees(correction.round.max_error);
  const std::string radius = "at its best radius of " + rounded(correction.round.r1, 5) + " mm the joint ";
  const std::string miss = error < 0.001 ? "by less than 0.001°" : "by up to " + rounded(error, 3) + "°";
  if (correction.round.suffices) return "P1 stays round: " + radius + "deviates from its law " + miss;
  return "P1 is not round, so that the joint follows its law; round, " + radius + "would deviate " + miss;
}

std::string infeasible_words(const correction::Correction& correction) {
  return "the pulley that would correct this cannot be made: " + correction.infeasible;
}

std::string assembly_angle_words(const correction::Correction& correction) {
  return "tie its tendons with the unloaded joint at home and the motor at " +
         rounded(degrees(correction.assembly_angle), 4) +
         " deg: under its mean load the joint then follows its law. Assembled at 0, it is off by as much, which "
         "compensation.csv corrects";
}

std::vector<std::pair<double, std::vector<std::string>>> detectable_groups(
    const calibration::Calibration& calibration) {
  std::vector<calibration::Detectable> sorted = calibration.detectable;
  std::stable_sort(
      sorted.begin(), sorted.end(),
      [](const calibration::Detectable& a, const calibration::Detectable& b) { return a.smallest < b.smallest; });
  std::vector<std::pair<double, std::vector<std::string>>> groups;
  std::string group_size;
  for (const calibration::Detectable& detectable : sorted) {
    const std::string size = rounded(degrees(detectable.smallest), 2);
    if (groups.empty() || size != group_size) {
      groups.push_back({detectable.smallest, {}});
      group_size = size;
    }
    groups.back().second.push_back(detectable.name);
  }
  return groups;
}

namespace {

/// "0 … 10 N", or "5 N".
std::string from_to_words(const std::vector<double>& values, const std::string& unit) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const std::string from = rounded(*least, 2), to = rounded(*most, 2);
  return (from == to ? from : from + " … " + to) + unit;
}

/// The ranges of angle, load and speed in which the data were measured.
std::string measured_range_words(const CalibrationProduct& product) {
  const calibration::EmpiricalCurve& curve = product.calibration.curve;
  std::vector<double> loads, speeds;
  for (const measurement::Run& run : product.measurement.runs) {
    for (const measurement::Sample& sample : run.samples) {
      if (run.has_load) loads.push_back(sample.load);
    }
    if (run.has_time && run.speed > 0) speeds.push_back(degrees(run.speed));
  }
  std::string words = "alpha " + from_to_words({degrees(curve.alpha.front()), degrees(curve.alpha.back())}, "°");
  if (!loads.empty()) words += ", load " + from_to_words(loads, " " + product.measurement.load_unit);
  if (!speeds.empty()) words += ", speed " + from_to_words(speeds, " °/s");
  return words;
}

std::string ratio_curve_words(const CalibrationProduct& product) {
  if (product.calibration.identified.ratio_joint.curve == RatioCurve{}) return "";
  return "compensation.csv also removes a smooth curve of the angle, with a part proportional to the load: the ratio "
         "changes with the angle, or an unmodelled cause has the same effect";
}

std::string empirical_curve_words(const CalibrationProduct& product) {
  const calibration::EmpiricalCurve& curve = product.calibration.curve;
  if (!curve.used)
    return curve.why.empty() ? "" : "compensation.csv does not cover the unmodelled residual: " + curve.why;
  return "an empirical curve in compensation.csv corrects the error that depends on place and direction alone: by " +
         rounded(degrees(curve.gain), 3) + "° rms on held-out data (" + rounded(degrees(curve.held_out_effects), 3) +
         "° → " + rounded(degrees(curve.held_out_rms), 3) +
         "°). It states no cause, and holds for this joint as it was measured (" + measured_range_words(product) +
         "). If the joint's sensor causes the error, the table makes the joint wrong by as much. If the pulley does, "
         "measure again after another pulley is mounted";
}

}  // namespace

std::string curve_words(const CalibrationProduct& product) {
  const std::string of_ratio = ratio_curve_words(product), empirical = empirical_curve_words(product);
  if (of_ratio.empty()) return empirical;
  return product.calibration.curve.used ? of_ratio + ". " + first_upper(empirical) : of_ratio;
}

std::vector<std::string> next_texts(const calibration::Calibration& calibration) {
  std::vector<std::string> texts;
  for (const plan::NextMeasurement& next : calibration.next) texts.push_back(next.text());
  return texts;
}

std::vector<std::string> input_error_texts(const CalibrationProduct& product) {
  std::vector<std::string> all;
  for (const calibration::LikelyInputError& error : product.input_errors)
    all.push_back(calibration::input_error_words(error));
  return all;
}

std::vector<std::string> shortened_notes(const std::vector<std::string>& notes) {
  constexpr std::size_t k_shown_alike = 2;
  std::map<std::string, std::size_t> count;
  for (const std::string& note : notes) ++count[shared_text(note)];
  std::map<std::string, std::size_t> seen;
  std::vector<std::string> shown;
  for (const std::string& note : notes) {
    const std::size_t all = count[shared_text(note)], nth = ++seen[shared_text(note)];
    // A line in place of a single note would save nothing.
    if (nth <= k_shown_alike || all == k_shown_alike + 1) {
      shown.push_back(note);
    } else if (nth == k_shown_alike + 1) {
      shown.push_back("and " + std::to_string(all - k_shown_alike) + " more like this; calibration.json has all");
    }
  }
  return shown;
}

}  // namespace fusee::formats
