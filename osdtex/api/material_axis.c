/* material_axis.c -- by constraints, or by what the surface is like. */
#include "api/material_axis.h"

#include "api/axis_values.h"
#include "method/density.h"

#include <math.h>

static const char STAGE[] = "map";

static bool
asks_for_material(const otx_constraint_set *constraints)
{
    for (int32_t i = 0; constraints && i < constraints->count; ++i)
        if (constraints->items[i].has_material)
            return true;
    return false;
}

/* Of the first stack; 0: there is none. */
static int32_t
slices_of(const osdtex_mapping *handle)
{
    for (int32_t k = 0; k < handle->source_count; ++k)
        if (handle->exemplars[k].slices)
            return handle->exemplars[k].slices->count;
    return 0;
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
otx_material_axis_take(otx_run *run, const char *text, osdtex_mapping *handle)
{
    const otx_constraint_set *constraints = handle->request.constraints;
    const otx_surface *surface = &handle->surface->surface;
    const bool asked = asks_for_material(constraints);
    otx_axis how;
    float *along;

    OTX_TRY(otx_axis_parse(run, text, &how));
    if (slices_of(handle) == 0)
    {
        if (asked && handle->source_count == 1)
            otx_note(
                run, OSDTEX_SEVERITY_WARNING, STAGE, OTX_NOWHERE,
                "constraints name a material, and the exemplar has one only; "
                "give {also} exemplars, or a stack made by `osdtex stack`");
        return OSDTEX_OK;
    }
    how.slices = slices_of(handle);
    along = OTX_NEW(run->arena, float, otx_surface_leaf(surface)->vert_count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(
        asked ? follow(run, surface, constraints, along)
              : otx_axis_values(
                    run, surface, &how, handle->request.scale, along));
    handle->mapping.along = along;
    return OSDTEX_OK;
}
