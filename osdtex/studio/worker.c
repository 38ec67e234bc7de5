/* worker.c -- the thread that maps whatever recipe is newest. */
#include "studio/worker.h"

#include "studio/figures.h"
#include "studio/recipe.h"
#include "studio/sentence.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum
{
    ASIDE_BYTES = OTX_STUDIO_PATH_BYTES + 32
};

static double
now(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Whether what is at work is still wanted; under the lock. */
static bool
is_wanted(const otx_studio_worker *w)
{
    const otx_desk *desk = w->desk;

    return !desk->is_closing && !desk->work.is_cancelled &&
           desk->past.revision == w->taken;
}

/* Tells the page of steps of a fiftieth. */
static bool
show_progress(void *user, const char *stage, double fraction)
{
    otx_studio_worker *w = user;
    otx_desk_work *work = &w->desk->work;
    bool goes_on;

    pthread_mutex_lock(&w->desk->lock);
    goes_on = is_wanted(w);
    if (strcmp(work->stage, stage) != 0 || fraction < work->fraction ||
        fraction > work->fraction + 0.02)
    {
        snprintf(work->stage, sizeof work->stage, "%s", stage);
        work->fraction = fraction;
        otx_desk_touch(w->desk);
    }
    pthread_mutex_unlock(&w->desk->lock);
    return goes_on;
}

static osdtex_status
read_exemplar(otx_studio_worker *w, int index)
{
    if (w->exemplars[index])
        return OSDTEX_OK;
    return osdtex_exemplar_read(
        w->context, w->desk->options->exemplars[index],
        &w->desk->options->exemplar, &w->exemplars[index]);
}

/* The surface as `osdtex map` refines it; kept while it would be the same. */
static osdtex_status
refine(otx_studio_worker *w, int index, osdtex_map_options *map)
{
    osdtex_surface_options surface = w->desk->options->surface;
    osdtex_job job = osdtex_job_none();
    osdtex_forecast forecast;
    osdtex_status status;

    if (w->surface && w->surface_exemplar == index &&
        w->surface_scale == map->scale)
        return OSDTEX_OK;
    osdtex_surface_destroy(w->surface);
    w->surface = NULL;
    job.surface = &surface;
    job.map = map;
    status = osdtex_preflight(
        w->context, w->desk->options->cage, w->exemplars[index], &job,
        &forecast);
    if (status != OSDTEX_OK)
        return status;
    w->surface_exemplar = index;
    w->surface_scale = map->scale;
    w->scale = forecast.scale;
    surface.leaf_edge =
        osdtex_exemplar_leaf_edge(w->exemplars[index], forecast.scale);
    ++w->surface_serial;
    return osdtex_surface_refine(
        w->context, w->desk->options->cage, &surface, &w->surface);
}

/* What is asked of the field, for the page to show. */
static osdtex_status
solve_field(
    otx_studio_worker *w, const osdtex_map_options *map, osdtex_field **out)
{
    osdtex_field_options options = osdtex_field_options_default();

    options.constraints = map->constraints;
    options.follow = map->follow;
    return osdtex_field_create(w->context, w->surface, &options, out);
}

/* A file of its own for what is worked with: the one that is told of may hold a
 * newer recipe by the time it is read. To be removed.
 *
 *   name  what it is for */
static bool
write_aside(
    const otx_studio_worker *w, const json_t *constraints, const char *name,
    char path[ASIDE_BYTES])
{
    snprintf(
        path, ASIDE_BYTES, "%s.%s%ld.json",
        w->desk->options->files->constraints, name, (long)getpid());
    return otx_recipe_write(constraints, path);
}

/* The options of a recipe, its exemplar and surface.
 *
 *   path  a file with its constraints */
static osdtex_status
prepare(
    otx_studio_worker *w, const json_t *recipe, const char *path,
    osdtex_map_options *map)
{
    const int index = otx_recipe_exemplar(recipe);
    osdtex_status status = read_exemplar(w, index);

    *map = w->desk->options->map;
    otx_recipe_apply(recipe, map);
    map->constraints = path;
    if (status == OSDTEX_OK)
        status = refine(w, index, map);
    map->surface = w->surface;
    map->scale = w->scale;
    return status;
}

/* The edit of a mapping that makes it the recipe's. */
static osdtex_status
edit_base(
    otx_studio_worker *w, const otx_outcome *base, const json_t *rest,
    osdtex_mapping **out)
{
    osdtex_edit_options options = osdtex_edit_options_default();
    char path[ASIDE_BYTES];
    json_t *file = json_pack("{s:O}", "constraints", rest);
    osdtex_status status = OSDTEX_ERROR_IO;

    options.constraints = path;
    if (file && write_aside(w, file, "edit", path))
        status = osdtex_mapping_edit(w->context, base->mapping, &options, out);
    json_decref(file);
    unlink(path);
    return status;
}

/* From what is on the shelf where that will do; *out stays NULL where not. */
static osdtex_status
edit_recipe(otx_studio_worker *w, const json_t *recipe, osdtex_mapping **out)
{
    json_t *rest = NULL;
    const otx_outcome *base = otx_shelf_base(&w->shelf, recipe, &rest);
    osdtex_status status = OSDTEX_OK;

    *out = NULL;
    if (base && base->surface_serial == w->surface_serial)
        status = edit_base(w, base, rest, out);
    json_decref(rest);
    return status;
}

/* What the page is shown of a mapping, which is taken. */
static osdtex_status
wrap_up(
    otx_studio_worker *w, const osdtex_map_options *map,
    osdtex_mapping *mapping, otx_outcome **out)
{
    osdtex_field *field = NULL;
    osdtex_status status = solve_field(w, map, &field);
    otx_outcome *o;

    if (status == OSDTEX_OK)
        status = otx_outcome_make(w->context, mapping, field, out);
    else
        osdtex_mapping_destroy(mapping);
    if (status != OSDTEX_OK)
        return status;
    o = *out;
    o->surface_serial = w->surface_serial;
    o->exemplar = w->surface_exemplar;
    o->exemplars[0] = w->exemplars[w->surface_exemplar];
    for (int k = 0; k < map->also_count; ++k)
        o->exemplars[k + 1] = map->also[k].exemplar;
    return OSDTEX_OK;
}

/* A new outcome of a recipe, whose constraints are in a file. */
static osdtex_status
make_outcome(
    otx_studio_worker *w, const json_t *recipe, const char *path,
    otx_outcome **out, bool *is_edit)
{
    osdtex_mapping *mapping = NULL;
    osdtex_map_options map;
    osdtex_status status = prepare(w, recipe, path, &map);

    if (status == OSDTEX_OK)
        status = edit_recipe(w, recipe, &mapping);
    *is_edit = mapping != NULL;
    if (status == OSDTEX_OK && !mapping)
        status = osdtex_map(
            w->context, w->desk->options->cage,
            w->exemplars[w->surface_exemplar], &map, &mapping);
    return status == OSDTEX_OK ? wrap_up(w, &map, mapping, out) : status;
}

/* A new outcome, or one from the shelf; held for the caller. */
static osdtex_status
map_recipe(
    otx_studio_worker *w, const json_t *recipe, otx_outcome **out,
    bool *is_edit)
{
    const json_t *constraints = json_object_get(recipe, "constraints");
    char path[ASIDE_BYTES];
    osdtex_status status;

    *out = otx_shelf_find(&w->shelf, recipe);
    *is_edit = true;
    if (*out)
    {
        otx_outcome_hold(*out);
        return OSDTEX_OK;
    }
    if (!write_aside(w, constraints, "map", path))
        return OSDTEX_ERROR_IO;
    status = make_outcome(w, recipe, path, out, is_edit);
    unlink(path);
    if (status == OSDTEX_OK)
        otx_shelf_put(&w->shelf, recipe, *out);
    return status;
}

/* Lays what came of it on the desk. */
static void
publish(otx_studio_worker *w, otx_snapshot *made, osdtex_status status)
{
    const char *message = osdtex_context_error(w->context)->message;
    otx_desk *desk = w->desk;

    pthread_mutex_lock(&desk->lock);
    desk->work.is_busy = false;
    desk->work.stage[0] = '\0';
    desk->work.error[0] = '\0';
    if (status == OSDTEX_ERROR_IO && !*message)
        otx_sentence(
            desk->work.error,
            "nothing can be written beside %s; is the disk "
            "full?",
            desk->options->files->constraints);
    else if (status != OSDTEX_OK && status != OSDTEX_ERROR_CANCELLED)
        otx_sentence(
            desk->work.error, "%s",
            *message ? message : "there is no memory for what was asked");
    if (made)
    {
        otx_snapshot_release(desk->snapshot);
        made->serial = desk->serial;
        made->revision = w->taken;
        desk->snapshot = made;
    }
    otx_desk_touch(desk);
    pthread_mutex_unlock(&desk->lock);
    osdtex_diagnostic_clear(w->context);
}

static void
map_newest(otx_studio_worker *w, json_t *recipe)
{
    const double begun = now();
    otx_outcome *outcome = NULL;
    otx_snapshot *made = NULL;
    bool is_edit;
    osdtex_status status = map_recipe(w, recipe, &outcome, &is_edit);

    if (status == OSDTEX_OK)
        made = otx_snapshot_make(outcome);
    if (made && !(made->facts = otx_figures_facts(made)))
    {
        otx_snapshot_release(made);
        made = NULL;
    }
    if (status == OSDTEX_OK && !made)
        status = OSDTEX_ERROR_MEMORY;
    otx_outcome_release(outcome);
    if (made)
    {
        made->seconds = now() - begun;
        made->is_edit = is_edit;
    }
    publish(w, made, status);
}

/* Measures what is shown; a newer recipe cancels that, too. */
static void
measure(otx_studio_worker *w)
{
    otx_snapshot *shown = otx_desk_snapshot(w->desk);
    json_t *figures = shown ? otx_figures_of(w->context, shown) : NULL;

    pthread_mutex_lock(&w->desk->lock);
    w->desk->work.stage[0] = '\0';
    if (shown && (figures || is_wanted(w)))
    {
        json_decref(w->desk->work.figures);
        w->desk->work.figures = figures;
        w->desk->work.figures_of = shown->serial;
    }
    otx_desk_touch(w->desk);
    pthread_mutex_unlock(&w->desk->lock);
    otx_snapshot_release(shown);
    osdtex_diagnostic_clear(w->context);
}

/* -- exporting ------------------------------------------------------------ */

/* A file of another program is not replaced. */
static bool
may_replace(const char *path)
{
    osdtex_output_mark mark;
    FILE *file = fopen(path, "rb");

    if (!file)
        return true;
    fclose(file);
    osdtex_outputs_inspect(path, false, &mark);
    return mark.is_ours;
}

static osdtex_status
write_model(otx_studio_worker *w, const otx_snapshot *shown)
{
    const otx_studio_files *files = w->desk->options->files;
    osdtex_status status = osdtex_outputs_begin(w->context);

    if (status != OSDTEX_OK)
        return status;
    status = osdtex_outputs_mark(w->context, NULL, files->constraints);
    if (status == OSDTEX_OK)
        status = osdtex_mapping_write(
            w->context, shown->outcome->mapping, files->model, NULL);
    if (status == OSDTEX_OK)
        status = osdtex_mapping_save(
            w->context, shown->outcome->mapping, files->saved);
    if (status == OSDTEX_OK)
        return osdtex_outputs_commit(w->context);
    osdtex_outputs_drop(w->context);
    return status;
}

static void
export_shown(otx_studio_worker *w)
{
    const otx_studio_files *files = w->desk->options->files;
    otx_snapshot *shown = otx_desk_snapshot(w->desk);
    char told[OTX_STUDIO_ERROR_BYTES] = "there is nothing to export yet";

    if (shown && (!may_replace(files->model) || !may_replace(files->saved)))
        otx_sentence(
            told, "%s was not written by osdtex; start with another -o",
            may_replace(files->model) ? files->saved : files->model);
    else if (shown && write_model(w, shown) == OSDTEX_OK)
        otx_sentence(
            told,
            "wrote %s, its material and texture, and "
            "%s",
            files->model, files->saved);
    else if (shown)
        otx_sentence(told, "%s", osdtex_context_error(w->context)->message);
    otx_snapshot_release(shown);
    pthread_mutex_lock(&w->desk->lock);
    otx_sentence(w->desk->work.told, "%s", told);
    w->desk->work.is_busy = false;
    w->desk->work.stage[0] = '\0';
    otx_desk_touch(w->desk);
    pthread_mutex_unlock(&w->desk->lock);
}

/* -- the thread ----------------------------------------------------------- */

typedef enum task
{
    MAP,
    MEASURE,
    EXPORT,
    END
} task;

/* What is to be done next; under the lock, which is let go while nothing is. */
static task
wait_for_task(otx_studio_worker *w)
{
    otx_desk *desk = w->desk;

    for (;;)
    {
        if (desk->is_closing)
            return END;
        if (!desk->work.is_cancelled && desk->work.tried != desk->past.revision)
            return MAP;
        if (desk->work.wants_export)
            return EXPORT;
        if (desk->snapshot && !desk->work.is_cancelled &&
            desk->work.figures_of != desk->snapshot->serial &&
            desk->snapshot->revision == desk->past.revision)
            return MEASURE;
        pthread_cond_wait(&desk->changed, &desk->lock);
    }
}

/* Takes the next task; of a recipe to be mapped a copy, else NULL. */
static task
take_task(otx_studio_worker *w, json_t **recipe)
{
    otx_desk *desk = w->desk;
    task next;

    pthread_mutex_lock(&desk->lock);
    next = wait_for_task(w);
    *recipe = next == MAP ? json_deep_copy(otx_past_now(&desk->past)) : NULL;
    w->taken = desk->past.revision;
    if (next == MAP)
        desk->work.tried = w->taken;
    if (next == EXPORT)
        desk->work.wants_export = false;
    desk->work.is_busy = next != MEASURE;
    desk->work.fraction = 0.0;
    otx_desk_touch(desk);
    pthread_mutex_unlock(&desk->lock);
    return next;
}

static void *
work(void *user)
{
    otx_studio_worker *w = user;

    for (;;)
    {
        json_t *recipe;
        const task next = take_task(w, &recipe);

        if (next == END)
            return NULL;
        if (next == MAP && recipe)
            map_newest(w, recipe);
        else if (next == MEASURE)
            measure(w);
        else if (next == EXPORT)
            export_shown(w);
        json_decref(recipe);
    }
}

bool
otx_worker_start(otx_desk *desk, otx_studio_worker *w)
{
    osdtex_context_options options = desk->options->context;

    *w = (otx_studio_worker){.desk = desk};
    options.progress = show_progress;
    options.progress_user = w;
    options.log = NULL;
    if (osdtex_context_create(&options, &w->context) != OSDTEX_OK)
        return false;
    w->is_started = pthread_create(&w->thread, NULL, work, w) == 0;
    return w->is_started;
}

void
otx_worker_join(otx_studio_worker *w)
{
    if (w->is_started)
        pthread_join(w->thread, NULL);
    otx_shelf_free(&w->shelf);
    osdtex_surface_destroy(w->surface);
    for (int i = 0; i < OTX_STUDIO_EXEMPLARS_MAX; ++i)
        osdtex_exemplar_destroy(w->exemplars[i]);
    osdtex_context_destroy(w->context);
}
