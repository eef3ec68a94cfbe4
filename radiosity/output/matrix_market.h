#pragma once

#include "radiosity/form_factor/matrix.h"
#include "radiosity/mesh/patch_set.h"
#include "radiosity/output/file_set.h"

#include <span>
#include <string>
#include <string_view>

namespace hemicube::radiosity {

/// Writes form factors in Matrix Market's coordinate format: row i, column j, both from 1, holds
/// F_ij, entries by row and ascending column, numbers in round-trip digits. Beside FILE.mtx goes
/// FILE.rows.csv with the columns patch,area,row_sum,space,back_side (patch from 0).
/// @param rows  row k of the matrix belongs to patch rows[k]; empty = all patches in order. The
/// file is
///              n x n either way; rows.csv lists the rows that are there.
/// @return kIo
Status write_matrix_market(FileSet* files, std::string_view name, const FormFactorMatrix& matrix,
                           const PatchSet& patches, std::span<const std::uint32_t> rows);

/// The same for the form factors of points: points x patches, and point,row_sum,space,back_side.
Status write_point_matrix_market(FileSet* files, std::string_view name,
                                 const FormFactorMatrix& matrix);

/// FILE.rows.csv alone, for a matrix of all patches that is in a file already.
Status write_row_sums(FileSet* files, std::string_view name, const FormFactorMatrix& matrix,
                      const PatchSet& patches);

/// `F.rows.csv` for `F.mtx`.
std::string rows_file_name(std::string_view name);

} // namespace hemicube::radiosity
