#include "raster/status.h"

#include "raster/decimal.h"

#include <charconv>
#include <cstring>

namespace hemicube {
namespace {

template <typename Integer> std::string_view digits_of(Integer value, char (&text)[kMaxDecimal]) {
  const char* end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, static_cast<std::size_t>(end - text)};
}

} // namespace

Status& Status::operator=(const Status& other) noexcept {
  if (this == &other)
    return *this;
  code_ = other.code_;
  length_ = other.length_;
  std::memcpy(text_, other.text_, length_ + 1);
  return *this;
}

void Status::append(std::string_view text) noexcept {
  const std::size_t room = kCapacity - 1 - length_;
  const std::size_t count = text.size() < room ? text.size() : room;
  for (const char c : text.substr(0, count))
    text_[length_++] = static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  text_[length_] = '\0';
}

void Status::append(const char* text) noexcept {
  append(std::string_view(text));
}

void Status::append(double value) noexcept {
  char text[kMaxDecimal];
  append(std::string_view(text, shortest_decimal(value, text)));
}

void Status::append(unsigned long long value) noexcept {
  char text[kMaxDecimal];
  append(digits_of(value, text));
}

void Status::append(long long value) noexcept {
  char text[kMaxDecimal];
  append(digits_of(value, text));
}

} // namespace hemicube
