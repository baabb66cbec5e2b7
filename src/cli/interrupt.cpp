#include "cli/interrupt.h"

#include <semaphore.h>

#include <atomic>
#include <csignal>
#include <system_error>

#include "cli/immediate_exit.h"

// A signal handler may neither lock nor allocate, and removing files does both. So the handler wakes a thread that
// does.

namespace fusee::cli {
namespace {

// The only globals that a signal handler may access.
std::atomic<bool> interrupted = false;
std::atomic<bool> exit_prevented = false;
std::atomic<bool> has_watcher = false;
std::atomic<bool> watch_ended = false;
sem_t wake;
static_assert(std::atomic<bool>::is_always_lock_free);

void exit_unless_prevented() {
  if (!exit_prevented) exit_at_once(Exit::interrupted, "interrupted");
}

extern "C" void on_signal(int) {
  interrupted = true;
  if (has_watcher)
    ::sem_post(&wake);
  else
    exit_unless_prevented();
}

void catch_signals() {
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

void watch(const std::stop_source& source) {
  do {
    while (::sem_wait(&wake) != 0) {  // a signal interrupts the wait
    }
    if (!interrupted) continue;
    source.request_stop();
    exit_unless_prevented();
  } while (!watch_ended);
}

}  // namespace

SignalWatch::SignalWatch() {
  ::sem_init(&wake, 0, 0);
  catch_signals();
  try {
    thread_ = std::thread(watch, source_);
    has_watcher = true;
  } catch (const std::system_error&) {
    // No thread available: a signal exits at once, and the next run removes staged files.
  }
}

SignalWatch::~SignalWatch() {
  if (!thread_.joinable()) return;
  has_watcher = false;
  watch_ended = true;
  ::sem_post(&wake);
  thread_.join();
  if (interrupted) exit_unless_prevented();
}

void prevent_exit_by_signal() { exit_prevented = true; }

bool is_interrupted() { return interrupted; }

}  // namespace fusee::cli
