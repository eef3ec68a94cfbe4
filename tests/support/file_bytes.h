#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

namespace hemicube::radiosity::test {

/// The bytes of a number in either byte order.
template <typename Number>
std::string bytes_of(Number value, std::endian order = std::endian::little) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (order != std::endian::native)
    std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// The bytes of numbers, one behind the other, in little-endian order.
template <typename Number> std::string bytes_of(std::initializer_list<Number> values) {
  std::string bytes;
  for (const Number value : values)
    bytes += bytes_of(value);
  return bytes;
}

/// Bytes of a small file replaced, removed, repeated, exchanged for nasty words, or cut off.
inline std::string mutated(std::string bytes, const std::vector<std::string>& words,
                           std::mt19937& random) {
  for (auto count = 1 + random() % 3; count > 0 && !bytes.empty(); --count) {
    const std::size_t at = random() % bytes.size();
    switch (random() % 6) {
    case 0:
      bytes[at] = static_cast<char>(random() & 0xff);
      break;
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      break;
    case 2:
      bytes.erase(at, random() % 8);
      break;
    case 3:
      bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 32));
      break;
    case 4: {
      const std::string& word = words[random() % words.size()];
      bytes.replace(at, random() % (word.size() + 1), word);
      break;
    }
    case 5:
      bytes.resize(std::max(at, bytes.size() / 2));
      break;
    }
  }
  return bytes;
}

} // namespace hemicube::radiosity::test
