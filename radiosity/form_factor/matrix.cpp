#include "radiosity/form_factor/matrix.h"

#include "radiosity/form_factor/interleaved_sum.h"
#include "raster/hash.h"

#include <bit>
#include <cmath>

namespace hemicube::radiosity {
double row_dot(const RowView& row, const double* x, std::size_t stride, std::size_t first,
               std::size_t last) noexcept {
  const std::uint32_t* columns = row.columns.data();
  const float* values = row.values.data();
  return row.scale * interleaved_sum(first, last, [=](std::size_t k) {
           return static_cast<double>(values[k]) * x[columns[k] * stride];
         });
}

double row_sum(const RowView& row) noexcept {
  const float* values = row.values.data();
  return row.scale * interleaved_sum(0, row.values.size(),
                                     [=](std::size_t k) { return static_cast<double>(values[k]); });
}

void fit_scale(double share, RowView* row) noexcept {
  row->scale = 1;
  if (!(share > 0)) {
    row->columns = {};
    row->values = {};
  }
  const double sum = row_sum(*row);
  if (sum == 0)
    return;
  row->scale = share / sum;
  while (row_sum(*row) > share)
    row->scale *= 1 - 0x1p-53;
}

std::uint64_t hash_row(const RowView& row) noexcept {
  // Four chains side by side: one alone would be waited for.
  Hash chains[4];
  const std::size_t count = row.columns.size();
  for (std::size_t k = 0; k < count; ++k)
    chains[k % 4].add(std::uint64_t{row.columns[k]} << 32 |
                      std::bit_cast<std::uint32_t>(row.values[k]));
  Hash hash(count);
  for (const Hash& chain : chains)
    hash.add(chain.value());
  hash.add(row.scale);
  hash.add(row.space);
  hash.add(row.back_side);
  return hash.value();
}

Status FormFactorMatrix::init(std::uint64_t row_count, std::uint32_t column_count,
                              const RowStorage& storage) noexcept {
  column_count_ = column_count;
  nonzeros_ = 0;
  return rows_.init(row_count, storage);
}

Status FormFactorMatrix::adopt(std::uint64_t end, std::uint64_t* rest) noexcept {
  std::uint64_t rows = 0, nonzeros = 0;
  return rows_.adopt(
      end,
      [&](std::span<const std::byte> bytes) {
        if (!is_sound(bytes))
          return false;
        nonzeros += view(bytes).columns.size();
        // Only a whole block is taken.
        if (++rows % kBlockRows == 0 || rows == row_count()) {
          nonzeros_ += nonzeros;
          nonzeros = 0;
        }
        return true;
      },
      rest);
}

RowView FormFactorMatrix::view(std::span<const std::byte> bytes) noexcept {
  if (bytes.empty())
    return {};
  const RowHead& head = *reinterpret_cast<const RowHead*>(bytes.data());
  const auto* columns = reinterpret_cast<const std::uint32_t*>(bytes.data() + sizeof(RowHead));
  const auto nonzeros = static_cast<std::size_t>(head.nonzeros); // it is in memory
  return {{columns, nonzeros},
          {reinterpret_cast<const float*>(columns + nonzeros), nonzeros},
          head.scale,
          head.space,
          head.back_side};
}

/// What a file may hold, whoever wrote it: nothing that leads out of the arrays, or to light that
/// is no number.
bool FormFactorMatrix::is_sound(std::span<const std::byte> bytes) const noexcept {
  if (bytes.size() < sizeof(RowHead))
    return false;
  const std::uint64_t nonzeros = reinterpret_cast<const RowHead*>(bytes.data())->nonzeros;
  if (nonzeros != (bytes.size() - sizeof(RowHead)) / 8)
    return false;
  const RowView row = view(bytes);
  const auto is_share = [](double x) { return x >= 0 && x <= 1; };
  bool sound =
      row.scale >= 0 && std::isfinite(row.scale) && is_share(row.space) && is_share(row.back_side);
  for (std::size_t k = 0; k < nonzeros; ++k)
    sound = sound && row.columns[k] < column_count_ &&
            (k == 0 || row.columns[k - 1] < row.columns[k]) && row.values[k] >= 0 &&
            std::isfinite(row.values[k]);
  return sound && row_sum(row) <= 1 + 0x1p-40;
}

RowFacts FormFactorMatrix::facts(std::uint64_t index) const noexcept {
  const std::span<const std::byte> bytes = rows_.row(index);
  return bytes.empty() ? RowFacts() : reinterpret_cast<const RowHead*>(bytes.data())->facts;
}

Status FormFactorMatrix::read_row(std::uint64_t index, Buffer<std::byte>* scratch,
                                  RowView* row) const noexcept {
  std::span<const std::byte> bytes;
  HC_TRY(rows_.read_row(index, scratch, &bytes));
  *row = view(bytes);
  return {};
}

void FormFactorMatrix::swap(FormFactorMatrix& other) noexcept {
  rows_.swap(other.rows_);
  nonzeros_ = other.nonzeros_.exchange(nonzeros_);
  std::swap(column_count_, other.column_count_);
}

Status FormFactorMatrix::copy_rows(const FormFactorMatrix& from,
                                   std::span<const std::uint32_t> rows) noexcept {
  HC_TRY(init(rows.size(), from.column_count()));
  Buffer<std::byte> scratch;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    RowView row;
    HC_TRY(from.read_row(rows[k], &scratch, &row));
    HC_TRY(append_row(k / kBlockRows, row));
  }
  return {};
}

Status FormFactorMatrix::reserve_block(std::size_t index, std::size_t nonzeros) noexcept {
  return rows_.reserve(index, kBlockRows * sizeof(RowHead) + 8 * nonzeros);
}

std::span<float> FormFactorMatrix::values(std::uint64_t index) noexcept {
  const std::span<const float> values = view(rows_.row(index)).values;
  return {const_cast<float*>(values.data()), values.size()};
}

void FormFactorMatrix::set_shares(std::uint64_t index, double scale, double space,
                                  double back_side) noexcept {
  const std::span<std::byte> bytes = rows_.row(index);
  HC_ASSERT(!bytes.empty());
  RowHead& head = *reinterpret_cast<RowHead*>(bytes.data());
  head.scale = scale;
  head.space = space;
  head.back_side = back_side;
}

Status FormFactorMatrix::append_row(std::size_t block, const RowView& row,
                                    const RowFacts& facts) noexcept {
  const RowHead head{row.columns.size(), row.scale, row.space, row.back_side, facts};
  nonzeros_ += row.columns.size();
  return rows_.append(block, {std::as_bytes(std::span(&head, 1)), std::as_bytes(row.columns),
                              std::as_bytes(row.values)});
}

} // namespace hemicube::radiosity
