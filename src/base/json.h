/// \file
/// Internal: JSON, as all of fusee writes and reads it. What nlohmann makes text with, and what it parses with, each
/// file that asked for it compiled for itself: here once.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace fusee {

using Json = nlohmann::ordered_json;

/// `indent` blanks a level, and a line's end. Names of files and messages may hold any bytes, JSON may not: what is no
/// UTF-8 is replaced, and what a terminal would obey is escaped.
std::string json_text(const Json& json, int indent);

/// JSON knows no NaN and no infinity: null. The last digits of a fit or a simulation are noise, and nine are kept.
Json nine_digits(double value);
/// The same of an angle, in degrees.
Json angle_json(double angle);

/// Of fusee's own text. Throws nlohmann's error where it is no JSON.
Json parse_json(std::string_view text);

/// Of text that anybody may have written: no object where it is no JSON, and without what nests deeper than anything
/// that fusee writes.
Json parse_foreign_json(std::string_view text);

}  // namespace fusee
