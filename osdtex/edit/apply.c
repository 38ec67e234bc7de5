/* apply.c -- one edit of a mapping: constraints that act on an area alone. */
#include "edit/apply.h"

#include "base/random.h"
#include "edit/area.h"
#include "edit/fields.h"
#include "edit/refit.h"
#include "mapping/source.h"
#include "seam/unit.h"

#include <string.h>

static const char STAGE[] = "edit";

enum
{
    STAGE_EDIT = 0x45444954 /* of random numbers */
};

/* Reach of an edit that names none, in widths of the exemplar. */
static const double REACH = 0.5;

/* Texels within the area in which what was there may be kept, and the largest
 * share of an edit's reach. */
static const double RIM = 48.0;
static const double RIM_SHARE = 0.5;

/* An edit on its way. */
typedef struct editing
{
    const otx_edit *edit;
    otx_run *run;
    const otx_mapping *from;
    uint8_t *area; /* [leaf face_count] */
    bool any;
    otx_edit_asks asks;
    otx_edit_place place;
    const otx_surface *surface; /* with the density that is wanted */
    const otx_guide *guide;
    const float *along;
    uint8_t *demand; /* [leaf face_count]; NULL: one exemplar */
    uint8_t *state;  /* [leaf face_count] */
} editing;

otx_status
otx_edit_check(
    otx_run *run, const otx_method *method, const otx_mapping *mapping,
    const otx_exemplar *exemplars)
{
    const otx_level *leaf = otx_surface_leaf(mapping->surface);
    const char *why = NULL;

    if (!exemplars[0].match.pixels)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the mapping was read without what it is measured by, which an "
            "edit needs; read it whole");
    if (mapping->lookups && mapping->lookups->layering == OTX_LAYERING_OVER)
        why = "lays pieces over one another";
    else if (mapping->lookups)
        why = "mixes several places of the picture";
    else if (
        mapping->field &&
        otx_source_field_is_whole(
            mapping->field, leaf->face_hole, leaf->face_count))
        why = "makes its texture texel by texel";
    else if (exemplars[0].tiles.cell > 0)
        why = "has laid the tiles of a tiled texture";
    else if (!otx_method_can_fill())
        why = "has no other beside it that fills in patches";
    if (!why)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_SUPPORT, STAGE, OTX_NOWHERE,
        "the method '%s' %s, which cannot be made anew in part; map anew with "
        "what is wanted",
        method->name, why);
}

/* ---- what is wanted ---------------------------------------------------- */

static otx_status
find_area(editing *e)
{
    const otx_level *leaf = otx_surface_leaf(e->from->surface);

    e->area = OTX_ZNEW(e->run->scratch, uint8_t, leaf->face_count);
    e->state = OTX_ZNEW(e->run->scratch, uint8_t, leaf->face_count);
    OTX_TRY(otx_run_ok(e->run));
    OTX_TRY(otx_area_find(
        e->run, e->from->surface, e->edit->set, e->edit->number,
        REACH * e->from->scale, e->area));
    for (int32_t f = 0; f < leaf->face_count; ++f)
        e->any |= e->area[f] != 0;
    if (!e->any)
        return OSDTEX_OK;
    return otx_edit_place_make(
        e->run, e->from->surface, e->edit->set, e->edit->number, e->area,
        &e->place);
}

static otx_status
edit_guide(editing *e)
{
    e->guide = e->from->guide;
    if (!e->asks.direction)
        return OSDTEX_OK;
    if (e->guide)
        return otx_edit_guide(e->run, &e->place, e->from->guide, &e->guide);
    otx_note(
        e->run, OSDTEX_SEVERITY_WARNING, STAGE, OTX_NOWHERE,
        "the edit asks for a direction, and the mapping follows none, since "
        "the exemplar looks the same from all sides; say that it does not "
        "with {exemplar-class} directional when the mapping is made");
    e->asks.direction = false;
    return OSDTEX_OK;
}

static otx_status
edit_density(editing *e)
{
    otx_surface *surface;

    e->surface = e->from->surface;
    if (!e->asks.scale)
        return OSDTEX_OK;
    surface = OTX_NEW(e->run->arena, otx_surface, 1);
    OTX_TRY(otx_run_ok(e->run));
    *surface = *e->from->surface;
    OTX_TRY(otx_edit_density(e->run, &e->place, &surface->density));
    e->surface = surface;
    return OSDTEX_OK;
}

static otx_status
edit_along(editing *e)
{
    e->along = e->from->along;
    if (!e->asks.material)
        return OSDTEX_OK;
    if (e->along)
        return otx_edit_along(e->run, &e->place, e->from->along, &e->along);
    otx_note(
        e->run, OSDTEX_SEVERITY_WARNING, STAGE, OTX_NOWHERE,
        "the edit names a material, and the mapping shows no stack; of several "
        "exemplars name the one that is wanted");
    return OSDTEX_OK;
}

/* The faces that a constraint holds are to show its exemplar. */
static otx_status
demand_item(editing *e, const otx_constraint *item)
{
    const otx_arena_mark mark = otx_arena_here(e->run->scratch);
    int32_t *faces, count;

    if (item->exemplar > otx_source_count(e->from))
        return otx_fail(
            e->run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the edit asks for exemplar %d, and the mapping has %d",
            (int)item->exemplar, (int)otx_source_count(e->from));
    OTX_TRY(otx_area_hold(e->run, e->from->surface, item, &faces, &count));
    for (int32_t i = 0; i < count; ++i)
    {
        const int32_t wanted = item->exemplar - 1;

        if (e->demand[faces[i]] != wanted)
            e->state[faces[i]] = OTX_REFIT_OPEN;
        e->demand[faces[i]] = (uint8_t)wanted;
    }
    otx_arena_release(e->run->scratch, mark);
    return OSDTEX_OK;
}

/* What each face shows is what it is asked for, but for the edit. */
static otx_status
edit_demand(editing *e)
{
    const otx_level *leaf = otx_surface_leaf(e->from->surface);
    const otx_constraint_set *set = e->edit->set;

    if (otx_source_count(e->from) > 1)
    {
        e->demand = OTX_NEW(e->run->scratch, uint8_t, leaf->face_count);
        OTX_TRY(otx_run_ok(e->run));
        for (int32_t f = 0; f < leaf->face_count; ++f)
            e->demand[f] = (uint8_t)otx_source_of(e->from, f);
    }
    for (int32_t i = 0; e->asks.exemplar && i < set->count; ++i)
        if (set->items[i].edit == e->edit->number &&
            set->items[i].exemplar > 0 && e->demand)
            OTX_TRY(demand_item(e, &set->items[i]));
    return OSDTEX_OK;
}

/* Along the rim of the area what was there may stay: the new texture then
 * begins where it fits. */
static otx_status
mark_rim(editing *e)
{
    const int32_t faces = otx_surface_leaf(e->from->surface)->face_count;
    const double texel =
        1.0 / otx_unit_texels(e->edit->job->exemplars, e->from->scale);
    uint8_t *marked = OTX_NEW(e->run->scratch, uint8_t, faces);
    double reach = 0.0;

    OTX_TRY(otx_run_ok(e->run));
    for (int32_t i = 0; i < e->edit->set->count; ++i)
        if (e->edit->set->items[i].edit == e->edit->number)
            reach = fmax(reach, e->edit->set->items[i].reach);
    if (reach == 0.0)
        reach = REACH * e->from->scale;
    for (int32_t f = 0; f < faces; ++f)
        marked[f] = !e->area[f];
    OTX_TRY(otx_subset_widen(
        e->run, e->from->surface, fmin(RIM * texel, RIM_SHARE * reach), 2,
        marked));
    for (int32_t f = 0; f < faces; ++f)
        if (marked[f] == 2)
            e->state[f] = OTX_REFIT_EITHER;
    return OSDTEX_OK;
}

/* What constraints hold is to be as they ask. */
static otx_status
mark_held(editing *e)
{
    const otx_constraint_set *set = e->edit->set;

    for (int32_t i = 0; i < set->count; ++i)
    {
        const otx_arena_mark mark = otx_arena_here(e->run->scratch);
        int32_t *faces, count;

        if (set->items[i].edit != e->edit->number)
            continue;
        OTX_TRY(otx_area_hold(
            e->run, e->from->surface, &set->items[i], &faces, &count));
        for (int32_t k = 0; k < count; ++k)
            e->state[faces[k]] = OTX_REFIT_OPEN;
        otx_arena_release(e->run->scratch, mark);
    }
    return OSDTEX_OK;
}

/* All of the area is made anew where something is asked of the texture itself.
 * Where only another piece or exemplar is, that is fitted to what lies around
 * what is held, over which it may spread, and which may move: so the seam runs
 * where both agree. Made anew up to its rim the area would have to fit in all
 * around, and seams would get worse with every edit. */
static otx_status
set_states(editing *e)
{
    const int32_t faces = otx_surface_leaf(e->from->surface)->face_count;
    const bool whole = e->asks.direction || e->asks.scale;

    for (int32_t f = 0; f < faces; ++f)
    {
        if (!e->area[f] || e->state[f] == OTX_REFIT_OPEN)
            continue;
        if (whole)
            e->state[f] = OTX_REFIT_OPEN;
        else if (e->asks.exemplar || e->asks.redo)
            e->state[f] = OTX_REFIT_FREE;
    }
    if (whole)
        OTX_TRY(mark_rim(e));
    return whole || e->asks.redo ? mark_held(e) : OSDTEX_OK;
}

/* ---- making it --------------------------------------------------------- */

/* What was made by texels, and cells of a lattice, go with their faces. */
static otx_status
drop_changed(const editing *e, otx_mapping *out)
{
    const otx_level *leaf = otx_surface_leaf(e->from->surface);
    int32_t *chart =
        out->field ? OTX_NEW(e->run->arena, int32_t, leaf->face_count) : NULL;
    uint8_t *open =
        out->lattice ? OTX_NEW(e->run->arena, uint8_t, leaf->face_count) : NULL;
    otx_source_field *field = OTX_NEW(e->run->arena, otx_source_field, 1);
    otx_cell_map *lattice = OTX_NEW(e->run->arena, otx_cell_map, 1);

    OTX_TRY(otx_run_ok(e->run));
    for (int32_t f = 0; f < leaf->face_count; ++f)
    {
        const bool changed = e->state[f] != OTX_REFIT_HELD;

        if (chart)
            chart[f] = changed ? -1 : out->field->face_chart[f];
        if (open)
            open[f] = changed ? 1 : out->lattice->open[f];
    }
    if (chart)
    {
        *field = *out->field;
        field->face_chart = chart;
        out->field = field;
    }
    if (open)
    {
        *lattice = *out->lattice;
        lattice->open = open;
        out->lattice = lattice;
    }
    return OSDTEX_OK;
}

static otx_status
refit(const editing *e, otx_mapping *out)
{
    otx_run run = *e->run;
    otx_job job = *e->edit->job;
    otx_map_request request = *job.request;
    const otx_refit what = {
        .job = &job,
        .method = e->edit->method->fill ? e->edit->method : NULL,
        .from = e->from,
        .state = e->state,
        .avoid = e->asks.redo ? e->asks.take : 0,
    };

    run.seed = otx_random_bits(
        e->run->seed, STAGE_EDIT,
        ((uint64_t)e->edit->number << 32) + (uint32_t)e->asks.take);
    request.guide = e->guide;
    request.demand = e->demand;
    request.constraints = NULL;
    request.first_face = -1;
    job.run = &run;
    job.surface = e->surface;
    job.request = &request;
    OTX_TRY(otx_refit_run(&what, out));
    out->along = e->along;
    out->lattice = e->from->lattice;
    out->field = e->from->field;
    return drop_changed(e, out);
}

static otx_status
apply(editing *e, otx_mapping *out)
{
    OTX_TRY(find_area(e));
    if (!e->any)
    {
        *out = *e->from;
        return OSDTEX_OK;
    }
    OTX_TRY(edit_guide(e));
    OTX_TRY(edit_density(e));
    OTX_TRY(edit_along(e));
    OTX_TRY(edit_demand(e));
    OTX_TRY(set_states(e));
    return refit(e, out);
}

otx_status
otx_edit_apply(const otx_edit *edit, const otx_mapping *from, otx_mapping *out)
{
    otx_run *run = edit->job->run, aside = *run;
    const otx_arena_mark mark = otx_arena_here(run->scratch);
    editing e = {
        .edit = edit,
        .run = &aside,
        .from = from,
        .asks = otx_edit_asks_of(edit->set, edit->number)};
    otx_mapping made;
    otx_status status;

    OTX_TRY(otx_edit_check(run, edit->method, from, edit->job->exemplars));
    /* What is made on the way goes; the mapping is copied out of it. */
    aside.arena = otx_arena_create(run->allocator);
    if (!aside.arena)
        return otx_fail_memory(run, STAGE);
    status = apply(&e, &made);
    if (status == OSDTEX_OK)
        status = otx_edit_copy(run, &made, out);
    otx_arena_destroy(aside.arena);
    otx_arena_release(run->scratch, mark);
    return status;
}
