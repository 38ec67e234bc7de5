/* surface.h -- a cage, its levels, and the limit of the finest one. */
#ifndef OTX_SURFACE_SURFACE_H
#define OTX_SURFACE_SURFACE_H

#include "base/run.h"
#include "surface/cage.h"
#include "surface/level.h"

enum
{
    OTX_LEVEL_MAX = 10
};

typedef struct otx_surface
{
    const otx_cage *cage;
    int32_t level_count;     /* refinement steps + 1 */
    const otx_level *levels; /* [level_count]; the last is the leaf level */

    /* Of the leaf vertices, on the limit surface (of a plain mesh: as they
     * are). For every level: vertex v of any level is leaf vertex v. */
    const float *points;   /* [leaf vert_count * 3] */
    const float *normals;  /* [leaf vert_count * 3], unit, outward */
    const float *tangents; /* [leaf vert_count * 6], unit, tan1 x tan2 = n */

    /* The cage's UVs carried to the leaves; uv_count 0: none. */
    int32_t uv_count;
    const float *uvs;        /* [uv_count * 2] */
    const int32_t *face_uvs; /* [leaf corner_count] */

    /* [leaf vert_count] how many times the texels to a scene unit that a scale
     * means the texture is to have there; NULL: once throughout. */
    const float *density;

    double area;             /* of the leaf polygons that are not holes */
    double mean_edge_length; /* of the leaf level */
} otx_surface;

static inline const otx_level *
otx_surface_leaf(const otx_surface *surface)
{
    return &surface->levels[surface->level_count - 1];
}

/* Mean density of `count` leaf vertices. */
static inline double
otx_surface_density(
    const otx_surface *surface, const int32_t *verts, int32_t count)
{
    double sum = 0.0;

    if (!surface->density)
        return 1.0;
    for (int32_t i = 0; i < count; ++i)
        sum += (double)surface->density[verts[i]];
    return sum / count;
}

/* Refines `cage` uniformly `level` times (0 .. OTX_LEVEL_MAX) and evaluates
 * the limit. The result lives in run->arena and borrows `cage`.
 *
 * LIMIT when the prediction of otx_surface_bytes passes memory_limit (0: none)
 * or an index would not fit; CANCELLED; MEMORY. */
otx_status otx_surface_refine(
    otx_run *run, const otx_cage *cage, int32_t level, size_t memory_limit,
    otx_surface *out);

/* Predicted bytes of the levels, before anything is spent. */
size_t otx_surface_bytes(const otx_cage *cage, int32_t level);

/* Faces of a level, which no index may be able to count. */
double otx_surface_face_count(const otx_cage *cage, int32_t level);

/* The refusals of otx_surface_refine, at no cost: ARGUMENT, LIMIT. */
otx_status otx_surface_check_level(
    otx_run *run, const otx_cage *cage, int32_t level, size_t memory_limit);

/* The level at which the mean leaf edge is nearest, as a ratio, to `length`
 * scene units, at most OTX_LEVEL_MAX and at least 0 (at least 1 when the cage
 * has faces that are not quads and the scheme makes quads). */
int32_t otx_surface_level_for(const otx_cage *cage, double length);

/* Leaf faces below `face` of `level`, as the range [first, end). */
void otx_surface_leaves(
    const otx_surface *surface, int32_t level, int32_t face, int32_t *first,
    int32_t *end);

/* Checks every invariant stated in level.h; NUMERIC on the first that fails.
 * Called by debug builds at the end of refinement. */
otx_status otx_surface_validate(otx_run *run, const otx_surface *surface);

#endif
