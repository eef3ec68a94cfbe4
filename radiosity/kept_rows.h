#pragma once

#include "radiosity/form_factor/matrix_file.h"
#include "radiosity/radiosity.h"

namespace hemicube::radiosity {

/// The rows of a run in its files (RunFiles): begins them, or goes on with what a run of the same
/// mesh and the same options left there.
class KeptRows {
public:
  using Part = MatrixFileHead::Part;

  /// @param request  hash of what decides the rows besides the mesh and the options
  void init(const PatchSet& patches, const Options& options, std::uint64_t request) noexcept;

  /// The errors for which earlier runs chose finer settings, by round; empty if there was none.
  Status past_rounds(Buffer<double>* found) const noexcept;

  /// How rows are computed from now on. @param found  see past_rounds; what led to the setting
  void begin_round(const RungSetting& setting, std::span<const double> found) noexcept;

  /// Where a part is kept: in its file from the rows on that are there, if it has one.
  Status open(Part part, RowStorage* storage) noexcept;

  /// Makes a matrix of all patches that begins with the rows kept.
  /// @param first  receives the first row that is missing
  Status begin_matrix(Part part, FormFactorMatrix* matrix, std::uint64_t* first) noexcept;

  /// To be called when all rows of the matrix are there: makes a finished .hcf of its file, if that
  /// is to hold all.
  Status finish(FormFactorMatrix* matrix) noexcept;

  /// Reads the finished rows that were given. @param setting  receives how they were computed
  Status read_given(FormFactorMatrix* matrix, RungSetting* setting) noexcept;

  bool are_given() const noexcept { return files_ != nullptr && files_->rows_are_given; }
  bool hold_black_rows() const noexcept { return files_ != nullptr && files_->keeps_black_rows; }
  void report(std::uint64_t rows_resumed) const noexcept;

private:
  ByteFile* file(Part part) const noexcept;

  const PatchSet* patches_ = nullptr;
  const Options* options_ = nullptr;
  RunFiles* files_ = nullptr;
  MatrixFileHead head_;
};

} // namespace hemicube::radiosity
