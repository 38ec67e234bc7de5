/* field_given.c -- a field that the host has, as the library keeps one. */
#include "api/field_given.h"

#include <math.h>

static const char STAGE[] = "field";

/* As constraints may ask for. */
static const double SCALE_MAX = 16.0;

/* ---- from arrays --------------------------------------------------------- */

static const char *
element_name(osdtex_element of)
{
    return of == OSDTEX_ELEMENT_VERTEX      ? "vertices of the surface"
           : of == OSDTEX_ELEMENT_CAGE_FACE ? "faces of the cage"
                                            : "faces of the surface";
}

static int32_t
element_count(const otx_surface *surface, osdtex_element of)
{
    const otx_level *leaf = otx_surface_leaf(surface);

    return of == OSDTEX_ELEMENT_VERTEX      ? leaf->vert_count
           : of == OSDTEX_ELEMENT_CAGE_FACE ? surface->levels[0].face_count
                                            : leaf->face_count;
}

static otx_status
check_directions(
    otx_run *run, const otx_surface *surface,
    const osdtex_field_options *options)
{
    const int32_t wanted = element_count(surface, options->directions_of);
    const char *name = element_name(options->directions_of);

    if (options->directions_of < OSDTEX_ELEMENT_FACE ||
        options->directions_of > OSDTEX_ELEMENT_VERTEX)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "directions are of faces, of faces of the cage or of vertices");
    if (options->direction_count != wanted)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "there are %d directions for %d %s", (int)options->direction_count,
            (int)wanted, name);
    for (int64_t i = 0; i < 3 * (int64_t)wanted; ++i)
        if (!isfinite(options->directions[i]))
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                "direction %d is not finite", (int)(i / 3));
    return OSDTEX_OK;
}

static otx_vec3
direction_at(const osdtex_field_options *options, int32_t i)
{
    return otx_vec3_load(options->directions, i);
}

/* What the vertices of a face say together: the mean of those of its corners,
 * of which the equal ones of a symmetry count as one. */
static otx_vec3
mean_at(
    const otx_connection *c, int32_t symmetry,
    const osdtex_field_options *options, int32_t face)
{
    const otx_level *level = c->level;
    otx_vec2 sum = {0, 0};

    for (int32_t i = level->face_first[face]; i < level->face_first[face + 1];
         ++i)
    {
        const otx_vec3 d = direction_at(options, level->face_verts[i]);

        if (otx_vec3_length(d) > 0.0)
            sum = otx_vec2_add(
                sum, otx_direction_power(
                         otx_connection_project(c, face, otx_vec3_unit(d)),
                         symmetry));
    }
    if (!(otx_vec2_length(sum) > 0.0))
        return (otx_vec3){0, 0, 0};
    return otx_connection_lift(
        c, face, otx_vec2_polar(atan2(sum.y, sum.x) / symmetry));
}

static otx_status
read_directions(
    otx_run *run, const otx_connection *c, int32_t symmetry,
    const osdtex_field_options *options, otx_constraint_field *out)
{
    const otx_level *leaf = c->level;
    otx_vec3 *directions;

    OTX_TRY(check_directions(run, c->surface, options));
    directions = OTX_NEW(run->arena, otx_vec3, leaf->face_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        directions[f] =
            options->directions_of == OSDTEX_ELEMENT_VERTEX
                ? mean_at(c, symmetry, options, f)
                : direction_at(
                      options, options->directions_of == OSDTEX_ELEMENT_FACE
                                   ? f
                                   : leaf->face_cage[f]);
    out->directions = directions;
    return OSDTEX_OK;
}

static otx_status
read_scales(
    otx_run *run, const otx_connection *c, const osdtex_field_options *options,
    otx_constraint_field *out)
{
    const int32_t wanted = c->level->vert_count;
    double *values = OTX_NEW(run->arena, double, wanted);

    OTX_TRY(otx_run_ok(run));
    if (options->scale_count != wanted)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "there are %d scales for %d vertices of the surface",
            (int)options->scale_count, (int)wanted);
    for (int32_t v = 0; v < wanted; ++v)
    {
        const double scale = (double)options->scales[v];

        /* Written so that NaN is refused too. */
        if (!(scale >= 1.0 / SCALE_MAX && scale <= SCALE_MAX))
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                "scale %d is %g, outside 1/16 .. 16", (int)v, scale);
        values[v] = -log(scale);
    }
    out->log_scale = values;
    return OSDTEX_OK;
}

otx_status
otx_field_given_read(
    otx_run *run, const otx_connection *connection, int32_t symmetry,
    const osdtex_field_options *options, otx_constraint_field *out)
{
    *out = (otx_constraint_field){0};
    if (options->directions)
        OTX_TRY(read_directions(run, connection, symmetry, options, out));
    return options->scales ? read_scales(run, connection, options, out)
                           : OSDTEX_OK;
}

/* ---- for a mapping ------------------------------------------------------- */

/* NULL where all sizes are the same. */
static otx_status
sizes_of(otx_run *run, const osdtex_field *field, const double **out)
{
    double *values;

    *out = NULL;
    if (field->info.scale_min == 1.0 && field->info.scale_max == 1.0)
        return OSDTEX_OK;
    values = OTX_NEW(run->arena, double, field->info.vert_count);
    OTX_TRY(otx_run_ok(run));
    for (int32_t v = 0; v < field->info.vert_count; ++v)
        values[v] =
            field->asked_scale[v] + otx_scale_value(&field->correction, v);
    *out = values;
    return OSDTEX_OK;
}

otx_status
otx_field_given_constraints(
    otx_run *run, const osdtex_field *field, const otx_constraint_set **out)
{
    otx_constraint_set *set = OTX_NEW(run->arena, otx_constraint_set, 1);
    otx_constraint *items =
        OTX_NEW(run->arena, otx_constraint, field->set.count);

    OTX_TRY(otx_run_ok(run));
    *set = field->set;
    set->symmetry = field->direction.symmetry;
    set->follow = OTX_FOLLOW_NOTHING;
    set->is_table = false;
    set->field.directions = field->guide.directions;
    OTX_TRY(sizes_of(run, field, &set->field.log_scale));
    /* The field holds what they ask of it. */
    for (int32_t i = 0; i < set->count; ++i)
    {
        items[i] = field->set.items[i];
        items[i].has_direction = false;
        items[i].scale = 0.0;
    }
    set->items = items;
    *out = set;
    return OSDTEX_OK;
}
