# osdtex_studio: the page and what serves it, or where libmicrohttpd is not, the
# sentence that says so.
pkg_check_modules(MICROHTTPD IMPORTED_TARGET libmicrohttpd>=0.9.75)
if(MICROHTTPD_FOUND)
  file(GLOB OSDTEX_STUDIO_SOURCES CONFIGURE_DEPENDS osdtex/studio/*.c)
  list(FILTER OSDTEX_STUDIO_SOURCES EXCLUDE REGEX "/absent[.]c$")
  file(GLOB OSDTEX_PAGE_FILES CONFIGURE_DEPENDS osdtex/studio/page/*
    osdtex/studio/vendor/*.js)
  set(OSDTEX_PAGE_ROWS "")
  foreach(path ${OSDTEX_PAGE_FILES})
    get_filename_component(name ${path} NAME)
    list(APPEND OSDTEX_PAGE_ROWS "${name}|${path}")
  endforeach()
  set(OSDTEX_PAGE_SOURCE ${PROJECT_BINARY_DIR}/osdtex_page.c)
  add_custom_command(OUTPUT ${OSDTEX_PAGE_SOURCE}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${OSDTEX_PAGE_SOURCE}
      "-DFILES=${OSDTEX_PAGE_ROWS}"
      -P ${PROJECT_SOURCE_DIR}/tools/cmake/Page.cmake
    DEPENDS ${OSDTEX_PAGE_FILES} tools/cmake/Page.cmake
    VERBATIM COMMENT "The files of the page")
  list(APPEND OSDTEX_STUDIO_SOURCES ${OSDTEX_PAGE_SOURCE})
else()
  message(STATUS "No libmicrohttpd: osdtex studio will only say so")
  set(OSDTEX_STUDIO_SOURCES osdtex/studio/absent.c
    osdtex/studio/sentence.c)
endif()
add_library(osdtex_studio STATIC ${OSDTEX_STUDIO_SOURCES})
target_include_directories(osdtex_studio PUBLIC osdtex)
target_link_libraries(osdtex_studio PUBLIC osdtex_static PkgConfig::JANSSON
  PRIVATE osdtex_rules)
if(MICROHTTPD_FOUND)
  target_link_libraries(osdtex_studio PRIVATE PkgConfig::MICROHTTPD)
endif()
