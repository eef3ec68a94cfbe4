// The reader of reference matrices: a truth that is read wrong makes every error look right.

#include "tests/support/npy.h"
#include "tests/support/reference.h"
#include "tests/support/scene_files.h"
#include "tests/support/scenes_shared.h"

#include <cstring>
#include <limits>
#include <stdexcept>

namespace hemicube::test {
namespace {

/// A NumPy file with this header, and these values.
std::string npy(const std::string& header, const std::vector<double>& values) {
  std::string bytes("\x93NUMPY\x01\0", 8);
  bytes += static_cast<char>(header.size());
  bytes += '\0';
  bytes += header;
  bytes.resize(bytes.size() + values.size() * sizeof(double));
  std::memcpy(bytes.data() + bytes.size() - values.size() * sizeof(double), values.data(),
              values.size() * sizeof(double));
  return bytes;
}

const std::string kTwoByTwo = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }   \n";

class Npy : public radiosity::test::SceneFiles {
protected:
  void expect_refused(const std::string& bytes, const std::string& what) {
    const std::string file = write("matrix.npy", bytes);
    try {
      read_npy(file);
      ADD_FAILURE() << "accepted; expected: " << what;
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(file + ": " + what)) << error.what();
    }
  }
};

// Catches: rows and columns exchanged, an offset into the values.
TEST_F(Npy, ReadsRowByRow) {
  const SquareMatrix matrix = read_npy(write("matrix.npy", npy(kTwoByTwo, {1, 2, 3, 4})));
  ASSERT_EQ(matrix.size, 2u);
  EXPECT_EQ(matrix.values, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(matrix.at(0, 1), 2);
  EXPECT_EQ(matrix.at(1, 0), 3);
}

// Catches: a checkout that stopped half way read as zeros, or read past the end.
TEST_F(Npy, RefusesEveryTruncation) {
  const std::string whole = npy(kTwoByTwo, {1, 2, 3, 4});
  const std::size_t header_end = 10 + kTwoByTwo.size();
  for (std::size_t size = 0; size < whole.size(); ++size)
    expect_refused(whole.substr(0, size), size < 10           ? "not a NumPy file"
                                          : size < header_end ? "ends within its header"
                                                              : "has ");
  expect_refused(whole + '\0', "has 33 bytes of values, not 32");
  EXPECT_THROW(read_npy(path("none.npy")), std::runtime_error);
}

// Catches: floats read as doubles, a transposed matrix, a pointer file in place of the data.
TEST_F(Npy, RefusesOtherContents) {
  const std::vector<double> four = {1, 2, 3, 4};
  expect_refused("version https://git-lfs.github.com/spec/v1\n", "not a NumPy file");
  for (const char* header : {"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2), }",
                             "{'descr': '>f8', 'fortran_order': False, 'shape': (2, 2), }",
                             "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 2), }",
                             "{'descr': '<f8', 'fortran_order': False, 'shape': (4,), }"})
    expect_refused(npy(header, four), "not a matrix of little-endian doubles in C order");
  expect_refused(npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 4), }", four),
                 "not square: 1 x 4");
  expect_refused(npy(kTwoByTwo, {1, 2, std::numeric_limits<double>::quiet_NaN(), 4}),
                 "has a value that is not finite");
}

// Catches: a matrix that belongs to another mesh, or to the patches in another order: areas times
// form factors are about 1e-4. The two entries of a pair of boxin were found one by one, and differ
// by up to 1e-6 of a form factor, times an area of 1/64.
TEST(ReferenceMatrix, BelongsToItsMesh) {
  for (const char* name : {"cube8", "boxin"}) {
    const PatchSet patches =
        patches_of(reference_scene(std::string("viewfactors/") + name + ".obj"));
    const SquareMatrix truth = reference_matrix(std::string("viewfactors/") + name + ".F.npy");
    ASSERT_EQ(truth.size, patches.patch_count()) << name;
    for (std::size_t i = 0; i < truth.size; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < truth.size; ++j) {
        sum += truth.at(i, j);
        ASSERT_NEAR(patches.area[i] * truth.at(i, j), patches.area[j] * truth.at(j, i), 5e-8)
            << name << ": " << i << " and " << j;
      }
      EXPECT_NEAR(sum, 1, 1e-5) << name << ": row " << i;
    }
  }
}

} // namespace
} // namespace hemicube::test
