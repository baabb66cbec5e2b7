/// \file
/// Internal: JSON reading and writing. The nlohmann templates are compiled here once.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace fusee {

using Json = nlohmann::ordered_json;

/// JSON text with `indent` blanks a level and a line feed at the end. Bytes that are not UTF-8 are replaced, and
/// terminal control characters are escaped.
std::string json_text(const Json& json, int indent);

/// A result with six significant digits, as further ones can neither be made nor measured. Null for NaN and infinity,
/// which JSON lacks.
Json result_json(double value);
/// An angle (rad) in degrees, as a result.
Json angle_json(double angle);

/// Parses text that fusee wrote. Throws nlohmann's error on invalid JSON.
Json parse_json(std::string_view text);

/// Parses untrusted text. Returns a discarded value for invalid JSON, and drops values that nest deeper than any that
/// fusee writes.
Json parse_foreign_json(std::string_view text);

}  // namespace fusee
