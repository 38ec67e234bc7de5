/* material_axis.c -- by constraints, or by height. */
#include "api/material_axis.h"

#include "method/density.h"

#include <math.h>
#include <string.h>

static const char STAGE[] = "map";

static bool
asks_for_material(const otx_constraint_set *constraints)
{
    for (int32_t i = 0; constraints && i < constraints->count; ++i)
        if (constraints->items[i].has_material)
            return true;
    return false;
}

static bool
has_stack(const osdtex_mapping *handle)
{
    for (int32_t k = 0; k < handle->source_count; ++k)
        if (handle->exemplars[k].slices)
            return true;
    return false;
}

/* Which coordinate, and which way. */
static otx_status
parse(otx_run *run, const char *axis, int *coordinate, double *sign)
{
    const char *letter = axis && *axis == '-' ? axis + 1 : axis ? axis : "y";

    *sign = axis && *axis == '-' ? -1.0 : 1.0;
    *coordinate = letter[0] - 'x';
    if (*coordinate >= 0 && *coordinate <= 2 && letter[1] == '\0')
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
        "{along} is x, y or z, or one of them with a minus, not '%.40s'", axis);
}

static otx_status
climb(otx_run *run, const otx_surface *surface, const char *axis, float *along)
{
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    double low = (double)INFINITY, high = -(double)INFINITY, sign;
    int coordinate;

    OTX_TRY(parse(run, axis, &coordinate, &sign));
    for (int32_t v = 0; v < count; ++v)
    {
        const double at = sign * (double)surface->points[3 * v + coordinate];

        low = fmin(low, at);
        high = fmax(high, at);
    }
    for (int32_t v = 0; v < count; ++v)
    {
        const double at = sign * (double)surface->points[3 * v + coordinate];

        along[v] = high > low ? (float)((at - low) / (high - low)) : 0.0f;
    }
    return OSDTEX_OK;
}

static otx_status
follow(
    otx_run *run, const otx_surface *surface,
    const otx_constraint_set *constraints, float *along)
{
    const int32_t count = otx_surface_leaf(surface)->vert_count;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    double *values;

    OTX_TRY(otx_density_spread(
        run, surface, constraints, OTX_CONSTRAINT_MATERIAL, &values));
    for (int32_t v = 0; v < count; ++v)
        along[v] = (float)fmin(fmax(values[v], 0.0), 1.0);
    otx_arena_release(run->scratch, mark);
    return OSDTEX_OK;
}

otx_status
otx_material_axis_take(otx_run *run, const char *axis, osdtex_mapping *handle)
{
    const otx_constraint_set *constraints = handle->request.constraints;
    const otx_surface *surface = &handle->surface->surface;
    const bool asked = asks_for_material(constraints);
    int coordinate;
    double sign;
    float *along;

    OTX_TRY(parse(run, axis, &coordinate, &sign));
    if (!has_stack(handle))
    {
        if (asked && handle->source_count == 1)
            otx_note(
                run, OSDTEX_SEVERITY_WARNING, STAGE, OTX_NOWHERE,
                "constraints name a material, and the exemplar has one only; "
                "give {also} exemplars, or a stack made by `osdtex stack`");
        return OSDTEX_OK;
    }
    along = OTX_NEW(run->arena, float, otx_surface_leaf(surface)->vert_count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(
        asked ? follow(run, surface, constraints, along)
              : climb(run, surface, axis, along));
    handle->mapping.along = along;
    return OSDTEX_OK;
}
