#include "radiosity/output/matrix_market.h"

#include "radiosity/output/file_writer.h"
#include "radiosity/output/number_text.h"

namespace hemicube::radiosity {
namespace {

/// The rows of one file: what row k of the matrix is called, and how many rows the file has.
struct RowNames {
  const PatchSet* patches = nullptr; ///< null: rows are points
  std::span<const std::uint32_t> rows;
  std::uint64_t file_rows = 0;

  std::uint64_t operator[](std::uint64_t k) const { return rows.empty() ? k : rows[k]; }
};

template <typename Visit> Status for_each_row(const FormFactorMatrix& matrix, Visit visit) {
  return matrix.for_each_range([&](std::size_t first, std::size_t last) {
    for (std::uint64_t k = matrix.block_begin(first); k < matrix.block_end(last - 1); ++k)
      visit(k, matrix.row(k));
    return Status();
  });
}

Status write_entries(FileSet* files, std::string_view name, const FormFactorMatrix& matrix,
                     const RowNames& names) {
  FileWriter writer;
  HC_TRY(writer.open(files->path_for(name), files->shown_path(name)));
  std::string& text = writer.text();
  text += "%%MatrixMarket matrix coordinate real general\n"
          "% Diffuse form factors, dimensionless. ";
  text += names.patches == nullptr
              ? "Row i, column j: the fraction of the light leaving a small\n"
                "% receiver at point i that arrives at patch j. Points and patches count from 1.\n"
              : "Row i, column j: F_ij, the fraction of the light leaving\n"
                "% patch i that arrives at patch j. Patches count from 1.\n";
  append_number(&text, names.file_rows);
  text += ' ';
  append_number(&text, matrix.column_count());
  text += ' ';
  append_number(&text, matrix.nonzero_count());
  text += '\n';
  HC_TRY(for_each_row(matrix, [&](std::uint64_t k, const RowView& row) {
    for (std::size_t e = 0; e < row.columns.size(); ++e) {
      append_number(&text, names[k] + 1);
      text += ' ';
      append_number(&text, std::uint64_t{row.columns[e]} + 1);
      text += ' ';
      append_number(&text, row.scale * static_cast<double>(row.values[e]));
      text += '\n';
      writer.flush_if_large();
    }
  }));
  return writer.close();
}

Status write_rows(FileSet* files, const std::string& name, const FormFactorMatrix& matrix,
                  const RowNames& names) {
  FileWriter writer;
  HC_TRY(writer.open(files->path_for(name), files->shown_path(name)));
  std::string& text = writer.text();
  text += names.patches == nullptr ? "point,row_sum,space,back_side\n"
                                   : "patch,area,row_sum,space,back_side\n";
  HC_TRY(for_each_row(matrix, [&](std::uint64_t k, const RowView& row) {
    append_number(&text, names[k]);
    if (names.patches != nullptr) {
      text += ',';
      append_number(&text, names.patches->area[names[k]]);
    }
    for (const double value : {row_sum(row), row.space, row.back_side}) {
      text += ',';
      append_number(&text, value);
    }
    text += '\n';
    writer.flush_if_large();
  }));
  return writer.close();
}

} // namespace

Status write_matrix_market(FileSet* files, std::string_view name, const FormFactorMatrix& matrix,
                           const PatchSet& patches, std::span<const std::uint32_t> rows) {
  HC_ASSERT(matrix.row_count() == (rows.empty() ? patches.patch_count() : rows.size()));
  const RowNames names{&patches, rows, patches.patch_count()};
  HC_TRY(write_entries(files, name, matrix, names));
  return write_rows(files, rows_file_name(name), matrix, names);
}

Status write_point_matrix_market(FileSet* files, std::string_view name,
                                 const FormFactorMatrix& matrix) {
  const RowNames names{nullptr, {}, matrix.row_count()};
  HC_TRY(write_entries(files, name, matrix, names));
  return write_rows(files, rows_file_name(name), matrix, names);
}

Status write_row_sums(FileSet* files, std::string_view name, const FormFactorMatrix& matrix,
                      const PatchSet& patches) {
  return write_rows(files, rows_file_name(name), matrix, {&patches, {}, patches.patch_count()});
}

std::string rows_file_name(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  const bool has_extension = dot != std::string_view::npos && dot != 0;
  return std::string(name.substr(0, has_extension ? dot : name.size())) + ".rows.csv";
}

} // namespace hemicube::radiosity
