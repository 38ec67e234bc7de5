/* cage.h -- the artist's control mesh, validated.
 *
 * From a file, or from arrays:
 *
 *     osdtex_cage_arrays arrays = osdtex_cage_arrays_none();
 *
 *     arrays.vert_count = 8;
 *     arrays.face_count = 6;
 *     arrays.points = points;         // 8 * 3 floats, scene units
 *     arrays.face_sizes = sizes;      // 6 numbers of corners
 *     arrays.face_verts = verts;      // the corners, counter-clockwise
 *     osdtex_cage_create(context, &arrays, NULL, &cage);
 *     printf("%g wide\n", osdtex_cage_describe(cage)->diagonal);
 *     osdtex_cage_destroy(cage);
 *
 * Vertices and faces keep their order and numbers in all that follows. What is
 * read is checked once, here: a cage that was made can be refined and mapped.
 * Every fault is a finding with file and line, or with the face or vertex of
 * the arrays. A handle is immutable, and may be used by several contexts at the
 * same time. */
#ifndef OSDTEX_CAGE_H
#define OSDTEX_CAGE_H

#include <osdtex/context.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_cage osdtex_cage;

typedef int32_t osdtex_scheme;
enum
{
    OSDTEX_SCHEME_CATMARK = 0,
    OSDTEX_SCHEME_LOOP = 1, /* triangles only */
    OSDTEX_SCHEME_BILINEAR = 2,
    OSDTEX_SCHEME_NONE = 3 /* a plain mesh of triangles or polygons: its
                            * own vertices and faces get UVs, positions
                            * stay as they are; the level is 0 */
};

/* What the file's tag says, else USD's default. */
enum
{
    OSDTEX_UNSET = -1
};

/* What happens at the rim, in USD's words. */
typedef int32_t osdtex_boundary;
enum
{
    OSDTEX_BOUNDARY_NONE = 0,
    OSDTEX_BOUNDARY_EDGE_ONLY = 1,
    OSDTEX_BOUNDARY_EDGE_AND_CORNER = 2 /* USD's default */
};

/* How the cage's UVs are smoothed, in USD's words. */
typedef int32_t osdtex_fvar;
enum
{
    OSDTEX_FVAR_NONE = 0,
    OSDTEX_FVAR_CORNERS_ONLY = 1,
    OSDTEX_FVAR_CORNERS_PLUS1 = 2, /* USD's default */
    OSDTEX_FVAR_CORNERS_PLUS2 = 3,
    OSDTEX_FVAR_BOUNDARIES = 4,
    OSDTEX_FVAR_ALL = 5
};

typedef struct osdtex_cage_options
{
    size_t size;
    osdtex_scheme scheme;
    osdtex_boundary boundary; /* OSDTEX_UNSET: the file's */
    osdtex_fvar fvar;         /* OSDTEX_UNSET: the file's */
    int32_t reserved;
    double weld; /* vertices within this many scene units become the first of
                  * them; 0: none; negative: within a millionth of the bounding
                  * box's diagonal */
} osdtex_cage_options;

static inline osdtex_cage_options
osdtex_cage_options_default(void)
{
    osdtex_cage_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    options.scheme = OSDTEX_SCHEME_CATMARK;
    options.boundary = OSDTEX_UNSET;
    options.fvar = OSDTEX_UNSET;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_cage_options_init(osdtex_cage_options *out, size_t bytes);

/* A cage as arrays, which are read while the call lasts. Counts of 0 need no
 * array. */
typedef struct osdtex_cage_arrays
{
    size_t size;
    osdtex_index vert_count;
    osdtex_index face_count;
    const float *points;            /* [vert_count * 3], scene units */
    const osdtex_index *face_sizes; /* [face_count], 3 or more */
    const osdtex_index *face_verts; /* [sum of face_sizes], 0-based,
                                     * counter-clockwise outside */
    osdtex_index uv_count;
    osdtex_index crease_count;
    const float *uvs;                 /* [uv_count * 2]; NULL none */
    const osdtex_index *face_uvs;     /* [sum of face_sizes]; NULL none */
    const osdtex_index *crease_verts; /* [crease_count * 2] */
    const float *crease_sharpness;    /* [crease_count], 10 is infinite */
    osdtex_index corner_count;
    osdtex_index hole_count;
    const osdtex_index *corner_verts; /* [corner_count] */
    const float *corner_sharpness;    /* [corner_count] */
    const osdtex_index *hole_faces;   /* [hole_count] */
} osdtex_cage_arrays;

static inline osdtex_cage_arrays
osdtex_cage_arrays_none(void)
{
    osdtex_cage_arrays arrays = OSDTEX_ZERO;

    arrays.size = sizeof arrays;
    return arrays;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void osdtex_cage_arrays_init(osdtex_cage_arrays *out, size_t bytes);

typedef struct osdtex_cage_info
{
    const char *path; /* as given, NULL when made from arrays */
    const char *hash; /* of the file's bytes, NULL when made from arrays */
    osdtex_scheme scheme;
    osdtex_boundary boundary; /* as resolved */
    osdtex_fvar fvar;         /* as resolved */
    osdtex_index vert_count;
    osdtex_index face_count;
    osdtex_index edge_count;
    osdtex_index uv_count; /* 0: the cage has no UVs */
    osdtex_index crease_count;
    osdtex_index corner_count; /* sharp vertices */
    osdtex_index hole_count;
    osdtex_index triangle_count;
    osdtex_index quad_count;
    osdtex_index component_count;
    osdtex_index boundary_edge_count;
    osdtex_index material_count;
    osdtex_index group_count;
    double lower[3]; /* of the bounding box, scene units */
    double upper[3];
    double diagonal;         /* of the bounding box */
    double mean_edge_length; /* scene units */
    double default_scale;    /* what a scale of 0 means: diagonal / 5 */
} osdtex_cage_info;

/* Reads an OBJ, its tags for creases, corners and holes, its materials and
 * groups, on one thread. FORMAT (the line),
 * TOPOLOGY (an edge of three faces, a face that repeats a vertex, …), LIMIT (a
 * count beyond 2^31), NUMERIC (a number that is not finite), IO, MEMORY. */
OSDTEX_API osdtex_status osdtex_cage_read(
    osdtex_context *context, const char *path,
    const osdtex_cage_options *options, osdtex_cage **out);
/* The same from arrays. ARGUMENT (an array that is missing, an index that is
 * out of range), and as osdtex_cage_read but for IO. */
OSDTEX_API osdtex_status osdtex_cage_create(
    osdtex_context *context, const osdtex_cage_arrays *arrays,
    const osdtex_cage_options *options, osdtex_cage **out);
/* Lent as long as the handle. NULL for NULL. */
OSDTEX_API const osdtex_cage_info *
osdtex_cage_describe(const osdtex_cage *cage);
OSDTEX_API void osdtex_cage_destroy(osdtex_cage *cage);

OSDTEX_END_DECLS

#endif
