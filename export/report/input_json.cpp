#include "export/report/input_json.h"

#include <cmath>
#include <filesystem>
#include <map>

#include "export/report/html.h"

namespace fusee::formats {
namespace {

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Conversions to degrees and percent add rounding errors. Without the last digits, 30° is 30 as in the file.
Json as_written(double value) {
  constexpr int k_digits = 12;
  double rounded_value = value;
  if (value != 0 && std::isfinite(value)) {
    const double scale = elementary::pow(10.0, k_digits - 1 - std::floor(elementary::log10(std::abs(value))));
    rounded_value = std::round(value * scale) / scale;
  }
  return finite_or_null(rounded_value);
}

/// The last value of each key.
std::map<std::string, std::string> last_settings(const MechanismFile& file) {
  std::map<std::string, std::string> last;
  for (const Setting& setting : file.settings) last[setting.key] = setting.value;
  return last;
}

}  // namespace

Json field_value(const Field& field, const DeclaredMechanism& mechanism) {
  switch (field.kind) {
    case FieldKind::number:
      return finite_or_null(field.get(mechanism, 0));
    case FieldKind::range:
    case FieldKind::point:
      return {as_written(field.get(mechanism, 0)), as_written(field.get(mechanism, 1))};
    case FieldKind::choice:
    case FieldKind::text:
      return field.get_text(mechanism);
    case FieldKind::boolean:
      return field.get_text(mechanism) == "true";
    case FieldKind::numbers:
    case FieldKind::texts: {
      DeclaredMechanism copy = mechanism;  // list fields are accessed through a mutable reference
      return field.kind == FieldKind::numbers ? Json(field.numbers(copy)) : Json(field.texts(copy));
    }
  }
  return nullptr;
}

Json input_json(const MechanismFile& file) {
  Json set = Json::object();
  for (const auto& [key, value] : last_settings(file)) {
    const Field* field = find_field(key);
    set[key] = field != nullptr ? field_value(*field, file.mechanism) : Json(value);
  }
  return {{"file", std::filesystem::path(file.path).filename().string()}, {"sha256", file.sha256}, {"set", set}};
}

std::string source_html(const MechanismFile& file) {
  std::string settings;
  for (const auto& [key, value] : last_settings(file))
    settings += (settings.empty() ? "--set " : " --set ") + key + "=" + value;
  const std::string name = std::filesystem::path(file.path).filename().string();
  std::string html = name.empty() ? "" : "<code>" + safe_text(name) + "</code>";
  if (!settings.empty()) html += (html.empty() ? "with <code>" : " with <code>") + safe_text(settings) + "</code>";
  return html;
}

}  // namespace fusee::formats
