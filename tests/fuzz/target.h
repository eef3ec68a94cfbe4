#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

/// What fuzzers feed with bytes. Any bytes are a case.
namespace hemicube::test {

using Bytes = std::span<const std::uint8_t>;

/// What came of a case.
struct Verdict {
  std::string problem;     ///< what is wrong with what the product made of it; empty: nothing
  bool is_accepted = true; ///< false: it was refused, or is nothing that can be judged
};

struct FuzzTarget {
  std::string_view name;         ///< also that of its folder in corpus/
  Verdict (*judge)(Bytes bytes); ///< may throw what tests throw
  bool takes_files;       ///< a case is a file, like those in corpus/; else any bytes are one
  std::size_t most_bytes; ///< of a case: longer ones find nothing more
  int seeded_cases;       ///< in every run of the tests: less than half a second of them
};

std::span<const FuzzTarget> fuzz_targets();

// Files: refused with a message that begins with the file's name, or a sound scene and sound
// patches of it.
Verdict judge_obj(Bytes bytes);
Verdict judge_mtl(Bytes bytes);
Verdict judge_json(Bytes bytes);
Verdict judge_ply(Bytes bytes);
Verdict judge_off(Bytes bytes);
Verdict judge_stl(Bytes bytes);
Verdict judge_gltf(Bytes bytes);
Verdict judge_glb(Bytes bytes);
/// A file of form factors: refused, or rows that may be solved with.
Verdict judge_hcf(Bytes bytes);

// What is computed, against what must hold of it and independent ways to compute it.
Verdict judge_raster(Bytes bytes);
Verdict judge_exchange(Bytes bytes); ///< unoccluded form factors of two polygons
Verdict judge_union(Bytes bytes);    ///< coplanar patches joined to large convex polygons
Verdict judge_rungs(Bytes bytes);    ///< rows of small scenes on the rungs of the ladder
Verdict judge_light(Bytes bytes);    ///< balance and the three solvers

} // namespace hemicube::test
