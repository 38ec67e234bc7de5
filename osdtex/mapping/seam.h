/* seam.h -- where a mapping is not continuous, and how much that shows.
 *
 * A leaf edge between two faces is continuous when both faces give its ends
 * the same UVs, or UVs that differ by whole pictures along axes in which the
 * exemplar tiles. Everything else is a seam, whatever the patches are called.
 * A seam is judged by the colours that its two sides show along it.
 * See docs/notes/measure.md. */
#ifndef OTX_MAPPING_SEAM_H
#define OTX_MAPPING_SEAM_H

#include "exemplar/exemplar.h"
#include "mapping/source.h"

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

/* Whether two sides of an edge are continuous.
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

/* Samples for an edge of `length` texels: one a texel, at least 2. */
int32_t otx_seam_sample_count(double length);

/* Colours of a picture along one side of an edge, at the middles of `count`
 * equal pieces.
 *
 *   image   3 channels
 *   side    texel positions of the two ends
 *   offset  texels to the left of side[0] -> side[1]
 *   colors  [count * 3] */
void otx_seam_sample(
    const otx_image *image, bool wrap_x, bool wrap_y, const otx_vec2 side[2],
    double offset, int32_t count, float *colors);

/* The seams of a finished mapping, in ascending order of leaf edges. Where two
 * exemplars meet is a transition, whatever it shows. */
typedef struct otx_seam_list
{
    int32_t edge_count;
    const int32_t *edges;        /* [edge_count], leaf edges */
    const uint8_t *transition;   /* [edge_count], 1 between two exemplars */
    const double *lengths;       /* [edge_count], texels on the surface */
    const int32_t *sample_first; /* [edge_count + 1] */
    const float *samples;        /* Delta E (CIELAB 1976) across the seam */
    double total_length;         /* of the seams, texels on the surface... */
    double transition_length;    /* ... and of the transitions among them */
    double interior_length; /* of all leaf edges between two covered faces */
} otx_seam_list;

/* Texels per scene unit that the mapping asks for. */
double
otx_seam_density(const otx_mapping *mapping, const otx_exemplar *exemplars);

/* Whether a leaf face has a patch and finite UVs, and is not a hole. */
bool otx_seam_covered(const otx_mapping *mapping, int32_t face);

/* UV of a leaf corner in texels of the exemplar that its face shows. */
otx_vec2 otx_seam_texel(
    const otx_mapping *mapping, const otx_exemplar *exemplar, int32_t corner);

/* Finds and samples the seams between covered faces that are not holes. The
 * list lives in run->arena. MEMORY, LIMIT when the samples pass 2^31. */
otx_status otx_seam_collect(
    otx_run *run, const otx_mapping *mapping, const otx_exemplar *exemplars,
    otx_seam_list *out);

#endif
