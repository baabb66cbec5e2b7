#include "cli/console.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "base/text.h"
#include "cli/interrupt.h"

namespace fusee::cli {
namespace {

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    // Other signals are no failure. After Ctrl-C the reader may be blocked for ever, so the write ends.
    if (written < 0 && errno == EINTR && !is_interrupted()) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Writes to stderr; file names and bundle texts may contain terminal control codes.
void show(std::string_view text) { write_all(STDERR_FILENO, cleaned(text)); }

/// Colours the first "error:" red, "warning:" yellow, "note:" blue and "hint:" cyan.
std::string colored(std::string text, Severity severity) {
  const auto paint = [&text](std::string_view word, std::string_view code) {
    const std::size_t at = text.find(word);
    if (at != std::string::npos)
      text.replace(at, word.size(), "\x1b[" + std::string(code) + "m" + std::string(word) + "\x1b[0m");
  };
  if (severity == Severity::error) paint("error:", "1;31");
  if (severity == Severity::warning) paint("warning:", "1;33");
  if (severity == Severity::note) paint("note:", "1;34");
  paint("  hint:", "36");
  return text;
}

int percent_of(double share) { return static_cast<int>(100 * std::clamp(share, 0.0, 1.0)); }

/// A bar such as "[########............] " for 40 %.
std::string progress_bar(int percent) {
  constexpr std::size_t k_width = 20;
  const auto full = static_cast<std::size_t>(percent) * k_width / 100;
  return "[" + std::string(full, '#') + std::string(k_width - full, '.') + "] ";
}

bool wants_color() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return (no_color == nullptr || *no_color == '\0') && terminal != nullptr && std::string_view(terminal) != "dumb";
}

}  // namespace

Console::Console() : terminal_(::isatty(STDERR_FILENO) == 1), color_(terminal_ && wants_color()) {}

Console::~Console() { end_progress(); }

void Console::report(const Diagnostic& diagnostic) {
  if (options_.quiet && diagnostic.severity != Severity::error) return;
  end_progress();
  std::string text = cleaned(to_text(diagnostic));
  if (diagnostic.place.file.empty()) text.insert(0, "fusee: ");
  if (color_ && !options_.no_color) text = colored(std::move(text), diagnostic.severity);
  write_all(STDERR_FILENO, text + "\n");
}

void Console::progress(std::string_view step, std::optional<double> share) {
  if (options_.quiet) return;
  std::string line;
  if (share) {
    const int percent = percent_of(*share);
    line = (terminal_ ? progress_bar(percent) : "") + std::to_string(percent) + " %" + (step.empty() ? "" : ", ");
  }
  line += step;
  if (options_.verbose) {
    show("fusee: " + line + "\n");
  } else if (terminal_) {
    write_all(STDERR_FILENO, "\r\x1b[K");
    show(line + " …");
    progress_shown_ = true;
  }
}

std::optional<std::string> Console::ask(std::string_view question) {
  constexpr std::size_t k_longest_answer = 4096;
  end_progress();
  show(question);
  std::string line;
  char c = 0;
  while (line.size() < k_longest_answer) {
    // One byte at a time: input after this line may belong to another program.
    const ssize_t count = ::read(STDIN_FILENO, &c, 1);
    if (count < 0 && errno == EINTR && !is_interrupted()) continue;
    if (count <= 0) {
      write_all(STDERR_FILENO, "\n");
      return line.empty() ? std::nullopt : std::optional(line);
    }
    if (c == '\n') break;
    line += c;
  }
  if (::isatty(STDIN_FILENO) != 1) write_all(STDERR_FILENO, "\n");  // a terminal echoes the line break
  return line;
}

void Console::write(std::string_view text) {
  end_progress();
  show(text);
}

void Console::end_progress() {
  if (progress_shown_) write_all(STDERR_FILENO, "\r\x1b[K");
  progress_shown_ = false;
}

bool write_result(std::string_view text) { return write_all(STDOUT_FILENO, cleaned(text)); }

void make_streams_safe() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond `ulimit -f` fails like any other write
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // open() takes the lowest free number, which is this descriptor.
    ::open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);
  }
}

}  // namespace fusee::cli
