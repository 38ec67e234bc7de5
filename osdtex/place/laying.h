/* laying.h -- pictures while they are put where they were asked for.
 *
 * Inside of the room: place.c lays out what has a place of its own, scatter.c
 * what may lie anywhere, lay_down.c one picture at one spot. */
#ifndef OTX_PLACE_LAYING_H
#define OTX_PLACE_LAYING_H

#include "place/footprint.h"
#include "place/place.h"

/* A decal that is laid out, in run->scratch. */
typedef struct otx_laid
{
    int32_t item;
    int32_t face_count;
    int32_t *faces; /* of the leaf level, in the order of the chart */
    int32_t *first; /* [face_count + 1] */
    float *uvs;     /* [first[face_count] * 2] */
    otx_vec3 point;
    double radius; /* half its diagonal, scene units */
} otx_laid;

typedef struct otx_laying
{
    otx_run *run;
    const otx_surface *surface;
    const otx_place_list *list;
    otx_footprint_space space;
    otx_laid *laid; /* [laid_count] of [laid_most] */
    int32_t laid_count, laid_most;
    double *areas; /* [leaf face_count] sums up to each face; where scattered */
    otx_place_figures figures;
    double weight; /* area of all decals */
} otx_laying;

/* What sentences call an item's picture, and where they say it is.
 *
 *   face  of the cage; -1 none */
const char *otx_laying_name(const otx_laying *p, const otx_place_item *item);
otx_where otx_laying_where(const otx_laying *p, int32_t face);

/* Scene units of a picture's height to those of its width. */
double otx_laying_aspect(const otx_laying *p, const otx_place_item *item);

/* Lays item `index` out at a spot, and keeps it.
 *
 *   turn       radians, counter-clockwise
 *   only_good  what hangs over, or is stretched, is left out; else it is said
 *   kept       out: whether it was kept
 *
 * As otx_place_all. */
otx_status otx_laying_lay_down(
    otx_laying *p, int32_t index, const otx_spot *spot, double turn,
    bool only_good, bool *kept);

/* Lays down as many of item `index` as it asks for and as there is room for.
 * MEMORY, CANCELLED. */
otx_status otx_laying_scatter(otx_laying *p, int32_t index);

#endif
