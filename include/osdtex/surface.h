/* surface.h -- the subdivision hierarchy and the limit of its leaves.
 *
 * osdtex_map() refines by itself. A host that wants to see the surface, or maps
 * it several times, refines it once:
 *
 *     osdtex_surface_options options = osdtex_surface_options_default();
 *     osdtex_surface *surface;
 *
 *     options.level = 4;
 *     osdtex_surface_refine(context, cage, &options, &surface);
 *     map_options.surface = surface;
 *     osdtex_map(context, cage, exemplar, &map_options, &mapping);
 *
 * A surface keeps its cage. It is immutable; contexts may share it. */
#ifndef OSDTEX_SURFACE_H
#define OSDTEX_SURFACE_H

#include <osdtex/cage.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_surface osdtex_surface;

enum
{
    OSDTEX_LEVEL_AUTO = -1,
    OSDTEX_LEVEL_MAX = 10
};

typedef struct osdtex_surface_options
{
    size_t size;
    int32_t level; /* 0 .. OSDTEX_LEVEL_MAX, or OSDTEX_LEVEL_AUTO */
    int32_t reserved;
    /* Scene units that leaf edges are to come to, for OSDTEX_LEVEL_AUTO: see
     * osdtex_exemplar_leaf_edge. 0: a 48th of osdtex_cage_info.default_scale,
     * which suits exemplars of up to 672 texels at the default scale. */
    double leaf_edge;
} osdtex_surface_options;

static inline osdtex_surface_options
osdtex_surface_options_default(void)
{
    osdtex_surface_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    options.level = OSDTEX_LEVEL_AUTO;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_surface_options_init(osdtex_surface_options *out, size_t bytes);

/* The leaf level, on the limit surface. Leaf faces are in the order of the
 * cage's faces; the cage's vertices come first. */
typedef struct osdtex_surface_info
{
    int32_t level; /* refinement steps */
    osdtex_index vert_count;
    osdtex_index face_count;
    osdtex_index corner_count;
    const float *points;            /* [vert_count * 3], less `origin` */
    const float *normals;           /* [vert_count * 3], unit */
    const float *tangents;          /* [vert_count * 6], unit pairs */
    const osdtex_index *face_first; /* [face_count + 1], into corners */
    const osdtex_index *face_verts; /* [corner_count] */
    const osdtex_index *face_cage;  /* [face_count], face of the cage */
    const uint8_t *face_hole;       /* [face_count], 1 hole; NULL none */
    const float *uvs;               /* the cage's, [uv_count * 2] */
    const osdtex_index *face_uvs;   /* [corner_count], NULL none */
    osdtex_index uv_count;
    osdtex_index reserved;
    double area;             /* scene units squared, without holes */
    double mean_edge_length; /* scene units */
    double origin[3];        /* what `points` are relative to: zero, but of a
                              * cage far away from the scene's origin */
} osdtex_surface_info;

/* Refines by OpenSubdiv: 786 432 leaf faces in 0.3 seconds
 * (docs/benchmarks.md), of some 430 bytes each (docs/notes/preflight.md).
 * ARGUMENT, LIMIT (predicted memory over the context's, too many elements),
 * MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_surface_refine(
    osdtex_context *context, const osdtex_cage *cage,
    const osdtex_surface_options *options, osdtex_surface **out);
OSDTEX_API const osdtex_surface_info *
osdtex_surface_describe(const osdtex_surface *surface);
OSDTEX_API void osdtex_surface_destroy(osdtex_surface *surface);

OSDTEX_END_DECLS

#endif
