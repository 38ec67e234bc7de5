/* colour_support.h -- configurations that the tests of colour share. */
#ifndef OTX_TESTS_COLOUR_SUPPORT_H
#define OTX_TESTS_COLOUR_SUPPORT_H

#include "colour/decoder.h"
#include "colour/primaries.h"
#include "support.h"

#include <math.h>
#include <unistd.h>

#define CG SHARED_DATA "/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio"
#define MINI SHARED_DATA "/ocio/mini_rec709_v2.0.ocio"
#define DEMO SHARED_DATA "/ocio/ocio-v2_demo.ocio"
#define HOSTILE SHARED_DATA "/hostile/"

#define REC709                                                                 \
    {                                                                          \
        0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F             \
    }
#define ODD                                                                    \
    {                                                                          \
        0.60F, 0.33F, 0.25F, 0.60F, 0.15F, 0.10F, 0.3127F, 0.3290F             \
    }

static inline int32_t
warning_count(const otx_run *run)
{
    int32_t count = 0;

    for (int32_t i = 0; i < otx_diagnostics_count(run->diagnostics); ++i)
    {
        osdtex_diagnostic d;
        otx_diagnostics_get(run->diagnostics, i, &d);
        if (d.severity == OSDTEX_SEVERITY_WARNING)
            count += (int32_t)d.count;
    }
    return count;
}

#endif
