/* edit_call.c -- edits of mappings: constraints that act on an area alone. */
#include "api/edit_call.h"

#include "api/call.h"
#include "api/exemplar_names.h"
#include "api/map_input.h"
#include "api/mapping_info.h"
#include "edit/apply.h"
#include "mapping/mapping_check.h"

#include <string.h>

static const char STAGE[] = "edit";

enum
{
    EDITS_MOST = 1000000 /* numbers of edits: sums of two are numbers, too */
};

/* ---- sets of constraints ------------------------------------------------ */

static int32_t
last_edit(const otx_constraint_set *set)
{
    int32_t last = 0;

    for (int32_t i = 0; set && i < set->count; ++i)
        if (set->items[i].edit > last)
            last = set->items[i].edit;
    return last;
}

/* The next number that the set has, INT32_MAX: there is none. */
static int32_t
next_edit(const otx_constraint_set *set, int32_t from)
{
    int32_t next = INT32_MAX;

    for (int32_t i = 0; i < set->count; ++i)
        if (set->items[i].edit >= from && set->items[i].edit < next)
            next = set->items[i].edit;
    return next;
}

static otx_status
check_number(otx_run *run, const otx_constraint_set *set, int32_t i, int64_t n)
{
    if (n <= EDITS_MOST)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE,
        (otx_where){set->path, 0, set->items[i].face, -1},
        "constraint %d would be edit %lld, and edits are numbered from 1 to "
        "%d; give it a lower number",
        (int)i + 1, (long long)n, EDITS_MOST);
}

otx_status
otx_edit_call_base(
    otx_run *run, const otx_constraint_set *set, const otx_constraint_set **out)
{
    otx_constraint_set *base;
    otx_constraint *items;

    *out = set;
    if (last_edit(set) == 0)
        return OSDTEX_OK;
    for (int32_t i = 0; i < set->count; ++i)
        OTX_TRY(check_number(run, set, i, set->items[i].edit));
    base = OTX_NEW(run->arena, otx_constraint_set, 1);
    items = OTX_NEW(run->arena, otx_constraint, set->count);
    OTX_TRY(otx_run_ok(run));
    *base = *set;
    base->items = items;
    base->count = 0;
    for (int32_t i = 0; i < set->count; ++i)
        if (set->items[i].edit == 0)
            items[base->count++] = set->items[i];
    *out = base;
    return OSDTEX_OK;
}

otx_status
otx_edit_call_copy(
    otx_run *run, const otx_constraint_set *from, int32_t room,
    otx_constraint_set **out, otx_constraint **items)
{
    const otx_constraint_set none = {.axis = {0, 1, 0}};
    const int32_t count = from ? from->count : 0;

    *out = OTX_NEW(run->arena, otx_constraint_set, 1);
    *items = OTX_NEW(run->arena, otx_constraint, (size_t)count + (size_t)room);
    OTX_TRY(otx_run_ok(run));
    **out = from ? *from : none;
    (*out)->path = NULL;
    (*out)->is_table = false;
    (*out)->field = (otx_constraint_field){0};
    if (count > 0)
        memcpy(*items, from->items, (size_t)count * sizeof **items);
    for (int32_t i = 0; i < count; ++i)
        if ((*items)[i].exemplar_name)
            (*items)[i].exemplar_name =
                otx_arena_strdup(run->arena, (*items)[i].exemplar_name);
    (*out)->items = *items;
    return otx_run_ok(run);
}

/* All that was asked before, and what is asked now, numbered after it. */
static otx_status
join_sets(
    otx_run *run, const otx_constraint_set *had,
    const otx_constraint_set *asked, double reach, otx_constraint_set **out)
{
    const int32_t last = last_edit(had);
    otx_constraint *items;

    OTX_TRY(otx_edit_call_copy(run, had, asked->count, out, &items));
    if (!had)
    {
        (*out)->symmetry = asked->symmetry;
        (*out)->follow = OTX_FOLLOW_NOTHING;
    }
    for (int32_t i = 0; i < asked->count; ++i)
    {
        otx_constraint *item = &items[(*out)->count++];
        const int64_t edit = asked->items[i].edit;
        const int64_t number = (int64_t)last + (edit > 0 ? edit : 1);

        OTX_TRY(check_number(run, asked, i, number));
        *item = asked->items[i];
        item->edit = (int32_t)number;
        if (item->reach == 0.0)
            item->reach = reach;
    }
    return OSDTEX_OK;
}

/* ---- applying ----------------------------------------------------------- */

static otx_status
apply_one(
    otx_run *run, const otx_constraint_set *set, int32_t number,
    osdtex_mapping *handle)
{
    const otx_job job = {
        .run = run,
        .surface = handle->mapping.surface,
        .exemplars = handle->exemplars,
        .exemplar_count = handle->source_count,
        .request = &handle->request,
        .settings = handle->settings,
    };
    const otx_edit edit = {&job, handle->method, set, number};
    otx_mapping made;

    OTX_TRY(otx_edit_apply(&edit, &handle->mapping, &made));
    handle->mapping = made;
    return OSDTEX_OK;
}

/* All edits from `first` on. What lies between two of them goes when the later
 * one is made; the last mapping stays with the run. */
static otx_status
apply_all(
    otx_run *run, const otx_constraint_set *set, int32_t first,
    osdtex_mapping *handle)
{
    const int32_t last = last_edit(set);
    otx_arena *between = NULL;
    otx_status status = OSDTEX_OK;
    int32_t next;

    for (int32_t n = next_edit(set, first);
         n < INT32_MAX && status == OSDTEX_OK; n = next)
    {
        otx_run step = *run;

        next = next_edit(set, n + 1);
        if (next < INT32_MAX)
            step.arena = otx_arena_create(run->allocator);
        status = step.arena
                     ? otx_progress(run, STAGE, (double)(n - first) / last)
                     : otx_fail_memory(run, STAGE);
        if (status == OSDTEX_OK)
            status = apply_one(&step, set, n, handle);
        otx_arena_destroy(between);
        between = next < INT32_MAX ? step.arena : NULL;
    }
    otx_arena_destroy(between);
    return status;
}

otx_status
otx_edit_call_apply(
    otx_run *run, const otx_constraint_set *set, int32_t first,
    osdtex_mapping *handle)
{
    if (last_edit(set) < first)
        return OSDTEX_OK;
    OTX_TRY(otx_exemplar_names_resolve(
        run, handle->exemplars, handle->source_count, &set));
    run->seed = handle->seed;
    OTX_TRY(apply_all(run, set, first, handle));
    handle->request.constraints = set;
    return otx_mapping_check(
        run, &handle->mapping, &handle->surface->surface, handle->exemplars,
        handle->source_count, handle->method->name);
}

/* A handle that begins with another one's mapping. */
static otx_status
begin(otx_run *run, const osdtex_mapping *from, osdtex_mapping **out)
{
    osdtex_mapping *h = OTX_ZNEW(run->arena, osdtex_mapping, 1);
    otx_arena *base = from->base ? from->base : from->arena;

    OTX_TRY(otx_run_ok(run));
    *h = *from;
    h->arena = run->arena;
    h->base = base;
    h->figures = (otx_figures){0};
    h->saved_path = NULL;
    h->request.guide = NULL;
    h->request.demand = NULL;
    OTX_TRY(otx_call_hold(run, base));
    *out = h;
    return OSDTEX_OK;
}

static otx_status
read_options(
    otx_run *run, const osdtex_edit_options *options,
    const otx_constraint_set **asked, double *reach)
{
    osdtex_edit_options ours = osdtex_edit_options_default();
    osdtex_map_options map = osdtex_map_options_default();

    OTX_TRY(otx_call_options(run, &ours, sizeof ours, options));
    map.constraints = ours.constraints;
    map.constraint_items = ours.constraint_items;
    map.constraint_count = ours.constraint_count;
    *reach = ours.reach;
    /* Written so that NaN is refused too. */
    if (!(ours.reach >= 0.0) || isinf(ours.reach))
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "the reach of an edit is a positive number of scene units, or 0 "
            "for a suitable one, not %g",
            ours.reach);
    OTX_TRY(otx_map_input_options(run, &map, asked));
    if (*asked && (*asked)->count > 0)
        return OSDTEX_OK;
    return otx_fail(
        run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
        "an edit without constraints changes nothing; say where, and what is "
        "wanted there");
}

static otx_status
edit(
    otx_run *run, const osdtex_mapping *mapping,
    const osdtex_edit_options *options, osdtex_mapping **out)
{
    const otx_constraint_set *asked;
    otx_constraint_set *all;
    double reach;

    if (!mapping)
        return otx_fail(
            run, OSDTEX_ERROR_ARGUMENT, STAGE, OTX_NOWHERE,
            "no mapping is given");
    OTX_TRY(read_options(run, options, &asked, &reach));
    OTX_TRY(join_sets(run, mapping->request.constraints, asked, reach, &all));
    OTX_TRY(begin(run, mapping, out));
    OTX_TRY(otx_edit_call_apply(
        run, all, last_edit(mapping->request.constraints) + 1, *out));
    (*out)->info = otx_mapping_info_of(*out);
    return OSDTEX_OK;
}

osdtex_status
osdtex_mapping_edit(
    osdtex_context *context, const osdtex_mapping *mapping,
    const osdtex_edit_options *options, osdtex_mapping **out)
{
    otx_call call;

    if (!out)
        return OSDTEX_ERROR_ARGUMENT;
    *out = NULL;
    OTX_TRY(otx_call_begin(context, STAGE, &call));
    return otx_call_end(&call, edit(&call.run, mapping, options, out), out);
}
