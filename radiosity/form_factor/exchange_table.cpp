#include "radiosity/form_factor/exchange_table.h"

#include <cmath>

namespace hemicube::radiosity {
namespace {

/// What a row begins with in memory and in a file; its pairs follow.
struct RowHead {
  double area, back_side, back_side_error, space;
  std::uint64_t is_rendered;
  RowFacts facts;
};
static_assert(sizeof(PairExchange) == 24 && sizeof(RowHead) % 8 == 0,
              "files hold them as they are");

const RowHead& head_of(std::span<const std::byte> bytes) {
  return *reinterpret_cast<const RowHead*>(bytes.data());
}

ReceiverExchange view(std::span<const std::byte> bytes) {
  const RowHead& head = head_of(bytes);
  const std::span<const std::byte> rest = bytes.subspan(sizeof(RowHead));
  return {{reinterpret_cast<const PairExchange*>(rest.data()), rest.size() / sizeof(PairExchange)},
          head.area,
          head.back_side,
          head.back_side_error,
          head.is_rendered != 0,
          head.space};
}

bool is_sound(std::span<const std::byte> bytes, std::uint64_t row_count) {
  if (bytes.size() < sizeof(RowHead) || (bytes.size() - sizeof(RowHead)) % sizeof(PairExchange))
    return false;
  const ReceiverExchange row = view(bytes);
  const auto is_amount = [](double x) { return x >= 0 && std::isfinite(x); };
  bool sound = row.area > 0 && is_amount(row.area) && is_amount(row.back_side) &&
               is_amount(row.space) && is_amount(row.back_side_error);
  for (const PairExchange& pair : row.pairs)
    sound = sound && pair.patch < row_count && is_amount(pair.value) && pair.flags < 4;
  return sound;
}

} // namespace

Status ExchangeTable::init(std::uint32_t row_count, const RowStorage& storage) noexcept {
  others_.clear();
  other_offsets_.clear();
  RowStorage in_memory = storage;
  in_memory.most_bytes = RowStorage::kUnlimited;
  return rows_.init(row_count, in_memory);
}

Status ExchangeTable::adopt(std::uint64_t end, std::uint64_t* rest) noexcept {
  return rows_.adopt(
      end, [&](std::span<const std::byte> bytes) { return is_sound(bytes, rows_.row_count()); },
      rest);
}

Status ExchangeTable::append_row(std::size_t block, const ReceiverExchange& row,
                                 const RowFacts& facts) noexcept {
  const RowHead head{row.area,  row.back_side,   row.back_side_error,
                     row.space, row.is_rendered, facts};
  return rows_.append(block, {std::as_bytes(std::span(&head, 1)), std::as_bytes(row.pairs)});
}

ReceiverExchange ExchangeTable::row(std::uint32_t index) const noexcept {
  return view(rows_.row(index));
}

RowFacts ExchangeTable::facts(std::uint32_t index) const noexcept {
  return head_of(rows_.row(index)).facts;
}

Status ExchangeTable::transpose() noexcept {
  const auto row_count = static_cast<std::uint32_t>(rows_.row_count());
  HC_TRY(other_offsets_.resize(std::size_t{row_count} + 1));
  for (std::uint32_t i = 0; i < row_count; ++i)
    for (const PairExchange& pair : row(i).pairs)
      other_offsets_[pair.patch + 1] += pair.is_mutual() ? 1 : 0;
  for (std::uint32_t i = 0; i < row_count; ++i)
    other_offsets_[i + 1] += other_offsets_[i];
  HC_TRY(others_.resize(other_offsets_[row_count]));
  Buffer<std::size_t> next;
  HC_TRY(next.assign(other_offsets_.span()));
  for (std::uint32_t i = 0; i < row_count; ++i)
    for (PairExchange pair : row(i).pairs) {
      if (!pair.is_mutual())
        continue;
      const std::uint32_t other = pair.patch;
      pair.patch = i;
      others_[next[other]++] = pair;
    }
  return {};
}

} // namespace hemicube::radiosity
