// What Debian's builtins for wasm32, compiled with a guard of the stack, want of a C library;
// wasi-libc has it not.
#include <cstdint>
#include <cstdlib>

extern "C" {
std::uintptr_t __stack_chk_guard = 0x2d358dcc;
[[noreturn]] void __stack_chk_fail() {
  std::abort();
}
}
