# Installs the build, looks for build paths in what was installed, uses it by find_package and by
# pkg-config, uses the sources by add_subdirectory, and makes a Debian package.
# Usage: cmake -DBUILD=.. -DSOURCE=.. -DCC=cc -DCXX=c++ -DCPACK=cpack -P package.cmake
set(work ${BUILD}/tests/package)
file(REMOVE_RECURSE ${work})
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/usr)
execute_process(COMMAND grep -rlF -e ${SOURCE} -e ${BUILD} ${work}/usr OUTPUT_VARIABLE leaks)
if(leaks)
  message(FATAL_ERROR "the path of the build is in what was installed:\n${leaks}")
endif()

# In Debug our own files take the least time.
set(consumer ${CMAKE_COMMAND} -S ${SOURCE}/tests/package/consumer -DCMAKE_BUILD_TYPE=Debug
  -DCMAKE_CXX_COMPILER=${CXX})
run(${consumer} -B ${work}/found -DCMAKE_PREFIX_PATH=${work}/usr)
run(${CMAKE_COMMAND} --build ${work}/found)
run(${work}/found/consumer ${SOURCE}/scenes/furnace_cube.obj)
set(light ${output})
run(${work}/usr/bin/hemicube solve ${SOURCE}/scenes/furnace_cube.obj --rung hemicube --resolution 16
  --json --quiet)
string(STRIP "${light}" light)
if(NOT light MATCHES "^[0-9a-f]+$" OR NOT output MATCHES "${light}")
  message(FATAL_ERROR "a program by find_package finds ${light}, the installed program says ${output}")
endif()

set(ENV{PKG_CONFIG_PATH} ${work}/usr/lib/pkgconfig)
run(pkg-config --cflags --libs hemicube)
separate_arguments(flags UNIX_COMMAND "${output}")
run(${CC} -std=c99 ${SOURCE}/radiosity/c_api/examples/room.c ${flags} -Wl,-rpath,${work}/usr/lib
  -o ${work}/room)
run(${work}/room)

run(${consumer} -B ${work}/added -DHEMICUBE_SOURCE=${SOURCE})
run(${CMAKE_COMMAND} --build ${work}/added --target consumer)
run(${work}/added/consumer)

run(${CPACK} --config ${BUILD}/CPackConfig.cmake -G DEB -B ${work}/deb)
file(GLOB package ${work}/deb/*.deb)
run(dpkg-deb --contents ${package})
foreach(file bin/hemicube lib/libhemicube.so lib/hemicube/hemicube_image_oiio.so include/hemicube.h
    include/hemicube/radiosity/radiosity.h lib/cmake/hemicube/hemicube-config.cmake
    lib/pkgconfig/hemicube.pc)
  if(NOT output MATCHES "\\./usr/${file}")
    message(FATAL_ERROR "${package} lacks ${file}:\n${output}")
  endif()
endforeach()
