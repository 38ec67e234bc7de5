/* show_decals.h -- what decals leave of the colour below them.
 *
 * For mapping/show.c, which asks wherever it has found what a face shows. */
#ifndef OTX_MAPPING_SHOW_DECALS_H
#define OTX_MAPPING_SHOW_DECALS_H

#include "mapping/show.h"

/* Puts the decals of a face over a colour, premultiplied and scene-linear,
 * filtered over `share` of the place's footprint.
 *
 *   channels  of `color`: 3, or 4 with alpha */
void otx_show_decals_color(
    const otx_show_view *show, const otx_show_place *place, double share,
    int32_t channels, float *color);

/* The same in CIELAB, unfiltered. */
void otx_show_decals_lab(
    const otx_show_view *show, const otx_show_place *place, float lab[3]);

/* Whether the decals of two faces go on across an edge.
 *
 *   corners  [2][2] of the edge's ends on either face, in the same order */
bool otx_show_decals_go_on(
    const otx_show_view *show, const int32_t faces[2],
    const int32_t corners[2][2]);

#endif
