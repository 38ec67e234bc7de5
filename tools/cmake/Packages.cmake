# Debian packages of what is installed, by cpack: see tools/package.
#
#     libosdtex0.2      the shared library
#     libosdtex-dev     headers, archive, pkg-config and CMake files
#     osdtex            the program, manual pages, completions, DCC scripts
#     python3-osdtex    the Python module
#     osdtex-doc        the documents
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME osdtex)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The osdtex authors <osdtex@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL library development tools doc)
if(TARGET osdtex_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_STRIP_FILES ON)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

set(library libosdtex${OSDTEX_SOVERSION})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
  "Textures subdivision surfaces: the shared library")

# The archive needs what it is made of, which is said by the names that
# Dependencies.cmake looks for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libosdtex-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "${library} (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "libosd-dev, libopenexr-dev, \
libfftw3-dev, libopencolorio-dev, liblcms2-dev, libembree-dev, libpng-dev, \
libtiff-dev, libjpeg-dev, libjansson-dev, libxxhash-dev, libsuitesparse-dev, \
libdeflate-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "Textures subdivision surfaces: headers and archive")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME osdtex)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS "osdtex-doc, blender")
set(CPACK_COMPONENT_TOOLS_DESCRIPTION ${PROJECT_DESCRIPTION})

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-osdtex)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3-numpy, \
${library} (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
  "Textures subdivision surfaces: the Python module")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME osdtex-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DOC_DESCRIPTION
  "Textures subdivision surfaces: the documents")
include(CPack)
