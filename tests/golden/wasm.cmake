# WebAssembly with vectors, for WASI, with Debian's clang. It has neither threads nor exceptions: what
# would throw stops the program.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-14)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(HEMICUBE_THREADS OFF CACHE BOOL "")
set(CMAKE_AR llvm-ar-14 CACHE STRING "")
set(CMAKE_RANLIB llvm-ranlib-14 CACHE STRING "")
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fignore-exceptions")
# What is usual elsewhere; the linker's own 64 KB are less than rows on the finer rungs take.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,-z,stack-size=8388608")
include(${CMAKE_CURRENT_LIST_DIR}/glm_alone.cmake)
