/* status.h -- status codes inside the library are the public ones.
 *
 * OTX_TRY is the only control-flow macro of the tree. Stages allocate from
 * arenas, so returning early never leaks. */
#ifndef OTX_BASE_STATUS_H
#define OTX_BASE_STATUS_H

#include <osdtex/common.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef osdtex_status otx_status;

#define OTX_TRY(expression)                                                    \
    do                                                                         \
    {                                                                          \
        const otx_status otx_try_status = (expression);                        \
        if (otx_try_status != OSDTEX_OK)                                       \
            return otx_try_status;                                             \
    } while (0)

#define OTX_PI 3.14159265358979323846

#if defined(__GNUC__)
#define OTX_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define OTX_PRINTF(text, first)
#endif

#endif
