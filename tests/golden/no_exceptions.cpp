// What libc++abi for WASI does without: there is nothing to throw with, so a throw ends the
// program.
#include <cstddef>
#include <cstdlib>

extern "C" {

void* __cxa_allocate_exception(std::size_t) noexcept;
[[noreturn]] void __cxa_throw(void*, void*, void (*)(void*));

void* __cxa_allocate_exception(std::size_t) noexcept {
  std::abort();
}

void __cxa_throw(void*, void*, void (*)(void*)) {
  std::abort();
}
}
