/* piece.h -- the leaves below one cluster, flattened by themselves: the control
 * polygon, and everything below relative to it [Soler02, eq. 1]. */
#ifndef OTX_FLATTEN_PIECE_H
#define OTX_FLATTEN_PIECE_H

#include "cluster/controls.h"
#include "flatten/chart.h"

typedef struct otx_piece
{
    const otx_chart_request *request;
    const otx_controls *controls; /* NULL: of single faces alone */
    otx_cluster cluster;
    int32_t corner_count; /* control vertices */
    int32_t *polygon;     /* [corner_count] them, counter-clockwise */
    int32_t leaf_count;
    int32_t *leaves; /* [leaf_count] ascending */
    int32_t *first;  /* [leaf_count + 1] offsets into corners */
    int32_t *corners;
    int32_t vert_count;
    int32_t *verts;      /* [vert_count] leaf vertices */
    otx_vec2 *flat;      /* [vert_count] texels */
    double *value;       /* [vert_count] position values; NULL: not asked for */
    const int32_t *slot; /* while it is made: the space's numbers */
    otx_vec2 *seen;      /* room for the corners of anything below, ... */
    double *weights;     /* ... and for their coordinates */
} otx_piece;

/* A side of a cluster, from control vertex to control vertex, and who is
 * beyond it. */
typedef struct otx_side
{
    int32_t ends[2];
    int32_t face; /* the cluster beyond, where it is a single face */
    otx_cluster beyond;
} otx_side;

/* Flattens a cluster: one face of any level, or a region of controls->tree.
 *
 *   side  for position values; NULL: none are wanted
 *   out   with corner_count < 3 and no more where the cluster has no polygon
 *
 * In `scratch`. MEMORY, without a finding. */
otx_status otx_piece_make(
    const otx_chart_request *request, const otx_controls *controls,
    const otx_cluster *cluster, const otx_side *side, otx_chart_space *space,
    otx_arena *scratch, otx_piece *out);

/* The sides that have a neighbour: *out[count], in `scratch`. MEMORY, without a
 * finding. */
otx_status otx_piece_sides(
    const otx_piece *piece, otx_arena *scratch, otx_side **out, int32_t *count);

#endif
