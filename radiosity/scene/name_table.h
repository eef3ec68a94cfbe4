#pragma once

#include "raster/memory.h"

#include <cstdint>
#include <string_view>

namespace hemicube::radiosity {

/// Names numbered from 0 in the order they were added. A name may be any bytes, also empty.
class NameTable {
public:
  static constexpr std::uint32_t kAbsent = 0xffffffffu;

  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(ends_.size()); }

  std::string_view operator[](std::uint32_t index) const noexcept {
    const std::size_t begin = index == 0 ? 0 : ends_[index - 1];
    return {bytes_.data() + begin, ends_[index] - begin};
  }

  /// The number of a name, or kAbsent; linear in the number of names.
  std::uint32_t find(std::string_view name) const noexcept {
    for (std::uint32_t i = 0; i < size(); ++i)
      if ((*this)[i] == name)
        return i;
    return kAbsent;
  }

  /// Adds a name at the end, also if it is there already.
  Status add(std::string_view name) noexcept {
    HC_TRY(bytes_.append(std::span<const char>(name.data(), name.size())));
    return ends_.push_back(bytes_.size());
  }

private:
  Buffer<char> bytes_;
  Buffer<std::size_t> ends_;
};

} // namespace hemicube::radiosity
