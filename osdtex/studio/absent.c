/* absent.c -- the studio of a build without libmicrohttpd. */
#include "studio/sentence.h"
#include "studio/studio.h"

#include <stdio.h>

bool
otx_studio_is_built(void)
{
    return false;
}

osdtex_status
otx_studio_run(
    const otx_studio_options *options, char error[OTX_STUDIO_ERROR_BYTES])
{
    (void)options;
    otx_sentence(
        error,
        "this build has no studio: it was compiled without libmicrohttpd "
        "(Debian: libmicrohttpd-dev)");
    return OSDTEX_ERROR_SUPPORT;
}
