#include "radiosity/output/row_file.h"

#include "radiosity/output/file_writer.h"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hemicube::radiosity {
namespace {

/// Runs shorter than this leave no file; nor does a kill lose more.
constexpr std::chrono::seconds kUntilFirst{3}, kBetween{1};
constexpr std::uint64_t kMostWaiting = 512;

} // namespace

Status RowFile::failed(const char* what, int error) const noexcept {
  return Status::error(
      StatusCode::kIo, std::string_view(path_), ": ", what, ": ", errno_text(error),
      error == ENOSPC || error == EDQUOT || error == EFBIG ? "; make room and run again" : "");
}

Status RowFile::in_use() const noexcept {
  return Status::error(StatusCode::kIo, std::string_view(path_),
                       ": is in use by another run: wait for it, or choose another output");
}

Status RowFile::open(const std::string& path) {
  path_ = path;
  while (true) {
    descriptor_ = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (descriptor_ < 0 && errno == ENOENT)
      return {};
    if (descriptor_ < 0)
      return failed("cannot be opened", errno);
    struct stat opened = {}, named = {};
    if (::fstat(descriptor_, &opened) != 0)
      return failed("cannot be read", errno);
    if (!S_ISREG(opened.st_mode))
      return Status::error(StatusCode::kIo, std::string_view(path_), ": is not a regular file");
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      return in_use();
    // Another run may have finished with it in between: then the name is of another file by now.
    if (::stat(path.c_str(), &named) == 0 && named.st_ino == opened.st_ino &&
        named.st_dev == opened.st_dev) {
      size_ = static_cast<std::uint64_t>(opened.st_size);
      return {};
    }
    close();
  }
}

Status RowFile::open_to_read(const std::string& path) {
  path_ = path;
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor_ < 0)
    return failed("cannot be opened", errno);
  struct stat opened = {};
  if (::fstat(descriptor_, &opened) != 0)
    return failed("cannot be read", errno);
  if (!S_ISREG(opened.st_mode))
    return Status::error(StatusCode::kIo, std::string_view(path_), ": is not a regular file");
  size_ = static_cast<std::uint64_t>(opened.st_size);
  return {};
}

void RowFile::use_temporary() {
  is_temporary_ = true;
  std::error_code error;
  path_ = (std::filesystem::temp_directory_path(error) / "hemicube-rows").string();
}

Status RowFile::make() noexcept {
  if (is_temporary_) {
    constexpr char kEnd[] = "-XXXXXX"; // and a NUL
    Buffer<char> name;
    HC_TRY(name.append(path_));
    HC_TRY(name.append(kEnd));
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0)
      return failed("cannot be made", errno);
    ::unlink(name.data());
  } else {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST)
      return failed("cannot be made", errno);
    if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
      return in_use();
  }
  return write(0, waiting_.span());
}

Status RowFile::write(std::uint64_t offset, std::span<const std::byte> bytes) noexcept {
  std::uint64_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done,
                                     static_cast<off_t>(offset + done));
    if (written < 0 && errno == EINTR)
      continue;
    if (written <= 0) {
      const int error = written < 0 ? errno : ENOSPC;
      static_cast<void>(::ftruncate(descriptor_, static_cast<off_t>(offset)));
      return failed("cannot be written", error);
    }
    done += static_cast<std::uint64_t>(written);
  }
  return {};
}

Status RowFile::append(std::span<const std::byte> bytes) noexcept {
  if (descriptor_ < 0 && size_ + bytes.size() <= kMostWaiting)
    HC_TRY(waiting_.append(bytes));
  else {
    if (descriptor_ < 0)
      HC_TRY(make());
    HC_TRY(write(size_, bytes));
  }
  size_ += bytes.size();
  return {};
}

Status RowFile::read(std::uint64_t offset, std::span<std::byte> into) noexcept {
  if (descriptor_ < 0)
    HC_TRY(make());
  std::uint64_t done = 0;
  while (done < into.size()) {
    const ssize_t got = ::pread(descriptor_, into.data() + done, into.size() - done,
                                static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      return failed("cannot be read", errno);
    if (got == 0)
      return Status::error(StatusCode::kIo, std::string_view(path_), ": ends at byte ",
                           offset + done, ", more was expected: it was cut off while in use");
    done += static_cast<std::uint64_t>(got);
  }
  return {};
}

Status RowFile::truncate(std::uint64_t size) noexcept {
  if (size >= size_)
    return {};
  if (descriptor_ < 0)
    HC_TRY(waiting_.resize(size));
  else if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0)
    return failed("cannot be shortened", errno);
  size_ = size;
  return {};
}

void RowFile::expect(std::uint64_t offset, std::uint64_t size) noexcept {
  static_cast<void>(::posix_fadvise(descriptor_, static_cast<off_t>(offset),
                                    static_cast<off_t>(size), POSIX_FADV_WILLNEED));
}

bool RowFile::is_due() noexcept {
  if (is_temporary_)
    return false;
  const Clock::time_point now = Clock::now();
  if (now - opened_ < kUntilFirst || now - last_due_ < kBetween)
    return false;
  last_due_ = now;
  return true;
}

Status RowFile::rename(const std::string& path) {
  if (descriptor_ < 0)
    HC_TRY(make());
  if (::fsync(descriptor_) != 0)
    return failed("cannot be written", errno);
  if (::rename(path_.c_str(), path.c_str()) != 0) {
    const int error = errno;
    return Status::error(StatusCode::kIo, std::string_view(path),
                         ": cannot be put in place: ", errno_text(error), "; it is in ",
                         std::string_view(path_));
  }
  path_ = path;
  return {};
}

void RowFile::remove() noexcept {
  if (is_on_disk())
    ::unlink(path_.c_str());
  is_temporary_ = true;
}

void RowFile::close() noexcept {
  if (descriptor_ >= 0)
    ::close(descriptor_);
  descriptor_ = -1;
  size_ = 0;
  waiting_.clear();
}

} // namespace hemicube::radiosity
