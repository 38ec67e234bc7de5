/* desk.c -- what the threads of the studio share, behind one lock. */
#include "studio/desk.h"

#include "studio/recipe.h"
#include "studio/sentence.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum
{
    WAIT_SECONDS = 15,
    STATE_FORMAT = 1
};

/* -- opening -------------------------------------------------------------- */

/* By which constraints are looked at before they are taken: on the cage's own
 * faces, which is quick. */
static osdtex_status
make_checker(otx_desk *desk, char error[OTX_STUDIO_ERROR_BYTES])
{
    osdtex_context_options context = desk->options->context;
    osdtex_surface_options surface = osdtex_surface_options_default();
    osdtex_status status;

    context.progress = NULL;
    context.log = NULL;
    context.threads = 1;
    surface.level = 0;
    status = osdtex_context_create(&context, &desk->checker);
    if (status == OSDTEX_OK)
        status = osdtex_surface_refine(
            desk->checker, desk->options->cage, &surface, &desk->cage);
    if (status != OSDTEX_OK)
        otx_sentence(
            error, "%s",
            desk->checker ? osdtex_context_error(desk->checker)->message
                          : "there is no memory to begin with");
    return status;
}

/* Whether constraints of a file can be held. */
static osdtex_status
check_constraints(
    otx_desk *desk, const char *path, char error[OTX_STUDIO_ERROR_BYTES])
{
    osdtex_field_options options = osdtex_field_options_default();
    osdtex_field *field;
    osdtex_status status;

    options.constraints = path;
    status = osdtex_field_create(desk->checker, desk->cage, &options, &field);
    osdtex_field_destroy(field);
    if (status != OSDTEX_OK)
        otx_sentence(error, "%s", osdtex_context_error(desk->checker)->message);
    osdtex_diagnostic_clear(desk->checker);
    return status;
}

/* The recipe that an earlier studio left; NULL none. */
static osdtex_status
read_state(otx_desk *desk, json_t **recipe, char error[OTX_STUDIO_ERROR_BYTES])
{
    const otx_studio_files *files = desk->options->files;
    json_t *state = json_load_file(files->state, 0, NULL);
    char *text = NULL;
    osdtex_status status = OSDTEX_ERROR_FORMAT;

    *recipe = NULL;
    if (access(files->state, F_OK) != 0)
    {
        if (access(files->constraints, F_OK) != 0)
            return OSDTEX_OK;
        otx_sentence(
            error,
            "%s is there and is not the studio's; write elsewhere with -o, or "
            "begin from it with --constraints",
            files->constraints);
        return OSDTEX_ERROR_IO;
    }
    if (json_integer_value(json_object_get(state, "studio")) == STATE_FORMAT)
        text = json_dumps(json_object_get(state, "recipe"), JSON_ENCODE_ANY);
    if (text)
        *recipe = otx_recipe_parse(
            text, strlen(text), desk->options->exemplar_count, error);
    if (*recipe)
        status = OSDTEX_OK;
    else
        otx_sentence(
            error,
            "%s cannot be gone on from; move it away, or write elsewhere with "
            "-o",
            files->state);
    free(text);
    json_decref(state);
    return status;
}

/* -- saving --------------------------------------------------------------- */

/* Both files, for the recipe in force. */
static bool
save(const otx_desk *desk, json_t *recipe)
{
    const otx_studio_files *files = desk->options->files;
    json_t *state =
        json_pack("{s:i, s:O}", "studio", STATE_FORMAT, "recipe", recipe);
    const bool is_saved =
        state && otx_recipe_write(state, files->state) &&
        otx_recipe_write(
            json_object_get(recipe, "constraints"), files->constraints);

    json_decref(state);
    return is_saved;
}

static bool
refuse_save(const otx_desk *desk, char error[OTX_STUDIO_ERROR_BYTES])
{
    otx_sentence(
        error, "%s cannot be written; is the disk full?",
        desk->options->files->constraints);
    return false;
}

/* Whether the constraints of a recipe can be held, by a file beside theirs. */
static osdtex_status
check(otx_desk *desk, json_t *recipe, char error[OTX_STUDIO_ERROR_BYTES])
{
    char path[OTX_STUDIO_PATH_BYTES + 32];
    osdtex_status status;

    snprintf(
        path, sizeof path, "%s.new%ld.json", desk->options->files->constraints,
        (long)getpid());
    if (!otx_recipe_write(json_object_get(recipe, "constraints"), path))
    {
        refuse_save(desk, error);
        return OSDTEX_ERROR_IO;
    }
    status = check_constraints(desk, path, error);
    unlink(path);
    return status;
}

osdtex_status
otx_desk_open(
    const otx_studio_options *options, otx_desk *desk,
    char error[OTX_STUDIO_ERROR_BYTES])
{
    json_t *recipe = NULL;
    osdtex_status status;

    *desk = (otx_desk){.options = options, .serial = 1};
    pthread_mutex_init(&desk->lock, NULL);
    pthread_cond_init(&desk->changed, NULL);
    status = make_checker(desk, error);
    if (status == OSDTEX_OK)
        status = read_state(desk, &recipe, error);
    if (status == OSDTEX_OK && !recipe)
    {
        if (options->map.constraints)
            status = check_constraints(desk, options->map.constraints, error);
        if (status == OSDTEX_OK && !(recipe = otx_recipe_first(&options->map)))
            status = OSDTEX_ERROR_MEMORY;
    }
    if (status == OSDTEX_OK && !save(desk, recipe))
    {
        refuse_save(desk, error);
        status = OSDTEX_ERROR_IO;
    }
    if (status == OSDTEX_OK)
        otx_past_push(&desk->past, recipe);
    else
        json_decref(recipe);
    return status;
}

void
otx_desk_close(otx_desk *desk)
{
    otx_snapshot_release(desk->snapshot);
    json_decref(desk->work.figures);
    otx_past_free(&desk->past);
    osdtex_surface_destroy(desk->cage);
    osdtex_context_destroy(desk->checker);
    pthread_cond_destroy(&desk->changed);
    pthread_mutex_destroy(&desk->lock);
}

/* -- changes -------------------------------------------------------------- */

void
otx_desk_touch(otx_desk *desk)
{
    ++desk->serial;
    pthread_cond_broadcast(&desk->changed);
}

/* The recipe in force is another one. */
static bool
take(otx_desk *desk, char error[OTX_STUDIO_ERROR_BYTES])
{
    const bool is_saved = save(desk, otx_past_now(&desk->past));

    desk->work.is_cancelled = false;
    otx_desk_touch(desk);
    return is_saved || refuse_save(desk, error);
}

bool
otx_desk_put(
    otx_desk *desk, const char *text, size_t bytes, int64_t revision,
    char error[OTX_STUDIO_ERROR_BYTES])
{
    json_t *recipe =
        otx_recipe_parse(text, bytes, desk->options->exemplar_count, error);
    bool is_taken = false;

    if (!recipe)
        return false;
    pthread_mutex_lock(&desk->lock);
    if (revision != desk->past.revision)
        otx_sentence(
            error,
            "another page has changed the model meanwhile; nothing was taken");
    else if (check(desk, recipe, error) == OSDTEX_OK)
    {
        otx_past_push(&desk->past, json_incref(recipe));
        is_taken = take(desk, error);
    }
    pthread_mutex_unlock(&desk->lock);
    json_decref(recipe);
    return is_taken;
}

bool
otx_desk_step(otx_desk *desk, int by, char error[OTX_STUDIO_ERROR_BYTES])
{
    bool is_taken = true;

    pthread_mutex_lock(&desk->lock);
    if (otx_past_step(&desk->past, by))
        is_taken = take(desk, error);
    pthread_mutex_unlock(&desk->lock);
    return is_taken;
}

void
otx_desk_cancel(otx_desk *desk)
{
    pthread_mutex_lock(&desk->lock);
    desk->work.is_cancelled = true;
    otx_desk_touch(desk);
    pthread_mutex_unlock(&desk->lock);
}

void
otx_desk_export(otx_desk *desk)
{
    pthread_mutex_lock(&desk->lock);
    desk->work.wants_export = true;
    desk->work.told[0] = '\0';
    otx_desk_touch(desk);
    pthread_mutex_unlock(&desk->lock);
}

void
otx_desk_end(otx_desk *desk)
{
    pthread_mutex_lock(&desk->lock);
    desk->is_closing = true;
    otx_desk_touch(desk);
    pthread_mutex_unlock(&desk->lock);
}

/* -- telling -------------------------------------------------------------- */

otx_snapshot *
otx_desk_snapshot(otx_desk *desk)
{
    otx_snapshot *held;

    pthread_mutex_lock(&desk->lock);
    held = otx_snapshot_hold(desk->snapshot);
    pthread_mutex_unlock(&desk->lock);
    return held;
}

static json_t *
tell_snapshot(const otx_desk *desk)
{
    const otx_snapshot *s = desk->snapshot;
    const bool has_figures = s && desk->work.figures_of == s->serial;

    if (!s)
        return json_null();
    return json_pack(
        "{s:I, s:I, s:I, s:i, s:i, s:f, s:b, s:o, s:o}", "serial",
        (json_int_t)s->serial, "surface",
        (json_int_t)s->outcome->surface_serial, "revision",
        (json_int_t)s->revision, "exemplar", s->outcome->exemplar, "exemplars",
        (int)osdtex_mapping_describe(s->outcome->mapping)->exemplar_count,
        "seconds", s->seconds, "is_edit", s->is_edit, "facts",
        json_deep_copy(s->facts), "figures",
        has_figures ? json_deep_copy(desk->work.figures) : json_null());
}

static json_t *
tell_exemplars(const otx_studio_options *options)
{
    json_t *names = json_array();

    for (int i = 0; i < options->exemplar_count; ++i)
    {
        const char *slash = strrchr(options->exemplars[i], '/');

        json_array_append_new(
            names,
            otx_sentence_json(slash ? slash + 1 : options->exemplars[i]));
    }
    return names;
}

static json_t *
tell(const otx_desk *desk)
{
    const otx_studio_options *o = desk->options;
    const json_t *recipe = otx_past_now(&desk->past);
    char *line = otx_recipe_command(recipe, o);
    json_t *command = line ? otx_sentence_json(line) : json_null();

    free(line);
    return json_pack(
        "{s:I, s:I, s:O, s:b, s:b, s:b, s:b, s:s, s:f, s:o, s:o, s:o, s:o, "
        "s:o}",
        "serial", (json_int_t)desk->serial, "revision",
        (json_int_t)desk->past.revision, "recipe", recipe, "can_undo",
        otx_past_has(&desk->past, -1), "can_redo", otx_past_has(&desk->past, 1),
        "busy", desk->work.is_busy, "cancelled", desk->work.is_cancelled,
        "stage", desk->work.stage, "fraction", desk->work.fraction, "error",
        otx_sentence_json(desk->work.error), "told",
        otx_sentence_json(desk->work.told), "command", command, "exemplars",
        tell_exemplars(o), "snapshot", tell_snapshot(desk));
}

char *
otx_desk_tell(otx_desk *desk, int64_t serial)
{
    struct timespec until;
    json_t *state;
    char *text;

    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_sec += WAIT_SECONDS;
    pthread_mutex_lock(&desk->lock);
    while (desk->serial <= serial && !desk->is_closing &&
           pthread_cond_timedwait(&desk->changed, &desk->lock, &until) == 0)
        ;
    state = tell(desk);
    text = state ? json_dumps(state, JSON_COMPACT) : NULL;
    json_decref(state);
    pthread_mutex_unlock(&desk->lock);
    return text;
}
