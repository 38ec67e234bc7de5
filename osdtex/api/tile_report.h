/* tile_report.h -- the part of the report that is about tiles. */
#ifndef OTX_API_TILE_REPORT_H
#define OTX_API_TILE_REPORT_H

#include "api/handle.h"

#include <jansson.h>

/* Adds the object "tiles" to `root` where the exemplar is a tiled texture: how
 * far tiles differ where they meet, at every mip level, and how evenly they
 * are used. */
otx_status
otx_tile_report_add(otx_run *run, const osdtex_mapping *mapping, json_t *root);

#endif
