#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>

namespace hemicube::radiosity {

/// Appends a number as bytes, lowest first, on every machine.
template <std::unsigned_integral Unsigned>
void append_little_endian(std::string* bytes, Unsigned value) {
  for (std::size_t k = 0; k < sizeof value; ++k)
    bytes->push_back(static_cast<char>(value >> (8 * k) & 0xff));
}
inline void append_little_endian(std::string* bytes, float value) {
  append_little_endian(bytes, std::bit_cast<std::uint32_t>(value));
}

} // namespace hemicube::radiosity
