/* edge.h -- an edge of the surface, as its two faces show it.
 *
 * A leaf edge has two sides, each with UVs of its own at the edge's two ends.
 * Both sides are continuous when these are the same place of the exemplar;
 * else the edge is a seam, which is looked at by samples along it. Whoever
 * measures, cuts or closes seams takes corners, lengths and counts from here,
 * so that all mean the same edge. See docs/notes/measure.md. */
#ifndef OTX_SEAM_EDGE_H
#define OTX_SEAM_EDGE_H

#include "exemplar/exemplar.h"
#include "image/view.h"
#include "surface/surface.h"

/* Texel distance below which two UVs are the same: float UVs of a picture of
 * 2^15 texels are exact to 2^-9. */
#define OTX_SEAM_TOLERANCE 4e-3

enum
{
    OTX_SEAM_SAMPLES_MAX = 1 << 16 /* on one edge */
};

/* Corners of `face` at the two ends of `edge`, in the order of edge_verts, as
 * offsets into the level's corners. */
void otx_seam_corners(
    const otx_level *level, int32_t edge, int32_t face, int32_t corners[2]);

/* Whether two sides of an edge are continuous: they agree, or differ by whole
 * pictures along axes in which the exemplar tiles. NaN is a seam.
 *
 *   a, b   texel positions of the two ends, in the same order */
bool otx_seam_continuous(
    const otx_exemplar *exemplar, const otx_vec2 a[2], const otx_vec2 b[2]);

/* Length of a leaf edge in scene units. */
static inline double
otx_seam_edge_length(const otx_surface *surface, int32_t edge)
{
    const int32_t *verts =
        otx_surface_leaf(surface)->edge_verts + 2 * (size_t)edge;

    return otx_vec3_length(otx_vec3_sub(
        otx_vec3_load(surface->points, verts[1]),
        otx_vec3_load(surface->points, verts[0])));
}

/* Samples for an edge of `length` texels: one a texel, at least 2, at most
 * OTX_SEAM_SAMPLES_MAX. Sample i of n lies at (i + 1/2) / n of the edge. */
int32_t otx_seam_sample_count(double length);

/* Colours of a picture along one side of an edge, at its samples.
 *
 *   image   3 channels
 *   side    texel positions of the two ends
 *   offset  texels to the left of side[0] -> side[1]
 *   colors  [count * 3] */
static inline void
otx_seam_sample(
    const otx_image *image, bool wrap_x, bool wrap_y, const otx_vec2 side[2],
    double offset, int32_t count, float *colors)
{
    otx_view_line(
        otx_view_of(image, wrap_x, wrap_y), side, offset, count, colors);
}

#endif
