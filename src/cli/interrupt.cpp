#include "cli/interrupt.h"

#include <gmp.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "cli/reply.h"

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

/// Ends the program at once, in the words and the document of any failed run. Neither allocates.
[[noreturn]] void leave(Exit exit, std::string_view message) {
  write_signal_safe(STDERR_FILENO, "fusee: error: ");
  write_signal_safe(STDERR_FILENO, message);
  write_signal_safe(STDERR_FILENO, "\n");
  if (json_wanted) {
    write_signal_safe(STDOUT_FILENO, "{\"schema\": 1, \"ok\": false, \"exit\": ");
    write_signal_safe(STDOUT_FILENO, exit == Exit::interrupted ? "130" : "6");
    write_signal_safe(STDOUT_FILENO, ", \"errors\": [{\"file\": \"\", \"line\": 0, \"column\": 0, \"message\": \"");
    write_signal_safe(STDOUT_FILENO, message);
    write_signal_safe(STDOUT_FILENO, "\", \"hint\": \"\"}]}\n");
  }
  ::_exit(static_cast<int>(exit));
}

[[noreturn]] void leave_without_memory() { leave(Exit::cannot_write, "not enough memory for this"); }

extern "C" void on_signal(int) {
  interrupted = 1;
  if (!is_deferred) leave_interrupted();
}

extern "C" void* allocate_for_gmp(size_t size) {
  void* const room = std::malloc(size);
  if (room == nullptr) leave_without_memory();
  return room;
}

extern "C" void* reallocate_for_gmp(void* earlier, size_t, size_t size) {
  void* const room = std::realloc(earlier, size);
  if (room == nullptr) leave_without_memory();
  return room;
}

extern "C" void free_for_gmp(void* room, size_t) { std::free(room); }

void on_terminate() {
  try {
    if (std::current_exception() != nullptr) std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    leave_without_memory();
  } catch (...) {  // NOLINT(bugprone-empty-catch): a bug, with the core that abort() leaves
  }
  std::abort();
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

void leave_interrupted() { leave(Exit::interrupted, "interrupted"); }

void catch_lack_of_memory() {
  ::mp_set_memory_functions(allocate_for_gmp, reallocate_for_gmp, free_for_gmp);
  std::set_terminate(on_terminate);
}

bool is_interrupted() { return interrupted != 0; }

void stop_if_interrupted() {
  if (interrupted) throw Interrupted();
}

}  // namespace fusee::cli
