#include <malloc.h>

#include <algorithm>
#include <thread>

#include "cli/console.h"
#include "cli/run.h"

namespace {

/// A page that is touched for the first time takes the system longer than filling it takes us. What is freed is kept
/// for what comes next: large blocks too, which would be mapped anew each time, and by as many threads as run at once.
/// A build begins some fifty, one after another, each of which would have pages of its own.
void keep_what_is_freed() {
  constexpr int k_largest_kept = 32 << 20, k_most_kept = 128 << 20;
  ::mallopt(M_ARENA_MAX, std::max(2, static_cast<int>(std::thread::hardware_concurrency())));
  ::mallopt(M_MMAP_THRESHOLD, k_largest_kept);
  ::mallopt(M_TRIM_THRESHOLD, k_most_kept);
}

}  // namespace

int main(int count, char** arguments) {
  keep_what_is_freed();
  fusee::cli::make_streams_safe();
  return fusee::cli::run({arguments + (count > 0 ? 1 : 0), arguments + count});
}
