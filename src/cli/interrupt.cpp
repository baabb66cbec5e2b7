#include "cli/interrupt.h"

#include <csignal>
#include <exception>

#include "cli/immediate_exit.h"

namespace fusee::cli {
namespace {

// The only globals that a signal handler may access.
volatile std::sig_atomic_t interrupted = 0;
volatile std::sig_atomic_t is_deferred = 0;

extern "C" void on_signal(int) {
  interrupted = 1;
  if (!is_deferred) leave_interrupted();
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  // Under nohup, hang-ups stay ignored.
  struct sigaction before = {};
  ::sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
}

InterruptsDeferred::InterruptsDeferred() { is_deferred = 1; }
InterruptsDeferred::~InterruptsDeferred() {
  if (std::uncaught_exceptions() > 0) is_deferred = 0;
}

void leave_interrupted() { exit_at_once(Exit::interrupted, "interrupted"); }

bool is_interrupted() { return interrupted != 0; }

void stop_if_interrupted() {
  if (interrupted) throw Interrupted();
}

}  // namespace fusee::cli
