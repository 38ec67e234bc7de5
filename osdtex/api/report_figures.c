/* report_figures.c -- the numbers of a report as rows.
 *
 * They are read from the JSON itself, so that a figure which is put there is
 * here, too. What comes in is left out: inputs, options, colours. */
#include "api/report_figures.h"

#include "api/report_words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const SECTIONS[] = {
    "mapping",     "seams", "distortion", "exemplar", "exemplars",
    "transitions", "tiles", "field",      "seconds",  "memory"};

typedef struct list
{
    otx_run *run;
    const otx_figures *own;
    int32_t count;
    osdtex_figure *rows; /* NULL: they are only counted */
} list;

/* What the method says of its own figure, which the table need not know. */
static const char *
own_unit(const otx_figures *own, const char *key)
{
    const size_t lead = strlen("mapping.");

    if (own && strncmp(key, "mapping.", lead) == 0)
        for (int32_t i = 0; i < own->count; ++i)
            if (strcmp(own->rows[i].name, key + lead) == 0)
                return own->rows[i].unit;
    return "";
}

static otx_status
add_number(list *l, const char *key, const json_t *number)
{
    const otx_report_words *words = otx_report_words_of(key);
    osdtex_figure *row;

    /* What is null and not known may be a text that is not there. */
    if (json_is_null(number) && !words)
        return OSDTEX_OK;
    if (!l->rows)
    {
        ++l->count;
        return OSDTEX_OK;
    }
    row = &l->rows[l->count++];
    *row = (osdtex_figure){
        .key = otx_arena_strdup(l->run->arena, key),
        .unit = words ? words->unit : own_unit(l->own, key),
        .sentence = words ? words->sentence : "",
        .value = json_is_null(number) ? NAN : json_number_value(number),
        .kind =
            json_is_integer(number) ? OSDTEX_FIGURE_COUNT : OSDTEX_FIGURE_REAL,
    };
    return row->key ? OSDTEX_OK : otx_fail_memory(l->run, "report");
}

static otx_status add(list *l, const char *key, json_t *value);

static otx_status
add_members(list *l, const char *key, json_t *object)
{
    const char *name;
    json_t *value;

    json_object_foreach(object, name, value)
    {
        char below[160];

        snprintf(below, sizeof below, "%s.%s", key, name);
        OTX_TRY(add(l, below, value));
    }
    return OSDTEX_OK;
}

static otx_status
add(list *l, const char *key, json_t *value)
{
    switch (json_typeof(value))
    {
    case JSON_OBJECT:
        return add_members(l, key, value);
    case JSON_ARRAY:
        for (size_t i = 0; i < json_array_size(value); ++i)
            OTX_TRY(add(l, key, json_array_get(value, i)));
        return OSDTEX_OK;
    case JSON_INTEGER:
    case JSON_REAL:
    case JSON_NULL:
        return add_number(l, key, value);
    default:
        return OSDTEX_OK;
    }
}

static otx_status
add_sections(list *l, const json_t *root)
{
    l->count = 0;
    for (size_t i = 0; i < sizeof SECTIONS / sizeof *SECTIONS; ++i)
    {
        json_t *section = json_object_get(root, SECTIONS[i]);

        if (section)
            OTX_TRY(add(l, SECTIONS[i], section));
    }
    return OSDTEX_OK;
}

otx_status
otx_report_figures(
    otx_run *run, const json_t *root, const otx_figures *own,
    const osdtex_figure **out, int32_t *count)
{
    list l = {.run = run, .own = own};

    OTX_TRY(add_sections(&l, root));
    l.rows = OTX_NEW(run->arena, osdtex_figure, l.count);
    if (!l.rows)
        return otx_fail_memory(run, "report");
    OTX_TRY(add_sections(&l, root));
    *out = l.rows;
    *count = l.count;
    return OSDTEX_OK;
}
