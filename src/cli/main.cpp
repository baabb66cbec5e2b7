#include <malloc.h>

#include <algorithm>

#include "base/thread_pool.h"
#include "cli/console.h"
#include "cli/run.h"

namespace {

/// Keeps freed memory, large blocks included, for later allocations and for as many threads as run at once. Touching a
/// new page costs the system more time than filling it.
void keep_freed_memory() {
  constexpr int k_largest_kept_block = 32 << 20, k_most_kept = 128 << 20;  // bytes
  ::mallopt(M_ARENA_MAX, std::max(2, static_cast<int>(fusee::ThreadPool::available_threads())));
  ::mallopt(M_MMAP_THRESHOLD, k_largest_kept_block);
  ::mallopt(M_TRIM_THRESHOLD, k_most_kept);
}

}  // namespace

int main(int count, char** arguments) {
  keep_freed_memory();
  fusee::cli::make_streams_safe();
  return fusee::cli::run({arguments + (count > 0 ? 1 : 0), arguments + count});
}
