/// \file
/// The two streams: results on stdout, messages and progress on stderr. Neither can crash the program.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fusee/base/diagnostics.h"

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
  /// A diagnostic on stderr. With --quiet only errors.
  void say(const Diagnostic& diagnostic);
  /// What is being done now: a line that is overwritten on a terminal, a plain line with --verbose elsewhere, nothing
  /// otherwise.
  void progress(std::string_view step);
  /// Puts a question on stderr, --quiet or not, and waits for a line of stdin; none at its end. A line that has none is
  /// cut where it is longer than any answer.
  std::optional<std::string> ask(std::string_view question);
  /// Removes the progress line.
  void end_progress();

 private:
  ConsoleOptions options_;
  bool terminal_;
  bool color_;  ///< as far as terminal and environment go
  bool progress_shown_ = false;
};

/// "[########............] 40 %" of a share 0 … 1.
std::string progress_bar(double share);

/// All of `text` to stdout, cleaned(). False when it could not be delivered (a full disk, a closed or broken pipe);
/// errno says why.
bool write_result(std::string_view text);

/// Standard descriptors that are closed are filled, so that no output file is opened in their place and receives
/// messages. A write to a filled one fails for stdout and is swallowed for stderr. A broken pipe becomes an error
/// instead of a signal.
void make_streams_safe();

}  // namespace fusee::cli
