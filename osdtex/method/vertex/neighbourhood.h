/* neighbourhood.h -- squares of colours around a vertex, and the pixel whose
 * own is nearest [Turk01, sec. 5]. */
#ifndef OTX_METHOD_VERTEX_NEIGHBOURHOOD_H
#define OTX_METHOD_VERTEX_NEIGHBOURHOOD_H

#include "method/vertex/turk.h"

enum
{
    OTX_HOOD_REACH = 3,  /* squares are 7 x 7 */
    OTX_HOOD_MOST = 64,  /* samples */
    OTX_HOOD_BASIS = 15, /* dimensions that bound distances, of each channel */
    OTX_HOOD_HEAD = 3 * OTX_HOOD_BASIS
};

typedef enum otx_hood_kind
{
    OTX_HOOD_SEED,        /* H(7, 0) */
    OTX_HOOD_EXTRAPOLATE, /* F(7, 1) */
    OTX_HOOD_REFINE       /* F(7, 0) and F(3, 1) */
} otx_hood_kind;

/* Samples as steps to the right and down; those of the level come first. */
typedef struct otx_hood
{
    int32_t level;      /* of the pixel */
    int32_t count, own; /* samples, and those of the level itself */
    int8_t right[OTX_HOOD_MOST], down[OTX_HOOD_MOST];
    int32_t bounded; /* samples that `basis` is of, from the first */
    float basis[OTX_HOOD_BASIS][OTX_HOOD_MOST];
} otx_hood;

void otx_hood_set(otx_hood *hood, otx_hood_kind kind, int32_t level);

/* The colours around a vertex: on the surface, by walking right and then down
 * in steps of the level's pixels, twice as far for the coarser ones.
 *
 *   out  [hood->count] */
void otx_hood_gather(
    const otx_turk *t, const otx_hood *hood, int32_t vertex, otx_quad *out);

/* All pixels of a level by what bounds their distance, halved along the widest
 * of its coordinates again and again: a tree whose node i has the children
 * 2 i + 1 and 2 i + 2, and whose leaves are even shares of the pixels. */
typedef struct otx_hood_table
{
    const otx_pattern *pattern;
    const otx_hood *hood;
    float slack; /* what is found is at most 1 + slack times as far as what is
                  * nearest; 0: it is the nearest */
    int32_t count;
    int32_t depth;   /* of the leaves */
    int32_t *pixels; /* [count] */
    float *heads;    /* [count * OTX_HOOD_HEAD] */
    int32_t *axes;   /* [nodes above the leaves] */
    float *splits;   /* likewise */
} otx_hood_table;

/* In run->scratch. Of a picture that does not tile only pixels whose square is
 * inside; of one that is too small for that all. MEMORY. */
otx_status otx_hood_table_build(
    otx_run *run, const otx_pattern *pattern, const otx_hood *hood,
    otx_hood_table *out);

/* The pixel at the least distance, of all: left out are those whose projections
 * are too far already.
 *
 *   guess  a pixel that is thought to be near; -1 none */
int32_t otx_hood_nearest(
    const otx_hood_table *table, const otx_quad *colors, int32_t guess);

#endif
