#include "cli/immediate_exit.h"

#include <unistd.h>

#include <array>
#include <charconv>
#include <csignal>

namespace fusee::cli {
namespace {

// The only globals that a signal handler may access.
volatile std::sig_atomic_t json_wanted = 0;

void write_signal_safe(int descriptor, std::string_view text) {
  // The program exits here, so a failed write cannot be reported.
  [[maybe_unused]] const ssize_t written = ::write(descriptor, text.data(), text.size());
}

}  // namespace

void write_json_at_exit(bool json) { json_wanted = json ? 1 : 0; }

void exit_at_once(Exit exit, std::string_view message) {
  const int code = static_cast<int>(exit);
  write_signal_safe(STDERR_FILENO, "fusee: error: ");
  write_signal_safe(STDERR_FILENO, message);
  write_signal_safe(STDERR_FILENO, "\n");
  if (json_wanted) {
    std::array<char, 12> digits{};
    const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), code).ptr;
    write_signal_safe(STDOUT_FILENO, "{\"schema\": 1, \"ok\": false, \"exit\": ");
    write_signal_safe(STDOUT_FILENO, {digits.data(), static_cast<std::size_t>(end - digits.data())});
    write_signal_safe(STDOUT_FILENO, ", \"errors\": [{\"file\": \"\", \"line\": 0, \"column\": 0, \"message\": \"");
    write_signal_safe(STDOUT_FILENO, message);
    write_signal_safe(STDOUT_FILENO, "\", \"hint\": \"\"}]}\n");
  }
  ::_exit(code);
}

}  // namespace fusee::cli
