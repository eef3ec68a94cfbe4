// Bytes as a file of form factors. What only a forger would write is reached by making the
// checksums right before the file is read.

#include "radiosity/form_factor/matrix_file.h"
#include "tests/fuzz/target.h"
#include "tests/support/memory_file.h"
#include "tests/support/scenes_shared.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace hemicube::test {
namespace {

using radiosity::FormFactorMatrix;
using radiosity::MatrixFileHead;
using radiosity::RowStorage;
using radiosity::RowStore;

constexpr std::size_t kHead = sizeof(MatrixFileHead), kEnd = 24;

const PatchSet& mesh() {
  static const PatchSet patches = patches_of(box_enclosure({1, 1, 1}, 1, 1, 2, 0.5, 1));
  return patches; // 10 patches: two blocks of rows
}

std::uint64_t word(const std::vector<std::byte>& bytes, std::size_t offset) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + offset, 8);
  return value;
}
void set_word(std::vector<std::byte>* bytes, std::size_t offset, std::uint64_t value) {
  std::memcpy(bytes->data() + offset, &value, 8);
}

/// Of a block of rows: radiosity/README.md.
std::uint64_t block_checksum(const std::vector<std::byte>& bytes, std::size_t begin,
                             std::size_t size) {
  Hash chains[4] = {Hash(0), Hash(1), Hash(2), Hash(3)};
  for (std::size_t k = 1; k < size / 8; ++k)
    chains[k % 4].add(word(bytes, begin + 8 * k));
  Hash hash(size / 8);
  for (const Hash& chain : chains)
    hash.add(chain.value());
  return hash.value();
}

/// Makes a file of this mesh of any bytes, as far as its blocks tell where they end.
void forge(std::vector<std::byte>* bytes) {
  bytes->resize(std::max(bytes->size() / 8 * 8, kHead + kEnd));
  MatrixFileHead head;
  std::memcpy(&head, bytes->data(), kHead);
  head.magic = MatrixFileHead().magic;
  head.format = MatrixFileHead().format;
  head.part = MatrixFileHead::Part::kRows;
  head.row_count = head.column_count = mesh().patch_count();
  head.geometry = radiosity::hash_geometry(mesh());
  head.seal();
  std::memcpy(bytes->data(), &head, kHead);
  const std::size_t end = bytes->size() - kEnd;
  for (std::size_t at = kHead; at + 16 <= end;) {
    const std::uint64_t size = word(*bytes, at + 8);
    if (size < 16 || size % 8 != 0 || size > end - at)
      break;
    set_word(bytes, at, block_checksum(*bytes, at, static_cast<std::size_t>(size)));
    at += static_cast<std::size_t>(size);
  }
  set_word(bytes, end, 0x0a646e6566636820); // " hcfend"
  set_word(bytes, end + 8, end);
  Hash hash(kEnd);
  hash.add(word(*bytes, end));
  hash.add(word(*bytes, end + 8));
  set_word(bytes, end + 16, hash.value());
}

std::string row_problem(const radiosity::RowView& row) {
  double sum = 0;
  for (std::size_t k = 0; k < row.columns.size(); ++k) {
    if (row.columns[k] >= mesh().patch_count() || (k > 0 && row.columns[k - 1] >= row.columns[k]))
      return "columns";
    const double value = row.scale * static_cast<double>(row.values[k]);
    if (!(value >= 0 && value <= 2))
      return "a value of " + std::to_string(value);
    sum += value;
  }
  if (!(row.space >= 0 && row.space <= 1 && row.back_side >= 0 && row.back_side <= 1))
    return "shares";
  return sum <= 1 + 1e-9 ? "" : "a sum of " + std::to_string(sum);
}

std::string rows_problem(const FormFactorMatrix& matrix, std::size_t blocks) {
  std::string problem;
  const Status walked = matrix.for_each_range(0, blocks, [&](std::size_t first, std::size_t last) {
    for (std::uint64_t i = matrix.block_begin(first); i < matrix.block_end(last - 1); ++i)
      if (problem.empty())
        problem = row_problem(matrix.row(i));
    return Status();
  });
  return walked.ok() ? problem : std::string(walked.message());
}

Verdict judge_opened(MemoryFile* file, std::uint64_t most_bytes) {
  FormFactorMatrix matrix;
  MatrixFileHead head;
  const Status opened = radiosity::open_finished({file, 0, most_bytes, 1}, mesh(), &matrix, &head);
  if (opened.ok())
    return {rows_problem(matrix, matrix.block_count())};
  return {opened.code() == StatusCode::kBadScene && opened.message().starts_with("memory.hcf: ")
              ? ""
              : "message: " + std::string(opened.message()),
          false};
}

/// A run that goes on with what is sound of the file.
std::string resumed_problem(MemoryFile* file) {
  MatrixFileHead head;
  bool is_sound = false;
  require(radiosity::read_head(*file, &head, &is_sound));
  if (!is_sound)
    return "";
  RowStorage storage;
  require(radiosity::open_to_append(*file, head, &storage));
  FormFactorMatrix matrix;
  const std::uint32_t count = mesh().patch_count();
  require(matrix.init(count, count, storage));
  std::uint64_t rest = 0;
  require(matrix.adopt(file->size(), &rest));
  if (rest < storage.begin || rest > file->size())
    return "rows end at " + std::to_string(rest);
  std::size_t blocks = 0;
  while (blocks < matrix.block_count() && matrix.is_finished(blocks))
    ++blocks;
  return rows_problem(matrix, blocks);
}

} // namespace

/// The first byte: whether the file is forged.
Verdict judge_hcf(Bytes bytes) {
  MemoryFile file;
  if (!bytes.empty())
    for (const std::uint8_t byte : bytes.subspan(1))
      file.bytes.push_back(std::byte{byte});
  if (!bytes.empty() && bytes[0] % 2 == 1)
    forge(&file.bytes);
  Verdict verdict;
  for (const std::uint64_t most : {RowStorage::kUnlimited, std::uint64_t{1}})
    if (verdict.problem.empty())
      verdict = judge_opened(&file, most);
  if (verdict.problem.empty())
    verdict.problem = resumed_problem(&file);
  return verdict;
}

} // namespace hemicube::test
