/* sheet.h -- the UVs of a mapping as elastic sheets.
 *
 * A vertex has one variable for each patch around it. Faces, seams and the
 * rigidity of the sheets are expressed in variables. */
#ifndef OTX_RELAX_SHEET_H
#define OTX_RELAX_SHEET_H

#include "base/run.h"
#include "flatten/rigid.h"
#include "surface/surface.h"

/* The two sides of a leaf edge between patches, ends in the same order. */
typedef struct otx_sheet_seam
{
    int32_t a[2]; /* variables */
    int32_t b[2];
    double length; /* texels */
} otx_sheet_seam;

typedef struct otx_sheet
{
    int32_t face_count;   /* without holes */
    int32_t *first;       /* [face_count + 1] */
    int32_t *corners;     /* variables */
    int32_t *corner_leaf; /* offsets into the leaf level's corners */
    int32_t count;        /* variables */
    int32_t *verts;       /* [count] leaf vertices */
    int32_t *patches;     /* [count] */
    otx_vec2 *at;         /* [count] texels */
    uint8_t *fixed;       /* [count] 1: of a face that is left out, or still,
                           * as well */
    int32_t seam_count;
    otx_sheet_seam *seams;
    otx_rigid rigid;
} otx_sheet;

/* A part of the faces. Seams count where both sides are taken. */
typedef struct otx_sheet_part
{
    const uint8_t *inside; /* [leaf face_count] 1: taken */
    const uint8_t *still;  /* [leaf face_count] 1: fixed; NULL none */
} otx_sheet_part;

/* In run->scratch. MEMORY.
 *
 *   part  NULL: all faces are taken, and none is fixed */
otx_status otx_sheet_build(
    otx_run *run, const otx_surface *surface, double texels,
    const int32_t *face_patch, const otx_sheet_part *part, const otx_vec2 *uvs,
    otx_sheet *out);

/* Copies the variables back to the corners. */
void otx_sheet_store(const otx_sheet *sheet, otx_vec2 *uvs);

#endif
