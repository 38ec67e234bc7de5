/* density.c -- from scales at some places to a density at every leaf vertex.
 *
 * Harmonic between the places that are given, on a level of moderate size, and
 * by means of edges and faces from there to the leaves: it is smooth, so a
 * finer solve would not show. */
#include "method/density.h"

#include <math.h>

enum
{
    FACES_MAX = 24000 /* of the level that is solved on */
};

static bool
asks_for_scale(const otx_constraint_set *set)
{
    if (set && set->field.log_scale)
        return true;
    for (int32_t i = 0; set && i < set->count; ++i)
        if (set->items[i].scale > 0.0)
            return true;
    return false;
}

/* Values of the vertices that are born from a level. */
static void
refine_values(const otx_level *level, double *values)
{
    for (int32_t e = 0; e < level->edge_count; ++e)
        values[level->edge_child_vert[e]] =
            0.5 * (values[level->edge_verts[2 * (size_t)e]] +
                   values[level->edge_verts[2 * (size_t)e + 1]]);
    for (int32_t f = 0; f < level->face_count; ++f)
    {
        const int32_t size = otx_level_face_size(level, f);
        double sum = 0.0;

        if (level->face_child_vert[f] < 0)
            continue;
        for (int32_t k = 0; k < size; ++k)
            sum += values[level->face_verts[level->face_first[f] + k]];
        values[level->face_child_vert[f]] = sum / size;
    }
}

otx_status
otx_density_spread(
    otx_run *run, const otx_surface *surface,
    const otx_constraint_set *constraints, otx_constraint_kind kind,
    double **out)
{
    const int32_t last = surface->level_count - 1;
    double *values =
        OTX_ZNEW(run->scratch, double, otx_surface_leaf(surface)->vert_count);
    otx_connection *connection = OTX_NEW(run->arena, otx_connection, 1);
    int32_t level = last;

    OTX_TRY(otx_run_ok(run));
    while (level > 0 && surface->levels[level].face_count > FACES_MAX)
        --level;
    OTX_TRY(otx_connection_build(run, surface, level, connection));
    OTX_TRY(otx_constraint_interpolate(
        run, constraints, connection, kind, NULL, values));
    for (; level < last; ++level)
        refine_values(&surface->levels[level], values);
    *out = values;
    return OSDTEX_OK;
}

otx_status
otx_density_apply(
    otx_run *run, const otx_surface *surface,
    const otx_constraint_set *constraints, const otx_surface **out)
{
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    otx_surface *scaled;
    float *density;
    double *values = NULL;

    *out = surface;
    if (!asks_for_scale(constraints))
        return OSDTEX_OK;
    scaled = OTX_NEW(run->arena, otx_surface, 1);
    density = OTX_NEW(run->arena, float, count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(otx_density_spread(
        run, surface, constraints, OTX_CONSTRAINT_SCALE, &values));
    for (int32_t v = 0; v < count; ++v)
        density[v] = (float)exp(values[v]);
    *scaled = *surface;
    scaled->density = density;
    *out = scaled;
    return OSDTEX_OK;
}
