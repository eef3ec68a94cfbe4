#pragma once

#include <cstddef>

namespace hemicube {

/// Characters that shortest_decimal writes at most.
inline constexpr std::size_t kMaxDecimal = 24;

/// Writes the shortest decimal number that reads back as the same double, and of those the nearest:
/// "0.1", "1e-09", "-inf", "nan". Not terminated. The text is that of std::to_chars, whose tables
/// are a seventh of a program that embeds the core.
/// @param text  room for kMaxDecimal characters; the caller's
/// @return characters written
/// Deterministic: integers only, independent of the locale. Slow: for messages.
/// Source: Steele and White 1990, "How to print floating-point numbers accurately".
std::size_t shortest_decimal(double value, char* text) noexcept;

} // namespace hemicube
