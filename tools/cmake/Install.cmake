# What `cmake --install` puts where, and how other projects find it:
# pkg-config osdtex, or find_package(osdtex) with osdtex::shared and
# osdtex::static.
include(CMakePackageConfigHelpers)

# The components are the packages of Packages.cmake.
install(TARGETS osdtex_shared
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
  NAMELINK_COMPONENT development)
install(TARGETS osdtex_static
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(DIRECTORY include/osdtex DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development FILES_MATCHING PATTERN "*.h")
if(TARGET osdtex)
  install(TARGETS osdtex RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
    COMPONENT tools)
endif()
install(DIRECTORY docs/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
  COMPONENT tools FILES_MATCHING PATTERN "*.1")
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc
  PATTERN "man" EXCLUDE)
install(FILES README.md CHANGELOG.md LICENSE
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)

# What shells complete, printed by the program from its own table.
if(TARGET osdtex)
  set(OSDTEX_COMPLETIONS ${PROJECT_BINARY_DIR}/completions)
  add_custom_command(OUTPUT ${OSDTEX_COMPLETIONS}/osdtex
      ${OSDTEX_COMPLETIONS}/_osdtex ${OSDTEX_COMPLETIONS}/osdtex.fish
    COMMAND ${CMAKE_COMMAND} -E make_directory ${OSDTEX_COMPLETIONS}
    COMMAND osdtex help --completion bash >${OSDTEX_COMPLETIONS}/osdtex
    COMMAND osdtex help --completion zsh >${OSDTEX_COMPLETIONS}/_osdtex
    COMMAND osdtex help --completion fish >${OSDTEX_COMPLETIONS}/osdtex.fish
    DEPENDS osdtex COMMENT "What shells complete")
  add_custom_target(osdtex_completions ALL
    DEPENDS ${OSDTEX_COMPLETIONS}/osdtex)
  install(FILES ${OSDTEX_COMPLETIONS}/osdtex COMPONENT tools
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${OSDTEX_COMPLETIONS}/_osdtex COMPONENT tools
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
  install(FILES ${OSDTEX_COMPLETIONS}/osdtex.fish COMPONENT tools
    DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()

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
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/osdtexConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/osdtexConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/osdtex COMPONENT development)

# Only the public functions are exported; what C++ instantiates from the
# standard library would be, too.
set(OSDTEX_EXPORTS ${PROJECT_SOURCE_DIR}/tools/cmake/exports.map)
target_link_options(osdtex_shared PRIVATE
  -Wl,--version-script=${OSDTEX_EXPORTS})
set_target_properties(osdtex_shared PROPERTIES LINK_DEPENDS ${OSDTEX_EXPORTS})
install(FILES tools/dcc/blender/osdtex_import.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/osdtex/blender COMPONENT tools)
install(FILES tools/dcc/osdtex_cage.py tools/dcc/osdtex_job.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/osdtex COMPONENT tools)
install(FILES tools/dcc/houdini/osdtex_sop.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/osdtex/houdini COMPONENT tools)
install(FILES tools/dcc/maya/osdtex_shelf.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/osdtex/maya COMPONENT tools)
# The add-on as Blender installs it.
find_program(OSDTEX_PYTHON3 NAMES python3)
if(OSDTEX_PYTHON3)
  install(CODE "execute_process(COMMAND ${OSDTEX_PYTHON3}
    ${PROJECT_SOURCE_DIR}/tools/dcc/blender/make-addon
    ${PROJECT_BINARY_DIR}/osdtex_blender.zip COMMAND_ERROR_IS_FATAL ANY)"
    COMPONENT tools)
  install(FILES ${PROJECT_BINARY_DIR}/osdtex_blender.zip
    DESTINATION ${CMAKE_INSTALL_DATADIR}/osdtex/blender COMPONENT tools)
endif()
