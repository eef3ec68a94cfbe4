#include "radiosity/form_factor/matrix_file.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace hemicube::radiosity {
namespace {

static_assert(std::endian::native == std::endian::little, "files hold numbers little-endian");

/// Of all 8-byte words of an object but the last.
template <typename T> std::uint64_t checksum(const T& object) {
  static_assert(sizeof(T) % 8 == 0);
  std::uint64_t words[sizeof(T) / 8];
  std::memcpy(words, &object, sizeof(T));
  Hash hash(sizeof(T));
  for (std::size_t k = 0; k + 1 < sizeof(T) / 8; ++k)
    hash.add(words[k]);
  return hash.value();
}

template <typename T> std::span<std::byte> bytes_of(T* object) {
  return std::as_writable_bytes(std::span(object, 1));
}

bool is_sound(const MatrixFileHead& head) {
  return head.magic == MatrixFileHead().magic && head.checksum == checksum(head);
}

/// What a finished .hcf ends with.
struct FileEnd {
  static constexpr std::uint64_t kMagic = 0x0a646e6566636820; ///< " hcfend", a line feed

  std::uint64_t magic, begin, checksum; ///< begin: offset of this in the file
};

FileEnd end_at(std::uint64_t begin) {
  FileEnd end{FileEnd::kMagic, begin, 0};
  end.checksum = checksum(end);
  return end;
}

Status damaged(const ByteFile& file, std::uint64_t offset, const char* what) {
  return Status::error(StatusCode::kBadScene, file.name(), ": is damaged at byte ", offset, " of ",
                       file.size(), ": ", what,
                       "; delete it, and its form factors are computed "
                       "again");
}

} // namespace

void MatrixFileHead::seal() noexcept {
  checksum = radiosity::checksum(*this);
}

RungSetting MatrixFileHead::setting() const noexcept {
  return {static_cast<Rung>(rung), resolution, target};
}

void hash_corners(const PatchSet& patches, std::uint32_t patch, Hash* hash) noexcept {
  const auto corners = patches.corners_of(patch);
  hash->add(static_cast<std::uint64_t>(corners.size()));
  for (const std::uint32_t corner : corners) {
    const Vec3& v = patches.vertices[corner];
    hash->add(v.x);
    hash->add(v.y);
    hash->add(v.z);
  }
}

std::uint64_t hash_geometry(const PatchSet& patches) noexcept {
  Hash hash(patches.patch_count());
  for (std::uint32_t i = 0; i < patches.patch_count(); ++i)
    hash_corners(patches, i, &hash);
  return hash.value();
}

Status read_head(ByteFile& file, MatrixFileHead* head, bool* sound) noexcept {
  *sound = false;
  if (file.size() < sizeof(MatrixFileHead))
    return {};
  HC_TRY(file.read(0, bytes_of(head)));
  *sound = is_sound(*head) && head->format == MatrixFileHead().format &&
           head->rung <= static_cast<std::uint32_t>(Rung::kExact) && head->resolution <= 0xffff &&
           head->target > 0 && std::isfinite(head->target) &&
           head->rounds <= MatrixFileHead::kMostRounds;
  return {};
}

Status open_to_append(ByteFile& file, const MatrixFileHead& head, RowStorage* storage) noexcept {
  storage->file = &file;
  storage->begin = sizeof(MatrixFileHead);
  MatrixFileHead sealed = head, found;
  sealed.seal();
  bool sound = false;
  HC_TRY(read_head(file, &found, &sound));
  // Bit for bit: NOLINTNEXTLINE(bugprone-suspicious-memory-comparison,cert-exp42-c,cert-flp37-c)
  if (sound && std::memcmp(&found, &sealed, sizeof(found)) == 0)
    return {};
  HC_TRY(file.truncate(0));
  return file.append(bytes_of(&sealed));
}

Status finish_file(FormFactorMatrix* matrix) noexcept {
  HC_TRY(matrix->flush());
  ByteFile& file = *matrix->storage().file;
  FileEnd end = end_at(file.size());
  return file.append(bytes_of(&end));
}

Status open_finished(const RowStorage& storage, const PatchSet& patches, FormFactorMatrix* matrix,
                     MatrixFileHead* head) noexcept {
  ByteFile& file = *storage.file;
  bool sound = false;
  HC_TRY(read_head(file, head, &sound));
  if (!sound) {
    if (file.size() >= sizeof(MatrixFileHead) && head->magic == MatrixFileHead().magic &&
        head->format != MatrixFileHead().format && is_sound(*head))
      return Status::error(StatusCode::kBadScene, file.name(), ": is of format ", head->format,
                           ", this program reads format ", MatrixFileHead().format);
    return Status::error(StatusCode::kBadScene, file.name(), ": is not a file of form factors (",
                         file.size(), " bytes), or its beginning is damaged");
  }
  if (head->part != MatrixFileHead::Part::kRows)
    return Status::error(StatusCode::kBadScene, file.name(),
                         ": holds part of a run, not form factors");
  if (head->geometry != hash_geometry(patches) || head->row_count != patches.patch_count() ||
      head->column_count != patches.patch_count())
    return Status::error(StatusCode::kBadScene, file.name(), ": holds the form factors of ",
                         head->row_count, " patches of another mesh than this scene's: give the ",
                         "scene and the --max-edge it was computed with, or compute it again");
  if (file.size() < sizeof(MatrixFileHead) + sizeof(FileEnd))
    return damaged(file, file.size(), "it is cut off");
  FileEnd end;
  const std::uint64_t rows_end = file.size() - sizeof(end);
  HC_TRY(file.read(rows_end, bytes_of(&end)));
  const FileEnd expected = end_at(rows_end);
  const bool is_whole = std::memcmp(&end, &expected, sizeof(end)) == 0;
  RowStorage rows = storage;
  rows.begin = sizeof(MatrixFileHead);
  HC_TRY(matrix->init(patches.patch_count(), patches.patch_count(), rows));
  std::uint64_t rest = 0;
  HC_TRY(matrix->adopt(is_whole ? rows_end : file.size(), &rest));
  if (is_whole && rest == rows_end &&
      (matrix->block_count() == 0 || matrix->is_finished(matrix->block_count() - 1)))
    return {};
  return damaged(file, rest, is_whole ? "what follows are no sound rows" : "it is cut off");
}

} // namespace hemicube::radiosity
