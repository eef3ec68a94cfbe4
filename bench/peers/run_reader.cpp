#include "bench/peers/run_reader.h"

#include "tests/support/scenes_shared.h"

#include <bit>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace hemicube::bench {
namespace {

using raster::Item;

/// Where runs begin among `count` items, and their items. @return how many runs
using FindRuns = std::size_t (*)(const Item* items, std::int32_t count, std::int32_t* begins,
                                 Item* run_items);

std::size_t find_runs(const Item* items, std::int32_t count, std::int32_t* begins,
                      Item* run_items) {
  std::size_t runs = 0;
  for (std::int32_t x = 0; x < count; ++x) {
    // No branch: overwritten unless a run begins here.
    begins[runs] = x;
    run_items[runs] = items[x];
    runs += x == 0 || items[x] != items[x - 1] ? 1 : 0;
  }
  return runs;
}

#if defined(__x86_64__)
/// The same, 16 pixels at a time.
__attribute__((target("avx512f,avx512vl,avx512bw,avx512dq"))) std::size_t
find_runs_avx512(const Item* items, std::int32_t count, std::int32_t* begins, Item* run_items) {
  std::size_t runs = 0;
  __m512i at = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  for (std::int32_t x = 0; x < count; x += 16) {
    const __m512i here = _mm512_loadu_si512(items + x);
    std::uint32_t breaks = _mm512_cmpneq_epu32_mask(here, _mm512_loadu_si512(items + x - 1));
    if (x == 0)
      breaks |= 1;
    if (count - x < 16)
      breaks &= (1u << (count - x)) - 1;
    const auto mask = static_cast<__mmask16>(breaks);
    _mm512_storeu_si512(begins + runs, _mm512_maskz_compress_epi32(mask, at));
    _mm512_storeu_si512(run_items + runs, _mm512_maskz_compress_epi32(mask, here));
    runs += static_cast<std::size_t>(std::popcount(breaks));
    at = _mm512_add_epi32(at, _mm512_set1_epi32(16));
  }
  return runs;
}
#endif

FindRuns best_find_runs() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"))
    return find_runs_avx512;
#endif
  return find_runs;
}

} // namespace

void RunReader::prepare(std::uint32_t patch_count, std::uint32_t resolution) {
  test::require(delta_.init(resolution));
  const std::size_t pixels = std::size_t{3} * resolution * resolution;
  const std::size_t most_entries = pixels < patch_count ? pixels : patch_count;
  test::require(accumulator_.init(patch_count, most_entries));
  begins_.resize(resolution + 17);
  run_items_.resize(resolution + 17);
  columns_.resize(most_entries + 1);
  values_.resize(most_entries + 1);
}

void RunReader::add_row(raster::Face face, std::int32_t y, const Item* items) {
  static const FindRuns find = best_find_runs();
  const auto width = static_cast<std::int32_t>(delta_.resolution());
  const std::size_t runs = find(items, width, begins_.data(), run_items_.data());
  begins_[runs] = width;
  const std::uint64_t* sums =
      delta_.sums(face).data() + static_cast<std::size_t>(y) * delta_.resolution();
  std::uint64_t before = sums[0];
  for (std::size_t k = 0; k < runs; ++k) {
    const std::uint64_t after = sums[begins_[k + 1]];
    if (!raster::is_back_facing(run_items_[k])) // kNoItem has the flag, too
      accumulator_.add(run_items_[k], after - before);
    before = after;
  }
}

void RunReader::finish(double* dense, Hash* hash) {
  constexpr double kUnit = 0x1p-48;
  const std::size_t count = accumulator_.take(kUnit, columns_.data(), values_.data());
  for (std::size_t k = 0; k < count; ++k) {
    hash->add(columns_[k]);
    hash->add(values_[k]);
  }
  if (dense != nullptr)
    for (std::size_t k = 0; k < count; ++k)
      dense[columns_[k]] = static_cast<double>(values_[k]);
}

} // namespace hemicube::bench
