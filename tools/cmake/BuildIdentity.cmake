# Writes the source that says which build this is; run at every build, and by
# then touching the file only where it changes:
#
#     cmake -DSOURCE=FOLDER -DVERSION=V -DHOW=TEXT -DGIT=PROGRAM -DOUTPUT=FILE
#         -P BuildIdentity.cmake
#
# A build is what git calls the tree (of a tarball: the version), and a hash of
# what is compiled and how. The hash tells two states of a dirty tree apart.
set(paths CMakeLists.txt)
file(GLOB_RECURSE found RELATIVE ${SOURCE} LIST_DIRECTORIES false
  ${SOURCE}/osdtex/*.c ${SOURCE}/osdtex/*.cpp ${SOURCE}/osdtex/*.h
  ${SOURCE}/include/*.h ${SOURCE}/tools/cmake/*
  ${SOURCE}/osdtex/studio/page/* ${SOURCE}/osdtex/studio/vendor/*)
list(APPEND paths ${found})
list(SORT paths)
set(text "${HOW}")
foreach(path ${paths})
  file(SHA256 ${SOURCE}/${path} hash)
  string(APPEND text "\n${path} ${hash}")
endforeach()
string(SHA256 hash "${text}")
string(SUBSTRING ${hash} 0 12 hash)

# Of this tree only: a copy inside the checkout of something else is no
# checkout of ours.
set(tree ${VERSION})
if(GIT AND EXISTS ${SOURCE}/.git)
  # A build takes no lock of the tree that somebody else commits in.
  set(ENV{GIT_OPTIONAL_LOCKS} 0)
  execute_process(
    COMMAND ${GIT} -C ${SOURCE} describe --always --tags --dirty
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE
    RESULT_VARIABLE status ERROR_QUIET)
  if(status EQUAL 0 AND described MATCHES "^[A-Za-z0-9._-]+$")
    set(tree ${described})
  endif()
endif()

file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[/* Which build this is; see base/build.h. */
#include "base/build.h"

const char *
otx_build(void)
{
    return "@tree@+@hash@";
}
]])
