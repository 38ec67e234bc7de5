# osdtex_build: an object that says which build this is (osdtex/base/build.h).
find_program(OSDTEX_GIT git)
set(OSDTEX_BUILD_SOURCE ${PROJECT_BINARY_DIR}/osdtex_build.c)
set(OSDTEX_BUILD_HOW
  "${CMAKE_SYSTEM_PROCESSOR} ${CMAKE_BUILD_TYPE} ${OSDTEX_SANITIZE}"
  "C ${CMAKE_C_COMPILER_ID} ${CMAKE_C_COMPILER_VERSION} ${CMAKE_C_FLAGS}"
  "C++ ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
  "${CMAKE_CXX_FLAGS} OpenEXR ${OpenEXR_VERSION} OpenColorIO ${OCIO_VERSION}"
  "FFTW ${FFTW3F_VERSION} Embree ${embree_VERSION} PNG ${PNG_VERSION_STRING}"
  "TIFF ${TIFF_VERSION_STRING} JPEG ${JPEG_VERSION}"
  "libdeflate ${DEFLATE_VERSION} LittleCMS ${LCMS2_VERSION}")
list(JOIN OSDTEX_BUILD_HOW " " OSDTEX_BUILD_HOW)

# Always looked at, and a no-op for what depends on it where nothing changed.
add_custom_target(osdtex_build_source
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR}
    -DVERSION=${PROJECT_VERSION} "-DHOW=${OSDTEX_BUILD_HOW}"
    -DGIT=${OSDTEX_GIT} -DOUTPUT=${OSDTEX_BUILD_SOURCE}
    -P ${PROJECT_SOURCE_DIR}/tools/cmake/BuildIdentity.cmake
  BYPRODUCTS ${OSDTEX_BUILD_SOURCE} VERBATIM
  COMMENT "Which build this is")
add_library(osdtex_build OBJECT ${OSDTEX_BUILD_SOURCE})
add_dependencies(osdtex_build osdtex_build_source)
target_include_directories(osdtex_build PRIVATE osdtex)
target_link_libraries(osdtex_build PRIVATE osdtex_rules)
