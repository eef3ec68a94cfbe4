# What `cmake --install` installs and CPack packs: libraries by component, headers, the program.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # tests need not be there to install
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set_target_properties(hemicube_raster PROPERTIES EXPORT_NAME raster)
set_target_properties(hemicube_core PROPERTIES EXPORT_NAME radiosity)
set_target_properties(hemicube_c PROPERTIES EXPORT_NAME c)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hemicube)

# install_component(NAME targets...): one file of targets that hemicube-config.cmake reads on request.
function(install_component name)
  install(TARGETS ${ARGN} EXPORT hemicube-${name})
  install(EXPORT hemicube-${name} NAMESPACE hemicube:: DESTINATION ${config_dir})
endfunction()

install_component(raster hemicube_settings hemicube_raster)
install_component(radiosity hemicube_core hemicube_c)
if(HEMICUBE_CORE_ONLY)
  set(HEMICUBE_COMPONENTS raster radiosity)
else()
  set(HEMICUBE_COMPONENTS raster radiosity io)
  set_target_properties(hemicube_io PROPERTIES EXPORT_NAME io)
  install_component(io hemicube_io hemicube_readers hemicube_discontinuity)
  install(TARGETS hemicube)
  install(TARGETS hemicube_image_oiio DESTINATION lib/hemicube) # where the program looks for it
endif()

install(FILES radiosity/c_api/hemicube.h DESTINATION include)
install(DIRECTORY raster radiosity DESTINATION include/hemicube
  FILES_MATCHING PATTERN "*.h"
  PATTERN "simd/ops_*" EXCLUDE PATTERN "c_api" EXCLUDE PATTERN "cli" EXCLUDE PATTERN "pictures" EXCLUDE PATTERN "package" EXCLUDE PATTERN "web" EXCLUDE)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY radiosity/c_api/examples DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(radiosity/package/hemicube-config.cmake.in hemicube-config.cmake
  INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(hemicube-config-version.cmake COMPATIBILITY SameMinorVersion)
file(RELATIVE_PATH pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(radiosity/package/hemicube.pc.in hemicube.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hemicube-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/hemicube-config-version.cmake DESTINATION ${config_dir})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hemicube.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the hemicube authors")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_CURRENT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
mark_as_advanced(DPKG_SHLIBDEPS)
if(DPKG_SHLIBDEPS)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libglm-dev, libopenmesh-dev, nlohmann-json3-dev")
include(CPack)
