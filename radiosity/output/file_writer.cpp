#include "radiosity/output/file_writer.h"

#include <cerrno>
#include <cstring>

namespace hemicube::radiosity {

const char* errno_text(int error) noexcept {
  return std::strerror(error);
}

FileWriter::~FileWriter() {
  if (file_ != nullptr)
    std::fclose(file_);
}

Status FileWriter::open(const std::string& path, const std::string& shown_as) {
  shown_as_ = shown_as;
  file_ = std::fopen(path.c_str(), "wb");
  if (file_ == nullptr)
    return Status::error(StatusCode::kIo, shown_as_, ": cannot be written: ", errno_text(errno),
                         "; choose another place with -o");
  std::setvbuf(file_, nullptr, _IONBF, 0); // buffer_ is the buffer
  return {};
}

void FileWriter::write(std::string_view bytes) {
  buffer_.append(bytes);
  flush_if_large();
}

void FileWriter::flush() {
  if (error_ == 0 && !buffer_.empty()) {
    errno = 0;
    if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size())
      error_ = errno != 0 ? errno : EIO;
  }
  buffer_.clear();
}

Status FileWriter::close() {
  flush();
  if (std::fclose(file_) != 0 && error_ == 0)
    error_ = errno;
  file_ = nullptr;
  if (error_ != 0)
    return Status::error(StatusCode::kIo, shown_as_, ": cannot be written: ", errno_text(error_),
                         "; make room or choose another place with -o");
  return {};
}

} // namespace hemicube::radiosity
