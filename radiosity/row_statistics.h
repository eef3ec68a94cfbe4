#pragma once

#include "radiosity/form_factor/ladder_row.h"
#include "radiosity/output/certificate.h"

namespace hemicube::radiosity {

/// What the certificate says about rows, gathered while they are built: one entry per row, written
/// by one worker.
class RowStatistics {
public:
  Status init(std::uint64_t rows, bool hash_items);

  void record(std::uint64_t index, const RowView& row, const RowFacts& facts);

  /// The first rows of a matrix, by how they came about.
  Status record_rows(const FormFactorMatrix& matrix, std::uint64_t count);

  /// A row that was recorded and is now another.
  void replace(std::uint64_t index, const RowView& row);

  /// NaN where no row was built.
  double sum(std::uint64_t index) const { return rows_[index].sum; }
  double space(std::uint64_t index) const { return rows_[index].space; }
  double back_side(std::uint64_t index) const { return rows_[index].back_side; }

  double doubt(std::uint64_t index) const { return rows_[index].facts.doubt; }

  void summarise(Certificate* certificate) const;

private:
  struct Entry {
    double sum; ///< NaN: no row was built
    double space, back_side;
    std::uint64_t hash;
    RowFacts facts;
    std::uint64_t nonzeros;
  };

  Buffer<Entry> rows_;
  bool hash_items_ = false;
};

} // namespace hemicube::radiosity
