#include "cli/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <exception>
#include <string_view>

namespace fusee::cli {
namespace {

// A signal handler can speak to the program through nothing but globals of this type.
volatile std::sig_atomic_t interrupted = 0;
volatile std::sig_atomic_t is_deferred = 0;
volatile std::sig_atomic_t json_wanted = 0;

void write_signal_safe(int descriptor, std::string_view text) {
  // The program ends here; a failed write has nobody left to tell.
  [[maybe_unused]] const ssize_t written = ::write(descriptor, text.data(), text.size());
}

[[noreturn]] void leave() {
  write_signal_safe(STDERR_FILENO, "fusee: error: interrupted\n");
  if (json_wanted) {
    write_signal_safe(
        STDOUT_FILENO,
        "{\"schema\": 1, \"ok\": false, \"exit\": 130, \"errors\": [{\"file\": \"\", \"line\": 0, \"column\": 0, "
        "\"message\": \"interrupted\", \"hint\": \"\"}]}\n");
  }
  ::_exit(130);
}

extern "C" void on_signal(int) {
  interrupted = 1;
  if (!is_deferred) leave();
}

}  // namespace

void catch_interrupts(bool json) {
  json_wanted = json ? 1 : 0;
  struct sigaction action = {};
  action.sa_handler = on_signal;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  // nohup asks for hang-ups to be ignored.
  struct sigaction before = {};
  ::sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
}

InterruptsDeferred::InterruptsDeferred() { is_deferred = 1; }
InterruptsDeferred::~InterruptsDeferred() {
  if (std::uncaught_exceptions() > 0) is_deferred = 0;
}

void leave_interrupted() { leave(); }

bool is_interrupted() { return interrupted != 0; }

void stop_if_interrupted() {
  if (interrupted) throw Interrupted();
}

}  // namespace fusee::cli
