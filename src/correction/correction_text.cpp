#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "calibration/words.h"
#include "fusee/correction.h"
#include "fusee/mechanism_file.h"
#include "mechanism/lengths.h"

namespace fusee::correction {
namespace {

/// The text with a blank in place of each control character, so that it stays within a comment.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text;
}

std::string number_text(const calibration::FittedParameter& parameter) {
  return ": " + parameter.name + " = " + rounded(parameter.value) + ", 95 % within " + rounded(parameter.low) + " to " +
         rounded(parameter.high);
}

std::string found_text(const calibration::FoundEffect& effect) {
  std::string text = "# " + effect.name + " (" + std::string(word(effect.place)) + ")";
  for (const calibration::FittedParameter& parameter : effect.parameters) text += number_text(parameter);
  if (effect.group.size() < 2) return text;
  text += "; or";
  for (const std::string& rival : effect.group) {
    if (rival != effect.name) text += " " + rival;
  }
  text += ": these data do not distinguish them";
  for (const calibration::GroupMember& member : effect.beside) {
    text += "; perhaps with " + member.name;
    for (const calibration::FittedParameter& parameter : member.parameters) text += number_text(parameter);
  }
  return text;
}

/// The value rounded to six digits: more than the accuracy of any bench, and shorter than a full double.
double rounded_to_six_digits(double value) {
  if (value == 0 || !std::isfinite(value)) return 0;
  const double scale = elementary::pow(10.0, 5 - std::floor(elementary::log10(std::abs(value))));
  return std::isfinite(scale) ? std::round(value * scale) / scale : 0;
}

constexpr const char* k_title =
    "# ---- found by fusee calibrate: without this table this is the declared joint again ----\n";

/// Removes the comment of an earlier calibration.
std::string without_earlier_comment(std::string text) {
  const std::size_t title = text.find(k_title);
  if (title == std::string::npos) return text;
  std::size_t end = title;  // every line of the comment begins with #
  while (end < text.size() && text[end] == '#') end = std::min(text.find('\n', end), text.size() - 1) + 1;
  return text.erase(title, end - title);
}

/// The comment inside the table [identified].
std::string comment_of(const calibration::Calibration& calibration, const Correction& correction) {
  std::string comment =
      std::string(k_title) + "# verdict: " + std::string(calibration::word(calibration.verdict)) + "\n";
  for (const calibration::FoundEffect& effect : calibration.effects) comment += one_line(found_text(effect)) + "\n";
  if (calibration.effects.empty()) comment += "# no effect was found that the declared file lacks\n";
  if (correction.by_curve > 0) {
    comment += "# compensation.csv corrects the unmodelled error by an empirical curve of place and direction: " +
               rounded(degrees(correction.by_curve), 2) + " deg rms\n";
  }
  if (correction.assembly_angle != 0) {
    comment +=
        "# Tie the tendons with the unloaded joint at home and the motor at " +
        rounded(degrees(correction.assembly_angle), 4) +
        " deg: the joint then follows the law under its mean load.\n# If assembled at 0 deg, use compensation.csv "
        "for the motor angles.\n";
  }
  return comment;
}

/// Edits that set the keys of [identified]. A key at its default is edited only if the file states another value.
std::vector<ValueEdit> identified_edits(const DeclaredMechanism& declared, const Imperfections& identified) {
  DeclaredMechanism corrected = declared;
  corrected.identified = identified;
  const DeclaredMechanism defaults;
  std::vector<ValueEdit> edits;
  for (const Field& field : fields()) {
    if (field.table != "identified") continue;
    const LengthUnit units = is_length(field.key) ? declared.units : LengthUnit::mm;
    const double value = to_mm(rounded_to_six_digits(from_mm(field.get(corrected, 0), units)), units);
    const double default_value = field.get(defaults, 0);
    if (value != default_value || field.get(declared, 0) != default_value)
      edits.push_back({field.name(), std::min(std::max(value, field.least), field.most)});
  }
  return edits;
}

/// Index of the line below the header [identified]; npos without that header.
std::size_t below_header(const std::string& text) {
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t end = std::min(text.find('\n', line), text.size());
    std::string header = text.substr(line, end - line);
    header.erase(std::min(header.find('#'), header.size()));
    std::erase_if(header, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
    if (header == "[identified]") return std::min(end + 1, text.size());
    line = end + 1;
  }
  return std::string::npos;
}

}  // namespace

// Comment and numbers stand inside the table: deleting the table restores the declared file byte for byte.
std::string corrected_toml(std::string_view declared_text, const DeclaredMechanism& declared,
                           const calibration::Calibration& calibration, const Correction& correction) {
  std::string text = without_earlier_comment(std::string(declared_text));
  const std::vector<ValueEdit> edits = identified_edits(declared, correction.identified);
  if (edits.empty() && below_header(text) == std::string::npos)
    text += (!text.empty() && text.back() != '\n' ? "\n\n" : "\n") + std::string("[identified]\n");
  text = edit_values(text, edits);
  const std::string comment = comment_of(calibration, correction);
  const std::size_t start = below_header(text);
  if (start == std::string::npos) return text + comment;  // the file has an inline table
  return text.insert(start, comment);
}

std::string compensation_csv(const Correction& correction) {
  const bool has_curve = correction.by_curve > 0;
  std::string text = "theta_deg,alpha_up_deg,alpha_down_deg";
  text += has_curve ? ",empirical_up_deg,empirical_down_deg\n" : "\n";
  const auto add = [&](double angle, char separator) { text += fixed(degrees(angle), 4) + separator; };
  for (const CompensationRow& row : correction.table) {
    add(row.theta, ',');
    add(row.alpha_up, ',');
    add(row.alpha_down, has_curve ? ',' : '\n');
    if (!has_curve) continue;
    add(row.curve_up, ',');
    add(row.curve_down, '\n');
  }
  return text;
}

}  // namespace fusee::correction
