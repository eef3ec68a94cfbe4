#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/form_factor/rung.h"
#include "radiosity/mesh/patch_set.h"
#include "raster/hash.h"

namespace hemicube::radiosity {

/// To be raised with every change of results (where the golden hashes change): rows of two versions
/// must not meet in one file.
inline constexpr std::uint32_t kResultsVersion = 3;

/// What a file of rows begins with: what it is, and all that decides what its rows are. Numbers are
/// little-endian; what follows are the blocks of a RowStore and, in a finished .hcf, its end.
struct MatrixFileHead {
  enum class Part : std::uint32_t { kRows = 1, kPairs = 2, kBlackRows = 3 };
  static constexpr std::size_t kMostRounds = 8;

  std::uint64_t magic = 0x0a1a666368636820; ///< " hchcf", the end of a text, a line feed
  std::uint32_t format = 1;                 ///< raised when this layout changes
  std::uint32_t results = kResultsVersion;
  Part part = Part::kRows;
  std::uint32_t rung = 0;       ///< number of a Rung
  std::uint32_t resolution = 0; ///< pixels along the hemicube's edge
  std::uint32_t rounds = 0;     ///< how often a finer setting was chosen because of the error found
  double target = 0;            ///< RungSetting::target
  double found[kMostRounds] = {}; ///< the errors found, by round
  std::uint64_t row_count = 0, column_count = 0;
  std::uint64_t geometry = 0; ///< hash_geometry
  std::uint64_t request =
      0; ///< hash of what else decides the rows: options, what was to be chosen by
  std::uint64_t checksum = 0; ///< of all before

  /// Fills the checksum.
  void seal() noexcept;
  RungSetting setting() const noexcept;
};
static_assert(sizeof(MatrixFileHead) == 144);

/// Adds the corners of a patch to a hash.
void hash_corners(const PatchSet& patches, std::uint32_t patch, Hash* hash) noexcept;

/// Hash of the mesh alone: positions and order of all corners, no materials.
std::uint64_t hash_geometry(const PatchSet& patches) noexcept;

/// Reads what a file begins with.
/// @param is_sound  false: it is not a file of rows, or its head is damaged
Status read_head(ByteFile& file, MatrixFileHead* head, bool* is_sound) noexcept;

/// Prepares a file that goes on with what it holds, if it holds rows of exactly this kind, and else
/// is emptied and begun.
/// @param storage  its file and begin are filled
Status open_to_append(ByteFile& file, const MatrixFileHead& head, RowStorage* storage) noexcept;

/// Makes the file of a matrix whose rows are all there a finished .hcf.
Status finish_file(FormFactorMatrix* matrix) noexcept;

/// Reads a finished .hcf into a matrix.
/// @param patches  the mesh it must be of
/// @param storage  its file is the one to read
/// @return kBadScene (no such file, of another mesh, not finished, damaged: says where), kIo,
///         kOutOfMemory
Status open_finished(const RowStorage& storage, const PatchSet& patches, FormFactorMatrix* matrix,
                     MatrixFileHead* head) noexcept;

} // namespace hemicube::radiosity
