#include "raster/memory.h"

#include <cstdlib>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace hemicube {
namespace {

constexpr std::size_t kAlignment = 64;

void* allocate_aligned(std::size_t bytes) {
  if (bytes % kHugePage != 0)
    return std::aligned_alloc(kAlignment, (bytes + kAlignment - 1) / kAlignment * kAlignment);
  void* memory = std::aligned_alloc(kHugePage, bytes);
#if defined(__linux__)
  if (memory != nullptr)
    madvise(memory, bytes, MADV_HUGEPAGE); // a wish: what comes of it changes nothing but time
#endif
  return memory;
}

void release_aligned(void* memory, std::size_t) {
  std::free(memory);
}

constexpr Allocator kDefaultAllocator = {allocate_aligned, release_aligned};

Allocator g_allocator = kDefaultAllocator;
AssertHandler g_assert_handler = nullptr;
LogHandler g_log_handler = nullptr;

} // namespace

void set_allocator(const Allocator& allocator) noexcept {
  g_allocator = allocator;
}
Allocator default_allocator() noexcept {
  return kDefaultAllocator;
}
void set_assert_handler(AssertHandler handler) noexcept {
  g_assert_handler = handler;
}
void set_log_handler(LogHandler handler) noexcept {
  g_log_handler = handler;
}

void log_message(const char* message) noexcept {
  if (g_log_handler != nullptr)
    g_log_handler(message);
}

void assertion_failed(const char* expression, const char* file, int line) noexcept {
  if (g_assert_handler == nullptr)
    __builtin_trap();
  g_assert_handler(expression, file, line);
}

namespace detail {

void* allocate(std::size_t bytes) noexcept {
  return bytes == 0 ? nullptr : g_allocator.allocate(bytes);
}

void release(void* memory, std::size_t bytes) noexcept {
  if (memory != nullptr)
    g_allocator.release(memory, bytes);
}

} // namespace detail
} // namespace hemicube
