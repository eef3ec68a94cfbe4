# For toolchain files: finds GLM, which is headers alone, without the other headers of this machine that
# lie beside it.
set(alone ${CMAKE_BINARY_DIR}/glm_alone)
file(MAKE_DIRECTORY ${alone})
file(CREATE_LINK /usr/include/glm ${alone}/glm SYMBOLIC)
file(WRITE ${alone}/glm-config.cmake "add_library(glm::glm INTERFACE IMPORTED)
set_target_properties(glm::glm PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${alone})
")
set(glm_DIR ${alone})
