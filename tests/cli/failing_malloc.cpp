// Preloaded into the program: requests for memory fail from the FAIL_FROM-th on, once main has
// begun.

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

#include <dlfcn.h>

namespace {

std::atomic<long> left{-1}; ///< requests until they fail; < 0: they do not

bool fails() {
  if (left < 0 || (left > 0 && left.fetch_sub(1) > 0))
    return false;
  errno = ENOMEM;
  return true;
}

using Main = int (*)(int, char**, char**);
using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
Main program;

int counted_main(int argc, char** argv, char** variables) {
  if (const char* from = std::getenv("FAIL_FROM"))
    left = std::atol(from);
  const int status = program(argc, argv, variables);
  left = -1;
  return status;
}

} // namespace

// What glibc calls its own, under the names that programs call.
extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) noexcept {
  return fails() ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  return fails() ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  return fails() ? nullptr : __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return fails() ? nullptr : __libc_memalign(alignment, size);
}

[[gnu::visibility("default")]] int __libc_start_main(Main main, int argc, char** argv,
                                                     void (*init)(), void (*fini)(), void (*end)(),
                                                     void* stack) {
  program = main;
  const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(counted_main, argc, argv, init, fini, end, stack);
}
}
