#include "base/json.h"

#include <cmath>

#include "base/text.h"
#include "fusee/base.h"

namespace fusee {

std::string json_text(const Json& json, int indent) {
  return unicode_escaped(json.dump(indent, ' ', false, Json::error_handler_t::replace)) + "\n";
}

Json result_json(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value == 0 ? 0.0 : number_of(rounded(value, 6));
}

Json angle_json(double angle) { return result_json(degrees(angle)); }

Json parse_json(std::string_view text) { return Json::parse(text); }

Json parse_foreign_json(std::string_view text) {
  // nlohmann parses nested lists without recursion, but destroys and compares them recursively. A bundle's index nests
  // four deep, a manifest three.
  const auto shallow = [](int depth, Json::parse_event_t, Json&) { return depth <= 8; };
  return Json::parse(text, shallow, /*allow_exceptions=*/false);
}

}  // namespace fusee
