/// \file
/// Errors and diagnostics: what is wrong, where, and what to change.
///
/// There are three kinds of failure and no fourth:
///   bad input           InputError, with *all* its diagnostics
///   infeasible design   a value (profile/synthesis.h, solid/pulley.h)
///   a bug in fusee      Bug, thrown by demand(), with the values that broke it
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace fusee {

/// Position in an input file. Lines and columns count from 1; 0 means "the whole file".
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

enum class Severity { error, warning, note };

/// One error, warning or note about the input.
struct Diagnostic {
  Severity severity = Severity::error;
  Place place;
  std::string message;  ///< what is wrong, with the value and its unit
  std::string hint;     ///< what to change; may be empty
};

/// "joint.toml:3:5: error: …" and, on a second line, "  hint: …".
std::string to_text(const Diagnostic& diagnostic);

/// Unusable input. Exit code 3.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> diagnostics);
  explicit InputError(Diagnostic diagnostic);
  /// An error about a whole file (line 0).
  InputError(std::string file, std::string message, std::string hint = {});

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// An output place exists and was not written by fusee, or cannot be written. Exit code 6.
class OutputError : public std::runtime_error {
 public:
  explicit OutputError(const std::string& message, std::string hint = {});
  const std::string& hint() const { return hint_; }

 private:
  std::string hint_;
};

/// An error in fusee itself. Exit code 1.
class Bug : public std::logic_error {
  using std::logic_error::logic_error;
};

/// Throws Bug(what) unless `holds`. `what` should name the values: demand(n > 2, "ring of " + std::to_string(n)).
void demand(bool holds, const std::string& what);

/// The candidate nearest to `word` by edit distance, or "" when none is near enough.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace fusee
