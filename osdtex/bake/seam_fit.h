/* seam_fit.h -- both sides of a cut in the texture show the same along it.
 *
 * A renderer that comes to a rim looks up half of what it shows in the margin.
 * Seen from the two sides of an edge, texels lie differently, and what is
 * between them comes out differently: a step along the edge. Therefore what
 * the edge shows is settled first, from both sides, and the texels around it
 * are moved so that lookups on it find that. See docs/notes/bake.md. */
#ifndef OTX_BAKE_SEAM_FIT_H
#define OTX_BAKE_SEAM_FIT_H

#include "bake/mip_level.h"
#include "bake/raster.h"
#include "bake/sharpen.h"
#include "image/texture.h"
#include "mapping/show.h"

/* Texels of a block, and what is known of them. */
typedef struct otx_seam_fit
{
    const otx_mapping *mapping;
    const otx_show_view *show;
    const otx_texture *textures; /* of the exemplars, by otx_source_of() */
    const otx_mip *mip;
    const otx_raster *raster;
    const otx_raster_near *near_rim, *near_seam; /* near_seam: blended ones */
    const otx_sharpen_grid *grid;                /* the raster's texels */
    const float *low, *high; /* [grid->channels] no texel leaves these */
    /* The grid is the heights that show->carry carries over: a displaced
     * surface must not open, so both sides are made one wherever the surface
     * goes on, and nothing is held. False: colours. */
    bool welds;
} otx_seam_fit;

/* One face's view of an edge: the side of a facet from corner 0 to corner 1,
 * which the other face sees backwards. */
typedef struct otx_seam_fit_side
{
    int32_t face, exemplar;
    int32_t corners[3];
    double dx[3]; /* barycentric: along the edge, a sample's share of a texel */
    double dy[3]; /* away from it, two texels */
    bool layered;
    /* Where it is not layered, in the exemplar: */
    otx_vec2 uv, along; /* the start, from there to the end */
    otx_texture_probes probes;
} otx_seam_fit_side;

/* An edge, found out once for all texels by it. */
typedef struct otx_seam_fit_edge
{
    int32_t rim;      /* of the mip; -1: none as yet */
    bool goes_on;     /* the mapping, on both sides of it */
    otx_vec2 ends[2]; /* texels of the mip */
    double step;      /* the edge's share that the larger texel has */
    otx_seam_fit_side sides[2];
    /* What it shows where it was asked last, as a share of the way. */
    double known_at;
    float known[OTX_IMAGE_MAX_CHANNELS];
} otx_seam_fit_edge;

/* The texel (x, y) of the raster, all channels: where a rim is within a texel
 * of its centre with its share of what a lookup there lacks or has too much,
 * else as it is.
 *
 *   edge  the rim met last, kept from call to call */
void otx_seam_fit_texel(
    const otx_seam_fit *fit, int32_t x, int32_t y, otx_seam_fit_edge *edge,
    float *out);

#endif
