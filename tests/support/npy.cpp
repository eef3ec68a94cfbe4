#include "tests/support/npy.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace hemicube::test {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Magic, version, and the length of the header in two bytes.
constexpr std::size_t kPreludeSize = 10;
constexpr char kMagicAndVersion[] = "\x93NUMPY\x01"; // and the zero at the end

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw std::runtime_error(path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

SquareMatrix read_npy(const std::string& path) {
  const auto refuse = [&](const std::string& what) -> std::runtime_error {
    return std::runtime_error(path + ": " + what);
  };
  const std::string bytes = bytes_of(path);
  if (bytes.size() < kPreludeSize ||
      std::memcmp(bytes.data(), kMagicAndVersion, sizeof kMagicAndVersion) != 0)
    throw refuse("not a NumPy file of format 1.0");
  std::uint16_t header_size = 0;
  std::memcpy(&header_size, bytes.data() + sizeof kMagicAndVersion, sizeof header_size);
  const std::size_t start = kPreludeSize + header_size;
  if (bytes.size() < start)
    throw refuse("ends within its header");
  const std::string header = bytes.substr(kPreludeSize, header_size);
  static const std::regex pattern(
      R"(\{'descr': '<f8', 'fortran_order': False, 'shape': \((\d{1,6}), (\d{1,6})\), \}\s*)");
  std::smatch shape;
  if (!std::regex_match(header, shape, pattern))
    throw refuse("not a matrix of little-endian doubles in C order: " + header);
  if (shape[1] != shape[2])
    throw refuse("not square: " + shape[1].str() + " x " + shape[2].str());
  SquareMatrix matrix;
  matrix.size = std::stoul(shape[1]);
  const std::size_t count = matrix.size * matrix.size;
  if (bytes.size() - start != count * sizeof(double))
    throw refuse("has " + std::to_string(bytes.size() - start) + " bytes of values, not " +
                 std::to_string(count * sizeof(double)));
  matrix.values.resize(count);
  if (count != 0)
    std::memcpy(matrix.values.data(), bytes.data() + start, count * sizeof(double));
  for (const double value : matrix.values)
    if (!std::isfinite(value))
      throw refuse("has a value that is not finite");
  return matrix;
}

} // namespace hemicube::test
