/* axis_values.h -- a number from 0 to 1 at every vertex of a surface.
 *
 * Where the slices of a stack go: osdtex_map_options.along says what the words
 * mean. */
#ifndef OTX_API_AXIS_VALUES_H
#define OTX_API_AXIS_VALUES_H

#include "base/run.h"
#include "surface/surface.h"

typedef enum otx_axis_kind
{
    OTX_AXIS_X,
    OTX_AXIS_Y,
    OTX_AXIS_Z,
    OTX_AXIS_CURVATURE,
    OTX_AXIS_RIDGES,
    OTX_AXIS_HOLLOWS,
    OTX_AXIS_OCCLUSION,
    OTX_AXIS_BOUNDARY,
    OTX_AXIS_CREASES,
    OTX_AXIS_RED,
    OTX_AXIS_GREEN,
    OTX_AXIS_BLUE,
    OTX_AXIS_SCATTER,
    OTX_AXIS_COUNT,
    OTX_AXIS_MAP = OTX_AXIS_COUNT /* a picture, which has a name of its own */
} otx_axis_kind;

typedef struct otx_axis
{
    otx_axis_kind kind;
    bool is_reversed;
    double reach; /* scene units at which it is 1; 0: where it is largest; of
                   * SCATTER the way to another value, 0: half the width */
    const char *path; /* of MAP, in the text that was read */
    int32_t slices;   /* of SCATTER: how many values there are; 0: 2 */
} otx_axis;

/* Reads the text of osdtex_map_options.along, NULL being "y". ARGUMENT. */
otx_status otx_axis_parse(otx_run *run, const char *text, otx_axis *out);

/* The values.
 *
 *   width  of the exemplar in scene units: bends are smoothed over a fifth
 *   along  [leaf vert_count] 0 to 1
 *
 * ARGUMENT where the surface has no such edge, CANCELLED, MEMORY, NUMERIC. */
otx_status otx_axis_values(
    otx_run *run, const otx_surface *surface, const otx_axis *axis,
    double width, float *along);

#endif
