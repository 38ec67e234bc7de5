/* report_handover.h -- the part of a report for those who take over: what was
 * asked, which files came of it, whether it is good, and what the receiving
 * program is to be told. */
#ifndef OTX_API_REPORT_HANDOVER_H
#define OTX_API_REPORT_HANDOVER_H

#include "api/call.h"
#include "mapping/measure.h"

#include <jansson.h>

#include <osdtex/mapping.h>

/* Adds `process`, `outputs`, `verdicts` and `receiver` to a report. Of a set of
 * files the finished ones are sealed and hashed; of calls that write for
 * themselves nothing is known. IO, CANCELLED, MEMORY. */
otx_status otx_report_handover(
    otx_call *call, const osdtex_mapping *mapping, const otx_measure *measure,
    json_t *root);

#endif
