/* seam_edge.h -- what an edge that the texture is cut at shows, the same from
 * both sides. */
#ifndef OTX_BAKE_SEAM_EDGE_H
#define OTX_BAKE_SEAM_EDGE_H

#include "bake/mip_level.h"
#include "bake/raster.h"
#include "bake/rim_chain.h"
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
    int32_t rim;       /* of the mip; -1: none as yet */
    bool goes_on;      /* the mapping, on both sides of it */
    otx_mip_rim place; /* of the rim */
    otx_vec2 ends[2];  /* texels of the mip */
    double step;       /* the edge's share that the larger texel has */
    otx_seam_fit_side sides[2];
    /* Of heights in an atlas: how it lies, and where both sides have other
     * texels the parts that it is linear between the middles of; 0 theirs. */
    otx_rim_way way;
    int32_t parts;
    otx_rim_chain chain;
    /* What it shows where it was asked last, as a share of the way. */
    double known_at;
    float known[OTX_IMAGE_MAX_CHANNELS];
} otx_seam_fit_edge;

/* Places an edge: `rim` of the mip. */
void
otx_seam_edge_set(const otx_seam_fit *fit, int32_t rim, otx_seam_fit_edge *out);

/* What texels are to show at fraction t of the way: what both sides do, in the
 * mean over a texel of it. At an end heights are those of the vertex. */
void otx_seam_edge_show(
    const otx_seam_fit *fit, const otx_seam_fit_edge *edge, double t,
    float *out);

/* Whether a diagonal rim ends where this one does, at fraction t of the way:
 * the sharp corner of half a block. */
bool otx_seam_edge_is_sharp(
    const otx_seam_fit *fit, const otx_seam_fit_edge *edge, double t);

#endif
