#include "mechanism/field_text.h"

#include <fmt/format.h>

#include "base/text.h"
#include "mechanism/lengths.h"

namespace fusee {
namespace {

/// Control characters, quotes and backslashes escaped as in TOML.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\r':
        out += "\\r";
        break;
      case '\t':
        out += "\\t";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
          out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
        } else {
          out += c;
        }
    }
  }
  return out;
}

}  // namespace

std::string with_unit(double value, std::string_view unit) {
  return unit.empty() ? shortest(value) : shortest(value) + " " + std::string(unit);
}

std::string choices_text(const std::vector<std::string_view>& choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) text += i + 1 == choices.size() ? " or " : ", ";
    text += "\"" + std::string(choices[i]) + "\"";
  }
  return text;
}

std::string bounds_text(const Field& field, LengthUnit units) {
  const auto bound = [&](double value) {
    return is_length(field.key) && units != LengthUnit::mm ? rounded(from_mm(value, units)) : shortest(value);
  };
  const std::string unit(unit_in_file(field, units));
  return bound(field.least) + " to " + bound(field.most) + (unit.empty() ? "" : " " + unit);
}

std::string allowed_text(const Field& field, LengthUnit units) {
  switch (field.kind) {
    case FieldKind::number:
      if (field.least == field.most) return shortest(field.least);
      return bounds_text(field, units);
    case FieldKind::range:
      return "lowest <= 0 <= highest, both " + bounds_text(field, units);
    case FieldKind::point:
      return "both " + bounds_text(field, units);
    case FieldKind::choice:
      return choices_text(field.choices);
    case FieldKind::text:
      return "any text of one line";
    case FieldKind::boolean:
      return "true or false";
    case FieldKind::numbers:
      return shortest(field.least) + " to " + shortest(field.most) + " each";
    case FieldKind::texts:
      return field.choices.empty() ? "texts of one line" : choices_text(field.choices);
  }
  return {};
}

std::string kind_text(const Field& field, LengthUnit units) {
  const std::string unit(unit_in_file(field, units));
  const bool has_unit = !unit.empty() && field.kind != FieldKind::numbers;
  const std::string unit_name = unit == "in" ? "inches" : unit;
  const std::string in_unit = has_unit ? " in " + unit_name : "";
  switch (field.kind) {
    case FieldKind::number:
      return (field.whole ? "a whole number" : "a number") + in_unit;
    case FieldKind::range:
      return "two numbers [lowest, highest]" + in_unit;
    case FieldKind::point:
      return "two numbers [across, along]" + in_unit;
    case FieldKind::choice:
      return choices_text(field.choices);
    case FieldKind::text:
      return "a text in quotes";
    case FieldKind::boolean:
      return "true or false";
    case FieldKind::numbers:
      return "a list of numbers";
    case FieldKind::texts:
      return field.choices.empty() ? "a list of texts in quotes" : "one or a list of " + choices_text(field.choices);
  }
  return {};
}

std::string toml_string(std::string_view text) { return "\"" + escaped(text) + "\""; }

std::string as_shown(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return unicode_escaped(escaped(text));
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // do not split a UTF-8 character
  return unicode_escaped(escaped(text.substr(0, end))) + "...";
}

std::string in_quotes(std::string_view text) { return "\"" + as_shown(text) + "\""; }

std::string condition_text(const Field& field) {
  const std::size_t equals = field.only_when.find('=');
  const std::size_t dot = field.only_when.find('.');
  return std::string(field.only_when.substr(dot + 1, equals - dot - 1)) + " = \"" +
         std::string(field.only_when.substr(equals + 1)) + "\"";
}

std::string default_text(const Field& field) {
  const std::string only = field.only_when.empty() ? "" : " with " + condition_text(field);
  if (!field.otherwise.empty()) return "if omitted: " + std::string(field.otherwise);
  if (field.fallback.empty()) return "required" + only;
  const std::string unit = field.unit.empty() ? "" : " " + std::string(field.unit);
  return "default " + std::string(field.fallback) + unit + (only.empty() ? "" : "; used only" + only);
}

}  // namespace fusee
