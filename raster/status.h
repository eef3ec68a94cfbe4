#pragma once

#include <concepts>
#include <cstddef>
#include <string_view>
#include <type_traits>
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
  Status& operator=(const Status& other) noexcept;

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
  // Not inline: errors are rare, and returned from everywhere.
  void append(std::string_view text) noexcept;
  void append(const char* text) noexcept;
  void append(double value) noexcept;
  void append(unsigned long long value) noexcept;
  void append(long long value) noexcept;
  template <std::integral Integer> void append(Integer value) noexcept {
    using Widest = std::conditional_t<std::is_signed_v<Integer>, long long, unsigned long long>;
    append(static_cast<Widest>(value));
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
