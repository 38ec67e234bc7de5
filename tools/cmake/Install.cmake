# What `cmake --install` puts where, and how other projects find it:
# pkg-config osdtex, or find_package(osdtex) with osdtex::shared and
# osdtex::static.
include(CMakePackageConfigHelpers)

install(TARGETS osdtex_shared osdtex_static
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/osdtex DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h")
if(TARGET osdtex)
  install(TARGETS osdtex RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(FILES docs/man/osdtex.1
  DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)

# The archive needs what it is made of. Names of libraries rather than targets:
# a consumer shall not need the (partly broken) CMake packages of the
# dependencies, only the libraries themselves.
set(OSDTEX_PRIVATE_LIBS -losdCPU -lOpenEXRCore -lOpenEXR -lImath
  -lOpenColorIO -llcms2 -lfftw3f
  -lcholmod -lembree3 -lpng -ltiff -ljpeg -ljansson -lxxhash -ldeflate -lstdc++
  -lpthread -lm)
list(JOIN OSDTEX_PRIVATE_LIBS " " OSDTEX_PRIVATE_LIBS_TEXT)

# From the .pc file up to the prefix, so that the tree can be moved.
file(RELATIVE_PATH OSDTEX_PC_UP /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig
  /prefix)
configure_file(tools/cmake/osdtex.pc.in osdtex.pc @ONLY)
configure_package_config_file(tools/cmake/osdtexConfig.cmake.in
  osdtexConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/osdtex
  PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(osdtexConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/osdtex.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/osdtexConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/osdtexConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/osdtex)

# Only the public functions are exported; what C++ instantiates from the
# standard library would be, too.
set(OSDTEX_EXPORTS ${PROJECT_SOURCE_DIR}/tools/cmake/exports.map)
target_link_options(osdtex_shared PRIVATE
  -Wl,--version-script=${OSDTEX_EXPORTS})
set_target_properties(osdtex_shared PROPERTIES LINK_DEPENDS ${OSDTEX_EXPORTS})
install(FILES tools/dcc/blender/osdtex_import.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/osdtex/blender)
install(FILES tools/dcc/osdtex_cage.py tools/dcc/osdtex_job.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/osdtex)
# The add-on as Blender installs it.
find_program(OSDTEX_PYTHON3 NAMES python3)
if(OSDTEX_PYTHON3)
  install(CODE "execute_process(COMMAND ${OSDTEX_PYTHON3}
    ${PROJECT_SOURCE_DIR}/tools/dcc/blender/make-addon
    ${PROJECT_BINARY_DIR}/osdtex_blender.zip COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES ${PROJECT_BINARY_DIR}/osdtex_blender.zip
    DESTINATION ${CMAKE_INSTALL_DATADIR}/osdtex/blender)
endif()
