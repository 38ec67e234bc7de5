/* stack_command.c -- osdtex stack: pictures along a material axis. */
#include "cli/dispatch.h"
#include "cli/guard.h"
#include "cli/inputs.h"
#include "cli/saved_files.h"
#include "cli/session.h"
#include "cli/value.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const MORPHS[] = {"auto", "advect", "relax", "linear"};
static const char *const FEATURES[] = {"auto", "spots", "joints"};

enum
{
    MORPH_COUNT = sizeof MORPHS / sizeof *MORPHS,
    FEATURE_COUNT = sizeof FEATURES / sizeof *FEATURES,
    VARIED_SLICES = 4
};

typedef struct job
{
    otx_flag_values values; /* with the files of sets */
    const char *output;
    osdtex_exemplar_options exemplar_options;
    osdtex_stack_options options;
    osdtex_stack_figures figures;
    osdtex_material *sets[OSDTEX_STACK_KEYS_MAX]; /* NULL: a picture */
    osdtex_exemplar *keys[OSDTEX_STACK_KEYS_MAX];
    osdtex_image *masks[OSDTEX_STACK_KEYS_MAX];
    int mask_count;
} job;

static bool
parse_word(
    const otx_flag_values *values, otx_flag_id id, const char *const *words,
    int count, int32_t *out)
{
    int index = 0;

    if (values->text[id] &&
        !otx_value_word(values->text[id], words, count, &index))
    {
        otx_session_refuse(
            "--%s is %s, not '%s'", otx_flag_at(id)->name,
            otx_flag_at(id)->argument, values->text[id]);
        return false;
    }
    *out = index;
    return true;
}

static bool
parse_numbers(job *j)
{
    int64_t slices = j->options.slices, width = 0, seed = 1;

    if (!otx_inputs_number(
            &j->values, OTX_FLAG_SLICES, 2, OSDTEX_STACK_SLICES_MAX, &slices) ||
        !otx_inputs_number(&j->values, OTX_FLAG_STACK_SIZE, 32, 8192, &width) ||
        !otx_inputs_number(&j->values, OTX_FLAG_SEED, 0, INT64_MAX, &seed))
        return false;
    j->options.slices = (int32_t)slices;
    j->options.width = (int32_t)width;
    j->options.seed = (uint64_t)seed;
    return true;
}

/* As many masks as pictures, or fewer. */
static bool
check_masks(const otx_flag_values *values)
{
    const char *text = values->text[OTX_FLAG_MASKS];
    int count = text != NULL;

    for (const char *c = text ? text : ""; *c; ++c)
        count += *c == ',';
    if (count <= values->operand_count)
        return true;
    otx_session_refuse(
        "--masks names %d files for %d pictures", count, values->operand_count);
    return false;
}

/* Two pictures, or one that varies. */
static bool
parse_vary(job *j)
{
    j->options.vary = j->values.text[OTX_FLAG_VARY] != NULL;
    if (j->options.vary)
        j->options.slices = VARIED_SLICES;
    if ((j->values.operand_count == 1) == (j->options.vary != 0))
        return true;
    otx_session_refuse(
        "osdtex stack takes EXEMPLAR and EXEMPLAR to go from one to the other, "
        "or one with --vary");
    return false;
}

static bool
parse(job *j, const otx_flag_values *values)
{
    const char *const tileable = values->text[OTX_FLAG_TILEABLE];

    *j = (job){.values = *values, .output = values->text[OTX_FLAG_OUTPUT]};
    j->options = osdtex_stack_options_default();
    if (!j->output || !otx_value_has_extension(j->output, ".exr"))
    {
        otx_session_refuse("osdtex stack writes an EXR: -o DIR/NAME.exr");
        return false;
    }
    if (!otx_inputs_exemplar(values, &j->exemplar_options))
        return false;
    /* Slices tile, or there is no axis to lay them along. */
    if (!tileable)
        j->exemplar_options.tileable = OSDTEX_TILEABLE_MAKE;
    return parse_vary(j) && check_masks(values) && parse_numbers(j) &&
           parse_word(
               values, OTX_FLAG_MORPH, MORPHS, MORPH_COUNT,
               &j->options.morph) &&
           parse_word(
               values, OTX_FLAG_FEATURES, FEATURES, FEATURE_COUNT,
               &j->options.feature);
}

/* FILE,FILE,...: one for each picture; an empty name: it is found. */
static osdtex_status
read_masks(otx_session *session, job *j)
{
    const char *text = j->values.text[OTX_FLAG_MASKS];

    for (; text && *text; ++j->mask_count)
    {
        const size_t length = strcspn(text, ",");
        char *path = strndup(text, length);
        osdtex_status status = OSDTEX_OK;

        if (path && *path)
            status = osdtex_image_read(
                session->context, path, &j->masks[j->mask_count]);
        free(path);
        if (!path)
            return OSDTEX_ERROR_MEMORY;
        if (status != OSDTEX_OK)
            return status;
        text += length + (text[length] == ',');
    }
    j->options.masks = (const osdtex_image *const *)j->masks;
    return OSDTEX_OK;
}

/* Whether a name is a folder, or begins the names of a set: no file is called
 * so. */
static bool
is_set(const char *name)
{
    const char *base = strrchr(name, '/');

    return otx_path_list_is_folder(name) ||
           (access(name, F_OK) != 0 && !strchr(base ? base : name, '.'));
}

/* Pictures in the place of sets. */
static osdtex_status
find_sets(otx_session *session, job *j)
{
    for (int k = 0; k < j->values.operand_count; ++k)
    {
        const osdtex_material_info *info;
        osdtex_status status;

        if (!is_set(j->values.operands[k]))
            continue;
        status = osdtex_material_find(
            session->context, j->values.operands[k], &j->sets[k]);
        if (status != OSDTEX_OK)
            return status;
        info = osdtex_material_describe(j->sets[k]);
        j->values.operands[k] = info->color;
        otx_flag_inputs_add(&j->values.inputs, info->color);
        for (int i = 0; i < info->map_count; ++i)
            otx_flag_inputs_add(&j->values.inputs, info->maps[i].path);
    }
    return OSDTEX_OK;
}

static osdtex_status
read_keys(otx_session *session, job *j)
{
    osdtex_status status = OSDTEX_OK;

    for (int k = 0; k < j->values.operand_count && status == OSDTEX_OK; ++k)
    {
        const osdtex_material_info *set = osdtex_material_describe(j->sets[k]);
        osdtex_exemplar_options own = j->exemplar_options;

        own.maps = set ? set->maps : NULL;
        own.map_count = set ? set->map_count : 0;
        own.layer = set ? set->color_layer : NULL;
        status = osdtex_exemplar_read(
            session->context, j->values.operands[k], &own, &j->keys[k]);
    }
    return status;
}

static void
say_done(otx_session *session, const job *j, const osdtex_stack_info *info)
{
    otx_session_say(
        session,
        "wrote %s: %d slices of %d x %d texels, masks %s%s (%s), %.0f %% of "
        "the "
        "first picture; %.1f s",
        j->output, info->slice_count, info->width, info->height,
        j->options.vary ? "shared" : "by ",
        j->options.vary ? "" : MORPHS[info->morph],
        j->mask_count ? "given" : FEATURES[info->feature],
        100.0 * info->mask_share[0], otx_session_seconds(session));
}

static void
say_figures(otx_session *session, const osdtex_stack_figures *f)
{
    otx_session_say(
        session,
        "of the worst slice: features where they are asked for %.3f; contrast "
        "%.2f to %.2f and sharpness %.2f of the pictures; texels that change "
        "at once %.2f to %.2f of the mean; step to the next %.2f of the "
        "median, %.1f Lab away from what changes; colours %.1f Lab off",
        f->lookup, f->contrast_least, f->contrast_most, f->sharpness,
        f->flips_least, f->flips_most, f->step, f->still, f->colours);
}

static osdtex_status
make(otx_session *session, job *j)
{
    const int count = j->values.operand_count;
    osdtex_status status = read_keys(session, j);
    osdtex_stack_info info;

    if (status == OSDTEX_OK)
        status = read_masks(session, j);
    otx_session_lap(session, "inputs read");
    if (status != OSDTEX_OK)
        return status;
    if (j->values.text[OTX_FLAG_DRY_RUN])
    {
        printf("would make a stack of %d pictures into %s\n", count, j->output);
        return OSDTEX_OK;
    }
    j->figures.size = sizeof j->figures;
    j->options.figures = &j->figures;
    status = osdtex_stack_write(
        session->context, (const osdtex_exemplar *const *)j->keys, count,
        &j->options, j->output, &info);
    if (status == OSDTEX_OK)
        status = otx_session_commit(session);
    if (status == OSDTEX_OK)
    {
        say_done(session, j, &info);
        say_figures(session, &j->figures);
    }
    return status;
}

/* Of NAME.exr all that will be written. */
static osdtex_status
guard(otx_session *session, const job *j)
{
    const int stem = (int)strlen(j->output) - (int)strlen(".exr");
    otx_path_list outputs = {0};
    osdtex_status status;

    otx_path_list_add(&outputs, j->output);
    for (int k = 0; k < j->values.operand_count; ++k)
    {
        char name[4096];

        snprintf(name, sizeof name, "%.*s_mask%d.png", stem, j->output, k + 1);
        otx_path_list_add(&outputs, name);
    }
    status = otx_guard_check(session, &j->values, &outputs);
    otx_path_list_free(&outputs);
    return status;
}

int
otx_stack_command_run(const otx_flag_values *values)
{
    osdtex_status status;
    otx_session session;
    job j;

    if (!parse(&j, values))
        return OTX_EXIT_USAGE;
    if (!otx_session_begin(&session, values))
        return session.exit_code;
    status = find_sets(&session, &j);
    if (status == OSDTEX_OK)
        status = guard(&session, &j);
    if (status == OSDTEX_OK)
        status = osdtex_outputs_mark(
            session.context, NULL, otx_saved_files_source(&j.values));
    if (status == OSDTEX_OK)
        status = make(&session, &j);
    for (int k = 0; k < OSDTEX_STACK_KEYS_MAX; ++k)
    {
        osdtex_exemplar_destroy(j.keys[k]);
        osdtex_material_destroy(j.sets[k]);
        osdtex_image_destroy(j.masks[k]);
    }
    return otx_session_end(&session, status);
}
