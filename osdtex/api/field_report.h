/* field_report.h -- what a report says about fields. */
#ifndef OTX_API_FIELD_REPORT_H
#define OTX_API_FIELD_REPORT_H

#include "api/handle.h"

#include <jansson.h>

/* Adds "field" to a report where the mapping follows one: its singularities
 * with place and index, the angle between it and the texture, the range of the
 * texture's size. MEMORY. */
otx_status
otx_field_report_add(otx_run *run, const osdtex_mapping *mapping, json_t *root);

#endif
