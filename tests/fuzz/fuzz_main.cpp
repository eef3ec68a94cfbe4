// libFuzzer's side of all targets: HEMICUBE_FUZZ_TARGET names the one that is fed. What is wrong
// with a case stops the program.

#include "raster/memory.h"
#include "tests/fuzz/target.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

using hemicube::test::FuzzTarget;

const FuzzTarget* target = nullptr;

std::string problem_of(hemicube::test::Bytes bytes) {
  try {
    return target->judge(bytes).problem;
  } catch (const std::exception& thrown) {
    return std::string("thrown: ") + thrown.what();
  }
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* name = std::getenv("HEMICUBE_FUZZ_TARGET");
  for (const FuzzTarget& one : hemicube::test::fuzz_targets())
    if (name != nullptr && one.name == name)
      target = &one;
  if (target == nullptr) {
    std::fprintf(stderr, "HEMICUBE_FUZZ_TARGET must be one of");
    for (const FuzzTarget& one : hemicube::test::fuzz_targets())
      std::fprintf(stderr, " %.*s", static_cast<int>(one.name.size()), one.name.data());
    std::fprintf(stderr, "\n");
    std::exit(2);
  }
  // Without the huge pages of the default, which cost more than a small case.
  hemicube::set_allocator(
      {[](std::size_t bytes) { return std::aligned_alloc(64, (bytes + 63) / 64 * 64); },
       [](void* memory, std::size_t) { std::free(memory); }});
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string problem =
      problem_of({data, size < target->most_bytes ? size : target->most_bytes});
  if (problem.empty())
    return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}
