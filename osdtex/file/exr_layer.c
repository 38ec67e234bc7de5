/* exr_layer.c -- which part and which channels of an EXR are the picture. */
#include "file/exr_layer.h"

#include "file/exr_data.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum
{
    NAMES_BYTES = 400,
    NONE = OTX_EXR_NO_CHANNEL
};

/* How good a layer is as a picture; the smallest wins. */
typedef enum rank
{
    RANK_PLAIN,      /* R, G, B of a part without a name, or a beauty's */
    RANK_NAMED_PART, /* R, G, B of a part with another name */
    RANK_GRAY,       /* Y alone */
    RANK_BEAUTY,     /* a layer that is called as beauties are */
    RANK_OTHER,      /* another layer */
    RANK_DATA        /* what is called as things are that are no colours */
} rank;

/* A layer with colours. */
typedef struct candidate
{
    otx_exr_layer layer;
    rank rank;
    const char *name; /* "part.layer", "part", "layer"; "" plain */
} candidate;

typedef struct candidate_list
{
    otx_run *run;
    exr_const_context_t file;
    int32_t count, capacity;
    candidate *items;
} candidate_list;

/* ---- names -------------------------------------------------------------- */

/* Whether [begin, end) is one of the words, case apart, or one of them with
 * digits behind it. */
static bool
is_word(
    const char *begin, const char *end, const char *const *words, size_t count)
{
    while (end > begin && isdigit((unsigned char)end[-1]))
        --end;
    for (size_t i = 0; i < count; ++i)
        if (strlen(words[i]) == (size_t)(end - begin) &&
            strncasecmp(words[i], begin, (size_t)(end - begin)) == 0)
            return true;
    return false;
}

/* The end of the word that begins here: names are cut at dots. */
static const char *
word_end(const char *word)
{
    const char *dot = strchr(word, '.');

    return dot ? dot : word + strlen(word);
}

static const char *
last_word(const char *name)
{
    const char *dot = strrchr(name, '.');

    return dot ? dot + 1 : name;
}

static bool
is_beauty(const char *name)
{
    static const char *const words[] = {
        "",     "beauty", "rgba",     "rgb",   "combined",
        "c",    "ci",     "subimage", "part",  "color",
        "main", "colour", "default",  "image", "final"};
    const char *word = last_word(name);

    return is_word(
        word, word + strlen(word), words, sizeof words / sizeof *words);
}

static bool
is_data(const char *name)
{
    static const char *const words[] = {
        "n",          "ng",       "normal",      "normals",
        "z",          "depth",    "p",           "pos",
        "position",   "pref",     "uv",          "st",
        "id",         "ids",      "objectid",    "matid",
        "materialid", "motion",   "vector",      "motionvector",
        "mv",         "velocity", "mask",        "matte",
        "variance",   "pworld",   "worldnormal", "worldposition",
        "mist",       "indexob",  "indexma"};

    for (const char *word = name; *word;)
    {
        const char *end = word_end(word);

        if (strncasecmp(word, "crypto", 6) == 0 ||
            is_word(word, end, words, sizeof words / sizeof *words))
            return true;
        word = *end ? end + 1 : end;
    }
    return false;
}

/* ---- candidates --------------------------------------------------------- */

/* Index of the channel `layer` + `name`, or NONE. `layer` has `length` bytes,
 * its dot included. */
static int32_t
find_channel(
    const exr_attr_chlist_t *list, const char *layer, size_t length,
    const char *name)
{
    for (int32_t i = 0; i < list->num_channels; ++i)
    {
        const char *entry = list->entries[i].name.str;

        if (strncmp(entry, layer, length) == 0 &&
            strcasecmp(entry + length, name) == 0)
            return i;
    }
    return NONE;
}

/* Takes R, G, B (and A) of a layer. False when one of the three is missing. */
static bool
take_layer(
    const exr_attr_chlist_t *list, const char *layer, size_t length,
    otx_exr_layer *out)
{
    static const char *const names[4] = {"R", "G", "B", "A"};

    for (int32_t i = 0; i < 4; ++i)
        out->channels[i] = find_channel(list, layer, length, names[i]);
    return out->channels[0] != NONE && out->channels[1] != NONE &&
           out->channels[2] != NONE;
}

/* Luminance, alone or with chroma. */
static bool
take_luminance(const exr_attr_chlist_t *list, otx_exr_layer *out)
{
    const int32_t y = find_channel(list, "", 0, "Y");
    const int32_t ry = find_channel(list, "", 0, "RY");
    const int32_t by = find_channel(list, "", 0, "BY");

    if (y == NONE || (ry == NONE) != (by == NONE))
        return false;
    out->is_chroma = ry != NONE;
    out->is_gray = !out->is_chroma;
    out->channels[0] = y;
    out->channels[1] = out->is_chroma ? ry : y;
    out->channels[2] = out->is_chroma ? by : y;
    out->channels[3] = find_channel(list, "", 0, "A");
    return true;
}

static bool
part_is_flat(exr_const_context_t file, int part)
{
    exr_storage_t storage = EXR_STORAGE_LAST_TYPE;

    return exr_get_storage(file, part, &storage) == EXR_ERR_SUCCESS &&
           (storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED);
}

/* "part.layer", with what there is of the two. NULL when memory is out. */
static char *
full_name(otx_arena *arena, const char *part, const char *layer, size_t length)
{
    const size_t part_length = strlen(part);
    const bool dot = part_length > 0 && length > 0;
    char *name = OTX_NEW(arena, char, part_length + length + 2);

    if (name)
        snprintf(
            name, part_length + length + 2, "%s%s%.*s", part, dot ? "." : "",
            (int)length, layer);
    for (char *c = name; c && *c; ++c)
        if (*c < ' ' || *c > '~')
            *c = '?';
    return name;
}

static otx_status
add_candidate(candidate_list *list, candidate c, const char *part, size_t dot)
{
    const char *entry = NULL;
    const exr_attr_chlist_t *channels = NULL;

    if (list->count == list->capacity)
        return OSDTEX_OK;
    exr_get_channels(list->file, c.layer.part, &channels);
    entry = channels->entries[c.layer.channels[0]].name.str;
    c.name = full_name(list->run->arena, part, entry, dot);
    OTX_TRY(otx_run_ok(list->run));
    if (is_data(c.name))
        c.rank = RANK_DATA;
    else if (c.rank == RANK_PLAIN && !is_beauty(part))
        c.rank = RANK_NAMED_PART;
    else if (c.rank == RANK_OTHER && is_beauty(c.name))
        c.rank = RANK_BEAUTY;
    list->items[list->count++] = c;
    return OSDTEX_OK;
}

/* Plain colours of a part, and its layers: each is met at its R. */
static otx_status
add_part(candidate_list *list, int part)
{
    const exr_attr_chlist_t *channels = NULL;
    const char *name = NULL;
    candidate c = {.layer = {.part = part}};

    if (!part_is_flat(list->file, part) ||
        exr_get_channels(list->file, part, &channels) != EXR_ERR_SUCCESS)
        return OSDTEX_OK;
    if (exr_get_name(list->file, part, &name) != EXR_ERR_SUCCESS || !name)
        name = "";
    c.rank = RANK_PLAIN;
    if (take_layer(channels, "", 0, &c.layer))
        OTX_TRY(add_candidate(list, c, name, 0));
    else if (take_luminance(channels, &c.layer))
    {
        c.rank = c.layer.is_gray ? RANK_GRAY : RANK_PLAIN;
        OTX_TRY(add_candidate(list, c, name, 0));
    }
    c = (candidate){.layer = {.part = part}, .rank = RANK_OTHER};
    for (int32_t i = 0; i < channels->num_channels; ++i)
    {
        const char *entry = channels->entries[i].name.str;
        const char *dot = strrchr(entry, '.');

        if (dot && strcasecmp(dot, ".R") == 0 &&
            take_layer(channels, entry, (size_t)(dot + 1 - entry), &c.layer))
            OTX_TRY(add_candidate(list, c, name, (size_t)(dot - entry)));
    }
    return OSDTEX_OK;
}

static otx_status
find_candidates(candidate_list *list, int part_count)
{
    const exr_attr_chlist_t *channels = NULL;

    for (int part = 0; part < part_count; ++part)
        if (exr_get_channels(list->file, part, &channels) == EXR_ERR_SUCCESS)
            list->capacity += channels->num_channels;
    list->items = OTX_NEW(list->run->scratch, candidate, list->capacity);
    OTX_TRY(otx_run_ok(list->run));
    for (int part = 0; part < part_count; ++part)
        OTX_TRY(add_part(list, part));
    return OSDTEX_OK;
}

/* ---- what is said ------------------------------------------------------- */

/* What is there, for the message that says it is not what is needed. Bytes
 * that are not printable ASCII become '?'. */
static void
list_channels(exr_const_context_t file, int part_count, char text[NAMES_BYTES])
{
    const exr_attr_chlist_t *list = NULL;
    size_t used = 0;

    text[0] = '\0';
    for (int part = 0; part < part_count; ++part)
    {
        if (exr_get_channels(file, part, &list) != EXR_ERR_SUCCESS)
            continue;
        for (int32_t i = 0; i < list->num_channels; ++i)
        {
            const int n = snprintf(
                text + used, NAMES_BYTES - used, "%s%s", used > 0 ? ", " : "",
                list->entries[i].name.str);

            if (n < 0 || (size_t)n >= NAMES_BYTES - used)
                break;
            used += (size_t)n;
        }
    }
    for (char *c = text; *c; ++c)
        if (*c < ' ' || *c > '~')
            *c = '?';
}

static otx_status
no_color(
    otx_run *run, const char *path, exr_const_context_t file, int part_count)
{
    char names[NAMES_BYTES];
    bool deep = true;

    for (int part = 0; part < part_count; ++part)
        deep = deep && !part_is_flat(file, part);
    if (deep)
        return otx_fail(
            run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(path),
            "the EXR is deep; flatten it, for example with oiiotool --flatten");
    list_channels(file, part_count, names);
    return otx_fail(
        run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(path),
        "the EXR has no R, G, B, no Y and no layer with R, G, B, only "
        "%s; rename or select channels, for example with oiiotool --ch",
        names);
}

/* The names of the candidates of a rank, or of all. */
static void
list_layers(const candidate_list *list, bool all, rank of, char *text)
{
    size_t used = 0;

    text[0] = '\0';
    for (int32_t i = 0; i < list->count; ++i)
    {
        const candidate *c = &list->items[i];
        int n;

        if (!all && c->rank != of)
            continue;
        n = snprintf(
            text + used, NAMES_BYTES - used, "%s%s", used > 0 ? ", " : "",
            c->name[0] ? c->name : "RGB");
        if (n < 0 || (size_t)n >= NAMES_BYTES - used)
            break;
        used += (size_t)n;
    }
}

/* ---- the choice --------------------------------------------------------- */

static bool
is_called(const candidate *c, const char *wanted)
{
    return strcmp(c->name, wanted) == 0 ||
           (c->name[0] == '\0' && strcasecmp(wanted, "RGB") == 0);
}

/* Whether colours are called so, all of it or behind the last dot. */
static bool
has_layer(const candidate_list *list, const char *wanted)
{
    for (int32_t i = 0; i < list->count; ++i)
        if (is_called(&list->items[i], wanted) ||
            strcmp(last_word(list->items[i].name), wanted) == 0)
            return true;
    return false;
}

/* By its whole name, else by what stands behind the last dot. */
static otx_status
choose_wanted(
    const candidate_list *list, const char *path, const char *wanted,
    const candidate **out)
{
    char names[NAMES_BYTES];
    int32_t found = 0;

    for (int32_t i = 0; i < list->count && !*out; ++i)
        if (is_called(&list->items[i], wanted))
            *out = &list->items[i];
    for (int32_t i = 0; i < list->count && (!*out || found > 0); ++i)
        if (strcmp(last_word(list->items[i].name), wanted) == 0 && ++found == 1)
            *out = &list->items[i];
    if (*out && found <= 1)
        return OSDTEX_OK;
    list_layers(list, true, RANK_DATA, names);
    return otx_fail(
        list->run, OSDTEX_ERROR_ARGUMENT, "picture", otx_where_file(path),
        "the EXR has %s layer '%.60s' with colours; it has %s",
        found > 1 ? "more than one" : "no", wanted, names);
}

static otx_status
choose_best(const candidate_list *list, const char *path, const candidate **out)
{
    const candidate *best = NULL;
    char names[NAMES_BYTES];
    int32_t equals = 0;

    for (int32_t i = 0; i < list->count; ++i)
    {
        const candidate *c = &list->items[i];

        equals = !best || c->rank < best->rank ? 1
                 : c->rank == best->rank       ? equals + 1
                                               : equals;
        best = !best || c->rank < best->rank ? c : best;
    }
    *out = best;
    if (best->rank != RANK_DATA &&
        (equals == 1 || best->rank == RANK_PLAIN || best->rank == RANK_GRAY ||
         best->rank == RANK_BEAUTY))
        return OSDTEX_OK;
    list_layers(list, false, best->rank, names);
    return otx_fail(
        list->run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(path),
        "it is unclear which layer of the EXR is the picture; choose one with "
        "{layer}: %s",
        names);
}

static void
note_choice(const candidate_list *list, const char *path, const candidate *c)
{
    if (list->count > 1)
        otx_note(
            list->run, OSDTEX_SEVERITY_INFO, "picture", otx_where_file(path),
            "of %d layers with colours '%s' (part %d) is used", list->count,
            c->name[0] ? c->name : "RGB", c->layer.part);
    else if (c->rank > RANK_GRAY)
        otx_note(
            list->run, OSDTEX_SEVERITY_INFO, "picture", otx_where_file(path),
            "the EXR has no plain R, G, B; layer '%s' is used", c->name);
}

static otx_status
choose(
    otx_run *run, const char *path, exr_const_context_t file,
    const char *wanted, otx_exr_layer *out)
{
    candidate_list list = {.run = run, .file = file};
    const candidate *chosen = NULL;
    int part_count = 0;

    exr_get_count(file, &part_count);
    OTX_TRY(find_candidates(&list, part_count));
    if (wanted && !has_layer(&list, wanted) &&
        otx_exr_data_find(run, file, wanted, out))
        return OSDTEX_OK;
    if (list.count == 0)
        return no_color(run, path, file, part_count);
    OTX_TRY(
        wanted ? choose_wanted(&list, path, wanted, &chosen)
               : choose_best(&list, path, &chosen));
    note_choice(&list, path, chosen);
    *out = chosen->layer;
    out->name = chosen->name[0] ? chosen->name : NULL;
    return OSDTEX_OK;
}

/* Colours that are subsampled otherwise than as chroma would need a filter of
 * their own; an alpha that is goes without. */
static otx_status
check_channels(
    otx_run *run, const char *path, exr_const_context_t file,
    otx_exr_layer *out)
{
    const exr_attr_chlist_t *list = NULL;

    exr_get_channels(file, out->part, &list);
    for (int32_t i = 0; i < 4; ++i)
    {
        const exr_attr_chlist_entry_t *entry;
        const int32_t step = out->is_chroma && (i == 1 || i == 2) ? 2 : 1;

        if (out->channels[i] == NONE)
            continue;
        entry = &list->entries[out->channels[i]];
        if (entry->x_sampling == step && entry->y_sampling == step)
            continue;
        if (i < 3)
            return otx_fail(
                run, OSDTEX_ERROR_SUPPORT, "picture", otx_where_file(path),
                "the EXR has subsampled colours; convert it to full "
                "resolution R, G, B");
        out->channels[i] = NONE;
    }
    out->bits =
        list->entries[out->channels[0]].pixel_type == EXR_PIXEL_HALF ? 16 : 32;
    return OSDTEX_OK;
}

otx_status
otx_exr_layer_choose(
    otx_run *run, const char *path, exr_const_context_t file,
    const char *wanted, otx_exr_layer *out)
{
    *out = (otx_exr_layer){0};
    OTX_TRY(choose(run, path, file, wanted, out));
    return check_channels(run, path, file, out);
}
