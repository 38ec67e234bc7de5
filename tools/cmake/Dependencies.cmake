# Where each library is found on Debian 12. Several of the CMake packages there
# are broken (OpenSubdiv, OpenColorIO) or absent (FFTW, Jansson, xxHash).
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)

find_path(OSD_INCLUDE_DIR opensubdiv/version.h REQUIRED)
find_library(OSD_CPU_LIBRARY NAMES osdCPU REQUIRED)
add_library(osdtex_dep_osd UNKNOWN IMPORTED)
set_target_properties(osdtex_dep_osd PROPERTIES
  IMPORTED_LOCATION "${OSD_CPU_LIBRARY}"
  INTERFACE_INCLUDE_DIRECTORIES "${OSD_INCLUDE_DIR}")

find_package(OpenEXR 3.1 CONFIG REQUIRED QUIET)
find_package(embree 3.13 CONFIG REQUIRED)
find_package(PNG REQUIRED)
find_package(TIFF REQUIRED)
find_package(JPEG REQUIRED)
pkg_check_modules(OCIO REQUIRED IMPORTED_TARGET OpenColorIO>=2.1)
pkg_check_modules(LCMS2 REQUIRED IMPORTED_TARGET lcms2>=2.12)
pkg_check_modules(DEFLATE REQUIRED IMPORTED_TARGET libdeflate>=1.10)
pkg_check_modules(FFTW3F REQUIRED IMPORTED_TARGET fftw3f>=3.3)
pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson>=2.13)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash>=0.8)

# CHOLMOD has neither a CMake nor a pkg-config file. Only its simplicial code
# (LGPL) is called, never the supernodal one (GPL); see osdtex/math/sparse.h.
find_path(CHOLMOD_INCLUDE_DIR suitesparse/cholmod.h REQUIRED)
find_library(CHOLMOD_LIBRARY NAMES cholmod REQUIRED)
add_library(osdtex_dep_cholmod UNKNOWN IMPORTED)
set_target_properties(osdtex_dep_cholmod PROPERTIES
  IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
  INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}")

set(OSDTEX_LIBRARIES
  osdtex_dep_osd osdtex_dep_cholmod OpenEXR::OpenEXRCore OpenEXR::OpenEXR embree PNG::PNG
  TIFF::TIFF JPEG::JPEG
  PkgConfig::OCIO PkgConfig::LCMS2 PkgConfig::DEFLATE PkgConfig::FFTW3F PkgConfig::JANSSON PkgConfig::XXHASH
  Threads::Threads m)
