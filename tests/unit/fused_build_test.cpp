// A build without -ffp-contract=off is found out: this file is compiled so.
#include "raster/fp_environment.h"

#include <gtest/gtest.h>

namespace hemicube {
namespace {

TEST(FusedBuild, IsRefused) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("fma"))
    GTEST_SKIP() << "a machine without fused operations";
#endif
  EXPECT_EQ(check_float_environment().code(), StatusCode::kUnsupportedFloatEnvironment);
}

} // namespace
} // namespace hemicube
