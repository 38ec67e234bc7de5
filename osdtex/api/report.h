/* report.h -- what was done, as JSON for scripts. */
#ifndef OTX_API_REPORT_H
#define OTX_API_REPORT_H

#include "api/call.h"

#include <jansson.h>

enum
{
    /* Of the keys: raised when one is taken away or means something else, not
     * when there are more. docs/report.schema.json describes this one. */
    OTX_REPORT_SCHEMA = 1
};

/* All of docs/report.md. It lives as long as the arena of the call.
 *
 *   windows  that are looked up in the exemplar, see osdtex_report_options
 *
 * MEMORY, CANCELLED. */
otx_status otx_report_build(
    otx_call *call, const osdtex_mapping *mapping, int32_t windows,
    json_t **out);

#endif
