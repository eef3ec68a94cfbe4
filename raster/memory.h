#pragma once

#include "raster/status.h"

#include <cstddef>
#include <cstring>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace hemicube {

/// Where all memory of the core comes from. An embedder may replace it before the first call.
/// allocate returns `bytes` bytes aligned to 64, or null; release takes them back. Memory that is
/// walked at random is asked for in multiples of kHugePage: best aligned to that and backed by huge
/// pages, as the default does on Linux.
struct Allocator {
  void* (*allocate)(std::size_t bytes);
  void (*release)(void* memory, std::size_t bytes);
};
inline constexpr std::size_t kHugePage = std::size_t{2} << 20;
void set_allocator(const Allocator& allocator) noexcept;
/// That of the C library, and what there is until set_allocator is called.
Allocator default_allocator() noexcept;

/// Called with the text of a violated precondition; null, the default, stops the program.
using AssertHandler = void (*)(const char* expression, const char* file, int line);
void set_assert_handler(AssertHandler handler) noexcept;
void assertion_failed(const char* expression, const char* file, int line) noexcept;

/// Told of what is noteworthy and no error, one line; from any thread. Null, the default: nobody.
using LogHandler = void (*)(const char* message);
void set_log_handler(LogHandler handler) noexcept;
void log_message(const char* message) noexcept;

namespace detail {
void* allocate(std::size_t bytes) noexcept;
void release(void* memory, std::size_t bytes) noexcept;
} // namespace detail

/// A resizable array of plain data, aligned to 64 bytes. It never throws: growing reports out of
/// memory as a Status and then leaves the array as it was. Move-only; new elements are
/// value-initialised.
template <typename T> class Buffer {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  static_assert(alignof(T) <= 64);

public:
  Buffer() noexcept = default;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    Buffer taken(std::move(other));
    swap(taken);
    return *this;
  }
  ~Buffer() { detail::release(data_, capacity_ * sizeof(T)); }

  void swap(Buffer& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  Status reserve(std::size_t capacity) noexcept {
    if (capacity <= capacity_)
      return {};
    return reallocate(capacity);
  }

  /// For what is walked at random and often: rounds up to huge pages, unless it is small.
  Status reserve_huge(std::size_t capacity) noexcept {
    constexpr std::size_t kPerPage = kHugePage / sizeof(T);
    static_assert(kPerPage * sizeof(T) == kHugePage);
    return reserve(capacity < kPerPage / 8 ? capacity
                                           : (capacity + kPerPage - 1) / kPerPage * kPerPage);
  }

  /// Gives back what growing took in advance.
  Status shrink_to_fit() noexcept { return size_ == capacity_ ? Status() : reallocate(size_); }

  Status resize(std::size_t size) noexcept { return resize(size, T{}); }

  Status resize(std::size_t size, const T& value) noexcept {
    HC_TRY(reserve(size));
    for (std::size_t i = size_; i < size; ++i)
      data_[i] = value;
    size_ = size;
    return {};
  }

  Status push_back(const T& value) noexcept {
    const T copy = value; // it may live in this very buffer
    if (size_ == capacity_)
      HC_TRY(reserve(capacity_ == 0 ? 16 : capacity_ * 2));
    data_[size_++] = copy;
    return {};
  }

  Status append(std::span<const T> values) noexcept {
    if (size_ + values.size() > capacity_) {
      const std::size_t doubled = capacity_ * 2;
      HC_TRY(reserve(size_ + values.size() > doubled ? size_ + values.size() : doubled));
    }
    if (!values.empty())
      std::memcpy(static_cast<void*>(data_ + size_), values.data(), values.size_bytes());
    size_ += values.size();
    return {};
  }

  Status assign(std::span<const T> values) noexcept {
    clear();
    return append(values);
  }

  void pop_back() noexcept { --size_; }
  void clear() noexcept { size_ = 0; }
  void fill(const T& value) noexcept {
    for (std::size_t i = 0; i < size_; ++i)
      data_[i] = value;
  }

  std::size_t size() const noexcept { return size_; }
  std::size_t capacity() const noexcept { return capacity_; }
  bool empty() const noexcept { return size_ == 0; }
  T* data() noexcept { return data_; }
  const T* data() const noexcept { return data_; }
  T& operator[](std::size_t i) noexcept { return data_[i]; }
  const T& operator[](std::size_t i) const noexcept { return data_[i]; }
  T& back() noexcept { return data_[size_ - 1]; }
  T* begin() noexcept { return data_; }
  T* end() noexcept { return data_ + size_; }
  const T* begin() const noexcept { return data_; }
  const T* end() const noexcept { return data_ + size_; }
  std::span<T> span() noexcept { return {data_, size_}; }
  std::span<const T> span() const noexcept { return {data_, size_}; }

private:
  /// @param capacity  at least size()
  Status reallocate(std::size_t capacity) noexcept {
    T* moved = nullptr;
    if (capacity <= static_cast<std::size_t>(-1) / sizeof(T) / 2)
      moved = static_cast<T*>(detail::allocate(capacity * sizeof(T)));
    if (moved == nullptr && capacity != 0)
      return Status::error(StatusCode::kOutOfMemory, "out of memory: ", capacity, " elements of ",
                           sizeof(T), " bytes were asked for");
    if (size_ != 0)
      std::memcpy(static_cast<void*>(moved), data_, size_ * sizeof(T));
    detail::release(data_, capacity_ * sizeof(T));
    data_ = moved;
    capacity_ = capacity;
    return {};
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// An array of default-constructed objects that never moves them: for workers and other owners of
/// buffers.
template <typename T> class FixedArray {
public:
  FixedArray() noexcept = default;
  FixedArray(const FixedArray&) = delete;
  FixedArray& operator=(const FixedArray&) = delete;
  ~FixedArray() { release(); }

  /// Destroys what there was and makes `size` new objects.
  Status init(std::size_t size) noexcept {
    release();
    if (size == 0)
      return {};
    data_ = size > static_cast<std::size_t>(-1) / sizeof(T)
                ? nullptr
                : static_cast<T*>(detail::allocate(size * sizeof(T)));
    if (data_ == nullptr)
      return Status::error(StatusCode::kOutOfMemory, "out of memory: ", size, " objects of ",
                           sizeof(T), " bytes were asked for");
    for (; size_ < size; ++size_)
      new (&data_[size_]) T;
    return {};
  }

  void swap(FixedArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  std::size_t size() const noexcept { return size_; }
  T& operator[](std::size_t i) noexcept { return data_[i]; }
  const T& operator[](std::size_t i) const noexcept { return data_[i]; }
  T* begin() noexcept { return data_; }
  T* end() noexcept { return data_ + size_; }
  const T* begin() const noexcept { return data_; }
  const T* end() const noexcept { return data_ + size_; }

private:
  void release() noexcept {
    for (std::size_t i = 0; i < size_; ++i)
      data_[i].~T();
    detail::release(data_, size_ * sizeof(T));
    data_ = nullptr;
    size_ = 0;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
};

} // namespace hemicube

/// A precondition of the caller. Violations are bugs, not bad input. The file is told without its
/// folder, which is that of whoever built the program.
#define HC_ASSERT(expression)                                                                      \
  ((expression) ? (void)0 : ::hemicube::assertion_failed(#expression, __FILE_NAME__, __LINE__))
