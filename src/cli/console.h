/// \file
/// Output streams: results on stdout, messages and progress on stderr. A failing stream never crashes the program.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fusee/base.h"

namespace fusee::cli {

struct ConsoleOptions {
  bool quiet = false;
  bool verbose = false;
  bool no_color = false;
};

class Console {
 public:
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void set_options(ConsoleOptions options) { options_ = options; }
  bool verbose() const { return options_.verbose; }
  /// Writes a diagnostic to stderr; with --quiet only errors.
  void report(const Diagnostic& diagnostic);
  /// Shows the present step and its share: on a terminal a bar that is overwritten, elsewhere a plain line with
  /// --verbose, else nothing.
  void progress(std::string_view step, std::optional<double> share = std::nullopt);
  /// Writes a question to stderr, also with --quiet, and reads a line from stdin; empty at the end of the input. Lines
  /// longer than any answer are cut.
  std::optional<std::string> ask(std::string_view question);
  /// Writes text of a conversation to stderr, also with --quiet.
  void write(std::string_view text);
  /// Removes the progress line.
  void end_progress();

 private:
  ConsoleOptions options_;
  bool terminal_;  ///< stderr is one
  bool color_;     ///< as terminal and environment allow
  bool progress_shown_ = false;
};

/// Writes text to stdout after cleaned(). False if it could not be delivered (full disk, closed or broken pipe); errno
/// has the reason.
bool write_result(std::string_view text);

/// Opens closed standard descriptors, so that no output file takes their place and receives messages. Writes to such a
/// stdout fail; to such a stderr they are ignored. A broken pipe gives an error instead of a signal.
void make_streams_safe();

}  // namespace fusee::cli
