/* several.c -- the exemplars of a mapping, and where each goes.
 *
 * Patches of different exemplars are fitted to each other, so all are compared
 * in one space and at as many texels to a scene unit; and they end in one
 * texture when they are baked, so all are in one linear space. */
#include "api/several.h"

#include "api/call.h"
#include "api/exemplar_names.h"
#include "api/mask_pictures.h"
#include "method/demand.h"
#include "seam/unit.h"

#include <math.h>
#include <string.h>

static const char STAGE[] = "mask";

static const char *
name_of(const osdtex_exemplar *exemplar)
{
    const char *path = exemplar->exemplar.source_path;

    return path ? path : "in memory";
}

static otx_status
check_spaces(
    otx_run *run, const osdtex_exemplar *first, const osdtex_exemplar *other)
{
    const otx_exemplar *a = &first->exemplar, *b = &other->exemplar;
    const otx_where where = {b->source_path, 0, -1, -1};

    if (b->tiles.cell > 0 || a->tiles.cell > 0)
        return otx_fail(
            run, OSDTEX_ERROR_SUPPORT, STAGE, where,
            "a tiled texture cannot be one of several exemplars");
    if (strcmp(a->linear_space, b->linear_space) != 0)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "the exemplars are written in two spaces, '%.80s' and '%.80s'; "
            "give the one that both are to be in with {to}",
            a->linear_space, b->linear_space);
    if (strcmp(a->match_space, b->match_space) != 0 ||
        a->embedding != b->embedding)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
            "the exemplars cannot be compared: one is in '%.80s', the other in "
            "'%.80s' (%s, %s)",
            a->match_space, b->match_space, otx_embedding_name(a->embedding),
            otx_embedding_name(b->embedding));
    return OSDTEX_OK;
}

static otx_status
check(
    otx_run *run, const osdtex_map_options *options,
    const osdtex_mapping *handle)
{
    if (options->also_count < 0 || (options->also_count > 0 && !options->also))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "exemplars are counted and none are given");
    if (options->also_count >= OTX_EXEMPLARS_MAX)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "%d exemplars are given; a mapping takes up to %d",
            (int)options->also_count + 1, OTX_EXEMPLARS_MAX);
    if (options->also_count == 0 &&
        (options->mask || options->mask_image || options->face_exemplars))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "a mask divides the surface between exemplars, and one is given; "
            "give the others with {also}");
    for (int32_t k = 0; k < options->also_count; ++k)
    {
        const osdtex_also *also = &options->also[k];

        if (!also->exemplar || !(also->scale >= 0.0) || isinf(also->scale))
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                "exemplar %d is missing, or its scale is no positive number",
                (int)k + 2);
        if (also->exemplar->exemplar.mixes_maps ||
            handle->exemplar->exemplar.mixes_maps)
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
                "of several exemplars the colours are matched, which mean the "
                "same in each; leave {match-maps} away");
        OTX_TRY(check_spaces(run, handle->exemplar, also->exemplar));
    }
    return OSDTEX_OK;
}

/* One more exemplar at the first's texels to a unit. */
static otx_status
take_exemplar(
    otx_run *run, const osdtex_also *also, const osdtex_mapping *handle,
    otx_exemplar *out)
{
    const otx_exemplar *from = &also->exemplar->exemplar;
    const double texels =
        otx_unit_texels(&handle->exemplar->exemplar, handle->request.scale);
    const double width = also->scale > 0.0 ? floor(also->scale * texels + 0.5)
                                           : from->match.width;
    const double height =
        floor(width * from->match.height / from->match.width + 0.5);

    *out = *from;
    if (width == from->match.width)
        return OSDTEX_OK;
    if (width > OTX_IMAGE_MAX_SIDE || height > OTX_IMAGE_MAX_SIDE)
        return otx_fail(
            run, OSDTEX_ERROR_LIMIT, STAGE, otx_where_file(from->source_path),
            "its scale of %g makes the picture more than %d texels of the "
            "first exemplar's size wide or high",
            also->scale, OTX_IMAGE_MAX_SIDE);
    return otx_exemplar_resize(run, from, (int32_t)width, (int32_t)height, out);
}

static otx_status
take_exemplars(
    otx_run *run, const osdtex_map_options *options, osdtex_mapping *handle)
{
    otx_exemplar *list =
        OTX_NEW(run->arena, otx_exemplar, options->also_count + 1);

    OTX_TRY(otx_run_ok(run));
    list[0] = handle->exemplar->exemplar;
    handle->sources[0] = handle->exemplar;
    for (int32_t k = 0; k < options->also_count; ++k)
    {
        handle->sources[k + 1] = options->also[k].exemplar;
        OTX_TRY(take_exemplar(run, &options->also[k], handle, &list[k + 1]));
        OTX_TRY(otx_call_hold(run, options->also[k].exemplar->arena));
    }
    handle->exemplars = list;
    handle->source_count = options->also_count + 1;
    return OSDTEX_OK;
}

/* -- where ------------------------------------------------------------- */

/* Everything that says where, each over what came before. */
static otx_status
collect(
    otx_run *run, const osdtex_map_options *options,
    const osdtex_mapping *handle, uint8_t *demand, bool *said)
{
    const otx_surface *surface = &handle->surface->surface;
    const otx_constraint_set *constraints = handle->request.constraints;

    *said = options->mask || options->mask_image || options->face_exemplars ||
            otx_demand_in(constraints);
    if (otx_demand_in(constraints))
        OTX_TRY(otx_demand_constraints(
            run, surface, constraints, handle->source_count, demand));
    if (options->mask)
        OTX_TRY(otx_mask_pictures_take(
            run, surface, options->mask, handle->source_count, demand));
    if (options->mask_image)
        OTX_TRY(otx_mask_pictures_take_image(
            run, surface, &options->mask_image->image, handle->source_count,
            demand));
    if (options->face_exemplars)
        OTX_TRY(otx_demand_faces(
            run, surface, options->face_exemplars, handle->source_count,
            demand));
    for (int32_t k = 0; k < options->also_count; ++k)
        if (options->also[k].material)
            OTX_TRY(otx_demand_material(
                run, surface, options->also[k].material, k + 1, demand));
    return OSDTEX_OK;
}

static bool
is_asked_for(const osdtex_mapping *handle, const uint8_t *demand, int32_t k)
{
    const otx_level *leaf = otx_surface_leaf(&handle->surface->surface);

    for (int32_t f = 0; f < leaf->face_count; ++f)
        if (!leaf->face_hole[f] && demand[f] == k)
            return true;
    return false;
}

/* An exemplar that nothing can ask for is a mistake; one that nothing does,
 * a surprise. */
static otx_status
check_demand(
    otx_run *run, const osdtex_map_options *options,
    const osdtex_mapping *handle, const uint8_t *demand, bool said)
{
    /* A mapping that is kept has them where it has them. */
    if (options->keep)
        return OSDTEX_OK;
    for (int32_t k = 1; k < handle->source_count; ++k)
    {
        const otx_where where = {handle->exemplars[k].source_path, 0, -1, -1};

        if (!said && !options->also[k - 1].material)
            return otx_fail(
                run, OSDTEX_ERROR_ARGUMENT, STAGE, where,
                "nothing says where exemplar %d goes; name a material of the "
                "cage ({also} MATERIAL=FILE), or give a {mask} or constraints "
                "that name exemplars",
                (int)k + 1);
        if (!is_asked_for(handle, demand, k))
            otx_note(
                run, OSDTEX_SEVERITY_WARNING, STAGE, where,
                "no face shows exemplar %d (%.200s): what asks for it may be "
                "smaller than a face; raise {level}",
                (int)k + 1, name_of(handle->sources[k]));
    }
    return OSDTEX_OK;
}

otx_status
otx_several_take(
    otx_run *run, const osdtex_map_options *options, osdtex_mapping *handle)
{
    const otx_level *leaf = otx_surface_leaf(&handle->surface->surface);
    uint8_t *demand;
    bool said;

    OTX_TRY(check(run, options, handle));
    OTX_TRY(take_exemplars(run, options, handle));
    OTX_TRY(otx_exemplar_names_resolve(
        run, handle->exemplars, handle->source_count,
        &handle->request.constraints));
    if (options->also_count == 0)
        return OSDTEX_OK;
    demand = OTX_ZNEW(run->arena, uint8_t, leaf->face_count);
    OTX_TRY(otx_run_ok(run));
    OTX_TRY(collect(run, options, handle, demand, &said));
    OTX_TRY(check_demand(run, options, handle, demand, said));
    handle->request.demand = demand;
    return OSDTEX_OK;
}
