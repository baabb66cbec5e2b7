#include <algorithm>
#include <numeric>

#include "fusee/base.h"

namespace fusee {
namespace {

std::string severity_word(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::warning:
      return "warning";
    case Severity::note:
      return "note";
  }
  return "error";
}

std::string joined(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!text.empty()) text += '\n';
    text += to_text(diagnostic);
  }
  return text;
}

/// Levenshtein distance, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
    }
  }
  return row.back();
}

}  // namespace

std::string to_text(const Diagnostic& diagnostic) {
  std::string text = diagnostic.place.file;
  if (diagnostic.place.line > 0) text += ":" + std::to_string(diagnostic.place.line);
  if (diagnostic.place.line > 0 && diagnostic.place.column > 0) text += ":" + std::to_string(diagnostic.place.column);
  if (!text.empty()) text += ": ";
  text += severity_word(diagnostic.severity) + ": " + diagnostic.message;
  if (!diagnostic.hint.empty()) text += "\n  hint: " + diagnostic.hint;
  return text;
}

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(joined(diagnostics)), diagnostics_(std::move(diagnostics)) {}

InputError::InputError(Diagnostic diagnostic) : InputError(std::vector<Diagnostic>{std::move(diagnostic)}) {}

InputError::InputError(std::string file, std::string message, std::string hint)
    : InputError(Diagnostic{Severity::error, {std::move(file), 0, 0}, std::move(message), std::move(hint)}) {}

OutputError::OutputError(const std::string& message, std::string hint)
    : std::runtime_error(message), hint_(std::move(hint)) {}

void demand(bool holds, const std::string& what) {
  if (!holds) throw Bug(what);
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string* best = nullptr;
  std::size_t best_distance = 0;
  // A word further away is not a likely misspelling.
  const std::size_t largest_distance = std::max<std::size_t>(2, word.size() / 2);
  // Long input is no misspelling and would need a large table.
  if (word.size() > 100) return {};
  for (const std::string& candidate : candidates) {
    const bool unit_left_out = candidate.rfind(std::string(word) + "_", 0) == 0;  // "r1" for "r1_mm"
    const std::size_t distance = unit_left_out ? 1 : edit_distance(word, candidate);
    if (distance <= largest_distance && (best == nullptr || distance < best_distance)) {
      best = &candidate;
      best_distance = distance;
    }
  }
  return best == nullptr ? std::string() : *best;
}

}  // namespace fusee
