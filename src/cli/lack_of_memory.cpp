#include "cli/lack_of_memory.h"

#include <gmp.h>

#include <cstdlib>
#include <exception>
#include <new>

#include "cli/immediate_exit.h"

namespace fusee::cli {
namespace {

[[noreturn]] void exit_without_memory() { exit_at_once(Exit::cannot_write, k_no_memory); }

extern "C" void* allocate_for_gmp(size_t size) {
  void* const block = std::malloc(size);
  if (block == nullptr) exit_without_memory();
  return block;
}

extern "C" void* reallocate_for_gmp(void* earlier, size_t, size_t size) {
  void* const block = std::realloc(earlier, size);
  if (block == nullptr) exit_without_memory();
  return block;
}

extern "C" void free_for_gmp(void* block, size_t) { std::free(block); }

void on_terminate() {
  try {
    if (std::current_exception() != nullptr) std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    exit_without_memory();
  } catch (...) {  // NOLINT(bugprone-empty-catch): a bug, with the core that abort() leaves
  }
  std::abort();
}

}  // namespace

void catch_lack_of_memory() {
  ::mp_set_memory_functions(allocate_for_gmp, reallocate_for_gmp, free_for_gmp);
  std::set_terminate(on_terminate);
}

}  // namespace fusee::cli
