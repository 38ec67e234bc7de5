/* samples.h -- which parts of the surface are textured already.
 *
 * Every triangle that is rendered carries a lattice of samples, corners and
 * edges with it, closer than the detail of a mask. A face is covered when all
 * of its samples are. */
#ifndef OTX_METHOD_LAPPED_SAMPLES_H
#define OTX_METHOD_LAPPED_SAMPLES_H

#include "math/vec.h"
#include "surface/facet.h"
#include "surface/surface.h"

enum
{
    OTX_SAMPLES_STEPS_MAX = 32 /* of the side of a triangle */
};

typedef struct otx_samples
{
    const otx_surface *surface;
    const otx_level *leaf;
    int64_t *first;   /* [leaf face_count + 1] samples of a face */
    uint8_t *steps;   /* [leaf face_count] of its triangles' sides */
    uint8_t *covered; /* [samples] */
    float *shown;     /* [samples * 3] Lab of what lies on top there */
    int32_t *open;    /* [leaf face_count] samples that are not covered */
    int64_t left;     /* of all faces */
    /* [OTX_SAMPLES_STEPS_MAX + 1] weights of corners 1 and 2, row by row */
    otx_vec2 *lattice[OTX_SAMPLES_STEPS_MAX + 1];
} otx_samples;

/* A sample as weights of three corners of its face. */
typedef struct otx_sample_place
{
    int32_t corners[3]; /* of the level */
    double at[3];
} otx_sample_place;

/* All uncovered but holes, in run->scratch.
 *
 *   texels   per scene unit, before the surface's density
 *   spacing  texels from sample to sample */
otx_status otx_samples_create(
    otx_run *run, const otx_surface *surface, double texels, double spacing,
    otx_samples *out);

static inline int32_t
otx_samples_count(const otx_samples *cover, int32_t face)
{
    return (int32_t)(cover->first[face + 1] - cover->first[face]);
}

/* Sample `index` of a face. */
otx_sample_place
otx_samples_at(const otx_samples *cover, int32_t face, int32_t index);

/* Samples of each of a face's triangles. */
int32_t otx_samples_facet(const otx_samples *cover, int32_t face);

/* Marks sample `index` of all, one of the face's, as covered. Whether it was
 * not; `left` is the caller's to count, since faces may be marked by several
 * threads. */
bool otx_samples_set(const otx_samples *cover, int32_t face, int64_t index);

#endif
