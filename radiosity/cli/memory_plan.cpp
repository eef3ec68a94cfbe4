#include "radiosity/cli/memory_plan.h"

#include "radiosity/cli/console.h"

#include <algorithm>
#include <unistd.h>

namespace hemicube::radiosity::cli {
namespace {

// Measured: peak memory of solves of 9,000 to 262,000 patches less their rows (bench/growth).
constexpr std::uint64_t kProgram = 12 << 20, kThread = 2 << 20, kPatch = 1300, kPatchBand = 150;
/// Rows take more than their bytes while they grow.
constexpr double kRowOverhead = 1.12;
/// What a walk through rows in a file cannot do without.
constexpr std::uint64_t kLeastRows = 4 << 20;

std::uint64_t machine_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0
             ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(size)
             : std::uint64_t{4} << 30;
}

} // namespace

std::uint64_t other_memory(std::uint64_t patches, std::uint32_t bands, std::uint64_t threads) {
  return kProgram + threads * kThread + patches * (kPatch + bands * kPatchBand);
}

Status plan_memory(std::uint64_t budget, std::uint64_t patches, std::uint32_t bands,
                   std::uint64_t threads, MemoryPlan* plan) {
  const std::uint64_t other = other_memory(patches, bands, threads), least = other + kLeastRows;
  const std::uint64_t most = budget != 0 ? budget : machine_memory() / 4 * 3;
  if (most < least)
    return Status::error(StatusCode::kOutOfMemory, budget != 0 ? "--memory " : "of this machine, ",
                         memory_text(static_cast<double>(most)), budget != 0 ? "" : " may be used",
                         ": ", patches, " patches need about ",
                         memory_text(static_cast<double>(least)),
                         " besides what is kept in files: allow more, or use a coarser mesh");
  plan->most_rows = static_cast<std::uint64_t>(static_cast<double>(most - other) / kRowOverhead);
  plan->row_range = std::min(RowStorage::kRangeBytes, plan->most_rows / 2);
  return {};
}

} // namespace hemicube::radiosity::cli
