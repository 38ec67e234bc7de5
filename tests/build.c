/* build.c -- the build that tests are: see base/build.h. */
#include "base/build.h"

const char *
otx_build(void)
{
    return "test+000000000000";
}
