#include "pipeline/design_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "fusee/base.h"

namespace fusee::pipeline {
namespace {

constexpr std::size_t k_largest_file = 1 << 20;  // bytes

Diagnostic warning(std::string message) {
  Diagnostic diagnostic;
  diagnostic.severity = Severity::warning;
  diagnostic.message = std::move(message);
  return diagnostic;
}

/// True if the edited text is a valid mechanism with the intended numbers.
bool has_values(const std::string& text, const std::vector<ValueEdit>& edits, const std::string& path,
                FileAccess& files) {
  try {
    const DeclaredMechanism read =
        parse_mechanism(text, path, std::filesystem::path(path).parent_path(), {}, nullptr, nullptr, files);
    return std::all_of(edits.begin(), edits.end(), [&read](const ValueEdit& edit) {
      return std::abs(find_number_key(edit.key)->get(read) - edit.value) <= 1e-12 * std::abs(edit.value);
    });
  } catch (const InputError&) {
    return false;
  }
}

/// Edits of the settings, then of the design, which takes precedence.
std::vector<ValueEdit> all_edits(const optimize::Problem& problem, const optimize::Design& design,
                                 const std::vector<Setting>& settings, std::vector<Diagnostic>& warnings) {
  std::vector<ValueEdit> edits;
  for (const Setting& setting : settings) {
    const auto key = find_number_key(setting.key);
    if (key)
      edits.push_back({setting.key, key->get(problem.base)});
    else if (setting.key != "units")
      warnings.push_back(warning("the new file omits --set " + setting.key + "=" + setting.value));
  }
  for (const ValueEdit& edit : optimize::edits_of(problem, design)) {
    std::erase_if(edits, [&edit](const ValueEdit& earlier) { return earlier.key == edit.key; });
    edits.push_back(edit);
  }
  return edits;
}

}  // namespace

DesignFile design_file(const MechanismFile& file, const optimize::Problem& problem, const optimize::Design& design,
                       const std::vector<Setting>& settings, FileAccess& files) {
  DesignFile result;
  const std::vector<ValueEdit> edits = all_edits(problem, design, settings, result.warnings);
  result.text = edit_values(read_file(file.path, k_largest_file, files), edits);
  const bool keeps_units =
      std::none_of(settings.begin(), settings.end(), [](const Setting& setting) { return setting.key == "units"; });
  if (keeps_units && has_values(result.text, edits, file.path, files)) return result;
  // The edits fail if dotted keys leave no place for a new key of their table. Other units change every length.
  result.warnings.push_back(warning("the layout of " + file.path + " could not be kept: the new file has every key"));
  DeclaredMechanism whole = optimize::mechanism_at(problem, design);
  whole.optimize = file.mechanism.optimize;
  result.text = write_mechanism(whole);
  return result;
}

}  // namespace fusee::pipeline
