/* exemplar_handle.h -- reading exemplars as others were read. */
#ifndef OTX_API_EXEMPLAR_HANDLE_H
#define OTX_API_EXEMPLAR_HANDLE_H

#include "api/handle.h"

/* As osdtex_exemplar_read. Where `cuts` is not NULL, they are made instead of
 * looked for; a picture of another size is refused. Copies them.
 *
 *   linear_only  what is compared is not made */
osdtex_status otx_exemplar_handle_read(
    osdtex_context *context, const char *path,
    const osdtex_exemplar_options *options, const otx_exemplar_cuts *cuts,
    bool linear_only, osdtex_exemplar **out);

#endif
