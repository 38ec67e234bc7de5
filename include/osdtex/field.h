/* field.h -- which way a texture is to run, and how large it is to be.
 *
 * A mapping makes a field by itself where the exemplar has a direction. A host
 * that shows it, lets it be edited, or has one of its own, makes it first:
 *
 *     osdtex_field_options options = osdtex_field_options_default();
 *     osdtex_constraint comb = osdtex_constraint_none();
 *     osdtex_field *field, *edited;
 *
 *     options.follow = "curvature";
 *     osdtex_field_create(context, surface, &options, &field);
 *     comb.face = 17;
 *     comb.direction[1] = 1.0;
 *     osdtex_field_edit(context, field, &comb, 0.5, &edited);
 *     map_options.field = edited;
 *
 * From arrays, such as a groom's:
 *
 *     options.directions = directions;        // 3 floats each
 *     options.direction_count = osdtex_surface_describe(surface)->vert_count;
 *     options.directions_of = OSDTEX_ELEMENT_VERTEX;
 *
 * A field keeps its surface and is immutable: an edit makes another one. A
 * million leaf faces take about a second of processor time
 * (docs/benchmarks.md). */
#ifndef OSDTEX_FIELD_H
#define OSDTEX_FIELD_H

#include <osdtex/surface.h>

OSDTEX_BEGIN_DECLS

typedef struct osdtex_field osdtex_field;

/* Elements of a surface that values can be of. */
typedef int32_t osdtex_element;
enum
{
    OSDTEX_ELEMENT_FACE = 0,      /* of the leaf level, osdtex_surface_info */
    OSDTEX_ELEMENT_CAGE_FACE = 1, /* of the cage: all leaves below it */
    OSDTEX_ELEMENT_VERTEX = 2     /* of the leaf level */
};

typedef struct osdtex_field_options
{
    size_t size;
    const char *constraints; /* a file, JSON or CSV; NULL none */
    /* "smooth", "up", "edges" (the cage's edge loops), "curvature" (least
     * bending) or an axis "X,Y,Z": what the field follows where no constraint
     * says otherwise. NULL: what the file says, else smooth. */
    const char *follow;
    int32_t symmetry;    /* 1 arrow, 2 line, 4 cross; 0: the file's, else 2 */
    int32_t whole_table; /* 1: a CSV needs a line for each of the cage's
                          * faces; 0: what it leaves out is free */
    /* How far the texture's size may give way so that rows can follow the
     * curvature, in octaves; 0: not at all. */
    double octaves;
    /* A field of the host's own, that constraints add to. Directions are in
     * scene axes and of any length, their part along a face counts; where they
     * are zero the field is free. NULL: none. */
    const float *directions; /* [direction_count * 3] */
    osdtex_index direction_count;
    osdtex_element directions_of; /* what each is of */
    /* Factor on the texture's size, 1/16 .. 16, at each vertex of the surface;
     * scales of constraints then say nothing. NULL: none. */
    const float *scales; /* [scale_count] */
    osdtex_index scale_count;
    int32_t reserved;
} osdtex_field_options;

static inline osdtex_field_options
osdtex_field_options_default(void)
{
    osdtex_field_options options = OSDTEX_ZERO;

    options.size = sizeof options;
    return options;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void
osdtex_field_options_init(osdtex_field_options *out, size_t bytes);

/* Where a field has no direction: going round the vertex it turns by 2 pi times
 * the index. */
typedef struct osdtex_singularity
{
    osdtex_index vertex; /* of the surface */
    int32_t reserved;
    double point[3]; /* scene units */
    double index;    /* a multiple of 1 / symmetry, not 0 */
} osdtex_singularity;

/* On the leaf level of the surface. */
typedef struct osdtex_field_info
{
    int32_t symmetry;
    osdtex_index face_count;
    osdtex_index vert_count;
    osdtex_index singularity_count;
    const float *directions; /* [face_count * 3] one of the equal ones,
                              * unit, along the face; 0 on holes */
    const float *scales;     /* [vert_count] factor on the texture's size */
    const float *materials;  /* [vert_count] 0 .. 1 */
    const osdtex_singularity *singularities; /* [singularity_count] */
    double scale_min;
    double scale_max;
} osdtex_field_info;

/* What is asked of the faces below a face of the cage, or around a point.
 */
typedef struct osdtex_constraint
{
    size_t size;
    osdtex_index face; /* of the cage; -1: at the point */
    int32_t has_material;
    double point[3];     /* scene units */
    double radius;       /* around it; the nearest face is held at least */
    double direction[3]; /* scene axes; 0: not asked */
    double scale;        /* factor on the size, 1/16 .. 16; 0: not asked */
    double material;     /* 0 .. 1 */
    /* Of several exemplars the one to be shown, from 1; 0: not asked. Mappings
     * read it, fields do not. */
    int32_t exemplar;
    /* Of edits of a mapping (mapping.h), from 1: those with one number are
     * asked for together, and later numbers after earlier ones. 0: asked for
     * when the mapping is made. Fields do not read it, nor the two below. */
    int32_t edit;
    /* Of an edit: the faces within this many scene units along the surface may
     * change, others do not; 0: half a picture's width beyond what is held. */
    double reach;
    /* Not this texture here: which other one is to be tried, from 1; 0: not
     * asked. */
    int32_t redo;
    int32_t reserved;
} osdtex_constraint;

static inline osdtex_constraint
osdtex_constraint_none(void)
{
    osdtex_constraint constraint = OSDTEX_ZERO;

    constraint.size = sizeof constraint;
    constraint.face = -1;
    return constraint;
}
/* The same for hosts that cannot call inline functions: see osdtex.h. */
OSDTEX_API void osdtex_constraint_init(osdtex_constraint *out, size_t bytes);

/* ARGUMENT (a constraint that cannot be held, with its number), FORMAT, IO,
 * NUMERIC, MEMORY, CANCELLED. */
OSDTEX_API osdtex_status osdtex_field_create(
    osdtex_context *context, const osdtex_surface *surface,
    const osdtex_field_options *options, osdtex_field **out);
/* The field with one constraint more, which changes it nowhere but within
 * `reach` scene units along the surface. The old field stays as it is and may
 * be destroyed first. As osdtex_field_create. */
OSDTEX_API osdtex_status osdtex_field_edit(
    osdtex_context *context, const osdtex_field *field,
    const osdtex_constraint *constraint, double reach, osdtex_field **out);
OSDTEX_API const osdtex_field_info *
osdtex_field_describe(const osdtex_field *field);
/* Writes a line for each face of `level` of the surface, 0 the cage's: its
 * direction, scale and material, as constraints take them. ARGUMENT, IO,
 * MEMORY. */
OSDTEX_API osdtex_status osdtex_field_write(
    osdtex_context *context, const osdtex_field *field, int32_t level,
    const char *path);
OSDTEX_API void osdtex_field_destroy(osdtex_field *field);

OSDTEX_END_DECLS

#endif
