#include "raster/fp_environment.h"
#include "raster/kernels.h"
#include "raster/simd/dispatch.h"

#include <cstdio>

int main() {
  std::puts(hemicube::raster::best_kernels().name);
  return hemicube::check_float_environment().ok() ? 0 : 1;
}
