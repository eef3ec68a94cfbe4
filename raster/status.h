#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <utility>

namespace hemicube {

enum class StatusCode {
  kOk,
  kInvalidArgument,             ///< a value the caller gave is out of range
  kBadScene,                    ///< the scene cannot be modelled as it is
  kOutOfMemory,                 ///< an allocation failed
  kNotConverged,                ///< the solver stopped before its tolerance
  kSingular,                    ///< the equations have no solution
  kIo,                          ///< a file could not be read or written
  kCancelled,                   ///< the caller asked to stop
  kUnsupportedFloatEnvironment, ///< this build or thread does not compute the promised bits
  kCheckFailed                  ///< a condition that the caller set does not hold
};

/// The outcome of a call: a code and, unless it is kOk, one line that says what is wrong, where,
/// with the offending value, and what to do. Longer messages are cut at kCapacity - 1 bytes. They
/// quote files and file names: control bytes, which a terminal would obey, become '?'.
class [[nodiscard]] Status {
public:
  static constexpr std::size_t kCapacity = 512;

  Status() noexcept { text_[0] = '\0'; }
  Status(const Status& other) noexcept { *this = other; }
  Status& operator=(const Status& other) noexcept {
    if (this == &other)
      return *this;
    code_ = other.code_;
    length_ = other.length_;
    std::memcpy(text_, other.text_, length_ + 1);
    return *this;
  }

  /// An error whose message is the concatenation of the parts: text, integers, floating-point
  /// numbers (shortest form that reads back the same, independent of the locale).
  template <typename... Parts>
  static Status error(StatusCode code, const Parts&... parts) noexcept {
    Status status;
    status.code_ = code;
    (status.append(parts), ...);
    return status;
  }

  bool ok() const noexcept { return code_ == StatusCode::kOk; }
  StatusCode code() const noexcept { return code_; }
  std::string_view message() const noexcept { return {text_, length_}; }

private:
  void append(std::string_view text) noexcept {
    const std::size_t room = kCapacity - 1 - length_;
    const std::size_t count = text.size() < room ? text.size() : room;
    for (const char c : text.substr(0, count))
      text_[length_++] = static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    text_[length_] = '\0';
  }
  void append(const char* text) noexcept { append(std::string_view(text)); }
  template <typename Number>
  requires std::integral<Number> || std::floating_point<Number>
  void append(Number value) noexcept {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    append(std::string_view(digits, static_cast<std::size_t>(end - digits)));
  }

  StatusCode code_ = StatusCode::kOk;
  std::size_t length_ = 0;
  char text_[kCapacity];
};

/// A value or the reason why there is none. value() may be called only if ok().
template <typename T> class [[nodiscard]] Result {
public:
  Result(T value) : value_(std::move(value)) {}
  Result(const Status& status) : status_(status) {}

  bool ok() const noexcept { return status_.ok(); }
  const Status& status() const noexcept { return status_; }
  T& value() noexcept { return value_; }
  const T& value() const noexcept { return value_; }

private:
  Status status_;
  T value_{};
};

} // namespace hemicube

/// Returns the status of an expression from the enclosing function unless it is ok.
#define HC_TRY(expression)                                                                         \
  do {                                                                                             \
    if (const ::hemicube::Status& hc_try_status = (expression); !hc_try_status.ok())               \
      return hc_try_status;                                                                        \
  } while (false)
